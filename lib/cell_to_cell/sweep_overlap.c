/// A fan of more than a full turn, as rounded corners make them: the line's halves pass over
/// directions that they have had before, so that directions have no order but in each sector. What
/// is seen through the sectors is compared pair by pair; such fans are rare, and none was met on a
/// real map.
///
/// Angles are those of going round the fan, counter-clockwise from its first edge: two directions
/// may be the same and yet lie a full turn apart.
#include "cell_to_cell/reach_bound.h"
#include "cell_to_cell/sweep.h"

void sl_overlap_destroy(sl_context *context, sl_overlap *overlap) {
    for (int half = 0; half < 2; half++) {
        sl_free(context, overlap->halves[half].starts.items);
        sl_free(context, overlap->halves[half].seen.items);
    }
    *overlap = (sl_overlap){0};
}

// --- what is seen through each sector

static sl_status add_seen(sl_context *context, sl_overlap_half *half, sl_overlap_seen seen) {
    SL_TRY(SL_ARRAY_ROOM(context, &half->seen, 1));
    half->seen.items[half->seen.count++] = seen;
    return SL_OK;
}

/// What is seen along an edge alone: for the backward half first edges, for the forward half last
/// ones (add_rays of sweep_fan.c).
static sl_status add_ray(sl_context *context, sl_sweeper *s, const sl_fan_cell *cell, bool ahead,
                         sl_overlap_half *half) {
    const sl_fan_edge along = {cell->cell, cell[ahead].edge, ahead};
    const sl_bound bound = {.end = along.end, .level = ahead ? SL_COUNTER : SL_CLOCKWISE};
    s->rays.starts.count = s->rays.cells.count = 0;
    SL_TRY(sl_rays_add(context, &s->reacher, along, NULL, 0, &s->rays));
    for (size_t i = 0; i < s->rays.cells.count; i++)
        SL_TRY(add_seen(context, half,
                        (sl_overlap_seen){s->rays.cells.items[i], bound, bound, false}));
    return SL_OK;
}

static sl_status look_through(sl_context *context, sl_sweeper *s, const sl_fan_cell *cell,
                              bool ahead, sl_overlap_half *half) {
    const sl_bound low = {.end = cell->edge, .level = s->closed ? SL_COUNTER : SL_AFTER};
    const sl_bound high = {.end = cell[1].edge, .level = s->closed ? SL_CLOCKWISE : SL_BEFORE};
    sl_reach_clear(&s->middle);
    SL_TRY(sl_reach_add(context, &s->reacher, cell->cell, low, high, &s->middle));
    SL_TRY(sl_reach_through(context, &s->reacher, cell->cell, low, high, false, &s->middle));
    SL_TRY(sl_reach_run(context, &s->reacher, &s->middle));
    for (size_t i = 0; i < s->middle.cells.count; i++) {
        const sl_reached *c = &s->middle.cells.items[i];
        SL_TRY(add_seen(context, half, (sl_overlap_seen){c->cell, c->low, c->high, c->start}));
    }
    return s->closed ? add_ray(context, s, cell, ahead, half) : SL_OK;
}

static sl_status look_through_all(sl_context *context, sl_sweeper *s, const sl_fan *fan, bool ahead,
                                  sl_overlap_half *half) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    half->starts.count = half->seen.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &half->starts, fan->count + 1));
    for (uint32_t k = 0; k < fan->count; k++) {
        half->starts.items[half->starts.count++] = (uint32_t)half->seen.count;
        SL_TRY(look_through(context, s, &cells[k], ahead, half));
    }
    half->starts.items[half->starts.count++] = (uint32_t)half->seen.count;
    return SL_OK;
}

// --- angles

/// Sign of the angle by which edge m is beyond edge i, less pi. A sector is half a turn at most, so
/// that no step passes over the directions past half a turn.
static int past_half(const sl_reacher *r, const sl_fan_cell *cells, uint32_t i, uint32_t m) {
    for (uint32_t k = i + 1; k <= m; k++) {
        const int sign = sl_ends_turn(r, cells[i].edge, cells[k].edge);
        if (sign < 0) return 1;
        if (sign == 0 &&
            sl_opposite(r->from, sl_end_of(r, cells[i].edge), sl_end_of(r, cells[k].edge)))
            return k < m;
    }
    return -1;
}

/// Where the range of one sector and that of another, turned by half a turn, start: both contain
/// the later of the two starts, and end within half a turn from it.
typedef struct frame {
    sl_bound middle;
    bool back_starts, ahead_starts; ///< whether that one's range starts with it
} frame;

/// 0 for the middle of the frame, -1 and 1 for what lies before and behind it.
static int side_of(const sl_reacher *r, sl_bound middle, sl_bound bound, bool starts) {
    const int sign = sl_bounds_turn(r, middle, bound);
    if (sign != 0) return starts ? 1 : sign;
    const bool opposite = sl_opposite(r->from, sl_end_of(r, middle.end), sl_end_of(r, bound.end)) ==
                          (middle.away == bound.away);
    return !opposite ? 0 : starts ? 1 : -1;
}

/// Compares a direction of the backward half with one of the forward half, turned.
static int compare(const sl_reacher *r, const frame *f, sl_bound back, sl_bound ahead) {
    ahead.away = !ahead.away;
    const int of_back = side_of(r, f->middle, back, f->back_starts);
    const int of_ahead = side_of(r, f->middle, ahead, f->ahead_starts);
    if (of_back != of_ahead) return of_back < of_ahead ? -1 : 1;
    const int turn = of_back ? sl_bounds_turn(r, ahead, back) : 0;
    return turn ? turn : (back.level > ahead.level) - (back.level < ahead.level);
}

/// Whether some line through the point has both at once. A cell of the fan is touched from where
/// its own sector lets the line turn to it.
static bool meet(const sl_reacher *r, const frame *f, const sl_overlap_seen *back,
                 const sl_overlap_seen *ahead) {
    if (compare(r, f, back->high, ahead->low) < 0) return false;
    return back->touched || ahead->touched || compare(r, f, back->low, ahead->high) <= 0;
}

// --- pairs

static void add_met(const sl_sweeper *s, const sl_fan *fan, uint32_t k, uint32_t j,
                    const sl_overlap_seen *back, sl_word_set *set) {
    const sl_reacher *r = &s->reacher;
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    const sl_overlap_half *ahead = &s->overlap.halves[1];
    const bool by_touch = past_half(r, cells, k, j + 1) < 0;
    const int starts = past_half(r, cells, k, j);
    const frame f = {.middle = {.end = cells[starts >= 0 ? j : k].edge, .away = starts >= 0},
                     .back_starts = starts <= 0,
                     .ahead_starts = starts >= 0};
    for (uint32_t i = ahead->starts.items[j]; i < ahead->starts.items[j + 1]; i++) {
        const sl_overlap_seen *x = &ahead->seen.items[i];
        if (by_touch ? back->touched || x->touched : meet(r, &f, back, x))
            sl_word_set_add(set, x->cell);
    }
}

sl_status sl_sweep_overlap(sl_context *context, sl_sweeper *s, const sl_fan *fan) {
    const sl_fan_cell *cells = s->fans->cells.items + fan->first;
    sl_overlap_half *back = &s->overlap.halves[0];
    s->reacher.fans = s->inward;
    SL_TRY(look_through_all(context, s, fan, false, back));
    s->reacher.fans = s->outward;
    SL_TRY(look_through_all(context, s, fan, true, &s->overlap.halves[1]));
    for (uint32_t k = 0; k < fan->count; k++)
        for (uint32_t i = back->starts.items[k]; i < back->starts.items[k + 1]; i++) {
            const sl_overlap_seen *y = &back->seen.items[i];
            for (uint32_t j = k; j < fan->count; j++) {
                if (j > k && past_half(&s->reacher, cells, k + 1, j) > 0) break;
                add_met(s, fan, k, j, y, &s->before);
            }
            SL_TRY(sl_bit_rows_add(context, s->back_rows, y->cell, &s->before));
            sl_word_set_clear(&s->before);
        }
    return SL_OK;
}
