/// Measures of a visible region (Benedikt 1979; Turner et al. 2001; depthmapX).
///
/// The region is star-shaped about the eye. Each edge and the eye make a triangle, or a sector
/// where the edge is an arc:
///
///       q ----- p      area = sum of p x q / 2, with p and q as offsets from the eye.
///        `.   .'       A radial edge (occluding, or the cone's border) adds no area.
///          eye
///
/// All these parts are at least 0, so nothing cancels between them. Integrals over directions (mean
/// radial, variance, skewness) have closed forms for each edge. Cost: O(edges).
#include "geometry/length.h"
#include "sightline/region.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double angle_between(sl_point a, sl_point b) {
    return atan2(sli_cross(a, b), sli_dot(a, b));
}

/// The angle of an arc. Rounding may turn the sign of half a circle.
static double angle_of_arc(sl_point a, sl_point b) {
    const double angle = angle_between(a, b);
    return sli_dot(a, b) < 0 ? fabs(angle) : angle;
}

static sl_point offset_after(const sl_region *region, size_t i) {
    return region->offsets[i + 1 < region->count ? i + 1 : 0];
}

static bool is_radial(const sl_region_edge *edge) {
    return edge->kind == SL_EDGE_OCCLUDING || edge->kind == SL_EDGE_CONE;
}

/// Twice the area between an edge and the eye.
static double double_area(const sl_region *region, size_t i) {
    const sl_point p = region->offsets[i], q = offset_after(region, i);
    if (is_radial(&region->edges[i])) return 0;
    if (region->edges[i].kind == SL_EDGE_ARC)
        return region->range * region->range * angle_of_arc(p, q);
    return sli_cross(p, q);
}

double sl_region_area(const sl_region *region) {
    double sum = 0;
    for (size_t i = 0; i < region->count; i++) sum += double_area(region, i);
    return sum / 2;
}

bool sl_region_meets_border(const sl_region *region) {
    for (size_t i = 0; i < region->count; i++)
        if (region->edges[i].kind == SL_EDGE_BORDER) return true;
    return false;
}

/// Integrals over the directions of the view: of 1, and of the radial's first three powers.
typedef struct moments {
    double angle, first, second, third;
} moments;

/// The moments of an edge. On a segment at distance h, the radial at angle a from the perpendicular
/// has length h / cos a.
static moments moments_of(const sl_region *region, size_t i) {
    const sl_point p = region->offsets[i], q = offset_after(region, i);
    moments m = {.angle = angle_between(p, q)};
    if (region->edges[i].kind == SL_EDGE_ARC) {
        m.angle = angle_of_arc(p, q);
        m.first = region->range * m.angle;
        m.second = region->range * m.first;
        m.third = region->range * m.second;
        return m;
    }
    const double length = sli_length(q.x - p.x, q.y - p.y);
    const sl_point along = {(q.x - p.x) / length, (q.y - p.y) / length};
    const double h = sli_cross(p, along), from = sli_dot(p, along), to = sli_dot(q, along);
    if (!(h > 0)) return (moments){0};
    const double turned = asinh(to / h) - asinh(from / h);
    m.first = h * turned;
    m.second = sli_cross(p, q);
    m.third = h * (to * sli_length(h, to) - from * sli_length(h, from) + h * h * turned) / 2;
    return m;
}

static double distance_to(sl_point p, sl_point q) {
    const sl_point d = {q.x - p.x, q.y - p.y};
    const double square = sli_dot(d, d), share = square > 0 ? -sli_dot(p, d) / square : 0;
    if (!(share > 0)) return sli_length(p.x, p.y);
    if (!(share < 1)) return sli_length(q.x, q.y);
    return fabs(sli_cross(p, d)) / sqrt(square);
}

/// Three times the first moment of the area between an edge and the eye.
static sl_point pull_of(const sl_region *region, size_t i) {
    const sl_point p = region->offsets[i], q = offset_after(region, i);
    if (is_radial(&region->edges[i])) return (sl_point){0, 0};
    if (region->edges[i].kind == SL_EDGE_ARC) {
        const double square = region->range * region->range;
        return (sl_point){square * (q.y - p.y), square * (p.x - q.x)};
    }
    const double half = sli_cross(p, q) / 2;
    return (sl_point){half * (p.x + q.x), half * (p.y + q.y)};
}

static void add_drift(const sl_region *region, sl_region_measures *out) {
    sl_point pull = {0, 0};
    for (size_t i = 0; i < region->count; i++) {
        const sl_point part = pull_of(region, i);
        pull.x += part.x;
        pull.y += part.y;
    }
    if (!(out->area > 0)) return;
    const sl_point drift = {pull.x / 3 / out->area, pull.y / 3 / out->area};
    const double degrees = atan2(drift.y, drift.x) * (180 / pi), turned = degrees + 360;
    out->drift_magnitude = sli_length(drift.x, drift.y);
    out->drift_angle = !(degrees < 0) ? degrees : turned < 360 ? turned : 0;
}

static void add_radials(const sl_region *region, sl_region_measures *out) {
    moments sum = {0};
    out->min_radial = INFINITY;
    for (size_t i = 0; i < region->count; i++) {
        const sl_region_edge *edge = &region->edges[i];
        const sl_point p = region->offsets[i], q = offset_after(region, i);
        out->max_radial = fmax(out->max_radial, sli_length(p.x, p.y));
        if (edge->kind != SL_EDGE_CONE)
            out->min_radial = fmin(out->min_radial,
                                   edge->kind == SL_EDGE_ARC ? region->range : distance_to(p, q));
        if (is_radial(edge)) continue;
        const moments m = moments_of(region, i);
        sum.angle += m.angle;
        sum.first += m.first;
        sum.second += m.second;
        sum.third += m.third;
    }
    if (!(sum.angle > 0)) return;
    const double mean = sum.first / sum.angle, square = sum.second / sum.angle;
    out->mean_radial = mean;
    out->radial_variance = fmax(square - mean * mean, 0);
    out->radial_skewness = sum.third / sum.angle - 3 * mean * square + 2 * mean * mean * mean;
}

sl_region_measures sl_region_measure(const sl_region *region) {
    sl_region_measures out = {0};
    if (!region->count) return out;
    out.area = sl_region_area(region);
    for (size_t i = 0; i < region->count; i++) {
        const sl_point p = region->offsets[i], q = offset_after(region, i);
        const double length = region->edges[i].kind == SL_EDGE_ARC
                                  ? region->range * angle_of_arc(p, q)
                                  : sli_length(q.x - p.x, q.y - p.y);
        out.perimeter += length;
        if (region->edges[i].kind == SL_EDGE_OCCLUDING) out.occlusivity += length;
    }
    if (out.perimeter > 0) out.compactness = 4 * pi * out.area / (out.perimeter * out.perimeter);
    add_drift(region, &out);
    add_radials(region, &out);
    return out;
}

static bool ends_at(const sl_space *space, const sl_region_edge *edge, sl_point point) {
    if (edge->kind != SL_EDGE_WALL || edge->wall >= space->wall_count) return false;
    const sl_wall *w = &space->walls[edge->wall];
    return (w->a.x == point.x && w->a.y == point.y) || (w->b.x == point.x && w->b.y == point.y);
}

size_t sl_region_corners(const sl_region *region, const sl_space *space, sl_point *corners,
                         size_t room) {
    size_t found = 0;
    for (size_t i = 0; i < region->count; i++) {
        const sl_region_edge *before = &region->edges[i ? i - 1 : region->count - 1];
        const sl_point point = region->points[i];
        if (!region->edges[i].exact) continue;
        if (!ends_at(space, before, point) && !ends_at(space, &region->edges[i], point)) continue;
        if (found < room) corners[found] = point;
        found++;
    }
    return found;
}

size_t sl_region_flatten(const sl_region *region, double tolerance, sl_point *points, size_t room) {
    size_t count = 0;
    for (size_t i = 0; i < region->count; i++) {
        if (count < room) points[count] = region->points[i];
        count++;
        if (region->edges[i].kind != SL_EDGE_ARC) continue;
        const sl_point from = region->offsets[i];
        const double angle = angle_of_arc(from, offset_after(region, i));
        const double step = 2 * acos(fmax(1 - tolerance / region->range, 0));
        const double chords = fmin(ceil(angle / fmax(step, 1e-4)), 65536);
        for (double k = 1; k < chords; k++, count++) {
            const double turn = angle * k / chords, c = cos(turn), s = sin(turn);
            if (count < room)
                points[count] = (sl_point){region->view.eye.x + c * from.x - s * from.y,
                                           region->view.eye.y + s * from.x + c * from.y};
        }
    }
    return count;
}
