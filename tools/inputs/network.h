/// What tables say of a network of segments: weights, and crossings that are no junctions.
#ifndef NETWORK_H
#define NETWORK_H

#include "sightline/axial.h"
#include "sightline/map.h"

/// Reads a table with the columns x and y, and finds the crossing that each row means. The caller
/// frees the points (sl_free), also after a failure.
sl_status network_unlinks_read(sl_context *context, const char *path, const sl_segment *segments,
                               uint32_t count, sl_point **unlinks, uint32_t *unlink_count);

/// The weight of each wall of a map that was read from a file, and cleaned: a column of the file,
/// which must be a table. Pieces of one row share its value. `segments`: the walls. `weights` has
/// room for all.
sl_status network_weights_read(sl_context *context, const char *path, const char *column,
                               const sl_map *map, const sl_segment *segments, double *weights);

#endif
