/// The exact predicate against GMP's rationals, and against what plain doubles would say.
#include "testing.h"

#include "contraction/expansion.h"
#include "geometry/crossing.h"
#include "sightline/support.h"

#include <gmp.h>
#include <math.h>

static mpq_t left_product, right_product, differences[4], ends[6];

static int set_up(void **state) {
    (void)state;
    mpq_inits(left_product, right_product, NULL);
    for (int i = 0; i < 4; i++) mpq_init(differences[i]);
    for (int i = 0; i < 6; i++) mpq_init(ends[i]);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    mpq_clears(left_product, right_product, NULL);
    for (int i = 0; i < 4; i++) mpq_clear(differences[i]);
    for (int i = 0; i < 6; i++) mpq_clear(ends[i]);
    return 0;
}

static int rational_orient(sl_point a, sl_point b, sl_point c) {
    const double values[6] = {a.x, a.y, b.x, b.y, c.x, c.y};
    for (int i = 0; i < 6; i++) mpq_set_d(ends[i], values[i]);
    mpq_sub(differences[0], ends[2], ends[0]);
    mpq_sub(differences[1], ends[5], ends[1]);
    mpq_sub(differences[2], ends[3], ends[1]);
    mpq_sub(differences[3], ends[4], ends[0]);
    mpq_mul(left_product, differences[0], differences[1]);
    mpq_mul(right_product, differences[2], differences[3]);
    return mpq_cmp(left_product, right_product);
}

static int sign(int value) {
    return (value > 0) - (value < 0);
}

static int plain_orient(sl_point a, sl_point b, sl_point c) {
    const double d = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return (d > 0) - (d < 0);
}

static void check(sl_point a, sl_point b, sl_point c) {
    const int expected = sign(rational_orient(a, b, c));
    const int found = sl_orient(a, b, c), exact = sli_orient_exact(a, b, c);
    if (found != expected || exact != expected)
        fail_msg("(%a %a) (%a %a) (%a %a): %d, exact part %d, rationals %d", a.x, a.y, b.x, b.y,
                 c.x, c.y, found, exact, expected);
}

static double steps(double value, int count) {
    for (; count > 0; count--) value = nextafter(value, INFINITY);
    for (; count < 0; count++) value = nextafter(value, -INFINITY);
    return value;
}

/// The grid of Kettner, Mehlhorn, Pion, Schirra & Yap 2008 (Classroom examples of robustness
/// problems): points one unit in the last place apart about a line. Plain doubles must fail on it,
/// or the grid would prove nothing.
static void near_collinear_grids_are_decided(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p-498, 0x1p498, 0x1p-20, 0x1p30};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        const double scale = scales[s];
        int plain_wrong = 0;
        for (int i = 0; i < 128; i++)
            for (int j = 0; j < 128; j++) {
                const sl_point a = {steps(0.5 * scale, i), steps(0.5 * scale, j)};
                const sl_point b = {12 * scale, 12 * scale}, c = {24 * scale, 24 * scale};
                check(a, b, c);
                check(c, b, a);
                check(b, a, c);
                plain_wrong += plain_orient(a, b, c) != sign(rational_orient(a, b, c));
            }
        if (!plain_wrong) fail_msg("the grid at scale %a is not hard", scale);
    }
}

enum { GRID = 128 };

/// How many signs on the grid a predicate gets wrong.
static int wrong_on_grid(int (*orient)(sl_point a, sl_point b, sl_point c), double scale) {
    const sl_point b = {12 * scale, 12 * scale}, c = {24 * scale, 24 * scale};
    int wrong = 0;
    for (int i = 0; i < GRID; i++)
        for (int j = 0; j < GRID; j++) {
            const sl_point a = {steps(0.5 * scale, i), steps(0.5 * scale, j)};
            wrong += orient(a, b, c) != sign(rational_orient(a, b, c));
        }
    return wrong;
}

/// The grid tells when a compiler contracts what must be rounded twice: the same text passes
/// compiled as all is, and fails compiled with contraction by force.
static void the_grid_finds_contraction(void **state) {
    (void)state;
    assert_int_equal(wrong_on_grid(orient_kept, 1), 0);
    if (!orient_contracts()) {
        print_message("skipped: this compiler or machine has no fused multiply-add\n");
        skip();
    }
    const int wrong = wrong_on_grid(orient_contracted, 1);
    print_message("contracted, %d of %d signs are wrong\n", wrong, GRID * GRID);
    assert_true(wrong > 0);
}

static double random_double(sl_random *random, int lowest, int highest) {
    const double mantissa = 1 + sl_random_unit(random);
    const int exponent = lowest + (int)sl_random_below(random, (uint64_t)(highest - lowest + 1));
    return ldexp(sl_random_below(random, 2) ? mantissa : -mantissa, exponent);
}

static void any_finite_doubles_are_decided(void **state) {
    (void)state;
    sl_random random = {5};
    const int ranges[][2] = {{-3, 3}, {-500, 500}, {-1074, 1023}, {-1074, -1000}, {1000, 1023}};
    for (int i = 0; i < 20000; i++) {
        const int *range = ranges[i % 5];
        double v[6];
        for (int k = 0; k < 6; k++) v[k] = random_double(&random, range[0], range[1]);
        if (i % 7 == 0) v[sl_random_below(&random, 6)] = 0;
        if (i % 11 == 0) v[2] = v[0], v[3] = v[1];
        check((sl_point){v[0], v[1]}, (sl_point){v[2], v[3]}, (sl_point){v[4], v[5]});
    }
    const double extremes[] = {0,
                               -0.0,
                               0x1p-1074,
                               -0x1p-1074,
                               0x1p-1022,
                               0x1p-537,
                               1,
                               0x1p53,
                               0x1.fffffffffffffp1023,
                               -0x1.fffffffffffffp1023};
    const size_t n = sizeof extremes / sizeof *extremes;
    for (int i = 0; i < 200000; i++) {
        double v[6];
        for (int k = 0; k < 6; k++) v[k] = extremes[sl_random_below(&random, n)];
        check((sl_point){v[0], v[1]}, (sl_point){v[2], v[3]}, (sl_point){v[4], v[5]});
    }
}

/// Points on a line, one moved by a unit in the last place: what decides is in the last bits.
static void nearly_collinear_points_are_decided(void **state) {
    (void)state;
    sl_random random = {6};
    for (int i = 0; i < 100000; i++) {
        const double shift = i % 3 ? 0 : random_double(&random, -60, 60);
        const sl_point a = {random_double(&random, -30, 30) + shift,
                            random_double(&random, -30, 30) + shift};
        const sl_point b = {random_double(&random, -30, 30) + shift,
                            random_double(&random, -30, 30) + shift};
        const double t = 4 * sl_random_unit(&random) - 2;
        sl_point c = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        c.x = steps(c.x, (int)sl_random_below(&random, 5) - 2);
        check(a, b, c);
        check(c, a, b);
    }
}

/// (b - a) x (c - a)
static void rational_determinant(sl_point a, sl_point b, sl_point c, mpq_t out) {
    rational_orient(a, b, c);
    mpq_sub(out, left_product, right_product);
}

/// The crossing lies between the ends of s, in the shares of their distances from t.
static int rational_crossing_side(sl_point from, sl_point to, sl_segment s, sl_segment t) {
    mpq_t along_a, along_b, across_a, across_b;
    mpq_inits(along_a, along_b, across_a, across_b, NULL);
    rational_determinant(t.a, t.b, s.a, along_a);
    rational_determinant(t.a, t.b, s.b, along_b);
    rational_determinant(from, to, s.a, across_a);
    rational_determinant(from, to, s.b, across_b);
    mpq_abs(along_a, along_a);
    mpq_abs(along_b, along_b);
    mpq_mul(across_a, across_a, along_b);
    mpq_mul(across_b, across_b, along_a);
    mpq_add(across_a, across_a, across_b);
    const int side = mpq_sgn(across_a);
    mpq_clears(along_a, along_b, across_a, across_b, NULL);
    return side;
}

/// Lines past crossings: anywhere, and through the crossing but for its last bits.
static void sides_of_crossings_are_decided(void **state) {
    (void)state;
    sl_random random = {7};
    int tried = 0, signs[3] = {0};
    const int ranges[][2] = {{-3, 3}, {-30, 30}, {-480, 480}};
    for (int i = 0; i < 40000; i++) {
        const int *range = ranges[i % 3];
        double v[12];
        for (int k = 0; k < 12; k++)
            v[k] = i % 2 ? (double)sl_random_below(&random, 12)
                         : random_double(&random, range[0], range[1]);
        const sl_segment s = {{v[0], v[1]}, {v[2], v[3]}}, t = {{v[4], v[5]}, {v[6], v[7]}};
        const sl_point from = {v[8], v[9]};
        if (sli_orient(t.a, t.b, s.a) * sli_orient(t.a, t.b, s.b) >= 0) continue;
        sl_point to = {v[10], v[11]};
        if (i % 5 && sli_orient(s.a, s.b, t.a) * sli_orient(s.a, s.b, t.b) < 0) {
            to = sli_crossing(s, t);
            to.x = steps(to.x, (int)sl_random_below(&random, 3) - 1);
        }
        const int expected = rational_crossing_side(from, to, s, t);
        assert_int_equal(sli_crossing_side(from, to, s, t), expected);
        tried++;
        signs[expected + 1]++;
    }
    assert_true(tried > 10000 && signs[0] > 1000 && signs[1] > 200 && signs[2] > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(near_collinear_grids_are_decided),
        cmocka_unit_test(the_grid_finds_contraction),
        cmocka_unit_test(any_finite_doubles_are_decided),
        cmocka_unit_test(nearly_collinear_points_are_decided),
        cmocka_unit_test(sides_of_crossings_are_decided),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
