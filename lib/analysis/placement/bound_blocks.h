/// Better bounds for large parts of a set cover.
#ifndef SLI_BOUND_BLOCKS_H
#define SLI_BOUND_BLOCKS_H

#include "sightline/set_cover.h"

/// Betters the bound of `result`, and its proof, where a part that is a leaf alone has more than
/// `many` rows. For problems of costs and demands of 1. Cancelled, it keeps what it has proven so
/// far.
sl_status sli_bound_by_blocks(sl_context *context, const sl_cover_problem *problem,
                              const sl_cover_program *program, uint32_t many,
                              sl_cover_result *result);

#endif
