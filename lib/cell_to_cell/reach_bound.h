/// Directions from a point, compared.
#ifndef SL_REACH_BOUND_H
#define SL_REACH_BOUND_H

#include "cell_to_cell/reach.h"

#include "geometry/orient.h"

static inline sl_point sl_end_of(const sl_reacher *r, uint32_t end) {
    return r->ends->ends.items[end];
}

/// From the point to an end.
static inline sl_point sl_towards(const sl_reacher *r, uint32_t end) {
    const sl_point at = sl_end_of(r, end);
    return (sl_point){at.x - r->from.x, at.y - r->from.y};
}

static inline double sl_cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

/// Where rounding may have changed a cross product's sign. It must not be inlined: it is rare.
int sl_ends_turn_exact(const sl_reacher *r, uint32_t a, uint32_t b);

/// On which side of the direction to `a` the end `b` lies: 1 counter-clockwise, -1 clockwise, 0 on
/// its line.
static inline int sl_ends_turn(const sl_reacher *r, uint32_t a, uint32_t b) {
    if (a == b) return 0;
    const double cross = sl_cross(sl_towards(r, a), sl_towards(r, b));
    if (cross > r->limit) return 1;
    if (cross < -r->limit) return -1;
    return sl_ends_turn_exact(r, a, b);
}

static inline int sl_bound_side(const sl_reacher *r, sl_bound bound, uint32_t end) {
    const int sign = sl_ends_turn(r, bound.end, end);
    return bound.away ? -sign : sign;
}

/// Whether an end on a bound's line lies in its direction.
static inline bool sl_bound_has(const sl_reacher *r, sl_bound bound, uint32_t end) {
    return bound.end == end
               ? !bound.away
               : sl_opposite(r->from, sl_end_of(r, bound.end), sl_end_of(r, end)) == bound.away;
}

/// By how much `b` is beyond `a`, of two directions less than half a turn apart: 1, 0, -1.
static inline int sl_bounds_turn(const sl_reacher *r, sl_bound a, sl_bound b) {
    const int sign = sl_ends_turn(r, a.end, b.end);
    return a.away != b.away ? -sign : sign;
}

/// Whether directions lie between the end of an interval and the start of another.
static inline bool sl_is_gap(const sl_reacher *r, sl_bound high, sl_bound low) {
    const int turn = sl_bounds_turn(r, high, low);
    // Levels -1 and 1 follow each other. Of open sight single directions do not matter.
    return turn > 0 || (turn == 0 && r->closed && low.level - high.level > 2);
}

static inline bool sl_is_before(const sl_reacher *r, sl_bound a, sl_bound b) {
    const int turn = sl_bounds_turn(r, a, b);
    return turn > 0 || (turn == 0 && a.level < b.level);
}

/// Which level of its direction crosses a portal that lies on a ray from the point.
int8_t sl_level_along(const sl_reacher *r, const sl_walk_portal *e);

#endif
