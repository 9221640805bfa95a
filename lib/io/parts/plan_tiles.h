/// Tiles of a floor, which a drawing shows as boxes in rows and columns.
#ifndef SL_PLAN_TILES_H
#define SL_PLAN_TILES_H

#include "io/parts/plan_net.h"

/// Marks the walls of tiles in `tiles`, which is zero before. `*count` gets how many there are.
/// Tiles lie along the axes of the net's map.
sl_status sli_plan_tiles_find(sli_plan_net *net, sl_bits *tiles, size_t *count);

#endif
