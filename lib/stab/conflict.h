/// The few portal ends that prove a sequence hidden.
#ifndef SL_CONFLICT_H
#define SL_CONFLICT_H

#include "sightline/stab.h"
#include "sightline/support.h"

/// Finds ends of the portals that no line keeps on their sides: strictly, or (strict false) not
/// even touching them. None of the ends found can be spared. The portals must have such ends. Time:
/// the product of the corners of the two hulls, in rare degenerate cases a power more.
sl_status sl_conflict_find(sl_context *context, const sl_portal_ends *portals, size_t count,
                           bool strict, sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *found);

#endif
