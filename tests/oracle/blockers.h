/// Walls that block sightlines, apart from the library: a uniform grid says which of them a segment
/// may meet, and signs are decided by doubles with an error bound, else by GMP's rationals.
#ifndef BLOCKERS_H
#define BLOCKERS_H

#include "sightline/map.h"

typedef struct blockers blockers;

/// A copy of the segments. Aborts where there is no memory.
blockers *blockers_create(const sl_segment *segments, size_t count);
void blockers_destroy(blockers *walls);

/// The sign of the turn a, b, c: 1 left, -1 right, 0 none. Exact.
int blockers_turn(sl_point a, sl_point b, sl_point c);

/// Whether the closed segments share a point. Exact.
bool blockers_meet(sl_segment a, sl_segment b);

/// Whether no wall has a point of the segment. Exact.
bool blockers_free(blockers *walls, sl_segment sightline);

/// How far one can go from the segment's first end towards its second before a wall, as a share of
/// its length; 1 where no wall is met; rounded. *wall is the wall met, SIZE_MAX for none.
double blockers_reach(blockers *walls, sl_segment sightline, size_t *wall);

#endif
