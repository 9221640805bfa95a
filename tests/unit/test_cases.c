// The hard portal sequences, tests/cases/*.portals: every solver, both references, every file.
// Exact solvers must give the verdict that stands in the file, for the sequence as it is, walked
// backwards, turned and mirrored. How rounded solvers err is printed.
#include "testing.h"

#include "geometry/orient.h"
#include "oracle/margin.h"
#include "oracle/random_sequence.h"
#include "portals_text.h"
#include "solver_table.h"

#include <glob.h>

/// Longer sequences are not for the slower oracle, and are asked in two ways only.
enum { VERDICTS = SL_STABBED + 1, ORACLE_MOST = 64 };

/// The ways in which a sequence is asked: each must give the same verdict.
typedef enum way { AS_IT_IS, BACKWARDS, TURNED, MIRRORED, WAYS } way;

typedef struct tally {
    size_t too_long, refused, said[VERDICTS][VERDICTS]; ///< by what was said and what is
} tally;

static sl_point turned(sl_point p) {
    return (sl_point){-p.y, p.x};
}

static sl_point mirrored(sl_point p) {
    return (sl_point){-p.x, p.y};
}

/// The sequence in another way, all exact; for free().
static oracle_portal *go(const portals_text *text, way how) {
    oracle_portal *portals = calloc(text->count, sizeof *portals);
    assert_non_null(portals);
    for (size_t i = 0; i < text->count; i++) {
        const oracle_portal p = text->portals[i];
        if (how == AS_IT_IS) portals[i] = p;
        // The line the other way has left ends at its right.
        if (how == BACKWARDS) portals[text->count - 1 - i] = (oracle_portal){p.right, p.left};
        if (how == TURNED) portals[i] = (oracle_portal){turned(p.left), turned(p.right)};
        if (how == MIRRORED) portals[i] = (oracle_portal){mirrored(p.right), mirrored(p.left)};
    }
    return portals;
}

static void check_references(const char *path, const portals_text *text) {
    if (!oracle_forwards(text->portals, text->count))
        fail_msg("%s: no direction crosses all portals forwards", path);
    const oracle_margin margin = oracle_margin_of(text->portals, text->count);
    if (margin.verdict != text->verdict)
        fail_msg("%s: the margin is %g: %s", path, margin.value, verdict_name(margin.verdict));
    if (text->count > ORACLE_MOST) return;
    const sl_stab_verdict verdict = oracle_stab(text->portals, text->count);
    if (verdict != text->verdict) fail_msg("%s: the oracle says %s", path, verdict_name(verdict));
}

static void check_witness(const char *path, const sl_solver *solver, const void *state,
                          const oracle_portal *portals, size_t count) {
    const sl_line line = solver->witness(state);
    for (size_t i = 0; i < count; i++) {
        if (sli_orient(line.a, line.b, portals[i].left) < 0 ||
            sli_orient(line.a, line.b, portals[i].right) > 0)
            fail_msg("%s: the witness of %s passes portal %zu on the wrong side", path,
                     solver->name, i);
    }
}

/// False where the solver refuses.
static bool ask(const char *path, sl_context *context, const sl_solver *solver,
                const oracle_portal *portals, size_t count, sl_stab_verdict *verdict) {
    void *state;
    assert_ok(context, solver->create(context, oracle_bounds(portals, count), &state));
    sl_status status = SL_OK;
    *verdict = SL_STABBED;
    size_t pushed = 0;
    while (status == SL_OK && *verdict != SL_HIDDEN && pushed < count) {
        status = solver->push(context, state, portals[pushed].left, portals[pushed].right, verdict);
        pushed++;
    }
    if (status == SL_OK && *verdict != SL_HIDDEN && solver->conflict)
        check_witness(path, solver, state, portals, count);
    solver->destroy(context, state);
    if (status == SL_UNSUPPORTED) return false;
    if (status != SL_OK) fail_msg("%s: %s: %s", path, solver->name, sl_context_message(context));
    return true;
}

static void check_solver(const char *path, sl_context *context, const sl_solver *solver,
                         const portals_text *text, tally *count) {
    if (text->count > solver_patience(solver)) {
        count->too_long++;
        return;
    }
    const way ways = text->count > ORACLE_MOST ? TURNED : WAYS;
    for (way how = AS_IT_IS; how < ways; how++) {
        oracle_portal *portals = go(text, how);
        sl_stab_verdict verdict;
        const bool answered = ask(path, context, solver, portals, text->count, &verdict);
        free(portals);
        if (!answered) {
            count->refused++;
            continue;
        }
        count->said[verdict][text->verdict]++;
        if (solver->guarantee == SL_EXACT && verdict != text->verdict)
            fail_msg("%s: %s says %s (%s)", path, solver->name, verdict_name(verdict),
                     how == AS_IT_IS ? "as it is" : "backwards, turned or mirrored");
        if (how == AS_IT_IS && verdict != text->verdict)
            print_message("%s: %s says %s, is %s\n", strrchr(path, '/') + 1, solver->name,
                          verdict_name(verdict), verdict_name(text->verdict));
    }
}

static void read_case(const char *path, portals_text *text) {
    unsigned line;
    FILE *in = fopen(path, "r");
    if (!in) fail_msg("%s cannot be opened", path);
    const char *fault = portals_text_read(in, text, &line);
    fclose(in);
    if (fault) fail_msg("%s:%u: %s", path, line, fault);
}

static void print_account(const tally counts[SOLVERS_MOST]) {
    for (size_t i = 0; solver_at(i); i++) {
        const tally *t = &counts[i];
        size_t right = 0, marked = 0, wrong = 0;
        for (int said = 0; said < VERDICTS; said++) {
            for (int is = 0; is < VERDICTS; is++) {
                size_t *where = said == is ? &right : said == SL_GRAZING ? &marked : &wrong;
                *where += t->said[said][is];
            }
        }
        print_message("%-10s (%s): %zu right, %zu too near to tell, %zu wrong, %zu refused, "
                      "%zu too long\n",
                      solver_at(i)->name, sl_guarantee_name(solver_at(i)->guarantee), right, marked,
                      wrong, t->refused, t->too_long);
    }
}

static void test_hard_sequences(void **state) {
    (void)state;
    glob_t found;
    assert_int_equal(glob(SIGHTLINE_SOURCE_DIR "/tests/cases/*.portals", 0, NULL, &found), 0);
    sl_context *context = testing_context(NULL);
    tally counts[SOLVERS_MOST] = {0};
    for (size_t i = 0; i < found.gl_pathc; i++) {
        portals_text text;
        read_case(found.gl_pathv[i], &text);
        check_references(found.gl_pathv[i], &text);
        for (size_t s = 0; solver_at(s); s++)
            check_solver(found.gl_pathv[i], context, solver_at(s), &text, &counts[s]);
        portals_text_free(&text);
    }
    print_message("%zu sequences, each also backwards; the shorter ones turned and mirrored too\n",
                  found.gl_pathc);
    print_account(counts);
    solvers_leave();
    globfree(&found);
    sl_context_destroy(context);
}

static void test_broken_files_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text;
        unsigned line;
    } cases[] = {{"portal 0 0 0 1\nverdict stabbed\n", 1},
                 {"#\nportal 0 0 0 1\nverdict stabbed\n", 1},
                 {"# a\nportal 0 0 0\nverdict stabbed\n", 2},
                 {"# a\nportal 0 0 0 x\nverdict stabbed\n", 2},
                 {"# a\nportal 0 0 0 1e-200\nverdict stabbed\n", 2},
                 {"# a\nportal 1 0 0x1p0 0\nverdict stabbed\n", 2},
                 {"# a\nportal 0 0 0 1 2\nverdict stabbed\n", 2},
                 {"# a\nwall 0 0 0 1\nverdict stabbed\n", 2},
                 {"# a\nportal 0 0 0 1\nverdict seen\n", 3},
                 {"# a\nportal 0 0 0 1\nverdict\n", 3},
                 {"# a\nverdict hidden\n", 2},
                 {"# a\nportal 0 0 0 1\n", 3},
                 {"# a\nportal 0 0 0 1\nverdict stabbed\nportal 0 0 0 1\n", 4},
                 {"# a\nportal 0 0 0 1\nverdict stabbed", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        FILE *file = tmpfile();
        assert_non_null(file);
        fputs(cases[i].text, file);
        rewind(file);
        portals_text text;
        unsigned line;
        if (!portals_text_read(file, &text, &line)) fail_msg("broken text %zu is read", i);
        assert_int_equal(line, cases[i].line);
        portals_text_free(&text);
        fclose(file);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hard_sequences),
        cmocka_unit_test(test_broken_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
