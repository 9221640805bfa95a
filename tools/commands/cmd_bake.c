/// `sightline bake`: cells, portals and cell-to-cell visibility of a map, into a file.
#include "arguments/names.h"
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "inputs/pipeline.h"
#include "reports/json_print.h"
#include "reports/report.h"
#include "sightline/support.h"
#include "studies/bake_parts.h"
#include "system/built.h"
#include "system/crew.h"
#include "system/system.h"

#include <inttypes.h>
#include <string.h>

typedef struct bake_report {
    const char *input, *output;
    const sl_baked *baked;
    sl_bake_account account;
    double read_seconds, write_seconds; ///< cleaning included in the first
} bake_report;

// --- the report

// --- JSON

static void add_seconds(json_fields *fields, const bake_report *report) {
    json_open(fields, "seconds");
    json_add_real(fields, "read", report->read_seconds);
    json_add_real(fields, "subdivide", report->account.seconds.subdivide);
    if (report->account.checked) json_add_real(fields, "check", report->account.seconds.check);
    json_add_real(fields, "cell_to_cell", report->account.seconds.see);
    json_add_real(fields, "write", report->write_seconds);
    json_close(fields);
}

/// How much of the work was done, if the bake was not done in one go.
static void add_parts(json_fields *fields, const bake_report *report) {
    const sl_bake_account *account = &report->account;
    const sl_partial *partial = &report->baked->partial;
    json_add_flag(fields, "finished", !sl_partial_begun(partial));
    if (!account->work.units) return;
    json_open(fields, "work");
    json_add_text(fields, "units", account->work.units);
    json_add_count(fields, "count", account->work.count);
    json_add_count(fields, "known_before", account->work.known);
    json_add_count(fields, "done", account->work.done);
    if (partial->shard_count) {
        json_add_count(fields, "shard", partial->shard);
        json_add_count(fields, "shards", partial->shard_count);
        json_add_count(fields, "left", sl_partial_left(partial));
    }
    json_close(fields);
}

static void add_visibility(json_fields *fields, const sl_visibility *visibility) {
    const sl_see_account *account = &visibility->account;
    const sl_stab_trees *trees = &visibility->trees;
    json_add_count(fields, "pairs", account->pairs);
    json_add_count(fields, "doubtful_pairs", account->doubtful_pairs);
    json_add_count(fields, "tests", account->tests);
    json_add_count(fields, "tree_nodes", account->nodes);
    json_add_count(fields, "pieces", account->sweep.pieces);
    if (account->multipass.sectors) {
        json_add_count(fields, "sectors", account->multipass.sectors);
        json_add_count(fields, "candidates", account->multipass.candidates);
        json_add_count(fields, "relations", account->multipass.relations);
        json_add_count(fields, "cells_on_cycles", account->multipass.on_cycles);
    }
    json_add_count(fields, "longest_sequence", account->deepest);
    json_open(fields, "effect_work");
    json_add_count(fields, "door_steps", account->effects.door_steps);
    json_add_count(fields, "mirror_steps", account->effects.mirror_steps);
    json_add_count(fields, "glass_tests", account->effects.glass_tests);
    json_add_count(fields, "mirrored_pairs", account->mirrored_pairs);
    json_add_count(fields, "rounded_places", account->effects.rounded_places);
    json_add_count(fields, "door_bytes", sl_door_sets_bytes(&visibility->doors));
    json_add_count(fields, "door_fallbacks", account->effects.door_fallbacks);
    json_add_count(fields, "range_tests", account->effects.range_tests);
    json_add_count(fields, "close_calls", account->effects.close_calls);
    json_close(fields);
    if (!trees->cell_count) return;
    json_add_count(fields, "tree_nodes_kept", trees->offsets[trees->cell_count]);
    json_add_count(fields, "trees_left_out", trees->left_out);
}

static sl_status bake_report_print_json(sl_context *context, const bake_report *report) {
    const sl_baked *baked = report->baked;
    const sl_space *space = &baked->space;
    const bool has_sets = !sl_baked_is_shard(baked);
    pvs_means mean;
    if (has_sets) SL_TRY(mean_pvs_of(context, baked, &mean));

    json_fields fields = json_begin();
    json_add_text(&fields, "map", report->input);
    json_add_text(&fields, "output", report->output);
    json_add_text(&fields, "subdivide", report->account.subdivision->name);
    json_add_text(&fields, "method", baked->method);
    json_add_text(&fields, "solver", baked->solver[0] ? baked->solver : NULL);
    json_add_text(&fields, "sight", sight_name(baked->visibility.sight));
    json_add_text(&fields, "guarantee", sl_guarantee_name(baked->visibility.guarantee));
    plan_add_json(&fields, &baked->map);
    add_parts(&fields, report);
    add_seconds(&fields, report);
    json_add_cleaning(&fields, "cleaning", &report->account.cleaning);
    json_add_count(&fields, "walls", space->wall_count);
    json_add_count(&fields, "welded", report->account.cleaning.welded);
    json_add_count(&fields, "cells", space->cell_count);
    json_add_count(&fields, "inside_cells", space->inside_count);
    ground_add_json(&fields, space);
    json_add_count(&fields, "portals", space->portal_count);
    json_add_count(&fields, "tree_depth", space->tree_depth);
    if (has_sets) add_visibility(&fields, &baked->visibility);
    if (has_sets) mean_pvs_add_json(&fields, &mean);
    json_add_count(&fields, "peak_memory_bytes", system_peak_memory());
    json_add_count(&fields, "file_bytes", system_file_size(report->output));
    return json_print(context, &fields);
}

// --- text

static void print_parts(const bake_report *report) {
    const sl_bake_account *account = &report->account;
    const sl_partial *partial = &report->baked->partial;
    const char *units = account->work.units;
    char text[SL_PARTIAL_TEXT];
    if (!units) return;
    printf("  %-9s %" PRIu32 ", %" PRIu32 " of them done, %" PRIu32 " known before\n", units,
           account->work.count, account->work.done, account->work.known);
    if (partial->shard_count) {
        printf("  shard     %" PRIu32 " of %" PRIu32 ", %" PRIu32 " %s left\n", partial->shard,
               partial->shard_count, sl_partial_left(partial), units);
        return;
    }
    sl_baked_say_partial(report->baked, text);
    if (text[0]) printf("  %s\n", text);
}

static void print_effect_work(const sl_visibility *visibility) {
    const sl_see_account *account = &visibility->account;
    const sl_door_sets *doors = &visibility->doors;
    if (visibility->mirrored.cell_count) {
        printf("  mirrored  %" PRIu64 " pairs seen by mirror", account->mirrored_pairs);
        if (account->effects.rounded_places)
            printf("; %" PRIu64 " places were rounded", account->effects.rounded_places);
        putchar('\n');
    }
    if (doors->cell_count) {
        char size[SIZE_TEXT];
        size_write(sl_door_sets_bytes(doors), size);
        printf("  doors     %s of door sets", size);
        if (account->effects.door_fallbacks)
            printf("; %" PRIu64 " %s as seen, with too many sets", account->effects.door_fallbacks,
                   account->effects.door_fallbacks == 1 ? "pair counts" : "pairs count");
        putchar('\n');
    }
    if (account->effects.range_tests) {
        printf("  in range  %" PRIu64 " sequences measured", account->effects.range_tests);
        if (account->effects.close_calls)
            printf("; %" PRIu64 " end within rounding of the range and count as seen",
                   account->effects.close_calls);
        putchar('\n');
    }
}

static void print_visibility(const sl_baked *baked) {
    const sl_visibility *visibility = &baked->visibility;
    const sl_see_account *account = &visibility->account;
    printf("  pairs     %" PRIu64 " seen, %s sight, by %s%s%s (%s)\n", account->pairs,
           sight_name(visibility->sight), baked->method, baked->solver[0] ? " with " : "",
           baked->solver, sl_guarantee_name(visibility->guarantee));
    if (account->doubtful_pairs)
        printf("  doubtful  %" PRIu64 " of them were decided by rounding\n",
               account->doubtful_pairs);
    if (account->tests)
        printf("  work      %" PRIu64 " stabbing tests, %" PRIu64
               " tree nodes, longest sequence %" PRIu32 "\n",
               account->tests, account->nodes, account->deepest);
    else if (account->sweep.pieces)
        printf("  work      %" PRIu64 " pieces of cells, longest sequence %" PRIu32 "\n",
               account->sweep.pieces, account->deepest);
    print_effect_work(visibility);
    const sl_stab_trees *trees = &visibility->trees;
    if (trees->cell_count) {
        printf("  trees     %" PRIu64 " nodes kept", trees->offsets[trees->cell_count]);
        if (trees->left_out)
            printf("; %" PRIu32 " of %" PRIu32 " trees are left out (--tree-memory)",
                   trees->left_out, trees->cell_count);
        putchar('\n');
    }
}

static void print_seconds(const bake_report *report) {
    printf("  seconds   read %.3f, subdivide %.3f", report->read_seconds,
           report->account.seconds.subdivide);
    if (report->account.checked) printf(", check %.3f", report->account.seconds.check);
    printf(", cell to cell %.3f, write %.3f\n", report->account.seconds.see, report->write_seconds);
}

static sl_status bake_report_print(sl_context *context, const bake_report *report) {
    const sl_space *space = &report->baked->space;
    const bool has_sets = !sl_baked_is_shard(report->baked);
    pvs_means mean;
    if (has_sets) SL_TRY(mean_pvs_of(context, report->baked, &mean));
    char file[SIZE_TEXT], memory[SIZE_TEXT];
    size_write(system_file_size(report->output), file);
    size_write(system_peak_memory(), memory);
    printf("%s: %s, baked from %s\n", report->output, file, report->input);
    printf("  walls     %" PRIu32, space->wall_count);
    cleaning_print(&report->account.cleaning);
    printf("  cells     %" PRIu32, space->cell_count);
    if (space->inside_count < space->cell_count)
        printf(", %" PRIu32 " inside", space->inside_count);
    if (space->node_count) printf("; tree depth %" PRIu32, space->tree_depth);
    putchar('\n');
    ground_print(space);
    printf("  portals   %" PRIu32 "\n", space->portal_count);
    plan_print(&report->baked->map);
    print_parts(report);
    if (has_sets) {
        print_visibility(report->baked);
        mean_pvs_print(&mean);
    }
    print_seconds(report);
    printf("  memory    %s at most\n", memory);
    return SL_OK;
}

// --- the command

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

/// Refuses options that the chosen method has no use for.
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

/// Where no method is named, the map decides later. Options are checked against the method for a
/// map of walls alone.
static sl_status make_plan(sl_context *context, bake_plan *plan) {
    sl_bake_options *bake = &plan->pipeline.bake;
    SL_TRY(pipeline_plan(context, plan->input, &plan->pipeline));
    if (plan->solver_given) bake->see.solver = built_solver(plan->solver);
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

/// With --check: reads the file again that was written.
static sl_status check_file(sl_context *context, const bake_plan *plan) {
    sl_baked again = {0};
    if (!plan->pipeline.bake.check) return SL_OK;
    SL_TRY(sl_baked_read_part(context, plan->output, &again));
    sl_baked_destroy(context, &again);
    return SL_OK;
}

static sl_status between(sl_context *context, void *user, sl_bake_options *options,
                         const sl_baked *baked, sl_partial *known) {
    bake_plan *plan = user;
    if (crew_rank() == 0)
        SL_TRY(pipeline_note_inside(context, &plan->pipeline, &baked->map, &baked->space));
    return bake_parts_begin(context, &plan->parts, options, baked, known);
}

static sl_status join(sl_context *context, void *user, sl_status outcome, sl_partial *partial) {
    bake_plan *plan = user;
    return bake_parts_join(context, &plan->parts, outcome, partial);
}

/// Says which pairs take no notice of doors, and what to do about it.
static void note_fallbacks(sl_context *context, const bake_report *report, uint32_t limit) {
    const uint64_t pairs = report->baked->visibility.account.effects.door_fallbacks;
    if (!limit && report->baked->map.door_count)
        sl_note(context,
                "no sets of doors are kept: rows are those with all doors open; in a game, "
                "sl_runtime_settle() makes them exact");
    else if (pairs)
        sl_note(context,
                "whatever is shut, %" PRIu64 " %s as seen, for more sets of doors are needed than "
                "the %" PRIu32 " kept: --door-limit N keeps more; in a game, sl_runtime_settle() "
                "makes rows exact, and --door-limit 0 bakes fast",
                pairs, pairs == 1 ? "pair counts" : "pairs count", limit);
}

static sl_status bake(sl_context *context, bake_plan *plan, sl_map *map, sl_baked *baked,
                      bake_report *report) {
    sl_bake_options *options = &plan->pipeline.bake;
    const double start = sl_seconds();
    SL_TRY(pipeline_read(context, &plan->pipeline, map));
    report->read_seconds = sl_seconds() - start;
    bake_parts_choose(&plan->parts, map, options);
    options->user = plan;
    options->between = between;
    options->join = join;
    SL_TRY(sl_bake(context, map, options, baked, &report->account));
    report->read_seconds += report->account.seconds.clean;
    if (crew_rank() != 0) return SL_OK;
    note_fallbacks(context, report, options->door_limit);
    if (plan->named_by_map) sl_note(context, "writing %s, as no -o is given", plan->output);
    const double seen = sl_seconds();
    SL_TRY(sl_baked_write(context, baked, plan->output));
    report->write_seconds = sl_seconds() - seen;
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
    pipeline_print_methods();
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
        {"output", 'o', "FILE.slv", "the baked file (default: in this folder, named after the map)",
         .text = &plan.output, .check = CHECK_BAKED},
        {"inside", 0, NULL, "compute inside cells only: a smaller file for a game",
         .flag = &see->inside_only},
        {"stab-trees", 0, NULL, "keep the trees of portal sequences", .flag = &see->trees},
        {"method", 0, "NAME",
         "how to find what a cell sees (default: sweep; dfs for stab trees and solvers)",
         .choice = &plan.method, .names = method_table(), .given = &plan.method_given},
        {"solver", 0, "NAME",
         "what decides if a line passes a sequence of portals (default: funnel)",
         .choice = &plan.solver, .names = solver_table(), .given = &plan.solver_given},
        {"threads", 0, "N", "number of threads (default: one per core)", .count32 = &see->threads,
         .most = MAX_THREADS},
        {"json", 0, NULL, "print the statistics as one JSON object", .flag = &plan.json},
        {.group = &pipeline},
        {"sight", 0, "closed|open",
         "whether lines that only touch wall ends count: closed (default): yes; open: no",
         .sight = &see->sight, .topic = "computing visibility", .rare = true},
        {"mirror-depth", 0, "N", "largest number of reflections, up to 16 (default 1; 0: none)",
         .count32 = &bake_options->mirror_depth, .most = 16, .topic = "computing visibility",
         .rare = true},
        {"door-limit", 0, "N",
         "largest number of sets of doors kept for a pair (default 16); a pair with more counts as "
         "seen; 0: none are looked for",
         .count32 = &bake_options->door_limit, .most = 65535, .topic = "computing visibility",
         .rare = true},
        {"memory", 0, "SIZE",
         "memory for the visible sets while they grow: 64M, 2G (default: half of the machine's)",
         .bytes = &see->row_bytes, .given = &plan.memory_given, .topic = "computing visibility",
         .rare = true},
        {"tree-memory", 0, "SIZE", "memory for stab trees: 64K, 256M (default), 2G",
         .bytes = &see->tree_bytes, .given = &plan.tree_memory_given,
         .topic = "computing visibility", .rare = true},
        {"passes", 0, "N",
         "number of direction sectors of multipass (default 8; 0: one per portal)",
         .count32 = &see->sectors, .given = &plan.passes_given, .topic = "computing visibility",
         .rare = true},
        {"samples", 0, "N", "number of lines from each cell, for the method sampling",
         .count32 = &see->samples, .given = &plan.samples_given, .topic = "computing visibility",
         .rare = true},
        {"seed", 0, "N", "seed of the random lines, for the method sampling", .count = &see->seed,
         .given = &plan.seed_given, .topic = "computing visibility", .rare = true},
        {.group = &parts},
    };
    const command_usage usage = {
        .name = "bake",
        .synopsis = "MAP [-o FILE.slv] [options]",
        .operands = {"MAP"},
        .what = "Cuts a map into convex cells joined by portals. Computes which cells see which. "
                "Writes both into a file.",
        .tables = print_tables,
        .examples = "  sightline bake office.map -o office.slv\n"
                    "  sightline bake tower.ug --slice 1040 --start 1400,1600 --inside --json\n"
                    "  sightline bake office.map --previous office.slv -o office.slv\n"
                    "  sightline bake city.map --time-limit 60 -o city.slv\n"
                    "  sightline bake city.map --resume city.slv -o city.slv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .given = &plan.pipeline.given,
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
