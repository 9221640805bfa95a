/// Sight from lines and areas: by hand in small rooms, by exact arithmetic on random maps (the
/// crossings of all lines through a point and the ends of walls, in rational numbers), and by many
/// eyes.
#include "set_plan.h"

static void assert_area(const room *r, const sl_point *points, size_t count, sl_set_kind kind,
                        sl_set_seen seen, double expected) {
    const double area = area_of(r, points, count, kind, seen);
    if (fabs(area - expected) > 1e-9 * (1 + expected))
        fail_msg("area %.17g, not %.17g", area, expected);
}

/// A wall of length 2 in the middle of a room, and a line below it.
///
///     +----------------+ 10
///     |                |
///     |      ----      | 5
///     |    s------s    | 3
///     +----------------+ 0
///     0   6  9  11 14  20
static void behind_a_wall(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 20 0 20 10 0 10 0 0\nwall 9 5 11 5\nstart 2 5 0\n");
    const sl_point line[] = {{6, 3}, {14, 3}};
    // Hidden from all: below the rays from (6, 3) past (9, 5) and from (14, 3) past (11, 5). They
    // meet at x = 10, 2 / 3 above the wall.
    assert_area(&r, line, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 200 - 2.0 / 3);
    // Hidden from some: above the rays from (14, 3) past (9, 5) and from (6, 3) past (11, 5). They
    // meet the sides of the room 3.6 above the wall.
    assert_area(&r, line, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 100 + 9 * 3.6);
    end_room(&r);
}

static void rooms_and_doors(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL,
              "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 4\nwall 10 6 10 10\n"
              "start 2 5 0\ndoor middle 10 4 10 6 shut\n");
    const sl_point across[] = {{2, 5}, {18, 5}}, left[] = {{2, 5}, {8, 5}};
    assert_area(&r, left, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 100);
    assert_area(&r, left, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 100);
    assert_area(&r, across, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 200);
    assert_area(&r, across, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 0);
    sl_query_set_doors(r.context, r.query, true);
    assert_area(&r, across, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 200);
    assert_true(area_of(&r, across, 2, SL_SET_LINE, SL_SEEN_FROM_ALL) > 10);
    // From the line between the jambs, all is seen; from each jamb, too.
    const sl_point door[] = {{10, 4}, {10, 6}};
    assert_area(&r, door, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 200);
    assert_area(&r, door, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 200);
    end_room(&r);
}

/// A line on a wall looks to both sides.
static void on_a_wall(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 20 0 20 10 0 10 0 0\nwall 10 0 10 10\nstart 2 5 0\n");
    const sl_point wall[] = {{10, 2}, {10, 8}}, both[] = {{10, 0}, {10, 10}};
    assert_area(&r, wall, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 200);
    assert_area(&r, wall, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 200);
    assert_area(&r, both, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 200);
    const sl_point through[] = {{9, 5}, {11, 5}, {11, 7}, {9, 7}};
    assert_area(&r, through, 2, SL_SET_LINE, SL_SEEN_FROM_SOME, 200);
    assert_area(&r, through, 2, SL_SET_LINE, SL_SEEN_FROM_ALL, 0);
    assert_area(&r, through, 4, SL_SET_AREA, SL_SEEN_FROM_SOME, 200);
    assert_area(&r, through, 4, SL_SET_AREA, SL_SEEN_FROM_ALL, 0);
    end_room(&r);
}

/// A small closed room within the area is seen from itself only.
static void areas(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL,
              "walls 0 0 20 0 20 10 0 10 0 0\nwalls 9 4 11 4 11 6 9 6 9 4\nstart 2 5 0\n");
    const sl_point area[] = {{8, 3}, {12, 3}, {12, 7}, {8, 7}};
    assert_area(&r, area, 4, SL_SET_AREA, SL_SEEN_FROM_SOME, 200);
    const sl_point turned[] = {{8, 7}, {12, 7}, {12, 3}, {8, 3}};
    assert_area(&r, turned, 4, SL_SET_AREA, SL_SEEN_FROM_SOME, 200);
    assert_area(&r, area, 4, SL_SET_AREA, SL_SEEN_FROM_ALL, 0);
    const sl_point aside[] = {{1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 2}};
    assert_true(area_of(&r, aside, 5, SL_SET_AREA, SL_SEEN_FROM_ALL) > 100);
    end_room(&r);
}

/// Two walls with slits between a line and a hall: behind them the cones cross everywhere. The
/// limit holds before the crossings are made points.
static void many_slits(void **state) {
    (void)state;
    enum { SLITS = 80, TEXT = 64 * 1024 };
    char *text = calloc(1, TEXT);
    assert_non_null(text);
    int used = snprintf(text, TEXT, "walls 0 0 800 0 800 60 0 60 0 0\nstart 400 1 0\n");
    for (int wall = 0; wall < 2; wall++)
        for (int i = 0; i <= SLITS; i++) // of different widths, so that few lines meet in a point
            used += snprintf(text + used, (size_t)(TEXT - used), "wall %.17g %d %.17g %d\n",
                             i ? 10 * i - 0.25 : 0.0, 20 + 20 * wall,
                             i < SLITS ? 10 * i + 9 + (i * (7 + wall) % 13) * 0.05 : 800.0,
                             20 + 20 * wall);
    room r;
    make_room(&r, NULL, text);
    free(text);
    const sl_point line[] = {{1, 2}, {799, 2}};
    sl_set_sight *sight;
    sl_set_region region = {0};
    assert_ok(r.context, sl_set_sight_create(r.context, r.query, line, 2, SL_SET_LINE, &sight));
    assert_int_equal(sl_set_sight_region(r.context, sight, SL_SEEN_FROM_SOME, &region),
                     SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(r.context), "more than"));
    assert_non_null(strstr(sl_context_message(r.context), "crossings"));
    assert_true(!region.shape.count && region.area == 0);
    sl_set_region_destroy(r.context, &region);
    sl_set_sight_destroy(r.context, sight);
    end_room(&r);
}

static void wrong_sets(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 20 0 20 10 0 10 0 0\nstart 2 5 0\n");
    sl_set_sight *sight;
    const sl_point outside[] = {{1, 1}, {30, 1}}, nan[] = {{1, 1}, {NAN, 1}};
    const sl_point star[] = {{5, 1}, {7, 9}, {2, 4}, {8, 4}, {3, 9}};
    const sl_point dent[] = {{1, 1}, {9, 1}, {4, 2}, {1, 9}}, line[] = {{1, 1}, {3, 3}, {2, 2}};
    const struct {
        const sl_point *points;
        size_t count;
        sl_set_kind kind;
        const char *message;
    } cases[] = {{outside, 2, SL_SET_LINE, "point 2"}, {nan, 2, SL_SET_LINE, "point 2"},
                 {line, 0, SL_SET_LINE, "a point"},    {star, 5, SL_SET_AREA, "convex"},
                 {dent, 4, SL_SET_AREA, "convex"},     {line, 3, SL_SET_AREA, "in one line"},
                 {line, 1, SL_SET_AREA, "in one line"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(sl_set_sight_create(r.context, r.query, cases[i].points, cases[i].count,
                                             cases[i].kind, &sight),
                         SL_BAD_ARGUMENT);
        assert_non_null(strstr(sl_context_message(r.context), cases[i].message));
    }
    end_room(&r);
}

// --- on random maps

enum { POINTS = 25 };

static void check_membership(const room *r, sl_set_sight *sight, brute *x, sl_segment s,
                             const sl_set_region regions[2], sl_random *random, uint64_t seed) {
    for (int i = 0; i < POINTS; i++) {
        const sl_point at = i % 5 ? random_point(&r->space.bounds, random) : odd_point(r, random);
        seen_pieces pieces[2];
        bool sees[2];
        const uint32_t cell = sl_space_locate(&r->space, at);
        if (cell == SL_NO_CELL || r->space.cells[cell].solid) continue;
        by_brute_force(x, s, at, pieces);
        const bool some = pieces[1].any, all = !pieces[0].any;
        for (int k = 0; k < 2; k++)
            assert_ok(r->context,
                      sl_set_sight_sees(r->context, sight, (sl_set_seen)k, at, &sees[k]));
        if (sl_orient(s.a, s.b, at) != 0) {
            if (some > sees[0] || (sees[0] && !some && !sees_single(r, s, at)))
                fail_msg("seed %llu: %.17g,%.17g is%s seen from some point of %.17g,%.17g "
                         "%.17g,%.17g",
                         (unsigned long long)seed, at.x, at.y, some ? "" : " not", s.a.x, s.a.y,
                         s.b.x, s.b.y);
            if (all != sees[1])
                fail_msg("seed %llu: %.17g,%.17g is%s seen from all points of %.17g,%.17g "
                         "%.17g,%.17g",
                         (unsigned long long)seed, at.x, at.y, all ? "" : " not", s.a.x, s.a.y,
                         s.b.x, s.b.y);
        }
        const double near = 1e-9 * (fabs(r->space.bounds.max.x) + fabs(r->space.bounds.max.y));
        for (int k = 0; i % 5 && k < 2; k++)
            // Regions need not know of pieces that rounding hides.
            if ((!pieces[!k].any || pieces[!k].longest > 1e-9) &&
                goes_around(&regions[k].shape, at) != sees[k] &&
                distance_to(&regions[k].shape, at) > near)
                fail_msg("seed %llu: %.17g,%.17g: the region from %s says %d (%.17g,%.17g "
                         "%.17g,%.17g)",
                         (unsigned long long)seed, at.x, at.y, k ? "all" : "some", !sees[k], s.a.x,
                         s.a.y, s.b.x, s.b.y);
    }
}

static void check_segment(const room *r, brute *x, sl_random *random, uint64_t seed) {
    const sl_segment s = {odd_point(r, random), odd_point(r, random)};
    const sl_point points[] = {s.a, s.b};
    if (s.a.x == s.b.x && s.a.y == s.b.y) return;
    for (uint32_t i = 0; i < r->space.wall_count; i++) {
        set_exact(&x->ends[i][0], r->space.walls[i].a);
        set_exact(&x->ends[i][1], r->space.walls[i].b);
    }
    x->wall_count = r->space.wall_count;
    sl_set_sight *sight;
    sl_set_region regions[2] = {0};
    assert_ok(r->context,
              sl_set_sight_create(r->context, r->query, points, 2, SL_SET_LINE, &sight));
    for (int k = 0; k < 2; k++)
        assert_ok(r->context, sl_set_sight_region(r->context, sight, (sl_set_seen)k, &regions[k]));
    check_membership(r, sight, x, s, regions, random, seed);
    for (int k = 0; k < 2; k++) sl_set_region_destroy(r->context, &regions[k]);
    sl_set_sight_destroy(r->context, sight);
}

static void random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    brute *x = calloc(1, sizeof *x);
    assert_non_null(x);
    brute_open(x);
    for (uint64_t seed = 1; seed <= testing_seeds(100); seed++) {
        room r;
        sl_random random = {seed};
        if (make_random(context, seed, &r)) check_segment(&r, x, &random, seed);
        end_map(&r);
    }
    brute_close(x);
    free(x);
    sl_context_destroy(context);
}

// --- against many eyes, with doors, glass, bends and areas

/// No eye of the set sees more than is seen from some point, nor less than from all. Few points
/// are seen from some point and by no eye.
static void check_eyes(const room *r, const sl_point *points, size_t count, sl_set_kind kind,
                       uint64_t seed) {
    enum { LOOKED_AT = 40 };
    sl_random random = {seed};
    sl_set_sight *sight;
    sl_set_region regions[2] = {0};
    size_t missed = 0, unsure = 0;
    assert_ok(r->context, sl_set_sight_create(r->context, r->query, points, count, kind, &sight));
    for (int k = 0; k < 2; k++)
        assert_ok(r->context, sl_set_sight_region(r->context, sight, (sl_set_seen)k, &regions[k]));
    for (int i = 0; i < LOOKED_AT; i++) {
        const sl_point at = random_point(&r->space.bounds, &random);
        bool sees[2], by_some = false, by_all = true;
        for (int k = 0; k < 2; k++) {
            assert_ok(r->context,
                      sl_set_sight_sees(r->context, sight, (sl_set_seen)k, at, &sees[k]));
            assert_true(sees[k] == goes_around(&regions[k].shape, at));
        }
        for (size_t eye = 0; eye < eye_count(); eye++) {
            const double share = (double)eye / (double)(eye_count() - 1);
            const sl_point from = eye_of(points, count, kind, share, &random);
            bool is_seen;
            assert_ok(r->context, sl_query_sees(r->context, r->query, from, at, &is_seen));
            by_some |= is_seen;
            by_all &= is_seen;
        }
        if (by_some > sees[0] || by_all < sees[1])
            fail_msg("seed %llu: %.17g,%.17g: some %d, by an eye %d; all %d, by all eyes %d",
                     (unsigned long long)seed, at.x, at.y, sees[0], by_some, sees[1], by_all);
        missed += by_some < sees[0];
        unsure += by_all > sees[1];
    }
    assert_true(missed <= 2 && unsure <= 2);
    for (int k = 0; k < 2; k++) sl_set_region_destroy(r->context, &regions[k]);
    sl_set_sight_destroy(r->context, sight);
}

static void many_eyes(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, set_plan);
    const sl_point bend[] = {{2, 2}, {6, 7}, {12, 7.5}, {12.5, 14}}, line[] = {{9, 1}, {15, 14}};
    const sl_point area[] = {{9.2, 8.1}, {12.3, 8.4}, {12.1, 11.3}, {9.7, 10.8}};
    const sl_point court[] = {{18, 8}, {22, 8}, {22, 12}, {18, 12}},
                   short_line[] = {{1, 1}, {2, 1}};
    sl_point disc[64];
    const sl_point middle = {5.5, 12};
    const size_t corners = sl_set_of_disc(middle, 1.7, 0.01, disc, 64);
    assert_true(corners >= 20 && corners <= 64);
    for (size_t i = 0; i < corners; i++) {
        const sl_point a = disc[i], b = disc[(i + 1) % corners];
        const double sag = 1.7 - hypot((a.x + b.x) / 2 - middle.x, (a.y + b.y) / 2 - middle.y);
        assert_true(sag >= 0 && sag <= 0.01);
    }
    for (uint64_t open = 0; open < 2; open++) {
        sl_query_set_doors(r.context, r.query, open);
        check_eyes(&r, bend, 4, SL_SET_LINE, 10 + open);
        check_eyes(&r, line, 2, SL_SET_LINE, 20 + open);
        check_eyes(&r, short_line, 2, SL_SET_LINE, 30 + open);
        check_eyes(&r, area, 4, SL_SET_AREA, 40 + open);
        check_eyes(&r, court, 4, SL_SET_AREA, 50 + open);
        check_eyes(&r, disc, corners, SL_SET_AREA, 60 + open);
    }
    end_room(&r);
}

/// What one point sees is its visible region.
static void one_point(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, set_plan);
    const sl_point eye = {5, 7};
    const sl_view view = sl_view_all_round(eye);
    sl_region region = {0};
    assert_ok(r.context, sl_query_region(r.context, r.query, &view, &region));
    const sl_point twice[] = {eye, eye};
    for (int seen = 0; seen < 2; seen++) {
        assert_area(&r, &eye, 1, SL_SET_LINE, (sl_set_seen)seen, sl_region_area(&region));
        assert_area(&r, twice, 2, SL_SET_LINE, (sl_set_seen)seen, sl_region_area(&region));
    }
    sl_region_destroy(r.context, &region);
    end_room(&r);
}

/// In other units, very large and very small ones, the regions are the same, to the last bit.
static void tiny_and_huge(void **state) {
    (void)state;
    static const sl_segment walls[] = {
        {{0, 0}, {20, 1}}, {{20, 1}, {21, 12}}, {{21, 12}, {-1, 11}}, {{-1, 11}, {0, 0}},
        {{9, 5}, {11, 6}}, {{4, 7}, {6, 4}},    {{11, 6}, {13, 4.5}}};
    double areas[2] = {0};
    for (int exponent = -450; exponent <= 450; exponent += 150) {
        char text[1024];
        size_t length = 0;
        room r;
        for (size_t i = 0; i < sizeof walls / sizeof *walls; i++)
            length += (size_t)snprintf(
                text + length, sizeof text - length, "wall %.17g %.17g %.17g %.17g\n",
                ldexp(walls[i].a.x, exponent), ldexp(walls[i].a.y, exponent),
                ldexp(walls[i].b.x, exponent), ldexp(walls[i].b.y, exponent));
        make_room(&r, NULL, text);
        const sl_point line[] = {{ldexp(5, exponent), ldexp(2, exponent)},
                                 {ldexp(14, exponent), ldexp(3, exponent)}};
        for (int seen = 0; seen < 2; seen++) {
            const double area = area_of(&r, line, 2, SL_SET_LINE, (sl_set_seen)seen);
            if (exponent == -450) areas[seen] = ldexp(area, 900);
            assert_true(area > 0 && ldexp(area, -2 * exponent) == areas[seen]);
        }
        end_room(&r);
    }
}

/// Each allocation that fails leaves nothing behind.
static void memory_that_ends(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r = {.context = testing_context(&memory)};
    testing_space(r.context, set_plan, &r.map, &r.space);
    assert_ok(r.context, sl_query_over(r.context, &r.space, &r.map, NULL, &r.query));
    assert_ok(r.context, sl_query_prepare(r.context, r.query));
    const sl_point area[] = {{9.2, 8.1}, {12.3, 8.4}, {12.1, 11.3}, {7, 10.8}};
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status != SL_OK; at++) {
        const long live = memory.live;
        sl_set_sight *sight = NULL;
        sl_set_region regions[2] = {0};
        memory.calls = 0;
        memory.fail_at = at;
        memory.once = true;
        status = sl_set_sight_create(r.context, r.query, area, 4, SL_SET_AREA, &sight);
        for (int k = 0; k < 2 && status == SL_OK; k++)
            status = sl_set_sight_region(r.context, sight, (sl_set_seen)k, &regions[k]);
        for (int k = 0; k < 2; k++) sl_set_region_destroy(r.context, &regions[k]);
        sl_set_sight_destroy(r.context, status == SL_OK || sight ? sight : NULL);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        assert_int_equal(memory.live, live);
    }
    memory.fail_at = 0;
    end_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(behind_a_wall),    cmocka_unit_test(rooms_and_doors),
        cmocka_unit_test(on_a_wall),        cmocka_unit_test(areas),
        cmocka_unit_test(many_slits),       cmocka_unit_test(wrong_sets),
        cmocka_unit_test(random_maps),      cmocka_unit_test(many_eyes),
        cmocka_unit_test(one_point),        cmocka_unit_test(tiny_and_huge),
        cmocka_unit_test(memory_that_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
