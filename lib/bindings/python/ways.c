/// Ways and distances for Python.
#include "facade.h"

#include <math.h>

/// A finder of ways with the level's doors. Where the loss is a number, those that are shut are
/// passed at that loss.
static sl_status begin(slp_level *level, double loss, sl_query **query, sl_route_finder **finder) {
    sl_context *context = level->base.context;
    const sl_map *map = &level->baked.map;
    *query = NULL;
    *finder = NULL;
    if (sl_map_steps_differ(map))
        return sl_fail(context, SL_UNSUPPORTED,
                       "the cells are those of sight, and some walls stop sight or steps alone: "
                       "there are no ways in them");
    double *losses = sl_alloc_array(context, map->door_count, sizeof *losses);
    if (!losses) return SL_NO_MEMORY;
    sl_status status = sl_query_over(context, &level->baked.space, map, NULL, query);
    for (size_t i = 0; status == SL_OK && i < map->door_count; i++) {
        sl_query_set_door_at(context, *query, i, !isnan(loss) || !level->shut[i]);
        losses[i] = level->shut[i] ? loss : 0;
    }
    if (status == SL_OK) status = sl_route_finder_create(context, *query, finder);
    if (status == SL_OK && !isnan(loss))
        status = sl_route_finder_set_losses(context, *finder, losses, map->door_count);
    sl_free(context, losses);
    return status;
}

static void finish(slp_level *level, sl_query *query, sl_route_finder *finder) {
    sl_route_finder_destroy(level->base.context, finder);
    sl_query_destroy(level->base.context, query);
}

int slp_level_path(slp_level *level, const double *from, const double *to, double loss,
                   double radius, double *length) {
    sl_context *context = level->base.context;
    sl_query *query;
    sl_route_finder *finder;
    slp_level_forget(level);
    sl_status status = begin(level, loss, &query, &finder);
    if (status == SL_OK && radius > 0) status = sl_route_finder_set_radius(context, finder, radius);
    if (status == SL_OK)
        status = sl_route_find(context, finder, (sl_point){from[0], from[1]},
                               (sl_point){to[0], to[1]}, &level->route);
    *length = level->route.found ? level->route.length : (double)INFINITY;
    finish(level, query, finder);
    return status;
}

size_t slp_level_path_points(const slp_level *level, double *points) {
    for (size_t i = 0; points && i < level->route.count; i++) {
        points[2 * i] = level->route.points[i].x;
        points[2 * i + 1] = level->route.points[i].y;
    }
    return level->route.count;
}

int slp_level_distances(slp_level *level, const double *from, double loss, double limit,
                        double *distances, double *nearest) {
    sl_context *context = level->base.context;
    const uint32_t count = level->baked.space.cell_count;
    sl_query *query;
    sl_route_finder *finder;
    sl_route_near *cells = sl_alloc_array(context, count, sizeof *cells);
    if (!cells) return SL_NO_MEMORY;
    sl_status status = begin(level, loss, &query, &finder);
    if (status == SL_OK)
        status = sl_route_distances(context, finder, (sl_point){from[0], from[1]}, limit, cells);
    for (uint32_t c = 0; status == SL_OK && c < count; c++) {
        const bool reached = isfinite(cells[c].distance);
        distances[c] = cells[c].distance;
        nearest[2 * c] = reached ? cells[c].at.x : (double)NAN;
        nearest[2 * c + 1] = reached ? cells[c].at.y : (double)NAN;
    }
    finish(level, query, finder);
    sl_free(context, cells);
    return status;
}

int slp_level_distances_to(slp_level *level, const double *from, double loss, double limit,
                           const double *places, size_t count, double *distances, double *roots) {
    sl_context *context = level->base.context;
    sl_query *query;
    sl_route_finder *finder;
    sl_route_map *map = NULL;
    sl_status status = begin(level, loss, &query, &finder);
    if (status == SL_OK)
        status = sl_route_map_create(context, finder, (sl_point){from[0], from[1]}, limit, &map);
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        sl_route_place place;
        sl_route_map_at(map, (sl_point){places[2 * i], places[2 * i + 1]}, &place);
        const bool reached = isfinite(place.distance);
        distances[i] = place.distance;
        roots[2 * i] = reached ? place.root.x : (double)NAN;
        roots[2 * i + 1] = reached ? place.root.y : (double)NAN;
    }
    sl_route_map_destroy(context, map);
    finish(level, query, finder);
    return status;
}
