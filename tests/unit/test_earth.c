// Longitude and latitude in a plane and back; lengths against integrals over the ellipsoid.
#include "testing.h"

#include "map_same.h"
#include "sightline/earth.h"

#include <math.h>

static const double degree = 3.14159265358979323846 / 180;

static const sl_earth origins[] = {{.known = true, .longitude = 0, .latitude = 0},
                                   {.known = true, .longitude = 10, .latitude = 60},
                                   {.known = true, .longitude = -179.99, .latitude = -45},
                                   {.known = true, .longitude = 180, .latitude = 78.2},
                                   {.known = true, .longitude = 139.7, .latitude = 0},
                                   {.known = true, .longitude = 12.5, .latitude = -89.9}};
enum { ORIGINS = sizeof origins / sizeof *origins };

/// There and back, up to some 100 km: within 1e-10 degrees, a hundredth of a millimetre.
static void test_round_trip(void **state) {
    (void)state;
    sl_random random = {7};
    for (int i = 0; i < 20000; i++) {
        const sl_earth *earth = &origins[i % ORIGINS];
        const double reach = pow(10, -6 + 6 * sl_random_unit(&random));
        const double wide = reach / fmax(cos(earth->latitude * degree), 0.05);
        sl_point p = {earth->longitude + wide * (2 * sl_random_unit(&random) - 1),
                      earth->latitude + reach * (2 * sl_random_unit(&random) - 1)};
        p.y = fmax(-89.99, fmin(89.99, p.y));
        const sl_point back = sl_earth_of_map(earth, sl_earth_to_map(earth, p));
        const double east = remainder(back.x - p.x, 360) * cos(p.y * degree);
        assert_true(fabs(east) < 1e-10 && fabs(back.y - p.y) < 1e-10);
        assert_true(back.x >= -180 && back.x <= 180);
    }
}

/// The radius of curvature along a meridian, and that of a parallel, by their definitions.
static double along_meridian(double latitude) {
    const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f), s = sin(latitude);
    return a * (1 - e2) / pow(1 - e2 * s * s, 1.5);
}

static double of_parallel(double latitude) {
    const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f), s = sin(latitude);
    return a * cos(latitude) / sqrt(1 - e2 * s * s);
}

/// The meridian from the origin to a latitude, by Simpson's rule.
static double meridian(double from, double to) {
    enum { STEPS = 2000 };
    double sum = 0;
    const double step = (to - from) / STEPS;
    for (int i = 0; i <= STEPS; i++)
        sum += along_meridian(from + i * step) * (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2);
    return sum * step / 3;
}

static void test_meridian(void **state) {
    (void)state;
    for (int i = 0; i < ORIGINS; i++) {
        const sl_earth *earth = &origins[i];
        for (double to = -80; to <= 80; to += 16) {
            const sl_point at = sl_earth_to_map(earth, (sl_point){earth->longitude, to});
            assert_true(fabs(at.x) < 1e-6);
            assert_true(fabs(at.y - meridian(earth->latitude * degree, to * degree)) < 1e-6);
        }
    }
}

/// Small steps east and north, away from the meridian: as long as the stretch says, and at right
/// angles.
static void test_stretch(void **state) {
    (void)state;
    const double small = 1e-4 * degree;
    for (double latitude = -60; latitude <= 60; latitude += 30) {
        const sl_earth earth = {.known = true, .longitude = 20, .latitude = latitude};
        for (double east = 0; east <= 3; east += 0.5) {
            const sl_point p = {20 + east, latitude};
            const sl_point at = sl_earth_to_map(&earth, p);
            const sl_point e = sl_earth_to_map(&earth, (sl_point){p.x + small / degree, p.y});
            const sl_point n = sl_earth_to_map(&earth, (sl_point){p.x, p.y + small / degree});
            const double ex = e.x - at.x, ey = e.y - at.y, nx = n.x - at.x, ny = n.y - at.y;
            const double wide = hypot(ex, ey) / (of_parallel(latitude * degree) * small);
            const double high = hypot(nx, ny) / (along_meridian(latitude * degree) * small);
            const double expected = sl_earth_stretch(at.x);
            // R differs by up to 0.7 % from the equator's, so the excess does by 1.4 %.
            assert_true(fabs(wide - expected) < 2e-6 + 0.02 * (expected - 1));
            assert_true(fabs(high - expected) < 2e-6 + 0.02 * (expected - 1));
            assert_true(fabs(ex * nx + ey * ny) < 1e-5 * hypot(ex, ey) * hypot(nx, ny));
        }
    }
}

/// The way over 180 degrees is short.
static void test_date_line(void **state) {
    (void)state;
    const sl_earth earth = {.known = true, .longitude = 179.9, .latitude = 10};
    const sl_point at = sl_earth_to_map(&earth, (sl_point){-179.9, 10});
    assert_true(at.x > 0 && at.x < 30000);
    assert_true(fabs(sl_earth_of_map(&earth, at).x + 179.9) < 1e-11);
}

/// Map text says where the map lies, and the same numbers are read back.
static void test_map_text(void **state) {
    (void)state;
    sl_context *context = testing_context(NULL);
    const char *text = "sightline 1\nunit m\nearth 10.000000000000002 -60.5\nwall 0 0 1 1\n";
    sl_map map = {0}, copy = {0};
    assert_ok(context, sli_map_read_text(context, "f", text, strlen(text), &map));
    assert_ok(context, sl_map_copy(context, &map, &copy));
    assert_true(copy.earth.known);
    assert_true(copy.earth.longitude == 10.000000000000002 && copy.earth.latitude == -60.5);
    char *again = map_text(&copy);
    assert_string_equal(again, text);
    free(again);
    sl_map_destroy(context, &map);
    sl_map_destroy(context, &copy);
    sl_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip), cmocka_unit_test(test_meridian),
        cmocka_unit_test(test_stretch),    cmocka_unit_test(test_date_line),
        cmocka_unit_test(test_map_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
