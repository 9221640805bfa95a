/// Axial walls sorted by the line they lie on, so that all walls of a line stand together.
#ifndef SL_WALL_LINES_H
#define SL_WALL_LINES_H

#include "sightline/map.h"
#include "sightline/support.h"

/// A wall, or what a region leaves of one: on the line x = at (axis 0) or y = at (axis 1), from lo
/// to hi in the other coordinate, lo < hi.
typedef struct sl_piece {
    double at, lo, hi;
    int axis;
    uint32_t seam; ///< 0 for a wall; else 1 + the part of the seams that this is of
} sl_piece;

/// All walls, by axis, at, lo. SL_BAD_INPUT names the first wall of `source` that is not axial, and
/// one that overlaps another.
sl_status sl_wall_lines(sl_context *context, const char *source, const sl_wall *walls, size_t count,
                        sl_piece **out);

/// The first of `count` sorted pieces on the line or beyond whose end is past `lo`.
size_t sl_wall_lines_find(const sl_piece *pieces, size_t count, int axis, double at, double lo);

/// Whether walls cover all of lo .. hi on a line.
bool sl_wall_lines_cover(const sl_piece *pieces, size_t count, int axis, double at, double lo,
                         double hi);

#endif
