/// What a bake takes over, which part of it is done now, and when it stops.
#include "studies/bake_parts.h"

#include "sightline/support.h"
#include "studies/table_part.h"
#include "system/crew.h"

#include <string.h>

// --- the options

static bool in_parts(const bake_parts *parts) {
    return parts->time_limit > 0 || parts->keep_partial || parts->shard_count || parts->resume ||
           parts->previous || crew_size() > 1;
}

/// Whether units of the work are told apart: with --previous alone they are only if it is of use.
static bool by_units(const bake_parts *parts, unsigned effects) {
    bake_parts others = *parts;
    if (effects & ~(unsigned)(SL_EFFECT_ONEWAY | SL_EFFECT_RANGE)) others.previous = NULL;
    return in_parts(&others);
}

/// The option that asks for a bake in parts.
static const char *reason(const bake_parts *parts) {
    return parts->time_limit > 0 ? "--time-limit"
           : parts->keep_partial ? "--keep-partial"
           : parts->shard_count  ? "--shard"
           : parts->resume       ? "--resume"
           : parts->previous     ? "--previous"
                                 : "mpirun";
}

option_table bake_parts_option_table(bake_parts *parts) {
    const option_spec options[] = {
        {"time-limit", 0, "SECONDS",
         "stop after this time and write a partial file: pairs that are not decided count as seen",
         .number = &parts->time_limit, .over_0 = true, .needs = "seconds, more than 0"},
        {"keep-partial", 0, NULL,
         "write a partial file at the first Ctrl-C (default: write nothing)",
         .flag = &parts->keep_partial},
        {"resume", 0, "FILE.slv", "go on with a partial file of the same map and options",
         .text = &parts->resume},
        {"previous", 0, "FILE.slv",
         "take from an older bake what the changed walls cannot affect (nothing if the map has "
         "doors or mirrors)",
         .text = &parts->previous},
        {"shard", 0, "K/N", "compute part K of N (1 <= K <= N), for 'sightline merge'",
         .text = &parts->shard_text},
    };
    option_table table = {0};
    option_table_add(&table, options, sizeof options / sizeof *options);
    option_table_topic(&table, "working in parts (the bytes stay the same)");
    for (size_t i = 0; i < table.count; i++) table.items[i].rare = true;
    return table;
}

sl_status bake_parts_plan(sl_context *context, const sl_see_method *method,
                          const sl_see_options *see, bake_parts *parts) {
    parts->start = sl_seconds();
    if (parts->shard_text)
        SL_TRY(share_read(context, parts->shard_text, &parts->shard, &parts->shard_count));
    if (parts->resume && parts->previous)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--resume goes on with a bake, --previous takes over an older one: give "
                       "one of them");
    if (crew_size() > 1 && parts->shard_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "--shard: the processes of mpirun share the work");
    if (in_parts(parts) && !method->run)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: the method '%s' cannot work in parts; sweep, dfs and prune can",
                       reason(parts), method->name);
    if (in_parts(parts) && see->trees)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: a bake in parts cannot keep --stab-trees",
                       reason(parts));
    return SL_OK;
}

// --- when to stop

static bool is_over(void *user) {
    const bake_parts *parts = user;
    return (parts->asked && console_is_asked()) || (parts->end > 0 && sl_seconds() >= parts->end);
}

// --- what is known before

const char *bake_difference(const sl_baked *a, const sl_baked *b) {
    if (strcmp(a->method, b->method) != 0) return "by another method";
    if (strcmp(a->solver, b->solver) != 0) return "with another solver";
    if (a->visibility.sight != b->visibility.sight) return "with other sight";
    if (a->partial.inside_only != b->partial.inside_only) return "with another choice of --inside";
    if (a->partial.mirror_depth != b->partial.mirror_depth) return "with another --mirror-depth";
    if (a->partial.door_limit != b->partial.door_limit) return "with another --door-limit";
    if (sl_map_channel(&a->map) != sl_map_channel(&b->map)) return "with other --stops";
    if (!sl_effects_same(&a->map, &b->map)) return "with other effects";
    if (!sl_baked_same_space(&a->space, &b->space))
        return "from another map, or cut into other cells,";
    return NULL;
}

static sl_status fail_other(sl_context *context, const char *path, const char *difference,
                            const sl_baked *before) {
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--resume %s: was baked %s than asked for; it was begun with --method %s%s%s "
                   "--sight %s%s",
                   path, difference, before->method, before->solver[0] ? " --solver " : "",
                   before->solver, sight_name(before->visibility.sight),
                   before->partial.inside_only ? " --inside" : "");
}

static sl_status take_begun(sl_context *context, const bake_parts *parts, const sl_see_options *see,
                            const sl_baked *baked, sl_baked *before, sl_partial *partial) {
    const char *path = parts->resume;
    SL_TRY(sl_baked_read_part(context, path, before));
    if (!sl_partial_begun(&before->partial))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--resume %s: is finished; there is nothing to go on with", path);
    sl_baked asked = *baked;
    asked.visibility.sight = see->sight;
    asked.partial.inside_only = see->inside_only;
    if (see->plan->effects) {
        asked.partial.mirror_depth = see->plan->mirror_depth;
        asked.partial.door_limit = see->plan->door_limit;
    }
    const char *other = bake_difference(before, &asked);
    if (other) return fail_other(context, path, other, before);
    if (before->partial.shard != parts->shard || before->partial.shard_count != parts->shard_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       before->partial.shard_count ? "--resume %s: is shard %u of %u; ask for it"
                                                   : "--resume %s: is no shard",
                       path, before->partial.shard, before->partial.shard_count);
    *partial = before->partial;
    before->partial = (sl_partial){0};
    return SL_OK;
}

/// It is no failure when nothing can be reused: then everything is computed.
static sl_status take_over(sl_context *context, const char *path, const sl_see_method *method,
                           const sl_see_options *see, const sl_baked *baked, sl_baked *before,
                           sl_partial *partial) {
    SL_TRY(sl_baked_read(context, path, before));
    const sl_plan then = sl_plan_make(&before->map);
    if (then.effects != see->plan->effects || then.range != see->plan->range) {
        sl_note(context, "nothing is taken over from %s: it has other effects or another range",
                path);
        return SL_OK;
    }
    const sl_status status = sl_partial_reuse(context, &before->space, &before->visibility,
                                              &baked->space, method, see, partial);
    if (status != SL_BAD_ARGUMENT) return status;
    sl_note(context, "nothing is taken over from %s: %s", path, sl_context_message(context));
    return SL_OK;
}

/// An older bake that is of no use. It has to be one.
static sl_status pass_over(sl_context *context, const char *path, const char *why) {
    sl_baked before = {0};
    SL_TRY(sl_baked_read(context, path, &before));
    sl_baked_destroy(context, &before);
    sl_note(context, "nothing is taken over from %s: %s", path, why);
    return SL_OK;
}

/// Why --previous is of no use; NULL if it may be of some.
static const char *no_use(const bake_parts *parts, const sl_see_method *method, unsigned effects) {
    if (effects && !by_units(parts, effects))
        return "the map has doors or mirrors, and a baked file does not keep with how many sets of "
               "doors and reflections it was made";
    return effects && method && !method->stabs ? "with effects this method bakes a map as a whole"
                                               : NULL;
}

static sl_status take_known(sl_context *context, const bake_parts *parts,
                            const sl_see_method *method, const sl_see_options *see,
                            const sl_baked *baked, sl_partial *partial) {
    sl_baked before = {0};
    sl_status status = SL_OK;
    if (parts->resume)
        status = take_begun(context, parts, see, baked, &before, partial);
    else if (parts->previous)
        status = take_over(context, parts->previous, method, see, baked, &before, partial);
    sl_baked_destroy(context, &before);
    return status;
}

// --- the work

sl_status bake_parts_join(sl_context *context, bake_parts *parts, sl_status outcome,
                          sl_partial *partial) {
    SL_TRY(crew_agree(context, outcome));
    // Ctrl-C has had its effect. The bound may take a quarter of the time limit.
    parts->asked = false;
    parts->end = parts->time_limit > 0 ? sl_seconds() + parts->time_limit / 4 : 0;
    if (crew_size() == 1) return SL_OK;
    partial->shard = partial->shard_count = 0;
    SL_TRY(crew_agree(context, crew_join(context, partial)));
    if (crew_rank() != 0) sl_partial_destroy(context, partial);
    return SL_OK;
}

void bake_parts_choose(const bake_parts *parts, const sl_map *map, sl_bake_options *options) {
    const unsigned effects = sl_plan_make(map).effects;
    if (effects && by_units(parts, effects) && !options->method && !options->see.solver)
        options->method = sl_see_method_named("prune");
}

sl_status bake_parts_begin(sl_context *context, bake_parts *parts, sl_bake_options *options,
                           const sl_baked *baked, sl_partial *known) {
    const unsigned effects = options->see.plan->effects;
    sl_see_options *see = &options->see;
    const char *why = no_use(parts, options->method, effects);
    if (parts->previous && why && crew_rank() == 0)
        SL_TRY(pass_over(context, parts->previous, why));
    if (why) parts->previous = NULL;
    options->by_units = in_parts(parts);
    if (!options->by_units) return SL_OK;
    if (parts->keep_partial) console_ask_first();
    if (crew_size() > 1 && effects)
        return sl_fail(context, SL_UNSUPPORTED,
                       "processes of mpirun do not exchange what is found of effects: bake shards "
                       "(--shard), and merge them");
    parts->asked = parts->keep_partial;
    parts->end = parts->time_limit > 0 ? parts->start + parts->time_limit : 0;
    see->enough = is_over;
    see->enough_user = parts;
    SL_TRY(crew_agree(context, take_known(context, parts, options->method, see, baked, known)));
    // Each process of the crew computes its share.
    see->shard = crew_size() > 1 ? crew_rank() + 1 : parts->shard;
    see->shard_count = crew_size() > 1 ? crew_size() : parts->shard_count;
    return SL_OK;
}
