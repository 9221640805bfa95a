/// Exact signs of sums of products, for the cases that the filters of orient.h leave open.
///
/// A finite double is a whole number below 2^53 times a power of two. So a product of two doubles
/// is a whole number of at most 106 bits times a power of two. A sign is that of a sum of 6 to 24
/// such products. They are added in a fixed-point number wide enough for every exponent:
///
///     limbs   ...|........|........|........|........|...
///     product            [== 106 bits ==]  shifted to its exponent, in two's complement
///
/// Everything is done in integers: there is no rounding, no overflow, and no dependence on how a
/// compiler treats doubles.
///
/// Points of most maps lie on a grid. There the differences of coordinates are exact, and only two
/// products are left to compare. This case is tried first.
#include "geometry/orient.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef struct product {
    sli_wide magnitude;
    int exponent;
    bool negative;
} product;

/// A finite double as an integer below 2^53 times 2^exponent, exponent >= -1074.
static uint64_t integer_part(double value, int *exponent) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int biased = (int)(bits >> 52 & 0x7ff);
    const uint64_t fraction = bits & ((UINT64_C(1) << 52) - 1);
    *exponent = (biased ? biased : 1) - 1075;
    return biased ? fraction | UINT64_C(1) << 52 : fraction;
}

static product multiply(double a, double b, bool negative) {
    int exponent_a, exponent_b;
    const sli_wide magnitude =
        sli_wide_product(integer_part(a, &exponent_a), integer_part(b, &exponent_b));
    return (product){.magnitude = magnitude,
                     .exponent = exponent_a + exponent_b,
                     .negative = negative != (signbit(a) != signbit(b))};
}

/// Limbs for exponents from -2148 to 1942, for 106 bits of a product above, and for carries of 24
/// products.
enum { LIMBS = (2148 + 1942 + 106 + 8) / 64 + 2 };

/// Adds a product, shifted to start at bit `shift`, to a number in two's complement.
static void add_product(uint64_t *limbs, int count, const product *p, int shift) {
    const sli_wide low = sli_wide_shifted(p->magnitude, shift % 64);
    const uint64_t top = shift % 64 ? p->magnitude.high >> (64 - shift % 64) : 0;
    const uint64_t parts[3] = {low.low, low.high, top};
    uint64_t carry = p->negative;
    for (int i = shift / 64, part = 0; i < count; i++, part++) {
        const uint64_t value = part < 3 ? parts[part] : 0;
        const uint64_t sum = limbs[i] + (p->negative ? ~value : value), all = sum + carry;
        carry = (uint64_t)(sum < limbs[i]) + (all < sum);
        limbs[i] = all;
    }
}

static int sign_of_sum(const product *products, int product_count) {
    int lowest = 4096, highest = -4096;
    for (int i = 0; i < product_count; i++) {
        if (sli_wide_is_0(products[i].magnitude)) continue;
        if (products[i].exponent < lowest) lowest = products[i].exponent;
        if (products[i].exponent > highest) highest = products[i].exponent;
    }
    if (highest < lowest) return 0;
    uint64_t limbs[LIMBS] = {0};
    const int count = (highest - lowest + 106 + 8) / 64 + 1;
    for (int i = 0; i < product_count; i++)
        if (!sli_wide_is_0(products[i].magnitude))
            add_product(limbs, count, &products[i], products[i].exponent - lowest);
    if (limbs[count - 1] >> 63) return -1;
    for (int i = 0; i < count; i++)
        if (limbs[i]) return 1;
    return 0;
}

/// Frequent cases that no filter decides: a point that is met again, points on an axial line.
static bool plainly_on_line(sl_point a, sl_point b, sl_point c) {
    return (a.x == c.x && (b.x == c.x || a.y == c.y)) || (b.y == c.y && (a.y == c.y || b.x == c.x));
}

/// a - b where doubles hold it without rounding (Knuth's two-sum; Shewchuk 1997, theorem 7).
static bool subtract(double a, double b, double *difference) {
    const double d = a - b, b_part = a - d, a_part = d + b_part;
    *difference = d;
    return (a - a_part) + (b_part - b) == 0;
}

/// Compares two products of two doubles: -1, 0, 1. False where a factor has no full mantissa.
static bool compare_products(const product *p, const product *q, int *order) {
    const uint64_t full = UINT64_C(1) << 40; // of two mantissas of 53 bits: 2^104
    const bool none_p = sli_wide_is_0(p->magnitude), none_q = sli_wide_is_0(q->magnitude);
    if (none_p || none_q || p->negative != q->negative) {
        const int sign_p = none_p ? 0 : p->negative ? -1 : 1;
        const int sign_q = none_q ? 0 : q->negative ? -1 : 1;
        *order = (sign_p > sign_q) - (sign_p < sign_q);
        return true;
    }
    if (p->magnitude.high < full || q->magnitude.high < full) return false;
    int shift = p->exponent - q->exponent;
    int larger = shift > 2 ? 1 : shift < -2 ? -1 : 0;
    if (!larger)
        larger = sli_wide_compare(sli_wide_shifted(p->magnitude, shift > 0 ? shift : 0),
                                  sli_wide_shifted(q->magnitude, shift < 0 ? -shift : 0));
    *order = p->negative ? -larger : larger;
    return true;
}

/// The case of points on a grid, where the differences of coordinates are exact.
static bool orient_by_differences(sl_point a, sl_point b, sl_point c, int *sign) {
    double ax, ay, bx, by;
    if (!subtract(a.x, c.x, &ax) || !subtract(a.y, c.y, &ay) || !subtract(b.x, c.x, &bx) ||
        !subtract(b.y, c.y, &by))
        return false;
    const product left = multiply(ax, by, false), right = multiply(ay, bx, false);
    return compare_products(&left, &right, sign);
}

int sli_orient_exact(sl_point a, sl_point b, sl_point c) {
    int sign;
    if (plainly_on_line(a, b, c)) return 0;
    if (orient_by_differences(a, b, c, &sign)) return sign;
    const product products[6] = {
        multiply(a.x, b.y, false), multiply(a.y, b.x, true),  multiply(b.x, c.y, false),
        multiply(b.y, c.x, true),  multiply(c.x, a.y, false), multiply(c.y, a.x, true),
    };
    return sign_of_sum(products, 6);
}

/// Adds the products of p x q, sums of two each.
static int multiply_fine(const sli_fine *p, const sli_fine *q, product *products) {
    const double px[2] = {p->at.x, p->rest.x}, py[2] = {p->at.y, p->rest.y};
    const double qx[2] = {q->at.x, q->rest.x}, qy[2] = {q->at.y, q->rest.y};
    for (int i = 0; i < 4; i++) {
        products[2 * i] = multiply(px[i / 2], qy[i % 2], false);
        products[2 * i + 1] = multiply(py[i / 2], qx[i % 2], true);
    }
    return 8;
}

int sli_orient_fine(const sli_fine *a, const sli_fine *b, const sli_fine *c) {
    product products[24];
    int count = multiply_fine(a, b, products);
    count += multiply_fine(b, c, products + count);
    count += multiply_fine(c, a, products + count);
    return sign_of_sum(products, count);
}

int sli_turn_exact(sl_point a, sl_point b, sl_point c, sl_point d) {
    // Two directions along the same axis are frequent.
    if ((a.x == b.x && c.x == d.x) || (a.y == b.y && c.y == d.y)) return 0;
    const product products[8] = {
        multiply(b.x, d.y, false), multiply(b.x, c.y, true), multiply(a.x, d.y, true),
        multiply(a.x, c.y, false), multiply(b.y, d.x, true), multiply(b.y, c.x, false),
        multiply(a.y, d.x, false), multiply(a.y, c.x, true),
    };
    return sign_of_sum(products, 8);
}

int sl_orient(sl_point a, sl_point b, sl_point c) {
    return sli_orient(a, b, c);
}
