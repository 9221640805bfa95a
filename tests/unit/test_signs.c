/// Signs, and the parts of paths that no viewpoint sees: by hand, and on random maps against the
/// law of the visibility catchment area and sl_query_sees, point by point.
#include "room.h"

#include "oracle/random_map.h"
#include "oracle/random_oblique.h"
#include "sightline/coverage.h"
#include "sightline/place.h"
#include "sightline/place_area.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static bool is_near(double a, double b, double tolerance) {
    return fabs(a - b) <= tolerance;
}

static sl_viewpoint sign_at(double x, double y, double heading, double range) {
    sl_viewpoint sign = {.at = {x, y}, .heading = heading, .range = range};
    sl_viewpoint_sign(&sign, 0);
    return sign;
}

static double area_read(room *r, sl_viewpoint sign) {
    sl_coverage c;
    assert_ok(r->context, sl_coverage_make(r->context, r->query, &sign, 1, &c));
    const double area = c.seen[0];
    sl_coverage_destroy(r->context, &c);
    return area;
}

static void letters_make_the_distance(void **state) {
    (void)state;
    sl_viewpoint sign = {.heading = 30};
    sl_viewpoint_sign(&sign, 0.15);
    assert_true(sign.sign && sign.range == 0.15 * SL_SIGN_FACTOR);
    sign.range = 4;
    sl_viewpoint_sign(&sign, 0.15);
    assert_true(sign.range == 4); // the smaller one
    sl_viewpoint_sign(&sign, 0.01);
    assert_true(sign.range == 0.01 * SL_SIGN_FACTOR);
}

/// A disc that touches the wall: on the side that the sign faces, also on the wall itself.
static void one_disc(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL,
              "walls 0 0 40 0 40 20 0 20 0 0\nwall 20 0 20 20\nstart 2 5 0\nstart 30 5 0\n");
    const double disc = PI * 16;
    assert_true(is_near(area_read(&r, sign_at(20, 10, 0, 8)), disc, 2e-4 * disc));
    assert_true(is_near(area_read(&r, sign_at(20, 10, 180, 8)), disc, 2e-4 * disc));
    assert_true(is_near(area_read(&r, sign_at(10, 10, 17.3, 8)), disc, 2e-4 * disc));
    assert_true(area_read(&r, sign_at(0, 10, 180, 8)) == 0);   // it faces out of the map
    assert_true(area_read(&r, sign_at(20, 10, 0, 8)) <= disc); // nothing that is not read
    // Half of the disc is behind the wall, 4 before the sign.
    assert_true(is_near(area_read(&r, sign_at(16, 10, 0, 8)), disc / 2, 2e-4 * disc));
    end_room(&r);
}

static void half_read_behind_a_corner(void **state) {
    (void)state;
    // The wall hides the lower half of the disc.
    room r;
    make_room(&r, NULL,
              "walls 0 0 40 0 40 20 0 20 0 0\nwall 0 10 20 10\nstart 2 5 0\nstart 2 15 0\n");
    const double disc = PI * 16;
    assert_true(is_near(area_read(&r, sign_at(2, 10, 0, 8)), disc / 2, 2e-4 * disc));
    end_room(&r);
}

/// At each angle the distance is that straight before the sign times the cosine.
static void cosine_of_the_angle(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 40 0 40 40 0 40 0 0\nstart 2 5 0\n");
    const sl_viewpoint sign = sign_at(20, 20, 50, 10);
    sl_coverage c;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, &sign, 1, &c));
    for (int angle = -80; angle <= 80; angle += 2) { // chords are as far off as 1e-3 there
        const double far = 10 * cos(angle * PI / 180), turned = (50 + angle) * PI / 180;
        for (int side = -1; side <= 1; side += 2) {
            const double way = far * (1 + side * 1e-3) + side * 1e-3;
            const sl_point at = {20 + way * cos(turned), 20 + way * sin(turned)};
            if (way <= 0) continue;
            assert_int_equal(c.overlay.counts[sl_space_locate(&c.overlay.pieces, at)], side < 0);
        }
    }
    sl_coverage_destroy(r.context, &c);
    end_room(&r);
}

// --- paths

static void parts_of_a_path(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL,
              "walls 0 0 40 0 40 20 0 20 0 0\nwall 20 0 20 8\nwall 20 12 20 20\nstart 2 5 0\n");
    // Discs of 8 about (4, 10) and of 6 about (31, 10).
    const sl_viewpoint signs[] = {sign_at(0, 10, 0, 8), sign_at(28, 10, 0, 6)};
    const sl_point path[] = {{1, 10}, {39, 10}, {39, 10}, {39, 19}};
    sl_coverage c;
    sl_path_parts p;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, signs, 2, &c));
    assert_ok(r.context, sl_coverage_of_path(r.context, r.query, &c, signs, path, 4, &p));
    assert_int_equal(p.count, 2);
    assert_true(is_near(p.length, 47, 1e-9) && is_near(p.total, 20 + 14, 1e-9));
    assert_true(is_near(p.parts[0].from, 7, 1e-9) && is_near(p.parts[0].to, 27, 1e-9));
    assert_true(is_near(p.parts[0].start.x, 8, 1e-9) && is_near(p.parts[0].end.x, 28, 1e-9));
    assert_true(is_near(p.parts[1].from, 33, 1e-9) && p.parts[1].to == 47);
    assert_true(p.parts[1].end.y == 19);
    sl_path_parts_destroy(r.context, &p);
    sl_coverage_destroy(r.context, &c);
    // A camera with a dead zone: along the wall that it looks along, and without one.
    const sl_viewpoint camera = {.at = {0, 0}, .heading = 45, .fov = 90, .range = 30, .nearest = 5};
    const sl_point wall[] = {{40, 0}, {0, 0}};
    assert_ok(r.context, sl_coverage_make(r.context, r.query, &camera, 1, &c));
    assert_ok(r.context, sl_coverage_of_path(r.context, r.query, &c, &camera, wall, 2, &p));
    assert_int_equal(p.count, 2);
    assert_true(is_near(p.parts[0].to, 20, 1e-9)); // behind the wall across
    assert_true(is_near(p.parts[1].from, 35, 1e-9) && p.parts[1].to == 40);
    sl_path_parts_destroy(r.context, &p);
    sl_coverage_destroy(r.context, &c);
    // Nobody looks.
    assert_ok(r.context, sl_coverage_make(r.context, r.query, NULL, 0, &c));
    assert_ok(r.context, sl_coverage_of_path(r.context, r.query, &c, NULL, path, 4, &p));
    assert_true(p.count == 1 && p.total == p.length && p.parts[0].to == p.length);
    sl_path_parts_destroy(r.context, &p);
    sl_coverage_destroy(r.context, &c);
    end_room(&r);
}

static void wrong_questions(void **state) {
    (void)state;
    room r;
    make_room(&r, NULL, "walls 0 0 40 0 40 20 0 20 0 0\noneway 20 0 20 20\nstart 2 5 0\n");
    const sl_viewpoint sign = sign_at(2, 2, 0, 4), camera = {.at = {2, 2}, .fov = 360};
    sl_viewpoint none = sign;
    sl_coverage c;
    sl_path_parts p;
    none.range = 0;
    assert_int_equal(sl_coverage_make(r.context, r.query, &none, 1, &c), SL_BAD_ARGUMENT);
    assert_int_equal(sl_coverage_make(r.context, r.query, &sign, 1, &c), SL_UNSUPPORTED);
    assert_non_null(strstr(sl_context_message(r.context), "one-way glass"));
    assert_ok(r.context, sl_coverage_make(r.context, r.query, &camera, 1, &c));
    const sl_point path[] = {{1, 10}, {41, 10}};
    assert_int_equal(sl_coverage_of_path(r.context, r.query, &c, &camera, path, 2, &p),
                     SL_BAD_ARGUMENT);
    assert_non_null(strstr(sl_context_message(r.context), "point 2"));
    assert_int_equal(sl_coverage_of_path(r.context, r.query, &c, &camera, path, 1, &p),
                     SL_BAD_ARGUMENT);
    assert_true(p.count == 0 && !p.parts);
    sl_coverage_destroy(r.context, &c);
    sl_placement placed;
    const sl_point target = {3, 3};
    const sl_place_list list = {
        .places = &sign, .place_count = 1, .targets = &target, .target_count = 1};
    assert_int_equal(sl_place_among(r.context, r.query, &list, NULL, &placed), SL_UNSUPPORTED);
    end_room(&r);
}

// --- on random maps

enum { SIGNS = 4, POINTS = 60 };

static bool make_random(sl_context *context, uint64_t seed, room *r) {
    *r = (room){.context = context};
    if (seed % 2)
        assert_ok(context, oracle_random_map(context, seed, (oracle_grid)(seed % 3), &r->map));
    else
        assert_ok(context, oblique_random_map(context, seed, OBLIQUE_ANYWHERE, 20, &r->map));
    assert_ok(context, sl_map_clean(context, &r->map, NULL, NULL));
    if (!r->map.wall_count) return false;
    assert_ok(context, sl_subdivision_for(&r->map)->subdivide(context, &r->map, NULL, &r->space));
    assert_ok(context, sl_query_over(context, &r->space, &r->map, NULL, &r->query));
    return true;
}

/// Whether a sign is read from a place, by the law itself: 1, 0, or -1 where rounding tells.
static int is_read(room *r, const sl_viewpoint *sign, sl_point at) {
    const double x = at.x - sign->at.x, y = at.y - sign->at.y, away = hypot(x, y);
    const double turned = sign->heading * PI / 180;
    const double far = sign->range * (x * cos(turned) + y * sin(turned)) / away;
    bool sees;
    if (fabs(away - far) < 1e-3 * sign->range) return -1;
    if (away > far) return 0;
    assert_ok(r->context, sl_query_sees(r->context, r->query, at, sign->at, &sees));
    return sees;
}

static int is_read_of_any(room *r, const sl_viewpoint *signs, sl_point at) {
    int any = 0;
    for (int k = 0; k < SIGNS; k++) {
        const int read = is_read(r, &signs[k], at);
        if (read > 0) return 1;
        if (read < 0) any = -1;
    }
    return any;
}

static void check_random(room *r, const sl_viewpoint *signs, sl_random *random, int counts[2]) {
    sl_coverage c;
    assert_ok(r->context, sl_coverage_make(r->context, r->query, signs, SIGNS, &c));
    for (int i = 0; i < POINTS; i++) {
        const sl_point at = random_point(&r->space.bounds, random);
        const int read = is_read_of_any(r, signs, at);
        const uint32_t cell = sl_space_locate(&r->space, at);
        if (read < 0 || !r->space.cells[cell].inside) continue;
        assert_int_equal(c.overlay.counts[sl_space_locate(&c.overlay.pieces, at)] > 0, read);
    }
    const sl_point path[] = {random_point(&r->space.bounds, random),
                             random_point(&r->space.bounds, random),
                             random_point(&r->space.bounds, random)};
    sl_path_parts p;
    assert_ok(r->context, sl_coverage_of_path(r->context, r->query, &c, signs, path, 3, &p));
    for (size_t i = 0; i < p.count; i++)
        assert_true(p.parts[i].from < p.parts[i].to && (!i || p.parts[i - 1].to < p.parts[i].from));
    double before = 0;
    for (int s = 0; s < 2; s++) {
        const double length = hypot(path[s + 1].x - path[s].x, path[s + 1].y - path[s].y);
        for (int i = 0; i < POINTS; i++) {
            const double t = sl_random_unit(random), along = before + t * length;
            const sl_point at = {path[s].x + t * (path[s + 1].x - path[s].x),
                                 path[s].y + t * (path[s + 1].y - path[s].y)};
            bool unseen = false;
            for (size_t k = 0; k < p.count; k++)
                unseen |= p.parts[k].from <= along && along <= p.parts[k].to;
            const int read = is_read_of_any(r, signs, at);
            if (read < 0) continue;
            assert_int_equal(unseen, !read);
            counts[read]++;
        }
        before += length;
    }
    assert_true(is_near(before, p.length, 1e-9 * before));
    sl_path_parts_destroy(r->context, &p);
    sl_coverage_destroy(r->context, &c);
}

static void random_maps(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    int counts[2] = {0};
    const uint64_t seeds = testing_seeds(300);
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        room r;
        sl_random random = {seed};
        if (make_random(context, seed, &r)) {
            sl_viewpoint signs[SIGNS];
            const double size = r.space.bounds.max.x - r.space.bounds.min.x;
            for (int k = 0; k < SIGNS; k++) {
                const sl_point at = random_point(&r.space.bounds, &random);
                signs[k] = sign_at(at.x, at.y, 360 * sl_random_unit(&random),
                                   size * (0.1 + sl_random_unit(&random)));
            }
            check_random(&r, signs, &random, counts);
        }
        sl_query_destroy(context, r.query);
        sl_space_destroy(context, &r.space);
        sl_map_destroy(context, &r.map);
    }
    assert_true(counts[0] > (int)seeds && counts[1] > (int)seeds); // both are there to be checked
    sl_context_destroy(context);
}

/// Each allocation that fails leaves nothing behind.
static void memory_that_ends(void **state) {
    (void)state;
    testing_memory memory = {0};
    room r;
    make_room(&r, &memory, "walls 0 0 40 0 40 20 0 20 0 0\nwall 0 10 20 10\nstart 2 5 0\n");
    const sl_viewpoint sign = sign_at(2, 10, 0, 8);
    const sl_point path[] = {{1, 15}, {39, 15}};
    sl_coverage c;
    sl_path_parts p;
    assert_ok(r.context, sl_coverage_make(r.context, r.query, &sign, 1, &c));
    assert_ok(r.context, sl_coverage_of_path(r.context, r.query, &c, &sign, path, 2, &p));
    sl_path_parts_destroy(r.context, &p);
    sl_coverage_destroy(r.context, &c);
    const long live = memory.live;
    sl_status status = SL_NO_MEMORY;
    for (long at = 1; status != SL_OK; at++) {
        memory.calls = 0;
        memory.fail_at = at;
        memory.once = true;
        c = (sl_coverage){0};
        p = (sl_path_parts){0};
        status = sl_coverage_make(r.context, r.query, &sign, 1, &c);
        if (status == SL_OK)
            status = sl_coverage_of_path(r.context, r.query, &c, &sign, path, 2, &p);
        assert_true(status == SL_OK || status == SL_NO_MEMORY);
        sl_path_parts_destroy(r.context, &p);
        sl_coverage_destroy(r.context, &c);
        assert_true(memory.live <= live + 1);
    }
    memory.fail_at = 0;
    end_room(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(letters_make_the_distance),
                                       cmocka_unit_test(one_disc),
                                       cmocka_unit_test(half_read_behind_a_corner),
                                       cmocka_unit_test(cosine_of_the_angle),
                                       cmocka_unit_test(parts_of_a_path),
                                       cmocka_unit_test(wrong_questions),
                                       cmocka_unit_test(random_maps),
                                       cmocka_unit_test(memory_that_ends)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
