/// Local search for networks: some chosen places that are close to each other are taken out, what
/// they saw is covered anew, what fell apart is joined (area_network.c), and what is not needed
/// goes. The result is kept if it is not dearer (Shaw 1998, Using constraint programming and local
/// search methods to solve vehicle routing problems).
///
/// Places that are linked to the others are preferred: they need no chain of places that see
/// nothing new.
#include "analysis/placement/cover.h"
#include "analysis/placement/place_area.h"

#include <math.h>
#include <string.h>

enum { ITERATIONS = 400, TAKEN_LEAST = 2, TAKEN_MORE = 8 };
/// What a link is worth, in rows; one in so many places is passed over.
enum { WORTH_OF_LINK = 3, PASSED_OVER = 8 };

typedef struct network_search {
    sli_area *a;
    const sli_cover *cover;
    sl_random random;
    uint8_t *now, *trial; ///< by place
    uint32_t *counts;     ///< by row: how many of `trial` see it
    uint8_t *near;        ///< by point: there, or linked to it, is a place of `trial`
} network_search;

static uint64_t cost_of(const network_search *s, const uint8_t *chosen) {
    uint64_t cost = 0;
    for (uint32_t p = 0; p < s->cover->columns; p++)
        if (chosen[p]) cost += s->a->task->costs ? s->a->task->costs[p] : 1;
    return cost;
}

static double square_between(const network_search *s, uint32_t p, uint32_t q) {
    const sl_point a = s->a->task->places[p].at, b = s->a->task->places[q].at;
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// A place of `trial` by chance, but no fixed one; all places where there is none.
static uint32_t draw_place(network_search *s) {
    uint32_t count = 0, chosen = s->cover->columns;
    for (uint32_t p = 0; p < s->cover->columns; p++)
        if (s->trial[p] && !s->a->fixed[p] && sl_random_below(&s->random, ++count) == 0) chosen = p;
    return chosen;
}

/// Takes a place out, and those nearest to it.
static void take_out(network_search *s) {
    const uint32_t from = draw_place(s), columns = s->cover->columns;
    uint64_t count = TAKEN_LEAST + sl_random_below(&s->random, TAKEN_MORE);
    for (; from < columns && count; count--) {
        uint32_t nearest = columns;
        for (uint32_t p = 0; p < columns; p++)
            if (s->trial[p] && !s->a->fixed[p] &&
                (nearest == columns ||
                 square_between(s, from, p) < square_between(s, from, nearest)))
                nearest = p;
        if (nearest == columns) return;
        s->trial[nearest] = 0;
    }
}

static void put_in(network_search *s, uint32_t place) {
    const sli_network *n = &s->a->network;
    const uint32_t group = n->group_of[place];
    s->trial[place] = 1;
    for (size_t i = s->cover->column_first[place]; i < s->cover->column_first[place + 1]; i++)
        s->counts[s->cover->column_rows[i]]++;
    s->near[group] = 1;
    for (size_t i = n->first[group]; i < n->first[group + 1]; i++) s->near[n->links[i]] = 1;
}

/// How much a place adds, for its cost.
static double worth_of(const network_search *s, uint32_t place) {
    double worth = s->near[s->a->network.group_of[place]] ? WORTH_OF_LINK : 0;
    for (size_t i = s->cover->column_first[place]; i < s->cover->column_first[place + 1]; i++) {
        const uint32_t row = s->cover->column_rows[i];
        worth += s->counts[row] < s->cover->demands[row];
    }
    return worth / (s->a->task->costs ? s->a->task->costs[place] : 1);
}

/// The place of a row to put in: that which adds most, of those that are not passed over by chance.
static uint32_t place_for(network_search *s, uint32_t row) {
    uint32_t best = UINT32_MAX;
    double most = -1;
    for (size_t i = s->cover->row_first[row]; i < s->cover->row_first[row + 1]; i++) {
        const uint32_t place = s->cover->row_columns[i];
        if (s->trial[place]) continue;
        if (best != UINT32_MAX && sl_random_below(&s->random, PASSED_OVER) == 0) continue;
        const double worth = worth_of(s, place);
        if (worth <= most) continue;
        most = worth;
        best = place;
    }
    return best;
}

/// Covers what is left of all rows. False where that cannot be done.
static bool cover_again(network_search *s) {
    const sli_cover *cover = s->cover;
    memset(s->counts, 0, cover->rows * sizeof *s->counts);
    memset(s->near, 0, s->a->group_count);
    for (uint32_t p = 0; p < cover->columns; p++)
        if (s->trial[p]) put_in(s, p);
    const uint32_t start = (uint32_t)sl_random_below(&s->random, cover->rows);
    for (uint32_t i = 0; i < cover->rows; i++) {
        const uint32_t row = i < cover->rows - start ? start + i : i - (cover->rows - start);
        while (s->counts[row] < cover->demands[row]) {
            const uint32_t place = place_for(s, row);
            if (place == UINT32_MAX) return false;
            put_in(s, place);
        }
    }
    return true;
}

static sl_status search(network_search *s) {
    const uint32_t columns = s->cover->columns;
    uint64_t cost = cost_of(s, s->now);
    for (int i = 0; i < ITERATIONS && s->cover->rows; i++) {
        SL_TRY(sl_check_cancelled(s->a->context));
        memcpy(s->trial, s->now, columns);
        take_out(s);
        if (!cover_again(s)) continue;
        bool joined;
        SL_TRY(sli_network_join_by(s->a, s->cover, (uint32_t)sl_random_below(&s->random, columns),
                                   s->trial, &joined));
        const uint64_t next = cost_of(s, s->trial);
        if (!joined || next > cost) continue;
        cost = next;
        memcpy(s->now, s->trial, columns);
    }
    return SL_OK;
}

sl_status sli_network_search(sli_area *a, uint8_t *chosen) {
    sl_cover_problem problem = {0};
    sli_cover cover = {0};
    network_search s = {.a = a, .cover = &cover, .random = {a->witnesses.count}, .now = chosen};
    sl_status status = sli_area_problem(a, false, &problem);
    if (status == SL_OK) status = sli_cover_read(a->context, &problem, 1, &cover);
    s.trial = sl_alloc_array(a->context, a->task->place_count, 1);
    s.counts = sl_alloc_array(a->context, (size_t)cover.rows + 1, sizeof *s.counts);
    s.near = sl_alloc_array(a->context, a->group_count, 1);
    if (status == SL_OK && (!s.trial || !s.counts || !s.near)) status = SL_NO_MEMORY;
    if (status == SL_OK) status = search(&s);
    sl_free(a->context, s.trial);
    sl_free(a->context, s.counts);
    sl_free(a->context, s.near);
    sli_cover_destroy(a->context, &cover);
    sli_area_problem_destroy(a->context, &problem);
    return status;
}
