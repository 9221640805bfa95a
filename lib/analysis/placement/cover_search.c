/// Covers that are cheap: a greedy start (Chvatal 1979), then local search with weighted rows (Gao,
/// Weise and Li 2015, RWLS).
///
/// The search holds a set that costs less than the best cover, so some rows are not covered. Each
/// step drops the column whose loss is least and adds one that covers a row drawn from those not
/// covered. Then the weight of each row that is still not covered grows by one: rows that are hard
/// to cover become dear, and the search leaves places where it goes in circles. When all rows are
/// covered, that is a better cover.
///
/// The score of a column is what the weighted shortfall of the rows would gain by adding or lose by
/// dropping it. A row changes scores only where it comes to its demand or leaves it. A column that
/// was dropped comes back only after a column beside it has changed (configuration checking); a
/// column just added stays for a step. All draws are from one generator: the same input gives the
/// same set.
#include "analysis/placement/cover.h"

#include <stdlib.h>
#include <string.h>

typedef struct priced {
    uint32_t cost, column;
} priced;

static int compare_dearest(const void *left, const void *right) {
    const priced *a = left, *b = right;
    if (a->cost != b->cost) return a->cost > b->cost ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

/// Drops columns that no row needs, the dearest first.
static void drop_spare(const sli_cover *c, const uint8_t *fixed, int64_t *rest, priced *order,
                       uint8_t *taken) {
    uint32_t count = 0;
    for (uint32_t j = 0; j < c->columns; j++)
        if (taken[j] && !(fixed && fixed[j] == SLI_COVER_IN))
            order[count++] = (priced){c->costs[j], j};
    qsort(order, count, sizeof *order, compare_dearest);
    for (uint32_t k = 0; k < count; k++) {
        const size_t from = c->column_first[order[k].column];
        const size_t to = c->column_first[order[k].column + 1];
        bool spare = true;
        for (size_t i = from; i < to && spare; i++) spare = rest[c->column_rows[i]] < 0;
        if (!spare) continue;
        taken[order[k].column] = 0;
        for (size_t i = from; i < to; i++) rest[c->column_rows[i]]++;
    }
}

typedef struct greedy {
    const sli_cover *cover;
    const double *duals;
    int64_t *rest;        ///< by row
    uint32_t *short_rows; ///< by column: its rows that are short of columns
    double *worth;        ///< by column: the duals of these
    uint32_t missing;     ///< rows
} greedy;

static void greedy_take(greedy *g, uint32_t column) {
    const sli_cover *c = g->cover;
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++) {
        const uint32_t row = c->column_rows[i];
        if (--g->rest[row]) continue;
        g->missing--;
        for (size_t k = c->row_first[row]; k < c->row_first[row + 1]; k++) {
            g->short_rows[c->row_columns[k]]--;
            if (g->duals) g->worth[c->row_columns[k]] -= g->duals[row];
        }
    }
}

/// What a column costs for each row that it covers, less is better; its reduced cost where there
/// are duals (Caprara, Fischetti and Toth 1999).
static double greedy_price(const greedy *g, uint32_t column) {
    const double cost = g->cover->costs[column] - g->worth[column], rows = g->short_rows[column];
    return cost > 0 ? cost / rows : cost * rows;
}

static void greedy_run(greedy *g, const uint8_t *fixed, uint8_t *taken) {
    const sli_cover *c = g->cover;
    for (uint32_t r = 0; r < c->rows; r++) {
        g->rest[r] = c->demands[r];
        g->missing += g->rest[r] > 0;
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1] && g->rest[r] > 0; k++) {
            g->short_rows[c->row_columns[k]]++;
            if (g->duals) g->worth[c->row_columns[k]] += g->duals[r];
        }
    }
    for (uint32_t j = 0; j < c->columns; j++)
        if (taken[j]) greedy_take(g, j);
    while (g->missing) {
        uint32_t best = UINT32_MAX;
        double least = 0;
        for (uint32_t j = 0; j < c->columns; j++) {
            if (taken[j] || !g->short_rows[j] || (fixed && fixed[j] == SLI_COVER_OUT)) continue;
            const double price = greedy_price(g, j);
            if (best != UINT32_MAX && price >= least) continue;
            best = j;
            least = price;
        }
        if (best == UINT32_MAX) break; // not without columns that are left out
        taken[best] = 1;
        greedy_take(g, best);
    }
}

sl_status sli_cover_greedy(sl_context *context, const sli_cover *cover, const double *duals,
                           const uint8_t *fixed, uint8_t *taken) {
    greedy g = {.cover = cover, .duals = duals};
    g.rest = sl_alloc_array(context, cover->rows, sizeof *g.rest);
    g.short_rows = sl_alloc_array(context, cover->columns, sizeof *g.short_rows);
    g.worth = sl_alloc_array(context, cover->columns, sizeof *g.worth);
    priced *order = sl_alloc_array(context, cover->columns, sizeof *order);
    const bool room = g.rest && g.short_rows && g.worth && order;
    if (room) {
        greedy_run(&g, fixed, taken);
        drop_spare(cover, fixed, g.rest, order, taken);
    }
    sl_free(context, g.rest);
    sl_free(context, g.short_rows);
    sl_free(context, g.worth);
    sl_free(context, order);
    return room ? SL_OK : SL_NO_MEMORY;
}

// --- local search

/// A list of numbers that knows where each is; UINT32_MAX for those that are not in it.
typedef struct list {
    uint32_t *items, *places, count;
} list;

typedef struct search {
    const sli_cover *cover;
    sl_random random;
    list in, missing;    ///< columns of the set, rows short of columns
    int64_t *rest;       ///< by row
    int64_t *weights;    ///< by row
    int64_t *scores;     ///< by column
    uint64_t *row_times; ///< when a column of this row last changed
    uint64_t *times;     ///< when a column last changed
    uint64_t time, cost;
    int64_t short_weight; ///< of rows short of columns, by the weights of the time
} search;

static bool list_make(sl_context *context, uint32_t count, list *out) {
    out->items = sl_alloc_array(context, count, sizeof *out->items);
    out->places = sl_alloc_array(context, count, sizeof *out->places);
    if (!out->items || !out->places) return false;
    for (uint32_t i = 0; i < count; i++) out->places[i] = UINT32_MAX;
    return true;
}

static void list_add(list *l, uint32_t item) {
    l->places[item] = l->count;
    l->items[l->count++] = item;
}

static void list_drop(list *l, uint32_t item) {
    const uint32_t place = l->places[item], last = l->items[--l->count];
    l->items[place] = last;
    l->places[last] = place;
    l->places[item] = UINT32_MAX;
}

static bool is_in(const search *s, uint32_t column) {
    return s->in.places[column] != UINT32_MAX;
}

/// A row has come to its demand: no column gains by it more; those of the set lose by it already.
static void shift_outer(search *s, uint32_t row, int64_t by, uint32_t but) {
    const sli_cover *c = s->cover;
    for (size_t k = c->row_first[row]; k < c->row_first[row + 1]; k++) {
        const uint32_t column = c->row_columns[k];
        if (column != but && !is_in(s, column)) s->scores[column] += by;
    }
}

static void shift_inner(search *s, uint32_t row, int64_t by, uint32_t but) {
    const sli_cover *c = s->cover;
    for (size_t k = c->row_first[row]; k < c->row_first[row + 1]; k++) {
        const uint32_t column = c->row_columns[k];
        if (column != but && is_in(s, column)) s->scores[column] += by;
    }
}

/// Adds a column, or drops it.
static void change(search *s, uint32_t column) {
    const sli_cover *c = s->cover;
    const bool adds = !is_in(s, column);
    s->time++;
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++) {
        const uint32_t row = c->column_rows[i];
        s->row_times[row] = s->time;
        if (adds) {
            if (--s->rest[row] == 0) {
                list_drop(&s->missing, row);
                s->short_weight -= s->weights[row];
                shift_outer(s, row, -s->weights[row], column);
            } else if (s->rest[row] == -1) {
                shift_inner(s, row, s->weights[row], column);
            }
        } else if (++s->rest[row] == 1) {
            list_add(&s->missing, row);
            s->short_weight += s->weights[row];
            shift_outer(s, row, s->weights[row], column);
        } else if (s->rest[row] == 0) {
            shift_inner(s, row, -s->weights[row], column);
        }
    }
    s->scores[column] = -s->scores[column];
    s->times[column] = s->time;
    if (adds) {
        list_add(&s->in, column);
        s->cost += c->costs[column];
    } else {
        list_drop(&s->in, column);
        s->cost -= c->costs[column];
    }
}

/// Costs do not count in maximum coverage: there they are 1 each.
static double priority(const search *s, uint32_t column) {
    return (double)s->scores[column] / s->cover->costs[column];
}

/// The column of the set to drop: the least loss for its cost, then the one that is there longest.
/// Columns that came after `since` stay, if there are others.
static uint32_t worst(const search *s, uint64_t since) {
    uint32_t best = UINT32_MAX;
    double most = 0;
    for (uint32_t k = 0; k < s->in.count; k++) {
        const uint32_t j = s->in.items[k];
        if (s->times[j] > since) continue;
        const double p = priority(s, j);
        if (best != UINT32_MAX && (p < most || (p == most && s->times[j] >= s->times[best])))
            continue;
        best = j;
        most = p;
    }
    return best;
}

static bool may_return(const search *s, uint32_t column) {
    const sli_cover *c = s->cover;
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++)
        if (s->row_times[c->column_rows[i]] > s->times[column]) return true;
    return s->times[column] == 0;
}

/// The column to add for a row, at a cost below `room`; UINT32_MAX for none.
static uint32_t best_for(const search *s, uint32_t row, uint64_t room) {
    const sli_cover *c = s->cover;
    uint32_t best = UINT32_MAX;
    double most = 0;
    for (size_t k = c->row_first[row]; k < c->row_first[row + 1]; k++) {
        const uint32_t j = c->row_columns[k];
        if (is_in(s, j) || c->costs[j] >= room) continue;
        const double p = priority(s, j);
        if (best != UINT32_MAX && (p < most || (p == most && s->times[j] >= s->times[best])))
            continue;
        if (!may_return(s, j)) continue;
        best = j;
        most = p;
    }
    return best;
}

/// A step: one column less, then columns for rows that are short, as far as the cost allows.
static void step(search *s, uint64_t best, uint64_t *since) {
    const uint32_t out = worst(s, *since);
    if (out != UINT32_MAX) change(s, out);
    *since = s->time;
    while (s->missing.count && s->cost < best) {
        const uint32_t row = s->missing.items[sl_random_below(&s->random, s->missing.count)];
        const uint32_t added = best_for(s, row, best - s->cost);
        if (added == UINT32_MAX) break;
        change(s, added);
    }
    for (uint32_t k = 0; k < s->missing.count; k++) {
        const uint32_t row = s->missing.items[k];
        s->weights[row]++;
        s->short_weight++;
        shift_outer(s, row, 1, UINT32_MAX);
        shift_inner(s, row, -1, UINT32_MAX);
    }
}

/// `weights` by row; NULL: 1 each.
static void begin(search *s, const int64_t *weights, const uint8_t *taken) {
    const sli_cover *c = s->cover;
    for (uint32_t r = 0; r < c->rows; r++) {
        s->rest[r] = c->demands[r];
        s->weights[r] = weights ? weights[r] : 1;
        if (s->rest[r] <= 0) continue;
        list_add(&s->missing, r);
        s->short_weight += s->weights[r];
    }
    for (uint32_t j = 0; j < c->columns; j++)
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++)
            if (s->rest[c->column_rows[i]] > 0) s->scores[j] += s->weights[c->column_rows[i]];
    for (uint32_t j = 0; j < c->columns; j++)
        if (taken[j]) change(s, j);
    memset(s->times, 0, c->columns * sizeof *s->times);
    memset(s->row_times, 0, c->rows * sizeof *s->row_times);
    s->time = 0;
}

static sl_status run(sl_context *context, search *s, uint64_t enough, uint64_t iterations,
                     uint8_t *taken) {
    uint64_t best = s->cost + 1, since = 0;
    for (uint64_t i = 0; i < iterations; i++) {
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(context));
        while (!s->missing.count) {
            if (s->cost < best) {
                best = s->cost;
                memset(taken, 0, s->cover->columns);
                for (uint32_t k = 0; k < s->in.count; k++) taken[s->in.items[k]] = 1;
                if (best <= enough) return SL_OK;
            }
            change(s, worst(s, UINT64_MAX));
            since = s->time;
        }
        step(s, best, &since);
    }
    return SL_OK;
}

static bool search_make(sl_context *context, search *s) {
    const sli_cover *c = s->cover;
    return list_make(context, c->columns, &s->in) && list_make(context, c->rows, &s->missing) &&
           (s->rest = sl_alloc_array(context, c->rows, sizeof *s->rest)) &&
           (s->weights = sl_alloc_array(context, c->rows, sizeof *s->weights)) &&
           (s->scores = sl_alloc_array(context, c->columns, sizeof *s->scores)) &&
           (s->row_times = sl_alloc_array(context, c->rows, sizeof *s->row_times)) &&
           (s->times = sl_alloc_array(context, c->columns, sizeof *s->times));
}

static void search_destroy(sl_context *context, search *s) {
    sl_free(context, s->in.items);
    sl_free(context, s->in.places);
    sl_free(context, s->missing.items);
    sl_free(context, s->missing.places);
    sl_free(context, s->rest);
    sl_free(context, s->weights);
    sl_free(context, s->scores);
    sl_free(context, s->row_times);
    sl_free(context, s->times);
}

sl_status sli_cover_search(sl_context *context, const sli_cover *cover, uint64_t enough,
                           uint64_t iterations, uint8_t *taken) {
    search s = {.cover = cover, .random = {1}};
    sl_status status = SL_NO_MEMORY;
    if (search_make(context, &s)) {
        begin(&s, NULL, taken);
        status = run(context, &s, enough, iterations, taken);
    }
    search_destroy(context, &s);
    return status;
}

// --- the most that so many columns cover

/// The column outside that gains most, among those that did not change since; UINT32_MAX where none
/// gains.
static uint32_t most_gain(const search *s, uint64_t since) {
    uint32_t best = UINT32_MAX;
    for (uint32_t j = 0; j < s->cover->columns; j++) {
        if (is_in(s, j) || s->scores[j] <= 0 || s->times[j] > since) continue;
        if (best == UINT32_MAX || s->scores[j] > s->scores[best] ||
            (s->scores[j] == s->scores[best] && s->times[j] < s->times[best]))
            best = j;
    }
    return best;
}

/// What came or went lately stays so: for a number of changes that is drawn each time, so that the
/// search does not go in circles (tabu search; Glover 1989).
static uint64_t some_changes_ago(search *s) {
    const uint64_t ago = 2 + sl_random_below(&s->random, 10);
    return s->time > ago ? s->time - ago : 0;
}

static sl_status run_most(sl_context *context, search *s, uint32_t count, uint64_t iterations,
                          uint8_t *taken) {
    int64_t best = INT64_MAX;
    for (uint64_t i = 0; i <= iterations; i++) {
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(context));
        while (s->in.count < count) {
            const uint32_t added = most_gain(s, i ? some_changes_ago(s) : UINT64_MAX);
            if (added == UINT32_MAX) break;
            change(s, added);
        }
        if (s->short_weight < best) {
            best = s->short_weight;
            memset(taken, 0, s->cover->columns);
            for (uint32_t k = 0; k < s->in.count; k++) taken[s->in.items[k]] = 1;
        }
        const uint32_t out = worst(s, some_changes_ago(s));
        if (best == 0 || !s->in.count) break;
        if (out != UINT32_MAX) change(s, out);
    }
    return SL_OK;
}

sl_status sli_cover_search_most(sl_context *context, const sli_cover *cover, const int64_t *weights,
                                uint32_t count, uint64_t iterations, uint8_t *taken) {
    search s = {.cover = cover, .random = {1}};
    sl_status status = SL_NO_MEMORY;
    if (search_make(context, &s)) {
        begin(&s, weights, taken);
        status = run_most(context, &s, count, iterations, taken);
    }
    search_destroy(context, &s);
    return status;
}
