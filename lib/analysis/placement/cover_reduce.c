/// Reductions of a set cover problem: rows and columns that decide nothing go, before any search.
///
///     row i goes      where every column that covers row j covers i too, and i demands no more:
///                     who covers j covers i by the way
///     column c goes   where column d covers all rows of c and costs no more, and these rows demand
///                     one column each: d may stand for c in any set
///     column c is taken  where a row of it demands all the columns that it has
///
/// Each step shortens lists, which allows others; so they go on until nothing changes. Only lists
/// that became shorter are looked at again: a set can become a subset of another by losing
/// something, not by what the other one loses.
///
/// The supersets of a set are sought among those that share its rarest element, by size, then by a
/// signature of 64 bits (a bit for each element, by hash), then element by element. The steps are
/// kept in their order, for the proof: each can be checked in the problem that those before it
/// left.
#include "analysis/placement/cover.h"

#include <string.h>

/// Sets of one way of the matrix: the rows of columns, or the columns of rows.
typedef struct sets {
    uint32_t count, *lengths, *items;
    const size_t *first;
    uint64_t *signs;
    bool *there, *changed;
} sets;

typedef struct reducer {
    const sli_cover *cover;
    sli_cover_left *left;
    sets columns, rows;
    bool plain; ///< every row demands one column at most
} reducer;

static sl_status sets_make(sl_context *context, uint32_t count, const size_t *first,
                           const uint32_t *items, bool *there, sets *out) {
    out->count = count;
    out->first = first;
    out->there = there;
    out->lengths = sl_alloc_array(context, count, sizeof *out->lengths);
    out->items = sl_alloc_array(context, first[count], sizeof *out->items);
    out->signs = sl_alloc_array(context, count, sizeof *out->signs);
    out->changed = sl_alloc_array(context, count, sizeof *out->changed);
    if (!out->lengths || !out->items || !out->signs || !out->changed) return SL_NO_MEMORY;
    if (first[count]) memcpy(out->items, items, first[count] * sizeof *items);
    for (uint32_t i = 0; i < count; i++) {
        out->lengths[i] = (uint32_t)(first[i + 1] - first[i]);
        out->there[i] = out->changed[i] = true;
    }
    return SL_OK;
}

static void sets_destroy(sl_context *context, sets *s) {
    sl_free(context, s->lengths);
    sl_free(context, s->items);
    sl_free(context, s->signs);
    sl_free(context, s->changed);
}

/// Takes out of all sets what is gone, and signs them.
static void tidy(sets *s, const sets *others) {
    for (uint32_t i = 0; i < s->count; i++) {
        if (!s->there[i]) continue;
        uint32_t *items = s->items + s->first[i], kept = 0;
        uint64_t sign = 0;
        for (uint32_t k = 0; k < s->lengths[i]; k++) {
            if (!others->there[items[k]]) continue;
            sign |= (uint64_t)1 << ((items[k] * 0x9e3779b97f4a7c15u) >> 58);
            items[kept++] = items[k];
        }
        if (kept != s->lengths[i]) s->changed[i] = true;
        s->lengths[i] = kept;
        s->signs[i] = sign;
    }
}

static bool is_subset(const sets *s, uint32_t a, uint32_t b) {
    if (s->lengths[a] > s->lengths[b] || (s->signs[a] & ~s->signs[b])) return false;
    const uint32_t *x = s->items + s->first[a], *y = s->items + s->first[b];
    const uint32_t *x_end = x + s->lengths[a], *y_end = y + s->lengths[b];
    while (x < x_end) {
        while (y < y_end && *y < *x) y++;
        if (y == y_end || *y != *x) return false;
        x++;
        y++;
    }
    return true;
}

/// The element of a set, not an empty one, that the fewest sets have.
static uint32_t rarest(const sets *s, const sets *others, uint32_t set) {
    const uint32_t *items = s->items + s->first[set];
    uint32_t best = items[0];
    for (uint32_t k = 1; k < s->lengths[set]; k++)
        if (others->lengths[items[k]] < others->lengths[best]) best = items[k];
    return best;
}

static sl_status add_step(sl_context *context, reducer *r, sl_cover_step_kind kind, uint32_t what,
                          uint32_t by) {
    SL_TRY(SL_ARRAY_ROOM(context, &r->left->steps, 1));
    r->left->steps.items[r->left->steps.count++] = (sl_cover_step){kind, what, by};
    return SL_OK;
}

// --- rows

/// Drops the rows that row j implies.
static sl_status imply(sl_context *context, reducer *r, uint32_t j) {
    const sets *rows = &r->rows;
    const uint32_t *rest = r->left->rest;
    const uint32_t column = rarest(rows, &r->columns, j);
    const uint32_t *among = r->columns.items + r->columns.first[column];
    for (uint32_t k = 0; k < r->columns.lengths[column]; k++) {
        const uint32_t i = among[k];
        if (i == j || !rows->there[i] || rest[i] > rest[j] || !is_subset(rows, j, i)) continue;
        // Of two that are the same, the first one stays.
        if (i < j && rest[i] == rest[j] && rows->lengths[i] == rows->lengths[j]) continue;
        SL_TRY(add_step(context, r, SL_COVER_ROW_GOES, i, j));
        rows->there[i] = false;
    }
    return SL_OK;
}

static sl_status drop_rows(sl_context *context, reducer *r) {
    for (uint32_t j = 0; j < r->rows.count; j++) {
        if (j % 64 == 0) SL_TRY(sl_check_cancelled(context));
        if (!r->rows.there[j] || !r->rows.changed[j]) continue;
        r->rows.changed[j] = false;
        SL_TRY(imply(context, r, j));
    }
    return SL_OK;
}

// --- columns

static bool demands_once(const reducer *r, uint32_t column) {
    const uint32_t *rows = r->columns.items + r->columns.first[column];
    for (uint32_t k = 0; k < r->columns.lengths[column] && !r->plain; k++)
        if (r->left->rest[rows[k]] > 1) return false;
    return true;
}

/// A column that may stand for this one; the column itself for none.
static uint32_t substitute(const reducer *r, uint32_t c) {
    const sets *columns = &r->columns;
    const uint32_t *costs = r->cover->costs, row = rarest(columns, &r->rows, c);
    const uint32_t *among = r->rows.items + r->rows.first[row];
    for (uint32_t k = 0; k < r->rows.lengths[row]; k++) {
        const uint32_t d = among[k];
        if (d == c || !columns->there[d] || costs[d] > costs[c] || !is_subset(columns, c, d))
            continue;
        if (d > c && costs[d] == costs[c] && columns->lengths[d] == columns->lengths[c]) continue;
        return d;
    }
    return c;
}

static sl_status drop_columns(sl_context *context, reducer *r) {
    for (uint32_t c = 0; c < r->columns.count; c++) {
        if (c % 64 == 0) SL_TRY(sl_check_cancelled(context));
        if (!r->columns.there[c] || !r->columns.changed[c]) continue;
        r->columns.changed[c] = false;
        if (!r->columns.lengths[c]) { // of no use: not in the way of the proof, either
            r->columns.there[c] = false;
            continue;
        }
        if (!demands_once(r, c)) continue;
        const uint32_t d = substitute(r, c);
        if (d == c) continue;
        SL_TRY(add_step(context, r, SL_COVER_COLUMN_GOES, c, d));
        r->columns.there[c] = false;
    }
    return SL_OK;
}

// --- what must be taken

static sl_status take(sl_context *context, reducer *r, uint32_t column, uint32_t row) {
    SL_TRY(add_step(context, r, SL_COVER_COLUMN_TAKEN, column, row));
    r->left->taken[column] = 1;
    r->columns.there[column] = false;
    const uint32_t *rows = r->columns.items + r->columns.first[column];
    for (uint32_t k = 0; k < r->columns.lengths[column]; k++)
        if (r->rows.there[rows[k]] && !--r->left->rest[rows[k]]) r->rows.there[rows[k]] = false;
    return SL_OK;
}

/// Takes what rows demand that have no more; says whether there was any.
static sl_status take_essential(sl_context *context, reducer *r, bool *any) {
    *any = false;
    for (uint32_t row = 0; row < r->rows.count; row++) {
        if (!r->rows.there[row]) continue;
        const uint32_t *columns = r->rows.items + r->rows.first[row];
        uint32_t there = 0;
        for (uint32_t k = 0; k < r->rows.lengths[row]; k++) there += r->columns.there[columns[k]];
        if (there > r->left->rest[row]) continue;
        *any = true;
        for (uint32_t k = 0; k < r->rows.lengths[row]; k++)
            if (r->columns.there[columns[k]]) SL_TRY(take(context, r, columns[k], row));
    }
    // With demands above one, a column that is taken also changes what may be compared.
    if (*any && !r->plain) {
        memset(r->rows.changed, 1, r->rows.count);
        memset(r->columns.changed, 1, r->columns.count);
    }
    return SL_OK;
}

static sl_status run(sl_context *context, reducer *r) {
    for (size_t before = SIZE_MAX; before != r->left->steps.count;) {
        before = r->left->steps.count;
        bool any = true;
        while (any) {
            tidy(&r->columns, &r->rows);
            tidy(&r->rows, &r->columns);
            SL_TRY(take_essential(context, r, &any));
        }
        SL_TRY(drop_columns(context, r));
        tidy(&r->rows, &r->columns);
        SL_TRY(drop_rows(context, r));
    }
    return SL_OK;
}

void sli_cover_left_destroy(sl_context *context, sli_cover_left *l) {
    sl_free(context, l->steps.items);
    sl_free(context, l->row_there);
    sl_free(context, l->column_there);
    sl_free(context, l->rest);
    sl_free(context, l->taken);
    *l = (sli_cover_left){0};
}

sl_status sli_cover_reduce(sl_context *context, const sli_cover *cover, sli_cover_left *out) {
    sli_cover_left l = {0};
    reducer r = {.cover = cover, .left = &l, .plain = true};
    l.row_there = sl_alloc_array(context, cover->rows, sizeof *l.row_there);
    l.column_there = sl_alloc_array(context, cover->columns, sizeof *l.column_there);
    l.rest = sl_alloc_array(context, cover->rows, sizeof *l.rest);
    l.taken = sl_alloc_array(context, cover->columns, sizeof *l.taken);
    sl_status status = l.row_there && l.column_there && l.rest && l.taken ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = sets_make(context, cover->columns, cover->column_first, cover->column_rows,
                           l.column_there, &r.columns);
    if (status == SL_OK)
        status = sets_make(context, cover->rows, cover->row_first, cover->row_columns, l.row_there,
                           &r.rows);
    if (status == SL_OK) {
        for (uint32_t i = 0; i < cover->rows; i++) {
            l.rest[i] = cover->demands[i];
            l.row_there[i] = l.rest[i] > 0;
            r.plain &= l.rest[i] <= 1;
        }
        status = run(context, &r);
    }
    sets_destroy(context, &r.columns);
    sets_destroy(context, &r.rows);
    if (status == SL_OK)
        *out = l;
    else
        sli_cover_left_destroy(context, &l);
    return status;
}
