/// The sweep, the default method: a line rotates about every corner of walls (SWEEP.md).
///
///      behind            A line through the corner w of a wall. While it rotates, cells come into
///           .            the sight of one half, or leave it. A cell that comes into the sight of
///            .           one half is joined with all cells that the other half sees.
///     wall ###w
///              .
///               before
///
/// Idea: move a sightline between two cells until it touches a corner of a wall, or until it comes
/// to a chosen corner of one of the cells. So two cells see each other exactly if a line through a
/// wall's corner joins them while it rotates, or if the chosen corner of one of them sees the
/// other.
///
/// The method needs no portal sequences and no solver. It decides all signs by exact predicates,
/// and gives the result of the depth-first search with an exact solver, bit for bit.
///
/// Cost: for each corner, finding the intervals of angle at which cells are seen (visible.c), and
/// one row operation for each interval. Corners are independent, and their results join by OR.
#include "cell_to_cell/sweep/sweep.h"

#include "cell_to_cell/methods.h"
#include "sightline/support.h"

#include <pthread.h>

/// Fans that a thread takes at once.
enum { FANS_AT_ONCE = 32 };

static void end_sweep_worker(sl_context *context, void *job, void *state) {
    sli_sweep *all = job;
    sli_sweeper *me = state;
    pthread_mutex_lock(&all->lock);
    sli_bit_rows_join(context, &all->rows, &me->rows);
    sli_bit_rows_join(context, &all->seen_from, &me->seen_from);
    all->pieces += me->finder.pieces;
    if (me->finder.deepest > all->deepest) all->deepest = me->finder.deepest;
    pthread_mutex_unlock(&all->lock);
    sli_sweeper_destroy(context, me);
    sl_free(context, me);
}

static sl_status begin_sweep_worker(sl_context *context, void *job, void **state) {
    sli_sweep *all = job;
    sli_sweeper *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    const sl_status status =
        sli_sweeper_create(context, &all->fans[0], all->options->sight == SL_CLOSED, &all->rows,
                           all->seen_from.count ? &all->seen_from : NULL, me);
    if (status == SL_OK)
        *state = me;
    else
        end_sweep_worker(context, job, me);
    return status;
}

static size_t count_fans(const sli_sweep *all) {
    size_t count = 0;
    for (uint32_t set = 0; set < all->fan_sets; set++) count += all->fans[set].fans.count;
    return count;
}

/// Fans are numbered through all sets, one set after the other.
static sl_status sweep_unit(sl_context *context, void *job, void *state, size_t unit) {
    const sli_sweep *all = job;
    const size_t count = count_fans(all), first = unit * FANS_AT_ONCE;
    for (size_t i = first; i < first + FANS_AT_ONCE && i < count; i++) {
        if (all->before && !sli_unit_is_wanted(all->options, all->before, (uint32_t)i)) continue;
        if (all->before && sli_is_enough(all->options)) return SL_OK;
        size_t in_set = i;
        uint32_t set = 0;
        while (in_set >= all->fans[set].fans.count) in_set -= all->fans[set++].fans.count;
        SL_TRY(all->visit(context, all, state, set, &all->fans[set].fans.items[in_set]));
        if (all->before) all->done[i] = 1;
    }
    return SL_OK;
}

sl_status sli_sweep_run(sl_context *context, sli_sweep *all) {
    const sl_work work = {.job = all,
                          .begin = begin_sweep_worker,
                          .unit = sweep_unit,
                          .end = end_sweep_worker,
                          .stage = "cell_to_cell",
                          .units = "corners"};
    const size_t units = (count_fans(all) + FANS_AT_ONCE - 1) / FANS_AT_ONCE;
    return sl_work_run(context, &work, units, all->options->threads);
}

static void destroy_sweep(sl_context *context, sli_sweep *all) {
    for (uint32_t set = 0; set < SLI_MOST_FAN_SETS; set++)
        sli_fans_destroy(context, &all->fans[set]);
    sli_bit_rows_destroy(context, &all->rows);
    sli_bit_rows_destroy(context, &all->seen_from);
    sl_free(context, all->done);
}

sl_status sli_sweep_see(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_status (*find)(sl_context *context, sli_sweep *all, sl_visibility *out),
                        sl_visibility *out) {
    sli_sweep all = {.space = space, .options = options};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_EXACT};
    pthread_mutex_init(&all.lock, NULL);
    sl_status status = find(context, &all, &visibility);
    pthread_mutex_destroy(&all.lock);
    if (status == SL_OK) {
        visibility.account.sweep.pieces = all.pieces;
        visibility.account.deepest = all.deepest;
        status = sli_sweep_finish(context, space, options, &all.rows, &visibility);
    }
    destroy_sweep(context, &all);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}

// --- what rows will take

enum { CORNERS_ASKED = 256 };

/// A cell has more words than one of its corners sees, and growing rows have room to spare.
/// Together that is a factor of 1.4 to 1.9 over generated cities, floors, mazes, caves and halls.
#define WORDS_A_WORD_SEEN 1.6

/// Counts the words that a row needs for what the fan visited last sees.
static uint64_t count_words(const sli_sweeper *s, sli_word_set *set) {
    uint64_t count = 0;
    sli_visible_add_to(set, &s->back);
    sli_visible_add_to(set, &s->middle);
    sli_visible_add_to(set, &s->ahead);
    for (size_t word = sli_word_set_next(set, set->low); word < set->high;
         word = sli_word_set_next(set, word + 1))
        count++;
    sli_word_set_clear(set);
    return count;
}

static sl_status ask(sl_context *context, sli_sweeper *s, sli_word_set *set, uint64_t *bytes) {
    const size_t count = s->fans->fans.count;
    const size_t asked = count < CORNERS_ASKED ? count : CORNERS_ASKED;
    uint64_t sum = 0;
    for (size_t i = 0; i < asked; i++) {
        SL_TRY(sli_sweep_fan(context, s, &s->fans->fans.items[i * count / asked]));
        sum += count_words(s, set);
    }
    const double words = asked ? WORDS_A_WORD_SEEN * (double)sum / (double)asked : 0;
    *bytes = (uint64_t)(s->fans->cell_count *
                        (words * SLI_SPARSE_WORD_BYTES + (double)sizeof(sli_sparse_row)));
    return SL_OK;
}

/// Estimates the memory of sparse rows, to a factor of 2 either way. It visits some of the fans.
static sl_status estimate_rows(sl_context *context, const sli_fans *fans, bool closed,
                               sli_bit_rows *rows, uint64_t *bytes) {
    sli_sweeper sweeper;
    sli_word_set set = {0};
    sl_status status = sli_sweeper_create(context, fans, closed, rows, NULL, &sweeper);
    if (status == SL_OK) status = sli_word_set_create(context, fans->cell_count, &set);
    if (status == SL_OK) status = ask(context, &sweeper, &set, bytes);
    sli_bit_rows_join(context, rows, &sweeper.rows);
    sli_sweeper_destroy(context, &sweeper);
    sli_word_set_destroy(context, &set);
    return status;
}

/// Notes how much memory sparse rows will take. Refuses if that is far above the limit.
static sl_status tell_memory(sl_context *context, sli_sweep *all) {
    if (all->rows.bits) return SL_OK;
    const double limit = (double)all->options->row_bytes, mib = 1 << 20;
    uint64_t bytes = 0;
    SL_TRY(estimate_rows(context, &all->fans[0], all->options->sight == SL_CLOSED, &all->rows,
                         &bytes));
    if ((double)bytes / 2 > limit)
        return sl_fail(context, SL_NO_MEMORY,
                       "the visible sets would take about %.1f MiB, and may take %.1f MiB: allow "
                       "more memory, or bake in parts",
                       (double)bytes / mib, limit / mib);
    sl_note(
        context,
        "the visible sets of %u cells will take about %.0f MiB of memory, the corners that lines "
        "turn about %.0f MiB",
        all->rows.count, (double)bytes / mib, (double)sli_fans_bytes(&all->fans[0]) / mib);
    return SL_OK;
}

static sl_status visit(sl_context *context, const sli_sweep *all, sli_sweeper *me, uint32_t set,
                       const sli_fan *fan) {
    (void)all, (void)set;
    return sli_sweep_fan(context, me, fan);
}

static sl_status find_fans(sl_context *context, sli_sweep *all) {
    all->fan_sets = 1;
    all->visit = visit;
    return sli_fans_find(context, all->space, all->options, SLI_FANS_MUTUAL, &all->fans[0]);
}

static sl_status turn_about_all(sl_context *context, sli_sweep *all) {
    SL_TRY(sli_bit_rows_create(context, all->space->cell_count, all->options, &all->rows));
    if (!all->options->shard_count) SL_TRY(tell_memory(context, all));
    return sli_sweep_run(context, all);
}

static sl_status sweep_all(sl_context *context, sli_sweep *all, sl_visibility *out) {
    (void)out;
    SL_TRY(find_fans(context, all));
    SL_TRY(turn_about_all(context, all));
    sli_fans_destroy(context, &all->fans[0]);
    return SL_OK;
}

static sl_status check_options(sl_context *context, const sl_see_options *options) {
    if (!options->trees) return SL_OK;
    return sl_fail(context, SL_UNSUPPORTED, "the method 'sweep' makes no stab trees");
}

sl_status sli_see_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_visibility *out) {
    SL_TRY(check_options(context, options));
    if (options->plan && options->plan->effects & ~(unsigned)SL_EFFECT_ONEWAY)
        return sli_see_sweep_finished(context, space, options, out);
    if (options->plan && options->plan->effects & SL_EFFECT_ONEWAY)
        return sli_see_sweep_one_way(context, space, options, out);
    return sli_sweep_see(context, space, options, sweep_all, out);
}

// --- in parts

static sl_status sweep_some(sl_context *context, sli_sweep *all, sl_partial *partial) {
    SL_TRY(find_fans(context, all));
    const uint32_t count = (uint32_t)all->fans[0].fans.count;
    SL_TRY(sli_partial_begin(context, all->space, all->options, count, partial));
    all->before = partial;
    all->done = sl_alloc_array(context, count, sizeof *all->done);
    if (!all->done) return SL_NO_MEMORY;
    SL_TRY(turn_about_all(context, all));
    sli_fans_destroy(context, &all->fans[0]);
    SL_TRY(sli_bit_rows_add_pvs(context, &all->rows, &partial->sure));
    sl_visibility found = {0};
    SL_TRY(sli_bit_rows_encode(context, &all->rows, &found));
    sl_pvs_destroy(context, &partial->sure);
    partial->sure = found.pvs;
    sli_partial_note_bytes(partial, all->done);
    return SL_OK;
}

sl_status sli_run_sweep(sl_context *context, const sl_space *space, const sl_see_options *options,
                        sl_partial *partial) {
    SL_TRY(check_options(context, options));
    if (options->plan && options->plan->effects)
        return sl_fail(
            context, SL_UNSUPPORTED,
            "the sweep knows no effects when it works in parts: take the method 'prune'");
    sli_sweep all = {.space = space, .options = options};
    pthread_mutex_init(&all.lock, NULL);
    const sl_status status = sweep_some(context, &all, partial);
    pthread_mutex_destroy(&all.lock);
    destroy_sweep(context, &all);
    return status;
}
