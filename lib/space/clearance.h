/// Clearance: how far free places are from the nearest wall.
#ifndef SL_SPACE_CLEARANCE_H
#define SL_SPACE_CLEARANCE_H

#include "space/channels.h"
#include "space/index.h"

/// Measures clearances; zeroed but for the first two, and destroyed in the end.
typedef struct sli_clearance {
    sl_context *context;
    const sli_channels *channels;
    sli_box_tree tree; ///< of the walls
    uint32_t *walls;   ///< by box of the tree: the edge
    uint32_t last;     ///< the edge that was found last, which is often near the next place, too
    uint64_t steps;    ///< walls and boxes of the tree that were looked at
    uint64_t asked;    ///< the steps at which somebody was asked whether to go on
    size_t cut_short;  ///< how many searches for a place were given up
} sli_clearance;

sl_status sli_clearance_make(sl_context *context, const sli_channels *channels, sli_clearance *out);
void sli_clearance_destroy(sli_clearance *clearance); ///< and zeroes it

/// A place in a triangle that is far from walls, and its clearance. Not always the farthest one.
/// *out is -1, and *place stays, if the clearance is not above `least`.
sl_status sli_clearance_of(sli_clearance *clearance, uint32_t half, double least, sl_point *place,
                           double *out);

/// Whether a place in a triangle has at least this clearance. Places that have it by less than 1/16
/// of it may be missed. *place is one. In a sliver that is thousands of times as long the search
/// is given up: then *out is false, and `cut_short` counts it.
sl_status sli_clearance_reaches(sli_clearance *clearance, uint32_t half, double wanted,
                                sl_point *place, bool *out);

#endif
