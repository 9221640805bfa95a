/// A step of a portal sequence where mirrors reflect it: where mirrored space has the portal or
/// mirror crossed last.
#ifndef SL_UNFOLDED_H
#define SL_UNFOLDED_H

#include "cell_to_cell/crossing.h"
#include "effects/frame.h"

typedef struct sl_unfolded {
    sl_directed_portal ends; ///< of what was crossed last, where mirrored space has it
    uint32_t least, most;    ///< places that bound the directions of all portals; 0 for none yet
    sl_frame frame;          ///< beyond it
    uint32_t mirror;         ///< crossed last; UINT32_MAX for a portal
} sl_unfolded;

/// Where a portal of the map lies in a frame; *rounded is set where that is not exact.
static inline sl_directed_portal sl_unfold(const sl_frame *frame, sl_point left, sl_point right,
                                           bool *rounded) {
    if (!frame->depth) return (sl_directed_portal){.left = left, .right = right};
    *rounded |= frame->rounded;
    const sl_point l = sl_frame_place(frame, left, rounded);
    const sl_point r = sl_frame_place(frame, right, rounded);
    return frame->depth % 2 ? (sl_directed_portal){.left = r, .right = l}
                            : (sl_directed_portal){.left = l, .right = r};
}

/// Whether some direction crosses all portals up to a new place, the last one of which is `from`;
/// sets its bounds. `here`: its number.
static inline bool sl_unfolded_may_cross(const sl_directed_portal *least,
                                         const sl_directed_portal *most, const sl_unfolded *from,
                                         uint32_t here, sl_unfolded *to) {
    to->least = from->least;
    to->most = from->most;
    if (!from->least) {
        to->least = to->most = here;
        return true;
    }
    const sl_crossing crossing = sl_crossing_of(least, most, from->least == from->most, &to->ends);
    if (crossing == SL_CROSSES_LEAST) to->least = here;
    if (crossing == SL_CROSSES_MOST) to->most = here;
    return crossing != SL_CROSSES_NEVER;
}

#endif
