#include "compare_columns.h"

#include "names.h"

/// "done", "not done", "refused"
static const char *outcome_name(sl_run_outcome outcome) {
    static const char *const names[] = {
        [SL_RUN_REFUSED] = "refused", [SL_RUN_NOT_DONE] = "not done", [SL_RUN_DONE] = "done"};
    return names[outcome];
}

static sl_value of_text(const char *text) {
    return (sl_value){.kind = text ? SL_VALUE_TEXT : SL_VALUE_NONE, .text = text};
}

static sl_value real_if(bool known, double real) {
    return (sl_value){.kind = known ? SL_VALUE_REAL : SL_VALUE_NONE, .real = real};
}

static sl_value count_if(bool known, uint64_t count) {
    return (sl_value){.kind = known ? SL_VALUE_COUNT : SL_VALUE_NONE, .count = count};
}

static bool done(const sl_compare_run *run) {
    return run->outcome == SL_RUN_DONE;
}

static const sl_see_account *account(const sl_compare_run *run) {
    return &run->visibility.account;
}

/// One function a column: its name, and the value it gives for `run`.
#define COLUMN(name, expression)                                                                   \
    static sl_value column_##name(const sl_comparison *comparison, const sl_compare_run *run) {    \
        (void)comparison, (void)run;                                                               \
        return expression;                                                                         \
    }

COLUMN(method, of_text(run->method->name))
COLUMN(solver, of_text(run->solver ? run->solver->name : NULL))
COLUMN(sight, of_text(sl_sight_name(comparison->sight)))
COLUMN(guarantee, of_text(sl_guarantee_name(run->guarantee)))
COLUMN(outcome, of_text(outcome_name(run->outcome)))
COLUMN(timings, count_if(done(run), run->timings))
COLUMN(seconds, real_if(done(run), run->seconds))
COLUMN(seconds_low, real_if(done(run), run->low))
COLUMN(seconds_high, real_if(done(run), run->high))
COLUMN(ratio, real_if(run->ratio > 0, run->ratio))
COLUMN(tests, count_if(done(run), account(run)->tests))
COLUMN(seconds_per_test,
       real_if(account(run)->tests > 0, run->seconds / (double)account(run)->tests))
COLUMN(tree_nodes, count_if(done(run), account(run)->nodes))
COLUMN(longest_sequence, count_if(done(run), account(run)->deepest))
COLUMN(pairs, count_if(done(run), account(run)->pairs))
COLUMN(pairs_too_many, count_if(run->judged, run->too_many))
COLUMN(pairs_too_few, count_if(run->judged, run->too_few))
COLUMN(doubtful_pairs, count_if(done(run), account(run)->doubtful_pairs))
COLUMN(frontier, count_if(run->judged, run->frontier))
COLUMN(orientations, count_if(done(run), account(run)->stab.orientations))
COLUMN(exact_orientations, count_if(done(run), account(run)->stab.exact))
COLUMN(filter_share,
       real_if(account(run)->stab.orientations > 0,
               1 - (double)account(run)->stab.exact / (double)account(run)->stab.orientations))
COLUMN(certified, count_if(done(run), account(run)->stab.certified))
COLUMN(fallbacks, count_if(done(run), account(run)->stab.fallbacks))

const sl_compare_column *sl_compare_columns(size_t *count) {
#define ROW(name, what)                                                                            \
    { #name, what, column_##name }
    static const sl_compare_column columns[] = {
        ROW(method, "how cells were searched"),
        ROW(solver, "what stabbed portal sequences"),
        ROW(sight, "closed or open"),
        ROW(guarantee, "what is promised of the answer"),
        ROW(outcome, "done; not done, in the time given; refused, as the map\n                     "
                     " asks for what the method cannot do"),
        ROW(timings, "how often the run was timed"),
        ROW(seconds, "for all cells: the median, on one thread"),
        ROW(seconds_low, "the lower quartile"),
        ROW(seconds_high, "the upper quartile"),
        ROW(ratio, "seconds, to those of the fastest exact run"),
        ROW(tests, "portal sequences tested for a sightline"),
        ROW(seconds_per_test, "seconds / tests"),
        ROW(tree_nodes, "sequences that have one"),
        ROW(longest_sequence, "portals in the longest of them"),
        ROW(pairs, "ordered pairs of cells seen, each with itself included"),
        ROW(pairs_too_many, "of them those hidden by the exact answer"),
        ROW(pairs_too_few, "pairs seen by the exact answer only"),
        ROW(doubtful_pairs, "pairs of which rounding decided"),
        ROW(frontier, "1: no run is as fast and as right, and better in one"),
        ROW(orientations, "orientation tests by the solver"),
        ROW(exact_orientations, "those that the filter left to exact arithmetic"),
        ROW(filter_share, "the share that the filter decided"),
        ROW(certified, "rounded verdicts that predicates confirmed"),
        ROW(fallbacks, "verdicts that an exact solver gave instead"),
    };
#undef ROW
    *count = sizeof columns / sizeof *columns;
    return columns;
}
