/// The crossing of a-b and c-d is a + (b - a) n / m, with the cross products n = (c - a) x (d - c)
/// and m = (b - a) x (d - c), in whole numbers. The quotient of their highest digits is corrected
/// step by step, of which there are few: each compares, in whole numbers, the place with the middle
/// between two neighbouring doubles.
#include "geometry/crossing.h"

#include "geometry/orient.h"
#include "geometry/whole.h"

#include <math.h>

/// What the two coordinates of the place are quotients of.
typedef struct quotient {
    sl_whole x, y, divisor; ///< the divisor is positive
    int exponent;           ///< of the unit of the whole numbers that coordinates are
} quotient;

/// At most 0, so that what the least coordinate takes on top of it is a double yet.
static int lowest_exponent(const sl_segment *s, const sl_segment *t) {
    const double values[] = {s->a.x, s->a.y, s->b.x, s->b.y, t->a.x, t->a.y, t->b.x, t->b.y};
    int lowest = 0;
    for (int i = 0; i < 8; i++) {
        const int exponent = values[i] != 0 ? sl_whole_exponent(values[i]) : lowest;
        if (exponent < lowest) lowest = exponent;
    }
    return lowest;
}

static void subtract(double a, double b, int exponent, sl_whole *out) {
    sl_whole left, right;
    sl_whole_set(a, exponent, &left);
    sl_whole_set(b, exponent, &right);
    sl_whole_subtract(&left, &right, out);
}

static void cross(const sl_whole *ax, const sl_whole *ay, const sl_whole *bx, const sl_whole *by,
                  sl_whole *out) {
    sl_whole left, right;
    sl_whole_multiply(ax, by, &left);
    sl_whole_multiply(ay, bx, &right);
    sl_whole_subtract(&left, &right, out);
}

/// from * divisor + step * share
static void along(double from, int exponent, const sl_whole *divisor, const sl_whole *step,
                  const sl_whole *share, sl_whole *out) {
    sl_whole start, left, right;
    sl_whole_set(from, exponent, &start);
    sl_whole_multiply(&start, divisor, &left);
    sl_whole_multiply(step, share, &right);
    sl_whole_add(&left, &right, out);
}

static void divide(const sl_segment *s, const sl_segment *t, quotient *q) {
    sl_whole sx, sy, tx, ty, gap_x, gap_y, share;
    q->exponent = lowest_exponent(s, t);
    subtract(s->b.x, s->a.x, q->exponent, &sx);
    subtract(s->b.y, s->a.y, q->exponent, &sy);
    subtract(t->b.x, t->a.x, q->exponent, &tx);
    subtract(t->b.y, t->a.y, q->exponent, &ty);
    subtract(t->a.x, s->a.x, q->exponent, &gap_x);
    subtract(t->a.y, s->a.y, q->exponent, &gap_y);
    cross(&sx, &sy, &tx, &ty, &q->divisor);
    cross(&gap_x, &gap_y, &tx, &ty, &share);
    if (q->divisor.sign < 0) {
        q->divisor.sign = 1;
        share.sign = -share.sign;
    }
    along(s->a.x, q->exponent, &q->divisor, &sx, &share, &q->x);
    along(s->a.y, q->exponent, &q->divisor, &sy, &share, &q->y);
}

/// The sign of a coordinate of the place less the middle of two doubles.
static int compare_to_middle(const quotient *q, const sl_whole *coordinate, double a, double b) {
    int exponent = q->exponent;
    if (a != 0 && sl_whole_exponent(a) < exponent) exponent = sl_whole_exponent(a);
    if (b != 0 && sl_whole_exponent(b) < exponent) exponent = sl_whole_exponent(b);
    sl_whole left, right, sum, twice, unit;
    sl_whole_set(a, exponent, &left);
    sl_whole_set(b, exponent, &right);
    sl_whole_add(&left, &right, &sum);
    sl_whole_multiply(&sum, &q->divisor, &right);
    sl_whole_set(ldexp(1, q->exponent - exponent + 1), 0, &unit);
    sl_whole_multiply(coordinate, &unit, &twice);
    return sl_whole_compare(&twice, &right);
}

/// The next coordinate that a map may have (sl_coordinate_usable), up or down.
static double next_to(double value, double toward) {
    const double next = nextafter(value, toward);
    if (next == 0 || fabs(next) >= SL_COORDINATE_MIN) return next;
    return value != 0 ? 0 : toward > 0 ? SL_COORDINATE_MIN : -SL_COORDINATE_MIN;
}

/// The highest digits of a whole number, to be multiplied by 2^*exponent.
static double leading(const sl_whole *whole, int *exponent) {
    const uint32_t first = whole->count > 3 ? whole->count - 3 : 0;
    double value = 0;
    for (uint32_t i = whole->count; i-- > first;) value = value * 0x1p32 + whole->digits[i];
    *exponent = 32 * (int)first;
    return value;
}

/// The usable double nearest to a coordinate; of two that are as near the lower one.
static double nearest(const quotient *q, const sl_whole *coordinate) {
    int above, below;
    const double share = leading(coordinate, &above) / leading(&q->divisor, &below);
    double value = coordinate->sign * ldexp(share, above - below + q->exponent);
    if (fabs(value) < SL_COORDINATE_MIN) value = 0;
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

sl_point sl_crossing(sl_segment s, sl_segment t) {
    quotient q;
    divide(&s, &t, &q);
    return (sl_point){nearest(&q, &q.x), nearest(&q, &q.y)};
}

// --- the side of a line

/// (b - a) x (c - a), rounded, and by how much it may be off.
typedef struct rounded {
    double value, error;
} rounded;

static rounded determinant(sl_point a, sl_point b, sl_point c) {
    const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    return (rounded){left - right, 8 * 0x1p-53 * (fabs(left) + fabs(right)) + 0x1p-900};
}

static void determinant_exact(sl_point a, sl_point b, sl_point c, int exponent, sl_whole *out) {
    sl_whole bx, by, cx, cy;
    subtract(b.x, a.x, exponent, &bx);
    subtract(b.y, a.y, exponent, &by);
    subtract(c.x, a.x, exponent, &cx);
    subtract(c.y, a.y, exponent, &cy);
    cross(&bx, &by, &cx, &cy, out);
}

/// The sign of |along b| * |across a| - |along a| * |across b|, where `across` is a determinant of
/// an end of s with the line, and `along` one with t.
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
    sl_whole one, other, left_exact, right_exact;
    determinant_exact(t->a, t->b, s->b, exponent, &one);
    determinant_exact(from, to, s->a, exponent, &other);
    sl_whole_multiply(&one, &other, &left_exact);
    determinant_exact(t->a, t->b, s->a, exponent, &one);
    determinant_exact(from, to, s->b, exponent, &other);
    sl_whole_multiply(&one, &other, &right_exact);
    left_exact.sign = left_exact.sign != 0;
    right_exact.sign = right_exact.sign != 0;
    return sl_whole_compare(&left_exact, &right_exact);
}

int sl_crossing_side(sl_point from, sl_point to, sl_segment s, sl_segment t) {
    const int a = sl_orient(from, to, s.a), b = sl_orient(from, to, s.b);
    if (a * b >= 0) return a ? a : b;
    return a * compare_shares(from, to, &s, &t);
}
