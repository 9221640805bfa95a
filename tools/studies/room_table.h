/// Rooms as a table: their names and areas, what is seen of each from some viewpoints, and means of
/// measures over the points of a grid in it.
#ifndef ROOM_TABLE_H
#define ROOM_TABLE_H

#include "sightline/rooms.h"
#include "studies/vga_table.h"

/// The longest name in a note, its 0 included; longer ones are cut.
enum { LOST_TEXT = 64 };

/// Zeroed, nothing.
typedef struct room_table {
    sl_rooms rooms;
    double inside;             ///< area of all that is inside
    uint32_t lost;             ///< how many texts are inside, but in no room
    char lost_text[LOST_TEXT]; ///< the first of them
    double *seen;          ///< by room: the area seen from any of the viewpoints; NULL: not asked
    const vga_table *grid; ///< whose points and measures count; NULL: none
    uint32_t *points;      ///< by room: those of the grid that are in it
    size_t *measures;      ///< of SL_VGA, those that the grid has
    size_t measure_count;
    double *means; ///< by room and measure; NAN where it has no point with a value
} room_table;

/// Finds and names the rooms. `width` as in sl_rooms_find.
sl_status room_table_make(sl_context *context, const sl_baked *baked, double width,
                          room_table *out);
/// Notes how much of the inside is in no room, if that is a hundredth or more, and texts there.
void room_table_note(sl_context *context, const room_table *table);
/// Adds what is seen of each room.
sl_status room_table_look(sl_context *context, const isovist_scene *scene, const eye_places *eyes,
                          room_table *table);
/// Adds the means. Keeps `grid`. A point on the border of two rooms is in the larger one.
sl_status room_table_average(sl_context *context, const vga_table *grid, room_table *table);
void room_table_destroy(sl_context *context, room_table *table);

/// Writes CSV; "-" for stdout.
sl_status room_table_write(sl_context *context, const room_table *table, const char *path);
/// The same as the field "rooms".
sl_status room_table_print_json(sl_context *context, const room_table *table);

#endif
