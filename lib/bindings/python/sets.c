/// Sight from lines and areas for Python.
#include "facade.h"

#include "sightline/exposure.h"
#include "sightline/reach.h"

#include <math.h>

/// The points of a set. One point with a radius is a disc: the corners of a polygon in it, with
/// chords within a thousandth of the radius.
static sl_status take_points(sl_context *context, const double *points, size_t count, double radius,
                             sl_point **out, size_t *out_count) {
    const bool disc = radius > 0 && count == 1;
    const sl_point middle = {count ? points[0] : 0, count ? points[1] : 0};
    *out_count = disc ? sl_set_of_disc(middle, radius, radius / 1000, NULL, 0) : count;
    *out = sl_alloc_array(context, *out_count, sizeof **out);
    if (!*out) return SL_NO_MEMORY;
    if (disc)
        sl_set_of_disc(middle, radius, radius / 1000, *out, *out_count);
    else
        for (size_t i = 0; i < count; i++) (*out)[i] = (sl_point){points[2 * i], points[2 * i + 1]};
    return SL_OK;
}

/// The sight of a set with the level's settings.
static sl_status begin(slp_level *level, const double *points, size_t count, int is_area,
                       double radius, sl_set_sight **out) {
    sl_context *context = level->base.context;
    sl_point *set = NULL;
    size_t set_count = 0;
    SL_TRY(slp_level_queries(level, 1));
    sl_status status = take_points(context, points, count, radius, &set, &set_count);
    if (status == SL_OK)
        status = sl_set_sight_create(context, level->queries.items[0], set, set_count,
                                     is_area || radius > 0 ? SL_SET_AREA : SL_SET_LINE, out);
    sl_free(context, set);
    return status;
}

static sl_status keep_loops(sl_context *context, const sl_shape *shape, slp_polygons *out) {
    for (size_t i = 0; i < shape->count; i++) {
        const size_t from = i ? shape->ends[i - 1] : 0, count = shape->ends[i] - from;
        SL_TRY(SL_ARRAY_ROOM(context, &out->list, 1));
        slp_polygon *loop = &out->list.items[out->list.count];
        *loop = (slp_polygon){.count = count};
        loop->points = sl_alloc_array(context, count, sizeof *loop->points);
        if (!loop->points) return SL_NO_MEMORY;
        out->list.count++;
        for (size_t k = 0; k < count; k++) loop->points[k] = shape->points[from + k];
    }
    return SL_OK;
}

int slp_level_set_region(slp_level *level, const double *points, size_t count, int is_area,
                         double radius, int from_all, double *area) {
    sl_context *context = level->base.context;
    sl_set_sight *sight;
    sl_set_region region = {0};
    slp_level_forget(level);
    SL_TRY(begin(level, points, count, is_area, radius, &sight));
    sl_status status = sl_set_sight_region(
        context, sight, from_all ? SL_SEEN_FROM_ALL : SL_SEEN_FROM_SOME, &region);
    if (status == SL_OK) {
        level->polygons = sl_alloc_array(context, 1, sizeof *level->polygons);
        status = level->polygons ? SL_OK : SL_NO_MEMORY;
    }
    if (status == SL_OK) {
        level->eye_count = 1;
        status = keep_loops(context, &region.shape, level->polygons);
    }
    *area = region.area;
    sl_set_region_destroy(context, &region);
    sl_set_sight_destroy(context, sight);
    return status;
}

int slp_level_set_sees(slp_level *level, const double *points, size_t count, int is_area,
                       double radius, int from_all, const double *places, size_t place_count,
                       uint8_t *sees) {
    sl_context *context = level->base.context;
    sl_set_sight *sight;
    SL_TRY(begin(level, points, count, is_area, radius, &sight));
    sl_status status = SL_OK;
    for (size_t i = 0; i < place_count && status == SL_OK; i++) {
        bool seen = false;
        status = sl_set_sight_sees(context, sight, from_all ? SL_SEEN_FROM_ALL : SL_SEEN_FROM_SOME,
                                   (sl_point){places[2 * i], places[2 * i + 1]}, &seen);
        sees[i] = seen;
        if (status == SL_OK && i % 256 == 0) status = sl_check_cancelled(context);
    }
    sl_set_sight_destroy(context, sight);
    return status;
}

/// Rows of exposures: size, seen, the length of the path that sees some of it, and all of it, and
/// how far along the path some of it is seen first, or NAN.
static void put_exposure(sl_context *context, sl_exposure *e, double row[5]) {
    row[0] = e->size;
    row[1] = e->seen;
    row[2] = e->some.total;
    row[3] = e->whole.total;
    row[4] = e->some.count ? e->some.parts[0].from : NAN;
    sl_exposure_destroy(context, e);
}

int slp_level_exposure(slp_level *level, const double *path, size_t path_count,
                       const double *points, const int64_t *ends, size_t count, int is_area,
                       double *rows) {
    sl_context *context = level->base.context;
    SL_TRY(slp_level_queries(level, 1));
    const size_t point_count = count ? (size_t)ends[count - 1] : 0;
    sl_point *all = sl_alloc_array(context, path_count + point_count, sizeof *all);
    size_t *own = sl_alloc_array(context, count, sizeof *own);
    sl_exposed *things = sl_alloc_array(context, count, sizeof *things);
    sl_exposure *exposures = sl_alloc_array(context, count, sizeof *exposures);
    sl_status status = all && own && things && exposures ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        for (size_t i = 0; i < path_count; i++) all[i] = (sl_point){path[2 * i], path[2 * i + 1]};
        for (size_t i = 0; i < point_count; i++)
            all[path_count + i] = (sl_point){points[2 * i], points[2 * i + 1]};
        for (size_t i = 0, from = 0; i < count; from = (size_t)ends[i++]) {
            own[i] = (size_t)ends[i] - from;
            things[i] = (sl_exposed){{all + path_count + from, &own[i], 1}, is_area};
        }
        status = sl_exposure_make(context, level->queries.items[0], all, path_count, things, count,
                                  exposures);
    }
    for (size_t i = 0; status == SL_OK && i < count; i++)
        put_exposure(context, &exposures[i], rows + 5 * i);
    sl_free(context, exposures);
    sl_free(context, things);
    sl_free(context, own);
    sl_free(context, all);
    return status;
}

int slp_level_sees_within(slp_level *level, const double *from, double from_radius,
                          const double *to, double to_radius, size_t count, int on_foot,
                          uint8_t *sees) {
    sl_context *context = level->base.context;
    sl_reach *reach;
    SL_TRY(slp_level_queries(level, 1));
    SL_TRY(sl_reach_create(context, level->queries.items[0], &reach));
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        const sl_point a = {from[2 * i], from[2 * i + 1]}, b = {to[2 * i], to[2 * i + 1]};
        bool seen = false;
        status = sl_reach_sees_within(context, reach, a, from_radius, b, to_radius,
                                      on_foot ? SL_REACH_ON_FOOT : SL_REACH_STRAIGHT, &seen);
        sees[i] = seen;
        if (status == SL_OK && i % 256 == 0) status = sl_check_cancelled(context);
    }
    sl_reach_destroy(context, reach);
    return status;
}
