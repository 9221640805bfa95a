/// From a map to a baked result, in the order of the stages: clean, subdivide, see.
#include "bake/cells.h"

#include "sightline/stab.h"
#include "sightline/support.h"

enum { MIRROR_DEPTH_MOST = 16 };

sl_bake_options sl_bake_options_default(void) {
    sl_bake_options options = {.clean = sl_clean_options_default(),
                               .rules = sl_subdivide_options_default(),
                               .see = sl_see_options_default(),
                               .mirror_depth = 1,
                               .door_limit = 16};
    options.see.row_bytes = sl_machine_memory() / 2;
    return options;
}

/// Takes doors as they stand where a method is asked for that knows no doors.
static sl_status settle_doors(sl_context *context, sl_map *map, const sl_bake_options *options) {
    const bool knows = !options->method || options->method->knows & SL_EFFECT_DOOR;
    return knows || !map->door_count ? SL_OK : sl_effects_settle_doors(context, map);
}

static sl_status choose(sl_context *context, const sl_map *map, sl_bake_options *options) {
    if (options->mirror_depth > MIRROR_DEPTH_MOST)
        return sl_fail(context, SL_BAD_ARGUMENT, "the mirror depth must be 0 to %d",
                       MIRROR_DEPTH_MOST);
    if (!options->method) options->method = sl_see_method_for(map, &options->see);
    if (options->method->stabs && !options->see.solver) options->see.solver = sl_funnel();
    return sl_see_check(context, options->method, options->see.solver, map);
}

sl_status sl_bake_space(sl_context *context, sl_map *map, sl_bake_options *options, sl_baked *out,
                        sl_bake_account *account) {
    sl_bake_account unwanted = {0};
    if (!account) account = &unwanted;
    SL_TRY(settle_doors(context, map, options));
    SL_TRY(sli_bake_clean(context, map, options, account));
    SL_TRY(choose(context, map, options));
    SL_TRY(sli_bake_cut(context, map, options, out, account));
    snprintf(out->method, sizeof out->method, "%s", options->method->name);
    if (options->see.solver)
        snprintf(out->solver, sizeof out->solver, "%s", options->see.solver->name);
    return SL_OK;
}

/// Finds the visible sets unit by unit, or what is known of them when the bake stops.
static sl_status see_by_units(sl_context *context, sl_bake_options *options, sl_partial *partial,
                              sl_baked *baked, sl_bake_account *account) {
    const sl_see_method *method = options->method;
    sl_see_options *see = &options->see;
    if (!method->run || see->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method '%s' does not work by units%s",
                       method->name, method->run ? " with stab trees" : "");
    account->work.known = partial->done_count;
    sl_status status = method->run(context, &baked->space, see, partial);
    if (options->join) status = options->join(context, options->user, status, partial);
    SL_TRY(status);
    account->work.units = method->units;
    account->work.count = partial->unit_count;
    account->work.done = partial->done_count;
    if (partial->shard_count) {
        baked->visibility.sight = see->sight;
        baked->visibility.guarantee = method->stabs ? see->solver->guarantee : method->guarantee;
    } else if (sl_partial_begun(partial)) {
        SL_TRY(method->finish(context, &baked->space, see, partial, &baked->visibility));
    }
    if (!partial->shard_count && sl_partial_complete(partial)) return SL_OK;
    baked->partial = *partial;
    *partial = (sl_partial){0};
    return SL_OK;
}

static sl_status find_sets(sl_context *context, sl_bake_options *options, sl_baked *baked,
                           sl_bake_account *account) {
    sl_plan plan = sl_plan_make(&baked->map);
    sl_partial partial = {0};
    sl_status status = SL_OK;
    plan.mirror_depth = options->mirror_depth;
    plan.door_limit = options->door_limit;
    options->see.plan = &plan;
    if (options->between)
        status = options->between(context, options->user, options, baked, &partial);
    double time = sl_seconds();
    if (status == SL_OK)
        status = options->by_units ? see_by_units(context, options, &partial, baked, account)
                                   : options->method->see(context, &baked->space, &options->see,
                                                          &baked->visibility);
    account->seconds.see = sl_seconds() - time;
    sl_partial_destroy(context, &partial);
    return status;
}

sl_guarantee sl_limited_guarantee(const sl_map *map, sl_guarantee guarantee) {
    const bool adds = guarantee == SL_CONSERVATIVE || guarantee == SL_ROUNDED;
    if (adds || !sl_map_limited_walls(map)) return guarantee;
    return guarantee == SL_EXACT ? SL_CONSERVATIVE : SL_ROUNDED;
}

sl_status sl_bake(sl_context *context, sl_map *map, const sl_bake_options *options, sl_baked *out,
                  sl_bake_account *account) {
    sl_bake_options chosen = options ? *options : sl_bake_options_default();
    sl_bake_account done = {0};
    SL_TRY(sl_bake_space(context, map, &chosen, out, &done));
    const sl_status status = find_sets(context, &chosen, out, &done);
    out->visibility.guarantee = sl_limited_guarantee(&out->map, out->visibility.guarantee);
    if (status != SL_OK)
        sl_baked_destroy(context, out);
    else if (account)
        *account = done;
    return status;
}
