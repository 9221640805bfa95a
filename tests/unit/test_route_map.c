/// Shortest path maps: by hand, and place by place against single ways on random maps.
#include "testing.h"

#include "oracle/random_effects.h"
#include "route_plan.h"

#include <math.h>

enum { PLACES = 40 };

static const char two_rooms[] =
    "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 10 10 0 10\nwall 0 10 0 0\n"
    "wall 5 0 5 4\nwall 5 6 5 10\ndoor front 5 4 5 6 open\n";

static sl_route_map *make_map(plan *p, sl_point from, double limit) {
    sl_route_map *map;
    assert_ok(p->context, sl_route_map_create(p->context, p->finder, from, limit, &map));
    return map;
}

static void assert_place(sl_route_map *map, sl_point at, double distance, sl_point root) {
    sl_route_place place;
    sl_route_map_at(map, at, &place);
    assert_true(fabs(place.distance - distance) < 1e-13);
    if (!sli_same_point(place.root, root))
        fail_msg("to %.9g,%.9g by %.9g,%.9g", at.x, at.y, place.root.x, place.root.y);
}

static void test_two_rooms(void **state) {
    (void)state;
    plan p;
    read_plan(&p, two_rooms);
    const sl_point from = {1, 1}, corner = {5, 4};
    sl_route_map *map = make_map(&p, from, INFINITY);
    assert_place(map, from, 0, from);
    assert_place(map, (sl_point){4, 5}, 5, from);
    assert_place(map, (sl_point){9, 1}, 10, corner);        // two triangles of 3, 4, 5
    assert_place(map, (sl_point){5, 5}, hypot(4, 4), from); // in the door
    sl_route_place place;
    const sl_point nowhere[] = {{-1, 5}, {NAN, 5}, {INFINITY, 5}};
    for (size_t i = 0; i < 3; i++) {
        sl_route_map_at(map, nowhere[i], &place);
        assert_true(isinf(place.distance));
    }
    sl_route_map_destroy(p.context, map);
    map = make_map(&p, from, 9);
    sl_route_map_at(map, (sl_point){9, 1}, &place);
    assert_true(isinf(place.distance));
    sl_route_map_at(map, (sl_point){7, 2.5}, &place);
    assert_true(fabs(place.distance - 7.5) < 1e-13);
    sl_route_map_destroy(p.context, map);
    close_plan(&p);
}

static void test_losses_and_refusals(void **state) {
    (void)state;
    plan p;
    read_plan(&p, two_rooms);
    const double loss = 3;
    sl_route_map *map;
    assert_ok(p.context, sl_route_finder_set_losses(p.context, p.finder, &loss, 1));
    map = make_map(&p, (sl_point){1, 1}, INFINITY);
    assert_place(map, (sl_point){9, 1}, 13, (sl_point){5, 4});
    sl_route_map_destroy(p.context, map);
    assert_int_equal(sl_route_map_create(p.context, p.finder, (sl_point){1, 1}, -1, &map),
                     SL_BAD_ARGUMENT);
    assert_int_equal(sl_route_map_create(p.context, p.finder, (sl_point){-1, 1}, 1, &map),
                     SL_BAD_ARGUMENT);
    assert_ok(p.context, sl_route_finder_set_losses(p.context, p.finder, NULL, 0));
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 0.1));
    assert_int_equal(sl_route_map_create(p.context, p.finder, (sl_point){1, 1}, 1, &map),
                     SL_UNSUPPORTED);
    close_plan(&p);
}

/// Each allocation that fails leaves nothing behind.
static void test_memory(void **state) {
    (void)state;
    sl_status status = SL_NO_MEMORY;
    for (long fail_at = 1; status != SL_OK; fail_at++) {
        testing_memory memory = {0};
        plan p = {.context = testing_context(&memory)};
        assert_ok(p.context,
                  sl_map_parse(p.context, "test.map", two_rooms, strlen(two_rooms), NULL, &p.map));
        assert_ok(p.context, sl_map_clean(p.context, &p.map, NULL, NULL));
        open_plan(&p);
        sl_route_map *map = NULL;
        memory.calls = 0;
        memory.fail_at = fail_at;
        status = sl_route_map_create(p.context, p.finder, (sl_point){1, 1}, INFINITY, &map);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        memory.fail_at = 0;
        sl_route_map_destroy(p.context, map);
        close_plan(&p);
        assert_int_equal(memory.live, 0);
    }
}

/// Both are within the stated share of the true distance.
static bool is_same(double a, double b, size_t corners) {
    return isinf(a) ? isinf(b) : fabs(a - b) <= b * 0x1p-39 * (double)(corners + 2);
}

/// The roots of all places that were compared, and of those the ones that are another way's.
static size_t compared, ties;

/// From one place, all others are as far as single ways say, and by way of a root that is.
static void check_opened(plan *p, uint64_t seed) {
    sl_random random = {seed};
    sl_point from = random_place(&random, p);
    if (!p->space.wall_count || !is_clear(p, stand(p, from))) {
        close_plan(p);
        return;
    }
    sl_route_map *map = make_map(p, from, INFINITY);
    for (int i = 0; i < PLACES; i++) {
        const sl_point to = random_place(&random, p);
        const uint32_t cell = sl_space_locate(&p->space, to);
        if (cell == SL_NO_CELL || p->space.cells[cell].solid) continue;
        sl_route_place place;
        sl_route_map_at(map, to, &place);
        const double length = way(p, from.x, from.y, to.x, to.y);
        if (!is_same(place.distance, length, p->route.count))
            fail_msg("seed %llu: from %.17g,%.17g to %.17g,%.17g: %.17g, not %.17g",
                     (unsigned long long)seed, from.x, from.y, to.x, to.y, place.distance, length);
        if (isinf(place.distance) || sli_same_point(place.root, from)) continue;
        const double last = hypot(to.x - place.root.x, to.y - place.root.y);
        const sl_point corner = p->route.points[p->route.count - 2];
        assert_true(last < place.distance);
        // The way turns there, too, or another one that is as long does.
        if (!sli_same_point(corner, place.root)) ties++;
        compared++;
    }
    sl_route_map_destroy(p->context, map);
    close_plan(p);
}

/// The same with doors at a loss and one-way glass.
static void test_effects(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < testing_seeds(400); seed++) {
        sl_random random = {seed + 1};
        plan p = {.context = testing_context(NULL)};
        random_effects_map(p.context, &random, SL_EFFECT_DOOR | SL_EFFECT_ONEWAY, 1, &p.map);
        open_plan(&p);
        double losses[3];
        for (int i = 0; i < 3; i++) losses[i] = (double)sl_random_below(&random, 4) / 2;
        assert_ok(p.context, sl_route_finder_set_losses(p.context, p.finder, losses, 3));
        check_opened(&p, seed);
    }
}

static void check_open(plan *p, uint64_t seed) {
    open_plan(p);
    check_opened(p, seed);
}

static void test_axial(void **state) {
    (void)state;
    each_axial_plan(testing_seeds(300), check_open);
}

static void test_turned(void **state) {
    (void)state;
    each_turned_plan(testing_seeds(200), check_open);
}

static void test_oblique(void **state) {
    (void)state;
    each_oblique_plan(testing_seeds(300), check_open);
}

/// Few places have several ways of the same length.
static void test_roots(void **state) {
    (void)state;
    assert_true(compared > testing_seeds(1000) && 10 * ties < compared);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_rooms), cmocka_unit_test(test_losses_and_refusals),
        cmocka_unit_test(test_axial),     cmocka_unit_test(test_turned),
        cmocka_unit_test(test_oblique),   cmocka_unit_test(test_effects),
        cmocka_unit_test(test_roots),     cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
