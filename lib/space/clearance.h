/// Clearance: how far free places are from the nearest wall.
#ifndef SL_SPACE_CLEARANCE_H
#define SL_SPACE_CLEARANCE_H

#include "space/channels.h"

/// Measures clearances; zeroed but for the first two, and destroyed in the end.
typedef struct sli_clearance {
    sl_context *context;
    const sli_channels *channels;
    uint32_t *seen, stamp; ///< by half-edge: the last search that came through its triangle
    SL_ARRAY(uint32_t) stack;
} sli_clearance;

sl_status sli_clearance_make(sl_context *context, const sli_channels *channels, sli_clearance *out);
void sli_clearance_destroy(sli_clearance *clearance); ///< and zeroes it

/// A place in a triangle that is far from walls, and its clearance. Not always the farthest one.
sl_status sli_clearance_of(sli_clearance *clearance, uint32_t half, sl_point *place, double *out);

/// Whether a place in a triangle has at least this clearance. Places that have it by less than 1/16
/// of it may be missed. *place is one.
sl_status sli_clearance_reaches(sli_clearance *clearance, uint32_t half, double wanted,
                                sl_point *place, bool *out);

#endif
