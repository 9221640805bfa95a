/// What the searches for explanations share: distances, the range, and the line that is shown.
#ifndef SL_EXPLAIN_LINE_H
#define SL_EXPLAIN_LINE_H

#include "sightline/explain.h"

/// For each cell how many portals it is from a cell, SL_NO_WAY where none lead there. The caller
/// frees *out, on failure too.
sl_status sli_find_distances(sl_context *context, const sl_space *space, uint32_t to,
                             uint32_t **out);

/// Whether a sequence, not hidden, has a line that is no longer than the range.
bool sli_explain_in_range(const sl_explain_options *options, const void *solver_state);

/// At what share of a portal, from its left end, a line crosses it; 0 where it lies along it.
double sli_share_of_portal(const sl_directed_portal *directed, sl_line line);

/// From a point on a cell's boundary half the way through it.
sl_point sli_halfway_into(const sl_space *space, uint32_t cell, sl_point at, sl_point direction);

#endif
