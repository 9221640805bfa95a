// What the whole cell-to-cell stage costs by each method with each solver, on one thread, in one
// run.
//   bench_methods MAP [Z]           a map file, and the height of its slice
//   bench_methods FILE.wad LEVEL[:given] [METHOD [SOLVER]]    a level of a WAD; given: cut into the
//                                   cells of its node builder; by one method, with one solver alone
// CSV: machine, map, cells, sight, method, solver, pairs, seconds of the processor, times those of
// the sweep. What takes longer than a minute has no figures.
#include "bench.h"

#include "sightline/glpk.h"
#include "sightline/sightline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

enum { ROUNDS = 5, LIMIT_SECONDS = 60 };

typedef struct clock_hook {
    double deadline;
} clock_hook;

static bool too_late(void *user) {
    const clock_hook *hook = user;
    return bench_seconds() > hook->deadline;
}

typedef struct bench {
    sl_context *context;
    clock_hook *clock;
    const char *map;
    sl_space space;
    char machine[128];
    double of_sweep; ///< seconds, of the sight at hand
} bench;

/// The least of some rounds: what the others have more is the machine's doing. 0 where the time ran
/// out.
static double least_of_rounds(bench *b, const sl_see_method *method, const sl_see_options *options,
                              uint64_t *pairs) {
    double least = 0;
    for (int round = 0; round < ROUNDS; round++) {
        sl_visibility seen;
        const double start = bench_seconds();
        b->clock->deadline = start + LIMIT_SECONDS;
        if (method->see(b->context, &b->space, options, &seen) != SL_OK) return 0;
        const double seconds = bench_seconds() - start;
        *pairs = seen.account.pairs;
        sl_visibility_destroy(b->context, &seen);
        if (round == 0 || seconds < least) least = seconds;
        if (seconds > 1) break;
    }
    return least;
}

static void run(bench *b, const sl_see_method *method, const sl_solver *solver, sl_sight sight) {
    sl_see_options options = sl_see_options_default();
    options.sight = sight;
    options.solver = solver;
    options.threads = 1;
    uint64_t pairs = 0;
    const double seconds = least_of_rounds(b, method, &options, &pairs);
    if (strcmp(method->name, "sweep") == 0) b->of_sweep = seconds;
    printf("%s,%s,%u,%s,%s,%s,", b->machine, b->map, b->space.cell_count,
           sight == SL_CLOSED ? "closed" : "open", method->name, solver ? solver->name : "");
    fflush(stdout);
    if (seconds > 0)
        printf("%llu,%.6f,%.2f\n", (unsigned long long)pairs, seconds, seconds / b->of_sweep);
    else
        puts(",,");
}

static const sl_see_method *method_of(const char *name) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    bench_fail("a method is missing");
}

int main(int argc, char **argv) {
    static const sl_solver *(*const solvers[])(void) = {sl_funnel, sl_glpk_simplex, sl_glpk_hybrid,
                                                        sl_glpk_exact};
    if (argc < 2) bench_fail("usage: bench_methods MAP [Z], or FILE.wad LEVEL");
    clock_hook hook = {.deadline = 1e300};
    const sl_hooks hooks = {.user = &hook, .cancelled = too_late};
    bench b = {.context = sl_context_create(&hooks), .clock = &hook, .map = argv[1]};
    if (!b.context) bench_fail("out of memory");
    bench_read_space(b.context, argv[1], argc > 2 ? argv[2] : NULL, &b.space);
    struct utsname machine;
    uname(&machine);
    snprintf(b.machine, sizeof b.machine, "%.40s %.40s", machine.sysname, machine.machine);
    const char *only = argc > 3 ? argv[3] : NULL, *with_only = argc > 4 ? argv[4] : NULL;
    puts("machine,map,cells,sight,method,solver,pairs,seconds,times_the_sweep");
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (int sight = SL_CLOSED; sight <= SL_OPEN; sight++) {
        run(&b, method_of("sweep"), NULL, (sl_sight)sight);
        for (size_t m = 0; m < count; m++) {
            if (strcmp(methods[m].name, only ? only : methods[m].name) != 0) continue;
            if (strcmp(methods[m].name, "sweep") == 0) continue;
            const size_t with = methods[m].stabs ? sizeof solvers / sizeof *solvers : 1;
            for (size_t i = 0; i < with; i++) {
                const sl_solver *solver = methods[m].stabs ? solvers[i]() : NULL;
                if (solver && with_only && strcmp(solver->name, with_only) != 0) continue;
                run(&b, &methods[m], solver, (sl_sight)sight);
            }
        }
    }
    sl_space_destroy(b.context, &b.space);
    sl_context_destroy(b.context);
    return 0;
}
