/// Segments made a planar graph, against rationals: no two edges meet but in common ends, chains
/// join what their segments did and do not stray, and the order of the input counts for nothing.
#include "testing.h"

#include "map/planar.h"
#include "oracle/planar_graph.h"
#include "oracle/random_oblique.h"
#include "sightline/generate.h"

#include <math.h>

typedef struct bundle {
    sl_segment *items;
    size_t count, room;
} bundle;

static void add(bundle *b, sl_point from, sl_point to) {
    if (b->count == b->room) {
        b->room = b->room ? 2 * b->room : 64;
        b->items = realloc(b->items, b->room * sizeof *b->items);
        assert_non_null(b->items);
    }
    b->items[b->count++] = (sl_segment){from, to};
}

static void turn(bundle *b, double degrees, double move) {
    for (size_t i = 0; i < b->count; i++) oblique_turn_segment(&b->items[i], degrees, move);
}

static double usable(double value) {
    return fabs(value) < SL_COORDINATE_MIN ? 0 : value;
}

static sl_point noisy(sl_random *random, sl_point p, double noise) {
    return (sl_point){usable(p.x + noise * (2 * sl_random_unit(random) - 1)),
                      usable(p.y + noise * (2 * sl_random_unit(random) - 1))};
}

static void add_noise(bundle *b, uint64_t seed, double noise) {
    sl_random random = {seed};
    for (size_t i = 0; i < b->count; i++)
        b->items[i] = (sl_segment){noisy(&random, b->items[i].a, noise),
                                   noisy(&random, b->items[i].b, noise)};
}

static double tolerance_of(const bundle *b) {
    sl_box box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (size_t i = 0; i < b->count; i++) {
        const sl_segment s = b->items[i];
        box.min.x = fmin(box.min.x, fmin(s.a.x, s.b.x));
        box.min.y = fmin(box.min.y, fmin(s.a.y, s.b.y));
        box.max.x = fmax(box.max.x, fmax(s.a.x, s.b.x));
        box.max.y = fmax(box.max.y, fmax(s.a.y, s.b.y));
    }
    return sli_planar_tolerance(&box);
}

// --- the same for all orders

/// Whether the chain of a segment is that of another graph, turned round or not.
static bool same_chain(const sli_planar *a, size_t i, const sli_planar *b, size_t k,
                       bool reversed) {
    const size_t count = a->first[i + 1] - a->first[i];
    if (b->first[k + 1] - b->first[k] != count) return false;
    for (size_t n = 0; n < count; n++) {
        const sl_segment s = sli_planar_at(a, a->links[a->first[i] + n]);
        const sli_planar_link link = b->links[b->first[k] + (reversed ? count - 1 - n : n)];
        const sl_segment t = sli_planar_at(b, link ^ reversed);
        if (!testing_same_point(s.a, t.a) || !testing_same_point(s.b, t.b)) return false;
    }
    return true;
}

static void check_order(sl_context *context, const char *name, const bundle *b, double weld,
                        const sli_planar *expected) {
    sl_random random = {b->count};
    sl_segment *shuffled = malloc((b->count + 1) * sizeof *shuffled);
    size_t *from = malloc((b->count + 1) * sizeof *from);
    bool *reversed = malloc((b->count + 1) * sizeof *reversed);
    assert_true(shuffled && from && reversed);
    for (size_t i = 0; i < b->count; i++) from[i] = i;
    for (size_t i = b->count; i > 1; i--) {
        const size_t k = (size_t)sl_random_below(&random, i), kept = from[k];
        from[k] = from[i - 1];
        from[i - 1] = kept;
    }
    for (size_t i = 0; i < b->count; i++) {
        const sl_segment s = b->items[from[i]];
        reversed[i] = sl_random_below(&random, 2);
        shuffled[i] = reversed[i] ? (sl_segment){s.b, s.a} : s;
    }
    sli_planar graph = {0};
    assert_ok(context, sli_planar_make(context, name, shuffled, b->count, weld, &graph));
    assert_int_equal(graph.point_count, expected->point_count);
    if (graph.point_count)
        assert_memory_equal(graph.points, expected->points,
                            graph.point_count * sizeof *graph.points);
    assert_int_equal(graph.edge_count, expected->edge_count);
    if (graph.edge_count)
        assert_memory_equal(graph.edges, expected->edges, graph.edge_count * sizeof *graph.edges);
    assert_true(graph.welded == expected->welded && graph.crossings == expected->crossings);
    assert_true(graph.largest_move == expected->largest_move);
    for (size_t i = 0; i < b->count; i++)
        if (!same_chain(expected, from[i], &graph, i, reversed[i]))
            fail_msg("%s: the chain of segment %zu depends on the order", name, from[i]);
    sli_planar_destroy(context, &graph);
    free(shuffled);
    free(from);
    free(reversed);
}

// --- all checks of one bundle

typedef struct outcome {
    size_t points, crossings, welded;
    double move;
    bool refused;
} outcome;

static outcome check_with(const char *name, const bundle *b, double weld) {
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    sli_planar graph = {0};
    char why[ORACLE_WHY];
    outcome found = {0};
    const sl_status status = sli_planar_make(context, name, b->items, b->count, weld, &graph);
    if (status == SL_UNSUPPORTED) {
        assert_non_null(strstr(sl_context_message(context), "larger tolerance"));
        assert_null(graph.points);
        found.refused = true;
    } else {
        assert_ok(context, status);
        if (!oracle_is_graph_of(&graph, b->items, b->count, weld, why))
            fail_msg("%s, tolerance %g: %s", name, weld, why);
        check_order(context, name, b, weld, &graph);
        found = (outcome){graph.point_count, graph.crossings, graph.welded, graph.largest_move, 0};
    }
    sli_planar_destroy(context, &graph);
    sl_context_destroy(context);
    assert_int_equal(memory.live, 0);
    return found;
}

/// With the tolerance of doubles, and larger ones, it is never refused.
static outcome check_all(const char *name, const bundle *b) {
    const double usual = tolerance_of(b), size = usual * 0x1p46;
    const double welds[] = {0, usual, 1e-9 * size, 1e-3 * size, 0.02 * size};
    outcome found = {0};
    for (size_t i = 0; i < sizeof welds / sizeof *welds; i++) {
        const outcome now = check_with(name, b, welds[i]);
        if (now.refused && i) fail_msg("%s is refused with tolerance %g", name, welds[i]);
        if (i == 1) found = now;
    }
    return found;
}

static void release(bundle *b) {
    free(b->items);
    *b = (bundle){0};
}

// --- bundles

static bundle city(uint64_t walls) {
    sl_context *context = testing_context(NULL);
    size_t count;
    const sl_map_kind *kind = sl_map_kinds(&count);
    while (strcmp(kind->name, "city") != 0) kind++;
    sl_generate_options how = sl_generate_options_default();
    how.walls = walls;
    sl_map map = {0};
    bundle b = {0};
    assert_ok(context, sl_generate(context, kind, &how, &map));
    for (size_t i = 0; i < map.wall_count; i++) add(&b, map.walls[i].a, map.walls[i].b);
    sl_map_destroy(context, &map);
    sl_context_destroy(context);
    return b;
}

/// Long walls, and short ones that end on them: not one of them is cut yet.
static bundle t_junctions(int size) {
    bundle b = {0};
    for (int i = 0; i <= size; i++) add(&b, (sl_point){0, i}, (sl_point){size, i});
    for (int i = 0; i < size; i++)
        for (int k = 0; k < size; k++) {
            const double x = k + 0.1 * (1 + (3 * i + 7 * k) % 9);
            add(&b, (sl_point){x, i}, (sl_point){x, i + 1});
        }
    return b;
}

static bundle star(int count, double radius) {
    bundle b = {0};
    for (int i = 0; i < count; i++) {
        const double angle = acos(-1) * (i + 0.5) / count, x = radius * cos(angle),
                     y = radius * sin(angle);
        add(&b, (sl_point){x, y}, (sl_point){-x, -y});
    }
    return b;
}

/// Lines that run beside each other at a few steps of doubles, and cross at all angles of that.
static bundle near_parallel(int count, uint64_t seed, double step) {
    bundle b = {0};
    sl_random random = {seed};
    for (int i = 0; i < count; i++) {
        const double from = (double)sl_random_below(&random, 40) * step;
        const double to = (double)sl_random_below(&random, 40) * step;
        const double left = 0.4 * sl_random_unit(&random),
                     right = 1 - 0.4 * sl_random_unit(&random);
        add(&b, (sl_point){left, 1 + from}, (sl_point){right, 1 + to});
    }
    return b;
}

/// On one line of the direction 3, 2: exactly, overlapping, touching, apart, twice and without
/// length.
static bundle collinear(int count, uint64_t seed) {
    bundle b = {0};
    sl_random random = {seed};
    for (int i = 0; i < count; i++) {
        const double from = (double)sl_random_below(&random, 60),
                     to = (double)sl_random_below(&random, 60);
        const double row = (double)sl_random_below(&random, 3);
        add(&b, (sl_point){3 * from, 2 * from + row}, (sl_point){3 * to, 2 * to + row});
        if (i % 5 == 0)
            add(&b, (sl_point){3 * to, 2 * to + row}, (sl_point){3 * from, 2 * from + row});
        if (i % 7 == 0) add(&b, (sl_point){3 * to, 2 * to + row}, (sl_point){3 * to, 2 * to + row});
    }
    return b;
}

static bundle anywhere(int count, uint64_t seed) {
    bundle b = {0};
    sl_random random = {seed};
    for (int i = 0; i < count; i++) {
        double v[4];
        for (int k = 0; k < 4; k++) v[k] = 100 * sl_random_unit(&random);
        add(&b, (sl_point){v[0], v[1]}, (sl_point){v[2], v[3]});
    }
    return b;
}

// --- tests

static void nothing_gives_nothing(void **state) {
    (void)state;
    const bundle none = {0};
    const outcome found = check_with("nothing", &none, 0);
    assert_int_equal(found.points, 0);
    bundle dot = {0};
    add(&dot, (sl_point){3, 4}, (sl_point){3, 4});
    assert_int_equal(check_with("a point", &dot, 0).points, 0);
    release(&dot);
}

/// Without welds and crossings that are rounded nothing moves.
static void what_is_planar_stays(void **state) {
    (void)state;
    bundle b = city(600);
    const outcome found = check_with("city", &b, 0);
    assert_true(found.crossings == 0 && found.welded == 0 && found.move == 0);
    release(&b);
}

static void turned_cities(void **state) {
    (void)state;
    const double angles[] = {17.3, 33, 45, 0.001, 89.9};
    const double shifts[] = {0, 1e6, 1e15 / 8};
    for (size_t a = 0; a < sizeof angles / sizeof *angles; a++) {
        bundle b = city(200);
        turn(&b, angles[a], shifts[a % 3]);
        check_all("turned city", &b);
        release(&b);
    }
}

static void junctions(void **state) {
    (void)state;
    const double angles[] = {0, 17.3, 45, 0.001};
    for (size_t a = 0; a < sizeof angles / sizeof *angles; a++) {
        bundle b = t_junctions(16);
        turn(&b, angles[a], a % 2 ? 1e6 : 0);
        const outcome found = check_all("junctions", &b);
        // Each short wall ends on two long ones, which are welded to it; none crosses through.
        assert_int_equal(found.crossings, 0);
        release(&b);
    }
}

static void many_through_one_point(void **state) {
    (void)state;
    bundle b = star(1000, 10);
    const outcome found = check_with("star", &b, tolerance_of(&b));
    assert_int_equal(found.crossings, 1);
    release(&b);
    for (int far = 0; far < 3; far++) {
        b = star(120, 10);
        turn(&b, 10, far ? (far == 1 ? 1e6 : 1e15) : 0);
        check_all("small star", &b);
        release(&b);
    }
}

static void near_parallel_bundles(void **state) {
    (void)state;
    const double steps[] = {0x1p-52, 0x1p-50, 0x1p-46, 0x1p-44, 1e-9};
    for (size_t s = 0; s < sizeof steps / sizeof *steps; s++)
        for (uint64_t seed = 1; seed <= 2; seed++) {
            bundle b = near_parallel(40, seed, steps[s]);
            check_all("near parallel", &b);
            turn(&b, 33, 0);
            check_all("near parallel, turned", &b);
            release(&b);
        }
}

static void collinear_ones(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        bundle b = collinear(60, seed);
        const outcome exact = check_with("collinear", &b, 0);
        assert_true(exact.crossings == 0 && exact.move == 0);
        check_all("collinear", &b);
        turn(&b, 17.3, seed % 2 ? 1e6 : 0);
        check_all("collinear, turned", &b);
        release(&b);
    }
}

static void of_all_magnitudes(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (int grid = 0; grid < OBLIQUE_GRIDS; grid++)
        for (uint64_t seed = 1; seed <= 25; seed++) {
            sl_map map = {0};
            bundle b = {0};
            char name[64];
            snprintf(name, sizeof name, "grid %d, seed %d", grid, (int)seed);
            assert_ok(context, oblique_random_map(context, seed, (oblique_grid)grid, 24, &map));
            for (size_t i = 0; i < map.wall_count; i++) add(&b, map.walls[i].a, map.walls[i].b);
            check_all(name, &b);
            release(&b);
            sl_map_destroy(context, &map);
        }
    sl_context_destroy(context);
}

/// Noise as large as the tolerance: what comes near is welded, which leads to more that comes near.
static void noise_of_the_tolerance(void **state) {
    (void)state;
    const double shares[] = {0.5, 1, 3};
    for (size_t s = 0; s < sizeof shares / sizeof *shares; s++)
        for (int kind = 0; kind < 3; kind++) {
            const double welds[] = {0, 1e-9, 1e-3, 0.3};
            for (size_t w = 0; w < sizeof welds / sizeof *welds; w++) {
                bundle b = kind == 0 ? city(200) : kind == 1 ? t_junctions(10) : star(60, 20);
                turn(&b, 17.3, 0);
                const double weld = welds[w] > 0 ? welds[w] : tolerance_of(&b);
                add_noise(&b, s + 1, shares[s] * weld);
                if (check_with("noise", &b, weld).refused) fail_msg("noise of %g is refused", weld);
                release(&b);
            }
        }
}

static void hundreds_that_all_cross(void **state) {
    (void)state;
    bundle b = anywhere(120, 5);
    const outcome found = check_with("anywhere", &b, tolerance_of(&b));
    assert_true(found.crossings > 1000);
    check_with("anywhere", &b, 0);
    turn(&b, 0, 1e6);
    check_with("anywhere, far", &b, tolerance_of(&b));
    release(&b);
    b = anywhere(60, 6);
    check_all("anywhere", &b);
    release(&b);
}

static void memory_may_fail_at_any_call(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    bundle b = anywhere(12, 7);
    sl_status status = SL_NO_MEMORY;
    const long before = memory.live;
    for (long at = 1; status == SL_NO_MEMORY; at++) {
        sli_planar graph = {0};
        memory.calls = 0;
        memory.fail_at = at;
        status = sli_planar_make(context, "memory", b.items, b.count, 1e-6, &graph);
        sli_planar_destroy(context, &graph);
        assert_int_equal(memory.live, before);
    }
    assert_int_equal(status, SL_OK);
    release(&b);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_gives_nothing),
        cmocka_unit_test(what_is_planar_stays),
        cmocka_unit_test(turned_cities),
        cmocka_unit_test(junctions),
        cmocka_unit_test(many_through_one_point),
        cmocka_unit_test(near_parallel_bundles),
        cmocka_unit_test(collinear_ones),
        cmocka_unit_test(of_all_magnitudes),
        cmocka_unit_test(noise_of_the_tolerance),
        cmocka_unit_test(hundreds_that_all_cross),
        cmocka_unit_test(memory_may_fail_at_any_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
