// Set cover, on random problems of known kinds, and GLPK's own branch and bound beside it; one
// thread, processor time.
//   bench_cover [NODES]
//       CSV: machine, kind, rows, columns, entries, program (none: Lagrangian bounds alone), lower
//       bound, cost, seconds, seconds of the check; at last what GLPK finds within NODES nodes of
//       its own (default 0: not asked), and its seconds.
#include "bench.h"

#include "sightline/glpk.h"
#include "sightline/set_cover.h"
#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/utsname.h>

typedef struct problem {
    sl_cover_problem cover;
    size_t *ends;
    SL_ARRAY(uint32_t) entries;
    uint32_t *costs, *demands;
} problem;

typedef struct kind {
    const char *name;
    uint32_t rows, columns;
    double size; ///< radius of what a column covers; or the share of rows
} kind;

/// Points in the unit square; columns are discs about them or wedges of a quarter, as what a camera
/// sees. `random`: each entry by chance, costs of 1 to 100 (Beasley 1987).
static const kind kinds[] = {
    {"discs", 82, 64, 0.2},       {"discs", 500, 1000, 0.1},   {"wedges", 1141, 1276, 0.12},
    {"wedges", 6517, 5876, 0.05}, {"random", 200, 2000, 0.02},
};

static bool covers(const kind *k, sl_random *random, sl_point at, sl_point point, double heading) {
    if (k->name[0] == 'r') return sl_random_unit(random) < k->size;
    const double x = point.x - at.x, y = point.y - at.y;
    if (x * x + y * y > k->size * k->size) return false;
    return k->name[0] == 'd' || (x == 0 && y == 0) ||
           fabs(remainder(atan2(y, x) - heading, 6.283185307179586)) <= 0.7853981633974483;
}

static void make(sl_context *context, const kind *k, problem *p) {
    sl_random random = {1};
    sl_point *points = sl_alloc_array(context, k->rows, sizeof *points);
    p->ends = sl_alloc_array(context, k->columns, sizeof *p->ends);
    p->costs = sl_alloc_array(context, k->columns, sizeof *p->costs);
    p->demands = sl_alloc_array(context, k->rows, sizeof *p->demands);
    if (!points || !p->ends || !p->costs || !p->demands) bench_must(context, SL_NO_MEMORY);
    for (uint32_t r = 0; r < k->rows; r++)
        points[r] = (sl_point){sl_random_unit(&random), sl_random_unit(&random)};
    for (uint32_t j = 0; j < k->columns; j++) {
        // The first columns stand at points.
        const sl_point at =
            j < k->rows ? points[j] : (sl_point){sl_random_unit(&random), sl_random_unit(&random)};
        const double heading = (double)sl_random_below(&random, 8) * 0.7853981633974483;
        bench_must(context, SL_ARRAY_ROOM(context, &p->entries, k->rows));
        for (uint32_t r = 0; r < k->rows; r++) {
            if (!covers(k, &random, at, points[r], heading)) continue;
            p->entries.items[p->entries.count++] = r;
            p->demands[r] = 1; // of a row that no column covers: 0
        }
        p->ends[j] = p->entries.count;
        p->costs[j] = k->name[0] == 'r' ? 1 + (uint32_t)sl_random_below(&random, 100) : 1;
    }
    p->cover =
        (sl_cover_problem){k->rows, k->columns, p->ends, p->entries.items, p->costs, p->demands};
    sl_free(context, points);
}

static void measure(sl_context *context, const kind *k, uint64_t nodes) {
    struct utsname machine;
    uname(&machine);
    problem p = {0};
    make(context, k, &p);
    const sl_cover_program *programs[] = {NULL, sl_cover_glpk()};
    for (int i = 0; i < 2; i++) {
        sl_cover_options options = sl_cover_options_default();
        options.program = programs[i];
        sl_cover_result result = {0};
        uint64_t lower;
        double start = bench_seconds();
        bench_must(context, sl_cover_solve(context, &p.cover, &options, &result));
        const double solved = bench_seconds() - start;
        start = bench_seconds();
        bench_must(context, sl_cover_check(context, &p.cover, &result.proof, &lower));
        const double checked = bench_seconds() - start;
        printf("%s %s,%s,%u,%u,%zu,%s,%llu,%llu,%.4f,%.4f", machine.sysname, machine.machine,
               k->name, k->rows, k->columns, p.entries.count, i ? programs[i]->name : "none",
               (unsigned long long)lower, (unsigned long long)result.cost, solved, checked);
        if (i && nodes) {
            uint32_t count, *columns = sl_alloc_array(context, k->columns, sizeof *columns);
            if (!columns) bench_must(context, SL_NO_MEMORY);
            uint64_t cost = 0;
            start = bench_seconds();
            if (programs[i]->branch(context, &p.cover, nodes, columns, &count) == SL_OK)
                for (uint32_t c = 0; c < count; c++) cost += p.costs[columns[c]];
            printf(",%llu,%.4f", (unsigned long long)cost, bench_seconds() - start);
            sl_free(context, columns);
        }
        putchar('\n');
        fflush(stdout);
        sl_cover_result_destroy(context, &result);
    }
    sl_free(context, p.ends);
    sl_free(context, p.costs);
    sl_free(context, p.demands);
    sl_free(context, p.entries.items);
}

int main(int argc, char **argv) {
    const uint64_t nodes = argc > 1 ? strtoull(argv[1], NULL, 10) : 0;
    sl_context *context = sl_context_create(NULL);
    puts("machine,kind,rows,columns,entries,program,lower,cost,seconds,check,glpk,glpk_seconds");
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) measure(context, &kinds[i], nodes);
    sl_context_destroy(context);
    return 0;
}
