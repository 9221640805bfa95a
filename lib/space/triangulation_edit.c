/// Changes of a triangulation: points and edges of the graph go, and others come.
///
/// A point goes with its edges. The hole is a polygon all of which the point saw; its ears are cut
/// off one by one, by exact signs:
///
///       +-----+                +-----+                +-----+
///      / \   / \              /       \              / \     \   .
///     +---(p)---+     ->     +         +     ->     +   \     +
///      \  / \  /              \       /              \   \   /
///       +-----+                +-----+                +----+-+
///
/// No other corner may be in an ear, or on its border. So no triangle is flat. Then the new edges
/// are flipped to Delaunay triangles. Time: the square of the corners; a hole has about six.
#include "space/triangulator.h"

#include "geometry/orient.h"

#define NONE UINT32_MAX

static sl_point start_of(const sli_triangulator *m, uint32_t half) {
    return m->t->points.items[m->t->halves.items[half].from];
}

static sl_point end_of(const sli_triangulator *m, uint32_t half) {
    return start_of(m, half ^ 1);
}

void sli_triangulator_begin(sli_triangulator *m) {
    m->keeps_journal = true;
    m->journal.count = 0;
    m->old_halves = m->t->halves.count;
    m->old_points = m->t->points.count;
    m->old_last = m->last;
}

void sli_triangulator_undo(sli_triangulator *m) {
    m->keeps_journal = false;
    while (m->journal.count) {
        const sli_written w = m->journal.items[--m->journal.count];
        *sli_triangulator_word(m, w.kind, w.index) = w.old;
    }
    m->t->halves.count = m->old_halves;
    m->t->points.count = m->old_points;
    m->doubtful.count = 0;
    m->last = m->old_last;
}

/// Puts an edge into the free list.
static void free_edge(sli_triangulator *m, uint32_t edge) {
    sli_triangulator_put(m, SLI_WORD_LABEL, edge, 0);
    sli_triangulator_put(m, SLI_WORD_FROM, 2 * edge, NONE);
    sli_triangulator_put(m, SLI_WORD_FROM, 2 * edge + 1, NONE);
    sli_triangulator_put(m, SLI_WORD_NEXT, 2 * edge, m->free_edge);
    sli_triangulator_put(m, SLI_WORD_FREE_EDGE, 0, edge + 1);
}

sl_status sli_triangulator_new_point(sli_triangulator *m, sl_point at, uint32_t *out) {
    sli_triangulation *t = m->t;
    SL_TRY(sli_triangulator_room(m));
    if (m->free_point) {
        *out = m->free_point - 1;
        sli_triangulator_put(m, SLI_WORD_FREE_POINT, 0, t->out[*out]);
    } else {
        if (t->points.count >= INT32_MAX) return sl_fail_memory(m->context);
        SL_TRY(SL_ARRAY_ROOM(m->context, &t->points, 1));
        SL_TRY(sl_reserve(m->context, &t->out, &t->out_room, t->points.count + 1, sizeof *t->out));
        *out = (uint32_t)t->points.count++;
    }
    t->points.items[*out] = at;
    sli_triangulator_put(m, SLI_WORD_OUT, *out, NONE);
    return SL_OK;
}

uint32_t sli_triangulator_half(const sli_triangulation *t, uint32_t a, uint32_t b) {
    const uint32_t first = t->out[a];
    uint32_t half = first;
    do {
        if (sli_half_end(t, half) == b) return half;
        half = sli_half_around(t, half);
    } while (half != first && half != SLI_OUTSIDE);
    if (half == first) return SLI_OUTSIDE;
    // A point of the border: the other way round.
    for (half = first; !sli_half_is_outside(t, half ^ 1);) {
        half = t->halves.items[half ^ 1].next;
        if (sli_half_end(t, half) == b) return half;
    }
    return SLI_OUTSIDE;
}

sl_status sli_triangulator_unlabel(sli_triangulator *m, uint32_t edge) {
    SL_TRY(sli_triangulator_room(m));
    sli_triangulator_put(m, SLI_WORD_LABEL, edge, 0);
    SL_TRY(sli_triangulator_doubt(m, 2 * edge));
    return sli_triangulator_settle(m);
}

// --- removing a point

/// Lists the sides of the hole around a point, and frees the edges within, the first one last.
static sl_status open_hole(sli_triangulator *m, uint32_t point) {
    const sli_triangulation *t = m->t;
    const uint32_t first = t->out[point];
    uint32_t half = first;
    m->ring.count = 0;
    do {
        SL_TRY(SL_ARRAY_ROOM(m->context, &m->ring, 1));
        m->ring.items[m->ring.count++] = t->halves.items[half].next;
        half = sli_half_around(t, half);
    } while (half != first);
    for (size_t i = 0; i < m->ring.count; i++) {
        const uint32_t ring = m->ring.items[i];
        SL_TRY(sli_triangulator_room(m));
        // The edge from the end of this side back to the point.
        free_edge(m, t->halves.items[ring].next / 2);
        sli_triangulator_put(m, SLI_WORD_OUT, t->halves.items[ring].from, ring);
    }
    SL_TRY(sli_triangulator_room(m));
    sli_triangulator_put(m, SLI_WORD_OUT, point, m->free_point);
    sli_triangulator_put(m, SLI_WORD_FREE_POINT, 0, point + 1);
    return SL_OK;
}

/// Whether the corner between two sides of the hole can be cut off.
static bool is_ear(const sli_triangulator *m, size_t before) {
    const size_t count = m->ring.count, after = (before + 1) % count;
    const sl_point a = start_of(m, m->ring.items[before]), b = start_of(m, m->ring.items[after]),
                   c = end_of(m, m->ring.items[after]);
    if (sli_orient(a, b, c) <= 0) return false;
    for (size_t i = (after + 2) % count; i != before; i = (i + 1) % count) {
        const sl_point p = start_of(m, m->ring.items[i]);
        if (sli_orient(a, b, p) >= 0 && sli_orient(b, c, p) >= 0 && sli_orient(c, a, p) >= 0)
            return false;
    }
    return true;
}

/// Cuts off an ear: the new edge is a side of the hole that is left.
static sl_status cut_ear(sli_triangulator *m, size_t before) {
    const size_t after = (before + 1) % m->ring.count;
    const uint32_t one = m->ring.items[before], two = m->ring.items[after];
    const sli_half_edge *halves = m->t->halves.items;
    const uint32_t half = 2 * (m->free_edge - 1);
    SL_TRY(sli_triangulator_room(m));
    sli_triangulator_put(m, SLI_WORD_FREE_EDGE, 0, halves[half].next);
    sli_triangulator_put(m, SLI_WORD_FROM, half, halves[one].from);
    sli_triangulator_put(m, SLI_WORD_FROM, half + 1, halves[two ^ 1].from);
    sli_triangulator_link(m, one, two, half + 1);
    m->ring.items[before] = half;
    for (size_t i = after; i + 1 < m->ring.count; i++) m->ring.items[i] = m->ring.items[i + 1];
    m->ring.count--;
    return sli_triangulator_doubt(m, half);
}

sl_status sli_triangulator_remove_point(sli_triangulator *m, uint32_t point) {
    SL_TRY(open_hole(m, point));
    size_t at = 0, tried = 0;
    while (m->ring.count > 3) {
        if (tried > m->ring.count)
            return sl_fail(m->context, SL_BAD_INPUT, "the hole of a removed point has no ear");
        at %= m->ring.count;
        if (is_ear(m, at)) {
            SL_TRY(cut_ear(m, at));
            tried = 0;
        } else {
            tried++;
        }
        at++;
    }
    SL_TRY(sli_triangulator_room(m));
    sli_triangulator_link(m, m->ring.items[0], m->ring.items[1], m->ring.items[2]);
    m->last = m->ring.items[0];
    return sli_triangulator_settle(m);
}
