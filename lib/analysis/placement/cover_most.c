/// Maximum coverage: so many columns that cover the most weight, and a bound of it.
///
/// For any prices u >= 0 of rows, no set of n columns covers more than
///
///     sum over rows of max(0, weight - demand * u) + the n largest sums of u over a column's rows
///
/// as the weight of a covered row is paid for by what its columns are worth, up to its price. The
/// least of these bounds is that of the linear program; prices move towards it by subgradients, as
/// in cover_lagrange.c. The bound that counts is computed in integers: weights times a power of
/// two, rounded up; so it holds whatever the prices are.
#include "analysis/placement/cover.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct ranked {
    double worth;
    uint32_t column;
} ranked;

typedef struct most {
    const sli_cover *cover;
    const double *weights;
    uint32_t count;
    int exponent;     ///< integers are weights * 2^exponent
    int64_t *rounded; ///< weights, rounded up
    double *prices, *best, *slopes;
    ranked *order;
    int64_t *worths; ///< by column
    uint8_t *taken;
    uint32_t left; ///< rows of weight that `taken` does not cover, and others would
} most;

static int compare_ranks(const void *left, const void *right) {
    const ranked *a = left, *b = right;
    if (a->worth != b->worth) return a->worth > b->worth ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

static int compare_worths(const void *left, const void *right) {
    const int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
    return (a < b) - (a > b);
}

/// The bound of prices, rounded; leaves the columns that are worth most in front, and the slopes.
static double bound_of(most *m) {
    const sli_cover *c = m->cover;
    double bound = 0;
    for (uint32_t r = 0; r < c->rows; r++) {
        const double rest = m->weights[r] - c->demands[r] * m->prices[r];
        m->slopes[r] = rest > 0 ? -(double)c->demands[r] : 0;
        bound += fmax(0, rest);
    }
    for (uint32_t j = 0; j < c->columns; j++) {
        m->order[j] = (ranked){0, j};
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++)
            m->order[j].worth += m->prices[c->column_rows[i]];
    }
    qsort(m->order, c->columns, sizeof *m->order, compare_ranks);
    for (uint32_t k = 0; k < m->count && k < c->columns; k++) {
        const uint32_t j = m->order[k].column;
        bound += m->order[k].worth;
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++)
            m->slopes[c->column_rows[i]] += 1;
    }
    return bound;
}

/// Moves prices down where a row is covered too often, as long as the bound falls.
static sl_status descend(sl_context *context, most *m, double covered, uint64_t iterations) {
    const sli_cover *c = m->cover;
    double least = INFINITY, step = 1;
    uint64_t since = 0;
    for (uint64_t i = 0; i < iterations && step > 1e-4; i++) {
        if (i % 16 == 0) SL_TRY(sl_check_cancelled(context));
        const double bound = bound_of(m);
        if (bound < least) {
            if (bound < least - 1e-5 * fabs(least)) since = i;
            least = bound;
            memcpy(m->best, m->prices, c->rows * sizeof *m->best);
        }
        if (i - since >= 15) {
            step *= 0.6;
            since = i;
        }
        double square = 0;
        for (uint32_t r = 0; r < c->rows; r++) square += m->slopes[r] * m->slopes[r];
        if (square == 0 || bound <= covered) break;
        const double length = step * (bound - 0.99 * covered) / square;
        for (uint32_t r = 0; r < c->rows; r++)
            m->prices[r] = fmax(0, m->prices[r] - length * m->slopes[r]);
    }
    return SL_OK;
}

/// The bound of the best prices, in integers.
static double prove(most *m) {
    const sli_cover *c = m->cover;
    int64_t bound = 0;
    memset(m->worths, 0, c->columns * sizeof *m->worths);
    for (uint32_t r = 0; r < c->rows; r++) {
        const int64_t demand = c->demands[r], dearest = demand ? m->rounded[r] / demand : 0;
        int64_t price = (int64_t)ldexp(fmin(m->best[r], m->weights[r]), m->exponent);
        if (price > dearest) price = dearest;
        bound += m->rounded[r] - demand * price;
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++)
            m->worths[c->row_columns[k]] += price;
    }
    qsort(m->worths, c->columns, sizeof *m->worths, compare_worths);
    int64_t all = 0;
    for (uint32_t r = 0; r < c->rows; r++)
        if (c->row_first[r + 1] - c->row_first[r] >= c->demands[r]) all += m->rounded[r];
    for (uint32_t k = 0; k < m->count && k < c->columns && bound < all; k++) bound += m->worths[k];
    const double proven = ldexp((double)(bound < all ? bound : all), -m->exponent);
    return bound > 0 && all > 0 ? fmax(proven, DBL_MIN) : proven; // below, doubles lose bits
}

static double weigh(most *m) {
    const sli_cover *c = m->cover;
    double covered = 0;
    for (uint32_t r = 0; r < c->rows; r++) {
        uint32_t times = 0;
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++)
            times += m->taken[c->row_columns[k]];
        if (times >= c->demands[r])
            covered += m->weights[r];
        else if (m->weights[r] > 0 && c->row_first[r + 1] - c->row_first[r] >= c->demands[r])
            m->left++;
    }
    return covered;
}

/// Weights as integers: all of them together below 2^50, so that doubles hold each sum.
static sl_status round_weights(sl_context *context, most *m, bool *whole) {
    double all = 0;
    *whole = true;
    for (uint32_t r = 0; r < m->cover->rows; r++) {
        if (!isfinite(m->weights[r]) || m->weights[r] < 0)
            return sl_fail(context, SL_BAD_ARGUMENT, "the weight of row %u is no number from 0 on",
                           r);
        *whole &= m->weights[r] == floor(m->weights[r]);
        all += m->weights[r];
    }
    if (!isfinite(all)) return sl_fail(context, SL_BAD_ARGUMENT, "weights too large");
    int size;
    (void)frexp(all, &size);
    m->exponent = 50 - size;
    for (uint32_t r = 0; r < m->cover->rows; r++)
        m->rounded[r] = (int64_t)ceil(ldexp(m->weights[r], m->exponent));
    return SL_OK;
}

static bool make(sl_context *context, most *m) {
    const size_t rows = m->cover->rows, columns = m->cover->columns;
    return (m->rounded = sl_alloc_array(context, rows, sizeof *m->rounded)) &&
           (m->prices = sl_alloc_array(context, rows, sizeof *m->prices)) &&
           (m->best = sl_alloc_array(context, rows, sizeof *m->best)) &&
           (m->slopes = sl_alloc_array(context, rows, sizeof *m->slopes)) &&
           (m->order = sl_alloc_array(context, columns, sizeof *m->order)) &&
           (m->worths = sl_alloc_array(context, columns, sizeof *m->worths)) &&
           (m->taken = sl_alloc_array(context, columns, sizeof *m->taken));
}

static void destroy(sl_context *context, most *m) {
    sl_free(context, m->rounded);
    sl_free(context, m->prices);
    sl_free(context, m->best);
    sl_free(context, m->slopes);
    sl_free(context, m->order);
    sl_free(context, m->worths);
    sl_free(context, m->taken);
}

/// A set to start from, its first columns where it has too many.
static sl_status begin(sl_context *context, most *m, const sl_cover_options *o) {
    uint32_t taken = 0;
    for (uint32_t i = 0; i < o->start_count; i++) {
        if (o->start[i] >= m->cover->columns)
            return sl_fail(context, SL_BAD_ARGUMENT, "there is no column %u to start from",
                           o->start[i]);
        if (m->taken[o->start[i]] || taken == m->count) continue;
        m->taken[o->start[i]] = 1;
        taken++;
    }
    return SL_OK;
}

static sl_status keep_set(sl_context *context, const most *m, sl_cover_result *out) {
    uint32_t count = 0;
    uint32_t *columns = sl_alloc_array(context, m->cover->columns, sizeof *columns);
    if (!columns) return SL_NO_MEMORY;
    for (uint32_t j = 0; j < m->cover->columns; j++)
        if (m->taken[j]) columns[count++] = j;
    *out = (sl_cover_result){.count = count, .columns = columns, .cost = count};
    return SL_OK;
}

/// Iterations of the local search for each Lagrangian one, at most.
enum { LAGRANGIAN_SHARE = 50 };

sl_status sl_cover_most(sl_context *context, const sl_cover_problem *problem, const double *weights,
                        uint32_t count, const sl_cover_options *options, sl_cover_result *out,
                        double *covered, double *bound) {
    const sl_cover_options usual = sl_cover_options_default();
    if (!options) options = &usual;
    sli_cover cover;
    SL_TRY(sli_cover_read(context, problem, 0, &cover));
    most m = {.cover = &cover, .weights = weights, .count = count};
    bool whole = false;
    sl_status status = make(context, &m) ? round_weights(context, &m, &whole) : SL_NO_MEMORY;
    if (status == SL_OK) status = begin(context, &m, options);
    if (status == SL_OK)
        status =
            sli_cover_search_most(context, &cover, m.rounded, count, options->iterations, m.taken);
    const double seen = status == SL_OK || status == SL_CANCELLED ? weigh(&m) : 0;
    if (status == SL_OK)
        status = descend(context, &m, seen, options->iterations / LAGRANGIAN_SHARE);
    if (status == SL_OK || status == SL_CANCELLED) {
        const sl_status kept = keep_set(context, &m, out);
        if (kept == SL_OK) {
            const double most_weight = whole ? floor(prove(&m)) : prove(&m);
            *covered = seen;
            *bound = m.left ? fmax(most_weight, seen) : seen;
        } else {
            status = kept;
        }
    }
    destroy(context, &m);
    sli_cover_destroy(context, &cover);
    return status;
}
