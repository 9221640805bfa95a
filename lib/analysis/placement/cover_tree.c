/// Branch and bound, depth first, with a proof that can be checked node by node.
///
/// The tree is grown towards a target: it shows that no set costs less, so a node whose bound comes
/// up to the target is a leaf. The first target is the least one above the bound of the root; when
/// its tree is whole, the target rises, up to the cost of the best set. So a search that ends early
/// leaves the bound of the last whole tree. A cheaper set that is found on the way lowers the
/// target.
///
/// At each node:
///
/// 1. Rows that demand all their free columns take them; a row that demands more ends the node.
/// 2. The parent's duals bound it; where they do not suffice, duals of its own: from the linear
///    program, which goes on from the basis of the node before, or by some Lagrangian steps.
/// 3. Reduced costs fix columns: one that costs too much is not taken, one that is worth too much
/// is.
/// 4. It branches on a column that the program takes in part (cover_choose.c).
///
/// A column fixed by 3 is a node with one child, the other one bounded by its duals. Most of these
/// matter to no leaf below, so a node is made only where a bound, or a row that runs short, counts
/// on the column.
#include "analysis/placement/cover_tree.h"

#include <string.h>

/// What a tree keeps of duals at most: 256 MB; and the Lagrangian steps of a node.
enum { MOST_DUALS = 1 << 25, STEPS = 60 };

/// Simplex steps times entries that the program may take for a root.
static const uint64_t root_work = (uint64_t)1 << 32;
static const double whole = 1e-6;

typedef sli_cover_tree tree;

static sl_status add_node(sl_context *context, tree *t, sl_cover_node node, uint32_t *at) {
    SL_TRY(SL_ARRAY_ROOM(context, &t->part->nodes, 1));
    *at = (uint32_t)t->part->nodes.count;
    t->part->nodes.items[t->part->nodes.count++] = node;
    return SL_OK;
}

static void reach(tree *t, uint64_t bound) {
    if (bound < t->least) t->least = bound;
}

static sl_status add_leaf(sl_context *context, tree *t, size_t duals, uint64_t bound,
                          uint32_t *at) {
    reach(t, bound);
    return add_node(context, t, (sl_cover_node){UINT32_MAX, {UINT32_MAX, UINT32_MAX}, duals}, at);
}

/// The bound of the state by some duals; leaves the sums of columns.
static int64_t bound_by(tree *t, size_t duals) {
    return sli_cover_bound(t->cover, &t->state, t->part->duals.items + duals, t->part->denominator,
                           t->sums);
}

/// The last bound is part of the proof: it counts on columns that are not there to be taken.
static void need_by_sums(tree *t) {
    for (uint32_t j = 0; j < t->cover->columns; j++)
        if (t->state.fixed[j] == SLI_COVER_OUT &&
            t->sums[j] > (int64_t)(t->cover->costs[j] * t->part->denominator))
            t->needed[j] = true;
}

/// A row counts on its columns that are left.
static void need_by_row(tree *t, uint32_t row) {
    for (size_t k = t->cover->row_first[row]; k < t->cover->row_first[row + 1]; k++)
        if (t->state.fixed[t->cover->row_columns[k]] == SLI_COVER_OUT)
            t->needed[t->cover->row_columns[k]] = true;
}

static sl_status fix_column(sl_context *context, tree *t, uint32_t column, uint8_t how,
                            size_t duals) {
    SL_TRY(SL_ARRAY_ROOM(context, &t->fixes, 1));
    t->fixes.items[t->fixes.count++] = (sli_cover_fixed){column, how, duals};
    sli_cover_fix(t->cover, &t->state, column, how);
    return SL_OK;
}

/// Takes what rows must have. `row`: one that cannot have enough, or UINT32_MAX.
static sl_status take_forced(sl_context *context, tree *t, uint32_t *short_row) {
    const sli_cover *c = t->cover;
    *short_row = UINT32_MAX;
    for (uint32_t r = 0; r < c->rows; r++) {
        if (t->state.rest[r] <= 0 || t->state.free[r] > t->state.rest[r]) continue;
        need_by_row(t, r);
        if (t->state.free[r] < t->state.rest[r]) {
            *short_row = r;
            return SL_OK;
        }
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++)
            if (t->state.fixed[c->row_columns[k]] == SLI_COVER_FREE)
                SL_TRY(fix_column(context, t, c->row_columns[k], SLI_COVER_IN, SIZE_MAX));
    }
    return SL_OK;
}

static bool is_covered(const tree *t) {
    for (uint32_t r = 0; r < t->cover->rows; r++)
        if (t->state.rest[r] > 0) return false;
    return true;
}

/// Completes what is in t->set; keeps it where it is the best cover so far.
static sl_status try_set(sl_context *context, tree *t, const double *duals) {
    const sli_cover *c = t->part->cover; // who covers its rows fulfils all cuts
    SL_TRY(sli_cover_greedy(context, c, duals, t->state.fixed, t->set));
    for (uint32_t r = 0; r < c->rows; r++) {
        uint32_t covered = 0;
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++)
            covered += t->set[c->row_columns[k]];
        if (covered < c->demands[r]) return SL_OK;
    }
    const uint64_t cost = sli_cover_cost(c, t->set);
    if (cost >= t->part->cost) return SL_OK;
    t->part->cost = cost;
    memcpy(t->part->taken, t->set, c->columns);
    if (cost < t->target) t->target = cost;
    return SL_OK;
}

bool sli_cover_pay(sli_cover_tree *t) {
    const uint64_t price = 1 + t->cover->column_first[t->cover->columns] / SLI_COVER_NODE_ENTRIES;
    if (*t->nodes_left < price) return false;
    *t->nodes_left -= price;
    return true;
}

/// New duals for the state, behind the others; from those at `duals`. Leaves t->values. The program
/// may stop where its bound passes `enough`; 0: it does not.
static sl_status find_duals(sl_context *context, tree *t, size_t duals, double enough) {
    const uint32_t rows = t->cover->rows;
    const uint64_t denominator = t->part->denominator;
    sl_status status = SL_UNSUPPORTED;
    const uint64_t work = 1 + (enough > 0 ? SLI_COVER_NODE_WORK : root_work) /
                                  (1 + t->cover->column_first[t->cover->columns]);
    if (t->program)
        status = t->part->options->program->again(context, t->program, t->state.fixed, work, enough,
                                                  t->y, t->values);
    if (status == SL_UNSUPPORTED) {
        for (uint32_t r = 0; r < rows; r++)
            t->y[r] = (double)t->part->duals.items[duals + r] / (double)denominator;
        memset(t->values, 0, t->cover->columns * sizeof *t->values);
        status = sli_cover_lagrange(context, t->cover, &t->state, t->target, STEPS, t->y, t->values,
                                    NULL);
    }
    SL_TRY(status);
    SL_TRY(SL_ARRAY_ROOM(context, &t->part->duals, rows));
    sli_cover_duals_round(t->cover, t->y, denominator, t->part->duals.items + t->part->duals.count);
    t->part->duals.count += rows;
    return SL_OK;
}

/// Leaves columns that would cost too much, by the sums of the last bound.
static sl_status fix_dear(sl_context *context, tree *t, int64_t bound, size_t duals, bool *any) {
    const uint64_t d = t->part->denominator;
    for (uint32_t j = 0; j < t->cover->columns; j++) {
        if (t->state.fixed[j] != SLI_COVER_FREE || !t->sums[j]) continue;
        const int64_t more = (int64_t)(t->cover->costs[j] * d) - t->sums[j];
        if (more <= 0 || sli_cover_ceiling(bound + more, d) < t->target) continue;
        if (!*any) need_by_sums(t);
        *any = true;
        reach(t, sli_cover_ceiling(bound + more, d));
        SL_TRY(fix_column(context, t, j, SLI_COVER_OUT, duals));
    }
    return SL_OK;
}

/// Takes columns whose loss would cost too much. Each changes the sums of others.
static sl_status fix_worthy(sl_context *context, tree *t, int64_t bound, size_t duals, bool *any) {
    const uint64_t d = t->part->denominator;
    for (uint32_t j = 0; j < t->cover->columns; j++) {
        if (t->state.fixed[j] != SLI_COVER_FREE) continue;
        const int64_t more = t->sums[j] - (int64_t)(t->cover->costs[j] * d);
        if (more <= 0 || sli_cover_ceiling(bound + more, d) < t->target) continue;
        *any = true;
        need_by_sums(t);
        reach(t, sli_cover_ceiling(bound + more, d));
        SL_TRY(fix_column(context, t, j, SLI_COVER_IN, duals));
        bound = bound_by(t, duals);
    }
    return SL_OK;
}

static sl_status grow(sl_context *context, tree *t, size_t duals, uint32_t *at);

static sl_status branch_on(sl_context *context, tree *t, uint32_t column, size_t duals,
                           uint32_t *at) {
    sl_cover_node node = {column, {0, 0}, SIZE_MAX};
    static const uint8_t ways[] = {SLI_COVER_IN, SLI_COVER_OUT};
    for (int i = 0; i < 2; i++) {
        sli_cover_fix(t->cover, &t->state, column, ways[i]);
        const sl_status status = grow(context, t, duals, &node.children[1 - i]);
        sli_cover_unfix(t->cover, &t->state, column);
        if (status != SL_OK || t->spent) return status;
    }
    return add_node(context, t, node, at);
}

static sl_status fill_set(sl_context *context, tree *t) {
    for (uint32_t j = 0; j < t->cover->columns; j++)
        t->set[j] = t->state.fixed[j] == SLI_COVER_IN ||
                    (t->state.fixed[j] == SLI_COVER_FREE && t->values[j] > 0.5);
    return try_set(context, t, t->y);
}

/// The node of the state, whose fixes are undone by the caller.
static sl_status grow_node(sl_context *context, tree *t, size_t duals, uint32_t *at) {
    const uint64_t d = t->part->denominator;
    bool searched = false;
    int64_t bound = 0;
    for (bool any = true; any;) {
        uint32_t short_row;
        size_t before;
        do {
            before = t->fixes.count;
            SL_TRY(take_forced(context, t, &short_row));
            if (short_row != UINT32_MAX) return add_leaf(context, t, SIZE_MAX, UINT64_MAX, at);
        } while (t->fixes.count != before);
        if (is_covered(t)) {
            memset(t->values, 0, t->cover->columns * sizeof *t->values);
            SL_TRY(fill_set(context, t));
            return add_leaf(context, t, SIZE_MAX, t->state.taken, at);
        }
        bound = bound_by(t, duals);
        if (!searched && sli_cover_ceiling(bound, d) < t->target) {
            searched = true;
            const size_t found = t->part->duals.count;
            SL_TRY(find_duals(context, t, duals, (double)t->target - 1 + whole));
            const int64_t better = bound_by(t, found);
            SL_TRY(fill_set(context, t));
            if (better > bound)
                duals = found;
            else
                t->part->duals.count = found;
            bound = bound_by(t, duals);
        }
        if (sli_cover_ceiling(bound, d) >= t->target) {
            need_by_sums(t);
            return add_leaf(context, t, duals, sli_cover_ceiling(bound, d), at);
        }
        any = false;
        SL_TRY(fix_dear(context, t, bound, duals, &any));
        SL_TRY(fix_worthy(context, t, bound, duals, &any));
    }
    if (t->part->duals.count > MOST_DUALS) t->spent = true;
    if (t->spent) return SL_OK;
    uint32_t column;
    SL_TRY(sli_cover_choose(context, t, bound, &column));
    return branch_on(context, t, column, duals, at);
}

/// Undoes fixes down to `count`, and puts those that are needed above the node.
static sl_status undo(sl_context *context, tree *t, size_t count, sl_status status, uint32_t *at) {
    while (t->fixes.count > count) {
        const sli_cover_fixed f = t->fixes.items[--t->fixes.count];
        sli_cover_unfix(t->cover, &t->state, f.column);
        const bool needed = f.how == SLI_COVER_IN || t->needed[f.column];
        t->needed[f.column] = false;
        if (!needed || t->spent || status != SL_OK) continue;
        sl_cover_node node = {f.column, {UINT32_MAX, UINT32_MAX}, f.duals};
        node.children[f.how == SLI_COVER_IN] = *at;
        status = add_node(context, t, node, at);
    }
    return status;
}

/// Makes the node of the state, from its parent's duals.
static sl_status grow(sl_context *context, tree *t, size_t duals, uint32_t *at) {
    t->spent = !sli_cover_pay(t);
    if (t->spent) return SL_OK;
    SL_TRY(sl_check_cancelled(context));
    const size_t count = t->fixes.count;
    return undo(context, t, count, grow_node(context, t, duals, at), at);
}

/// A tree for one target; what it proves goes to the part only when it is whole.
static sl_status grow_whole(sl_context *context, tree *t, bool *is_whole) {
    sli_cover_part *part = t->part, kept = *part;
    part->nodes.items = NULL;
    part->duals.items = NULL;
    part->nodes.count = part->nodes.capacity = part->duals.count = part->duals.capacity = 0;
    t->least = UINT64_MAX;
    sl_status status = SL_ARRAY_ROOM(context, &part->duals, t->cover->rows);
    if (status == SL_OK) {
        memcpy(part->duals.items, kept.duals.items, t->cover->rows * sizeof *kept.duals.items);
        part->duals.count = t->cover->rows;
        uint32_t root;
        status = grow(context, t, 0, &root);
    }
    *is_whole = status == SL_OK && !t->spent;
    if (*is_whole) {
        part->lower = t->least < part->cost ? t->least : part->cost;
        sl_free(context, kept.nodes.items);
        sl_free(context, kept.duals.items);
    } else {
        sl_free(context, part->nodes.items);
        sl_free(context, part->duals.items);
        memcpy(&part->nodes, &kept.nodes, sizeof kept.nodes);
        memcpy(&part->duals, &kept.duals, sizeof kept.duals);
    }
    return status;
}

/// The bound of the root, as good as the program has it; a leaf alone, which replaces the part's.
static sl_status bound_root(sl_context *context, tree *t, double *duals) {
    sli_cover_part *part = t->part;
    SL_TRY(find_duals(context, t, 0, 0));
    SL_TRY(fill_set(context, t));
    const uint32_t rows = t->cover->rows;
    const uint64_t bound = sli_cover_ceiling(bound_by(t, rows), part->denominator);
    part->duals.count = rows;
    if (bound < part->lower) return SL_OK;
    memcpy(part->duals.items, part->duals.items + rows, rows * sizeof *part->duals.items);
    memcpy(duals, t->y, rows * sizeof *duals);
    part->lower = bound;
    return SL_OK;
}

static sl_status tree_make(sl_context *context, tree *t, const sli_cover *cover) {
    t->cover = cover;
    SL_TRY(sli_cover_state_make(context, cover, &t->state));
    t->needed = sl_alloc_array(context, cover->columns, sizeof *t->needed);
    t->sums = sl_alloc_array(context, cover->columns, sizeof *t->sums);
    t->y = sl_alloc_array(context, cover->rows, sizeof *t->y);
    t->values = sl_alloc_array(context, cover->columns, sizeof *t->values);
    t->set = sl_alloc_array(context, cover->columns, sizeof *t->set);
    t->effects = sl_alloc_array(context, cover->columns, sizeof *t->effects);
    t->prospects = sl_alloc_array(context, cover->columns, sizeof *t->prospects);
    t->tried_y = sl_alloc_array(context, cover->rows, sizeof *t->tried_y);
    t->tried_values = sl_alloc_array(context, cover->columns, sizeof *t->tried_values);
    t->tried_duals = sl_alloc_array(context, cover->rows, sizeof *t->tried_duals);
    return t->needed && t->sums && t->y && t->values && t->set && t->effects && t->prospects &&
                   t->tried_y && t->tried_values && t->tried_duals
               ? SL_OK
               : SL_NO_MEMORY;
}

static void tree_destroy(sl_context *context, tree *t) {
    sli_cover_state_destroy(context, &t->state);
    sl_free(context, t->needed);
    sl_free(context, t->sums);
    sl_free(context, t->y);
    sl_free(context, t->values);
    sl_free(context, t->set);
    sl_free(context, t->effects);
    sl_free(context, t->prospects);
    sl_free(context, t->tried_y);
    sl_free(context, t->tried_values);
    sl_free(context, t->tried_duals);
}

/// Goes over to the problem with cuts, where it proves as much: then the part has them, and a leaf
/// alone.
static sl_status stand_on(sl_context *context, tree *t, sli_cover_cuts *cuts, bool *stands) {
    sli_cover_part *part = t->part, kept = *part;
    tree_destroy(context, t);
    *t = (tree){.part = part,
                .problem = t->problem,
                .program = t->program,
                .nodes_left = t->nodes_left,
                .fixes = t->fixes};
    SL_TRY(tree_make(context, t, &cuts->cover));
    const uint32_t rows = cuts->cover.rows;
    uint64_t bound = 0;
    part->denominator = sli_cover_denominator(&cuts->cover);
    part->duals.items = NULL;
    part->duals.count = part->duals.capacity = 0;
    sl_status status = part->denominator ? SL_ARRAY_ROOM(context, &part->duals, rows) : SL_OK;
    *stands = status == SL_OK && part->denominator;
    if (*stands) {
        memset(part->duals.items, 0, rows * sizeof *part->duals.items);
        part->duals.count = rows;
        status = find_duals(context, t, 0, 0);
    }
    if (*stands && status == SL_OK) status = fill_set(context, t);
    if (*stands && status == SL_OK) {
        memcpy(part->duals.items, part->duals.items + rows, rows * sizeof *part->duals.items);
        part->duals.count = rows;
        bound = sli_cover_ceiling(bound_by(t, 0), part->denominator);
    }
    *stands = *stands && status == SL_OK && bound >= kept.lower;
    sl_free(context, *stands ? kept.duals.items : part->duals.items);
    if (!*stands) {
        part->denominator = kept.denominator;
        memcpy(&part->duals, &kept.duals, sizeof kept.duals);
        return status;
    }
    part->lower = bound;
    part->cuts = *cuts;
    *cuts = (sli_cover_cuts){0};
    t->cover = &part->cuts.cover;
    return SL_OK;
}

/// Cuts raise the bound of the root. *stands: trees can be grown on.
static sl_status raise_root(sl_context *context, tree *t, bool *stands) {
    const sl_cover_options *o = t->part->options;
    *stands = true;
    if (!t->program || !o->program->change || !o->cuts || !o->nodes) return SL_OK;
    sli_cover_cuts cuts = {0};
    sl_status status = sli_cover_cut(context, t->part->cover, o, t->program, &t->problem,
                                     t->state.fixed, t->part->cost, 1, t->y, t->values, &cuts);
    const bool made = status == SL_OK || status == SL_CANCELLED;
    const sl_status stood = made ? stand_on(context, t, &cuts, stands) : status;
    sli_cover_cuts_destroy(context, &cuts);
    return stood == SL_OK ? status : stood;
}

static sl_status grow_trees(sl_context *context, tree *t, double *duals) {
    bool is_whole = true;
    if (t->program) SL_TRY(bound_root(context, t, duals));
    if (t->part->lower < t->part->cost) SL_TRY(raise_root(context, t, &is_whole));
    while (is_whole && t->part->lower < t->part->cost) {
        t->target = t->part->options->at_once ? t->part->cost : t->part->lower + 1;
        SL_TRY(grow_whole(context, t, &is_whole));
    }
    return SL_OK;
}

/// Whether the program may come to an end at the root: it takes a step for most rows at least, and
/// nothing interrupts it.
static bool suits_program(const sli_cover *cover) {
    return root_work / (1 + cover->column_first[cover->columns]) >= cover->rows / 2;
}

sl_status sli_cover_branch(sl_context *context, sli_cover_part *part, double *duals,
                           uint64_t *nodes) {
    const sl_cover_program *program = part->options->program;
    tree t = {.part = part, .problem = sli_cover_problem(part->cover), .nodes_left = nodes};
    sl_status status = tree_make(context, &t, part->cover);
    if (status == SL_OK && program && program->begin && suits_program(part->cover))
        status = program->begin(context, &t.problem, &t.program);
    if (status == SL_OK) status = grow_trees(context, &t, duals);
    if (t.program) program->end(context, t.program);
    tree_destroy(context, &t);
    sl_free(context, t.fixes.items);
    return status;
}
