/// Solid ground as polygons: the walls of a map that have marks, traced from end to end.
#ifndef SL_MAP_GROUND_H
#define SL_MAP_GROUND_H

#include "sightline/map.h"

/// While a map is cleaned, SLI_GROUND_KEPT is or-ed to the ground of a wall that a mirror is on.
enum { SLI_GROUND_SIDES = 15, SLI_GROUND_KEPT = 16 };

/// As sl_ground_turned, while a map is cleaned.
static inline uint32_t sli_ground_turned(uint32_t ground) {
    return sl_ground_turned(ground) | (ground & SLI_GROUND_KEPT);
}

/// Whether a wall has solid ground at both sides, and no mirror on it: nobody ever sees it.
static inline bool sli_ground_hides_wall(uint32_t ground) {
    const uint32_t both = SL_SOLID_LEFT | SL_SOLID_RIGHT;
    return (ground & (both | SLI_GROUND_KEPT)) == both;
}

/// Adds a polygon of solid ground, or of open ground, as sl_map_add_solid and sl_map_add_open do;
/// `source` is for messages.
sl_status sli_map_add_ground(sl_context *context, sl_map *map, const char *source, bool open,
                             const sl_point *corners, size_t count, uint32_t line);

/// Who takes the polygons. A status other than SL_OK ends the work.
typedef struct sli_loop_user {
    void *user;
    /// A polygon, counter-clockwise with `solid` ground inside, or clockwise with solid ground
    /// outside and open ground inside.
    sl_status (*polygon)(void *user, const sl_point *corners, size_t count, bool solid);
    /// A wall with solid ground at its left that is in no such polygon.
    sl_status (*wall)(void *user, sl_point from, sl_point to);
} sli_loop_user;

/// Traces all walls with solid ground beside them. A wall between two solid grounds is in two
/// polygons.
sl_status sli_ground_trace(sl_context *context, const sl_wall *walls, size_t count,
                           const sli_loop_user *user);

#endif
