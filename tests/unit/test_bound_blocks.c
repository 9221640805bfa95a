// Bounds of large parts, block by block: above those of a coarse cover, with proofs that the check
// confirms, however early they are cancelled.
#include "cover_problems.h"

#include "analysis/placement/bound_blocks.h"
#include "sightline/glpk.h"

#include <limits.h>

enum { MANY = 100 };

static cover_problem p;

/// Discs of a few points each: parts are large, and the program takes columns by halves.
static void make_problem(uint64_t seed) {
    sl_random random = {seed};
    cover_discs(&p, &random, 1000, 2000, 0.04);
}

static void solve_coarsely(sl_context *context, sl_cover_result *out) {
    sl_cover_options options = sl_cover_options_default();
    options.nodes = 0;
    options.iterations = 1000;
    assert_ok(context, sl_cover_solve(context, &p.problem, &options, out));
}

static void blocks_raise_bounds(void **state) {
    (void)state;
    sl_context *context = sl_context_create(NULL);
    for (uint64_t seed = 1; seed <= 4; seed++) {
        make_problem(seed);
        sl_cover_result r = {0};
        solve_coarsely(context, &r);
        const uint64_t before = r.lower;
        assert_ok(context, sli_bound_by_blocks(context, &p.problem, sl_cover_glpk(), MANY, &r));
        assert_true(r.lower > before && r.proof.raised_count == 1);
        cover_check_result(context, &p, &r);
        sl_cover_result_destroy(context, &r);
    }
    sl_context_destroy(context);
}

/// Without a program, or without a part that is large enough, all stays.
static void nothing_to_better(void **state) {
    (void)state;
    sl_context *context = sl_context_create(NULL);
    sl_cover_result r = {0};
    make_problem(1);
    solve_coarsely(context, &r);
    const uint64_t before = r.lower;
    assert_ok(context, sli_bound_by_blocks(context, &p.problem, NULL, MANY, &r));
    assert_ok(context, sli_bound_by_blocks(context, &p.problem, sl_cover_glpk(), 1000, &r));
    assert_true(r.lower == before && r.proof.raised_count == 0);
    cover_check_result(context, &p, &r);
    sl_cover_result_destroy(context, &r);
    sl_context_destroy(context);
}

static void cancelled(void **state) {
    (void)state;
    unsigned long raised = 0;
    make_problem(2);
    for (unsigned long most = 0; most < 120; most += 1 + most / 4) {
        sl_context *calm = sl_context_create(NULL);
        cover_patience q = {0, most};
        const sl_hooks hooks = {.user = &q, .cancelled = cover_is_over};
        sl_context *context = sl_context_create(&hooks);
        sl_cover_result r = {0};
        solve_coarsely(calm, &r);
        const sl_status status =
            sli_bound_by_blocks(context, &p.problem, sl_cover_glpk(), MANY, &r);
        assert_true(status == SL_OK || status == SL_CANCELLED);
        cover_check_result(calm, &p, &r);
        raised += status == SL_CANCELLED && r.proof.raised_count;
        sl_cover_result_destroy(calm, &r);
        sl_context_destroy(context);
        sl_context_destroy(calm);
    }
    assert_true(raised > 0);
}

/// Our own memory fails; GLPK's is not ours.
static void without_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sl_random random = {1};
    cover_discs(&p, &random, 200, 400, 0.09);
    long failed = 0;
    memory.once = true;
    for (long n = 1, done = 0; !done; n += 1 + n / 16) {
        sl_cover_result r = {0};
        solve_coarsely(context, &r);
        memory.fail_at = memory.calls + n;
        const sl_status status = sli_bound_by_blocks(context, &p.problem, sl_cover_glpk(), 20, &r);
        done = memory.calls < memory.fail_at;
        memory.fail_at = 0;
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        failed += status == SL_NO_MEMORY;
        cover_check_result(context, &p, &r);
        sl_cover_result_destroy(context, &r);
    }
    assert_true(failed > 20);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static bool is_cancelled(void *user) {
    (void)user;
    return true;
}

/// The check of the proof, which is not cancelled, takes its memory from the caller's hook.
static void check_takes_our_memory(void **state) {
    (void)state;
    testing_memory memory = {0};
    const sl_hooks hooks = {.user = &memory, .resize = testing_resize, .cancelled = is_cancelled};
    sl_context *calm = testing_context(&memory), *context = sl_context_create(&hooks);
    sl_cover_result r = {0};
    uint64_t lower;
    make_problem(1);
    solve_coarsely(calm, &r);
    long before = memory.calls;
    assert_ok(calm, sl_cover_check(calm, &p.problem, &r.proof, &lower));
    const long of_check = memory.calls - before;
    before = memory.calls;
    const sl_status status = sli_bound_by_blocks(context, &p.problem, sl_cover_glpk(), MANY, &r);
    assert_int_equal(status, SL_CANCELLED);
    const long own = 20; // about what the blocks allocate before they are cancelled
    assert_true(memory.calls - before > of_check + own);
    sl_cover_result_destroy(calm, &r);
    sl_context_destroy(context);
    sl_context_destroy(calm);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_raise_bounds),
        cmocka_unit_test(nothing_to_better),
        cmocka_unit_test(cancelled),
        cmocka_unit_test(without_memory),
        cmocka_unit_test(check_takes_our_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
