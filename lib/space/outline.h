/// Making an outline.
#ifndef SL_OUTLINE_H
#define SL_OUTLINE_H

#include "sightline/space.h"

/// Makes the outline of a space that passes sl_space_check, or of one with glass that is dark from
/// one side (sli_filtered_space.dark_walls). No coordinate is computed. Cells are
/// joined to rooms across their longest portals first, where the room is convex. SL_BAD_ARGUMENT
/// for a piece of a cell's boundary that is neither portal nor wall nor border. Time O(n log n) for
/// n walls and sides, if few walls are near to one line.
sl_status sli_outline_make(sl_context *context, const sl_space *space, sl_outline *out);
void sli_outline_destroy(sl_context *context, sl_outline *outline); ///< and zeroes it
/// Whether a point is in a room or on its border.
bool sli_outline_room_holds(const sl_outline *outline, uint32_t room, sl_point point);

#endif
