/// Numbers as text, both ways, the same in every locale.
#ifndef SL_NUMBER_H
#define SL_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/// The longest text of sl_number_write, its 0 included.
#define SL_NUMBER_TEXT 32

/// The shortest decimal (at most 17 digits) that reads back to the same double. Finite values only.
void sl_number_write(double value, char text[SL_NUMBER_TEXT]);

/// The length of the decimal number at the start of text[0 .. length), 0 for none.
size_t sl_number_length(const char *text, size_t length);

/// Reads a decimal number that is all of text[0 .. length): sign, digits, point, exponent. False
/// for anything else: "nan", "inf", "0x1", "1e", "". A magnitude too large reads as an infinity.
bool sl_number_read(const char *text, size_t length, double *value);

#endif
