/// Sight from lines and areas within a range: by hand, single points by exact arithmetic on random
/// maps, and regions between two bounds.
#include "set_plan.h"

enum { POINTS = 40 };

static double area_within(room *r, double range, const sl_point *points, size_t count,
                          sl_set_kind kind, sl_set_seen seen) {
    assert_ok(r->context, sl_query_set_range(r->context, r->query, range));
    return area_of(r, points, count, kind, seen);
}

/// An area that is a part of the true one, but for what is nearly as far as the range.
static void assert_within(double area, double least, double most) {
    if (!(area >= least && area <= most))
        fail_msg("area %.17g, not from %.17g to %.17g", area, least, most);
}

/// In free ground: what is near a segment, and what is near both of its ends.
static void free_ground(void **state) {
    (void)state;
    const double pi = 4 * atan(1), loss = 1 - SL_SET_RANGE_SHARE;
    room r;
    make_room(&r, NULL, "walls -50 -50 50 -50 50 50 -50 50 -50 -50\nstart 0 0 0\n");
    const sl_point line[] = {{-3, -4}, {3, 4}}, square[] = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
    for (double range = 6; range < 20; range += 4) {
        const double near = range * loss;
        assert_within(area_within(&r, range, line, 2, SL_SET_LINE, SL_SEEN_FROM_SOME),
                      20 * near + pi * near * near, 20 * range + pi * range * range);
        assert_within(area_within(&r, range, square, 4, SL_SET_AREA, SL_SEEN_FROM_SOME),
                      16 + 16 * near + pi * near * near, 16 + 16 * range + pi * range * range);
        // A lens: two circles, 10 apart.
        const double lens = 2 * range * range * acos(5 / range) - 10 * sqrt(range * range - 25);
        const double less = 2 * near * near * acos(5 / near) - 10 * sqrt(near * near - 25);
        assert_within(area_within(&r, range, line, 2, SL_SET_LINE, SL_SEEN_FROM_ALL), less, lens);
    }
    // Nothing is that near to both ends, and with a large range the range does not count.
    assert_true(area_within(&r, 4.9, line, 2, SL_SET_LINE, SL_SEEN_FROM_ALL) == 0);
    for (int seen = 0; seen < 2; seen++)
        assert_within(area_within(&r, 200, line, 2, SL_SET_LINE, (sl_set_seen)seen),
                      10000 * (1 - 1e-12), 10000 * (1 + 1e-12));
    end_room(&r);
}

/// A point that is exactly as far as the range is seen; one that is farther by a bit is not.
static void exactly_as_far(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls -50 -50 50 -50 50 50 -50 50 -50 -50\nwall 0 10 0 40\nstart 1 0 0\n");
    const sl_point line[] = {{-9, 0}, {-3, 0}};
    const struct {
        sl_point at;
        bool some, all;
    } cases[] = {
        {{-5, 5}, true, false},                // the foot of it is on the segment
        {{-5, nextafter(5, 6)}, false, false}, //
        {{1, 3}, true, false},                 // 3, 4, 5 to the nearer end
        {{1, nextafter(3, 4)}, false, false},  //
        {{2, 0}, true, false},                 // in line with it
        {{nextafter(2, 3), 0}, false, false},  //
        {{-6, 4}, true, true},                 // 3, 4, 5 to both ends
        {{-6, nextafter(4, 5)}, true, false},  //
        {{-6, 0}, true, true},                 // on it
    };
    sl_set_sight *sight;
    assert_ok(r.context, sl_query_set_range(r.context, r.query, 5));
    assert_ok(r.context, sl_set_sight_create(r.context, r.query, line, 2, SL_SET_LINE, &sight));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bool some, all;
        assert_ok(r.context,
                  sl_set_sight_sees(r.context, sight, SL_SEEN_FROM_SOME, cases[i].at, &some));
        assert_ok(r.context,
                  sl_set_sight_sees(r.context, sight, SL_SEEN_FROM_ALL, cases[i].at, &all));
        if (some != cases[i].some || all != cases[i].all)
            fail_msg("%.17g,%.17g: some %d, all %d", cases[i].at.x, cases[i].at.y, some, all);
    }
    sl_set_sight_destroy(r.context, sight);
    // Past the end of the wall, (0, 10): from (-6, 2) it is 10 away, and (3, 14) another 5.
    const sl_point below[] = {{-6, 2}, {-6, -20}};
    const double ranges[] = {15, nextafter(15, 0)};
    for (int i = 0; i < 2; i++) {
        bool some;
        assert_ok(r.context, sl_query_set_range(r.context, r.query, ranges[i]));
        assert_ok(r.context,
                  sl_set_sight_create(r.context, r.query, below, 2, SL_SET_LINE, &sight));
        assert_ok(r.context,
                  sl_set_sight_sees(r.context, sight, SL_SEEN_FROM_SOME, (sl_point){3, 14}, &some));
        assert_true(some == !i);
        sl_set_sight_destroy(r.context, sight);
    }
    end_room(&r);
}

/// Whether a wall crosses the segment: there, places are rounded.
static bool is_crossed(const brute *x, sl_segment s) {
    for (size_t i = 0; i < x->wall_count; i++) {
        const sl_point a = {mpq_get_d(x->ends[i][0].x), mpq_get_d(x->ends[i][0].y)},
                       b = {mpq_get_d(x->ends[i][1].x), mpq_get_d(x->ends[i][1].y)};
        if (sli_orient(s.a, s.b, a) * sli_orient(s.a, s.b, b) < 0 &&
            sli_orient(a, b, s.a) * sli_orient(a, b, s.b) <= 0)
            return true;
    }
    return false;
}

/// Whether a place is seen by exact arithmetic within a range.
static bool is_near_some(brute *x, sl_segment s, sl_point at, double range) {
    seen_pieces pieces[2];
    mpq_set_d(x->range, range);
    by_brute_force(x, s, at, pieces);
    return pieces[1].near;
}

static void check_points(const room *r, brute *x, sl_segment s, double range, sl_random *random,
                         uint64_t seed) {
    const sl_point points[] = {s.a, s.b};
    const double near = 1e-9 * (fabs(r->space.bounds.max.x) + fabs(r->space.bounds.max.y));
    const bool crossed = is_crossed(x, s);
    sl_set_sight *sight;
    sl_set_region regions[2] = {0};
    assert_ok(r->context,
              sl_set_sight_create(r->context, r->query, points, 2, SL_SET_LINE, &sight));
    for (int k = 0; k < 2; k++)
        assert_ok(r->context, sl_set_sight_region(r->context, sight, (sl_set_seen)k, &regions[k]));
    for (int i = 0; i < POINTS; i++) {
        const sl_point at = i % 5 ? random_point(&r->space.bounds, random) : odd_point(r, random);
        const uint32_t cell = sl_space_locate(&r->space, at);
        seen_pieces pieces[2];
        bool sees[2];
        if (cell == SL_NO_CELL || r->space.cells[cell].solid || sli_orient(s.a, s.b, at) == 0)
            continue;
        mpq_set_d(x->range, range);
        by_brute_force(x, s, at, pieces);
        for (int k = 0; k < 2; k++)
            assert_ok(r->context,
                      sl_set_sight_sees(r->context, sight, (sl_set_seen)k, at, &sees[k]));
        if (!crossed &&
            (pieces[1].near > sees[0] || (sees[0] && !pieces[1].near && !sees_single(r, s, at))))
            fail_msg("seed %llu: %.17g,%.17g: in range of some point %d", (unsigned long long)seed,
                     at.x, at.y, pieces[1].near);
        const bool both = hypot(at.x - s.a.x, at.y - s.a.y) <= range &&
                          hypot(at.x - s.b.x, at.y - s.b.y) <= range;
        if (sees[1] != (both && !pieces[0].any))
            fail_msg("seed %llu: %.17g,%.17g: in range of all points %d", (unsigned long long)seed,
                     at.x, at.y, sees[1]);
        if (i % 5 == 0) continue;
        const bool in = goes_around(&regions[0].shape, at);
        if (in > sees[0] && distance_to(&regions[0].shape, at) > near)
            fail_msg("seed %llu: %.17g,%.17g is in the region of %.17g,%.17g %.17g,%.17g, and not "
                     "seen within %.17g: %g away from its border",
                     (unsigned long long)seed, at.x, at.y, s.a.x, s.a.y, s.b.x, s.b.y, range,
                     distance_to(&regions[0].shape, at));
        // Regions need not know of pieces that rounding hides.
        if (!in && pieces[1].longest > 1e-9 &&
            is_near_some(x, s, at, range * (1 - SL_SET_RANGE_SHARE)) &&
            distance_to(&regions[0].shape, at) > near)
            fail_msg("seed %llu: %.17g,%.17g is seen well in range of %.17g, and not in the region "
                     "of %.17g,%.17g %.17g,%.17g",
                     (unsigned long long)seed, at.x, at.y, range, s.a.x, s.a.y, s.b.x, s.b.y);
        if (goes_around(&regions[1].shape, at) > sees[1] &&
            distance_to(&regions[1].shape, at) > near)
            fail_msg("seed %llu: %.17g,%.17g is in the region of all points",
                     (unsigned long long)seed, at.x, at.y);
    }
    for (int k = 0; k < 2; k++) sl_set_region_destroy(r->context, &regions[k]);
    sl_set_sight_destroy(r->context, sight);
}

static void random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    brute *x = calloc(1, sizeof *x);
    assert_non_null(x);
    brute_open(x);
    for (uint64_t seed = 1; seed <= testing_seeds(14); seed++) {
        room r;
        sl_random random = {seed};
        if (make_random(context, seed, &r)) {
            const sl_segment s = {odd_point(&r, &random), odd_point(&r, &random)};
            const sl_box *b = &r.space.bounds;
            const double size = fmax(b->max.x - b->min.x, b->max.y - b->min.y);
            const double range = size * (0.05 + 0.7 * sl_random_unit(&random));
            x->wall_count = r.space.wall_count;
            for (uint32_t i = 0; i < r.space.wall_count; i++) {
                set_exact(&x->ends[i][0], r.space.walls[i].a);
                set_exact(&x->ends[i][1], r.space.walls[i].b);
            }
            assert_ok(context, sl_query_set_range(context, r.query, range));
            if (s.a.x != s.b.x || s.a.y != s.b.y) check_points(&r, x, s, range, &random, seed);
        }
        end_map(&r);
    }
    brute_close(x);
    free(x);
    sl_context_destroy(context);
}

/// Against eyes along bends and in areas, with doors, glass and a wall across.
static void check_eyes(const room *r, const sl_point *points, size_t count, sl_set_kind kind,
                       double range, uint64_t seed) {
    enum { LOOKED_AT = 12 };
    sl_random random = {seed};
    sl_set_sight *sight;
    sl_set_region region = {0};
    size_t missed = 0;
    assert_ok(r->context, sl_query_set_range(r->context, r->query, range));
    assert_ok(r->context, sl_set_sight_create(r->context, r->query, points, count, kind, &sight));
    assert_ok(r->context, sl_set_sight_region(r->context, sight, SL_SEEN_FROM_SOME, &region));
    for (int i = 0; i < LOOKED_AT; i++) {
        const sl_point at = random_point(&r->space.bounds, &random);
        bool some, all, by_some = false, by_all = true, well = false;
        assert_ok(r->context, sl_set_sight_sees(r->context, sight, SL_SEEN_FROM_SOME, at, &some));
        assert_ok(r->context, sl_set_sight_sees(r->context, sight, SL_SEEN_FROM_ALL, at, &all));
        for (size_t eye = 0; eye < eye_count(); eye++) {
            const double share = (double)eye / (double)(eye_count() - 1);
            const sl_point from = eye_of(points, count, kind, share, &random);
            bool is_seen;
            assert_ok(r->context, sl_query_sees(r->context, r->query, from, at, &is_seen));
            by_some |= is_seen;
            by_all &= is_seen;
            well |=
                is_seen && hypot(at.x - from.x, at.y - from.y) <= range * (1 - SL_SET_RANGE_SHARE);
        }
        const bool in = goes_around(&region.shape, at);
        if (by_some > some || by_all < all || well > in || in > some)
            fail_msg("seed %llu: %.17g,%.17g: some %d, by an eye %d, well %d, in the region %d",
                     (unsigned long long)seed, at.x, at.y, some, by_some, well, in);
        missed += by_some < some;
    }
    // Few eyes stand at the border of an area, where they are nearest to what is outside.
    assert_true(kind == SL_SET_AREA || missed <= 2);
    sl_set_region_destroy(r->context, &region);
    sl_set_sight_destroy(r->context, sight);
}

static void many_eyes(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, set_plan);
    const sl_point bend[] = {{2, 2}, {6, 7}, {12, 7.5}, {12.5, 14}}, line[] = {{9, 1}, {15, 14}};
    const sl_point area[] = {{9.2, 8.1}, {12.3, 8.4}, {12.1, 11.3}, {9.7, 10.8}};
    sl_point disc[64];
    const size_t corners = sl_set_of_disc((sl_point){5.5, 12}, 1.7, 0.01, disc, 64);
    for (uint64_t open = 0; open < 2; open++) {
        sl_query_set_doors(r.context, r.query, open);
        for (double range = 3; range < 10; range *= 3) {
            check_eyes(&r, bend, 4, SL_SET_LINE, range, 10 + open);
            check_eyes(&r, line, 2, SL_SET_LINE, range, 20 + open);
            check_eyes(&r, area, 4, SL_SET_AREA, range, 40 + open);
            check_eyes(&r, disc, corners, SL_SET_AREA, range, 60 + open);
        }
    }
    end_room(&r);
}

/// A set that is far too long for its range is refused.
static void too_long(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 20 0 20 10 0 10 0 0\nstart 2 5 0\n");
    const sl_point line[] = {{1, 1}, {19, 9}};
    sl_set_sight *sight;
    sl_set_region region = {0};
    assert_ok(r.context, sl_query_set_range(r.context, r.query, 1e-9));
    assert_ok(r.context, sl_set_sight_create(r.context, r.query, line, 2, SL_SET_LINE, &sight));
    assert_int_equal(sl_set_sight_region(r.context, sight, SL_SEEN_FROM_SOME, &region),
                     SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(r.context), "too long for the range 1e-09"));
    sl_set_sight_destroy(r.context, sight);
    end_room(&r);
}

/// Each allocation that fails leaves nothing behind.
static void memory_that_ends(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r = {.context = testing_context(&memory)};
    testing_space(r.context, "walls 0 0 20 0 20 10 0 10 0 0\nwall 9 5 11 5\nstart 2 5 0\n", &r.map,
                  &r.space);
    assert_ok(r.context, sl_query_over(r.context, &r.space, &r.map, NULL, &r.query));
    assert_ok(r.context, sl_query_set_range(r.context, r.query, 6));
    assert_ok(r.context, sl_query_prepare(r.context, r.query));
    const sl_point line[] = {{9, 3}, {9.5, 3}};
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status != SL_OK; at++) {
        const long live = memory.live;
        sl_set_sight *sight = NULL;
        sl_set_region regions[2] = {0};
        memory.calls = 0;
        memory.fail_at = at;
        memory.once = true;
        status = sl_set_sight_create(r.context, r.query, line, 2, SL_SET_LINE, &sight);
        for (int k = 0; k < 2 && status == SL_OK; k++)
            status = sl_set_sight_region(r.context, sight, (sl_set_seen)k, &regions[k]);
        for (int k = 0; k < 2; k++) sl_set_region_destroy(r.context, &regions[k]);
        sl_set_sight_destroy(r.context, sight);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        assert_int_equal(memory.live, live);
    }
    memory.fail_at = 0;
    end_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_ground), cmocka_unit_test(exactly_as_far),
        cmocka_unit_test(random_maps), cmocka_unit_test(many_eyes),
        cmocka_unit_test(too_long),    cmocka_unit_test(memory_that_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
