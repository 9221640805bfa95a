/// The outline: the boundaries of all rooms, side by side, for walks through a space. A room is one
/// cell, or several that make up a convex polygon. Sight needs no portals within a room.
#ifndef SIGHTLINE_OUTLINE_H
#define SIGHTLINE_OUTLINE_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The values of sl_side.neighbour. Below SL_SIDE_WALL: a portal, as the index of its other side.
/// From SL_SIDE_WALL on: a wall, by its number. From SL_SIDE_BORDER on: the map's border without a
/// wall; the lower, right, upper or left one.
#define SL_SIDE_WALL UINT32_C(0x80000000)
/// The map's lower border; the right, upper and left one follow.
#define SL_SIDE_BORDER UINT32_C(0xfffffff0)

/// A piece of a room's boundary: a portal, a piece of one wall, or a piece of the border. A portal
/// may be several of the space's in one line. The piece starts at `start`, and ends where the next
/// one starts, counter-clockwise around the room.
typedef struct sl_side {
    sl_point start;
    uint32_t next, neighbour;
} sl_side;

/// Zeroed, an outline is empty.
typedef struct sl_outline {
    const sl_space *space; ///< the caller's; it must live as long as the outline
    sl_side *sides;        ///< grouped by room, in order
    uint32_t *first;       ///< by room, and one more: sides[first[r] .. first[r + 1])
    uint32_t *first_part;  ///< by cell of the space, and one more
    uint32_t *parts;       ///< rooms; those with a part of cell c: from first_part[c] on
    uint32_t side_count, room_count;
    /// One-way glass: walls from this number on are its dark sides. The other side of wall w is
    /// sides[lit[w - first_dark]], a portal that leads to the wall's side. NULL without glass.
    uint32_t first_dark, *lit;
} sl_outline;

/// The room that holds a point of a cell, among the rooms with a part of that cell. Time: the sides
/// of these rooms.
SL_API uint32_t sl_outline_room(const sl_outline *outline, uint32_t cell, sl_point point);

/// Whether a side is a portal.
static inline bool sl_side_is_portal(const sl_side *side) {
    return side->neighbour < SL_SIDE_WALL;
}

/// Whether a side is the dark side of glass.
static inline bool sl_side_is_dark(const sl_outline *outline, const sl_side *side) {
    return outline->lit && side->neighbour >= SL_SIDE_WALL + outline->first_dark &&
           side->neighbour < SL_SIDE_BORDER;
}

#ifdef __cplusplus
}
#endif

#endif
