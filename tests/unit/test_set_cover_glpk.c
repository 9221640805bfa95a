/// Set cover with GLPK's linear program: the same least costs, proven by the same check; GLPK's own
/// branch and bound finds them too.
#include "cover_problems.h"

#include "sightline/glpk.h"

static cover_problem p;

static void finds_the_least_with_a_program(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {41};
    sl_cover_options options = sl_cover_options_default();
    options.program = sl_cover_glpk();
    options.iterations = 0; // so that bounds come from the program
    const uint64_t seeds = testing_seeds(1000);
    for (uint64_t i = 0; i < seeds; i++) {
        cover_small(&p, &random);
        if (i % 4 == 0) {
            cover_steiner(&p, 2);
            cover_cost(&p, &random, 9, 1);
        }
        const uint64_t least = cover_brute(&p);
        sl_cover_result r;
        assert_ok(context, sl_cover_solve(context, &p.problem, &options, &r));
        cover_check_result(context, &p, &r);
        assert_true(r.lower == least && r.cost == least);
        sl_cover_result_destroy(context, &r);
    }
    sl_context_destroy(context);
}

/// The bound of the relaxation is that of its duals.
static void relaxes_and_branches(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {42};
    const sl_cover_program *program = sl_cover_glpk();
    for (int i = 0; i < 20; i++) {
        cover_discs(&p, &random, 60, 90, 0.2);
        cover_cost(&p, &random, 9, 1);
        double duals[COVER_ROWS], values[COVER_COLUMNS], paid = 0, asked = 0;
        assert_ok(context, program->relax(context, &p.problem, 0, duals, values));
        for (uint32_t j = 0; j < p.problem.column_count; j++) paid += p.costs[j] * values[j];
        for (uint32_t r = 0; r < p.problem.row_count; r++) asked += duals[r];
        assert_true(asked > paid * (1 - 1e-6) && asked < paid * (1 + 1e-6));
        assert_int_equal(program->relax(context, &p.problem, 1, duals, values), SL_UNSUPPORTED);
        uint32_t columns[COVER_COLUMNS], count;
        assert_ok(context, program->branch(context, &p.problem, 100000, columns, &count));
        sl_cover_options options = sl_cover_options_default();
        options.program = program;
        sl_cover_result r;
        assert_ok(context, sl_cover_solve(context, &p.problem, &options, &r));
        cover_check_result(context, &p, &r);
        uint64_t cost = 0;
        for (uint32_t k = 0; k < count; k++) cost += p.costs[columns[k]];
        assert_true(r.lower == r.cost && r.cost == cost);
        sl_cover_result_destroy(context, &r);
    }
    sl_context_destroy(context);
}

/// Columns to branch on are tried out (reliability branching). Chosen by their values alone, the
/// four trees have 424 nodes in place of about 210.
static void branches_on_what_raises_the_bound(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {43};
    uint64_t nodes = 0;
    for (int i = 0; i < 4; i++) {
        cover_random(&p, &random, 90, 90, 12);
        sl_cover_options options = sl_cover_options_default();
        options.program = sl_cover_glpk();
        options.cuts = 0;
        sl_cover_result r;
        assert_ok(context, sl_cover_solve(context, &p.problem, &options, &r));
        cover_check_result(context, &p, &r);
        assert_true(r.lower == r.cost);
        nodes += r.proof.node_count;
        sl_cover_result_destroy(context, &r);
    }
    assert_true(nodes > 4 && nodes < 300);
    sl_context_destroy(context);
}

/// Our own memory fails; GLPK's is not ours.
static void survives_lack_of_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    cover_steiner(&p, 2);
    sl_cover_options options = {.nodes = 50, .program = sl_cover_glpk()};
    sl_cover_result r;
    memory.calls = 0;
    assert_ok(context, sl_cover_solve(context, &p.problem, &options, &r));
    const long needed = memory.calls;
    sl_cover_result_destroy(context, &r);
    const long live = memory.live;
    for (long at = 1; at <= needed; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        assert_int_equal(sl_cover_solve(context, &p.problem, &options, &r), SL_NO_MEMORY);
        memory.fail_at = 0;
        assert_int_equal(memory.live, live);
    }
    sl_context_destroy(context);
}

/// A row that demands two comes in later: still no column counts for two.
static void takes_each_column_once(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_cover_program *program = sl_cover_glpk();
    const size_t ends[] = {1, 2}, more_ends[] = {2, 4};
    const uint32_t entries[] = {0, 0}, more_entries[] = {0, 1, 0, 1};
    const uint32_t costs[] = {1, 5}, demands[] = {1, 2};
    const sl_cover_problem one = {1, 2, ends, entries, costs, NULL},
                           two = {2, 2, more_ends, more_entries, costs, demands};
    const uint8_t fixed[2] = {0};
    const bool gone[1] = {false};
    void *lp = NULL;
    double duals[2], values[2];
    assert_ok(context, program->begin(context, &one, &lp));
    assert_ok(context, program->again(context, lp, fixed, 0, 0, duals, values));
    assert_true(values[0] == 1 && values[1] == 0);
    assert_ok(context, program->change(context, lp, &two, gone));
    assert_ok(context, program->again(context, lp, fixed, 0, 0, duals, values));
    assert_true(values[0] == 1 && values[1] == 1);
    program->end(context, lp);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_the_least_with_a_program),
        cmocka_unit_test(relaxes_and_branches),
        cmocka_unit_test(branches_on_what_raises_the_bound),
        cmocka_unit_test(takes_each_column_once),
        cmocka_unit_test(survives_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
