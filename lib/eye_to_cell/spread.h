/// From the eye's cell over portals, within its visible set: what two of the methods are but for
/// what they ask of a portal.
#ifndef SL_SPREAD_H
#define SL_SPREAD_H

#include "eye_to_cell/eye_search.h"

/// Whether to go through a directed portal.
typedef bool sl_spread_test(sl_eye_query *query, const sl_directed_portal *directed);

/// Adds to the result each cell that can be reached, the eye's own first.
sl_status sl_eye_spread(sl_context *context, sl_eye_query *query, sl_spread_test *test);

#endif
