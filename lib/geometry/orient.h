/// The exact predicates: all signs about points and lines are decided here and in
/// crossing.h.
#ifndef SL_ORIENT_H
#define SL_ORIENT_H

#include "base/wide.h"
#include "sightline/geometry.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD < 0
#error "this compiler computes doubles with more bits, so signs are wrong: use -msse2 -mfpmath=sse"
#endif

static inline bool sli_box_holds(const sl_box *box, sl_point p) {
    return p.x >= box->min.x && p.x <= box->max.x && p.y >= box->min.y && p.y <= box->max.y;
}

static inline bool sli_same_point(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// A value as a coordinate: 0 where it is too small to be used (SL_COORDINATE_MIN). What cannot be
/// a coordinate stays as it is: sl_coordinate_usable() says so.
static inline double sli_coordinate(double value) {
    return fabs(value) < SL_COORDINATE_MIN ? copysign(0, value) : value;
}

static inline sl_point sli_coordinates(sl_point point) {
    return (sl_point){sli_coordinate(point.x), sli_coordinate(point.y)};
}

/// Whether corner i of a polygon is where the corner before it is.
static inline bool sli_corner_repeats(const sl_point *corners, size_t count, size_t i) {
    return sli_same_point(corners[i], corners[i ? i - 1 : count - 1]);
}

/// How many corners a polygon has where repeated ones count once.
static inline size_t sli_distinct_corners(const sl_point *corners, size_t count) {
    size_t distinct = 0;
    for (size_t i = 0; i < count; i++) distinct += !sli_corner_repeats(corners, count, i);
    return distinct;
}

/// The order of points: by x, then by y. The sign of a - b.
static inline int sli_compare_points(sl_point a, sl_point b) {
    if (a.x != b.x) return a.x < b.x ? -1 : 1;
    return (a.y > b.y) - (a.y < b.y);
}

/// Of items that begin with a point, by which they are sorted (sli_compare_points), the first that
/// is not before `at`; `count` if all are. `size`: of an item.
static inline size_t sli_first_at(const void *items, size_t size, size_t count, sl_point at) {
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const void *item = (const char *)items + middle * size;
        if (sli_compare_points(*(const sl_point *)item, at) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/// As sli_orient, by exact arithmetic only.
int sli_orient_exact(sl_point a, sl_point b, sl_point c);

/// The sign of a x b for two vectors whose coordinates are differences, each rounded once. 0 where
/// rounding may have changed the sign.
///
/// The filter is Shewchuk's (1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust
/// Geometric Predicates, section 4.1): the rounded determinant has the right sign when it is larger
/// than (3 + 16e)e times the sum of its two products, e = 2^-53. The last term of the bound is
/// larger than what a product loses by underflow. An overflow makes both comparisons false. The
/// bound also holds where the compiler fuses a product into the difference.
static inline int sli_turn_filter(sl_point a, sl_point b) {
    const double left = a.x * b.y, right = a.y * b.x;
    const double determinant = left - right;
    const double sum = fabs(left) + fabs(right);
    const double bound = (3 * 0x1p-53 + 16 * 0x1p-106) * sum + 0x1p-1000;
    return (determinant > bound) - (-determinant > bound);
}

/// The limit that a x b must exceed for its sign to be sure, for every b whose coordinates are no
/// larger than those of `reach`. It is the bound above for the largest products, rounded up.
static inline double sli_turn_limit(sl_point a, sl_point reach) {
    return 4 * 0x1p-53 * (fabs(a.x) * reach.y + fabs(a.y) * reach.x) + 0x1p-1000;
}

/// As sli_turn_filter with the limit of `a`: cheaper for many b with the same a.
static inline int sli_turn_filter_within(sl_point a, sl_point b, double limit) {
    const double determinant = a.x * b.y - a.y * b.x;
    return determinant > limit ? 1 : determinant < -limit ? -1 : 0;
}

/// The sign of (b - a) x (c - a); 0 where rounding may have changed it.
static inline int sli_orient_filter(sl_point a, sl_point b, sl_point c) {
    return sli_turn_filter((sl_point){a.x - c.x, a.y - c.y}, (sl_point){b.x - c.x, b.y - c.y});
}

/// The sign of (b - a) x (c - a): 1 where c lies to the left of the line from a to b, -1 to the
/// right, 0 on it. Exact for all finite doubles, also near overflow and underflow.
static inline int sli_orient(sl_point a, sl_point b, sl_point c) {
    const int sign = sli_orient_filter(a, b, c);
    return sign ? sign : sli_orient_exact(a, b, c);
}

/// Whether the way from a through p to b goes straight on or turns left. A way back is neither.
static inline bool sli_goes_on(sl_point a, sl_point p, sl_point b) {
    const int turn = sli_orient(a, p, b);
    if (turn) return turn > 0;
    return !sli_same_point(a, p) && !sli_same_point(p, b) && (a.x < p.x) == (p.x < b.x) &&
           (a.x > p.x) == (p.x > b.x) && (a.y < p.y) == (p.y < b.y) && (a.y > p.y) == (p.y > b.y);
}

/// The order of points around a place, which comes first: counter-clockwise from the direction of
/// x, the nearest first in each direction. Exact.
static inline int sli_compare_around(sl_point at, sl_point a, sl_point b) {
    const bool upper = a.y > at.y || (a.y == at.y && a.x > at.x),
               other = b.y > at.y || (b.y == at.y && b.x > at.x);
    if (sli_same_point(a, b)) return 0;
    if (sli_same_point(a, at) || sli_same_point(b, at)) return sli_same_point(a, at) ? -1 : 1;
    if (upper != other) return upper ? -1 : 1;
    const int turn = sli_orient(at, a, b);
    return turn ? -turn : sli_goes_on(at, a, b) ? -1 : 1;
}

/// A point finer than doubles: at + rest. `rest` is at most half a unit in the last place of `at`.
/// Places in mirrored space are sums of coordinates, and so need it.
typedef struct sli_fine {
    sl_point at, rest;
} sli_fine;

/// As sli_orient, of fine points.
int sli_orient_fine(const sli_fine *a, const sli_fine *b, const sli_fine *c);

/// The sign of a x b, exact. `scale` is a power of two; the coordinates of both vectors, times
/// `scale`, must be whole numbers below 2^62.
static inline int sli_turn_grid(sl_point a, sl_point b, double scale) {
    const int order = sli_compare_products((int64_t)(a.x * scale), (int64_t)(b.y * scale),
                                           (int64_t)(a.y * scale), (int64_t)(b.x * scale));
    return order;
}

/// As sli_turn, by exact arithmetic only.
int sli_turn_exact(sl_point a, sl_point b, sl_point c, sl_point d);

/// The sign of (b - a) x (d - c): 1 where the direction from c to d lies to the left of that from a
/// to b, by less than half a turn; -1 to the right; 0 where both lie in one line. Exact for all
/// finite doubles.
static inline int sli_turn(sl_point a, sl_point b, sl_point c, sl_point d) {
    const int sign =
        sli_turn_filter((sl_point){b.x - a.x, b.y - a.y}, (sl_point){d.x - c.x, d.y - c.y});
    return sign ? sign : sli_turn_exact(a, b, c, d);
}

#endif
