/// Whole numbers: sign and magnitude, added and multiplied as by hand, digit by digit.
#include "geometry/crossing.h"

#include <math.h>
#include <string.h>

int sli_whole_exponent(double value) {
    int exponent;
    const double fraction = frexp(value, &exponent);
    uint64_t digits = (uint64_t)fabs(ldexp(fraction, 53));
    for (exponent -= 53; digits % 2 == 0; digits /= 2) exponent++;
    return exponent;
}

void sli_whole_set(double value, int exponent, sli_whole *out) {
    out->sign = (value > 0) - (value < 0);
    out->count = 0;
    if (!out->sign) return;
    const int own = sli_whole_exponent(value);
    const uint64_t digits = (uint64_t)fabs(ldexp(value, -own));
    const uint32_t shift = (uint32_t)(own - exponent), skip = shift / 32, rest = shift % 32;
    memset(out->digits, 0, (skip + 3) * sizeof *out->digits);
    out->digits[skip] = (uint32_t)(digits << rest);
    out->digits[skip + 1] = (uint32_t)(digits >> (32 - rest));
    out->digits[skip + 2] = rest ? (uint32_t)(digits >> (64 - rest)) : 0;
    out->count = skip + 3;
    while (!out->digits[out->count - 1]) out->count--;
}

static int compare_sizes(const sli_whole *a, const sli_whole *b) {
    if (a->count != b->count) return a->count < b->count ? -1 : 1;
    for (uint32_t i = a->count; i-- > 0;)
        if (a->digits[i] != b->digits[i]) return a->digits[i] < b->digits[i] ? -1 : 1;
    return 0;
}

int sli_whole_compare(const sli_whole *a, const sli_whole *b) {
    if (a->sign != b->sign) return a->sign < b->sign ? -1 : 1;
    return a->sign * compare_sizes(a, b);
}

/// |a| + |b|, where a has no fewer digits.
static void add_sizes(const sli_whole *a, const sli_whole *b, sli_whole *out) {
    uint64_t carry = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        carry += (uint64_t)a->digits[i] + (i < b->count ? b->digits[i] : 0);
        out->digits[i] = (uint32_t)carry;
        carry >>= 32;
    }
    out->count = a->count;
    if (carry) out->digits[out->count++] = (uint32_t)carry;
}

/// |a| - |b|, where a is the larger.
static void subtract_sizes(const sli_whole *a, const sli_whole *b, sli_whole *out) {
    uint32_t borrow = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        const uint64_t less = (uint64_t)(i < b->count ? b->digits[i] : 0) + borrow;
        borrow = a->digits[i] < less;
        out->digits[i] = (uint32_t)(a->digits[i] - less);
    }
    out->count = a->count;
    while (out->count && !out->digits[out->count - 1]) out->count--;
}

static void add_signed(const sli_whole *a, const sli_whole *b, int b_sign, sli_whole *out) {
    const int order = compare_sizes(a, b);
    const sli_whole *large = order < 0 ? b : a, *small = order < 0 ? a : b;
    const int large_sign = order < 0 ? b_sign : a->sign;
    out->sign = large_sign;
    if (a->sign == b_sign || !a->sign || !b_sign) {
        add_sizes(large, small, out);
        return;
    }
    subtract_sizes(large, small, out);
    if (!out->count) out->sign = 0;
}

void sli_whole_add(const sli_whole *a, const sli_whole *b, sli_whole *out) {
    add_signed(a, b, b->sign, out);
}

void sli_whole_subtract(const sli_whole *a, const sli_whole *b, sli_whole *out) {
    add_signed(a, b, -b->sign, out);
}

void sli_whole_multiply(const sli_whole *a, const sli_whole *b, sli_whole *out) {
    out->sign = a->sign * b->sign;
    out->count = 0;
    if (!out->sign) return;
    memset(out->digits, 0, (a->count + b->count) * sizeof *out->digits);
    for (uint32_t i = 0; i < a->count; i++) {
        uint64_t carry = 0;
        for (uint32_t k = 0; k < b->count; k++) {
            carry += (uint64_t)a->digits[i] * b->digits[k] + out->digits[i + k];
            out->digits[i + k] = (uint32_t)carry;
            carry >>= 32;
        }
        out->digits[i + b->count] = (uint32_t)carry;
    }
    out->count = a->count + b->count;
    while (!out->digits[out->count - 1]) out->count--;
}
