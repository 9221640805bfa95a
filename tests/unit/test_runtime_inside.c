/// What the runtime header computes with, looked at from inside: signs, differences that no double
/// holds, and numbers as text.
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include "testing.h"

#include "geometry/crossing.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>
#include <string.h>

// --- signs

/// Signs of cross products of three points, as they are or as the eye's arms give them.
static void signs_are_exact(void **state) {
    (void)state;
    sl_random random = {5};
    for (int i = 0; i < 200000; i++) {
        // Nearly in line, far from the origin, of mixed sizes.
        const double scale = ldexp(1, (int)sl_random_below(&random, 900) - 430);
        const double offset = sl_random_below(&random, 2) ? 0 : scale * 1000;
        sl_point p[3];
        for (int k = 0; k < 3; k++) {
            const double along = 1 + (double)sl_random_below(&random, 64);
            p[k] = (sl_point){offset + scale * along, offset + scale * along * 3};
            if (sl_random_below(&random, 2)) p[k].x = nextafter(p[k].x, INFINITY);
            if (sl_random_below(&random, 2)) p[k].y = nextafter(p[k].y, -INFINITY);
        }
        const slrt_arm u = slrt_make_arm(p[0].x, p[0].y, p[1].x, p[1].y);
        const slrt_arm v = slrt_make_arm(p[0].x, p[0].y, p[2].x, p[2].y);
        assert_int_equal(slrt_side(&u, &v), sli_orient(p[0], p[1], p[2]));
        assert_int_equal(slrt_side_exact(&u, &v), sli_orient(p[0], p[1], p[2]));
    }
}

static int64_t small(sl_random *random) {
    return (int64_t)sl_random_below(random, 9) - 4;
}

/// The sign of the library's and the runtime's polynomial, which must be the same.
static int axial_sign(sl_point eye, sl_point point, sl_point a, sl_point b, int axis,
                      double value) {
    const slrt_search s = {.x = eye.x, .y = eye.y};
    const slrt_arm u = slrt_make_arm(eye.x, eye.y, point.x, point.y);
    const slrt_point p = {a.x, a.y}, q = {b.x, b.y};
    const int sign = sli_axial_meet_side(eye, point, a, b, axis, value);
    assert_int_equal(slrt_side_meets(&s, &u, p, q, axis, value), sign);
    assert_int_equal(slrt_side_meets_exact(&s, &u, p, q, axis, value), sign);
    return sign;
}

/// Against whole numbers; at 0.1 and so on, where rounding would decide; near overflow and
/// underflow.
static void signs_of_meeting_lines(void **state) {
    (void)state;
    sl_random random = {5};
    size_t zeros = 0;
    for (int i = 0; i < 100000; i++) {
        int64_t n[9];
        for (int k = 0; k < 9; k++) n[k] = small(&random);
        const int axis = i % 2;
        const int64_t ux = n[2] - n[0], uy = n[3] - n[1], sx = n[6] - n[4], sy = n[7] - n[5];
        const int64_t turn = sx * (n[5] - n[1]) - sy * (n[4] - n[0]), cross = sx * uy - sy * ux;
        const int64_t truth = (axis ? uy : ux) * turn - cross * (n[8] - n[axis]);
        const double scale = ldexp(1, (int)sl_random_below(&random, 900) - 450);
        double d[9];
        for (int k = 0; k < 9; k++) d[k] = scale * (double)n[k];
        const int sign = axial_sign((sl_point){d[0], d[1]}, (sl_point){d[2], d[3]},
                                    (sl_point){d[4], d[5]}, (sl_point){d[6], d[7]}, axis, d[8]);
        assert_int_equal(sign, (truth > 0) - (truth < 0));
        zeros += !sign;
        for (int k = 0; k < 9; k++) d[k] = 0.1 * (double)n[k] + 0.3;
        axial_sign((sl_point){d[0], d[1]}, (sl_point){d[2], d[3]}, (sl_point){d[4], d[5]},
                   (sl_point){d[6], d[7]}, axis, d[8]);
    }
    assert_true(zeros > 1000);
}

// --- differences

__extension__ typedef __int128 wide;

static wide size_of(wide number) {
    return number < 0 ? -number : number;
}

/// Cross products of differences that no double holds, against whole numbers: any two, and two that
/// are nearly in line.
static void cross_products(void **state) {
    (void)state;
    sl_random random = {7};
    for (int i = 0; i < 100000; i++) {
        int64_t to[4], from[4];
        wide is[4];
        slrt_pair pairs[4];
        for (int k = 0; k < 4; k++) {
            const bool in_line = i % 2 && k > 1; // and three times as long
            to[k] = in_line ? 3 * to[k - 2] : (int64_t)sl_random_below(&random, 1ull << 50) * 1024;
            from[k] = in_line ? 3 * from[k - 2] + (int64_t)sl_random_below(&random, 9)
                              : (int64_t)sl_random_below(&random, 1ull << 40);
            is[k] = (wide)to[k] - from[k];
            pairs[k] = slrt_difference((double)to[k], (double)from[k]);
            assert_true((wide)pairs[k].high + (wide)pairs[k].low == is[k]);
        }
        const wide left = is[0] * is[3], right = is[1] * is[2], exact = left - right;
        const wide found = (wide)slrt_cross(pairs[0], pairs[1], pairs[2], pairs[3]);
        const wide most = (size_of(exact) >> 52) + ((size_of(left) + size_of(right)) >> 100) + 1;
        assert_true(size_of(found - exact) <= most);
    }
}

// --- numbers

static bool reads(const char *text, double *value) {
    slrt_text line = {(const unsigned char *)text, (const unsigned char *)text + strlen(text)};
    return slrt_take_number(&line, false, value);
}

static void same_number(const char *text) {
    double is, said = NAN;
    const bool finite = sl_number_read(text, strlen(text), &is) && isfinite(is);
    if (reads(text, &said) != finite || (finite && memcmp(&is, &said, sizeof is) != 0))
        fail_msg("%s is read as %.17g", text, said);
}

static void numbers_are_read_to_the_last_bit(void **state) {
    (void)state;
    static const char *const hard[] = {"0",
                                       "-0",
                                       "+.5",
                                       "5.",
                                       ".",
                                       "-",
                                       "",
                                       "e5",
                                       "1e",
                                       "1e+",
                                       "1.2.3",
                                       "0x1",
                                       "inf",
                                       "nan",
                                       "1e308",
                                       "1.7976931348623157e308",
                                       "1.7976931348623158e308",
                                       "1.7976931348623159e308",
                                       "1e309",
                                       "1e99999999999",
                                       "0e99999999999",
                                       "1e-99999999999",
                                       "4.9e-324",
                                       "2.4703282292e-324",
                                       "2.4703282292062328e-324",
                                       "2.2250738585072011e-308",
                                       "2.2250738585072014e-308",
                                       "9007199254740993",
                                       "9007199254740992.9999",
                                       "9007199254740993.00000000000000000000000001",
                                       "0.1",
                                       "1e22",
                                       "1e23",
                                       "8.5e-5",
                                       "123456789012345678901234567890",
                                       "-1.5E+3",
                                       "1,5"};
    char text[600];
    sl_random random = {17};
    for (size_t i = 0; i < sizeof hard / sizeof *hard; i++) same_number(hard[i]);
    for (int length = 490; length < 520; length++) {
        double value;
        memset(text, '3', (size_t)length);
        memcpy(text + length, "e-505", 6);
        if (length + 5 < 512)
            same_number(text);
        else
            assert_false(reads(text, &value));
        text[length] = '\0';
        assert_false(reads(text, &value));
    }
    for (int i = 0; i < 20000; i++) {
        const uint64_t bits = sl_random_next(&random);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        snprintf(text, sizeof text, "%.*g", 1 + (int)sl_random_below(&random, 20), value);
        same_number(text);
        // A tie between two doubles, written to its last digit.
        const double whole = (double)(bits >> 12) + 0x1p52;
        snprintf(text, sizeof text, "%.0f.5", whole);
        same_number(text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(signs_are_exact),
        cmocka_unit_test(signs_of_meeting_lines),
        cmocka_unit_test(cross_products),
        cmocka_unit_test(numbers_are_read_to_the_last_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
