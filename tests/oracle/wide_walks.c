/// The points around an end of a wall are the corners of a polygon of POINTS sides. A disc of
/// radius R goes around it no shorter than around the polygon whose corners are on its circle. It
/// can go around the polygon whose sides touch its circle. So both bounds are lengths in such a
/// graph; in the first one, pieces may come as near to walls as the sides of its polygon do.
#include "oracle/wide_walks.h"
#include "oracle/blockers.h"
#include "oracle/must.h"

#include <math.h>
#include <stdbool.h>

enum { POINTS = 48 };

static const double HALF_STEP = 3.14159265358979323846 / POINTS, MARGIN = 1e-9;

typedef struct wide_graph {
    const sl_segment *walls;
    size_t wall_count;
    double room; ///< what pieces must have
    sl_point *points;
    double *far;
    bool *done;
    size_t count;
} wide_graph;

static double to_segment(sl_point p, sl_segment s) {
    const double x = s.b.x - s.a.x, y = s.b.y - s.a.y, px = p.x - s.a.x, py = p.y - s.a.y;
    const double length = hypot(x, y);
    const double along = length > 0 ? (px * (x / length) + py * (y / length)) : 0;
    if (along <= 0) return hypot(px, py);
    if (along >= length) return hypot(p.x - s.b.x, p.y - s.b.y);
    return fabs(px * (y / length) - py * (x / length));
}

double oracle_room(const sl_segment *walls, size_t count, sl_segment s) {
    double least = INFINITY;
    for (size_t i = 0; i < count && least > 0; i++) {
        const sl_segment w = walls[i];
        least = fmin(least, fmin(fmin(to_segment(s.a, w), to_segment(s.b, w)),
                                 fmin(to_segment(w.a, s), to_segment(w.b, s))));
        if (blockers_meet(w, s)) least = 0;
    }
    return least;
}

static void add_point(wide_graph *g, const sl_box *bounds, sl_point p) {
    if (p.x < bounds->min.x || p.x > bounds->max.x || p.y < bounds->min.y || p.y > bounds->max.y ||
        oracle_room(g->walls, g->wall_count, (sl_segment){p, p}) < g->room)
        return;
    g->points[g->count++] = p;
}

static bool is_new_end(const sl_segment *walls, size_t i, sl_point p) {
    for (size_t k = 0; k < i; k++)
        if ((walls[k].a.x == p.x && walls[k].a.y == p.y) ||
            (walls[k].b.x == p.x && walls[k].b.y == p.y))
            return false;
    return true;
}

static void add_points(wide_graph *g, const sl_box *bounds, double radius) {
    for (size_t i = 0; i < g->wall_count; i++)
        for (int end = 0; end < 2; end++) {
            const sl_point p = end ? g->walls[i].b : g->walls[i].a;
            for (int k = 0; k < POINTS && is_new_end(g->walls, i, p); k++)
                add_point(g, bounds,
                          (sl_point){p.x + radius * cos(2 * HALF_STEP * k),
                                     p.y + radius * sin(2 * HALF_STEP * k)});
        }
}

/// Dijkstra's search from the first point to the second one.
static double search(wide_graph *g) {
    g->far[0] = 0;
    while (true) {
        size_t at = g->count;
        for (size_t i = 0; i < g->count; i++)
            if (!g->done[i] && isfinite(g->far[i]) && (at == g->count || g->far[i] < g->far[at]))
                at = i;
        if (at == g->count) return INFINITY;
        if (at == 1) return g->far[1];
        g->done[at] = true;
        for (size_t i = 0; i < g->count; i++) {
            const double far = g->far[at] + hypot(g->points[i].x - g->points[at].x,
                                                  g->points[i].y - g->points[at].y);
            const sl_segment piece = {g->points[at], g->points[i]};
            if (!g->done[i] && far < g->far[i] &&
                oracle_room(g->walls, g->wall_count, piece) >= g->room)
                g->far[i] = far;
        }
    }
}

static double walk(const sl_segment *walls, size_t count, sl_box bounds, sl_point from, sl_point to,
                   double radius, double room) {
    const size_t most = 2 + 2 * count * POINTS;
    wide_graph g = {.walls = walls, .wall_count = count, .room = room};
    g.points = must(malloc(most * sizeof *g.points));
    g.far = must(malloc(most * sizeof *g.far));
    g.done = must(calloc(most, sizeof *g.done));
    g.points[0] = from;
    g.points[1] = to;
    g.count = 2;
    add_points(&g, &bounds, radius);
    for (size_t i = 0; i < g.count; i++) g.far[i] = INFINITY;
    const double length = search(&g);
    free(g.points);
    free(g.far);
    free(g.done);
    return length;
}

double oracle_wide_walk_least(const sl_segment *walls, size_t count, sl_box bounds, sl_point from,
                              sl_point to, double radius) {
    return walk(walls, count, bounds, from, to, radius, radius * (cos(HALF_STEP) - MARGIN));
}

double oracle_wide_walk_most(const sl_segment *walls, size_t count, sl_box bounds, sl_point from,
                             sl_point to, double radius) {
    return walk(walls, count, bounds, from, to, radius / cos(HALF_STEP) * (1 + 2 * MARGIN),
                radius * (1 + MARGIN));
}
