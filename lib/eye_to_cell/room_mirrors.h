/// Finding where rooms end at mirrors.
#ifndef SL_ROOM_MIRRORS_H
#define SL_ROOM_MIRRORS_H

#include "sightline/region.h"

/// Finds them. Mirrors must be walls of the outline's space too (sl_map_clean makes them so).
sl_status sli_room_mirrors_make(sl_context *context, const sl_outline *outline, const sl_map *map,
                                sl_room_mirrors *out);
/// Frees what sli_room_mirrors_make gave and zeroes it.
void sli_room_mirrors_destroy(sl_context *context, sl_room_mirrors *mirrors);

#endif
