// What visibility graph analysis costs, part by part, on one thread and in processor time.
//   bench_vga MAP STEP [SECONDS [PART [RANGE]]]
//       CSV: machine, map, points, edges, part, seconds, microseconds a point, how often that goes
//       into SECONDS: the time that another program takes for the part (0: none), and the largest
//       size of the process so far in MiB.
//       PART: this part alone ("graph": no measure). RANGE: nothing farther is seen.
#include "bench.h"
#include "space/outline.h"

#include "sightline/sightline.h"
#include "sightline/support.h"
#include "sightline/vga.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/utsname.h>

typedef struct table {
    const char *map;
    struct utsname machine;
    uint32_t points;
    uint64_t edges;
    double other;     ///< seconds; 0 where none are given
    const char *only; ///< the part to measure; NULL: all
    double range;
} table;

static void print_row(const table *t, const char *part, double seconds) {
    printf("%s %s,%s,%u,%llu,%s,%.4f,%.2f,", t->machine.sysname, t->machine.machine, t->map,
           t->points, (unsigned long long)t->edges, part, seconds,
           t->points ? 1e6 * seconds / t->points : 0);
    if (t->other > 0) printf("%.1f", t->other / seconds);
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    printf(",%.1f\n", (double)used.ru_maxrss / 1024);
    fflush(stdout);
}

static void measure(sl_context *context, const sl_space *space, double step, table *t) {
    static const struct {
        const char *name;
        unsigned parts;
    } parts[] = {{"depths", SL_VGA_GLOBAL},
                 {"local", SL_VGA_LOCAL},
                 {"through", SL_VGA_THROUGH},
                 {"metric", SL_VGA_METRIC},
                 {"angular", SL_VGA_ANGULAR}};
    sl_outline outline = {0};
    sl_vga_grid grid = {0};
    sl_vga_graph graph = {0};
    bench_must(context, sli_outline_make(context, space, &outline));
    double start = bench_seconds();
    bench_must(context, sl_vga_grid_make(context, &outline, step, NULL, 0, &grid));
    bench_must(context, sl_vga_graph_make(context, &outline, &grid, t->range, 1, &graph));
    const double made = bench_seconds() - start;
    t->points = grid.count;
    t->edges = graph.edges;
    puts("machine,map,points,edges,part,seconds,us_a_point,ratio,mib");
    print_row(t, "graph", made);
    sl_vga_measures *measures = sl_alloc_array(context, grid.count + 1, sizeof *measures);
    if (!measures) bench_must(context, SL_NO_MEMORY);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (t->only && strcmp(t->only, parts[i].name) != 0) continue;
        sl_vga_options options = sl_vga_options_default();
        options.parts = parts[i].parts;
        options.threads = 1;
        start = bench_seconds();
        bench_must(context, sl_vga_measure(context, &outline, &grid, &graph, &options, measures));
        print_row(t, parts[i].name, bench_seconds() - start);
    }
    sl_free(context, measures);
    sl_vga_graph_destroy(context, &graph);
    sl_vga_grid_destroy(context, &grid);
    sli_outline_destroy(context, &outline);
}

int main(int argc, char **argv) {
    const double step = argc > 2 ? strtod(argv[2], NULL) : 0;
    if (!(step > 0)) {
        fputs("usage: bench_vga MAP STEP [SECONDS [PART [RANGE]]]\n", stderr);
        return 2;
    }
    sl_space space = {0};
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    bench_read_space(context, argv[1], NULL, &space);
    table t = {.map = argv[1],
               .other = argc > 3 ? strtod(argv[3], NULL) : 0,
               .only = argc > 4 ? argv[4] : NULL,
               .range = argc > 5 ? strtod(argv[5], NULL) : 0};
    uname(&t.machine);
    measure(context, &space, step, &t);
    sl_space_destroy(context, &space);
    sl_context_destroy(context);
    return 0;
}
