/// Set cover: the cheapest columns that cover every row, with a lower bound that is proven in
/// integers. Placement asks it which viewpoints see all witnesses; it knows nothing of geometry.
///
///     sl_cover_problem problem = {rows, columns, ends, entries, NULL, NULL};
///     sl_cover_result result;
///     sl_status status = sl_cover_solve(context, &problem, NULL, &result);
///     if (status == SL_OK && result.lower == result.cost) // nothing is cheaper
///         for (uint32_t i = 0; i < result.count; ++i) use(result.columns[i]);
///     sl_cover_result_destroy(context, &result);
///
/// The bound never rests on rounding. Its duals come from anywhere (a Lagrangian search, a linear
/// program in doubles); they are made integers over a common denominator, and count only as far as
/// they are feasible in integers.
#ifndef SIGHTLINE_SET_COVER_H
#define SIGHTLINE_SET_COVER_H

#include "sightline/context.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Columns cover rows. Entries of a column are row numbers in ascending order, each once.
typedef struct sl_cover_problem {
    uint32_t row_count, column_count;
    const size_t *ends;      ///< by column: the number of entries up to its last one
    const uint32_t *entries; ///< column after column
    const uint32_t *costs;   ///< by column, at least 1; NULL: 1 each
    const uint32_t *demands; ///< by row: how many different columns must cover it, 0 for none;
                             ///< NULL: 1 each
} sl_cover_problem;

/// A solver of linear programs, for bounds and for guiding the search. Rounded: nobody trusts it.
/// In its problems, a row that repeats in a column is a coefficient: 2 where it is there twice.
typedef struct sl_cover_program {
    const char *name, *what;
    /// The relaxation of a problem, each column taken 0 to 1 times: duals by row (any sign), values
    /// by column. SL_UNSUPPORTED where it finds no optimum. `work`: simplex steps at most, 0 for no
    /// limit.
    sl_status (*relax)(sl_context *context, const sl_cover_problem *problem, uint64_t work,
                       double *duals, double *values);
    /// The integer program with a limit in nodes: the columns of the best set that it found, and
    /// their number. May be NULL.
    sl_status (*branch)(sl_context *context, const sl_cover_problem *problem, uint64_t nodes,
                        uint32_t *columns, uint32_t *count);
    /// The same relaxation again and again, while columns are taken and left: each run goes on from
    /// the basis of the one before. The problem stays where it is until `end` or `change`. May be
    /// NULL, all three.
    sl_status (*begin)(sl_context *context, const sl_cover_problem *problem, void **state);
    /// `fixed` by column: 0 free, 1 not taken, 2 taken. Ends early where the bound passes `enough`;
    /// then duals are right, and values are not. `enough` 0: it does not.
    sl_status (*again)(sl_context *context, void *state, const uint8_t *fixed, uint64_t work,
                       double enough, double *duals, double *values);
    void (*end)(sl_context *context, void *state);
    /// Goes on with another problem: the same columns, the rows that are not `gone` (by row of the
    /// one before), then others. May be NULL.
    sl_status (*change)(sl_context *context, void *state, const sl_cover_problem *problem,
                        const bool *gone);
} sl_cover_program;

/// What to do, and how much of it. sl_cover_options_default() has the usual values.
typedef struct sl_cover_options {
    const sl_cover_program *program; ///< NULL: Lagrangian bounds alone
    /// Of the branching trees, at most; 0: no tree. In a part of more than 512 entries, a node
    /// counts for one more for each 512.
    uint64_t nodes;
    uint64_t iterations;   ///< of the local search and of the Lagrangian search, at most
    uint64_t known_lower;  ///< a bound that the caller has from elsewhere; 0 for none
    const uint32_t *start; ///< columns to start from: a set that the caller has; NULL for none
    uint32_t start_count;
    bool at_once; ///< a tree is grown for the best set at once, not bound by bound: all or nothing
    uint32_t splits; ///< how often a part that its tree leaves open is split; 0: never
    uint32_t cuts;   ///< rounds of cuts for a part at most, before its tree; 0: none
} sl_cover_options;

/// No program; 10,000 nodes, 50,000 iterations, 60 rounds of cuts.
SL_API sl_cover_options sl_cover_options_default(void);

/// A step that makes a problem smaller and keeps its least cost. Steps are taken one after the
/// other; each speaks of the rows and columns that those before it left, and of what is still
/// demanded.
typedef enum sl_cover_step_kind {
    SL_COVER_ROW_GOES,    ///< every column that covers row `by` covers row `what`, which demands no
                          ///< more; a bound without the row is a bound in any case
    SL_COVER_COLUMN_GOES, ///< column `by` covers all that column `what` does, and costs no more;
                          ///< these rows demand one column each
    SL_COVER_COLUMN_TAKEN, ///< row `by` demands all columns that it has, `what` among them
} sl_cover_step_kind;

/// One step: what it says of a row or column, and by which other one.
typedef struct sl_cover_step {
    uint32_t kind; ///< sl_cover_step_kind
    uint32_t what, by;
} sl_cover_step;

/// A node of a branching tree. A leaf is bounded by its duals. An inner node has a column, in its
/// first child not taken and in its second one taken. A child that is UINT32_MAX is not in the
/// tree: the node's duals bound it, or no set is left there.
typedef struct sl_cover_node {
    uint32_t column; ///< of an inner node; UINT32_MAX: a leaf
    uint32_t children[2];
    size_t duals; ///< where its duals start in sl_cover_proof.duals: one for each row of its part
                  ///< that the steps left, ascending; SIZE_MAX: all of them 0
} sl_cover_node;

/// Why no set costs less than `lower`. The steps leave a problem that falls into parts: no column
/// covers rows of two. Each part has a tree; the part's bound is the least one of its leaves. The
/// bounds of the parts and the costs of the columns that steps took add up.
///
/// With the columns taken and not taken on the way to it, a leaf's bound is
///
///     sum over taken columns of cost + sum over rows of y * (what is still demanded)
///         - sum over free columns of max(0, sum of y over its rows with demand - cost)
///
/// where y = dual / denominator, rounded up to a multiple of the greatest common divisor of all
/// costs. A leaf with a row that demands more columns than are free for it holds no set at all. For
/// a child that is not there, the bound is that of its node, and more by what is lost by taking the
/// column, max(0, cost - sum), or by not taking it, max(0, sum - cost).
///
/// A part may be split in place of a tree (sl_cover_split), or its tree be for more rows
/// (sl_cover_cuts).
typedef struct sl_cover_proof {
    uint64_t denominator; ///< of all duals; at least 1
    uint32_t row_count, step_count, part_count, node_count;
    size_t dual_count;
    sl_cover_step *steps;
    uint32_t *parts;      ///< by row: its part; of no meaning for a row that is gone
    sl_cover_node *nodes; ///< the first ones are the roots, by part; a child comes after its parent
    uint64_t *duals;
    uint32_t split_count;
    struct sl_cover_split *splits; ///< of the parts from part_count on
    uint32_t raised_count;
    struct sl_cover_cuts *raised; ///< of the parts behind those
} sl_cover_proof;

/// A part whose rows are in blocks. Each of its columns has a copy for each block that it has rows
/// of, in the order of its first rows there, and the copies share its cost: they are columns of
/// another problem, which no set solves for less than `rest` proves. A set of the part's columns
/// costs no less than its copies. So the bound, over `unit` and rounded up, is one for the part.
/// In units of the greatest common divisor of all costs.
typedef struct sl_cover_split {
    uint32_t unit;      ///< what a cost of 1 is, in costs of copies; at least 1
    uint32_t row_count; ///< of the part; also of the problem of the copies
    uint32_t *blocks;   ///< by row of the part
    uint32_t cost_count;
    uint32_t *costs;      ///< by copy, each 1 or more, column by column
    sl_cover_proof *rest; ///< for the copies: it splits nothing
} sl_cover_split;

/// A part with cuts: rows that follow from others, since sets take columns whole (Chvatal 1973). A
/// cut is half the sum of some rows, of the part or cuts before it, each coefficient and the demand
/// rounded up, and no coefficient above the demand. A set of the part fulfils all of them. So the
/// bound that `rest` proves for the part's rows and then the cuts is one for the part. In units of
/// the greatest common divisor of all costs.
typedef struct sl_cover_cuts {
    uint32_t row_count; ///< of the part
    uint32_t cut_count;
    size_t *ends;   ///< by cut: the number of its and all earlier rows
    uint32_t *rows; ///< of a cut, ascending: rows of the part in their order, behind them cuts
    sl_cover_proof *rest; ///< one part, without steps; numbers of columns are those in the part
} sl_cover_cuts;

/// Zeroed, it is empty.
typedef struct sl_cover_result {
    uint32_t count;
    uint32_t *columns;    ///< ascending; they cover all rows
    uint64_t cost;        ///< of these columns
    uint64_t lower;       ///< no set costs less
    sl_cover_proof proof; ///< of `lower`, as far as it is not known_lower
} sl_cover_result;

/// Covers all rows. NULL options: the default ones. SL_BAD_ARGUMENT, with the row, where a row
/// cannot be covered as often as it demands. Cancelled by the context, it returns the best set and
/// bound so far with SL_CANCELLED, once it has a set. The same input gives the same bytes.
SL_API sl_status sl_cover_solve(sl_context *context, const sl_cover_problem *problem,
                                const sl_cover_options *options, sl_cover_result *out);
SL_API void sl_cover_result_destroy(sl_context *context,
                                    sl_cover_result *result); ///< and zeroes it

/// Checks a proof in integers, trusting nothing in it: the bound that it proves, which may be less
/// than what is claimed; 0 where it is no proof.
SL_API sl_status sl_cover_check(sl_context *context, const sl_cover_problem *problem,
                                const sl_cover_proof *proof, uint64_t *lower);

/// The most weight that `count` columns can cover, with an upper bound: `weights` by row. The bound
/// is what they cover where they cover every row of weight that can be covered.
SL_API sl_status sl_cover_most(sl_context *context, const sl_cover_problem *problem,
                               const double *weights, uint32_t count,
                               const sl_cover_options *options, sl_cover_result *out,
                               double *covered, double *bound);

#ifdef __cplusplus
}
#endif

#endif
