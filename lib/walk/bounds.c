/// How far the eye may move before a hidden node can be seen.
///
/// A node is hidden from an eye by a chain of occluders if the node is behind the line of each, the
/// eye before it, and each begins right of where the one before it ends, the first right of the
/// node, the last left of it. All that is said of the eye is on which side it lies of lines through
/// two given points; so the node stays hidden while the eye moves less than to the nearest of them,
/// whichever occluders are chosen then and wherever the eye looks. Distances are rounded down.
#include "walk/walk_parts.h"

#include <math.h>

#define SLACK SL_WALK_SLACK

/// The bound on the determinant is that of sl_turn_filter, with room.
double sl_walk_clearance(sl_point p, sl_point a, sl_point b) {
    const double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y;
    const double left = ax * by, right = ay * bx;
    const double area = fabs(left - right) - 8 * 0x1p-53 * (fabs(left) + fabs(right)) - 0x1p-900;
    const double length = sl_walk_length(b.x - a.x, b.y - a.y) * (1 + SLACK);
    const double distance = area / length * (1 - SLACK);
    return distance > 0 ? distance : 0; // not NaN, where it overflows
}

double sl_walk_length(double x, double y) {
    const double square = x * x + y * y;
    return square > 0x1p-900 && square < 0x1p900 ? sqrt(square) : hypot(x, y);
}

double sl_walk_moved(sl_point from, sl_point to) {
    return sl_walk_length(to.x - from.x, to.y - from.y) * (1 + SLACK) + 0x1p-900;
}

static bool hides_from(const sl_occluder *o, const sl_shape *shape) {
    for (uint32_t k = 0; k < shape->count; k++)
        if (sl_orient(o->a, o->b, shape->corners[k]) > 0) return false;
    return true;
}

/// The occluder that begins right of a point (or is in line with it) and ends farthest to the left,
/// of those that the shape is behind. NULL for none that gets past the point.
static const sl_occluder *farthest(const sl_shadows *s, const sl_shape *shape, sl_point from) {
    const sl_point eye = s->pivot.eye;
    const sl_occluder *best = NULL;
    for (size_t i = 0; i < s->occluders.count; i++) {
        const sl_occluder *o = &s->occluders.items[i];
        if (sl_orient(eye, o->a, from) < 0 || sl_orient(eye, from, o->b) <= 0) continue;
        if (best && sl_orient(eye, best->b, o->b) <= 0) continue;
        if (hides_from(o, shape)) best = o;
    }
    return best;
}

/// The least clearance of an eye from the lines through a point and a shape's corners.
static double clear_of_corners(sl_point eye, sl_point end, const sl_shape *shape) {
    double least = INFINITY;
    for (uint32_t k = 0; k < shape->count; k++) {
        const sl_point c = shape->corners[k];
        if (c.x != end.x || c.y != end.y) least = fmin(least, sl_walk_clearance(eye, end, c));
    }
    return least;
}

double sl_walk_hidden_bound(sl_walk *w, const sl_walk_look *look) {
    sl_shadows *s = &w->occlusion->shadows;
    const sl_point eye = s->pivot.eye;
    // What is outside the cone must be hidden too: the cone may turn.
    if (sl_shape_sectors(&s->pivot, &look->shape, w->sectors) != 1) return 0;
    const sl_point left = w->sectors[0].left.point;
    sl_point at = w->sectors[0].right.point;
    double bound = INFINITY;
    const sl_occluder *before = NULL;
    while (bound > 0) {
        const sl_occluder *o = farthest(s, &look->shape, at);
        if (!o) return 0;
        bound = fmin(bound, sl_walk_clearance(eye, o->a, o->b));
        if (!before)
            bound = fmin(bound, clear_of_corners(eye, o->a, &look->shape));
        else if (before->b.x != o->a.x || before->b.y != o->a.y)
            bound = fmin(bound, sl_walk_clearance(eye, o->a, before->b));
        if (sl_orient(eye, left, o->b) >= 0)
            return fmin(bound, clear_of_corners(eye, o->b, &look->shape));
        before = o;
        at = o->b;
    }
    return 0;
}
