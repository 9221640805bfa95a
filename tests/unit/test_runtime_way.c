/// The runtime's shortest ways: by hand, against the library's on random maps and those of maps/,
/// and with as little memory as there may be.
#include "runtime_maps.h"

#include "oracle/random_effects.h"
#include "route_plan.h"
#include "sightline/bake.h"

enum { NODES = 1 << 14, POINTS = 256, DOORS_MOST = 8 };

/// A level, and the library's finder over the same cells. `p.space` is the baked file's.
typedef struct level {
    plan p;
    baked_file file;
    unsigned char shut[DOORS_MOST];
    uint32_t *scratch;
    double points[2 * POINTS];
    sl_runtime_way way;
} level;

static void open_level(level *l) {
    const sl_runtime *r = &l->file.runtime;
    const size_t size = sl_runtime_way_scratch_count(r, NODES);
    l->p.context = l->p.context ? l->p.context : testing_context(NULL);
    l->p.space = l->file.baked.space;
    assert_ok(l->p.context, sl_query_create(l->p.context, &l->file.baked, &l->p.query));
    assert_ok(l->p.context, sl_route_finder_create(l->p.context, l->p.query, &l->p.finder));
    l->scratch = malloc(size * sizeof *l->scratch);
    assert_non_null(l->scratch);
    memset(l->scratch, 0xa5, size * sizeof *l->scratch);
    assert_true(r->door_count <= DOORS_MOST);
    for (uint32_t i = 0; i < r->door_count; i++) l->shut[i] = !sl_runtime_door_open(r, i);
}

/// Bakes a map, which it takes over.
static void bake_level(level *l, sl_context *context, sl_map *map) {
    l->p.context = context;
    l->file = (baked_file){.name = "random"};
    assert_ok(context, sl_bake(context, map, NULL, &l->file.baked, NULL));
    l->file.bytes = baked_bytes(context, &l->file.baked, &l->file.size);
    baked_file_open(&l->file);
    open_level(l);
}

static void close_level(level *l) {
    free(l->scratch);
    sl_route_destroy(l->p.context, &l->p.route);
    sl_route_finder_destroy(l->p.context, l->p.finder);
    sl_query_destroy(l->p.context, l->p.query);
    baked_file_destroy(l->p.context, &l->file);
    sl_context_destroy(l->p.context);
}

static void text_level(level *l, const char *statements) {
    *l = (level){.p.context = testing_context(NULL)};
    l->file = baked_file_of_text(l->p.context, statements);
    open_level(l);
}

static void set_door(level *l, uint32_t door, bool shut) {
    l->shut[door] = shut;
    sl_query_set_door_at(l->p.context, l->p.query, door, !shut);
}

static sl_runtime_way_status ask(level *l, sl_point a, sl_point b) {
    return sl_runtime_find_way(&l->file.runtime, a.x, a.y, b.x, b.y, l->shut, l->scratch, NODES,
                               l->points, POINTS, &l->way);
}

/// The length; INFINITY for no way.
static double length(level *l, double x0, double y0, double x1, double y1) {
    const sl_runtime_way_status status = ask(l, (sl_point){x0, y0}, (sl_point){x1, y1});
    if (status != SL_RUNTIME_WAY_FOUND) {
        assert_int_equal(status, SL_RUNTIME_WAY_NONE);
        assert_true(l->way.count == 0 && l->way.length == 0);
    }
    return status == SL_RUNTIME_WAY_FOUND ? l->way.length : (double)INFINITY;
}

// --- by hand

static const char room[] = "walls 0 0 10 0 10 10 0 10 0 0\n";

static void boxed(level *l, const char *more) {
    char text[512];
    snprintf(text, sizeof text, "%s%s", room, more);
    text_level(l, text);
}

static void test_straight_and_around(void **state) {
    (void)state;
    level l;
    boxed(&l, "wall 5 0 5 6\n");
    assert_true(length(&l, 1, 8, 9, 8) == 8 && l.way.count == 2);
    assert_true(length(&l, 2, 2, 8, 2) == 10 && l.way.count == 3); // two triangles of 3, 4, 5
    assert_true(l.points[2] == 5 && l.points[3] == 6);
    assert_true(length(&l, 3, 3, 3, 3) == 0 && l.way.count == 2);
    assert_true(l.points[2] == 3 && l.points[3] == 3);
    assert_true(length(&l, 5, 6, 5, 9) == 3); // along walls, and from a wall's end
    assert_true(length(&l, 5, 6, 2, 2) == 5 && length(&l, 5, 6, 8, 2) == 5);
    assert_true(length(&l, 0, 0, 0, 10) == 10);
    close_level(&l);
}

static void test_touching_walls_are_closed(void **state) {
    (void)state;
    level l;
    boxed(&l, "wall 0 1 5 5\nwall 5 5 10 9\n");
    assert_true(isinf(length(&l, 3, 8, 8, 3)));
    close_level(&l);
    boxed(&l, "wall 0 5 5 5\nwall 5.000000000000001 5 10 5\n");
    assert_true(length(&l, 5, 8, 5, 2) < 6 + 1e-12);
    close_level(&l);
    boxed(&l, "wall 5 0 5 10\nwall 0 5 10 5\n");
    assert_true(isinf(length(&l, 4, 4, 6, 6)));
    close_level(&l);
    // The corner of two blocks is passed around, not through.
    boxed(&l, "walls 2 2 5 2 5 5 2 5 2 2\nwalls 5 5 8 5 8 8 5 8 5 5\n");
    assert_true(length(&l, 4, 6, 6, 4) > 8);
    close_level(&l);
}

static void test_doors_and_glass(void **state) {
    (void)state;
    level l;
    boxed(&l, "wall 5 0 5 4\nwall 5 6 5 10\ndoor front 5 4 5 6 open\n");
    for (int i = 0; i < 3; i++) {
        l.shut[0] = i == 1;
        assert_true(i == 1 ? isinf(length(&l, 1, 5, 9, 5)) : length(&l, 1, 5, 9, 5) == 8);
    }
    close_level(&l);
    boxed(&l, "wall 5 0 5 4\nwall 5 6 5 8\noneway 5 4 5 6\n");
    const double over = length(&l, 1, 5, 9, 5), back = length(&l, 9, 5, 1, 5);
    assert_true(fmin(over, back) == 8 && fmax(over, back) == 10);
    close_level(&l);
}

/// Windows stop who walks, curtains do not; a shut door in a curtain does.
static void test_windows_and_curtains(void **state) {
    (void)state;
    level l;
    boxed(&l, "wall 5 0 5 6 stops steps\nwall 7 4 7 10 stops sight\n");
    assert_true(length(&l, 2, 2, 8, 2) == 10 && l.way.count == 3);
    assert_true(length(&l, 6, 8, 9, 8) == 3 && l.way.count == 2);
    close_level(&l);
    boxed(&l, "wall 5 0 5 10 stops sight\ndoor front 5 4 5 6 open\n");
    assert_true(length(&l, 2, 5, 8, 5) == 6);
    set_door(&l, 0, true);
    assert_true(fabs(length(&l, 2, 5, 8, 5) - 2 * hypot(3, 1)) < 1e-14 && l.way.count == 3);
    close_level(&l);
}

static void test_no_place(void **state) {
    (void)state;
    level l;
    boxed(&l, "");
    const sl_point in = {1, 1}, outside[] = {{11, 1}, {NAN, 1}, {1, -INFINITY}};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(ask(&l, in, outside[i]), SL_RUNTIME_WAY_NO_PLACE);
        assert_int_equal(ask(&l, outside[i], in), SL_RUNTIME_WAY_NO_PLACE);
    }
    close_level(&l);
}

// --- little memory

/// As many nodes as are needed and no fewer; as much room as is needed; nothing half-written.
static void check_memory(level *l, sl_point a, sl_point b) {
    const sl_runtime *r = &l->file.runtime;
    const uint32_t count = l->way.count;
    const double expected = l->way.length;
    double *points = malloc(2 * count * sizeof *points), none = -7;
    assert_non_null(points);
    bool found = false;
    for (uint32_t nodes = 0; !found; nodes += 1 + nodes / 8) {
        sl_runtime_way way = {99, 99};
        uint32_t *scratch = malloc(sl_runtime_way_scratch_count(r, nodes) * sizeof *scratch);
        assert_non_null(scratch);
        for (uint32_t i = 0; i < 2 * count; i++) points[i] = none;
        const sl_runtime_way_status status = sl_runtime_find_way(
            r, a.x, a.y, b.x, b.y, l->shut, scratch, nodes, points, count, &way);
        found = status == SL_RUNTIME_WAY_FOUND;
        assert_true(found || status == SL_RUNTIME_WAY_NODES);
        assert_true(found ? way.count == count && way.length == expected
                          : way.count == 0 && way.length == 0);
        if (found) assert_memory_equal(points, l->points, 2 * count * sizeof *points);
        for (uint32_t i = 0; i < 2 * count && !found; i++) assert_true(points[i] == none);
        for (uint32_t i = 0; i < count && found; i++) {
            points[0] = points[2 * count - 1] = none;
            assert_int_equal(sl_runtime_find_way(r, a.x, a.y, b.x, b.y, l->shut, scratch, nodes,
                                                 i ? points : NULL, i, &way),
                             SL_RUNTIME_WAY_ROOM);
            assert_true(way.count == count && points[0] == none && points[2 * count - 1] == none);
        }
        free(scratch);
    }
    free(points);
}

static void test_memory(void **state) {
    (void)state;
    level l;
    boxed(&l, "wall 5 0 5 6\nwall 3 4 2 9\nwall 7 3 7 10\n");
    assert_true(length(&l, 1, 5, 9, 9) > 8 && l.way.count > 3);
    check_memory(&l, (sl_point){1, 5}, (sl_point){9, 9});
    assert_true(length(&l, 3, 3, 3, 3) == 0);
    check_memory(&l, (sl_point){3, 3}, (sl_point){3, 3});
    close_level(&l);
}

// --- against the library

static size_t all_found, all_none, all_same;

/// A way against the library's in the same cells, and against all walls where they are few.
static void check_way(level *l, const barrier *b, sl_point from, sl_point to, uint64_t seed) {
    const double expected = way(&l->p, from.x, from.y, to.x, to.y);
    const double is = length(l, from.x, from.y, to.x, to.y);
    const sl_route *route = &l->p.route;
    if (isinf(is) != isinf(expected) ||
        (!isinf(is) && fabs(is - expected) > 0x1p-40 * (double)(route->count - 1) * expected))
        fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: %.17g, by the library %.17g",
                 (unsigned long long)seed, from.x, from.y, to.x, to.y, is, expected);
    all_found += !isinf(is);
    all_none += isinf(is);
    if (isinf(is)) return;
    sl_point points[POINTS];
    for (uint32_t i = 0; i < l->way.count; i++)
        points[i] = (sl_point){l->points[2 * i], l->points[2 * i + 1]};
    assert_true(testing_same_point(points[0], from));
    assert_true(testing_same_point(points[l->way.count - 1], to));
    const bool same = l->way.count == route->count &&
                      memcmp(points, route->points, route->count * sizeof *points) == 0;
    all_same += same;
    const walk_end start = stand(&l->p, from), goal = stand(&l->p, to);
    if (b->count > ORACLE_WALLS || !is_clear(&l->p, start) || !is_clear(&l->p, goal)) return;
    if (!oracle_can_walk(b->walls, b->count, start, goal, points, l->way.count))
        fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: the way is blocked",
                 (unsigned long long)seed, from.x, from.y, to.x, to.y);
}

static void check_level(level *l, uint64_t seed, int pairs, bool one_way) {
    static barrier b;
    sl_random random = {seed};
    for (uint32_t i = 0; i < l->file.runtime.door_count; i++)
        set_door(l, i, sl_random_below(&random, 2));
    assert_ok(l->p.context, sl_route_finder_update(l->p.context, l->p.finder));
    find_barrier(&l->p, &b);
    if (one_way) b.count = WALLS_MOST; // glass is a wall for one side only
    for (int i = 0; i < pairs; i++) {
        const sl_point from = random_place(&random, &l->p), to = random_place(&random, &l->p);
        const uint32_t start = sl_space_locate(&l->p.space, from),
                       goal = sl_space_locate(&l->p.space, to);
        if (start == SL_NO_CELL || goal == SL_NO_CELL || l->p.space.cells[start].solid ||
            l->p.space.cells[goal].solid)
            continue;
        check_way(l, &b, from, to, seed);
        if (i == 0 && seed % 8 == 0 && l->way.count) check_memory(l, from, to);
    }
    close_level(l);
}

static void check_plan(plan *p, uint64_t seed) {
    static level l;
    l = (level){0};
    bake_level(&l, p->context, &p->map);
    check_level(&l, seed, 8, false);
}

static void begin_count(void) {
    all_found = all_none = all_same = 0;
}

static void end_count(void) {
    print_message("%zu ways, %zu of them with the same points; %zu times none\n", all_found,
                  all_same, all_none);
    assert_true(all_found > 100 && all_none && all_same > all_found * 99 / 100);
}

static void test_axial(void **state) {
    (void)state;
    begin_count();
    each_axial_plan(testing_seeds(150), check_plan);
    end_count();
}

static void test_turned(void **state) {
    (void)state;
    begin_count();
    each_turned_plan(testing_seeds(120), check_plan);
    end_count();
}

static void test_oblique(void **state) {
    (void)state;
    begin_count();
    each_oblique_plan(testing_seeds(300), check_plan);
    end_count();
}

static void test_effects(void **state) {
    (void)state;
    begin_count();
    for (uint64_t seed = 0, count = testing_seeds(200); seed < count; seed++) {
        static level l;
        sl_map map = {0};
        sl_random random = {seed};
        sl_context *context = testing_context(NULL);
        random_effects_map(context, &random,
                           SL_EFFECT_DOOR | SL_EFFECT_ONEWAY | (seed % 2 ? SL_EFFECT_MIRROR : 0), 1,
                           &map);
        l = (level){0};
        bake_level(&l, context, &map);
        check_level(&l, seed, 10, true);
    }
    end_count();
}

static void test_maps(void **state) {
    (void)state;
    static const char *const names[] = {"office", "pillars", "maze", "oblique/chapel",
                                        "oblique/star"};
    begin_count();
    for (uint64_t i = 0; i < 10; i++) {
        static level l;
        l = (level){.p.context = testing_context(NULL)};
        l.file = baked_file_turned(l.p.context, names[i % 5], i < 5 ? 0 : 17.3, i < 5 ? 0 : 1e6);
        open_level(&l);
        check_level(&l, i, 40, false);
    }
    assert_true(all_found > 100);
    // In the chapel two ways have the same pieces in another order, and rounded sums that differ.
    assert_true(all_same + 1 >= all_found);
}

// --- walls that stop some of sight, steps and sound

/// A bake for sight or for sound against the library in the cells for steps.
static void check_stops(uint64_t seed) {
    static level l;
    sl_random random = {seed};
    sl_map map = {0}, raw = {0};
    sl_baked steps = {0};
    sl_query *query;
    sl_context *context = testing_context(NULL);
    plan p = {.context = context};
    if (seed % 2)
        assert_ok(context, oracle_random_map(context, seed, ORACLE_GRID_INTEGER, &raw));
    else
        assert_ok(context, oblique_random_map(context, seed, OBLIQUE_SQUARES, 16, &raw));
    for (size_t i = 0; i < raw.wall_count; i++) {
        const size_t first = map.wall_count;
        assert_ok(context, sl_map_add_wall(context, &map, raw.walls[i].a, raw.walls[i].b, 0));
        const uint32_t some = !i || sl_random_below(&random, 2)
                                  ? SL_STOPS_ALL
                                  : 1 + (uint32_t)sl_random_below(&random, 6);
        assert_ok(context, sl_map_walls_stop(context, &map, first, some));
    }
    sl_map_destroy(context, &raw);
    assert_ok(context, sl_map_copy(context, &map, &raw));
    raw.channel = SL_STOPS_STEPS;
    map.channel = seed % 3 ? SL_STOPS_SIGHT : SL_STOPS_SOUND;
    assert_ok(context, sl_bake_cells(context, &raw, NULL, &steps));
    assert_ok(context, sl_query_create(context, &steps, &query));
    assert_ok(context, sl_route_finder_create(context, query, &p.finder));
    l = (level){0};
    bake_level(&l, context, &map);
    const sl_box b = l.p.space.bounds;
    for (int i = 0; i < 12; i++) {
        sl_point at[2];
        bool clear = true;
        for (int k = 0; k < 2; k++) {
            at[k] = (sl_point){b.min.x + sl_random_unit(&random) * (b.max.x - b.min.x),
                               b.min.y + sl_random_unit(&random) * (b.max.y - b.min.y)};
            clear &= sl_runtime_can_walk(&l.file.runtime, at[k].x, at[k].y, at[k].x, at[k].y, NULL);
        }
        if (!clear) continue;
        const double is = length(&l, at[0].x, at[0].y, at[1].x, at[1].y),
                     expected = way(&p, at[0].x, at[0].y, at[1].x, at[1].y);
        if (isinf(is) != isinf(expected) || (!isinf(is) && fabs(is - expected) > 1e-11 * expected))
            fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: %.17g, by the library %.17g",
                     (unsigned long long)seed, at[0].x, at[0].y, at[1].x, at[1].y, is, expected);
        all_found += !isinf(is);
        all_none += isinf(is);
        all_same += l.file.runtime.passage_count > 0 && l.way.count > 2;
    }
    sl_route_destroy(context, &p.route);
    sl_route_finder_destroy(context, p.finder);
    sl_query_destroy(context, query);
    sl_baked_destroy(context, &steps);
    close_level(&l);
}

static void test_stops(void **state) {
    (void)state;
    begin_count();
    for (uint64_t seed = 1, count = testing_seeds(200); seed <= count; seed++) check_stops(seed);
    print_message("%zu ways, %zu of them turn where curtains are; %zu times none\n", all_found,
                  all_same, all_none);
    assert_true(all_found > 100 && all_none && all_same > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_straight_and_around),
        cmocka_unit_test(test_touching_walls_are_closed),
        cmocka_unit_test(test_doors_and_glass),
        cmocka_unit_test(test_windows_and_curtains),
        cmocka_unit_test(test_no_place),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_axial),
        cmocka_unit_test(test_turned),
        cmocka_unit_test(test_oblique),
        cmocka_unit_test(test_effects),
        cmocka_unit_test(test_maps),
        cmocka_unit_test(test_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
