/// Where two segments cross, and on which side of a line that is.
#ifndef SL_CROSSING_H
#define SL_CROSSING_H

#include "sightline/geometry.h"

/// The place where two segments cross, each coordinate the nearest that a map may have
/// (sl_coordinate_usable), the lower one of two that are as near: the same for both orders. They
/// must cross properly: the ends of each lie strictly on different sides of the other (sl_orient).
sl_point sl_crossing(sl_segment s, sl_segment t);

/// The side of the line between two points on which s crosses the line through t: as sl_orient. The
/// ends of s must lie strictly on different sides of t's line. Exact for all finite doubles.
int sl_crossing_side(sl_point from, sl_point to, sl_segment s, sl_segment t);

#endif
