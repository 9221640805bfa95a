/// Distances by GMP.
#include "oracle/apart.h"

#include "oracle/blockers.h"

#include <math.h>

static void difference(mpq_t out, double a, double b) {
    mpq_t other;
    mpq_init(other);
    mpq_set_d(out, a);
    mpq_set_d(other, b);
    mpq_sub(out, out, other);
    mpq_clear(other);
}

static void sum_of_products(mpq_t out, mpq_t a, mpq_t b, mpq_t c, mpq_t d, bool minus) {
    mpq_t other;
    mpq_init(other);
    mpq_mul(out, a, b);
    mpq_mul(other, c, d);
    if (minus)
        mpq_sub(out, out, other);
    else
        mpq_add(out, out, other);
    mpq_clear(other);
}

void oracle_square_between(mpq_t out, sl_point a, sl_point b) {
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    difference(x, a.x, b.x);
    difference(y, a.y, b.y);
    sum_of_products(out, x, x, y, y, false);
    mpq_clears(x, y, NULL);
}

void oracle_square_to_segment(mpq_t out, sl_segment s, sl_point v) {
    mpq_t dx, dy, vx, vy, along, length;
    mpq_inits(dx, dy, vx, vy, along, length, NULL);
    difference(dx, s.b.x, s.a.x);
    difference(dy, s.b.y, s.a.y);
    difference(vx, v.x, s.a.x);
    difference(vy, v.y, s.a.y);
    sum_of_products(along, vx, dx, vy, dy, false);
    sum_of_products(length, dx, dx, dy, dy, false);
    if (mpq_sgn(along) <= 0) {
        oracle_square_between(out, v, s.a);
    } else if (mpq_cmp(along, length) >= 0) {
        oracle_square_between(out, v, s.b);
    } else {
        sum_of_products(out, dx, vy, dy, vx, true);
        mpq_mul(out, out, out);
        mpq_div(out, out, length);
    }
    mpq_clears(dx, dy, vx, vy, along, length, NULL);
}

int oracle_compare_to_square(const mpq_t square, double distance) {
    mpq_t other;
    mpq_init(other);
    mpq_set_d(other, distance);
    mpq_mul(other, other, other);
    const int order = mpq_cmp(square, other);
    mpq_clear(other);
    return order;
}

/// How far the boxes of two segments are from each other, at least.
static double between_boxes(sl_segment s, sl_segment t) {
    const double x =
        fmax(fmin(s.a.x, s.b.x) - fmax(t.a.x, t.b.x), fmin(t.a.x, t.b.x) - fmax(s.a.x, s.b.x));
    const double y =
        fmax(fmin(s.a.y, s.b.y) - fmax(t.a.y, t.b.y), fmin(t.a.y, t.b.y) - fmax(s.a.y, s.b.y));
    return fmax(x, y) * (1 - 0x1p-50);
}

bool oracle_are_apart(sl_segment s, sl_segment t, double distance) {
    if (between_boxes(s, t) > distance) return true;
    if (blockers_meet(s, t)) return false;
    const sl_segment segments[4] = {s, s, t, t};
    const sl_point ends[4] = {t.a, t.b, s.a, s.b};
    bool apart = true;
    mpq_t square;
    mpq_init(square);
    for (int i = 0; i < 4 && apart && distance > 0; i++) {
        oracle_square_to_segment(square, segments[i], ends[i]);
        apart = oracle_compare_to_square(square, distance) > 0;
    }
    mpq_clear(square);
    return apart;
}
