/// The sweep where glass is one-way: what sweep.c says, of lines that have a direction.
///
/// A line that goes round a portal's end with the end at its left crosses the portals about it
/// counter-clockwise, one with the end at its right clockwise: glass that ends there is a wall to
/// one of them alone. So the proof of sweep.c holds for either, each with fans of its own, cut
/// where its way is barred. About such a fan the backward half of the line sees cells from which
/// sight comes to the point, the forward half those to which sight goes on: both by directed
/// portals, taken the one way and the other. Lines that go clockwise are those that go
/// counter-clockwise if all glass is turned round, backwards: what their halves see changes places.
///
/// The proof moves one end of a line only, that in the cell that sees. So what a cell's corner sees
/// is needed for the cell as the one that sees, not as the one that is seen; but there it needs all
/// that can be turned to from the cell, both ways round.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/reach.h"
#include "cell_to_cell/sweep.h"

#include "base/threads.h"

#include <pthread.h>

/// Fans that a thread takes at once.
enum { FANS_AT_ONCE = 32 };

typedef struct sweep {
    const sl_space *space;
    const sl_see_options *options;
    sl_fans serving, forth, back;
    pthread_mutex_t lock;
    sl_bit_rows sees, seen_from; ///< joined from the threads' forks, under the lock
    uint64_t pieces;
    uint32_t deepest;
} sweep;

/// One thread's own.
typedef struct one_way {
    sl_sweeper turning; ///< its rows: what cells see
    sl_bit_rows seen_from;
    sl_rays sectors; ///< of the fan at hand: what is seen through each of its cells
} one_way;

// --- what a fan's point sees for the cells that it serves

static sl_status look_along_edges(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    s->rays.starts.count = s->rays.cells.count = 0;
    for (uint32_t k = 0; k < fan->count && s->closed; k++)
        for (int last = 0; last < 2; last++) {
            const sl_fan_edge along = {cells[k].cell, cells[k + (uint32_t)last].edge, last};
            SL_TRY(sl_rays_add(context, &s->reacher, along, NULL, 0, &s->rays));
        }
    return SL_OK;
}

static sl_bound first_bound(const sl_sweeper *s, const sl_fan_cell *cell) {
    return (sl_bound){.end = cell->edge, .level = s->closed ? SL_COUNTER : SL_AFTER};
}

static sl_bound last_bound(const sl_sweeper *s, const sl_fan_cell *cell) {
    return (sl_bound){.end = cell[1].edge, .level = s->closed ? SL_CLOCKWISE : SL_BEFORE};
}

static sl_status look_through(sl_context *context, sl_sweeper *s, const sl_fan_cell *cell,
                              sl_bound low, sl_bound high) {
    sl_reach_clear(&s->middle);
    SL_TRY(sl_reach_add(context, &s->reacher, cell->cell, low, high, &s->middle));
    SL_TRY(sl_reach_through(context, &s->reacher, cell->cell, low, high, false, &s->middle));
    return sl_reach_run(context, &s->reacher, &s->middle);
}

/// What is seen through each cell of a fan, all of it.
static sl_status look_through_all(sl_context *context, one_way *me, const sl_fan *fan) {
    sl_sweeper *s = &me->turning;
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    sl_rays *sectors = &me->sectors;
    sectors->starts.count = sectors->cells.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &sectors->starts, fan->count + 1));
    sectors->starts.items[sectors->starts.count++] = 0;
    for (uint32_t k = 0; k < fan->count; k++) {
        SL_TRY(look_through(context, s, &cells[k], first_bound(s, &cells[k]),
                            last_bound(s, &cells[k])));
        SL_TRY(SL_ARRAY_ROOM(context, &sectors->cells, s->middle.cells.count));
        for (size_t i = 0; i < s->middle.cells.count; i++)
            sectors->cells.items[sectors->cells.count++] = s->middle.cells.items[i].cell;
        sectors->starts.items[sectors->starts.count++] = (uint32_t)sectors->cells.count;
    }
    return SL_OK;
}

static void add_listed(const sl_rays *lists, uint32_t list, sl_word_set *set) {
    for (uint32_t i = lists->starts.items[list]; i < lists->starts.items[list + 1]; i++)
        sl_word_set_add(set, lists->cells.items[i]);
}

static void add_ray(const sl_sweeper *s, uint32_t k, bool last, sl_word_set *set) {
    if (s->closed) add_listed(&s->rays, 2 * k + last, set);
}

static sl_status add_part(sl_context *context, sl_sweeper *s, const sl_fan_cell *cell, sl_bound low,
                          sl_bound high, sl_word_set *set) {
    SL_TRY(look_through(context, s, cell, low, high));
    for (size_t i = 0; i < s->middle.cells.count; i++)
        sl_word_set_add(set, s->middle.cells.items[i].cell);
    return SL_OK;
}

/// The next cell of a fan, one way or the other. False where there is none, or glass is blocked.
static bool step(const sl_fans *fans, const sl_fan *fan, bool counter, uint32_t *k) {
    const sl_fan_cell *cells = fans->cells.items + fan->first;
    if (*k == (counter ? fan->count - 1 : 0) && !fan->full_turn) return false;
    const uint32_t from = *k;
    *k = counter ? (from + 1) % fan->count : (from + fan->count - 1) % fan->count;
    // The directed portal that a cell begins with leads clockwise round the point.
    const uint32_t back = cells[counter ? *k : from].begin;
    return fans->directed[counter ? fans->directed[back].twin : back].cell != SL_NO_CELL;
}

/// All that a line sees that turns counter-clockwise from a cell of the fan, by less than half a
/// turn from its last edge.
static sl_status turn_counter(sl_context *context, one_way *me, const sl_fan *fan, uint32_t k,
                              sl_word_set *set) {
    sl_sweeper *s = &me->turning;
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    const sl_bound end = {
        .end = cells[k + 1].edge, .away = true, .level = s->closed ? SL_CLOCKWISE : SL_BEFORE};
    add_ray(s, k, true, set);
    uint32_t j = k;
    for (uint32_t left = fan->count - 1; left && step(s->fans, fan, true, &j); left--) {
        const int within = sl_ends_turn(&s->reacher, cells[k + 1].edge, cells[j + 1].edge);
        if (within < 0) return add_part(context, s, &cells[j], first_bound(s, &cells[j]), end, set);
        add_listed(&me->sectors, j, set);
        if (within == 0) break;
        add_ray(s, j, true, set);
    }
    return SL_OK;
}

/// The other way round, from its first edge.
static sl_status turn_clockwise(sl_context *context, one_way *me, const sl_fan *fan, uint32_t k,
                                sl_word_set *set) {
    sl_sweeper *s = &me->turning;
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    const sl_bound start = {
        .end = cells[k].edge, .away = true, .level = s->closed ? SL_COUNTER : SL_AFTER};
    add_ray(s, k, false, set);
    uint32_t j = k;
    for (uint32_t left = fan->count - 1; left && step(s->fans, fan, false, &j); left--) {
        const int within = sl_ends_turn(&s->reacher, cells[j].edge, cells[k].edge);
        if (within < 0)
            return add_part(context, s, &cells[j], start, last_bound(s, &cells[j]), set);
        add_listed(&me->sectors, j, set);
        if (within == 0) break;
        add_ray(s, j, false, set);
    }
    return SL_OK;
}

static sl_status serve(sl_context *context, one_way *me, const sl_fan *fan) {
    sl_sweeper *s = &me->turning;
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    SL_TRY(sl_reacher_stand(context, &s->reacher, s->fans, fan->at));
    s->reacher.fans = s->fans;
    SL_TRY(look_along_edges(context, s, fan));
    SL_TRY(look_through_all(context, me, fan));
    for (uint32_t k = 0; k < fan->count; k++) {
        if (!cells[k].served) continue;
        add_listed(&me->sectors, k, &s->before);
        SL_TRY(turn_counter(context, me, fan, k, &s->before));
        SL_TRY(turn_clockwise(context, me, fan, k, &s->before));
        SL_TRY(sl_bit_rows_add(context, &s->rows, cells[k].cell, &s->before));
        sl_word_set_clear(&s->before);
    }
    return SL_OK;
}

// --- all fans

static void end(sl_context *context, void *job, void *state) {
    sweep *all = job;
    one_way *me = state;
    pthread_mutex_lock(&all->lock);
    sl_bit_rows_join(context, &all->sees, &me->turning.rows);
    sl_bit_rows_join(context, &all->seen_from, &me->seen_from);
    all->pieces += me->turning.reacher.pieces;
    if (me->turning.reacher.deepest > all->deepest) all->deepest = me->turning.reacher.deepest;
    pthread_mutex_unlock(&all->lock);
    sl_sweeper_destroy(context, &me->turning);
    sl_rays_destroy(context, &me->sectors);
    sl_free(context, me);
}

static sl_status begin(sl_context *context, void *job, void **state) {
    sweep *all = job;
    one_way *me = sl_alloc_array(context, 1, sizeof *me);
    if (!me) return SL_NO_MEMORY;
    sl_status status = sl_sweeper_create(context, &all->serving, all->options->sight == SL_CLOSED,
                                         &all->sees, &me->turning);
    if (status == SL_OK) status = sl_bit_rows_fork(context, &all->seen_from, &me->seen_from);
    if (status == SL_OK)
        *state = me;
    else
        end(context, job, me);
    return status;
}

/// Turns the line about the fans of lines that go counter-clockwise, or (`back`) clockwise.
static sl_status turn(sl_context *context, sweep *all, one_way *me, bool back, size_t fan) {
    sl_sweeper *s = &me->turning;
    s->fans = back ? &all->back : &all->forth;
    s->inward = back ? &all->forth : &all->back;
    s->outward = s->fans;
    s->back_rows = back ? &me->seen_from : &s->rows;
    s->ahead_rows = back ? &s->rows : &me->seen_from;
    return sl_sweep_fan(context, s, &s->fans->fans.items[fan]);
}

static sl_status sweep_unit(sl_context *context, void *job, void *state, size_t unit) {
    sweep *all = job;
    one_way *me = state;
    const size_t serving = all->serving.fans.count, forth = all->forth.fans.count;
    const size_t count = serving + forth + all->back.fans.count;
    for (size_t i = unit * FANS_AT_ONCE; i < (unit + 1) * FANS_AT_ONCE && i < count; i++) {
        if (i < serving) {
            me->turning.fans = &all->serving;
            SL_TRY(serve(context, me, &all->serving.fans.items[i]));
        } else {
            const bool back = i >= serving + forth;
            SL_TRY(turn(context, all, me, back, i - serving - (back ? forth : 0)));
        }
    }
    return SL_OK;
}

/// Adds to what cells see whatever they are seen from.
static sl_status join_directions(sl_context *context, sweep *all) {
    sl_visibility found = {0};
    sl_pvs sees = {0};
    SL_TRY(sl_bit_rows_encode(context, &all->seen_from, &found));
    sl_status status = sl_pvs_transpose(context, &found.pvs, &sees);
    if (status == SL_OK) status = sl_bit_rows_add_pvs(context, &all->sees, &sees);
    sl_pvs_destroy(context, &found.pvs);
    sl_pvs_destroy(context, &sees);
    return status;
}

static sl_status sweep_all(sl_context *context, sweep *all, sl_visibility *out) {
    const sl_space *space = all->space;
    const sl_see_options *options = all->options;
    sl_see_options half = *options;
    if (half.row_bytes != UINT64_MAX) half.row_bytes /= 2;
    SL_TRY(sl_fans_find(context, space, options, SL_FANS_SERVING, &all->serving));
    SL_TRY(sl_fans_find(context, space, options, SL_FANS_FORTH, &all->forth));
    SL_TRY(sl_fans_find(context, space, options, SL_FANS_BACK, &all->back));
    SL_TRY(sl_bit_rows_create(context, space->cell_count, &half, &all->sees));
    SL_TRY(sl_bit_rows_create(context, space->cell_count, &half, &all->seen_from));
    const sl_work work = {.job = all,
                          .begin = begin,
                          .unit = sweep_unit,
                          .end = end,
                          .stage = "cell_to_cell",
                          .units = "corners"};
    const size_t count = all->serving.fans.count + all->forth.fans.count + all->back.fans.count;
    SL_TRY(
        sl_work_run(context, &work, (count + FANS_AT_ONCE - 1) / FANS_AT_ONCE, options->threads));
    SL_TRY(join_directions(context, all));
    out->account.pieces = all->pieces;
    out->account.deepest = all->deepest;
    // By each of the three that found fans.
    out->account.glass_tests = 3 * (uint64_t)all->forth.first_directed[space->cell_count];
    return sl_sweep_finish(context, space, options, &all->sees, out);
}

sl_status sl_see_sweep_one_way(sl_context *context, const sl_space *space,
                               const sl_see_options *options, sl_visibility *out) {
    sweep all = {.space = space, .options = options};
    sl_visibility visibility = {.sight = options->sight, .guarantee = SL_EXACT};
    pthread_mutex_init(&all.lock, NULL);
    const sl_status status = sweep_all(context, &all, &visibility);
    pthread_mutex_destroy(&all.lock);
    sl_fans_destroy(context, &all.serving);
    sl_fans_destroy(context, &all.forth);
    sl_fans_destroy(context, &all.back);
    sl_bit_rows_destroy(context, &all.sees);
    sl_bit_rows_destroy(context, &all.seen_from);
    if (status == SL_OK)
        *out = visibility;
    else
        sl_visibility_destroy(context, &visibility);
    return status;
}
