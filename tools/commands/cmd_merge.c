/// `sightline merge`: puts the shards of a bake, or of a table, together.
#include "arguments/outputs.h"
#include "commands/commands.h"
#include "inputs/inputs.h"
#include "sightline/support.h"
#include "studies/bake_parts.h"
#include "studies/table_part.h"
#include "system/built.h"
#include "system/system.h"

#include <inttypes.h>
#include <string.h>

typedef struct merge_plan {
    const char *first, *output;
    option_list more;
    uint32_t *shards; ///< by part in the order given: its number
} merge_plan;

static uint32_t part_count(const merge_plan *plan) {
    return (uint32_t)plan->more.count + 1;
}

static const char *part_name(const merge_plan *plan, uint32_t part) {
    return part ? plan->more.items[part - 1] : plan->first;
}

// --- what belongs together

static sl_status check_part(sl_context *context, const merge_plan *plan, uint32_t part,
                            const sl_baked *baked, const sl_baked *first) {
    const char *name = part_name(plan, part);
    const sl_partial *f = &baked->partial;
    if (!sl_baked_is_shard(baked))
        return sl_fail_at(context, name, 0, "is no shard: sightline bake --shard K/N writes them");
    if (f->shard_count != first->partial.shard_count)
        return sl_fail_at(context, name, 0, "is shard %u of %u, but %s is one of %u", f->shard,
                          f->shard_count, plan->first, first->partial.shard_count);
    const char *other = part ? bake_difference(baked, first) : NULL;
    if (other) return sl_fail_at(context, name, 0, "was baked %s than %s", other, plan->first);
    for (uint32_t i = 0; i < part; i++)
        if (plan->shards[i] == f->shard)
            return sl_fail_at(context, name, 0, "is shard %u of %u, as is %s", f->shard,
                              f->shard_count, part_name(plan, i));
    if (sl_partial_left(f))
        return sl_fail_at(context, name, 0,
                          "shard %u of %u is not finished, %u units are left: go on with it, bake "
                          "--shard %u/%u --resume %s",
                          f->shard, f->shard_count, sl_partial_left(f), f->shard, f->shard_count,
                          name);
    plan->shards[part] = f->shard;
    return SL_OK;
}

static bool is_there(const merge_plan *plan, uint32_t shard) {
    for (uint32_t i = 0; i < part_count(plan); i++)
        if (plan->shards[i] == shard) return true;
    return false;
}

/// No two parts are the same shard, so there are never too many.
static sl_status check_all_there(sl_context *context, const merge_plan *plan, uint32_t count) {
    if (part_count(plan) == count) return SL_OK;
    char missing[64] = "";
    size_t length = 0;
    for (uint32_t shard = 1; shard <= count && length < sizeof missing - 16; shard++)
        if (!is_there(plan, shard))
            length += (size_t)snprintf(missing + length, sizeof missing - length, "%s%u",
                                       length ? ", " : "", shard);
    const uint32_t left = count - part_count(plan);
    return sl_fail(context, SL_BAD_INPUT, "of %u shards %u %s missing: %s%s", count, left,
                   left == 1 ? "is" : "are", missing, length < sizeof missing - 16 ? "" : ", ...");
}

// --- the work

static sl_status take_part(sl_context *context, const merge_plan *plan, uint32_t part,
                           sl_baked *all) {
    sl_baked baked = {0};
    SL_TRY(sl_baked_read_part(context, part_name(plan, part), &baked));
    sl_status status = check_part(context, plan, part, &baked, part ? all : &baked);
    if (status == SL_OK && part) status = sl_partial_merge(context, &all->partial, &baked.partial);
    if (status == SL_OK && !part) {
        *all = baked;
        return SL_OK;
    }
    sl_baked_destroy(context, &baked);
    return status;
}

static const sl_solver *find_solver(const char *name) {
    for (size_t i = 0; built_solver(i); i++)
        if (strcmp(built_solver(i)->name, name) == 0) return built_solver(i);
    return NULL;
}

static sl_status settle(sl_context *context, const merge_plan *plan, sl_baked *all) {
    const sl_see_method *method = sl_see_method_named(all->method);
    sl_see_options see = sl_see_options_default();
    see.sight = all->visibility.sight;
    see.inside_only = all->partial.inside_only;
    see.solver = find_solver(all->solver);
    sl_plan effects = sl_plan_make(&all->map);
    effects.mirror_depth = all->partial.mirror_depth;
    effects.door_limit = all->partial.door_limit;
    see.plan = &effects;
    if (!method || !method->finish || (method->stabs && !see.solver))
        return sl_fail_at(context, plan->first, 0,
                          "was baked by a method or a solver that this program has not");
    sl_visibility seen;
    SL_TRY(method->finish(context, &all->space, &see, &all->partial, &seen));
    sl_visibility_destroy(context, &all->visibility);
    all->visibility = seen;
    all->visibility.guarantee = sl_limited_guarantee(&all->map, seen.guarantee);
    sl_partial_destroy(context, &all->partial);
    return SL_OK;
}

static sl_status merge(sl_context *context, const merge_plan *plan, sl_baked *all) {
    for (uint32_t i = 0; i < part_count(plan); i++) {
        sl_report(context, "read", "shards", i, part_count(plan));
        SL_TRY(take_part(context, plan, i, all));
    }
    SL_TRY(check_all_there(context, plan, all->partial.shard_count));
    SL_TRY(settle(context, plan, all));
    return sl_baked_write(context, all, plan->output);
}

static sl_status merge_and_report(command_console *console, merge_plan *plan) {
    sl_context *context = console->context;
    plan->shards = sl_alloc_array(context, part_count(plan), sizeof *plan->shards);
    if (!plan->shards) return SL_NO_MEMORY;
    sl_baked all = {0};
    const sl_status status = merge(context, plan, &all);
    progress_line_clear(&console->line);
    if (status == SL_OK && !console->quiet) {
        char size[SIZE_TEXT];
        size_write(system_file_size(plan->output), size);
        printf("%s: %s, merged from %u shards\n", plan->output, size, part_count(plan));
        printf("  pairs     %" PRIu64 " seen, %s sight, by %s%s%s (%s)\n",
               all.visibility.account.pairs, sight_name(all.visibility.sight), all.method,
               all.solver[0] ? " with " : "", all.solver,
               sl_guarantee_name(all.visibility.guarantee));
        if (all.visibility.mirrored.cell_count)
            printf("  mirrored  %" PRIu64 " pairs seen by mirror\n",
                   all.visibility.account.mirrored_pairs);
    }
    sl_baked_destroy(context, &all);
    sl_free(context, plan->shards);
    return status;
}

/// Tables of vga and isovist.
static sl_status merge_tables(command_console *console, const merge_plan *plan) {
    sl_context *context = console->context;
    const uint32_t count = part_count(plan);
    const char **names = sl_alloc_array(context, count, sizeof *names);
    if (!names) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) names[i] = part_name(plan, i);
    const sl_status status = table_parts_merge(context, names, count, plan->output);
    progress_line_clear(&console->line);
    if (status == SL_OK && !console->quiet && strcmp(plan->output, "-") != 0) {
        char size[SIZE_TEXT];
        size_write(system_file_size(plan->output), size);
        printf("%s: %s, merged from %u parts\n", plan->output, size, count);
    }
    sl_free(context, names);
    return status;
}

sl_status cmd_merge(command_console *console, int argc, char **argv) {
    merge_plan plan = {0};
    const option_spec options[] = {
        {"output", 'o', "FILE", "the baked file (.slv), or the table (.csv)", .text = &plan.output,
         .check = CHECK_FILE, .endings = ".slv .csv"},
    };
    const command_usage usage = {
        .name = "merge",
        .synopsis = "PART [PART ...] -o FILE.slv|FILE.csv",
        .operands = {"PART"},
        .what =
            "Joins the shards of a bake, or of a table of vga or isovist, in any order. The file "
            "is the same, byte for byte, as one process would write. Names the shards that are "
            "missing, doubled, not finished, or of another map.",
        .examples = "  sightline bake city.map --shard 1/2 -o city.1.slv\n"
                    "  sightline bake city.map --shard 2/2 -o city.2.slv\n"
                    "  sightline merge city.1.slv city.2.slv -o city.slv\n"
                    "  sightline vga city.map --grid 1 --shard 1/2 -o city.1.csv\n"
                    "  sightline vga city.map --grid 1 --shard 2/2 -o city.2.csv\n"
                    "  sightline merge city.1.csv city.2.csv -o city.csv",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .more = &plan.more,
    };
    bool helped;
    SL_TRY(options_parse(console, &usage, argc, argv, &plan.first, &helped));
    if (helped) return SL_OK;
    if (!plan.output)
        return sl_fail(console->context, SL_BAD_ARGUMENT,
                       "-o FILE is needed: where to write what the shards make");
    if (!name_ends_with(plan.output, ".slv")) return merge_tables(console, &plan);
    return merge_and_report(console, &plan);
}
