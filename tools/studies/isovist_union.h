/// What several viewpoints see together, and its files.
#ifndef ISOVIST_UNION_H
#define ISOVIST_UNION_H

#include "sightline/overlay.h"
#include "studies/eye_run.h"

/// Lays regions over each other; `space` says what is inside. Regions must not be mirrored.
sl_status isovist_union_make(sl_context *context, const sl_space *space, const seen_parts *regions,
                             sl_overlay *out);

/// Writes the areas inside, one row for each number of viewpoints; "-" is stdout. A name that ends
/// in .geojson: the pieces of them that are seen, as GeoJSON.
sl_status isovist_union_write(sl_context *context, const sl_overlay *all, const sl_earth *earth,
                              const char *path);

#endif
