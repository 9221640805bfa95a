/// A double as an odd integer times a power of two: exact for every finite value.
#ifndef SL_TESTS_DYADIC_H
#define SL_TESTS_DYADIC_H

#include <math.h>
#include <stdint.h>

typedef struct dyadic {
    int64_t odd; ///< 0 for zero, whose exponent is then 0
    int exponent;
} dyadic;

static inline dyadic dyadic_of(double value) {
    dyadic result = {0, 0};
    if (value == 0) return result;
    double fraction = frexp(value, &result.exponent);
    result.odd = (int64_t)ldexp(fraction, 53);
    result.exponent -= 53;
    while (result.odd % 2 == 0) {
        result.odd /= 2;
        result.exponent++;
    }
    return result;
}

#endif
