/// Long division in binary: 64 bits of the quotient, and whether anything is left. These decide how
/// it is rounded to 53 bits.
#include "io/fraction.h"

#include <math.h>
#include <stdint.h>

/// Words for all digits, at most log2(10) < 10/3 bits each, and two for shifts.
enum { WORDS = SLI_FRACTION_DIGITS * 10 / 3 / 32 + 3 };

/// A whole number: words from the low end on, without zeros at the high end.
typedef struct number {
    uint32_t words[WORDS];
    int count;
    bool negative;
} number;

static bool read_digits(const char *text, size_t length, number *out) {
    const bool sign = length && (*text == '-' || *text == '+');
    out->count = 0;
    out->negative = sign && *text == '-';
    if (length == sign || length - sign > SLI_FRACTION_DIGITS) return false;
    for (size_t i = sign; i < length; i++) {
        if (text[i] < '0' || text[i] > '9') return false;
        uint64_t carry = (uint64_t)(text[i] - '0');
        for (int k = 0; k < out->count; k++, carry >>= 32) {
            carry += (uint64_t)out->words[k] * 10;
            out->words[k] = (uint32_t)carry;
        }
        if (carry) out->words[out->count++] = (uint32_t)carry;
    }
    return true;
}

static int bits_of(const number *n) {
    int bits = 32 * n->count;
    if (!bits) return 0;
    for (uint32_t top = n->words[n->count - 1]; !(top & 0x80000000u); top <<= 1) bits--;
    return bits;
}

static int compare(const number *a, const number *b) {
    if (a->count != b->count) return a->count < b->count ? -1 : 1;
    for (int k = a->count; k--;)
        if (a->words[k] != b->words[k]) return a->words[k] < b->words[k] ? -1 : 1;
    return 0;
}

static void trim(number *a) {
    while (a->count && !a->words[a->count - 1]) a->count--;
}

static void subtract(number *a, const number *b) {
    uint64_t borrow = 0;
    for (int k = 0; k < a->count; k++) {
        const uint64_t less = borrow + (k < b->count ? b->words[k] : 0);
        borrow = a->words[k] < less;
        a->words[k] = (uint32_t)(a->words[k] - less);
    }
    trim(a);
}

/// In place, from the high end on. The result fits, as both numbers are of as many bits then.
static void shift(number *a, int bits) {
    const int words = bits / 32, rest = bits % 32, count = a->count + words + 1;
    for (int k = count; k--;) {
        const uint64_t high = k >= words && k - words < a->count ? a->words[k - words] : 0;
        const uint64_t low = k > words && k - words <= a->count ? a->words[k - words - 1] : 0;
        if (k < WORDS) a->words[k] = (uint32_t)((high << 32 | low) << rest >> 32);
    }
    a->count = count < WORDS ? count : WORDS;
    trim(a);
}

bool sli_fraction_read(const char *above, size_t above_length, const char *below,
                       size_t below_length, double *value, bool *exact) {
    number a, b;
    if (!read_digits(above, above_length, &a) || !read_digits(below, below_length, &b) || !b.count)
        return false;
    const int power = bits_of(&a) - bits_of(&b);
    *exact = true;
    *value = 0;
    if (!a.count) return true;
    *exact = power <= 1000 && power >= -1000;
    if (power > 1000) *value = INFINITY;
    if (*exact) {
        shift(power > 0 ? &b : &a, power > 0 ? power : -power);
        uint64_t quotient = 0;
        for (int i = 0; i < 64; i++) {
            quotient <<= 1;
            if (compare(&a, &b) >= 0) {
                subtract(&a, &b);
                quotient |= 1;
            }
            shift(&a, 1);
        }
        // What is left beyond 64 bits only tells a half from more than that.
        quotient |= a.count > 0;
        *exact = (double)quotient < 0x1p64 && (uint64_t)(double)quotient == quotient;
        *value = ldexp((double)quotient, power - 63);
    }
    if (a.negative != b.negative) *value = -*value;
    return true;
}
