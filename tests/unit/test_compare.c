/// Comparing methods: pairs too many and too few, the exact answer, the frontier, the order.
#include "testing.h"

#include "cell_to_cell/pvs_rows.h"

// The program has no library of its own: what is tested is the file.
#include "studies/compare_judge.c"

enum { CELLS = 130 }; // three words of bits, the last one not full

/// A PVS from a table of who sees whom.
static sl_pvs pvs_of(sl_context *context, bool sees[CELLS][CELLS]) {
    sli_row_bytes rows[CELLS] = {0};
    sl_pvs pvs;
    for (uint32_t a = 0; a < CELLS; a++) {
        sl_bits set[(CELLS + 63) / 64] = {0};
        for (uint32_t b = 0; b < CELLS; b++)
            if (sees[a][b]) sl_bits_add(set, b);
        assert_ok(context, sli_row_append(context, &rows[a], set, CELLS));
    }
    assert_ok(context, sli_pvs_join(context, rows, CELLS, &pvs));
    return pvs;
}

/// Against counting pair by pair, for sets of any density, empty rows and full ones among them.
static void pairs_beyond_are_those_of_one_only(void **state) {
    (void)state;
    static bool sees[2][CELLS][CELLS];
    sl_context *context = testing_context(NULL);
    uint32_t noise = 1;
    for (unsigned density = 0; density <= 8; density++) {
        uint64_t beyond[2] = {0, 0};
        for (uint32_t a = 0; a < CELLS; a++)
            for (uint32_t b = 0; b < CELLS; b++) {
                for (int k = 0; k < 2; k++) {
                    noise = noise * 1664525u + 1013904223u;
                    sees[k][a][b] = (noise >> 16) % 8 < density;
                }
                // Half of the rows are nearly alike, as those of two methods are.
                if (a % 2 && b % 16) sees[1][a][b] = sees[0][a][b];
                beyond[0] += sees[0][a][b] && !sees[1][a][b];
                beyond[1] += sees[1][a][b] && !sees[0][a][b];
            }
        sl_pvs first = pvs_of(context, sees[0]), second = pvs_of(context, sees[1]);
        assert_int_equal(pvs_pairs_beyond(&first, &second), beyond[0]);
        assert_int_equal(pvs_pairs_beyond(&second, &first), beyond[1]);
        assert_int_equal(pvs_pairs_beyond(&first, &first), 0);
        if (density % 8) assert_true(beyond[0] && beyond[1]);
        sl_pvs_destroy(context, &first);
        sl_pvs_destroy(context, &second);
    }
    sl_context_destroy(context);
}

/// What a run of the tests below saw: of cell 0's row, cells `first` to `end`.
typedef struct made_run {
    run_outcome outcome;
    sl_guarantee guarantee;
    double seconds;
    uint32_t first, end;
} made_run;

static void make_runs(sl_context *context, const made_run *made, size_t count, compare_run *runs) {
    for (size_t i = 0; i < count; i++) {
        static bool sees[CELLS][CELLS];
        memset(sees, 0, sizeof sees);
        for (uint32_t b = made[i].first; b < made[i].end; b++) sees[0][b] = true;
        runs[i] = (compare_run){
            .outcome = made[i].outcome, .guarantee = made[i].guarantee, .seconds = made[i].seconds};
        if (made[i].outcome == RUN_DONE) runs[i].visibility.pvs = pvs_of(context, sees);
    }
    compare_judge(runs, count);
}

static void destroy_runs(sl_context *context, compare_run *runs, size_t count) {
    for (size_t i = 0; i < count; i++) sl_visibility_destroy(context, &runs[i].visibility);
}

static void runs_are_held_against_the_first_exact_one(void **state) {
    (void)state;
    static const made_run made[] = {
        {RUN_REFUSED, SL_EXACT, 0, 0, 0},        {RUN_DONE, SL_ROUNDED, 1, 8, 30}, // 2 too many
        {RUN_NOT_DONE, SL_EXACT, 0, 0, 0},       {RUN_DONE, SL_EXACT, 4, 10, 30},  // the answer
        {RUN_DONE, SL_EXACT, 2, 10, 30},                                           // the fastest
        {RUN_DONE, SL_CONSERVATIVE, 0.5, 5, 40},                                   // 15 too many
        {RUN_DONE, SL_AGGRESSIVE, 0.25, 20, 30},                                   // 10 too few
        {RUN_DONE, SL_ROUNDED, 8, 9, 29},                                          // one of each
    };
    static const struct {
        bool judged;
        uint64_t many, few;
        double ratio;
        bool frontier;
    } due[] = {
        {false, 0, 0, 0, false},    {true, 2, 0, 0.5, true}, {false, 0, 0, 0, false},
        {true, 0, 0, 2, false},     {true, 0, 0, 1, true},   {true, 15, 0, 0.25, true},
        {true, 0, 10, 0.125, true}, {true, 1, 1, 4, false},
    };
    enum { COUNT = sizeof made / sizeof *made };
    sl_context *context = testing_context(NULL);
    compare_run runs[COUNT];
    make_runs(context, made, COUNT, runs);
    assert_int_equal(compare_reference(runs, COUNT), 3);
    for (size_t i = 0; i < COUNT; i++) {
        assert_int_equal(runs[i].judged, due[i].judged);
        assert_int_equal(runs[i].too_many, due[i].many);
        assert_int_equal(runs[i].too_few, due[i].few);
        assert_true(runs[i].ratio == due[i].ratio);
        assert_int_equal(runs[i].frontier, due[i].frontier);
    }
    destroy_runs(context, runs, COUNT);
    sl_context_destroy(context);
}

/// Neither kind of error makes up for the other; runs that are the same in all are both kept.
static void the_frontier_weighs_each_error_by_itself(void **state) {
    (void)state;
    static const made_run made[] = {
        {RUN_DONE, SL_EXACT, 8, 10, 30},        // the answer
        {RUN_DONE, SL_CONSERVATIVE, 4, 9, 30},  // 1 too many
        {RUN_DONE, SL_AGGRESSIVE, 5, 11, 30},   // 1 too few, slower: another fault
        {RUN_DONE, SL_CONSERVATIVE, 5, 9, 30},  // as the first, slower: beaten
        {RUN_DONE, SL_CONSERVATIVE, 4, 10, 31}, // the same as the first in all
        {RUN_DONE, SL_CONSERVATIVE, 4, 8, 30},  // as fast, but worse: beaten
        {RUN_DONE, SL_ROUNDED, 5, 9, 29},       // one of each: beaten by either
        {RUN_DONE, SL_ROUNDED, 3, 5, 20},       // bad in both, but the fastest
    };
    static const bool due[] = {true, true, true, false, true, false, false, true};
    enum { COUNT = sizeof made / sizeof *made };
    sl_context *context = testing_context(NULL);
    compare_run runs[COUNT];
    make_runs(context, made, COUNT, runs);
    for (size_t i = 0; i < COUNT; i++) assert_int_equal(runs[i].frontier, due[i]);
    destroy_runs(context, runs, COUNT);
    sl_context_destroy(context);
}

static void without_an_exact_run_nothing_is_judged(void **state) {
    (void)state;
    static const made_run made[] = {
        {RUN_DONE, SL_ROUNDED, 1, 0, 9},
        {RUN_NOT_DONE, SL_EXACT, 0, 0, 0},
        {RUN_DONE, SL_CONSERVATIVE, 2, 0, 20},
    };
    sl_context *context = testing_context(NULL);
    compare_run runs[3];
    make_runs(context, made, 3, runs);
    assert_true(compare_reference(runs, 3) == NO_RUN);
    for (int i = 0; i < 3; i++) {
        assert_false(runs[i].judged);
        assert_false(runs[i].frontier);
        assert_int_equal(runs[i].too_many + runs[i].too_few, 0);
        assert_true(runs[i].ratio == 0);
    }
    assert_true(compare_reference(NULL, 0) == NO_RUN);
    destroy_runs(context, runs, 3);
    sl_context_destroy(context);
}

static void the_fastest_comes_first_and_what_is_not_done_last(void **state) {
    (void)state;
    const compare_run runs[] = {
        {.outcome = RUN_REFUSED},
        {.outcome = RUN_DONE, .seconds = 3},
        {.outcome = RUN_DONE, .seconds = 1},
        {.outcome = RUN_NOT_DONE},
        {.outcome = RUN_DONE, .seconds = 3},
        {.outcome = RUN_DONE, .seconds = 2},
    };
    static const size_t due[] = {2, 5, 1, 4, 0, 3};
    size_t order[6];
    compare_order(runs, 6, order);
    for (int i = 0; i < 6; i++) assert_int_equal(order[i], due[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_beyond_are_those_of_one_only),
        cmocka_unit_test(runs_are_held_against_the_first_exact_one),
        cmocka_unit_test(the_frontier_weighs_each_error_by_itself),
        cmocka_unit_test(without_an_exact_run_nothing_is_judged),
        cmocka_unit_test(the_fastest_comes_first_and_what_is_not_done_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
