/// Mirrors: what lies where in mirrored space, and which sides of cells reflect.
///
/// To look into a mirror from a place is to look at the map itself from the place's image, straight
/// through the mirror. So nothing of the map need be mirrored. A view from one eye folds: the eye
/// and the few points that bound its sight are reflected (sli_fold). A search over portal sequences
/// unfolds: portals are placed in a frame of mirrored space, in which the sightline stays straight.
#ifndef SL_MIRRORS_H
#define SL_MIRRORS_H

#include "geometry/orient.h"
#include "sightline/geometry.h"
#include "sightline/space.h"

#include <stdbool.h>
#include <stdint.h>

// --- images of points

/// The image of a point in a mirror's line. Points on that line stay as they are. An axial mirror's
/// images are sums of coordinates, and exact as long as two doubles hold them; *rounded is set
/// where they do not. An oblique mirror's are good to about four units in the last place of the
/// larger of their distances from the origin and from the mirror's first end; *rounded is set.
sli_fine sli_fold(sl_segment mirror, const sli_fine *point, bool *rounded);

// --- frames of mirrored space

/// A frame of mirrored space: where the map comes to lie after a number of reflections. A point p
/// goes to (xx p.x + xy p.y + x, yx p.x + yy p.y + y).
///
/// Reflections in axial mirrors only change signs and add: frames and places in them are exact as
/// long as all sums are (coordinates with few bits, as those of drawings and games, always are).
/// Else, and with oblique mirrors, they are rounded, and say so.
typedef struct sli_mirror_frame {
    double xx, xy, x, yx, yy, y;
    uint32_t depth; ///< reflections so far; an odd number swaps left and right
    bool rounded;
} sli_mirror_frame;

sli_mirror_frame sli_mirror_frame_of_map(void);

/// The frame behind a mirror, whose ends are given as in the map.
sli_mirror_frame sli_mirror_frame_reflect(const sli_mirror_frame *frame, sl_segment mirror);

/// Where a point of the map lies; sets *rounded where that is not exact.
sl_point sli_mirror_frame_place(const sli_mirror_frame *frame, sl_point p, bool *rounded);

// --- where cells end at mirrors

/// A piece of a cell's boundary on a mirror that reflects there; its ends as crossed on the way
/// out.
typedef struct sli_mirror_side {
    sl_point left, right;
    uint32_t cell, mirror;
} sli_mirror_side;

typedef struct sli_mirror_sides {
    sli_mirror_side *sides; ///< those of cell c: sides[first[c] .. first[c + 1])
    uint32_t *first;
} sli_mirror_sides;

/// What of a piece of a cell's boundary, counter-clockwise, on a mirror's line lies on the mirror,
/// if that reflects there. False for nothing.
bool sli_mirror_covers(const sl_glass *mirror, sl_point from, sl_point to, sl_point *right,
                       sl_point *left);

/// A coordinate that grows along a line from one point to another.
double sli_mirror_along(sl_point from, sl_point to, sl_point p);

/// The first side of a cell on a mirror; false where there is none.
bool sli_mirror_side_of(const sl_space *space, const sl_map *map, uint32_t cell, uint32_t mirror,
                        sli_mirror_side *out);

/// Mirrors must be walls of the space too (sl_map_clean makes them so).
sl_status sli_mirror_sides_find(sl_context *context, const sl_space *space, const sl_map *map,
                                sli_mirror_sides *out);
void sli_mirror_sides_destroy(sl_context *context, sli_mirror_sides *sides);

#endif
