/// Who sees whom where the map has doors, one-way glass, mirrors and a range: by every portal
/// sequence there is, in exact arithmetic, but for lengths, which are sampled. Tells by the map's
/// own segments what a portal lies on. Coordinates must be small integers; mirrors axial.
#ifndef SL_TESTS_EFFECTS_H
#define SL_TESTS_EFFECTS_H

#include "oracle/oracle.h"

/// A way in which one cell sees another.
typedef struct oracle_way {
    uint32_t from, to;
    uint32_t doors; ///< a bit for each that the sequence passes
    bool mirrored;
    double length; ///< of the shortest sightline between the cells, give or take a thousandth
} oracle_way;

typedef struct oracle_ways {
    oracle_way *items;
    size_t count, room;
} oracle_ways;

/// Sequences with more than `depth` reflections, and such with a length far over the range, are not
/// gone on from. False where more than `limit` portals would be pushed. Free the items.
bool oracle_effects(const sl_space *space, const sl_map *map, sl_sight sight, uint32_t depth,
                    uint64_t limit, oracle_ways *out);

#endif
