/// Cuts: rows that every set fulfils, and the linear program does not (Chvatal 1973; Caprara and
/// Fischetti 1996).
///
/// Some rows are added up, and the sum is halved. A set takes each column whole, so every
/// coefficient may be rounded up, and then the demand:
///
///     a + b     >= 1
///         b + c >= 1     sum: 2a + 2b + 2c >= 3     half, rounded up: a + b + c >= 2
///     a     + c >= 1
///
/// The program takes a, b and c by half, which is no longer enough. What a cut gains is the
/// rounding of the demand, less what the rows have over and less the values of columns whose
/// coefficients are rounded: rows with an odd demand in all are sought for which these two are
/// below 1. Modulo 2 that is an elimination: columns with large values go first, each by a row that
/// has little over (Koster, Zymolka and Kutschka 2009). Cuts may be made of cuts.
///
/// A coefficient above 1 is an entry that repeats. So bounds and trees need not know of cuts: each
/// adds up the duals of a column's entries.
///
/// Cost: a round takes time for the rows that have little over, times the columns that the program
/// takes in part; and the steps of the program.
#include "analysis/placement/cover.h"
#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Cuts made in a round, rows that one is made of, and rounds without much gain.
enum { CUTS_A_ROUND = 300, MOST_ROWS = 20, PATIENCE = 5 };
/// The largest demand of a cut, and entries of the program.
enum { MOST_DEMAND = 64, MOST_ENTRIES = 1 << 23 };
/// Simplex steps times entries that the program may take for a round.
enum { PROGRAM_WORK = 1 << 30 };
/// What rows may have over and coefficients lose together; what a cut must gain; and what a bound
/// must, in PATIENCE rounds, of a cost of 1.
static const double most_lost = 0.95, least_broken = 0.02, gain_share = 0.05;
static const double rounding = 1e-7, loose = 1e-4;

/// Rows added up, modulo 2.
typedef struct combination {
    double over; ///< what these rows have over
    uint32_t count;
    uint32_t rows[MOST_ROWS];
    bool odd;  ///< the demand
    bool gone; ///< it stood for a column, or lost too much
} combination;

typedef struct entry {
    uint32_t column, coefficient;
} entry;

typedef struct cutter {
    sl_context *context;
    const sli_cover *plain;
    sli_cover_cuts *out; ///< all cuts that were made
    SL_ARRAY(size_t) entry_ends;
    SL_ARRAY(entry) entries; ///< by cut
    SL_ARRAY(uint32_t) demands;
    SL_ARRAY(uint32_t) active; ///< cuts that are rows of the program now, ascending
    const sl_cover_program *program;
    void *state;               ///< of the program
    sl_cover_problem *problem; ///< that it has
    const uint8_t *fixed;      ///< by column
    double least_gain;         ///< in costs of the program
    double *duals, *values;    ///< by row of the program, by column
    uint32_t *sums;            ///< by column, 0 each
    uint32_t *live;            ///< columns of values over 0, the largest first
    uint32_t *bits;            ///< by column: its place there
    uint32_t live_count;
    combination *all;
    uint64_t *odd; ///< by combination: columns with an odd sum, `words` each
    size_t count, words;
} cutter;

/// The number of a row of the program: cuts are behind the rows of the part.
static uint32_t name_of(const cutter *c, uint32_t row) {
    return row < c->plain->rows ? row : c->plain->rows + c->active.items[row - c->plain->rows];
}

static size_t entries_from(const cutter *c, uint32_t cut) {
    return cut ? c->entry_ends.items[cut - 1] : 0;
}

// --- sums of rows

/// Adds a row, by its name, to c->sums. Returns its demand.
static uint32_t add_up(cutter *c, uint32_t name) {
    const sli_cover *p = c->plain;
    if (name < p->rows) {
        for (size_t k = p->row_first[name]; k < p->row_first[name + 1]; k++)
            c->sums[p->row_columns[k]]++;
        return p->demands[name];
    }
    const uint32_t cut = name - p->rows;
    for (size_t k = entries_from(c, cut); k < c->entry_ends.items[cut]; k++)
        c->sums[c->entries.items[k].column] += c->entries.items[k].coefficient;
    return c->demands.items[cut];
}

/// Makes a cut of c->sums, and clears them. *broken: by how much the values miss it.
static sl_status halve(cutter *c, uint32_t demand, double *broken) {
    const uint32_t half = demand / 2 + demand % 2;
    *broken = half;
    for (uint32_t j = 0; j < c->plain->columns; j++) {
        if (!c->sums[j]) continue;
        uint32_t coefficient = c->sums[j] / 2 + c->sums[j] % 2;
        if (coefficient > half) coefficient = half;
        c->sums[j] = 0;
        *broken -= c->values[j] * coefficient;
        SL_TRY(SL_ARRAY_ROOM(c->context, &c->entries, 1));
        c->entries.items[c->entries.count++] = (entry){j, coefficient};
    }
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->entry_ends, 1));
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->demands, 1));
    c->entry_ends.items[c->entry_ends.count++] = c->entries.count;
    c->demands.items[c->demands.count++] = half;
    return SL_OK;
}

/// Whether a cut from `first` on is made of the same rows.
static bool is_known(const cutter *c, uint32_t first, const uint32_t *rows, uint32_t count) {
    for (size_t i = first; i < c->out->ends.count; i++) {
        const size_t from = i ? c->out->ends.items[i - 1] : 0;
        if (c->out->ends.items[i] - from == count &&
            memcmp(c->out->rows.items + from, rows, count * sizeof *rows) == 0)
            return true;
    }
    return false;
}

/// Makes a cut of a combination, if the values break it; not twice in a round, whose first cut is
/// `first`.
static sl_status make_cut(cutter *c, const combination *from, uint32_t first) {
    uint32_t names[MOST_ROWS], demand = 0;
    double broken;
    for (uint32_t k = 0; k < from->count; k++) names[k] = name_of(c, from->rows[k]);
    qsort(names, from->count, sizeof *names, sli_compare_whole);
    if (is_known(c, first, names, from->count)) return SL_OK;
    const size_t before = c->entries.count;
    for (uint32_t k = 0; k < from->count; k++) demand += add_up(c, names[k]);
    SL_TRY(halve(c, demand, &broken));
    if (broken < least_broken || demand > 2 * MOST_DEMAND) {
        c->entries.count = before;
        c->entry_ends.count--;
        c->demands.count--;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->out->rows, from->count));
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->out->ends, 1));
    for (uint32_t k = 0; k < from->count; k++) c->out->rows.items[c->out->rows.count++] = names[k];
    c->out->ends.items[c->out->ends.count++] = c->out->rows.count;
    return SL_OK;
}

// --- elimination

typedef struct valued {
    double value;
    uint32_t column;
} valued;

static int compare_valued(const void *left, const void *right) {
    const valued *a = left, *b = right;
    if (a->value != b->value) return a->value > b->value ? -1 : 1;
    return (a->column > b->column) - (a->column < b->column);
}

static sl_status list_live(cutter *c) {
    valued *order = sl_alloc_array(c->context, c->plain->columns, sizeof *order);
    if (!order) return SL_NO_MEMORY;
    c->live_count = 0;
    for (uint32_t j = 0; j < c->plain->columns; j++) {
        c->bits[j] = UINT32_MAX;
        if (c->values[j] > rounding) order[c->live_count++] = (valued){c->values[j], j};
    }
    qsort(order, c->live_count, sizeof *order, compare_valued);
    for (uint32_t k = 0; k < c->live_count; k++) {
        c->live[k] = order[k].column;
        c->bits[order[k].column] = k;
    }
    sl_free(c->context, order);
    return SL_OK;
}

/// A row of the program as the first of a combination, where it has little over.
static void begin_combination(cutter *c, const sli_cover *cover, uint32_t row) {
    double over = -(double)cover->demands[row];
    for (size_t k = cover->row_first[row]; k < cover->row_first[row + 1]; k++)
        over += c->values[cover->row_columns[k]];
    if (over > most_lost / 2) return;
    uint64_t *odd = c->odd + c->count * c->words;
    memset(odd, 0, c->words * sizeof *odd);
    for (size_t k = cover->row_first[row]; k < cover->row_first[row + 1]; k++) {
        const uint32_t bit = c->bits[cover->row_columns[k]];
        if (bit != UINT32_MAX) odd[bit / 64] ^= (uint64_t)1 << bit % 64;
    }
    c->all[c->count++] = (combination){
        .over = fmax(over, 0), .count = 1, .rows = {row}, .odd = cover->demands[row] % 2};
}

static bool is_odd(const cutter *c, size_t i, uint32_t bit) {
    return c->odd[i * c->words + bit / 64] >> bit % 64 & 1;
}

/// Adds `by` to a combination: what is in both goes. Gone where it loses too much.
static void combine(cutter *c, size_t i, size_t by) {
    combination *to = &c->all[i];
    const combination *from = &c->all[by];
    to->over += from->over;
    to->odd ^= from->odd;
    for (size_t w = 0; w < c->words; w++) c->odd[i * c->words + w] ^= c->odd[by * c->words + w];
    for (uint32_t k = 0; k < from->count && !to->gone; k++) {
        uint32_t at = 0;
        while (at < to->count && to->rows[at] != from->rows[k]) at++;
        if (at < to->count)
            to->rows[at] = to->rows[--to->count];
        else if (to->count < MOST_ROWS)
            to->rows[to->count++] = from->rows[k];
        else
            to->gone = true;
    }
    to->gone |= to->over > most_lost;
}

/// What a combination loses: what its rows have over, and columns with an odd sum.
static double lost_by(const cutter *c, size_t i) {
    double lost = c->all[i].over;
    for (size_t w = 0; w < c->words && lost < most_lost; w++)
        for (uint64_t bits = c->odd[i * c->words + w], k = 64 * w; bits; bits >>= 1, k++)
            if (bits & 1) lost += c->values[c->live[k]];
    return lost;
}

/// The combination to clear a column by: little over, then few rows; SIZE_MAX for none.
static size_t pivot_of(const cutter *c, uint32_t bit) {
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < c->count; i++) {
        if (c->all[i].gone || !is_odd(c, i, bit)) continue;
        const combination *a = &c->all[i], *b = &c->all[best == SIZE_MAX ? i : best];
        if (best == SIZE_MAX || a->over < b->over - rounding ||
            (a->over < b->over + rounding && a->count < b->count))
            best = i;
    }
    return best;
}

static sl_status eliminate(cutter *c, uint32_t first) {
    for (uint32_t bit = 0; bit < c->live_count; bit++) {
        if (bit % 16 == 0) SL_TRY(sl_check_cancelled(c->context));
        const size_t pivot = pivot_of(c, bit);
        if (pivot == SIZE_MAX) continue;
        c->all[pivot].gone = true;
        for (size_t i = 0; i < c->count; i++) {
            if (c->all[i].gone || !is_odd(c, i, bit)) continue;
            combine(c, i, pivot);
            if (c->all[i].gone || !c->all[i].odd || lost_by(c, i) >= most_lost) continue;
            SL_TRY(make_cut(c, &c->all[i], first));
            if (c->out->ends.count - first == CUTS_A_ROUND) return SL_OK;
        }
    }
    return SL_OK;
}

/// Makes cuts that the values break.
static sl_status separate(cutter *c) {
    const sli_cover *cover = c->out->cover.rows ? &c->out->cover : c->plain;
    SL_TRY(list_live(c));
    c->words = ((size_t)c->live_count + 63) / 64;
    c->count = 0;
    c->all = sl_alloc_array(c->context, cover->rows, sizeof *c->all);
    c->odd = sl_alloc_array(c->context, cover->rows * c->words, sizeof *c->odd);
    sl_status status = c->all && c->odd ? SL_OK : SL_NO_MEMORY;
    for (uint32_t r = 0; r < cover->rows && status == SL_OK; r++) begin_combination(c, cover, r);
    if (status == SL_OK) status = eliminate(c, (uint32_t)c->out->ends.count);
    sl_free(c->context, c->all);
    sl_free(c->context, c->odd);
    return status;
}

// --- the problem with cuts

static size_t size_of(const sli_cover *cover) {
    return cover->column_first[cover->columns];
}

/// The part's rows, then the active cuts.
static sl_status extend(cutter *c, sli_cover *out) {
    const sli_cover *p = c->plain;
    const uint32_t count = (uint32_t)c->active.count;
    size_t entries = p->column_first[p->columns];
    size_t *ends = sl_alloc_array(c->context, p->columns, sizeof *ends);
    if (!ends) return SL_NO_MEMORY;
    for (uint32_t j = 0; j < p->columns; j++) ends[j] = p->column_first[j + 1] - p->column_first[j];
    for (uint32_t i = 0; i < count; i++)
        for (size_t k = entries_from(c, c->active.items[i]);
             k < c->entry_ends.items[c->active.items[i]]; k++) {
            ends[c->entries.items[k].column] += c->entries.items[k].coefficient;
            entries += c->entries.items[k].coefficient;
        }
    const sl_status status = sli_cover_make(c->context, p->rows + count, p->columns, entries, out);
    for (uint32_t j = 0; j < p->columns && status == SL_OK; j++) {
        const size_t own = p->column_first[j + 1] - p->column_first[j];
        out->column_first[j + 1] = out->column_first[j] + ends[j];
        ends[j] = out->column_first[j] + own;
        memcpy(out->column_rows + out->column_first[j], p->column_rows + p->column_first[j],
               own * sizeof *out->column_rows);
        out->costs[j] = p->costs[j];
    }
    for (uint32_t r = 0; r < p->rows && status == SL_OK; r++) out->demands[r] = p->demands[r];
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        const uint32_t cut = c->active.items[i];
        out->demands[p->rows + i] = c->demands.items[cut];
        for (size_t k = entries_from(c, cut); k < c->entry_ends.items[cut]; k++)
            for (uint32_t n = 0; n < c->entries.items[k].coefficient; n++)
                out->column_rows[ends[c->entries.items[k].column]++] = p->rows + i;
    }
    if (status == SL_OK) sli_cover_turn(out);
    sl_free(c->context, ends);
    return status;
}

/// Marks the cuts that a cut is made of.
static void need(const cutter *c, uint32_t cut, bool *needed) {
    for (size_t k = cut ? c->out->ends.items[cut - 1] : 0; k < c->out->ends.items[cut]; k++)
        if (c->out->rows.items[k] >= c->plain->rows)
            needed[c->out->rows.items[k] - c->plain->rows] = true;
}

/// Whether the values have more than a cut demands: then the bound does not rest on it, and the
/// program can do without it and keep its basis.
static bool is_loose(const cutter *c, uint32_t cut) {
    double over = -(double)c->demands.items[cut];
    for (size_t k = entries_from(c, cut); k < c->entry_ends.items[cut]; k++)
        over += c->values[c->entries.items[k].column] * c->entries.items[k].coefficient;
    return over > loose;
}

/// Loose cuts go from the program, unless one that stays is made of them; those from `first` on
/// come in. `gone`: by row of the program.
static sl_status renew(cutter *c, uint32_t first, bool *gone) {
    const uint32_t rows = c->plain->rows;
    size_t kept = 0;
    bool *needed = sl_alloc_array(c->context, c->out->ends.count, sizeof *needed);
    if (!needed) return SL_NO_MEMORY;
    for (uint32_t cut = first; cut < c->out->ends.count; cut++) need(c, cut, needed);
    for (size_t i = c->active.count; i-- > 0;) {
        const uint32_t cut = c->active.items[i];
        gone[rows + i] = !needed[cut] && is_loose(c, cut);
        if (!gone[rows + i]) need(c, cut, needed);
    }
    sl_free(c->context, needed);
    for (size_t i = 0; i < c->active.count; i++)
        if (!gone[rows + i]) c->active.items[kept++] = c->active.items[i];
    c->active.count = kept;
    for (uint32_t cut = first; cut < c->out->ends.count; cut++) {
        SL_TRY(SL_ARRAY_ROOM(c->context, &c->active, 1));
        c->active.items[c->active.count++] = cut;
    }
    return SL_OK;
}

/// Of all cuts the active ones stay, by the numbers that they have as rows.
static sl_status keep_active(cutter *c) {
    const uint32_t rows = c->plain->rows;
    sli_cover_cuts *o = c->out;
    uint32_t *names = sl_alloc_array(c->context, o->ends.count, sizeof *names);
    if (!names) return SL_NO_MEMORY;
    size_t to = 0;
    for (size_t i = 0; i < c->active.count; i++) {
        const uint32_t cut = c->active.items[i];
        names[cut] = rows + (uint32_t)i;
        const size_t end = o->ends.items[cut];
        for (size_t k = cut ? o->ends.items[cut - 1] : 0; k < end; k++) {
            const uint32_t row = o->rows.items[k];
            o->rows.items[to++] = row < rows ? row : names[row - rows];
        }
        o->ends.items[i] = to; // of a cut that was read already, or of none
    }
    o->ends.count = c->active.count;
    o->rows.count = to;
    sl_free(c->context, names);
    return SL_OK;
}

// --- rounds

static double cost_of(const cutter *c) {
    double cost = 0;
    for (uint32_t j = 0; j < c->plain->columns; j++) cost += c->values[j] * c->plain->costs[j];
    return cost;
}

/// Gives the program the active cuts, and runs it. *solved: it has found duals and values; else the
/// duals are those from before, 0 for what is new.
static sl_status run_program(cutter *c, const bool *gone, bool *solved) {
    sli_cover next = {0};
    SL_TRY(extend(c, &next));
    double *duals = sl_alloc_array(c->context, next.rows, sizeof *duals);
    sl_status status = duals ? SL_OK : SL_NO_MEMORY;
    for (uint32_t r = 0, to = 0; duals && r < c->problem->row_count; r++)
        if (!gone[r]) duals[to++] = c->duals[r];
    sli_cover_destroy(c->context, &c->out->cover);
    c->out->cover = next;
    *c->problem = sli_cover_problem(&c->out->cover);
    sl_free(c->context, c->duals);
    c->duals = duals;
    if (status == SL_OK) status = c->program->change(c->context, c->state, c->problem, gone);
    if (status == SL_OK)
        status = c->program->again(c->context, c->state, c->fixed,
                                   1 + PROGRAM_WORK / (1 + size_of(&next)), 0, duals, c->values);
    *solved = status == SL_OK;
    return status == SL_UNSUPPORTED ? SL_OK : status;
}

/// New cuts from `first` on, in place of those that do nothing.
static sl_status change_cuts(cutter *c, uint32_t first, bool *solved) {
    bool *gone = sl_alloc_array(c->context, c->problem->row_count, sizeof *gone);
    sl_status status = gone ? renew(c, first, gone) : SL_NO_MEMORY;
    if (status == SL_OK) status = run_program(c, gone, solved);
    sl_free(c->context, gone);
    return status;
}

static sl_status run(cutter *c, uint32_t rounds, double enough) {
    double before = cost_of(c);
    bool solved = true;
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < rounds && solved && cost_of(c) < enough; i++) {
        const uint32_t first = (uint32_t)c->out->ends.count;
        status = separate(c);
        if (status != SL_OK && status != SL_CANCELLED) return status;
        if (status == SL_CANCELLED || c->out->ends.count == first) break;
        SL_TRY(change_cuts(c, first, &solved));
        if (size_of(&c->out->cover) > MOST_ENTRIES) break;
        if (i % PATIENCE != PATIENCE - 1) continue;
        if (cost_of(c) < before + c->least_gain) break;
        before = cost_of(c);
    }
    SL_TRY(change_cuts(c, (uint32_t)c->out->ends.count, &solved));
    SL_TRY(keep_active(c));
    return status;
}

sl_status sli_cover_cut(sl_context *context, const sli_cover *plain,
                        const sl_cover_options *options, void *state, sl_cover_problem *problem,
                        const uint8_t *fixed, uint64_t enough, double unit, const double *duals,
                        double *values, sli_cover_cuts *out) {
    cutter c = {.context = context,
                .plain = plain,
                .program = options->program,
                .state = state,
                .problem = problem,
                .fixed = fixed,
                .least_gain = gain_share * unit,
                .values = values,
                .out = out};
    c.duals = sl_alloc_array(context, plain->rows, sizeof *c.duals);
    c.sums = sl_alloc_array(context, plain->columns, sizeof *c.sums);
    c.live = sl_alloc_array(context, plain->columns, sizeof *c.live);
    c.bits = sl_alloc_array(context, plain->columns, sizeof *c.bits);
    sl_status status = c.duals && c.sums && c.live && c.bits ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        memcpy(c.duals, duals, plain->rows * sizeof *duals);
        status = run(&c, options->cuts, (double)enough - 1 + rounding);
    }
    sl_free(context, c.entry_ends.items);
    sl_free(context, c.entries.items);
    sl_free(context, c.demands.items);
    sl_free(context, c.active.items);
    sl_free(context, c.duals);
    sl_free(context, c.sums);
    sl_free(context, c.live);
    sl_free(context, c.bits);
    return status;
}

void sli_cover_cuts_destroy(sl_context *context, sli_cover_cuts *cuts) {
    sl_free(context, cuts->ends.items);
    sl_free(context, cuts->rows.items);
    sli_cover_destroy(context, &cuts->cover);
    *cuts = (sli_cover_cuts){0};
}
