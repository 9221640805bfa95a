/// The turning line: its backward half goes over one part of a fan, its forward half over the part
/// half a turn on. A cell that comes into sight of one half is seen from all that the other half
/// sees at that moment.
#include "cell_to_cell/sweep.h"

/// One half of the line.
typedef struct half {
    const sl_reach *reach;
    sl_word_set *seen;
    sl_bit_rows *rows; ///< of what it sees, of what the other half sees
    uint32_t turn;     ///< the next one
    int8_t ray_level;
    bool touched_stay; ///< touched cells, once entered, are so to the end
} half;

static void enter(half *h, int8_t level) {
    const sl_reached *cells = h->reach->cells.items;
    for (uint32_t i = h->reach->turns.items[h->turn].enter; i != UINT32_MAX;
         i = cells[i].next_enter)
        if (cells[i].low.level == level) sl_word_set_add(h->seen, cells[i].cell);
}

/// Adds to the rows of what `h` has come to see all that the other half sees.
static sl_status join(sl_context *context, const half *h, const half *other, int8_t level) {
    const sl_reached *cells = h->reach->cells.items;
    for (uint32_t i = h->reach->turns.items[h->turn].enter; i != UINT32_MAX;
         i = cells[i].next_enter)
        if (cells[i].low.level == level)
            SL_TRY(sl_bit_rows_add(context, h->rows, cells[i].cell, other->seen));
    return SL_OK;
}

static void leave(half *h, int8_t level) {
    const sl_reached *cells = h->reach->cells.items;
    for (uint32_t i = h->reach->turns.items[h->turn].leave; i != UINT32_MAX;
         i = cells[i].next_leave)
        if (cells[i].high.level == level && !(cells[i].touched && h->touched_stay))
            sl_word_set_drop(h->seen, cells[i].cell);
}

/// The cells of the ray at a half's turn, of level `level`.
static void ray_of(const sl_sweeper *s, const half *h, int8_t level, const uint32_t **cells,
                   uint32_t *count) {
    const uint32_t ray = h->reach->turns.items[h->turn].ray;
    *count = 0;
    if (ray == UINT32_MAX || h->ray_level != level) return;
    const uint32_t first = s->rays.starts.items[ray];
    *cells = s->rays.cells.items + first;
    *count = s->rays.starts.items[ray + 1] - first;
}

/// A ray's cells come into sight for a moment: those that were not seen already are noted.
static sl_status pass_ray(sl_context *context, sl_sweeper *s, half *h, int8_t level) {
    const uint32_t *cells;
    uint32_t count;
    ray_of(s, h, level, &cells, &count);
    s->passing.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &s->passing, count));
    for (uint32_t i = 0; i < count; i++) {
        if (sl_bits_has(h->seen->bits, cells[i])) continue;
        sl_word_set_add(h->seen, cells[i]);
        s->passing.items[s->passing.count++] = cells[i];
    }
    return SL_OK;
}

/// One level of a moment of both halves: all that comes into sight, on either side, is joined with
/// all that is in sight.
static sl_status at_level(sl_context *context, sl_sweeper *s, half *halves[2], int8_t level) {
    for (int i = 0; i < 2; i++) enter(halves[i], level);
    // At one level only one of the halves has rays.
    const int with_ray = halves[0]->ray_level == level ? 0 : 1;
    SL_TRY(pass_ray(context, s, halves[with_ray], level));
    for (int i = 0; i < 2; i++) SL_TRY(join(context, halves[i], halves[!i], level));
    for (size_t i = 0; i < s->passing.count; i++)
        SL_TRY(sl_bit_rows_add(context, halves[with_ray]->rows, s->passing.items[i],
                               halves[!with_ray]->seen));
    for (size_t i = 0; i < s->passing.count; i++)
        sl_word_set_drop(halves[with_ray]->seen, s->passing.items[i]);
    for (int i = 0; i < 2; i++) leave(halves[i], level);
    return SL_OK;
}

/// A moment of one half alone. What the other half sees does not change in it, so that levels make
/// no difference.
static sl_status at_turn(sl_context *context, sl_sweeper *s, half *h, const half *other) {
    const sl_reached *cells = h->reach->cells.items;
    const sl_reach_turn *turn = &h->reach->turns.items[h->turn];
    for (uint32_t i = turn->enter; i != UINT32_MAX; i = cells[i].next_enter) {
        sl_word_set_add(h->seen, cells[i].cell);
        SL_TRY(sl_bit_rows_add(context, h->rows, cells[i].cell, other->seen));
    }
    const uint32_t *passing;
    uint32_t count;
    ray_of(s, h, h->ray_level, &passing, &count);
    for (uint32_t i = 0; i < count; i++)
        SL_TRY(sl_bit_rows_add(context, h->rows, passing[i], other->seen));
    for (uint32_t i = turn->leave; i != UINT32_MAX; i = cells[i].next_leave)
        if (!(cells[i].touched && h->touched_stay)) sl_word_set_drop(h->seen, cells[i].cell);
    h->turn++;
    return SL_OK;
}

/// A moment of both halves.
static sl_status at_both_turns(sl_context *context, sl_sweeper *s, half *halves[2]) {
    for (int i = 0; i < 2; i++)
        SL_TRY(at_level(context, s, halves,
                        s->closed ? i ? SL_COUNTER : SL_CLOCKWISE
                        : i       ? SL_AFTER
                                  : SL_BEFORE));
    halves[0]->turn++;
    halves[1]->turn++;
    return SL_OK;
}

/// The cells of the fan that the backward half will see are touched by the line from its start.
static void touch(half *h) {
    for (size_t i = 0; i < h->reach->cells.count; i++)
        if (h->reach->cells.items[i].touched)
            sl_word_set_add(h->seen, h->reach->cells.items[i].cell);
}

sl_status sl_sweep_turn(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    const uint32_t first = s->fans->cells.items[fan->first].edge;
    half back = {
        .reach = &s->back, .seen = &s->behind, .rows = s->back_rows, .ray_level = SL_CLOCKWISE};
    half ahead = {.reach = &s->ahead,
                  .seen = &s->before,
                  .rows = s->ahead_rows,
                  .ray_level = SL_COUNTER,
                  .touched_stay = true};
    half *halves[2] = {&back, &ahead};
    touch(&back);
    sl_status status = SL_OK;
    while (status == SL_OK) {
        const bool more_back = back.turn < s->back.turns.count;
        const bool more_ahead = ahead.turn < s->ahead.turns.count;
        if (!more_back && !more_ahead) break;
        const int order =
            !more_ahead  ? -1
            : !more_back ? 1
                         : sl_turns_compare(&s->reacher, first, &s->back.turns.items[back.turn],
                                            &s->ahead.turns.items[ahead.turn]);
        if (order < 0)
            status = at_turn(context, s, &back, &ahead);
        else if (order > 0)
            status = at_turn(context, s, &ahead, &back);
        else
            status = at_both_turns(context, s, halves);
    }
    sl_word_set_clear(&s->behind);
    sl_word_set_clear(&s->before);
    return status;
}
