/// A way is a sequence of edges between corners. No corner is inside an edge: a way past a corner
/// is two edges, so each corner that it touches is asked whether it may be passed there. It may if
/// there is no wall at the corner on one of its sides, left or right, between the way in and the
/// way out. An edge along a wall is two edges, one on each side of the wall.
#include "oracle/walks.h"
#include "oracle/blockers.h"
#include "oracle/must.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FREE, WALL_RIGHT, WALL_LEFT, SIDES };
enum { NO_EDGE, FREE_EDGE, WALL_EDGE };

typedef struct walks {
    sl_point *points;
    size_t count;
    uint8_t *edges; ///< by pair of points
    walk_end from, to;
    size_t from_point, to_point;
} walks;

static bool same(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

static size_t point_number(walks *w, sl_point p) {
    for (size_t i = 0; i < w->count; i++)
        if (same(w->points[i], p)) return i;
    w->points[w->count] = p;
    return w->count++;
}

/// Whether p, on the line of s, is strictly between the ends of s.
static bool between(sl_segment s, sl_point p) {
    if (same(s.a, p) || same(s.b, p)) return false;
    return fmin(s.a.x, s.b.x) <= p.x && p.x <= fmax(s.a.x, s.b.x) && fmin(s.a.y, s.b.y) <= p.y &&
           p.y <= fmax(s.a.y, s.b.y);
}

static bool inside_of(sl_segment s, sl_point p) {
    return between(s, p) && blockers_turn(s.a, s.b, p) == 0;
}

static bool holds_point(const walks *w, sl_segment s) {
    for (size_t i = 0; i < w->count; i++)
        if (inside_of(s, w->points[i])) return true;
    return false;
}

/// Whether both points are on a wall.
static bool along(sl_segment wall, sl_segment s) {
    return (same(wall.a, s.a) || same(wall.b, s.a) || inside_of(wall, s.a)) &&
           (same(wall.a, s.b) || same(wall.b, s.b) || inside_of(wall, s.b));
}

static bool crosses(sl_segment s, sl_segment t) {
    if (fmax(s.a.x, s.b.x) < fmin(t.a.x, t.b.x) || fmin(s.a.x, s.b.x) > fmax(t.a.x, t.b.x) ||
        fmax(s.a.y, s.b.y) < fmin(t.a.y, t.b.y) || fmin(s.a.y, s.b.y) > fmax(t.a.y, t.b.y))
        return false;
    return blockers_turn(s.a, s.b, t.a) * blockers_turn(s.a, s.b, t.b) < 0 &&
           blockers_turn(t.a, t.b, s.a) * blockers_turn(t.a, t.b, s.b) < 0;
}

/// The ends of s touch walls at most in points of the graph, so a wall that is not along s has
/// nothing of its inside but by crossing, or by a point of s in the wall.
static uint8_t edge_of(const walks *w, const sl_segment *walls, size_t count, sl_segment s) {
    uint8_t kind = FREE_EDGE;
    if (holds_point(w, s)) return NO_EDGE;
    for (size_t i = 0; i < count; i++) {
        if (same(walls[i].a, walls[i].b)) continue;
        if (along(walls[i], s)) kind = WALL_EDGE;
        if (crosses(walls[i], s)) return NO_EDGE;
    }
    return kind;
}

static walks make(const sl_segment *walls, size_t count, walk_end from, walk_end to) {
    walks w = {.from = from, .to = to};
    w.points = must(malloc((2 * count + 2) * sizeof *w.points));
    for (size_t i = 0; i < count; i++) {
        if (same(walls[i].a, walls[i].b)) continue;
        point_number(&w, walls[i].a);
        point_number(&w, walls[i].b);
    }
    w.from_point = point_number(&w, from.at);
    w.to_point = point_number(&w, to.at);
    w.edges = must(calloc(w.count, w.count));
    for (size_t u = 0; u < w.count; u++)
        for (size_t v = u + 1; v < w.count; v++)
            w.edges[u * w.count + v] = w.edges[v * w.count + u] =
                edge_of(&w, walls, count, (sl_segment){w.points[u], w.points[v]});
    return w;
}

static void destroy(walks *w) {
    free(w->points);
    free(w->edges);
}

// --- passing a corner

/// The angle from one direction to another, counter-clockwise: 0 for none, 1 for less than half a
/// turn, 2 for half a turn, 3 for more.
static int angle_class(sl_point v, sl_point from, sl_point x) {
    const int turn = blockers_turn(v, from, x);
    if (turn) return turn > 0 ? 1 : 3;
    const bool ahead =
        from.x != v.x ? (from.x > v.x) == (x.x > v.x) : (from.y > v.y) == (x.y > v.y);
    return ahead ? 0 : 2;
}

/// Whether direction x lies strictly between two others, counter-clockwise.
static bool in_sector(sl_point v, sl_point first, sl_point x, sl_point last) {
    const int a = angle_class(v, first, x), b = angle_class(v, first, last);
    if (!a || a != b) return a && a < b;
    return a != 2 && blockers_turn(v, x, last) > 0;
}

/// Whether a way may come from `back` to a corner and go on to `out`. The sides are those of walls
/// that it runs along.
static bool may_pass(const walks *w, size_t corner, sl_point back, int side_in, sl_point out,
                     int side_out) {
    const sl_point v = w->points[corner];
    const bool returns = angle_class(v, back, out) == 0;
    bool left = side_in != WALL_LEFT && side_out != WALL_LEFT;
    bool right = side_in != WALL_RIGHT && side_out != WALL_RIGHT;
    if (returns && (side_in != side_out || side_in == FREE)) return true;
    for (size_t i = 0; i < w->count; i++) {
        if (w->edges[corner * w->count + i] != WALL_EDGE) continue;
        const sl_point x = w->points[i];
        if (returns && angle_class(v, back, x)) return false;
        if (in_sector(v, out, x, back)) left = false;
        if (in_sector(v, back, x, out)) right = false;
    }
    return returns || left || right;
}

// --- the search

typedef struct walk_state {
    double length;
    size_t u, v;
    int side;
} walk_state;

typedef struct walk_heap {
    walk_state *items;
    size_t count, room;
} walk_heap;

static void heap_push(walk_heap *heap, walk_state state) {
    if (heap->count == heap->room) {
        heap->room = 2 * heap->room + 64;
        heap->items = must(realloc(heap->items, heap->room * sizeof *heap->items));
    }
    size_t i = heap->count++;
    for (; i && state.length < heap->items[(i - 1) / 2].length; i = (i - 1) / 2)
        heap->items[i] = heap->items[(i - 1) / 2];
    heap->items[i] = state;
}

static walk_state heap_pop(walk_heap *heap) {
    const walk_state least = heap->items[0], last = heap->items[--heap->count];
    size_t i = 0;
    for (size_t child; (child = 2 * i + 1) < heap->count; i = child) {
        if (child + 1 < heap->count && heap->items[child + 1].length < heap->items[child].length)
            child++;
        if (last.length <= heap->items[child].length) break;
        heap->items[i] = heap->items[child];
    }
    heap->items[i] = last;
    return least;
}

/// Adds the edges that lead on from a corner.
static void lead_on(const walks *w, walk_heap *heap, double length, size_t corner, sl_point back,
                    int side_in) {
    for (size_t i = 0; i < w->count; i++) {
        const uint8_t kind = w->edges[corner * w->count + i];
        if (kind == NO_EDGE) continue;
        const sl_point v = w->points[corner], out = w->points[i];
        const double more = length + hypot(out.x - v.x, out.y - v.y);
        for (int side = kind == WALL_EDGE; side < (kind == WALL_EDGE ? SIDES : WALL_RIGHT); side++)
            if (may_pass(w, corner, back, side_in, out, side))
                heap_push(heap, (walk_state){more, corner, i, side});
    }
}

static double shortest(const walks *w) {
    walk_heap heap = {0};
    double length = INFINITY;
    bool *done = must(calloc(w->count * w->count, SIDES));
    lead_on(w, &heap, 0, w->from_point, w->from.side, FREE);
    while (heap.count) {
        const walk_state s = heap_pop(&heap);
        bool *is_done = &done[(s.u * w->count + s.v) * SIDES + (size_t)s.side];
        if (*is_done) continue;
        *is_done = true;
        if (s.v == w->to_point && may_pass(w, s.v, w->points[s.u], s.side, w->to.side, FREE)) {
            length = s.length;
            break;
        }
        lead_on(w, &heap, s.length, s.v, w->points[s.u], s.side);
    }
    free(heap.items);
    free(done);
    return length;
}

/// From a point to itself: it stands there, unless it stands on two sides.
static bool stays(const walks *w) {
    return w->from_point == w->to_point &&
           may_pass(w, w->from_point, w->from.side, FREE, w->to.side, FREE);
}

double oracle_walk(const sl_segment *walls, size_t count, walk_end from, walk_end to) {
    walks w = make(walls, count, from, to);
    const double length = stays(&w) ? 0 : shortest(&w);
    destroy(&w);
    return length;
}

// --- a given way

/// The next point of the graph on the way from u to a place; w->count for none.
static size_t next_on(const walks *w, size_t u, sl_point to) {
    for (size_t i = 0; i < w->count; i++) {
        const sl_point p = w->points[i];
        const sl_segment s = {w->points[u], to};
        if (w->edges[u * w->count + i] != NO_EDGE && (same(p, to) || inside_of(s, p))) return i;
    }
    return w->count;
}

static bool can_walk(const walks *w, const sl_point *points, size_t count) {
    bool sides[SIDES] = {true}; // those on which one may have come
    size_t u = w->from_point;
    sl_point back = w->from.side;
    if (!same(points[0], w->from.at) || !same(points[count - 1], w->to.at)) return false;
    for (size_t k = 1; k < count; k++)
        while (!same(w->points[u], points[k])) {
            const size_t v = next_on(w, u, points[k]);
            if (v == w->count) return false;
            bool next[SIDES] = {false};
            const bool wall = w->edges[u * w->count + v] == WALL_EDGE;
            for (int in = 0; in < SIDES; in++)
                for (int out = wall; sides[in] && out < (wall ? SIDES : WALL_RIGHT); out++)
                    next[out] |= may_pass(w, u, back, in, w->points[v], out);
            memcpy(sides, next, sizeof sides);
            back = w->points[u];
            u = v;
        }
    for (int in = 0; in < SIDES; in++)
        if (sides[in] && may_pass(w, u, back, in, w->to.side, FREE)) return true;
    return false;
}

bool oracle_can_walk(const sl_segment *walls, size_t count, walk_end from, walk_end to,
                     const sl_point *points, size_t point_count) {
    walks w = make(walls, count, from, to);
    const bool can = point_count && can_walk(&w, points, point_count);
    destroy(&w);
    return can;
}
