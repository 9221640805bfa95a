/// The points of a path that an option names.
#ifndef PATH_POINTS_H
#define PATH_POINTS_H

#include "sightline/map.h"

/// The points of a path of the map, or of a table (.csv, or "-": stdin) with the columns x and y.
/// `option`: for messages. The caller frees the points (sl_free), also after a failure.
sl_status path_points_read(sl_context *context, const char *option, const char *name,
                           const sl_map *map, sl_point **points, size_t *count);

#endif
