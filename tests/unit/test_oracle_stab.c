// Every solver against the oracle on random portal sequences, pushed and popped as a search does.
#include "oracle/oracle.h"
#include "sightline/glpk.h"
#include "sightline/support.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { DEEPEST = 10, REACH = 40 };

static const char *const verdict_names[] = {"hidden", "grazing", "stabbed"};

/// A sequence that is built up and taken down, in a solver and beside it.
typedef struct walk {
    const sl_solver *solver;
    sl_context *context;
    void *state;
    oracle_sequence *oracle;
    oracle_portal portals[DEEPEST];
    size_t depth;
} walk;

/// `grain`: a double of which all coordinates are multiples.
static void begin_walk(walk *w, const sl_solver *solver, sl_box bounds, double grain) {
    *w = (walk){.solver = solver, .context = sl_context_create(NULL)};
    assert_non_null(w->context);
    assert_int_equal(solver->create(w->context, bounds, &w->state), SL_OK);
    w->oracle = oracle_sequence_create(&(sl_point){grain, 0}, 1);
}

static void end_walk(walk *w) {
    oracle_sequence_destroy(w->oracle);
    w->solver->destroy(w->context, w->state);
    if (w->solver->leave_thread) w->solver->leave_thread();
    sl_context_destroy(w->context);
}

static double side(sl_line line, sl_point p) {
    return (line.b.x - line.a.x) * (p.y - line.a.y) - (line.b.y - line.a.y) * (p.x - line.a.x);
}

static void complain(const walk *w, sl_stab_verdict said, sl_stab_verdict is) {
    for (size_t i = 0; i < w->depth; i++) {
        const oracle_portal *p = &w->portals[i];
        print_error("left %.17g %.17g right %.17g %.17g\n", p->left.x, p->left.y, p->right.x,
                    p->right.y);
    }
    fail_msg("%s says %s of a sequence that is %s", w->solver->name, verdict_names[said],
             verdict_names[is]);
}

/// Pushes, compares, and gives the oracle's verdict. `rounded`: grazing may stand for anything.
static sl_stab_verdict push(walk *w, oracle_portal portal, bool rounded) {
    sl_stab_verdict said;
    assert_int_equal(w->solver->push(w->context, w->state, portal.left, portal.right, &said),
                     SL_OK);
    w->portals[w->depth++] = portal;
    assert_true(oracle_sequence_forwards(w->oracle, portal));
    sl_stab_verdict is = oracle_sequence_push(w->oracle, portal);
    if (said != is && !(rounded && said == SL_GRAZING)) complain(w, said, is);
    if (said != SL_STABBED || rounded) return said;
    // On a small grid a line with room keeps so far from all ends that doubles tell its sides.
    sl_line line = w->solver->witness(w->state);
    for (size_t i = 0; i < w->depth; i++) {
        assert_true(side(line, w->portals[i].left) > 0);
        assert_true(side(line, w->portals[i].right) < 0);
    }
    return said;
}

static void pop(walk *w) {
    w->solver->pop(w->state);
    oracle_sequence_pop(w->oracle);
    w->depth--;
}

/// How far to the right and up a sequence has come: a search finds no portals behind that.
typedef struct front {
    double x, y;
} front;

/// A portal crossed upwards or to the right, beyond the front, which it moves.
static oracle_portal random_portal(sl_random *random, front *at) {
    double on = 1 + (double)sl_random_below(random, 3), aside = (double)sl_random_below(random, 4);
    double length = 1 + (double)sl_random_below(random, 3);
    if (sl_random_below(random, 2)) {
        at->x += on;
        return (oracle_portal){{at->x, at->y + aside + length}, {at->x, at->y + aside}};
    }
    at->y += on;
    return (oracle_portal){{at->x + aside, at->y}, {at->x + aside + length, at->y}};
}

static oracle_portal turned(oracle_portal p, unsigned quarters, double unit) {
    for (unsigned i = 0; i < quarters; i++) {
        p = (oracle_portal){{REACH - p.left.y, p.left.x}, {REACH - p.right.y, p.right.x}};
    }
    return (oracle_portal){{p.left.x * unit, p.left.y * unit},
                           {p.right.x * unit, p.right.y * unit}};
}

static void walk_at_random(const sl_solver *solver, double unit, bool rounded, size_t found[3]) {
    for (uint64_t seed = 1; seed <= 200; seed++) {
        walk w;
        sl_random random = {seed};
        front fronts[DEEPEST + 1] = {{0, 0}};
        begin_walk(&w, solver, (sl_box){{0, 0}, {REACH * unit, REACH * unit}}, unit * 0x1p-60);
        for (int i = 0; i < 150; i++) {
            if (w.depth == DEEPEST || (w.depth && sl_random_below(&random, 8) == 0)) pop(&w);
            fronts[w.depth + 1] = fronts[w.depth];
            oracle_portal portal = random_portal(&random, &fronts[w.depth + 1]);
            sl_stab_verdict said = push(&w, turned(portal, seed % 4, unit), rounded);
            found[said]++;
            if (said == SL_HIDDEN) pop(&w);
        }
        end_walk(&w);
    }
}

static void test_glpk_on_a_grid(void **state) {
    (void)state;
    size_t found[3] = {0};
    walk_at_random(sl_glpk_simplex(), 1, false, found);
    walk_at_random(sl_glpk_simplex(), 0x1p-200, false, found);
    print_message("%zu hidden, %zu grazing, %zu stabbed\n", found[SL_HIDDEN], found[SL_GRAZING],
                  found[SL_STABBED]);
    assert_true(found[SL_HIDDEN] > 100 && found[SL_GRAZING] > 100 && found[SL_STABBED] > 100);
}

static void test_glpk_on_tenths(void **state) {
    (void)state;
    size_t found[3] = {0};
    walk_at_random(sl_glpk_simplex(), 0.1, true, found);
    assert_true(found[SL_HIDDEN] > 100 && found[SL_STABBED] > 100);
}

/// The basis that the second portal left was close to singular for the turned normalisation that
/// the third brought in: simplex called the sequence stabbed, by a line far from its portals.
static void test_glpk_after_a_turn(void **state) {
    (void)state;
    const double t = 0.1;
    const oracle_portal portals[] = {{{6 * t, 2 * t}, {6 * t, 3 * t}},
                                     {{5 * t, 1 * t}, {5 * t, 2 * t}},
                                     {{-1 * t, 3 * t}, {3 * t, 3 * t}}};
    walk w;
    begin_walk(&w, sl_glpk_simplex(), (sl_box){{-t, -t}, {11 * t, 11 * t}}, 0x1p-60);
    assert_int_equal(push(&w, portals[0], true), SL_STABBED);
    assert_int_equal(push(&w, portals[1], true), SL_STABBED);
    assert_int_equal(push(&w, portals[2], true), SL_HIDDEN);
    end_walk(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_glpk_on_a_grid),
        cmocka_unit_test(test_glpk_on_tenths),
        cmocka_unit_test(test_glpk_after_a_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
