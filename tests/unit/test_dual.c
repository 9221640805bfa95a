/// The dual plane against the exact solver: a region is there just where lines are.
#include "testing.h"

#include "sightline/support.h"

#include <math.h>

enum { PORTALS = 6 };

/// Portals crossed rightwards (and some upwards), one after the other, with ends on a grid.
static uint32_t random_portals(sl_random *random, sl_portal_ends ends[PORTALS]) {
    const uint32_t count = 1 + (uint32_t)sl_random_below(random, PORTALS);
    double x = 0, y = 0;
    for (uint32_t i = 0; i < count; i++) {
        x += 1 + (double)sl_random_below(random, 3);
        y += (double)sl_random_below(random, 5) - 2;
        const double wide = 1 + (double)sl_random_below(random, 4);
        ends[i] = (sl_portal_ends){{x, y + wide}, {x, y}};
    }
    return count;
}

static sl_stab_verdict solve(sl_context *context, const sl_portal_ends *ends, uint32_t count) {
    const sl_solver *solver = sl_funnel();
    void *state;
    sl_stab_verdict verdict = SL_STABBED;
    assert_ok(context, solver->create(context, (sl_box){{-99, -99}, {99, 99}}, &state));
    for (uint32_t i = 0; i < count && verdict != SL_HIDDEN; i++)
        assert_ok(context, solver->push(context, state, ends[i].left, ends[i].right, &verdict));
    solver->destroy(context, state);
    return verdict;
}

static void test_like_the_solver(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {7};
    int seen = 0, hidden = 0;
    for (int i = 0; i < 4000; i++) {
        sl_portal_ends ends[PORTALS];
        sl_dual dual;
        const uint32_t count = random_portals(&random, ends);
        sl_dual_make(ends, count, count, &dual);
        const sl_stab_verdict verdict = solve(context, ends, count);
        // Slopes beyond the frame cannot be needed: portals lie a unit apart at least.
        if (verdict == SL_STABBED) {
            assert_true(dual.margin > 1e-9);
            assert_true(dual.corner_count >= 3);
            seen++;
        } else if (verdict == SL_HIDDEN) {
            assert_true(dual.margin < -1e-9);
            hidden++;
        } else {
            assert_true(fabs(dual.margin) < 1e-9);
        }
        assert_true(fabs(sl_dual_margin(&dual, ends, count, dual.best) - dual.margin) < 1e-9);
        for (uint32_t k = 0; k < dual.corner_count; k++) {
            assert_true(sl_dual_margin(&dual, ends, count, dual.corners[k]) > -1e-9);
            assert_true(sl_dual_margin(&dual, ends, count, dual.corners[k]) < dual.margin + 1e-9);
        }
    }
    assert_true(seen > 500 && hidden > 500);
    sl_context_destroy(context);
}

static void test_frame(void **state) {
    (void)state;
    const sl_portal_ends ends[2] = {{{0, 5}, {3, 5}}, {{4, 10}, {4, 6}}}; // up, then rightwards
    sl_dual dual;
    sl_dual_make(ends, 2, 2, &dual);
    // Both portals are crossed towards +x': left ends over right ones.
    for (int i = 0; i < 2; i++)
        assert_true(sl_dual_point(&dual, ends[i].left).y > sl_dual_point(&dual, ends[i].right).y);
    const sl_line line = sl_dual_line_at(&dual, dual.best, -1, 1);
    const sl_point a = sl_dual_point(&dual, line.a);
    assert_true(fabs(a.x + 1) < 1e-12);
    assert_true(fabs(a.y - (dual.best.height - dual.best.slope)) < 1e-12);
}

/// Of the last portal only the frame is taken.
static void test_cutting(void **state) {
    (void)state;
    const sl_portal_ends ends[2] = {{{0, 1}, {0, 0}}, {{2, 1}, {2, 0}}};
    sl_dual one, both;
    sl_dual_make(ends, 2, 1, &one);
    sl_dual_make(ends, 2, 2, &both);
    assert_true(one.scale == both.scale && one.origin.x == both.origin.x);
    assert_int_equal(both.corner_count, 4);
    double low = 9, high = -9;
    for (uint32_t i = 0; i < one.corner_count; i++) {
        low = fmin(low, one.corners[i].slope);
        high = fmax(high, one.corners[i].slope);
    }
    assert_true(low == -SL_DUAL_SLOPE && high == SL_DUAL_SLOPE);
    sl_dual_make(ends, 2, 0, &one);
    assert_int_equal(one.corner_count, 4);
}

static void test_one_portal_is_crossed_straight(void **state) {
    (void)state;
    // All slopes have the same margin: the middle one is taken.
    const sl_portal_ends ends[2] = {{{3, 7}, {3, 2}}, {{-1, 5}, {4, 5}}};
    for (int i = 0; i < 2; i++) {
        sl_dual dual;
        sl_dual_make(&ends[i], 1, 1, &dual);
        assert_true(fabs(dual.best.slope) < 1e-6 && fabs(dual.best.height) < 1e-6);
        assert_true(fabs(dual.margin - 1) < 1e-12);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_portal_is_crossed_straight),
        cmocka_unit_test(test_like_the_solver),
        cmocka_unit_test(test_frame),
        cmocka_unit_test(test_cutting),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
