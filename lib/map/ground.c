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
/// Open rooms that share a wall become one, with this wall in it.
/// Loops that are not closed or cross themselves are given wall by wall. Time O(n log n).
#include "map/ground.h"

#include "geometry/orient.h"
#include "map/planar.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/support.h"

#include <stdlib.h>
#include <string.h>

#define NONE SIZE_MAX

// --- from polygons to walls

/// What a loop of sides is, as a polygon.
typedef enum loop_kind {
    LOOP_FLAT,      ///< it has no area, or spikes
    LOOP_CROSSED,   ///< its sides cross, or it runs twice round a place
    LOOP_LEFT,      ///< counter-clockwise
    LOOP_CLOCKWISE, ///< clockwise
} loop_kind;

/// An edge of the loop's graph in one direction; number 2 * edge, plus 1 for the way back.
typedef struct half {
    sl_point at, to;
    uint32_t number;
} half;

/// The graph of one loop, which is connected. Each half-edge has a face at its left.
typedef struct loop {
    sli_planar graph;
    half *halves;    ///< by `at`, then counter-clockwise
    uint32_t *place; ///< by number: where it is in `halves`
    int32_t *passes; ///< by number: how often the loop runs along it
    int32_t *turns;  ///< by number: how often the loop runs round the face at its left
    uint32_t *stack;
    bool *known;
} loop;

/// From just right of straight down all the way round.
static int compare_halves(const void *left, const void *right) {
    const half *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    if (order) return order;
    const int back_a = sli_compare_points(a->to, a->at) < 0;
    const int back_b = sli_compare_points(b->to, b->at) < 0;
    return back_a != back_b ? back_a - back_b : -sli_orient(a->at, a->to, b->to);
}

static sl_status make_loop(sl_context *context, const sl_point *corners, size_t count, loop *l) {
    sl_segment *sides = sl_alloc_array(context, count, sizeof *sides);
    if (!sides) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        sides[i] = (sl_segment){corners[i], corners[i + 1 < count ? i + 1 : 0]};
    const sl_status status = sli_planar_make(context, "the polygon", sides, count, 0, &l->graph);
    sl_free(context, sides);
    SL_TRY(status);
    const size_t halves = 2 * l->graph.edge_count;
    l->halves = sl_alloc_array(context, halves, sizeof *l->halves);
    l->place = sl_alloc_array(context, halves, sizeof *l->place);
    l->passes = sl_alloc_array(context, halves, sizeof *l->passes);
    l->turns = sl_alloc_array(context, halves, sizeof *l->turns);
    l->stack = sl_alloc_array(context, halves, sizeof *l->stack);
    l->known = sl_alloc_array(context, halves, sizeof *l->known);
    if (!l->halves || !l->place || !l->passes || !l->turns || !l->stack || !l->known)
        return SL_NO_MEMORY;
    for (uint32_t i = 0; i < halves; i++) {
        const sl_segment at = sli_planar_at(&l->graph, i);
        l->halves[i] = (half){at.a, at.b, i};
    }
    if (halves) qsort(l->halves, halves, sizeof *l->halves, compare_halves);
    for (uint32_t i = 0; i < halves; i++) l->place[l->halves[i].number] = i;
    for (size_t i = 0; i < l->graph.first[count]; i++) l->passes[l->graph.links[i]]++;
    return SL_OK;
}

static void destroy_loop(sl_context *context, loop *l) {
    sli_planar_destroy(context, &l->graph);
    void *const parts[] = {l->halves, l->place, l->passes, l->turns, l->stack, l->known};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

/// The next half-edge of the face at the left: the first one clockwise from the way back.
static uint32_t next_of_face(const loop *l, uint32_t number) {
    const uint32_t back = l->place[number ^ 1];
    const sl_point at = l->halves[back].at;
    if (back > 0 && sli_same_point(l->halves[back - 1].at, at)) return l->halves[back - 1].number;
    uint32_t last = back;
    while (last + 1 < 2 * l->graph.edge_count && sli_same_point(l->halves[last + 1].at, at)) last++;
    return l->halves[last].number;
}

/// Counts how often the loop runs round each face, from the outer one on: across a half-edge from
/// its right to its left, once more for each pass along it, and once less for each pass back.
static void count_turns(loop *l) {
    size_t count = 0;
    uint32_t outer = 0;
    while (sli_same_point(l->halves[outer + 1].at, l->halves[0].at)) outer++;
    l->stack[count++] = l->halves[outer].number; // its left is the outer face
    l->known[l->halves[outer].number] = true;
    while (count) {
        const uint32_t first = l->stack[--count];
        uint32_t h = first;
        do { // all round the face
            l->known[h] = true;
            l->turns[h] = l->turns[first];
            if (!l->known[h ^ 1]) {
                l->known[h ^ 1] = true;
                l->turns[h ^ 1] = l->turns[h] - l->passes[h] + l->passes[h ^ 1];
                l->stack[count++] = h ^ 1;
            }
            h = next_of_face(l, h);
        } while (h != first);
    }
}

/// A loop is a polygon if it runs round each face once, or not at all, and each pass has a face at
/// its inner hand that it runs round. So a bridge to a hole is fine, and a spike is not.
static loop_kind kind_of(const loop *l) {
    int32_t least = 0, most = 0;
    const size_t halves = 2 * l->graph.edge_count;
    for (size_t h = 0; h < halves; h++) {
        if (l->turns[h] < least) least = l->turns[h];
        if (l->turns[h] > most) most = l->turns[h];
    }
    if (most - least > 1) return LOOP_CROSSED;
    if (most == least) return LOOP_FLAT;
    for (size_t h = 0; h < halves; h++)
        if (l->passes[h] && !l->turns[most ? h : h ^ 1]) return LOOP_FLAT;
    return most ? LOOP_LEFT : LOOP_CLOCKWISE;
}

/// Exact. Time O(n log n) for sides that meet in a few places each.
static sl_status find_kind(sl_context *context, const sl_point *corners, size_t count,
                           loop_kind *kind) {
    loop l = {0};
    sl_status status = make_loop(context, corners, count, &l);
    *kind = LOOP_FLAT;
    if (status == SL_UNSUPPORTED) { // sides cross again and again, a few steps of doubles apart
        status = SL_OK;
        *kind = LOOP_CROSSED;
    } else if (status == SL_OK && l.graph.crossings) {
        *kind = LOOP_CROSSED;
    } else if (status == SL_OK && l.graph.edge_count) {
        count_turns(&l);
        *kind = kind_of(&l);
    }
    destroy_loop(context, &l);
    return status;
}

static sl_status add_polygon(sl_context *context, sl_map *map, const char *source, bool open,
                             const sl_point *corners, size_t count, uint32_t line) {
    const char *what = open ? "open" : "solid";
    loop_kind kind;
    SL_TRY(find_kind(context, corners, count, &kind));
    if (kind == LOOP_CROSSED)
        return sl_fail_at(context, source, line, "%s: sides of the polygon cross each other", what);
    if (kind == LOOP_FLAT)
        return sl_fail_at(context, source, line,
                          "%s: expected a polygon with an area, without spikes", what);
    const uint32_t solid = SL_SOLID_LEFT | SL_SOLID_BEGINS;
    const uint32_t forward = open ? sl_ground_turned(solid | SL_OPEN_RIGHT) : solid;
    const uint32_t ground = kind == LOOP_LEFT ? forward : sl_ground_turned(forward);
    for (size_t i = 0; i < count; i++) {
        SL_TRY(sl_map_add_wall(context, map, corners[i], corners[i + 1 < count ? i + 1 : 0], line));
        map->walls[map->wall_count - 1].ground = ground;
    }
    return SL_OK;
}

sl_status sli_map_add_ground(sl_context *context, sl_map *map, const char *source, bool open,
                             const sl_point *corners, size_t count, uint32_t line) {
    const char *what = open ? "open" : "solid";
    sl_point *settled;
    if (count < 3)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s: expected at least 3 corners", what);
    SL_TRY(sli_copy_points(context, what, corners, count, &settled));
    const sl_status status = add_polygon(context, map, source, open, settled, count, line);
    sl_free(context, settled);
    return status;
}

sl_status sl_map_add_solid(sl_context *context, sl_map *map, const sl_point *corners, size_t count,
                           uint32_t line) {
    return sli_map_add_ground(context, map, sli_map_name(map), false, corners, count, line);
}

sl_status sl_map_add_open(sl_context *context, sl_map *map, const sl_point *corners, size_t count,
                          uint32_t line) {
    return sli_map_add_ground(context, map, sli_map_name(map), true, corners, count, line);
}

// --- from walls to polygons

/// A wall, with solid ground at its left going from `from` to `to`.
typedef struct side {
    sl_point from, to;
    size_t wall;
    uint32_t line;
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
    int order = sli_compare_points(a->from, b->from);
    if (!order) order = sli_compare_points(a->to, b->to);
    return order ? order : (a->wall > b->wall) - (a->wall < b->wall);
}

/// The sides that start at a point: the first of them, and *end behind the last.
static size_t sides_from(const tracer *t, sl_point at, size_t *end) {
    const size_t low = sli_first_at(t->sides, sizeof *t->sides, t->count, at);
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

/// The side on which a loop goes on; NONE where it ends. The way back comes last.
static size_t next_side(const tracer *t, const side *last) {
    size_t end, best = NONE;
    int best_quarter = 0;
    for (size_t i = sides_from(t, last->to, &end); i < end; i++) {
        if (t->sides[i].used) continue;
        const int own = quarter(last->to, last->from, t->sides[i].to);
        bool better = best == NONE || best_quarter == 3;
        if (!better && own < 3) {
            const int turn = sli_orient(last->to, t->sides[best].to, t->sides[i].to);
            better = own != best_quarter ? own < best_quarter : turn > 0;
        }
        if (!better) continue;
        best = i;
        best_quarter = own;
    }
    return best;
}

/// Gives what was traced: as a polygon, if it can be read back as one, or else wall by wall.
static sl_status give(tracer *t, bool closed) {
    const size_t count = t->way.count;
    bool open = true;
    uint32_t line = UINT32_MAX;
    t->corners.count = 0;
    SL_TRY(SL_ARRAY_ROOM(t->context, &t->corners, count));
    for (size_t i = 0; i < count; i++) {
        const side *s = &t->sides[t->way.items[i]];
        t->corners.items[t->corners.count++] = s->from;
        open &= s->open;
        if (s->line < line) line = s->line;
    }
    loop_kind kind = LOOP_FLAT;
    if (closed && count >= 3) SL_TRY(find_kind(t->context, t->corners.items, count, &kind));
    if (kind == LOOP_LEFT || (kind == LOOP_CLOCKWISE && open))
        return t->user->polygon(t->user->user, t->corners.items, count, kind == LOOP_LEFT, line);
    for (size_t i = 0; i < count; i++) {
        const side *s = &t->sides[t->way.items[i]];
        SL_TRY(t->user->wall(t->user->user, s->from, s->to, s->line));
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

/// How many loops go along a wall, with solid ground at their left, from a to b and back.
static void count_loops(const sl_wall *w, size_t *there, size_t *back) {
    const bool left = w->ground & SL_SOLID_LEFT, right = w->ground & SL_SOLID_RIGHT;
    const int32_t begins = sli_ground_begins(w->ground);
    const int32_t least_back = (int32_t)left - begins;
    *there = *back = 0;
    if (sli_same_point(w->a, w->b) || sli_ground_parts_rooms(w->ground)) return;
    if (right) *back = least_back > 1 ? (size_t)least_back : 1;
    const int32_t least_there = (int32_t)*back + begins;
    if (left) *there = least_there > 1 ? (size_t)least_there : 1;
}

static sl_status make_sides(tracer *t, const sl_wall *walls, size_t count) {
    size_t sides = 0, there, back;
    for (size_t i = 0; i < count; i++) {
        count_loops(&walls[i], &there, &back);
        sides += there + back;
    }
    t->sides = sl_alloc_array(t->context, sides, sizeof *t->sides);
    if (!t->sides) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const sl_wall *w = &walls[i];
        count_loops(w, &there, &back);
        for (size_t k = 0; k < there; k++)
            t->sides[t->count++] = (side){w->a, w->b, i, w->line, w->ground & SL_OPEN_RIGHT, false};
        for (size_t k = 0; k < back; k++)
            t->sides[t->count++] = (side){w->b, w->a, i, w->line, w->ground & SL_OPEN_LEFT, false};
    }
    return SL_OK;
}

/// Takes out the walls between two open polygons: such a wall is there twice, there and back.
static sl_status part_rooms(tracer *t) {
    size_t end;
    for (size_t i = 0; i < t->count; i++) {
        side *there = &t->sides[i];
        if (!there->open || there->used) continue;
        for (size_t k = sides_from(t, there->to, &end); k < end && !there->used; k++) {
            side *back = &t->sides[k];
            there->used = back->open && !back->used && sli_same_point(back->to, there->from);
            back->used |= there->used;
        }
        if (there->used && t->user->plain)
            SL_TRY(t->user->plain(t->user->user, there->from, there->to, there->line));
    }
    return SL_OK;
}

sl_status sli_ground_trace(sl_context *context, const sl_wall *walls, size_t count,
                           const sli_loop_user *user) {
    tracer t = {.context = context, .user = user};
    SL_TRY(make_sides(&t, walls, count));
    if (t.count) qsort(t.sides, t.count, sizeof *t.sides, compare_sides);
    sl_status status = part_rooms(&t);
    for (size_t i = 0; i < t.count && status == SL_OK && user->polygon; i++) {
        if (i % 1024 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK && !t.sides[i].used) status = trace(&t, i);
    }
    sl_free(context, t.sides);
    sl_free(context, t.way.items);
    sl_free(context, t.corners.items);
    return status;
}
