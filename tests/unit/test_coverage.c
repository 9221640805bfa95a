/// What viewpoints see together: by hand in small rooms, and on random maps against sl_query_sees.
#include "room.h"

#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/coverage.h"

#include <math.h>

static room make_space(const char *statements) {
    room r = {.context = testing_context(NULL)};
    testing_space(r.context, statements, &r.map, &r.space);
    return r;
}

static void open_query(room *r) {
    assert_ok(r->context, sl_query_over(r->context, &r->space, &r->map, NULL, &r->query));
}

static const char two_rooms[] = "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
                                "start 2 5 0\ndoor middle 10 4 10 6 shut\n";

static bool is_near(double a, double b, double tolerance) {
    return fabs(a - b) <= tolerance;
}

static void one_room_of_two(void **state) {
    (void)state;
    room r = make_space(two_rooms);
    open_query(&r);
    const sl_viewpoint eye = {.at = {3, 4}, .fov = 360};
    sl_coverage c;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, &eye, 1, &c));
    assert_true(is_near(c.overlay.areas[0], 200, 1e-9));
    assert_true(is_near(c.overlay.areas[1], 100, 1e-9));
    assert_true(is_near(c.seen[0], 100, 1e-9));
    assert_true(is_near(c.alone[0], 100, 1e-9));
    assert_int_equal(c.blind_count, 1);
    assert_true(is_near(c.blind[0].area, 100, 1e-9));
    assert_true(c.blind[0].bounds.min.x == 10 && c.blind[0].bounds.max.x == 20);
    assert_true(c.blind[0].at.x > 10);
    sl_coverage_destroy(r.context, &c);
    end_room(&r);
}

/// No viewpoint: the wall between the rooms parts the blind spots.
static void nobody_sees(void **state) {
    (void)state;
    room r = make_space(two_rooms);
    open_query(&r);
    sl_coverage c;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, NULL, 0, &c));
    assert_int_equal(c.blind_count, 2);
    assert_true(is_near(c.blind[0].area, 100, 1e-9) && is_near(c.blind[1].area, 100, 1e-9));
    sl_coverage_destroy(r.context, &c);
    sl_query_set_doors(r.context, r.query, true);
    assert_ok(r.context, sl_coverage_make(r.context, r.query, NULL, 0, &c));
    assert_int_equal(c.blind_count, 1);
    assert_true(is_near(c.blind[0].area, 200, 1e-9));
    sl_coverage_destroy(r.context, &c);
    end_room(&r);
}

static void spare_and_needed(void **state) {
    (void)state;
    room r = make_space(two_rooms);
    open_query(&r);
    const sl_viewpoint eyes[] = {
        {.at = {3, 4}, .fov = 360}, {.at = {8, 9}, .fov = 360}, {.at = {15, 5}, .fov = 360}};
    sl_coverage c;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, eyes, 3, &c));
    assert_true(sl_coverage_is_spare(&c, 0) && sl_coverage_is_spare(&c, 1));
    assert_false(sl_coverage_is_spare(&c, 2));
    assert_int_equal(c.blind_count, 0);
    assert_true(is_near(c.overlay.areas[2], 100, 1e-9));
    sl_coverage_destroy(r.context, &c);
    end_room(&r);
}

/// A ring of a quarter of a turn: cone, range and dead zone.
static void cone_range_and_dead_zone(void **state) {
    (void)state;
    room r = make_space("walls 0 0 20 0 20 20 0 20 0 0\nstart 2 5 0\n");
    open_query(&r);
    assert_ok(r.context, sl_query_set_range(r.context, r.query, 9));
    const sl_viewpoint eyes[] = {
        {.at = {10, 10}, .heading = 90, .fov = 90, .range = 5, .nearest = 2},
        {.at = {10, 10}, .fov = 360, .range = 30, .nearest = 9}};
    const double ring = atan(1) * (25 - 4);
    sl_coverage c;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, eyes, 2, &c));
    assert_true(is_near(c.seen[0], ring, 1e-3 * ring));
    assert_true(c.seen[1] == 0); // the query's range counts
    assert_true(is_near(c.overlay.areas[1], ring, 1e-3 * ring));
    assert_int_equal(c.blind_count, 1);
    assert_true(sl_query_range(r.query) == 9);
    sl_coverage_destroy(r.context, &c);
    end_room(&r);
}

static void tilted_cameras(void **state) {
    (void)state;
    sl_viewpoint v = {.fov = 90, .range = 100};
    sl_viewpoint_tilt(&v, 3, 45, 1); // half a picture is 45 degrees high: from below to the horizon
    assert_true(v.nearest < 1e-9 && v.range == 100);
    v = (sl_viewpoint){.fov = 2 * atan(1.0 / 3) * 45 / atan(1)}; // tan of the half: 1 / 3
    sl_viewpoint_tilt(&v, 3, 45, 1); // tan(45 +- a) = (1 +- t) / (1 -+ t)
    assert_true(is_near(v.nearest, 1.5, 1e-9) && is_near(v.range, 6, 1e-9));
    v.range = 4;
    sl_viewpoint_tilt(&v, 3, 45, 1);
    assert_true(v.range == 4);
}

static void wrong_viewpoints(void **state) {
    (void)state;
    room r = make_space(two_rooms);
    open_query(&r);
    const sl_viewpoint wrong[] = {{.at = {3, 4}, .fov = 0},
                                  {.at = {3, 4}, .fov = 361},
                                  {.at = {3, 4}, .fov = NAN},
                                  {.at = {3, 4}, .fov = 90, .range = -1},
                                  {.at = {3, 4}, .fov = 90, .range = HUGE_VAL},
                                  {.at = {3, 4}, .fov = 90, .nearest = -1},
                                  {.at = {3, 4}, .fov = 90, .heading = NAN},
                                  {.at = {NAN, 4}, .fov = 90}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const sl_viewpoint both[] = {{.at = {3, 4}, .fov = 360}, wrong[i]};
        sl_coverage c;
        assert_int_equal(sl_coverage_make(r.context, r.query, both, 2, &c), SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(r.context), "viewpoint 2"));
    }
    end_room(&r);
}

// --- on random maps

enum { EYES = 5, POINTS = 40 };

static bool make_random(sl_context *context, uint64_t seed, room *r) {
    *r = (room){.context = context};
    if (seed % 2)
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &r->map));
    else
        assert_ok(context, oblique_random_map(context, seed, OBLIQUE_ANYWHERE, 20, &r->map));
    assert_ok(context, sl_map_clean(context, &r->map, NULL, NULL));
    if (!r->map.wall_count) return false;
    assert_ok(context, sl_subdivision_for(&r->map)->subdivide(context, &r->map, NULL, &r->space));
    open_query(r);
    return true;
}

/// Points of pieces are seen by as many eyes as the piece says; sums are sums of pieces.
static void check_points(const room *r, const sl_coverage *c, const sl_viewpoint *eyes,
                         sl_random *random, uint64_t seed) {
    for (int i = 0; i < POINTS; i++) {
        const sl_point at = random_point(&r->space.bounds, random);
        const uint32_t piece = sl_space_locate(&c->overlay.pieces, at);
        uint32_t seen = 0;
        for (int k = 0; k < EYES; k++) {
            bool sees;
            assert_ok(r->context, sl_query_sees(r->context, r->query, eyes[k].at, at, &sees));
            seen += sees;
        }
        const bool inside = r->space.cells[sl_space_locate(&r->space, at)].inside;
        if (!inside) continue;
        if (seen != c->overlay.counts[piece])
            fail_msg("seed %llu: %.17g,%.17g is seen by %u, not %u", (unsigned long long)seed, at.x,
                     at.y, seen, c->overlay.counts[piece]);
        assert_true(c->spots[piece] == UINT32_MAX || !seen);
    }
}

static void check_sums(const sl_coverage *c) {
    double covered = 0, alone = 0, layers = 0, blind = 0;
    for (int k = 0; k < EYES; k++) {
        covered += c->seen[k];
        alone += c->alone[k];
        layers += c->overlay.areas[k + 1];
        assert_true(c->alone[k] <= c->seen[k]);
    }
    const double rounding = 1e-9 * c->overlay.areas[0];
    assert_true(is_near(covered, layers, rounding));
    assert_true(is_near(alone, c->overlay.areas[1] - c->overlay.areas[2], rounding));
    for (uint32_t i = 0; i < c->blind_count; i++) {
        blind += c->blind[i].area;
        assert_true(!i || c->blind[i].area <= c->blind[i - 1].area);
        const uint32_t piece = sl_space_locate(&c->overlay.pieces, c->blind[i].at);
        assert_true(c->spots[piece] == i || c->blind[i].area < 1e-6 * c->overlay.areas[0]);
    }
    assert_true(
        is_near(blind, c->overlay.areas[0] - c->overlay.areas[1], 1e-6 * c->overlay.areas[0]));
}

static void random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    for (uint64_t seed = 1; seed <= testing_seeds(400); seed++) {
        room r;
        sl_random random = {seed};
        if (make_random(context, seed, &r)) {
            sl_viewpoint eyes[EYES];
            for (int k = 0; k < EYES; k++)
                eyes[k] = (sl_viewpoint){.at = random_point(&r.space.bounds, &random), .fov = 360};
            sl_coverage c;
            assert_ok(context, sl_coverage_make(context, r.query, eyes, EYES, &c));
            check_points(&r, &c, eyes, &random, seed);
            if (c.overlay.areas[0] > 0) check_sums(&c);
            sl_coverage_destroy(context, &c);
        }
        sl_query_destroy(context, r.query);
        sl_space_destroy(context, &r.space);
        sl_map_destroy(context, &r.map);
    }
    sl_context_destroy(context);
}

/// Each allocation that fails leaves nothing behind.
static void memory_that_ends(void **state) {
    (void)state;
    testing_memory memory = {0};
    sl_context *context = testing_context(&memory);
    room r = {.context = context};
    testing_space(context, two_rooms, &r.map, &r.space);
    open_query(&r);
    const sl_viewpoint eye = {.at = {3, 4}, .fov = 360, .nearest = 1};
    sl_coverage c;
    assert_ok(context, sl_coverage_make(context, r.query, &eye, 1, &c));
    sl_coverage_destroy(context, &c);
    const long live = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status != SL_OK; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        memory.once = true;
        status = sl_coverage_make(context, r.query, &eye, 1, &c);
        assert_true(status == SL_OK || (status == SL_NO_MEMORY && memory.live <= live + 1));
    }
    memory.fail_at = 0;
    sl_coverage_destroy(context, &c);
    end_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_room_of_two),  cmocka_unit_test(nobody_sees),
        cmocka_unit_test(spare_and_needed), cmocka_unit_test(cone_range_and_dead_zone),
        cmocka_unit_test(tilted_cameras),   cmocka_unit_test(wrong_viewpoints),
        cmocka_unit_test(random_maps),      cmocka_unit_test(memory_that_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
