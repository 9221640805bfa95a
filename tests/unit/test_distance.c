/// Distances held against lengths, against rationals: places at random and such at just that
/// distance, huge, tiny and far from the origin.
#include "testing.h"

#include "geometry/crossing.h"
#include "sightline/support.h"

#include <gmp.h>

enum { DRAWS = 20000 };

// --- whole numbers

static void whole_to_mpz(const sli_whole *a, mpz_t out) {
    mpz_import(out, a->count, -1, sizeof *a->digits, 0, 0, a->digits);
    if (a->sign < 0) mpz_neg(out, out);
    assert_true(!a->count || a->digits[a->count - 1]);
    assert_int_equal(a->sign != 0, a->count != 0);
}

static double random_double(sl_random *random) {
    const double value =
        ldexp(sl_random_unit(random) + 0.5, (int)sl_random_below(random, 400) - 200);
    const uint64_t kind = sl_random_below(random, 8);
    if (kind == 0) return 0;
    if (kind == 1) return (double)sl_random_below(random, 9) - 4;
    if (kind == 2) return 0x1p-1074;
    if (kind == 3) return -0x1.fffffffffffffp1023;
    return kind % 2 ? value : -value;
}

static void whole_numbers(void **state) {
    (void)state;
    sl_random random = {1};
    mpz_t a, b, c, d;
    mpz_inits(a, b, c, d, NULL);
    for (int i = 0; i < 2000; i++) {
        sli_whole x, y, sum, less, product, all;
        const double u = random_double(&random), v = random_double(&random);
        sli_whole_set(u, -1074, &x);
        sli_whole_set(v, -1074, &y);
        whole_to_mpz(&x, a);
        whole_to_mpz(&y, b);
        mpf_t f;
        mpf_init2(f, 2200);
        mpf_set_d(f, u);
        mpf_mul_2exp(f, f, 1074);
        mpz_set_f(c, f);
        assert_int_equal(mpz_cmp(a, c), 0);
        mpf_clear(f);
        sli_whole_add(&x, &y, &sum);
        sli_whole_subtract(&x, &y, &less);
        sli_whole_multiply(&x, &y, &product);
        mpz_add(c, a, b);
        whole_to_mpz(&sum, d);
        assert_int_equal(mpz_cmp(c, d), 0);
        mpz_sub(c, a, b);
        whole_to_mpz(&less, d);
        assert_int_equal(mpz_cmp(c, d), 0);
        const int order = mpz_cmp(a, b);
        assert_int_equal(sli_whole_compare(&x, &y), (order > 0) - (order < 0));
        mpz_mul(c, a, b);
        whole_to_mpz(&product, d);
        assert_int_equal(mpz_cmp(c, d), 0);
        sli_whole_multiply(&product, &product, &less);
        sli_whole_multiply(&less, &product, &all); // six factors
        mpz_pow_ui(c, c, 3);
        whole_to_mpz(&all, d);
        assert_int_equal(mpz_cmp(c, d), 0);
    }
    mpz_clears(a, b, c, d, NULL);
}

// --- distances

typedef struct vector {
    mpq_t x, y;
} vector;

static void between(const sli_fine *from, const sli_fine *to, vector *out) {
    const double parts[2][4] = {{to->at.x, to->rest.x, from->at.x, from->rest.x},
                                {to->at.y, to->rest.y, from->at.y, from->rest.y}};
    mpq_t part;
    mpq_init(part);
    for (int axis = 0; axis < 2; axis++) {
        mpq_ptr sum = axis ? out->y : out->x;
        mpq_set_ui(sum, 0, 1);
        for (int i = 0; i < 4; i++) {
            mpq_set_d(part, parts[axis][i]);
            if (i < 2)
                mpq_add(sum, sum, part);
            else
                mpq_sub(sum, sum, part);
        }
    }
    mpq_clear(part);
}

static void dot(const vector *a, const vector *b, mpq_t out) {
    mpq_t t;
    mpq_init(t);
    mpq_mul(out, a->x, b->x);
    mpq_mul(t, a->y, b->y);
    mpq_add(out, out, t);
    mpq_clear(t);
}

static void cross(const vector *a, const vector *b, mpq_t out) {
    mpq_t t;
    mpq_init(t);
    mpq_mul(out, a->x, b->y);
    mpq_mul(t, a->y, b->x);
    mpq_sub(out, out, t);
    mpq_clear(t);
}

/// The share of the way from right to left at which a direction meets the segment's line.
static void meet(const vector *p, const vector *w, const vector *d, mpq_t at) {
    mpq_t over;
    mpq_init(over);
    cross(p, d, at);
    cross(d, w, over);
    mpq_div(at, at, over);
    mpq_clear(over);
}

/// The sign, by the place itself: the foot's share of the way, kept between those of the borders.
static int expected_sign(const sli_glance *g, double length) {
    const sli_fine right = {.at = g->right}, left = {.at = g->left};
    vector p, w, d;
    mpq_t low, high, at, t;
    mpq_inits(p.x, p.y, w.x, w.y, d.x, d.y, low, high, at, t, NULL);
    between(&g->eye, &right, &p);
    between(&right, &left, &w);
    between(&g->eye, &g->from, &d);
    meet(&p, &w, &d, low);
    between(&g->eye, &g->to, &d);
    meet(&p, &w, &d, high);
    dot(&p, &w, at);
    dot(&w, &w, t);
    mpq_div(at, at, t);
    mpq_neg(at, at);
    if (mpq_cmp(at, low) < 0) mpq_set(at, low);
    if (mpq_cmp(at, high) > 0) mpq_set(at, high);
    mpq_mul(t, w.x, at);
    mpq_add(p.x, p.x, t);
    mpq_mul(t, w.y, at);
    mpq_add(p.y, p.y, t);
    dot(&p, &p, at);
    mpq_set_d(t, length);
    mpq_mul(t, t, t);
    const int order = mpq_cmp(at, t);
    mpq_clears(p.x, p.y, w.x, w.y, d.x, d.y, low, high, at, t, NULL);
    return (order > 0) - (order < 0);
}

static double small(sl_random *random) {
    return (double)sl_random_below(random, 21) - 10;
}

static sl_point place(sl_random *random, double scale, double shift, double by) {
    return (sl_point){shift + (small(random) + by * sl_random_unit(random)) * scale,
                      shift + (small(random) + by * sl_random_unit(random)) * scale};
}

static int turn(const sli_glance *g, sl_point a, sl_point b) {
    return sli_orient_fine(&g->eye, &(sli_fine){.at = a}, &(sli_fine){.at = b});
}

/// A direction through the segment: at one of its ends, or at a point that is seen between them.
static bool random_direction(sl_random *random, sli_glance *g, double scale, double shift,
                             double by, sli_fine *point, bool *away) {
    const uint64_t kind = sl_random_below(random, 4);
    *away = false;
    *point = (sli_fine){.at = kind ? g->right : g->left};
    if (kind < 2) return true;
    point->at = place(random, scale, shift, by);
    const int from = turn(g, g->right, point->at), to = turn(g, point->at, g->left);
    *away = from < 0 && to < 0;
    return *away || (from > 0 && to > 0);
}

/// Whether a direction is not to the right of another one.
static bool is_left_of(const sli_glance *g) {
    const int sign = turn(g, g->from.at, g->to.at);
    return (g->from_away == g->to_away ? sign : -sign) >= 0;
}

static bool random_glance(sl_random *random, double scale, double shift, double by, sli_glance *g) {
    *g = (sli_glance){.eye = {.at = place(random, scale, shift, by)},
                      .right = place(random, scale, shift, by),
                      .left = place(random, scale, shift, by)};
    if (sl_random_below(random, 3) == 0)
        g->eye.rest = (sl_point){g->eye.at.x * 0x1p-55, g->eye.at.y * 0x1p-60};
    return turn(g, g->right, g->left) > 0 &&
           random_direction(random, g, scale, shift, by, &g->from, &g->from_away) &&
           random_direction(random, g, scale, shift, by, &g->to, &g->to_away) && is_left_of(g);
}

static void nearest_places(void **state) {
    (void)state;
    sl_random random = {2};
    size_t counts[3] = {0};
    const double scales[][2] = {{1, 0},       {0.1, 0},    {0x1p-480, 0},
                                {0x1p480, 0}, {1, 0x1p50}, {1e-9, 1}};
    for (int i = 0; i < DRAWS;) {
        const double *scale = scales[i % 6];
        const double by = sl_random_below(&random, 2) ? 1 : 0;
        sli_glance g;
        if (!random_glance(&random, scale[0], scale[1], by, &g)) continue;
        double length = (double)(1 + sl_random_below(&random, 15)) * scale[0];
        if (sl_random_below(&random, 2))
            length = hypot(g.right.x - g.eye.at.x, g.right.y - g.eye.at.y);
        if (!(length > 0)) continue;
        const int sign = expected_sign(&g, length);
        if (sli_nearest_compare(&g, length) != sign)
            fail_msg("draw %d: eye %.17g,%.17g right %.17g,%.17g left %.17g,%.17g length %.17g: %d",
                     i, g.eye.at.x, g.eye.at.y, g.right.x, g.right.y, g.left.x, g.left.y, length,
                     sign);
        counts[sign + 1]++;
        i++;
    }
    assert_true(counts[0] > 100 && counts[1] > 100 && counts[2] > 100);
}

static void segments_in_line(void **state) {
    (void)state;
    sli_glance g = {.eye = {.at = {1, 1}},
                    .from = {.at = {4, 5}},
                    .to = {.at = {4, 5}},
                    .right = {7, 9},
                    .left = {4, 5}};
    assert_int_equal(sli_nearest_compare(&g, 5), 0);
    assert_int_equal(sli_nearest_compare(&g, nextafter(5, 0)), 1);
    g.right = (sl_point){4, 5};
    g.left = (sl_point){7, 9};
    assert_int_equal(sli_nearest_compare(&g, nextafter(5, 9)), -1);
}

static void two_points(void **state) {
    (void)state;
    const sl_point o = {1e10, -1e10}, p = {1e10 + 3, -1e10 + 4};
    assert_int_equal(sli_distance_compare(o, p, 5), 0);
    assert_int_equal(sli_distance_compare(o, p, nextafter(5, 0)), 1);
    assert_int_equal(sli_distance_compare(o, p, nextafter(5, 9)), -1);
    assert_int_equal(sli_distance_compare(o, o, 0), 0);
    assert_int_equal(sli_distance_compare(o, o, 0x1p-1074), -1);
    assert_int_equal(sli_distance_compare(o, p, 0), 1);
    assert_int_equal(sli_distance_compare((sl_point){3e-200, 0}, (sl_point){0, 4e-200}, 5e-200),
                     sli_distance_compare((sl_point){3e-200 * 0x1p600, 0},
                                          (sl_point){0, 4e-200 * 0x1p600}, 5e-200 * 0x1p600));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_numbers),
        cmocka_unit_test(nearest_places),
        cmocka_unit_test(segments_in_line),
        cmocka_unit_test(two_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
