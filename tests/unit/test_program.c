// The linear program as it is shown: its rows, and an optimum that can be checked by hand.
#include "testing.h"

#include "sightline/dual.h"
#include "sightline/explain.h"
#include "sightline/glpk.h"
#include "sightline/support.h"

#include <math.h>

enum { PORTALS = 6 };

/// Portals crossed rightwards, one after the other, with ends on a grid.
static uint32_t random_portals(sl_random *random, sl_portal_ends ends[PORTALS]) {
    const uint32_t count = 1 + (uint32_t)sl_random_below(random, PORTALS);
    double x = 100, y = -50;
    for (uint32_t i = 0; i < count; i++) {
        x += 1 + (double)sl_random_below(random, 3);
        y += (double)sl_random_below(random, 5) - 2;
        const double wide = 1 + (double)sl_random_below(random, 4);
        ends[i] = (sl_portal_ends){{x, y + wide}, {x, y}};
    }
    return count;
}

/// The least distance of an end from the program's line, in units of the map; negative where one is
/// on its wrong side.
static double margin_by_hand(const sl_program *p, const sl_portal_ends *ends, uint32_t count) {
    const double *v = p->values;
    const double length = hypot(v[SL_PROGRAM_UX], v[SL_PROGRAM_UY]);
    double least = INFINITY;
    for (uint32_t i = 0; i < 2 * count; i++) {
        const sl_point at = i % 2 ? ends[i / 2].right : ends[i / 2].left;
        const double x = (at.x - p->origin.x) / p->unit, y = (at.y - p->origin.y) / p->unit;
        const double side = v[SL_PROGRAM_UX] * y - v[SL_PROGRAM_UY] * x + v[SL_PROGRAM_C];
        least = fmin(least, (i % 2 ? -side : side) / length * p->unit);
    }
    return least;
}

static void check_rows(const sl_program *p, uint32_t count) {
    double sum = 0;
    assert_int_equal(p->row_count, 1 + 2 * count);
    assert_int_equal(p->rows[0].portal, SL_PROGRAM_FIXED);
    uint32_t basic = 0;
    for (uint32_t i = 0; i < p->row_count; i++) {
        const sl_program_row *row = &p->rows[i];
        double value = 0;
        for (int k = 0; k < SL_PROGRAM_COLUMNS; k++) value += row->coefficients[k] * p->values[k];
        assert_true(fabs(value - row->value) < 1e-9);
        basic += row->basic;
        // What is not in the basis is at its bound, and alone has a price.
        if (row->basic)
            assert_true(fabs(row->price) < 1e-9);
        else
            assert_true(fabs(value - (i ? 0 : 1)) < 1e-9);
        if (!i) continue;
        assert_int_equal(row->portal, (i - 1) / 2);
        assert_int_equal(row->left, i % 2);
        assert_true(row->left ? value > -1e-9 : value < 1e-9);
        assert_true(row->coefficients[SL_PROGRAM_C] == 1);
        assert_true(row->coefficients[SL_PROGRAM_D] == (row->left ? -1 : 1));
    }
    for (int k = 0; k < SL_PROGRAM_COLUMNS; k++) basic += p->basic[k];
    assert_int_equal(basic, p->row_count);
    // Strong duality: of all bounds only that of the first row is not 0.
    sum = p->rows[0].price;
    assert_true(fabs(sum - p->objective) < 1e-9);
}

static void optima_can_be_checked(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {11};
    int seen = 0, hidden = 0;
    for (int i = 0; i < 500; i++) {
        sl_portal_ends ends[PORTALS];
        sl_program p;
        sl_conflict conflict;
        const uint32_t count = random_portals(&random, ends);
        assert_ok(context, sl_program_make(context, ends, count, &p));
        assert_true(p.solved);
        check_rows(&p, count);
        assert_true(fabs(margin_by_hand(&p, ends, count) - p.margin) < 1e-7);
        assert_ok(context, sl_conflict_find(context, ends, count, &conflict));
        assert_true(conflict.verdict == SL_STABBED   ? p.margin > 1e-9
                    : conflict.verdict == SL_GRAZING ? fabs(p.margin) < 1e-7
                                                     : p.margin < -1e-9);
        seen += conflict.verdict == SL_STABBED;
        hidden += conflict.verdict == SL_HIDDEN;
        sl_program_destroy(context, &p);
    }
    assert_true(seen > 50 && hidden > 50);
    sl_context_destroy(context);
}

static void portals_that_turn_back_have_none(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_portal_ends there_and_back[2] = {{{0, 1}, {0, 0}}, {{3, 0}, {3, 1}}};
    sl_program p = {0};
    assert_ok(context, sl_program_make(context, there_and_back, 2, &p));
    assert_int_equal(p.row_count, 5);
    // w.u = 1 with a w of 0 cannot hold, or the line has ends on their wrong sides.
    assert_true(!p.solved || p.margin < 0);
    sl_program_destroy(context, &p);
    assert_int_equal(sl_program_make(context, there_and_back, 0, &p), SL_BAD_ARGUMENT);
    assert_null(p.rows);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(optima_can_be_checked),
        cmocka_unit_test(portals_that_turn_back_have_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
