/// Squares of distances are compared, so that all are polynomials in the coordinates. With p and q
/// from the eye to the segment's ends, w from the one to the other and d along a direction, the
/// place that the direction meets is at
///     |p x q| |d| / |d x w|,
/// and the foot of the perpendicular at |p x q| / |w|. Which of them is the nearest the signs of
/// d . w tell. First in doubles, with room for far more than rounding; what that leaves open, in
/// whole numbers.
#include "geometry/distance.h"

#include "geometry/whole.h"

#include <limits.h>

// --- in doubles

/// A vector, and what each of its coordinates may be off by.
typedef struct rough {
    sl_point at;
    double error;
} rough;

static double size(sl_point v) {
    return fabs(v.x) + fabs(v.y);
}

static rough rough_between(const sl_fine *from, const sl_fine *to) {
    const sl_point at = {to->at.x - from->at.x, to->at.y - from->at.y};
    const sl_point rest = {to->rest.x - from->rest.x, to->rest.y - from->rest.y};
    const sl_point sum = {at.x + rest.x, at.y + rest.y};
    return (rough){sum, 0x1p-51 * (size(at) + size(rest))};
}

static double cross(sl_point a, sl_point b) {
    return a.x * b.y - a.y * b.x;
}

static double dot(sl_point a, sl_point b) {
    return a.x * b.x + a.y * b.y;
}

/// What a product of two vectors may be off by.
static double error_of(const rough *a, const rough *b) {
    return 0x1p-50 * size(a->at) * size(b->at) + a->error * size(b->at) + b->error * size(a->at);
}

/// Whether a value is known to 20 bits; false for NaN.
static bool is_sure(double value, double error) {
    return fabs(value) > 0x1p20 * error && fabs(value) > 0x1p-200 && fabs(value) < 0x1p200;
}

/// The sign of a - b where they differ by more than a 2^-14th, else 0.
static int compare_roughly(double a, double b) {
    if (!(a > 0x1p-900 && a < 0x1p900 && b > 0x1p-900 && b < 0x1p900)) return 0;
    return a > b * (1 + 0x1p-14) ? 1 : a < b * (1 - 0x1p-14) ? -1 : 0;
}

/// The sign, 0 where doubles do not tell.
static int compare_in_doubles(const sl_glance *g, double length) {
    const sl_fine right = {.at = g->right}, left = {.at = g->left};
    const rough p = rough_between(&g->eye, &right), q = rough_between(&g->eye, &left);
    const rough w = rough_between(&right, &left);
    const double area = cross(p.at, q.at), square = length * length;
    if (!is_sure(area, error_of(&p, &q))) return 0;
    for (int side = 0; side < 2; side++) {
        const rough d = rough_between(&g->eye, side ? &g->to : &g->from);
        const bool away = side ? g->to_away : g->from_away;
        const double along = away ? -dot(d.at, w.at) : dot(d.at, w.at);
        const double over = cross(d.at, w.at);
        if (!is_sure(along, error_of(&d, &w))) return 0;
        if (side ? along > 0 : along < 0) continue;
        if (!is_sure(over, error_of(&d, &w)) || !is_sure(size(d.at), d.error)) return 0;
        return compare_roughly(area * area * (dot(d.at, d.at) / (over * over)), square);
    }
    return compare_roughly(area * area / dot(w.at, w.at), square);
}

// --- in whole numbers

typedef struct vector {
    sl_whole x, y;
} vector;

static void lower(int *exponent, double value) {
    if (value == 0) return;
    const int own = sl_whole_exponent(value);
    if (own < *exponent) *exponent = own;
}

static void lower_by(int *exponent, const sl_fine *p) {
    lower(exponent, p->at.x);
    lower(exponent, p->at.y);
    lower(exponent, p->rest.x);
    lower(exponent, p->rest.y);
}

static void set_sum(double a, double b, int exponent, sl_whole *out) {
    sl_whole s, t;
    sl_whole_set(a, exponent, &s);
    sl_whole_set(b, exponent, &t);
    sl_whole_add(&s, &t, out);
}

static void set_between(const sl_fine *from, const sl_fine *to, int exponent, vector *out) {
    sl_whole a, b;
    set_sum(from->at.x, from->rest.x, exponent, &a);
    set_sum(to->at.x, to->rest.x, exponent, &b);
    sl_whole_subtract(&b, &a, &out->x);
    set_sum(from->at.y, from->rest.y, exponent, &a);
    set_sum(to->at.y, to->rest.y, exponent, &b);
    sl_whole_subtract(&b, &a, &out->y);
}

static void whole_cross(const vector *a, const vector *b, sl_whole *out) {
    sl_whole s, t;
    sl_whole_multiply(&a->x, &b->y, &s);
    sl_whole_multiply(&a->y, &b->x, &t);
    sl_whole_subtract(&s, &t, out);
}

static void whole_dot(const vector *a, const vector *b, sl_whole *out) {
    sl_whole s, t;
    sl_whole_multiply(&a->x, &b->x, &s);
    sl_whole_multiply(&a->y, &b->y, &t);
    sl_whole_add(&s, &t, out);
}

/// The sign of a a b - c c d.
static int compare_products(const sl_whole *a, const sl_whole *b, const sl_whole *c,
                            const sl_whole *d) {
    sl_whole square, left, right;
    sl_whole_multiply(a, a, &square);
    sl_whole_multiply(&square, b, &left);
    sl_whole_multiply(c, c, &square);
    sl_whole_multiply(&square, d, &right);
    return sl_whole_compare(&left, &right);
}

/// The sign of |v| - length.
static int compare_length(const vector *v, const sl_whole *length) {
    sl_whole left, right;
    whole_dot(v, v, &left);
    sl_whole_multiply(length, length, &right);
    return sl_whole_compare(&left, &right);
}

/// The sign of the distance to the place that a direction meets, less the length.
static int compare_met(const sl_whole *area, const vector *d, const vector *w,
                       const sl_whole *length) {
    sl_whole square, over, reach;
    whole_dot(d, d, &square);
    whole_cross(d, w, &over);
    sl_whole_multiply(length, &over, &reach);
    sl_whole one;
    sl_whole_set(1, 0, &one);
    return compare_products(area, &square, &reach, &one);
}

static int exponent_of(const sl_glance *g, double length) {
    int exponent = INT_MAX;
    lower_by(&exponent, &g->eye);
    lower_by(&exponent, &g->from);
    lower_by(&exponent, &g->to);
    lower_by(&exponent, &(sl_fine){.at = g->right});
    lower_by(&exponent, &(sl_fine){.at = g->left});
    lower(&exponent, length);
    return exponent;
}

static int compare_exactly(const sl_glance *g, double length) {
    const sl_fine right = {.at = g->right}, left = {.at = g->left};
    const int exponent = exponent_of(g, length);
    vector p, q, w, d;
    sl_whole range, area, along;
    sl_whole_set(length, exponent, &range);
    set_between(&g->eye, &right, exponent, &p);
    set_between(&g->eye, &left, exponent, &q);
    set_between(&right, &left, exponent, &w);
    whole_cross(&p, &q, &area);
    if (!area.sign) {
        const int to_right = compare_length(&p, &range), to_left = compare_length(&q, &range);
        return to_right < to_left ? to_right : to_left;
    }
    set_between(&g->eye, &g->from, exponent, &d);
    whole_dot(&d, &w, &along);
    if ((g->from_away ? -along.sign : along.sign) >= 0) return compare_met(&area, &d, &w, &range);
    set_between(&g->eye, &g->to, exponent, &d);
    whole_dot(&d, &w, &along);
    if ((g->to_away ? -along.sign : along.sign) <= 0) return compare_met(&area, &d, &w, &range);
    sl_whole square, one;
    whole_dot(&w, &w, &square);
    sl_whole_set(1, 0, &one);
    return compare_products(&area, &one, &range, &square);
}

int sl_nearest_compare(const sl_glance *glance, double length) {
    const int sign = compare_in_doubles(glance, length);
    return sign ? sign : compare_exactly(glance, length);
}

int sl_distance_compare(sl_point a, sl_point b, double length) {
    const sl_fine from = {.at = a}, to = {.at = b};
    const rough v = rough_between(&from, &to);
    const int sign = compare_roughly(dot(v.at, v.at), length * length);
    if (sign) return sign;
    int exponent = INT_MAX;
    lower_by(&exponent, &from);
    lower_by(&exponent, &to);
    lower(&exponent, length);
    if (exponent == INT_MAX) return 0;
    vector way;
    sl_whole range;
    set_between(&from, &to, exponent, &way);
    sl_whole_set(length, exponent, &range);
    return compare_length(&way, &range);
}
