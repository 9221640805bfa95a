/// Shortest ways: by hand where walls touch, and on random maps against a graph of all corners.
#include "testing.h"

#include "oracle/random_effects.h"
#include "route_plan.h"
#include "space/index.h"

// --- by hand

static const char box[] =
    "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n";

static void boxed(plan *p, const char *more) {
    char text[1024];
    snprintf(text, sizeof text, "%s%s", box, more);
    read_plan(p, text);
}

static void test_straight_and_around(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 5 0 5 6\n");
    assert_true(way(&p, 1, 8, 9, 8) == 8);
    assert_int_equal(p.route.count, 2);
    assert_true(way(&p, 2, 2, 8, 2) == 10); // two triangles of 3, 4, 5
    assert_int_equal(p.route.count, 3);
    assert_true(p.route.points[1].x == 5 && p.route.points[1].y == 6);
    assert_true(way(&p, 3, 3, 3, 3) == 0);
    assert_int_equal(p.route.count, 2);
    close_plan(&p);
}

/// A way along both faces of a wall, and from a wall's end.
static void test_along_walls(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 5 0 5 6\n");
    assert_true(way(&p, 5, 6, 5, 9) == 3);
    assert_true(way(&p, 5, 6, 2, 2) == 5 && way(&p, 5, 6, 8, 2) == 5);
    assert_true(way(&p, 0, 0, 0, 10) == 10);
    assert_true(way(&p, 10, 0, 5, 6) == hypot(5, 6));
    close_plan(&p);
}

static void test_touching_walls_are_closed(void **state) {
    (void)state;
    // Two oblique walls whose ends meet in 5,5, and two that leave a gap of a step of doubles.
    plan p;
    boxed(&p, "wall 0 1 5 5\nwall 5 5 10 9\n");
    assert_true(isinf(way(&p, 3, 8, 8, 3)));
    assert_true(p.route.count == 0 && p.route.length == 0);
    const sl_point nearest = p.route.nearest;
    assert_true(isfinite(way(&p, 3, 8, nearest.x, nearest.y)));
    close_plan(&p);
    boxed(&p, "wall 0 5 5 5\nwall 5.000000000000001 5 10 5\n");
    assert_true(way(&p, 5, 8, 5, 2) < 6 + 1e-12);
    close_plan(&p);
    // Corner to corner: rooms that share one point only.
    boxed(&p, "wall 5 0 5 10\nwall 0 5 10 5\n");
    assert_true(isinf(way(&p, 4, 4, 6, 6)));
    close_plan(&p);
    // The corner of two blocks is passed around, not through.
    boxed(&p, "wall 2 2 5 2\nwall 5 2 5 5\nwall 5 5 2 5\nwall 2 5 2 2\n"
              "wall 5 5 8 5\nwall 8 5 8 8\nwall 8 8 5 8\nwall 5 8 5 5\n");
    assert_true(way(&p, 4, 6, 6, 4) > 8);
    close_plan(&p);
}

static void test_doors(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 5 0 5 4\nwall 5 6 5 10\ndoor front 5 4 5 6 open\n");
    assert_true(way(&p, 1, 5, 9, 5) == 8);
    assert_int_equal(p.route.portal_count > 0, 1);
    assert_ok(p.context, sl_query_set_door(p.context, p.query, "front", false));
    assert_ok(p.context, sl_route_finder_update(p.context, p.finder));
    assert_true(isinf(way(&p, 1, 5, 9, 5)));
    assert_ok(p.context, sl_query_set_door(p.context, p.query, "front", true));
    assert_ok(p.context, sl_route_finder_update(p.context, p.finder));
    assert_true(way(&p, 1, 5, 9, 5) == 8);
    close_plan(&p);
}

/// A room that leads nowhere else costs nothing: as many nodes are expanded as with its door shut.
static void test_dead_end(void **state) {
    (void)state;
    plan p;
    boxed(&p, "walls 3 5 3 7 7 7 7 3 3 3 3 4\ndoor room 3 4 3 5 open\n"
              "wall 4 4 5 4\nwall 5 5 5 6\nwall 6 4 6 5\n");
    const double open_length = way(&p, 1, 4, 9, 6);
    const uint64_t open_nodes = p.route.nodes;
    assert_true(way(&p, 1, 4, 6.5, 5) < 7); // into the room
    sl_query_set_door_at(p.context, p.query, 0, false);
    assert_ok(p.context, sl_route_finder_update(p.context, p.finder));
    assert_true(way(&p, 1, 4, 9, 6) == open_length);
    assert_int_equal(p.route.nodes, open_nodes);
    close_plan(&p);
}

/// Glass is passed from its right to its left alone, and boxes that block are walked around.
static void test_one_way_and_boxes(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 5 0 5 4\nwall 5 6 5 8\noneway 5 4 5 6\n");
    const double over = way(&p, 1, 5, 9, 5), back = way(&p, 9, 5, 1, 5);
    assert_true(fmin(over, back) == 8 && fmax(over, back) == 10);
    const sl_moving_box block = {{{7, 3}, {8, 9}}, true};
    assert_ok(p.context, sl_query_set_boxes(p.context, p.query, &block, 1));
    assert_ok(p.context, sl_route_finder_update(p.context, p.finder));
    assert_true(way(&p, 6, 5, 9, 5) > 4.4);
    close_plan(&p);
}

/// Glass that stands free in line with the start: the search turns around its end and stops there,
/// though no way leads past the other glass from this side.
static void test_no_way_past_glass(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 8 0 8 4\nwall 8 6 8 10\noneway 8 4 8 6\noneway 5 2 5 4\noneway 3 4 3 2\n");
    for (double x = 3; x <= 5; x += 2)
        for (double y = 1; y < 10; y += 8)
            assert_true(isinf(way(&p, x, y, 9, 5)) != isinf(way(&p, 9, 5, x, y)));
    close_plan(&p);
}

static void test_refusals(void **state) {
    (void)state;
    plan p;
    boxed(&p, "");
    const sl_point in = {1, 1}, outside[] = {{11, 1}, {NAN, 1}, {1, -INFINITY}};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(sl_route_find(p.context, p.finder, in, outside[i], &p.route),
                         SL_BAD_ARGUMENT);
        assert_int_equal(sl_route_find(p.context, p.finder, outside[i], in, &p.route),
                         SL_BAD_ARGUMENT);
    }
    close_plan(&p);
    const sl_point rock[] = {{4, 4}, {6, 4}, {6, 6}, {4, 6}};
    p = (plan){.context = testing_context(NULL)};
    assert_ok(p.context, sl_map_parse(p.context, "test.map", box, strlen(box), NULL, &p.map));
    assert_ok(p.context, sl_map_add_solid(p.context, &p.map, rock, 4, 0));
    assert_ok(p.context, sl_map_clean(p.context, &p.map, NULL, NULL));
    open_plan(&p);
    assert_int_equal(sl_route_find(p.context, p.finder, in, (sl_point){5, 5}, &p.route),
                     SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(p.context), "solid ground"));
    assert_true(way(&p, 5, 1, 5, 9) == 2 * hypot(1, 3) + 2);
    close_plan(&p);
}

static void test_memory(void **state) {
    (void)state;
    for (long fail_at = 1, done = 0; !done; fail_at++) {
        testing_memory memory = {0};
        plan p = {.context = testing_context(&memory)};
        const char text[] =
            "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 5 0 5 6\nwall 3 4 2 9\n";
        assert_ok(p.context, sl_map_parse(p.context, "test.map", text, strlen(text), NULL, &p.map));
        assert_ok(p.context, sl_map_clean(p.context, &p.map, NULL, NULL));
        assert_ok(p.context,
                  sl_subdivision_for(&p.map)->subdivide(p.context, &p.map, NULL, &p.space));
        assert_ok(p.context, sl_query_over(p.context, &p.space, &p.map, NULL, &p.query));
        memory.calls = 0;
        memory.fail_at = fail_at;
        sl_status status = sl_route_finder_create(p.context, p.query, &p.finder);
        if (status == SL_OK)
            status =
                sl_route_find(p.context, p.finder, (sl_point){1, 1}, (sl_point){9, 1}, &p.route);
        done = status == SL_OK;
        if (!done) assert_int_equal(status, SL_NO_MEMORY);
        const long calls = memory.calls;
        if (done) { // nothing more once it has grown
            assert_true(way(&p, 9, 1, 1, 1) > 8 && way(&p, 1, 1, 9, 1) > 8);
            assert_true(memory.calls == calls);
        }
        memory.fail_at = 0;
        close_plan(&p);
        assert_int_equal(memory.live, 0);
    }
}

// --- random maps

static double check_way(plan *p, const barrier *b, sl_point from, sl_point to, uint64_t seed) {
    const walk_end start = stand(p, from), goal = stand(p, to);
    const double length = way(p, from.x, from.y, to.x, to.y);
    if (!is_clear(p, start) || !is_clear(p, goal) || b->count > ORACLE_WALLS) return length;
    const double expected = oracle_walk(b->walls, b->count, start, goal);
    if (isinf(length) != isinf(expected) ||
        (!isinf(length) && fabs(length - expected) > 1e-12 * expected))
        fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: %.17g, expected %.17g",
                 (unsigned long long)seed, from.x, from.y, to.x, to.y, length, expected);
    if (p->route.found &&
        !oracle_can_walk(b->walls, b->count, start, goal, p->route.points, p->route.count))
        fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: the way is blocked",
                 (unsigned long long)seed, from.x, from.y, to.x, to.y);
    return length;
}

/// Ways against the oracle; the same length both ways, and no shorter by way of a third point.
static void check_plan(plan *p, uint64_t seed) {
    static barrier b;
    sl_random random = {seed};
    open_plan(p);
    if (p->map.door_count) {
        for (size_t i = 0; i < p->map.door_count; i++)
            sl_query_set_door_at(p->context, p->query, i, sl_random_below(&random, 2));
        assert_ok(p->context, sl_route_finder_update(p->context, p->finder));
    }
    find_barrier(p, &b);
    for (int i = 0; i < 3; i++) {
        sl_point at[3];
        bool usable = true;
        for (int k = 0; k < 3; k++) {
            at[k] = random_place(&random, p);
            const uint32_t cell = sl_space_locate(&p->space, at[k]);
            usable &= cell != SL_NO_CELL && !p->space.cells[cell].solid;
        }
        if (!usable) continue;
        const double over = check_way(p, &b, at[0], at[1], seed);
        const double back = way(p, at[1].x, at[1].y, at[0].x, at[0].y);
        const double one = way(p, at[0].x, at[0].y, at[2].x, at[2].y),
                     other = way(p, at[2].x, at[2].y, at[1].x, at[1].y);
        if (isinf(over) != isinf(back) || fabs(over - back) > 1e-13 * over)
            fail_msg("seed %llu: %.17g there, %.17g back", (unsigned long long)seed, over, back);
        if (over > (one + other) * (1 + 1e-13))
            fail_msg("seed %llu: %.17g, by a third point %.17g", (unsigned long long)seed, over,
                     one + other);
    }
    close_plan(p);
}

static void test_axial(void **state) {
    (void)state;
    each_axial_plan(testing_seeds(150), check_plan);
}

static void test_turned(void **state) {
    (void)state;
    each_turned_plan(testing_seeds(120), check_plan);
}

static void test_oblique(void **state) {
    (void)state;
    each_oblique_plan(testing_seeds(300), check_plan);
}

static void test_random_doors(void **state) {
    (void)state;
    for (uint64_t seed = 0, count = testing_seeds(120); seed < count; seed++) {
        plan p = {.context = testing_context(NULL)};
        sl_random random = {seed};
        random_effects_map(p.context, &random, SL_EFFECT_DOOR | SL_EFFECT_MIRROR, 1, &p.map);
        check_plan(&p, seed);
    }
}

/// Whether the portals of the way lead from one cell with its start to one with its end.
static bool is_chain(const plan *p, uint32_t cell, sl_point from, sl_point to) {
    bool joined = sli_cell_holds(&p->space, cell, from);
    for (size_t i = 0; i < p->route.portal_count; i++) {
        const uint32_t *ends = p->space.portals[p->route.portals[i]].cell;
        joined &= ends[0] == cell || ends[1] == cell;
        cell = ends[ends[0] == cell];
    }
    return joined && sli_cell_holds(&p->space, cell, to);
}

static void check_portals(const plan *p, sl_point from, sl_point to) {
    bool found = false;
    for (uint32_t c = 0; c < p->space.cell_count && !found; c++) found = is_chain(p, c, from, to);
    assert_true(found);
}

static const sl_subdivision *subdivision(const char *name) {
    size_t count, i = 0;
    const sl_subdivision *all = sl_subdivisions(&count);
    while (i + 1 < count && strcmp(all[i].name, name) != 0) i++;
    return &all[i];
}

static bool is_at_pillar(sl_point at) {
    const double x = fmod(at.x, 6), y = fmod(at.y, 6);
    return x >= 2 && x <= 4 && y >= 2 && y <= 4;
}

/// Among pillars that stand in rows, with many ways of the same length, it is the same way in cells
/// of a kd-tree and of a mesh.
static void test_pillars(void **state) {
    (void)state;
    static const char *const cuts[] = {"kd", "mesh"};
    char text[4096];
    plan p[2];
    size_t used =
        (size_t)snprintf(text, sizeof text, "sightline 1\nwalls 0 0 30 0 30 30 0 30 0 0\n");
    for (int i = 0; i < 25; i++) {
        const int x = 2 + 6 * (i % 5), y = 2 + 6 * (i / 5);
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "walls %d %d %d %d %d %d %d %d %d %d\n", x, y, x + 2, y, x + 2,
                                 y + 2, x, y + 2, x, y);
    }
    for (int k = 0; k < 2; k++) {
        sl_context *context = testing_context(NULL);
        p[k] = (plan){.context = context};
        assert_ok(context, sl_map_parse(context, "pillars", text, strlen(text), NULL, &p[k].map));
        assert_ok(context, sl_map_clean(context, &p[k].map, NULL, NULL));
        assert_ok(context, subdivision(cuts[k])->subdivide(context, &p[k].map, NULL, &p[k].space));
        assert_ok(context, sl_query_over(context, &p[k].space, &p[k].map, NULL, &p[k].query));
        assert_ok(context, sl_route_finder_create(context, p[k].query, &p[k].finder));
    }
    sl_random random = {7};
    for (int asked = 0; asked < 300;) {
        sl_point ends[2];
        for (int k = 0; k < 2; k++)
            ends[k] = (sl_point){(double)sl_random_below(&random, 31),
                                 (double)sl_random_below(&random, 31)};
        if (is_at_pillar(ends[0]) || is_at_pillar(ends[1])) // in which cell may depend on the cut
            continue;
        for (int k = 0; k < 2; k++) {
            assert_true(isfinite(way(&p[k], ends[0].x, ends[0].y, ends[1].x, ends[1].y)));
            check_portals(&p[k], ends[0], ends[1]);
        }
        assert_int_equal(p[0].route.count, p[1].route.count);
        assert_memory_equal(p[0].route.points, p[1].route.points,
                            p[0].route.count * sizeof(sl_point));
        asked++;
    }
    for (int k = 0; k < 2; k++) close_plan(&p[k]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_straight_and_around),
        cmocka_unit_test(test_along_walls),
        cmocka_unit_test(test_touching_walls_are_closed),
        cmocka_unit_test(test_doors),
        cmocka_unit_test(test_dead_end),
        cmocka_unit_test(test_one_way_and_boxes),
        cmocka_unit_test(test_no_way_past_glass),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_axial),
        cmocka_unit_test(test_turned),
        cmocka_unit_test(test_oblique),
        cmocka_unit_test(test_random_doors),
        cmocka_unit_test(test_pillars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
