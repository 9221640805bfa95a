/// Distances held against a length, exactly.
#ifndef SL_DISTANCE_H
#define SL_DISTANCE_H

#include "geometry/orient.h"

#include <stdbool.h>

/// What directions about an eye have of a segment, the ends of which are `right` and `left` as the
/// eye sees them. The directions go counter-clockwise from `from` to `to`, each through its point
/// or
/// (`away`) straight away from it; they meet the segment, and are less than half a turn.
typedef struct sl_glance {
    sl_fine eye, from, to;
    bool from_away, to_away;
    sl_point right, left;
} sl_glance;

/// The sign of the distance from the eye to the nearest place that is seen of the segment, less a
/// positive length. A segment in line with the eye counts as a whole, which must not hold the eye.
/// Exact for all finite doubles.
int sl_nearest_compare(const sl_glance *glance, double length);

/// The sign of the distance between two points, less a length that is not negative. Exact.
int sl_distance_compare(sl_point a, sl_point b, double length);

#endif
