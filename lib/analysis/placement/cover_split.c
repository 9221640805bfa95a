/// Splits of a part that is too large for a tree: many small problems in place of a large one.
///
/// Where a linear program takes columns by halves, as on odd cycles, its bound is too low, and each
/// such place of a large part adds to the gap. A tree would have to settle all of them together.
/// So the rows are put into blocks. A column has a copy in each block that it has rows of, and the
/// copies share its cost. No block knows of the others now: a small tree settles each.
///
///       rows of block 1 | rows of block 2        column j costs 1: its copies 0.6 and 0.4
///       ------+---------+-----+----------
///       j:    x  x      |     x
///
/// With shares after the duals of the linear program, the blocks' bounds add up to no less than its
/// own (Lagrangian decomposition; Guignard and Kim 1987). Then shares move: where the blocks take
/// some copies of a column and not the others, those taken become dearer.
///
/// Blocks grow along cheap columns: rows that share these are joined, those that share most first,
/// up to a size that trees can do with.
#include "analysis/placement/cover.h"

#include <stdlib.h>
#include <string.h>

/// Costs of copies are in units of 1 / UNIT; nodes of trees for each block, and turn. A part with
/// more entries takes long, and gains little.
enum { UNIT = 240, NODES_A_BLOCK = 600, MOST_ENTRIES = 1 << 15 };

/// What the linear program asks for a block, at most, in columns of the mean cost; and by how much
/// a column may be too dear to join rows. How much of a cost moves at first, and how much of this
/// is left by each turn.
static const double block_size = 8, dear = 0.1, first_step = 0.15, shorter = 0.9;

typedef struct tie {
    uint32_t a, b;
    double weight;
} tie;

typedef struct copy {
    uint32_t origin, block;
    double cost;
} copy;

typedef struct splitter {
    sl_context *context;
    const sli_cover *cover;
    const double *duals;
    SL_ARRAY(tie) ties;
    uint32_t *up; ///< by row
    double *size; ///< by row that leads a block
    uint32_t *blocks, block_count;
    SL_ARRAY(copy) copies;
    SL_ARRAY(size_t) ends; ///< by copy
    SL_ARRAY(uint32_t) entries;
    uint32_t *costs; ///< by copy
    bool *taken;     ///< by copy
} splitter;

void sli_cover_split_destroy(sl_context *context, sl_cover_split *s) {
    if (s->rest) sli_cover_proof_destroy(context, s->rest);
    sl_free(context, s->rest);
    sl_free(context, s->blocks);
    sl_free(context, s->costs);
    *s = (sl_cover_split){0};
}

// --- blocks

static int compare_ends(const void *left, const void *right) {
    const tie *x = left, *y = right;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    return (x->b > y->b) - (x->b < y->b);
}

static int compare_weights(const void *left, const void *right) {
    const tie *x = left, *y = right;
    if (x->weight != y->weight) return x->weight > y->weight ? -1 : 1;
    return compare_ends(left, right);
}

/// So that sums of weights do not hang on how equals are sorted.
static int compare_ties(const void *left, const void *right) {
    const int ends = compare_ends(left, right);
    return ends ? ends : compare_weights(left, right);
}

static double reduced_cost(const splitter *s, uint32_t column) {
    const sli_cover *c = s->cover;
    double cost = c->costs[column];
    for (size_t i = c->column_first[column]; i < c->column_first[column + 1]; i++)
        cost -= s->duals[c->column_rows[i]];
    return cost;
}

/// Pairs of rows that cheap columns cover, each once.
static sl_status find_ties(splitter *s) {
    const sli_cover *c = s->cover;
    for (uint32_t j = 0; j < c->columns; j++) {
        const size_t first = c->column_first[j], end = c->column_first[j + 1];
        const double cost = reduced_cost(s, j) / c->costs[j];
        if (cost > dear || end < first + 2) continue;
        SL_TRY(SL_ARRAY_ROOM(s->context, &s->ties, (end - first) * (end - first - 1) / 2));
        for (size_t i = first; i < end; i++)
            for (size_t k = i + 1; k < end; k++)
                s->ties.items[s->ties.count++] = (tie){c->column_rows[i], c->column_rows[k],
                                                       (dear - cost) / (double)(end - first)};
    }
    if (!s->ties.count) return SL_OK;
    qsort(s->ties.items, s->ties.count, sizeof *s->ties.items, compare_ties);
    size_t count = 1;
    for (size_t i = 1; i < s->ties.count; i++) {
        if (compare_ends(&s->ties.items[count - 1], &s->ties.items[i]) == 0)
            s->ties.items[count - 1].weight += s->ties.items[i].weight;
        else
            s->ties.items[count++] = s->ties.items[i];
    }
    s->ties.count = count;
    qsort(s->ties.items, count, sizeof *s->ties.items, compare_weights);
    return SL_OK;
}

static sl_status find_blocks(splitter *s) {
    const uint32_t rows = s->cover->rows;
    double most = 0;
    for (uint32_t j = 0; j < s->cover->columns; j++)
        most += block_size * s->cover->costs[j] / s->cover->columns;
    s->up = sl_alloc_array(s->context, rows, sizeof *s->up);
    s->size = sl_alloc_array(s->context, rows, sizeof *s->size);
    s->blocks = sl_alloc_array(s->context, rows, sizeof *s->blocks);
    if (!s->up || !s->size || !s->blocks) return SL_NO_MEMORY;
    for (uint32_t r = 0; r < rows; r++) {
        s->up[r] = r;
        s->size[r] = s->duals[r];
    }
    for (size_t i = 0; i < s->ties.count; i++) {
        const uint32_t a = sl_root_of(s->up, s->ties.items[i].a),
                       b = sl_root_of(s->up, s->ties.items[i].b);
        if (a == b || s->size[a] + s->size[b] > most) continue;
        s->up[a > b ? a : b] = a < b ? a : b;
        s->size[a < b ? a : b] += s->size[a > b ? a : b];
    }
    // Leaders are the first rows of their blocks.
    for (uint32_t r = 0; r < rows; r++) {
        const uint32_t leader = sl_root_of(s->up, r);
        s->blocks[r] = leader == r ? s->block_count++ : s->blocks[leader];
    }
    return SL_OK;
}

// --- copies

/// The copies of a column. They share its cost after the duals of their rows, and the rest of it
/// evenly.
static sl_status add_copies(splitter *s, uint32_t column) {
    const sli_cover *c = s->cover;
    const size_t from = s->copies.count;
    const size_t first = c->column_first[column], end = c->column_first[column + 1];
    for (size_t i = first; i < end; i++) {
        const uint32_t block = s->blocks[c->column_rows[i]];
        size_t k = from;
        while (k < s->copies.count && s->copies.items[k].block != block) k++;
        if (k == s->copies.count) {
            SL_TRY(SL_ARRAY_ROOM(s->context, &s->copies, 1));
            s->copies.items[s->copies.count++] = (copy){column, block, 0};
        }
        s->copies.items[k].cost += s->duals[c->column_rows[i]];
    }
    const double rest = reduced_cost(s, column) / (double)(s->copies.count - from);
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->entries, end - first));
    SL_TRY(SL_ARRAY_ROOM(s->context, &s->ends, s->copies.count - from));
    for (size_t k = from; k < s->copies.count; k++) {
        s->copies.items[k].cost += rest;
        for (size_t i = first; i < end; i++)
            if (s->blocks[c->column_rows[i]] == s->copies.items[k].block)
                s->entries.items[s->entries.count++] = c->column_rows[i];
        s->ends.items[s->ends.count++] = s->entries.count;
    }
    return SL_OK;
}

static size_t end_of_copies(const splitter *s, size_t from) {
    size_t end = from;
    while (end < s->copies.count && s->copies.items[end].origin == s->copies.items[from].origin)
        end++;
    return end;
}

/// Whole costs: each 1 or more, together those of the column.
static void round_costs(splitter *s) {
    for (size_t from = 0, end; from < s->copies.count; from = end) {
        double all = 0, sum = 0;
        end = end_of_copies(s, from);
        for (size_t k = from; k < end; k++)
            all += s->copies.items[k].cost > 0 ? s->copies.items[k].cost : 0;
        const uint32_t cost = s->cover->costs[s->copies.items[from].origin];
        const uint32_t room = UNIT * cost - (uint32_t)(end - from);
        uint32_t given = 0;
        for (size_t k = from; k < end; k++) {
            sum += s->copies.items[k].cost > 0 ? s->copies.items[k].cost : 0;
            const double share = all > 0 && k + 1 < end ? sum / all : 1;
            const uint32_t up_to = share < 1 ? (uint32_t)(share * room) : room;
            s->costs[k] = 1 + up_to - given;
            given = up_to;
        }
    }
}

/// The share of its copies that are taken.
static double mean_taken(const splitter *s, size_t from, size_t end) {
    size_t count = 0;
    for (size_t k = from; k < end; k++) count += s->taken[k];
    return (double)count / (double)(end - from);
}

/// Moves costs from copies that are not taken to those that are: as far as the bound lacks of
/// `missing`, if all went on as it begins (Polyak 1969).
static void move_costs(splitter *s, const sl_cover_result *r, double missing) {
    double square = 0;
    memset(s->taken, 0, s->copies.count * sizeof *s->taken);
    for (uint32_t i = 0; i < r->count; i++) s->taken[r->columns[i]] = true;
    for (size_t from = 0, end; from < s->copies.count; from = end) {
        end = end_of_copies(s, from);
        const double mean = mean_taken(s, from, end);
        for (size_t k = from; k < end; k++) square += (s->taken[k] - mean) * (s->taken[k] - mean);
    }
    for (size_t from = 0, end; from < s->copies.count && square > 0; from = end) {
        end = end_of_copies(s, from);
        const double mean = mean_taken(s, from, end);
        for (size_t k = from; k < end; k++)
            s->copies.items[k].cost += missing / square * (s->taken[k] - mean);
    }
}

/// Whether costs can be shared in whole units, and something is shared at all.
static bool is_fit(const splitter *s) {
    if (s->block_count < 2 || s->copies.count >= UINT32_MAX) return false;
    for (size_t from = 0, end; from < s->copies.count; from = end) {
        end = end_of_copies(s, from);
        const uint64_t cost = s->cover->costs[s->copies.items[from].origin];
        if (cost > UINT32_MAX / UNIT || end - from > UNIT * cost) return false;
    }
    return true;
}

// --- turns

/// Takes a proof, and the costs that it is for.
static sl_status keep(splitter *s, sl_cover_result *r, sl_cover_split *out) {
    const uint32_t rows = s->cover->rows, copies = (uint32_t)s->copies.count;
    sli_cover_split_destroy(s->context, out);
    out->rest = sl_alloc_array(s->context, 1, sizeof *out->rest);
    out->blocks = sl_alloc_array(s->context, rows, sizeof *out->blocks);
    out->costs = sl_alloc_array(s->context, copies, sizeof *out->costs);
    if (!out->rest || !out->blocks || !out->costs) return SL_NO_MEMORY;
    out->unit = UNIT;
    out->row_count = rows;
    out->cost_count = copies;
    memcpy(out->blocks, s->blocks, rows * sizeof *out->blocks);
    memcpy(out->costs, s->costs, copies * sizeof *out->costs);
    *out->rest = r->proof;
    r->proof = (sl_cover_proof){0};
    return SL_OK;
}

static sl_status turn(splitter *s, sli_cover_part *part, double step, sl_cover_split *out) {
    const sl_cover_problem problem = {s->cover->rows, (uint32_t)s->copies.count,
                                      s->ends.items,  s->entries.items,
                                      s->costs,       s->cover->demands};
    sl_cover_options options = sl_cover_options_default();
    options.program = part->options->program;
    options.iterations = part->options->iterations;
    options.nodes = (uint64_t)NODES_A_BLOCK * s->block_count;
    options.at_once = true;
    options.cuts = 0;
    sl_cover_result r = {0};
    round_costs(s);
    sl_status status = sl_cover_solve(s->context, &problem, &options, &r);
    const uint64_t lower = r.lower / UNIT + (r.lower % UNIT > 0);
    const double missing = (double)part->cost - (double)r.lower / UNIT;
    if (status == SL_OK) move_costs(s, &r, step * missing);
    if (status == SL_OK && lower > part->lower) {
        status = keep(s, &r, out);
        part->lower = lower < part->cost ? lower : part->cost;
    }
    sl_cover_result_destroy(s->context, &r);
    return status;
}

static sl_status run(splitter *s, sli_cover_part *part, sl_cover_split *out) {
    SL_TRY(find_ties(s));
    SL_TRY(find_blocks(s));
    for (uint32_t j = 0; j < s->cover->columns; j++) SL_TRY(add_copies(s, j));
    if (!is_fit(s)) return SL_OK;
    s->costs = sl_alloc_array(s->context, s->copies.count, sizeof *s->costs);
    s->taken = sl_alloc_array(s->context, s->copies.count, sizeof *s->taken);
    if (!s->costs || !s->taken) return SL_NO_MEMORY;
    double step = first_step;
    for (uint32_t i = 0; i < part->options->splits && part->lower < part->cost; i++) {
        SL_TRY(turn(s, part, step, out));
        step *= shorter;
    }
    return SL_OK;
}

sl_status sli_cover_split(sl_context *context, sli_cover_part *part, const double *duals,
                          sl_cover_split *out) {
    splitter s = {.context = context, .cover = part->cover, .duals = duals};
    if (!part->options->splits || s.cover->column_first[s.cover->columns] > MOST_ENTRIES)
        return SL_OK;
    const sl_status status = run(&s, part, out);
    sl_free(context, s.ties.items);
    sl_free(context, s.up);
    sl_free(context, s.size);
    sl_free(context, s.blocks);
    sl_free(context, s.copies.items);
    sl_free(context, s.ends.items);
    sl_free(context, s.entries.items);
    sl_free(context, s.costs);
    sl_free(context, s.taken);
    return status;
}
