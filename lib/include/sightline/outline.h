/// The outline: the boundary of every room, side by side, in one table to walk through a space by.
/// A room is one cell or several that make up a convex polygon: sight needs no portals in it.
#ifndef SIGHTLINE_OUTLINE_H
#define SIGHTLINE_OUTLINE_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What lies beyond a side. A value below SL_SIDE_WALL: the portal's other side, as an index of
/// sides. From SL_SIDE_WALL on: the wall of that number. From SL_SIDE_BORDER on: the map's border,
/// lower, right, upper or left, where no wall is.
#define SL_SIDE_WALL UINT32_C(0x80000000)
/// The map's lower border; the right, upper and left one follow.
#define SL_SIDE_BORDER UINT32_C(0xfffffff0)

/// A piece of a room's boundary: a portal (several of the space's, where they join in one line), or
/// what lies on one wall, or on the border. It starts at `start` and ends where the next one
/// starts, counter-clockwise around the room.
typedef struct sl_side {
    sl_point start;
    uint32_t next, neighbour;
} sl_side;

/// Zeroed, an outline is empty.
typedef struct sl_outline {
    const sl_space *space; ///< the caller's; it must stay as long as the outline
    sl_side *sides;        ///< those of a room stand together, in order
    uint32_t *first;       ///< by room, and one more: sides[first[r] .. first[r + 1])
    uint32_t *first_part;  ///< by cell of the space, and one more
    uint32_t *parts;       ///< rooms; those that have a part of cell c: from first_part[c] on
    uint32_t side_count, room_count;
} sl_outline;

/// Makes the outline of a space that is as sl_space_check wants it. No coordinate is computed.
/// Cells become one room by the longest of their portals first, where the room is convex.
/// SL_BAD_ARGUMENT where a piece of a cell's boundary is none of portal, wall and border. Time
/// O(n log n) for n walls and sides, as long as few walls share a line's neighbourhood.
SL_API sl_status sl_outline_make(sl_context *context, const sl_space *space, sl_outline *out);
SL_API void sl_outline_destroy(sl_context *context, sl_outline *outline); ///< and zeroes it

/// A room that holds a point of a cell's; one that has a part of that cell, where there is one.
/// Time: the sides of those rooms, but that of all rooms where rounding hides the room from the
/// cell.
SL_API uint32_t sl_outline_room(const sl_outline *outline, uint32_t cell, sl_point point);

/// Whether a side is a portal.
static inline bool sl_side_is_portal(const sl_side *side) {
    return side->neighbour < SL_SIDE_WALL;
}

#ifdef __cplusplus
}
#endif

#endif
