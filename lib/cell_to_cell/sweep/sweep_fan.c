/// One fan of the sweep: what its point sees, and how the line rotates about it.
///
/// What is seen from the point is cut into three parts: what the rotating line has behind itself,
/// what it has before itself, and what lies between. The third part counts only for cells that the
/// point covers.
///
/// Then the line rotates. Its backward half goes over one part of the fan, its forward half over
/// the part half a turn on. At each event cells come into the sight of one half or leave it. A cell
/// that comes into the sight of one half is seen from all cells that the other half sees then.
///
/// Invariant: between two events the sets `behind` and `before` are what the two halves see. Cost:
/// one row operation for each interval that starts, besides finding the intervals.
#include "cell_to_cell/sweep/sweep.h"

sl_status sli_sweeper_create(sl_context *context, const sli_fans *fans, bool closed,
                             const sli_bit_rows *rows, const sli_bit_rows *seen_from,
                             sli_sweeper *s) {
    *s = (sli_sweeper){.fans = fans,
                       .inward = fans,
                       .outward = fans,
                       .closed = closed,
                       .back_rows = &s->rows,
                       .ahead_rows = &s->rows};
    SL_TRY(sli_visible_finder_create(context, fans, closed, &s->finder));
    SL_TRY(sli_word_set_create(context, fans->cell_count, &s->behind));
    SL_TRY(sli_word_set_create(context, fans->cell_count, &s->before));
    if (seen_from) SL_TRY(sli_bit_rows_fork(context, seen_from, &s->seen_from));
    return sli_bit_rows_fork(context, rows, &s->rows);
}

void sli_sweeper_destroy(sl_context *context, sli_sweeper *s) {
    sli_visible_finder_destroy(context, &s->finder);
    sli_visible_destroy(context, &s->back);
    sli_visible_destroy(context, &s->middle);
    sli_visible_destroy(context, &s->ahead);
    sli_rays_destroy(context, &s->rays);
    sli_rays_destroy(context, &s->looks);
    sl_free(context, s->passing.items);
    sl_free(context, s->sectors.items);
    sli_word_set_destroy(context, &s->behind);
    sli_word_set_destroy(context, &s->before);
    *s = (sli_sweeper){0};
}

// --- three parts of a fan

/// Finds what is seen through the sectors that were added.
static sl_status look(sl_context *context, sli_sweeper *s, sli_visible *visible) {
    for (size_t i = 0; i < s->sectors.count; i++) {
        const sli_fan_sector *from = &s->sectors.items[i];
        SL_TRY(sli_visible_through(context, &s->finder, from->cell, from->low, from->high,
                                   from->thin, visible));
    }
    s->sectors.count = 0;
    return sli_visible_run(context, &s->finder, visible);
}

/// As look, and sorts the events.
static sl_status look_sorted(sl_context *context, sli_sweeper *s, sli_visible *visible) {
    if (!s->sectors.count) return SL_OK;
    const sli_bound first = s->sectors.items[0].low;
    SL_TRY(look(context, s, visible));
    return sli_visible_sort(context, &s->finder, first, visible);
}

static sl_status add_sector(sl_context *context, sli_sweeper *s, sli_fan_sector sector,
                            bool touched, sli_visible *visible) {
    SL_TRY(SL_ARRAY_ROOM(context, &s->sectors, 1));
    s->sectors.items[s->sectors.count++] = sector;
    SL_TRY(sli_visible_add(context, &s->finder, sector.cell, sector.low, sector.high, visible));
    visible->cells.items[visible->cells.count - 1].touched = touched;
    return SL_OK;
}

/// The two ends of the horizon. A fan's point looks at the directions above it for the cells that
/// it covers, a little more than half a turn.
static sli_bound horizon(const sli_sweeper *s, bool left) {
    const uint32_t count = (uint32_t)s->fans->ends.count;
    return (sli_bound){.end = left ? count - 1 : count - 2, .rank = left ? SLI_BEFORE : SLI_AFTER};
}

static sl_status find_back(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    const sli_bound end = {
        .end = cells[fan->count].edge, .away = true, .rank = s->closed ? SLI_COUNTER : SLI_BEFORE};
    for (uint32_t k = 0; k < fan->count && cells[k].past_rest <= (s->closed ? 0 : -1); k++) {
        const bool whole = cells[k + 1].past_rest <= 0;
        const sli_fan_sector sector = {.cell = cells[k].cell,
                                       .low = sli_after_edge(s, cells[k].edge),
                                       .high = whole ? sli_before_edge(s, cells[k + 1].edge) : end,
                                       .thin = cells[k].past_rest == 0};
        SL_TRY(add_sector(context, s, sector, cells[k + 1].past_rest < 0, &s->back));
    }
    return look_sorted(context, s, &s->back);
}

/// The first cell of the fan that lies, in part or with its last edge, half a turn on.
static uint32_t first_ahead(const sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    uint32_t k = 0;
    while (cells[k + 1].past_half < (s->closed ? 0 : 1)) k++;
    return k;
}

static sl_status find_ahead(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    const sli_bound start = {
        .end = cells[0].edge, .away = true, .rank = s->closed ? SLI_CLOCKWISE : SLI_AFTER};
    for (uint32_t k = first_ahead(s, fan); k < fan->count; k++) {
        const sli_fan_sector sector = {
            .cell = cells[k].cell,
            .low = cells[k].past_half >= 0 ? sli_after_edge(s, cells[k].edge) : start,
            .high = sli_before_edge(s, cells[k + 1].edge),
            .thin = cells[k + 1].past_half == 0};
        SL_TRY(add_sector(context, s, sector, cells[k].past_half > 0, &s->ahead));
    }
    return look_sorted(context, s, &s->ahead);
}

/// Whether a direction is one of those below the horizon, less than half a turn.
static bool is_below(const sli_sweeper *s, sli_bound bound) {
    const sli_visible_finder *r = &s->finder;
    return sli_bounds_turn(r, horizon(s, false), bound) < 0 &&
           sli_bounds_turn(r, horizon(s, true), bound) > 0;
}

/// Adds the part of a sector that is above the horizon, or its two parts. The sector is half a turn
/// at most.
static sl_status add_above(sl_context *context, sli_sweeper *s, sli_fan_sector sector) {
    const sli_visible_finder *r = &s->finder;
    SL_TRY(SL_ARRAY_ROOM(context, &s->sectors, 2));
    sli_fan_sector *out = s->sectors.items + s->sectors.count;
    if (!s->fans->has_horizon) {
        *out = sector;
        s->sectors.count++;
        return SL_OK;
    }
    const sli_bound right = horizon(s, false), left = horizon(s, true);
    const bool low_below = is_below(s, sector.low), high_below = is_below(s, sector.high);
    if (low_below && high_below) return SL_OK;
    out[0] = out[1] = sector;
    s->sectors.count++;
    if (low_below) {
        out->low = right;
    } else if (high_below) {
        out->high = left;
    } else if (sli_bounds_turn(r, sector.low, left) > 0 &&
               sli_bounds_turn(r, left, sector.high) > 0) {
        out[0].high = left;
        out[1].low = right;
        s->sectors.count++;
    }
    return SL_OK;
}

/// Finds what is seen between the two parts, or in all of a fan that is not wide. The fan's own
/// cells count as seen wherever they lie.
static sl_status find_middle(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    const sli_bound start = {.end = cells[fan->count].edge, .away = true, .rank = SLI_AFTER};
    const sli_bound end = {.end = cells[0].edge, .away = true, .rank = SLI_BEFORE};
    for (uint32_t k = 0; k < fan->count; k++) {
        sli_fan_sector sector = {.cell = cells[k].cell,
                                 .low = sli_after_edge(s, cells[k].edge),
                                 .high = sli_before_edge(s, cells[k + 1].edge)};
        if (fan->wide && (cells[k + 1].past_rest <= 0 || cells[k].past_half >= 0)) continue;
        if (fan->wide && cells[k].past_rest < 0) sector.low = start;
        if (fan->wide && cells[k + 1].past_half > 0) sector.high = end;
        SL_TRY(
            sli_visible_add(context, &s->finder, sector.cell, sector.low, sector.high, &s->middle));
        SL_TRY(add_above(context, s, sector));
    }
    return look(context, s, &s->middle);
}

// --- rays along the edges

/// Gives the events at the edges of the part that was found last their rays. `first`: the first
/// cell of the fan in it.
static sl_status add_rays(sl_context *context, sli_sweeper *s, const sli_fan *fan,
                          sli_visible *visible, uint32_t first, bool last) {
    const sli_fan_cell *cell = s->fans->cells.items + fan->first + first;
    for (size_t i = 0; i < visible->cells.count; i++) {
        const sli_visible_interval *c = &visible->cells.items[i];
        if (!c->start) continue;
        const uint32_t event = last ? c->leave : c->enter;
        const sli_fan_edge along = {.cell = cell->cell, .end = cell[last].edge, .last = last};
        visible->events.items[event].ray =
            s->rays.starts.count ? (uint32_t)s->rays.starts.count - 1 : 0;
        SL_TRY(sli_rays_add(context, &s->finder, along, visible, event, &s->rays));
        cell++;
    }
    return SL_OK;
}

// --- what the point sees for the cells that it covers

/// What the rotating line does not join with a cell of the fan anyway: see turn_line. Cells
/// beside each other mostly get the same.
static sl_status cover(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    enum { NOTHING, MIDDLE = 1, BACK = 2, AHEAD = 4 };
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    sli_word_set *set = &s->behind;
    for (uint32_t k = 0, has = NOTHING; k < fan->count; k++) {
        if (!cells[k].covered) continue;
        const uint32_t gets = MIDDLE | (fan->wide && cells[k].past_half <= 0 ? BACK : 0) |
                              (fan->wide && cells[k + 1].past_rest >= 0 ? AHEAD : 0);
        if (has & ~gets) {
            sli_word_set_clear(set);
            has = NOTHING;
        }
        if (gets & ~has & MIDDLE) sli_visible_add_to(set, &s->middle);
        if (gets & ~has & BACK) sli_visible_add_to(set, &s->back);
        if (gets & ~has & AHEAD) sli_visible_add_to(set, &s->ahead);
        has = gets;
        SL_TRY(sli_bit_rows_add(context, &s->rows, cells[k].cell, set));
    }
    sli_word_set_clear(set);
    return SL_OK;
}

// --- the line turns

/// One half of the line.
typedef struct half {
    const sli_visible *visible;
    sli_word_set *seen;
    sli_bit_rows *rows; ///< of what it sees, of what the other half sees
    uint32_t event;     ///< the next one
    int8_t ray_rank;
    bool touched_stay; ///< touched cells, once entered, are so to the end
} half;

static void enter(half *h, int8_t rank) {
    const sli_visible_interval *cells = h->visible->cells.items;
    for (uint32_t i = h->visible->events.items[h->event].enter; i != UINT32_MAX;
         i = cells[i].next_enter)
        if (cells[i].low.rank == rank) sli_word_set_add(h->seen, cells[i].cell);
}

/// Adds all that the other half sees to the rows of the cells that `h` begins to see.
static sl_status join(sl_context *context, const half *h, const half *other, int8_t rank) {
    const sli_visible_interval *cells = h->visible->cells.items;
    for (uint32_t i = h->visible->events.items[h->event].enter; i != UINT32_MAX;
         i = cells[i].next_enter)
        if (cells[i].low.rank == rank)
            SL_TRY(sli_bit_rows_add(context, h->rows, cells[i].cell, other->seen));
    return SL_OK;
}

static void leave(half *h, int8_t rank) {
    const sli_visible_interval *cells = h->visible->cells.items;
    for (uint32_t i = h->visible->events.items[h->event].leave; i != UINT32_MAX;
         i = cells[i].next_leave)
        if (cells[i].high.rank == rank && !(cells[i].touched && h->touched_stay))
            sli_word_set_drop(h->seen, cells[i].cell);
}

/// The cells of the ray at a half's next event, of rank `rank`.
static void ray_of(const sli_sweeper *s, const half *h, int8_t rank, const uint32_t **cells,
                   uint32_t *count) {
    const uint32_t ray = h->visible->events.items[h->event].ray;
    *count = 0;
    if (ray == UINT32_MAX || h->ray_rank != rank) return;
    const uint32_t first = s->rays.starts.items[ray];
    *cells = s->rays.cells.items + first;
    *count = s->rays.starts.items[ray + 1] - first;
}

/// Adds a ray's cells to what the half sees, for this event alone, and notes those that are new.
static sl_status pass_ray(sl_context *context, sli_sweeper *s, half *h, int8_t rank) {
    const uint32_t *cells;
    uint32_t count;
    ray_of(s, h, rank, &cells, &count);
    s->passing.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &s->passing, count));
    for (uint32_t i = 0; i < count; i++) {
        if (sl_bits_has(h->seen->bits, cells[i])) continue;
        sli_word_set_add(h->seen, cells[i]);
        s->passing.items[s->passing.count++] = cells[i];
    }
    return SL_OK;
}

/// One rank of an event of both halves: all that comes into sight, on either side, is joined with
/// all that is in sight.
static sl_status at_rank(sl_context *context, sli_sweeper *s, half *halves[2], int8_t rank) {
    for (int i = 0; i < 2; i++) enter(halves[i], rank);
    // At one rank only one of the halves has rays.
    const int with_ray = halves[0]->ray_rank == rank ? 0 : 1;
    SL_TRY(pass_ray(context, s, halves[with_ray], rank));
    for (int i = 0; i < 2; i++) SL_TRY(join(context, halves[i], halves[!i], rank));
    for (size_t i = 0; i < s->passing.count; i++)
        SL_TRY(sli_bit_rows_add(context, halves[with_ray]->rows, s->passing.items[i],
                                halves[!with_ray]->seen));
    for (size_t i = 0; i < s->passing.count; i++)
        sli_word_set_drop(halves[with_ray]->seen, s->passing.items[i]);
    for (int i = 0; i < 2; i++) leave(halves[i], rank);
    return SL_OK;
}

/// An event of one half alone. What the other half sees does not change, so that ranks make no
/// difference.
static sl_status at_event(sl_context *context, sli_sweeper *s, half *h, const half *other) {
    const sli_visible_interval *cells = h->visible->cells.items;
    const sli_visible_event *event = &h->visible->events.items[h->event];
    for (uint32_t i = event->enter; i != UINT32_MAX; i = cells[i].next_enter) {
        sli_word_set_add(h->seen, cells[i].cell);
        SL_TRY(sli_bit_rows_add(context, h->rows, cells[i].cell, other->seen));
    }
    const uint32_t *passing;
    uint32_t count;
    ray_of(s, h, h->ray_rank, &passing, &count);
    for (uint32_t i = 0; i < count; i++)
        SL_TRY(sli_bit_rows_add(context, h->rows, passing[i], other->seen));
    for (uint32_t i = event->leave; i != UINT32_MAX; i = cells[i].next_leave)
        if (!(cells[i].touched && h->touched_stay)) sli_word_set_drop(h->seen, cells[i].cell);
    h->event++;
    return SL_OK;
}

/// An event of both halves.
static sl_status at_both_events(sl_context *context, sli_sweeper *s, half *halves[2]) {
    for (int i = 0; i < 2; i++)
        SL_TRY(at_rank(context, s, halves,
                       s->closed ? i ? SLI_COUNTER : SLI_CLOCKWISE
                       : i       ? SLI_AFTER
                                 : SLI_BEFORE));
    halves[0]->event++;
    halves[1]->event++;
    return SL_OK;
}

/// The line touches the fan's cells that its backward half will see from its start on.
static void touch(half *h) {
    for (size_t i = 0; i < h->visible->cells.count; i++)
        if (h->visible->cells.items[i].touched)
            sli_word_set_add(h->seen, h->visible->cells.items[i].cell);
}

/// Rotates the line over half a turn, and adds the pairs that its two halves see.
static sl_status turn_line(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const uint32_t first = s->fans->cells.items[fan->first].edge;
    half back = {
        .visible = &s->back, .seen = &s->behind, .rows = s->back_rows, .ray_rank = SLI_CLOCKWISE};
    half ahead = {.visible = &s->ahead,
                  .seen = &s->before,
                  .rows = s->ahead_rows,
                  .ray_rank = SLI_COUNTER,
                  .touched_stay = true};
    half *halves[2] = {&back, &ahead};
    touch(&back);
    sl_status status = SL_OK;
    while (status == SL_OK) {
        const bool more_back = back.event < s->back.events.count;
        const bool more_ahead = ahead.event < s->ahead.events.count;
        if (!more_back && !more_ahead) break;
        const int order =
            !more_ahead  ? -1
            : !more_back ? 1
                         : sli_events_compare(&s->finder, first, &s->back.events.items[back.event],
                                              &s->ahead.events.items[ahead.event]);
        if (order < 0)
            status = at_event(context, s, &back, &ahead);
        else if (order > 0)
            status = at_event(context, s, &ahead, &back);
        else
            status = at_both_events(context, s, halves);
    }
    sli_word_set_clear(&s->behind);
    sli_word_set_clear(&s->before);
    return status;
}

// --- all of a fan

sl_status sli_sweep_fan(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    SL_TRY(sli_visible_finder_stand(context, &s->finder, s->fans, fan->at));
    sli_visible_clear(&s->back);
    sli_visible_clear(&s->middle);
    sli_visible_clear(&s->ahead);
    s->rays.starts.count = s->rays.cells.count = 0;
    if (fan->wide) {
        s->finder.fans = s->inward;
        SL_TRY(find_back(context, s, fan));
        if (s->closed) SL_TRY(add_rays(context, s, fan, &s->back, 0, false));
        s->finder.fans = s->outward;
        SL_TRY(find_ahead(context, s, fan));
        if (s->closed) SL_TRY(add_rays(context, s, fan, &s->ahead, first_ahead(s, fan), true));
    }
    if (fan->covers && !fan->back_to_back) SL_TRY(find_middle(context, s, fan));
    if (fan->covers) SL_TRY(cover(context, s, fan));
    return fan->wide ? turn_line(context, s, fan) : SL_OK;
}
