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
sl_status sl_look_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                      sl_findings *findings);
sl_status sl_settle_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_findings *findings, sl_visibility *out);
sl_status sl_look_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_findings *findings);
sl_status sl_settle_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const sl_findings *findings, sl_visibility *out);
sl_status sl_look_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_findings *findings);
sl_status sl_settle_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const sl_findings *findings, sl_visibility *out);
sl_status sl_carry_search(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const uint64_t *kept, const uint64_t *enclosed, sl_findings *findings);
sl_status sl_carry_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                         const uint64_t *kept, const uint64_t *enclosed, sl_findings *findings);

/// SL_UNSUPPORTED where a solver cannot serve a plan.
sl_status sl_plan_check_solver(sl_context *context, const sl_plan *plan, const sl_solver *solver);

#endif
