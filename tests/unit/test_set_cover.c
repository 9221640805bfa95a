/// Set cover against brute force on small problems of all kinds, with demands and costs; problems
/// of known optimum; larger ones, whose proofs are checked; and what is refused.
#include "cover_problems.h"

#include "analysis/placement/cover.h"

#include <limits.h>

static cover_problem p;

static void solve(sl_context *context, const sl_cover_options *options, sl_cover_result *out) {
    *out = (sl_cover_result){0};
    assert_ok(context, sl_cover_solve(context, &p.problem, options, out));
    cover_check_result(context, &p, out);
}

static void finds_the_least(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {7};
    const uint64_t seeds = testing_seeds(2500);
    for (uint64_t i = 0; i < seeds; i++) {
        cover_small(&p, &random);
        sl_cover_result r;
        solve(context, NULL, &r);
        const uint64_t least = cover_brute(&p);
        if (r.cost != least || r.lower != least)
            fail_msg("problem %llu: [%llu, %llu], not %llu", (unsigned long long)i,
                     (unsigned long long)r.lower, (unsigned long long)r.cost,
                     (unsigned long long)least);
        sl_cover_result_destroy(context, &r);
    }
    sl_context_destroy(context);
}

/// Without branching, or without any search, the bound is no larger than the least cost.
static void bounds_hold_without_search(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {8};
    const uint64_t seeds = testing_seeds(1000);
    for (uint64_t i = 0; i < seeds; i++) {
        cover_small(&p, &random);
        const uint64_t least = cover_brute(&p);
        sl_cover_options options = sl_cover_options_default();
        options.nodes = sl_random_below(&random, 4);
        options.iterations = sl_random_below(&random, 30);
        sl_cover_result r;
        solve(context, &options, &r);
        assert_true(r.lower <= least && least <= r.cost);
        sl_cover_result_destroy(context, &r);
    }
    sl_context_destroy(context);
}

static void expect(sl_context *context, uint64_t least) {
    sl_cover_result r;
    solve(context, NULL, &r);
    assert_int_equal(r.cost, least);
    assert_int_equal(r.lower, least);
    sl_cover_result_destroy(context, &r);
}

static void solves_known_problems(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    cover_steiner(&p, 2);
    expect(context, 5);
    cover_steiner(&p, 3);
    assert_int_equal(p.problem.row_count, 117);
    expect(context, 18);
    // Edges of a cycle, covered by its corners; the relaxation takes a half of each.
    for (uint32_t n = 3; n < 60; n += 7) {
        cover_begin(&p, n);
        for (uint32_t j = 0; j < n; j++) {
            cover_add_column(&p);
            cover_add_entry(&p, j ? j - 1 : 0);
            cover_add_entry(&p, j ? j : n - 1);
        }
        expect(context, (n + 1) / 2);
    }
    cover_begin(&p, 0);
    expect(context, 0);
    sl_context_destroy(context);
}

/// Parts add up, and are not multiplied: many odd cycles apart.
static void parts_are_solved_apart(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const uint32_t cycles = 60, length = 7;
    cover_begin(&p, cycles * length);
    for (uint32_t k = 0; k < cycles; k++)
        for (uint32_t j = 0; j < length; j++) {
            cover_add_column(&p);
            cover_add_entry(&p, k * length + (j ? j - 1 : 0));
            cover_add_entry(&p, k * length + (j ? j : length - 1));
        }
    sl_cover_result r;
    solve(context, NULL, &r);
    assert_int_equal(r.cost, cycles * 4);
    assert_int_equal(r.lower, r.cost);
    assert_int_equal(r.proof.part_count, cycles);
    sl_cover_result_destroy(context, &r);
    sl_context_destroy(context);
}

static bool same_results(const sl_cover_result *a, const sl_cover_result *b) {
    const sl_cover_proof *x = &a->proof, *y = &b->proof;
    if (a->count != b->count || a->lower != b->lower || x->node_count != y->node_count ||
        x->dual_count != y->dual_count || x->step_count != y->step_count)
        return false;
    if (memcmp(a->columns, b->columns, a->count * sizeof *a->columns) != 0) return false;
    if (memcmp(x->duals, y->duals, x->dual_count * sizeof *x->duals) != 0) return false;
    if (memcmp(x->steps, y->steps, x->step_count * sizeof *x->steps) != 0) return false;
    for (uint32_t i = 0; i < x->node_count; i++)
        if (x->nodes[i].column != y->nodes[i].column || x->nodes[i].duals != y->nodes[i].duals)
            return false;
    return true;
}

static void discs_are_bounded_and_repeat(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {3};
    for (int kind = 0; kind < 4; kind++) {
        cover_discs(&p, &random, 120, 240, 0.13);
        if (kind & 1) cover_cost(&p, &random, 5, 20);
        if (kind & 2) cover_demand(&p, &random, 2);
        sl_cover_options options = sl_cover_options_default();
        options.nodes = 200;
        options.iterations = 2000;
        sl_cover_result first, second;
        solve(context, &options, &first);
        solve(context, &options, &second);
        assert_true(same_results(&first, &second));
        assert_true((double)first.lower > 0.8 * (double)first.cost);
        sl_cover_result_destroy(context, &first);
        sl_cover_result_destroy(context, &second);
    }
    sl_context_destroy(context);
}

/// A set to start from is not lost, and a bound that is known ends the search.
static void starts_from_a_set(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {5};
    cover_discs(&p, &random, 200, 400, 0.12);
    sl_cover_options options = sl_cover_options_default();
    options.nodes = 0;
    sl_cover_result good, again;
    solve(context, &options, &good);
    options.iterations = 0;
    options.start = good.columns;
    options.start_count = good.count;
    solve(context, &options, &again);
    assert_true(again.cost <= good.cost);
    sl_cover_result_destroy(context, &again);
    options = sl_cover_options_default();
    options.start = good.columns;
    options.start_count = good.count;
    options.known_lower = good.cost;
    again = (sl_cover_result){0};
    assert_ok(context, sl_cover_solve(context, &p.problem, &options, &again));
    assert_int_equal(again.lower, good.cost);
    assert_true(again.proof.node_count == again.proof.part_count); // no tree was asked for
    sl_cover_result_destroy(context, &again);
    const uint32_t wrong = p.problem.column_count;
    options.start = &wrong;
    options.start_count = 1;
    assert_int_equal(sl_cover_solve(context, &p.problem, &options, &again), SL_BAD_ARGUMENT);
    sl_cover_result_destroy(context, &good);
    sl_context_destroy(context);
}

static void refused(sl_context *context, const char *message) {
    sl_cover_result r = {.cost = 77};
    assert_int_equal(sl_cover_solve(context, &p.problem, NULL, &r), SL_BAD_ARGUMENT);
    assert_string_equal(sl_context_message(context), message);
    assert_int_equal(r.cost, 77);
}

/// Where the bound stays below the least cost, the relaxation takes columns in part: all of them,
/// in a problem in which each is like any other.
static void values_are_shares(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_cover_options options = sl_cover_options_default();
    sl_cover_result r = {0};
    double values[9] = {0};
    options.nodes = 0;
    cover_steiner(&p, 2);
    assert_int_equal(p.problem.column_count, 9);
    assert_ok(context, sli_cover_solve(context, &p.problem, &options, values, &r));
    assert_true(r.lower < r.cost);
    for (int j = 0; j < 9; j++) assert_true(values[j] > 0.02 && values[j] < 1);
    sl_cover_result_destroy(context, &r);
    sl_context_destroy(context);
}

static void refuses_what_makes_no_sense(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    cover_begin(&p, 3);
    cover_add_column(&p);
    cover_add_entry(&p, 0);
    cover_add_entry(&p, 2);
    refused(context, "row 1 demands 1 columns, and has 0");
    p.entries[1] = 3;
    refused(context, "column 0: rows are below 3 and ascending");
    p.entries[1] = 0;
    refused(context, "column 0: rows are below 3 and ascending");
    p.entries[1] = 2;
    p.costs[0] = 0;
    p.problem.costs = p.costs;
    refused(context, "column 0 costs nothing");
    sl_context_destroy(context);
}

/// Cancelled at any question, there is a set and a bound, or nothing at all.
static void keeps_the_best_when_cancelled(void **state) {
    (void)state;
    sl_random random = {11};
    cover_steiner(&p, 3);
    cover_cost(&p, &random, 3, 1);
    unsigned long full = 0, with_set = 0;
    for (unsigned long most = 0; most <= full + 1; most += 1 + most / 10) {
        cover_patience q = {0, full ? most : ULONG_MAX};
        const sl_hooks hooks = {.user = &q, .cancelled = cover_is_over};
        sl_context *context = sl_context_create(&hooks);
        sl_cover_options options = sl_cover_options_default();
        options.nodes = 100;
        sl_cover_result r = {0};
        const sl_status status = sl_cover_solve(context, &p.problem, &options, &r);
        if (!full) {
            assert_int_equal(status, SL_OK);
            full = q.asked;
        } else {
            assert_int_equal(status, most < full ? SL_CANCELLED : SL_OK);
        }
        q.most = ULONG_MAX;
        if (r.count) cover_check_result(context, &p, &r);
        with_set += status == SL_CANCELLED && r.count;
        sl_cover_result_destroy(context, &r);
        sl_context_destroy(context);
    }
    assert_true(full > 100 && with_set > 5);
}

static void survives_lack_of_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {12};
    cover_discs(&p, &random, 60, 120, 0.2);
    sl_cover_options options = sl_cover_options_default();
    options.nodes = 50;
    options.iterations = 300;
    sl_cover_result r;
    memory.calls = 0;
    solve(context, &options, &r);
    sl_cover_result_destroy(context, &r);
    const long needed = memory.calls, live = memory.live;
    for (long at = 1; at <= needed; at += 1 + needed / 400)
        for (int once = 0; once < 2; once++) {
            memory.calls = 0;
            memory.fail_at = at;
            memory.once = once;
            r = (sl_cover_result){0};
            uint64_t lower;
            sl_status status = sl_cover_solve(context, &p.problem, &options, &r);
            if (status == SL_OK) status = sl_cover_check(context, &p.problem, &r.proof, &lower);
            assert_int_equal(status, SL_NO_MEMORY);
            memory.fail_at = 0;
            memory.once = false;
            sl_cover_result_destroy(context, &r);
            assert_int_equal(memory.live, live);
        }
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_least),
        cmocka_unit_test(bounds_hold_without_search),
        cmocka_unit_test(solves_known_problems),
        cmocka_unit_test(parts_are_solved_apart),
        cmocka_unit_test(discs_are_bounded_and_repeat),
        cmocka_unit_test(starts_from_a_set),
        cmocka_unit_test(values_are_shares),
        cmocka_unit_test(refuses_what_makes_no_sense),
        cmocka_unit_test(keeps_the_best_when_cancelled),
        cmocka_unit_test(survives_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
