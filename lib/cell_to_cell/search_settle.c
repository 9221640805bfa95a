/// What a search from some source cells has found becomes a result.
///
/// Which pairs the missing sources leave open. An exact search finds a pair from either of its
/// cells, "prune" from the lower one; a rounded one may find it from one and not from the other,
/// so that it takes both.
#include "cell_to_cell/flood.h"
#include "cell_to_cell/methods.h"
#include "cell_to_cell/partial.h"
#include "cell_to_cell/pvs_maker.h"

/// From which of its cells a pair is decided.
typedef enum deciding { FROM_EITHER, FROM_LOWER, FROM_BOTH } deciding;

typedef struct missing {
    const sl_partial *partial;
    deciding deciding;
} missing;

static bool is_open(const missing *m, uint32_t a, uint32_t b) {
    const bool has_a = sl_bits_has(m->partial->done, a), has_b = sl_bits_has(m->partial->done, b);
    switch (m->deciding) {
    case FROM_EITHER:
        return !has_a && !has_b;
    case FROM_LOWER:
        return a < b ? !has_a : !has_b;
    case FROM_BOTH:
        break;
    }
    return !has_a || !has_b;
}

static sl_status make_rows(sl_context *context, const missing *m, const sl_pvs *seen,
                           const sl_pvs *bound, sl_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(sl_pvs_maker_create(context, seen->cell_count, seen->cell_count, maker));
    for (uint32_t cell = 0; cell < seen->cell_count; cell++) {
        sl_pvs_maker_add(maker, seen, cell);
        for (sl_pvs_run run = sl_pvs_begin(bound, cell); sl_pvs_next(&run);)
            for (uint32_t i = run.first; i < run.end; i++)
                if (is_open(m, cell, i)) sl_word_set_add(&maker->row, i);
        SL_TRY(sl_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    return sl_pvs_maker_finish(context, maker, out);
}

/// Adds the open pairs that the bound leaves possible.
static sl_status add_open(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const missing *m, sl_visibility *out) {
    sl_pvs bound = {0}, rows = {0};
    sl_pvs_maker maker = {0};
    bool bounded;
    sl_status status = sl_flood_bound(context, space, options, &bound, &bounded);
    if (status == SL_OK) status = make_rows(context, m, &out->pvs, &bound, &maker, &rows);
    if (status == SL_OK) {
        sl_pvs_destroy(context, &out->pvs);
        out->pvs = rows;
        out->account.pairs = maker.pairs;
    }
    sl_pvs_maker_destroy(context, &maker);
    sl_pvs_destroy(context, &bound);
    return status;
}

static sl_status settle(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_partial *partial, bool prunes, sl_visibility *out) {
    if (!options->solver) return sl_fail(context, SL_BAD_ARGUMENT, "the searches need a solver");
    const sl_guarantee guarantee = options->solver->guarantee;
    if (partial->unit_count != space->cell_count || partial->sure.cell_count != space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT, "findings of another space or other options");
    sl_visibility visibility = {.sight = options->sight, .guarantee = guarantee};
    const missing m = {.partial = partial,
                       .deciding = guarantee != SL_EXACT ? FROM_BOTH
                                   : prunes              ? FROM_LOWER
                                                         : FROM_EITHER};
    sl_status status =
        sl_visibility_finish(context, &partial->sure, &partial->doubtful, true, &visibility);
    if (status == SL_OK && !sl_partial_complete(partial)) {
        if (guarantee == SL_EXACT) visibility.guarantee = SL_CONSERVATIVE;
        status = add_open(context, space, options, &m, &visibility);
    }
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}

sl_status sl_finish_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_partial *partial, sl_visibility *out) {
    return settle(context, space, options, partial, false, out);
}

sl_status sl_finish_prune(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const sl_partial *partial, sl_visibility *out) {
    return settle(context, space, options, partial, true, out);
}

sl_status sl_reuse_search(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const uint64_t *kept, const uint64_t *enclosed, sl_partial *partial) {
    (void)enclosed;
    SL_TRY(sl_partial_begin(context, space, options, space->cell_count, partial));
    sl_partial_note(partial, kept);
    return SL_OK;
}
