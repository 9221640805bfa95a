// The funnel, and the hybrid that falls back on it, push by push: verdicts against the oracle on
// every prefix of random degenerate sequences, taken back and built up at random; witnesses and
// conflicts by exact tests of their own.
#include "testing.h"

#include "geometry/orient.h"
#include "oracle/margin.h"
#include "oracle/random_sequence.h"
#include "sightline/stab.h"
#include "sightline/support.h"
#include "solver_table.h"

enum { WALKS = 50, STEPS = 24, DEEPEST = 10 };

typedef struct tally {
    size_t verdicts[SL_STABBED + 1], strict, through_ends;
    size_t sizes[2][SL_CONFLICT_MOST + 1]; ///< of conflicts: of hidden sequences, of grazing ones
} tally;

/// A sequence that is built up and taken back, in the funnel and beside it.
typedef struct walk {
    const sl_solver *solver;
    sl_context *context;
    void *state;
    random_kind kind;
    oracle_portal portals[DEEPEST];
    size_t depth;
    sl_stab_verdict verdict; ///< of the sequence as it stands
    bool small;              ///< all ends are small integers
    tally *count;
} walk;

static void complain(const walk *w, const char *what) {
    for (size_t i = 0; i < w->depth; i++) {
        const oracle_portal *p = &w->portals[i];
        print_error("portal %a %a %a %a\n", p->left.x, p->left.y, p->right.x, p->right.y);
    }
    fail_msg("%s (%s): %s", w->solver->name, random_kind_name(w->kind), what);
}

static bool is_end(const walk *w, sl_point p) {
    for (size_t i = 0; i < w->depth; i++)
        if (testing_same_point(p, w->portals[i].left) || testing_same_point(p, w->portals[i].right))
            return true;
    return false;
}

/// The least side that the line keeps of any end: 1 strictly, 0 touching, -1 wrong.
static int least_side(const walk *w, sl_line line) {
    int least = 1;
    for (size_t i = 0; i < w->depth; i++) {
        const int left = sli_orient(line.a, line.b, w->portals[i].left);
        const int right = -sli_orient(line.a, line.b, w->portals[i].right);
        if (left < least) least = left;
        if (right < least) least = right;
    }
    return least;
}

static void check_witness(const walk *w) {
    const sl_line line = w->solver->witness(w->state);
    const int side = least_side(w, line);
    if (testing_same_point(line.a, line.b)) complain(w, "the witness is no line");
    if (side < 0) complain(w, "the witness passes an end on its wrong side");
    if (side > 0 && w->verdict != SL_STABBED) complain(w, "a strict witness of a grazed sequence");
    if (side == 0 && (!is_end(w, line.a) || !is_end(w, line.b)))
        complain(w, "a witness neither strict nor through two ends");
    // On a small grid a strict line keeps so far from all ends that doubles can express it.
    if (side == 0 && w->verdict == SL_STABBED && w->small) complain(w, "a strict witness is there");
    w->count->strict += side > 0;
    w->count->through_ends += side == 0;
}

/// The verdict on some ends alone, but for one of them, by their hulls.
static sl_stab_verdict verdict_of(const walk *w, const sl_stab_end *ends, size_t count,
                                  size_t but) {
    sl_point left[SL_CONFLICT_MOST], right[SL_CONFLICT_MOST];
    size_t lefts = 0, rights = 0;
    for (size_t i = 0; i < count; i++) {
        const oracle_portal *p = &w->portals[ends[i].portal];
        if (i == but) continue;
        if (ends[i].left)
            left[lefts++] = p->left;
        else
            right[rights++] = p->right;
    }
    if (!lefts || !rights) return SL_STABBED;
    oracle_portal pairs[SL_CONFLICT_MOST];
    const size_t most = lefts > rights ? lefts : rights;
    for (size_t i = 0; i < most; i++)
        pairs[i] = (oracle_portal){left[i % lefts], right[i % rights]};
    return oracle_margin_of(pairs, most).verdict;
}

/// Alone, the ends leave no line (hidden) or none with room (grazing); without one of them they do.
static void check_conflict(const walk *w) {
    sl_stab_end ends[SL_CONFLICT_MOST];
    uint32_t count;
    assert_ok(w->context, w->solver->conflict(w->context, w->state, ends, &count));
    if (count > SL_CONFLICT_MOST) complain(w, "a conflict of too many ends");
    for (uint32_t i = 0; i < count; i++) {
        if (ends[i].portal >= w->depth) complain(w, "a conflict with a portal that is not there");
        for (uint32_t k = 0; k < i; k++)
            if (ends[k].portal == ends[i].portal && ends[k].left == ends[i].left)
                complain(w, "a conflict that names an end twice");
    }
    if (verdict_of(w, ends, count, SIZE_MAX) > w->verdict) complain(w, "a conflict that is none");
    for (uint32_t i = 0; i < count; i++)
        if (verdict_of(w, ends, count, i) <= w->verdict)
            complain(w, "a conflict that can spare an end");
    w->count->sizes[w->verdict][count]++;
}

/// A solver that has seen nothing else says the same.
static void build_anew(const walk *w) {
    void *state;
    sl_stab_verdict verdict = SL_STABBED;
    const sl_box bounds = oracle_bounds(w->portals, w->depth);
    assert_ok(w->context, w->solver->create(w->context, bounds, &state));
    for (size_t i = 0; i < w->depth; i++)
        assert_ok(w->context, w->solver->push(w->context, state, w->portals[i].left,
                                              w->portals[i].right, &verdict));
    if (verdict != w->verdict) complain(w, "built anew it says something else");
    w->solver->destroy(w->context, state);
}

static void push(walk *w, oracle_portal portal) {
    w->portals[w->depth++] = portal;
    if (!oracle_forwards(w->portals, w->depth)) {
        w->depth--;
        return;
    }
    assert_ok(w->context,
              w->solver->push(w->context, w->state, portal.left, portal.right, &w->verdict));
    const sl_stab_verdict is = oracle_stab(w->portals, w->depth);
    if (w->verdict != is) complain(w, verdict_name(is));
    w->count->verdicts[is]++;
    build_anew(w);
    if (is != SL_HIDDEN) check_witness(w);
    if (is != SL_STABBED) check_conflict(w);
}

/// What a pop leaves must be whole: its witness is that of the sequence without the last portal.
static void pop(walk *w) {
    w->solver->pop(w->state);
    w->depth--;
    if (!w->depth) return;
    w->verdict = oracle_stab(w->portals, w->depth);
    check_witness(w);
}

static void walk_at_random(const sl_solver *solver, random_kind kind, uint64_t seed, tally *count) {
    sl_random random = {seed};
    random_portals source;
    random_sequence(&random, kind, &source);
    const bool plain = sl_random_below(&random, 2);
    if (!plain) random_placing(&random, &source);
    for (uint64_t changes = plain ? 0 : sl_random_below(&random, 4); changes--;)
        random_mutation(&random, &source);
    testing_memory memory = {0};
    walk w = {.solver = solver,
              .kind = kind,
              .small = plain && (kind == RANDOM_STAIRS || kind == RANDOM_GRID),
              .count = count,
              .context = testing_context(&memory)};
    const sl_box bounds = oracle_bounds(source.items, source.count);
    assert_ok(w.context, solver->create(w.context, bounds, &w.state));
    for (int i = 0; i < STEPS; i++) {
        const bool hidden = w.depth && w.verdict == SL_HIDDEN;
        const size_t next = sl_random_below(&random, 2) ? w.depth : sl_random_next(&random);
        if (hidden || w.depth == DEEPEST || (w.depth && sl_random_below(&random, 4) == 0))
            pop(&w);
        else
            push(&w, source.items[next % source.count]);
    }
    solver->destroy(w.context, w.state);
    assert_int_equal(memory.live, 1);
    sl_context_destroy(w.context);
}

static void print_tally(const sl_solver *solver, const tally *count) {
    print_message(
        "%s: %zu hidden, %zu grazing, %zu stabbed; witnesses: %zu strict, %zu through two "
        "ends\n",
        solver->name, count->verdicts[SL_HIDDEN], count->verdicts[SL_GRAZING],
        count->verdicts[SL_STABBED], count->strict, count->through_ends);
    for (int size = 0; size <= SL_CONFLICT_MOST; size++)
        print_message("conflicts of %d ends: %zu of hidden, %zu of grazing sequences\n", size,
                      count->sizes[SL_HIDDEN][size], count->sizes[SL_GRAZING][size]);
}

/// The solvers that prove what they say.
static const sl_solver *next_solver(size_t *index) {
    while (solver_at(*index) && !solver_at(*index)->conflict) ++*index;
    return solver_at((*index)++);
}

static void test_random_sequences(void **state) {
    (void)state;
    const sl_solver *solver;
    for (size_t i = 0; (solver = next_solver(&i));) {
        tally count = {.strict = 0};
        for (int kind = 0; kind < RANDOM_KINDS; kind++)
            for (uint64_t seed = 1; seed <= WALKS; seed++)
                walk_at_random(solver, (random_kind)kind, seed * RANDOM_KINDS + (uint64_t)kind,
                               &count);
        print_tally(solver, &count);
        for (int verdict = SL_HIDDEN; verdict <= SL_STABBED; verdict++)
            assert_true(count.verdicts[verdict] > 300);
        assert_true(count.strict > 300 && count.through_ends > 300);
    }
    solvers_leave();
}

/// Five portals with a corner each in the funnel, one that grazes, and one that hides.
static const oracle_portal course[] = {
    {{0, 4}, {0, -4}}, {{1, 3}, {1, -3}},  {{2, 2.5}, {2, -2.5}}, {{3, 3}, {3, -3}},
    {{4, 4}, {4, -4}}, {{9, 20}, {9, 14}}, {{10, 30}, {10, 29}}};

/// Pushes them all, asks for the conflict, takes half of them back and pushes them again.
static sl_status run_course(sl_context *context, const sl_solver *solver, void *state) {
    const size_t count = sizeof course / sizeof *course;
    sl_stab_verdict verdict = SL_STABBED;
    for (int round = 0; round < 2; round++) {
        for (size_t i = round ? count / 2 : 0; i < count; i++) {
            if (verdict == SL_HIDDEN) return sl_fail(context, SL_BAD_INPUT, "hidden too early");
            SL_TRY(solver->push(context, state, course[i].left, course[i].right, &verdict));
        }
        sl_stab_end ends[SL_CONFLICT_MOST];
        uint32_t found;
        SL_TRY(solver->conflict(context, state, ends, &found));
        for (size_t i = count / 2; round == 0 && i < count; i++) solver->pop(state);
        if (round == 0) verdict = SL_STABBED;
    }
    return verdict == SL_HIDDEN ? SL_OK : sl_fail(context, SL_BAD_INPUT, "not hidden");
}

static void fail_at_each_call(const sl_solver *solver) {
    sl_status status = SL_NO_MEMORY;
    long fails = 0;
    for (long at = 1; status == SL_NO_MEMORY; at++) {
        testing_memory memory = {0};
        sl_context *context = testing_context(&memory);
        void *made = NULL;
        memory.calls = 0;
        memory.fail_at = at;
        status = solver->create(context, (sl_box){{0, -30}, {10, 30}}, &made);
        if (status == SL_OK) {
            status = run_course(context, solver, made);
            solver->destroy(context, made);
        }
        fails += status == SL_NO_MEMORY;
        assert_int_equal(memory.live, 1);
        if (status == SL_NO_MEMORY)
            assert_string_equal(sl_context_message(context), "out of memory");
        else
            assert_ok(context, status);
        sl_context_destroy(context);
    }
    assert_true(fails > 5);
}

static void test_memory_may_fail_at_any_call(void **state) {
    (void)state;
    const sl_solver *solver;
    for (size_t i = 0; (solver = next_solver(&i));) fail_at_each_call(solver);
    solvers_leave();
}

static void test_account_counts(void **state) {
    (void)state;
    const sl_solver *solver = sl_funnel();
    sl_context *context = testing_context(NULL);
    void *made;
    assert_ok(context, solver->create(context, (sl_box){{0, -30}, {10, 30}}, &made));
    assert_ok(context, run_course(context, solver, made));
    sl_stab_account sum = {.orientations = 1000};
    solver->account(made, &sum);
    assert_true(sum.orientations > 1010 && sum.exact <= sum.orientations - 1000);
    assert_true(sum.certified == 0 && sum.fallbacks == 0);
    solver->destroy(context, made);
    sl_context_destroy(context);
}

static uint64_t orientations_of(const void *made) {
    sl_stab_account sum = {.orientations = 0};
    sl_funnel()->account(made, &sum);
    return sum.orientations;
}

enum { CURVE = 65 };

/// Between two curves bent away from each other: every end of either adds a corner to the funnel.
static void test_long_lists(void **state) {
    (void)state;
    const sl_solver *solver = sl_funnel();
    sl_context *context = testing_context(NULL);
    oracle_portal portals[CURVE + 1];
    sl_stab_verdict verdict;
    void *made;
    assert_ok(context, solver->create(context, (sl_box){{-256, -5000}, {400, 5000}}, &made));
    for (int i = 0; i < CURVE; i++) {
        const double x = i - CURVE / 2;
        portals[i] = (oracle_portal){{8 * x, 1024 + x * x}, {8 * x, -1024 - x * x}};
        assert_ok(context,
                  solver->push(context, made, portals[i].left, portals[i].right, &verdict));
        assert_int_equal(verdict, SL_STABBED);
    }
    size_t verdicts[SL_STABBED + 1] = {0};
    uint64_t most = 0;
    const double sizes[] = {8, 1000, 4000, 7000};
    for (int i = 0; i < 4; i++)
        for (double low = -4000; low <= 4000; low += 100) {
            oracle_portal *window = &portals[CURVE];
            *window = (oracle_portal){{400, low + sizes[i]}, {400, low}};
            const uint64_t before = orientations_of(made);
            assert_ok(context, solver->push(context, made, window->left, window->right, &verdict));
            if (orientations_of(made) - before > most) most = orientations_of(made) - before;
            assert_int_equal(verdict, oracle_margin_of(portals, CURVE + 1).verdict);
            verdicts[verdict]++;
            solver->pop(made);
        }
    assert_true(verdicts[SL_HIDDEN] && verdicts[SL_GRAZING] && verdicts[SL_STABBED]);
    assert_true(most > 2 * 100);
    solver->destroy(context, made);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_sequences),
        cmocka_unit_test(test_memory_may_fail_at_any_call),
        cmocka_unit_test(test_account_counts),
        cmocka_unit_test(test_long_lists),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
