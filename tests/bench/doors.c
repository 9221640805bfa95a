// What doors cost at run time: a plan of 24 rooms with 30 doors, which open and shut at random.
//   bench_doors
// CSV: machine, sets of doors kept of a pair at most, what was measured, its value, and times the
// value of the line that it is held against (the one before, where the last column names none).
#include "bench.h"
#include "cell_to_cell/pvs_rows.h"
#include "effects/filtered.h"

#include "baked_bytes.h"
#include "sightline/sightline.h"
#include "sightline/support.h"
#include "space/subdivide.h"

#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "doors_plan.h"
#include "runtime/sightline_runtime.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

enum { ASKED = 1 << 14, LOOKS = 1 << 9, ROUNDS = 15 };

typedef struct bench {
    sl_context *context;
    sl_baked baked;
    char *bytes;
    size_t size;
    sl_runtime runtime;
    uint32_t limit;
    uint32_t from[ASKED], to[ASKED];
    double x[ASKED], y[ASKED];
    unsigned char shut[DOORS];
    bool shut_flags[DOORS];
    uint32_t *scratch, *cells;
    const char *machine;
} bench;

// --- the bake

static void see(const bench *b, const sl_space *space, const sl_plan *plan, sl_visibility *out) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    sl_see_options options = sl_see_options_default();
    options.solver = sl_funnel();
    options.threads = 1;
    options.plan = plan;
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, plan ? "prune" : "sweep") == 0)
            bench_must(b->context, methods[i].see(b->context, space, &options, out));
}

static void bake(bench *b) {
    const sl_subdivide_options rules = sl_subdivide_options_default();
    b->baked = (sl_baked){.method = "prune", .solver = "funnel"};
    bench_must(b->context, doors_plan(b->context, &b->baked.map));
    bench_must(b->context, sl_map_clean(b->context, &b->baked.map, NULL, NULL));
    bench_must(b->context, sli_subdivide_kd(b->context, &b->baked.map, &rules, &b->baked.space));
    sl_plan plan = sl_plan_make(&b->baked.map);
    plan.door_limit = b->limit;
    see(b, &b->baked.space, &plan, &b->baked.visibility);
    b->bytes = baked_bytes(b->context, &b->baked, &b->size);
    if (sl_runtime_open(b->bytes, b->size, &b->runtime) != SL_RUNTIME_OK) exit(1);
    b->scratch = calloc(sl_runtime_scratch_count(&b->runtime), sizeof *b->scratch);
    b->cells = calloc(b->runtime.cell_count, sizeof *b->cells);
    if (!b->scratch || !b->cells) exit(1);
}

// --- what is measured: each asks for element i of the lists and gives something to add up

static uint64_t change_door(bench *b, size_t i) {
    return b->shut[i % DOORS] ^= 1;
}

static uint64_t ask_runtime_open(bench *b, size_t i) {
    return sl_runtime_can_see(&b->runtime, b->from[i], b->to[i]);
}

static uint64_t ask_runtime(bench *b, size_t i) {
    return sl_runtime_can_see_past(&b->runtime, b->from[i], b->to[i], b->shut);
}

static uint64_t ask_library_open(bench *b, size_t i) {
    return sl_pvs_sees(&b->baked.visibility.pvs, b->from[i], b->to[i]);
}

static uint64_t ask_library(bench *b, size_t i) {
    const sl_visibility *v = &b->baked.visibility;
    return sl_pvs_sees(&v->pvs, b->from[i], b->to[i]) &&
           sli_door_sets_open(&v->doors, b->from[i], b->to[i], b->shut_flags);
}

static uint64_t look_open(bench *b, size_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
    return sl_runtime_look(&b->runtime, &view, b->scratch, b->cells, b->runtime.cell_count);
}

static uint64_t look_past(bench *b, size_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
    return sl_runtime_look_past(&b->runtime, &view, b->shut, 0, b->scratch, b->cells,
                                b->runtime.cell_count);
}

static uint64_t look_in_range(bench *b, size_t i) {
    const sl_runtime_view view = sl_runtime_view_all_round(b->x[i], b->y[i]);
    return sl_runtime_look_past(&b->runtime, &view, b->shut, 15, b->scratch, b->cells,
                                b->runtime.cell_count);
}

/// What an eye of the library needs of a change: the space with walls in the doors.
static uint64_t make_filtered(bench *b, size_t i) {
    const sli_filtered_space filtered = {.shut = b->shut_flags};
    sl_space walled;
    (void)i;
    bench_must(b->context,
               sli_filtered_space_make(b->context, &b->baked.space, &filtered, NULL, &walled));
    const uint64_t portals = walled.portal_count;
    sl_space_destroy(b->context, &walled);
    return portals;
}

/// What a change costs who has no sets of doors.
static uint64_t bake_afresh(bench *b, size_t i) {
    const sli_filtered_space filtered = {.shut = b->shut_flags};
    sl_space walled;
    sl_visibility seen = {0};
    (void)i;
    bench_must(b->context,
               sli_filtered_space_make(b->context, &b->baked.space, &filtered, NULL, &walled));
    see(b, &walled, NULL, &seen);
    const uint64_t pairs = seen.account.pairs;
    sl_visibility_destroy(b->context, &seen);
    sl_space_destroy(b->context, &walled);
    return pairs;
}

static const struct {
    const char *what;
    uint64_t (*ask)(bench *b, size_t i);
    size_t count;
    size_t against; ///< an earlier line
} questions[] = {
    {"runtime: a pair, doors not asked, ns", ask_runtime_open, ASKED, 0},
    {"runtime: a pair past doors, ns", ask_runtime, ASKED, 0},
    {"library: a pair, doors not asked, ns", ask_library_open, ASKED, 2},
    {"library: a pair past doors, ns", ask_library, ASKED, 2},
    {"runtime: an eye all round, doors not asked, ns", look_open, LOOKS, 4},
    {"runtime: an eye past doors, ns", look_past, LOOKS, 4},
    {"runtime: an eye past doors within 15, ns", look_in_range, LOOKS, 4},
    {"a fresh bake by the sweep, ns", bake_afresh, 4, 7},
    {"a door changes, the library's eye: space with walls, ns", make_filtered, 64, 7},
    {"a door changes, sets and runtime: a byte, ns", change_door, ASKED, 7},
};

enum { QUESTIONS = sizeof questions / sizeof *questions };

static double time_question(bench *b, size_t q, uint64_t *sum) {
    double least = INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        const double start = bench_seconds();
        for (size_t i = 0; i < questions[q].count; i++) *sum += questions[q].ask(b, i);
        least = fmin(least, bench_seconds() - start);
    }
    return least / (double)questions[q].count * 1e9;
}

// --- the report

static void report(bench *b) {
    const sl_visibility *v = &b->baked.visibility;
    uint64_t depend = 0, sets = 0, sum = 0;
    for (uint32_t cell = 0; cell < v->pvs.cell_count; cell++)
        for (sl_door_pairs p = sl_door_pairs_begin(&v->doors, cell);
             sl_door_pairs_next(&p, b->shut_flags);) {
            depend++;
            sets += p.alternatives;
        }
    const double pairs = (double)v->account.pairs, bytes = (double)sl_door_sets_bytes(&v->doors);
    const struct {
        const char *what;
        double value;
    } counts[] = {
        {"cells", v->pvs.cell_count},
        {"pairs", pairs},
        {"pairs that depend on doors", (double)depend},
        {"sets of doors of such a pair", depend ? (double)sets / (double)depend : 0},
        {"bytes of door sets a pair", bytes / pairs},
        {"bytes of visible sets a pair", (double)v->pvs.offsets[v->pvs.cell_count] / pairs},
        {"pairs with more sets than are kept", (double)v->account.effects.door_fallbacks}};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        printf("%s,%u,%s,%.6g,\n", b->machine, (unsigned)b->limit, counts[i].what, counts[i].value);
    double times[QUESTIONS];
    for (size_t q = 0; q < QUESTIONS; q++) {
        times[q] = time_question(b, q, &sum);
        printf("%s,%u,\"%s\",%.4g,%.4g\n", b->machine, (unsigned)b->limit, questions[q].what,
               times[q], times[q] / times[questions[q].against]);
    }
    if (sum == 0) printf("nothing was seen\n");
}

static void draw_lists(bench *b) {
    sl_random random = {30};
    for (size_t i = 0; i < ASKED; i++) {
        b->from[i] = (uint32_t)sl_random_below(&random, b->runtime.cell_count);
        b->to[i] = (uint32_t)sl_random_below(&random, b->runtime.cell_count);
        b->x[i] = sl_random_unit(&random) * DOORS_COLUMNS * DOORS_ROOM;
        b->y[i] = sl_random_unit(&random) * DOORS_ROWS * DOORS_ROOM;
    }
    for (int i = 0; i < DOORS; i++)
        b->shut[i] = b->shut_flags[i] = sl_random_below(&random, 3) == 0;
}

int main(void) {
    static bench b;
    struct utsname machine;
    static const uint32_t limits[] = {1, 2, 16};
    b.machine = uname(&machine) == 0 ? machine.nodename : "?";
    b.context = sl_context_create(NULL);
    if (!b.context) return 1;
    puts("machine,sets_kept,what,value,times");
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        b.limit = limits[i];
        bake(&b);
        draw_lists(&b);
        report(&b);
        free(b.scratch);
        free(b.cells);
        free(b.bytes);
        sl_baked_destroy(b.context, &b.baked);
    }
    sl_context_destroy(b.context);
    return 0;
}
