/// The line that an explanation shows.
#ifndef SL_EXPLAIN_LINE_H
#define SL_EXPLAIN_LINE_H

#include "sightline/explain.h"

/// Makes of a line one near it that is strictly between the ends of every portal of the sequence,
/// of as few decimals as will do. False, and the line as it was, where doubles cannot express one.
bool sl_simplify_line(const sl_space *space, const sl_sequence *sequence, sl_line *line);

/// The line's piece from the middle of its way through cell `from` to that through the last cell.
sl_segment sl_shown_segment(const sl_space *space, const sl_sequence *sequence, uint32_t from,
                            sl_line line);

#endif
