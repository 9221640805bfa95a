/// The check of proofs: whatever is changed in one, it never proves more than the least cost.
#include "cover_problems.h"

#include <limits.h>

static cover_problem p;

/// Parts of a proof, and numbers to put there.
static uint64_t odd_number(sl_random *random) {
    static const uint64_t numbers[] = {0,
                                       1,
                                       2,
                                       UINT32_MAX,
                                       UINT32_MAX - 1,
                                       UINT64_MAX,
                                       UINT64_MAX - 1,
                                       SIZE_MAX,
                                       1u << 31,
                                       (uint64_t)1 << 31,
                                       (uint64_t)1 << 62,
                                       (uint64_t)1 << 63};
    return sl_random_below(random, 2) ? sl_random_below(random, 14)
                                      : numbers[sl_random_below(random, 12)];
}

/// Changes one thing. Arrays stay as long as their counts say, or longer.
static void mutate(sl_random *random, sl_cover_proof *q) {
    const uint64_t number = odd_number(random);
    const uint32_t small = (uint32_t)number;
    switch (sl_random_below(random, 12)) {
    case 0:
        q->denominator = number;
        break;
    case 1:
        q->part_count = small % (q->node_count + 2);
        break;
    case 2:
        q->step_count -= q->step_count > 0;
        break;
    case 3:
        q->node_count -= q->node_count > 0;
        break;
    case 4:
        if (q->row_count) q->parts[sl_random_below(random, q->row_count)] = small;
        break;
    case 5:
        if (!q->step_count) break;
        switch (sl_random_below(random, 3)) {
        case 0:
            q->steps[sl_random_below(random, q->step_count)].kind = small;
            break;
        case 1:
            q->steps[sl_random_below(random, q->step_count)].what = small;
            break;
        default:
            q->steps[sl_random_below(random, q->step_count)].by = small;
            break;
        }
        break;
    case 6:
        if (q->node_count) q->nodes[sl_random_below(random, q->node_count)].column = small;
        break;
    case 7:
        if (q->node_count)
            q->nodes[sl_random_below(random, q->node_count)].children[sl_random_below(random, 2)] =
                small;
        break;
    case 8:
        if (q->node_count) q->nodes[sl_random_below(random, q->node_count)].duals = (size_t)number;
        break;
    default:
        if (!q->dual_count) break;
        uint64_t *dual = &q->duals[sl_random_below(random, q->dual_count)];
        *dual = sl_random_below(random, 2) ? number : *dual + *dual / 2;
    }
}

static void *copy(const void *from, size_t count, size_t size) {
    void *to = malloc(count * size + 1);
    assert_non_null(to);
    if (count) memcpy(to, from, count * size);
    return to;
}

/// Each trial changes a copy of the proof once more, up to four times.
static void try_mutations(sl_context *context, sl_random *random, const sl_cover_proof *proof,
                          uint64_t least, uint64_t *weaker) {
    sl_cover_proof q = *proof;
    q.steps = copy(proof->steps, proof->step_count, sizeof *q.steps);
    q.parts = copy(proof->parts, proof->row_count, sizeof *q.parts);
    q.nodes = copy(proof->nodes, proof->node_count, sizeof *q.nodes);
    q.duals = copy(proof->duals, proof->dual_count, sizeof *q.duals);
    for (int i = 0; i < 4; i++) {
        mutate(random, &q);
        uint64_t proven;
        assert_ok(context, sl_cover_check(context, &p.problem, &q, &proven));
        if (proven > least)
            fail_msg("proves %llu of %llu", (unsigned long long)proven, (unsigned long long)least);
        *weaker += proven < least;
    }
    free(q.steps);
    free(q.parts);
    free(q.nodes);
    free(q.duals);
}

static void never_proves_too_much(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {31};
    uint64_t weaker = 0;
    const uint64_t seeds = testing_seeds(300);
    for (uint64_t i = 0; i < seeds; i++) {
        cover_small(&p, &random);
        if (i % 3 == 0) { // one that leaves something to branch on
            cover_steiner(&p, 2);
            if (i % 2) cover_cost(&p, &random, 9, 1);
            if (i % 4 == 0) cover_demand(&p, &random, 2);
        }
        const uint64_t least = cover_brute(&p);
        sl_cover_result r;
        assert_ok(context, sl_cover_solve(context, &p.problem, NULL, &r));
        cover_check_result(context, &p, &r);
        assert_true(r.lower == least);
        for (int k = 0; k < 10; k++) try_mutations(context, &random, &r.proof, least, &weaker);
        sl_cover_result_destroy(context, &r);
    }
    assert_true(weaker > seeds * 5); // most changes do harm
    sl_context_destroy(context);
}

// --- steps

enum { TRIED_COLUMNS = 6, TRIED_NODES = 1 << (TRIED_COLUMNS + 1) };

/// All sets of the columns [0 .. count), as a tree whose leaves have no duals: it proves the least
/// cost of what steps leave. Node `at` is the root of those from `from` on.
static void grow_all(sl_cover_node *nodes, uint32_t *used, uint32_t at, const uint32_t *columns,
                     uint32_t count) {
    nodes[at] = (sl_cover_node){UINT32_MAX, {UINT32_MAX, UINT32_MAX}, SIZE_MAX};
    if (!count) return;
    nodes[at].column = columns[0];
    for (int k = 0; k < 2; k++) {
        nodes[at].children[k] = (*used)++;
        grow_all(nodes, used, nodes[at].children[k], columns + 1, count - 1);
    }
}

/// What steps and such a tree prove; 0 where a step is refused.
static uint64_t prove_after(sl_context *context, sl_cover_step *steps, uint32_t count) {
    static sl_cover_node nodes[TRIED_NODES];
    uint32_t rest[16], parts[16] = {0}, columns[TRIED_COLUMNS], left = 0, used = 1;
    bool gone[TRIED_COLUMNS] = {false};
    for (uint32_t r = 0; r < p.problem.row_count; r++) rest[r] = p.demands[r];
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t what = steps[i].what;
        if (steps[i].kind == SL_COVER_ROW_GOES) {
            rest[what] = 0;
            continue;
        }
        gone[what] = true;
        for (size_t k = what ? p.ends[what - 1] : 0;
             k < p.ends[what] && steps[i].kind == SL_COVER_COLUMN_TAKEN; k++)
            rest[p.entries[k]] -= rest[p.entries[k]] > 0;
    }
    for (uint32_t j = 0; j < p.problem.column_count; j++) {
        bool useful = false;
        for (size_t k = j ? p.ends[j - 1] : 0; k < p.ends[j]; k++) useful |= rest[p.entries[k]] > 0;
        if (useful && !gone[j]) columns[left++] = j;
    }
    grow_all(nodes, &used, 0, columns, left);
    uint32_t rows = 0;
    for (uint32_t r = 0; r < p.problem.row_count; r++) rows += rest[r] > 0;
    const sl_cover_proof proof = {
        1,   p.problem.row_count, count, rows > 0, used, 0, steps, parts, nodes, NULL, 0, NULL, 0,
        NULL};
    uint64_t proven;
    assert_ok(context, sl_cover_check(context, &p.problem, &proof, &proven));
    return proven;
}

/// Steps by chance: whatever is let through keeps the least cost.
static void steps_keep_the_least_cost(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_random random = {32};
    uint64_t kept[3] = {0}, refused = 0;
    const uint64_t seeds = testing_seeds(800);
    for (uint64_t i = 0; i < seeds; i++) {
        const uint32_t rows = 2 + (uint32_t)sl_random_below(&random, 4);
        cover_random(&p, &random, rows, TRIED_COLUMNS, 2);
        cover_demand(&p, &random, 2);
        if (i % 2) cover_cost(&p, &random, 3, 1);
        const uint64_t least = cover_brute(&p);
        sl_cover_step steps[8];
        uint32_t count = 0;
        for (int tries = 0; tries < 60 && count < 7; tries++) {
            const uint32_t kind = (uint32_t)sl_random_below(&random, 3);
            const uint32_t what_most = kind == SL_COVER_ROW_GOES ? rows : TRIED_COLUMNS;
            const uint32_t by_most = kind == SL_COVER_COLUMN_GOES ? TRIED_COLUMNS : rows;
            steps[count] = (sl_cover_step){kind, (uint32_t)sl_random_below(&random, what_most),
                                           (uint32_t)sl_random_below(&random, by_most)};
            const uint64_t proven = prove_after(context, steps, count + 1);
            if (proven > least)
                fail_msg("a step of kind %u lets %llu through for %llu", kind,
                         (unsigned long long)proven, (unsigned long long)least);
            refused += proven < least;
            if (proven != least || !least) continue;
            kept[kind]++;
            count++;
        }
    }
    assert_true(kept[0] > seeds / 10 && kept[1] > seeds / 10 && kept[2] > seeds / 10);
    assert_true(refused > seeds);
    sl_context_destroy(context);
}

/// Nothing at all proves 0; a proof of another problem has another number of rows.
static void empty_proofs_prove_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    cover_steiner(&p, 2);
    uint64_t proven = 77;
    const sl_cover_proof none = {0};
    assert_ok(context, sl_cover_check(context, &p.problem, &none, &proven));
    assert_int_equal(proven, 0);
    sl_cover_result r;
    assert_ok(context, sl_cover_solve(context, &p.problem, NULL, &r));
    cover_steiner(&p, 3);
    assert_ok(context, sl_cover_check(context, &p.problem, &r.proof, &proven));
    assert_int_equal(proven, 0);
    sl_cover_result_destroy(context, &r);
    sl_context_destroy(context);
}

/// Nodes that lead to each other, or two ways to one node, end.
static void ends_in_circles(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    cover_steiner(&p, 2);
    enum { NODES = 9 };
    sl_cover_node nodes[NODES];
    uint32_t parts[12] = {0};
    for (uint32_t i = 0; i < NODES; i++)
        nodes[i] = (sl_cover_node){i, {(i + 1) % NODES, (i + 1) % NODES}, SIZE_MAX};
    const sl_cover_proof proof = {1,     12,    0,    1, NODES, 0, NULL,
                                  parts, nodes, NULL, 0, NULL,  0, NULL};
    uint64_t proven;
    assert_ok(context, sl_cover_check(context, &p.problem, &proof, &proven));
    assert_int_equal(proven, 0);
    sl_context_destroy(context);
}

/// Sums beyond 128 bits prove nothing, and do no harm.
static void sums_do_not_overflow(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const uint32_t rows = 3;
    cover_begin(&p, rows);
    for (uint32_t j = 0; j < 2; j++) {
        cover_add_column(&p);
        for (uint32_t r = 0; r < rows; r++) cover_add_entry(&p, r);
        p.costs[j] = UINT32_MAX - j;
    }
    p.problem.costs = p.costs;
    uint64_t duals[3] = {UINT64_MAX, UINT64_MAX, UINT64_MAX};
    uint32_t parts[3] = {0};
    sl_cover_node node = {UINT32_MAX, {UINT32_MAX, UINT32_MAX}, 0};
    for (uint64_t denominator = 1; denominator; denominator *= 16) {
        const sl_cover_proof proof = {denominator, rows,  0,     1, 1,    3, NULL,
                                      parts,       &node, duals, 0, NULL, 0, NULL};
        uint64_t proven;
        assert_ok(context, sl_cover_check(context, &p.problem, &proof, &proven));
        assert_true(proven <= p.costs[1]);
    }
    for (uint32_t r = 0; r < rows; r++) p.demands[r] = UINT32_MAX; // no set at all
    p.problem.demands = p.demands;
    const sl_cover_proof proof = {1, rows, 0, 1, 1, 3, NULL, parts, &node, duals, 0, NULL, 0, NULL};
    uint64_t proven;
    assert_ok(context, sl_cover_check(context, &p.problem, &proof, &proven));
    assert_true(proven == UINT64_MAX);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(never_proves_too_much),      cmocka_unit_test(steps_keep_the_least_cost),
        cmocka_unit_test(empty_proofs_prove_nothing), cmocka_unit_test(ends_in_circles),
        cmocka_unit_test(sums_do_not_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
