/// The methods that the table lists.
#ifndef SL_METHODS_H
#define SL_METHODS_H

#include "sightline/cell_to_cell.h"

sl_status sl_see_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                     sl_visibility *out);
sl_status sl_see_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                       sl_visibility *out);
sl_status sl_see_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                       sl_visibility *out);
sl_status sl_see_flood(sl_context *context, const sl_space *space, const sl_see_options *options,
                       sl_visibility *out);
sl_status sl_see_sampling(sl_context *context, const sl_space *space, const sl_see_options *options,
                          sl_visibility *out);
sl_status sl_see_multipass(sl_context *context, const sl_space *space,
                           const sl_see_options *options, sl_visibility *out);

// In parts.
sl_status sl_run_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                     sl_partial *partial);
sl_status sl_finish_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_partial *partial, sl_visibility *out);
sl_status sl_run_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                       sl_partial *partial);
sl_status sl_finish_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const sl_partial *partial, sl_visibility *out);
sl_status sl_run_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                       sl_partial *partial);
sl_status sl_finish_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const sl_partial *partial, sl_visibility *out);
sl_status sl_reuse_search(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const uint64_t *kept, const uint64_t *enclosed, sl_partial *partial);
sl_status sl_reuse_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                         const uint64_t *kept, const uint64_t *enclosed, sl_partial *partial);

/// SL_UNSUPPORTED where a solver cannot serve a plan.
sl_status sl_plan_check_solver(sl_context *context, const sl_plan *plan, const sl_solver *solver);

#endif
