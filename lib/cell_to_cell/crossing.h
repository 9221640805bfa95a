/// Which way portals are crossed, and the rule that keeps searches over portal sequences finite:
/// some one direction crosses all of a sequence's portals strictly forwards. No line does without,
/// and so no sequence enters a cell twice.
#ifndef SL_CROSSING_H
#define SL_CROSSING_H

#include "geometry/orient.h"
#include "sightline/space.h"

#define SL_NO_EXIT UINT32_MAX

/// The directions of a sequence's portals, from right end to left end, span less than half a turn:
/// from that of exit `least` counter-clockwise to that of exit `most`. SL_NO_EXIT for both: none
/// yet.
typedef struct sl_crossings {
    uint32_t least, most;
} sl_crossings;

#define SL_CROSSINGS_NONE ((sl_crossings){SL_NO_EXIT, SL_NO_EXIT})

/// Whether two directions along one line are the same.
static inline bool sl_same_way(const sl_exit *a, const sl_exit *b) {
    return a->left.x != a->right.x ? (a->left.x > a->right.x) == (b->left.x > b->right.x)
                                   : (a->left.y > a->right.y) == (b->left.y > b->right.y);
}

/// What one more exit does to the directions of those so far.
typedef enum sl_crossing {
    SL_CROSSES_NEVER,  ///< no direction is left
    SL_CROSSES_WITHIN, ///< it is among them
    SL_CROSSES_LEAST,  ///< it is the least now
    SL_CROSSES_MOST,   ///< it is the most now
} sl_crossing;

/// `alone`: least and most are one exit.
static inline sl_crossing sl_crossing_of(const sl_exit *least, const sl_exit *most, bool alone,
                                         const sl_exit *exit) {
    const int from_least = sl_turn(least->right, least->left, exit->right, exit->left);
    const int from_most =
        alone ? from_least : sl_turn(most->right, most->left, exit->right, exit->left);
    if (from_least == 0 && from_most == 0)
        return sl_same_way(least, exit) ? SL_CROSSES_WITHIN : SL_CROSSES_NEVER;
    if (from_least >= 0 && from_most <= 0) return SL_CROSSES_WITHIN;
    if (from_least <= 0 && from_most >= 0) return SL_CROSSES_NEVER;
    return from_most > 0 ? SL_CROSSES_MOST : SL_CROSSES_LEAST;
}

/// Adds an exit, by its number; false, and nothing added, where no direction is left.
static inline bool sl_crossings_add(const sl_space *space, sl_crossings *crossings,
                                    uint32_t number) {
    if (crossings->least == SL_NO_EXIT) {
        *crossings = (sl_crossings){number, number};
        return true;
    }
    const sl_crossing crossing =
        sl_crossing_of(&space->exits[crossings->least], &space->exits[crossings->most],
                       crossings->least == crossings->most, &space->exits[number]);
    if (crossing == SL_CROSSES_MOST) crossings->most = number;
    if (crossing == SL_CROSSES_LEAST) crossings->least = number;
    return crossing != SL_CROSSES_NEVER;
}

#endif
