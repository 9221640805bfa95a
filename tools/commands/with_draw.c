/// Registers what commands use of sightline_draw.
#include "commands/commands.h"
#include "system/built.h"

static const built_command commands[] = {{"draw", cmd_draw}, {"report", cmd_report}, {0}};

static const built_draw draw = {
    .options_default = sl_draw_options_default,
    .file = sl_draw_file,
    .check_sheet = sl_draw_check_sheet,
    .explanation = sl_draw_explanation,
    .eye = sl_draw_eye,
    .regions = sl_draw_regions_file,
    .set = sl_draw_set_file,
    .coverage = sl_draw_coverage_file,
    .field = sl_draw_field_file,
    .patches = sl_draw_patches_file,
    .lines = sl_draw_lines_file,
    .chart = sl_draw_chart_file,
    .document = sl_draw_document_file,
};

const built_part with_draw = {.commands = commands, .draw = &draw};
