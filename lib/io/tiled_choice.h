/// Which of Tiled's layers are asked for: NAME takes all tiles of a layer, or all layers of a
/// group; NAME:28+33-35 the tiles of these numbers.
#ifndef SL_IMPORT_TILED_CHOICE_H
#define SL_IMPORT_TILED_CHOICE_H

#include "io/json.h"
#include "map/scan.h"

/// Whether a layer of this name is in the list; `*gids` gets its tiles' numbers, of no length for
/// all.
bool sl_tiled_asked_for(const char *list, const char *layer, sl_word *gids);

/// Whether a tile is among the numbers; any tile is among none.
bool sl_tiled_among(sl_word gids, uint32_t gid);

/// SL_BAD_ARGUMENT where the list names a layer that `map` has not, or its numbers are none.
sl_status sl_tiled_check_choice(const sl_json *map, const char *list);

#endif
