/// The line that an explanation shows.
#ifndef SL_EXPLAIN_LINE_H
#define SL_EXPLAIN_LINE_H

#include "sightline/explain.h"

/// Makes of a line one near it that is strictly between the ends of every portal of the sequence,
/// of as few decimals as will do. False, and the line as it was, where doubles cannot express one.
bool sl_simplify_line(const sl_space *space, const sl_sequence *sequence, sl_line *line);

/// For each cell how many portals it is from a cell, SL_NO_WAY where none lead there. The caller
/// frees *out, on failure too.
sl_status sl_find_distances(sl_context *context, const sl_space *space, uint32_t to,
                            uint32_t **out);

/// At what share of a portal, from its left end, a line crosses it; 0 where it lies along it.
double sl_share_of_portal(const sl_directed_portal *directed, sl_line line);

/// From a point on a cell's boundary half the way through it.
sl_point sl_halfway_into(const sl_space *space, uint32_t cell, sl_point at, sl_point direction);

/// The line's piece from the middle of its way through cell `from` to that through the last cell.
sl_segment sl_shown_segment(const sl_space *space, const sl_sequence *sequence, uint32_t from,
                            sl_line line);

#endif
