#include "commands.h"
#include "faults_report.h"
#include "pictures.h"
#include "pipeline.h"
#include "sightline/draw.h"
#include "sightline/support.h"

#include <math.h>

/// The options as they are given.
typedef struct check_texts {
    sl_pipeline_texts pipeline;
    const char *output, *gap, *thin, *most, *snap, *width;
    bool json, dark;
} check_texts;

typedef struct check_plan {
    sl_pipeline pipeline;
    sl_faults_options faults;
    sl_draw_options drawing;
    const char *output, *snap;
    uint64_t most;
    bool json;
} check_plan;

/// A map with its space, for as long as both are looked at.
typedef struct checked {
    sl_map map;     ///< as read: walls with their lines
    sl_baked baked; ///< its space, and the rest of the map for the picture
    sl_faults faults;
} checked;

static void destroy(sl_context *context, checked *c) {
    sl_map_destroy(context, &c->map);
    sl_baked_destroy(context, &c->baked);
    sl_faults_destroy(context, &c->faults);
}

/// Subdivides and looks for faults; c->map is there, and c->baked.map is a copy to be cleaned.
static sl_status examine(sl_context *context, const check_plan *plan, checked *c) {
    SL_TRY(sl_input_clean(context, &plan->pipeline.texts, &c->baked.map, NULL));
    SL_TRY(sl_pipeline_subdivide(context, &plan->pipeline, &c->baked.map, &c->baked.space));
    SL_TRY(sl_pipeline_check(context, &plan->pipeline, &c->baked.space));
    return sl_find_faults(context, &c->map, &c->baked.space, &plan->faults, &c->faults);
}

/// Closes gaps, writes the map, and counts what is left.
static sl_status mend(sl_context *context, const check_plan *plan, const checked *before,
                      sl_faults_report *report) {
    checked after = {0};
    sl_status status = sl_map_copy(context, &before->map, &after.map);
    if (status == SL_OK) status = sl_map_snap(context, &after.map, report->gap, &report->snap);
    if (status == SL_OK && !after.map.wall_count)
        status = sl_fail(context, SL_BAD_ARGUMENT,
                         "--snap %s: closing gaps up to %g (--gap) leaves no wall", plan->snap,
                         report->gap);
    if (status == SL_OK) status = sl_map_copy(context, &after.map, &after.baked.map);
    if (status == SL_OK) status = examine(context, plan, &after);
    if (status == SL_OK) status = sl_map_write_text(context, &after.map, plan->snap);
    for (int kind = 0; kind < SL_FAULT_KINDS; kind++)
        report->left[kind] = after.faults.counts[kind];
    report->mended = plan->snap;
    destroy(context, &after);
    return status;
}

static sl_status check(sl_console *console, const check_plan *plan, checked *c) {
    sl_context *context = console->context;
    SL_TRY(sl_pipeline_read(context, &plan->pipeline, &c->map));
    SL_TRY(sl_map_copy(context, &c->map, &c->baked.map));
    SL_TRY(examine(context, plan, c));
    const sl_box box = sl_map_bounds(&c->map);
    const double usual = hypot(box.max.x - box.min.x, box.max.y - box.min.y) / 1000;
    sl_faults_report report = {.input = plan->pipeline.input,
                               .map = &c->map,
                               .space = &c->baked.space,
                               .faults = &c->faults,
                               .gap = plan->faults.gap > 0 ? plan->faults.gap : usual,
                               .thin = plan->faults.thin > 0 ? plan->faults.thin : usual,
                               .most = plan->most};
    if (plan->snap) SL_TRY(mend(context, plan, c, &report));
    if (plan->output) {
        sl_draw_options drawing = plan->drawing;
        drawing.faults = &c->faults;
        SL_TRY(sl_draw_file(context, &c->baked, &drawing, plan->output));
    }
    sl_progress_line_clear(&console->line);
    return plan->json ? sl_faults_print_json(context, &report) : sl_faults_print(&report);
}

static sl_status read_size(sl_context *context, const char *option, const char *text,
                           double *size) {
    SL_TRY(sl_option_number(context, option, text, size));
    if (!text || *size > 0) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "%s %s: a number over 0 is needed", option, text);
}

static sl_status make_plan(sl_context *context, const char *input, const check_texts *t,
                           check_plan *plan) {
    SL_TRY(sl_pipeline_plan(context, input, &t->pipeline, &plan->pipeline));
    SL_TRY(read_size(context, "--gap", t->gap, &plan->faults.gap));
    SL_TRY(read_size(context, "--thin", t->thin, &plan->faults.thin));
    plan->most = 10;
    SL_TRY(sl_option_count(context, "--most", t->most, UINT32_MAX, &plan->most));
    SL_TRY(sl_picture_plan(context, t->width, NULL, t->dark, &plan->drawing));
    plan->output = t->output;
    plan->snap = t->snap;
    plan->json = t->json;
    SL_TRY(sl_picture_check(context, input, "-o", t->output));
    return sl_output_check(context, input, "--snap", t->snap);
}

static void print_tables(void) {
    sl_pipeline_print_subdivisions();
    sl_input_print_formats();
}

sl_status sl_cmd_check(sl_console *console, int argc, char **argv) {
    check_texts t = {0};
    const sl_option_spec options[] = {
        {"gap", 0, "SIZE", NULL, &t.gap,
         "tell of gaps up to this width (the default is a\nthousandth of the map's diagonal)"},
        {"thin", 0, "SIZE", NULL, &t.thin, "tell of cells thinner than this (the same default)"},
        {"snap", 0, "FIXED.map", NULL, &t.snap, "close such gaps and write the map so mended"},
        {"output", 'o', "PICTURE", NULL, &t.output,
         "mark all faults on the plan: .png, .svg or .pdf"},
        {"width", 0, "PX", NULL, &t.width, "of the picture, 64 to 20000 pixels or points"},
        {"dark", 0, NULL, &t.dark, NULL, "light on dark"},
        {"most", 0, "N", NULL, &t.most, "print so many faults of a kind, 10 unless told"},
        SL_PIPELINE_OPTIONS(t.pipeline),
        {"json", 0, NULL, &t.json, NULL, "print all faults as one JSON object"},
    };
    const sl_command_usage usage = {
        .name = "check",
        .synopsis = "MAP [options]",
        .operands = {"MAP"},
        .what = "Looks a map over: leaks from a start to the outside with their way, gaps between\n"
                "walls, overlaps and crossings, thin cells, rooms that no start leads to.",
        .tables = print_tables,
        .examples = "  sightline check office.map -o office-check.png\n"
                    "  sightline check plan.dxf --start 3,5 --gap 0.02 --snap mended.map",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    check_plan plan = {0};
    checked c = {0};
    bool helped;
    const char *input;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, input, &t, &plan));
    const sl_status status = check(console, &plan, &c);
    destroy(console->context, &c);
    return status;
}
