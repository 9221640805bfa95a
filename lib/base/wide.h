/// Whole numbers of 128 bits, for products of mantissas. Where the compiler has none of its own, as
/// on machines of 32 bits, they are made of parts of 32 bits.
#ifndef SLI_WIDE_H
#define SLI_WIDE_H

#include <stdbool.h>
#include <stdint.h>

/// Without a sign.
typedef struct sli_wide {
    uint64_t high, low;
} sli_wide;

static inline sli_wide sli_wide_product(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
    __extension__ typedef unsigned __int128 whole;
    const whole product = (whole)a * b;
    return (sli_wide){(uint64_t)(product >> 64), (uint64_t)product};
#else
    const uint64_t part = UINT32_MAX, a_low = a & part, a_high = a >> 32, b_low = b & part,
                   b_high = b >> 32;
    const uint64_t low = a_low * b_low, left = a_high * b_low, right = a_low * b_high;
    const uint64_t middle = (low >> 32) + (left & part) + (right & part);
    return (sli_wide){a_high * b_high + (left >> 32) + (right >> 32) + (middle >> 32),
                      middle << 32 | (low & part)};
#endif
}

/// Shifted by 0 to 63 bits.
static inline sli_wide sli_wide_shifted(sli_wide a, int shift) {
    if (!shift) return a;
    return (sli_wide){a.high << shift | a.low >> (64 - shift), a.low << shift};
}

/// a - b, where b is not the larger.
static inline sli_wide sli_wide_difference(sli_wide a, sli_wide b) {
    return (sli_wide){a.high - b.high - (a.low < b.low), a.low - b.low};
}

/// -1, 0 or 1.
static inline int sli_wide_compare(sli_wide a, sli_wide b) {
    if (a.high != b.high) return a.high < b.high ? -1 : 1;
    return (a.low > b.low) - (a.low < b.low);
}

static inline bool sli_wide_is_0(sli_wide a) {
    return !(a.high | a.low);
}

/// Compares the products a x b and c x d: -1, 0 or 1. No factor is the least number there is.
static inline int sli_compare_products(int64_t a, int64_t b, int64_t c, int64_t d) {
#ifdef __SIZEOF_INT128__
    __extension__ typedef __int128 whole;
    const whole left = (whole)a * b, right = (whole)c * d;
    return (left > right) - (left < right);
#else
    const int left_sign = ((a > 0) - (a < 0)) * ((b > 0) - (b < 0));
    const int right_sign = ((c > 0) - (c < 0)) * ((d > 0) - (d < 0));
    if (left_sign != right_sign || !left_sign)
        return (left_sign > right_sign) - (left_sign < right_sign);
    const sli_wide left = sli_wide_product((uint64_t)(a < 0 ? -a : a), (uint64_t)(b < 0 ? -b : b));
    const sli_wide right = sli_wide_product((uint64_t)(c < 0 ? -c : c), (uint64_t)(d < 0 ? -d : d));
    return left_sign * sli_wide_compare(left, right);
#endif
}

#endif
