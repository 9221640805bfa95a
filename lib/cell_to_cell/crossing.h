/// Which way a portal is crossed, and the rule that keeps searches over portal sequences finite: a
/// direction that has been crossed is never crossed backwards. No line passes both strictly.
#ifndef SL_CROSSING_H
#define SL_CROSSING_H

#include "sightline/space.h"

/// Directions, to be or-ed; a direction's opposite is its neighbour.
enum sl_crossing { SL_RIGHTWARDS = 1, SL_LEFTWARDS = 2, SL_UPWARDS = 4, SL_DOWNWARDS = 8 };

static inline uint32_t sl_crossing_of(const sl_exit *exit) {
    if (exit->left.x == exit->right.x)
        return exit->left.y > exit->right.y ? SL_RIGHTWARDS : SL_LEFTWARDS;
    return exit->left.x < exit->right.x ? SL_UPWARDS : SL_DOWNWARDS;
}

static inline uint32_t sl_crossing_opposite(uint32_t crossing) {
    return crossing & (SL_RIGHTWARDS | SL_UPWARDS) ? crossing << 1 : crossing >> 1;
}

static inline const char *sl_crossing_name(uint32_t crossing) {
    return crossing == SL_RIGHTWARDS  ? "rightwards"
           : crossing == SL_LEFTWARDS ? "leftwards"
           : crossing == SL_UPWARDS   ? "upwards"
                                      : "downwards";
}

#endif
