/// How far may the eye move before a node's state can change?
///
/// A hidden node is hidden by a chain of occluders, each of which has the node behind its line and
/// the eye before it. The first begins right of the node, each next one right of where the last one
/// ended, and the last ends left of the node:
///
///          [ node ]
///        ---2---           Whether this holds depends only on which side of some lines the eye is:
///            -----1-----   the lines through the occluders, through their ends and the node's
///                          corners, and through the ends of neighbours in the chain. The node
///            eye           stays hidden until the eye reaches the nearest of these lines.
///
/// A part that is seen (a node, or a point of it) stays seen while no occluder meets the hull of
/// the eye and that part. The places from which an occluder hides something of it are bordered by
/// the occluder, and by the rays from its ends straight away from the part's corners. The part
/// stays seen until the eye reaches the nearest of these, over all occluders.
///
/// Invariant: distances are rounded down, so a state is never kept too long. Cost: O(occluders x
/// corners) for a node, and a few dozen operations for each frame in which the bound holds.
#include "geometry/length.h"
#include "sight/cone.h"
#include "study/walk/walk_parts.h"

#include <math.h>

#define SLACK  0x1p-50 ///< more than the rounding of a few operations, relative
#define FAR    32      ///< steps like the last that a bound is at most
#define ENOUGH 4       ///< steps like the last that a witness is to last
#define PULL   0.875   ///< how far out to the corners a witness is tried

// --- distances

/// No more than the distance from a point to the line through two others; 0 where rounding leaves
/// nothing that is sure. The bound on the determinant is that of sli_turn_filter, with room.
static double clearance(sl_point p, sl_point a, sl_point b) {
    const double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y;
    const double left = ax * by, right = ay * bx;
    const double area = fabs(left - right) - 8 * 0x1p-53 * (fabs(left) + fabs(right)) - 0x1p-900;
    const double length = sli_length(b.x - a.x, b.y - a.y) * (1 + SLACK);
    const double distance = area / length * (1 - SLACK);
    return distance > 0 ? distance : 0; // not NaN, where it overflows
}

double sli_walk_moved(sl_point from, sl_point to) {
    return sli_length(to.x - from.x, to.y - from.y) * (1 + SLACK) + 0x1p-900;
}

static bool hides_from(const sli_occluder *o, const sli_shape *shape) {
    for (uint32_t k = 0; k < shape->count; k++)
        if (sli_orient(o->a, o->b, shape->corners[k]) > 0) return false;
    return true;
}

/// The occluder that begins right of a point (or is in line with it) and ends farthest to the left,
/// of those that the shape is behind. NULL for none that gets past the point.
static const sli_occluder *farthest(const sli_shadows *s, const sli_shape *shape, sl_point from) {
    const sl_point eye = s->pivot.eye;
    const sli_occluder *best = NULL;
    for (size_t i = 0; i < s->occluders.count; i++) {
        const sli_occluder *o = &s->occluders.items[i];
        if (sli_orient(eye, o->a, from) < 0 || sli_orient(eye, from, o->b) <= 0) continue;
        if (best && sli_orient(eye, best->b, o->b) <= 0) continue;
        if (hides_from(o, shape)) best = o;
    }
    return best;
}

/// The least clearance of an eye from the lines through a point and a shape's corners.
static double clear_of_corners(sl_point eye, sl_point end, const sli_shape *shape) {
    double least = INFINITY;
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_point c = shape->corners[k];
        if (c.x != end.x || c.y != end.y) least = fmin(least, clearance(eye, end, c));
    }
    return least;
}

double sli_walk_hidden_bound(sl_walk *w, const sli_node_view *seen) {
    sli_shadows *s = &w->occlusion->shadows;
    const sl_point eye = s->pivot.eye;
    // The part outside the cone must be hidden too: the cone may turn.
    if (sli_shape_wedges(&s->pivot, &seen->shape, w->wedges) != 1) return 0;
    const sl_point left = w->wedges[0].left.point;
    sl_point at = w->wedges[0].right.point;
    double bound = INFINITY;
    const sli_occluder *before = NULL;
    while (bound > 0) {
        const sli_occluder *o = farthest(s, &seen->shape, at);
        if (!o) return 0;
        bound = fmin(bound, clearance(eye, o->a, o->b));
        if (!before)
            bound = fmin(bound, clear_of_corners(eye, o->a, &seen->shape));
        else if (before->b.x != o->a.x || before->b.y != o->a.y)
            bound = fmin(bound, clearance(eye, o->a, before->b));
        if (sli_orient(eye, left, o->b) >= 0)
            return fmin(bound, clear_of_corners(eye, o->b, &seen->shape));
        before = o;
        at = o->b;
    }
    return 0;
}

// --- while seen

/// No more than the distance between two points.
static double distance(sl_point p, sl_point q) {
    return sli_length(q.x - p.x, q.y - p.y) * (1 - SLACK);
}

/// Whether q may be ahead of p, in the direction from `back` to `front`. Where rounding decides,
/// the distances of both cases are nearly equal. Where it overflows or underflows the answer is
/// true: the caller then takes the distance from the line, which is no more.
static bool is_ahead(sl_point p, sl_point q, sl_point back, sl_point front) {
    return !((q.x - p.x) * (front.x - back.x) + (q.y - p.y) * (front.y - back.y) < -0x1p-900);
}

/// No more than the distance from the eye to the ray that starts at an end and leads straight away
/// from a corner.
static double to_ray(sl_point eye, sl_point end, sl_point corner) {
    if (sli_same_point(end, corner)) return INFINITY; // the shape has other corners
    return is_ahead(end, eye, corner, end) ? clearance(eye, corner, end) : distance(eye, end);
}

/// No more than the distance from the eye to an occluder.
static double to_occluder(sl_point eye, const sli_occluder *o) {
    if (!is_ahead(o->a, eye, o->a, o->b)) return distance(eye, o->a);
    if (!is_ahead(o->b, eye, o->b, o->a)) return distance(eye, o->b);
    return clearance(eye, o->a, o->b);
}

/// Whether an occluder is on one side of a line, on it included: 1 for the left.
static bool is_beside(sl_point from, sl_point to, const sli_occluder *o, int side) {
    return sli_orient(from, to, o->a) * side >= 0 && sli_orient(from, to, o->b) * side >= 0;
}

/// Whether an occluder meets the line of sight to a point; true where all is in line.
static bool meets_sight(sl_point eye, sl_point at, const sli_occluder *o) {
    return sli_orient(o->a, o->b, eye) * sli_orient(o->a, o->b, at) <= 0 &&
           sli_orient(eye, at, o->a) * sli_orient(eye, at, o->b) <= 0;
}

/// Whether an occluder stays clear of the line of sight to a point, or of the inside of the hull of
/// the eye and a node. Two convex sets are apart where the line of a side of one separates them.
static bool is_clear(sl_point eye, const sli_shape *shape, const sli_wedge *wedge,
                     const sli_occluder *o) {
    if (shape->count == 1) return !meets_sight(eye, shape->corners[0], o);
    if (wedge &&
        (is_beside(eye, wedge->right.point, o, -1) || is_beside(eye, wedge->left.point, o, 1)))
        return true;
    bool before = true;
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_point from = shape->corners[k], to = shape->corners[(k + 1) % shape->count];
        if (sli_orient(from, to, eye) >= 0 && is_beside(from, to, o, -1)) return true;
        before = before && sli_orient(o->a, o->b, from) >= 0;
    }
    return before;
}

/// Whether an occluder is at least a bound away from the box of the hull. It then cannot matter:
/// the hull moves no farther than the eye.
static bool is_far(const sl_box *hull, const sli_occluder *o, double bound) {
    const double reach = bound * (1 + SLACK);
    return fmin(o->a.x, o->b.x) - hull->max.x > reach ||
           hull->min.x - fmax(o->a.x, o->b.x) > reach ||
           fmin(o->a.y, o->b.y) - hull->max.y > reach || hull->min.y - fmax(o->a.y, o->b.y) > reach;
}

/// No more than the distance from the eye to a place where an occluder hides something of a shape,
/// and no more than `bound`.
static double to_shadow(sl_point eye, const sli_shape *shape, const sli_occluder *o, double bound) {
    bound = fmin(bound, to_occluder(eye, o));
    for (uint32_t k = 0; k < shape->count; k++) {
        bound = fmin(bound, to_ray(eye, o->a, shape->corners[k]));
        bound = fmin(bound, to_ray(eye, o->b, shape->corners[k]));
    }
    return bound;
}

/// How far the eye may move with a shape in view; 0 where that is not more than `least`.
static double seen_bound(sl_walk *w, const sli_shape *shape, const sli_wedge *wedge, double least) {
    const sli_shadows *s = &w->occlusion->shadows;
    const sl_point eye = s->pivot.eye;
    const sl_box hull = {{fmin(eye.x, shape->box.min.x), fmin(eye.y, shape->box.min.y)},
                         {fmax(eye.x, shape->box.max.x), fmax(eye.y, shape->box.max.y)}};
    double bound = w->moved > 0 ? FAR * w->moved : INFINITY;
    for (size_t i = 0; i < s->occluders.count && bound > 0; i++) {
        const sli_occluder *o = &s->occluders.items[i];
        if (is_far(&hull, o, bound)) continue;
        bound = to_shadow(eye, shape, o, bound);
        if (!(bound > least) || !is_clear(eye, shape, wedge, o)) bound = 0;
    }
    return bound;
}

double sli_walk_whole_bound(sl_walk *w, const sli_node_view *seen) {
    sli_pivot *pivot = &w->occlusion->shadows.pivot;
    const bool outside = sli_shape_wedges(pivot, &seen->shape, w->wedges) == 1;
    return seen_bound(w, &seen->shape, outside ? w->wedges : NULL, w->moved);
}

static bool holds_inside(const sli_shape *shape, sl_point p) {
    for (uint32_t k = 0; k < shape->count; k++)
        if (sli_orient(shape->corners[k], shape->corners[(k + 1) % shape->count], p) <= 0)
            return false;
    return true;
}

double sli_walk_witness_bound(sl_walk *w, const sli_node_view *seen, sl_point *witness) {
    const sli_shape *shape = &seen->shape;
    sl_point middle = {0, 0};
    for (uint32_t k = 0; k < shape->count; k++) {
        middle.x += shape->corners[k].x / shape->count;
        middle.y += shape->corners[k].y / shape->count;
    }
    double best = 0;
    for (uint32_t k = 0; k <= shape->count && best <= ENOUGH * w->moved; k++) {
        sl_point at = middle;
        if (k) {
            const sl_point corner = shape->corners[k - 1];
            at.x += PULL * (corner.x - middle.x);
            at.y += PULL * (corner.y - middle.y);
        }
        if (!sli_view_holds(&w->view, at) || !holds_inside(shape, at)) continue;
        const sli_shape point = {&at, 1, {at, at}, false};
        const double bound = seen_bound(w, &point, NULL, fmax(best, w->moved));
        if (bound > best) {
            best = bound;
            *witness = at;
        }
    }
    return best;
}
