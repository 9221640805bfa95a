/// What the check of proofs makes of a part: other problems, whose bounds are bounds for the part.
/// The code is the check's own, and shares nothing with what finds proofs.
#ifndef SLI_COVER_CHECK_H
#define SLI_COVER_CHECK_H

#include "sightline/set_cover.h"
#include "sightline/support.h"

/// Where the entries of a column begin.
static inline size_t sli_checked_begin(const sl_cover_problem *p, uint32_t column) {
    return column ? p->ends[column - 1] : 0;
}

/// A problem while it is made: its columns one after the other.
typedef struct sli_made_problem {
    SL_ARRAY(size_t) ends;
    SL_ARRAY(uint32_t) entries, costs, demands;
} sli_made_problem;

void sli_made_destroy(sl_context *context, sli_made_problem *made);
sl_cover_problem sli_made(const sli_made_problem *made);

/// The copies of a part's columns, by the blocks that a split says. *sense is false where it makes
/// none, as where copies cost more than their column.
sl_status sli_make_copies(sl_context *context, const sl_cover_problem *part,
                          const sl_cover_split *split, sli_made_problem *out, bool *sense);
/// The part's rows and behind them cuts, a row as often in a column as its coefficient says. *sense
/// is false where a cut is of no earlier rows, or its numbers are too large.
sl_status sli_make_raised(sl_context *context, const sl_cover_problem *part,
                          const sl_cover_cuts *cuts, sli_made_problem *out, bool *sense);

#endif
