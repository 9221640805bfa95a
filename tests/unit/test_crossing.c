/// Where two segments cross, against rationals: no representable coordinate is nearer.
#include "testing.h"

#include "geometry/crossing.h"
#include "oracle/blockers.h"
#include "sightline/support.h"

#include <gmp.h>
#include <math.h>

/// The place of the crossing, in rationals.
typedef struct place {
    mpq_t x, y;
} place;

static void difference(mpq_t out, double a, double b) {
    mpq_t other;
    mpq_init(other);
    mpq_set_d(out, a);
    mpq_set_d(other, b);
    mpq_sub(out, out, other);
    mpq_clear(other);
}

/// ax * by - ay * bx
static void cross(mpq_t out, mpq_t ax, mpq_t ay, mpq_t bx, mpq_t by) {
    mpq_t other;
    mpq_init(other);
    mpq_mul(out, ax, by);
    mpq_mul(other, ay, bx);
    mpq_sub(out, out, other);
    mpq_clear(other);
}

/// out = from + step * share
static void go(mpq_t out, double from, mpq_t step, mpq_t share) {
    mpq_set_d(out, from);
    mpq_mul(step, step, share);
    mpq_add(out, out, step);
}

static void place_of(sl_segment s, sl_segment t, place *out) {
    mpq_t v[8];
    for (int i = 0; i < 8; i++) mpq_init(v[i]);
    difference(v[0], s.b.x, s.a.x);
    difference(v[1], s.b.y, s.a.y);
    difference(v[2], t.b.x, t.a.x);
    difference(v[3], t.b.y, t.a.y);
    difference(v[4], t.a.x, s.a.x);
    difference(v[5], t.a.y, s.a.y);
    cross(v[6], v[4], v[5], v[2], v[3]);
    cross(v[7], v[0], v[1], v[2], v[3]);
    mpq_div(v[6], v[6], v[7]);
    mpq_inits(out->x, out->y, NULL);
    go(out->x, s.a.x, v[0], v[6]);
    go(out->y, s.a.y, v[1], v[6]);
    for (int i = 0; i < 8; i++) mpq_clear(v[i]);
}

/// The next coordinate that a map may have.
static double neighbour(double value, double toward) {
    const double next = nextafter(value, toward);
    if (next == 0 || fabs(next) >= SL_COORDINATE_MIN) return next;
    if (value != 0) return 0;
    return toward > 0 ? SL_COORDINATE_MIN : -SL_COORDINATE_MIN;
}

static void off(mpq_t out, const mpq_t is, double value) {
    mpq_set_d(out, value);
    mpq_sub(out, out, is);
    mpq_abs(out, out);
}

static bool is_nearest(const mpq_t is, double value) {
    mpq_t here, there;
    mpq_inits(here, there, NULL);
    off(here, is, value);
    bool nearest = value == 0 || fabs(value) >= SL_COORDINATE_MIN;
    for (int side = -1; side <= 1; side += 2) {
        off(there, is, neighbour(value, side * HUGE_VAL));
        nearest &= mpq_cmp(here, there) <= 0;
    }
    mpq_clears(here, there, NULL);
    return nearest;
}

static bool strictly_cross(sl_segment s, sl_segment t) {
    return blockers_turn(s.a, s.b, t.a) * blockers_turn(s.a, s.b, t.b) < 0 &&
           blockers_turn(t.a, t.b, s.a) * blockers_turn(t.a, t.b, s.b) < 0;
}

static sl_segment turned(sl_segment s) {
    return (sl_segment){s.b, s.a};
}

/// False where they do not cross.
static bool check(sl_segment s, sl_segment t) {
    if (!strictly_cross(s, t)) return false;
    place is;
    place_of(s, t, &is);
    const sl_point at = sli_crossing(s, t);
    if (!is_nearest(is.x, at.x) || !is_nearest(is.y, at.y))
        fail_msg("%a %a to %a %a and %a %a to %a %a do not cross at %a %a", s.a.x, s.a.y, s.b.x,
                 s.b.y, t.a.x, t.a.y, t.b.x, t.b.y, at.x, at.y);
    mpq_clears(is.x, is.y, NULL);
    const sl_segment pairs[][2] = {{t, s}, {turned(s), t}, {s, turned(t)}, {turned(t), turned(s)}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (!testing_same_point(sli_crossing(pairs[i][0], pairs[i][1]), at))
            fail_msg("%a %a to %a %a and %a %a to %a %a cross elsewhere in another order", s.a.x,
                     s.a.y, s.b.x, s.b.y, t.a.x, t.a.y, t.b.x, t.b.y);
    return true;
}

// --- random segments

typedef double draw(sl_random *random);

static double anywhere(sl_random *random) {
    return sl_random_unit(random) - 0.5;
}

static double whole(sl_random *random) {
    return (double)sl_random_below(random, 20) - 10;
}

static double power(sl_random *random) {
    const double value = ldexp(1, (int)sl_random_below(random, 997) - 498);
    return sl_random_below(random, 2) ? value : -value;
}

static double any_scale(sl_random *random) {
    if (sl_random_below(random, 8) == 0) return 0;
    return power(random) * (1 + sl_random_unit(random)) / 2;
}

static double tiny(sl_random *random) {
    const double value = SL_COORDINATE_MIN * (1 + (double)sl_random_below(random, 1000));
    return sl_random_below(random, 2) ? value : -value;
}

static double huge(sl_random *random) {
    return SL_COORDINATE_MAX * (2 * sl_random_unit(random) - 1);
}

static double far_off(sl_random *random) {
    return 1e15 + (double)sl_random_below(random, 40) * 0.125;
}

static double steps(sl_random *random) {
    return 1 + (double)sl_random_below(random, 20) * 0x1p-52;
}

static double usable(double value) {
    return fabs(value) < SL_COORDINATE_MIN ? 0 : value;
}

static sl_segment any_segment(sl_random *random, draw *by) {
    double v[4];
    for (int i = 0; i < 4; i++) v[i] = usable(by(random));
    return (sl_segment){{v[0], v[1]}, {v[2], v[3]}};
}

static void of_all_magnitudes(void **state) {
    (void)state;
    draw *const draws[] = {anywhere, whole, power, any_scale, tiny, huge, far_off, steps};
    for (size_t d = 0; d < sizeof draws / sizeof *draws; d++) {
        sl_random random = {d + 1};
        uint64_t crossed = 0;
        for (int i = 0; i < 1500; i++)
            crossed += check(any_segment(&random, draws[d]), any_segment(&random, draws[d]));
        assert_true(crossed > 40);
    }
}

static void of_mixed_magnitudes(void **state) {
    (void)state;
    draw *const draws[] = {anywhere, any_scale, tiny, huge, far_off};
    sl_random random = {7};
    uint64_t crossed = 0;
    for (int i = 0; i < 15000; i++) {
        draw *const x = draws[sl_random_below(&random, 5)], *const y =
                                                                draws[sl_random_below(&random, 5)];
        const sl_segment sx = any_segment(&random, x), sy = any_segment(&random, y);
        const sl_segment tx = any_segment(&random, x), ty = any_segment(&random, y);
        crossed += check((sl_segment){{sx.a.x, sy.a.y}, {sx.b.x, sy.b.y}},
                         (sl_segment){{tx.a.x, ty.a.y}, {tx.b.x, ty.b.y}});
    }
    assert_true(crossed > 300);
}

/// Up to some steps of doubles away.
static double beside(sl_random *random, double value) {
    for (uint64_t steps_left = sl_random_below(random, 4); steps_left; steps_left--)
        value = neighbour(value, sl_random_below(random, 2) ? HUGE_VAL : -HUGE_VAL);
    return value;
}

static sl_point point_beside(sl_random *random, sl_point p) {
    return (sl_point){beside(random, p.x), beside(random, p.y)};
}

static sl_point along(sl_segment s, double share) {
    return (sl_point){usable(s.a.x + share * (s.b.x - s.a.x)),
                      usable(s.a.y + share * (s.b.y - s.a.y))};
}

static void nearly_parallel(void **state) {
    (void)state;
    draw *const draws[] = {anywhere, whole, any_scale, far_off, huge, tiny};
    for (size_t d = 0; d < sizeof draws / sizeof *draws; d++) {
        sl_random random = {d + 20};
        uint64_t crossed = 0;
        for (int i = 0; i < 1500; i++) {
            const sl_segment s = any_segment(&random, draws[d]);
            sl_segment t = s;
            if (i % 2) t.a = along(s, sl_random_unit(&random));
            if (i % 3) t.b = along(s, sl_random_unit(&random));
            t = (sl_segment){point_beside(&random, t.a), point_beside(&random, t.b)};
            crossed += check(s, t);
        }
        assert_true(crossed > 40);
    }
}

/// Crossings just beside, or at, the end of one of them.
static void near_an_end(void **state) {
    (void)state;
    draw *const draws[] = {anywhere, whole, any_scale, far_off, huge, tiny};
    for (size_t d = 0; d < sizeof draws / sizeof *draws; d++) {
        sl_random random = {d + 40};
        uint64_t crossed = 0;
        for (int i = 0; i < 1500; i++) {
            const sl_segment s = any_segment(&random, draws[d]);
            sl_segment t = any_segment(&random, draws[d]);
            t.a = point_beside(&random, i % 2 ? s.a : along(s, sl_random_unit(&random)));
            crossed += check(s, t);
        }
        assert_true(crossed > 40);
    }
}

// --- cases

static void where_zero_is_near(void **state) {
    (void)state;
    const double low = SL_COORDINATE_MIN;
    for (int exponent = -498; exponent <= 498; exponent += 12) {
        const double h = fmax(low, ldexp(1, exponent));
        // Through the origin, and past it by less than the least coordinate.
        assert_true(check((sl_segment){{-h, -h}, {h, h}}, (sl_segment){{-h, h}, {h, -h}}));
        assert_true(check((sl_segment){{-h, -h}, {h, h}}, (sl_segment){{0, h}, {low, -h}}));
        assert_true(check((sl_segment){{-low, 1}, {low, -1}}, (sl_segment){{-h, 0}, {h, 0}}));
    }
    for (int k = 1; k < 8; k++) {
        const double m = k * low;
        assert_true(check((sl_segment){{-m, low}, {low, -low}}, (sl_segment){{0, -m}, {0, m}}));
        check((sl_segment){{-low, -low}, {m, low}}, (sl_segment){{0, low}, {low, -m}});
        check((sl_segment){{-low, -low}, {m, low}}, (sl_segment){{-low, low}, {low, -m}});
    }
}

/// Where two doubles are equally near, the order of the segments must not choose.
static void halfway_between_doubles(void **state) {
    (void)state;
    const double unit = 0x1p53;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 8; k++)
            check((sl_segment){{unit + 2 * i, unit}, {unit + 2 * k + 2, unit + 4}},
                  (sl_segment){{unit + 2 * k, unit}, {unit + 2 * i + 2, unit + 4}});
    assert_true(check((sl_segment){{unit, unit}, {unit + 2, unit + 2}},
                      (sl_segment){{unit, unit + 2}, {unit + 2, unit}}));
    assert_true(check((sl_segment){{1, 1}, {1 + 0x1p-52, 1 + 0x1p-52}},
                      (sl_segment){{1, 1 + 0x1p-52}, {1 + 0x1p-52, 1}}));
}

// --- the order of places along a line

/// The sign of (p - q) * (s.b - s.a), where p and q are on the line through s.
static int order_of(sl_segment s, const place *p, const place *q) {
    mpq_t x, y, way;
    mpq_inits(x, y, way, NULL);
    mpq_sub(x, p->x, q->x);
    mpq_sub(y, p->y, q->y);
    difference(way, s.b.x, s.a.x);
    mpq_mul(x, x, way);
    difference(way, s.b.y, s.a.y);
    mpq_mul(y, y, way);
    mpq_add(x, x, y);
    const int sign = mpq_sgn(x);
    mpq_clears(x, y, way, NULL);
    return sign;
}

static void check_order(sl_segment s, sl_segment t, sl_segment u, int *ties) {
    if (!sli_turn(s.a, s.b, t.a, t.b) || !sli_turn(s.a, s.b, u.a, u.b)) return;
    place p, q;
    place_of(s, t, &p);
    place_of(s, u, &q);
    const int expected = order_of(s, &p, &q);
    *ties += expected == 0;
    assert_int_equal(sli_meet_order(s, t, u), expected);
    assert_int_equal(sli_meet_order(s, u, t), -expected);
    assert_int_equal(sli_meet_order((sl_segment){s.b, s.a}, t, u), -expected);
    assert_int_equal(sli_meet_order(s, (sl_segment){t.b, t.a}, u), expected);
    mpq_clears(p.x, p.y, q.x, q.y, NULL);
}

/// Small whole numbers, where many lines meet in one place; then all magnitudes.
static void in_order_along_a_line(void **state) {
    (void)state;
    sl_random random = {9};
    int ties = 0;
    for (int i = 0; i < 6000; i++) {
        sl_segment line[3];
        for (int k = 0; k < 3; k++) {
            double v[4];
            for (int c = 0; c < 4; c++) {
                v[c] = (double)sl_random_below(&random, 5) - 2;
                if (i % 2) v[c] = ldexp(v[c] + 0.1, (int)sl_random_below(&random, 400) - 200);
            }
            line[k] = (sl_segment){{v[0], v[1]}, {v[2], v[3]}};
        }
        check_order(line[0], line[1], line[2], &ties);
    }
    assert_true(ties > 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_all_magnitudes),     cmocka_unit_test(of_mixed_magnitudes),
        cmocka_unit_test(nearly_parallel),       cmocka_unit_test(near_an_end),
        cmocka_unit_test(where_zero_is_near),    cmocka_unit_test(halfway_between_doubles),
        cmocka_unit_test(in_order_along_a_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
