/// The writers of maps, to a stream that is open already. Whether the stream took all is the
/// caller's to ask.
#ifndef SL_MAP_PRINT_H
#define SL_MAP_PRINT_H

#include "sightline/map.h"
#include "sightline/support.h"

void sl_map_print_text(const sl_map *map, FILE *stream);

/// Prints nothing where it fails.
sl_status sl_map_print_plan(sl_context *context, const sl_map *map, FILE *stream);

#endif
