/// Which way portals are crossed, and the rule that keeps searches over portal sequences finite:
/// some one direction crosses all portals of a sequence strictly forwards. Every sightline has such
/// a direction, and so no sequence enters a cell twice.
#ifndef SL_DIRECTIONS_H
#define SL_DIRECTIONS_H

#include "effects/mirrors.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/space.h"

#include <math.h>

// --- the directions of portals

#define SLI_NO_PORTAL UINT32_MAX

/// The directions of a sequence's portals, from right end to left end, span less than half a turn:
/// from that of directed portal `least` counter-clockwise to that of directed portal `most`.
/// SLI_NO_PORTAL for both: none yet.
typedef struct sli_directions {
    uint32_t least, most;
} sli_directions;

#define SLI_NO_DIRECTIONS ((sli_directions){SLI_NO_PORTAL, SLI_NO_PORTAL})

/// Whether two directions along one line are the same.
static inline bool sli_same_way(const sl_directed_portal *a, const sl_directed_portal *b) {
    return a->left.x != a->right.x ? (a->left.x > a->right.x) == (b->left.x > b->right.x)
                                   : (a->left.y > a->right.y) == (b->left.y > b->right.y);
}

/// What one more directed portal does to the directions of those so far.
typedef enum sli_direction_change {
    SLI_CROSSES_NEVER,  ///< no direction is left
    SLI_CROSSES_WITHIN, ///< it is among them
    SLI_CROSSES_LEAST,  ///< it is the least now
    SLI_CROSSES_MOST,   ///< it is the most now
} sli_direction_change;

/// `alone`: least and most are one directed portal.
static inline sli_direction_change sli_direction_change_of(const sl_directed_portal *least,
                                                           const sl_directed_portal *most,
                                                           bool alone,
                                                           const sl_directed_portal *directed) {
    const int from_least = sli_turn(least->right, least->left, directed->right, directed->left);
    const int from_most =
        alone ? from_least : sli_turn(most->right, most->left, directed->right, directed->left);
    if (from_least == 0 && from_most == 0)
        return sli_same_way(least, directed) ? SLI_CROSSES_WITHIN : SLI_CROSSES_NEVER;
    if (from_least >= 0 && from_most <= 0) return SLI_CROSSES_WITHIN;
    if (from_least <= 0 && from_most >= 0) return SLI_CROSSES_NEVER;
    return from_most > 0 ? SLI_CROSSES_MOST : SLI_CROSSES_LEAST;
}

/// Adds a directed portal, by its number; false, and nothing added, where no direction is left.
static inline bool sli_directions_add(const sl_space *space, sli_directions *directions,
                                      uint32_t number) {
    if (directions->least == SLI_NO_PORTAL) {
        *directions = (sli_directions){number, number};
        return true;
    }
    const sli_direction_change crossing = sli_direction_change_of(
        &space->directed[directions->least], &space->directed[directions->most],
        directions->least == directions->most, &space->directed[number]);
    if (crossing == SLI_CROSSES_MOST) directions->most = number;
    if (crossing == SLI_CROSSES_LEAST) directions->least = number;
    return crossing != SLI_CROSSES_NEVER;
}

// --- places in mirrored space

/// A step of a portal sequence that mirrors may reflect.
typedef struct sli_unfolded {
    sl_directed_portal ends; ///< of what was crossed last, where mirrored space has it
    uint32_t least, most;    ///< places that bound the directions of all portals; 0 for none yet
    sli_mirror_frame frame;  ///< beyond it
    uint32_t mirror;         ///< crossed last; UINT32_MAX for a portal
} sli_unfolded;

/// Where a portal of the map lies in a frame; *rounded is set where that is not exact.
static inline sl_directed_portal sli_unfold(const sli_mirror_frame *frame, sl_point left,
                                            sl_point right, bool *rounded) {
    if (!frame->depth) return (sl_directed_portal){.left = left, .right = right};
    *rounded |= frame->rounded;
    const sl_point l = sli_mirror_frame_place(frame, left, rounded);
    const sl_point r = sli_mirror_frame_place(frame, right, rounded);
    return frame->depth % 2 ? (sl_directed_portal){.left = r, .right = l}
                            : (sl_directed_portal){.left = l, .right = r};
}

/// Whether some direction crosses all portals up to a new place, the last one of which is `from`;
/// sets its bounds. `here`: its number.
static inline bool sli_unfolded_may_cross(const sl_directed_portal *least,
                                          const sl_directed_portal *most, const sli_unfolded *from,
                                          uint32_t here, sli_unfolded *to) {
    to->least = from->least;
    to->most = from->most;
    if (!from->least) {
        to->least = to->most = here;
        return true;
    }
    const sli_direction_change crossing =
        sli_direction_change_of(least, most, from->least == from->most, &to->ends);
    if (crossing == SLI_CROSSES_LEAST) to->least = here;
    if (crossing == SLI_CROSSES_MOST) to->most = here;
    return crossing != SLI_CROSSES_NEVER;
}

/// Whether a line keeps clear of both ends of a portal in a rounded frame by more than the frame's
/// rounding can have moved them: then it also passes the portal where it really lies. `size`: the
/// largest coordinate of the map.
static inline bool sli_unfolded_is_clear(const sli_mirror_frame *frame,
                                         const sl_directed_portal *ends, sl_point a, sl_point b,
                                         double size) {
    const double x = b.x - a.x, y = b.y - a.y, length = sli_length(x, y);
    const double slack = 0x1p-46 * frame->depth * (size + fabs(frame->x) + fabs(frame->y));
    return x * (ends->left.y - a.y) - y * (ends->left.x - a.x) > slack * length &&
           x * (ends->right.y - a.y) - y * (ends->right.x - a.x) < -slack * length;
}

#endif
