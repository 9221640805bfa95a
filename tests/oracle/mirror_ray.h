/// One ray through a map, reflected by mirrors in any direction, past one-way glass: in rationals,
/// from the map's own segments. Lack of memory aborts.
#ifndef SL_TESTS_MIRROR_RAY_H
#define SL_TESTS_MIRROR_RAY_H

#include "sightline/map.h"

enum { ORACLE_LEGS_MOST = 9 };

/// A straight piece of a ray.
typedef struct oracle_leg {
    sl_point from, to; ///< exact, and then rounded
    uint32_t mirror;   ///< that it comes from; UINT32_MAX for the first
} oracle_leg;

typedef struct oracle_ray {
    oracle_leg legs[ORACLE_LEGS_MOST];
    uint32_t count; ///< 0: it leaves the map
    double margin;  ///< how far it keeps from all ends of walls and mirrors
} oracle_ray;

/// Walls must include the mirrors (sl_map_clean). At most `depth` reflections; the eye is on no
/// wall.
oracle_ray oracle_ray_of(const sl_map *map, sl_point eye, sl_point direction, uint32_t depth);

#endif
