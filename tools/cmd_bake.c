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

typedef struct bake_plan {
    const char *input, *output;
    map_pipeline pipeline;
    size_t method_number, solver_number;
    const char *method_given, *solver_given;
    const char *memory_given, *tree_memory_given, *samples_given, *seed_given, *passes_given;
    const sl_see_method *method;
    sl_see_options see;
    bake_parts parts;
    uint32_t mirror_depth, door_sets;
    bool json;
    bool any_method;   // none was asked for, nor what only one gives
    bool named_by_map; // no -o was given
} bake_plan;

// --- reading the options

/// The solver by name, or the first.
static sl_status plan_solver(sl_context *context, bake_plan *plan) {
    if (plan->solver_given && !plan->method->stabs)
        return sl_fail(context, SL_BAD_ARGUMENT, "--solver: the method '%s' uses none",
                       plan->method->name);
    if (plan->method->stabs) plan->see.solver = solver_at(plan->solver_number);
    return SL_OK;
}

/// What else than walls a map calls for only some methods know: where the default does not, prune.
static sl_status fit_method(sl_context *context, const sl_map *map, bake_plan *plan) {
    const unsigned effects = sl_plan_make(map).effects;
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count && plan->any_method && effects & ~plan->method->knows; i++)
        if (strcmp(methods[i].name, "prune") == 0) plan->method = &methods[i];
    return plan->see.solver ? SL_OK : plan_solver(context, plan);
}

/// The fastest exact method; what only a search can give asks for the first, which is one.
static void choose_method(bake_plan *plan) {
    plan->any_method = !plan->method_given && !plan->solver_given && !plan->see.trees;
    if (plan->any_method) plan->method_number = method_number("sweep");
    plan->method = &sl_see_methods(&(size_t){0})[plan->method_number];
}

/// Options of a method that the chosen one has no use for.
static sl_status check_method(sl_context *context, const bake_plan *plan) {
    const char *method = plan->method->name;
    const char *random = plan->samples_given ? plan->samples_given : plan->seed_given;
    if (random && plan->method->guarantee != SL_AGGRESSIVE)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s: the method '%s' draws nothing at random",
                       random, method);
    if (plan->passes_given && strcmp(method, "multipass") != 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--passes: the method '%s' makes none", method);
    if (plan->passes_given && plan->see.sectors && plan->see.sectors < 4)
        return sl_fail(context, SL_BAD_ARGUMENT, "--passes: at least 4, or 0 for all");
    if (plan->tree_memory_given && !plan->see.trees)
        return sl_fail(context, SL_BAD_ARGUMENT, "--tree-memory needs --stab-trees");
    if (plan->memory_given && !plan->method->keeps_rows)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--memory: the method '%s' keeps no more than it writes", method);
    return SL_OK;
}

static sl_status make_plan(sl_context *context, bake_plan *plan) {
    SL_TRY(pipeline_plan(context, plan->input, &plan->pipeline));
    choose_method(plan);
    SL_TRY(check_method(context, plan));
    SL_TRY(plan_solver(context, plan));
    return bake_parts_plan(context, plan->method, &plan->see, &plan->parts);
}

/// "maps/office.map" gives "office.slv"; the name belongs to the caller.
static sl_status name_output(sl_context *context, const char *input, char **name) {
    size_t length;
    if (strcmp(input, "-") == 0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "-o is missing: name the file, for standard input has no name to take");
    const char *base = input_base_name(input, &length);
    *name = sl_alloc(context, length + sizeof ".slv");
    if (!*name) return SL_NO_MEMORY;
    memcpy(*name, base, length);
    memcpy(*name + length, ".slv", sizeof ".slv");
    return SL_OK;
}

// --- the work

/// Seconds since *last, which is set to now.
static double lap(double *last) {
    const double before = *last;
    *last = seconds_now();
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
                                bake_report *report) {
    SL_TRY(pipeline_read_clean(context, &plan->pipeline, map, &report->cleaning));
    SL_TRY(fit_method(context, map, plan));
    return sl_see_check(context, plan->method, plan->see.solver, map);
}

static sl_status subdivide(sl_context *context, const bake_plan *plan, const sl_map *map,
                           bake_report *report, sl_space *space, double *time) {
    SL_TRY(pipeline_subdivide(context, &plan->pipeline, map, space));
    report->subdivide = pipeline_subdivision(&plan->pipeline, map)->name;
    report->seconds.subdivide = lap(time);
    SL_TRY(pipeline_check(context, &plan->pipeline, space));
    report->seconds.check = lap(time);
    report->checked = pipeline_checks(&plan->pipeline, space);
    return SL_OK;
}

static sl_status see(sl_context *context, const bake_plan *plan, sl_baked *baked,
                     bake_report *report) {
    sl_plan effects = sl_plan_make(&baked->map);
    effects.mirror_depth = plan->mirror_depth;
    effects.door_limit = plan->door_sets;
    sl_see_options options = plan->see;
    options.plan = &effects;
    return bake_parts_see(context, &plan->parts, plan->method, &options, baked, &report->parts);
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
                      bake_report *report) {
    double time = seconds_now();
    SL_TRY(read_and_clean(context, plan, map, report));
    report->seconds.read = lap(&time);
    SL_TRY(subdivide(context, plan, map, report, &baked->space, &time));
    keep_rest_of_map(context, map, baked);
    snprintf(baked->method, sizeof baked->method, "%s", plan->method->name);
    if (plan->see.solver)
        snprintf(baked->solver, sizeof baked->solver, "%s", plan->see.solver->name);
    SL_TRY(see(context, plan, baked, report));
    report->seconds.cell_to_cell = lap(&time);
    if (crew_rank() != 0) return SL_OK;
    if (plan->named_by_map) sl_note(context, "writing %s, as no -o is given", plan->output);
    SL_TRY(sl_baked_write(context, baked, plan->output));
    report->seconds.write = lap(&time);
    return check_file(context, plan);
}

static sl_status bake_and_report(command_console *console, bake_plan *plan) {
    sl_context *context = console->context;
    sl_map map = {0};
    sl_baked baked = {0};
    bake_report report = {.input = plan->input, .output = plan->output, .baked = &baked};
    sl_status status = bake(context, plan, &map, &baked, &report);
    progress_line_clear(&console->line);
    if (status == SL_OK && crew_rank() != 0)
        status = SL_OK; // the first process reports
    else if (status == SL_OK && plan->json)
        status = bake_report_print_json(context, &report);
    else if (status == SL_OK && !console->quiet)
        status = bake_report_print(context, &report);
    sl_baked_destroy(context, &baked);
    sl_map_destroy(context, &map);
    return status;
}

// --- help

static void print_tables(void) {
    pipeline_print_subdivisions();
    pipeline_print_methods("; sweep is the default, but dfs where stab trees or a solver are "
                           "asked for,\nand prune where the map has mirrors",
                           " (the first is the default)");
    pipeline_print_effects();
    input_print_formats();
}

sl_status cmd_bake(command_console *console, int argc, char **argv) {
    bake_plan plan = {.pipeline = pipeline_default(),
                      .see = sl_see_options_default(),
                      .mirror_depth = 1,
                      .door_sets = 16};
    plan.see.row_bytes = sl_machine_memory() / 2;
    plan.see.tree_bytes = (uint64_t)256 << 20;
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table parts = bake_parts_option_table(&plan.parts);
    const option_spec options[] = {
        {"output", 'o', "FILE.slv",
         "where to write; without it in the current folder,\nby the map's name",
         .text = &plan.output, .check = CHECK_BAKED},
        {.group = &pipeline},
        {"method", 0, "NAME", "how to find what a cell sees", .choice = &plan.method_number,
         .names = method_table(), .given = &plan.method_given},
        {"solver", 0, "NAME", "what stabs portal sequences", .choice = &plan.solver_number,
         .names = solver_table(), .given = &plan.solver_given},
        {"sight", 0, "closed|open",
         "closed (the default): lines that only touch\nwall ends count; open: they do not",
         .sight = &plan.see.sight},
        {"threads", 0, "N",
         "0, the default, for one a core;\nthe result is the same for any number",
         .count32 = &plan.see.threads, .most = MAX_THREADS},
        {"samples", 0, "N", "lines from each cell, for sampling", .count32 = &plan.see.samples,
         .given = &plan.samples_given},
        {"seed", 0, "N", "of random numbers, for sampling", .count = &plan.see.seed,
         .given = &plan.seed_given},
        {"memory", 0, "SIZE",
         "for the visible sets in the making at most, as 64M,\n2G; half of the machine's unless "
         "told",
         .bytes = &plan.see.row_bytes, .given = &plan.memory_given},
        {"passes", 0, "N",
         "sectors that multipass cuts directions into, at most;\n8 unless told; 0: at all portals' "
         "own",
         .count32 = &plan.see.sectors, .given = &plan.passes_given},
        {"stab-trees", 0, NULL, "keep the trees of portal sequences", .flag = &plan.see.trees},
        {"tree-memory", 0, "SIZE", "for them at most, as 64K, 256M (the default), 2G",
         .bytes = &plan.see.tree_bytes, .given = &plan.tree_memory_given},
        {"inside", 0, NULL,
         "look from and at inside cells only: those that a\nstart leads to or that walls enclose",
         .flag = &plan.see.inside_only},
        {"mirror-depth", 0, "N",
         "reflections of a sightline, at most (1 without it, up\nto 16; 0: mirrors are walls)",
         .count32 = &plan.mirror_depth, .most = 16},
        {"door-sets", 0, "N",
         "sets of doors kept of a pair, at most (16 without\nit); a pair with more counts as seen",
         .count32 = &plan.door_sets, .most = 65535},
        {"json", 0, NULL, "print the statistics as one JSON object", .flag = &plan.json},
        {.group = &parts},
    };
    const command_usage usage = {
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
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.input, &helped));
    if (helped) return SL_OK;
    SL_TRY(make_plan(console->context, &plan));
    char *own_name = NULL;
    if (!plan.output) {
        SL_TRY(name_output(console->context, plan.input, &own_name));
        plan.output = own_name;
        plan.named_by_map = true;
    }
    const sl_status status = bake_and_report(console, &plan);
    sl_free(console->context, own_name);
    return status;
}
