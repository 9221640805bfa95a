/// The visible region by brute force in rationals: between two neighbouring directions to wall ends
/// the nearest wall is one and the same, and it is found by asking all.
#ifndef SL_TESTS_ISOVIST_H
#define SL_TESTS_ISOVIST_H

#include "sightline/space.h"
#include "sightline/view.h"

typedef struct oracle_isovist {
    double area;        ///< an exact rational, rounded once
    double perimeter;   ///< a sum of rounded square roots
    double occlusivity; ///< likewise
} oracle_isovist;

/// Of clean axial walls, with sight ending at the bounds. The eye is within the bounds; on a wall,
/// it sees what lies on its upper right, on the upper or right border on its lower or left.
oracle_isovist oracle_isovist_of(const sl_space *space, const sl_view *view);

#endif
