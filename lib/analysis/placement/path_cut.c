/// Which parts of a path does something hold on?
///
///     path  ----o=========o-----o====o----     Along a segment, sight begins and ends where the
///              a|         |b    |              segment crosses the border of a region, a range, a
///               |  region |     |              disc. Between two neighbouring crossings nothing
///               +---------+    ...             changes, so the middle tells.
///
/// Crossings are computed, so a crossing that is listed twice, or where nothing changes, does no
/// harm: parts that meet are one. Cost: the corners of all regions for each segment, and a question
/// for each crossing.
#include "analysis/placement/path_cut.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

/// Parts up to this share of the largest coordinate are rounding.
#define ROUNDING 0x1p-36

static sl_status add_cut(sli_path_cut *w, double t) {
    if (!(t > 0 && t < 1)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(w->context, &w->cuts, 1));
    w->cuts.items[w->cuts.count++] = t;
    return SL_OK;
}

static double cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

static sl_point less(sl_point a, sl_point b) {
    return (sl_point){a.x - b.x, a.y - b.y};
}

/// Where an edge meets the segment.
static sl_status cut_by_edge(sli_path_cut *w, sl_point p, sl_point q, sl_point a, sl_point b) {
    const int oa = sli_orient(p, q, a), ob = sli_orient(p, q, b);
    const sl_point way = less(q, p), to = less(a, p);
    if (oa == 0) return add_cut(w, (to.x * way.x + to.y * way.y) / (way.x * way.x + way.y * way.y));
    if (oa * ob >= 0) return SL_OK; // an end on the line is the start of another edge
    const sl_point edge = less(b, a);
    return add_cut(w, cross(to, edge) / cross(way, edge));
}

sl_status sli_cut_by_shape(sli_path_cut *w, sl_point p, sl_point q, const sl_shape *shape) {
    for (size_t i = 0, from = 0; i < shape->count; from = shape->ends[i++])
        for (size_t k = from; k < shape->ends[i]; k++) {
            const size_t next = k + 1 < shape->ends[i] ? k + 1 : from;
            SL_TRY(cut_by_edge(w, p, q, shape->points[k], shape->points[next]));
        }
    return SL_OK;
}

sl_status sli_cut_by_circle(sli_path_cut *w, sl_point p, sl_point q, sl_point middle,
                            double radius) {
    const sl_point way = less(q, p), from = less(p, middle);
    const double a = way.x * way.x + way.y * way.y, b = way.x * from.x + way.y * from.y;
    const double away = cross(way, from) / sqrt(a);
    const double root = (radius - away) * (radius + away);
    if (!(radius > 0 && root > 0)) return SL_OK;
    const double half = sqrt(root) / sqrt(a);
    SL_TRY(add_cut(w, -b / a - half));
    return add_cut(w, -b / a + half);
}

static sl_point between(sl_point p, sl_point q, double t) {
    return t == 1 ? q : (sl_point){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

/// Adds a part, or joins it to the one that it goes on from.
static sl_status add_part(sli_path_cut *w, sl_point p, sl_point q, double t0, double t1,
                          double length) {
    const sl_path_part part = {w->done + t0 * length, w->done + t1 * length, between(p, q, t0),
                               between(p, q, t1)};
    sl_path_part *last = w->parts.count ? &w->parts.items[w->parts.count - 1] : NULL;
    if (last && part.from - last->to <= w->least) {
        last->to = part.to;
        last->end = part.end;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(w->context, &w->parts, 1));
    w->parts.items[w->parts.count++] = part;
    return SL_OK;
}

static sl_status walk_segment(sli_path_cut *w, sl_point p, sl_point q) {
    const double length = hypot(q.x - p.x, q.y - p.y);
    w->cuts.count = 0;
    if (!(length > 0)) return SL_OK;
    SL_TRY(w->cut(w, p, q));
    SL_TRY(SL_ARRAY_ROOM(w->context, &w->cuts, 1));
    qsort(w->cuts.items, w->cuts.count, sizeof *w->cuts.items, sl_compare_numbers);
    w->cuts.items[w->cuts.count++] = 1;
    double from = 0;
    for (size_t i = 0; i < w->cuts.count; i++) {
        const double to = w->cuts.items[i];
        bool holds;
        w->piece = (to - from) * length;
        if (!(w->piece > w->least)) continue;
        SL_TRY(w->holds(w, between(p, q, from + (to - from) / 2), &holds));
        if (holds) SL_TRY(add_part(w, p, q, from, to, length));
        from = to;
    }
    w->done += length;
    return SL_OK;
}

static sl_status check_path(sl_context *context, const sl_space *space, const sl_point *path,
                            size_t count) {
    if (count < 2)
        return sl_fail(context, SL_BAD_ARGUMENT, "a path needs 2 points, not %zu", count);
    for (size_t i = 0; i < count; i++)
        if (sl_space_locate(space, path[i]) == SL_NO_CELL)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "point %zu of the path, %.9g,%.9g, is outside the map's bounds", i + 1,
                           path[i].x, path[i].y);
    return SL_OK;
}

static sl_status walk(sli_path_cut *w, const sl_point *path, size_t count) {
    const sl_box *b = &w->space->bounds;
    w->least =
        ROUNDING * fmax(fmax(fabs(b->min.x), fabs(b->max.x)), fmax(fabs(b->min.y), fabs(b->max.y)));
    SL_TRY(check_path(w->context, w->space, path, count));
    for (size_t i = 0; i + 1 < count; i++) {
        SL_TRY(sl_check_cancelled(w->context));
        SL_TRY(walk_segment(w, path[i], path[i + 1]));
    }
    return SL_OK;
}

sl_status sli_path_parts(sli_path_cut *w, const sl_point *path, size_t count, sl_path_parts *out) {
    *out = (sl_path_parts){0};
    const sl_status status = walk(w, path, count);
    sl_free(w->context, w->cuts.items);
    if (status != SL_OK) {
        sl_free(w->context, w->parts.items);
        return status;
    }
    *out = (sl_path_parts){.length = w->done, .parts = w->parts.items, .count = w->parts.count};
    for (size_t i = 0; i < out->count; i++) out->total += out->parts[i].to - out->parts[i].from;
    return SL_OK;
}

void sl_path_parts_destroy(sl_context *context, sl_path_parts *parts) {
    sl_free(context, parts->parts);
    *parts = (sl_path_parts){0};
}
