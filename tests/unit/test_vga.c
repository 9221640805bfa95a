/// Visibility graphs: each pair beside sli_sees, measures beside sums over all pairs.
#include "effects/filtered.h"
#include "space/outline.h"
#include "testing.h"

#include "analysis/visibility_graph/graph_paths.h"
#include "analysis/visibility_graph/graph_rows.h"
#include "geometry/length.h"
#include "map/scan.h"
#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sight/region.h"
#include "sightline/effects.h"
#include "sightline/vga.h"
#include "space/subdivide.h"

#include <math.h>
#include <string.h>

typedef struct fixture {
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_vga_grid grid;
    sl_vga_graph graph;
} fixture;

static void fixture_destroy(sl_context *context, fixture *f) {
    sl_vga_graph_destroy(context, &f->graph);
    sl_vga_grid_destroy(context, &f->grid);
    sli_outline_destroy(context, &f->outline);
    sl_space_destroy(context, &f->space);
    sl_map_destroy(context, &f->map);
}

static bool has_edge(const sl_vga_graph *graph, uint32_t a, uint32_t b) {
    return sl_vga_sees(graph, a, b);
}

/// A row of `count` for each point: what it sees. For loops over all pairs.
static bool *all_edges(const sl_vga_graph *graph) {
    bool *edges = test_calloc((size_t)graph->count * graph->count + 1, sizeof *edges);
    for (uint32_t p = 0; p < graph->count; p++) {
        sl_vga_run run = sl_vga_row(graph, p);
        while (sl_vga_next(&run))
            memset(edges + (size_t)p * graph->count + run.first, true, run.stop - run.first);
    }
    return edges;
}

/// Half of a unit puts points on walls' lines, at ends and on portals.
static void fill_and_connect(sl_context *context, double step, fixture *f) {
    assert_ok(context, sli_outline_make(context, &f->space, &f->outline));
    assert_ok(context, sl_vga_grid_make(context, &f->outline, step, NULL, 0, &f->grid));
    assert_ok(context, sl_vga_graph_make(context, &f->outline, &f->grid, 0, 1, &f->graph));
}

static size_t check_pairs(sl_context *context, const fixture *f) {
    size_t seen = 0;
    for (uint32_t a = 0; a < f->grid.count; a++) {
        assert_false(has_edge(&f->graph, a, a));
        for (uint32_t b = 0; b < f->grid.count; b++) {
            bool sees;
            if (a == b) continue;
            assert_ok(context, sli_sees(context, &f->outline, f->grid.points[a], f->grid.points[b],
                                        SL_CLOSED, &sees));
            assert_int_equal(has_edge(&f->graph, a, b), sees);
            assert_int_equal(has_edge(&f->graph, b, a), sees);
            seen += sees;
        }
    }
    assert_int_equal(f->graph.edges, seen);
    return seen;
}

static uint32_t part_root(const uint32_t *parts, uint32_t p) {
    while (parts[p] != p) p = parts[p];
    return p;
}

enum { BIT_POINTS = 200 };

/// Makes a graph from a bit for each pair.
static sl_status look_up(sl_context *context, void *job, void *state, uint32_t point,
                         sl_bits *row) {
    const sl_bits(*rows)[4] = job;
    (void)context;
    (void)state;
    for (uint32_t q = 0; q < BIT_POINTS; q++)
        if (sl_bits_has(rows[point], q)) sl_bits_add(row, q);
    return SL_OK;
}

static void make_of_bits(sl_context *context, sl_bits (*rows)[4], uint32_t count,
                         sl_vga_graph *out) {
    const sli_vga_source source = {
        .count = count, .points = count, .directed = true, .job = rows, .look = look_up};
    assert_ok(context, sli_vga_graph_write(context, &source, 1, out));
}

/// Rows of random runs are read as they were written, forwards and turned over. Empty rows, full
/// ones and single points are among them.
static void rows_are_read_as_written(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    sl_bits rows[BIT_POINTS][4];
    sl_random random = {5};
    for (uint32_t count = 0; count <= BIT_POINTS; count++) {
        const uint64_t length = 1 + sl_random_below(&random, 90);
        sl_vga_graph graph = {0};
        uint64_t edges = 0;
        memset(rows, 0, sizeof rows);
        for (uint32_t p = 0; p < count; p++) {
            bool in = sl_random_below(&random, 2);
            for (uint32_t q = 0; q < count; q++) {
                in ^= sl_random_below(&random, length) == 0;
                if (!in || q == p) continue;
                sl_bits_add(rows[p], q);
                edges++;
            }
        }
        make_of_bits(context, rows, count, &graph);
        assert_true(graph.edges == edges && graph.count == count);
        for (uint32_t p = 0; p < count; p++) {
            sl_bits read[4] = {0};
            sli_vga_add_row(&graph, p, read);
            assert_memory_equal(read, rows[p], sizeof read);
            for (uint32_t q = 0; q < count; q++)
                assert_int_equal(sl_vga_sees(&graph, p, q), sl_bits_has(rows[p], q));
            sl_vga_run run = sl_vga_row(&graph, p);
            for (uint32_t stop = 0; sl_vga_next(&run); stop = run.stop)
                assert_true(run.first < run.stop && (run.first > stop || stop == 0));
        }
        assert_ok(context, sl_vga_graph_turn(context, &graph));
        assert_true(graph.edges == edges);
        for (uint32_t p = 0; p < count; p++)
            for (uint32_t q = 0; q < count; q++)
                assert_int_equal(sl_vga_sees(&graph, p, q), sl_bits_has(rows[q], p));
        sl_vga_graph_destroy(context, &graph);
    }
    sl_context_destroy(context);
}

/// Graphs of random pairs, one of them empty, as one: pairs are those of each alone.
static void joined_graphs_keep_their_pairs(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    static const uint32_t counts[4] = {70, 0, 1, 64};
    sl_bits rows[4][BIT_POINTS][4];
    sl_vga_graph graphs[4] = {0}, all;
    sl_random random = {3};
    uint64_t edges = 0;
    memset(rows, 0, sizeof rows);
    for (int g = 0; g < 4; g++) {
        for (uint32_t p = 0; p < counts[g]; p++)
            for (uint32_t q = 0; q < counts[g]; q++)
                if (p != q && sl_random_below(&random, 3) == 0) sl_bits_add(rows[g][p], q);
        make_of_bits(context, rows[g], counts[g], &graphs[g]);
        edges += graphs[g].edges;
    }
    assert_ok(context, sl_vga_graph_join(context, graphs, 4, &all));
    assert_true(all.count == 135 && all.edges == edges && all.directed);
    for (uint32_t p = 0; p < all.count; p++)
        for (uint32_t q = 0; q < all.count; q++) {
            const uint32_t first = p < 70 ? 0 : p < 71 ? 70 : 71, g = p < 70 ? 0 : p < 71 ? 2 : 3;
            const bool same = q >= first && q - first < counts[g];
            assert_int_equal(sl_vga_sees(&all, p, q),
                             same && sl_bits_has(rows[g][p - first], q - first));
        }
    for (int g = 0; g < 4; g++) sl_vga_graph_destroy(context, &graphs[g]);
    sl_vga_graph_destroy(context, &all);
    sl_context_destroy(context);
}

/// The sizes of parts beside sets of points that are joined pair by pair; random directed graphs,
/// with links.
static void parts_are_those_of_all_pairs(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    enum { MOST = BIT_POINTS };
    sl_bits rows[MOST][4];
    uint64_t seed = 7;
    uint32_t parts[MOST], sizes[MOST];
    for (int i = 0; i < 400; i++) {
        const uint32_t count = 1 + (uint32_t)i % MOST, edges = count * (uint32_t)(i % 7) / 4;
        sl_vga_graph graph = {0};
        sl_vga_link links[2] = {{0, count - 1}, {count / 2, count / 3}};
        const size_t link_count = count > 3 ? (size_t)i % 3 : 0;
        memset(rows, 0, sizeof rows);
        for (uint32_t p = 0; p < count; p++) parts[p] = p;
        for (uint32_t k = 0; k < edges + link_count; k++) {
            seed = seed * 6364136223846793005U + 1442695040888963407U;
            uint32_t a = (uint32_t)(seed >> 33) % count, b = (uint32_t)(seed >> 48) % count;
            if (k >= edges) {
                a = links[k - edges].a;
                b = links[k - edges].b;
            } else if (a != b) {
                sl_bits_add(rows[a], b);
            }
            parts[part_root(parts, a)] = part_root(parts, b);
        }
        make_of_bits(context, rows, count, &graph);
        assert_ok(context, sl_vga_part_sizes(context, &graph, links, link_count, sizes));
        for (uint32_t p = 0; p < count; p++) {
            uint32_t size = 0;
            for (uint32_t q = 0; q < count; q++) size += part_root(parts, q) == part_root(parts, p);
            assert_int_equal(sizes[p], size);
        }
        // Numbered from the largest, of two alike from the first.
        uint32_t numbers[MOST], number_count;
        assert_ok(context,
                  sl_vga_parts(context, &graph, links, link_count, numbers, &number_count));
        for (uint32_t p = 0; p < count; p++)
            for (uint32_t q = 0; q < p; q++) {
                const bool one = part_root(parts, p) == part_root(parts, q);
                assert_true(one == (numbers[p] == numbers[q]));
                if (sizes[p] != sizes[q])
                    assert_true((sizes[p] > sizes[q]) == (numbers[p] < numbers[q]));
            }
        for (uint32_t p = 0, seen = 0; p < count; p++) {
            assert_true(numbers[p] < number_count);
            uint32_t first = 0;
            while (numbers[first] != numbers[p]) first++;
            if (first != p) continue;
            for (uint32_t q = 0; q < p; q++)
                if (sizes[q] == sizes[p]) assert_true(numbers[q] < numbers[p]);
            assert_true(++seen <= number_count);
        }
        sl_vga_graph_destroy(context, &graph);
    }
    sl_context_destroy(context);
}

/// A part with less than a tenth of the largest one's points does not set the scale.
static void small_parts_do_not_set_the_scale(void **state) {
    (void)state;
    double values[34];
    uint32_t sizes[34];
    for (uint32_t p = 0; p < 34; p++) {
        sizes[p] = p < 30 ? 30 : p < 33 ? 3 : 1;
        values[p] = p < 30 ? 2 + p : p < 33 ? 40 : 70;
    }
    values[4] = NAN;
    sl_vga_scale scale = sl_vga_scale_of(values, sizes, 34);
    assert_true(scale.least == 2 && scale.most == 40);
    assert_int_equal(scale.small_points, 1);
    assert_int_equal(scale.small_parts, 1);
    assert_int_equal(scale.beyond, 1);
    values[33] = 3;
    scale = sl_vga_scale_of(values, sizes, 34);
    assert_true(scale.least == 2 && scale.most == 40);
    assert_int_equal(scale.beyond, 0);
}

static void pairs_are_those_of_single_sightlines(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const sl_subdivide_options options = sl_subdivide_options_default();
    size_t seen = 0, points = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(60); seed++) {
        fixture f = {0};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &f.map));
        assert_ok(context, sl_map_clean(context, &f.map, NULL, NULL));
        const bool mesh = seed % 3 == 0;
        const sl_status made = !f.map.wall_count ? SL_BAD_ARGUMENT
                               : mesh            ? sli_subdivide_mesh(context, &f.map, &f.space)
                                      : sli_subdivide_kd(context, &f.map, &options, &f.space);
        if (made == SL_OK) {
            fill_and_connect(context, seed % 2 ? 0.5 : 1, &f);
            seen += check_pairs(context, &f);
            points += f.grid.count;
        }
        fixture_destroy(context, &f);
    }
    assert_true(points > 1000 && seen > 10000);
    sl_context_destroy(context);
}

static void oblique_pairs_too(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t seen = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(60); seed++) {
        fixture f = {0};
        assert_ok(context, oblique_random_map(context, seed, (oblique_grid)(seed % OBLIQUE_GRIDS),
                                              12, &f.map));
        assert_ok(context, sl_map_clean(context, &f.map, NULL, NULL));
        if (sli_subdivide_mesh(context, &f.map, &f.space) == SL_OK) {
            const sl_box b = f.space.bounds;
            const double step = fmax(b.max.x - b.min.x, b.max.y - b.min.y) / 12;
            if (step > 0 && fabs(b.min.x) / step < 1e6 && fabs(b.min.y) / step < 1e6) {
                fill_and_connect(context, step, &f);
                seen += check_pairs(context, &f);
            }
        }
        fixture_destroy(context, &f);
    }
    assert_true(seen > 1000);
    sl_context_destroy(context);
}

// --- measures, beside brute force

static void make_plan(sl_context *context, fixture *f) {
    static const char text[] =
        "sightline 1\nwalls 0 0 9 0 9 6 0 6 0 0\nwall 3 0 3 2\nwall 3 3 3 6\n"
        "wall 6 1.5 6 6\nwall 3 4 5 4.5\n";
    assert_ok(context, sli_map_read_text(context, "plan", text, sizeof text - 1, &f->map));
    assert_ok(context, sl_map_clean(context, &f->map, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &f->map, &f->space));
    fill_and_connect(context, 0.5, f);
}

static void local_measures(const fixture *f, uint32_t p, const sl_vga_measures *m) {
    double degree = 0, pairs = 0, both = 0, control = 0, first = 0;
    const size_t n = f->grid.count;
    bool *edges = all_edges(&f->graph);
    const bool *of_p = edges + p * n;
    for (uint32_t q = 0; q < n; q++) {
        bool near = false;
        double of_q = 0;
        for (uint32_t r = 0; r < n; r++) {
            near |= of_p[r] && edges[r * n + q];
            of_q += edges[q * n + r];
            pairs += of_p[q] && of_p[r] && edges[q * n + r];
        }
        both += near;
        if (!of_p[q]) continue;
        degree++;
        control += 1 / of_q;
        first += hypot(f->grid.points[q].x - f->grid.points[p].x,
                       f->grid.points[q].y - f->grid.points[p].y);
    }
    test_free(edges);
    assert_true(m->connectivity == degree);
    assert_true(fabs(m->point_first_moment - first) < 1e-9 * first);
    assert_true(fabs(m->visual_clustering_coefficient - pairs / (degree * (degree - 1))) < 1e-12);
    assert_true(fabs(m->visual_control - control) < 1e-12 * control);
    assert_true(m->visual_controllability == degree / both);
}

/// Floyd and Warshall, on steps and on lengths. Paths turn at points beside walls only, so they are
/// a little longer than the shortest of all.
static void global_measures(const fixture *f, const sl_vga_measures *m) {
    const uint32_t n = f->grid.count;
    double *steps = test_calloc((size_t)n * n, sizeof *steps);
    double *lengths = test_calloc((size_t)n * n, sizeof *lengths);
    for (uint32_t a = 0; a < n; a++)
        for (uint32_t b = 0; b < n; b++) {
            const sl_point p = f->grid.points[a], q = f->grid.points[b];
            const bool edge = has_edge(&f->graph, a, b);
            steps[a * n + b] = a == b ? 0 : edge ? 1 : INFINITY;
            lengths[a * n + b] = a == b ? 0 : edge ? hypot(p.x - q.x, p.y - q.y) : INFINITY;
        }
    for (uint32_t k = 0; k < n; k++)
        for (uint32_t a = 0; a < n; a++)
            for (uint32_t b = 0; b < n; b++) {
                steps[a * n + b] = fmin(steps[a * n + b], steps[a * n + k] + steps[k * n + b]);
                lengths[a * n + b] =
                    fmin(lengths[a * n + b], lengths[a * n + k] + lengths[k * n + b]);
            }
    for (uint32_t a = 0; a < n; a++) {
        double total = 0, length = 0;
        for (uint32_t b = 0; b < n; b++) {
            total += steps[a * n + b];
            length += lengths[a * n + b];
        }
        assert_true(m[a].visual_node_count == n);
        assert_true(fabs(m[a].visual_mean_depth - total / (n - 1)) < 1e-12 * total);
        const double metric = m[a].metric_mean_shortest_path_distance;
        assert_true(metric > (1 - 1e-6) * length / n && metric < 1.02 * length / n);
    }
    test_free(steps);
    test_free(lengths);
}

static void measures_are_those_of_brute_force(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    make_plan(context, &f);
    sl_vga_options options = sl_vga_options_default();
    options.parts = SL_VGA_LOCAL | SL_VGA_GLOBAL | SL_VGA_THROUGH | SL_VGA_METRIC | SL_VGA_ANGULAR;
    sl_vga_measures *one = test_calloc(f.grid.count, sizeof *one);
    sl_vga_measures *three = test_calloc(f.grid.count, sizeof *three);
    options.threads = 1;
    assert_ok(context, sl_vga_measure(context, &f.outline, &f.grid, &f.graph, &options, one));
    options.threads = 3;
    assert_ok(context, sl_vga_measure(context, &f.outline, &f.grid, &f.graph, &options, three));
    assert_memory_equal(one, three, f.grid.count * sizeof *one);
    for (uint32_t p = 0; p < f.grid.count; p++) local_measures(&f, p, &one[p]);
    global_measures(&f, one);
    uint32_t *depths = test_calloc(f.grid.count, sizeof *depths);
    const uint32_t from = 0;
    double total = 0;
    assert_ok(context, sl_vga_step_depth(context, &f.graph, &from, 1, depths));
    for (uint32_t p = 0; p < f.grid.count; p++) total += depths[p];
    assert_true(fabs(total / (f.grid.count - 1) - one[0].visual_mean_depth) < 1e-12);
    test_free(depths);
    test_free(one);
    test_free(three);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

/// Rooms in a row, with doors on opposite sides, turned.
static void make_turned(sl_context *context, double degrees, double step, double range,
                        fixture *f) {
    static const double walls[][4] = {{0, 0, 12, 0},   {12, 0, 12, 5}, {12, 5, 0, 5},
                                      {0, 5, 0, 0},    {3, 0, 3, 4},   {6, 1, 6, 5},
                                      {9, 0, 9, 4.25}, {1, 2, 2, 2.5}, {10.5, 1, 10.5, 3}};
    const double c = cos(degrees * 0.017453292519943295), s = sin(degrees * 0.017453292519943295);
    char text[2048];
    size_t n = (size_t)snprintf(text, sizeof text, "sightline 1\n");
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        const double *w = walls[i];
        n += (size_t)snprintf(text + n, sizeof text - n, "wall %.17g %.17g %.17g %.17g\n",
                              c * w[0] - s * w[1], s * w[0] + c * w[1], c * w[2] - s * w[3],
                              s * w[2] + c * w[3]);
    }
    assert_ok(context, sli_map_read_text(context, "rooms", text, n, &f->map));
    assert_ok(context, sl_map_clean(context, &f->map, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &f->map, &f->space));
    assert_ok(context, sli_outline_make(context, &f->space, &f->outline));
    assert_ok(context, sl_vga_grid_make(context, &f->outline, step, NULL, 0, &f->grid));
    assert_ok(context, sl_vga_graph_make(context, &f->outline, &f->grid, range, 2, &f->graph));
}

static void check_range(sl_context *context, const fixture *f, double range) {
    for (uint32_t a = 0; a < f->grid.count; a++)
        for (uint32_t b = 0; b < a; b++) {
            const sl_point p = f->grid.points[a], q = f->grid.points[b];
            bool sees;
            assert_ok(context, sli_sees(context, &f->outline, p, q, SL_CLOSED, &sees));
            sees &= range == 0 || sli_length(p.x - q.x, p.y - q.y) <= range;
            assert_int_equal(has_edge(&f->graph, a, b), sees);
            assert_int_equal(has_edge(&f->graph, b, a), sees);
        }
}

enum { RADII = 4 }; ///< 0, which is no limit, up to 3

/// Many groups of points, levels found from both sides, and masks that are not full.
static void depths_are_those_of_plain_searches(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const double turns[] = {0, 17.3}, ranges[] = {0, 2};
    for (size_t i = 0; i < 4; i++) {
        fixture f = {0};
        make_turned(context, turns[i / 2], 0.25, ranges[i % 2], &f);
        check_range(context, &f, ranges[i % 2]);
        const uint32_t n = f.grid.count;
        sl_vga_measures *m = test_calloc((size_t)n * RADII, sizeof *m);
        uint32_t *depths = test_calloc(n, sizeof *depths), deepest = 0;
        assert_true(n > 640);
        for (uint32_t radius = 0; radius < RADII; radius++) {
            const sl_vga_options options = {
                .parts = SL_VGA_LOCAL | SL_VGA_GLOBAL, .radius = radius, .threads = 2};
            assert_ok(context, sl_vga_measure(context, &f.outline, &f.grid, &f.graph, &options,
                                              m + (size_t)radius * n));
        }
        for (uint32_t p = 0; p < n; p++) {
            assert_ok(context, sl_vga_step_depth(context, &f.graph, &p, 1, depths));
            for (uint32_t radius = 0; radius < RADII; radius++) {
                const sl_vga_measures *of = &m[(size_t)radius * n + p];
                double nodes = 0, total = 0;
                for (uint32_t q = 0; q < n; q++) {
                    if (depths[q] > (radius ? radius : n)) continue;
                    nodes++;
                    total += depths[q];
                    if (depths[q] > deepest) deepest = depths[q];
                }
                assert_true(of->visual_node_count == nodes);
                assert_true(of->visual_mean_depth == total / (nodes - 1));
                if (p % 97 == radius) local_measures(&f, p, of);
            }
        }
        assert_true(deepest > 3);
        test_free(m);
        test_free(depths);
        fixture_destroy(context, &f);
    }
    sl_context_destroy(context);
}

// --- searches, beside plain ones

/// Whether a wall touches one of the nine squares about a point. Walls are axial here.
static bool is_beside_wall(const fixture *f, uint32_t p) {
    const sl_point at = f->grid.points[p];
    const double far = 1.5 * f->grid.step;
    for (uint32_t i = 0; i < f->space.wall_count; i++) {
        const sl_wall w = f->space.walls[i];
        if (fmin(w.a.x, w.b.x) <= at.x + far && fmax(w.a.x, w.b.x) >= at.x - far &&
            fmin(w.a.y, w.b.y) <= at.y + far && fmax(w.a.y, w.b.y) >= at.y - far)
            return true;
    }
    return false;
}

static sl_point step_of(const fixture *f, uint32_t from, uint32_t to) {
    const sl_point a = f->grid.points[from], b = f->grid.points[to];
    return (sl_point){round((b.x - a.x) / f->grid.step), round((b.y - a.y) / f->grid.step)};
}

/// In right angles.
static float turn_at(const fixture *f, uint32_t before, uint32_t at, uint32_t to) {
    const sl_point a = step_of(f, before, at), b = step_of(f, at, to);
    const double lengths = sqrt((a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y));
    const double cosine = (a.x * b.x + a.y * b.y) / lengths;
    return (float)(acos(fmin(fmax(cosine, -1), 1)) / 1.5707963267948966);
}

typedef struct plain_path {
    float length, turn; ///< in squares, and in right angles
    uint32_t last;      ///< the point before it that gave the length
    uint32_t before;    ///< the first that gave it, as rounded; `from` has itself
    bool done, turns;
} plain_path;

/// Dijkstra's algorithm by its definition, without a heap. Single precision and ties as depthmapX.
static void find_plain_paths(const fixture *f, uint32_t from, bool angular, plain_path *paths) {
    const size_t n = f->grid.count;
    bool *edges = all_edges(&f->graph);
    for (uint32_t q = 0; q < n; q++) {
        paths[q] = (plain_path){INFINITY, INFINITY, from, from, false, is_beside_wall(f, q)};
        if (q == from) paths[q].length = paths[q].turn = 0;
    }
    for (;;) {
        uint32_t u = (uint32_t)n;
        for (uint32_t q = 0; q < n; q++) {
            const float key = angular ? paths[q].turn : paths[q].length;
            if (paths[q].done || key == INFINITY) continue;
            if (u == n || key < (angular ? paths[u].turn : paths[u].length)) u = q;
        }
        if (u == n) break;
        plain_path *at = &paths[u];
        at->done = true;
        if (!angular && u != from && at->last != from)
            at->turn = paths[at->last].turn + turn_at(f, paths[at->last].before, at->last, u);
        else if (!angular)
            at->turn = 0;
        if (u != from && !at->turns && !(angular && at->turn == 0)) continue;
        for (uint32_t q = 0; q < n; q++) {
            plain_path *to = &paths[q];
            if (to->done || !edges[u * n + q]) continue;
            const sl_point step = step_of(f, u, q);
            const double way = sqrt(step.x * step.x + step.y * step.y);
            if (angular) {
                // Where the point before sees it, it has tried.
                if (u != from && edges[at->before * n + q]) continue;
                const float turn = at->turn + (u == from ? 0 : turn_at(f, at->before, u, q));
                if (turn >= to->turn) continue;
                to->turn = turn;
                to->before = u;
            } else if (at->length + way < to->length) {
                const float length = at->length + (float)way;
                if (length != to->length) to->before = u;
                to->length = length;
                to->last = u;
            }
        }
    }
    test_free(edges);
}

static void check_plain_paths(const fixture *f, uint32_t from, const sl_vga_measures *m) {
    const uint32_t n = f->grid.count;
    plain_path *paths = test_calloc(n, sizeof *paths);
    double length = 0, turn = 0, angular = 0, nodes = 0;
    find_plain_paths(f, from, false, paths);
    for (uint32_t q = 0; q < n; q++) {
        if (paths[q].length == INFINITY) continue;
        length += paths[q].length * f->grid.step;
        turn += paths[q].turn;
        nodes++;
    }
    assert_true(m->metric_node_count == nodes);
    assert_true(m->metric_mean_shortest_path_distance == length / nodes);
    assert_true(m->metric_mean_shortest_path_angle == turn / nodes);
    find_plain_paths(f, from, true, paths);
    nodes = 0;
    for (uint32_t q = 0; q < n; q++) {
        if (paths[q].turn == INFINITY) continue;
        angular += paths[q].turn;
        nodes++;
    }
    assert_true(m->angular_node_count == nodes);
    assert_true(m->angular_total_depth == angular);
    test_free(paths);
}

/// Steps, one point at a time.
static void check_plain_depths(sl_context *context, const fixture *f, uint32_t from,
                               uint32_t radius, const sl_vga_measures *m) {
    const uint32_t n = f->grid.count;
    uint32_t *depths = test_calloc(n, sizeof *depths);
    double nodes = 0, total = 0;
    assert_ok(context, sl_vga_step_depth(context, &f->graph, &from, 1, depths));
    for (uint32_t q = 0; q < n; q++) {
        if (depths[q] == UINT32_MAX || (radius && depths[q] > radius)) continue;
        nodes++;
        total += depths[q];
    }
    assert_true(m->visual_node_count == nodes);
    if (nodes > 1) assert_true(m->visual_mean_depth == total / (nodes - 1));
    test_free(depths);
}

/// Of random maps, in several parts, with points on walls' lines. `range` makes groups small.
static void searches_are_those_of_plain_ones(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    size_t points = 0, deep = 0;
    for (uint64_t seed = 1; seed <= testing_seeds(16); seed++) {
        fixture f = {0};
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &f.map));
        assert_ok(context, sl_map_clean(context, &f.map, NULL, NULL));
        if (f.map.wall_count && sli_subdivide_mesh(context, &f.map, &f.space) == SL_OK) {
            const sl_box b = f.space.bounds;
            const double size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
            fill_and_connect(context, size > 20 ? 1 : 0.5, &f);
            if (seed % 3 == 0) {
                sl_vga_graph_destroy(context, &f.graph);
                assert_ok(context,
                          sl_vga_graph_make(context, &f.outline, &f.grid, 2.5, 1, &f.graph));
            }
            sl_vga_options options = sl_vga_options_default();
            options.parts = SL_VGA_GLOBAL | SL_VGA_METRIC | SL_VGA_ANGULAR;
            options.radius = seed % 4 == 1 ? 2 : 0;
            options.threads = 1 + seed % 2;
            sl_vga_measures *m = test_calloc(f.grid.count + 1, sizeof *m);
            assert_ok(context, sl_vga_measure(context, &f.outline, &f.grid, &f.graph, &options, m));
            for (uint32_t p = 0; p < f.grid.count; p++) {
                check_plain_depths(context, &f, p, options.radius, &m[p]);
                deep += m[p].visual_mean_depth > 2;
                if (p % 16 == seed % 16) check_plain_paths(&f, p, &m[p]);
            }
            points += f.grid.count;
            test_free(m);
        }
        fixture_destroy(context, &f);
    }
    assert_true(points > 2000 && deep > 100);
    sl_context_destroy(context);
}

/// Shortest paths are found by lists of ways on. What has no room for a list tries all ways on.
static void lists_do_not_change_paths(void **state) {
    (void)state;
    static const size_t limits[] = {0, 300, 3000};
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    make_plan(context, &f);
    const uint32_t n = f.grid.count;
    sl_vga_options options = sl_vga_options_default();
    options.parts = SL_VGA_METRIC;
    sl_bits *turning = NULL;
    assert_ok(context, sli_vga_find_turning(context, &f.outline, &f.grid, &turning));
    sl_vga_measures *all = test_calloc(n, sizeof *all), *some = test_calloc(n, sizeof *some);
    sli_vga_job job = {&f.grid, &f.graph, &options, NULL, turning, NULL, all};
    sli_vga_sights sights;
    assert_ok(context, sli_vga_sights_make(context, &job, &sights));
    assert_ok(context, sli_vga_measure_metric(context, &sights));
    for (uint32_t p = 0; p < n; p += 5) {
        plain_path *paths = test_calloc(n, sizeof *paths);
        double length = 0;
        find_plain_paths(&f, p, false, paths);
        for (uint32_t q = 0; q < n; q++) length += paths[q].length * f.grid.step;
        assert_true(all[p].metric_mean_shortest_path_distance == length / n);
        test_free(paths);
    }
    job.measures = some;
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        sights.kept_ways = limits[i];
        memset(some, 0, n * sizeof *some);
        assert_ok(context, sli_vga_measure_metric(context, &sights));
        assert_memory_equal(some, all, n * sizeof *some);
    }
    sli_vga_sights_destroy(context, &sights);
    sl_free(context, turning);
    test_free(all);
    test_free(some);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

/// What is behind glass is reached from one side alone: no part of the graph for both.
static void paths_lead_through_glass_one_way(void **state) {
    (void)state;
    static const char *const texts[] = {
        "sightline 1\nwalls 0 0 8 0 8 6 0 6 0 0\nwall 4 0 4 2\nwall 4 3 4 6\nwall 2 2 2 4\n"
        "wall 6 1 6 4\noneway 4 2 4 3\n",
        "sightline 1\nwalls 0 0 8 0 8 6 0 6 0 0\nwall 3.75 0 3.75 2\nwall 3.75 3 3.75 6\nwall 2 2 "
        "2 4\n"
        "wall 6 1 6 4\noneway 3.75 3 3.75 2\n"};
    sl_context *context = testing_context(NULL);
    const sli_filtered_space filtered = {.one_way = true, .dark_walls = true};
    for (size_t i = 0; i < 2; i++) {
        fixture f = {0};
        sl_space plain = {0};
        assert_ok(context, sli_map_read_text(context, "plan", texts[i], strlen(texts[i]), &f.map));
        assert_ok(context, sl_map_clean(context, &f.map, NULL, NULL));
        assert_ok(context, sli_subdivide_mesh(context, &f.map, &plain));
        assert_ok(context, sli_filtered_space_make(context, &plain, &filtered, NULL, &f.space));
        fill_and_connect(context, 0.5, &f);
        sl_vga_options options = sl_vga_options_default();
        options.parts = SL_VGA_GLOBAL | SL_VGA_METRIC | SL_VGA_ANGULAR;
        sl_vga_measures *m = test_calloc(f.grid.count + 1, sizeof *m);
        assert_ok(context, sl_vga_measure(context, &f.outline, &f.grid, &f.graph, &options, m));
        double most = 0, least = INFINITY;
        for (uint32_t p = 0; p < f.grid.count; p++) {
            check_plain_depths(context, &f, p, 0, &m[p]);
            check_plain_paths(&f, p, &m[p]);
            most = fmax(most, m[p].angular_node_count);
            least = fmin(least, m[p].angular_node_count);
        }
        if (i == 1) assert_true(least + 50 < most); // no point is on the glass
        test_free(m);
        sl_space_destroy(context, &plain);
        fixture_destroy(context, &f);
    }
    sl_context_destroy(context);
}

static void seeds_stay_in_their_room(void **state) {
    (void)state;
    static const char text[] = "sightline 1\nwalls 0 0 4 0 4 2 0 2 0 0\nwall 2 0 2 2\n";
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    assert_ok(context, sli_map_read_text(context, "plan", text, sizeof text - 1, &f.map));
    assert_ok(context, sl_map_clean(context, &f.map, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &f.map, &f.space));
    assert_ok(context, sli_outline_make(context, &f.space, &f.outline));
    const sl_point seed = {0.9, 1.1}, outside = {9, 9};
    assert_ok(context, sl_vga_grid_make(context, &f.outline, 0.5, &seed, 1, &f.grid));
    assert_int_equal(f.grid.count, 9);
    sl_vga_grid other = {0};
    assert_int_equal(sl_vga_grid_make(context, &f.outline, 0.5, &outside, 1, &other),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_vga_grid_make(context, &f.outline, 0, NULL, 0, &other), SL_BAD_ARGUMENT);
    assert_int_equal(sl_vga_grid_make(context, &f.outline, 1e-9, NULL, 0, &other), SL_BAD_ARGUMENT);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

/// Glass is seen through from its right: rows are directed, and the turned graph has the columns.
static void glass_is_seen_through_one_way(void **state) {
    (void)state;
    static const char text[] = "sightline 1\nwalls 0 0 4 0 4 3 0 3 0 0\nwall 2 0 2 1\n"
                               "wall 2 2 2 3\noneway 2 1 2 2\n";
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    sl_space plain = {0};
    const sli_filtered_space filtered = {.one_way = true, .dark_walls = true};
    assert_ok(context, sli_map_read_text(context, "plan", text, sizeof text - 1, &f.map));
    assert_ok(context, sl_map_clean(context, &f.map, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &f.map, &plain));
    assert_ok(context, sli_filtered_space_make(context, &plain, &filtered, NULL, &f.space));
    fill_and_connect(context, 0.5, &f);
    size_t one_way = 0;
    for (uint32_t a = 0; a < f.grid.count; a++) {
        for (uint32_t b = 0; b < f.grid.count; b++) {
            bool sees;
            if (a == b) continue;
            assert_ok(context, sli_sees(context, &f.outline, f.grid.points[a], f.grid.points[b],
                                        SL_CLOSED, &sees));
            assert_int_equal(has_edge(&f.graph, a, b), sees);
            if (sees && !has_edge(&f.graph, b, a)) {
                assert_true(f.grid.points[a].x >= 2 && f.grid.points[b].x < 2);
                one_way++;
            }
        }
    }
    assert_true(one_way > 10);
    sl_vga_graph turned = {0};
    assert_ok(context, sl_vga_graph_make(context, &f.outline, &f.grid, 0, 2, &turned));
    assert_ok(context, sl_vga_graph_turn(context, &turned));
    assert_true(f.graph.directed && turned.directed && turned.edges == f.graph.edges);
    for (uint32_t a = 0; a < f.grid.count; a++)
        for (uint32_t b = 0; b < f.grid.count; b++)
            assert_int_equal(has_edge(&turned, b, a), has_edge(&f.graph, a, b));
    sl_vga_graph_destroy(context, &turned);
    fixture_destroy(context, &f);
    sl_space_destroy(context, &plain);
    sl_context_destroy(context);
}

/// Means of depths from each point are the measures; a link that shortens nothing changes them only
/// by its one place less.
static void depths_add_up_to_measures(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    make_plan(context, &f);
    const uint32_t n = f.grid.count;
    sl_vga_options options = sl_vga_options_default();
    options.parts = SL_VGA_GLOBAL | SL_VGA_METRIC | SL_VGA_ANGULAR;
    sl_vga_measures *measures = test_calloc(n, sizeof *measures);
    sl_vga_measures *linked = test_calloc(n, sizeof *linked);
    sl_vga_depths *depths = test_calloc(n, sizeof *depths);
    assert_ok(context, sl_vga_measure(context, &f.outline, &f.grid, &f.graph, &options, measures));
    const sl_vga_link link = {0, n - 1}, loop = {3, 3}, outside = {0, n};
    assert_ok(context, sl_vga_measure_linked(context, &f.outline, &f.grid, &f.graph, &link, 1,
                                             &options, linked));
    for (uint32_t from = 0; from < n; from += 7) {
        for (size_t with = 0; with < 2; with++) {
            const sl_vga_measures *m = with ? &linked[from] : &measures[from];
            double steps = 0, length = 0, turn = 0, straight = 0, angle = 0;
            assert_ok(context, sl_vga_depth(context, &f.outline, &f.grid, &f.graph, &link, with,
                                            options.parts, &from, 1, depths));
            for (uint32_t p = 0; p < n - with; p++) {
                steps += depths[p].visual_step_depth;
                length += depths[p].metric_step_shortest_path_length;
                turn += depths[p].metric_step_shortest_path_angle;
                straight += depths[p].metric_straight_line_distance;
                angle += depths[p].angular_step_depth;
            }
            const double count = n - (double)with;
            assert_true(m->visual_node_count == count && m->metric_node_count == count);
            assert_true(fabs(steps / (count - 1) - m->visual_mean_depth) < 1e-12);
            assert_true(fabs(length / count - m->metric_mean_shortest_path_distance) < 1e-9);
            assert_true(fabs(angle / count - m->angular_mean_depth) < 1e-6);
            if (with) {
                assert_true(depths[0].visual_step_depth == depths[n - 1].visual_step_depth);
                assert_true(depths[0].metric_step_shortest_path_length ==
                            depths[n - 1].metric_step_shortest_path_length);
                continue;
            }
            assert_true(fabs(turn / count - m->metric_mean_shortest_path_angle) < 1e-6);
            assert_true(fabs(straight / count - m->metric_mean_straight_line_distance) < 1e-9);
        }
    }
    assert_int_equal(
        sl_vga_measure_linked(context, &f.outline, &f.grid, &f.graph, &loop, 1, &options, linked),
        SL_BAD_ARGUMENT);
    assert_int_equal(sl_vga_measure_linked(context, &f.outline, &f.grid, &f.graph, &outside, 1,
                                           &options, linked),
                     SL_BAD_ARGUMENT);
    test_free(depths);
    test_free(linked);
    test_free(measures);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

static void borders_are_kept(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    make_plan(context, &f);
    const uint32_t before = f.grid.count;
    uint64_t *border = test_calloc(sl_bits_words(before), sizeof *border);
    assert_ok(context, sl_vga_grid_border(context, &f.grid, border));
    sl_vga_grid_keep(&f.grid, border);
    assert_true(f.grid.count > before / 4 && f.grid.count < before * 3 / 4);
    for (uint32_t p = 0; p < f.grid.count; p++)
        assert_int_equal(sl_vga_grid_find(&f.grid, f.grid.points[p]), p);
    assert_int_equal(sl_vga_grid_find(&f.grid, (sl_point){4.5, 2}), UINT32_MAX); // far from walls
    assert_int_equal(sl_vga_grid_find(&f.grid, (sl_point){-9, 2}), UINT32_MAX);
    test_free(border);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

// --- measures that are not defined

static void check_no_value_is_infinite(const sl_vga_measures *m, uint32_t count) {
    const double *values = (const double *)m;
    for (size_t i = 0; i < count * (sizeof *m / sizeof *values); i++)
        assert_false(isinf(values[i]));
}

/// All visual measures of a plan's grid of step 1. One-way glass is as it stands.
static sl_vga_measures *measure_text(sl_context *context, const char *text, fixture *f) {
    sl_space plain = {0};
    const sli_filtered_space filtered = {.one_way = true, .dark_walls = true};
    assert_ok(context, sli_map_read_text(context, "plan", text, strlen(text), &f->map));
    assert_ok(context, sl_map_clean(context, &f->map, NULL, NULL));
    assert_ok(context, sli_subdivide_mesh(context, &f->map, &plain));
    assert_ok(context, sli_filtered_space_make(context, &plain, &filtered, NULL, &f->space));
    sl_space_destroy(context, &plain);
    fill_and_connect(context, 1, f);
    const sl_vga_options options = sl_vga_options_default();
    sl_vga_measures *m = test_calloc(f->grid.count + 1, sizeof *m);
    assert_ok(context, sl_vga_measure(context, &f->outline, &f->grid, &f->graph, &options, m));
    check_no_value_is_infinite(m, f->grid.count);
    return m;
}

/// One point alone is two steps away: Teklenburg's divisor is log(1).
static void a_divisor_of_log_1_gives_no_value(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    sl_vga_measures *m = measure_text(
        context,
        "sightline 1\nwalls 0.75 0.75 2.25 0.75 2.25 2.25 1.75 2.25 1.75 1.25 0.75 1.25 "
        "0.75 0.75\n",
        &f);
    assert_int_equal(f.grid.count, 3);
    size_t undefined = 0;
    for (uint32_t p = 0; p < 3; p++) {
        const bool is_end = m[p].connectivity == 1;
        assert_true(isnan(m[p].visual_integration_tekl));
        assert_int_equal(isnan(m[p].visual_integration_hh), !is_end);
        assert_int_equal(isnan(m[p].visual_integration_pvalue), !is_end);
        undefined += is_end;
    }
    assert_int_equal(undefined, 2);
    test_free(m);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

enum { STAIRS = 150 };

/// Two points of a grid a stair, each of which sees the next one and the one before.
static void write_stairs(char *text, size_t room) {
    size_t n = (size_t)snprintf(text, room, "sightline 1\nwalls -0.25 -0.25");
    for (int i = 1; i <= STAIRS; i++)
        n += (size_t)snprintf(text + n, room - n, " %g %g %g %g", i + 0.25, i - 1.25, i + 0.25,
                              i == STAIRS ? i + 0.25 : i - 0.25);
    for (int i = STAIRS; i >= 1; i--)
        n += (size_t)snprintf(text + n, room - n, " %g %g %g %g", i - 0.25, i + 0.25, i - 0.25,
                              i - 0.75);
    snprintf(text + n, room - n, " -0.25 0.25 -0.25 -0.25\n");
}

/// The factorial of 171 is no double.
static void entropy_of_deep_points_is_a_number(void **state) {
    (void)state;
    static char text[STAIRS * 64];
    sl_context *context = testing_context(NULL);
    fixture f = {0};
    write_stairs(text, sizeof text);
    sl_vga_measures *m = measure_text(context, text, &f);
    const double others = 2 * STAIRS, mean = (others + 1) / 2;
    double relative = 0;
    assert_int_equal(f.grid.count, 2 * STAIRS + 1);
    for (int k = 1; k <= 2 * STAIRS; k++)
        relative += (-log(others) - k * log(mean) + lgamma(k + 2) + mean) / others / log(2);
    assert_true(fabs(m[0].visual_mean_depth - mean) < 1e-12 * mean);
    assert_true(fabs(m[0].visual_relativised_entropy - relative) < 1e-9 * relative);
    for (uint32_t p = 0; p < f.grid.count; p++)
        assert_true(isfinite(m[p].visual_relativised_entropy));
    test_free(m);
    fixture_destroy(context, &f);
    sl_context_destroy(context);
}

/// The last point on the left sees nothing, and is seen through the glass.
static void neighbours_that_see_nothing_control_nothing(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int count = 2; count <= 3; count++) {
        char text[120];
        fixture f = {0};
        snprintf(text, sizeof text,
                 "sightline 1\nwalls 0.75 0.75 %d.25 0.75 %d.25 1.25 0.75 1.25 0.75 0.75\n"
                 "oneway 1.5 0.75 1.5 1.25\n",
                 count, count);
        sl_vga_measures *m = measure_text(context, text, &f);
        assert_int_equal(f.grid.count, count);
        assert_true(m[0].connectivity == 0 && m[1].connectivity == count - 1);
        assert_true(isnan(m[0].visual_control) && isnan(m[0].visual_controllability));
        assert_true(isnan(m[1].visual_control));
        assert_int_equal(isnan(m[1].visual_controllability), count == 2);
        test_free(m);
        fixture_destroy(context, &f);
    }
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_those_of_single_sightlines),
        cmocka_unit_test(rows_are_read_as_written),
        cmocka_unit_test(joined_graphs_keep_their_pairs),
        cmocka_unit_test(parts_are_those_of_all_pairs),
        cmocka_unit_test(small_parts_do_not_set_the_scale),
        cmocka_unit_test(oblique_pairs_too),
        cmocka_unit_test(measures_are_those_of_brute_force),
        cmocka_unit_test(depths_are_those_of_plain_searches),
        cmocka_unit_test(searches_are_those_of_plain_ones),
        cmocka_unit_test(lists_do_not_change_paths),
        cmocka_unit_test(paths_lead_through_glass_one_way),
        cmocka_unit_test(seeds_stay_in_their_room),
        cmocka_unit_test(glass_is_seen_through_one_way),
        cmocka_unit_test(depths_add_up_to_measures),
        cmocka_unit_test(borders_are_kept),
        cmocka_unit_test(a_divisor_of_log_1_gives_no_value),
        cmocka_unit_test(entropy_of_deep_points_is_a_number),
        cmocka_unit_test(neighbours_that_see_nothing_control_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
