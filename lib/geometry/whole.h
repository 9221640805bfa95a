/// Whole numbers of many digits, on the stack, for predicates with more factors than a determinant.
#ifndef SL_WHOLE_H
#define SL_WHOLE_H

#include <stdint.h>

/// The number of digits (base 2^32). It holds a product of six numbers, each a difference of two
/// finite doubles, in units of one power of two.
enum { SL_WHOLE_DIGITS = 408 };

typedef struct sl_whole {
    int sign;                         ///< -1, 0 or 1
    uint32_t count;                   ///< digits in use; the last one is not 0
    uint32_t digits[SL_WHOLE_DIGITS]; ///< the lowest first
} sl_whole;

/// The exponent of the last binary digit of a finite double other than 0.
int sl_whole_exponent(double value);

/// value * 2^-exponent, which must be whole.
void sl_whole_set(double value, int exponent, sl_whole *out);

// `out` must not be an operand.
void sl_whole_add(const sl_whole *a, const sl_whole *b, sl_whole *out);
void sl_whole_subtract(const sl_whole *a, const sl_whole *b, sl_whole *out);
void sl_whole_multiply(const sl_whole *a, const sl_whole *b, sl_whole *out);

/// The sign of a - b.
int sl_whole_compare(const sl_whole *a, const sl_whole *b);

#endif
