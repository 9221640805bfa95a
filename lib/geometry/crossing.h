/// The exact predicates with more factors: where two segments cross, and distances against a
/// length.
#ifndef SL_CROSSING_H
#define SL_CROSSING_H

#include "geometry/orient.h"

/// The place where two segments cross. Each coordinate is the nearest usable one
/// (sl_coordinate_usable), of two equally near ones the lower. The order of the segments does not
/// matter. They must cross properly: the ends of each lie strictly on different sides of the other.
sl_point sl_crossing(sl_segment s, sl_segment t);

/// The side of the line from `from` to `to` on which s crosses the line through t, as sl_orient.
/// The ends of s must lie strictly on different sides of t's line. Exact for all finite doubles.
int sl_crossing_side(sl_point from, sl_point to, sl_segment s, sl_segment t);

/// A segment, and the directions in which an eye looks at it. `right` and `left` are the ends of
/// the segment as the eye sees them. The directions go counter-clockwise from `from` to `to`, by
/// less than half a turn. Each points to its point, or straight away from it (`away`). They meet
/// the segment.
typedef struct sl_glance {
    sl_fine eye, from, to;
    bool from_away, to_away;
    sl_point right, left;
} sl_glance;

/// The sign of the distance from the eye to the nearest place that is seen of the segment, less a
/// positive length. A segment in line with the eye counts as a whole, and must not hold the eye.
/// Exact for all finite doubles.
int sl_nearest_compare(const sl_glance *glance, double length);

/// The sign of the distance between two points, less a length of 0 or more. Exact.
int sl_distance_compare(sl_point a, sl_point b, double length);

#endif
