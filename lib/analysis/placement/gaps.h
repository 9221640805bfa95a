/// What a set of viewpoints leaves unseen.
#ifndef SLI_PLACE_GAPS_H
#define SLI_PLACE_GAPS_H

#include "analysis/placement/columns.h"

typedef SL_ARRAY(sli_window_part) sli_window_parts;

/// The parts of windows beyond which, inside, no look sees anything. Where there is none, the looks
/// see all of each part of the inside in which one of them stands. Exact. `bounds` has those of the
/// looks, in their order. `gaps` has what the first `known` looks leave, and gets what all do.
sl_status sli_gaps_find(sl_context *context, const sli_ground *ground, const sli_look *const *looks,
                        uint32_t count, sli_nearby *bounds, uint32_t known, sli_window_parts *gaps);

#endif
