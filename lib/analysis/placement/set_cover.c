/// Set cover, from the problem to a set and a proof.
///
/// 1. Reductions (cover_reduce.c) leave less, mostly much less.
/// 2. What is left falls into parts that share no column. Each is solved by itself:
/// 3. a greedy cover, a Lagrangian bound with covers by the way (cover_lagrange.c), local search
///    (cover_search.c); and where bound and cover still differ,
/// 4. branch and bound (cover_tree.c), with a linear program where there is one, and cuts to raise
///    it (cover_cuts.c),
/// 5. and where that is too much, blocks that share the costs of columns (cover_split.c).
/// 6. Steps, parts, trees, splits and cuts are the proof, which cover_check.c reads with code of
/// its own.
///
/// Costs are divided by their greatest common divisor first: then bounds are rounded up to whole
/// numbers. The duals are integers over a power of two, as large as sums in 64 bits allow.
#include "analysis/placement/cover.h"

#include <string.h>

sl_cover_options sl_cover_options_default(void) {
    return (sl_cover_options){.nodes = 10000, .iterations = 50000, .cuts = 60};
}

static void cuts_destroy(sl_context *context, sl_cover_cuts *c) {
    if (c->rest) sli_cover_proof_destroy(context, c->rest);
    sl_free(context, c->rest);
    sl_free(context, c->ends);
    sl_free(context, c->rows);
}

void sli_cover_proof_destroy(sl_context *context, sl_cover_proof *proof) {
    sl_free(context, proof->steps);
    sl_free(context, proof->parts);
    sl_free(context, proof->nodes);
    sl_free(context, proof->duals);
    for (uint32_t i = 0; i < proof->split_count; i++)
        sli_cover_split_destroy(context, &proof->splits[i]);
    sl_free(context, proof->splits);
    for (uint32_t i = 0; i < proof->raised_count; i++) cuts_destroy(context, &proof->raised[i]);
    sl_free(context, proof->raised);
    *proof = (sl_cover_proof){0};
}

void sl_cover_result_destroy(sl_context *context, sl_cover_result *r) {
    sl_free(context, r->columns);
    sli_cover_proof_destroy(context, &r->proof);
    *r = (sl_cover_result){0};
}

// --- the problem

static sl_status check_columns(sl_context *context, const sl_cover_problem *p) {
    size_t at = 0;
    for (uint32_t j = 0; j < p->column_count; at = p->ends[j++]) {
        if (p->ends[j] < at) return sl_fail(context, SL_BAD_ARGUMENT, "column %u ends early", j);
        if (p->costs && !p->costs[j])
            return sl_fail(context, SL_BAD_ARGUMENT, "column %u costs nothing", j);
        for (size_t i = at; i < p->ends[j]; i++)
            if (p->entries[i] >= p->row_count || (i > at && p->entries[i] <= p->entries[i - 1]))
                return sl_fail(context, SL_BAD_ARGUMENT,
                               "column %u: rows are below %u and ascending", j, p->row_count);
    }
    return SL_OK;
}

static sl_status check_rows(sl_context *context, const sli_cover *c) {
    for (uint32_t r = 0; r < c->rows; r++)
        if (c->row_first[r + 1] - c->row_first[r] < c->demands[r])
            return sl_fail(context, SL_BAD_ARGUMENT, "row %u demands %u columns, and has %zu", r,
                           c->demands[r], c->row_first[r + 1] - c->row_first[r]);
    return SL_OK;
}

static uint32_t common_divisor(const sl_cover_problem *p) {
    uint32_t divisor = p->costs ? 0 : 1;
    for (uint32_t j = 0; j < p->column_count && divisor != 1; j++)
        for (uint32_t a = p->costs[j]; a;) {
            const uint32_t rest = divisor % a;
            divisor = a;
            a = rest;
        }
    return divisor ? divisor : 1;
}

sl_status sli_cover_read(sl_context *context, const sl_cover_problem *p, uint32_t divisor,
                         sli_cover *out) {
    SL_TRY(check_columns(context, p));
    const size_t entries = p->column_count ? p->ends[p->column_count - 1] : 0;
    SL_TRY(sli_cover_make(context, p->row_count, p->column_count, entries, out));
    for (uint32_t j = 0; j < p->column_count; j++) {
        out->column_first[j + 1] = p->ends[j];
        out->costs[j] = p->costs && divisor ? p->costs[j] / divisor : 1;
    }
    if (entries) memcpy(out->column_rows, p->entries, entries * sizeof *p->entries);
    for (uint32_t r = 0; r < p->row_count; r++) out->demands[r] = p->demands ? p->demands[r] : 1;
    sli_cover_turn(out);
    return SL_OK;
}

// --- parts

typedef struct piece {
    sli_cover cover;
    uint32_t *columns; ///< by column of the piece: its number in the problem
    sli_cover_part part;
    sl_cover_split split; ///< in place of its tree, where it has rows
} piece;

typedef struct solver {
    const sl_cover_options *options;
    sli_cover cover;
    sli_cover_left left;
    uint64_t denominator, nodes, step_cost;
    uint32_t *parts; ///< by row
    uint32_t *names; ///< by row, and by column: the number in its piece
    uint32_t *column_names;
    piece *pieces;
    uint32_t piece_count;
    double *values; ///< the caller's; NULL: none
} solver;

/// Numbers parts by their first rows.
static sl_status find_parts(sl_context *context, solver *s) {
    const sli_cover *c = &s->cover;
    uint32_t *up = sl_alloc_array(context, c->rows, sizeof *up);
    if (!up) return SL_NO_MEMORY;
    for (uint32_t r = 0; r < c->rows; r++) up[r] = r;
    for (uint32_t j = 0; j < c->columns; j++) {
        uint32_t first = UINT32_MAX;
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++) {
            const uint32_t row = c->column_rows[i];
            if (!s->left.column_there[j] || !s->left.row_there[row]) continue;
            if (first == UINT32_MAX) first = sl_root_of(up, row);
            const uint32_t other = sl_root_of(up, row);
            // The lower row leads, so that parts come in the order of their first rows.
            up[first < other ? other : first] = first < other ? first : other;
            if (other < first) first = other;
        }
    }
    for (uint32_t r = 0; r < c->rows; r++) {
        if (!s->left.row_there[r]) continue;
        const uint32_t root = sl_root_of(up, r);
        s->parts[r] = root == r ? s->piece_count++ : s->parts[root];
    }
    sl_free(context, up);
    return SL_OK;
}

/// Counts what pieces have, and gives rows and columns their numbers there.
static sl_status make_pieces(sl_context *context, solver *s) {
    const sli_cover *c = &s->cover;
    size_t *entries = sl_alloc_array(context, s->piece_count, sizeof *entries);
    s->pieces = sl_alloc_array(context, s->piece_count, sizeof *s->pieces);
    sl_status status = entries && s->pieces ? SL_OK : SL_NO_MEMORY;
    for (uint32_t r = 0; r < c->rows && status == SL_OK; r++)
        if (s->left.row_there[r]) s->names[r] = s->pieces[s->parts[r]].cover.rows++;
    for (uint32_t j = 0; j < c->columns && status == SL_OK; j++) {
        uint32_t part = UINT32_MAX;
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++) {
            if (!s->left.column_there[j] || !s->left.row_there[c->column_rows[i]]) continue;
            part = s->parts[c->column_rows[i]];
            entries[part]++;
        }
        s->left.column_there[j] = part != UINT32_MAX;
        if (part != UINT32_MAX) s->column_names[j] = s->pieces[part].cover.columns++;
    }
    for (uint32_t k = 0; k < s->piece_count && status == SL_OK; k++) {
        piece *p = &s->pieces[k];
        status = sli_cover_make(context, p->cover.rows, p->cover.columns, entries[k], &p->cover);
        p->columns = sl_alloc_array(context, p->cover.columns, sizeof *p->columns);
        p->part.taken = sl_alloc_array(context, p->cover.columns, sizeof *p->part.taken);
        if (!p->columns || !p->part.taken) status = SL_NO_MEMORY;
        p->part.cover = &p->cover;
        p->part.options = s->options;
        p->part.denominator = s->denominator;
    }
    sl_free(context, entries);
    return status;
}

static void fill_pieces(solver *s) {
    const sli_cover *c = &s->cover;
    for (uint32_t r = 0; r < c->rows; r++)
        if (s->left.row_there[r])
            s->pieces[s->parts[r]].cover.demands[s->names[r]] = s->left.rest[r];
    for (uint32_t j = 0; j < c->columns; j++) {
        piece *p = NULL;
        for (size_t i = c->column_first[j]; i < c->column_first[j + 1]; i++) {
            const uint32_t row = c->column_rows[i];
            if (!s->left.column_there[j] || !s->left.row_there[row]) continue;
            const uint32_t name = s->column_names[j];
            if (!p) {
                p = &s->pieces[s->parts[row]];
                p->columns[name] = j;
                p->cover.costs[name] = c->costs[j];
                p->cover.column_first[name + 1] = p->cover.column_first[name];
            }
            p->cover.column_rows[p->cover.column_first[name + 1]++] = s->names[row];
        }
    }
    for (uint32_t k = 0; k < s->piece_count; k++) sli_cover_turn(&s->pieces[k].cover);
}

static void solver_destroy(sl_context *context, solver *s) {
    for (uint32_t k = 0; s->pieces && k < s->piece_count; k++) {
        piece *p = &s->pieces[k];
        sli_cover_destroy(context, &p->cover);
        sl_free(context, p->columns);
        sl_free(context, p->part.taken);
        sl_free(context, p->part.nodes.items);
        sl_free(context, p->part.duals.items);
        sli_cover_cuts_destroy(context, &p->part.cuts);
        sli_cover_split_destroy(context, &p->split);
    }
    sl_free(context, s->pieces);
    sl_free(context, s->parts);
    sl_free(context, s->names);
    sl_free(context, s->column_names);
    sli_cover_left_destroy(context, &s->left);
    sli_cover_destroy(context, &s->cover);
}

// --- sets

static void keep_if_better(sli_cover_part *p, const uint8_t *set) {
    const uint64_t cost = sli_cover_cost(p->cover, set);
    if (p->cost && cost >= p->cost) return;
    p->cost = cost;
    memcpy(p->taken, set, p->cover->columns);
}

/// A greedy cover of each piece; and what the caller has, completed.
static sl_status begin_sets(sl_context *context, solver *s) {
    uint8_t *start = sl_alloc_array(context, s->cover.columns, sizeof *start);
    uint8_t *set = sl_alloc_array(context, s->cover.columns, sizeof *set);
    sl_status status = start && set ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->options->start_count && status == SL_OK; i++) {
        if (s->options->start[i] < s->cover.columns)
            start[s->options->start[i]] = 1;
        else
            status = sl_fail(context, SL_BAD_ARGUMENT, "there is no column %u to start from",
                             s->options->start[i]);
    }
    for (size_t i = 0; i < s->left.steps.count && status == SL_OK; i++) {
        const sl_cover_step *step = &s->left.steps.items[i];
        if (step->kind == SL_COVER_COLUMN_GOES) start[step->by] |= start[step->what];
    }
    for (uint32_t k = 0; k < s->piece_count && status == SL_OK; k++) {
        piece *p = &s->pieces[k];
        for (uint32_t j = 0; j < p->cover.columns; j++) set[j] = start[p->columns[j]];
        if (s->options->start_count) {
            status = sli_cover_greedy(context, &p->cover, NULL, NULL, set);
            if (status == SL_OK) keep_if_better(&p->part, set);
        }
        memset(set, 0, s->cover.columns);
        if (status == SL_OK) status = sli_cover_greedy(context, &p->cover, NULL, NULL, set);
        if (status == SL_OK) keep_if_better(&p->part, set);
    }
    sl_free(context, start);
    sl_free(context, set);
    return status;
}

// --- bounds

/// Takes duals as the proof of a part, a leaf alone, where they prove more than it has.
static sl_status prove_by(sl_context *context, sli_cover_part *p, const double *duals) {
    sli_cover_state state;
    SL_TRY(sli_cover_state_make(context, p->cover, &state));
    sl_status status = SL_ARRAY_ROOM(context, &p->nodes, 1);
    if (status == SL_OK) status = SL_ARRAY_ROOM(context, &p->duals, p->cover->rows);
    if (status == SL_OK) {
        sli_cover_duals_round(p->cover, duals, p->denominator, p->duals.items);
        p->duals.count = p->cover->rows;
        p->nodes.count = 1;
        p->nodes.items[0] = (sl_cover_node){UINT32_MAX, {UINT32_MAX, UINT32_MAX}, 0};
        p->lower = sli_cover_ceiling(
            sli_cover_bound(p->cover, &state, p->duals.items, p->denominator, NULL),
            p->denominator);
    }
    sli_cover_state_destroy(context, &state);
    return status;
}

/// What the cost of a part need not be below, as the caller has a bound of the whole.
static uint64_t enough_of(const solver *s, const piece *p, uint64_t known) {
    uint64_t others = 0;
    for (uint32_t k = 0; k < s->piece_count; k++)
        if (&s->pieces[k] != p) others += s->pieces[k].part.cost;
    const uint64_t least = known > others ? known - others : 0;
    return least > p->part.lower ? least : p->part.lower;
}

/// Iterations of the local search for each Lagrangian one, at most.
enum { LAGRANGIAN_SHARE = 25 };

/// `nodes`: of those that are left, what the piece may use.
static sl_status solve_piece(sl_context *context, solver *s, piece *p, uint64_t known,
                             uint64_t nodes) {
    sli_cover_part *part = &p->part;
    const sl_cover_options *o = s->options;
    uint64_t left = nodes;
    double *duals = sl_alloc_array(context, p->cover.rows, sizeof *duals);
    double *values = sl_alloc_array(context, p->cover.columns, sizeof *values);
    sli_cover_state state = {0};
    sl_status status = duals && values ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sli_cover_state_make(context, &p->cover, &state);
    if (status == SL_OK)
        status = sli_cover_lagrange(context, &p->cover, &state, part->cost,
                                    o->iterations / LAGRANGIAN_SHARE, duals, values, part->taken);
    if (status == SL_OK || status == SL_CANCELLED) {
        const sl_status proven = prove_by(context, part, duals);
        if (proven != SL_OK) status = proven;
        part->cost = sli_cover_cost(&p->cover, part->taken);
    }
    if (status == SL_OK && part->cost > enough_of(s, p, known)) {
        status = sli_cover_search(context, &p->cover, enough_of(s, p, known), o->iterations,
                                  part->taken);
        part->cost = sli_cover_cost(&p->cover, part->taken);
    }
    if (status == SL_OK && part->cost > enough_of(s, p, known))
        status = sli_cover_branch(context, part, duals, &left);
    s->nodes -= nodes - left;
    for (uint32_t j = 0; s->values && status == SL_OK && j < p->cover.columns; j++)
        s->values[p->columns[j]] = values[j];
    if (status == SL_OK && part->cost > enough_of(s, p, known))
        status = sli_cover_split(context, part, duals, &p->split);
    sli_cover_state_destroy(context, &state);
    sl_free(context, duals);
    sl_free(context, values);
    return status;
}

static size_t size_of(const piece *p) {
    return p->cover.column_first[p->cover.columns];
}

/// Small pieces first: what they leave of their share of the nodes is for the large ones.
static sl_status solve_pieces(sl_context *context, solver *s, uint64_t known) {
    uint32_t *order = sl_alloc_array(context, s->piece_count, sizeof *order);
    if (!order) return SL_NO_MEMORY;
    for (uint32_t k = 0; k < s->piece_count; k++) {
        uint32_t at = k;
        for (; at && size_of(&s->pieces[order[at - 1]]) > size_of(&s->pieces[k]); at--)
            order[at] = order[at - 1];
        order[at] = k;
    }
    sl_status status = SL_OK;
    for (uint32_t k = 0; k < s->piece_count && status == SL_OK; k++)
        status =
            solve_piece(context, s, &s->pieces[order[k]], known, s->nodes / (s->piece_count - k));
    sl_free(context, order);
    return status;
}

// --- the result

/// Puts a part's tree into a proof as that of `part`, the rest of its nodes from `first` on. The
/// duals of a proof are for costs as they are, not divided: below the largest cost, times 2^31.
/// `columns`: the names of the part's; NULL: they keep their numbers.
static void add_nodes(sl_cover_proof *proof, const sli_cover_part *p, const uint32_t *columns,
                      uint32_t divisor, uint32_t part, uint32_t first) {
    const uint32_t count = (uint32_t)p->nodes.count;
    for (uint32_t i = 0; i < count; i++) {
        // The root, last in the part, is in front; the others follow, turned round.
        sl_cover_node node = p->nodes.items[i];
        for (int k = 0; k < 2; k++)
            if (node.children[k] != UINT32_MAX)
                node.children[k] = first + count - 2 - node.children[k];
        if (node.column != UINT32_MAX && columns) node.column = columns[node.column];
        if (node.duals != SIZE_MAX) node.duals += proof->dual_count;
        proof->nodes[i == count - 1 ? part : first + count - 2 - i] = node;
    }
    for (size_t i = 0; i < p->duals.count; i++)
        proof->duals[proof->dual_count + i] = p->duals.items[i] * divisor;
    proof->dual_count += p->duals.count;
}

static sl_status make_room(sl_context *context, sl_cover_proof *proof, size_t nodes, size_t duals) {
    proof->node_count = (uint32_t)nodes;
    proof->nodes = sl_alloc_array(context, nodes, sizeof *proof->nodes);
    proof->duals = sl_alloc_array(context, duals, sizeof *proof->duals);
    return proof->nodes && proof->duals ? SL_OK : SL_NO_MEMORY;
}

/// How a part is proven: parts come in this order.
typedef enum how { BY_TREE, BY_SPLIT, BY_CUTS, HOWS } how;

static how how_of(const piece *p) {
    return p->split.row_count ? BY_SPLIT : p->part.cuts.ends.count ? BY_CUTS : BY_TREE;
}

/// Moves cuts to the proof, with the tree that is for them.
static sl_status move_cuts(sl_context *context, sli_cover_part *p, sl_cover_cuts *out) {
    *out = (sl_cover_cuts){p->cover->rows, (uint32_t)p->cuts.ends.count, p->cuts.ends.items,
                           p->cuts.rows.items, NULL};
    p->cuts.ends.items = NULL;
    p->cuts.rows.items = NULL;
    out->rest = sl_alloc_array(context, 1, sizeof *out->rest);
    if (!out->rest) return SL_NO_MEMORY;
    out->rest->denominator = p->denominator;
    out->rest->part_count = 1;
    out->rest->row_count = p->cuts.cover.rows;
    out->rest->parts = sl_alloc_array(context, out->rest->row_count, sizeof *out->rest->parts);
    if (!out->rest->parts) return SL_NO_MEMORY;
    SL_TRY(make_room(context, out->rest, p->nodes.count, p->duals.count));
    add_nodes(out->rest, p, NULL, 1, 0, 1);
    return SL_OK;
}

/// Numbers the parts, and moves splits and cuts to the proof.
static sl_status number_parts(sl_context *context, solver *s, sl_cover_proof *proof) {
    uint32_t *numbers = sl_alloc_array(context, s->piece_count, sizeof *numbers);
    uint32_t counts[HOWS] = {0}, next[HOWS] = {0};
    for (uint32_t k = 0; k < s->piece_count; k++) counts[how_of(&s->pieces[k])]++;
    proof->splits = sl_alloc_array(context, counts[BY_SPLIT], sizeof *proof->splits);
    proof->raised = sl_alloc_array(context, counts[BY_CUTS], sizeof *proof->raised);
    sl_status status = numbers && proof->splits && proof->raised ? SL_OK : SL_NO_MEMORY;
    proof->part_count = counts[BY_TREE];
    next[BY_SPLIT] = counts[BY_TREE];
    next[BY_CUTS] = counts[BY_TREE] + counts[BY_SPLIT];
    for (uint32_t k = 0; status == SL_OK && k < s->piece_count; k++) {
        piece *p = &s->pieces[k];
        const how by = how_of(p);
        numbers[k] = next[by]++;
        if (by == BY_CUTS)
            status = move_cuts(context, &p->part, &proof->raised[proof->raised_count++]);
        if (by != BY_SPLIT) continue;
        proof->splits[proof->split_count++] = p->split;
        p->split.blocks = p->split.costs = NULL;
        p->split.rest = NULL;
    }
    for (uint32_t r = 0; status == SL_OK && r < s->cover.rows; r++)
        if (s->left.row_there[r]) s->parts[r] = numbers[s->parts[r]];
    sl_free(context, numbers);
    return status;
}

static sl_status fill_proof(sl_context *context, solver *s, uint32_t divisor,
                            sl_cover_proof *proof) {
    size_t nodes = 0, duals = 0;
    SL_TRY(number_parts(context, s, proof));
    for (uint32_t k = 0; k < s->piece_count; k++) {
        if (how_of(&s->pieces[k]) != BY_TREE) continue;
        nodes += s->pieces[k].part.nodes.count;
        duals += s->pieces[k].part.duals.count;
    }
    proof->denominator = s->denominator;
    proof->row_count = s->cover.rows;
    proof->step_count = (uint32_t)s->left.steps.count;
    proof->steps = s->left.steps.items;
    s->left.steps.items = NULL;
    proof->parts = s->parts;
    s->parts = NULL;
    SL_TRY(make_room(context, proof, nodes, duals));
    uint32_t first = proof->part_count, part = 0;
    for (uint32_t k = 0; k < s->piece_count; k++) {
        const piece *p = &s->pieces[k];
        if (how_of(p) != BY_TREE) continue;
        add_nodes(proof, &p->part, p->columns, divisor, part++, first);
        first += (uint32_t)p->part.nodes.count - 1;
    }
    return SL_OK;
}

static sl_status fill_result(sl_context *context, solver *s, uint32_t divisor,
                             sl_cover_result *out) {
    const sli_cover *c = &s->cover;
    out->columns = sl_alloc_array(context, c->columns, sizeof *out->columns);
    if (!out->columns) return SL_NO_MEMORY;
    for (uint32_t k = 0; k < s->piece_count; k++) {
        const piece *p = &s->pieces[k];
        for (uint32_t j = 0; j < p->cover.columns; j++)
            s->left.taken[p->columns[j]] |= p->part.taken[j];
        out->lower += p->part.lower;
        out->cost += p->part.cost;
    }
    out->lower += s->step_cost;
    out->cost += s->step_cost;
    out->lower *= divisor;
    out->cost *= divisor;
    if (out->lower < s->options->known_lower) out->lower = s->options->known_lower;
    for (uint32_t j = 0; j < c->columns; j++)
        if (s->left.taken[j]) out->columns[out->count++] = j;
    return fill_proof(context, s, divisor, &out->proof);
}

/// A part whose turn does not come has a leaf without duals.
static sl_status complete_parts(sl_context *context, solver *s) {
    for (uint32_t k = 0; k < s->piece_count; k++) {
        sli_cover_part *p = &s->pieces[k].part;
        if (p->nodes.count) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &p->nodes, 1));
        p->nodes.items[p->nodes.count++] =
            (sl_cover_node){UINT32_MAX, {UINT32_MAX, UINT32_MAX}, SIZE_MAX};
    }
    return SL_OK;
}

static sl_status prepare(sl_context *context, const sl_cover_problem *problem, uint32_t divisor,
                         solver *s) {
    SL_TRY(sli_cover_read(context, problem, divisor, &s->cover));
    SL_TRY(check_rows(context, &s->cover));
    s->denominator = sli_cover_denominator(&s->cover);
    if (!s->denominator)
        return sl_fail(context, SL_UNSUPPORTED, "costs too large for sums in 64 bits");
    SL_TRY(sli_cover_reduce(context, &s->cover, &s->left));
    s->step_cost = sli_cover_cost(&s->cover, s->left.taken);
    s->parts = sl_alloc_array(context, s->cover.rows, sizeof *s->parts);
    s->names = sl_alloc_array(context, s->cover.rows, sizeof *s->names);
    s->column_names = sl_alloc_array(context, s->cover.columns, sizeof *s->column_names);
    if (!s->parts || !s->names || !s->column_names) return SL_NO_MEMORY;
    SL_TRY(find_parts(context, s));
    SL_TRY(make_pieces(context, s));
    fill_pieces(s);
    return begin_sets(context, s);
}

sl_status sli_cover_solve(sl_context *context, const sl_cover_problem *problem,
                          const sl_cover_options *options, double *values, sl_cover_result *out) {
    const sl_cover_options usual = sl_cover_options_default();
    solver s = {.options = options ? options : &usual, .values = values};
    const uint32_t divisor = common_divisor(problem);
    s.nodes = s.options->nodes;
    sl_cover_result result = {0};
    sl_status status = prepare(context, problem, divisor, &s), filled = status;
    if (status == SL_OK) {
        // The bound that the caller knows, less what steps took, in units of the divisor.
        const uint64_t known =
            s.options->known_lower / divisor + (s.options->known_lower % divisor > 0);
        status = solve_pieces(context, &s, known > s.step_cost ? known - s.step_cost : 0);
        filled = status == SL_OK || status == SL_CANCELLED ? complete_parts(context, &s) : status;
        if (filled == SL_OK) filled = fill_result(context, &s, divisor, &result);
    }
    solver_destroy(context, &s);
    if (filled == SL_OK)
        *out = result;
    else
        sl_cover_result_destroy(context, &result);
    return filled == SL_OK ? status : filled;
}

sl_status sl_cover_solve(sl_context *context, const sl_cover_problem *problem,
                         const sl_cover_options *options, sl_cover_result *out) {
    return sli_cover_solve(context, problem, options, NULL, out);
}
