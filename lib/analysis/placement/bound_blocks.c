/// Bounds of large parts of a set cover, block by block.
///
/// The linear program of a part with many rows takes too long. So the rows are put into blocks. A
/// pass improves the duals of one block after the other, while all others stay: a block may use
/// what columns cost less the duals of their other rows. So duals stay feasible and no pass lowers
/// the bound, both up to rounding. The check of the proof decides what is kept. Blocks of the next
/// pass are others, which mends what was lost at borders.
///
///     duals:  [ block 1 ][ block 2 ][ block 3 ]     one after the other
///             [ 1' ][  block 2'  ][  block 3' ]     then others
///
/// In the last pass each block gets cuts as well (cover_cuts.c). A cut of some rows of a block is
/// one of the part, so all of them together are the proof: a leaf with duals for rows and cuts.
///
/// Cost: a pass takes the simplex steps of all blocks, so it grows as the part does.
#include "analysis/placement/bound_blocks.h"

#include "analysis/placement/cover.h"
#include "base/base.h"

#include <stdlib.h>
#include <string.h>

/// Rows of a block, passes without cuts, rounds of cuts.
enum { BLOCK_ROWS = 800, PASSES = 4, CUT_ROUNDS = 6 };
/// What a cost of 1 is in the programs of blocks; simplex steps times entries that one may take.
enum { UNIT = 1 << 20, BLOCK_WORK = 1 << 30 };
/// Of the duals in the proof.
static const uint64_t denominator = (uint64_t)1 << 31;

typedef struct bounder {
    sl_context *context;
    const sl_cover_program *program;
    sli_cover cover; ///< the part: its rows and columns by their places
    double *y;       ///< by row
    double *rest;    ///< by column: its cost, less the duals of its rows and cuts
    bool *done;      ///< by row: it is in a block of this pass
    uint32_t *names; ///< by row, and by column: its number in the block, or UINT32_MAX
    uint32_t *column_names;
    SL_ARRAY(uint32_t) rows; ///< of the block
    SL_ARRAY(uint32_t) columns;
    sli_cover block;
    sli_cover_cuts cuts; ///< of all blocks, named as in sl_cover_cuts; without a cover
    SL_ARRAY(double) cut_duals;
} bounder;

// --- the part

/// Marks what steps leave: UINT32_MAX is what they do not.
static void follow_steps(const sl_cover_problem *p, const sl_cover_proof *proof,
                         uint32_t *row_names, uint32_t *column_names) {
    memset(row_names, 0, p->row_count * sizeof *row_names);
    memset(column_names, 0, p->column_count * sizeof *column_names);
    for (uint32_t i = 0; i < proof->step_count; i++) {
        const sl_cover_step *s = &proof->steps[i];
        if (s->kind == SL_COVER_ROW_GOES) {
            row_names[s->what] = UINT32_MAX;
            continue;
        }
        column_names[s->what] = UINT32_MAX;
        const size_t first = s->what ? p->ends[s->what - 1] : 0;
        for (size_t k = first; k < p->ends[s->what] && s->kind == SL_COVER_COLUMN_TAKEN; k++)
            row_names[p->entries[k]] = UINT32_MAX;
    }
}

/// Of the parts that are a leaf alone, the one with the most rows, if these are more than `most`;
/// else UINT32_MAX. Numbers its rows, and no others.
static sl_status choose_part(sl_context *context, const sl_cover_problem *p,
                             const sl_cover_proof *proof, uint32_t most, uint32_t *row_names,
                             uint32_t *best) {
    uint32_t *counts = sl_alloc_array(context, proof->part_count, sizeof *counts);
    if (!counts) return SL_NO_MEMORY;
    *best = UINT32_MAX;
    for (uint32_t r = 0; r < p->row_count; r++)
        if (row_names[r] != UINT32_MAX && proof->parts[r] < proof->part_count)
            counts[proof->parts[r]]++;
    for (uint32_t part = 0; part < proof->part_count; part++) {
        const sl_cover_node *root = &proof->nodes[part];
        if (counts[part] <= most || root->column != UINT32_MAX || root->duals == SIZE_MAX) continue;
        most = counts[part];
        *best = part;
    }
    sl_free(context, counts);
    for (uint32_t r = 0, rows = 0; r < p->row_count; r++)
        if (row_names[r] != UINT32_MAX)
            row_names[r] = proof->parts[r] == *best ? rows++ : UINT32_MAX;
    return SL_OK;
}

/// The part by itself. Numbers its columns.
static sl_status make_cover(bounder *b, const sl_cover_problem *p, const uint32_t *row_names,
                            uint32_t *column_names) {
    uint32_t rows = 0, columns = 0;
    size_t entries = 0;
    for (uint32_t r = 0; r < p->row_count; r++) rows += row_names[r] != UINT32_MAX;
    for (uint32_t j = 0; j < p->column_count; j++) {
        const size_t before = entries;
        for (size_t k = j ? p->ends[j - 1] : 0; k < p->ends[j]; k++)
            entries += column_names[j] != UINT32_MAX && row_names[p->entries[k]] != UINT32_MAX;
        column_names[j] = entries > before ? columns++ : UINT32_MAX;
    }
    SL_TRY(sli_cover_make(b->context, rows, columns, entries, &b->cover));
    entries = 0;
    for (uint32_t j = 0; j < p->column_count; j++) {
        if (column_names[j] == UINT32_MAX) continue;
        for (size_t k = j ? p->ends[j - 1] : 0; k < p->ends[j]; k++)
            if (row_names[p->entries[k]] != UINT32_MAX)
                b->cover.column_rows[entries++] = row_names[p->entries[k]];
        b->cover.column_first[column_names[j] + 1] = entries;
        b->cover.costs[column_names[j]] = 1;
    }
    for (uint32_t r = 0; r < rows; r++) b->cover.demands[r] = 1;
    sli_cover_turn(&b->cover);
    return SL_OK;
}

static double worth_of(const bounder *b, uint32_t column) {
    double worth = 0;
    for (size_t k = b->cover.column_first[column]; k < b->cover.column_first[column + 1]; k++)
        worth += b->y[b->cover.column_rows[k]];
    return worth;
}

/// Begins with those of the proof, made feasible: a row gives way to the column that asks most.
static void begin_duals(bounder *b, const uint64_t *duals, uint64_t unit) {
    const sli_cover *c = &b->cover;
    for (uint32_t r = 0; r < c->rows; r++) b->y[r] = (double)duals[r] / (double)unit;
    for (uint32_t j = 0; j < c->columns; j++) b->rest[j] = worth_of(b, j);
    for (uint32_t r = 0; r < c->rows; r++) {
        double most = 1;
        for (size_t k = c->row_first[r]; k < c->row_first[r + 1]; k++)
            if (b->rest[c->row_columns[k]] > most) most = b->rest[c->row_columns[k]];
        b->y[r] /= most;
    }
    for (uint32_t j = 0; j < c->columns; j++) b->rest[j] = 1 - worth_of(b, j);
}

// --- blocks

/// Grows a block from a row: rows that share columns, breadth first, as far as they are not done.
static sl_status grow(bounder *b, uint32_t seed, size_t most) {
    const sli_cover *c = &b->cover;
    b->rows.count = b->columns.count = 0;
    SL_TRY(SL_ARRAY_ROOM(b->context, &b->rows, most));
    b->rows.items[b->rows.count++] = seed;
    b->done[seed] = true;
    for (size_t i = 0; i < b->rows.count; i++) {
        const uint32_t row = b->rows.items[i];
        for (size_t k = c->row_first[row]; k < c->row_first[row + 1]; k++) {
            const uint32_t j = c->row_columns[k];
            if (b->column_names[j] != UINT32_MAX) continue;
            b->column_names[j] = (uint32_t)b->columns.count;
            SL_TRY(SL_ARRAY_ROOM(b->context, &b->columns, 1));
            b->columns.items[b->columns.count++] = j;
            for (size_t e = c->column_first[j]; e < c->column_first[j + 1]; e++) {
                const uint32_t other = c->column_rows[e];
                if (b->done[other] || b->rows.count == most) continue;
                b->done[other] = true;
                b->rows.items[b->rows.count++] = other;
            }
        }
    }
    qsort(b->rows.items, b->rows.count, sizeof *b->rows.items, sli_compare_whole);
    for (size_t i = 0; i < b->rows.count; i++) b->names[b->rows.items[i]] = (uint32_t)i;
    return SL_OK;
}

/// Takes the duals of the block's rows off, and makes its problem of what columns have left.
static sl_status make_block(bounder *b) {
    const sli_cover *c = &b->cover;
    size_t entries = 0;
    for (size_t i = 0; i < b->rows.count; i++)
        entries += c->row_first[b->rows.items[i] + 1] - c->row_first[b->rows.items[i]];
    sli_cover_destroy(b->context, &b->block);
    SL_TRY(sli_cover_make(b->context, (uint32_t)b->rows.count, (uint32_t)b->columns.count, entries,
                          &b->block));
    entries = 0;
    for (size_t i = 0; i < b->columns.count; i++) {
        const uint32_t j = b->columns.items[i];
        double left = b->rest[j];
        for (size_t k = c->column_first[j]; k < c->column_first[j + 1]; k++) {
            const uint32_t row = c->column_rows[k];
            if (b->names[row] == UINT32_MAX) continue;
            left += b->y[row];
            b->block.column_rows[entries++] = b->names[row];
        }
        b->block.column_first[i + 1] = entries;
        b->block.costs[i] = left > 0 ? (uint32_t)(left * UNIT) : 0;
    }
    for (uint32_t r = 0; r < b->block.rows; r++) b->block.demands[r] = 1;
    sli_cover_turn(&b->block);
    return SL_OK;
}

/// Puts the block's duals in place of those before. `cover`: its rows, and cuts if there are some.
static void take_duals(bounder *b, const sli_cover *cover, const double *duals) {
    for (uint32_t i = 0; i < cover->columns; i++) {
        double change = 0;
        for (size_t k = cover->column_first[i]; k < cover->column_first[i + 1]; k++) {
            const uint32_t row = cover->column_rows[k];
            change += duals[row] > 0 ? duals[row] / UNIT : 0;
            if (row < b->rows.count) change -= b->y[b->rows.items[row]];
        }
        b->rest[b->columns.items[i]] -= change;
    }
    for (size_t i = 0; i < b->rows.count; i++)
        b->y[b->rows.items[i]] = duals[i] > 0 ? duals[i] / UNIT : 0;
}

/// Takes the cuts of the block, named as those of the part.
static sl_status take_cuts(bounder *b, const sli_cover_cuts *cuts, const double *duals) {
    const uint32_t rows = (uint32_t)b->rows.count;
    const uint32_t before = b->cover.rows + (uint32_t)b->cuts.ends.count;
    SL_TRY(SL_ARRAY_ROOM(b->context, &b->cuts.rows, cuts->rows.count));
    SL_TRY(SL_ARRAY_ROOM(b->context, &b->cuts.ends, cuts->ends.count));
    SL_TRY(SL_ARRAY_ROOM(b->context, &b->cut_duals, cuts->ends.count));
    const size_t first = b->cuts.rows.count;
    for (size_t k = 0; k < cuts->rows.count; k++) {
        const uint32_t row = cuts->rows.items[k];
        b->cuts.rows.items[b->cuts.rows.count++] =
            row < rows ? b->rows.items[row] : before + row - rows;
    }
    for (size_t i = 0; i < cuts->ends.count; i++) {
        b->cuts.ends.items[b->cuts.ends.count++] = first + cuts->ends.items[i];
        b->cut_duals.items[b->cut_duals.count++] = duals[rows + i] > 0 ? duals[rows + i] / UNIT : 0;
    }
    return SL_OK;
}

/// Room for what a program gives: duals of `rows`, values by column, and what is fixed: nothing.
typedef struct answer {
    double *duals, *values;
    uint8_t *fixed;
} answer;

static sl_status make_answer(sl_context *context, const sli_cover *cover, answer *out) {
    sl_free(context, out->duals);
    out->duals = sl_alloc_array(context, cover->rows, sizeof *out->duals);
    if (!out->values) out->values = sl_alloc_array(context, cover->columns, sizeof *out->values);
    if (!out->fixed) out->fixed = sl_alloc_array(context, cover->columns, sizeof *out->fixed);
    return out->duals && out->values && out->fixed ? SL_OK : SL_NO_MEMORY;
}

static sl_status run_program(bounder *b, void *state, const sli_cover *cover, answer *a) {
    SL_TRY(make_answer(b->context, cover, a));
    const uint64_t work = 1 + BLOCK_WORK / (1 + cover->column_first[cover->columns]);
    return b->program->again(b->context, state, a->fixed, work, 0, a->duals, a->values);
}

static sl_status add_cuts(bounder *b, void *state, sl_cover_problem *problem, answer *a) {
    const sl_cover_options options = {.program = b->program, .cuts = CUT_ROUNDS};
    sli_cover_cuts cuts = {0};
    sl_status status = sli_cover_cut(b->context, &b->block, &options, state, problem, a->fixed,
                                     UINT32_MAX, UNIT, a->duals, a->values, &cuts);
    const bool cancelled = status == SL_CANCELLED;
    if ((status == SL_OK || cancelled) && cuts.ends.count)
        status = run_program(b, state, &cuts.cover, a);
    if (status == SL_OK && cuts.ends.count) {
        take_duals(b, &cuts.cover, a->duals);
        status = take_cuts(b, &cuts, a->duals);
    }
    sli_cover_cuts_destroy(b->context, &cuts);
    return cancelled && status == SL_OK ? SL_CANCELLED : status;
}

/// Betters the duals of a block. Where the program finds none, they stay.
static sl_status improve_block(bounder *b, bool cuts) {
    SL_TRY(make_block(b));
    sl_cover_problem problem = sli_cover_problem(&b->block);
    answer a = {0};
    void *state = NULL;
    sl_status status = b->program->begin(b->context, &problem, &state);
    if (status == SL_OK) status = run_program(b, state, &b->block, &a);
    if (status == SL_OK) take_duals(b, &b->block, a.duals);
    if (status == SL_OK && cuts) status = add_cuts(b, state, &problem, &a);
    b->program->end(b->context, state);
    sl_free(b->context, a.duals);
    sl_free(b->context, a.values);
    sl_free(b->context, a.fixed);
    return status == SL_UNSUPPORTED ? SL_OK : status;
}

static sl_status pass(bounder *b, uint32_t number) {
    const uint32_t rows = b->cover.rows;
    size_t most = number % 2 ? BLOCK_ROWS / 2 : BLOCK_ROWS; // of the first one
    memset(b->done, 0, rows * sizeof *b->done);
    for (uint32_t i = 0; i < rows; i++) {
        const uint32_t seed = number % 2 ? rows - 1 - i : i;
        if (b->done[seed]) continue;
        SL_TRY(sl_check_cancelled(b->context));
        SL_TRY(grow(b, seed, most));
        SL_TRY(improve_block(b, number == PASSES));
        for (size_t k = 0; k < b->rows.count; k++) b->names[b->rows.items[k]] = UINT32_MAX;
        for (size_t k = 0; k < b->columns.count; k++)
            b->column_names[b->columns.items[k]] = UINT32_MAX;
        most = BLOCK_ROWS;
    }
    return SL_OK;
}

// --- the proof

static uint64_t rounded(double dual) {
    return dual < 0 ? 0 : dual > 1 ? denominator : (uint64_t)(dual * (double)denominator);
}

/// The leaf of the part with its cuts.
static sl_status make_raised(bounder *b, sl_cover_cuts *out) {
    const uint32_t rows = b->cover.rows, cuts = (uint32_t)b->cuts.ends.count;
    sl_cover_proof *rest = sl_alloc_array(b->context, 1, sizeof *rest);
    if (!rest) return SL_NO_MEMORY;
    *out = (sl_cover_cuts){rows, cuts, b->cuts.ends.items, b->cuts.rows.items, rest};
    b->cuts.ends.items = NULL;
    b->cuts.rows.items = NULL;
    *rest = (sl_cover_proof){.denominator = denominator,
                             .row_count = rows + cuts,
                             .part_count = 1,
                             .node_count = 1,
                             .dual_count = (size_t)rows + cuts};
    rest->parts = sl_alloc_array(b->context, rest->row_count, sizeof *rest->parts);
    rest->nodes = sl_alloc_array(b->context, 1, sizeof *rest->nodes);
    rest->duals = sl_alloc_array(b->context, rest->dual_count, sizeof *rest->duals);
    if (!rest->parts || !rest->nodes || !rest->duals) return SL_NO_MEMORY;
    rest->nodes[0] = (sl_cover_node){UINT32_MAX, {UINT32_MAX, UINT32_MAX}, 0};
    for (uint32_t r = 0; r < rows; r++) rest->duals[r] = rounded(b->y[r]);
    for (uint32_t i = 0; i < cuts; i++) rest->duals[rows + i] = rounded(b->cut_duals.items[i]);
    return SL_OK;
}

/// A proof with `raised` in place of the tree of a part, which has a leaf alone. It shares what it
/// does not change.
static sl_status replace(sl_context *context, const sl_cover_proof *from, uint32_t part,
                         const sl_cover_cuts *raised, sl_cover_proof *out) {
    *out = *from;
    out->part_count--;
    out->node_count--;
    out->raised_count++;
    out->nodes = sl_alloc_array(context, out->node_count, sizeof *out->nodes);
    out->parts = sl_alloc_array(context, out->row_count, sizeof *out->parts);
    out->raised = sl_alloc_array(context, out->raised_count, sizeof *out->raised);
    if (!out->nodes || !out->parts || !out->raised) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < out->node_count; i++) {
        out->nodes[i] = from->nodes[i + (i >= part)];
        for (int k = 0; k < 2; k++) {
            uint32_t *child = &out->nodes[i].children[k];
            if (*child != UINT32_MAX && *child > part) --*child;
        }
    }
    const uint32_t last = out->part_count + out->split_count + out->raised_count - 1;
    for (uint32_t r = 0; r < out->row_count; r++)
        out->parts[r] = from->parts[r] == part  ? last
                        : from->parts[r] > part ? from->parts[r] - 1
                                                : from->parts[r];
    for (uint32_t i = 0; i < from->raised_count; i++) out->raised[i] = from->raised[i];
    out->raised[from->raised_count] = *raised;
    return SL_OK;
}

static void destroy_raised(sl_context *context, sl_cover_cuts *raised) {
    if (raised->rest) sli_cover_proof_destroy(context, raised->rest);
    sl_free(context, raised->rest);
    sl_free(context, raised->ends);
    sl_free(context, raised->rows);
}

/// Takes the new proof if it proves more. What decides is the check; nothing cancels it.
static sl_status keep_if_better(bounder *b, const sl_cover_problem *problem, uint32_t part,
                                sl_cover_result *result) {
    sl_cover_cuts raised = {0};
    sl_cover_proof proof = {0};
    uint64_t lower = 0;
    sl_hooks hooks = *sl_context_hooks(b->context);
    hooks.cancelled = NULL;
    sl_context *calm = sl_context_create(&hooks);
    sl_status status = calm ? make_raised(b, &raised) : SL_NO_MEMORY;
    if (status == SL_OK) status = replace(b->context, &result->proof, part, &raised, &proof);
    if (status == SL_OK) status = sl_cover_check(calm, problem, &proof, &lower);
    sl_context_destroy(calm);
    if (status == SL_NO_MEMORY) sl_fail_memory(b->context);
    const bool better = status == SL_OK && lower > result->lower;
    sl_cover_proof *old = better ? &result->proof : &proof;
    sl_free(b->context, old->nodes);
    sl_free(b->context, old->parts);
    sl_free(b->context, old->raised);
    if (better) {
        result->proof = proof;
        result->lower = lower;
    } else {
        destroy_raised(b->context, &raised);
    }
    return status;
}

// --- all

static sl_status make(bounder *b, const sl_cover_proof *proof, uint32_t part) {
    const sli_cover *c = &b->cover;
    b->y = sl_alloc_array(b->context, c->rows, sizeof *b->y);
    b->done = sl_alloc_array(b->context, c->rows, sizeof *b->done);
    b->names = sl_alloc_array(b->context, c->rows, sizeof *b->names);
    b->rest = sl_alloc_array(b->context, c->columns, sizeof *b->rest);
    b->column_names = sl_alloc_array(b->context, c->columns, sizeof *b->column_names);
    if (!b->y || !b->done || !b->names || !b->rest || !b->column_names) return SL_NO_MEMORY;
    for (uint32_t r = 0; r < c->rows; r++) b->names[r] = UINT32_MAX;
    for (uint32_t j = 0; j < c->columns; j++) b->column_names[j] = UINT32_MAX;
    begin_duals(b, proof->duals + proof->nodes[part].duals, proof->denominator);
    return SL_OK;
}

static void destroy(bounder *b) {
    sli_cover_destroy(b->context, &b->cover);
    sli_cover_destroy(b->context, &b->block);
    sli_cover_cuts_destroy(b->context, &b->cuts);
    sl_free(b->context, b->y);
    sl_free(b->context, b->rest);
    sl_free(b->context, b->done);
    sl_free(b->context, b->names);
    sl_free(b->context, b->column_names);
    sl_free(b->context, b->rows.items);
    sl_free(b->context, b->columns.items);
    sl_free(b->context, b->cut_duals.items);
}

static sl_status better_part(bounder *b, const sl_cover_problem *problem, uint32_t part,
                             sl_cover_result *result) {
    SL_TRY(make(b, &result->proof, part));
    sl_status status = SL_OK;
    for (uint32_t i = 0; i <= PASSES && status == SL_OK; i++) status = pass(b, i);
    if (status != SL_OK && status != SL_CANCELLED) return status;
    const sl_status kept = keep_if_better(b, problem, part, result);
    return kept == SL_OK ? status : kept;
}

sl_status sli_bound_by_blocks(sl_context *context, const sl_cover_problem *problem,
                              const sl_cover_program *program, uint32_t many,
                              sl_cover_result *result) {
    if (!program || !program->begin || !program->change) return SL_OK;
    uint32_t *row_names = sl_alloc_array(context, problem->row_count, sizeof *row_names);
    uint32_t *column_names = sl_alloc_array(context, problem->column_count, sizeof *column_names);
    bounder b = {.context = context, .program = program};
    uint32_t part = UINT32_MAX;
    sl_status status = row_names && column_names ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        follow_steps(problem, &result->proof, row_names, column_names);
        status = choose_part(context, problem, &result->proof, many, row_names, &part);
    }
    if (status == SL_OK && part != UINT32_MAX)
        status = make_cover(&b, problem, row_names, column_names);
    sl_free(context, row_names);
    sl_free(context, column_names);
    if (status == SL_OK && part != UINT32_MAX) status = better_part(&b, problem, part, result);
    destroy(&b);
    return status;
}
