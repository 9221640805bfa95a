/// What several viewpoints see together: the union of their regions, by how many of them see it.
#ifndef ISOVIST_UNION_H
#define ISOVIST_UNION_H

#include "eye_run.h"

/// Zero it to start.
typedef struct isovist_union {
    sl_space pieces;  ///< convex, cut along the outlines of all regions
    uint32_t *counts; ///< by piece: how many regions hold it
    double *areas; ///< areas[k]: of what k regions hold, or more; areas[0]: of all that is inside
    size_t count;  ///< of regions; areas has one more
} isovist_union;

/// `space` says what is inside. The outlines of the regions are laid over each other and cut where
/// they cross, as the walls of a map are, and each piece is counted. So areas are exact but for the
/// rounding of these crossings. Regions must not be mirrored.
sl_status isovist_union_make(sl_context *context, const sl_space *space, const seen_parts *regions,
                             isovist_union *out);
void isovist_union_destroy(sl_context *context, isovist_union *all); ///< and zeroes it

/// Writes the areas, one row for each number of viewpoints; "-" is stdout. A name that ends in
/// .geojson: the pieces that are seen, as GeoJSON.
sl_status isovist_union_write(sl_context *context, const isovist_union *all, const char *path);

#endif
