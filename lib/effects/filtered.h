/// The space as sight finds it: with shut doors and dark glass as walls.
#ifndef SL_FILTERED_H
#define SL_FILTERED_H

#include "sightline/space.h"

/// The space as sight finds it for the time being, with what holds it back made part of the space:
/// portals on doors that are shut become walls, and one-way glass has no directed portal on the
/// side from which it is not seen through, or is a wall where one eye is there. Cells, vertices and
/// the numbers of portals stay.
typedef struct sli_filtered_space {
    const bool *shut; ///< by door of the map; NULL: all are open
    bool one_way;     ///< with its glass; else that is open both ways
    /// With `one_way`: the dark side of glass is a wall, after all other walls. Such a space has an
    /// outline, in which regions see one way (space.h).
    bool dark_walls;
    /// Glass that is dark for this eye is a wall, all other is open both ways: what one eye sees
    /// straight on, without mirrors, is then what it sees past walls. NULL for none.
    const sl_point *eye;
} sli_filtered_space;

/// A copy of a space for a filtered space. It is as sl_space_check wants it where sight is
/// not one-way: then all methods work on it. With one-way directed portals missing, only those that
/// go through directed portals do, one way: "dfs", and eye-to-cell, directly and by mirror; with
/// `dark_walls` also regions and single lines of sight. Portals that are walls have no
/// directed portals and are left out; `portals` (portal_count of `space`, or NULL) gets the new
/// number of each, UINT32_MAX for none.
sl_status sli_filtered_space_make(sl_context *context, const sl_space *space,
                                  const sli_filtered_space *filtered, uint32_t *portals,
                                  sl_space *out);

/// Whether one-way glass keeps sight from leaving a cell by a directed portal.
bool sli_portal_is_blocked(const sl_space *space, uint32_t cell, uint32_t directed);

#endif
