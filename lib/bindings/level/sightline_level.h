/// A baked level behind a handle, for languages that call C: LuaJIT, C#, Python and others.
///
/// The same questions as the runtime header for games, with its guarantees
/// (lib/runtime/README.md). Here the library owns the memory: the file, the state of doors and
/// boxes, and the answers. Only numbers, pointers to numbers and text go in and out, so no struct
/// has to be declared again in another language.
///
/// Once boxes stand in the level, those that block hide what is behind them from every question of
/// an eye and stop who walks.
///
/// One level is for one thread at a time; different levels are independent. An answer that is a
/// pointer stays until the next call with the same level. No call fails but sl_level_open,
/// sl_level_open_file, sl_level_set_box_count and, if memory is short, those that give NULL; a
/// number that names no cell, door, start or box gives the answer for nothing (-1, 0, NULL).
#ifndef SIGHTLINE_LEVEL_H
#define SIGHTLINE_LEVEL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32) && defined(SIGHTLINE_LEVEL_BUILDS)
#define SL_LEVEL_API __declspec(dllexport)
#elif defined(_WIN32)
#define SL_LEVEL_API __declspec(dllimport)
#else
#define SL_LEVEL_API __attribute__((visibility("default")))
#endif

typedef struct sl_level sl_level;

/// Opens the bytes of a baked file (.slv), which are copied. NULL if they are damaged or memory is
/// short: sl_level_error says why.
SL_LEVEL_API sl_level *sl_level_open(const void *bytes, size_t size);
/// Opens a baked file by its name.
SL_LEVEL_API sl_level *sl_level_open_file(const char *name);
/// Why the last sl_level_open or sl_level_open_file of this thread gave NULL, as a text that stays.
SL_LEVEL_API const char *sl_level_error(void);
/// Frees a level; NULL is fine.
SL_LEVEL_API void sl_level_close(sl_level *level);

// --- coordinates: those of the map, with y up, until one of these calls chooses others. Then all
// places, boxes, lengths and headings that the level takes and gives are in them.

/// Chooses those of the file that was baked: pixels of a Tiled map with y down, say. 0 if the baked
/// file does not have it, as those before 2.0; nothing is then changed.
SL_LEVEL_API int32_t sl_level_use_file_coordinates(sl_level *level);
/// Chooses any others: `origin_x`, `origin_y` is the place in the map that is 0, 0 there, `scale`
/// how many units there a unit of the map is (more than 0). With `y_down` headings are clockwise
/// from +x; polygons still go counter-clockwise as they are seen. Exact for whole numbers if the
/// scale is a power of 2; else places are rounded.
SL_LEVEL_API void sl_level_use_coordinates(sl_level *level, double origin_x, double origin_y,
                                           double scale, int32_t y_down);
/// 1 if y is down in the coordinates that are chosen: a screen's y is then drawn as it is. Else 0.
SL_LEVEL_API int32_t sl_level_y_is_down(const sl_level *level);

// --- the map

SL_LEVEL_API int32_t sl_level_cell_count(const sl_level *level);
/// The bounds: min x, min y, max x, max y.
SL_LEVEL_API void sl_level_bounds(const sl_level *level, double bounds[4]);
/// The corners of a cell, counter-clockwise: `*count` pairs of numbers. NULL for no cell.
SL_LEVEL_API const double *sl_level_cell_corners(sl_level *level, int32_t cell, int32_t *count);
/// 1 for a cell of solid ground, else 0.
SL_LEVEL_API int32_t sl_level_is_solid(const sl_level *level, int32_t cell);
SL_LEVEL_API int32_t sl_level_start_count(const sl_level *level);
/// A start: x, y, and the heading in degrees, counter-clockwise from +x. 0 if it does not exist;
/// `start` is then unchanged.
SL_LEVEL_API int32_t sl_level_start(const sl_level *level, int32_t number, double start[3]);

// --- doors, numbered from 0 in the order of the map. They begin as the map has them.

SL_LEVEL_API int32_t sl_level_door_count(const sl_level *level);
/// The name of a door, which stays as long as the level. Several doors may have one name. NULL for
/// no door.
SL_LEVEL_API const char *sl_level_door_name(const sl_level *level, int32_t door);
/// The first door of a name from door `from` on; -1 for none.
SL_LEVEL_API int32_t sl_level_find_door(const sl_level *level, const char *name, int32_t from);
/// 0 for a door, 1 for a wall that breaks, 2 for a place for a wall; -1 for no door.
SL_LEVEL_API int32_t sl_level_door_kind(const sl_level *level, int32_t door);
/// Opens a door (1), or shuts it (0): all doors of its name. A wall that breaks is opened once, and
/// a wall is built once. 0, and nothing changes, to shut or open these again and for no door.
SL_LEVEL_API int32_t sl_level_set_door(sl_level *level, int32_t door, int32_t open);
/// Makes what sl_level_can_see says exact for the doors as they stand, if the map has no mirrors:
/// works through up to `portals` portals, of about 0.1 microseconds each. How many rows are left.
/// Before that nothing is missed.
SL_LEVEL_API int32_t sl_level_settle(sl_level *level, int32_t portals);
/// 1 for an open door, 0 for a shut one and for none.
SL_LEVEL_API int32_t sl_level_door_is_open(const sl_level *level, int32_t door);
/// The segments of a door: `*count` times x0, y0, x1, y1. NULL for no door.
SL_LEVEL_API const double *sl_level_door_segments(sl_level *level, int32_t door, int32_t *count);

// --- questions

/// The cell that holds a point; -1 for none.
SL_LEVEL_API int32_t sl_level_locate(const sl_level *level, double x, double y);
/// 1 if anything in one cell can be seen from anywhere in the other, past the doors as they stand.
/// Boxes do not count. What mirrors show does, here alone: to all other questions they are walls.
SL_LEVEL_API int32_t sl_level_can_see(const sl_level *level, int32_t from, int32_t to);
/// 1 if an eye at a point sees another point.
SL_LEVEL_API int32_t sl_level_sees(sl_level *level, double x0, double y0, double x1, double y1);
/// 1 if one may walk straight from one point to another. Box `own` does not stop it: that of who
/// walks, or -1.
SL_LEVEL_API int32_t sl_level_can_walk(sl_level *level, double x0, double y0, double x1, double y1,
                                       int32_t own);
/// Moves a disc toward a point, sliding along what stops it, and puts where it comes to into `at`.
/// 1 if it comes to that point. `own` is as for sl_level_can_walk.
SL_LEVEL_API int32_t sl_level_walk(sl_level *level, double x0, double y0, double x1, double y1,
                                   double radius, int32_t own, double at[2]);
/// For servers: which things each player may see, past doors but not boxes. Players and things are
/// boxes: min x, min y, max x, max y of each. A player may see from all around its box within
/// `margin`. Player p may see thing t if answer[p * row + t / 8] >> t % 8 & 1, with a row of
/// (thing_count + 7) / 8 bytes. No pair is missed. NULL if memory is short.
SL_LEVEL_API const unsigned char *sl_level_relevant(sl_level *level, const double *players,
                                                    int32_t player_count, double margin,
                                                    const double *things, int32_t thing_count);
/// The cells that an eye sees, `*count` of them. `heading` and `fov` are in degrees,
/// counter-clockwise from +x; a field of view of 180 or more is all round, one of 0 or less is the
/// line of the heading. `range` above 0 limits how far it sees; 0 stands for the map's own range.
SL_LEVEL_API const int32_t *sl_level_look(sl_level *level, double x, double y, double heading,
                                          double fov, double range, int32_t *count);
/// The polygon that an eye sees, counter-clockwise: `*count` pairs of numbers, 0 if it sees
/// nothing. As for sl_level_look.
SL_LEVEL_API const double *sl_level_visible_polygon(sl_level *level, double x, double y,
                                                    double heading, double fov, double range,
                                                    int32_t *count);

// --- boxes that move

/// Makes room for `count` boxes, which are nowhere yet; those before are gone. 0 if memory is
/// short: there are then none.
SL_LEVEL_API int32_t sl_level_set_box_count(sl_level *level, int32_t count);
/// Puts a box at a place. One that blocks (1) hides what is behind it.
SL_LEVEL_API void sl_level_move_box(sl_level *level, int32_t box, double min_x, double min_y,
                                    double max_x, double max_y, int32_t blocks);
/// Which boxes an eye sees: a byte for each, 1 or 0. As for sl_level_look.
SL_LEVEL_API const unsigned char *sl_level_boxes_seen(sl_level *level, double x, double y,
                                                      double heading, double fov, double range,
                                                      int32_t *count);

#ifdef __cplusplus
}
#endif

#endif
