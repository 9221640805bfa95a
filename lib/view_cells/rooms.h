/// What sightlines pass through and end at, for exact sets of view cells: convex rooms, the portals
/// between them, and the objects that are told. Where objects are cells, rooms are the space's
/// cells; where they are walls, the outline's rooms, which are fewer.
#ifndef SL_VIEW_ROOMS_H
#define SL_VIEW_ROOMS_H

#include "sightline/support.h"
#include "sightline/view_cells.h"

#define SL_NO_ROOM   UINT32_MAX
#define SL_NO_OBJECT UINT32_MAX

/// A piece of a room's boundary as it is crossed on the way out. Pieces that nothing is behind and
/// that are no object (the map's border) are left out.
typedef struct sl_room_side {
    sl_point left, right;
    uint32_t room;   ///< behind it; SL_NO_ROOM for a wall
    uint32_t object; ///< that is seen by who sees the side; SL_NO_OBJECT for none
} sl_room_side;

/// Inside ones alone.
typedef struct sl_view_rooms {
    uint32_t count, object_count;
    sl_box bounds;
    sl_point *corners;      ///< counter-clockwise
    uint32_t *first_corner; ///< by room, and one more
    sl_room_side *sides;
    uint32_t *first_side; ///< by room, and one more
    uint32_t *object;     ///< by room: the object that it is itself; SL_NO_OBJECT for none
    double *places[2];    ///< the corners' coordinates on each axis, ascending, each once
    uint32_t place_counts[2];
} sl_view_rooms;

sl_status sl_view_rooms_make(sl_context *context, const sl_space *space, sl_view_objects objects,
                             sl_view_rooms *out);
/// The corner's coordinate that a rounded place on an axis stands for, or the place itself: cuts
/// that are to be along walls then are.
double sl_view_rooms_snap(const sl_view_rooms *rooms, int axis, double place);
void sl_view_rooms_destroy(sl_context *context, sl_view_rooms *rooms); ///< and zeroes it

#endif
