/// What the files of set cover share: the problem both ways, what reductions leave of it, and
/// bounds in integers. Begin with set_cover.c.
#ifndef SLI_COVER_H
#define SLI_COVER_H

#include "sightline/set_cover.h"
#include "sightline/support.h"

/// Modules for JavaScript have no linear program: nothing leads to what asks one.
#ifdef SLI_WITHOUT_PROGRAMS
enum { SLI_PROGRAMS = 0 };
#else
enum { SLI_PROGRAMS = 1 };
#endif

/// A problem by columns and by rows, lists ascending.
typedef struct sli_cover {
    uint32_t rows, columns;
    size_t *column_first, *row_first;    ///< one more than there are
    uint32_t *column_rows, *row_columns; ///< NULL in a problem without entries
    uint32_t *costs, *demands;
} sli_cover;

/// Room for a problem; `entries` of all columns together.
sl_status sli_cover_make(sl_context *context, uint32_t rows, uint32_t columns, size_t entries,
                         sli_cover *out);
/// Makes the lists by row of those by column.
void sli_cover_turn(sli_cover *cover);
void sli_cover_destroy(sl_context *context, sli_cover *cover);
void sli_cover_proof_destroy(sl_context *context, sl_cover_proof *proof); ///< and zeroes it
/// The same for a program, as long as the cover is there.
sl_cover_problem sli_cover_problem(const sli_cover *cover);
/// The caller's problem, its columns checked; costs are divided, and 1 each where `divisor` is 0.
sl_status sli_cover_read(sl_context *context, const sl_cover_problem *problem, uint32_t divisor,
                         sli_cover *out);

/// What is taken and what is left undecided on the way down a tree.
enum { SLI_COVER_FREE, SLI_COVER_OUT, SLI_COVER_IN };
typedef struct sli_cover_state {
    uint8_t *fixed; ///< by column
    int64_t *rest;  ///< by row: what is still demanded; negative where more is taken
    uint32_t *free; ///< by row: how many free columns it has
    uint64_t taken; ///< cost
} sli_cover_state;

sl_status sli_cover_state_make(sl_context *context, const sli_cover *cover, sli_cover_state *out);
void sli_cover_state_destroy(sl_context *context, sli_cover_state *state);
/// A free column is taken or left; and the same undone.
void sli_cover_fix(const sli_cover *cover, sli_cover_state *state, uint32_t column, uint8_t how);
void sli_cover_unfix(const sli_cover *cover, sli_cover_state *state, uint32_t column);

/// As sl_cover_solve(). `values`: NULL, or by column about what share of it the Lagrangian search
/// takes; 0 for columns that steps take or leave.
sl_status sli_cover_solve(sl_context *context, const sl_cover_problem *problem,
                          const sl_cover_options *options, double *values, sl_cover_result *out);

// --- reductions

/// What steps leave.
typedef struct sli_cover_left {
    SL_ARRAY(sl_cover_step) steps;
    bool *row_there, *column_there;
    uint32_t *rest; ///< by row: what is still demanded
    uint8_t *taken; ///< by column: taken by a step
} sli_cover_left;

/// Dominated rows and columns go and essential columns are taken, until nothing changes.
sl_status sli_cover_reduce(sl_context *context, const sli_cover *cover, sli_cover_left *out);
void sli_cover_left_destroy(sl_context *context, sli_cover_left *left);

// --- sets

/// Sets of columns are bytes by column. Completes `taken` to a cover by the columns that cost least
/// for what they cover, then drops what is not needed. `duals` by row, or NULL: they make rows that
/// are hard to cover worth more. Columns that `fixed` (NULL: none) leaves are not taken, and those
/// that it takes stay.
sl_status sli_cover_greedy(sl_context *context, const sli_cover *cover, const double *duals,
                           const uint8_t *fixed, uint8_t *taken);
uint64_t sli_cover_cost(const sli_cover *cover, const uint8_t *taken);

/// Betters a cover by local search, until it costs no more than `enough` or `iterations` are over.
sl_status sli_cover_search(sl_context *context, const sli_cover *cover, uint64_t enough,
                           uint64_t iterations, uint8_t *taken);

/// Betters a set of at most `count` columns that covers much, from `taken` on; costs are 1 each.
/// Weights by row sum up below 2^62. Cancelled, it keeps the best so far.
sl_status sli_cover_search_most(sl_context *context, const sli_cover *cover, const int64_t *weights,
                                uint32_t count, uint64_t iterations, uint8_t *taken);

// --- bounds

/// The numerator of a bound: by its duals in integers, over `denominator`. `sums`: NULL, or by
/// column the sum of the duals of its rows with demand.
int64_t sli_cover_bound(const sli_cover *cover, const sli_cover_state *state, const uint64_t *duals,
                        uint64_t denominator, int64_t *sums);
/// The duals as integers, where bounds cannot overflow: at most the largest cost each.
void sli_cover_duals_round(const sli_cover *cover, const double *duals, uint64_t denominator,
                           uint64_t *out);
/// The largest power of two, up to 2^31, with which no bound comes near 2^63; 0 where that is none.
uint64_t sli_cover_denominator(const sli_cover *cover);
/// The least whole number that is not below numerator / denominator; 0 for what is negative.
uint64_t sli_cover_ceiling(int64_t numerator, uint64_t denominator);

/// Lagrangian search: betters `duals` until the bound passes `upper - 1` or `iterations` are over.
/// `values` by column: about what share of it the relaxation takes. `set`: NULL, or a cover that is
/// bettered by the way.
sl_status sli_cover_lagrange(sl_context *context, const sli_cover *cover,
                             const sli_cover_state *state, uint64_t upper, uint64_t iterations,
                             double *duals, double *values, uint8_t *set);

// --- the tree

/// Rows that follow from those of a part, as in sl_cover_cuts.
typedef struct sli_cover_cuts {
    SL_ARRAY(size_t) ends; ///< by cut
    SL_ARRAY(uint32_t) rows;
    sli_cover cover; ///< the part's rows, then cuts; an entry as often as its coefficient says
} sli_cover_cuts;

/// A part of the problem, its best cover, and why nothing is cheaper.
typedef struct sli_cover_part {
    const sli_cover *cover;
    sli_cover_cuts cuts; ///< where there are some, nodes and duals are for cuts.cover
    const sl_cover_options *options;
    uint64_t denominator;
    uint8_t *taken;
    uint64_t cost, lower;
    SL_ARRAY(sl_cover_node) nodes; ///< the root is the last one, and children are before parents
    SL_ARRAY(uint64_t) duals;
} sli_cover_part;

/// Betters bound and cover by branching. The part has a root alone; `duals` are its, and become
/// those of the program.
sl_status sli_cover_branch(sl_context *context, sli_cover_part *part, double *duals,
                           uint64_t *nodes);

// --- cuts

/// Makes cuts from what a program takes in part, as long as its bound rises by them and proves no
/// `enough`. `unit`: what a cost of 1 is in `plain`; rises are measured by it. `state` and
/// `problem` are the program's, for `plain`; they become those of out->cover, unless `out` is
/// empty. `duals` and `values`: of `plain`; values of the last run come back. Cancelled, it gives
/// the cuts so far.
sl_status sli_cover_cut(sl_context *context, const sli_cover *plain,
                        const sl_cover_options *options, void *state, sl_cover_problem *problem,
                        const uint8_t *fixed, uint64_t enough, double unit, const double *duals,
                        double *values, sli_cover_cuts *out);
void sli_cover_cuts_destroy(sl_context *context, sli_cover_cuts *cuts); ///< and zeroes it

// --- splits

/// Betters the bound of a part by splitting it, where that can be; else `out` is empty. `duals`: of
/// the part's linear program.
sl_status sli_cover_split(sl_context *context, sli_cover_part *part, const double *duals,
                          sl_cover_split *out);
void sli_cover_split_destroy(sl_context *context, sl_cover_split *split); ///< and zeroes it

#endif
