/// Random spaces of convex cells with oblique walls: a small grid's points triangulated, some
/// triangles joined (corners with an angle of pi stay, so that cells meet in the middle of an
/// edge), each edge then a wall, a portal, or partly both. The same seed gives the same space
/// everywhere.
#ifndef SL_TESTS_CONVEX_SPACE_H
#define SL_TESTS_CONVEX_SPACE_H

#include "sightline/space.h"

/// Fills cells, corners, portals and directed portals; there is no tree and there are no walls. All
/// coordinates are multiples of 1 up to 64, or of 2^-30 times that, far from the origin, where
/// `seed` says so. Aborts where there is no memory. To be destroyed by sl_space_destroy.
void oracle_random_space(sl_context *context, uint64_t seed, sl_space *out);

#endif
