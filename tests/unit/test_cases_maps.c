// The hard maps, tests/cases/*.map: cleaned, subdivided and checked, then seen by every method with
// every solver, with closed and with open sight. Exact solvers agree on every pair, with each other
// and with the oracle where that can be asked; rounded ones may differ on pairs that they mark as
// doubtful.
#include "testing.h"

#include "oracle/oracle.h"
#include "sightline/import.h"
#include "solver_table.h"
#include "space/subdivide.h"

#include <glob.h>

/// Portals that the oracle may push for one map.
enum { PUSH_LIMIT = 60000 };

typedef struct tally {
    size_t maps, pairs, doubtful, doubtful_wrong, refused;
} tally;

typedef struct trial {
    const char *path;
    sl_map map;
    sl_space space;
    bool *closed, *open; ///< by the oracle, or where it gives up by the funnel
    bool by_oracle;
} trial;

static sl_status see(sl_context *context, const trial *t, const sl_see_method *method,
                     const sl_solver *solver, sl_sight sight, sl_visibility *out) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = solver;
    options.threads = 1;
    *out = (sl_visibility){0};
    return method->see(context, &t->space, &options, out);
}

static void ask_funnel(sl_context *context, const trial *t, sl_sight sight, bool *matrix) {
    size_t count;
    sl_visibility seen;
    assert_ok(context, see(context, t, sl_see_methods(&count), sl_funnel(), sight, &seen));
    const uint32_t n = t->space.cell_count;
    for (size_t i = 0; i < (size_t)n * n; i++)
        matrix[i] = sl_pvs_sees(&seen.pvs, (uint32_t)(i / n), (uint32_t)(i % n));
    sl_visibility_destroy(context, &seen);
}

static void begin(sl_context *context, const char *path, trial *t) {
    *t = (trial){.path = path};
    assert_ok(context, sl_map_read(context, path, NULL, &t->map));
    assert_ok(context, sl_map_clean(context, &t->map, NULL, NULL));
    const sl_subdivide_options options = sl_subdivide_options_default();
    assert_ok(context, sli_subdivide_kd(context, &t->map, &options, &t->space));
    assert_ok(context, sl_space_check(context, &t->space));
    const size_t pairs = (size_t)t->space.cell_count * t->space.cell_count;
    t->closed = calloc(pairs, sizeof *t->closed);
    t->open = calloc(pairs, sizeof *t->open);
    assert_true(t->closed && t->open);
    t->by_oracle = oracle_by_sequences(&t->space, PUSH_LIMIT, t->closed, t->open);
    if (t->by_oracle) return;
    ask_funnel(context, t, SL_CLOSED, t->closed);
    ask_funnel(context, t, SL_OPEN, t->open);
}

static void end(sl_context *context, trial *t) {
    free(t->closed);
    free(t->open);
    sl_space_destroy(context, &t->space);
    sl_map_destroy(context, &t->map);
}

static void compare(const trial *t, const char *who, const sl_visibility *seen, tally *count) {
    const uint32_t n = t->space.cell_count;
    const bool *truth = seen->sight == SL_CLOSED ? t->closed : t->open;
    for (size_t i = 0; i < (size_t)n * n; i++) {
        const uint32_t a = (uint32_t)(i / n), b = (uint32_t)(i % n);
        const bool said = sl_pvs_sees(&seen->pvs, a, b);
        count->pairs++;
        if (seen->doubtful.cell_count && sl_pvs_sees(&seen->doubtful, a, b)) {
            count->doubtful++;
            count->doubtful_wrong += said != truth[i];
        } else if ((said && !truth[i] && seen->guarantee != SL_CONSERVATIVE) ||
                   (!said && truth[i] && seen->guarantee != SL_AGGRESSIVE)) {
            fail_msg("%s: %s with %s sight: cells %u and %u are %s", t->path, who,
                     seen->sight == SL_CLOSED ? "closed" : "open", a, b,
                     truth[i] ? "hidden, but see each other" : "seen, but hidden");
        }
    }
}

static void try_method(sl_context *context, const trial *t, const sl_see_method *method,
                       const sl_solver *solver, tally *count) {
    for (int sight = 0; sight < 2; sight++) {
        sl_visibility seen;
        char who[64];
        snprintf(who, sizeof who, "%s %s", method->name, solver ? solver->name : "");
        const sl_status status =
            see(context, t, method, solver, sight ? SL_OPEN : SL_CLOSED, &seen);
        if (status == SL_UNSUPPORTED)
            count->refused++;
        else if (status != SL_OK)
            fail_msg("%s: %s: %s", t->path, who, sl_context_message(context));
        else
            compare(t, who, &seen, count);
        count->maps++;
        sl_visibility_destroy(context, &seen);
    }
}

static void try_map(sl_context *context, const trial *t, tally counts[SOLVERS_MOST + 1]) {
    size_t method_count;
    const sl_see_method *methods = sl_see_methods(&method_count);
    for (size_t m = 0; m < method_count; m++) {
        if (!methods[m].stabs) try_method(context, t, &methods[m], NULL, &counts[SOLVERS_MOST]);
        for (size_t s = 0; methods[m].stabs && solver_at(s); s++)
            try_method(context, t, &methods[m], solver_at(s), &counts[s]);
    }
}

static void test_hard_maps(void **state) {
    (void)state;
    glob_t found;
    assert_int_equal(glob(SIGHTLINE_SOURCE_DIR "/tests/cases/*.map", 0, NULL, &found), 0);
    sl_context *context = testing_context(NULL);
    tally counts[SOLVERS_MOST + 1] = {0};
    size_t by_oracle = 0, grazing = 0;
    for (size_t i = 0; i < found.gl_pathc; i++) {
        trial t;
        begin(context, found.gl_pathv[i], &t);
        by_oracle += t.by_oracle;
        for (size_t k = 0; k < (size_t)t.space.cell_count * t.space.cell_count; k++)
            grazing += t.closed[k] && !t.open[k];
        try_map(context, &t, counts);
        end(context, &t);
    }
    print_message("%zu maps, %zu of them by the oracle too, %zu pairs that only graze\n",
                  found.gl_pathc, by_oracle, grazing);
    for (size_t s = 0; solver_at(s); s++)
        print_message("%-10s: %zu pairs, %zu doubtful, %zu of these wrong; refused %zu of %zu\n",
                      solver_at(s)->name, counts[s].pairs, counts[s].doubtful,
                      counts[s].doubtful_wrong, counts[s].refused, counts[s].maps);
    assert_true(grazing > 0);
    solvers_leave();
    globfree(&found);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hard_maps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
