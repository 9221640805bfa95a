/// The regions of viewpoints as shapes.
///
///     +---------------+        A region with a dead zone is a shape with a hole: the region up to
///     |     ____      |        the range, counter-clockwise, and that up to the dead zone,
///     |    /    \     |        clockwise. Both look from one eye, so one lies within the other.
///     |   ( (o)  )    |
///     |    \____/     |        An arc becomes chords. Those of the range lie within the arc, those
///     +---------------+        of the dead zone about it: what is doubtful counts as not seen.
#include "analysis/placement/view_shapes.h"

#include <math.h>

/// How far the chord of an arc may be off it, as a share of the radius.
#define CHORD 1e-4

sl_status sli_check_viewpoints(sl_context *context, const sl_viewpoint *viewpoints, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_viewpoint *v = &viewpoints[i];
        const bool cone = v->fov > 0 && v->fov <= 360 && isfinite(v->heading);
        const bool reach = v->range >= 0 && v->nearest >= 0 && isfinite(v->range + v->nearest);
        if (!cone || !reach || !isfinite(v->at.x) || !isfinite(v->at.y))
            return sl_fail(context, SL_BAD_ARGUMENT, "viewpoint %zu: %s", i + 1,
                           !cone    ? "the field of view must be over 0 and up to 360 degrees"
                           : !reach ? "range and dead zone must be 0 or more, and finite"
                                    : "its place must be finite");
    }
    return SL_OK;
}

double sli_view_range(const sl_query *query, const sl_viewpoint *v) {
    const double most = sl_query_range(query);
    return most > 0 && !(v->range > 0 && v->range < most) ? most : v->range;
}

static sl_status end_loop(sl_context *context, sli_view_shapes *s) {
    const size_t shape = s->shape_points.count;
    SL_TRY(SL_ARRAY_ROOM(context, &s->ends, 1));
    s->ends.items[s->ends.count++] =
        s->points.count - (shape ? s->shape_points.items[shape - 1] : 0);
    return SL_OK;
}

static sl_status end_shape(sl_context *context, sli_view_shapes *s) {
    SL_TRY(SL_ARRAY_ROOM(context, &s->shape_points, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &s->shape_loops, 1));
    s->shape_points.items[s->shape_points.count++] = s->points.count;
    s->shape_loops.items[s->shape_loops.count++] = s->ends.count;
    return SL_OK;
}

/// Adds the region of a viewpoint up to a range as a loop.
static sl_status add_loop(sl_context *context, sl_query *query, const sl_viewpoint *v, double range,
                          bool clockwise, sl_region *region, sli_view_shapes *s) {
    const double most = sl_query_range(query);
    const sl_view view = sl_query_view(query, v->at, v->heading, v->fov);
    SL_TRY(sl_query_set_range(context, query, range));
    const sl_status status = sl_query_region(context, query, &view, region);
    SL_TRY(sl_query_set_range(context, query, most));
    SL_TRY(status);
    const double tolerance = CHORD * range;
    const size_t count = sl_region_flatten(region, tolerance, NULL, 0);
    if (!count) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &s->points, count));
    sl_point *const loop = s->points.items + s->points.count;
    sl_region_flatten(region, tolerance, loop, count);
    s->points.count += count;
    for (size_t i = 0; clockwise && i < count / 2; i++) {
        const sl_point last = loop[count - 1 - i];
        loop[count - 1 - i] = loop[i];
        loop[i] = last;
    }
    return end_loop(context, s);
}

sl_status sli_view_shapes_add(sl_context *context, sl_query *query, const sl_viewpoint *v,
                              sl_region *region, sli_view_shapes *s) {
    const double range = sli_view_range(query, v);
    // As much farther as a chord may come nearer, and more.
    const double nearest = v->nearest * (1 + 2 * CHORD);
    if (!(range > 0 && nearest >= range)) {
        SL_TRY(add_loop(context, query, v, range, false, region, s));
        if (nearest > 0) SL_TRY(add_loop(context, query, v, nearest, true, region, s));
    }
    return end_shape(context, s);
}

sl_status sli_view_shapes_add_walls(sl_context *context, const sl_space *space,
                                    sli_view_shapes *s) {
    for (uint32_t w = 0; w < space->wall_count; w++) {
        SL_TRY(SL_ARRAY_ROOM(context, &s->points, 2));
        s->points.items[s->points.count++] = space->walls[w].a;
        s->points.items[s->points.count++] = space->walls[w].b;
        SL_TRY(end_loop(context, s));
    }
    return end_shape(context, s);
}

sl_shape sli_view_shape(const sli_view_shapes *s, size_t number) {
    const size_t point = number ? s->shape_points.items[number - 1] : 0;
    const size_t loop = number ? s->shape_loops.items[number - 1] : 0;
    return (sl_shape){s->points.items ? s->points.items + point : NULL,
                      s->ends.items ? s->ends.items + loop : NULL,
                      s->shape_loops.items[number] - loop};
}

void sli_view_shapes_destroy(sl_context *context, sli_view_shapes *s) {
    sl_free(context, s->points.items);
    sl_free(context, s->ends.items);
    sl_free(context, s->shape_points.items);
    sl_free(context, s->shape_loops.items);
    *s = (sli_view_shapes){0};
}
