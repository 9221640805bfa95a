/// What the incremental exact solver knows beyond its verdict.
#ifndef SL_FUNNEL_H
#define SL_FUNNEL_H

#include "geometry/orient.h"
#include "sightline/stab.h"
#include "sightline/support.h"

/// A corner of the polygon of lines: a directed line through two portal ends, and the end about
/// which it turns to become the next corner's line. In order, around.
typedef struct sli_funnel_corner {
    sl_point from, to, pivot;
} sli_funnel_corner;

/// Of the sequence as it stands, which must not be hidden or empty. No corners: all portals lie on
/// one line.
uint32_t sli_funnel_corner_count(const void *state);
sli_funnel_corner sli_funnel_corner_at(const void *state, uint32_t i);

/// The length of the shortest piece, between the first portal and the last one, of the lines
/// through the sequence as it stands, which must not be hidden or empty. 0 for one portal. Rounded:
/// to within SLI_SHORTEST_ERROR of itself, unless portals are a thousand times as long or more,
/// whose own rounding then counts.
///
/// The lines make up a convex polygon in the plane of lines, whose edges are turns about one portal
/// end each. Along a turn the length is the sum of two secants of the angle, which is convex; and
/// the shortest piece of all lies on an edge, for it touches an end of some portal.
double sli_funnel_shortest(const void *state);

#define SLI_SHORTEST_ERROR 0x1p-40

// --- What exact solvers share: the exact predicate with its uses counted, and the few portal ends
// --- that prove a sequence hidden.

// --- the predicate

static inline int sli_orient_counted(sl_stab_account *account, sl_point a, sl_point b, sl_point c) {
    account->orientations++;
    const int sign = sli_orient_filter(a, b, c);
    if (sign) return sign;
    account->exact++;
    return sli_orient_exact(a, b, c);
}

// --- conflicts

/// Finds ends of the portals that no line keeps on their sides: strictly, or (strict false) not
/// even touching them. None of the ends found can be spared. The portals must have such ends. Time:
/// the product of the corners of the two hulls, in rare degenerate cases a power more.
sl_status sli_conflict_find(sl_context *context, const sl_portal_ends *portals, size_t count,
                            bool strict, sl_stab_end ends[SL_CONFLICT_MOST], uint32_t *found);

#endif
