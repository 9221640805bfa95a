/// What exact solvers share: the exact predicate with its uses counted, and the few portal ends
/// that prove a sequence hidden.
#ifndef SL_CONFLICT_H
#define SL_CONFLICT_H

#include "geometry/orient.h"
#include "sightline/stab.h"
#include "sightline/support.h"

// --- the predicate

static inline int sl_orient_counted(sl_stab_account *account, sl_point a, sl_point b, sl_point c) {
    account->orientations++;
    const int sign = sl_orient_filter(a, b, c);
    if (sign) return sign;
    account->exact++;
    return sl_orient_exact(a, b, c);
}

// --- conflicts

/// Finds ends of the portals that no line keeps on their sides: strictly, or (strict false) not
/// even touching them. None of the ends found can be spared. The portals must have such ends. Time:
/// the product of the corners of the two hulls, in rare degenerate cases a power more.
sl_status sl_conflict_find(sl_context *context, const sl_portal_ends *portals, size_t count,
                           bool strict, sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *found);

#endif
