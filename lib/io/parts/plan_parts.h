/// What a plan has beside walls, found by shape alone, in drawings whose layers say nothing: frames
/// of sheets, axes and dimension lines that run across walls, legends beside the plan, furniture
/// that stands loose in rooms, and tiles of floors.
#ifndef SL_PLAN_PARTS_H
#define SL_PLAN_PARTS_H

#include "sightline/map.h"
#include "sightline/support.h"

/// Zeroed, it is empty.
typedef struct sli_plan_parts {
    sl_bits *gone;        ///< by wall: it is no wall
    size_t frame;         ///< walls of frames
    size_t dimensions;    ///< walls of dimension lines, with their ticks
    size_t across;        ///< walls that run across drawn walls
    size_t beside;        ///< walls of what lies beside the plan
    size_t loose, pieces; ///< walls of loose things, and how many these are
    size_t tiles;         ///< walls of tiles
    double
        rest; ///< the share, by length, of what is left and not drawn as walls are; 0 for unknown
} sli_plan_parts;

/// Finds them. Only frames are looked for where walls are not drawn as pairs of lines. `metre` is a
/// metre in the map's unit, 0 for unknown. Destroy `out` also on failure.
sl_status sli_plan_parts_find(sl_context *context, const sl_map *map, double metre,
                              sli_plan_parts *out);
void sli_plan_parts_destroy(sl_context *context, sli_plan_parts *parts);

static inline size_t sli_plan_parts_count(const sli_plan_parts *parts) {
    return parts->frame + parts->dimensions + parts->across + parts->beside + parts->loose +
           parts->tiles;
}

#endif
