/// Partial results: what some units of a bake have found, joined with what others found.
///
/// A unit is a source cell of a search, or a corner of the sweep. Units are independent, and their
/// results join by OR, so that the order and the machine do not matter.
///
/// A partial result can be finished before all units are done. Pairs that a missing unit could add
/// then count as seen if an upper bound (flood.c) leaves them possible. So the result is
/// conservative. An exact search finds a pair from either of its cells, "prune" from the lower one.
/// A rounded search may find it from one and not from the other, so that it needs both. With
/// effects each source has rows of its own: what it sees, by mirror too, and through which doors.
#include "base/bits.h"
#include "base/size.h"
#include "cell_to_cell/methods.h"

#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/search/bounds.h"
#include "cell_to_cell/search/dfs.h"

#include <string.h>

void sl_partial_destroy(sl_context *context, sl_partial *partial) {
    sl_free(context, partial->done);
    sl_pvs_destroy(context, &partial->sure);
    sl_pvs_destroy(context, &partial->doubtful);
    sl_pvs_destroy(context, &partial->mirrored);
    sli_door_sets_destroy(context, &partial->doors);
    sli_door_sets_destroy(context, &partial->mirrored_doors);
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

static sl_status make_empty_doors(sl_context *context, uint32_t count, sl_door_sets *sets) {
    sl_pvs rows = {0};
    const sl_status status = make_empty_rows(context, count, &rows);
    *sets = (sl_door_sets){rows.cell_count, rows.offsets, rows.bytes};
    return status;
}

static sl_status make_empty_effects(sl_context *context, uint32_t count, sl_partial *partial) {
    const bool doors = partial->effects & SL_EFFECT_DOOR;
    const bool mirrors = partial->effects & SL_EFFECT_MIRROR;
    if (doors) SL_TRY(make_empty_doors(context, count, &partial->doors));
    if (mirrors) SL_TRY(make_empty_rows(context, count, &partial->mirrored));
    return doors && mirrors ? make_empty_doors(context, count, &partial->mirrored_doors) : SL_OK;
}

static bool same_options(const sl_partial *a, const sl_partial *b) {
    return a->inside_only == b->inside_only && a->effects == b->effects &&
           a->mirror_depth == b->mirror_depth && a->door_limit == b->door_limit;
}

static sl_status make_empty(sl_context *context, uint32_t cell_count, sl_partial *partial) {
    SL_TRY(make_empty_rows(context, cell_count, &partial->sure));
    SL_TRY(make_empty_rows(context, cell_count, &partial->doubtful));
    SL_TRY(make_empty_effects(context, cell_count, partial));
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
    sl_partial empty = {.unit_count = unit_count, .inside_only = options->inside_only};
    if (options->plan && options->plan->effects) {
        empty.effects = options->plan->effects;
        empty.mirror_depth = options->plan->mirror_depth;
        empty.door_limit = options->plan->door_limit;
    }
    if (sl_partial_begun(partial)) {
        if (partial->sure.cell_count != space->cell_count || partial->unit_count != unit_count ||
            !same_options(partial, &empty))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "partial results of another space or other options");
    } else {
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
    partial->done_count =
        (uint32_t)sli_bits_count(partial->done, sl_bits_words(partial->unit_count));
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

/// A row that one of the two has is the row of both.
static sl_status join_doors(sl_context *context, const sl_door_sets *a, const sl_door_sets *b,
                            sl_door_sets *out) {
    const uint32_t count = a->cell_count;
    if (!count) return SL_OK;
    out->offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *out->offsets);
    out->bytes = sl_alloc(context, sli_size(sl_door_sets_bytes(a) + sl_door_sets_bytes(b) + 1));
    if (!out->offsets || !out->bytes) return SL_NO_MEMORY;
    out->cell_count = count;
    for (uint32_t i = 0; i < count; i++) {
        const sl_door_sets *from = a->offsets[i] < a->offsets[i + 1] ? a : b;
        const size_t bytes = sli_size(from->offsets[i + 1] - from->offsets[i]);
        if (bytes) memcpy(out->bytes + out->offsets[i], from->bytes + from->offsets[i], bytes);
        out->offsets[i + 1] = out->offsets[i] + bytes;
    }
    return SL_OK;
}

/// Joins the rows of both into `out`, which has none.
static sl_status join_all(sl_context *context, const sl_partial *a, const sl_partial *b,
                          sl_partial *out) {
    SL_TRY(join_rows(context, &a->sure, &b->sure, &out->sure));
    SL_TRY(join_rows(context, &a->doubtful, &b->doubtful, &out->doubtful));
    if (a->mirrored.cell_count)
        SL_TRY(join_rows(context, &a->mirrored, &b->mirrored, &out->mirrored));
    SL_TRY(join_doors(context, &a->doors, &b->doors, &out->doors));
    return join_doors(context, &a->mirrored_doors, &b->mirrored_doors, &out->mirrored_doors);
}

sl_status sl_partial_merge(sl_context *context, sl_partial *partial, const sl_partial *other) {
    if (partial->sure.cell_count != other->sure.cell_count ||
        partial->unit_count != other->unit_count || !same_options(partial, other))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "partial results of another space or other options");
    sl_partial joined = {0};
    const sl_status status = join_all(context, partial, other, &joined);
    if (status != SL_OK) {
        sl_partial_destroy(context, &joined);
        return status;
    }
    note_done(partial, other->done);
    const sl_partial before = *partial;
    *partial = joined;
    partial->unit_count = before.unit_count;
    partial->done_count = before.done_count;
    partial->done = before.done;
    partial->inside_only = before.inside_only;
    partial->shard = before.shard;
    partial->shard_count = before.shard_count;
    partial->effects = before.effects;
    partial->mirror_depth = before.mirror_depth;
    partial->door_limit = before.door_limit;
    partial->rounded = before.rounded || other->rounded;
    sl_partial rows = before;
    rows.done = NULL;
    sl_partial_destroy(context, &rows);
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
typedef enum deciding { FROM_EITHER, FROM_LOWER, FROM_FIRST, FROM_BOTH } deciding;

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
    case FROM_FIRST:
        return !has_a;
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
static sl_status add_open(sl_context *context, const missing *m, const sl_pvs *bound,
                          sl_visibility *out) {
    sl_pvs rows = {0};
    sli_pvs_maker maker = {0};
    const sl_status status = make_open_rows(context, m, &out->pvs, bound, &maker, &rows);
    if (status == SL_OK) {
        sl_pvs_destroy(context, &out->pvs);
        out->pvs = rows;
        out->account.pairs = maker.pairs;
    }
    sli_pvs_maker_destroy(context, &maker);
    return status;
}

/// Adds to what is seen by mirror what the bound leaves possible for cells that are not done.
static sl_status add_open_mirrored(sl_context *context, const sl_space *space,
                                   const sl_see_options *options, const missing *m,
                                   const sl_pvs *bound, sl_visibility *out) {
    sl_pvs mirrored = {0}, rows = {0};
    sli_pvs_maker maker = {0};
    missing by_mirror = *m;
    by_mirror.deciding = FROM_FIRST;
    if (!out->mirrored.cell_count) return SL_OK;
    sl_status status = sli_mirrored_bound(context, space, options, bound, &mirrored);
    if (status == SL_OK)
        status = make_open_rows(context, &by_mirror, &out->mirrored, &mirrored, &maker, &rows);
    if (status == SL_OK) {
        sl_pvs_destroy(context, &out->mirrored);
        out->mirrored = rows;
    }
    sli_pvs_maker_destroy(context, &maker);
    sl_pvs_destroy(context, &mirrored);
    return status;
}

static sl_status finish_open(sl_context *context, const sl_space *space,
                             const sl_see_options *options, const missing *m, sl_visibility *out) {
    sl_pvs bound = {0};
    bool bounded;
    if (out->guarantee == SL_EXACT) out->guarantee = SL_CONSERVATIVE;
    SL_TRY(sli_flood_bound(context, space, options, &bound, &bounded));
    sl_status status = add_open(context, m, &bound, out);
    if (status == SL_OK) status = add_open_mirrored(context, space, options, m, &bound, out);
    sl_pvs_destroy(context, &bound);
    return status;
}

static deciding deciding_of(const sl_see_options *options, bool prunes) {
    const sl_plan *plan = options->plan;
    if (options->solver->guarantee != SL_EXACT) return FROM_BOTH;
    if (plan && plan->effects) return plan->mutual ? FROM_EITHER : FROM_FIRST;
    return prunes ? FROM_LOWER : FROM_EITHER;
}

static sl_status finish(sl_context *context, const sl_space *space, const sl_see_options *options,
                        const sl_partial *partial, bool prunes, sl_visibility *out) {
    if (!options->solver) return sl_fail(context, SL_BAD_ARGUMENT, "the searches need a solver");
    const sl_plan *plan = options->plan;
    if (partial->unit_count != space->cell_count || partial->sure.cell_count != space->cell_count ||
        partial->effects != (plan ? plan->effects : 0))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "partial results of another space or other options");
    sl_visibility visibility = {.sight = options->sight, .guarantee = options->solver->guarantee};
    const missing m = {.partial = partial, .deciding = deciding_of(options, prunes)};
    sl_status status = sli_visibility_finish(context, &partial->sure, &partial->doubtful,
                                             !plan || plan->mutual, &visibility);
    if (status == SL_OK && partial->effects)
        status = sli_dfs_effects_settle(context, plan, partial, &visibility);
    if (status == SL_OK && !sl_partial_complete(partial))
        status = finish_open(context, space, options, &m, &visibility);
    visibility.account.mirrored_pairs = sli_pvs_pairs(&visibility.mirrored);
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
