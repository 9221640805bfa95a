#include "bake_parts.h"
#include "bake_report.h"
#include "commands.h"
#include "crew.h"
#include "inputs.h"
#include "outputs.h"
#include "pipeline.h"
#include "sightline/support.h"
#include "solvers.h"

#include <string.h>

enum { MAX_THREADS = 4096 };

/// The options as they are given.
typedef struct bake_texts {
    sl_pipeline_texts pipeline;
    const char *output, *method, *solver, *sight, *threads, *memory, *tree_memory, *samples, *seed;
    const char *passes, *mirror_depth, *door_sets;
    bool stab_trees, inside, json;
    sl_bake_part_texts parts;
} bake_texts;

/// The options as they are meant.
typedef struct bake_plan {
    sl_pipeline pipeline;
    const char *output;
    const sl_see_method *method;
    sl_see_options see;
    sl_bake_parts parts;
    uint64_t mirror_depth, door_sets;
    bool json;
    bool any_method;   // none was asked for, nor what only one gives
    bool named_by_map; // no -o was given
} bake_plan;

// --- reading the options

/// The solver by name, or the first.
static sl_status plan_solver(sl_context *context, const char *text, bake_plan *plan) {
    if (text && !plan->method->stabs)
        return sl_fail(context, SL_BAD_ARGUMENT, "--solver: the method '%s' uses none",
                       plan->method->name);
    if (!plan->method->stabs) return SL_OK;
    sl_solver solvers[SL_SOLVERS_MOST];
    const sl_name_table names = sl_pipeline_solver_names(solvers);
    size_t chosen = 0;
    SL_TRY(sl_option_choice(context, "--solver", text, &names, &chosen));
    plan->see.solver = sl_solver_at(chosen);
    return SL_OK;
}

/// The fastest exact method; what only a search can give asks for the first, which is one.
static size_t default_method(const bake_texts *texts, const sl_see_method *methods, size_t count) {
    for (size_t i = 0; i < count && !texts->stab_trees && !texts->solver; i++)
        if (strcmp(methods[i].name, "sweep") == 0) return i;
    return 0;
}

/// What else than walls a map calls for only some methods know: where the default does not, prune.
static sl_status fit_method(sl_context *context, const sl_map *map, bake_plan *plan) {
    const unsigned effects = sl_plan_make(map).effects;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count && plan->any_method && effects & ~plan->method->knows; i++)
        if (strcmp(methods[i].name, "prune") == 0) plan->method = &methods[i];
    return plan->see.solver ? SL_OK : plan_solver(context, NULL, plan);
}

static sl_status plan_effects(sl_context *context, const bake_texts *texts, bake_plan *plan) {
    plan->mirror_depth = 1;
    plan->door_sets = 16;
    SL_TRY(
        sl_option_count(context, "--mirror-depth", texts->mirror_depth, 16, &plan->mirror_depth));
    return sl_option_count(context, "--door-sets", texts->door_sets, 65535, &plan->door_sets);
}

static sl_status plan_seeing(sl_context *context, const bake_texts *texts, bake_plan *plan) {
    size_t sight = SL_CLOSED, count;
    uint64_t threads = 0, tree_bytes = (uint64_t)256 << 20;
    const sl_see_method *methods = sl_see_methods(&count);
    size_t method = default_method(texts, methods, count);
    const sl_name_table method_names = {"method", methods, sizeof *methods, count};
    const sl_name_table sight_names = sl_sight_table();
    SL_TRY(sl_option_choice(context, "--method", texts->method, &method_names, &method));
    SL_TRY(sl_option_choice(context, "--sight", texts->sight, &sight_names, &sight));
    SL_TRY(sl_option_count(context, "--threads", texts->threads, MAX_THREADS, &threads));
    SL_TRY(sl_option_size(context, "--tree-memory", texts->tree_memory, &tree_bytes));
    sl_see_options see = sl_see_options_default();
    uint64_t samples = see.samples;
    SL_TRY(sl_option_count(context, "--samples", texts->samples, UINT32_MAX, &samples));
    SL_TRY(sl_option_count(context, "--seed", texts->seed, UINT64_MAX, &see.seed));
    if ((texts->samples || texts->seed) && methods[method].guarantee != SL_AGGRESSIVE)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: the method '%s' draws nothing at random",
                       texts->samples ? "--samples" : "--seed", methods[method].name);
    uint64_t sectors = see.sectors;
    SL_TRY(sl_option_count(context, "--passes", texts->passes, UINT32_MAX, &sectors));
    if (texts->passes && strcmp(methods[method].name, "multipass") != 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--passes: the method '%s' makes none",
                       methods[method].name);
    if (texts->passes && sectors && sectors < 4)
        return sl_fail(context, SL_BAD_ARGUMENT, "--passes: at least 4, or 0 for all");
    if (texts->tree_memory && !texts->stab_trees)
        return sl_fail(context, SL_BAD_ARGUMENT, "--tree-memory needs --stab-trees");
    if (texts->memory && !methods[method].keeps_rows)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--memory: the method '%s' keeps no more than it writes",
                       methods[method].name);
    see.row_bytes = sl_machine_memory() / 2;
    SL_TRY(sl_option_size(context, "--memory", texts->memory, &see.row_bytes));
    plan->method = &methods[method];
    plan->any_method = !texts->method && !texts->solver && !texts->stab_trees;
    SL_TRY(plan_effects(context, texts, plan));
    plan->see = see;
    plan->see.samples = (uint32_t)samples;
    plan->see.sectors = (uint32_t)sectors;
    plan->see.sight = (sl_sight)sight;
    plan->see.threads = (unsigned)threads;
    plan->see.trees = texts->stab_trees;
    plan->see.tree_bytes = tree_bytes;
    plan->see.inside_only = texts->inside;
    return plan_solver(context, texts->solver, plan);
}

/// "maps/office.map" gives "office.slv"; the name belongs to the caller.
static sl_status name_output(sl_context *context, const char *input, char **name) {
    size_t length;
    if (strcmp(input, "-") == 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o is missing: name the file, for standard input has no name to take");
    const char *base = sl_input_base_name(input, &length);
    *name = sl_alloc(context, length + sizeof ".slv");
    if (!*name) return SL_NO_MEMORY;
    memcpy(*name, base, length);
    memcpy(*name + length, ".slv", sizeof ".slv");
    return SL_OK;
}

static sl_status make_plan(sl_context *context, const char *input, const bake_texts *texts,
                           bake_plan *plan) {
    SL_TRY(sl_output_check_baked(context, input, "-o", texts->output));
    SL_TRY(sl_pipeline_plan(context, input, &texts->pipeline, &plan->pipeline));
    SL_TRY(plan_seeing(context, texts, plan));
    plan->output = texts->output;
    plan->json = texts->json;
    return sl_bake_parts_plan(context, &texts->parts, plan->method, &plan->see, &plan->parts);
}

// --- the work

/// Seconds since *last, which is set to now.
static double lap(double *last) {
    const double before = *last;
    *last = sl_now();
    return *last - before;
}

/// What a baked file keeps of the map: all but the walls and cells, which the space has.
static void keep_rest_of_map(sl_context *context, sl_map *map, sl_baked *baked) {
    sl_free(context, map->walls);
    map->walls = NULL;
    map->wall_count = map->wall_room = 0;
    sl_map_drop_cells(context, map);
    baked->map = *map;
    *map = (sl_map){0};
}

static sl_status read_and_clean(sl_context *context, bake_plan *plan, sl_map *map,
                                sl_bake_report *report) {
    SL_TRY(sl_pipeline_read_clean(context, &plan->pipeline, map, &report->cleaning));
    SL_TRY(fit_method(context, map, plan));
    return sl_see_check(context, plan->method, plan->see.solver, map);
}

static sl_status subdivide(sl_context *context, const bake_plan *plan, const sl_map *map,
                           sl_bake_report *report, sl_space *space, double *time) {
    SL_TRY(sl_pipeline_subdivide(context, &plan->pipeline, map, space));
    report->subdivide = sl_pipeline_subdivision(&plan->pipeline, map)->name;
    report->seconds.subdivide = lap(time);
    SL_TRY(sl_pipeline_check(context, &plan->pipeline, space));
    report->seconds.check = lap(time);
    report->checked = sl_pipeline_checks(&plan->pipeline, space);
    return SL_OK;
}

static sl_status see(sl_context *context, const bake_plan *plan, sl_baked *baked,
                     sl_bake_report *report) {
    sl_plan effects = sl_plan_make(&baked->map);
    effects.mirror_depth = (uint32_t)plan->mirror_depth;
    effects.door_limit = (uint32_t)plan->door_sets;
    sl_see_options options = plan->see;
    options.plan = &effects;
    return sl_bake_parts_see(context, &plan->parts, plan->method, &options, baked, &report->parts);
}

/// With --check, that what was written can be read.
static sl_status check_file(sl_context *context, const bake_plan *plan) {
    sl_baked again = {0};
    if (!plan->pipeline.check) return SL_OK;
    SL_TRY(sl_baked_read_part(context, plan->output, &again));
    sl_baked_destroy(context, &again);
    return SL_OK;
}

static sl_status bake(sl_context *context, bake_plan *plan, sl_map *map, sl_baked *baked,
                      sl_bake_report *report) {
    double time = sl_now();
    SL_TRY(read_and_clean(context, plan, map, report));
    report->seconds.read = lap(&time);
    SL_TRY(subdivide(context, plan, map, report, &baked->space, &time));
    keep_rest_of_map(context, map, baked);
    snprintf(baked->method, sizeof baked->method, "%s", plan->method->name);
    if (plan->see.solver)
        snprintf(baked->solver, sizeof baked->solver, "%s", plan->see.solver->name);
    SL_TRY(see(context, plan, baked, report));
    report->seconds.cell_to_cell = lap(&time);
    if (sl_crew_rank() != 0) return SL_OK;
    if (plan->named_by_map) sl_note(context, "writing %s, as no -o is given", plan->output);
    SL_TRY(sl_baked_write(context, baked, plan->output));
    report->seconds.write = lap(&time);
    return check_file(context, plan);
}

static sl_status bake_and_report(sl_console *console, bake_plan *plan) {
    sl_context *context = console->context;
    sl_map map = {0};
    sl_baked baked = {0};
    sl_bake_report report = {
        .input = plan->pipeline.input, .output = plan->output, .baked = &baked};
    sl_status status = bake(context, plan, &map, &baked, &report);
    sl_progress_line_clear(&console->line);
    if (status == SL_OK && sl_crew_rank() != 0)
        status = SL_OK; // the first process reports
    else if (status == SL_OK && plan->json)
        status = sl_bake_report_print_json(context, &report);
    else if (status == SL_OK && !console->quiet)
        status = sl_bake_report_print(context, &report);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    return status;
}

// --- help

static void print_tables(void) {
    sl_pipeline_print_subdivisions();
    sl_pipeline_print_methods("; sweep is the default, but dfs where stab trees or a solver are "
                              "asked for,\nand prune where the map has mirrors",
                              " (the first is the default)");
    sl_pipeline_print_effects();
    sl_input_print_formats();
}

sl_status sl_cmd_bake(sl_console *console, int argc, char **argv) {
    bake_texts t = {0};
    const sl_option_spec options[] = {
        {"output", 'o', "FILE.slv", NULL, &t.output,
         "where to write; without it in the current folder,\nby the map's name"},
        SL_PIPELINE_OPTIONS(t.pipeline),
        {"method", 0, "NAME", NULL, &t.method, "how to find what a cell sees"},
        {"solver", 0, "NAME", NULL, &t.solver, "what stabs portal sequences"},
        {"sight", 0, "closed|open", NULL, &t.sight,
         "closed (the default): lines that only touch\nwall ends count; open: they do not"},
        {"threads", 0, "N", NULL, &t.threads,
         "0, the default, for one a core;\nthe result is the same for any number"},
        {"samples", 0, "N", NULL, &t.samples, "lines from each cell, for sampling"},
        {"seed", 0, "N", NULL, &t.seed, "of random numbers, for sampling"},
        {"memory", 0, "SIZE", NULL, &t.memory,
         "for the visible sets in the making at most, as 64M,\n2G; half of the machine's unless "
         "told"},
        {"passes", 0, "N", NULL, &t.passes,
         "sectors that multipass cuts directions into, at most;\n8 unless told; 0: at all portals' "
         "own"},
        {"stab-trees", 0, NULL, &t.stab_trees, NULL, "keep the trees of portal sequences"},
        {"tree-memory", 0, "SIZE", NULL, &t.tree_memory,
         "for them at most, as 64K, 256M (the default), 2G"},
        {"inside", 0, NULL, &t.inside, NULL,
         "look from and at inside cells only: those that a\nstart leads to or that walls enclose"},
        {"mirror-depth", 0, "N", NULL, &t.mirror_depth,
         "reflections of a sightline, at most (1 without it, up\nto 16; 0: mirrors are walls)"},
        {"door-sets", 0, "N", NULL, &t.door_sets,
         "sets of doors kept of a pair, at most (16 without\nit); a pair with more counts as seen"},
        {"json", 0, NULL, &t.json, NULL, "print the statistics as one JSON object"},
        SL_BAKE_PART_OPTIONS(t.parts),
    };
    const sl_command_usage usage = {
        .name = "bake",
        .synopsis = "MAP [-o FILE.slv] [options]",
        .operands = {"MAP"},
        .what = "Cuts a map into convex cells joined by portals, finds which cells can see which,\n"
                "and writes both into a file. The time for reading includes cleaning the walls.",
        .tables = print_tables,
        .examples = "  sightline bake office.map -o office.slv\n"
                    "  sightline bake tower.ug --slice 1040 --start 1400,1600 --inside --json\n"
                    "  sightline bake office.map --previous office.slv -o office.slv\n"
                    "  sightline bake city.map --time-limit 60 -o city.slv\n"
                    "  sightline bake city.map --resume city.slv -o city.slv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
    };
    bake_plan plan = {0};
    bool helped;
    const char *input;
    SL_TRY(sl_option_parse(console, &usage, argc, argv, &input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, input, &t, &plan));
    char *own_name = NULL;
    if (!plan.output) {
        SL_TRY(name_output(console->context, input, &own_name));
        plan.output = own_name;
        plan.named_by_map = true;
    }
    const sl_status status = bake_and_report(console, &plan);
    sl_free(console->context, own_name);
    return status;
}
