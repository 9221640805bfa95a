/// From a map to a baked result, in the order of the stages: clean, subdivide, see.
#include "sightline/bake.h"

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

/// Seconds since *last, which is set to now.
static double lap(double *last) {
    const double before = *last;
    *last = sl_seconds();
    return *last - before;
}

/// What a baked result keeps of the map: all but walls and cells, which the space has.
static void keep_rest_of_map(sl_context *context, sl_map *map, sl_baked *baked) {
    sl_free(context, map->walls);
    map->walls = NULL;
    map->wall_count = map->wall_room = 0;
    sl_map_drop_cells(context, map);
    baked->map = *map;
    *map = (sl_map){0};
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

static sl_status make_space(sl_context *context, const sl_map *map, const sl_bake_options *options,
                            sl_space *space, sl_bake_account *account, double *time) {
    account->subdivision = options->subdivision ? options->subdivision : sl_subdivision_for(map);
    SL_TRY(account->subdivision->subdivide(context, map, &options->rules, space));
    account->seconds.subdivide = lap(time);
    account->checked = options->check || space->neighbour;
    const sl_status status = account->checked ? sl_space_check(context, space) : SL_OK;
    account->seconds.check = lap(time);
    if (status != SL_OK) sl_space_destroy(context, space);
    return status;
}

sl_status sl_bake_space(sl_context *context, sl_map *map, sl_bake_options *options, sl_baked *out,
                        sl_bake_account *account) {
    sl_bake_account unwanted = {0};
    double time = sl_seconds();
    if (!account) account = &unwanted;
    SL_TRY(settle_doors(context, map, options));
    SL_TRY(sl_map_clean(context, map, &options->clean, &account->cleaning));
    SL_TRY(sl_map_find_inside(context, map, &options->clean, &account->cleaning));
    SL_TRY(choose(context, map, options));
    account->seconds.clean = lap(&time);
    SL_TRY(make_space(context, map, options, &out->space, account, &time));
    keep_rest_of_map(context, map, out);
    snprintf(out->method, sizeof out->method, "%s", options->method->name);
    if (options->see.solver)
        snprintf(out->solver, sizeof out->solver, "%s", options->see.solver->name);
    return SL_OK;
}

sl_plan sl_bake_plan(const sl_bake_options *options, const sl_baked *baked) {
    sl_plan plan = sl_plan_make(&baked->map);
    plan.mirror_depth = options->mirror_depth;
    plan.door_limit = options->door_limit;
    return plan;
}

sl_status sl_bake_see(sl_context *context, const sl_bake_options *options, sl_baked *baked,
                      sl_bake_account *account) {
    double time = sl_seconds();
    const sl_plan plan = sl_bake_plan(options, baked);
    sl_see_options see = options->see;
    see.plan = &plan;
    SL_TRY(options->method->see(context, &baked->space, &see, &baked->visibility));
    if (account) account->seconds.see = lap(&time);
    return SL_OK;
}

sl_status sl_bake(sl_context *context, sl_map *map, const sl_bake_options *options, sl_baked *out,
                  sl_bake_account *account) {
    sl_bake_options chosen = options ? *options : sl_bake_options_default();
    sl_bake_account done = {0};
    SL_TRY(sl_bake_space(context, map, &chosen, out, &done));
    const sl_status status = sl_bake_see(context, &chosen, out, &done);
    if (status != SL_OK)
        sl_baked_destroy(context, out);
    else if (account)
        *account = done;
    return status;
}
