/// Maximum coverage against brute force: what is found is covered, and no set covers more than the
/// bound.
#include "cover_problems.h"

#include <math.h>

static cover_problem p;
static double weights[COVER_ROWS];

static double weigh(const uint8_t *taken) {
    uint32_t covered[COVER_ROWS] = {0};
    double sum = 0;
    for (uint32_t j = 0; j < p.problem.column_count; j++)
        for (size_t i = j ? p.ends[j - 1] : 0; i < p.ends[j] && taken[j]; i++)
            covered[p.entries[i]]++;
    for (uint32_t r = 0; r < p.problem.row_count; r++)
        if (covered[r] >= (p.problem.demands ? p.demands[r] : 1)) sum += weights[r];
    return sum;
}

static double brute(uint32_t count) {
    double most = 0;
    uint8_t taken[32];
    for (uint32_t set = 0; set < 1u << p.problem.column_count; set++) {
        uint32_t size = 0;
        for (uint32_t j = 0; j < p.problem.column_count; j++) size += taken[j] = set >> j & 1;
        if (size <= count) most = fmax(most, weigh(taken));
    }
    return most;
}

static void check(sl_context *context, const sl_cover_options *options, uint32_t count,
                  double *covered, double *bound) {
    static uint8_t taken[COVER_COLUMNS];
    sl_cover_result r;
    assert_ok(context,
              sl_cover_most(context, &p.problem, weights, count, options, &r, covered, bound));
    assert_true(r.count <= count);
    memset(taken, 0, sizeof taken);
    for (uint32_t i = 0; i < r.count; i++) taken[r.columns[i]] = 1;
    assert_true(weigh(taken) == *covered);
    assert_true(*bound >= *covered);
    sl_cover_result_destroy(context, &r);
}

static void covers_the_most(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {21};
    sl_cover_options options = sl_cover_options_default();
    options.iterations = 2000;
    const uint64_t seeds = testing_seeds(1000);
    uint64_t best = 0, tight = 0;
    for (uint64_t i = 0; i < seeds; i++) {
        cover_small(&p, &random);
        const double unit = sl_random_below(&random, 2) ? 1 : 0.1;
        for (uint32_t r = 0; r < p.problem.row_count; r++)
            weights[r] = unit * (double)sl_random_below(&random, 6);
        const uint32_t count = (uint32_t)sl_random_below(&random, 5);
        double covered, bound;
        check(context, &options, count, &covered, &bound);
        const double most = brute(count);
        // Sums of tenths differ by their order.
        assert_true(covered <= most * (1 + 1e-12) && bound >= most * (1 - 1e-12));
        best += covered >= most * (1 - 1e-12);
        tight += bound <= most * 1.1;
    }
    assert_true(best * 10 > seeds * 9 && tight * 10 > seeds * 6);
    sl_context_destroy(context);
}

/// As many columns as it takes cover every row that can be covered: the bound is what they cover,
/// though weights are no binary fractions. One column alone mostly leaves the bound above it.
static void covers_all(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {23};
    const uint64_t seeds = testing_seeds(300);
    uint64_t less = 0;
    for (uint64_t i = 0; i < seeds; i++) {
        cover_small(&p, &random);
        for (uint32_t r = 0; r < p.problem.row_count; r++)
            weights[r] = 0.1 * (double)(1 + sl_random_below(&random, 5));
        double covered, bound;
        check(context, NULL, p.problem.column_count, &covered, &bound);
        assert_true(covered == bound);
        check(context, NULL, 1, &covered, &bound);
        less += covered < bound;
    }
    assert_true(less * 2 > seeds);
    sl_context_destroy(context);
}

/// Whole weights bring a whole bound; weights far from 1 change nothing.
static void scales(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {22};
    cover_discs(&p, &random, 200, 300, 0.1);
    for (uint32_t r = 0; r < 200; r++) weights[r] = 1;
    double covered, bound;
    check(context, NULL, 12, &covered, &bound);
    assert_true(bound == floor(bound) && bound <= covered * 1.05);
    const double scale[] = {0x1p-1000, 0x1p-300, 0x1p300, 0x1p1000};
    for (int i = 0; i < 4; i++) {
        for (uint32_t r = 0; r < 200; r++) weights[r] = scale[i];
        double again, above;
        check(context, NULL, 12, &again, &above);
        assert_true(again == covered * scale[i] && above >= again &&
                    above < (bound + 1) * scale[i]);
    }
    sl_context_destroy(context);
}

static void goes_to_the_ends(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {23};
    cover_discs(&p, &random, 60, 60, 0.1);
    double covered, bound;
    for (uint32_t r = 0; r < 60; r++) weights[r] = 2;
    check(context, NULL, 0, &covered, &bound);
    assert_true(covered == 0 && bound == 0);
    check(context, NULL, UINT32_MAX, &covered, &bound);
    assert_true(covered == 120 && bound == 120);
    sl_cover_result r;
    static const double wrong[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++) {
        weights[5] = wrong[i];
        assert_int_equal(sl_cover_most(context, &p.problem, weights, 3, NULL, &r, &covered, &bound),
                         SL_BAD_ARGUMENT);
        assert_string_equal(sl_context_message(context),
                            "the weight of row 5 is no number from 0 on");
    }
    sl_context_destroy(context);
}

static void survives_lack_of_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {24};
    cover_discs(&p, &random, 30, 60, 0.2);
    for (uint32_t r = 0; r < 30; r++) weights[r] = r;
    sl_cover_options options = {.iterations = 100};
    double covered, bound;
    memory.calls = 0;
    check(context, &options, 3, &covered, &bound);
    const long needed = memory.calls, live = memory.live;
    for (long at = 1; at <= needed; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        sl_cover_result r;
        assert_int_equal(
            sl_cover_most(context, &p.problem, weights, 3, &options, &r, &covered, &bound),
            SL_NO_MEMORY);
        memory.fail_at = 0;
        assert_int_equal(memory.live, live);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_the_most),
        cmocka_unit_test(covers_all),
        cmocka_unit_test(scales),
        cmocka_unit_test(goes_to_the_ends),
        cmocka_unit_test(survives_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
