/// The visible region where the answer is known: measures, range, cones, eyes in odd places,
/// memory.
#include "sight/region.h"
#include "space/outline.h"
#include "testing.h"

#include "sightline/region.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

typedef struct place {
    sl_context *context;
    sl_map map;
    sl_space space;
    sl_outline outline;
    sl_region region;
} place;

static void enter(place *p, testing_memory *memory, const char *statements) {
    *p = (place){.context = testing_context(memory)};
    testing_space(p->context, statements, &p->map, &p->space);
    assert_ok(p->context, sli_outline_make(p->context, &p->space, &p->outline));
}

static void leave(place *p) {
    sl_region_destroy(p->context, &p->region);
    sli_outline_destroy(p->context, &p->outline);
    sl_space_destroy(p->context, &p->space);
    sl_map_destroy(p->context, &p->map);
    sl_context_destroy(p->context);
}

static sl_region_measures look(place *p, sl_view view, double range) {
    assert_ok(p->context, sli_region_make(p->context, &p->outline, &view, range, &p->region));
    return sl_region_measure(&p->region);
}

#define ROOM "walls 0 0 4 0 4 2 0 2 0 0\n"
#define assert_within(found, expected, limit)                                                      \
    do {                                                                                           \
        const double found_value = (found), due = (expected);                                      \
        if (!(fabs(found_value - due) <= (limit)))                                                 \
            fail_msg("%s: %.17g, not %.17g", #found, found_value, due);                            \
    } while (0)
#define assert_close(found, expected) assert_within(found, expected, 1e-12)

static void measures_of_a_room(void **state) {
    (void)state;
    place p;
    enter(&p, NULL, ROOM);
    const sl_region_measures m = look(&p, sl_view_all_round((sl_point){1, 1}), 0);
    assert_int_equal(p.region.count, 4);
    assert_close(m.area, 8);
    assert_close(m.perimeter, 12);
    assert_close(m.compactness, 4 * pi * 8 / 144);
    assert_close(m.occlusivity, 0);
    assert_close(m.drift_magnitude, 1);
    assert_close(m.drift_angle, 0);
    assert_close(m.min_radial, 1);
    assert_close(m.max_radial, sqrt(10));
    // Radials of a square room seen from its middle: 1 / cos a, a from -45 to 45 degrees.
    place square;
    enter(&square, NULL, "walls 0 0 2 0 2 2 0 2 0 0\n");
    const sl_region_measures s = look(&square, sl_view_all_round((sl_point){1, 1}), 0);
    const double mean = 2 * asinh(1) / (pi / 2), second = 4 / pi;
    const double third = (sqrt(2) + asinh(1)) / (pi / 2);
    assert_close(s.mean_radial, mean);
    assert_close(s.radial_variance, second - mean * mean);
    assert_close(s.radial_skewness, third - 3 * mean * second + 2 * mean * mean * mean);
    assert_close(s.drift_magnitude, 0);
    sl_point corners[4];
    assert_int_equal(sl_region_corners(&square.region, &square.space, corners, 4), 4);
    leave(&square);
    leave(&p);
}

static void a_wall_hides_what_is_behind_it(void **state) {
    (void)state;
    place p;
    // From 1 2 the wall x = 2, y 1 to 3 hides a trapezium of area (2 + 6) / 2 * 2.
    enter(&p, NULL, "walls 0 -1 4 -1 4 5 0 5 0 -1\nwall 2 1 2 3\n");
    const sl_region_measures m = look(&p, sl_view_all_round((sl_point){1, 2}), 0);
    assert_close(m.area, 24 - 8);
    assert_close(m.occlusivity, 2 * hypot(2, 2));
    sl_point corners[8];
    assert_int_equal(sl_region_corners(&p.region, &p.space, corners, 8), 6);
    leave(&p);
}

static void range_is_a_circle(void **state) {
    (void)state;
    place p;
    enter(&p, NULL, "walls -2 -2 2 -2 2 2 -2 2 -2 -2\n");
    sl_region_measures m = look(&p, sl_view_all_round((sl_point){0.25, 0}), 1);
    assert_close(m.area, pi);
    assert_close(m.perimeter, 2 * pi);
    assert_close(m.compactness, 1);
    assert_close(m.drift_magnitude, 0);
    assert_close(m.min_radial, 1);
    assert_close(m.max_radial, 1);
    assert_close(m.mean_radial, 1);
    assert_close(m.radial_variance, 0);
    // A wall one unit away cuts a segment of 120 degrees off a circle of radius 2.
    m = look(&p, sl_view_all_round((sl_point){-1, 0}), 1.5);
    const double half = acos(1 / 1.5);
    assert_close(m.area, 2.25 * pi - 2.25 * half + sqrt(1.25));
    assert_close(m.perimeter, 3 * (pi - half) + 2 * sqrt(1.25));
    m = look(&p, sl_view_cone((sl_point){0, 0}, 30, 60, 4), 1);
    assert_close(m.area, pi / 6);
    assert_close(m.perimeter, pi / 3 + 2);
    m = look(&p, sl_view_all_round((sl_point){0, 0}), 10);
    assert_close(m.area, 16);
    leave(&p);
}

/// An eye on an oblique wall sees half a circle. Rounding may turn the sign of its arc.
static void half_a_circle_on_a_wall(void **state) {
    (void)state;
    for (int i = 1; i <= 60; i++) {
        const int x = 3 + i % 7, y = 1 + i;
        char text[128];
        place p;
        snprintf(text, sizeof text, "walls 0 0 %d %d %d %d %d %d 0 0\n", 2 * x, 2 * y,
                 2 * x - 2 * y, 2 * y + 2 * x, -2 * y, 2 * x);
        enter(&p, NULL, text);
        for (int k = 1; k < 16; k++) {
            const double range = 0.1 + 0.01 * k;
            const sl_point eye = {x * k / 8.0, y * k / 8.0};
            const sl_region_measures m = look(&p, sl_view_all_round(eye), range);
            assert_close(m.area, pi * range * range / 2);
            assert_close(m.perimeter, (pi + 2) * range);
            assert_true(sl_region_flatten(&p.region, 1e-3 * range, NULL, 0) > 32);
        }
        leave(&p);
    }
}

/// The radial function beside that of the whole region: with a range it is cut, and no more.
static void range_on_a_floor(void **state) {
    (void)state;
    place p;
    enter(&p, NULL,
          "walls 0 0 12 0 12 9 0 9 0 0\nwall 4 0 4 3\nwall 4 4 4 9\nwall 4 5 8 5\nwall 9 5 12 5\n");
    sl_region cut = {0};
    for (int i = 0; i < 60; i++) {
        const sl_point eye = {0.3 + 0.19 * i, 0.4 + fmod(1.7 * i, 8)};
        const sl_view view = sl_view_all_round(eye);
        const double range = 0.5 + 0.1 * i;
        look(&p, view, 0);
        assert_ok(p.context, sli_region_make(p.context, &p.outline, &view, range, &cut));
        // By the sum over the whole region's edges of what lies within the circle, sampled finely.
        double area = 0;
        for (size_t k = 0; k < p.region.count; k++) {
            const sl_point a = p.region.offsets[k], b = p.region.offsets[(k + 1) % p.region.count];
            const double turn = atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
            enum { SAMPLES = 2000 };
            for (int s = 0; s < SAMPLES; s++) {
                const double at = turn * (s + 0.5) / SAMPLES, c = cos(at), n = sin(at);
                const sl_point d = {c * a.x - n * a.y, n * a.x + c * a.y};
                const double share = (a.x * (b.y - a.y) - a.y * (b.x - a.x)) /
                                     (d.x * (b.y - a.y) - d.y * (b.x - a.x));
                const double radial = fmin(share * hypot(d.x, d.y), range);
                if (turn > 1e-9) area += radial * radial * turn / SAMPLES / 2;
            }
        }
        assert_within(sl_region_area(&cut), area, 1e-4 * area);
        const size_t count = sl_region_flatten(&cut, 1e-6, NULL, 0);
        sl_point *points = calloc(count, sizeof *points);
        assert_int_equal(sl_region_flatten(&cut, 1e-6, points, count), count);
        double twice = 0;
        for (size_t k = 0; k < count; k++) {
            const sl_point a = points[k], b = points[(k + 1) % count];
            twice += a.x * b.y - a.y * b.x;
        }
        assert_within(twice / 2, sl_region_area(&cut), 1e-4);
        free(points);
    }
    sl_region_destroy(p.context, &cut);
    leave(&p);
}

static void eyes_in_odd_places(void **state) {
    (void)state;
    place p;
    enter(&p, NULL, ROOM "wall 2 0 2 2\nwall 1 1 1 2\n");
    // On the middle wall: the room to its right. On the border's upper right: the same.
    assert_close(look(&p, sl_view_all_round((sl_point){2, 1}), 0).area, 4);
    assert_close(look(&p, sl_view_all_round((sl_point){4, 2}), 0).area, 4);
    assert_close(look(&p, sl_view_all_round((sl_point){4, 1}), 0).area, 4);
    // At a wall's free end: all around.
    assert_close(look(&p, sl_view_all_round((sl_point){1, 1}), 0).area, 4);
    // On the wall's side, to its right.
    assert_close(look(&p, sl_view_all_round((sl_point){1, 1.5}), 0).area, 2);
    assert_close(look(&p, sl_view_all_round((sl_point){5, 1}), 0).area, 0);
    assert_int_equal(p.region.count, 0);
    assert_int_equal(p.region.cell, SL_NO_CELL);
    look(&p, sl_view_all_round((sl_point){NAN, 1}), 0);
    assert_int_equal(p.region.count, 0);
    look(&p, sl_view_cone((sl_point){3, 1}, 45, 0, 4), 0);
    assert_int_equal(p.region.count, 0);
    leave(&p);
}

/// Two blocks, and nothing around them: what is seen between and beside them ends at the border.
static void borders_end_what_is_seen(void **state) {
    (void)state;
    const sl_point eye = {15, 5};
    place p;
    enter(&p, NULL, ROOM);
    look(&p, sl_view_all_round((sl_point){1, 1}), 0);
    assert_false(sl_region_meets_border(&p.region));
    look(&p, sl_view_all_round((sl_point){5, 1}), 0);
    assert_false(sl_region_meets_border(&p.region));
    leave(&p);
    enter(&p, NULL, "solid 0 0 10 0 10 10 0 10\nsolid 20 0 30 0 30 10 20 10\n");
    look(&p, sl_view_all_round(eye), 0);
    assert_true(sl_region_meets_border(&p.region));
    look(&p, sl_view_all_round(eye), 5.5);
    assert_true(sl_region_meets_border(&p.region));
    look(&p, sl_view_all_round(eye), 4.5);
    assert_false(sl_region_meets_border(&p.region));
    look(&p, sl_view_cone(eye, 0, 30, 10), 0);
    assert_false(sl_region_meets_border(&p.region));
    leave(&p);
}

static void far_from_the_origin(void **state) {
    (void)state;
    place p;
    enter(&p, NULL,
          "walls 1e9 1e9 1000000004 1e9 1000000004 1000000002 1e9 1000000002 1e9 1e9\n"
          "wall 1000000002 1e9 1000000002 1000000001\n");
    const sl_region_measures m = look(&p, sl_view_all_round((sl_point){1e9 + 1, 1e9 + 0.5}), 0);
    assert_close(m.area, 8 - 3);
    leave(&p);
}

static void arguments_are_checked(void **state) {
    (void)state;
    place p;
    enter(&p, NULL, ROOM);
    const sl_point eye = {1, 1};
    const sl_view views[3] = {{.eye = eye, .left = eye, .right = {2, 1}},
                              {.eye = eye, .left = {2, 1}, .right = {NAN, 1}},
                              sl_view_all_round(eye)};
    const double ranges[3] = {0, 0, -1};
    for (int i = 0; i < 3; i++) {
        look(&p, sl_view_all_round(eye), 0);
        assert_int_equal(sli_region_make(p.context, &p.outline, &views[i], ranges[i], &p.region),
                         SL_BAD_ARGUMENT);
        assert_int_equal(p.region.count, 0);
    }
    leave(&p);
}

static void memory_is_kept_and_may_fail(void **state) {
    (void)state;
    testing_memory memory = {0};
    place p;
    enter(&p, &memory, "walls 0 0 9 0 9 9 0 9 0 0\nwall 3 0 3 5\nwall 6 4 6 9\nwall 7 4 9 4\n");
    const sl_view view = sl_view_all_round((sl_point){1, 2});
    look(&p, view, 3);
    const long calls = memory.calls;
    for (int i = 0; i < 10; i++) look(&p, view, 3);
    assert_int_equal(memory.calls, calls);
    sl_region_destroy(p.context, &p.region);
    for (long n = 1;; n++) {
        memory.calls = 0;
        memory.fail_at = n;
        const sl_status status = sli_region_make(p.context, &p.outline, &view, 3, &p.region);
        memory.fail_at = 0;
        sl_region_destroy(p.context, &p.region);
        if (status == SL_OK) break;
        assert_int_equal(status, SL_NO_MEMORY);
    }
    for (long n = 1;; n++) {
        sl_outline outline = {0};
        memory.calls = 0;
        memory.fail_at = n;
        const sl_status status = sli_outline_make(p.context, &p.space, &outline);
        memory.fail_at = 0;
        sli_outline_destroy(p.context, &outline);
        if (status == SL_OK) break;
        assert_int_equal(status, SL_NO_MEMORY);
    }
    leave(&p);
    assert_int_equal(memory.live, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_of_a_room),
        cmocka_unit_test(a_wall_hides_what_is_behind_it),
        cmocka_unit_test(half_a_circle_on_a_wall),
        cmocka_unit_test(range_is_a_circle),
        cmocka_unit_test(range_on_a_floor),
        cmocka_unit_test(eyes_in_odd_places),
        cmocka_unit_test(borders_end_what_is_seen),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(memory_is_kept_and_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
