/// Folding: looking into a mirror from a place is looking at the map itself from the place's image,
/// straight through the mirror. So what is seen by mirror is found without mirroring the map: the
/// eye and the few points that bound its sight are reflected, everything else stays as it is.
#ifndef SL_FOLD_H
#define SL_FOLD_H

#include "geometry/orient.h"

#include <stdbool.h>

/// The image of a point in a mirror's line. Points on that line stay as they are. An axial mirror's
/// images are sums of coordinates, and exact as long as two doubles hold them; *rounded is set
/// where they do not. An oblique mirror's are good to about four units in the last place of the
/// larger of their distances from the origin and from the mirror's first end; *rounded is set.
sl_fine sl_fold(sl_segment mirror, const sl_fine *point, bool *rounded);

#endif
