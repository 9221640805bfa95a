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
/// The bound never rests on rounding. Duals come from anywhere (a Lagrangian search, a linear
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
} sl_cover_program;

/// What to do, and how much of it. sl_cover_options_default() has the usual values.
typedef struct sl_cover_options {
    const sl_cover_program *program; ///< NULL: Lagrangian bounds alone
    uint64_t nodes;                  ///< of the branching tree, at most; 0: no tree
    uint64_t iterations;             ///< of the local search and of the Lagrangian search, at most
    uint64_t known_lower;            ///< a bound that the caller has from elsewhere; 0 for none
    const uint32_t *start; ///< columns to start from: a set that the caller has; NULL for none
    uint32_t start_count;
} sl_cover_options;

SL_API sl_cover_options sl_cover_options_default(void);

/// A node of the branching tree that proves the lower bound. A leaf has duals: y[row] / denominator
/// each, integers. An inner node has a column, in its first child not taken and in its second one
/// taken.
typedef struct sl_cover_node {
    uint32_t column; ///< of an inner node; UINT32_MAX: a leaf
    uint32_t children[2];
    size_t duals; ///< of a leaf: where its row_count duals start in sl_cover_proof.duals
} sl_cover_node;

/// Why no set costs less than `lower`. Node 0 is the root. For a leaf, with the columns taken and
/// not taken on the way to it, the bound is
///
///     sum over taken columns of cost + sum over rows of y * (what is still demanded)
///         - sum over free columns of max(0, sum of its rows' y - cost)
///
/// rounded up to an integer; without a free column left that covers some row's rest, or with more
/// demanded than there is, a leaf holds no set at all.
typedef struct sl_cover_proof {
    uint64_t denominator; ///< of all duals; at least 1
    uint32_t node_count, row_count;
    sl_cover_node *nodes;
    uint64_t *duals;
} sl_cover_proof;

/// Zeroed, it is empty.
typedef struct sl_cover_result {
    uint32_t count;
    uint32_t *columns;    ///< ascending; they cover all rows
    uint64_t cost;        ///< of these columns
    uint64_t lower;       ///< no set costs less
    sl_cover_proof proof; ///< of `lower`
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

/// The most weight that `count` columns can cover, with an upper bound: `weights` by row.
SL_API sl_status sl_cover_most(sl_context *context, const sl_cover_problem *problem,
                               const double *weights, uint32_t count,
                               const sl_cover_options *options, sl_cover_result *out,
                               double *covered, double *bound);

#ifdef __cplusplus
}
#endif

#endif
