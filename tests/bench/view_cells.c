// The figures of Mattausch et al. 2006, in 2D: view cells by every method, told by samples that had
// no part in making them.
//   bench_view_cells FIGURE MAP [option=value ...]
// FIGURE   curves     expected cost against the number of view cells, every method (figure 7)
//          samples    the same for ever more samples: as they tell it themselves, and as others do
//                     (figure 6)
//          histogram  how much of view space costs how much, av-m and kd-vt (figure 9)
//          walls      walls' own lines as splits beside axis-aligned ones alone (figure 11)
//          times      seconds and memory, axis-aligned splits, walls' lines too, merging (table 1)
// options  slice=Z map=NAME start=X,Y turn=DEGREES, how the map is read
//          objects=cells, what is seen: the space's cells instead of walls
//          samples=N evaluate=N cells=N, lines to make by, lines to tell costs by, cells at most
//          chart=FILE.png, drawn beside the table
// CSV on stdout. Seconds are of this process's processor time.
#include "bench.h"
#include "space/outline.h"

#include "sightline/draw.h"
#include "sightline/io.h"
#include "sightline/sightline.h"
#include "sightline/support.h"
#include "sightline/view_cells.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/utsname.h>

enum { POINTS_MOST = 64, SERIES_MOST = 7, WALL_SPLITS = 150, BINS = 30 };

typedef struct bench {
    sl_context *context;
    const char *path, *name, *chart; ///< `name`: the path's last part
    double turn;
    uint64_t samples, evaluate;
    uint32_t cells;
    sl_view_objects objects;
    char machine[128];
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_view_places places;
    sl_view_scene scene;
    sl_view_segments segments, others;
    // The chart.
    sl_chart_series series[SERIES_MOST];
    sl_chart_mark marks[SERIES_MOST][POINTS_MOST];
    char names[SERIES_MOST][64];
    size_t series_count;
    unsigned line_count;
} bench;

static const sl_view_method *method_named(const char *name) {
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    bench_fail(name);
}

// --- the map

static sl_point turned(sl_point p, double degrees) {
    const double angle = degrees * 0.017453292519943295, c = cos(angle), s = sin(angle);
    return (sl_point){c * p.x - s * p.y, s * p.x + c * p.y};
}

static void turn_map(bench *b) {
    for (size_t i = 0; i < b->map.wall_count; i++) {
        b->map.walls[i].a = turned(b->map.walls[i].a, b->turn);
        b->map.walls[i].b = turned(b->map.walls[i].b, b->turn);
    }
    for (size_t i = 0; i < b->map.start_count; i++)
        b->map.starts[i].at = turned(b->map.starts[i].at, b->turn);
}

static void read_map(bench *b, const sl_import_options *options, const sl_point *start) {
    bench_must(b->context, sl_io_use(b->context));
    bench_must(b->context, sl_map_read(b->context, b->path, options, &b->map));
    if (start) bench_must(b->context, sl_map_add_start(b->context, &b->map, *start, 0, 0));
    bench_must(b->context, sl_map_clean(b->context, &b->map, NULL, NULL));
    if (b->turn != 0) turn_map(b);
    bench_must(b->context,
               sl_subdivision_for(&b->map)->subdivide(b->context, &b->map, NULL, &b->space));
    bench_must(b->context, sli_outline_make(b->context, &b->space, &b->outline));
    bench_must(b->context, sl_view_places_inside(b->context, &b->space, &b->places));
    b->scene = (sl_view_scene){&b->space, b->objects, sl_render_cost_default(), &b->places};
}

static void sample(bench *b, uint64_t samples, uint64_t seed, sl_view_segments *out) {
    sl_view_sampling sampling = sl_view_sampling_default();
    sampling.objects = b->objects;
    sampling.samples = samples;
    sampling.seed = seed;
    bench_must(b->context, sl_view_sample(b->context, &b->outline, &sampling, out));
}

// --- making and telling

typedef struct made {
    sl_view_tree tree;
    sl_view_hierarchy told, others; ///< by the samples that made it, by others
    double *told_costs, *costs;     ///< by number of cells less 1
    double divide, merge;           ///< seconds
} made;

static sl_view_subdivision options_of(const bench *b) {
    sl_view_subdivision options = sl_view_subdivision_default();
    options.cells = b->cells;
    options.least_gain = 0;
    options.patience = UINT32_MAX;
    // So deep that KD-VT* ends before it has used up its cells.
    options.deepest = (uint32_t)floor(log2(b->cells));
    return options;
}

/// Exact methods go by what they have found themselves.
static void join(bench *b, const sl_view_method *method, const sl_view_segments *by,
                 const sl_view_found *found, made *m) {
    sl_view_sets sets = found->sets;
    if (!method->exact)
        bench_must(b->context, sl_view_sets_sample(b->context, &b->scene, &m->tree, by, 0, &sets));
    const double start = bench_seconds();
    bench_must(b->context, sl_view_hierarchy_make(b->context, &b->scene, &m->tree, &sets,
                                                  method->merges, &m->told));
    m->merge = bench_seconds() - start;
    sl_view_sets_destroy(b->context, &sets);
}

static void tell(bench *b, made *m) {
    sl_view_sets sets;
    bench_must(b->context,
               sl_view_sets_sample(b->context, &b->scene, &m->tree, &b->others, 0, &sets));
    bench_must(b->context,
               sl_view_evaluate(b->context, &b->scene, &m->tree, &m->told, &sets, &m->others));
    sl_view_sets_destroy(b->context, &sets);
    m->told_costs = calloc(m->told.cell_count, sizeof *m->told_costs);
    m->costs = calloc(m->told.cell_count, sizeof *m->costs);
    if (!m->told_costs || !m->costs) bench_fail("out of memory");
    sl_view_curve(&m->told, m->told_costs, NULL);
    sl_view_curve(&m->others, m->costs, NULL);
}

static void make(bench *b, const sl_view_method *method, const sl_view_segments *by,
                 const sl_view_subdivision *options, made *m) {
    *m = (made){0};
    sl_view_found found = {0};
    const double start = bench_seconds();
    bench_must(b->context, method->divide(b->context, &b->scene, by, options, &m->tree, &found));
    m->divide = bench_seconds() - start;
    join(b, method, by, &found, m);
    tell(b, m);
}

static void drop(bench *b, made *m) {
    sl_view_tree_destroy(b->context, &m->tree);
    sl_view_hierarchy_destroy(b->context, &m->told);
    sl_view_hierarchy_destroy(b->context, &m->others);
    free(m->told_costs);
    free(m->costs);
}

/// Numbers of cells at about equal steps of their logarithm: 1, 2, 3, 4, 5, 7, 10, 13 ...
static uint32_t next_count(uint32_t count, uint32_t most) {
    const uint32_t next = (uint32_t)ceil(count * 1.33);
    if (count == most) return most + 1;
    return next > count ? (next < most ? next : most) : count + 1;
}

static void begin_series(bench *b, const char *name, sl_chart_style style) {
    if (b->series_count == SERIES_MOST) bench_fail("too many series");
    snprintf(b->names[b->series_count], sizeof b->names[0], "%s", name);
    sl_chart_series *s = &b->series[b->series_count];
    *s = (sl_chart_series){.name = b->names[b->series_count],
                           .style = style,
                           .colour = style == SL_CHART_LINE ? b->line_count++ : 0,
                           .marks = b->marks[b->series_count]};
    b->series_count++;
}

static void add_mark(bench *b, double x, double y) {
    sl_chart_series *s = &b->series[b->series_count - 1];
    if (s->mark_count < POINTS_MOST)
        b->marks[b->series_count - 1][s->mark_count++] = (sl_chart_mark){.x = x, .y = y};
}

static void draw(bench *b, const char *title, sl_chart_axis x, sl_chart_axis y) {
    if (!b->chart) return;
    const sl_chart chart = {.title = title,
                            .subtitle = b->name,
                            .x = x,
                            .y = y,
                            .series = b->series,
                            .series_count = b->series_count,
                            .width = 1000};
    bench_must(b->context, sl_draw_chart_file(b->context, &chart, b->chart));
}

// --- the figures

static const char *what_is_seen(const bench *b) {
    return b->objects == SL_VIEW_WALLS ? "walls in the visible set, expected"
                                       : "cells in the visible set, expected";
}

static void curves(bench *b) {
    size_t count;
    const sl_view_method *methods = sl_view_methods(&count);
    const sl_view_subdivision options = options_of(b);
    made best = {0};
    puts("machine,map,method,view_cells,cost_by_own_samples,cost,ratio_to_av_m");
    for (size_t i = 0; i < count; i++) {
        made m;
        make(b, &methods[i], &b->segments, &options, &m);
        if (i == 0) best = m;
        // Depth first there is nothing to tell before the end.
        const bool ends = strcmp(methods[i].name, "kd-vt-df") == 0;
        // A chart has no colour left for it, and it runs along kd-lasm.
        const bool drawn = strcmp(methods[i].name, "kd-casm") != 0;
        if (drawn) begin_series(b, methods[i].name, ends ? SL_CHART_MARKS : SL_CHART_LINE);
        for (uint32_t n = 10; n <= m.told.cell_count; n = next_count(n, m.told.cell_count)) {
            printf("%s,%s,%s,%u,%.6g,%.6g,", b->machine, b->name, methods[i].name, n,
                   m.told_costs[n - 1], m.costs[n - 1]);
            const double ratio = n <= best.told.cell_count ? m.costs[n - 1] / best.costs[n - 1] : 0;
            if (ratio > 0)
                printf("%.4f\n", ratio);
            else
                putchar('\n');
            if (drawn && (!ends || n == m.told.cell_count)) add_mark(b, n, m.costs[n - 1]);
        }
        if (i) drop(b, &m);
    }
    drop(b, &best);
    draw(b, "Expected render cost by number of view cells",
         (sl_chart_axis){.label = "view cells", .scale = SL_CHART_LOG},
         (sl_chart_axis){.label = what_is_seen(b), .scale = SL_CHART_LOG});
}

static void samples(bench *b) {
    static const uint64_t counts[] = {50000, 200000, 1000000};
    const sl_view_subdivision options = options_of(b);
    puts("machine,map,samples,view_cells,cost_by_own_samples,cost");
    for (size_t i = 0; i < 3; i++) {
        sl_view_segments by = {0};
        made m;
        sample(b, counts[i], 11 + i, &by);
        make(b, method_named("av-m"), &by, &options, &m);
        for (int told = 0; told < 2; told++) {
            char name[64];
            snprintf(name, sizeof name, "%llu samples, %s", (unsigned long long)counts[i],
                     told ? "as they tell it" : "evaluated");
            begin_series(b, name, SL_CHART_LINE);
            for (uint32_t n = 10; n <= m.told.cell_count; n = next_count(n, m.told.cell_count)) {
                add_mark(b, n, told ? m.told_costs[n - 1] : m.costs[n - 1]);
                if (!told)
                    printf("%s,%s,%llu,%u,%.6g,%.6g\n", b->machine, b->name,
                           (unsigned long long)counts[i], n, m.told_costs[n - 1], m.costs[n - 1]);
            }
        }
        drop(b, &m);
        sl_view_segments_destroy(b->context, &by);
    }
    draw(b, "Cost as the samples tell it that made the cells, and as others do",
         (sl_chart_axis){.label = "view cells", .scale = SL_CHART_LOG},
         (sl_chart_axis){.label = what_is_seen(b), .scale = SL_CHART_LOG});
}

static void histogram(bench *b) {
    static const char *const names[] = {"av-m", "kd-vt"};
    sl_view_subdivision options = options_of(b);
    const uint32_t wanted = b->cells;
    options.cells = 4 * wanted;
    puts("machine,map,method,view_cells,cost_from,cost_to,share_of_view_space");
    double top = 0;
    for (int i = 0; i < 2; i++) {
        made m;
        make(b, method_named(names[i]), &b->segments, &options, &m);
        const uint32_t cells = wanted < m.others.cell_count ? wanted : m.others.cell_count;
        uint32_t *of = calloc(m.others.cell_count, sizeof *of), *numbers = calloc(cells, 4);
        if (!of || !numbers) bench_fail("out of memory");
        bench_must(b->context, sl_view_cut(b->context, &m.others, cells, of, numbers));
        double bins[BINS] = {0}, most = 0;
        for (uint32_t v = 0; v < cells; v++) most = fmax(most, m.others.cost[numbers[v]]);
        if (i == 0) top = 1.5 * most / BINS;
        for (uint32_t v = 0; v < cells; v++) {
            const double bin = m.others.cost[numbers[v]] / top;
            bins[bin < BINS ? (int)bin : BINS - 1] += m.others.mass[numbers[v]];
        }
        begin_series(b, names[i], SL_CHART_LINE);
        for (int k = 0; k < BINS; k++) {
            printf("%s,%s,%s,%u,%.4g,%.4g,%.6g\n", b->machine, b->name, names[i], cells, k * top,
                   (k + 1) * top, bins[k]);
            add_mark(b, (k + 0.5) * top, 100 * bins[k]);
        }
        printf("%s,%s,%s,%u,%.6g,,largest\n", b->machine, b->name, names[i], cells, most);
        free(of);
        free(numbers);
        drop(b, &m);
    }
    draw(b, "How much of view space costs how much", (sl_chart_axis){.label = "render cost"},
         (sl_chart_axis){.label = "% of view space"});
}

static void walls(bench *b) {
    sl_view_subdivision options = options_of(b);
    made axes, both;
    make(b, method_named("av-s"), &b->segments, &options, &axes);
    options.wall_splits = WALL_SPLITS;
    make(b, method_named("av-s"), &b->segments, &options, &both);
    puts("machine,map,turned,view_cells,cost_axes,cost_with_walls,ratio");
    begin_series(b, "only axis-aligned, beside walls' own lines too", SL_CHART_LINE);
    for (uint32_t n = 10; n <= b->cells; n = next_count(n, b->cells)) {
        if (n > axes.told.cell_count || n > both.told.cell_count) break;
        printf("%s,%s,%g,%u,%.6g,%.6g,%.4f\n", b->machine, b->name, b->turn, n, axes.costs[n - 1],
               both.costs[n - 1], axes.costs[n - 1] / both.costs[n - 1]);
        add_mark(b, n, axes.costs[n - 1] / both.costs[n - 1]);
    }
    draw(b, "Axis-aligned splits alone, beside walls' lines too",
         (sl_chart_axis){.label = "view cells", .scale = SL_CHART_LOG},
         (sl_chart_axis){.label = "ratio of costs"});
    drop(b, &axes);
    drop(b, &both);
}

static void times(bench *b) {
    sl_view_subdivision options = options_of(b);
    made axes, both;
    make(b, method_named("av-m"), &b->segments, &options, &axes);
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    options.wall_splits = WALL_SPLITS;
    make(b, method_named("av-m"), &b->segments, &options, &both);
    puts("machine,map,samples,segments,view_cells,axes_s,axes_and_walls_s,merge_s,peak_mib");
    printf("%s,%s,%llu,%u,%u,%.2f,%.2f,%.2f,%ld\n", b->machine, b->name,
           (unsigned long long)b->samples, b->segments.count, axes.tree.cell_count, axes.divide,
           both.divide, axes.merge, usage.ru_maxrss / 1024);
    drop(b, &axes);
    drop(b, &both);
}

// --- the command

static const struct {
    const char *name;
    void (*run)(bench *b);
} figures[] = {{"curves", curves},
               {"samples", samples},
               {"histogram", histogram},
               {"walls", walls},
               {"times", times}};

static void read_option(bench *b, const char *text, sl_import_options *import, sl_point *start,
                        bool *has_start) {
    const char *value = strchr(text, '=');
    if (!value) bench_fail(text);
    const size_t length = (size_t)(value++ - text);
    char *end;
    if (strncmp(text, "slice", length) == 0) {
        import->has_slice = true;
        import->slice = strtod(value, NULL);
    } else if (strncmp(text, "map", length) == 0) {
        import->map = value;
    } else if (strncmp(text, "start", length) == 0) {
        start->x = strtod(value, &end);
        start->y = strtod(*end ? end + 1 : end, NULL);
        *has_start = true;
    } else if (strncmp(text, "objects", length) == 0 && strcmp(value, "cells") == 0) {
        b->objects = SL_VIEW_CELLS;
    } else if (strncmp(text, "turn", length) == 0) {
        b->turn = strtod(value, NULL);
    } else if (strncmp(text, "samples", length) == 0) {
        b->samples = strtoull(value, NULL, 10);
    } else if (strncmp(text, "evaluate", length) == 0) {
        b->evaluate = strtoull(value, NULL, 10);
    } else if (strncmp(text, "cells", length) == 0) {
        b->cells = (uint32_t)strtoul(value, NULL, 10);
    } else if (strncmp(text, "chart", length) == 0) {
        b->chart = value;
    } else {
        bench_fail(text);
    }
}

int main(int argc, char **argv) {
    static bench b = {.samples = 1500000, .evaluate = 8000000, .cells = 5000};
    sl_import_options import = sl_import_options_default();
    sl_point start = {0};
    bool has_start = false;
    if (argc < 3) bench_fail("a figure and a map are needed; the head of the source tells which");
    b.context = sl_context_create(NULL);
    if (!b.context) bench_fail("out of memory");
    b.path = argv[2];
    b.name = strrchr(b.path, '/') ? strrchr(b.path, '/') + 1 : b.path;
    for (int i = 3; i < argc; i++) read_option(&b, argv[i], &import, &start, &has_start);
    struct utsname machine;
    if (uname(&machine) == 0) snprintf(b.machine, sizeof b.machine, "%s", machine.nodename);
    read_map(&b, &import, has_start ? &start : NULL);
    sample(&b, b.samples, 1, &b.segments);
    sample(&b, b.evaluate, 2, &b.others);
    bool found = false;
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        if (strcmp(figures[i].name, argv[1]) == 0) {
            figures[i].run(&b);
            found = true;
        }
    if (!found) bench_fail(argv[1]);
    sl_view_segments_destroy(b.context, &b.segments);
    sl_view_segments_destroy(b.context, &b.others);
    sl_view_places_destroy(b.context, &b.places);
    sli_outline_destroy(b.context, &b.outline);
    sl_space_destroy(b.context, &b.space);
    sl_map_destroy(b.context, &b.map);
    sl_context_destroy(b.context);
    return 0;
}
