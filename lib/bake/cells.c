/// The first half of a bake: a map becomes cells.
#include "bake/cells.h"

#include "sightline/support.h"

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

sl_status sli_bake_clean(sl_context *context, sl_map *map, const sl_bake_options *options,
                         sl_bake_account *account) {
    double time = account ? sl_seconds() : 0;
    sl_clean_account unwanted = {0}, *cleaning = account ? &account->cleaning : &unwanted;
    SL_TRY(sl_map_clean(context, map, &options->clean, cleaning));
    SL_TRY(sl_map_find_inside(context, map, &options->clean, cleaning));
    if (account) account->seconds.clean = lap(&time);
    return SL_OK;
}

sl_status sli_bake_cut(sl_context *context, sl_map *map, const sl_bake_options *options,
                       sl_baked *out, sl_bake_account *account) {
    double time = account ? sl_seconds() : 0;
    sl_space *space = &out->space;
    const sl_subdivision *way =
        options->subdivision ? options->subdivision : sl_subdivision_for(map);
    SL_TRY(way->subdivide(context, map, &options->rules, space));
    if (account) account->seconds.subdivide = lap(&time);
    const bool checked = options->check || space->neighbour;
    const sl_status status = checked ? sl_space_check(context, space) : SL_OK;
    if (account) {
        account->seconds.check = lap(&time);
        account->subdivision = way;
        account->checked = checked;
    }
    if (status == SL_OK)
        keep_rest_of_map(context, map, out);
    else
        sl_space_destroy(context, space);
    return status;
}

sl_status sl_bake_cells(sl_context *context, sl_map *map, const sl_bake_options *options,
                        sl_baked *out) {
    const sl_bake_options usual = {.clean = sl_clean_options_default(),
                                   .rules = sl_subdivide_options_default()};
    if (!options) options = &usual;
    SL_TRY(sli_bake_clean(context, map, options, NULL));
    return sli_bake_cut(context, map, options, out, NULL);
}

sl_status sl_bake_steps(sl_context *context, const sl_baked *sight, const sl_bake_options *options,
                        sl_baked *out) {
    sl_map map = {0};
    sl_bake_options chosen;
    if (!sl_map_steps_differ(&sight->map)) return SL_OK;
    SL_TRY(sl_baked_copy_map(context, sight, &map));
    map.channel = SL_STOPS_STEPS;
    // Cells that the map brought were those of sight.
    if (options && options->subdivision && options->subdivision->takes_cells) {
        chosen = *options;
        chosen.subdivision = NULL;
        options = &chosen;
    }
    const sl_status status = sl_bake_cells(context, &map, options, out);
    sl_map_destroy(context, &map);
    return status;
}
