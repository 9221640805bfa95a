/// `sightline regions`: what view cells see, by every from-region method (Laine 2005).
#include "arguments/help.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "inputs/pipeline.h"
#include "sightline/support.h"
#include "studies/regions_report.h"
#include "system/built.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

// --- measuring

/// Processor time of all threads: other programs on the machine do not change it.
static double processor_seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static sl_status check_same(sl_context *context, const sl_from_region_result *a,
                            const sl_from_region_result *b, const char *first, const char *second) {
    const size_t bytes = (size_t)a->view_cells * a->words * sizeof *a->seen;
    if (memcmp(a->seen, b->seen, bytes) == 0) return SL_OK;
    return sl_fail(context, SL_BAD_INPUT,
                   "the methods '%s' and '%s' see different objects, which they must not: please "
                   "report it with the map",
                   first, second);
}

static sl_status run_methods(sl_context *context, const sl_from_region_scene *regions,
                             const sl_from_region_options *how, regions_row *row,
                             sl_from_region_result results[REGIONS_METHODS_MOST]) {
    size_t count;
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    for (size_t i = 0; i < count && i < REGIONS_METHODS_MOST; i++) {
        const double start = processor_seconds();
        SL_TRY(methods[i].see(context, regions, how, &results[i]));
        const sl_from_region_result *r = &results[i];
        const double asked = (double)r->images * row->counts.objects;
        row->costs[row->cost_count++] =
            (regions_cost){.method = methods[i].name,
                           .seconds = processor_seconds() - start,
                           .refined = asked > 0 ? (double)r->refined / asked : 0,
                           .candidates = r->candidates,
                           .relations = r->relations};
        SL_TRY(check_same(context, &results[0], r, methods[0].name, methods[i].name));
    }
    row->images = results[0].images;
    row->rays = results[0].rays;
    row->pairs = sl_from_region_pairs(&results[0]);
    return SL_OK;
}

static void name_view_cells(const sl_from_region_scene_options *what, char *text, size_t size) {
    if (what->view_cells == SL_VIEW_CELLS_GRID)
        snprintf(text, size, "%u x %u", what->grid, what->grid);
    else
        snprintf(text, size, "%s", what->view_cells == SL_VIEW_CELLS_BOXES ? "boxes" : "leaves");
}

/// Runs all methods and adds a row. SL_BAD_INPUT where two methods see different objects, which
/// must not happen.
static sl_status regions_measure(sl_context *context, const sl_map *map, const char *name,
                                 const sl_from_region_scene_options *what,
                                 const sl_from_region_options *how, regions_rows *rows) {
    sl_from_region_scene *regions;
    SL_TRY(SL_ARRAY_ROOM(context, rows, 1));
    SL_TRY(sl_from_region_scene_create(context, map, what, &regions));
    regions_row row = {.counts = sl_from_region_scene_count(regions)};
    snprintf(row.map, sizeof row.map, "%s", name);
    name_view_cells(what, row.view_cells, sizeof row.view_cells);
    sl_from_region_result results[REGIONS_METHODS_MOST] = {{0}};
    const sl_status status = run_methods(context, regions, how, &row, results);
    for (size_t i = 0; i < REGIONS_METHODS_MOST; i++)
        sl_from_region_result_destroy(context, &results[i]);
    sl_from_region_scene_destroy(context, regions);
    if (status == SL_OK) rows->items[rows->count++] = row;
    return status;
}

// --- the command

enum { GRIDS_MOST = 8 };

typedef struct regions_plan {
    map_pipeline pipeline; ///< its input, and what to leave out
    sl_from_region_scene_options what;
    sl_from_region_options how;
    option_list also;
    const char *output, *grid;
    size_t view_cells, objects, solver, stab;
    const char *grid_given, *groups_given;
    const char *for_sampling, *for_stabs; ///< options that only one kind of solver has
    uint32_t grids[GRIDS_MOST];
    size_t grid_count;
    bool dark;
} regions_plan;

static const char *const file_names[] = {"regions.csv", "refine.png", "refine.svg",
                                         "work.png",    "work.svg",   NULL};

// --- the options

static const char *const view_cell_kinds[] = {"grid", "leaves", "boxes"};
static const char *const object_kinds[] = {"walls", "groups", "boxes", "cells"};

static sl_status plan_grids(sl_context *context, const char *text, regions_plan *plan) {
    for (const char *at = text; *at;) {
        char *end;
        const unsigned long grid = strtoul(at, &end, 10);
        if (end == at || *at == '-' || (*end && *end != ',') || (*end && !end[1]) || grid < 1 ||
            grid > SL_VIEW_GRID_MOST)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "--grid %s: numbers from 1 to %d are needed, with commas between", text,
                           SL_VIEW_GRID_MOST);
        if (plan->grid_count == GRIDS_MOST)
            return sl_fail(context, SL_BAD_ARGUMENT, "--grid %s: at most %d grids", text,
                           GRIDS_MOST);
        plan->grids[plan->grid_count++] = (uint32_t)grid;
        at = *end ? end + 1 : end;
    }
    if (!plan->grid_count) return sl_fail(context, SL_BAD_ARGUMENT, "--grid: no number is given");
    return SL_OK;
}

static sl_status make_plan(sl_context *context, const char *input, regions_plan *plan) {
    size_t count;
    const sl_from_region_solver *solver = &sl_from_region_solvers(&count)[plan->solver];
    const char *useless = solver->stabs ? plan->for_sampling : plan->for_stabs;
    SL_TRY(pipeline_plan(context, input, &plan->pipeline));
    plan->what.view_cells = (sl_view_cell_kind)plan->view_cells;
    plan->what.objects = (sl_object_kind)plan->objects;
    plan->how.solver = solver;
    plan->how.stab = built_solver(plan->stab);
    if (plan->grid_given && plan->what.view_cells != SL_VIEW_CELLS_GRID)
        return sl_fail(context, SL_BAD_ARGUMENT, "--grid is for --view-cells grid, not %s",
                       view_cell_kinds[plan->view_cells]);
    if (plan->groups_given && plan->what.objects != SL_OBJECTS_GROUPS)
        return sl_fail(context, SL_BAD_ARGUMENT, "--groups is for --objects groups, not %s",
                       object_kinds[plan->objects]);
    if (useless)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s is for --solver %s, not %s", useless,
                       solver->stabs ? "sampling" : "stabs", solver->name);
    if (plan->what.view_cells == SL_VIEW_CELLS_GRID) return plan_grids(context, plan->grid, plan);
    plan->grids[plan->grid_count++] = plan->what.grid; // of no use, but one round
    return SL_OK;
}

// --- the work

/// The space of the measurements is cut further, but has the same inside.
static sl_status note_inside(sl_context *context, const map_pipeline *pipeline, const sl_map *map) {
    sl_space space;
    SL_TRY(pipeline_subdivide(context, pipeline, map, &space));
    const sl_status status = pipeline_note_inside(context, pipeline, map, &space);
    sl_space_destroy(context, &space);
    return status;
}

/// A map that was read, and its name without folders.
typedef struct measured_map {
    sl_map map;
    char name[48];
} measured_map;

static sl_status read_map(sl_context *context, const regions_plan *plan, const char *path,
                          measured_map *read) {
    map_pipeline pipeline = plan->pipeline;
    pipeline.path = path;
    size_t length;
    const char *base = input_base_name(path, &length);
    snprintf(read->name, sizeof read->name, "%.*s", (int)length, base);
    SL_TRY(pipeline_read_clean(context, &pipeline, &read->map, NULL));
    SL_TRY(sl_effects_check(context, &read->map, "regions", 0,
                            "the methods that it compares know walls alone"));
    return note_inside(context, &pipeline, &read->map);
}

/// All maps with a grid, then all with the next one.
static sl_status measure_all(sl_context *context, const regions_plan *plan, regions_rows *rows) {
    const size_t count = plan->also.count + 1;
    measured_map *maps = sl_alloc_array(context, count, sizeof *maps);
    if (!maps) return SL_NO_MEMORY;
    memset(maps, 0, count * sizeof *maps);
    sl_status status = read_map(context, plan, plan->pipeline.path, &maps[0]);
    for (size_t k = 1; k < count && status == SL_OK; k++)
        status = read_map(context, plan, plan->also.items[k - 1], &maps[k]);
    sl_from_region_scene_options what = plan->what;
    for (size_t i = 0; i < plan->grid_count && status == SL_OK; i++) {
        what.grid = plan->grids[i];
        for (size_t k = 0; k < count && status == SL_OK; k++)
            status = regions_measure(context, &maps[k].map, maps[k].name, &what, &plan->how, rows);
    }
    for (size_t k = 0; k < count; k++) sl_map_destroy(context, &maps[k].map);
    sl_free(context, maps);
    return status;
}

static sl_status write_file(sl_context *context, const regions_plan *plan, const regions_rows *rows,
                            const output_folder *folder, const char *name) {
    char *path = folder_file(context, folder, name);
    if (!path) return SL_NO_MEMORY;
    const sl_status status = strstr(name, ".csv") ? regions_write_csv(context, rows, path)
                             : strstr(name, "refine")
                                 ? regions_draw_refine(context, rows, plan->dark, path)
                                 : regions_draw_work(context, rows, plan->dark, path);
    sl_free(context, path);
    return status;
}

static sl_status run(sl_context *context, const regions_plan *plan) {
    regions_rows rows = {0};
    output_folder folder;
    const char *output = plan->output;
    if (output) SL_TRY(folder_open(context, output, file_names, &folder));
    sl_status status = measure_all(context, plan, &rows);
    for (size_t i = 0; file_names[i] && output && status == SL_OK; i++)
        status = write_file(context, plan, &rows, &folder, file_names[i]);
    if (output) status = folder_close(context, &folder, status);
    if (status == SL_OK) regions_print(&rows);
    sl_free(context, rows.items);
    return status;
}

static void print_tables(void) {
    size_t count;
    puts("\nmethods, all of which run:");
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    for (size_t i = 0; i < count; i++) help_name(methods[i].name, 12, methods[i].what, NULL);
    puts("\nsolvers (the first is the default):");
    const sl_from_region_solver *solvers = sl_from_region_solvers(&count);
    for (size_t i = 0; i < count; i++)
        help_name(solvers[i].name, 12, solvers[i].what, sl_guarantee_name(solvers[i].guarantee));
    pipeline_print_effects();
    input_print_formats();
}

sl_status cmd_regions(command_console *console, int argc, char **argv) {
    regions_plan plan = {.pipeline = pipeline_default(),
                         .what = sl_from_region_scene_options_default(),
                         .how = sl_from_region_options_default(),
                         .grid = "2,4,8"};
    plan.pipeline.settles_doors = true;
    plan.view_cells = plan.what.view_cells;
    plan.objects = plan.what.objects;
    plan.how.sight = SL_CLOSED;
    plan.how.threads = 0;
    const name_table cell_kinds = {"kind of view cells", view_cell_kinds, sizeof *view_cell_kinds,
                                   3, NULL};
    const name_table kinds = {"kind of objects", object_kinds, sizeof *object_kinds, 4, NULL};
    name_table solvers = {.kind = "solver", .stride = sizeof(sl_from_region_solver)};
    solvers.items = sl_from_region_solvers(&solvers.count);
    const option_table input_table = input_option_table(&plan.pipeline.input);
    const option_table without = pipeline_without_table(&plan.pipeline);
    const char **sampling = &plan.for_sampling, **stabs = &plan.for_stabs;
    const option_spec options[] = {
        {"output", 'o', "DIR", "write regions.csv and charts (.png, .svg) to this folder",
         .text = &plan.output},
        {"also", 0, "MAP", "another map; may be given several times", .list = &plan.also},
        {"grid", 0, "N,...", "use N x N view cells, for each N (default 2,4,8)", .text = &plan.grid,
         .given = &plan.grid_given},
        {"view-cells", 0, "KIND",
         "what view cells are: grid (default), leaves of the kd-tree, or the map's 'object' boxes",
         .choice = &plan.view_cells, .names = cell_kinds},
        {"objects", 0, "KIND",
         "what is seen: groups of walls (default), walls, the map's 'object' boxes, or cells",
         .choice = &plan.objects, .names = kinds},
        {"solver", 0, "NAME", "how to decide what is seen (default: sampling)",
         .choice = &plan.solver, .names = solvers},
        {"threads", 0, "N", "number of threads (default: one per core)",
         .count32 = &plan.how.threads, .most = 1024},
        {"cut", 0, NULL, "cut view cells that depend on each other in a cycle",
         .flag = &plan.what.cut_cycles, .rare = true},
        {"groups", 0, "N", "number of groups of walls (default 1800)", .count32 = &plan.what.groups,
         .given = &plan.groups_given, .rare = true},
        {"points", 0, "N", "sampling: points along the map's longer side (default 256)",
         .count32 = &plan.how.points, .most = 1u << 20, .given = sampling, .rare = true},
        {"pixels", 0, "N", "sampling: lines from a point in half a quadrant (default 32)",
         .count32 = &plan.how.pixels, .most = 1u << 16, .given = sampling, .rare = true},
        {"seed", 0, "N", "sampling: seed of the lines (default 1)", .count = &plan.how.seed,
         .given = sampling, .rare = true},
        {"stab", 0, "NAME", "stabs: the stabbing solver (default: funnel)", .choice = &plan.stab,
         .names = solver_table(), .given = stabs, .rare = true},
        {"sight", 0, "closed|open",
         "stabs: whether lines that only touch wall ends count (default: closed, they do)",
         .sight = &plan.how.sight, .given = stabs, .rare = true},
        {"dark", 0, NULL, "draw charts light on dark", .flag = &plan.dark, .without = "output",
         .rare = true},
        {.group = &input_table},
        {.group = &without},
    };
    const command_usage usage = {
        .name = "regions",
        .synopsis = "MAP [--also MAP ...] [-o DIR] [options]",
        .operands = {"MAP"},
        .what =
            "Computes which objects are seen from which view cells, by every method with the same "
            "solver: sizes of refine sets, and times (Laine 2005). Walls must be axial. The "
            "command fails if the methods differ.",
        .tables = print_tables,
        .examples = "  sightline regions office.map --objects walls --grid 4\n"
                    "  sightline regions t10.map --also t100.map -o out --threads 1\n"
                    "  sightline regions a.map --view-cells leaves --objects cells --solver stabs",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
    };
    const char *input;
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, input, &plan));
    if (plan.output) SL_TRY(built_need_pictures(console->context));
    return run(console->context, &plan);
}
