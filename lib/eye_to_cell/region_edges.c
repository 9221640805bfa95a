/// The polygon as it grows: pieces of one wall become one edge, and between pieces that do not meet
/// stands an occluding edge. Where a piece ends is computed only when the next is known not to go
/// on along the same wall.
#include "eye_to_cell/region_parts.h"

#include <math.h>

/// A number as the unevaluated sum of two, for the few lines that a ray meets at a sharp angle.
typedef struct pair {
    double high, low;
} pair;

static pair quick_sum(double a, double b) {
    const double sum = a + b;
    return (pair){sum, b - (sum - a)};
}

/// Exact (Knuth; Shewchuk 1997, theorem 7).
static pair difference(double a, double b) {
    const double sum = a - b, part = sum - a;
    return (pair){sum, (a - (sum - part)) - (b + part)};
}

static pair product(pair a, pair b) {
    const double high = a.high * b.high;
    const double low = fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high);
    return quick_sum(high, low);
}

static pair minus(pair a, pair b) {
    const pair sum = difference(a.high, b.high);
    return quick_sum(sum.high, sum.low + (a.low - b.low));
}

static double cross_of_pairs(pair ax, pair ay, pair bx, pair by) {
    const pair cross = minus(product(ax, by), product(ay, bx));
    return cross.high + cross.low;
}

/// a x b for differences of points, to about a unit in the last place whatever cancels.
static double cross(sl_point from, sl_point to, sl_point other_from, sl_point other_to) {
    return cross_of_pairs(difference(to.x, from.x), difference(to.y, from.y),
                          difference(other_to.x, other_from.x),
                          difference(other_to.y, other_from.y));
}

sl_point sl_region_meet(sl_point eye, const sl_eye_ray *ray, sl_point a, sl_point b) {
    const sl_point d = ray->offset;
    // A line parallel to an axis, at a known distance: nothing cancels.
    if (a.x == b.x) return (sl_point){a.x - eye.x, d.y * ((a.x - eye.x) / d.x)};
    if (a.y == b.y) return (sl_point){d.x * ((a.y - eye.y) / d.y), a.y - eye.y};
    const double share = cross(eye, a, a, b) / cross(eye, ray->at, a, b);
    return (sl_point){d.x * share, d.y * share};
}

/// The sum of two doubles, and what it leaves out.
static double two_sum(double a, double b, double *rest) {
    const double sum = a + b, part = sum - a;
    *rest = (a - (sum - part)) + (b - part);
    return sum;
}

/// (a + a_rest) - (b + b_rest), to little more than one rounding but where nearly all cancels: what
/// is lost then is less than 2^-104 times the largest of them.
static double fine_difference(double a, double a_rest, double b, double b_rest) {
    double low, lower, lowest;
    const double high = two_sum(a, -b, &low);
    const double rests = two_sum(a_rest, -b_rest, &lower);
    const double middle = two_sum(low, rests, &lowest);
    return high + (middle + (lowest + lower));
}

sl_eye_ray sl_eye_ray_fine(const sl_eye_place *eye, const sl_fine *at) {
    const sl_fine *from = &eye->point;
    return (sl_eye_ray){at->at,
                        {fine_difference(at->at.x, at->rest.x, from->at.x, from->rest.x),
                         fine_difference(at->at.y, at->rest.y, from->at.y, from->rest.y)},
                        at->rest};
}

int sl_eye_turn_fine(const sl_eye_place *eye, const sl_eye_ray *a, const sl_eye_ray *b) {
    const double determinant = a->offset.x * b->offset.y - a->offset.y * b->offset.x;
    const int sign = sl_turn_filter(a->offset, b->offset);
    if (sign && fabs(determinant) > eye->slack) return sign;
    return sl_orient_fine(&eye->point, &(sl_fine){a->at, a->rest}, &(sl_fine){b->at, b->rest});
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

sl_status sl_region_add_point(sl_context *context, sl_region *region, sl_point point,
                              sl_point offset, sl_region_edge edge) {
    if (region->count == region->memory->room) SL_TRY(grow(context, region));
    if (region->count) {
        const sl_point last = region->points[region->count - 1];
        if (last.x == point.x && last.y == point.y) {
            // An edge shorter than what doubles can tell.
            region->count--;
            if (!region->count) region->memory->first = SL_PIECE_FAR;
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

static place place_of(sl_point eye, const sl_eye_ray *ray, bool at_end, sl_point a, sl_point b) {
    if (at_end) return (place){ray->at, ray->offset, true};
    const sl_point offset = sl_region_meet(eye, ray, a, b);
    const sl_point point = {within(a.x, eye.x + offset.x, b.x), within(a.y, eye.y + offset.y, b.y)};
    return (place){point, offset, false};
}

static place left_of(const sl_region *region, const sl_region_piece *p) {
    return place_of(region->view.eye, &p->left, p->to_end, p->a, p->b);
}

static sl_region_edge edge_along(uint32_t neighbour, bool exact) {
    if (neighbour == SL_PIECE_FAR) return (sl_region_edge){SL_NO_WALL, SL_EDGE_ARC, exact};
    if (neighbour >= SL_SIDE_BORDER) return (sl_region_edge){SL_NO_WALL, SL_EDGE_BORDER, exact};
    return (sl_region_edge){neighbour - SL_SIDE_WALL, SL_EDGE_WALL, exact};
}

static bool same(const place *a, const place *b) {
    return a->point.x == b->point.x && a->point.y == b->point.y;
}

/// Writes where the pending piece ends, unless that is where the next one starts.
static sl_status end_piece(sl_context *context, sl_region *region, const place *next,
                           sl_edge_kind kind) {
    const place end = left_of(region, &region->memory->piece);
    region->memory->pending = false;
    if (next && same(&end, next)) return SL_OK;
    const sl_region_edge edge = {SL_NO_WALL, (uint8_t)kind, end.exact};
    return sl_region_add_point(context, region, end.point, end.offset, edge);
}

sl_status sl_region_start_piece(sl_context *context, sl_region *region, uint32_t neighbour,
                                const sl_eye_ray *a, const sl_eye_ray *b, const sl_eye_ray *right) {
    struct sl_region_memory *m = region->memory;
    const place start = place_of(region->view.eye, right ? right : a, !right, a->at, b->at);
    if (region->count == 0) m->first = neighbour;
    if (m->pending) SL_TRY(end_piece(context, region, &start, SL_EDGE_OCCLUDING));
    m->piece.neighbour = neighbour;
    m->pending = true;
    return sl_region_add_point(context, region, start.point, start.offset,
                               edge_along(neighbour, start.exact));
}

sl_status sl_region_add_eye(sl_context *context, sl_region *region, sl_edge_kind kind) {
    const sl_region_edge edge = {SL_NO_WALL, (uint8_t)kind, true};
    const place eye = {region->view.eye, {0, 0}, true};
    if (region->memory->pending) SL_TRY(end_piece(context, region, &eye, SL_EDGE_BORDER));
    return sl_region_add_point(context, region, eye.point, eye.offset, edge);
}

sl_status sl_region_end_at_eye(sl_context *context, sl_region *region) {
    return end_piece(context, region, NULL, SL_EDGE_BORDER);
}

sl_status sl_region_add_on_mirror(sl_context *context, sl_region *region, const sl_eye_ray *ray,
                                  sl_point a, sl_point b, sl_region_edge edge) {
    const bool at_end = (ray->at.x == a.x && ray->at.y == a.y && !ray->rest.x && !ray->rest.y) ||
                        (ray->at.x == b.x && ray->at.y == b.y && !ray->rest.x && !ray->rest.y);
    const place at = place_of(region->view.eye, ray, at_end, a, b);
    if (region->memory->pending) SL_TRY(end_piece(context, region, &at, SL_EDGE_CONE));
    edge.exact = at.exact;
    return sl_region_add_point(context, region, at.point, at.offset, edge);
}

/// Whether the pending piece goes on as the first one.
static bool goes_around(const sl_region *region) {
    const struct sl_region_memory *m = region->memory;
    return region->count > 1 && m->piece.neighbour == m->first && m->first != SL_PIECE_FAR &&
           region->edges[0].kind != SL_EDGE_CONE;
}

sl_status sl_region_close(sl_context *context, sl_region *region) {
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
