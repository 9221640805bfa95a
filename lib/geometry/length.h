/// Lengths, sums, cross and dot products, and the lesser and the greater of two numbers. A length
/// is the same to the last bit on every machine. The hypot of mathematical libraries is not: they
/// round differently, some by the processor they find. A difference of one bit is enough to cut a
/// map another way.
#ifndef SLI_LENGTH_H
#define SLI_LENGTH_H

#include "sightline/geometry.h"

#include <math.h>

/// Off by less than a unit in the last place and a half; coordinates may be as large and as small
/// as they are allowed to be. Of two vectors of which one is the other mirrored or turned by 90
/// degrees, both lengths are equal.
static inline double sli_length(double x, double y) {
    const double square = x * x + y * y;
    if (square > 0x1p-900 && square < 0x1p900) return sqrt(square);
    const double most = fmax(fabs(x), fabs(y));
    if (!(most > 0)) return most;
    int exponent;
    frexp(most, &exponent); // powers of 2 are exact
    const double u = ldexp(x, -exponent), v = ldexp(y, -exponent);
    return ldexp(sqrt(u * u + v * v), exponent);
}

/// a x b, rounded. For its sign there is orient.h.
static inline double sli_cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

static inline double sli_dot(sl_point a, sl_point b) {
    return a.x * b.x + a.y * b.y;
}

/// a + b, and what that leaves out (Knuth's TwoSum).
static inline double sli_two_sum(double a, double b, double *rest) {
    const double sum = a + b, part = sum - a;
    *rest = (a - (sum - part)) + (b - part);
    return sum;
}

/// fmin and fmax for numbers, without a call of the C library.
static inline double sli_lesser(double a, double b) {
    return a < b ? a : b;
}

static inline double sli_greater(double a, double b) {
    return a > b ? a : b;
}

/// The point of the segment from a to b that is nearest to a place, rounded.
static inline sl_point sli_nearest_on(sl_point a, sl_point b, sl_point to) {
    const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    const double along = ((to.x - a.x) * x + (to.y - a.y) * y) / square;
    if (!(along > 0)) return a;
    return along < 1 ? (sl_point){a.x + along * x, a.y + along * y} : b;
}

/// How far a place is from the segment from a to b, rounded.
static inline double sli_away_from(sl_point a, sl_point b, sl_point to) {
    const sl_point on = sli_nearest_on(a, b, to);
    return sli_length(on.x - to.x, on.y - to.y);
}

#endif
