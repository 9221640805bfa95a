/// The space as sight finds it now. Doors open and shut in place: a door costs the cells and sides
/// that it touches.
#ifndef SL_SIGHT_SPACE_H
#define SL_SIGHT_SPACE_H

#include "sightline/space.h"

/// A portal on doors or one-way glass.
typedef struct sli_sight_portal {
    uint32_t portal;   ///< of the base
    uint32_t door;     ///< the wall that it is where it is shut
    uint32_t dark;     ///< the wall on the dark side of its glass; SL_NO_CELL without glass
    uint32_t blocked;  ///< the directed portal that glass keeps sight from; SL_NO_CELL for none
    uint32_t sides[2]; ///< of the outline: in cell[0], and in cell[1]
    bool sealed;       ///< glass is dark from both sides: it is shut for good
    bool shut;
} sli_sight_portal;

/// Zeroed, it is empty. `space` borrows from the base what never changes. Its cells, vertices and
/// portals have the numbers of the base. Portals that are shut have no directed portals. After the
/// walls of the base come those of doors and glass, then the dark sides of glass; those that do not
/// stand have no length.
typedef struct sli_sight_space {
    const sl_space *base;
    sl_space space;
    sl_outline outline;        ///< of `space`; made by sli_sight_space_outline
    const sl_outline *given;   ///< the outline of the base, as its owner keeps it; NULL for none
    sli_sight_portal *portals; ///< in the order of their numbers
    uint32_t portal_count, dark_count;
    uint32_t *first_of_door, *of_door; ///< by door, and one more: its portals, as numbers in
                                       ///< `portals`
    bool own; ///< `space` has cells, directed portals, walls and neighbours of its own
} sli_sight_space;

/// Makes it with doors as `shut` has them (by door of the map, `door_count` of them), and with
/// glass one-way. The base must outlive it.
sl_status sli_sight_space_make(sl_context *context, const sl_space *base, const bool *shut,
                               size_t door_count, sli_sight_space *out);
void sli_sight_space_destroy(sl_context *context, sli_sight_space *s); ///< and zeroes it

/// Follows a change of one door. Time: the sides of the cells at it.
void sli_sight_space_set_door(sli_sight_space *s, size_t door, const bool *shut);

/// The outline, made when it is first asked for.
sl_status sli_sight_space_outline(sl_context *context, sli_sight_space *s, const sl_outline **out);

#endif
