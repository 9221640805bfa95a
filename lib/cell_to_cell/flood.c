/// The upper bound alone, as Quake's vis makes it before it looks closer: from each exit on through
/// all portals that lie ahead of it, at least in part, and have some of it behind them. Signs are
/// exact, so that nothing is missed.
#include "cell_to_cell/flood.h"

#include "base/threads.h"
#include "cell_to_cell/findings.h"
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "geometry/orient.h"

#include <string.h>

/// Whether some of a portal lies ahead of (`sign` -1) or behind (1) an exit; for closed sight its
/// line is enough.
static bool reaches(const sl_exit *exit, sl_point left, sl_point right, int sign, bool closed) {
    const int least = closed ? 0 : 1;
    return sign * sl_orient(exit->right, exit->left, left) >= least ||
           sign * sl_orient(exit->right, exit->left, right) >= least;
}

uint32_t sl_flood_through(const sl_space *space, const sl_see_options *options, const sl_exit *exit,
                          sl_bits *set, uint32_t *found) {
    const bool closed = options->sight == SL_CLOSED;
    uint32_t count = 0;
    if (options->inside_only && !space->cells[exit->cell].inside) return 0;
    sl_bits_add(set, exit->cell);
    found[count++] = exit->cell;
    for (uint32_t done = 0; done < count; done++) {
        const sl_cell *cell = &space->cells[found[done]];
        for (uint32_t i = 0; i < cell->exit_count; i++) {
            const sl_exit *next = &space->exits[cell->first_exit + i];
            if (sl_bits_has(set, next->cell)) continue;
            if (options->inside_only && !space->cells[next->cell].inside) continue;
            if (!reaches(exit, next->left, next->right, -1, closed)) continue;
            if (!reaches(next, exit->left, exit->right, 1, closed)) continue;
            sl_bits_add(set, next->cell);
            found[count++] = next->cell;
        }
    }
    return count;
}

// --- the method

typedef struct flood {
    const sl_space *space;
    const sl_see_options *options;
    bool hurries;     ///< gives up where that is enough
    sl_bit_rows rows; ///< each is written by one thread
} flood;

/// One thread's own.
typedef struct flooder {
    uint32_t *found; ///< through one exit
    sl_bits *set;    ///< of them
    sl_word_set row; ///< of them through all exits
} flooder;

static void end(sl_context *context, void *job, void *state) {
    (void)job;
    flooder *me = state;
    sl_free(context, me->found);
    sl_free(context, me->set);
    sl_word_set_destroy(context, &me->row);
    sl_free(context, me);
}

static sl_status begin(sl_context *context, void *job, void **state) {
    const flood *all = job;
    flooder *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    me->found = sl_alloc_array(context, all->space->cell_count, sizeof *me->found);
    me->set = sl_alloc_array(context, all->rows.words, sizeof *me->set);
    if (me->found && me->set &&
        sl_word_set_create(context, all->space->cell_count, &me->row) == SL_OK) {
        *state = me;
        return SL_OK;
    }
    end(context, job, me);
    return SL_NO_MEMORY;
}

static sl_status flood_unit(sl_context *context, void *job, void *state, size_t unit) {
    flood *all = job;
    flooder *me = state;
    const sl_cell *cell = &all->space->cells[unit];
    if (all->options->inside_only && !cell->inside) return SL_OK;
    if (all->hurries && sl_is_enough(all->options)) return SL_CANCELLED;
    sl_word_set_add(&me->row, (uint32_t)unit);
    for (uint32_t i = 0; i < cell->exit_count; i++) {
        const uint32_t count = sl_flood_through(
            all->space, all->options, &all->space->exits[cell->first_exit + i], me->set, me->found);
        for (uint32_t k = 0; k < count; k++) {
            sl_word_set_add(&me->row, me->found[k]);
            me->set[me->found[k] / 64] = 0;
        }
    }
    SL_TRY(sl_bit_rows_add(context, &all->rows, (uint32_t)unit, &me->row));
    sl_word_set_clear(&me->row);
    return sl_check_cancelled(context);
}

static sl_status flood_all(sl_context *context, flood *all, sl_visibility *out) {
    SL_TRY(sl_bit_rows_create(context, all->space->cell_count, all->options, &all->rows));
    const sl_work work = {.job = all,
                          .begin = begin,
                          .unit = flood_unit,
                          .end = end,
                          .stage = "cell_to_cell",
                          .units = "cells"};
    SL_TRY(sl_work_run(context, &work, all->space->cell_count, all->options->threads));
    SL_TRY(sl_bit_rows_mirror(context, &all->rows, SL_KEEP_MUTUAL));
    return sl_bit_rows_encode(context, &all->rows, out);
}

sl_status sl_see_flood(sl_context *context, const sl_space *space, const sl_see_options *options,
                       sl_visibility *out) {
    if (options->trees)
        return sl_fail(context, SL_UNSUPPORTED, "the method 'flood' makes no stab trees");
    flood all = {.space = space, .options = options};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_CONSERVATIVE};
    const sl_status status = flood_all(context, &all, &visibility);
    sl_bit_rows_destroy(context, &all.rows);
    if (status == SL_OK) *out = visibility;
    return status;
}

// --- the bound for sets that are not decided

static bool takes_part(const sl_space *space, const sl_see_options *options, uint32_t cell) {
    return !options->inside_only || space->cells[cell].inside;
}

static uint32_t count_taking_part(const sl_space *space, const sl_see_options *options) {
    return options->inside_only ? space->inside_count : space->cell_count;
}

/// The row of all cells, once for each.
static sl_status repeat_row(sl_context *context, const sl_space *space,
                            const sl_see_options *options, const sl_row_bytes *row, sl_pvs *out) {
    const uint32_t count = space->cell_count;
    out->cell_count = count;
    out->offsets = sl_alloc_array(context, (size_t)count + 1, sizeof *out->offsets);
    out->bytes = sl_alloc(context, row->count * count_taking_part(space, options) + 1);
    if (!out->offsets || !out->bytes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        const size_t length = takes_part(space, options, i) ? row->count : 0;
        if (length) memcpy(out->bytes + out->offsets[i], row->items, length);
        out->offsets[i + 1] = out->offsets[i] + length;
    }
    return SL_OK;
}

static sl_status pair_all(sl_context *context, const sl_space *space, const sl_see_options *options,
                          sl_pvs *out) {
    sl_pvs all = {0};
    sl_row_bytes row = {0};
    sl_bits *set = sl_alloc_array(context, sl_bits_words(space->cell_count), sizeof *set);
    if (!set) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->cell_count; i++)
        if (takes_part(space, options, i)) sl_bits_add(set, i);
    sl_status status = sl_row_append(context, &row, set, space->cell_count);
    if (status == SL_OK) status = repeat_row(context, space, options, &row, &all);
    sl_free(context, row.items);
    sl_free(context, set);
    if (status == SL_OK)
        *out = all;
    else
        sl_pvs_destroy(context, &all);
    return status;
}

sl_status sl_flood_bound(sl_context *context, const sl_space *space, const sl_see_options *options,
                         sl_pvs *out, bool *bounded) {
    flood all = {.space = space, .options = options, .hurries = true};
    sl_visibility visibility = {0};
    sl_status status = flood_all(context, &all, &visibility);
    sl_bit_rows_destroy(context, &all.rows);
    *bounded = status == SL_OK;
    if (status == SL_CANCELLED && sl_is_enough(options)) {
        SL_TRY(sl_check_cancelled(context));
        return pair_all(context, space, options, out);
    }
    if (status == SL_OK) *out = visibility.pvs;
    return status;
}
