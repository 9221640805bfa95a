// Every method, with every solver, against the oracles on random maps, pair by pair.
// SIGHTLINE_SEEDS in the environment: how many maps (400 by default).
#include "testing.h"

#include "oracle/oracle.h"
#include "oracle/random_map.h"
#include "solver_table.h"
#include "space/subdivide.h"

/// Portals that the oracle may push for one map; maps that need more are skipped and counted.
enum { PUSH_LIMIT = 20000 };

/// The solvers behind the first two are tried on one map in so many.
enum { SLOW_SOLVERS_SKIP = 25 };

typedef struct tally {
    size_t maps, skipped, by_lines;
    size_t pairs, grazing, hidden;          ///< of the oracle
    size_t asked, doubtful, doubtful_wrong; ///< of the methods, both sights together
    size_t refused;
} tally;

/// A map, what it becomes, and who sees whom in it.
typedef struct trial {
    uint64_t seed;
    sl_map raw, map;
    sl_space space;
    bool *closed, *open;
} trial;

static void need(sl_context *context, sl_status status, uint64_t seed) {
    if (status != SL_OK) {
        fail_msg("seed %llu: %s", (unsigned long long)seed, sl_context_message(context));
    }
}

static void complain(const trial *t, const char *who, uint32_t from, uint32_t to,
                     const char *what) {
    for (size_t i = 0; i < t->raw.wall_count; i++) {
        const sl_wall *w = &t->raw.walls[i];
        print_error("wall %.17g %.17g %.17g %.17g\n", w->a.x, w->a.y, w->b.x, w->b.y);
    }
    fail_msg("seed %llu, %s, cells %u and %u: %s", (unsigned long long)t->seed, who, from, to,
             what);
}

static void begin_trial(sl_context *context, uint64_t seed, trial *t) {
    *t = (trial){.seed = seed};
    oracle_grid grid = (oracle_grid)(seed % 3);
    need(context, oracle_random_map(context, seed, grid, &t->raw), seed);
    need(context, oracle_random_map(context, seed, grid, &t->map), seed);
    need(context, sl_map_clean(context, &t->map, NULL, NULL), seed);
    sl_subdivide_options options = sl_subdivide_options_default();
    need(context, sli_subdivide_kd(context, &t->map, &options, &t->space), seed);
    need(context, sl_space_check(context, &t->space), seed);
    size_t pairs = (size_t)t->space.cell_count * t->space.cell_count;
    t->closed = calloc(pairs, sizeof *t->closed);
    t->open = calloc(pairs, sizeof *t->open);
    assert_true(t->closed && t->open);
}

static void end_trial(sl_context *context, trial *t) {
    free(t->closed);
    free(t->open);
    sl_space_destroy(context, &t->space);
    sl_map_destroy(context, &t->map);
    sl_map_destroy(context, &t->raw);
}

/// Asks the oracles, which must agree with each other. False where the map is too much for them.
static bool consult(trial *t, tally *count) {
    uint32_t n = t->space.cell_count;
    if (!oracle_by_sequences(&t->space, PUSH_LIMIT, t->closed, t->open)) return false;
    bool *by_lines = calloc((size_t)n * n, sizeof *by_lines);
    const char *reason;
    assert_non_null(by_lines);
    bool asked = t->seed % 3 != ORACLE_GRID_TENTHS;
    if (asked && !oracle_by_lines(&t->space, t->raw.walls, t->raw.wall_count, by_lines, &reason)) {
        complain(t, "oracle by lines", 0, 0, reason);
    }
    count->by_lines += asked;
    for (uint32_t a = 0; a < n; a++) {
        for (uint32_t b = 0; b < n; b++) {
            size_t at = (size_t)a * n + b, back = (size_t)b * n + a;
            if (asked && t->open[at] != by_lines[at]) {
                complain(t, "oracles", a, b,
                         by_lines[at] ? "hidden by portals, seen by lines"
                                      : "seen by portals, hidden by lines");
            }
            if (t->open[at] && !t->closed[at]) complain(t, "oracle", a, b, "open but not closed");
            if (t->closed[at] != t->closed[back] || t->open[at] != t->open[back]) {
                complain(t, "oracle", a, b, "not symmetric");
            }
            count->grazing += t->closed[at] && !t->open[at];
            count->hidden += !t->closed[at];
        }
    }
    count->pairs += (size_t)n * n;
    free(by_lines);
    return true;
}

static void compare(const trial *t, const char *who, const sl_visibility *seen, tally *count) {
    uint32_t n = t->space.cell_count;
    const bool *truth = seen->sight == SL_OPEN ? t->open : t->closed;
    for (uint32_t a = 0; a < n; a++) {
        for (uint32_t b = 0; b < n; b++) {
            bool said = sl_pvs_sees(&seen->pvs, a, b), is = truth[(size_t)a * n + b];
            count->asked++;
            if (seen->doubtful.cell_count && sl_pvs_sees(&seen->doubtful, a, b)) {
                count->doubtful++;
                count->doubtful_wrong += said != is;
            } else if (said && !is && seen->guarantee != SL_CONSERVATIVE) {
                complain(t, who, a, b, "said to be seen, is hidden");
            } else if (!said && is && seen->guarantee != SL_AGGRESSIVE) {
                complain(t, who, a, b, "said to be hidden, is seen");
            }
        }
    }
}

static void try_method(sl_context *context, const trial *t, const sl_see_method *method,
                       const sl_solver *solver, tally *count) {
    for (int sight = 0; sight < 2; sight++) {
        char who[64];
        sl_visibility seen = {0};
        sl_see_options options = sl_see_options_default();
        options.sight = sight ? SL_OPEN : SL_CLOSED;
        options.solver = solver;
        options.threads = 1;
        snprintf(who, sizeof who, "%s %s %s", method->name, solver ? solver->name : "",
                 sight ? "open" : "closed");
        const sl_status status = method->see(context, &t->space, &options, &seen);
        if (status == SL_UNSUPPORTED) {
            count->refused++; // glpk-exact, where coordinates do not fit its integers
            continue;
        }
        need(context, status, t->seed);
        assert_int_equal(seen.sight, options.sight);
        compare(t, who, &seen, count);
        sl_visibility_destroy(context, &seen);
    }
}

static void test_methods_on_random_maps(void **state) {
    (void)state;
    tally count = {0};
    sl_context *context = sl_context_create(NULL);
    size_t method_count;
    const sl_see_method *methods = sl_see_methods(&method_count);
    assert_true(method_count > 0);
    const uint64_t seeds = testing_seeds(400);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        trial t;
        begin_trial(context, seed, &t);
        count.maps++;
        if (consult(&t, &count)) {
            for (size_t m = 0; m < method_count; m++) {
                if (!methods[m].stabs) try_method(context, &t, &methods[m], NULL, &count);
                for (size_t i = 0; methods[m].stabs && solver_at(i); i++)
                    if (i < 2 || seed % SLOW_SOLVERS_SKIP == 0)
                        try_method(context, &t, &methods[m], solver_at(i), &count);
            }
        } else {
            count.skipped++;
        }
        end_trial(context, &t);
    }
    sl_context_destroy(context);
    print_message(
        "%zu maps (%zu skipped, %zu by lines too), %zu ordered pairs: %zu hidden, %zu by "
        "grazing lines only\n%zu answers, %zu doubtful, of these %zu wrong; %zu searches refused\n",
        count.maps, count.skipped, count.by_lines, count.pairs, count.hidden, count.grazing,
        count.asked, count.doubtful, count.doubtful_wrong, count.refused);
    assert_true(count.skipped * 10 <= count.maps);
    assert_true(count.hidden > 0 && count.grazing > 0);
    assert_true(count.doubtful * 2 < count.asked);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_methods_on_random_maps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
