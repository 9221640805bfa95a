// Splits of parts that are too large for trees: bounds that trees cannot reach, proofs that the
// check confirms, and no change of a split that makes it prove too much.
#include "cover_problems.h"

enum { CYCLES = 6, LENGTH = 5 };

static cover_problem p;

static void add_pair(uint32_t a, uint32_t b, uint32_t cost) {
    p.costs[p.problem.column_count] = cost;
    cover_add_column(&p);
    cover_add_entry(&p, a < b ? a : b);
    cover_add_entry(&p, a < b ? b : a);
}

/// Odd cycles in a row, each column on two neighbours. A linear program takes all by halves. Dear
/// columns join a cycle with the next one.
static void make_cycles(sl_random *random, bool various) {
    cover_begin(&p, CYCLES * LENGTH);
    p.problem.costs = p.costs;
    for (uint32_t k = 0; k < CYCLES; k++) {
        const uint32_t first = k * LENGTH;
        for (uint32_t i = 0; i < LENGTH; i++)
            add_pair(first + i, first + (i + 1) % LENGTH,
                     various ? 24 + 6 * (uint32_t)sl_random_below(random, 3) : 1);
        if (k + 1 < CYCLES)
            add_pair(first + (uint32_t)sl_random_below(random, LENGTH),
                     first + LENGTH + (uint32_t)sl_random_below(random, LENGTH), various ? 54 : 2);
    }
}

static void solve(sl_context *context, uint64_t nodes, uint32_t splits, sl_cover_result *out) {
    sl_cover_options options = sl_cover_options_default();
    options.nodes = nodes;
    options.splits = splits;
    assert_ok(context, sl_cover_solve(context, &p.problem, &options, out));
    assert_int_equal(cover_proves(context, &p, &out->proof), out->lower);
}

static void change_all(sl_context *context, sl_random *random, const sl_cover_proof *proof,
                       uint64_t least) {
    for (uint32_t i = 0; i < proof->split_count; i++) {
        sl_cover_split *s = &proof->splits[i];
        for (uint32_t k = 0; k < s->cost_count; k++) {
            cover_change(context, &p, proof, &s->costs[k], s->costs[k] + 1, least);
            cover_change(context, &p, proof, &s->costs[k], 0, least);
            cover_change(context, &p, proof, &s->costs[k], UINT32_MAX, least);
        }
        for (uint32_t k = 0; k < s->row_count; k++)
            cover_change(context, &p, proof, &s->blocks[k], (uint32_t)sl_random_below(random, 6),
                         least);
        cover_change(context, &p, proof, &s->unit, s->unit - 1, least);
        cover_change(context, &p, proof, &s->unit, 1, least);
        cover_change(context, &p, proof, &s->unit, 0, least);
        cover_change(context, &p, proof, &s->row_count, s->row_count - 1, least);
        cover_change(context, &p, proof, &s->cost_count, s->cost_count - 1, least);
        cover_change(context, &p, proof, &s->rest->row_count, s->row_count - 1, least);
        sl_cover_proof *rest = s->rest;
        s->rest = NULL;
        assert_true(cover_proves(context, &p, proof) <= least);
        s->rest = rest;
        rest->split_count = 1; // a split within a split: nothing is read there
        assert_true(cover_proves(context, &p, proof) <= least);
        rest->split_count = 0;
    }
}

static void splits_close_gaps(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    size_t better = 0, splits = 0;
    const uint64_t seeds = testing_seeds(20);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        sl_random random = {seed};
        sl_cover_result best, coarse, split;
        make_cycles(&random, seed % 2);
        solve(context, 10000, 0, &best);
        solve(context, 0, 0, &coarse);
        solve(context, 0, 6, &split);
        assert_true(split.lower >= coarse.lower);
        assert_true(split.lower <= best.cost);
        better += split.lower > coarse.lower;
        splits += split.proof.split_count;
        assert_int_equal(coarse.proof.split_count, 0);
        change_all(context, &random, &split.proof, best.cost);
        sl_cover_result_destroy(context, &best);
        sl_cover_result_destroy(context, &coarse);
        sl_cover_result_destroy(context, &split);
    }
    assert_true(better > seeds / 2);
    assert_true(splits > seeds / 2);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
}

static void without_memory(void **state) {
    (void)state;
    sl_random random = {1};
    make_cycles(&random, false);
    sl_cover_options options = sl_cover_options_default();
    options.nodes = 0;
    options.splits = 2;
    cover_without_memory(&p, &options);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splits_close_gaps),
        cmocka_unit_test(without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
