/// Whether some point of one box sees some point of another, by the walls alone. If any line of
/// sight leads from box to box, one does that passes two corners: of walls, of boxes, or where
/// walls cross sides of boxes. So each line through two corners is walked, both ways, as in
/// two_points.h: where it is free on its left, where on its right. Each point of the first box
/// looks to both sides, as it may also stand a little beside its place.
///
/// Coordinates are integers up to 2^8. Corners are fractions, and all products exact in 128 bits.
#ifndef SL_TESTS_TWO_BOXES_H
#define SL_TESTS_TWO_BOXES_H

#include "sightline/geometry.h"

#include <stdbool.h>
#include <stddef.h>

/// `walls`, with shut doors; none crosses another one but at its ends. `map`: the bounds of all.
/// Both boxes are within them, and may have no size.
bool two_boxes_see(const sl_segment *walls, size_t count, sl_box map, sl_box from, sl_box to);

#endif
