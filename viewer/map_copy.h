/// Copies of maps.
#ifndef VIEWER_MAP_COPY_H
#define VIEWER_MAP_COPY_H

#include "sightline/map.h"

/// A deep copy into an empty map, which stays empty on failure.
sl_status sl_map_copy(sl_context *context, const sl_map *from, sl_map *to);

/// Puts other walls in place of a map's own.
sl_status sl_map_set_walls(sl_context *context, sl_map *map, const sl_wall *walls, size_t count);

/// Whether two maps differ in nothing that a bake looks at: doors may be open or shut.
bool sl_map_same_bake(const sl_map *a, const sl_map *b);

#endif
