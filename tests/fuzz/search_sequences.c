// Searches for portal sequences on which solvers disagree with each other or with the references:
//   search_sequences [--seed N] [--count N] [--seconds N] [--quiet] [--self-test]
// Exact solvers must say what the references say, and the two references must agree: the first case
// where not is shrunk, printed as a case for tests/cases, and ends the search with status 1. What
// rounded solvers get wrong is counted, by what they said and what is so, with the largest distance
// by which they missed, relative to the size of the sequence; the worst of each is shrunk and
// printed too. --self-test adds a solver in plain doubles that calls itself exact, and fails where
// that is not found out. SL_GRAZING is how rounded solvers mark that they cannot tell: it is
// counted apart.
#include "search.h"

#include <getopt.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "portals_text.h"

/// A margin that a rounded solver may well not tell from none, as a share of the size.
#define NEAR 1e-8

enum { VERDICTS = SL_STABBED + 1, POOL = 512, BATCH = 1024, PATIENCE = 20 };

typedef struct options {
    uint64_t seed, count, seconds;
    bool quiet, self_test;
} options;

/// What one solver said where something else is so.
typedef struct error {
    uint64_t count;
    double miss; ///< the largest
    random_portals worst;
} error;

typedef struct tally {
    uint64_t verdicts, refused, changed;
    error errors[VERDICTS][VERDICTS]; ///< by what was said and what is
} tally;

typedef struct run {
    search search;
    options options;
    sl_random random;
    uint64_t sequences, verdicts, by_kind[RANDOM_KINDS + 1], is[VERDICTS];
    tally tallies[SOLVERS_MOST];
    random_portals near[POOL]; ///< sequences near to a disagreement, to be changed a little
    size_t near_count;
    time_t began, told;
} run;

/// A sequence made from one that came near to a disagreement, or from a solver's worst error.
static void make_from_near(run *r, random_portals *portals) {
    const tally *t = &r->tallies[sl_random_below(&r->random, r->search.solver_count)];
    const error *e =
        &t->errors[sl_random_below(&r->random, VERDICTS)][sl_random_below(&r->random, VERDICTS)];
    const bool worst = e->worst.count && sl_random_below(&r->random, 4) == 0;
    *portals = worst ? e->worst : r->near[sl_random_below(&r->random, r->near_count)];
    for (uint64_t changes = 1 + sl_random_below(&r->random, 3); changes--;)
        random_mutation(&r->random, portals);
}

static void make(run *r, random_portals *portals) {
    if (r->near_count && sl_random_below(&r->random, 3) == 0) {
        r->by_kind[RANDOM_KINDS]++;
        make_from_near(r, portals);
        return;
    }
    const random_kind kind = (random_kind)sl_random_below(&r->random, RANDOM_KINDS);
    r->by_kind[kind]++;
    random_sequence(&r->random, kind, portals);
    if (sl_random_below(&r->random, 2)) random_placing(&r->random, portals);
    if (sl_random_below(&r->random, 4) == 0)
        for (uint64_t changes = 1 + sl_random_below(&r->random, 4); changes--;)
            random_mutation(&r->random, portals);
}

/// Keeps a sequence whose margin is small beside its size, but not beyond what doubles can do.
static void keep_near(run *r, const search_trial *trial) {
    const double miss = search_miss(trial);
    if (miss < 1e-19 || miss > NEAR) return;
    const size_t at = r->near_count < POOL ? r->near_count++ : sl_random_below(&r->random, POOL);
    r->near[at] = trial->portals;
}

static void print_case(const run *r, size_t solver, const search_fault *fault,
                       const random_portals *portals) {
    char what[200];
    snprintf(what, sizeof what, "Found by search: %s says %s.", r->search.solvers[solver]->name,
             verdict_name(fault->said));
    portals_text_print(stdout, what, portals->items, portals->count, fault->is);
    puts("");
}

/// The first `count` portals, which bring the fault out: shrunk and printed.
static void report(const run *r, const search_trial *trial, size_t solver, size_t count) {
    search_fault fault = {.solver = solver,
                          .said = trial->answers[solver].verdicts[count - 1],
                          .is = trial->truth[count - 1]};
    random_portals portals = trial->portals;
    portals.count = count;
    search_shrink(&r->search, &fault, &portals);
    print_case(r, solver, &fault, &portals);
}

/// An error on the first `count` portals.
static void note_error(error *e, const search_trial *trial, size_t count, sl_stab_verdict said) {
    const bool whole = count == trial->portals.count;
    e->count++;
    // Of what was marked there is too much to measure each prefix.
    if (!whole && said == SL_GRAZING) return;
    const oracle_margin margin =
        whole ? trial->margin : oracle_margin_of(trial->portals.items, count);
    const double miss = fabs(margin.value) / trial->size;
    if (miss < e->miss) return;
    e->miss = miss;
    e->worst = trial->portals;
    e->worst.count = count;
}

/// Counts one solver's answers. False where an exact one is wrong.
static bool judge(run *r, const search_trial *trial, size_t solver) {
    const search_answer *answer = &trial->answers[solver];
    const bool exact = r->search.solvers[solver]->guarantee == SL_EXACT;
    tally *t = &r->tallies[solver];
    t->verdicts += answer->count;
    t->changed += answer->changed;
    if (answer->status != SL_OK) {
        t->refused++;
        if (answer->status != SL_UNSUPPORTED) {
            printf("%s failed: %s\n", r->search.solvers[solver]->name,
                   sl_context_message(r->search.context));
            portals_text_print(stdout, "A solver fails", trial->portals.items, trial->portals.count,
                               trial->margin.verdict);
            return false;
        }
    }
    for (size_t i = 0; i < answer->count; i++) {
        const sl_stab_verdict said = answer->verdicts[i], is = trial->truth[i];
        if (said == is) continue;
        note_error(&t->errors[said][is], trial, i + 1, said);
        if (exact) report(r, trial, solver, i + 1);
        if (exact) return false;
    }
    if (exact && answer->changed) {
        printf("%s changed its mind after a pop\n", r->search.solvers[solver]->name);
        portals_text_print(stdout, "A solver changes its mind after a pop", trial->portals.items,
                           trial->portals.count, trial->margin.verdict);
    }
    return !(exact && answer->changed);
}

/// What is being asked, for the watchdog.
static const random_portals *asked;

/// A solver that comes to no end is a finding too. (It does not print at that time, so that
/// printing here meets no lock.)
static void bark(int number) {
    (void)number;
    puts("No answer for a long time.");
    portals_text_print(stdout, "A solver comes to no end", asked->items, asked->count, SL_HIDDEN);
    fflush(stdout);
    _exit(1);
}

/// One sequence. False where something is found that must not be.
static bool step(run *r) {
    random_portals portals;
    search_trial trial;
    make(r, &portals);
    const size_t back =
        sl_random_below(&r->random, 4) ? 0 : 1 + sl_random_below(&r->random, portals.count);
    asked = &portals;
    alarm(PATIENCE);
    const bool whole = search_ask(&r->search, &portals, back, &trial);
    alarm(0);
    if (!whole) {
        if (trial.portals.count < 2) return true;
        printf("The references disagree; one says %s.\n", verdict_name(trial.margin.verdict));
        portals_text_print(stdout, "References", trial.portals.items, trial.portals.count,
                           trial.truth[trial.portals.count - 1]);
        return false;
    }
    r->sequences++;
    r->verdicts += trial.portals.count;
    for (size_t i = 0; i < trial.portals.count; i++) r->is[trial.truth[i]]++;
    keep_near(r, &trial);
    bool good = true;
    for (size_t i = 0; i < r->search.solver_count && good; i++) good = judge(r, &trial, i);
    return good;
}

static void tell_progress(run *r) {
    const time_t now = time(NULL);
    if (r->options.quiet || now - r->told < 10) return;
    r->told = now;
    fprintf(stderr, "%llu sequences, %llu verdicts, %zu near ones, %lld s\n",
            (unsigned long long)r->sequences, (unsigned long long)r->verdicts, r->near_count,
            (long long)(now - r->began));
}

static bool search_on(run *r) {
    r->began = r->told = time(NULL);
    while (r->sequences < r->options.count) {
        for (int i = 0; i < BATCH && r->sequences < r->options.count; i++)
            if (!step(r)) return false;
        tell_progress(r);
        if (r->options.seconds && (uint64_t)(time(NULL) - r->began) >= r->options.seconds) break;
    }
    return true;
}

static void print_errors(const run *r, size_t solver) {
    for (int said = 0; said < VERDICTS; said++) {
        for (int is = 0; is < VERDICTS; is++) {
            const error *e = &r->tallies[solver].errors[said][is];
            if (!e->count) continue;
            printf("  says %s where it is %s: %llu, by %.3g at most%s\n",
                   verdict_name((sl_stab_verdict)said), verdict_name((sl_stab_verdict)is),
                   (unsigned long long)e->count, e->miss,
                   said == SL_GRAZING ? " (marked as too near to tell)" : "");
        }
    }
}

static void print_table(const run *r) {
    printf("%llu sequences (", (unsigned long long)r->sequences);
    for (int i = 0; i < RANDOM_KINDS; i++)
        printf("%s %llu, ", random_kind_name((random_kind)i), (unsigned long long)r->by_kind[i]);
    printf("changed near ones %llu), seed %llu, %lld s\n",
           (unsigned long long)r->by_kind[RANDOM_KINDS], (unsigned long long)r->options.seed,
           (long long)(time(NULL) - r->began));
    printf("%llu verdicts: %llu hidden, %llu grazing, %llu stabbed\n",
           (unsigned long long)r->verdicts, (unsigned long long)r->is[SL_HIDDEN],
           (unsigned long long)r->is[SL_GRAZING], (unsigned long long)r->is[SL_STABBED]);
    for (size_t i = 0; i < r->search.solver_count; i++) {
        const tally *t = &r->tallies[i];
        printf("%s (%s): %llu verdicts", r->search.solvers[i]->name,
               sl_guarantee_name(r->search.solvers[i]->guarantee), (unsigned long long)t->verdicts);
        if (t->refused) printf(", %llu sequences refused", (unsigned long long)t->refused);
        if (t->changed)
            printf(", %llu sequences changed by a pop and a push", (unsigned long long)t->changed);
        puts("");
        print_errors(r, i);
    }
}

/// The worst errors of rounded solvers, but for what they marked and is near.
static void print_worst(const run *r) {
    for (size_t i = 0; i < r->search.solver_count; i++) {
        if (r->search.solvers[i]->guarantee == SL_EXACT) continue;
        for (int k = 0; k < VERDICTS * VERDICTS; k++) {
            search_fault fault = {i, (sl_stab_verdict)(k / VERDICTS),
                                  (sl_stab_verdict)(k % VERDICTS), 0};
            const error *e = &r->tallies[i].errors[fault.said][fault.is];
            if (!e->worst.count || (fault.said == SL_GRAZING && e->miss < NEAR)) continue;
            fault.miss = e->miss / 2;
            random_portals portals = e->worst;
            search_shrink(&r->search, &fault, &portals);
            print_case(r, i, &fault, &portals);
        }
    }
}

static bool read_number(const char *text, uint64_t *out) {
    char *end;
    *out = strtoull(text, &end, 10);
    return *text >= '0' && *text <= '9' && !*end;
}

static bool read_options(int argc, char **argv, options *out) {
    static const struct option names[] = {
        {"seed", required_argument, NULL, 's'},    {"count", required_argument, NULL, 'c'},
        {"seconds", required_argument, NULL, 't'}, {"quiet", no_argument, NULL, 'q'},
        {"self-test", no_argument, NULL, 'f'},     {NULL, 0, NULL, 0}};
    *out = (options){.seed = 1, .count = 100000};
    for (int c; (c = getopt_long(argc, argv, "", names, NULL)) != -1;) {
        bool good = true;
        switch (c) {
        case 's':
            good = read_number(optarg, &out->seed);
            break;
        case 'c':
            good = read_number(optarg, &out->count);
            break;
        case 't':
            good = read_number(optarg, &out->seconds);
            break;
        case 'q':
            out->quiet = true;
            break;
        case 'f':
            out->self_test = true;
            break;
        default:
            good = false;
        }
        if (!good) return false;
    }
    return optind == argc;
}

static void begin(run *r) {
    signal(SIGALRM, bark);
    r->random.state = r->options.seed;
    r->search.context = sl_context_create(NULL);
    if (!r->search.context) abort();
    for (const sl_solver *solver; (solver = solver_at(r->search.solver_count));)
        r->search.solvers[r->search.solver_count++] = solver;
    if (r->options.self_test) r->search.solvers[r->search.solver_count++] = search_doubles();
}

static void end(run *r) {
    solvers_leave();
    sl_context_destroy(r->search.context);
    free(r);
}

int main(int argc, char **argv) {
    run *r = calloc(1, sizeof *r);
    if (!r) abort();
    if (!read_options(argc, argv, &r->options)) {
        fputs("usage: search_sequences [--seed N] [--count N] [--seconds N] [--quiet] "
              "[--self-test]\n",
              stderr);
        free(r);
        return 2;
    }
    begin(r);
    bool good = search_on(r);
    if (good && !r->options.self_test) {
        print_table(r);
        print_worst(r);
    }
    if (r->options.self_test) {
        // Found out, and nothing else: the others are right on the same sequences.
        const size_t doubles = r->search.solver_count - 1;
        bool found = false;
        for (int k = 0; k < VERDICTS * VERDICTS; k++)
            found = found || r->tallies[doubles].errors[k / VERDICTS][k % VERDICTS].count;
        good = !good && found;
        puts(good ? "Rounding was found out." : "Rounding was not found out.");
    }
    end(r);
    return good ? 0 : 1;
}
