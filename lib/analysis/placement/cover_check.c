/// Checks the proof of a lower bound of a set cover problem: code of its own, which trusts nothing
/// in the proof.
///
/// Steps first, one after the other, each in the problem that those before it left. Then the parts:
/// no column that is left covers rows of two. Then the trees: a walk from each root, which visits
/// no node twice, with what is taken and left on the way. A leaf that says too much only gets the
/// bound that its duals do prove. What makes no sense (an index too large, a sum beyond 128 bits)
/// proves nothing: the bound is 0. Where a part is split or has cuts, another problem stands for it
/// (cover_check_parts.c), whose proof is checked in the same way. A row that is several times in a
/// column has that coefficient there.
///
/// Cost: for each step, the lists of its two rows or columns; for each leaf, the entries of its
/// part.
#include "analysis/placement/cover_check.h"
#include "base/wide.h"
#include "sightline/set_cover.h"
#include "sightline/support.h"

enum { FREE, LEFT, TAKEN };

/// An inner node on the way down.
typedef struct frame {
    uint32_t node;
    int next;     ///< the child that comes next
    bool decided; ///< the column is, for the child before it
} frame;

/// Bounds of the state by some duals; they hold as long as no column that counts in them changes.
typedef struct sum {
    bool holds;
    size_t duals;
    sli_wide more, less; ///< the bound is more - less
    sli_wide *worth;     ///< by column: the duals of its rows with demand
} sum;

typedef struct checker {
    const sl_cover_problem *problem;
    const sl_cover_proof *proof;
    bool *row_gone, *column_gone;
    uint8_t *decided;                   ///< by column, on the way down
    int64_t *rest;                      ///< by row: demand less what is taken
    int64_t *free;                      ///< by row: columns that are neither gone nor decided
    uint32_t *rows, *columns;           ///< what is left, by part, ascending
    size_t *rows_first, *columns_first; ///< by part, and two more
    size_t *places;                     ///< by row: where its dual is in those of its part
    uint32_t *column_parts;             ///< by column; UINT32_MAX for none
    bool *visited;                      ///< by node
    uint32_t divisor;                   ///< of all costs
    uint64_t taken;                     ///< cost of what is taken, by steps and on the way down
    sum sum;
    SL_ARRAY(frame) way;
} checker;

static uint32_t cost_of(const sl_cover_problem *p, uint32_t column) {
    return p->costs ? p->costs[column] : 1;
}

static size_t parts_of(const sl_cover_proof *p) {
    return (size_t)p->part_count + p->split_count + p->raised_count;
}

// --- sums of 128 bits

static bool add(sli_wide *a, sli_wide b) {
    const uint64_t low = a->low + b.low, carry = low < b.low;
    const uint64_t high = a->high + b.high;
    const bool fits = high >= b.high && high + carry >= high;
    *a = (sli_wide){high + carry, low};
    return fits;
}

/// The least multiple of `divisor` that is not below a / denominator; UINT64_MAX beyond.
static uint64_t round_up(sli_wide a, uint64_t denominator, uint32_t divisor) {
    uint64_t low = 0, high = UINT64_MAX / divisor;
    if (sli_wide_compare(sli_wide_product(high * divisor, denominator), a) < 0) return UINT64_MAX;
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (sli_wide_compare(sli_wide_product(middle * divisor, denominator), a) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low * divisor;
}

// --- steps

static bool has_row(const checker *c, uint32_t column, uint32_t row) {
    const sl_cover_problem *p = c->problem;
    size_t low = sli_checked_begin(p, column), high = p->ends[column];
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (p->entries[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low < p->ends[column] && p->entries[low] == row;
}

/// Without a row no set costs more: a bound stays a bound, whatever the row was dropped for.
static bool row_goes(checker *c, uint32_t what) {
    if (what >= c->problem->row_count || c->row_gone[what]) return false;
    c->row_gone[what] = true;
    return true;
}

static bool column_goes(checker *c, uint32_t what, uint32_t by) {
    const sl_cover_problem *p = c->problem;
    if (what >= p->column_count || by >= p->column_count || what == by) return false;
    if (c->column_gone[what] || c->column_gone[by] || cost_of(p, by) > cost_of(p, what))
        return false;
    for (size_t i = sli_checked_begin(p, what); i < p->ends[what]; i++) {
        const uint32_t row = p->entries[i];
        if (!c->row_gone[row] && (c->rest[row] > 1 || !has_row(c, by, row))) return false;
    }
    c->column_gone[what] = true;
    for (size_t i = sli_checked_begin(p, what); i < p->ends[what]; i++) c->free[p->entries[i]]--;
    return true;
}

static bool column_taken(checker *c, uint32_t what, uint32_t by) {
    const sl_cover_problem *p = c->problem;
    if (what >= p->column_count || by >= p->row_count || c->column_gone[what] || c->row_gone[by])
        return false;
    if (!has_row(c, what, by) || c->free[by] > c->rest[by]) return false;
    c->column_gone[what] = true;
    for (size_t i = sli_checked_begin(p, what); i < p->ends[what]; i++) {
        const uint32_t row = p->entries[i];
        c->free[row]--;
        if (!c->row_gone[row] && --c->rest[row] == 0) c->row_gone[row] = true;
    }
    c->taken += cost_of(p, what);
    return true;
}

static bool follow_steps(checker *c) {
    const sl_cover_problem *p = c->problem;
    for (uint32_t r = 0; r < p->row_count; r++) {
        c->rest[r] = p->demands ? p->demands[r] : 1;
        c->row_gone[r] = c->rest[r] == 0;
    }
    for (uint32_t i = 0; i < c->proof->step_count; i++) {
        const sl_cover_step s = c->proof->steps[i];
        const bool holds = s.kind == SL_COVER_ROW_GOES       ? row_goes(c, s.what)
                           : s.kind == SL_COVER_COLUMN_GOES  ? column_goes(c, s.what, s.by)
                           : s.kind == SL_COVER_COLUMN_TAKEN ? column_taken(c, s.what, s.by)
                                                             : false;
        if (!holds) return false;
    }
    return true;
}

// --- parts

/// The part of each column that is left; false where one has rows of two.
static bool find_column_parts(checker *c) {
    const sl_cover_problem *p = c->problem;
    for (uint32_t j = 0; j < p->column_count; j++) {
        c->column_parts[j] = UINT32_MAX;
        for (size_t i = sli_checked_begin(p, j); i < p->ends[j] && !c->column_gone[j]; i++) {
            if (c->row_gone[p->entries[i]]) continue;
            const uint32_t part = c->proof->parts[p->entries[i]];
            if (c->column_parts[j] != UINT32_MAX && c->column_parts[j] != part) return false;
            c->column_parts[j] = part;
        }
    }
    return true;
}

/// Lists rows and columns by part.
static bool follow_parts(checker *c) {
    const sl_cover_problem *p = c->problem;
    const uint64_t parts = parts_of(c->proof);
    for (uint32_t r = 0; r < p->row_count; r++) {
        if (c->row_gone[r]) continue;
        if (c->proof->parts[r] >= parts) return false;
        c->rows_first[(size_t)c->proof->parts[r] + 2]++;
    }
    if (!find_column_parts(c)) return false;
    for (uint32_t j = 0; j < p->column_count; j++)
        if (c->column_parts[j] != UINT32_MAX) c->columns_first[(size_t)c->column_parts[j] + 2]++;
    for (uint32_t k = 0; k < parts; k++) {
        c->rows_first[k + 2] += c->rows_first[k + 1];
        c->columns_first[k + 2] += c->columns_first[k + 1];
    }
    // The start of a part is one place behind, where it moves while the part is filled.
    for (uint32_t r = 0; r < p->row_count; r++)
        if (!c->row_gone[r]) c->rows[c->rows_first[(size_t)c->proof->parts[r] + 1]++] = r;
    for (uint32_t j = 0; j < p->column_count; j++)
        if (c->column_parts[j] != UINT32_MAX)
            c->columns[c->columns_first[(size_t)c->column_parts[j] + 1]++] = j;
    for (uint32_t k = 0; k < parts; k++)
        for (size_t i = c->rows_first[k]; i < c->rows_first[k + 1]; i++)
            c->places[c->rows[i]] = i - c->rows_first[k];
    return true;
}

// --- trees

static sli_wide price_of(const checker *c, uint32_t column) {
    return sli_wide_product(cost_of(c->problem, column), c->proof->denominator);
}

static void decide(checker *c, uint32_t column, uint8_t how) {
    const sl_cover_problem *p = c->problem;
    const bool was = c->decided[column] == TAKEN, is = how == TAKEN;
    if (was || is || sli_wide_compare(c->sum.worth[column], price_of(c, column)) > 0)
        c->sum.holds = false;
    c->taken += is ? cost_of(p, column) : 0;
    c->taken -= was ? cost_of(p, column) : 0;
    for (size_t i = sli_checked_begin(p, column); i < p->ends[column]; i++) {
        c->free[p->entries[i]] += (how == FREE) - (c->decided[column] == FREE);
        c->rest[p->entries[i]] += was - is;
    }
    c->decided[column] = how;
}

/// Sums up what the duals of a node prove of the state; false where they prove nothing.
static bool sum_up(checker *c, uint32_t part, size_t duals) {
    const sl_cover_problem *p = c->problem;
    const size_t size = c->rows_first[part + 1] - c->rows_first[part];
    if (c->sum.holds && c->sum.duals == duals) return true;
    if (duals > c->proof->dual_count || c->proof->dual_count - duals < size) return false;
    const uint64_t *y = c->proof->duals + duals;
    c->sum.more = sli_wide_product(c->taken, c->proof->denominator);
    c->sum.less = (sli_wide){0, 0};
    c->sum.holds = false;
    for (size_t i = c->rows_first[part]; i < c->rows_first[part + 1]; i++) {
        const uint32_t row = c->rows[i];
        if (c->rest[row] > 0 &&
            !add(&c->sum.more, sli_wide_product(y[c->places[row]], (uint64_t)c->rest[row])))
            return false;
    }
    for (size_t i = c->columns_first[part]; i < c->columns_first[part + 1]; i++) {
        const uint32_t column = c->columns[i];
        sli_wide *worth = &c->sum.worth[column];
        *worth = (sli_wide){0, 0};
        for (size_t k = sli_checked_begin(p, column); k < p->ends[column]; k++)
            if (!c->row_gone[p->entries[k]] && c->rest[p->entries[k]] > 0 &&
                !add(worth, (sli_wide){0, y[c->places[p->entries[k]]]}))
                return false;
        if (c->decided[column] != FREE || sli_wide_compare(*worth, price_of(c, column)) <= 0)
            continue;
        if (!add(&c->sum.less, sli_wide_difference(*worth, price_of(c, column)))) return false;
    }
    c->sum.holds = true;
    c->sum.duals = duals;
    return true;
}

/// The bound of the sums, and `more`.
static uint64_t bound_of(const checker *c, sli_wide more) {
    if (!add(&more, c->sum.more) || sli_wide_compare(more, c->sum.less) <= 0) return 0;
    return round_up(sli_wide_difference(more, c->sum.less), c->proof->denominator, c->divisor);
}

static uint64_t bound_of_leaf(checker *c, uint32_t part, size_t duals) {
    for (size_t i = c->rows_first[part]; i < c->rows_first[part + 1]; i++)
        if (c->rest[c->rows[i]] > c->free[c->rows[i]] && c->rest[c->rows[i]] > 0) return UINT64_MAX;
    if (duals == SIZE_MAX) return c->taken;
    return sum_up(c, part, duals) ? bound_of(c, (sli_wide){0, 0}) : 0;
}

/// The bound where a column is taken, or is not, and no node says more.
static uint64_t bound_without_node(checker *c, uint32_t part, const sl_cover_node *node, int way) {
    const sl_cover_problem *p = c->problem;
    for (size_t i = sli_checked_begin(p, node->column); i < p->ends[node->column] && !way; i++) {
        const uint32_t row = p->entries[i];
        if (!c->row_gone[row] && c->rest[row] > 0 && c->rest[row] > c->free[row] - 1)
            return UINT64_MAX;
    }
    if (node->duals == SIZE_MAX || !sum_up(c, part, node->duals)) return 0;
    const sli_wide worth = c->sum.worth[node->column], price = price_of(c, node->column);
    const int order = sli_wide_compare(worth, price);
    const sli_wide more = way && order < 0    ? sli_wide_difference(price, worth)
                          : !way && order > 0 ? sli_wide_difference(worth, price)
                                              : (sli_wide){0, 0};
    return bound_of(c, more);
}

/// Comes to a node: an inner one is put on the way, a leaf lowers the bound. False where the node
/// makes no sense.
static sl_status enter(sl_context *context, checker *c, uint32_t part, uint32_t at, uint64_t *bound,
                       bool *sense) {
    *sense = at < c->proof->node_count && !c->visited[at];
    if (!*sense) return SL_OK;
    const sl_cover_node *node = &c->proof->nodes[at];
    c->visited[at] = true;
    if (node->column == UINT32_MAX) {
        const uint64_t leaf = bound_of_leaf(c, part, node->duals);
        if (leaf < *bound) *bound = leaf;
        return SL_OK;
    }
    *sense = node->column < c->problem->column_count && c->column_parts[node->column] == part &&
             c->decided[node->column] == FREE;
    SL_TRY(SL_ARRAY_ROOM(context, &c->way, 1));
    c->way.items[c->way.count++] = (frame){at, 0, false};
    return SL_OK;
}

static sl_status walk(sl_context *context, checker *c, uint32_t part, uint64_t *bound) {
    bool sense;
    *bound = UINT64_MAX;
    c->sum.holds = false;
    SL_TRY(enter(context, c, part, part, bound, &sense));
    for (uint32_t steps = 0; sense && c->way.count; steps++) {
        if (steps % 256 == 0) SL_TRY(sl_check_cancelled(context));
        frame *f = &c->way.items[c->way.count - 1];
        const sl_cover_node *node = &c->proof->nodes[f->node];
        if (f->decided) decide(c, node->column, FREE);
        f->decided = false;
        if (f->next == 2) {
            c->way.count--;
            continue;
        }
        const int way = f->next++;
        if (node->children[way] == UINT32_MAX) {
            const uint64_t missing = bound_without_node(c, part, node, way);
            if (missing < *bound) *bound = missing;
            continue;
        }
        f->decided = true;
        decide(c, node->column, way ? TAKEN : LEFT);
        SL_TRY(enter(context, c, part, node->children[way], bound, &sense));
    }
    if (!sense) *bound = 0;
    return SL_OK;
}

// --- parts that other problems stand for

/// The part by itself, with what steps left: rows by their places, costs divided.
static sl_status make_part(sl_context *context, const checker *c, size_t part,
                           sli_made_problem *out) {
    const sl_cover_problem *p = c->problem;
    const size_t rows = c->rows_first[part + 1] - c->rows_first[part];
    const size_t columns = c->columns_first[part + 1] - c->columns_first[part];
    SL_TRY(SL_ARRAY_ROOM(context, &out->demands, rows));
    SL_TRY(SL_ARRAY_ROOM(context, &out->ends, columns));
    SL_TRY(SL_ARRAY_ROOM(context, &out->costs, columns));
    for (size_t i = c->rows_first[part]; i < c->rows_first[part + 1]; i++)
        out->demands.items[out->demands.count++] = (uint32_t)c->rest[c->rows[i]];
    for (size_t i = c->columns_first[part]; i < c->columns_first[part + 1]; i++) {
        const uint32_t column = c->columns[i];
        const size_t first = sli_checked_begin(p, column), end = p->ends[column];
        SL_TRY(SL_ARRAY_ROOM(context, &out->entries, end - first));
        for (size_t k = first; k < end; k++)
            if (!c->row_gone[p->entries[k]])
                out->entries.items[out->entries.count++] = (uint32_t)c->places[p->entries[k]];
        out->ends.items[out->ends.count++] = out->entries.count;
        out->costs.items[out->costs.count++] = cost_of(p, column) / c->divisor;
    }
    return SL_OK;
}

static sl_status check(sl_context *context, const sl_cover_problem *problem,
                       const sl_cover_proof *proof, bool repeats, uint64_t *lower);

/// The bound of a part by the copies of its columns, or by its cuts.
static sl_status check_other(sl_context *context, const checker *c, const sl_cover_problem *part,
                             const sl_cover_split *split, const sl_cover_cuts *cuts,
                             sli_made_problem *other, uint64_t *bound) {
    const sl_cover_proof *rest = split ? split->rest : cuts->rest;
    const uint64_t unit = split ? split->unit : 1;
    bool sense;
    *bound = 0;
    if (!rest || rest->split_count || rest->raised_count || (cuts && rest->step_count))
        return SL_OK;
    SL_TRY(split ? sli_make_copies(context, part, split, other, &sense)
                 : sli_make_raised(context, part, cuts, other, &sense));
    if (!sense) return SL_OK;
    const sl_cover_problem problem = sli_made(other);
    SL_TRY(check(context, &problem, rest, cuts, bound));
    *bound = *bound / unit + (*bound % unit > 0);
    *bound = *bound > UINT64_MAX / c->divisor ? UINT64_MAX : *bound * c->divisor;
    return SL_OK;
}

/// The bound of the part with such a number, behind those with trees.
static sl_status check_without_tree(sl_context *context, const checker *c, uint32_t number,
                                    uint64_t *bound) {
    const sl_cover_proof *p = c->proof;
    sli_made_problem made = {0}, other = {0};
    sl_status status = make_part(context, c, (size_t)p->part_count + number, &made);
    const sl_cover_problem part = sli_made(&made);
    if (status == SL_OK && number < p->split_count)
        status = check_other(context, c, &part, &p->splits[number], NULL, &other, bound);
    else if (status == SL_OK)
        status = check_other(context, c, &part, NULL, &p->raised[number - p->split_count], &other,
                             bound);
    sli_made_destroy(context, &made);
    sli_made_destroy(context, &other);
    return status;
}

/// Adds up the bounds of the parts; 0 from one that makes no sense, and then nothing else is asked.
static sl_status check_parts(sl_context *context, checker *c, uint64_t *lower) {
    uint64_t all = c->taken;
    c->taken = 0;
    for (uint32_t part = 0; part < c->proof->part_count; part++) {
        uint64_t bound;
        SL_TRY(walk(context, c, part, &bound));
        if (c->way.count) return SL_OK; // the way down made no sense
        all = all + bound < all ? UINT64_MAX : all + bound;
    }
    for (uint32_t i = 0; i < c->proof->split_count + c->proof->raised_count; i++) {
        uint64_t bound;
        SL_TRY(check_without_tree(context, c, i, &bound));
        all = all + bound < all ? UINT64_MAX : all + bound;
    }
    *lower = all;
    return SL_OK;
}

/// Counts the columns of rows, and finds the greatest common divisor of costs (Euclid).
static void count(checker *c) {
    const sl_cover_problem *p = c->problem;
    for (uint32_t j = 0; j < p->column_count; j++) {
        uint32_t a = cost_of(p, j);
        while (a) {
            const uint32_t rest = c->divisor % a;
            c->divisor = a;
            a = rest;
        }
        for (size_t i = sli_checked_begin(p, j); i < p->ends[j]; i++) c->free[p->entries[i]]++;
    }
}

static bool make(sl_context *context, checker *c) {
    const size_t rows = c->problem->row_count, columns = c->problem->column_count;
    const size_t parts = parts_of(c->proof);
    return (c->row_gone = sl_alloc_array(context, rows, sizeof *c->row_gone)) &&
           (c->column_gone = sl_alloc_array(context, columns, sizeof *c->column_gone)) &&
           (c->decided = sl_alloc_array(context, columns, sizeof *c->decided)) &&
           (c->rest = sl_alloc_array(context, rows, sizeof *c->rest)) &&
           (c->free = sl_alloc_array(context, rows, sizeof *c->free)) &&
           (c->rows = sl_alloc_array(context, rows, sizeof *c->rows)) &&
           (c->columns = sl_alloc_array(context, columns, sizeof *c->columns)) &&
           (c->rows_first = sl_alloc_array(context, parts + 2, sizeof *c->rows_first)) &&
           (c->columns_first = sl_alloc_array(context, parts + 2, sizeof *c->columns_first)) &&
           (c->places = sl_alloc_array(context, rows, sizeof *c->places)) &&
           (c->column_parts = sl_alloc_array(context, columns, sizeof *c->column_parts)) &&
           (c->visited = sl_alloc_array(context, c->proof->node_count, sizeof *c->visited)) &&
           (c->sum.worth = sl_alloc_array(context, columns, sizeof *c->sum.worth));
}

static void destroy(sl_context *context, checker *c) {
    sl_free(context, c->row_gone);
    sl_free(context, c->column_gone);
    sl_free(context, c->decided);
    sl_free(context, c->rest);
    sl_free(context, c->free);
    sl_free(context, c->rows);
    sl_free(context, c->columns);
    sl_free(context, c->rows_first);
    sl_free(context, c->columns_first);
    sl_free(context, c->places);
    sl_free(context, c->column_parts);
    sl_free(context, c->visited);
    sl_free(context, c->sum.worth);
    sl_free(context, c->way.items);
}

/// `repeats`: rows may be in a column several times.
static sl_status check_problem(sl_context *context, const sl_cover_problem *p, bool repeats) {
    size_t at = 0;
    for (uint32_t j = 0; j < p->column_count; at = p->ends[j++]) {
        if (p->ends[j] < at) return sl_fail(context, SL_BAD_ARGUMENT, "column %u ends early", j);
        if (!cost_of(p, j)) return sl_fail(context, SL_BAD_ARGUMENT, "column %u costs nothing", j);
        for (size_t i = at; i < p->ends[j]; i++)
            if (p->entries[i] >= p->row_count ||
                (i > at && p->entries[i] < p->entries[i - 1] + !repeats))
                return sl_fail(context, SL_BAD_ARGUMENT,
                               "column %u: rows are below %u and ascending", j, p->row_count);
    }
    return SL_OK;
}

static sl_status check(sl_context *context, const sl_cover_problem *problem,
                       const sl_cover_proof *proof, bool repeats, uint64_t *lower) {
    checker c = {.problem = problem, .proof = proof};
    SL_TRY(check_problem(context, problem, repeats));
    *lower = 0;
    if (proof->row_count != problem->row_count || !proof->denominator ||
        proof->part_count > proof->node_count)
        return SL_OK;
    sl_status status = SL_NO_MEMORY;
    if (make(context, &c)) {
        count(&c);
        status = SL_OK;
        if (follow_steps(&c) && follow_parts(&c)) status = check_parts(context, &c, lower);
    }
    destroy(context, &c);
    return status;
}

sl_status sl_cover_check(sl_context *context, const sl_cover_problem *problem,
                         const sl_cover_proof *proof, uint64_t *lower) {
    return check(context, problem, proof, false, lower);
}
