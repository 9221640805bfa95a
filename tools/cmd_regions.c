#include "commands.h"
#include "inputs.h"
#include "outputs.h"
#include "pipeline.h"
#include "regions_report.h"
#include "report.h"
#include "sightline/support.h"
#include "solvers.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

// --- measuring

/// Of all threads: other programs on the machine make no difference to it.
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

static sl_status run_methods(sl_context *context, const sl_regions *regions,
                             const sl_from_region_options *how, sl_regions_row *row,
                             sl_from_region_result results[SL_REGIONS_METHODS_MOST]) {
    size_t count;
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    for (size_t i = 0; i < count && i < SL_REGIONS_METHODS_MOST; i++) {
        const double start = processor_seconds();
        SL_TRY(methods[i].see(context, regions, how, &results[i]));
        const sl_from_region_result *r = &results[i];
        const double asked = (double)r->images * row->counts.objects;
        row->costs[row->cost_count++] =
            (sl_regions_cost){.method = methods[i].name,
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

static void name_view_cells(const sl_regions_options *what, char *text, size_t size) {
    if (what->view_cells == SL_VIEW_CELLS_GRID)
        snprintf(text, size, "%u x %u", what->grid, what->grid);
    else
        snprintf(text, size, "%s", what->view_cells == SL_VIEW_CELLS_BOXES ? "boxes" : "leaves");
}

sl_status sl_regions_measure(sl_context *context, const sl_map *map, const char *name,
                             const sl_regions_options *what, const sl_from_region_options *how,
                             sl_regions_rows *rows) {
    sl_regions *regions;
    SL_TRY(SL_ARRAY_ROOM(context, rows, 1));
    SL_TRY(sl_regions_create(context, map, what, &regions));
    sl_regions_row row = {.counts = sl_regions_count(regions)};
    snprintf(row.map, sizeof row.map, "%s", name);
    name_view_cells(what, row.view_cells, sizeof row.view_cells);
    sl_from_region_result results[SL_REGIONS_METHODS_MOST] = {{0}};
    const sl_status status = run_methods(context, regions, how, &row, results);
    for (size_t i = 0; i < SL_REGIONS_METHODS_MOST; i++)
        sl_from_region_result_destroy(context, &results[i]);
    sl_regions_destroy(context, regions);
    if (status == SL_OK) rows->items[rows->count++] = row;
    return status;
}

// --- the command

enum { GRIDS_MOST = 8 };

/// The options as they are given.
typedef struct regions_texts {
    sl_pipeline_texts pipeline; ///< its input, and what to leave out
    sl_option_list also;
    const char *also_text, *output, *grid, *view_cells, *objects, *groups, *solver, *stab, *sight;
    const char *points, *pixels, *seed, *threads;
    bool cut, dark;
} regions_texts;

/// The options as they are meant.
typedef struct regions_plan {
    const regions_texts *texts;
    sl_pipeline pipeline;
    sl_regions_options what;
    sl_from_region_options how;
    uint32_t grids[GRIDS_MOST];
    size_t grid_count;
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

static sl_status plan_what(sl_context *context, const regions_texts *t, regions_plan *plan) {
    const sl_name_table cells = {"kind of view cells", view_cell_kinds, sizeof *view_cell_kinds, 3};
    const sl_name_table objects = {"kind of objects", object_kinds, sizeof *object_kinds, 4};
    plan->what = sl_regions_options_default();
    size_t view_cell = plan->what.view_cells, object = plan->what.objects;
    uint64_t groups = plan->what.groups;
    SL_TRY(sl_option_choice(context, "--view-cells", t->view_cells, &cells, &view_cell));
    SL_TRY(sl_option_choice(context, "--objects", t->objects, &objects, &object));
    SL_TRY(sl_option_count(context, "--groups", t->groups, UINT32_MAX, &groups));
    plan->what.view_cells = (sl_view_cell_kind)view_cell;
    plan->what.objects = (sl_object_kind)object;
    plan->what.groups = (uint32_t)groups;
    plan->what.cut_cycles = t->cut;
    if (t->grid && plan->what.view_cells != SL_VIEW_CELLS_GRID)
        return sl_fail(context, SL_BAD_ARGUMENT, "--grid is for --view-cells grid, not %s",
                       t->view_cells);
    if (t->groups && plan->what.objects != SL_OBJECTS_GROUPS)
        return sl_fail(context, SL_BAD_ARGUMENT, "--groups is for --objects groups, not %s",
                       t->objects);
    if (plan->what.view_cells == SL_VIEW_CELLS_GRID)
        return plan_grids(context, t->grid ? t->grid : "2,4,8", plan);
    plan->grids[plan->grid_count++] = plan->what.grid; // of no use, but one round
    return SL_OK;
}

static sl_status plan_how(sl_context *context, const regions_texts *t, regions_plan *plan) {
    plan->how = sl_from_region_options_default();
    sl_name_table solvers = {.kind = "solver", .stride = sizeof(sl_from_region_solver)};
    solvers.items = sl_from_region_solvers(&solvers.count);
    sl_solver stabs[SL_SOLVERS_MOST];
    const sl_name_table stab_names = sl_pipeline_solver_names(stabs);
    const sl_name_table sights = sl_sight_table();
    size_t solver = 0, stab = 0, sight = SL_CLOSED;
    uint64_t points = plan->how.points, pixels = plan->how.pixels, threads = 0;
    SL_TRY(sl_option_choice(context, "--solver", t->solver, &solvers, &solver));
    SL_TRY(sl_option_choice(context, "--stab", t->stab, &stab_names, &stab));
    SL_TRY(sl_option_choice(context, "--sight", t->sight, &sights, &sight));
    SL_TRY(sl_option_count(context, "--points", t->points, 1u << 20, &points));
    SL_TRY(sl_option_count(context, "--pixels", t->pixels, 1u << 16, &pixels));
    SL_TRY(sl_option_count(context, "--seed", t->seed, UINT64_MAX, &plan->how.seed));
    SL_TRY(sl_option_count(context, "--threads", t->threads, 1024, &threads));
    plan->how.solver = (const sl_from_region_solver *)solvers.items + solver;
    plan->how.stab = sl_solver_at(stab);
    plan->how.sight = (sl_sight)sight;
    plan->how.points = (uint32_t)points;
    plan->how.pixels = (uint32_t)pixels;
    plan->how.threads = (unsigned)threads;
    const char *name = plan->how.solver->name;
    if (plan->how.solver->stabs && (t->points || t->pixels || t->seed))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s is for --solver sampling, not %s",
                       t->points   ? "--points"
                       : t->pixels ? "--pixels"
                                   : "--seed",
                       name);
    if (!plan->how.solver->stabs && (t->stab || t->sight))
        return sl_fail(context, SL_BAD_ARGUMENT, "%s is for --solver stabs, not %s",
                       t->stab ? "--stab" : "--sight", name);
    return SL_OK;
}

static sl_status make_plan(sl_context *context, const char *input, const regions_texts *t,
                           regions_plan *plan) {
    *plan = (regions_plan){.texts = t};
    SL_TRY(sl_pipeline_plan(context, input, &t->pipeline, &plan->pipeline));
    SL_TRY(plan_what(context, t, plan));
    return plan_how(context, t, plan);
}

// --- the work

static sl_status measure_map(sl_context *context, const regions_plan *plan, const char *path,
                             uint32_t grid, sl_regions_rows *rows) {
    sl_map map = {0};
    sl_pipeline pipeline = plan->pipeline;
    pipeline.input = path;
    sl_regions_options what = plan->what;
    what.grid = grid;
    char name[48];
    size_t length;
    const char *base = sl_input_base_name(path, &length);
    snprintf(name, sizeof name, "%.*s", (int)length, base);
    sl_status status = sl_pipeline_read_clean(context, &pipeline, &map, NULL);
    if (status == SL_OK) status = sl_effects_check(context, &map, "regions", 0);
    if (status == SL_OK) status = sl_regions_measure(context, &map, name, &what, &plan->how, rows);
    sl_map_destroy(context, &map);
    return status;
}

static sl_status measure_all(sl_context *context, const regions_plan *plan, sl_regions_rows *rows) {
    for (size_t i = 0; i < plan->grid_count; i++) {
        SL_TRY(measure_map(context, plan, plan->pipeline.input, plan->grids[i], rows));
        for (size_t k = 0; k < plan->texts->also.count; k++)
            SL_TRY(measure_map(context, plan, plan->texts->also.items[k], plan->grids[i], rows));
    }
    return SL_OK;
}

static sl_status write_file(sl_context *context, const regions_plan *plan,
                            const sl_regions_rows *rows, const sl_folder *folder,
                            const char *name) {
    char *path = sl_folder_file(context, folder, name);
    if (!path) return SL_NO_MEMORY;
    const sl_status status = strstr(name, ".csv") ? sl_regions_write_csv(context, rows, path)
                             : strstr(name, "refine")
                                 ? sl_regions_draw_refine(context, rows, plan->texts->dark, path)
                                 : sl_regions_draw_work(context, rows, plan->texts->dark, path);
    sl_free(context, path);
    return status;
}

static sl_status run(sl_context *context, const regions_plan *plan) {
    sl_regions_rows rows = {0};
    sl_folder folder;
    const char *output = plan->texts->output;
    if (output) SL_TRY(sl_folder_open(context, output, file_names, &folder));
    sl_status status = measure_all(context, plan, &rows);
    for (size_t i = 0; file_names[i] && output && status == SL_OK; i++)
        status = write_file(context, plan, &rows, &folder, file_names[i]);
    if (output) status = sl_folder_close(context, &folder, status);
    if (status == SL_OK) sl_regions_print(&rows);
    sl_free(context, rows.items);
    return status;
}

static void print_tables(void) {
    size_t count;
    puts("\nmethods, all of which run:");
    const sl_from_region_method *methods = sl_from_region_methods(&count);
    for (size_t i = 0; i < count; i++) printf("  %-12s%s\n", methods[i].name, methods[i].what);
    puts("\nsolvers (the first is the default):");
    const sl_from_region_solver *solvers = sl_from_region_solvers(&count);
    for (size_t i = 0; i < count; i++)
        printf("  %-12s%s; %s\n", solvers[i].name, solvers[i].what,
               sl_guarantee_name(solvers[i].guarantee));
    sl_pipeline_print_effects();
    sl_input_print_formats();
}

sl_status sl_cmd_regions(sl_console *console, int argc, char **argv) {
    regions_texts t = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "DIR", NULL, &t.output,
         "a folder for regions.csv and the charts refine and work\n(.png, .svg); made if missing"},
        {"also", 0, "MAP", NULL, &t.also_text, "a map beside; may be given several times"},
        {"grid", 0, "N,...", NULL, &t.grid, "N x N view cells, for each number; 2,4,8 without it"},
        {"view-cells", 0, "KIND", NULL, &t.view_cells,
         "grid (the default), leaves of the kd-tree, or the map's\n'object' boxes, those of one "
         "name together"},
        {"cut", 0, NULL, &t.cut, NULL, "cut view cells that depend on each other round a cycle"},
        {"objects", 0, "KIND", NULL, &t.objects,
         "groups of walls (the default), walls, the map's 'object'\nboxes, or cells of the "
         "kd-tree"},
        {"groups", 0, "N", NULL, &t.groups, "how many; 1800 without it"},
        {"solver", 0, "NAME", NULL, &t.solver, "what decides on what is seen"},
        {"points", 0, "N", NULL, &t.points, "sampling: points along the map's longer side; 256"},
        {"pixels", 0, "N", NULL, &t.pixels, "sampling: lines from a point in half a quadrant; 32"},
        {"seed", 0, "S", NULL, &t.seed, "sampling: what lines are drawn from; 1"},
        {"stab", 0, "NAME", NULL, &t.stab, "stabs: the stabbing solver; funnel"},
        {"sight", 0, "closed|open", NULL, &t.sight, "stabs: whether grazing lines count; closed"},
        {"threads", 0, "N", NULL, &t.threads, "0, the default, for one a core"},
        {"dark", 0, NULL, &t.dark, NULL, "charts light on dark"},
        SL_INPUT_OPTIONS(t.pipeline.input),
        {"without", 0, "EFFECT,...", NULL, &t.pipeline.without, "leave out what the map calls for"},
    };
    const sl_command_usage usage = {
        .name = "regions",
        .synopsis = "MAP [--also MAP ...] [-o DIR] [options]",
        .operands = {"MAP"},
        .what = "Which objects are seen from which view cells, by every method with the same\n"
                "solver under it: what the refine sets come to, and the time (Laine 2005). Walls\n"
                "must be axial. Methods must find the same: where they do not, the command fails.",
        .tables = print_tables,
        .examples = "  sightline regions office.map --objects walls --grid 4\n"
                    "  sightline regions t10.map --also t100.map -o out --threads 1\n"
                    "  sightline regions office.map --view-cells leaves --objects cells --solver "
                    "stabs",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .repeats = "also",
        .repeated = &t.also,
    };
    const char *input;
    bool helped;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    regions_plan plan;
    SL_TRY(make_plan(console->context, input, &t, &plan));
    return run(console->context, &plan);
}
