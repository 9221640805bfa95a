/// `sightline rooms`: the rooms of a plan, what is seen of each, and means of measures in each.
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "studies/room_table.h"
#include "studies/vga_run.h"

#include <stdio.h>

typedef struct rooms_plan {
    vga_plan graph; ///< `points.step` 0: no grid
    option_list from;
    double width;
    const char *parts_given;
    bool json;
} rooms_plan;

static sl_status read_eyes(sl_context *context, const rooms_plan *plan, const sl_space *space,
                           eye_places *eyes) {
    for (size_t i = 0; i < plan->from.count; i++) {
        eye_place eye = {.fov = 360};
        SL_TRY(read_point(context, "--from", plan->from.items[i], &eye.at));
        SL_TRY(input_locate(context, "--from", plan->from.items[i], space, eye.at, NULL));
        SL_TRY(eyes_add(context, eyes, eye));
    }
    return SL_OK;
}

static sl_status look(sl_context *context, const rooms_plan *plan, const vga_work *w,
                      room_table *table) {
    eye_places eyes = {0};
    const isovist_scene scene = {
        .space = &w->baked.space, .query = w->query, .range = sl_query_range(w->query)};
    sl_status status = read_eyes(context, plan, &w->baked.space, &eyes);
    if (status == SL_OK) status = room_table_look(context, &scene, &eyes, table);
    eyes_destroy(context, &eyes);
    return status;
}

static sl_status read_plan(sl_context *context, rooms_plan *plan, vga_work *w) {
    vga_plan *graph = &plan->graph;
    if (graph->points.step > 0) return vga_compute(context, graph, w);
    SL_TRY(pipeline_read_space(context, &graph->pipeline, "rooms", ~0u, NULL, &w->baked));
    SL_TRY(pipeline_need_inside(context, &graph->pipeline, &w->baked.map, &w->baked.space, ""));
    SL_TRY(doors_shut(context, &graph->doors, &w->baked));
    return sl_query_over(context, &w->baked.space, &w->baked.map, NULL, &w->query);
}

static sl_status work(command_console *console, rooms_plan *plan, vga_work *w, room_table *table) {
    sl_context *context = console->context;
    const char *output = plan->graph.output;
    if (plan->parts_given && !(plan->graph.points.step > 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "--measures is of no use without --grid");
    if (!plan->parts_given) plan->graph.parts = VGA_PART_VISUAL | VGA_PART_ISOVIST;
    if (plan->graph.parts & VGA_PART_ALL) plan->graph.parts |= VGA_PART_ALL - 1;
    plan->graph.parts &= VGA_PART_ALL - 1;
    SL_TRY(pipeline_plan(context, plan->graph.input, &plan->graph.pipeline));
    pipeline_take_drawn_doors(context, &plan->graph.pipeline);
    SL_TRY(read_plan(context, plan, w));
    SL_TRY(room_table_make(context, &w->baked, plan->width, table));
    if (!table->rooms.count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: the plan has no room: nothing inside is as wide as its doors (%.4g)",
                       plan->graph.input, table->rooms.width);
    room_table_note(context, table);
    if (plan->from.count) SL_TRY(look(context, plan, w, table));
    if (plan->graph.points.step > 0) SL_TRY(room_table_average(context, &w->table, table));
    progress_line_clear(&console->line);
    if (output || !plan->json) SL_TRY(room_table_write(context, table, output ? output : "-"));
    return plan->json ? room_table_print_json(context, table) : SL_OK;
}

sl_status cmd_rooms(command_console *console, int argc, char **argv) {
    rooms_plan plan = {.graph = {.command = "rooms",
                                 .pipeline = pipeline_default(),
                                 .options = sl_vga_options_default()}};
    vga_plan *graph = &plan.graph;
    const option_table pipeline = pipeline_option_table(&graph->pipeline),
                       doors = door_option_table(&graph->doors);
    const option_spec options[] = {
        {"output", 'o', "FILE.csv", "where the table goes (default: stdout)",
         .text = &graph->output, .check = CHECK_TABLE},
        {"from", 0, "X,Y",
         "add what is seen of each room from here: seen_area and seen_share; may be given several "
         "times",
         .list = &plan.from},
        {"grid", 0, "STEP",
         "add means of measures over the points of a grid with this step, and how many points a "
         "room has",
         .number = &graph->points.step, .over_0 = true},
        {"measures", 0, "GROUP,...",
         "with --grid: which measures: visual, through, metric, angular, isovist, all (default: "
         "visual,isovist)",
         .choices = &graph->parts, .names = vga_parts(), .given = &plan.parts_given},
        {"door-width", 0, "W",
         "openings narrower than this are doors (default: 1.1 m if the unit is known, else found "
         "from the plan)",
         .number = &plan.width, .over_0 = true},
        {"json", 0, NULL, "print one JSON object", .flag = &plan.json},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &graph->options.threads, .most = 1024},
        {.group = &doors},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "rooms",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Lists the rooms of a plan: what its walls enclose once all doors and narrow "
                "openings are shut, the largest first. A room has the name of a text in it, else a "
                "number. Doors that a drawing shows are kept as doors. Sight goes "
                "through doors that are open.",
        .examples = "  sightline rooms office.map\n"
                    "  sightline rooms office.map --from 3,3 -o seen.csv\n"
                    "  sightline rooms office.map --grid 0.5 -o means.csv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &graph->pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &graph->input, &helped));
    if (helped) return SL_OK;
    vga_work w = {0};
    room_table table = {0};
    const sl_status status = work(console, &plan, &w, &table);
    room_table_destroy(console->context, &table);
    vga_work_destroy(console->context, &w);
    return status;
}
