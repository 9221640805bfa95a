/// Where cells end at mirrors.
#ifndef SL_MIRROR_SIDES_H
#define SL_MIRROR_SIDES_H

#include "sightline/space.h"

/// A piece of a cell's boundary on a mirror that reflects there; its ends as crossed on the way
/// out.
typedef struct sl_mirror_side {
    sl_point left, right;
    uint32_t cell, mirror;
} sl_mirror_side;

typedef struct sl_mirror_sides {
    sl_mirror_side *sides; ///< those of cell c: sides[first[c] .. first[c + 1])
    uint32_t *first;
} sl_mirror_sides;

/// What of a piece of a cell's boundary, counter-clockwise, on a mirror's line lies on the mirror,
/// if that reflects there. False for nothing.
bool sl_mirror_covers(const sl_glass *mirror, sl_point from, sl_point to, sl_point *right,
                      sl_point *left);

/// A coordinate that grows along a line from one point to another.
double sl_mirror_along(sl_point from, sl_point to, sl_point p);

/// The first side of a cell on a mirror; false where there is none.
bool sl_mirror_side_of(const sl_space *space, const sl_map *map, uint32_t cell, uint32_t mirror,
                       sl_mirror_side *out);

/// Mirrors must be walls of the space too (sl_map_clean makes them so).
sl_status sl_mirror_sides_find(sl_context *context, const sl_space *space, const sl_map *map,
                               sl_mirror_sides *out);
void sl_mirror_sides_destroy(sl_context *context, sl_mirror_sides *sides);

#endif
