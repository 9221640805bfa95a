/// A pen that draws walls: straight lines and curves, through an affine map, into a map.
///
/// Curves become chords that end on the curve. No point of the curve is farther than the tolerance
/// from its chord, measured in the map's unit; where no tolerance is asked for, no farther than
/// 1/200 of the curve's own size (32 chords a circle).
#ifndef SL_IMPORT_PEN_H
#define SL_IMPORT_PEN_H

#include "sightline/map.h"

/// x' = xx x + xy y + x0, y' = yx x + yy y + y0.
typedef struct sl_affine {
    double xx, xy, x0, yx, yy, y0;
} sl_affine;

#define SL_AFFINE_NONE ((sl_affine){.xx = 1, .yy = 1})

/// The map that does `inner` first, then `outer`.
sl_affine sl_affine_after(sl_affine outer, sl_affine inner);
/// About the origin; multiples of a quarter turn are exact.
sl_affine sl_affine_turn(double degrees);

typedef struct sl_pen {
    sl_context *context;
    const char *name; ///< of the file, for messages
    sl_map *map;
    sl_affine affine; ///< from the drawing's coordinates to the map's
    double tolerance; ///< in the map's unit; 0: the usual
    uint32_t line;    ///< of the file, where walls are said to be from
    sl_point at;      ///< the pen, in the drawing's coordinates
    size_t walls;     ///< drawn
    size_t points;    ///< lines of no length, left out
} sl_pen;

/// Each draws from where the pen is, and moves it. SL_BAD_INPUT where the map's coordinate would
/// not be usable, or where there are more walls than 2^24.
sl_status sl_pen_line(sl_pen *pen, sl_point to);
/// The arc centre + u cos t + v sin t for t from 0 to `sweep` (radians, up to a full turn either
/// way), to `to`, which is where it ends but for rounding.
sl_status sl_pen_arc(sl_pen *pen, sl_point centre, sl_point u, sl_point v, double sweep,
                     sl_point to);
/// A cubic Bézier curve with two control points.
sl_status sl_pen_cubic(sl_pen *pen, sl_point first, sl_point second, sl_point to);

#endif
