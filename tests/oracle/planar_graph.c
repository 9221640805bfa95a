/// Neighbours by their boxes are compared in rationals.
#include "oracle/planar_graph.h"

#include "oracle/apart.h"
#include "oracle/blockers.h"
#include "oracle/shared.h"

#include <math.h>
#include <stdlib.h>

// --- no two edges have more in common than an end

typedef struct boxed {
    sl_segment at;
    double least_x;
} boxed;

static int compare_boxed(const void *left, const void *right) {
    const boxed *a = left, *b = right;
    return (a->least_x > b->least_x) - (a->least_x < b->least_x);
}

/// The end of `s` that is none of `common`.
static sl_point other_end(sl_segment s, sl_point common) {
    return same(s.a, common) ? s.b : s.a;
}

/// Whether from an end that both have they go the same way, so that they overlap.
static bool same_way(sl_point common, sl_point p, sl_point q) {
    return blockers_turn(common, p, q) == 0 && (p.x > common.x) == (q.x > common.x) &&
           (p.x < common.x) == (q.x < common.x) && (p.y > common.y) == (q.y > common.y) &&
           (p.y < common.y) == (q.y < common.y);
}

static bool are_apart(sl_segment s, sl_segment t) {
    const bool a = same(s.a, t.a) || same(s.a, t.b), b = same(s.b, t.a) || same(s.b, t.b);
    if (a && b) return false;
    if (!a && !b) return !blockers_meet(s, t);
    const sl_point common = a ? s.a : s.b;
    return !same_way(common, other_end(s, common), other_end(t, common));
}

bool oracle_is_planar(const sl_segment *edges, size_t count, char why[ORACLE_WHY]) {
    boxed *sorted = must(calloc(count + 1, sizeof *sorted));
    bool planar = true;
    for (size_t i = 0; i < count; i++) {
        sorted[i] = (boxed){edges[i], fmin(edges[i].a.x, edges[i].b.x)};
        if (same(edges[i].a, edges[i].b)) planar = fault(why, "edge %zu has no length", i);
    }
    qsort(sorted, count, sizeof *sorted, compare_boxed);
    for (size_t i = 0; i < count && planar; i++) {
        const sl_segment s = sorted[i].at;
        const double low = fmin(s.a.y, s.b.y), high = fmax(s.a.y, s.b.y);
        for (size_t k = i + 1; k < count && planar; k++) {
            const sl_segment t = sorted[k].at;
            if (sorted[k].least_x > fmax(s.a.x, s.b.x)) break;
            if (fmin(t.a.y, t.b.y) > high || fmax(t.a.y, t.b.y) < low || are_apart(s, t)) continue;
            planar = fault(why, "%a %a to %a %a and %a %a to %a %a meet", s.a.x, s.a.y, s.b.x,
                           s.b.y, t.a.x, t.a.y, t.b.x, t.b.y);
        }
    }
    free(sorted);
    return planar;
}

// --- chains

typedef struct audit {
    const sli_planar *graph;
    const sl_segment *segments;
    size_t count;
    double weld;
    bool *used;    ///< by edge
    mpq_t largest; ///< distance of a chain's point from its segment, squared
    char *why;
} audit;

static bool are_near(sl_point a, sl_point b, double reach) {
    mpq_t square;
    if (same(a, b)) return true;
    mpq_init(square);
    oracle_square_between(square, a, b);
    const bool near = oracle_compare_to_square(square, reach) <= 0;
    mpq_clear(square);
    return near;
}

static bool check_point(audit *t, size_t segment, sl_point v) {
    const sl_segment *s = &t->segments[segment];
    if (same(v, s->a) || same(v, s->b)) return true;
    mpq_t square;
    mpq_init(square);
    oracle_square_to_segment(square, *s, v);
    if (mpq_cmp(square, t->largest) > 0) mpq_set(t->largest, square);
    const bool within = oracle_compare_to_square(square, t->graph->largest_move) <= 0;
    const double distance = sqrt(mpq_get_d(square));
    mpq_clear(square);
    return within || fault(t->why, "segment %zu is led through %a %a, farther than %a: %a", segment,
                           v.x, v.y, t->graph->largest_move, distance);
}

static bool check_chain(audit *t, size_t segment) {
    const sli_planar *g = t->graph;
    const size_t first = g->first[segment], end = g->first[segment + 1];
    const sl_segment *s = &t->segments[segment];
    // Ends that have become one are both within the tolerance of it.
    if (first == end)
        return are_near(s->a, s->b, 2 * t->weld) ||
               fault(t->why, "segment %zu of some length has no chain", segment);
    for (size_t i = first; i < end; i++) {
        if (g->links[i] / 2 >= g->edge_count) return fault(t->why, "link %zu: no edge", i);
        t->used[g->links[i] / 2] = true;
        const sl_segment at = sli_planar_at(g, g->links[i]);
        if (i > first && !same(sli_planar_at(g, g->links[i - 1]).b, at.a))
            return fault(t->why, "the chain of segment %zu is broken", segment);
        if (!check_point(t, segment, at.a) || !check_point(t, segment, at.b)) return false;
    }
    // Distances held against the tolerance are rounded.
    const double reach = t->weld * (1 + 0x1p-50);
    return (are_near(s->a, sli_planar_at(g, g->links[first]).a, reach) &&
            are_near(s->b, sli_planar_at(g, g->links[end - 1]).b, reach)) ||
           fault(t->why, "the chain of segment %zu does not join its ends", segment);
}

static bool check_parts(audit *t) {
    const sli_planar *g = t->graph;
    bool *ended = must(calloc(g->point_count + 1, sizeof *ended)), sound = true;
    for (size_t i = 0; i < g->edge_count && sound; i++) {
        const sli_planar_edge *e = &g->edges[i];
        sound = (e->a < e->b && e->b < g->point_count && t->used[i]) ||
                fault(t->why, "edge %zu is of no use", i);
        if (sound) ended[e->a] = ended[e->b] = true;
    }
    for (size_t i = 0; i < g->point_count && sound; i++) {
        const sl_point p = g->points[i], before = g->points[i ? i - 1 : 0];
        const bool ordered = !i || is_before(before, p);
        sound = (ended[i] && ordered && sl_coordinate_usable(p.x) && sl_coordinate_usable(p.y)) ||
                fault(t->why, "point %zu is of no use or out of order", i);
    }
    free(ended);
    return sound;
}

/// Whether a point is nearer than `reach` to what is between the ends of an edge.
static bool is_beside(sl_segment e, sl_point v, double reach) {
    if (v.x < fmin(e.a.x, e.b.x) - reach || v.x > fmax(e.a.x, e.b.x) + reach ||
        v.y < fmin(e.a.y, e.b.y) - reach || v.y > fmax(e.a.y, e.b.y) + reach)
        return false;
    const double dx = e.b.x - e.a.x, dy = e.b.y - e.a.y, length = hypot(dx, dy);
    const double along = (v.x - e.a.x) * (dx / length) + (v.y - e.a.y) * (dy / length);
    const double off = (v.y - e.a.y) * (dx / length) - (v.x - e.a.x) * (dy / length);
    return along > reach && along < length - reach && fabs(off) < reach;
}

/// Points are the tolerance apart, and half of it from edges that they do not end; in doubles, with
/// room for rounding.
static bool check_welds(audit *t, double slack) {
    const sli_planar *g = t->graph;
    const double apart = t->weld - slack, off = t->weld / 2 - slack;
    for (size_t i = 0; i < g->point_count; i++)
        for (size_t k = i + 1; k < g->point_count && g->points[k].x <= g->points[i].x + apart; k++)
            if (hypot(g->points[i].x - g->points[k].x, g->points[i].y - g->points[k].y) < apart)
                return fault(t->why, "points %zu and %zu are not welded", i, k);
    for (size_t i = 0; i < g->edge_count; i++) {
        const sli_planar_edge *e = &g->edges[i];
        const sl_segment s = {g->points[e->a], g->points[e->b]};
        // Points are by x, and so are the ends of edges.
        for (size_t k = e->a; k-- && g->points[k].x >= s.a.x - off;)
            if (is_beside(s, g->points[k], off))
                return fault(t->why, "point %zu is beside edge %zu", k, i);
        for (size_t k = e->a + 1; k < g->point_count && g->points[k].x <= s.b.x + off; k++)
            if (k != e->b && is_beside(s, g->points[k], off))
                return fault(t->why, "point %zu is beside edge %zu", k, i);
    }
    return true;
}

static double size_of(const sl_segment *segments, size_t count) {
    double size = 0;
    for (size_t i = 0; i < count; i++)
        size = fmax(size, fmax(fmax(fabs(segments[i].a.x), fabs(segments[i].a.y)),
                               fmax(fabs(segments[i].b.x), fabs(segments[i].b.y))));
    return size;
}

static bool check_largest(audit *t) {
    const double move = t->graph->largest_move;
    const double limit = sqrt(mpq_get_d(t->largest)) + 0x1p-47 * size_of(t->segments, t->count);
    if (mpq_sgn(t->largest) == 0 ? move == 0 : move <= limit) return true;
    return fault(t->why, "a largest move of %a is too much", move);
}

static bool check_planar(const sli_planar *g, char *why) {
    sl_segment *edges = must(calloc(g->edge_count + 1, sizeof *edges));
    for (size_t i = 0; i < g->edge_count; i++)
        edges[i] = (sl_segment){g->points[g->edges[i].a], g->points[g->edges[i].b]};
    const bool planar = oracle_is_planar(edges, g->edge_count, why);
    free(edges);
    return planar;
}

bool oracle_is_graph_of(const sli_planar *graph, const sl_segment *segments, size_t count,
                        double weld, char why[ORACLE_WHY]) {
    audit t = {graph,     segments, count, weld, must(calloc(graph->edge_count + 1, sizeof(bool))),
               .why = why};
    mpq_init(t.largest);
    bool sound = graph->first[0] == 0;
    for (size_t i = 0; i < count && sound; i++) sound = check_chain(&t, i);
    sound = sound && check_parts(&t) && check_largest(&t) && check_planar(graph, why);
    const double slack = 0x1p-49 * size_of(segments, count);
    if (sound && weld > 4 * slack) sound = check_welds(&t, slack);
    mpq_clear(t.largest);
    free(t.used);
    return sound;
}
