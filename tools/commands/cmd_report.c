/// `sightline report`: plan, measures, heat maps, tables and method of a plan in one PDF.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "studies/plan_report.h"
#include "system/built.h"

#include <stdio.h>

static void print_measures(void) {
    help_measures(SL_VGA);
}

sl_status cmd_report(command_console *console, int argc, char **argv) {
    plan_report_plan plan = {.graph = {.command = "report",
                                       .pipeline = pipeline_default(),
                                       .options = sl_vga_options_default()}};
    vga_plan *graph = &plan.graph;
    const char *output = NULL;
    const option_table pipeline = pipeline_option_table(&graph->pipeline),
                       doors = door_option_table(&graph->doors);
    const option_spec options[] = {
        {"output", 'o', "OUT.pdf", "the report", .text = &output, .check = CHECK_FILE,
         .endings = ".pdf"},
        {"grid", 0, "STEP",
         "distance between neighbouring points (default: a round step that gives about 2000 to "
         "12000 points)",
         .number = &graph->points.step, .over_0 = true},
        {"title", 0, "TEXT", "the title (default: the name of the file)", .text = &plan.title},
        {"measure", 0, "NAME",
         "draw a heat map of this measure; may be given several times (default: area, "
         "visual_integration_hh, connectivity and through_vision)",
         .list = &plan.measures},
        {"cameras", 0, "TABLE",
         "what these viewpoints see together, as 'cover' shows it: classes with their areas, each "
         "room, blind spots",
         .text = &plan.cameras, .is_input = true},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &graph->options.threads, .most = 1024},
        {.group = &doors},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "report",
        .synopsis = "MAP|FILE.slv -o OUT.pdf [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Writes a report of a plan: the plan, measures of visible regions and of the "
                "visibility graph as a table and as heat maps, rooms, cameras, axial lines, and "
                "how exact all of it is. Doors that a drawing shows are kept as doors. Letters are "
                "text, and the same plan gives the same bytes.",
        .tables = print_measures,
        .examples = "  sightline report office.map -o office.pdf\n"
                    "  sightline report office.map --cameras cameras.csv -o office.pdf\n"
                    "  sightline report office.map --grid 1 --title \"Office\" -o office.pdf",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &graph->pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &graph->input, &helped));
    if (helped) return SL_OK;
    if (!output)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "-o is missing: name the report, ending in .pdf");
    SL_TRY(pipeline_plan(console->context, graph->input, &graph->pipeline));
    pipeline_take_drawn_doors(console->context, &graph->pipeline);
    const sl_status status = plan_report_write(console->context, &plan, output);
    progress_line_clear(&console->line);
    return status;
}
