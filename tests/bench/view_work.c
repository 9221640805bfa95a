// What view cells by exact directed sets take, beside what is found: generated maps of growing
// size, of which a cell sees about as much whatever the size, half as many view cells as there are
// walls.
//   bench_view_work [WALLS]     up to so many walls, 64000 unless told
// CSV on stdout: a line a map, and for each kind the exponents of all that, fitted over its maps,
// in what is found: the pairs of view cell and object. Seconds are of this process's processor
// time.
#include "bench.h"

#include "sightline/generate.h"
#include "sightline/sightline.h"
#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAPS_MOST = 12, LEAST_WALLS = 1000 };

/// What is told of a map; the first is what the others are held against.
enum { PAIRS, LOOKS, CANDIDATES, RELATIONS, TESTS, WEIGHED, SECONDS, MEASURES };
static const char *const measures[] = {"pairs", "looks",   "candidates", "relations",
                                       "tests", "weighed", "seconds"};

static const sl_view_method *hybrid(void) {
    size_t count, i = 0;
    const sl_view_method *methods = sl_view_methods(&count);
    while (i + 1 < count && !methods[i].exact) i++;
    return &methods[i];
}

static double count_pairs(const sl_view_sets *sets) {
    double pairs = 0;
    for (size_t i = 0; i < sets->count * sets->words; i++)
        pairs += __builtin_popcountll(sets->bits[i]);
    return pairs;
}

static void measure(sl_context *context, const sl_map_kind *kind, uint64_t walls,
                    double out[MEASURES]) {
    sl_generate_options generate = sl_generate_options_default();
    generate.walls = walls;
    sl_map map = {0};
    sl_space space;
    sl_view_places places;
    sl_view_tree tree;
    sl_view_found found;
    bench_must(context, sl_generate(context, kind, &generate, &map));
    bench_must(context, sl_subdivision_for(&map)->subdivide(context, &map, NULL, &space));
    bench_must(context, sl_view_places_inside(context, &space, &places));
    const sl_view_scene scene = {&space, SL_VIEW_CELLS, sl_render_cost_default(), &places};
    sl_view_subdivision options = sl_view_subdivision_default();
    options.threads = 1;
    options.cells = (uint32_t)(walls / 2);
    options.least_gain = 0;
    options.patience = UINT32_MAX;
    const double start = bench_seconds();
    bench_must(context, hybrid()->divide(context, &scene, NULL, &options, &tree, &found));
    out[SECONDS] = bench_seconds() - start;
    const sl_view_work *w = &found.work;
    const double counts[] = {count_pairs(&found.sets), (double)w->looks, (double)w->candidates,
                             (double)w->relations,     (double)w->tests, (double)w->weighed};
    memcpy(out, counts, sizeof counts);
    printf("%s,%zu,%u,%u,%llu", kind->name, map.wall_count, tree.cell_count, space.inside_count,
           (unsigned long long)w->cuts);
    for (int m = 0; m < MEASURES; m++) printf(m == SECONDS ? ",%.2f\n" : ",%.0f", out[m]);
    fflush(stdout);
    sl_view_sets_destroy(context, &found.sets);
    sl_view_tree_destroy(context, &tree);
    sl_view_places_destroy(context, &places);
    sl_space_destroy(context, &space);
    sl_map_destroy(context, &map);
}

/// The slope of logarithms, by least squares.
static double fit(double of[][MEASURES], size_t count, int measure) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < count; i++) {
        const double a = log(of[i][PAIRS]), b = log(of[i][measure]);
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    const double n = (double)count;
    return (n * xy - x * y) / (n * xx - x * x);
}

int main(int argc, char **argv) {
    const uint64_t most = argc > 1 ? strtoull(argv[1], NULL, 10) : 64000;
    sl_context *context = sl_context_create(NULL);
    if (!context) return 1;
    size_t kinds;
    const sl_map_kind *kind = sl_map_kinds(&kinds);
    printf("kind,walls,view_cells,rooms,cuts");
    for (int m = 0; m < MEASURES; m++) printf(",%s", measures[m]);
    putchar('\n');
    for (size_t k = 0; k < kinds; k++) {
        double of[MAPS_MOST][MEASURES];
        size_t count = 0;
        for (uint64_t walls = LEAST_WALLS; walls <= most && count < MAPS_MOST; walls *= 2)
            measure(context, &kind[k], walls, of[count++]);
        if (count < 2) continue;
        printf("%s,exponents,,,", kind[k].name);
        for (int m = 0; m < MEASURES; m++) printf(",%.3f", fit(of, count, m));
        putchar('\n');
    }
    sl_context_destroy(context);
    return 0;
}
