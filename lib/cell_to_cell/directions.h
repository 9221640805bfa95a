/// Which way portals are crossed, and the rule that keeps searches over portal sequences finite:
/// some one direction crosses all portals of a sequence strictly forwards. Every sightline has such
/// a direction, and so no sequence enters a cell twice.
#ifndef SL_DIRECTIONS_H
#define SL_DIRECTIONS_H

#include "effects/mirrors.h"
#include "geometry/orient.h"
#include "sightline/space.h"

// --- the directions of portals

#define SL_NO_PORTAL UINT32_MAX

/// The directions of a sequence's portals, from right end to left end, span less than half a turn:
/// from that of directed portal `least` counter-clockwise to that of directed portal `most`.
/// SL_NO_PORTAL for both: none yet.
typedef struct sl_directions {
    uint32_t least, most;
} sl_directions;

#define SL_NO_DIRECTIONS ((sl_directions){SL_NO_PORTAL, SL_NO_PORTAL})

/// Whether two directions along one line are the same.
static inline bool sl_same_way(const sl_directed_portal *a, const sl_directed_portal *b) {
    return a->left.x != a->right.x ? (a->left.x > a->right.x) == (b->left.x > b->right.x)
                                   : (a->left.y > a->right.y) == (b->left.y > b->right.y);
}

/// What one more directed portal does to the directions of those so far.
typedef enum sl_direction_change {
    SL_CROSSES_NEVER,  ///< no direction is left
    SL_CROSSES_WITHIN, ///< it is among them
    SL_CROSSES_LEAST,  ///< it is the least now
    SL_CROSSES_MOST,   ///< it is the most now
} sl_direction_change;

/// `alone`: least and most are one directed portal.
static inline sl_direction_change sl_direction_change_of(const sl_directed_portal *least,
                                                         const sl_directed_portal *most, bool alone,
                                                         const sl_directed_portal *directed) {
    const int from_least = sl_turn(least->right, least->left, directed->right, directed->left);
    const int from_most =
        alone ? from_least : sl_turn(most->right, most->left, directed->right, directed->left);
    if (from_least == 0 && from_most == 0)
        return sl_same_way(least, directed) ? SL_CROSSES_WITHIN : SL_CROSSES_NEVER;
    if (from_least >= 0 && from_most <= 0) return SL_CROSSES_WITHIN;
    if (from_least <= 0 && from_most >= 0) return SL_CROSSES_NEVER;
    return from_most > 0 ? SL_CROSSES_MOST : SL_CROSSES_LEAST;
}

/// Adds a directed portal, by its number; false, and nothing added, where no direction is left.
static inline bool sl_directions_add(const sl_space *space, sl_directions *directions,
                                     uint32_t number) {
    if (directions->least == SL_NO_PORTAL) {
        *directions = (sl_directions){number, number};
        return true;
    }
    const sl_direction_change crossing = sl_direction_change_of(
        &space->directed[directions->least], &space->directed[directions->most],
        directions->least == directions->most, &space->directed[number]);
    if (crossing == SL_CROSSES_MOST) directions->most = number;
    if (crossing == SL_CROSSES_LEAST) directions->least = number;
    return crossing != SL_CROSSES_NEVER;
}

// --- places in mirrored space

/// A step of a portal sequence that mirrors may reflect.
typedef struct sl_unfolded {
    sl_directed_portal ends; ///< of what was crossed last, where mirrored space has it
    uint32_t least, most;    ///< places that bound the directions of all portals; 0 for none yet
    sl_mirror_frame frame;   ///< beyond it
    uint32_t mirror;         ///< crossed last; UINT32_MAX for a portal
} sl_unfolded;

/// Where a portal of the map lies in a frame; *rounded is set where that is not exact.
static inline sl_directed_portal sl_unfold(const sl_mirror_frame *frame, sl_point left,
                                           sl_point right, bool *rounded) {
    if (!frame->depth) return (sl_directed_portal){.left = left, .right = right};
    *rounded |= frame->rounded;
    const sl_point l = sl_mirror_frame_place(frame, left, rounded);
    const sl_point r = sl_mirror_frame_place(frame, right, rounded);
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
    const sl_direction_change crossing =
        sl_direction_change_of(least, most, from->least == from->most, &to->ends);
    if (crossing == SL_CROSSES_LEAST) to->least = here;
    if (crossing == SL_CROSSES_MOST) to->most = here;
    return crossing != SL_CROSSES_NEVER;
}

#endif
