/// The matrix of a set cover problem, what is decided of it, and the bound that duals prove.
///
/// For any y >= 0, a set of columns that covers all rows costs at least
///
///     sum over rows of y * demand - sum over columns of max(0, sum of y over its rows - cost)
///
/// since each column taken pays for its rows, and one that is worth more than it costs is taken at
/// most once. So no y is wrong: duals of a linear program, rounded to integers over a common
/// denominator, lose a little of the bound and nothing of its truth.
#include "analysis/placement/cover.h"

#include <string.h>

sl_status sli_cover_make(sl_context *context, uint32_t rows, uint32_t columns, size_t entries,
                         sli_cover *out) {
    sli_cover c = {.rows = rows, .columns = columns};
    c.column_first = sl_alloc_array(context, (size_t)columns + 1, sizeof *c.column_first);
    c.row_first = sl_alloc_array(context, (size_t)rows + 2, sizeof *c.row_first);
    c.column_rows = sl_alloc_array(context, entries, sizeof *c.column_rows);
    c.row_columns = sl_alloc_array(context, entries, sizeof *c.row_columns);
    c.costs = sl_alloc_array(context, columns, sizeof *c.costs);
    c.demands = sl_alloc_array(context, rows, sizeof *c.demands);
    if (!c.column_first || !c.row_first || !c.column_rows || !c.row_columns || !c.costs ||
        !c.demands) {
        sli_cover_destroy(context, &c);
        return SL_NO_MEMORY;
    }
    *out = c;
    return SL_OK;
}

void sli_cover_turn(sli_cover *c) {
    const size_t entries = c->column_first[c->columns];
    memset(c->row_first, 0, ((size_t)c->rows + 2) * sizeof *c->row_first);
    // The start of a row is kept one place behind, where it moves while the row is filled.
    for (size_t i = 0; i < entries; i++) c->row_first[(size_t)c->column_rows[i] + 2]++;
    for (uint32_t r = 0; r < c->rows; r++) c->row_first[r + 2] += c->row_first[r + 1];
    for (uint32_t j = 0; j < c->columns; j++)
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++)
            c->row_columns[c->row_first[(size_t)c->column_rows[i] + 1]++] = j;
}

void sli_cover_destroy(sl_context *context, sli_cover *c) {
    sl_free(context, c->column_first);
    sl_free(context, c->row_first);
    sl_free(context, c->column_rows);
    sl_free(context, c->row_columns);
    sl_free(context, c->costs);
    sl_free(context, c->demands);
    *c = (sli_cover){0};
}

sl_cover_problem sli_cover_problem(const sli_cover *c) {
    return (sl_cover_problem){c->rows,        c->columns, c->column_first + 1,
                              c->column_rows, c->costs,   c->demands};
}

// --- what is decided

sl_status sli_cover_state_make(sl_context *context, const sli_cover *c, sli_cover_state *out) {
    sli_cover_state s = {0};
    s.fixed = sl_alloc_array(context, c->columns, sizeof *s.fixed);
    s.rest = sl_alloc_array(context, c->rows, sizeof *s.rest);
    s.free = sl_alloc_array(context, c->rows, sizeof *s.free);
    if (!s.fixed || !s.rest || !s.free) {
        sli_cover_state_destroy(context, &s);
        return SL_NO_MEMORY;
    }
    for (uint32_t r = 0; r < c->rows; r++) {
        s.rest[r] = c->demands[r];
        s.free[r] = (uint32_t)(c->row_first[r + 1] - c->row_first[r]);
    }
    *out = s;
    return SL_OK;
}

void sli_cover_state_destroy(sl_context *context, sli_cover_state *s) {
    sl_free(context, s->fixed);
    sl_free(context, s->rest);
    sl_free(context, s->free);
    *s = (sli_cover_state){0};
}

void sli_cover_fix(const sli_cover *c, sli_cover_state *s, uint32_t column, uint8_t how) {
    s->fixed[column] = how;
    if (how == SLI_COVER_IN) s->taken += c->costs[column];
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++) {
        s->free[c->column_rows[i]]--;
        s->rest[c->column_rows[i]] -= how == SLI_COVER_IN;
    }
}

void sli_cover_unfix(const sli_cover *c, sli_cover_state *s, uint32_t column) {
    const bool in = s->fixed[column] == SLI_COVER_IN;
    s->fixed[column] = SLI_COVER_FREE;
    if (in) s->taken -= c->costs[column];
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++) {
        s->free[c->column_rows[i]]++;
        s->rest[c->column_rows[i]] += in;
    }
}

uint64_t sli_cover_cost(const sli_cover *c, const uint8_t *taken) {
    uint64_t cost = 0;
    for (uint32_t j = 0; j < c->columns; j++)
        if (taken[j]) cost += c->costs[j];
    return cost;
}

// --- bounds

uint64_t sli_cover_denominator(const sli_cover *c) {
    double all = 0, demands = 0, most = 1;
    for (uint32_t j = 0; j < c->columns; j++) {
        all += c->costs[j];
        if (c->costs[j] > most) most = c->costs[j];
    }
    for (uint32_t r = 0; r < c->rows; r++) demands += c->demands[r];
    // A column is worth at most its rows' duals, each below the largest cost: the sum of all that
    // is lost is below that of all entries.
    const double size = all + (demands + (double)c->column_first[c->columns]) * most;
    uint64_t denominator = (uint64_t)1 << 31;
    while (denominator && (double)denominator * size > 0x1p60) denominator /= 2;
    return denominator;
}

int64_t sli_cover_bound(const sli_cover *c, const sli_cover_state *s, const uint64_t *duals,
                        uint64_t denominator, int64_t *sums) {
    int64_t bound = (int64_t)(s->taken * denominator);
    for (uint32_t r = 0; r < c->rows; r++)
        if (s->rest[r] > 0) bound += (int64_t)duals[r] * s->rest[r];
    for (uint32_t j = 0; j < c->columns; j++) {
        int64_t sum = 0;
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++)
            if (s->rest[c->column_rows[i]] > 0) sum += (int64_t)duals[c->column_rows[i]];
        const int64_t lost = sum - (int64_t)(c->costs[j] * denominator);
        if (lost > 0 && s->fixed[j] == SLI_COVER_FREE) bound -= lost;
        if (sums) sums[j] = sum;
    }
    return bound;
}

void sli_cover_duals_round(const sli_cover *c, const double *duals, uint64_t denominator,
                           uint64_t *out) {
    uint32_t most = 0;
    for (uint32_t j = 0; j < c->columns; j++)
        if (c->costs[j] > most) most = c->costs[j];
    for (uint32_t r = 0; r < c->rows; r++) {
        const double y = duals[r];
        out[r] = !(y > 0)    ? 0
                 : y >= most ? most * denominator
                             : (uint64_t)(y * (double)denominator);
    }
}

uint64_t sli_cover_ceiling(int64_t numerator, uint64_t denominator) {
    if (numerator <= 0) return 0;
    return ((uint64_t)numerator + denominator - 1) / denominator;
}
