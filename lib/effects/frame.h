/// A frame of mirrored space: where the map comes to lie after a number of reflections.
#ifndef SL_FRAME_H
#define SL_FRAME_H

#include "sightline/geometry.h"

#include <stdbool.h>
#include <stdint.h>

/// p goes to (xx p.x + xy p.y + x, yx p.x + yy p.y + y).
///
/// Reflections in axial mirrors only change signs and add: frames and places in them are exact as
/// long as all sums are (coordinates with few bits, as those of drawings and games, always are).
/// Else, and with oblique mirrors, they are rounded, and say so.
typedef struct sl_frame {
    double xx, xy, x, yx, yy, y;
    uint32_t depth; ///< reflections so far; an odd number swaps left and right
    bool rounded;
} sl_frame;

sl_frame sl_frame_of_map(void);

/// The frame behind a mirror, whose ends are given as in the map.
sl_frame sl_frame_reflect(const sl_frame *frame, sl_segment mirror);

/// Where a point of the map lies; sets *rounded where that is not exact.
sl_point sl_frame_place(const sl_frame *frame, sl_point p, bool *rounded);

#endif
