/// One fan of the sweep: what is seen from its point, cut into what a turning line has behind
/// itself, before itself, and what lies between and counts only for cells that the point serves.
#include "cell_to_cell/reach_bound.h"
#include "cell_to_cell/sweep.h"

sl_status sl_sweeper_create(sl_context *context, const sl_fans *fans, bool closed,
                            const sl_bit_rows *rows, sl_sweeper *s) {
    *s = (sl_sweeper){.fans = fans,
                      .inward = fans,
                      .outward = fans,
                      .closed = closed,
                      .back_rows = &s->rows,
                      .ahead_rows = &s->rows};
    SL_TRY(sl_reacher_create(context, fans, closed, &s->reacher));
    SL_TRY(sl_word_set_create(context, fans->cell_count, &s->behind));
    SL_TRY(sl_word_set_create(context, fans->cell_count, &s->before));
    return sl_bit_rows_fork(context, rows, &s->rows);
}

void sl_sweeper_destroy(sl_context *context, sl_sweeper *s) {
    sl_reacher_destroy(context, &s->reacher);
    sl_reach_destroy(context, &s->back);
    sl_reach_destroy(context, &s->middle);
    sl_reach_destroy(context, &s->ahead);
    sl_rays_destroy(context, &s->rays);
    sl_free(context, s->passing.items);
    sl_free(context, s->sectors.items);
    sl_word_set_destroy(context, &s->behind);
    sl_word_set_destroy(context, &s->before);
    *s = (sl_sweeper){0};
}

// --- three parts of a fan

/// The levels at which sectors start and end: edges that the line passes along belong to rays.
static sl_bound after_edge(const sl_sweeper *s, uint32_t end) {
    return (sl_bound){.end = end, .level = s->closed ? SL_COUNTER : SL_AFTER};
}

static sl_bound before_edge(const sl_sweeper *s, uint32_t end) {
    return (sl_bound){.end = end, .level = s->closed ? SL_CLOCKWISE : SL_BEFORE};
}

/// Finds what is seen through the sectors that were added.
static sl_status look(sl_context *context, sl_sweeper *s, sl_reach *reach) {
    for (size_t i = 0; i < s->sectors.count; i++) {
        const sl_sector *from = &s->sectors.items[i];
        SL_TRY(sl_reach_through(context, &s->reacher, from->cell, from->low, from->high, from->thin,
                                reach));
    }
    s->sectors.count = 0;
    return sl_reach_run(context, &s->reacher, reach);
}

/// As look, and sorts what was found.
static sl_status look_sorted(sl_context *context, sl_sweeper *s, sl_reach *reach) {
    if (!s->sectors.count) return SL_OK;
    const sl_bound first = s->sectors.items[0].low;
    SL_TRY(look(context, s, reach));
    return sl_reach_sort(context, &s->reacher, first, reach);
}

static sl_status add_sector(sl_context *context, sl_sweeper *s, sl_sector sector, bool touched,
                            sl_reach *reach) {
    SL_TRY(SL_ARRAY_ROOM(context, &s->sectors, 1));
    s->sectors.items[s->sectors.count++] = sector;
    SL_TRY(sl_reach_add(context, &s->reacher, sector.cell, sector.low, sector.high, reach));
    reach->cells.items[reach->cells.count - 1].touched = touched;
    return SL_OK;
}

/// The directions between which each fan's point looks for the cells that it serves, a little more
/// than half a turn.
static sl_bound horizon(const sl_sweeper *s, bool left) {
    const uint32_t count = (uint32_t)s->fans->ends.count;
    return (sl_bound){.end = left ? count - 1 : count - 2, .level = left ? SL_BEFORE : SL_AFTER};
}

static sl_status reach_back(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    const sl_bound end = {
        .end = cells[fan->count].edge, .away = true, .level = s->closed ? SL_COUNTER : SL_BEFORE};
    for (uint32_t k = 0; k < fan->count && cells[k].past_rest <= (s->closed ? 0 : -1); k++) {
        const bool whole = cells[k + 1].past_rest <= 0;
        const sl_sector sector = {.cell = cells[k].cell,
                                  .low = after_edge(s, cells[k].edge),
                                  .high = whole ? before_edge(s, cells[k + 1].edge) : end,
                                  .thin = cells[k].past_rest == 0};
        SL_TRY(add_sector(context, s, sector, cells[k + 1].past_rest < 0, &s->back));
    }
    return look_sorted(context, s, &s->back);
}

/// The first cell of the fan that lies, in part or with its last edge, half a turn on.
static uint32_t first_ahead(const sl_sweeper *s, const sl_fan *fan) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    uint32_t k = 0;
    while (cells[k + 1].past_half < (s->closed ? 0 : 1)) k++;
    return k;
}

static sl_status reach_ahead(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    const sl_bound start = {
        .end = cells[0].edge, .away = true, .level = s->closed ? SL_CLOCKWISE : SL_AFTER};
    for (uint32_t k = first_ahead(s, fan); k < fan->count; k++) {
        const sl_sector sector = {.cell = cells[k].cell,
                                  .low = cells[k].past_half >= 0 ? after_edge(s, cells[k].edge)
                                                                 : start,
                                  .high = before_edge(s, cells[k + 1].edge),
                                  .thin = cells[k + 1].past_half == 0};
        SL_TRY(add_sector(context, s, sector, cells[k].past_half > 0, &s->ahead));
    }
    return look_sorted(context, s, &s->ahead);
}

/// Whether a direction is one of those below the horizon, less than half a turn.
static bool is_below(const sl_sweeper *s, sl_bound bound) {
    const sl_reacher *r = &s->reacher;
    return sl_bounds_turn(r, horizon(s, false), bound) < 0 &&
           sl_bounds_turn(r, horizon(s, true), bound) > 0;
}

/// Adds of a sector, half a turn at most, what is above the horizon: one part, or two.
static sl_status add_above(sl_context *context, sl_sweeper *s, sl_sector sector) {
    const sl_reacher *r = &s->reacher;
    SL_TRY(SL_ARRAY_ROOM(context, &s->sectors, 2));
    sl_sector *out = s->sectors.items + s->sectors.count;
    if (!s->fans->has_horizon) {
        *out = sector;
        s->sectors.count++;
        return SL_OK;
    }
    const sl_bound right = horizon(s, false), left = horizon(s, true);
    const bool low_below = is_below(s, sector.low), high_below = is_below(s, sector.high);
    if (low_below && high_below) return SL_OK;
    out[0] = out[1] = sector;
    s->sectors.count++;
    if (low_below) {
        out->low = right;
    } else if (high_below) {
        out->high = left;
    } else if (sl_bounds_turn(r, sector.low, left) > 0 &&
               sl_bounds_turn(r, left, sector.high) > 0) {
        out[0].high = left;
        out[1].low = right;
        s->sectors.count++;
    }
    return SL_OK;
}

/// Between the two; all of a fan that is not wide. Its cells count as seen wherever they lie.
static sl_status reach_middle(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    const sl_bound start = {.end = cells[fan->count].edge, .away = true, .level = SL_AFTER};
    const sl_bound end = {.end = cells[0].edge, .away = true, .level = SL_BEFORE};
    for (uint32_t k = 0; k < fan->count; k++) {
        sl_sector sector = {.cell = cells[k].cell,
                            .low = after_edge(s, cells[k].edge),
                            .high = before_edge(s, cells[k + 1].edge)};
        if (fan->wide && (cells[k + 1].past_rest <= 0 || cells[k].past_half >= 0)) continue;
        if (fan->wide && cells[k].past_rest < 0) sector.low = start;
        if (fan->wide && cells[k + 1].past_half > 0) sector.high = end;
        SL_TRY(
            sl_reach_add(context, &s->reacher, sector.cell, sector.low, sector.high, &s->middle));
        SL_TRY(add_above(context, s, sector));
    }
    return look(context, s, &s->middle);
}

// --- rays along the edges

/// Gives the turns at the edges of one part, which was found last, their rays. `first`: its first
/// cell of the fan.
static sl_status add_rays(sl_context *context, sl_sweeper *s, const sl_fan *fan, sl_reach *reach,
                          uint32_t first, bool last) {
    const sl_fan_cell *cell = s->fans->cells.items + fan->first + first;
    for (size_t i = 0; i < reach->cells.count; i++) {
        const sl_reached *c = &reach->cells.items[i];
        if (!c->start) continue;
        const uint32_t turn = last ? c->leave : c->enter;
        const sl_fan_edge along = {.cell = cell->cell, .end = cell[last].edge, .last = last};
        reach->turns.items[turn].ray =
            s->rays.starts.count ? (uint32_t)s->rays.starts.count - 1 : 0;
        SL_TRY(sl_rays_add(context, &s->reacher, along, reach, turn, &s->rays));
        cell++;
    }
    return SL_OK;
}

// --- what the point sees for the cells that it serves

static void add_reach(sl_word_set *set, const sl_reach *reach) {
    for (size_t i = 0; i < reach->cells.count; i++)
        sl_word_set_add(set, reach->cells.items[i].cell);
}

/// What the turning line does not join with a cell of the fan anyway: see sl_sweep_turn. Cells
/// beside each other mostly get the same.
static sl_status serve(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    enum { NOTHING, MIDDLE = 1, BACK = 2, AHEAD = 4 };
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    sl_word_set *set = &s->behind;
    for (uint32_t k = 0, has = NOTHING; k < fan->count; k++) {
        if (!cells[k].served) continue;
        const uint32_t gets = MIDDLE | (fan->wide && cells[k].past_half <= 0 ? BACK : 0) |
                              (fan->wide && cells[k + 1].past_rest >= 0 ? AHEAD : 0);
        if (has & ~gets) {
            sl_word_set_clear(set);
            has = NOTHING;
        }
        if (gets & ~has & MIDDLE) add_reach(set, &s->middle);
        if (gets & ~has & BACK) add_reach(set, &s->back);
        if (gets & ~has & AHEAD) add_reach(set, &s->ahead);
        has = gets;
        SL_TRY(sl_bit_rows_add(context, &s->rows, cells[k].cell, set));
    }
    sl_word_set_clear(set);
    return SL_OK;
}

sl_status sl_sweep_fan(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    SL_TRY(sl_reacher_stand(context, &s->reacher, s->fans, fan->at));
    sl_reach_clear(&s->back);
    sl_reach_clear(&s->middle);
    sl_reach_clear(&s->ahead);
    s->rays.starts.count = s->rays.cells.count = 0;
    if (fan->wide) {
        s->reacher.fans = s->inward;
        SL_TRY(reach_back(context, s, fan));
        if (s->closed) SL_TRY(add_rays(context, s, fan, &s->back, 0, false));
        s->reacher.fans = s->outward;
        SL_TRY(reach_ahead(context, s, fan));
        if (s->closed) SL_TRY(add_rays(context, s, fan, &s->ahead, first_ahead(s, fan), true));
    }
    if (fan->serves && !fan->back_to_back) SL_TRY(reach_middle(context, s, fan));
    if (fan->serves) SL_TRY(serve(context, s, fan));
    return fan->wide ? sl_sweep_turn(context, s, fan) : SL_OK;
}
