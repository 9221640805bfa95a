/// What a point sees, as lines through pairs of given points. Nothing here is rounded but what says
/// so, so that placement can decide all by exact predicates.
///
///         wall of a front                 The region of an eye is a fan of fronts: pieces of
///      +-----------+-----                 walls, each between two rays through corners. Where the
///       .    seen  |.                     distance jumps from one front to the next there is a
///         .        | .  far end           window, a segment of the ray from a corner, its apex,
///           .      |  .                   to a wall. What lies at its other side is not seen.
///      ------+ apex|
///               .
///                 . eye
#ifndef SLI_PLACE_LOOKS_H
#define SLI_PLACE_LOOKS_H

#include "sightline/query.h"

/// A piece of a wall that is seen, from the ray through `right` counter-clockwise to the one
/// through `left`.
typedef struct sli_front {
    sl_point right, left; ///< corners that the rays pass, maybe before the wall
    sl_segment wall;      ///< its line
} sli_front;

/// A segment on the ray through the apex, from there to the wall that it ends on.
typedef struct sli_window {
    sl_point apex;
    sl_segment wall; ///< the line of the wall that it ends on
    sl_point far;    ///< where it ends, rounded
    int seen;        ///< the side of the ray that is seen: 1 left, -1 right
} sli_window;

/// Zeroed, it is empty.
typedef struct sli_look {
    sl_point eye;
    sl_box bounds; ///< of the region
    double area;   ///< of the region, rounded
    uint32_t front_count, window_count;
    sli_front *fronts; ///< counter-clockwise
    sli_window *windows;
    double *angles; ///< by front: that of its right ray, rounded, ascending (sli_look_angle)
    /// No line of sight touches two corners of walls and runs on behind them in only one direction
    /// (a needle): the region has all that sees the eye.
    bool general;
} sli_look;

/// A direction as a number from 0 to less than 4, counter-clockwise from +x.
double sli_look_angle(sl_point direction);

/// *clean is false, and the look empty, where the eye sees nothing, or the region has an edge that
/// is lost in rounding.
sl_status sli_look_make(sl_context *context, sl_query *query, sl_region *memory, sl_point eye,
                        sli_look *out, bool *clean);
/// Whether the closed region holds a point. True is exact; false too where there are no windows,
/// else unless several fronts are within the rounding of an angle.
bool sli_look_holds(const sli_look *look, sl_point point);
void sli_look_destroy(sl_context *context, sli_look *look); ///< and zeroes it

#endif
