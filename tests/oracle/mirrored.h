/// What an eye sees, directly and by mirror, within a range, by brute force in integers of any
/// size: along a ray in each of the directions at which anything may change, and between every two
/// of them. Mirrors are axial. Slow; lack of memory aborts.
#ifndef SL_TESTS_MIRRORED_H
#define SL_TESTS_MIRRORED_H

#include "sightline/map.h"
#include "sightline/space.h"
#include "sightline/view.h"

/// A chain of mirrors as a number: (mirrors + 1) times that of the chain without its last mirror,
/// plus that mirror's number and 1. Less than this:
size_t oracle_chains(const sl_map *map, uint32_t depth);

typedef struct oracle_mirrored {
    bool *closed, *open; ///< by cell: whether it is seen by mirror, at most as far as the range;
                         ///< with open sight, nearer
    bool *direct_closed, *direct_open; ///< likewise, whether it is seen directly
    double *areas; ///< by chain: what is seen by it, within the range (0: any); of an eye on a
                   ///< wall or dark glass none are told
    bool on_wall;
} oracle_mirrored;

/// Of a space with cells that are boxes, whose directed portals say where glass is dark
/// (sli_filtered_space_make); the eye is within the bounds. Mirrors that lie on one another count
/// as the first of them.
oracle_mirrored oracle_mirrored_of(const sl_space *space, const sl_map *map, const sl_view *view,
                                   double range, uint32_t depth);
void oracle_mirrored_free(oracle_mirrored *o);

#endif
