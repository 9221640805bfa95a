/// A constrained Delaunay triangulation, in two steps.
///
/// First, the points are added one by one. They come in the order of Hilbert's curve, so that each
/// is near the one before it. The triangle that holds a point is found by walking, and is cut into
/// three. Then edges are flipped until the circle through each triangle is empty (Lawson 1977):
///
///          c                  c                       c                    c
///         / \                /|\                     / \                  /|\   .
///        /   \              / | \                   /   \                / | \   .
///       /  p  \     ->     /  p  \                 a-----b     ->       a  |  b
///      /       \          / /   \ \                 \   /                \ | /
///     a---------b        a---------b                 \ /                  \|/
///                                                     d   flip a-b to c-d   d
///
/// Second, the edges of the graph are added (Sloan 1993). Take the edges that cross the way from a
/// to b. Each is flipped where its two triangles make a convex quadrilateral; if it still crosses,
/// it is tried again later. In the end none crosses, and a-b is a side of two triangles. The new
/// edges are then flipped to Delaunay triangles again, edges of the graph excepted.
///
/// Exact signs (sli_orient) decide what is a triangle. The circle test is rounded: a flip needs to
/// be sure, so flipping ends, and a doubtful case costs nothing but the shape of a triangle. Time
/// about O(n log n), for sorting; the walks are short.
#include "space/triangulator.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

#define NONE UINT32_MAX

typedef sli_triangulator maker;

static sl_point at(const maker *m, uint32_t point) {
    return m->t->points.items[point];
}

static uint32_t from(const maker *m, uint32_t half) {
    return m->t->halves.items[half].from;
}

static uint32_t to(const maker *m, uint32_t half) {
    return m->t->halves.items[half ^ 1].from;
}

static uint32_t next(const maker *m, uint32_t half) {
    return m->t->halves.items[half].next;
}

static void link(maker *m, uint32_t a, uint32_t b, uint32_t c) {
    sli_triangulator_link(m, a, b, c);
}

static void put(maker *m, sli_word_kind kind, uint32_t index, uint32_t value) {
    sli_triangulator_put(m, kind, index, value);
}

static int side(const maker *m, uint32_t a, uint32_t b, uint32_t c) {
    return sli_orient(at(m, a), at(m, b), at(m, c));
}

/// A new edge between two points; its half-edge from a to b.
static sl_status add_edge(maker *m, uint32_t a, uint32_t b, uint32_t *out) {
    sli_triangulation *t = m->t;
    SL_TRY(sli_triangulator_room(m));
    if (m->free_edge) {
        *out = 2 * (m->free_edge - 1);
        put(m, SLI_WORD_FREE_EDGE, 0, t->halves.items[*out].next);
    } else {
        if (t->halves.count >= INT32_MAX) return sl_fail_memory(m->context);
        SL_TRY(SL_ARRAY_ROOM(m->context, &t->halves, 2));
        SL_TRY(sl_reserve(m->context, &t->labels, &t->label_room, t->halves.count / 2 + 1,
                          sizeof *t->labels));
        *out = (uint32_t)t->halves.count;
        t->labels[*out / 2] = 0;
        t->halves.items[*out] = t->halves.items[*out + 1] = (sli_half_edge){NONE, 0};
        t->halves.count += 2;
    }
    put(m, SLI_WORD_FROM, *out, a);
    put(m, SLI_WORD_FROM, *out + 1, b);
    put(m, SLI_WORD_NEXT, *out, SLI_OUTSIDE);
    put(m, SLI_WORD_NEXT, *out + 1, SLI_OUTSIDE);
    return SL_OK;
}

// --- flipping edges

/// Whether d lies inside the circle through a, b and c, by more than rounding (the bound of
/// Shewchuk 1997, section 4.3).
static bool in_circle(const maker *m, sl_point a, sl_point b, sl_point c, sl_point d) {
    const double s = m->scale;
    const double ax = (a.x - d.x) * s, ay = (a.y - d.y) * s;
    const double bx = (b.x - d.x) * s, by = (b.y - d.y) * s;
    const double cx = (c.x - d.x) * s, cy = (c.y - d.y) * s;
    const double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
    const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double determinant = a2 * (bc - cb) + b2 * (ca - ac) + c2 * (ab - ba);
    const double sum =
        (fabs(bc) + fabs(cb)) * a2 + (fabs(ca) + fabs(ac)) * b2 + (fabs(ab) + fabs(ba)) * c2;
    return determinant > 12 * 0x1p-53 * sum + 0x1p-1000;
}

/// Whether the two triangles at an edge make a strictly convex quadrilateral.
static bool can_flip(const maker *m, uint32_t half) {
    const uint32_t x = to(m, next(m, half)), y = to(m, next(m, half ^ 1));
    return side(m, y, x, from(m, half)) > 0 && side(m, x, y, to(m, half)) > 0;
}

/// Flips an edge to the other two corners of the quadrilateral.
static void flip(maker *m, uint32_t half) {
    const uint32_t twin = half ^ 1;
    const uint32_t a = next(m, half), b = next(m, a), c = next(m, twin), d = next(m, c);
    put(m, SLI_WORD_OUT, from(m, half), c);
    put(m, SLI_WORD_OUT, from(m, twin), a);
    put(m, SLI_WORD_FROM, half, from(m, d));
    put(m, SLI_WORD_FROM, twin, from(m, b));
    link(m, half, b, c);
    link(m, twin, d, a);
}

static bool should_flip(const maker *m, uint32_t half) {
    if (m->t->labels[half / 2] || sli_half_is_outside(m->t, half) ||
        sli_half_is_outside(m->t, half ^ 1))
        return false;
    const uint32_t x = to(m, next(m, half)), y = to(m, next(m, half ^ 1));
    return in_circle(m, at(m, from(m, half)), at(m, to(m, half)), at(m, x), at(m, y)) &&
           can_flip(m, half);
}

sl_status sli_triangulator_doubt(maker *m, uint32_t half) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->doubtful, 1));
    m->doubtful.items[m->doubtful.count++] = half;
    return SL_OK;
}

static sl_status doubt(maker *m, uint32_t half) {
    return sli_triangulator_doubt(m, half);
}

sl_status sli_triangulator_settle(maker *m) {
    while (m->doubtful.count) {
        const uint32_t half = m->doubtful.items[--m->doubtful.count];
        if (!should_flip(m, half)) continue;
        SL_TRY(sli_triangulator_room(m));
        const uint32_t sides[4] = {next(m, half), next(m, next(m, half)), next(m, half ^ 1),
                                   next(m, next(m, half ^ 1))};
        flip(m, half);
        for (int i = 0; i < 4; i++) SL_TRY(doubt(m, sides[i]));
    }
    return SL_OK;
}

// --- adding points

/// Each step starts at a random edge, so that no walk goes in circles.
uint32_t sli_triangulator_walk(maker *m, sl_point p, bool *on) {
    uint32_t half = m->last;
    for (;;) {
        const uint64_t chance = sl_random_next(&m->random) % 3;
        for (uint64_t i = 0; i < chance; i++) half = next(m, half);
        uint32_t zero = NONE;
        int i = 0;
        for (; i < 3; i++, half = next(m, half)) {
            const int sign = sli_orient(at(m, from(m, half)), at(m, to(m, half)), p);
            if (sign < 0) break;
            if (sign == 0) zero = half;
        }
        if (i == 3) {
            *on = zero != NONE;
            return *on ? zero : half;
        }
        half ^= 1;
    }
}

static sl_status split_triangle(maker *m, uint32_t half, uint32_t p) {
    const uint32_t h[3] = {half, next(m, half), next(m, next(m, half))};
    uint32_t in[3];
    for (int i = 0; i < 3; i++) SL_TRY(add_edge(m, from(m, h[i]), p, &in[i]));
    for (int i = 0; i < 3; i++) {
        link(m, h[i], in[(i + 1) % 3], in[i] ^ 1);
        SL_TRY(doubt(m, h[i]));
    }
    put(m, SLI_WORD_OUT, p, in[0] ^ 1);
    return sli_triangulator_settle(m);
}

/// Cuts the triangles at an edge; one of its sides may be outside.
static sl_status split_edge(maker *m, uint32_t half, uint32_t p) {
    if (sli_half_is_outside(m->t, half)) half ^= 1;
    const uint32_t twin = half ^ 1, b = to(m, half);
    const uint32_t h1 = next(m, half), h2 = next(m, h1);
    const bool outer = sli_half_is_outside(m->t, twin);
    uint32_t rest, inward, across;
    SL_TRY(add_edge(m, p, b, &rest));
    SL_TRY(add_edge(m, p, from(m, h2), &inward));
    SL_TRY(sli_triangulator_room(m));
    put(m, SLI_WORD_FROM, twin, p);
    link(m, half, inward, h2);
    link(m, rest, h1, inward ^ 1);
    put(m, SLI_WORD_OUT, b, h1);
    put(m, SLI_WORD_OUT, p, rest);
    SL_TRY(doubt(m, h1));
    SL_TRY(doubt(m, h2));
    if (!outer) {
        const uint32_t t1 = next(m, twin), t2 = next(m, t1);
        SL_TRY(add_edge(m, p, from(m, t2), &across));
        link(m, twin, t1, across ^ 1);
        link(m, rest ^ 1, across, t2);
        SL_TRY(doubt(m, t1));
        SL_TRY(doubt(m, t2));
    }
    return sli_triangulator_settle(m);
}

sl_status sli_triangulator_add_point(maker *m, uint32_t p) {
    bool on = false;
    const uint32_t half = sli_triangulator_walk(m, at(m, p), &on);
    SL_TRY(on ? split_edge(m, half, p) : split_triangle(m, half, p));
    m->last = m->t->out[p];
    return SL_OK;
}

// --- the box

/// The number of a corner: a point of the graph where there is one.
static sl_status take_corner(maker *m, const sli_planar *graph, sl_point corner, uint32_t *out) {
    size_t low = 0, high = graph->point_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const sl_point p = graph->points[middle];
        if (p.x < corner.x || (p.x == corner.x && p.y < corner.y))
            low = middle + 1;
        else
            high = middle;
    }
    if (low < graph->point_count && graph->points[low].x == corner.x &&
        graph->points[low].y == corner.y) {
        *out = (uint32_t)low;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->t->points, 1));
    *out = (uint32_t)m->t->points.count;
    m->t->points.items[m->t->points.count++] = corner;
    return SL_OK;
}

static sl_status start(maker *m, const sli_planar *graph, const sl_box *box) {
    sli_triangulation *t = m->t;
    const sl_point corners[4] = {
        box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
    uint32_t c[4], h[4], diagonal;
    SL_TRY(SL_ARRAY_ROOM(m->context, &t->points, graph->point_count + 4));
    for (size_t i = 0; i < graph->point_count; i++) t->points.items[i] = graph->points[i];
    t->points.count = graph->point_count;
    for (int i = 0; i < 4; i++) SL_TRY(take_corner(m, graph, corners[i], &c[i]));
    t->out = sl_alloc_array(m->context, t->points.count, sizeof *t->out);
    if (!t->out) return SL_NO_MEMORY;
    for (size_t i = 0; i < t->points.count; i++) t->out[i] = NONE;
    for (int i = 0; i < 4; i++) {
        SL_TRY(add_edge(m, c[i], c[(i + 1) % 4], &h[i]));
        t->out[c[i]] = h[i];
    }
    SL_TRY(add_edge(m, c[0], c[2], &diagonal));
    link(m, h[0], h[1], diagonal ^ 1);
    link(m, diagonal, h[2], h[3]);
    m->last = diagonal;
    return SL_OK;
}

// --- the order of points

typedef struct place {
    uint64_t key;
    uint32_t point;
} place;

static int compare_places(const void *left, const void *right) {
    const place *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->point > b->point) - (a->point < b->point);
}

/// The place of a square, in a grid of 2^16 x 2^16, along Hilbert's curve.
static uint64_t along_curve(uint32_t x, uint32_t y) {
    uint64_t key = 0;
    for (uint32_t s = 1u << 15; s; s >>= 1) {
        const uint32_t right = (x & s) != 0, upper = (y & s) != 0;
        key = key * 4 + ((3 * right) ^ upper);
        if (upper) continue;
        if (right) {
            x = (s - 1) - (x & (s - 1));
            y = (s - 1) - (y & (s - 1));
        }
        const uint32_t swap = x;
        x = y;
        y = swap;
    }
    return key;
}

static uint32_t square_of(double value, double low, double high) {
    const double share = (value - low) / (high - low);
    return share < 1 ? (uint32_t)(share * 65536) : 65535;
}

static sl_status add_points(maker *m, const sl_box *box) {
    sli_triangulation *t = m->t;
    place *places = sl_alloc_array(m->context, t->points.count, sizeof *places);
    if (!places) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < t->points.count; i++) {
        const sl_point p = t->points.items[i];
        places[i] = (place){along_curve(square_of(p.x, box->min.x, box->max.x),
                                        square_of(p.y, box->min.y, box->max.y)),
                            i};
    }
    qsort(places, t->points.count, sizeof *places, compare_places);
    sl_status status = SL_OK;
    for (size_t i = 0; i < t->points.count && status == SL_OK; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(m->context);
        if (status == SL_OK && t->out[places[i].point] == NONE)
            status = sli_triangulator_add_point(m, places[i].point);
    }
    sl_free(m->context, places);
    return status;
}

// --- adding edges

static sl_status fail_at(const maker *m, uint32_t a, uint32_t b) {
    return sl_fail(m->context, SL_BAD_INPUT,
                   "the segment from %.17g %.17g to %.17g %.17g crosses or touches another one: "
                   "clean the map first",
                   at(m, a).x, at(m, a).y, at(m, b).x, at(m, b).y);
}

/// The next half-edge that starts in the same point, counter-clockwise; SLI_OUTSIDE behind the
/// last.
static uint32_t around(const maker *m, uint32_t half) {
    return next(m, next(m, half)) ^ 1;
}

/// The most clockwise half-edge that starts in the same point. It exists for a point on the border
/// of the box; another point gives the half-edge itself.
static uint32_t first_around(const maker *m, uint32_t half) {
    const uint32_t stop = half;
    for (;;) {
        const uint32_t before = half ^ 1;
        if (sli_half_is_outside(m->t, before)) return half;
        half = next(m, before);
        if (half == stop) return half;
    }
}

/// Finds the edge from a to b (*there), or the first edge that it crosses.
static sl_status find_way(const maker *m, uint32_t a, uint32_t b, bool *there, uint32_t *out) {
    const uint32_t first = first_around(m, m->t->out[a]);
    uint32_t half = first;
    *there = true;
    do {
        *out = half;
        if (to(m, half) == b) return SL_OK;
        if (sli_half_is_outside(m->t, half)) return fail_at(m, a, b);
        if (side(m, a, b, to(m, half)) < 0 && side(m, a, b, to(m, next(m, half))) > 0) {
            *there = false;
            *out = next(m, half);
            return SL_OK;
        }
        half = around(m, half);
    } while (half != first);
    return fail_at(m, a, b);
}

/// Lists the edges that the way from a to b crosses, each running from its right to its left.
static sl_status find_crossing(maker *m, uint32_t a, uint32_t b, uint32_t half) {
    m->crossing.count = 0;
    for (;;) {
        if (m->t->labels[half / 2]) return fail_at(m, a, b);
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->crossing, 1));
        m->crossing.items[m->crossing.count++] = half;
        const uint32_t first = next(m, half ^ 1), apex = to(m, first);
        if (apex == b) return SL_OK;
        const int sign = side(m, a, b, apex);
        if (sign == 0) return fail_at(m, a, b);
        half = sign > 0 ? first : next(m, first);
    }
}

/// Flips the edges that cross the way from a to b until one of them is that way.
static sl_status clear_way(maker *m, uint32_t a, uint32_t b, uint32_t label) {
    m->flipped.count = 0;
    while (m->crossing.count) {
        const size_t count = m->crossing.count;
        m->crossing.count = 0;
        for (size_t i = 0; i < count; i++) {
            const uint32_t half = m->crossing.items[i];
            const bool flips = can_flip(m, half);
            SL_TRY(sli_triangulator_room(m));
            if (flips) flip(m, half);
            const uint32_t p = from(m, half), q = to(m, half);
            if ((p == a && q == b) || (p == b && q == a)) {
                put(m, SLI_WORD_LABEL, half / 2, label);
            } else if (!flips || (p != a && p != b && q != a && q != b &&
                                  side(m, a, b, p) * side(m, a, b, q) < 0)) {
                m->crossing.items[m->crossing.count++] = half; // later, after others
            } else {
                SL_TRY(SL_ARRAY_ROOM(m->context, &m->flipped, 1));
                m->flipped.items[m->flipped.count++] = half;
            }
        }
        SL_TRY(sl_check_cancelled(m->context));
    }
    for (size_t i = 0; i < m->flipped.count; i++) SL_TRY(doubt(m, m->flipped.items[i]));
    return sli_triangulator_settle(m);
}

sl_status sli_triangulator_add_edge(maker *m, uint32_t a, uint32_t b, uint32_t label) {
    bool there;
    uint32_t half;
    SL_TRY(find_way(m, a, b, &there, &half));
    if (there) {
        SL_TRY(sli_triangulator_room(m));
        put(m, SLI_WORD_LABEL, half / 2, label);
        return SL_OK;
    }
    SL_TRY(find_crossing(m, a, b, half));
    return clear_way(m, a, b, label);
}

static sl_status add_edges(maker *m, const sli_planar *graph) {
    for (uint32_t i = 0; i < graph->edge_count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(m->context));
        SL_TRY(sli_triangulator_add_edge(m, graph->edges[i].a, graph->edges[i].b, i + 1));
    }
    return SL_OK;
}

// --- all of it

double sli_triangulator_scale(const sl_box *box) {
    int exponent = 0;
    frexp(fmax(box->max.x - box->min.x, box->max.y - box->min.y), &exponent);
    return ldexp(1, -exponent);
}

sl_status sli_triangulate(sl_context *context, const sli_planar *graph, const sl_box *box,
                          sli_triangulation *out) {
    sli_triangulation made = {0};
    maker m = {.context = context, .t = &made, .scale = sli_triangulator_scale(box)};
    sl_status status = start(&m, graph, box);
    if (status == SL_OK) status = add_points(&m, box);
    if (status == SL_OK) status = add_edges(&m, graph);
    sli_triangulator_end(&m);
    if (status == SL_OK)
        *out = made;
    else
        sli_triangulation_destroy(context, &made);
    return status;
}

void sli_triangulator_end(maker *m) {
    sl_free(m->context, m->doubtful.items);
    sl_free(m->context, m->crossing.items);
    sl_free(m->context, m->flipped.items);
    sl_free(m->context, m->journal.items);
    sl_free(m->context, m->ring.items);
}

void sli_triangulation_destroy(sl_context *context, sli_triangulation *t) {
    sl_free(context, t->points.items);
    sl_free(context, t->halves.items);
    sl_free(context, t->labels);
    sl_free(context, t->out);
    *t = (sli_triangulation){0};
}
