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

/// Adds an exit, by its number; false, and nothing added, where no direction is left.
static inline bool sl_crossings_add(const sl_space *space, sl_crossings *crossings,
                                    uint32_t number) {
    if (crossings->least == SL_NO_EXIT) {
        *crossings = (sl_crossings){number, number};
        return true;
    }
    const sl_exit *exit = &space->exits[number];
    const sl_exit *least = &space->exits[crossings->least];
    const sl_exit *most = &space->exits[crossings->most];
    const int from_least = sl_turn(least->right, least->left, exit->right, exit->left);
    const int from_most = crossings->least == crossings->most
                              ? from_least
                              : sl_turn(most->right, most->left, exit->right, exit->left);
    if (from_least == 0 && from_most == 0) return sl_same_way(least, exit);
    if (from_least >= 0 && from_most <= 0) return true;
    if (from_least <= 0 && from_most >= 0) return false;
    if (from_most > 0)
        crossings->most = number;
    else
        crossings->least = number;
    return true;
}

#endif
