/// The rooms of a plan: what its walls enclose once all doors are shut.
///
///     sl_rooms rooms;
///     sl_status status = sl_rooms_find(context, &map, &space, 0, &rooms);
///     if (status == SL_OK) status = sl_rooms_take_names(context, &rooms, &map);
///     // The share of the first room that is seen from an eye, whose region is `seen`:
///     sl_overlay overlay;
///     if (status == SL_OK)
///         status = sl_overlay_make(context, &rooms.items[0].shape, &seen, 1, &overlay);
///     // overlay.areas[1] / overlay.areas[0]
#ifndef SIGHTLINE_ROOMS_H
#define SIGHTLINE_ROOMS_H

#include "sightline/overlay.h"

#ifdef __cplusplus
extern "C" {
#endif

/// No room (sl_rooms_at).
#define SL_NO_ROOM UINT32_MAX

/// A room, as sl_rooms_find() finds it.
typedef struct sl_room {
    char *name;       ///< "Room 1" and so on until it is named
    sl_point at;      ///< a place far from its walls
    double clearance; ///< how far that is, rounded
    double area;
    sl_box bounds;
    sl_shape shape; ///< triangles, counter-clockwise, that tile the room
} sl_room;

/// Zeroed, there are none. The largest room comes first.
typedef struct sl_rooms {
    sl_room *items;
    uint32_t count;
    double width; ///< of the openings that count as doors; 0: none does
    sl_point *points;
    size_t *ends; ///< what the shapes are made of
} sl_rooms;

/// Finds the rooms. `map` is clean (sl_map_clean), and `space` was made from it. Doors count as
/// shut, and openings as doors that a disc of the diameter `width` does not pass (space/channels.h;
/// exact but for the feet of channels, which are rounded). With 0 the width is found: 1.1 m if the
/// unit of the map is known and there are rooms then. Else it is 1.25 times the median of the
/// openings between places that are roomier than the opening; the map has no openings that count if
/// there are none.
///
/// A room is inside. It has room for a disc of half that width, and at least the area of a square
/// as wide as its widest opening. So doorways in thick walls and niches are no rooms. Areas and
/// clearances are rounded. SL_BAD_ARGUMENT for a width that is no number from 0 on. Time O(n log n)
/// for maps whose doors are short against the map.
SL_API sl_status sl_rooms_find(sl_context *context, const sl_map *map, const sl_space *space,
                               double width, sl_rooms *out);
SL_API void sl_rooms_destroy(sl_context *context, sl_rooms *rooms); ///< and zeroes it

/// The room that a point is in, by exact signs of its triangles; of two, whose common border it is
/// on, the larger one. SL_NO_ROOM in doorways, outside and for NaN. Time O(rooms + triangles of the
/// rooms whose bounds hold the point).
SL_API uint32_t sl_rooms_at(const sl_rooms *rooms, sl_point point);

/// Names a room; "" gives it its number back.
SL_API sl_status sl_rooms_name(sl_context *context, sl_rooms *rooms, uint32_t room,
                               const char *name);

/// Names rooms by the texts of the plan (sl_map_source.texts) that begin in them. Of several texts
/// in a room the tallest counts that has a letter and says no area ("12.5 m2"); of equal ones the
/// uppermost; else the tallest of all, as a number of the room is. Rooms without a text keep their
/// names.
SL_API sl_status sl_rooms_take_names(sl_context *context, sl_rooms *rooms, const sl_map *map);

#ifdef __cplusplus
}
#endif

#endif
