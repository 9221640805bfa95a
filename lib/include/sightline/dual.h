/// The lines through a portal sequence as a region of the dual plane: each line is a point there,
/// each portal end a half-plane, and the lines through all portals a convex polygon.
#ifndef SIGHTLINE_DUAL_H
#define SIGHTLINE_DUAL_H

#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The polygon's corners at most: those of the frame and one more for each portal end.
#define SL_DUAL_PORTALS_MOST 256
/// The most corners that a dual polygon can have.
#define SL_DUAL_CORNERS_MOST (2 * SL_DUAL_PORTALS_MOST + 4)

/// How far slopes and heights are looked at: the frame's half width and half height. Coordinates
/// are scaled so that all portal ends lie within a circle of radius 1; of steeper lines only those
/// that portals 8 times longer than far apart let through are cut off.
#define SL_DUAL_SLOPE 8.0
/// Half of the frame's height.
#define SL_DUAL_HEIGHT 9.0

/// A line y' = slope x' + height, in a frame turned so that all portals are crossed towards +x'.
typedef struct sl_dual_line {
    double slope, height;
} sl_dual_line;

/// The dual of a sequence. Rounded: to be shown, not to decide by.
typedef struct sl_dual {
    sl_point origin;       ///< of the turned frame
    sl_point along;        ///< its +x', of length 1
    double scale;          ///< a unit of the frame in units of the map
    uint32_t corner_count; ///< 0 where no line is left
    sl_dual_line corners[SL_DUAL_CORNERS_MOST];
    /// The optimum of the linear program: the line whose least distance along y' to any end is the
    /// largest, and that distance in units of the frame; negative where an end is on its wrong
    /// side.
    sl_dual_line best;
    double margin;
} sl_dual;

/// The dual of up to SL_DUAL_PORTALS_MOST portals (those behind are not looked at); at least one.
/// The frame is that of all of them, while only the first `cutting` cut the polygon and bound the
/// optimum.
SL_API void sl_dual_make(const sl_portal_ends *portals, uint32_t count, uint32_t cutting,
                         sl_dual *out);

/// The half-plane of an end: lines with height <= y' - slope x' (left ends) or >= (right ends).
SL_API sl_point sl_dual_point(const sl_dual *dual, sl_point point); ///< in the turned frame

/// Two points of a line, in the map, at x' = from and x' = to.
SL_API sl_line sl_dual_line_at(const sl_dual *dual, sl_dual_line line, double from, double to);

/// The distance along y' of the end nearest to a line; negative where one is on its wrong side.
SL_API double sl_dual_margin(const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                             sl_dual_line line);

#ifdef __cplusplus
}
#endif

#endif
