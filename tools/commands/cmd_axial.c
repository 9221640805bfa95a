/// `sightline axial`: the axial lines of a plan, or drawn ones, and their measures.
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/pipeline.h"
#include "inputs/within.h"
#include "reports/line_table.h"
#include "sightline/axial.h"
#include "sightline/query.h"
#include "sightline/support.h"
#include "system/built.h"

#include <inttypes.h>
#include <string.h>

typedef struct lines_kind {
    const char *name;
} lines_kind;

enum { LINES_ALL, LINES_SUBSETS, LINES_FEWEST, LINES_DRAWN };
static const lines_kind kinds[] = {{"all"}, {"subsets"}, {"fewest"}, {"drawn"}};

typedef struct axial_plan {
    const char *input, *output, *picture;
    door_choice doors;
    map_pipeline pipeline;
    within_plan within;
    option_list radii;
    size_t lines, measure;
    const char *lines_given;
    unsigned threads;
    sl_draw_options drawing;
} axial_plan;

typedef struct axial_work {
    sl_baked baked;
    sl_space part; ///< of --within
    sl_map drawn;
    sl_query *query;
    sl_axial_lines lines;
    sl_line_graph graph;
    sl_axial_measures *measures;
    line_table table;
} axial_work;

static sl_status take_drawn(sl_context *context, const axial_plan *plan, axial_work *w) {
    SL_TRY(lines_read(context, plan->input, &plan->pipeline.input, &w->drawn));
    if (w->drawn.wall_count > INT32_MAX) return sl_fail(context, SL_UNSUPPORTED, "too many lines");
    w->lines.lines = sl_alloc_array(context, w->drawn.wall_count, sizeof *w->lines.lines);
    if (!w->lines.lines) return SL_NO_MEMORY;
    for (size_t i = 0; i < w->drawn.wall_count; i++)
        w->lines.lines[w->lines.count++] = (sl_segment){w->drawn.walls[i].a, w->drawn.walls[i].b};
    return SL_OK;
}

static sl_status find_lines(sl_context *context, const axial_plan *plan, axial_work *w) {
    SL_TRY(pipeline_read_space(context, &plan->pipeline, "axial", SL_EFFECT_DOOR,
                               "axial lines end at walls alone", &w->baked));
    if (!name_ends_with(plan->input, ".slv"))
        SL_TRY(pipeline_need_inside(context, &plan->pipeline, &w->baked.map, &w->baked.space, ""));
    SL_TRY(doors_shut(context, &plan->doors, &w->baked));
    if (plan->within.path)
        SL_TRY(
            within_space(context, &plan->within, &plan->pipeline.input, &w->baked.space, &w->part));
    const sl_space *space = plan->within.path ? &w->part : &w->baked.space;
    const sl_outline *outline;
    SL_TRY(sl_query_over(context, space, &w->baked.map, NULL, &w->query));
    SL_TRY(sl_query_outline(context, w->query, &outline));
    SL_TRY(sl_axial_all_lines(context, outline, plan->threads, &w->lines));
    if (!w->lines.count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the map has no axial line: none of its corners is inside; lines that are "
                       "drawn are read by --lines drawn");
    if (plan->lines == LINES_ALL) return SL_OK;
    const uint32_t all = w->lines.count;
    SL_TRY(sl_axial_fewest(context, &w->lines, plan->lines == LINES_FEWEST));
    sl_note(context, "%" PRIu32 " of %" PRIu32 " lines stay", w->lines.count, all);
    return SL_OK;
}

/// "n" is the whole network.
static sl_status read_radius(sl_context *context, const char *text, uint32_t *radius,
                             char ending[32]) {
    uint64_t count = 0;
    ending[0] = '\0';
    if (strcmp(text, "n") != 0) SL_TRY(read_count(context, "--radius", text, UINT32_MAX, &count));
    if (!count && strcmp(text, "n") != 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--radius 0: a number over 0, or n, is needed");
    if (count) snprintf(ending, 32, "_r%" PRIu64, count);
    *radius = (uint32_t)count;
    return SL_OK;
}

static sl_status check_radii(sl_context *context, const axial_plan *plan) {
    uint32_t radius, other;
    char ending[32];
    for (size_t i = 0; i < plan->radii.count; i++) {
        SL_TRY(read_radius(context, plan->radii.items[i], &radius, ending));
        for (size_t k = 0; k < i; k++) {
            SL_TRY(read_radius(context, plan->radii.items[k], &other, ending));
            if (other == radius)
                return sl_fail(context, SL_BAD_ARGUMENT, "--radius %s is given twice",
                               plan->radii.items[i]);
        }
    }
    return SL_OK;
}

static sl_status measure(sl_context *context, const axial_plan *plan, axial_work *w) {
    const size_t count = plan->radii.count ? plan->radii.count : 1;
    SL_TRY(sl_line_graph_make(context, w->lines.lines, w->lines.count, &w->graph));
    w->measures = sl_alloc_array(context, w->lines.count, sizeof *w->measures);
    if (!w->measures) return SL_NO_MEMORY;
    w->table.lines = w->lines.lines;
    const sl_map *map = plan->lines == LINES_DRAWN ? &w->drawn : &w->baked.map;
    w->table.earth = map->earth;
    w->table.unit = map->unit;
    w->table.layer = "AXIAL";
    w->table.count = w->lines.count;
    for (size_t i = 0; i < count; i++) {
        sl_axial_options options = {.threads = plan->threads};
        char ending[32];
        SL_TRY(read_radius(context, plan->radii.count ? plan->radii.items[i] : "n", &options.radius,
                           ending));
        SL_TRY(sl_axial_measure(context, w->lines.lines, &w->graph, &options, w->measures));
        SL_TRY(
            line_table_add(context, &w->table, SL_AXIAL, w->measures, sizeof *w->measures, ending));
    }
    return SL_OK;
}

/// Some files hold drawn lines only, and these pass doors as they pass walls.
static sl_status check_lines(sl_context *context, axial_plan *plan) {
    if (lines_are_drawn(plan->input) && !plan->lines_given) plan->lines = LINES_DRAWN;
    if (plan->lines != LINES_DRAWN)
        return name_ends_with(plan->input, ".csv")
                   ? sl_fail(context, SL_BAD_ARGUMENT,
                             "--lines %s: a .csv holds drawn lines, and no plan to find some in; "
                             "give the map",
                             kinds[plan->lines].name)
                   : SL_OK;
    if (plan->within.path)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--within: drawn lines are measured as they are, all of them");
    if (!plan->doors.shut && !plan->doors.open) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--%s: drawn lines are measured as they are, without doors",
                   plan->doors.shut ? "shut" : "open");
}

static sl_status work(command_console *console, axial_plan *plan, axial_work *w) {
    sl_context *context = console->context;
    SL_TRY(check_radii(context, plan));
    SL_TRY(check_lines(context, plan));
    SL_TRY(within_check(context, &plan->within));
    const bool drawn = plan->lines == LINES_DRAWN;
    SL_TRY(pipeline_plan(context, plan->input, &plan->pipeline));
    SL_TRY(drawn ? take_drawn(context, plan, w) : find_lines(context, plan, w));
    SL_TRY(measure(context, plan, w));
    const line_column *column = line_table_column(&w->table, plan->measure);
    if (plan->picture)
        SL_TRY(line_table_draw(context, &w->table, column, drawn ? NULL : &w->baked, plan->input,
                               plan->pipeline.input.import.map, &plan->drawing, plan->picture));
    progress_line_clear(&console->line);
    const char *path = plan->output ? plan->output : plan->picture ? NULL : "-";
    if (path) SL_TRY(line_table_write(context, &w->table, path));
    if (!console->quiet && (!path || strcmp(path, "-") != 0))
        line_table_print(&w->table, "line", column);
    return SL_OK;
}

static void print_tables(void) {
    help_measures(SL_AXIAL);
}

sl_status cmd_axial(command_console *console, int argc, char **argv) {
    axial_plan plan = {.pipeline = pipeline_default(),
                       .lines = LINES_FEWEST,
                       .measure = sl_measure_find(SL_AXIAL, "integration_hh"),
                       .drawing = built_draw_options()};
    const name_table lines = {"kind of lines", kinds, sizeof *kinds, sizeof kinds / sizeof *kinds,
                              NULL};
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table picture = picture_option_table(&plan.drawing, "picture", true);
    const option_table doors = door_option_table(&plan.doors);
    const option_table within = within_option_table(
        &plan.within, "only lines within the closed outlines of a drawing or map; they end there "
                      "as at walls");
    const option_spec options[] = {
        {"lines", 0, "NAME",
         "all: the all-line map; subsets, fewest (default): lines of it that cover the plan; "
         "drawn: the lines of the file",
         .choice = &plan.lines, .names = lines, .given = &plan.lines_given},
        {"output", 'o', "TABLE",
         "where the table goes: .csv, .geojson for a GIS, or .dxf for the lines alone (default: "
         "stdout, or nowhere if there "
         "is a --picture)",
         .text = &plan.output, .check = CHECK_FILE, .endings = ".csv .txt .geojson .dxf"},
        {"picture", 0, "PICTURE", "draw the lines: .png, .svg or .pdf", .text = &plan.picture,
         .check = CHECK_PICTURE},
        {"measure", 0, "NAME",
         "what the picture shows and the summary ranks (default: integration_hh)",
         .choice = &plan.measure, .names = measure_table(SL_AXIAL)},
        {"radius", 0, "N",
         "only lines within N steps, or n for all (default); may be given several times",
         .list = &plan.radii},
        {"threads", 0, "N", "number of threads (default: one per core)", .count32 = &plan.threads,
         .most = 1024, .rare = true},
        {.group = &within},
        {.group = &doors},
        {.group = &picture},
        {.group = &pipeline},
    };
    const command_usage usage = {
        .name = "axial",
        .synopsis = "MAP|FILE.slv [options]",
        .operands = {"MAP|FILE.slv"},
        .what = "Finds the axial lines of a plan (space syntax), or reads drawn ones: a map, "
                "GeoJSON, or a .csv with the columns x1,y1,x2,y2. Writes a table of their measures "
                "under the "
                "names of depthmapX. Corners are in line only where they are so exactly. So a plan "
                "that is turned by any angle has up to three times as many lines.",
        .examples = "  sightline axial office.map -o axial.csv --picture axial.png\n"
                    "  sightline axial drawn.dxf --lines drawn --radius n --radius 3 -o axial.csv",
        .tables = print_tables,
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    axial_work w = {0};
    const sl_status status = work(console, &plan, &w);
    line_table_destroy(console->context, &w.table);
    sl_free(console->context, w.measures);
    sl_line_graph_destroy(console->context, &w.graph);
    sl_axial_lines_destroy(console->context, &w.lines);
    sl_query_destroy(console->context, w.query);
    sl_space_destroy(console->context, &w.part);
    sl_map_destroy(console->context, &w.drawn);
    sl_baked_destroy(console->context, &w.baked);
    return status;
}
