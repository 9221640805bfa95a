/// Ways of a walker with a radius: by hand, and on random maps between two bounds of an oracle.
#include "testing.h"

#include "oracle/random_effects.h"
#include "oracle/wide_walks.h"
#include "route_plan.h"

#include "analysis/route/route.h"
#include "sightline/generate.h"

static const char box[] =
    "sightline 1\nwall 0 0 20 0\nwall 20 0 20 20\nwall 20 20 0 20\nwall 0 20 0 0\n";

static void boxed(plan *p, const char *more, double radius) {
    char text[1024];
    snprintf(text, sizeof text, "%s%s", box, more);
    read_plan(p, text);
    assert_ok(p->context, sl_route_finder_set_radius(p->context, p->finder, radius));
}

/// Around the end of a wall: two tangents and an arc.
static void test_around_an_end(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 10 0 10 10\n", 2);
    const double length = way(&p, 5, 5, 15, 5), away = hypot(5, 5);
    assert_true(p.route.count > 4 && p.route.portal_count == 0);
    for (int wide = 0; wide < 2; wide++) {
        const double radius = wide ? 2 * SL_ROUTE_ROOM : 2;
        // Over the top of the wall, both ends lie three quarters of a turn apart.
        const double arc = 3 * acos(0) - 2 * acos(radius / away);
        const double expected = 2 * sqrt(away * away - radius * radius) + radius * arc;
        assert_true(wide ? length <= expected : length >= expected);
    }
    close_plan(&p);
}

/// A gap is passed where it is wider than SL_ROUTE_ROOM times the walker, and not where it is
/// exactly as wide.
static void test_gaps(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 10 0 10 9\nwall 10 11 10 20\n", 1 / SL_ROUTE_ROOM - 1e-6);
    assert_true(way(&p, 5, 10, 15, 10) == 10);
    const double narrow[] = {1, 1.5, 1 + 1e-12};
    for (size_t i = 0; i < 3; i++) {
        assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, narrow[i]));
        assert_true(isinf(way(&p, 5, 10, 15, 10)));
        assert_true(p.route.nearest.x < 10);
    }
    close_plan(&p);
    // Between flat walls no more than rounding is lost.
    boxed(&p, "wall 0 9 20 9\nwall 0 11 20 11\n", 1 / SL_ROUTE_ROOM - 1e-6);
    assert_true(way(&p, 2, 10, 18, 10) == 16);
    close_plan(&p);
    // Corner to corner, the gap is a diagonal of 3, 4, 5.
    boxed(&p, "wall 0 8 8 8\nwall 8 8 8 0\nwall 12 20 12 11\nwall 12 11 20 11\n", 2.49);
    assert_true(isfinite(way(&p, 4, 14, 15, 4)));
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 2.5));
    assert_true(isinf(way(&p, 4, 14, 15, 4)));
    close_plan(&p);
}

/// Radius 0 is a point, before and after another radius.
static void test_point(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 10 0 10 10\n", 0);
    const double length = way(&p, 3, 3, 17, 4);
    const sl_point corner = p.route.points[1];
    assert_true(p.route.portal_count > 0 && corner.x == 10 && corner.y == 10);
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 1));
    assert_true(way(&p, 3, 3, 17, 4) > length);
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 0));
    assert_true(way(&p, 3, 3, 17, 4) == length && p.route.count == 3);
    close_plan(&p);
}

static void test_doors(void **state) {
    (void)state;
    plan p;
    boxed(&p, "wall 10 0 10 8\nwall 10 12 10 20\ndoor front 10 8 10 12 open\n", 1);
    assert_true(way(&p, 5, 10, 15, 10) == 10);
    assert_ok(p.context, sl_query_set_door(p.context, p.query, "front", false));
    assert_ok(p.context, sl_route_finder_update(p.context, p.finder));
    assert_true(isinf(way(&p, 5, 10, 15, 10)));
    close_plan(&p);
}

static void refuses(plan *p, sl_status status, sl_status expected, const char *text) {
    assert_int_equal(status, expected);
    assert_non_null(strstr(sl_context_message(p->context), text));
}

static void test_refusals(void **state) {
    (void)state;
    plan p;
    sl_route_near cells[64];
    const double loss = 1, bad[] = {-1, NAN, INFINITY};
    const sl_point in = {5, 5}, near = {0.5, 5}, out = {25, 5};
    boxed(&p, "wall 10 0 10 8\nwall 10 12 10 20\ndoor front 10 8 10 12 open\n", 0);
    for (size_t i = 0; i < 3; i++)
        refuses(&p, sl_route_finder_set_radius(p.context, p.finder, bad[i]), SL_BAD_ARGUMENT,
                "expected 0 to 1e+150");
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 1));
    refuses(&p, sl_route_find(p.context, p.finder, near, in, &p.route), SL_BAD_ARGUMENT,
            "from 0.5,5 is too near to the wall from 0,0 to 0,20: 0.5");
    refuses(&p, sl_route_find(p.context, p.finder, in, near, &p.route), SL_BAD_ARGUMENT,
            "to 0.5,5 is too near");
    refuses(&p, sl_route_find(p.context, p.finder, in, out, &p.route), SL_BAD_ARGUMENT, "outside");
    refuses(&p, sl_route_finder_set_losses(p.context, p.finder, &loss, 1), SL_UNSUPPORTED,
            "at a loss");
    refuses(&p, sl_route_distances(p.context, p.finder, in, INFINITY, cells), SL_UNSUPPORTED,
            "without a radius");
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 0));
    assert_ok(p.context, sl_route_finder_set_losses(p.context, p.finder, &loss, 1));
    refuses(&p, sl_route_finder_set_radius(p.context, p.finder, 1), SL_UNSUPPORTED, "at a loss");
    close_plan(&p);
    boxed(&p, "oneway 10 0 10 20\n", 0);
    refuses(&p, sl_route_finder_set_radius(p.context, p.finder, 1), SL_UNSUPPORTED, "one-way");
    assert_ok(p.context, sl_route_finder_set_radius(p.context, p.finder, 0));
    close_plan(&p);
}

static void test_memory(void **state) {
    (void)state;
    for (long fail_at = 1, done = 0; !done; fail_at++) {
        testing_memory memory = {0};
        plan p = {.context = testing_context(&memory)};
        const char text[] = "sightline 1\nwall 0 0 10 0\nwall 10 0 10 10\nwall 5 0 5 6\n";
        assert_ok(p.context, sl_map_parse(p.context, "test.map", text, strlen(text), NULL, &p.map));
        assert_ok(p.context, sl_map_clean(p.context, &p.map, NULL, NULL));
        open_plan(&p);
        memory.calls = 0;
        memory.fail_at = fail_at;
        const sl_status status = sl_route_finder_set_radius(p.context, p.finder, 0.5);
        done = status == SL_OK;
        if (!done) assert_int_equal(status, SL_NO_MEMORY);
        memory.fail_at = 0;
        if (!done) assert_ok(p.context, sl_route_finder_update(p.context, p.finder));
        assert_true(way(&p, 2, 2, 8, 2) > 10);
        close_plan(&p);
        assert_int_equal(memory.live, 0);
    }
}

// --- random maps

static bool has_room(const barrier *b, sl_point at, double radius) {
    const double needed = SL_ROUTE_ROOM * radius * (1 + 1e-9);
    return oracle_room(b->walls, b->count, (sl_segment){at, at}) > needed;
}

/// The clearance of the way is that of its pieces; what rounding may hide of it is far below the
/// slack that ways keep.
static void check_clearance(const plan *p, const barrier *b, double radius, uint64_t seed) {
    const sl_box *s = &p->space.bounds;
    const double most =
        fmax(fmax(fabs(s->min.x), fabs(s->max.x)), fmax(fabs(s->min.y), fabs(s->max.y)));
    for (size_t i = 1; i < p->route.count; i++) {
        const sl_segment piece = {p->route.points[i - 1], p->route.points[i]};
        const double room = oracle_room(b->walls, b->count, piece);
        if (room < radius + 0x1p-44 * most)
            fail_msg("seed %llu: radius %.17g, and %.17g from %.17g,%.17g to %.17g,%.17g",
                     (unsigned long long)seed, radius, room, piece.a.x, piece.a.y, piece.b.x,
                     piece.b.y);
    }
}

static uint64_t checked, found, rooms;

static void check_way(plan *p, const barrier *b, double radius, sl_point from, sl_point to,
                      uint64_t seed) {
    const double length = way(p, from.x, from.y, to.x, to.y);
    const double least =
                     oracle_wide_walk_least(b->walls, b->count, p->space.bounds, from, to, radius),
                 most = oracle_wide_walk_most(b->walls, b->count, p->space.bounds, from, to,
                                              SL_ROUTE_ROOM * radius);
    if (length < least * (1 - 1e-12) || length > most * (1 + 1e-12))
        fail_msg("seed %llu: radius %.17g from %.17g,%.17g to %.17g,%.17g: %.17g, expected %.17g "
                 "to %.17g",
                 (unsigned long long)seed, radius, from.x, from.y, to.x, to.y, length, least, most);
    check_clearance(p, b, radius, seed);
    checked++;
    found += p->route.found;
}

/// What stops the walker: the walls without the border of the bounds, which stops its middle only.
static void find_walls(plan *p, barrier *b) {
    find_barrier(p, b);
    for (int i = 0; i < 4; i++) {
        const sl_segment *s = &b->walls[b->count - 1];
        const sl_box *o = &p->space.bounds;
        const bool border = (s->a.x == s->b.x && (s->a.x == o->min.x || s->a.x == o->max.x)) ||
                            (s->a.y == s->b.y && (s->a.y == o->min.y || s->a.y == o->max.y));
        if (border) b->count--;
    }
}

static void check_plan(plan *p, uint64_t seed) {
    static barrier b;
    sl_random random = {seed};
    open_plan(p);
    find_walls(p, &b);
    const sl_box *s = &p->space.bounds;
    const double size = fmax(s->max.x - s->min.x, s->max.y - s->min.y);
    const double radius = size * (double)(1 + sl_random_below(&random, 20)) / 256;
    const bool fits = fabs(s->min.x) + fabs(s->max.x) + fabs(s->min.y) + fabs(s->max.y) < 1e149;
    if (b.count <= 24 && radius > 0 && fits) {
        assert_ok(p->context, sl_route_finder_set_radius(p->context, p->finder, radius));
        for (int tries = 0, ways = 0; tries < 40 && ways < 2; tries++) {
            const sl_point from = random_place(&random, p), to = random_place(&random, p);
            if (!has_room(&b, from, radius) || !has_room(&b, to, radius)) continue;
            check_way(p, &b, radius, from, to, seed);
            ways++;
        }
    }
    close_plan(p);
}

static void test_random(void **state) {
    (void)state;
    const uint64_t axial = testing_seeds(40), turned = testing_seeds(30),
                   oblique = testing_seeds(60);
    each_axial_plan(axial, check_plan);
    each_turned_plan(turned, check_plan);
    each_oblique_plan(oblique, check_plan);
    assert_true(3 * checked > axial + turned + oblique && 6 * found > axial + turned + oblique);
}

/// Ways in a room of the walls near them are those among all walls, to the corner.
static void check_room(plan *p, uint64_t seed) {
    sl_random random = {seed};
    const size_t walls = p->map.wall_count;
    sl_route all = {0};
    open_plan(p);
    const sl_box *b = &p->space.bounds;
    const double size = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    for (int i = 0; i < 12; i++) {
        sl_point from = b->min, to = b->min;
        from.x += sl_random_unit(&random) * (b->max.x - b->min.x);
        from.y += sl_random_unit(&random) * (b->max.y - b->min.y);
        to.x += sl_random_unit(&random) * (b->max.x - b->min.x);
        to.y += sl_random_unit(&random) * (b->max.y - b->min.y);
        assert_ok(p->context, sl_route_finder_set_radius(p->context, p->finder,
                                                         size * (double)(1 + i % 6) / 1024));
        if (sl_route_find(p->context, p->finder, from, to, &p->route) != SL_OK) continue;
        if (p->finder->has_all) continue;
        assert_true(p->route.found);
        rooms++;
        assert_ok(p->context, sli_route_make_room(p->context, p->finder, NULL));
        assert_ok(p->context, sli_route_find_here(p->context, p->finder, from, to, &all));
        assert_true(all.found);
        if (p->route.count != all.count || p->route.length != all.length ||
            memcmp(p->route.points, all.points, all.count * sizeof *all.points) != 0)
            fail_msg("seed %llu, %zu walls: from %.17g,%.17g to %.17g,%.17g: %.17g by %zu points, "
                     "among all walls %.17g by %zu",
                     (unsigned long long)seed, walls, from.x, from.y, to.x, to.y, p->route.length,
                     p->route.count, all.length, all.count);
    }
    sl_route_destroy(p->context, &all);
    close_plan(p);
}

static void city(plan *p, uint64_t seed, bool turned) {
    size_t count, kind = 0;
    const sl_map_kind *kinds = sl_map_kinds(&count);
    sl_generate_options options = sl_generate_options_default();
    while (kind + 1 < count && strcmp(kinds[kind].name, "city") != 0) kind++;
    options.seed = seed;
    options.walls = 300;
    options.turned = turned ? 17.3 : 0;
    *p = (plan){.context = testing_context(NULL)};
    assert_ok(p->context, sl_generate(p->context, &kinds[kind], &options, &p->map));
    assert_ok(p->context, sl_map_clean(p->context, &p->map, NULL, NULL));
}

static void test_rooms(void **state) {
    (void)state;
    plan p;
    for (uint64_t seed = 0; seed < 8; seed++) {
        city(&p, seed, seed % 2);
        check_room(&p, seed);
    }
    each_axial_plan(testing_seeds(20), check_room);
    each_turned_plan(testing_seeds(20), check_room);
    each_oblique_plan(testing_seeds(20), check_room);
    assert_true(rooms > 60);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_around_an_end), cmocka_unit_test(test_gaps),
        cmocka_unit_test(test_point),         cmocka_unit_test(test_doors),
        cmocka_unit_test(test_refusals),      cmocka_unit_test(test_memory),
        cmocka_unit_test(test_random),        cmocka_unit_test(test_rooms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
