/// Makes the result of a sweep, also where some fans have not been visited.
///
/// What could a missing fan add? It joins cells by lines through its point. Each half of such a
/// line leaves the point through a cell of the fan. So both cells of the pair are seen from cells
/// of the fan, and lie within the upper bound of these (flood.c). A pair is decided if no missing
/// fan has both of its cells within its bound: if it was not found, it is hidden. All other pairs
/// within the bound count as seen, so that the result is conservative.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/search/bounds.h"
#include "cell_to_cell/sweep/sweep.h"
#include "effects/filtered.h"

sl_status sli_sweep_finish(sl_context *context, const sl_space *space,
                           const sl_see_options *options, sli_bit_rows *rows, sl_visibility *out) {
    const bool one_way = options->plan && options->plan->effects & SL_EFFECT_ONEWAY;
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c];
        if (!sli_looks_from(space, options->inside_only, c)) continue;
        SL_TRY(sli_bit_rows_add_one(context, rows, c, c));
        for (uint32_t i = 0; i < cell->directed_count; i++) {
            const uint32_t next = space->directed[cell->first_directed + i].cell;
            if (options->inside_only && !space->cells[next].inside) continue;
            if (one_way && sli_portal_is_blocked(space, c, cell->first_directed + i)) continue;
            SL_TRY(sli_bit_rows_add_one(context, rows, c, next));
        }
    }
    if (!one_way) SL_TRY(sli_bit_rows_mirror(context, rows, SLI_ADD_MIRRORED));
    return sli_bit_rows_encode(context, rows, out);
}

// --- what missing fans could join

/// Fans that lie side by side are taken together.
enum { FANS_OF_A_GROUP = 32 };

/// For each group of fans, the cells that its missing fans may see. For each cell, the groups that
/// may see it.
typedef struct group_bounds {
    sl_pvs groups; ///< a row a group
    sli_columns seen_by;
} group_bounds;

/// Adds to a set what the missing fans of a group may see.
static void bound_group(const sli_fans *fans, const sl_partial *partial, const sl_pvs *bound,
                        uint32_t group, sli_word_set *set) {
    const uint32_t first = group * FANS_OF_A_GROUP;
    for (uint32_t i = first; i < first + FANS_OF_A_GROUP && i < fans->fans.count; i++) {
        if (sl_bits_has(partial->done, i)) continue;
        const sli_fan *fan = &fans->fans.items[i];
        for (uint32_t k = 0; k < fan->count; k++)
            sli_word_set_add_row(set, bound, fans->cells.items[fan->first + k].cell);
    }
}

static sl_status find_groups(sl_context *context, const sli_fans *fans, const sl_partial *partial,
                             const sl_pvs *bound, sli_pvs_maker *maker, group_bounds *out) {
    const uint32_t count = (uint32_t)((fans->fans.count + FANS_OF_A_GROUP - 1) / FANS_OF_A_GROUP);
    SL_TRY(sli_pvs_maker_create(context, fans->cell_count, count, maker));
    for (uint32_t group = 0; group < count; group++) {
        bound_group(fans, partial, bound, group, &maker->row);
        SL_TRY(sli_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    SL_TRY(sli_pvs_maker_finish(context, maker, &out->groups));
    return sli_columns_gather(context, &out->groups, fans->cell_count, &out->seen_by);
}

static sl_status make_rows(sl_context *context, const group_bounds *r, const sl_pvs *seen,
                           const sl_pvs *bound, sli_word_set *open, sli_pvs_maker *maker,
                           sl_pvs *out) {
    const uint32_t count = seen->cell_count;
    SL_TRY(sli_word_set_create(context, count, open));
    SL_TRY(sli_pvs_maker_create(context, count, count, maker));
    for (uint32_t cell = 0; cell < count; cell++) {
        for (uint64_t i = r->seen_by.starts[cell]; i < r->seen_by.starts[cell + 1]; i++)
            sli_word_set_add_row(open, &r->groups, r->seen_by.members[i]);
        sli_pvs_maker_add(maker, seen, cell);
        sli_word_set_add_common(&maker->row, bound, cell, open);
        sli_word_set_clear(open);
        SL_TRY(sli_pvs_maker_end_row(context, maker));
        SL_TRY(sl_check_cancelled(context));
    }
    return sli_pvs_maker_finish(context, maker, out);
}

/// Adds to what is seen the open pairs within the bound.
static sl_status add_open(sl_context *context, const sli_fans *fans, const sl_partial *partial,
                          const sl_pvs *bound, sl_visibility *out) {
    group_bounds all = {0};
    sli_word_set open = {0};
    sli_pvs_maker groups = {0}, maker = {0};
    sl_pvs rows = {0};
    sl_status status = find_groups(context, fans, partial, bound, &groups, &all);
    if (status == SL_OK) status = make_rows(context, &all, &out->pvs, bound, &open, &maker, &rows);
    if (status == SL_OK) {
        sl_pvs_destroy(context, &out->pvs);
        out->pvs = rows;
        out->account.pairs = maker.pairs;
    }
    sli_pvs_maker_destroy(context, &groups);
    sli_pvs_maker_destroy(context, &maker);
    sli_word_set_destroy(context, &open);
    sl_pvs_destroy(context, &all.groups);
    sli_columns_destroy(context, &all.seen_by);
    return status;
}

static sl_status bound_open(sl_context *context, const sl_space *space,
                            const sl_see_options *options, const sl_partial *partial,
                            sl_visibility *out) {
    sli_fans fans = {0};
    sl_pvs bound = {0};
    bool bounded = false;
    sl_status status = sli_fans_find(context, space, options, SLI_FANS_MUTUAL, &fans);
    if (status == SL_OK && fans.fans.count != partial->unit_count)
        status =
            sl_fail(context, SL_BAD_ARGUMENT, "partial results of another space or other options");
    if (status == SL_OK) status = sli_flood_bound(context, space, options, &bound, &bounded);
    if (status == SL_OK && bounded) status = add_open(context, &fans, partial, &bound, out);
    if (status == SL_OK && !bounded) {
        // Any missing fan may see all.
        sl_pvs_destroy(context, &out->pvs);
        out->pvs = bound;
        bound = (sl_pvs){0};
        out->account.pairs = sli_pvs_pairs(&out->pvs);
    }
    sl_pvs_destroy(context, &bound);
    sli_fans_destroy(context, &fans);
    return status;
}

// --- the result

static sl_status finish_rows(sl_context *context, const sl_space *space,
                             const sl_see_options *options, const sl_partial *partial,
                             sli_bit_rows *rows, sl_visibility *out) {
    SL_TRY(sli_bit_rows_create(context, space->cell_count, options, rows));
    SL_TRY(sli_bit_rows_add_pvs(context, rows, &partial->sure));
    SL_TRY(sli_sweep_finish(context, space, options, rows, out));
    if (sl_partial_complete(partial)) return SL_OK;
    out->guarantee = SL_CONSERVATIVE;
    return bound_open(context, space, options, partial, out);
}

sl_status sli_finish_sweep(sl_context *context, const sl_space *space,
                           const sl_see_options *options, const sl_partial *partial,
                           sl_visibility *out) {
    sli_bit_rows rows = {0};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_EXACT};
    if (partial->sure.cell_count != space->cell_count)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "partial results of another space or other options");
    const sl_status status = finish_rows(context, space, options, partial, &rows, &visibility);
    sli_bit_rows_destroy(context, &rows);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}

// --- what is known from another space

static bool is_spared(const sli_fans *fans, const sli_fan *fan, const uint64_t *enclosed) {
    for (uint32_t k = 0; k < fan->count; k++)
        if (!sl_bits_has(enclosed, fans->cells.items[fan->first + k].cell)) return false;
    return true;
}

/// A fan joins only cells that its own cells see. If the rows of all these are known, the fan has
/// nothing to add.
static sl_status spare(sl_context *context, const sli_fans *fans, const uint64_t *enclosed,
                       sl_partial *partial) {
    uint8_t *done = sl_alloc_array(context, fans->fans.count, sizeof *done);
    if (!done) return SL_NO_MEMORY;
    for (size_t i = 0; i < fans->fans.count; i++)
        done[i] = is_spared(fans, &fans->fans.items[i], enclosed);
    sli_partial_note_bytes(partial, done);
    sl_free(context, done);
    return SL_OK;
}

sl_status sli_reuse_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                          const uint64_t *kept, const uint64_t *enclosed, sl_partial *partial) {
    (void)kept;
    sli_fans fans = {0};
    sl_status status = sli_fans_find(context, space, options, SLI_FANS_MUTUAL, &fans);
    if (status == SL_OK)
        status = sli_partial_begin(context, space, options, (uint32_t)fans.fans.count, partial);
    if (status == SL_OK) status = spare(context, &fans, enclosed, partial);
    sli_fans_destroy(context, &fans);
    return status;
}
