/// The column that a tree branches on: the one for which taking and leaving both raise the bound
/// most. That is tried out, in the beginning of a tree, and later told from what was tried
/// (reliability branching; Achterberg, Koch and Martin 2005). Without a program, columns that it
/// takes in part by Lagrangian steps stand for that.
#include "analysis/placement/cover_tree.h"

#include <math.h>
#include <stdlib.h>

typedef sli_cover_tree tree;
typedef sli_cover_effect effect;
typedef sli_cover_prospect prospect;

/// So many columns are tried out at a node at most, so many that do not better the best one follow
/// each other at most, and a column is known after so many times.
enum { MOST_TRIED = 24, MOST_VAIN = 8, KNOWN = 4 };

static const double whole = 1e-6;

/// By how much the bound rises if a column is left (0) or taken (1).
static sl_status try_way(sl_context *context, tree *t, uint32_t column, int way, int64_t bound,
                         double *gain) {
    const uint64_t d = t->part->denominator;
    const uint64_t work = 1 + SLI_COVER_NODE_WORK / (1 + t->cover->column_first[t->cover->columns]);
    *gain = 0;
    sli_cover_fix(t->cover, &t->state, column, way ? SLI_COVER_IN : SLI_COVER_OUT);
    sl_status status = t->part->options->program->again(context, t->program, t->state.fixed, work,
                                                        (double)t->target - 1 + whole, t->tried_y,
                                                        t->tried_values);
    if (status == SL_OK) {
        sli_cover_duals_round(t->cover, t->tried_y, d, t->tried_duals);
        const int64_t tried = sli_cover_bound(t->cover, &t->state, t->tried_duals, d, NULL);
        if (tried > bound) *gain = (double)(tried - bound) / (double)d;
    }
    sli_cover_unfix(t->cover, &t->state, column);
    return status == SL_UNSUPPORTED ? SL_OK : status;
}

/// Both ways count: the product.
static double score_of(const tree *t, uint32_t column) {
    const effect *e = t->effects[column].tries ? &t->effects[column] : &t->all_effects;
    const double value = t->values[column], tries = e->tries ? e->tries : 1;
    return fmax(e->sums[0] / tries * value, 1e-6) * fmax(e->sums[1] / tries * (1 - value), 1e-6);
}

static sl_status try_out(sl_context *context, tree *t, uint32_t column, int64_t bound,
                         double *score) {
    const double shares[] = {t->values[column], 1 - t->values[column]};
    double gains[2];
    for (int way = 0; way < 2; way++) {
        if (!sli_cover_pay(t)) return SL_OK;
        SL_TRY(try_way(context, t, column, way, bound, &gains[way]));
    }
    for (int way = 0; way < 2; way++) {
        t->effects[column].sums[way] += gains[way] / shares[way];
        t->all_effects.sums[way] += gains[way] / shares[way];
    }
    t->effects[column].tries++;
    t->all_effects.tries++;
    *score = fmax(gains[0], 1e-6) * fmax(gains[1], 1e-6);
    return SL_OK;
}

static int compare_prospects(const void *left, const void *right) {
    const prospect *a = left, *b = right;
    if (a->score != b->score) return a->score > b->score ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

/// The column whose branches promise most; UINT32_MAX where the program takes none in part.
static sl_status choose_by_effect(sl_context *context, tree *t, int64_t bound, uint32_t *best) {
    size_t count = 0;
    for (uint32_t j = 0; j < t->cover->columns; j++)
        if (t->state.fixed[j] == SLI_COVER_FREE && t->values[j] > 0.01 && t->values[j] < 0.99)
            t->prospects[count++] = (prospect){score_of(t, j), j};
    *best = UINT32_MAX;
    if (!count) return SL_OK;
    qsort(t->prospects, count, sizeof *t->prospects, compare_prospects);
    double most = 0;
    int tried = 0, vain = 0;
    for (size_t i = 0; i < count && vain < MOST_VAIN; i++, vain++) {
        prospect p = t->prospects[i];
        if (t->effects[p.column].tries < KNOWN && tried++ < MOST_TRIED)
            SL_TRY(try_out(context, t, p.column, bound, &p.score));
        if (p.score <= most) continue;
        most = p.score;
        *best = p.column;
        vain = -1;
    }
    return SL_OK;
}

/// The column that is worth most to the row with the fewest columns.
static uint32_t choose_by_row(const tree *t) {
    const sli_cover *c = t->cover;
    uint32_t best = UINT32_MAX, row = UINT32_MAX;
    for (uint32_t r = 0; r < c->rows; r++)
        if (t->state.rest[r] > 0 && (row == UINT32_MAX || t->state.free[r] < t->state.free[row]))
            row = r;
    for (size_t k = c->row_first[row]; k < c->row_first[row + 1]; k++) {
        const uint32_t j = c->row_columns[k];
        if (t->state.fixed[j] == SLI_COVER_FREE &&
            (best == UINT32_MAX || t->sums[j] > t->sums[best]))
            best = j;
    }
    return best;
}

/// Without a program, the column of which it takes most, but not all, by Lagrangian steps.
static uint32_t choose_by_value(const tree *t) {
    uint32_t best = UINT32_MAX;
    double most = 0.01;
    for (uint32_t j = 0; j < t->cover->columns; j++) {
        if (t->state.fixed[j] != SLI_COVER_FREE || !t->sums[j]) continue;
        if (t->values[j] > most && t->values[j] < 1 - whole) {
            best = j;
            most = t->values[j];
        }
    }
    return best;
}

sl_status sli_cover_choose(sl_context *context, sli_cover_tree *t, int64_t bound, uint32_t *best) {
    *best = UINT32_MAX;
    if (t->program) SL_TRY(choose_by_effect(context, t, bound, best));
    if (*best == UINT32_MAX) *best = choose_by_value(t);
    if (*best == UINT32_MAX) *best = choose_by_row(t);
    return SL_OK;
}
