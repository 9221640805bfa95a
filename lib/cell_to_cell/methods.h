/// The methods that the table lists, and what they share.
#ifndef SL_METHODS_H
#define SL_METHODS_H

#include "cell_to_cell/rows.h"
#include "sightline/cell_to_cell.h"
#include "sightline/support.h"

sl_status sli_see_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                      sl_visibility *out);
sl_status sli_see_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_visibility *out);
sl_status sli_see_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_visibility *out);
sl_status sli_see_flood(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_visibility *out);
sl_status sli_see_sampling(sl_context *context, const sl_space *space,
                           const sl_see_options *options, sl_visibility *out);
sl_status sli_see_multipass(sl_context *context, const sl_space *space,
                            const sl_see_options *options, sl_visibility *out);

// In parts.
sl_status sli_run_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                      sl_partial *partial);
sl_status sli_finish_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                         const sl_partial *partial, sl_visibility *out);
sl_status sli_run_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_partial *partial);
sl_status sli_finish_prune(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const sl_partial *partial,
                           sl_visibility *out);
sl_status sli_run_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_partial *partial);
sl_status sli_finish_sweep(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const sl_partial *partial,
                           sl_visibility *out);
sl_status sli_reuse_search(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const uint64_t *kept,
                           const uint64_t *enclosed, sl_partial *partial);
sl_status sli_reuse_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const uint64_t *kept, const uint64_t *enclosed, sl_partial *partial);

/// Whether a method looks from a cell. Solid ground has no row. Other cells do not see it either:
/// there is always a wall between, so only the sources need to be asked.
static inline bool sli_looks_from(const sl_space *space, bool inside_only, uint32_t cell) {
    return inside_only ? space->cells[cell].inside : !space->cells[cell].solid;
}

/// SL_UNSUPPORTED where a solver cannot serve a plan.
sl_status sli_plan_check_solver(sl_context *context, const sl_plan *plan, const sl_solver *solver);

// --- work in parts

/// Makes an empty partial result of a method with so many units. One that is begun already must be
/// of the same space and options: else SL_BAD_ARGUMENT.
sl_status sli_partial_begin(sl_context *context, const sl_space *space,
                            const sl_see_options *options, uint32_t unit_count,
                            sl_partial *partial);

/// Whether a unit is of a shard; 0, 0 for all. Shards take runs of a few units in turn.
static inline bool sli_unit_is_of(uint32_t shard, uint32_t shard_count, uint32_t unit) {
    return !shard_count || unit / 8 % shard_count == shard - 1;
}

/// Whether a unit is of the shard and not done yet.
static inline bool sli_unit_is_wanted(const sl_see_options *options, const sl_partial *partial,
                                      uint32_t unit) {
    return !sl_bits_has(partial->done, unit) &&
           sli_unit_is_of(options->shard, options->shard_count, unit);
}

static inline bool sli_is_enough(const sl_see_options *options) {
    return options->enough && options->enough(options->enough_user);
}

/// Notes units as done, those whose byte is not 0: threads can write bytes side by side.
void sli_partial_note_bytes(sl_partial *partial, const uint8_t *done);

/// Adds all pairs of a PVS.
sl_status sli_bit_rows_add_pvs(sl_context *context, sli_bit_rows *rows, const sl_pvs *pvs);

#endif
