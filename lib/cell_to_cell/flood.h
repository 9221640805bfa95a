/// A bound on what is seen, by signs of portals in pairs.
#ifndef SL_FLOOD_H
#define SL_FLOOD_H

#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

/// Adds to an empty set all cells that a sightline through the directed portal may reach: never
/// misses one, but gives up where they are more than `most`. They are listed in `found`, which has
/// room for all cells, and counted.
uint32_t sl_flood_through(const sl_space *space, const sl_see_options *options,
                          const sl_directed_portal *directed, uint32_t most, sl_bits *set,
                          uint32_t *found);

/// The bound on what all cells see, symmetric. Once options.enough says so there is none but
/// what portals join: *bounded is then false.
sl_status sl_flood_bound(sl_context *context, const sl_space *space, const sl_see_options *options,
                         sl_pvs *out, bool *bounded);

#endif
