/// Reach: may some place near one point see some place near another? So a server asks whether one
/// player may see another within the next moments, wherever both move until then.
///
///     sl_reach *reach;
///     bool sees;
///     sl_reach_create(context, query, &reach);
///     sl_reach_sees_within(context, reach, a, 0.8, b, 0.8, SL_REACH_ON_FOOT, &sees);
///     sl_reach_destroy(context, reach);
///
/// Conservative: it never misses. It is the runtime header's search from box to box
/// (sl_runtime_sees_within), so both give the same answers.
#ifndef SIGHTLINE_REACH_H
#define SIGHTLINE_REACH_H

#include "sightline/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What is within reach of a point.
typedef enum sl_reach_kind {
    SL_REACH_STRAIGHT, ///< all places up to so far from it, through walls, too
    SL_REACH_ON_FOOT,  ///< all places that a way of that length leads to, through open doors
} sl_reach_kind;

/// Serves one thread at a time.
typedef struct sl_reach sl_reach;

/// Makes a reach over the space and the map of a query, which must outlive it. Time and memory:
/// those of writing a baked file of the space. SL_BAD_ARGUMENT for a query without a map,
/// SL_UNSUPPORTED for a loose space.
SL_API sl_status sl_reach_create(sl_context *context, sl_query *query, sl_reach **out);
SL_API void sl_reach_destroy(sl_context *context, sl_reach *reach); ///< NULL is allowed

/// Whether some place within `radius0` of a may see some place within `radius1` of b, directly.
/// Doors and the range are those of the query at the time of the question; its boxes do not count,
/// mirrors are walls, and limited walls are open.
///
/// Never false where it is so by sl_query_sees; a place on a wall counts on foot on the side that
/// the way comes from. Where it is true without need, then by little: discs count as the squares
/// about them; and as sl_runtime_relevant says. On foot, what counts of each cell that a way leads
/// to is the box about its part of the square; ways are measured from portal to portal, each at the
/// place nearest to the one before. Beyond 64 portals it is as if straight.
///
/// A radius of 0 is the point alone. False where no place within reach is inside the bounds.
/// SL_BAD_ARGUMENT for a radius that is negative or not finite, and for such a point. No memory is
/// allocated. Time: the portals between both squares; on foot, for each cell in reach of a.
SL_API sl_status sl_reach_sees_within(sl_context *context, sl_reach *reach, sl_point a,
                                      double radius0, sl_point b, double radius1,
                                      sl_reach_kind kind, bool *out);

#ifdef __cplusplus
}
#endif

#endif
