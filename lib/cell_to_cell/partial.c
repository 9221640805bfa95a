/// Partial results: what some units of a bake have found, joined with what others found.
///
/// A unit is a source cell of a search, or a corner of the sweep. Units are independent, and their
/// results join by OR, so that the order and the machine do not matter.
///
/// A partial result can be finished before all units are done. Pairs that a missing unit could add
/// then count as seen if an upper bound (flood.c) leaves them possible. So the result is
/// conservative. An exact search finds a pair from either of its cells, "prune" from the lower one.
/// A rounded search may find it from one and not from the other, so that it needs both.
#include "cell_to_cell/methods.h"

#include "cell_to_cell/bounds.h"
#include "cell_to_cell/pvs_rows.h"

void sl_partial_destroy(sl_context *context, sl_partial *partial) {
    sl_free(context, partial->done);
    sl_pvs_destroy(context, &partial->sure);
    sl_pvs_destroy(context, &partial->doubtful);
    *partial = (sl_partial){0};
}

bool sl_partial_begun(const sl_partial *partial) {
    return partial->sure.cell_count != 0;
}

bool sl_partial_complete(const sl_partial *partial) {
    return sl_partial_begun(partial) && partial->done_count == partial->unit_count;
}

uint32_t sl_partial_left(const sl_partial *f) {
    uint32_t left = 0;
    for (uint32_t i = 0; i < f->unit_count; i++)
        left += sli_unit_is_of(f->shard, f->shard_count, i) && !sl_bits_has(f->done, i);
    return left;
}

static sl_status make_empty_rows(sl_context *context, uint32_t count, sl_pvs *pvs) {
    pvs->offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *pvs->offsets);
    pvs->bytes = sl_alloc_array(context, 1, 1);
    pvs->cell_count = count;
    return pvs->offsets && pvs->bytes ? SL_OK : SL_NO_MEMORY;
}

static sl_status make_empty(sl_context *context, uint32_t cell_count, sl_partial *partial) {
    SL_TRY(make_empty_rows(context, cell_count, &partial->sure));
    SL_TRY(make_empty_rows(context, cell_count, &partial->doubtful));
    partial->done =
        sl_alloc_array(context, sl_bits_words(partial->unit_count), sizeof *partial->done);
    return partial->done ? SL_OK : SL_NO_MEMORY;
}

sl_status sli_partial_begin(sl_context *context, const sl_space *space,
                            const sl_see_options *options, uint32_t unit_count,
                            sl_partial *partial) {
    if (options->shard_count ? !options->shard || options->shard > options->shard_count
                             : options->shard)
        return sl_fail(context, SL_BAD_ARGUMENT, "there is no shard %u of %u", options->shard,
                       options->shard_count);
    if (options->plan && options->plan->effects)
        return sl_fail(
            context, SL_UNSUPPORTED,
            "a map with effects cannot be baked in parts: ignore the effects (--without), or "
            "bake it as a whole");
    if (sl_partial_begun(partial)) {
        if (partial->sure.cell_count != space->cell_count || partial->unit_count != unit_count ||
            partial->inside_only != options->inside_only)
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "partial results of another space or other options");
    } else {
        sl_partial empty = {.unit_count = unit_count, .inside_only = options->inside_only};
        const sl_status status = make_empty(context, space->cell_count, &empty);
        if (status != SL_OK) {
            sl_partial_destroy(context, &empty);
            return status;
        }
        *partial = empty;
    }
    partial->shard = options->shard;
    partial->shard_count = options->shard_count;
    return SL_OK;
}

static void count_done(sl_partial *partial) {
    partial->done_count = 0;
    for (size_t i = 0; i < sl_bits_words(partial->unit_count); i++)
        partial->done_count += (uint32_t)__builtin_popcountll(partial->done[i]);
}

/// Notes units as done.
static void note_done(sl_partial *partial, const sl_bits *done) {
    for (size_t i = 0; i < sl_bits_words(partial->unit_count); i++) partial->done[i] |= done[i];
    count_done(partial);
}

void sli_partial_note_bytes(sl_partial *partial, const uint8_t *done) {
    for (uint32_t i = 0; i < partial->unit_count; i++)
        if (done[i]) sl_bits_add(partial->done, i);
    count_done(partial);
}

// --- joining

static sl_status make_union(sl_context *context, const sl_pvs *a, const sl_pvs *b,
                            sli_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(sli_pvs_maker_create(context, a->cell_count, a->cell_count, maker));
    for (uint32_t cell = 0; cell < a->cell_count; cell++) {
        sli_pvs_maker_add(maker, a, cell);
        sli_pvs_maker_add(maker, b, cell);
        SL_TRY(sli_pvs_maker_end_row(context, maker));
    }
    return sli_pvs_maker_finish(context, maker, out);
}

static sl_status join_rows(sl_context *context, const sl_pvs *a, const sl_pvs *b, sl_pvs *out) {
    sli_pvs_maker maker;
    const sl_status status = make_union(context, a, b, &maker, out);
    sli_pvs_maker_destroy(context, &maker);
    return status;
}

sl_status sl_partial_merge(sl_context *context, sl_partial *partial, const sl_partial *other) {
    if (partial->sure.cell_count != other->sure.cell_count ||
        partial->unit_count != other->unit_count || partial->inside_only != other->inside_only)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "partial results of another space or other options");
    sl_pvs sure = {0}, doubtful = {0};
    sl_status status = join_rows(context, &partial->sure, &other->sure, &sure);
    if (status == SL_OK)
        status = join_rows(context, &partial->doubtful, &other->doubtful, &doubtful);
    if (status != SL_OK) {
        sl_pvs_destroy(context, &sure);
        return status;
    }
    sl_pvs_destroy(context, &partial->sure);
    sl_pvs_destroy(context, &partial->doubtful);
    partial->sure = sure;
    partial->doubtful = doubtful;
    note_done(partial, other->done);
    return SL_OK;
}

sl_status sli_bit_rows_add_pvs(sl_context *context, sli_bit_rows *rows, const sl_pvs *pvs) {
    sli_word_set set;
    SL_TRY(sli_word_set_create(context, rows->count, &set));
    sl_status status = SL_OK;
    for (uint32_t cell = 0; cell < pvs->cell_count && status == SL_OK; cell++) {
        if (pvs->offsets[cell] == pvs->offsets[cell + 1]) continue;
        sli_word_set_add_row(&set, pvs, cell);
        status = sli_bit_rows_add(context, rows, cell, &set);
        sli_word_set_clear(&set);
    }
    sli_word_set_destroy(context, &set);
    return status;
}

// --- what a search found becomes a result

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

static sl_status make_open_rows(sl_context *context, const missing *m, const sl_pvs *seen,
                                const sl_pvs *bound, sli_pvs_maker *maker, sl_pvs *out) {
    SL_TRY(sli_pvs_maker_create(context, seen->cell_count, seen->cell_count, maker));
    for (uint32_t cell = 0; cell < seen->cell_count; cell++) {
        sli_pvs_maker_add(maker, seen, cell);
        for (sl_pvs_run run = sl_pvs_begin(bound, cell); sl_pvs_next(&run);)
            for (uint32_t i = run.first; i < run.end; i++)
                if (is_open(m, cell, i)) sli_word_set_add(&maker->row, i);
        SL_TRY(sli_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    return sli_pvs_maker_finish(context, maker, out);
}

/// Adds the open pairs that the bound leaves possible.
static sl_status add_open(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const missing *m, sl_visibility *out) {
    sl_pvs bound = {0}, rows = {0};
    sli_pvs_maker maker = {0};
    bool bounded;
    sl_status status = sli_flood_bound(context, space, options, &bound, &bounded);
    if (status == SL_OK) status = make_open_rows(context, m, &out->pvs, &bound, &maker, &rows);
    if (status == SL_OK) {
        sl_pvs_destroy(context, &out->pvs);
        out->pvs = rows;
        out->account.pairs = maker.pairs;
    }
    sli_pvs_maker_destroy(context, &maker);
    sl_pvs_destroy(context, &bound);
    return status;
}

static sl_status finish(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_partial *partial, bool prunes, sl_visibility *out) {
    if (!options->solver) return sl_fail(context, SL_BAD_ARGUMENT, "the searches need a solver");
    const sl_guarantee guarantee = options->solver->guarantee;
    if (partial->unit_count != space->cell_count || partial->sure.cell_count != space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "partial results of another space or other options");
    sl_visibility visibility = {.sight = options->sight, .guarantee = guarantee};
    const missing m = {.partial = partial,
                       .deciding = guarantee != SL_EXACT ? FROM_BOTH
                                   : prunes              ? FROM_LOWER
                                                         : FROM_EITHER};
    sl_status status =
        sli_visibility_finish(context, &partial->sure, &partial->doubtful, true, &visibility);
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

sl_status sli_finish_dfs(sl_context *context, const sl_space *space, const sl_see_options *options,
                         const sl_partial *partial, sl_visibility *out) {
    return finish(context, space, options, partial, false, out);
}

sl_status sli_finish_prune(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const sl_partial *partial,
                           sl_visibility *out) {
    return finish(context, space, options, partial, true, out);
}

sl_status sli_reuse_search(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const uint64_t *kept,
                           const uint64_t *enclosed, sl_partial *partial) {
    (void)enclosed;
    SL_TRY(sli_partial_begin(context, space, options, space->cell_count, partial));
    note_done(partial, kept);
    return SL_OK;
}
