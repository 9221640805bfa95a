/// Whether it is plain what is inside of walls, as `check` would say it.
#ifndef SL_PLAN_INSIDE_H
#define SL_PLAN_INSIDE_H

#include "sightline/map.h"
#include "sightline/support.h"

/// `map` is changed: it is cleaned. `*sure` is false, too, where the map cannot be cut into cells.
sl_status sli_plan_inside(sl_context *context, sl_map *map, bool *sure);

#endif
