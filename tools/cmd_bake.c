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
    size_t method, solver; ///< in their tables
    const char *method_given, *solver_given;
    const char *memory_given, *tree_memory_given, *samples_given, *seed_given, *passes_given;
    bake_parts parts;
    bool json;
    bool named_by_map; // no -o was given
} bake_plan;

// --- reading the options

/// Options of a method that the chosen one has no use for.
static sl_status check_method(sl_context *context, const bake_plan *plan,
                              const sl_see_method *chosen) {
    const sl_see_options *see = &plan->pipeline.bake.see;
    const char *method = chosen->name;
    const char *random = plan->samples_given ? plan->samples_given : plan->seed_given;
    if (random && chosen->guarantee != SL_AGGRESSIVE)
        return sl_fail(context, SL_BAD_ARGUMENT, "--%s: the method '%s' draws nothing at random",
                       random, method);
    if (plan->passes_given && strcmp(method, "multipass") != 0)
        return sl_fail(context, SL_BAD_ARGUMENT, "--passes: the method '%s' makes none", method);
    if (plan->passes_given && see->sectors && see->sectors < 4)
        return sl_fail(context, SL_BAD_ARGUMENT, "--passes: at least 4, or 0 for all");
    if (plan->tree_memory_given && !see->trees)
        return sl_fail(context, SL_BAD_ARGUMENT, "--tree-memory needs --stab-trees");
    if (plan->memory_given && !chosen->keeps_rows)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--memory: the method '%s' keeps no more than it writes", method);
    if (plan->solver_given && !chosen->stabs)
        return sl_fail(context, SL_BAD_ARGUMENT, "--solver: the method '%s' uses none", method);
    return SL_OK;
}

/// The method stays open where none is named: then the map decides. Until it is read, that of a map
/// of walls alone stands for it.
static sl_status make_plan(sl_context *context, bake_plan *plan) {
    sl_bake_options *bake = &plan->pipeline.bake;
    SL_TRY(pipeline_plan(context, plan->input, &plan->pipeline));
    if (plan->solver_given) bake->see.solver = solver_at(plan->solver);
    if (plan->method_given) bake->method = &sl_see_methods(&(size_t){0})[plan->method];
    const sl_see_method *method =
        bake->method ? bake->method : sl_see_method_for(&(sl_map){0}, &bake->see);
    SL_TRY(check_method(context, plan, method));
    return bake_parts_plan(context, method, &bake->see, &plan->parts);
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
    *last = sl_seconds();
    return *last - before;
}

/// With --check, that what was written can be read.
static sl_status check_file(sl_context *context, const bake_plan *plan) {
    sl_baked again = {0};
    if (!plan->pipeline.bake.check) return SL_OK;
    SL_TRY(sl_baked_read_part(context, plan->output, &again));
    sl_baked_destroy(context, &again);
    return SL_OK;
}

static sl_status bake(sl_context *context, bake_plan *plan, sl_map *map, sl_baked *baked,
                      bake_report *report) {
    sl_bake_options *options = &plan->pipeline.bake;
    double time = sl_seconds();
    SL_TRY(pipeline_read(context, &plan->pipeline, map));
    report->seconds.read = lap(&time);
    SL_TRY(sl_bake_space(context, map, options, baked, &report->account));
    report->seconds.read += report->account.seconds.clean;
    lap(&time);
    SL_TRY(bake_parts_see(context, &plan->parts, options, baked, &report->parts));
    report->seconds.see = lap(&time);
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
    bake_plan plan = {.pipeline = pipeline_default()};
    sl_bake_options *bake_options = &plan.pipeline.bake;
    sl_see_options *see = &bake_options->see;
    const option_table pipeline = pipeline_option_table(&plan.pipeline);
    const option_table parts = bake_parts_option_table(&plan.parts);
    const option_spec options[] = {
        {"output", 'o', "FILE.slv",
         "where to write; without it in the current folder,\nby the map's name",
         .text = &plan.output, .check = CHECK_BAKED},
        {.group = &pipeline},
        {"method", 0, "NAME", "how to find what a cell sees", .choice = &plan.method,
         .names = method_table(), .given = &plan.method_given},
        {"solver", 0, "NAME", "what stabs portal sequences", .choice = &plan.solver,
         .names = solver_table(), .given = &plan.solver_given},
        {"sight", 0, "closed|open",
         "closed (the default): lines that only touch\nwall ends count; open: they do not",
         .sight = &see->sight},
        {"threads", 0, "N",
         "0, the default, for one a core;\nthe result is the same for any number",
         .count32 = &see->threads, .most = MAX_THREADS},
        {"samples", 0, "N", "lines from each cell, for sampling", .count32 = &see->samples,
         .given = &plan.samples_given},
        {"seed", 0, "N", "of random numbers, for sampling", .count = &see->seed,
         .given = &plan.seed_given},
        {"memory", 0, "SIZE",
         "for the visible sets in the making at most, as 64M,\n2G; half of the machine's unless "
         "told",
         .bytes = &see->row_bytes, .given = &plan.memory_given},
        {"passes", 0, "N",
         "sectors that multipass cuts directions into, at most;\n8 unless told; 0: at all portals' "
         "own",
         .count32 = &see->sectors, .given = &plan.passes_given},
        {"stab-trees", 0, NULL, "keep the trees of portal sequences", .flag = &see->trees},
        {"tree-memory", 0, "SIZE", "for them at most, as 64K, 256M (the default), 2G",
         .bytes = &see->tree_bytes, .given = &plan.tree_memory_given},
        {"inside", 0, NULL,
         "look from and at inside cells only: those that a\nstart leads to or that walls enclose",
         .flag = &see->inside_only},
        {"mirror-depth", 0, "N",
         "reflections of a sightline, at most (1 without it, up\nto 16; 0: mirrors are walls)",
         .count32 = &bake_options->mirror_depth, .most = 16},
        {"door-sets", 0, "N",
         "sets of doors kept of a pair, at most (16 without\nit); a pair with more counts as seen",
         .count32 = &bake_options->door_limit, .most = 65535},
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
