/// Cells that a map brings along, on their way to a space: faces of the BSP's kind (bsp.h), of
/// which all that bsp.h says of faces holds in the end.
#ifndef SL_SPACE_GIVEN_H
#define SL_SPACE_GIVEN_H

#include "space/bsp.h"
#include "space/wall_grid.h"

/// While it is not known what a side is, its `what` is SL_BEYOND_BORDER.
typedef struct sl_given {
    sl_bsp bsp; ///< faces; later nodes and lines
    const sl_map *map;
    const char *source;    ///< for messages
    sl_wall_grid grid;     ///< of the map's walls
    SL_ARRAY(uint32_t) of; ///< by face: the map's cell that it is, or is a part of
} sl_given;

/// SL_BAD_INPUT, led by the place of the map's cell that a face is made of: "cell 7: ...".
sl_status sl_given_fail(const sl_given *given, uint32_t face, const char *format, ...)
    SL_PRINTF(3, 4);

/// Tells what each side is (given_sides.c): corners that mean the same place become one, corners
/// are put in where another cell or a wall ends within a side, sides along walls get their wall.
/// SL_BAD_INPUT where a side is neither wall nor shared, and sight that leaves there might come
/// back.
sl_status sl_given_know_sides(sl_given *given);
/// Finds the two sides of each portal, by their ends; the sides of one cell that are neither wall
/// nor shared stay SL_BEYOND_BORDER. SL_BAD_INPUT where a side is told twice.
sl_status sl_given_pair(sl_given *given);

/// Moves corners that lie on walls onto their line or behind it, the same for all cells that meet
/// there (given_place.c).
sl_status sl_given_place(sl_given *given);

/// Cuts cells that are not convex (given_place.c). SL_BAD_INPUT where that cannot be.
sl_status sl_given_cut(sl_given *given);

/// Makes the tree that leads to the faces (given_tree.c).
sl_status sl_given_plant(sl_given *given);

#endif
