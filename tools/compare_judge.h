/// Runs of several methods on one map: how right and how fast each was beside the others.
#ifndef COMPARE_JUDGE_H
#define COMPARE_JUDGE_H

#include "sightline/cell_to_cell.h"

typedef enum sl_run_outcome {
    SL_RUN_REFUSED,  ///< the map calls for what the method does not know
    SL_RUN_NOT_DONE, ///< it took longer than it was given
    SL_RUN_DONE,
} sl_run_outcome;

/// One method, with one solver where it needs any. The lower part stands where it is done, and zero
/// where not.
typedef struct sl_compare_run {
    const sl_see_method *method;
    const sl_solver *solver; ///< NULL for none
    sl_guarantee guarantee;
    sl_run_outcome outcome;
    char refusal[1024]; ///< why, where it is refused

    unsigned timings;
    double seconds;   ///< the median of the timings
    double low, high; ///< their quartiles
    sl_visibility visibility;

    bool judged; ///< against an exact answer; else these are 0:
    uint64_t too_many, too_few;
    double ratio;  ///< to the fastest exact run's seconds
    bool frontier; ///< no other run is as fast and as right, and better in one of the two
} sl_compare_run;

#define SL_NO_RUN SIZE_MAX

/// How many pairs are in `a` and not in `b`, which are of the same cells.
uint64_t sl_pvs_pairs_beyond(const sl_pvs *a, const sl_pvs *b);

/// The first exact run that is done, SL_NO_RUN for none: the others are held against it.
size_t sl_compare_reference(const sl_compare_run *runs, size_t count);

/// Fills in what the runs that are done are beside the reference; nothing where there is none.
void sl_compare_judge(sl_compare_run *runs, size_t count);

/// The numbers of the runs: those that are done, fastest first, then the others; ties as they are.
void sl_compare_order(const sl_compare_run *runs, size_t count, size_t *order);

#endif
