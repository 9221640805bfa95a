/// The polygon of a visible region, as it grows and as its range cuts it.
///
/// Pieces of one wall join to one edge. Between two pieces that do not meet stands an occluding
/// edge. Where a piece ends is computed only when the next piece is known not to go on along the
/// same wall: so few intersections are computed, and each is good to a few units in the last place.
///
/// A range cuts the finished polygon by a circle about the eye, edge by edge. An edge on a wall
/// keeps what is inside the circle, with arcs before and after it; all in doubles.
#include "geometry/length.h"
#include "sight/region_parts.h"

#include <math.h>
#include <string.h>

#include "runtime/parts/pairs.h"

// --- intersections

sl_point sli_region_meet(sl_point eye, const sli_eye_ray *ray, sl_point a, sl_point b) {
    const sl_point d = ray->offset;
    // A line parallel to an axis, at a known distance: nothing cancels.
    if (a.x == b.x) return (sl_point){a.x - eye.x, d.y * ((a.x - eye.x) / d.x)};
    if (a.y == b.y) return (sl_point){d.x * ((a.y - eye.y) / d.y), a.y - eye.y};
    const slrt_pair x = slrt_difference(b.x, a.x), y = slrt_difference(b.y, a.y);
    const double share =
        slrt_cross(slrt_difference(a.x, eye.x), slrt_difference(a.y, eye.y), x, y) /
        slrt_cross(slrt_difference(ray->at.x, eye.x), slrt_difference(ray->at.y, eye.y), x, y);
    return (sl_point){d.x * share, d.y * share};
}

/// (a + a_rest) - (b + b_rest), good to little more than one rounding. Where nearly all cancels,
/// the error is below 2^-104 times the largest of the four.
static double fine_difference(double a, double a_rest, double b, double b_rest) {
    double low, lower, lowest;
    const double high = sli_two_sum(a, -b, &low);
    const double rests = sli_two_sum(a_rest, -b_rest, &lower);
    const double middle = sli_two_sum(low, rests, &lowest);
    return high + (middle + (lowest + lower));
}

sli_eye_ray sli_eye_ray_fine(const sli_eye_place *eye, const sli_fine *at) {
    const sli_fine *from = &eye->point;
    return (sli_eye_ray){at->at,
                         {fine_difference(at->at.x, at->rest.x, from->at.x, from->rest.x),
                          fine_difference(at->at.y, at->rest.y, from->at.y, from->rest.y)},
                         at->rest};
}

int sli_eye_turn_fine(const sli_eye_place *eye, const sli_eye_ray *a, const sli_eye_ray *b) {
    const double determinant = a->offset.x * b->offset.y - a->offset.y * b->offset.x;
    const int sign = sli_turn_filter(a->offset, b->offset);
    if (sign && fabs(determinant) > eye->slack) return sign;
    return sli_orient_fine(&eye->point, &(sli_fine){a->at, a->rest}, &(sli_fine){b->at, b->rest});
}

int sli_eye_turn_close(const sli_eye_place *eye, const sli_eye_ray *ray, sl_point at) {
    const sli_eye_ray other = sli_eye_ray_through(eye, at);
    return sli_eye_turn(eye, ray, &other);
}

static sl_status grow(sl_context *context, sl_region *region) {
    size_t room[3] = {region->memory->room, region->memory->room, region->memory->room};
    const size_t needed = region->count + 4;
    SL_TRY(sl_reserve(context, &region->points, &room[0], needed, sizeof *region->points));
    SL_TRY(sl_reserve(context, &region->offsets, &room[1], needed, sizeof *region->offsets));
    SL_TRY(sl_reserve(context, &region->edges, &room[2], needed, sizeof *region->edges));
    region->memory->room = room[0];
    return SL_OK;
}

/// Adds a point, given from the eye.
static sl_status add_point(sl_context *context, sl_region *region, sl_point point, sl_point offset,
                           sl_region_edge edge) {
    if (region->count == region->memory->room) SL_TRY(grow(context, region));
    if (region->count) {
        const sl_point last = region->points[region->count - 1];
        if (last.x == point.x && last.y == point.y) {
            // An edge shorter than a step of doubles.
            region->count--;
            if (!region->count) region->memory->first = SLI_PIECE_FAR;
        }
    }
    region->points[region->count] = point;
    region->offsets[region->count] = offset;
    region->edges[region->count++] = edge;
    return SL_OK;
}

/// An end of a piece.
typedef struct place {
    sl_point point, offset;
    bool exact;
} place;

static double within(double a, double value, double b) {
    const double low = a < b ? a : b, high = a < b ? b : a;
    return value < low ? low : value > high ? high : value;
}

static place place_of(sl_point eye, const sli_eye_ray *ray, bool at_end, sl_point a, sl_point b) {
    if (at_end) return (place){ray->at, ray->offset, true};
    const sl_point offset = sli_region_meet(eye, ray, a, b);
    const sl_point point = {within(a.x, eye.x + offset.x, b.x), within(a.y, eye.y + offset.y, b.y)};
    return (place){point, offset, false};
}

static place left_of(const sl_region *region, const sli_region_piece *p) {
    return place_of(region->view.eye, &p->left, p->to_end, p->a, p->b);
}

static sl_region_edge edge_along(uint32_t neighbour, bool exact) {
    if (neighbour == SLI_PIECE_FAR) return (sl_region_edge){SL_NO_WALL, SL_EDGE_ARC, exact};
    if (neighbour >= SL_SIDE_BORDER) return (sl_region_edge){SL_NO_WALL, SL_EDGE_BORDER, exact};
    if (neighbour < SL_SIDE_WALL)
        return (sl_region_edge){SL_LIMITED_WALL + neighbour, SL_EDGE_WALL, exact};
    return (sl_region_edge){neighbour - SL_SIDE_WALL, SL_EDGE_WALL, exact};
}

/// Adds the end of the pending piece, unless the next piece starts there.
static sl_status end_piece(sl_context *context, sl_region *region, const place *next,
                           sl_edge_kind kind) {
    const place end = left_of(region, &region->memory->piece);
    region->memory->pending = false;
    if (next && sli_same_point(end.point, next->point)) return SL_OK;
    const sl_region_edge edge = {SL_NO_WALL, (uint8_t)kind, end.exact};
    return add_point(context, region, end.point, end.offset, edge);
}

sl_status sli_region_start_piece(sl_context *context, sl_region *region, uint32_t neighbour,
                                 const sli_eye_ray *a, const sli_eye_ray *b,
                                 const sli_eye_ray *right) {
    struct sli_region_memory *m = region->memory;
    const place start = place_of(region->view.eye, right ? right : a, !right, a->at, b->at);
    if (region->count == 0) m->first = neighbour;
    const bool goes_on = !right && m->piece.to_end && sli_same_point(m->piece.left.at, a->at);
    if (m->pending && !goes_on) SL_TRY(end_piece(context, region, &start, SL_EDGE_OCCLUDING));
    m->piece.neighbour = neighbour;
    m->pending = true;
    return add_point(context, region, start.point, start.offset,
                     edge_along(neighbour, start.exact));
}

sl_status sli_region_add_eye(sl_context *context, sl_region *region, sl_edge_kind kind) {
    const sl_region_edge edge = {SL_NO_WALL, (uint8_t)kind, true};
    const place eye = {region->view.eye, {0, 0}, true};
    if (region->memory->pending) SL_TRY(end_piece(context, region, &eye, SL_EDGE_BORDER));
    return add_point(context, region, eye.point, eye.offset, edge);
}

sl_status sli_region_end_at_eye(sl_context *context, sl_region *region) {
    return end_piece(context, region, NULL, SL_EDGE_BORDER);
}

sl_status sli_region_add_on_mirror(sl_context *context, sl_region *region, const sli_eye_ray *ray,
                                   sl_point a, sl_point b, sl_region_edge edge) {
    const bool whole = ray->rest.x == 0 && ray->rest.y == 0;
    const bool at_end = (ray->at.x == a.x && ray->at.y == a.y && whole) ||
                        (ray->at.x == b.x && ray->at.y == b.y && whole);
    const place at = place_of(region->view.eye, ray, at_end, a, b);
    if (region->memory->pending) SL_TRY(end_piece(context, region, &at, SL_EDGE_CONE));
    edge.exact = at.exact;
    return add_point(context, region, at.point, at.offset, edge);
}

/// Whether the pending piece goes on as the first piece.
static bool goes_around(const sl_region *region) {
    const struct sli_region_memory *m = region->memory;
    return region->count > 1 && m->piece.neighbour == m->first && m->first != SLI_PIECE_FAR &&
           region->edges[0].kind != SL_EDGE_CONE;
}

sl_status sli_region_close(sl_context *context, sl_region *region) {
    if (!region->memory->pending) return SL_OK;
    if (goes_around(region)) {
        const size_t last = --region->count;
        region->memory->pending = false;
        region->points[0] = region->points[last];
        region->offsets[0] = region->offsets[last];
        region->edges[0] = region->edges[last];
        return SL_OK;
    }
    const place first = {region->points[0], region->offsets[0], region->edges[0].exact};
    return end_piece(context, region, &first, region->view.full ? SL_EDGE_OCCLUDING : SL_EDGE_CONE);
}

// --- cutting to the range

/// The point on the circle in a point's direction, or the point itself where it is inside.
static sl_point pulled_in(sl_point offset, double range, bool *moved) {
    const double length = sli_length(offset.x, offset.y);
    *moved = length > range;
    if (!*moved) return offset;
    return (sl_point){offset.x / length * range, offset.y / length * range};
}

/// The part of the segment from p to q that is inside the circle about the eye: `from` to `to`
/// along it. It is empty where `from` is not less than `to`.
typedef struct chord {
    sl_point along;
    double length, from, to;
} chord;

static chord chord_of(sl_point p, sl_point q, double range) {
    const double length = sli_length(q.x - p.x, q.y - p.y);
    const sl_point along = {(q.x - p.x) / length, (q.y - p.y) / length};
    const double distance = fabs(sli_cross(p, along)), foot = -sli_dot(p, along);
    const double half =
        distance < range ? sqrt((range - distance) * (range + distance)) : -INFINITY;
    return (chord){along, length, fmax(foot - half, 0), fmin(foot + half, length)};
}

static sl_point point_along(sl_point p, const chord *c, double at) {
    return (sl_point){p.x + at * c->along.x, p.y + at * c->along.y};
}

/// Starts an edge that is known to end at `end`.
static sl_status add_edge(sl_context *context, sl_region *region, sl_point start, sl_point end,
                          sl_point point, sl_region_edge edge) {
    if (start.x == end.x && start.y == end.y) return SL_OK;
    const bool arc = edge.kind == SL_EDGE_ARC;
    if (arc && region->count && region->edges[region->count - 1].kind == SL_EDGE_ARC &&
        sli_cross(region->offsets[region->count - 1], end) > 0)
        return SL_OK;
    const sl_point eye = region->view.eye;
    if (!edge.exact) point = (sl_point){eye.x + start.x, eye.y + start.y};
    return add_point(context, region, point, start, edge);
}

/// Cuts an edge on a wall or border: what is inside the circle stays, with arcs before and after
/// it.
static sl_status cut_edge(sl_context *context, sl_region *region, sl_point p, sl_point q,
                          sl_point point, sl_region_edge edge) {
    const double range = region->range;
    const chord c = chord_of(p, q, range);
    const sl_region_edge arc = {SL_NO_WALL, SL_EDGE_ARC, false};
    bool starts_outside, ends_outside;
    const sl_point start = pulled_in(p, range, &starts_outside);
    const sl_point end = pulled_in(q, range, &ends_outside);
    if (!(c.from < c.to)) return add_edge(context, region, start, end, point, arc);
    const sl_point enter = c.from > 0 && starts_outside ? point_along(p, &c, c.from) : start;
    const sl_point leave = c.to < c.length && ends_outside ? point_along(p, &c, c.to) : end;
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

/// Joins two arcs that meet at the region's first point.
static void join_first_arc(sl_region *region) {
    const size_t last = region->count - 1;
    if (region->count < 3 || region->edges[0].kind != SL_EDGE_ARC ||
        region->edges[last].kind != SL_EDGE_ARC ||
        !(sli_cross(region->offsets[last], region->offsets[1]) > 0))
        return;
    region->points[0] = region->points[last];
    region->offsets[0] = region->offsets[last];
    region->count = last;
}

sl_status sli_region_cut_range(sl_context *context, sl_region *region) {
    struct sli_region_memory *m = region->memory;
    const size_t count = region->count;
    m->whole.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &m->whole, count));
    for (size_t i = 0; i < count; i++)
        m->whole.items[i] =
            (sli_region_corner){region->points[i], region->offsets[i], region->edges[i]};
    region->count = 0;
    for (size_t i = 0; i < count; i++) {
        const sli_region_corner *c = &m->whole.items[i];
        const sl_point next = m->whole.items[(i + 1) % count].offset;
        SL_TRY(cut(context, region, c->offset, next, c->point, c->edge));
    }
    if (region->count) join_first_arc(region);
    return SL_OK;
}

/// The ends of the part of a segment inside the circle; false where there is none.
static bool within_range(sl_point p, sl_point q, double range, sl_point *from, sl_point *to) {
    const chord c = chord_of(p, q, range);
    if (!(c.from < c.to)) return false;
    *from = c.from > 0 ? point_along(p, &c, c.from) : p;
    *to = c.to < c.length ? point_along(p, &c, c.to) : q;
    return true;
}

/// Drops what lies to the right of the point where the circle meets the mirror, an arc.
static void trim_start(sl_region *region, sl_point start) {
    size_t drop = 0;
    while (drop + 1 < region->count && sli_cross(start, region->offsets[drop + 1]) <= 0) drop++;
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

sl_status sli_region_cut_mirrored(sl_context *context, sl_region *region) {
    const size_t last = region->count - 1;
    const sli_region_corner near = {region->points[last], region->offsets[last],
                                    region->edges[last]};
    const sl_point right = region->offsets[0], eye = region->view.eye;
    sl_point from, to;
    if (!within_range(near.offset, right, region->range, &from, &to)) {
        region->count = 0;
        return SL_OK;
    }
    SL_TRY(sli_region_cut_range(context, region));
    const bool cut_right = to.x != right.x || to.y != right.y;
    const bool cut_left = from.x != near.offset.x || from.y != near.offset.y;
    // The mirror is no wall that faces the eye: the cut leaves at most a point of it.
    while (region->count && region->edges[region->count - 1].kind == SL_EDGE_MIRROR)
        region->count--;
    if (cut_right && region->count) trim_start(region, to);
    while (cut_left && region->count > 1 &&
           sli_cross(region->offsets[region->count - 1], from) <= 0)
        region->count--;
    sl_region_edge edge = near.edge;
    edge.exact = edge.exact && !cut_left;
    const sl_point point = cut_left ? (sl_point){eye.x + from.x, eye.y + from.y} : near.point;
    return add_point(context, region, point, from, edge);
}
