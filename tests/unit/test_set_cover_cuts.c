// Cuts: bounds above those of the linear program, proofs that the check confirms, and no change of
// a cut that makes it prove too much.
#include "cover_problems.h"

#include "sightline/glpk.h"

#include <limits.h>

static cover_problem p;

/// One node: the bound is that of the root.
static void solve(sl_context *context, uint64_t nodes, uint32_t cuts, sl_cover_result *out) {
    sl_cover_options options = sl_cover_options_default();
    options.program = sl_cover_glpk();
    options.nodes = nodes;
    options.cuts = cuts;
    assert_ok(context, sl_cover_solve(context, &p.problem, &options, out));
    cover_check_result(context, &p, out);
}

/// Sparse ones, which leave the program a gap; demands and costs of all kinds.
static void make_problem(sl_random *random, uint64_t seed) {
    cover_random(&p, random, 80, 80, 11);
    cover_demand(&p, random, seed % 3 == 1 ? 2 : 1);
    if (seed % 2) cover_cost(&p, random, 4, 6);
}

static void change_all(sl_context *context, sl_random *random, const sl_cover_proof *proof,
                       uint64_t least) {
    for (uint32_t i = 0; i < proof->raised_count; i++) {
        sl_cover_cuts *c = &proof->raised[i];
        const size_t count = c->ends[c->cut_count - 1];
        for (size_t k = 0; k < count; k++) {
            const uint32_t names = c->row_count + c->cut_count + 2;
            cover_change(context, &p, proof, &c->rows[k], (uint32_t)sl_random_below(random, names),
                         least);
            cover_change(context, &p, proof, &c->rows[k], UINT32_MAX, least);
        }
        for (uint32_t k = 0; k < c->cut_count; k++) {
            const size_t was = c->ends[k];
            c->ends[k] = sl_random_below(random, count + 1);
            assert_true(cover_proves(context, &p, proof) <= least);
            c->ends[k] = was;
        }
        cover_change(context, &p, proof, &c->row_count, c->row_count - 1, least);
        cover_change(context, &p, proof, &c->cut_count, c->cut_count - 1, least);
        cover_change(context, &p, proof, &c->rest->row_count, c->row_count, least);
        for (size_t k = 0; k < c->rest->dual_count; k++) {
            const uint64_t was = c->rest->duals[k];
            c->rest->duals[k] = was + c->rest->denominator / 2;
            assert_true(cover_proves(context, &p, proof) <= least);
            c->rest->duals[k] = was;
        }
        sl_cover_proof *rest = c->rest;
        c->rest = NULL;
        assert_true(cover_proves(context, &p, proof) <= least);
        c->rest = rest;
        rest->raised_count = 1; // cuts within cuts: nothing is read there
        assert_true(cover_proves(context, &p, proof) <= least);
        rest->raised_count = 0;
    }
}

static void cuts_raise_bounds(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    size_t better = 0, of_cuts = 0;
    const uint64_t seeds = testing_seeds(24);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_random random = {seed};
        sl_cover_result best, plain, raised;
        make_problem(&random, seed);
        solve(context, 100000, 0, &best);
        assert_true(best.lower == best.cost);
        solve(context, 1, 0, &plain);
        solve(context, 1, 60, &raised);
        assert_int_equal(plain.proof.raised_count, 0);
        assert_true(raised.lower >= plain.lower);
        assert_true(raised.lower <= best.cost);
        better += raised.lower > plain.lower;
        for (uint32_t i = 0; i < raised.proof.raised_count; i++) {
            const sl_cover_cuts *c = &raised.proof.raised[i];
            for (size_t k = 0; k < c->ends[c->cut_count - 1]; k++)
                of_cuts += c->rows[k] >= c->row_count;
        }
        change_all(context, &random, &raised.proof, best.cost);
        sl_cover_result_destroy(context, &best);
        sl_cover_result_destroy(context, &plain);
        sl_cover_result_destroy(context, &raised);
    }
    assert_true(better > seeds / 8);
    assert_true(of_cuts > seeds); // cuts are made of cuts, too
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

/// Trees grow on from cuts to the least cost.
static void trees_stand_on_cuts(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t grown = 0;
    const uint64_t seeds = testing_seeds(12);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_random random = {seed};
        sl_cover_result plain, raised;
        make_problem(&random, seed);
        solve(context, 100000, 0, &plain);
        solve(context, 100000, 2, &raised);
        assert_true(raised.lower == raised.cost && raised.cost == plain.cost);
        for (uint32_t i = 0; i < raised.proof.raised_count; i++)
            grown += raised.proof.raised[i].rest->node_count > 1;
        sl_cover_result_destroy(context, &plain);
        sl_cover_result_destroy(context, &raised);
    }
    assert_true(grown > 0);
    sl_context_destroy(context);
}

/// Cancelled between cuts, those that are there count.
static void cancelled_between_cuts(void **state) {
    (void)state;
    sl_random random = {30};
    make_problem(&random, 30);
    unsigned long full = 0, with_cuts = 0;
    for (unsigned long most = 0; most <= full; most += 1 + most / 20) {
        cover_patience q = {0, full ? most : ULONG_MAX};
        const sl_hooks hooks = {.user = &q, .cancelled = cover_is_over};
        sl_context *context = sl_context_create(&hooks);
        sl_cover_options options = sl_cover_options_default();
        options.program = sl_cover_glpk();
        options.nodes = 1;
        sl_cover_result r = {0};
        const sl_status status = sl_cover_solve(context, &p.problem, &options, &r);
        if (!full) full = q.asked;
        assert_true(status == SL_OK || status == SL_CANCELLED);
        q.most = ULONG_MAX;
        if (r.count) cover_check_result(context, &p, &r);
        with_cuts += status == SL_CANCELLED && r.proof.raised_count;
        sl_cover_result_destroy(context, &r);
        sl_context_destroy(context);
    }
    assert_true(with_cuts > 0);
}

/// Our own memory fails; GLPK's is not ours.
static void without_memory(void **state) {
    (void)state;
    sl_random random = {3};
    make_problem(&random, 0);
    sl_cover_options options = sl_cover_options_default();
    options.program = sl_cover_glpk();
    options.nodes = 1;
    cover_without_memory(&p, &options);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_raise_bounds),
        cmocka_unit_test(trees_stand_on_cuts),
        cmocka_unit_test(cancelled_between_cuts),
        cmocka_unit_test(without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
