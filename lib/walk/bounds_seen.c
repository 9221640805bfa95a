/// How far the eye may move before something of a node that is seen can be hidden by the occluders
/// chosen.
///
/// An occluder hides a part of the plane, a point or a node, from where it meets the hull of the
/// eye and that part. All the places from which it does so are the occluder and what is behind it;
/// they are bordered by the occluder and by the rays from its ends straight away from the part's
/// corners. So the part stays seen while the eye moves less than to the nearest of these, past any
/// of the occluders. Distances are rounded down.
#include "walk/walk_parts.h"

#include <math.h>

#define SLACK  SL_WALK_SLACK
#define FAR    32    ///< steps like the last that a bound is at most
#define ENOUGH 4     ///< steps like the last that a witness is to last
#define PULL   0.875 ///< how far out to the corners a witness is looked for

/// No more than the distance between two points.
static double distance(sl_point p, sl_point q) {
    return sl_walk_length(q.x - p.x, q.y - p.y) * (1 - SLACK);
}

/// Whether q may be ahead of p, in the direction from `back` to `front`. Where roundings of it
/// decide, the distances on both sides are the same but for less; where it overflows or underflows
/// the distance from the line is taken, which is no more.
static bool is_ahead(sl_point p, sl_point q, sl_point back, sl_point front) {
    return !((q.x - p.x) * (front.x - back.x) + (q.y - p.y) * (front.y - back.y) < -0x1p-900);
}

/// Likewise from the eye to the ray that starts at an end and leads straight away
/// from a corner.
static double to_ray(sl_point eye, sl_point end, sl_point corner) {
    if (sl_same_point(end, corner)) return INFINITY; // the shape has other corners
    return is_ahead(end, eye, corner, end) ? sl_walk_clearance(eye, corner, end)
                                           : distance(eye, end);
}

/// Likewise to an occluder.
static double to_occluder(sl_point eye, const sl_occluder *o) {
    if (!is_ahead(o->a, eye, o->a, o->b)) return distance(eye, o->a);
    if (!is_ahead(o->b, eye, o->b, o->a)) return distance(eye, o->b);
    return sl_walk_clearance(eye, o->a, o->b);
}

/// Whether an occluder is on one side of a line, on it included: 1 for the left.
static bool is_beside(sl_point from, sl_point to, const sl_occluder *o, int side) {
    return sl_orient(from, to, o->a) * side >= 0 && sl_orient(from, to, o->b) * side >= 0;
}

/// Whether an occluder meets the sight of a point. Where all is in line, taken as if.
static bool meets_sight(sl_point eye, sl_point at, const sl_occluder *o) {
    return sl_orient(o->a, o->b, eye) * sl_orient(o->a, o->b, at) <= 0 &&
           sl_orient(eye, at, o->a) * sl_orient(eye, at, o->b) <= 0;
}

/// Whether an occluder stays clear of a point's sight, or of the inside of the hull of the eye and
/// a node: convex things are apart where the line of a side of one of them parts them.
static bool is_clear(sl_point eye, const sl_shape *shape, const sl_sector *sector,
                     const sl_occluder *o) {
    if (shape->count == 1) return !meets_sight(eye, shape->corners[0], o);
    if (sector &&
        (is_beside(eye, sector->right.point, o, -1) || is_beside(eye, sector->left.point, o, 1)))
        return true;
    bool before = true;
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_point from = shape->corners[k], to = shape->corners[(k + 1) % shape->count];
        if (sl_orient(from, to, eye) >= 0 && is_beside(from, to, o, -1)) return true;
        before = before && sl_orient(o->a, o->b, from) >= 0;
    }
    return before;
}

/// Whether an occluder is no nearer than a bound to the box of the hull. It does not matter then:
/// the hull moves no farther than the eye.
static bool is_far(const sl_box *hull, const sl_occluder *o, double bound) {
    const double reach = bound * (1 + SLACK);
    return fmin(o->a.x, o->b.x) - hull->max.x > reach ||
           hull->min.x - fmax(o->a.x, o->b.x) > reach ||
           fmin(o->a.y, o->b.y) - hull->max.y > reach || hull->min.y - fmax(o->a.y, o->b.y) > reach;
}

/// No more than the distance from the eye to where an occluder hides something of a shape, and than
/// a bound.
static double to_shadow(sl_point eye, const sl_shape *shape, const sl_occluder *o, double bound) {
    bound = fmin(bound, to_occluder(eye, o));
    for (uint32_t k = 0; k < shape->count; k++) {
        bound = fmin(bound, to_ray(eye, o->a, shape->corners[k]));
        bound = fmin(bound, to_ray(eye, o->b, shape->corners[k]));
    }
    return bound;
}

/// How far the eye may move with a shape in view: 0 for no more than a least given.
static double seen_bound(sl_walk *w, const sl_shape *shape, const sl_sector *sector, double least) {
    const sl_shadows *s = &w->occlusion->shadows;
    const sl_point eye = s->pivot.eye;
    const sl_box hull = {{fmin(eye.x, shape->box.min.x), fmin(eye.y, shape->box.min.y)},
                         {fmax(eye.x, shape->box.max.x), fmax(eye.y, shape->box.max.y)}};
    double bound = w->moved > 0 ? FAR * w->moved : INFINITY;
    for (size_t i = 0; i < s->occluders.count && bound > 0; i++) {
        const sl_occluder *o = &s->occluders.items[i];
        if (is_far(&hull, o, bound)) continue;
        bound = to_shadow(eye, shape, o, bound);
        if (!(bound > least) || !is_clear(eye, shape, sector, o)) bound = 0;
    }
    return bound;
}

double sl_walk_whole_bound(sl_walk *w, const sl_walk_look *look) {
    sl_pivot *pivot = &w->occlusion->shadows.pivot;
    const bool outside = sl_shape_sectors(pivot, &look->shape, w->sectors) == 1;
    return seen_bound(w, &look->shape, outside ? w->sectors : NULL, w->moved);
}

static bool holds_inside(const sl_shape *shape, sl_point p) {
    for (uint32_t k = 0; k < shape->count; k++)
        if (sl_orient(shape->corners[k], shape->corners[(k + 1) % shape->count], p) <= 0)
            return false;
    return true;
}

double sl_walk_witness_bound(sl_walk *w, const sl_walk_look *look, sl_point *witness) {
    const sl_shape *shape = &look->shape;
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
        if (!sl_view_holds(&w->view, at) || !holds_inside(shape, at)) continue;
        const sl_shape point = {&at, 1, {at, at}, false};
        const double bound = seen_bound(w, &point, NULL, fmax(best, w->moved));
        if (bound > best) {
            best = bound;
            *witness = at;
        }
    }
    return best;
}
