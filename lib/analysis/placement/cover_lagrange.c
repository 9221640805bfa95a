/// Lagrangian search: duals whose bound is close to that of the linear program, without one (Held,
/// Wolfe and Crowder 1974; Beasley 1990; Caprara, Fischetti and Toth 1999).
///
/// With a price u for each row, a column is worth taking where its rows' prices pass its cost.
/// Where these columns cover a row too often, its price is too high; where too seldom, too low. So
/// prices move along demand less cover, in steps that become shorter when the bound goes up and
/// down.
///
/// Of many columns only few matter: the core holds those that are cheap by prices, and some for
/// each row. Every so often all columns are priced, which gives a bound of the whole problem and
/// the next core. Cost: an iteration takes time for the entries of the core.
#include "analysis/placement/cover.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Iterations between two pricings, and between two looks at the length of steps.
enum { PRICING = 25, LOOK = 20, COLUMNS_A_ROW = 6, PATIENCE = 250, GREEDY = 4 };

/// How much of its course the search keeps from step to step (Crowder 1976): without it, steps go
/// to and fro across the valley, and the bound stays far below.
static const double kept_course = 0.7;

/// A core is worth its trouble from so many columns on.
enum { MANY_COLUMNS = 1500 };

typedef struct priced {
    double cost;
    uint32_t column;
} priced;

typedef struct ascent {
    const sli_cover *cover;
    const sli_cover_state *state;
    uint64_t upper;
    uint32_t *all, *core; ///< free columns
    uint32_t all_count, core_count;
    double *u, *best_u;      ///< by row
    double *costs;           ///< by column: reduced
    double *slopes, *course; ///< by row
    double *values;          ///< by column
    priced *order;           ///< room for sorting
    bool *chosen;            ///< by column
    double best, step, base;
} ascent;

static int compare_priced(const void *left, const void *right) {
    const priced *a = left, *b = right;
    if (a->cost != b->cost) return a->cost < b->cost ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

static double price(const ascent *a, uint32_t column) {
    const sli_cover *c = a->cover;
    double cost = c->costs[column];
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++)
        cost -= a->u[c->column_rows[i]]; // 0 for a row without demand
    return cost;
}

/// The bound of the columns in a list, which get their reduced costs.
static double bound_of(ascent *a, const uint32_t *list, uint32_t count) {
    double bound = a->base;
    for (uint32_t r = 0; r < a->cover->rows; r++)
        if (a->state->rest[r] > 0) bound += a->u[r] * (double)a->state->rest[r];
    for (uint32_t k = 0; k < count; k++) {
        a->costs[list[k]] = price(a, list[k]);
        if (a->costs[list[k]] < 0) bound += a->costs[list[k]];
    }
    return bound;
}

static void choose(ascent *a, uint32_t column) {
    if (a->chosen[column]) return;
    a->chosen[column] = true;
    a->core[a->core_count++] = column;
}

/// The cheapest columns of each row.
static void choose_by_rows(ascent *a) {
    const sli_cover *c = a->cover;
    for (uint32_t r = 0; r < c->rows; r++) {
        if (a->state->rest[r] <= 0) continue;
        uint32_t count = 0;
        const uint32_t most = COLUMNS_A_ROW + (uint32_t)a->state->rest[r];
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++) {
            const uint32_t j = c->row_columns[k];
            if (a->state->fixed[j] != SLI_COVER_FREE) continue;
            // Kept sorted, as the lists are short.
            const priced p = {a->costs[j], j};
            if (count == most && compare_priced(&p, &a->order[count - 1]) > 0) continue;
            uint32_t at = count < most ? count++ : count - 1;
            for (; at && compare_priced(&p, &a->order[at - 1]) < 0; at--)
                a->order[at] = a->order[at - 1];
            a->order[at] = p;
        }
        for (uint32_t k = 0; k < count; k++) choose(a, a->order[k].column);
    }
}

/// Keeps prices that are the best so far. Their bound is that of all columns.
static void keep(ascent *a, double bound) {
    if (bound <= a->best) return;
    a->best = bound;
    memcpy(a->best_u, a->u, a->cover->rows * sizeof *a->u);
}

/// Prices all columns, and makes the core.
static void price_all(ascent *a) {
    keep(a, bound_of(a, a->all, a->all_count));
    if (a->core == a->all) return;
    for (uint32_t k = 0; k < a->core_count; k++) a->chosen[a->core[k]] = false;
    a->core_count = 0;
    for (uint32_t k = 0; k < a->all_count; k++)
        if (a->costs[a->all[k]] < 0.001 * a->cover->costs[a->all[k]]) choose(a, a->all[k]);
    choose_by_rows(a);
}

/// One step along the slopes. Returns the bound of the core before it.
static double move(ascent *a) {
    const sli_cover *c = a->cover;
    const double bound = bound_of(a, a->core, a->core_count);
    if (a->core == a->all) keep(a, bound);
    double square = 0;
    for (uint32_t r = 0; r < c->rows; r++)
        a->slopes[r] = a->state->rest[r] > 0 ? (double)a->state->rest[r] : 0;
    for (uint32_t k = 0; k < a->core_count; k++) {
        const uint32_t j = a->core[k];
        const bool taken = a->costs[j] < 0;
        a->values[j] += 0.05 * (taken - a->values[j]);
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1] && taken; i++)
            a->slopes[c->column_rows[i]] -= 1;
    }
    for (uint32_t r = 0; r < c->rows; r++) {
        if (a->state->rest[r] <= 0) continue;
        if (a->slopes[r] < 0 && a->u[r] <= 0) a->slopes[r] = 0; // it stays at 0
        a->course[r] = kept_course * a->course[r] + (1 - kept_course) * a->slopes[r];
        square += a->course[r] * a->course[r];
    }
    if (square == 0) return bound;
    const double length = a->step * (1.05 * (double)a->upper - bound) / square;
    for (uint32_t r = 0; r < c->rows; r++)
        if (a->state->rest[r] > 0) a->u[r] = fmax(0, a->u[r] + length * a->course[r]);
    return bound;
}

/// Steps become shorter where the bound goes up and down, and longer where it hardly moves.
static void look(ascent *a, double least, double most) {
    const double size = fmax(1, fabs(most));
    if (most - least > 0.01 * size)
        a->step *= 0.5;
    else if (most - least < 0.001 * size)
        a->step *= 1.5;
}

static sl_status better_set(sl_context *context, ascent *a, uint8_t *scratch, uint8_t *set) {
    memset(scratch, 0, a->cover->columns);
    SL_TRY(sli_cover_greedy(context, a->cover, a->u, NULL, scratch));
    const uint64_t cost = sli_cover_cost(a->cover, scratch);
    if (cost < sli_cover_cost(a->cover, set)) memcpy(set, scratch, a->cover->columns);
    if (cost < a->upper) a->upper = cost;
    return SL_OK;
}

static bool is_enough(const ascent *a) {
    return a->best > (double)a->upper - 1 + 1e-7;
}

static sl_status climb(sl_context *context, ascent *a, uint64_t iterations, uint8_t *scratch,
                       uint8_t *set) {
    double least = INFINITY, most = -INFINITY, before = -INFINITY;
    for (uint64_t i = 0; i < iterations; i++) {
        if (i % PRICING == 0) {
            SL_TRY(sl_check_cancelled(context));
            if (a->core != a->all) price_all(a);
            if (set && i && i % (PRICING * GREEDY) == 0)
                SL_TRY(better_set(context, a, scratch, set));
        }
        if (is_enough(a)) return SL_OK;
        if (i % PATIENCE == PATIENCE - 1) {
            if (a->best < before + fmax(0.0005 * fabs(before), 1e-3) || a->step < 1e-5) break;
            before = a->best;
        }
        const double bound = move(a);
        least = fmin(least, bound);
        most = fmax(most, bound);
        if (i % LOOK != LOOK - 1) continue;
        look(a, least, most);
        least = INFINITY;
        most = -INFINITY;
    }
    price_all(a);
    return SL_OK;
}

/// Without prices to start from, a row is worth the least that one of its columns asks for it.
static void begin_prices(ascent *a, const double *duals) {
    const sli_cover *c = a->cover;
    bool any = false;
    for (uint32_t r = 0; r < c->rows; r++) any |= duals[r] > 0;
    for (uint32_t r = 0; r < c->rows; r++) {
        a->u[r] = 0;
        if (a->state->rest[r] <= 0) continue;
        if (any) {
            a->u[r] = fmax(0, duals[r]);
            continue;
        }
        double least = INFINITY;
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++) {
            const uint32_t j = c->row_columns[k];
            if (a->state->fixed[j] != SLI_COVER_FREE) continue;
            least =
                fmin(least, c->costs[j] / (double)(c->column_first[j + 1] - c->column_first[j]));
        }
        a->u[r] = isfinite(least) ? least : 0;
    }
}

sl_status sli_cover_lagrange(sl_context *context, const sli_cover *cover,
                             const sli_cover_state *state, uint64_t upper, uint64_t iterations,
                             double *duals, double *values, uint8_t *set) {
    ascent a = {.cover = cover, .state = state, .upper = upper, .step = 0.1, .values = values};
    a.base = (double)state->taken;
    a.best = -INFINITY;
    a.all = sl_alloc_array(context, cover->columns, sizeof *a.all);
    uint32_t *core = sl_alloc_array(context, cover->columns, sizeof *core);
    a.u = sl_alloc_array(context, cover->rows, sizeof *a.u);
    a.costs = sl_alloc_array(context, cover->columns, sizeof *a.costs);
    a.slopes = sl_alloc_array(context, cover->rows, sizeof *a.slopes);
    a.course = sl_alloc_array(context, cover->rows, sizeof *a.course);
    a.order = sl_alloc_array(context, cover->columns, sizeof *a.order);
    a.chosen = sl_alloc_array(context, cover->columns, sizeof *a.chosen);
    uint8_t *scratch = sl_alloc_array(context, cover->columns, sizeof *scratch);
    sl_status status = SL_NO_MEMORY;
    if (a.all && core && a.u && a.costs && a.slopes && a.course && a.order && a.chosen && scratch) {
        begin_prices(&a, duals);
        a.best_u = duals;
        for (uint32_t j = 0; j < cover->columns; j++)
            if (state->fixed[j] == SLI_COVER_FREE) a.all[a.all_count++] = j;
        const bool many = a.all_count > MANY_COLUMNS;
        a.core = many ? core : a.all;
        a.core_count = many ? 0 : a.all_count;
        status = climb(context, &a, iterations, scratch, set);
    }
    sl_free(context, a.all);
    sl_free(context, core);
    sl_free(context, a.u);
    sl_free(context, a.costs);
    sl_free(context, a.slopes);
    sl_free(context, a.course);
    sl_free(context, a.order);
    sl_free(context, a.chosen);
    sl_free(context, scratch);
    return status;
}
