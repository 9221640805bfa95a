/// The sight of a set: its settings, and single points that are seen from it.
#include "analysis/set_sight/set_sight.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "geometry/orient.h"

#include <math.h>
#include <string.h>

// --- the set

static sl_status check_points(sl_context *context, const sl_space *space, const sl_point *points,
                              size_t count) {
    if (!count) return sl_fail(context, SL_BAD_ARGUMENT, "a set needs a point to look from");
    for (size_t i = 0; i < count; i++)
        if (!isfinite(points[i].x) || !isfinite(points[i].y) ||
            !sli_box_holds(&space->bounds, points[i]))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "point %zu of the set, %.9g,%.9g, is outside the map's bounds", i + 1,
                           points[i].x, points[i].y);
    return SL_OK;
}

/// Takes the corners counter-clockwise, without those that are straight or repeated.
static void take_corners(sl_set_sight *s, const sl_point *points, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!sli_corner_repeats(points, count, i)) s->points[s->count++] = points[i];
        while (s->count > 2 &&
               sli_goes_on(s->points[s->count - 3], s->points[s->count - 2],
                           s->points[s->count - 1]) &&
               sli_orient(s->points[s->count - 3], s->points[s->count - 2],
                          s->points[s->count - 1]) == 0) {
            s->points[s->count - 2] = s->points[s->count - 1];
            s->count--;
        }
    }
}

static int side_of_corner(const sl_set_sight *s, size_t i) {
    const size_t n = s->count;
    return sli_orient(s->points[i], s->points[(i + 1) % n], s->points[(i + 2) % n]);
}

/// A closed polygon is convex if it turns one way only, and goes around once: as seen from its
/// first corner, all others come in order.
static bool is_convex(const sl_set_sight *s, int turn) {
    for (size_t i = 0; i < s->count; i++)
        if (side_of_corner(s, i) == -turn) return false;
    for (size_t i = 1; i + 1 < s->count; i++)
        if (sli_orient(s->points[0], s->points[i], s->points[i + 1]) == -turn) return false;
    return true;
}

static sl_status take_area(sl_context *context, sl_set_sight *s, const sl_point *points,
                           size_t count) {
    take_corners(s, points, count);
    int turn = 0;
    for (size_t i = 0; i < s->count && !turn; i++) turn = side_of_corner(s, i);
    if (!turn)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the area to look from has its corners in one line");
    if (!is_convex(s, turn))
        return sl_fail(context, SL_BAD_ARGUMENT, "the area to look from is not convex");
    for (size_t i = 0; turn < 0 && i < s->count / 2; i++) {
        const sl_point keep = s->points[i];
        s->points[i] = s->points[s->count - 1 - i];
        s->points[s->count - 1 - i] = keep;
    }
    return SL_OK;
}

static bool lies_between(sl_segment s, sl_point p) {
    const sl_box box = {{sli_lesser(s.a.x, s.b.x), sli_lesser(s.a.y, s.b.y)},
                        {sli_greater(s.a.x, s.b.x), sli_greater(s.a.y, s.b.y)}};
    return sli_box_holds(&box, p) && sli_orient(s.a, s.b, p) == 0;
}

/// Ends of walls that lie on the set: sight of single points of it.
static sl_status find_ends(sl_context *context, sl_set_sight *s) {
    for (size_t k = 0; k < sli_segment_count(s); k++)
        for (uint32_t i = 0; i < s->stop_count; i++) {
            const sl_point ends[2] = {sli_side(&s->rooms, s->stops[i])->start,
                                      sli_side_end(&s->rooms, s->stops[i])};
            for (int side = 0; side < 2; side++) {
                if (!lies_between(sli_segment(s, k), ends[side])) continue;
                SL_TRY(SL_ARRAY_ROOM(context, &s->ends, 1));
                s->ends.items[s->ends.count++] = ends[side];
            }
        }
    return SL_OK;
}

/// What the sides of the outline stop: it is asked again and again.
static sl_status find_stops(sl_context *context, sl_set_sight *s) {
    const uint32_t sides = s->rooms.outline->side_count;
    s->stops = sl_alloc_array(context, (size_t)sides + 1, sizeof *s->stops);
    s->touched =
        sl_alloc_array(context, sl_eye_words(s->rooms.outline->space) + 1, sizeof *s->touched);
    if (!s->stops || !s->touched) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < sides; i++)
        if (!sli_side_passes(&s->rooms, i, false) || !sli_side_passes(&s->rooms, i, true))
            s->stops[s->stop_count++] = i;
    return find_ends(context, s);
}

static sl_status check_settings(sl_context *context, sl_query *query, const sl_outline **outline) {
    const sl_space *space;
    const uint32_t *parents = NULL;
    const char *what = NULL;
    SL_TRY(sl_query_space(context, query, &space, &parents));
    SL_TRY(sl_query_outline(context, query, outline));
    if (sl_query_map(query)->mirror_count)
        what = "mirrors";
    else if (parents)
        what = "boxes that block";
    else if ((*outline)->limited)
        what = "limited walls";
    else if (space->loose)
        what = "a loose space";
    if (!what) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED, "sight from a line or an area does not support %s",
                   what);
}

static sl_status fill(sl_context *context, sl_set_sight *s, const sl_point *points, size_t count) {
    const sl_outline *outline;
    SL_TRY(check_settings(context, s->query, &outline));
    SL_TRY(check_points(context, outline->space, points, count));
    s->range = sl_query_range(s->query);
    sli_range_directions(s->directions);
    s->points = sl_alloc_array(context, count, sizeof *s->points);
    if (!s->points) return SL_NO_MEMORY;
    if (s->kind == SL_SET_AREA)
        SL_TRY(take_area(context, s, points, count));
    else {
        memcpy(s->points, points, count * sizeof *points);
        s->count = count;
    }
    SL_TRY(sli_beam_rooms_make(context, outline, &s->rooms));
    return find_stops(context, s);
}

sl_status sl_set_sight_create(sl_context *context, sl_query *query, const sl_point *points,
                              size_t count, sl_set_kind kind, sl_set_sight **out) {
    sl_set_sight *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->query = query;
    s->kind = kind;
    const sl_status status = fill(context, s, points, count);
    if (status == SL_OK)
        *out = s;
    else
        sl_set_sight_destroy(context, s);
    return status;
}

void sl_set_sight_destroy(sl_context *context, sl_set_sight *sight) {
    if (!sight) return;
    sli_beam_rooms_destroy(context, &sight->rooms);
    sl_free(context, sight->points);
    sl_free(context, sight->walk.frames.items);
    sl_free(context, sight->spot.rooms.items);
    sl_free(context, sight->spot.blocks.items);
    sl_free(context, sight->corner.rooms.items);
    sl_free(context, sight->corner.blocks.items);
    sl_free(context, sight->seen.items);
    sl_free(context, sight->cuts.items);
    sl_free(context, sight->ends.items);
    sl_free(context, sight->touched);
    sl_free(context, sight->stops);
    sl_free(context, sight);
}

size_t sl_set_of_disc(sl_point middle, double radius, double tolerance, sl_point *points,
                      size_t room) {
    const double turn = 8 * atan(1), half = acos(fmax(-1, 1 - tolerance / radius));
    const size_t count = (size_t)fmin(4096, fmax(3, ceil(turn / (2 * half))));
    for (size_t i = 0; i < count && i < room; i++) {
        const double angle = turn * (double)i / (double)count;
        points[i] = (sl_point){middle.x + radius * cos(angle), middle.y + radius * sin(angle)};
    }
    return count;
}

// --- single points

static bool holds(const sl_set_sight *s, sl_point p) {
    for (size_t i = 0; i < s->count; i++) {
        const sl_segment at = sli_segment(s, i);
        if (sli_orient(at.a, at.b, p) < 0) return false;
    }
    return true;
}

/// Whether a point of the set and another one see each other. Neither has a side.
static sl_status sees_point(sl_context *context, sl_set_sight *s, sl_point from, sl_point to,
                            bool *out) {
    if (s->rooms.outline->lit) return sl_query_sees(context, s->query, from, to, out);
    SL_TRY(sl_query_sees(context, s->query, to, from, out));
    return *out ? SL_OK : sl_query_sees(context, s->query, from, to, out);
}

/// Whether all points of the set are in range of a point: its corners, and so what is between them.
static bool is_all_in_range(const sl_set_sight *s, sl_point point) {
    for (size_t i = 0; s->range > 0 && i < s->count; i++)
        if (sli_distance_compare(point, s->points[i], s->range) > 0) return false;
    return true;
}

static sl_status sees_segment(sl_context *context, sl_set_sight *s, sl_segment segment,
                              sl_set_seen seen, const sli_spot *spot, bool *out) {
    const bool some = seen == SL_SEEN_FROM_SOME;
    *out = some && lies_between(segment, spot->at);
    if (*out) return SL_OK;
    if (sli_orient(segment.a, segment.b, spot->at) != 0) {
        bool piece, whole;
        SL_TRY(sli_reach(context, s, spot, segment, &piece, &whole));
        *out = some ? piece : whole;
        if (*out || !some) return SL_OK;
    }
    bool a, b;
    SL_TRY(sees_point(context, s, segment.a, spot->at, &a));
    SL_TRY(sees_point(context, s, segment.b, spot->at, &b));
    *out = some ? a || b : a && b;
    return SL_OK;
}

sl_status sl_set_sight_sees(sl_context *context, sl_set_sight *sight, sl_set_seen seen,
                            sl_point point, bool *out) {
    *out = false;
    if (!isfinite(point.x) || !isfinite(point.y) ||
        !sli_box_holds(&sight->rooms.outline->space->bounds, point))
        return SL_OK;
    SL_TRY(sli_spot_find(context, sight, point, &sight->spot));
    if (!sight->spot.rooms.count) return SL_OK;
    const bool some = seen == SL_SEEN_FROM_SOME;
    sight->within = some ? sight->range : 0;
    if (!some && !is_all_in_range(sight, point)) return SL_OK;
    if (sight->kind == SL_SET_LINE && sight->count == 1)
        return sees_point(context, sight, sight->points[0], point, out);
    if (some && sight->kind == SL_SET_AREA && holds(sight, point)) {
        *out = true;
        return SL_OK;
    }
    for (size_t i = 0; i < sli_segment_count(sight); i++) {
        SL_TRY(sees_segment(context, sight, sli_segment(sight, i), seen, &sight->spot, out));
        if (*out == some) return SL_OK;
    }
    for (size_t i = 0; some && !*out && i < sight->ends.count; i++)
        SL_TRY(sees_point(context, sight, sight->ends.items[i], point, out));
    return SL_OK;
}
