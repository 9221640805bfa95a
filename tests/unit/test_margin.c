// The second reference: margins known by hand, against the first reference, and against directions
// tried one by one.
#include "testing.h"

#include "oracle/margin.h"
#include "oracle/random_sequence.h"

#include <math.h>

/// A gate crossed towards +x.
static oracle_portal gate(double x, double low, double high) {
    return (oracle_portal){{x, high}, {x, low}};
}

static void assert_margin(const oracle_portal *portals, size_t count, double value) {
    const oracle_margin margin = oracle_margin_of(portals, count);
    assert_int_equal(margin.verdict, value > 0 ? SL_STABBED : value < 0 ? SL_HIDDEN : SL_GRAZING);
    if (fabs(margin.value - value) > 1e-15 * fabs(value))
        fail_msg("%.17g is not %.17g", margin.value, value);
}

static void test_known_margins(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p-400, 0x1p400, 3};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        const double s = scales[i];
        const oracle_portal straight[] = {gate(0, 0, s), gate(s, 0, s)};
        const oracle_portal touching[] = {gate(0, 0, s), gate(s, s, 2 * s), gate(2 * s, 0, s)};
        const oracle_portal zigzag[] = {gate(0, 0, s), gate(s, 2 * s, 3 * s), gate(2 * s, 0, s)};
        const oracle_portal level[] = {{{0, 0}, {s, 0}}, {{2 * s, 0}, {3 * s, 0}}};
        assert_margin(straight, 1, s / 2);
        assert_margin(straight, 2, s / 2);
        assert_margin(touching, 3, 0);
        assert_margin(zigzag, 3, -s / 2);
        assert_margin(level, 2, 0);
    }
    // One left and one right end alone, apart (3, 4) and in one place.
    const oracle_portal slanted = {{3, 4}, {0, 0}}, nothing = {{1, 2}, {1, 2}};
    assert_margin(&slanted, 1, 2.5);
    assert_margin(&nothing, 1, 0);
}

static double margin_in(const random_portals *portals, double angle) {
    const double x = cos(angle), y = sin(angle);
    double left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < portals->count; i++) {
        const oracle_portal *p = &portals->items[i];
        left = fmin(left, x * p->left.x + y * p->left.y);
        right = fmax(right, x * p->right.x + y * p->right.y);
    }
    return (left - right) / 2;
}

static void test_no_direction_does_better(void **state) {
    (void)state;
    sl_random random = {5};
    for (int round = 0; round < 300; round++) {
        random_portals portals;
        random_sequence(&random, round % 2 ? RANDOM_GRID : RANDOM_STAIRS, &portals);
        double best = -INFINITY;
        for (int i = 0; i < 4000; i++)
            best = fmax(best, margin_in(&portals, i * (acos(-1) / 2000)));
        const double value = oracle_margin_of(portals.items, portals.count).value;
        // Beside the best direction the margin is less by no more than the way to the farthest end.
        assert_true(best <= value + 1e-12 && best >= value - 0.2);
    }
}

static void test_both_references_agree(void **state) {
    (void)state;
    sl_random random = {6};
    size_t count[SL_STABBED + 1] = {0}, backwards = 0;
    for (int round = 0; round < 4000; round++) {
        random_portals portals;
        random_sequence(&random, (random_kind)(round % RANDOM_KINDS), &portals);
        if (round % 3 == 0) random_placing(&random, &portals);
        for (int i = round % 4; i > 0; i--) random_mutation(&random, &portals);
        size_t kept = 0;
        for (size_t i = 0; i < portals.count; i++) {
            portals.items[kept] = portals.items[i];
            if (oracle_forwards(portals.items, kept + 1)) kept++;
        }
        backwards += kept < portals.count;
        const oracle_margin margin = oracle_margin_of(portals.items, kept);
        // The oracle stops where a prefix is hidden, or where no direction crosses it: never here.
        assert_int_equal(oracle_stab(portals.items, kept), margin.verdict);
        count[margin.verdict]++;
    }
    assert_true(count[SL_HIDDEN] > 300 && count[SL_GRAZING] > 300 && count[SL_STABBED] > 300);
    assert_true(backwards > 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_margins),
        cmocka_unit_test(test_no_direction_does_better),
        cmocka_unit_test(test_both_references_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
