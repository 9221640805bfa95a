/// Solid ground as polygons: the walls of a map that have marks, traced from end to end.
#ifndef SL_MAP_GROUND_H
#define SL_MAP_GROUND_H

#include "sightline/map.h"

/// Whether a wall parts two open polygons, each of which says that the other one is solid.
static inline bool sli_ground_parts_rooms(uint32_t ground) {
    return ground & SL_OPEN_LEFT && ground & SL_OPEN_RIGHT;
}

/// How often solid ground begins at a wall, going from its right to its left; below 0 where it
/// ends.
static inline int32_t sli_ground_begins(uint32_t ground) {
    return (int32_t)(ground & ~(uint32_t)(SL_SOLID_BEGINS - 1)) / SL_SOLID_BEGINS;
}

/// While a map is cleaned, SLI_GROUND_KEPT is or-ed to the ground of a wall that a mirror is on.
enum { SLI_GROUND_SIDES = 15, SLI_GROUND_KEPT = 16 };

/// The ground of two walls that are one. Both go the same way.
static inline uint32_t sli_ground_joined(uint32_t a, uint32_t b) {
    const uint32_t flags = SL_SOLID_BEGINS - 1;
    return ((a | b) & flags) | ((a & ~flags) + (b & ~flags));
}

/// As sl_ground_turned, while a map is cleaned.
static inline uint32_t sli_ground_turned(uint32_t ground) {
    return sl_ground_turned(ground) | (ground & SLI_GROUND_KEPT);
}

/// Whether a wall has solid ground at both sides, nothing that contradicts this, and no mirror on
/// it: nobody ever sees it. One at which solid ground begins is kept, to count how often it does.
static inline bool sli_ground_hides_wall(uint32_t ground) {
    return ground == (SL_SOLID_LEFT | SL_SOLID_RIGHT);
}

/// Adds a polygon of solid ground, or of open ground, as sl_map_add_solid and sl_map_add_open do;
/// `source` is for messages.
sl_status sli_map_add_ground(sl_context *context, sl_map *map, const char *source, bool open,
                             const sl_point *corners, size_t count, uint32_t line);

/// Who takes the polygons and walls; NULL for those not asked for: `polygon` and `wall` are so
/// together. A status other than SL_OK ends the work.
typedef struct sli_loop_user {
    void *user;
    /// A polygon, counter-clockwise with `solid` ground inside, or clockwise with solid ground
    /// outside and open ground inside.
    /// `line` is the first of its walls' lines.
    sl_status (*polygon)(void *user, const sl_point *corners, size_t count, bool solid,
                         uint32_t line);
    /// A wall with solid ground at its left that is in no such polygon.
    sl_status (*wall)(void *user, sl_point from, sl_point to, uint32_t line);
    /// A wall between two open polygons.
    sl_status (*plain)(void *user, sl_point from, sl_point to, uint32_t line);
} sli_loop_user;

/// Traces all walls with solid ground beside them. A wall between two solid grounds is in two
/// polygons.
sl_status sli_ground_trace(sl_context *context, const sl_wall *walls, size_t count,
                           const sli_loop_user *user);

#endif
