/// Whether one point sees another, by the walls alone: no cell or portal is followed. Coordinates
/// are integers up to 2^20, so that all products are exact in 64 bits.
///
/// No wall may cross the way. What else the way meets are points of walls on it, and walls along
/// it. Beside these the way has a left and a right side:
///
///            | wall            BL: behind, left     FL: ahead, left
///        BL  |  FL
///     p -----*------- q        At * a wall to the left parts BL and FL. A wall along the way
///        BR     FR             parts the left from the right. The point is seen if some side
///                              leads from p to q.
///
/// At p, the way may begin on each side that no walls part from the eye's cell.
#ifndef SL_TESTS_TWO_POINTS_H
#define SL_TESTS_TWO_POINTS_H

#include "sightline/geometry.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// The walls, with shut doors and dark glass, and the way from p to q.
typedef struct two_points {
    const sl_segment *walls;
    size_t count;
    sl_point p, q;
    sl_point inward; ///< a point within the eye's cell, as seen from p; times any number above 0
} two_points;

static inline int64_t two_points_cross(sl_point o, sl_point a, sl_point b) {
    const int64_t ax = (int64_t)(a.x - o.x), ay = (int64_t)(a.y - o.y);
    const int64_t bx = (int64_t)(b.x - o.x), by = (int64_t)(b.y - o.y);
    return ax * by - ay * bx;
}

static inline int64_t two_points_dot(sl_point o, sl_point a, sl_point b) {
    const int64_t ax = (int64_t)(a.x - o.x), ay = (int64_t)(a.y - o.y);
    const int64_t bx = (int64_t)(b.x - o.x), by = (int64_t)(b.y - o.y);
    return ax * bx + ay * by;
}

static inline bool two_points_on(sl_segment wall, sl_point p) {
    return two_points_cross(p, wall.a, wall.b) == 0 && two_points_dot(p, wall.a, wall.b) <= 0;
}

/// The angle of a direction to another one, counter-clockwise: 0 for the same, else which half.
static inline int two_points_half(sl_point o, sl_point from, sl_point to) {
    const int64_t cross = two_points_cross(o, from, to);
    if (cross) return cross > 0 ? 1 : 3;
    return two_points_dot(o, from, to) > 0 ? 0 : 2;
}

/// Whether going counter-clockwise from a direction, b comes after a.
static inline bool two_points_after(sl_point o, sl_point from, sl_point a, sl_point b) {
    const int half_a = two_points_half(o, from, a), half_b = two_points_half(o, from, b);
    return half_a != half_b ? half_b > half_a : two_points_cross(o, a, b) > 0;
}

/// Whether no walls at p part the side just left (or right) of the way from the eye's cell.
static inline bool two_points_starts(const two_points *t, bool left) {
    const sl_point in = {t->p.x + t->inward.x, t->p.y + t->inward.y};
    bool before = false, after = false; // a wall on the way there counter-clockwise, or clockwise
    for (size_t i = 0; i < 2 * t->count; i++) {
        const sl_segment w = t->walls[i / 2];
        const sl_point end = i % 2 ? w.b : w.a;
        if (!two_points_on(w, t->p) || (end.x == t->p.x && end.y == t->p.y)) continue;
        const bool along = two_points_half(t->p, t->q, end) == 0;
        if (along ? left : two_points_after(t->p, in, end, t->q))
            before = true;
        else
            after = true;
    }
    return !before || !after;
}

/// Whether a wall at a point of the way leads off to its left (1) or right (-1).
static inline bool two_points_parts(const two_points *t, sl_point at, int side) {
    for (size_t i = 0; i < 2 * t->count; i++) {
        const sl_point end = i % 2 ? t->walls[i / 2].b : t->walls[i / 2].a;
        const int64_t cross = two_points_cross(t->p, t->q, end);
        if (two_points_on(t->walls[i / 2], at) && (side > 0 ? cross > 0 : cross < 0)) return true;
    }
    return false;
}

/// Whether a wall lies along the way between two points of it.
static inline bool two_points_covered(const two_points *t, sl_point from, sl_point to) {
    for (size_t i = 0; i < t->count; i++)
        if (two_points_on(t->walls[i], from) && two_points_on(t->walls[i], to)) return true;
    return false;
}

/// The next end of a wall on the way, or q.
static inline sl_point two_points_next(const two_points *t, sl_point at) {
    sl_point next = t->q;
    for (size_t i = 0; i < 2 * t->count; i++) {
        const sl_point end = i % 2 ? t->walls[i / 2].b : t->walls[i / 2].a;
        if (two_points_on((sl_segment){at, next}, end) && (end.x != at.x || end.y != at.y))
            next = end;
    }
    return next;
}

static inline bool two_points_crossed(const two_points *t) {
    for (size_t i = 0; i < t->count; i++) {
        const sl_segment w = t->walls[i];
        const int64_t a = two_points_cross(t->p, t->q, w.a), b = two_points_cross(t->p, t->q, w.b);
        const int64_t p = two_points_cross(w.a, w.b, t->p), q = two_points_cross(w.a, w.b, t->q);
        if (((a > 0 && b < 0) || (a < 0 && b > 0)) && ((p > 0 && q < 0) || (p < 0 && q > 0)))
            return true;
    }
    return false;
}

static inline bool two_points_see(const two_points *t) {
    if (t->p.x == t->q.x && t->p.y == t->q.y) return true;
    if (two_points_crossed(t)) return false;
    bool left = two_points_starts(t, true), right = two_points_starts(t, false);
    for (sl_point at = t->p; left || right;) {
        const sl_point next = two_points_next(t, at);
        if (!two_points_covered(t, at, next)) left = right = left || right;
        if (next.x == t->q.x && next.y == t->q.y) return true;
        at = next;
        left = left && !two_points_parts(t, at, 1);
        right = right && !two_points_parts(t, at, -1);
    }
    return false;
}

#endif
