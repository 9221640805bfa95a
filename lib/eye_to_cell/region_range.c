/// A region cut to its range. Edges are cut by the circle about the eye in doubles; what was seen
/// through portals out of range comes as arcs already, but with its ends beyond the circle.
#include "eye_to_cell/region_parts.h"

#include <math.h>

/// The point on the circle in a point's direction, or the point itself where it is inside.
static sl_point pulled_in(sl_point offset, double range, bool *moved) {
    const double length = hypot(offset.x, offset.y);
    *moved = length > range;
    if (!*moved) return offset;
    return (sl_point){offset.x / length * range, offset.y / length * range};
}

static double cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

/// Starts an edge that is known to end at `end`.
static sl_status add_edge(sl_context *context, sl_region *region, sl_point start, sl_point end,
                          sl_point point, sl_region_edge edge) {
    if (start.x == end.x && start.y == end.y) return SL_OK;
    const bool arc = edge.kind == SL_EDGE_ARC;
    if (arc && region->count && region->edges[region->count - 1].kind == SL_EDGE_ARC &&
        cross(region->offsets[region->count - 1], end) > 0)
        return SL_OK;
    const sl_point eye = region->view.eye;
    if (!edge.exact) point = (sl_point){eye.x + start.x, eye.y + start.y};
    return sl_region_add_point(context, region, point, start, edge);
}

/// An edge that lies on a line past the eye: what is inside the circle stays, with arcs before and
/// after it.
static sl_status cut_edge(sl_context *context, sl_region *region, sl_point p, sl_point q,
                          sl_point point, sl_region_edge edge) {
    const double range = region->range, length = hypot(q.x - p.x, q.y - p.y);
    const sl_point along = {(q.x - p.x) / length, (q.y - p.y) / length};
    const double distance = fabs(cross(p, along)), foot = -(p.x * along.x + p.y * along.y);
    const double half =
        distance < range ? sqrt((range - distance) * (range + distance)) : -INFINITY;
    const double from = fmax(foot - half, 0), to = fmin(foot + half, length);
    const sl_region_edge arc = {SL_NO_WALL, SL_EDGE_ARC, false};
    bool starts_outside, ends_outside;
    const sl_point start = pulled_in(p, range, &starts_outside);
    const sl_point end = pulled_in(q, range, &ends_outside);
    if (!(from < to)) return add_edge(context, region, start, end, point, arc);
    const sl_point enter =
        from > 0 && starts_outside ? (sl_point){p.x + from * along.x, p.y + from * along.y} : start;
    const sl_point leave =
        to < length && ends_outside ? (sl_point){p.x + to * along.x, p.y + to * along.y} : end;
    if (starts_outside) {
        SL_TRY(add_edge(context, region, start, enter, point, arc));
        edge.exact = false;
    }
    SL_TRY(add_edge(context, region, enter, leave, point, edge));
    return ends_outside ? add_edge(context, region, leave, end, point, arc) : SL_OK;
}

static sl_status cut(sl_context *context, sl_region *region, sl_point p, sl_point q, sl_point point,
                     sl_region_edge edge) {
    if (edge.kind == SL_EDGE_WALL || edge.kind == SL_EDGE_BORDER)
        return cut_edge(context, region, p, q, point, edge);
    bool starts_outside, ends_outside;
    const sl_point start = pulled_in(p, region->range, &starts_outside);
    const sl_point end = pulled_in(q, region->range, &ends_outside);
    edge.exact = edge.exact && !starts_outside;
    const bool radial = edge.kind != SL_EDGE_ARC;
    if (radial && starts_outside && ends_outside) return SL_OK;
    return add_edge(context, region, start, end, point, edge);
}

/// Arcs that meet where the region's first point is become one.
static void join_first_arc(sl_region *region) {
    const size_t last = region->count - 1;
    if (region->count < 3 || region->edges[0].kind != SL_EDGE_ARC ||
        region->edges[last].kind != SL_EDGE_ARC ||
        !(cross(region->offsets[last], region->offsets[1]) > 0))
        return;
    region->points[0] = region->points[last];
    region->offsets[0] = region->offsets[last];
    region->count = last;
}

sl_status sl_region_cut_range(sl_context *context, sl_region *region) {
    struct sl_region_memory *m = region->memory;
    const size_t count = region->count;
    m->whole.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &m->whole, count));
    for (size_t i = 0; i < count; i++)
        m->whole.items[i] =
            (sl_region_corner){region->points[i], region->offsets[i], region->edges[i]};
    region->count = 0;
    for (size_t i = 0; i < count; i++) {
        const sl_region_corner *c = &m->whole.items[i];
        const sl_point next = m->whole.items[(i + 1) % count].offset;
        SL_TRY(cut(context, region, c->offset, next, c->point, c->edge));
    }
    if (region->count) join_first_arc(region);
    return SL_OK;
}

/// What of the segment from p to q is within the circle; false for nothing.
static bool within_range(sl_point p, sl_point q, double range, sl_point *from, sl_point *to) {
    const double length = hypot(q.x - p.x, q.y - p.y);
    const sl_point along = {(q.x - p.x) / length, (q.y - p.y) / length};
    const double distance = fabs(cross(p, along)), foot = -(p.x * along.x + p.y * along.y);
    const double half =
        distance < range ? sqrt((range - distance) * (range + distance)) : -INFINITY;
    const double first = fmax(foot - half, 0), last = fmin(foot + half, length);
    if (!(first < last)) return false;
    *from = first > 0 ? (sl_point){p.x + first * along.x, p.y + first * along.y} : p;
    *to = last < length ? (sl_point){p.x + last * along.x, p.y + last * along.y} : q;
    return true;
}

/// Drops what lies to the right of the point where the circle meets the mirror: an arc.
static void trim_start(sl_region *region, sl_point start) {
    size_t drop = 0;
    while (drop + 1 < region->count && cross(start, region->offsets[drop + 1]) <= 0) drop++;
    for (size_t i = drop; i < region->count; i++) {
        region->points[i - drop] = region->points[i];
        region->offsets[i - drop] = region->offsets[i];
        region->edges[i - drop] = region->edges[i];
    }
    region->count -= drop;
    const sl_point eye = region->view.eye;
    region->offsets[0] = start;
    region->points[0] = (sl_point){eye.x + start.x, eye.y + start.y};
    region->edges[0] = (sl_region_edge){SL_NO_WALL, SL_EDGE_ARC, false};
}

sl_status sl_region_cut_mirrored(sl_context *context, sl_region *region) {
    const size_t last = region->count - 1;
    const sl_region_corner near = {region->points[last], region->offsets[last],
                                   region->edges[last]};
    const sl_point right = region->offsets[0], eye = region->view.eye;
    sl_point from, to;
    if (!within_range(near.offset, right, region->range, &from, &to)) {
        region->count = 0;
        return SL_OK;
    }
    SL_TRY(sl_region_cut_range(context, region));
    const bool cut_right = to.x != right.x || to.y != right.y;
    const bool cut_left = from.x != near.offset.x || from.y != near.offset.y;
    // Of the mirror, which is no wall that looks at the eye, the cut leaves at most its point.
    while (region->count && region->edges[region->count - 1].kind == SL_EDGE_MIRROR)
        region->count--;
    if (cut_right && region->count) trim_start(region, to);
    while (cut_left && region->count > 1 && cross(region->offsets[region->count - 1], from) <= 0)
        region->count--;
    sl_region_edge edge = near.edge;
    edge.exact = edge.exact && !cut_left;
    const sl_point point = cut_left ? (sl_point){eye.x + from.x, eye.y + from.y} : near.point;
    return sl_region_add_point(context, region, point, from, edge);
}
