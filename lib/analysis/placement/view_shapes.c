/// The regions of viewpoints as shapes.
///
///     +---------------+        A region with a dead zone is a shape with a hole: the region up to
///     |     ____      |        the range, counter-clockwise, and that up to the dead zone,
///     |    /    \     |        clockwise. Both look from one eye, so one lies within the other.
///     |   ( (o)  )    |
///     |    \____/     |        An arc becomes chords. Those of the range lie within the arc, those
///     +---------------+        of the dead zone about it: what is doubtful counts as not seen.
///
/// Chords are sides of one regular polygon in the circle. So where the edges at both ends of an arc
/// point to the eye, as windows and the sides of a field of view do, views from one eye leave the
/// same in doubt: none has a sliver that another one does not have. At other edges, as walls, they
/// may differ.
///
/// Of a sign it is the region all round, and what of it is within a disc.
#include "analysis/placement/view_shapes.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sight/cone.h"

#include <math.h>

/// How far the chord of an arc may be off it, as a share of the radius.
#define CHORD 1e-4
/// The corners of the polygon in a circle, and of a sign's disc: chords are not so far off.
enum { CORNERS = 256 };
/// A sign counts so far before its place, as a share of the largest coordinate.
#define BEFORE 0x1p-44

sl_status sli_check_viewpoints(sl_context *context, const sl_viewpoint *viewpoints, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sl_viewpoint *v = &viewpoints[i];
        const bool cone = v->fov > 0 && v->fov <= 360 && isfinite(v->heading);
        const bool reach = v->range >= 0 && v->nearest >= 0 && isfinite(v->range + v->nearest);
        if (v->sign && !(v->range > 0))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "viewpoint %zu: a sign needs a range, how far it is read", i + 1);
        if (!cone || !reach || !isfinite(v->at.x) || !isfinite(v->at.y))
            return sl_fail(context, SL_BAD_ARGUMENT, "viewpoint %zu: %s", i + 1,
                           !cone    ? "the field of view must be over 0 and up to 360 degrees"
                           : !reach ? "range and dead zone must be 0 or more, and finite"
                                    : "its place must be finite");
    }
    return SL_OK;
}

sl_status sli_refuse_signs(sl_context *context, const sl_viewpoint *viewpoints, size_t count,
                           const char *what) {
    for (size_t i = 0; i < count; i++)
        if (viewpoints[i].sign)
            return sl_fail(context, SL_UNSUPPORTED, "viewpoint %zu is a sign: %s knows none", i + 1,
                           what);
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

// --- arcs

static double out_of(sl_point a, sl_point b, sl_point p) {
    return sli_cross((sl_point){p.x - a.x, p.y - a.y}, (sl_point){b.x - a.x, b.y - a.y});
}

/// A corner of the polygon in the circle of a region's range, less the eye; of numbers that are
/// CORNERS apart the same.
static sl_point corner_of(const sl_region *r, int number) {
    const double angle = (number & (CORNERS - 1)) * (8 * atan(1) / CORNERS);
    return (sl_point){r->range * cos(angle), r->range * sin(angle)};
}

/// The corner before an end of an arc; numbers go around from -CORNERS / 2 on.
static int corner_before(sl_point end) {
    return (int)floor(atan2(end.y, end.x) * (CORNERS / (8 * atan(1))));
}

/// Where the edge between an end of an arc and the point `other` leaves the polygon. Where it is
/// outside all along, the point straight before the end.
static sl_point leave_at(const sl_region *r, sl_point end, sl_point other) {
    const int before = corner_before(end);
    const sl_point a = corner_of(r, before), b = corner_of(r, before + 1);
    if (out_of(a, b, other) >= 0) other = (sl_point){0, 0};
    const double from = out_of(a, b, other), to = out_of(a, b, end);
    const double share = to > 0 ? from / (from - to) : 1;
    return (sl_point){other.x + share * (end.x - other.x), other.y + share * (end.y - other.y)};
}

static sl_status add_point(sl_context *context, sl_point from, sl_point way, sli_view_shapes *s) {
    SL_TRY(SL_ARRAY_ROOM(context, &s->points, 1));
    s->points.items[s->points.count++] = (sl_point){from.x + way.x, from.y + way.y};
    return SL_OK;
}

/// The corners of a region, with chords in place of arcs.
static sl_status add_corners(sl_context *context, const sl_region *r, sli_view_shapes *s) {
    const sl_point eye = r->view.eye, none = {0, 0};
    for (size_t i = 0; i < r->count; i++) {
        const size_t before = (i ? i : r->count) - 1, after = i + 1 < r->count ? i + 1 : 0;
        const bool ends = r->edges[before].kind == SL_EDGE_ARC;
        const bool starts = r->edges[i].kind == SL_EDGE_ARC;
        const sl_point from = r->offsets[i], to = r->offsets[after];
        if (!starts && !ends) {
            SL_TRY(add_point(context, r->points[i], none, s));
            continue;
        }
        const sl_point other = !starts ? to : ends ? none : r->offsets[before];
        SL_TRY(add_point(context, eye, leave_at(r, from, other), s));
        if (!starts) continue;
        // Up to half a circle; rounded, an end may be a little before its start.
        const int number = corner_before(from),
                  passed = (corner_before(to) - number) & (CORNERS - 1);
        for (int k = 1; k <= passed && passed <= CORNERS / 2 + 1; k++)
            SL_TRY(add_point(context, eye, corner_of(r, number + k), s));
    }
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
    const size_t first = s->points.count;
    SL_TRY(add_corners(context, region, s));
    const size_t count = s->points.count - first;
    if (!count) return SL_OK;
    sl_point *const loop = s->points.items + first;
    for (size_t i = 0; clockwise && i < count / 2; i++) {
        const sl_point last = loop[count - 1 - i];
        loop[count - 1 - i] = loop[i];
        loop[i] = last;
    }
    return end_loop(context, s);
}

// --- signs

static sl_point ahead(sl_point from, double heading, double way) {
    const double degree = atan(1) / 45;
    return (sl_point){from.x + way * cos(heading * degree), from.y + way * sin(heading * degree)};
}

sl_point sli_viewpoint_eye(const sl_space *space, const sl_viewpoint *v) {
    const sl_box *b = &space->bounds;
    const double largest =
        fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
    return v->sign ? ahead(v->at, v->heading, BEFORE * largest) : v->at;
}

sl_point sli_sign_middle(sl_point eye, const sl_viewpoint *v) {
    return ahead(eye, v->heading, v->range / 2);
}

bool sli_viewpoint_holds(const sl_viewpoint *v, const sl_view *view, sl_point place) {
    if (v->range > 0 && sli_distance_compare(view->eye, place, v->range) > 0) return false;
    if (v->nearest > 0 && sli_distance_compare(view->eye, place, v->nearest) < 0) return false;
    if (v->sign)
        return sli_distance_compare(sli_sign_middle(view->eye, v), place, v->range / 2) <= 0;
    return view->full || sli_same_point(view->eye, place) || sli_view_holds(view, place);
}

/// What of the loop behind the last shape is within the disc of a sign takes its place.
static sl_status keep_disc(sl_context *context, sl_point eye, const sl_viewpoint *v, size_t first,
                           sli_view_shapes *s) {
    const size_t loop = s->points.count - first, disc = CORNERS;
    const sl_point middle = sli_sign_middle(eye, v);
    sl_point corners[CORNERS];
    for (int i = 0; i < CORNERS; i++)
        corners[i] = ahead(middle, v->heading + 180 + i * 360.0 / CORNERS, v->range / 2);
    const sl_shape both[2] = {{s->points.items + first, &loop, 1}, {corners, &disc, 1}};
    sl_overlay overlay;
    sl_shape read = {0};
    SL_TRY(sl_overlay_make(context, NULL, both, 2, &overlay));
    sl_status status = sl_overlay_outline(context, &overlay, 2, &read);
    sl_overlay_destroy(context, &overlay);
    s->points.count = first;
    s->ends.count--;
    for (size_t i = 0, next = 0; status == SL_OK && i < read.count; i++) {
        for (; status == SL_OK && next < read.ends[i]; next++)
            status = add_point(context, read.points[next], (sl_point){0, 0}, s);
        if (status == SL_OK) status = end_loop(context, s);
    }
    sl_shape_destroy(context, &read);
    return status;
}

static sl_status add_sign(sl_context *context, sl_query *query, const sl_viewpoint *v,
                          sl_region *region, sli_view_shapes *s) {
    const sl_map *map = sl_query_map(query);
    const sl_space *space;
    if (map && map->oneway_count)
        return sl_fail(context, SL_UNSUPPORTED, "signs do not support one-way glass: leave it out");
    SL_TRY(sl_query_space(context, query, &space, NULL));
    const size_t first = s->points.count;
    // Chords of the range are beyond the disc.
    sl_viewpoint around = {
        .at = sli_viewpoint_eye(space, v), .fov = 360, .range = v->range * (1 + 2 * CHORD)};
    around.range = sli_view_range(query, &around);
    SL_TRY(add_loop(context, query, &around, around.range, false, region, s));
    if (s->points.count > first) SL_TRY(keep_disc(context, around.at, v, first, s));
    return end_shape(context, s);
}

sl_status sli_view_shapes_add(sl_context *context, sl_query *query, const sl_viewpoint *v,
                              sl_region *region, sli_view_shapes *s) {
    if (v->sign) return add_sign(context, query, v, region, s);
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
        const sl_point none = {0, 0};
        SL_TRY(add_point(context, space->walls[w].a, none, s));
        SL_TRY(add_point(context, space->walls[w].b, none, s));
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
