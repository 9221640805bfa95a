/// Fractions of whole numbers of any length, as doubles.
#ifndef SLI_FRACTION_H
#define SLI_FRACTION_H

#include <stdbool.h>
#include <stddef.h>

/// The most digits of a numerator or a denominator.
enum { SLI_FRACTION_DIGITS = 2000 };

/// The double nearest to above / below, of two equally near ones the even one. Both are digits with
/// or without a sign, of up to SLI_FRACTION_DIGITS; false for anything else, and for below == 0.
/// *exact: it is the quotient itself. A magnitude below 2^-1000 gives 0, one past 2^1000 infinity.
bool sli_fraction_read(const char *above, size_t above_length, const char *below,
                       size_t below_length, double *value, bool *exact);

#endif
