/// The exact predicates with more factors: where two segments cross, and distances against a
/// length.
#ifndef SL_CROSSING_H
#define SL_CROSSING_H

#include "geometry/orient.h"

#include <stdint.h>

/// The place where two segments cross. Each coordinate is the nearest usable one
/// (sl_coordinate_usable), of two equally near ones the lower. The order of the segments does not
/// matter. They must cross properly: the ends of each lie strictly on different sides of the other.
/// Or the place where their lines cross, which must not be parallel.
sl_point sli_crossing(sl_segment s, sl_segment t);

/// The side of the line from `from` to `to` on which s crosses the line through t, as sli_orient.
/// The ends of s must lie strictly on different sides of t's line. Exact for all finite doubles.
int sli_crossing_side(sl_point from, sl_point to, sl_segment s, sl_segment t);

/// Where the lines through t and through u meet the line through s: 1 where t meets it further
/// along the way from s.a to s.b, -1 where u does, 0 at one place. Neither may be parallel to s.
/// Exact for all finite doubles.
int sli_meet_order(sl_segment s, sl_segment t, sl_segment u);

/// The sign of u_m (s x (a - eye)) - (s x u)(value - eye_m), for u = point - eye, s = b - a and the
/// coordinate m of the axis. Of three lines (through eye and point, through a and b, and the axial
/// one at the value) it says on which side of the third one the other two meet. Exact.
int sli_axial_meet_side(sl_point eye, sl_point point, sl_point a, sl_point b, int axis,
                        double value);

/// A segment, and the directions in which an eye looks at it. `right` and `left` are the ends of
/// the segment as the eye sees them. The directions go counter-clockwise from `from` to `to`, by
/// less than half a turn. Each points to its point, or straight away from it (`away`). They meet
/// the segment.
typedef struct sli_glance {
    sli_fine eye, from, to;
    bool from_away, to_away;
    sl_point right, left;
} sli_glance;

/// The sign of the distance from the eye to the nearest place that is seen of the segment, less a
/// positive length. A segment in line with the eye counts as a whole, and must not hold the eye.
/// Exact for all finite doubles.
int sli_nearest_compare(const sli_glance *glance, double length);

/// The sign of the distance between two points, less a length of 0 or more. Exact.
int sli_distance_compare(sl_point a, sl_point b, double length);

// --- Whole numbers of many digits, on the stack, for predicates with more factors than a
// determinant.

/// The number of digits (base 2^32). It holds a product of six numbers, each a difference of two
/// finite doubles, in units of one power of two.
enum { SLI_WHOLE_DIGITS = 408 };

typedef struct sli_whole {
    int sign;                          ///< -1, 0 or 1
    uint32_t count;                    ///< digits in use; the last one is not 0
    uint32_t digits[SLI_WHOLE_DIGITS]; ///< the lowest first
} sli_whole;

/// The exponent of the last binary digit of a finite double other than 0.
int sli_whole_exponent(double value);

/// value * 2^-exponent, which must be whole.
void sli_whole_set(double value, int exponent, sli_whole *out);

// `out` must not be an operand.
void sli_whole_add(const sli_whole *a, const sli_whole *b, sli_whole *out);
void sli_whole_subtract(const sli_whole *a, const sli_whole *b, sli_whole *out);
void sli_whole_multiply(const sli_whole *a, const sli_whole *b, sli_whole *out);

/// The sign of a - b.
int sli_whole_compare(const sli_whole *a, const sli_whole *b);

#endif
