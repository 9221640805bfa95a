/// The sweep for maps with one-way glass: SWEEP.md, for lines that have a direction.
///
/// A line with a portal's end at its left crosses the portals round that end counter-clockwise. A
/// line with the end at its right crosses them clockwise. Glass that ends there is a wall to one of
/// the two. So the proof holds for either kind of line, each with fans of its own, which end where
/// the glass is blocked. About such a fan the backward half of the line sees cells from which sight
/// comes to the point. The forward half sees cells to which sight goes on. Clockwise lines are
/// counter-clockwise ones with all glass turned round: their two halves change places.
///
/// The proof moves one end of a line only, the one in the cell that sees. So what a cell's corner
/// sees counts for that cell as the one that sees, not as the one that is seen. It must look at all
/// directions that a line can turn to from the cell, both ways round.
#include "cell_to_cell/pvs_rows.h"
#include "cell_to_cell/sweep/sweep.h"
#include "cell_to_cell/sweep/visible.h"

/// The sets of fans: those that cover cells; those of lines that go round with the fan's point at
/// their left; those with it at their right.
enum { COVERING, FORTH, BACK, SETS };

// --- what a fan's point sees for the cells that it covers

static sl_status look_along_edges(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    s->rays.starts.count = s->rays.cells.count = 0;
    for (uint32_t k = 0; k < fan->count && s->closed; k++)
        for (int last = 0; last < 2; last++) {
            const sli_fan_edge along = {cells[k].cell, cells[k + (uint32_t)last].edge, last};
            SL_TRY(sli_rays_add(context, &s->finder, along, NULL, 0, &s->rays));
        }
    return SL_OK;
}

static sl_status look_through(sl_context *context, sli_sweeper *s, const sli_fan_cell *cell,
                              sli_bound low, sli_bound high) {
    sli_visible_clear(&s->middle);
    SL_TRY(sli_visible_add(context, &s->finder, cell->cell, low, high, &s->middle));
    SL_TRY(sli_visible_through(context, &s->finder, cell->cell, low, high, false, &s->middle));
    return sli_visible_run(context, &s->finder, &s->middle);
}

/// Finds what is seen through each cell of a fan.
static sl_status look_through_all(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    sli_rays *looks = &s->looks;
    looks->starts.count = looks->cells.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &looks->starts, fan->count + 1));
    looks->starts.items[looks->starts.count++] = 0;
    for (uint32_t k = 0; k < fan->count; k++) {
        SL_TRY(look_through(context, s, &cells[k], sli_after_edge(s, cells[k].edge),
                            sli_before_edge(s, cells[k + 1].edge)));
        SL_TRY(SL_ARRAY_ROOM(context, &looks->cells, s->middle.cells.count));
        for (size_t i = 0; i < s->middle.cells.count; i++)
            looks->cells.items[looks->cells.count++] = s->middle.cells.items[i].cell;
        looks->starts.items[looks->starts.count++] = (uint32_t)looks->cells.count;
    }
    return SL_OK;
}

static void add_listed(const sli_rays *lists, uint32_t list, sli_word_set *set) {
    for (uint32_t i = lists->starts.items[list]; i < lists->starts.items[list + 1]; i++)
        sli_word_set_add(set, lists->cells.items[i]);
}

static void add_ray(const sli_sweeper *s, uint32_t k, bool last, sli_word_set *set) {
    if (s->closed) add_listed(&s->rays, 2 * k + last, set);
}

static sl_status add_part(sl_context *context, sli_sweeper *s, const sli_fan_cell *cell,
                          sli_bound low, sli_bound high, sli_word_set *set) {
    SL_TRY(look_through(context, s, cell, low, high));
    for (size_t i = 0; i < s->middle.cells.count; i++)
        sli_word_set_add(set, s->middle.cells.items[i].cell);
    return SL_OK;
}

/// The next cell of a fan, one way or the other. False where there is none, or glass is blocked.
static bool step(const sli_fans *fans, const sli_fan *fan, bool counter, uint32_t *k) {
    const sli_fan_cell *cells = fans->cells.items + fan->first;
    if (*k == (counter ? fan->count - 1 : 0) && !fan->full_turn) return false;
    const uint32_t from = *k;
    *k = counter ? (from + 1) % fan->count : (from + fan->count - 1) % fan->count;
    // The directed portal that a cell begins with leads clockwise round the point.
    const uint32_t back = cells[counter ? *k : from].begin;
    return fans->directed[counter ? fans->directed[back].twin : back].cell != SL_NO_CELL;
}

/// Adds all that a line sees while it rotates counter-clockwise from a cell of the fan, by less
/// than half a turn from the cell's last edge.
static sl_status turn_counter(sl_context *context, sli_sweeper *s, const sli_fan *fan, uint32_t k,
                              sli_word_set *set) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    const sli_bound end = {
        .end = cells[k + 1].edge, .away = true, .rank = s->closed ? SLI_CLOCKWISE : SLI_BEFORE};
    add_ray(s, k, true, set);
    uint32_t j = k;
    for (uint32_t left = fan->count - 1; left && step(s->fans, fan, true, &j); left--) {
        const int within = sli_ends_turn(&s->finder, cells[k + 1].edge, cells[j + 1].edge);
        if (within < 0)
            return add_part(context, s, &cells[j], sli_after_edge(s, cells[j].edge), end, set);
        add_listed(&s->looks, j, set);
        if (within == 0) break;
        add_ray(s, j, true, set);
    }
    return SL_OK;
}

/// Likewise clockwise, from the cell's first edge.
static sl_status turn_clockwise(sl_context *context, sli_sweeper *s, const sli_fan *fan, uint32_t k,
                                sli_word_set *set) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    const sli_bound start = {
        .end = cells[k].edge, .away = true, .rank = s->closed ? SLI_COUNTER : SLI_AFTER};
    add_ray(s, k, false, set);
    uint32_t j = k;
    for (uint32_t left = fan->count - 1; left && step(s->fans, fan, false, &j); left--) {
        const int within = sli_ends_turn(&s->finder, cells[j].edge, cells[k].edge);
        if (within < 0)
            return add_part(context, s, &cells[j], start, sli_before_edge(s, cells[j + 1].edge),
                            set);
        add_listed(&s->looks, j, set);
        if (within == 0) break;
        add_ray(s, j, false, set);
    }
    return SL_OK;
}

static sl_status cover(sl_context *context, sli_sweeper *s, const sli_fan *fan) {
    const sli_fan_cell *cells = s->fans->cells.items + fan->first;
    SL_TRY(sli_visible_finder_stand(context, &s->finder, s->fans, fan->at));
    s->finder.fans = s->fans;
    SL_TRY(look_along_edges(context, s, fan));
    SL_TRY(look_through_all(context, s, fan));
    for (uint32_t k = 0; k < fan->count; k++) {
        if (!cells[k].covered) continue;
        add_listed(&s->looks, k, &s->before);
        SL_TRY(turn_counter(context, s, fan, k, &s->before));
        SL_TRY(turn_clockwise(context, s, fan, k, &s->before));
        SL_TRY(sli_bit_rows_add(context, &s->rows, cells[k].cell, &s->before));
        sli_word_set_clear(&s->before);
    }
    return SL_OK;
}

// --- all fans

/// Serves cells, or turns the line about a fan of lines that go one way round.
static sl_status visit(sl_context *context, const sli_sweep *all, sli_sweeper *s, uint32_t set,
                       const sli_fan *fan) {
    const bool back = set == BACK;
    s->fans = &all->fans[set];
    if (set == COVERING) return cover(context, s, fan);
    s->inward = &all->fans[back ? FORTH : BACK];
    s->outward = s->fans;
    s->back_rows = back ? &s->seen_from : &s->rows;
    s->ahead_rows = back ? &s->rows : &s->seen_from;
    return sli_sweep_fan(context, s, fan);
}

/// Joins both tables: a cell sees another if that one is seen from it.
static sl_status join_directions(sl_context *context, sli_sweep *all) {
    sl_visibility found = {0};
    sl_pvs sees = {0};
    SL_TRY(sli_bit_rows_encode(context, &all->seen_from, &found));
    sl_status status = sli_pvs_transpose(context, &found.pvs, &sees);
    if (status == SL_OK) status = sli_bit_rows_add_pvs(context, &all->rows, &sees);
    sl_pvs_destroy(context, &found.pvs);
    sl_pvs_destroy(context, &sees);
    return status;
}

static sl_status sweep_all(sl_context *context, sli_sweep *all, sl_visibility *out) {
    static const sli_fan_way ways[SETS] = {SLI_FANS_COVERING, SLI_FANS_FORTH, SLI_FANS_BACK};
    const sl_space *space = all->space;
    sl_see_options half = *all->options;
    if (half.row_bytes != UINT64_MAX) half.row_bytes /= 2;
    all->fan_sets = SETS;
    all->visit = visit;
    for (uint32_t set = 0; set < SETS; set++)
        SL_TRY(sli_fans_find(context, space, all->options, ways[set], &all->fans[set]));
    SL_TRY(sli_bit_rows_create(context, space->cell_count, &half, &all->rows));
    SL_TRY(sli_bit_rows_create(context, space->cell_count, &half, &all->seen_from));
    SL_TRY(sli_sweep_run(context, all));
    SL_TRY(join_directions(context, all));
    // By each of the three that found fans.
    out->account.effects.glass_tests =
        SETS * (uint64_t)all->fans[FORTH].first_directed[space->cell_count];
    return SL_OK;
}

sl_status sli_see_sweep_one_way(sl_context *context, const sl_space *space,
                                const sl_see_options *options, sl_visibility *out) {
    return sli_sweep_see(context, space, options, sweep_all, out);
}
