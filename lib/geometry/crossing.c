/// Where two segments cross, on which side of a line that is, and what is nearer than a length.
///
/// Signs are those of polynomials in the coordinates. They are computed in doubles first, with a
/// bound for the rounding. Where the bound leaves a sign open, whole numbers decide (whole.h): a
/// power of two makes all coordinates whole, and then nothing is rounded.
///
/// The crossing of a-b and c-d is a + (b - a) n / m with the cross products
///
///     n = (c - a) x (d - c)      m = (b - a) x (d - c)
///
/// Its coordinates are quotients of whole numbers. The highest digits give a first double. It is
/// then moved by single steps, of which there are few: each step compares the quotient with the
/// middle between two neighbouring doubles.
///
/// Distances are compared as squares. Let p and q lead from the eye to the ends of a segment, w
/// from one end to the other, and d along a direction:
///
///     q ----- w ----- p        the direction meets the segment at distance  |p x q| |d| / |d x w|
///      \      |      /         the foot of the perpendicular is at distance  |p x q| / |w|
///       \     d     /
///        \    |    /          The signs of d . w for the two limits of the view say which of
///           eye               these is the nearest place that is seen.
#include "geometry/crossing.h"

#include "geometry/length.h"

#include <limits.h>
#include <math.h>

// --- vectors of whole numbers

typedef struct vector {
    sli_whole x, y;
} vector;

/// Lowers an exponent to that of a value, so that both are whole in its unit.
static void lower(int *exponent, double value) {
    if (value == 0) return;
    const int own = sli_whole_exponent(value);
    if (own < *exponent) *exponent = own;
}

static void subtract(double a, double b, int exponent, sli_whole *out) {
    sli_whole left, right;
    sli_whole_set(a, exponent, &left);
    sli_whole_set(b, exponent, &right);
    sli_whole_subtract(&left, &right, out);
}

static void set_way(sl_point from, sl_point to, int exponent, vector *out) {
    subtract(to.x, from.x, exponent, &out->x);
    subtract(to.y, from.y, exponent, &out->y);
}

static void whole_cross(const vector *a, const vector *b, sli_whole *out) {
    sli_whole s, t;
    sli_whole_multiply(&a->x, &b->y, &s);
    sli_whole_multiply(&a->y, &b->x, &t);
    sli_whole_subtract(&s, &t, out);
}

static void whole_dot(const vector *a, const vector *b, sli_whole *out) {
    sli_whole s, t;
    sli_whole_multiply(&a->x, &b->x, &s);
    sli_whole_multiply(&a->y, &b->y, &t);
    sli_whole_add(&s, &t, out);
}

// --- the place of a crossing

/// The two coordinates of a crossing as quotients.
typedef struct quotient {
    sli_whole x, y, divisor; ///< the divisor is positive
    int exponent;            ///< of the unit of the whole numbers
} quotient;

/// The exponent of the unit for two segments. It is 0 or less, so that the ratio of this unit to
/// that of the smallest usable coordinate is still a double.
static int lowest_exponent(const sl_segment *s, const sl_segment *t) {
    const double values[] = {s->a.x, s->a.y, s->b.x, s->b.y, t->a.x, t->a.y, t->b.x, t->b.y};
    int lowest = 0;
    for (int i = 0; i < 8; i++) lower(&lowest, values[i]);
    return lowest;
}

/// from * divisor + step * share
static void along(double from, int exponent, const sli_whole *divisor, const sli_whole *step,
                  const sli_whole *share, sli_whole *out) {
    sli_whole start, left, right;
    sli_whole_set(from, exponent, &start);
    sli_whole_multiply(&start, divisor, &left);
    sli_whole_multiply(step, share, &right);
    sli_whole_add(&left, &right, out);
}

static void divide(const sl_segment *s, const sl_segment *t, quotient *q) {
    vector s_way, t_way, gap;
    sli_whole share;
    q->exponent = lowest_exponent(s, t);
    set_way(s->a, s->b, q->exponent, &s_way);
    set_way(t->a, t->b, q->exponent, &t_way);
    set_way(s->a, t->a, q->exponent, &gap);
    whole_cross(&s_way, &t_way, &q->divisor);
    whole_cross(&gap, &t_way, &share);
    if (q->divisor.sign < 0) {
        q->divisor.sign = 1;
        share.sign = -share.sign;
    }
    along(s->a.x, q->exponent, &q->divisor, &s_way.x, &share, &q->x);
    along(s->a.y, q->exponent, &q->divisor, &s_way.y, &share, &q->y);
}

/// The sign of a coordinate of the place less the middle of two doubles.
static int compare_to_middle(const quotient *q, const sli_whole *coordinate, double a, double b) {
    int exponent = q->exponent;
    lower(&exponent, a);
    lower(&exponent, b);
    sli_whole left, right, sum, twice, unit;
    sli_whole_set(a, exponent, &left);
    sli_whole_set(b, exponent, &right);
    sli_whole_add(&left, &right, &sum);
    sli_whole_multiply(&sum, &q->divisor, &right);
    sli_whole_set(ldexp(1, q->exponent - exponent + 1), 0, &unit);
    sli_whole_multiply(coordinate, &unit, &twice);
    return sli_whole_compare(&twice, &right);
}

/// The next usable coordinate (sl_coordinate_usable), up or down.
static double next_to(double value, double toward) {
    const double next = nextafter(value, toward);
    if (next == 0 || fabs(next) >= SL_COORDINATE_MIN) return next;
    return value != 0 ? 0 : toward > 0 ? SL_COORDINATE_MIN : -SL_COORDINATE_MIN;
}

/// The highest digits of a whole number. The number is about the result times 2^*exponent.
static double leading(const sli_whole *whole, int *exponent) {
    const uint32_t first = whole->count > 3 ? whole->count - 3 : 0;
    double value = 0;
    for (uint32_t i = whole->count; i-- > first;) value = value * 0x1p32 + whole->digits[i];
    *exponent = 32 * (int)first;
    return value;
}

/// The usable double that is nearest to a coordinate; of two equally near ones the lower.
static double nearest(const quotient *q, const sli_whole *coordinate) {
    int above, below;
    const double share = leading(coordinate, &above) / leading(&q->divisor, &below);
    double value = coordinate->sign * ldexp(share, above - below + q->exponent);
    value = sli_coordinate(value);
    for (;;) {
        const double up = next_to(value, HUGE_VAL), down = next_to(value, -HUGE_VAL);
        if (compare_to_middle(q, coordinate, value, up) > 0)
            value = up;
        else if (compare_to_middle(q, coordinate, down, value) <= 0)
            value = down;
        else
            return value;
    }
}

sl_point sli_crossing(sl_segment s, sl_segment t) {
    quotient q;
    divide(&s, &t, &q);
    return (sl_point){nearest(&q, &q.x), nearest(&q, &q.y)};
}

// --- the side of a line

/// (b - a) x (c - a), rounded, and a bound of its error.
typedef struct rounded {
    double value, error;
} rounded;

static rounded determinant(sl_point a, sl_point b, sl_point c) {
    const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    return (rounded){left - right, 8 * 0x1p-53 * (fabs(left) + fabs(right)) + 0x1p-900};
}

static void determinant_exact(sl_point a, sl_point b, sl_point c, int exponent, sli_whole *out) {
    vector to_b, to_c;
    set_way(a, b, exponent, &to_b);
    set_way(a, c, exponent, &to_c);
    whole_cross(&to_b, &to_c, out);
}

/// The sign of |along b| * |across a| - |along a| * |across b|. `across` is the determinant of an
/// end of s with the line, `along` that with t.
static int compare_shares(sl_point from, sl_point to, const sl_segment *s, const sl_segment *t) {
    const rounded across_a = determinant(from, to, s->a), across_b = determinant(from, to, s->b);
    const rounded along_a = determinant(t->a, t->b, s->a), along_b = determinant(t->a, t->b, s->b);
    const double left = fabs(along_b.value * across_a.value);
    const double right = fabs(along_a.value * across_b.value);
    const double error = (fabs(along_b.value) + along_b.error) * across_a.error +
                         along_b.error * fabs(across_a.value) +
                         (fabs(along_a.value) + along_a.error) * across_b.error +
                         along_a.error * fabs(across_b.value);
    const double bound = 2 * error + 8 * 0x1p-53 * (left + right) + 0x1p-900;
    if (left - right > bound) return 1;
    if (right - left > bound) return -1;
    const sl_segment line = {from, to};
    const int first = lowest_exponent(s, t), second = lowest_exponent(s, &line);
    const int exponent = first < second ? first : second;
    sli_whole one, other, left_exact, right_exact;
    determinant_exact(t->a, t->b, s->b, exponent, &one);
    determinant_exact(from, to, s->a, exponent, &other);
    sli_whole_multiply(&one, &other, &left_exact);
    determinant_exact(t->a, t->b, s->a, exponent, &one);
    determinant_exact(from, to, s->b, exponent, &other);
    sli_whole_multiply(&one, &other, &right_exact);
    left_exact.sign = left_exact.sign != 0;
    right_exact.sign = right_exact.sign != 0;
    return sli_whole_compare(&left_exact, &right_exact);
}

int sli_crossing_side(sl_point from, sl_point to, sl_segment s, sl_segment t) {
    const int a = sli_orient(from, to, s.a), b = sli_orient(from, to, s.b);
    if (a * b >= 0) return a ? a : b;
    return a * compare_shares(from, to, &s, &t);
}

/// With D(t, p) = (t.b - t.a) x (p - t.a), t meets s at the share D(t, s.a) / (D(t, s.a) - D(t,
/// s.b)) of the way. The difference of two shares has the sign of a difference of two products.
int sli_meet_order(sl_segment s, sl_segment t, sl_segment u) {
    const int first = lowest_exponent(&s, &t), second = lowest_exponent(&s, &u);
    const int exponent = first < second ? first : second;
    sli_whole one, other, left, right;
    determinant_exact(u.a, u.b, s.a, exponent, &one);
    determinant_exact(t.a, t.b, s.b, exponent, &other);
    sli_whole_multiply(&one, &other, &left);
    determinant_exact(t.a, t.b, s.a, exponent, &one);
    determinant_exact(u.a, u.b, s.b, exponent, &other);
    sli_whole_multiply(&one, &other, &right);
    return sli_whole_compare(&left, &right) * sli_turn(t.a, t.b, s.a, s.b) *
           sli_turn(u.a, u.b, s.a, s.b);
}

static int axial_meet_side_exact(sl_point eye, sl_point point, sl_point a, sl_point b, int axis,
                                 double value) {
    const sl_segment s = {eye, point}, t = {a, b};
    int exponent = lowest_exponent(&s, &t);
    vector side, ray, to_a;
    sli_whole turn, cross, away, left, right;
    lower(&exponent, value);
    set_way(a, b, exponent, &side);
    set_way(eye, point, exponent, &ray);
    set_way(eye, a, exponent, &to_a);
    subtract(value, axis ? eye.y : eye.x, exponent, &away);
    whole_cross(&side, &to_a, &turn);
    whole_cross(&side, &ray, &cross);
    sli_whole_multiply(axis ? &ray.y : &ray.x, &turn, &left);
    sli_whole_multiply(&cross, &away, &right);
    return sli_whole_compare(&left, &right);
}

int sli_axial_meet_side(sl_point eye, sl_point point, sl_point a, sl_point b, int axis,
                        double value) {
    const double s_x = b.x - a.x, s_y = b.y - a.y, u_x = point.x - eye.x, u_y = point.y - eye.y;
    const double one = s_x * (a.y - eye.y), two = s_y * (a.x - eye.x);
    const double three = s_x * u_y, four = s_y * u_x;
    const double part = axis ? u_y : u_x, away = value - (axis ? eye.y : eye.x);
    const double sum = part * (one - two) - (three - four) * away;
    const double size =
        fabs(part) * (fabs(one) + fabs(two)) + fabs(away) * (fabs(three) + fabs(four));
    // Nine roundings at most in each term; what is added last is more than an underflow loses.
    const double bound = 32 * 0x1p-53 * size + 0x1p-500;
    if (sum > bound) return 1;
    if (-sum > bound) return -1;
    return axial_meet_side_exact(eye, point, a, b, axis, value);
}

// --- distances: in doubles

/// A vector, and a bound of the error of its coordinates.
typedef struct rough {
    sl_point at;
    double error;
} rough;

static double size(sl_point v) {
    return fabs(v.x) + fabs(v.y);
}

static rough rough_between(const sli_fine *from, const sli_fine *to) {
    const sl_point at = {to->at.x - from->at.x, to->at.y - from->at.y};
    const sl_point rest = {to->rest.x - from->rest.x, to->rest.y - from->rest.y};
    const sl_point sum = {at.x + rest.x, at.y + rest.y};
    return (rough){sum, 0x1p-51 * (size(at) + size(rest))};
}

/// A bound of the error of a product of two vectors.
static double error_of(const rough *a, const rough *b) {
    return 0x1p-50 * size(a->at) * size(b->at) + a->error * size(b->at) + b->error * size(a->at);
}

/// Whether a value is known to 20 bits; false for NaN.
static bool is_sure(double value, double error) {
    return fabs(value) > 0x1p20 * error && fabs(value) > 0x1p-200 && fabs(value) < 0x1p200;
}

/// The sign of a - b where they differ by more than a share of 2^-14, else 0.
static int compare_roughly(double a, double b) {
    if (!(a > 0x1p-900 && a < 0x1p900 && b > 0x1p-900 && b < 0x1p900)) return 0;
    return a > b * (1 + 0x1p-14) ? 1 : a < b * (1 - 0x1p-14) ? -1 : 0;
}

/// The sign; 0 where doubles leave it open.
static int compare_in_doubles(const sli_glance *g, double length) {
    const sli_fine right = {.at = g->right}, left = {.at = g->left};
    const rough p = rough_between(&g->eye, &right), q = rough_between(&g->eye, &left);
    const rough w = rough_between(&right, &left);
    const double area = sli_cross(p.at, q.at), square = length * length;
    if (!is_sure(area, error_of(&p, &q))) return 0;
    for (int side = 0; side < 2; side++) {
        const rough d = rough_between(&g->eye, side ? &g->to : &g->from);
        const bool away = side ? g->to_away : g->from_away;
        const double along = away ? -sli_dot(d.at, w.at) : sli_dot(d.at, w.at);
        const double over = sli_cross(d.at, w.at);
        if (!is_sure(along, error_of(&d, &w))) return 0;
        if (side ? along > 0 : along < 0) continue;
        if (!is_sure(over, error_of(&d, &w)) || !is_sure(size(d.at), d.error)) return 0;
        return compare_roughly(area * area * (sli_dot(d.at, d.at) / (over * over)), square);
    }
    return compare_roughly(area * area / sli_dot(w.at, w.at), square);
}

// --- distances: in whole numbers

static void lower_by(int *exponent, const sli_fine *p) {
    lower(exponent, p->at.x);
    lower(exponent, p->at.y);
    lower(exponent, p->rest.x);
    lower(exponent, p->rest.y);
}

static void set_sum(double a, double b, int exponent, sli_whole *out) {
    sli_whole s, t;
    sli_whole_set(a, exponent, &s);
    sli_whole_set(b, exponent, &t);
    sli_whole_add(&s, &t, out);
}

static void set_between(const sli_fine *from, const sli_fine *to, int exponent, vector *out) {
    sli_whole a, b;
    set_sum(from->at.x, from->rest.x, exponent, &a);
    set_sum(to->at.x, to->rest.x, exponent, &b);
    sli_whole_subtract(&b, &a, &out->x);
    set_sum(from->at.y, from->rest.y, exponent, &a);
    set_sum(to->at.y, to->rest.y, exponent, &b);
    sli_whole_subtract(&b, &a, &out->y);
}

/// The sign of a a b - c c d.
static int compare_products(const sli_whole *a, const sli_whole *b, const sli_whole *c,
                            const sli_whole *d) {
    sli_whole square, left, right;
    sli_whole_multiply(a, a, &square);
    sli_whole_multiply(&square, b, &left);
    sli_whole_multiply(c, c, &square);
    sli_whole_multiply(&square, d, &right);
    return sli_whole_compare(&left, &right);
}

/// The sign of |v| - length.
static int compare_length(const vector *v, const sli_whole *length) {
    sli_whole left, right;
    whole_dot(v, v, &left);
    sli_whole_multiply(length, length, &right);
    return sli_whole_compare(&left, &right);
}

/// The sign of the distance to the place that a direction meets, less the length.
static int compare_met(const sli_whole *area, const vector *d, const vector *w,
                       const sli_whole *length) {
    sli_whole square, over, reach;
    whole_dot(d, d, &square);
    whole_cross(d, w, &over);
    sli_whole_multiply(length, &over, &reach);
    sli_whole one;
    sli_whole_set(1, 0, &one);
    return compare_products(area, &square, &reach, &one);
}

static int exponent_of(const sli_glance *g, double length) {
    int exponent = INT_MAX;
    lower_by(&exponent, &g->eye);
    lower_by(&exponent, &g->from);
    lower_by(&exponent, &g->to);
    lower_by(&exponent, &(sli_fine){.at = g->right});
    lower_by(&exponent, &(sli_fine){.at = g->left});
    lower(&exponent, length);
    return exponent;
}

static int compare_exactly(const sli_glance *g, double length) {
    const sli_fine right = {.at = g->right}, left = {.at = g->left};
    const int exponent = exponent_of(g, length);
    vector p, q, w, d;
    sli_whole range, area, along;
    sli_whole_set(length, exponent, &range);
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
    sli_whole square, one;
    whole_dot(&w, &w, &square);
    sli_whole_set(1, 0, &one);
    return compare_products(&area, &one, &range, &square);
}

int sli_nearest_compare(const sli_glance *glance, double length) {
    const int sign = compare_in_doubles(glance, length);
    return sign ? sign : compare_exactly(glance, length);
}

int sli_distance_compare(sl_point a, sl_point b, double length) {
    const sli_fine from = {.at = a}, to = {.at = b};
    const rough v = rough_between(&from, &to);
    const int sign = compare_roughly(sli_dot(v.at, v.at), length * length);
    if (sign) return sign;
    int exponent = INT_MAX;
    lower_by(&exponent, &from);
    lower_by(&exponent, &to);
    lower(&exponent, length);
    if (exponent == INT_MAX) return 0;
    vector way;
    sli_whole range;
    set_between(&from, &to, exponent, &way);
    sli_whole_set(length, exponent, &range);
    return compare_length(&way, &range);
}
