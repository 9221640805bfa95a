/// Portals that become walls.
#ifndef SL_WALLED_H
#define SL_WALLED_H

#include "sightline/space.h"

/// Which portals of a space become walls, and which directed portals are left out.
typedef struct sli_walled {
    const sl_space *from;    ///< as it is; its arrays may be those of `out`
    sl_space *out;           ///< with the arrays that change, and room for the walls
    const uint32_t *portals; ///< by portal: its new number, in order; UINT32_MAX for a wall
    const bool *barred;      ///< by directed portal: left out, as all of walls are
    const uint32_t *dark; ///< by portal: the directed portal that has a wall in its place, and the
                          ///< other one has none; UINT32_MAX for none. NULL: no portal has such
} sli_walled;

/// Adds the walls to `out`, those of portals and then those of dark sides. They run from the right
/// end to the left one, as crossed from cell[0]. Cells, vertices and seams stay.
sl_status sli_walled_make(sl_context *context, const sli_walled *walled);

/// Makes walls of the portals that stop what the space of the map is for (sl_map.channel), and
/// lists their passages. Nothing where no wall says what it stops.
sl_status sli_walled_by_channel(sl_context *context, const sl_map *map, sl_space *space);

/// Checks that passages are in order, and that their cells are beside their walls. SL_BAD_INPUT.
sl_status sli_passages_check(sl_context *context, const sl_space *space);

/// What the walls stop that a portal lies on; 0 for none. A place limits sight if no wall there
/// stops it.
uint32_t sli_portal_stops(const sl_map *map, const sl_space *space, uint32_t portal);

#endif
