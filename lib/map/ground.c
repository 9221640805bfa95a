/// Solid ground: polygons become walls with marks, and marked walls become polygons again.
///
/// A polygon of solid ground is a loop of walls with solid ground at the left; one of open ground
/// that is cut out of solid ground is such a loop the other way round:
///
///     +---<---+   counter-clockwise:      +--->---+   clockwise:
///     | solid |   solid inside            |       |   solid outside
///     +--->---+                           +---<---+
///
/// The way back follows marked walls from end to end. Where several go on, the loop takes the first
/// one clockwise from where it came from, so that solid areas that touch in a corner stay apart.
/// Loops that are not closed or cross themselves are given wall by wall. Time O(n log n).
#include "map/ground.h"

#include "geometry/orient.h"
#include "map/planar.h"
#include "sightline/support.h"

#include <stdlib.h>
#include <string.h>

#define NONE SIZE_MAX

// --- from polygons to walls

static sl_point corner_at(const sl_point *corners, size_t count, size_t i) {
    return corners[i % count];
}

/// 1 for a loop that runs counter-clockwise, -1 for clockwise, 0 where its lowest corner is the tip
/// of a spike or the loop has no area. Exact for a loop whose sides do not cross.
static int direction_of(const sl_point *corners, size_t count) {
    size_t low = 0;
    for (size_t i = 1; i < count; i++)
        if (sli_compare_points(corners[i], corners[low]) < 0) low = i;
    size_t next = 1, before = 1;
    while (next < count && sli_same_point(corner_at(corners, count, low + next), corners[low]))
        next++;
    while (before < count &&
           sli_same_point(corner_at(corners, count, low + count - before), corners[low]))
        before++;
    return sli_orient(corner_at(corners, count, low + count - before), corners[low],
                      corner_at(corners, count, low + next));
}

/// Whether sides of a loop cross each other.
static sl_status find_crossing(sl_context *context, const sl_point *corners, size_t count,
                               bool *crosses) {
    sl_segment *sides = sl_alloc_array(context, count, sizeof *sides);
    if (!sides) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        sides[i] = (sl_segment){corners[i], corner_at(corners, count, i + 1)};
    sli_planar graph = {0};
    const sl_status status = sli_planar_make(context, "the polygon", sides, count, 0, &graph);
    *crosses = graph.crossings > 0;
    sli_planar_destroy(context, &graph);
    sl_free(context, sides);
    return status;
}

sl_status sli_map_add_ground(sl_context *context, sl_map *map, const char *source, bool open,
                             const sl_point *corners, size_t count, uint32_t line) {
    const char *what = open ? "open" : "solid";
    if (count < 3)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: expected at least 3 corners", what);
    bool crosses;
    SL_TRY(find_crossing(context, corners, count, &crosses));
    if (crosses)
        return sl_fail_at(context, source, line, "%s: sides of the polygon cross each other", what);
    const int direction = direction_of(corners, count);
    if (direction == 0)
        return sl_fail_at(context, source, line,
                          "%s: expected a polygon with an area, without spikes", what);
    const uint32_t forward = open ? SL_SOLID_RIGHT | SL_OPEN_LEFT : SL_SOLID_LEFT;
    const uint32_t ground = direction > 0 ? forward : sl_ground_turned(forward);
    for (size_t i = 0; i < count; i++) {
        SL_TRY(sl_map_add_wall(context, map, corners[i], corner_at(corners, count, i + 1), line));
        map->walls[map->wall_count - 1].ground = ground;
    }
    return SL_OK;
}

static const char *source_of(const sl_map *map) {
    return map->source ? map->source : "the map";
}

sl_status sl_map_add_solid(sl_context *context, sl_map *map, const sl_point *corners, size_t count,
                           uint32_t line) {
    return sli_map_add_ground(context, map, source_of(map), false, corners, count, line);
}

sl_status sl_map_add_open(sl_context *context, sl_map *map, const sl_point *corners, size_t count,
                          uint32_t line) {
    return sli_map_add_ground(context, map, source_of(map), true, corners, count, line);
}

// --- from walls to polygons

/// A wall, with solid ground at its left going from `from` to `to`.
typedef struct side {
    sl_point from, to;
    size_t wall;
    bool open; ///< open ground is at its right
    bool used;
} side;

typedef struct tracer {
    sl_context *context;
    const sli_loop_user *user;
    side *sides; ///< by `from`
    size_t count;
    SL_ARRAY(size_t) way; ///< the sides of the loop so far
    SL_ARRAY(sl_point) corners;
} tracer;

static int compare_sides(const void *left, const void *right) {
    const side *a = left, *b = right;
    const int order = sli_compare_points(a->from, b->from);
    return order ? order : (a->wall > b->wall) - (a->wall < b->wall);
}

/// The sides that start at a point: the first of them, and *end behind the last.
static size_t sides_from(const tracer *t, sl_point at, size_t *end) {
    size_t low = 0, high = t->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sli_compare_points(t->sides[middle].from, at) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    for (*end = low; *end < t->count && sli_same_point(t->sides[*end].from, at);) ++*end;
    return low;
}

/// Of the clockwise angle from the direction of `back` to that of `to`, seen from `at`: 0 below a
/// half turn, 1 for one, 2 above, 3 for none.
static int quarter(sl_point at, sl_point back, sl_point to) {
    const int turn = sli_orient(at, back, to);
    if (turn) return turn < 0 ? 0 : 2;
    const bool same =
        (back.x - at.x > 0) == (to.x - at.x > 0) && (back.x - at.x < 0) == (to.x - at.x < 0) &&
        (back.y - at.y > 0) == (to.y - at.y > 0) && (back.y - at.y < 0) == (to.y - at.y < 0);
    return same ? 3 : 1;
}

/// The side on which a loop goes on; NONE where it ends.
static size_t next_side(const tracer *t, const side *last) {
    size_t end, best = NONE;
    int best_quarter = 4;
    for (size_t i = sides_from(t, last->to, &end); i < end; i++) {
        if (t->sides[i].used) continue;
        const int own = quarter(last->to, last->from, t->sides[i].to);
        if (best == NONE || own < best_quarter ||
            (own == best_quarter && sli_orient(last->to, t->sides[best].to, t->sides[i].to) > 0)) {
            best = i;
            best_quarter = own;
        }
    }
    return best;
}

/// Gives what was traced: as a polygon, if it can be read back as one, or else wall by wall.
static sl_status give(tracer *t, bool closed) {
    const size_t count = t->way.count;
    bool whole = closed && count >= 3, open = true;
    t->corners.count = 0;
    SL_TRY(SL_ARRAY_ROOM(t->context, &t->corners, count));
    for (size_t i = 0; i < count; i++) {
        t->corners.items[t->corners.count++] = t->sides[t->way.items[i]].from;
        open &= t->sides[t->way.items[i]].open;
    }
    const int direction = whole ? direction_of(t->corners.items, count) : 0;
    whole = direction > 0 || (direction < 0 && open);
    bool crosses = false;
    if (whole) SL_TRY(find_crossing(t->context, t->corners.items, count, &crosses));
    if (whole && !crosses)
        return t->user->polygon(t->user->user, t->corners.items, count, direction > 0);
    for (size_t i = 0; i < count; i++) {
        const side *s = &t->sides[t->way.items[i]];
        SL_TRY(t->user->wall(t->user->user, s->from, s->to));
    }
    return SL_OK;
}

static sl_status trace(tracer *t, size_t first) {
    t->way.count = 0;
    for (size_t at = first; at != NONE;) {
        SL_TRY(SL_ARRAY_ROOM(t->context, &t->way, 1));
        t->way.items[t->way.count++] = at;
        t->sides[at].used = true;
        if (sli_same_point(t->sides[at].to, t->sides[first].from)) return give(t, true);
        at = next_side(t, &t->sides[at]);
    }
    return give(t, false);
}

sl_status sli_ground_trace(sl_context *context, const sl_wall *walls, size_t count,
                           const sli_loop_user *user) {
    tracer t = {.context = context, .user = user};
    t.sides = sl_alloc_array(context, 2 * count, sizeof *t.sides);
    if (!t.sides) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const sl_wall *w = &walls[i];
        if (sli_same_point(w->a, w->b)) continue;
        if (w->ground & SL_SOLID_LEFT)
            t.sides[t.count++] = (side){w->a, w->b, i, w->ground & SL_OPEN_RIGHT, false};
        if (w->ground & SL_SOLID_RIGHT)
            t.sides[t.count++] = (side){w->b, w->a, i, w->ground & SL_OPEN_LEFT, false};
    }
    if (t.count) qsort(t.sides, t.count, sizeof *t.sides, compare_sides);
    sl_status status = SL_OK;
    for (size_t i = 0; i < t.count && status == SL_OK; i++) {
        if (i % 1024 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK && !t.sides[i].used) status = trace(&t, i);
    }
    sl_free(context, t.sides);
    sl_free(context, t.way.items);
    sl_free(context, t.corners.items);
    return status;
}
