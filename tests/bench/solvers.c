// What a stabbing test costs with each solver: the pushes and pops of the depth-first search on a
// map are recorded once and played to every solver in turn, round after round, in one run.
//   bench_solvers MAP [Z]     CSV: machine, map, solver, tests, nanoseconds a test, times the
//   first's, and the same two without what playing alone takes
#include "bench.h"

#include "sightline/glpk.h"
#include "sightline/io.h"
#include "sightline/sightline.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/utsname.h>
#include <time.h>

/// A push with its portal, or (pop) the last one taken back.
typedef struct event {
    sl_portal_ends portal;
    bool pop;
} event;

typedef struct tape {
    event *events;
    size_t count, room;
} tape;

static void record(tape *t, event e) {
    if (t->count == t->room) {
        t->room = t->room ? 2 * t->room : 4096;
        t->events = realloc(t->events, t->room * sizeof *t->events);
        if (!t->events) bench_fail("out of memory");
    }
    t->events[t->count++] = e;
}

/// The search of the tool, cut down to what a tape needs: closed sight, every sequence with a line.
static void search(sl_context *context, const sl_space *space, uint32_t cell, const void *solver,
                   unsigned crossed, tape *t) {
    const sl_cell *c = &space->cells[cell];
    for (uint32_t i = 0; i < c->directed_count; i++) {
        const sl_directed_portal *directed = &space->directed[c->first_directed + i];
        const bool vertical = directed->left.x == directed->right.x;
        const bool up =
            vertical ? directed->left.y > directed->right.y : directed->left.x < directed->right.x;
        const unsigned bit = (vertical ? 1u : 4u) << !up, against = (vertical ? 1u : 4u) << up;
        if (crossed & against) continue;
        sl_stab_verdict verdict;
        if (sl_funnel()->push(context, (void *)(uintptr_t)solver, directed->left, directed->right,
                              &verdict) != SL_OK)
            bench_fail(sl_context_message(context));
        record(t, (event){{directed->left, directed->right}, false});
        if (verdict != SL_HIDDEN) search(context, space, directed->cell, solver, crossed | bit, t);
        sl_funnel()->pop((void *)(uintptr_t)solver);
        record(t, (event){.pop = true});
    }
}

static tape record_map(sl_context *context, const sl_space *space) {
    tape t = {0};
    void *state = NULL;
    if (sl_funnel()->create(context, space->bounds, &state) != SL_OK) bench_fail("out of memory");
    for (uint32_t cell = 0; cell < space->cell_count; cell++)
        search(context, space, cell, state, 0, &t);
    sl_funnel()->destroy(context, state);
    return t;
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static sl_status push_nothing(sl_context *context, void *state, sl_point left, sl_point right,
                              sl_stab_verdict *verdict) {
    (void)context, (void)state;
    // Takes the portal, as a solver must.
    *verdict = left.x == right.x && left.y == right.y ? SL_HIDDEN : SL_STABBED;
    return SL_OK;
}

static void pop_nothing(void *state) {
    (void)state;
}

static sl_status create_nothing(sl_context *context, sl_box bounds, void **state) {
    (void)context, (void)bounds;
    *state = NULL;
    return SL_OK;
}

static void destroy_nothing(sl_context *context, void *state) {
    (void)context, (void)state;
}

/// What playing the tape takes by itself.
static const sl_solver nothing = {.name = "nothing",
                                  .create = create_nothing,
                                  .destroy = destroy_nothing,
                                  .push = push_nothing,
                                  .pop = pop_nothing};

/// Seconds that a solver takes for the tape; 0 where it refuses a portal.
static double play(sl_context *context, const sl_solver *solver, sl_box bounds, const tape *t) {
    void *state = NULL;
    if (solver->create(context, bounds, &state) != SL_OK) return 0;
    const double start = now();
    sl_status status = SL_OK;
    for (size_t i = 0; i < t->count && status == SL_OK; i++) {
        const event *e = &t->events[i];
        sl_stab_verdict verdict;
        if (e->pop)
            solver->pop(state);
        else
            status = solver->push(context, state, e->portal.left, e->portal.right, &verdict);
    }
    const double seconds = now() - start;
    solver->destroy(context, state);
    return status == SL_OK ? seconds : 0;
}

enum { ROUNDS = 5, SOLVERS = 5, NOTHING = SOLVERS - 1 };

int main(int argc, char **argv) {
    if (argc < 2) bench_fail("usage: bench_solvers MAP [Z]");
    sl_context *context = sl_context_create(NULL);
    sl_space space = {0};
    if (!context) bench_fail("out of memory");
    bench_read_space(context, argv[1], argc > 2 ? argv[2] : NULL, &space);
    tape t = record_map(context, &space);
    const sl_solver *solvers[SOLVERS] = {sl_funnel(), sl_glpk_simplex(), sl_glpk_hybrid(),
                                         sl_glpk_exact(), &nothing};
    // The least of all rounds: what the others have more is the machine's doing.
    double least[SOLVERS] = {0};
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < SOLVERS; i++) {
            // Each finds the tape as warm as the others do.
            play(context, &nothing, space.bounds, &t);
            const double seconds = play(context, solvers[i], space.bounds, &t);
            if (round == 0 || seconds < least[i]) least[i] = seconds;
        }
    struct utsname machine;
    uname(&machine);
    puts("machine,map,solver,tests,nanoseconds_a_test,times_the_first,nanoseconds_of_its_own,"
         "times_the_first_of_its_own");
    const double test = 1e-9 * (double)t.count / 2;
    for (int i = 0; i < SOLVERS; i++)
        printf("%s %s,%s,%s,%zu,%.1f,%.1f,%.1f,%.1f\n", machine.sysname, machine.machine, argv[1],
               solvers[i]->name, t.count / 2, least[i] / test, least[i] / least[0],
               (least[i] - least[NOTHING]) / test,
               (least[i] - least[NOTHING]) / (least[0] - least[NOTHING]));
    free(t.events);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
    return 0;
}
