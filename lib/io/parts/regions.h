/// Regions of a map: ground that is joined by steps, through doors too. They say what starts reach
/// before the map has any.
#ifndef SL_REGIONS_H
#define SL_REGIONS_H

#include "io/parts/things.h"
#include "sightline/space.h"

typedef struct sli_region {
    double area;
    double beside;  ///< the length of the sides of walls that it reaches
    double between; ///< of these, walls that it has on both sides
    bool doors;     ///< doors lead from it, or are in it
} sli_region;

/// Zeroed, there are none.
typedef struct sli_regions {
    sl_space space;   ///< its cells have neighbours
    uint32_t *region; ///< by cell
    sli_region *items;
    size_t count;
    double tolerance; ///< ends of walls so far apart became one
} sli_regions;

/// Finds the regions of a map, with more walls in it. What the map says of solid ground does not
/// count. Time as for a bake without its pairs.
sl_status sli_regions_make(sl_context *context, const sl_map *map, const sl_segment *more,
                           size_t count, sli_regions *out);
void sli_regions_destroy(sl_context *context, sli_regions *regions); ///< and zeroes it

/// The number of the region at a place, or SL_NO_CELL.
uint32_t sli_regions_at(const sli_regions *regions, sl_point place);

/// A place of the middle of a cell.
sl_point sli_cell_middle(const sl_space *space, uint32_t cell);

/// Marks starts that reach less than a tenth of what another start reaches, or that a region with
/// doors has (sli_thing.doubt). Those that the user named, and those in doubt already, are passed
/// over.
void sli_regions_doubt(const sli_regions *regions, sli_things *things);

#endif
