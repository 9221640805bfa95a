/// Where two segments cross.
#ifndef SL_CROSSING_H
#define SL_CROSSING_H

#include "sightline/geometry.h"

/// The place where two segments cross, each coordinate the nearest that a map may have
/// (sl_coordinate_usable), the lower one of two that are as near: the same for both orders. They
/// must cross properly: the ends of each lie strictly on different sides of the other (sl_orient).
sl_point sl_crossing(sl_segment s, sl_segment t);

#endif
