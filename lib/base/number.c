/// Numbers as decimal text, the same in every locale. A double has at most 17 digits; the shortest
/// text that reads back to the same double is found by trying 15, 16 and 17.
///
/// Most numbers of a map lie between 10^-4 and 10^15. They are written with whole numbers alone. A
/// double is m 2^e. With k chosen so that 17 digits stand before the point,
///
///     value 10^k = m 5^k / 2^s,   s = -(e + k)
///
/// and m 5^k has less than 128 bits. So the digits are a shift, and what rounding them adds or
/// drops is exact. The text reads back to the same double where this is less than half of the step
/// to the next double, 5^k in the same unit. Below a power of two that step is half as long, but
/// all such powers here are written exactly. (Both Steele and White 1990, How to Print
/// Floating-Point Numbers Accurately, with numbers of at most 128 bits.) Other numbers
/// are left to printf and strtod.
#include "base/base.h"
#include "base/wide.h"
#include "sightline/support.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The decimal point that printf and strtod take: that of the locale that the program has set. It
/// may be of several bytes.
static const char *decimal_point(void) {
    const char *point = localeconv()->decimal_point;
    return point[0] ? point : ".";
}

/// Puts `to` in the place of the first `from`. There must be room.
static void replace(char *text, const char *from, const char *to) {
    char *at = strstr(text, from);
    if (!at) return;
    const char *rest = at + strlen(from);
    memmove(at + strlen(to), rest, strlen(rest) + 1);
    while (*to) *at++ = *to++;
}

enum { LEAST_POWER = 2 }; ///< of ten, by which values are multiplied

/// A decimal number: digits / 10^places.
typedef struct decimal {
    uint64_t digits;
    int places;
} decimal;

/// The number of 15 to 17 digits that reads back to a value from 10^-4 to below 10^15.
static decimal shortest(double value) {
    // By power: the least value that it gives 17 digits. The doubles below 1 are a little larger
    // than the powers of ten that they stand for, so no comparison errs.
    static const double least[] = {1e14, 1e13, 1e12, 1e11, 1e10, 1e9,  1e8,  1e7,  1e6, 1e5,
                                   1e4,  1e3,  1e2,  1e1,  1e0,  1e-1, 1e-2, 1e-3, 1e-4};
    int power = LEAST_POWER, exponent;
    uint64_t five = 25;
    for (; value < least[power - LEAST_POWER]; power++) five *= 5;
    const uint64_t mantissa = (uint64_t)ldexp(frexp(value, &exponent), 53);
    const int shift = 53 - exponent - power; // 1 to 63
    const sli_wide product = sli_wide_product(mantissa, five);
    const uint64_t whole = product.high << (64 - shift) | product.low >> shift;
    decimal out = {.places = power - 2};
    for (uint64_t unit = 100;; unit /= 10, out.places++) {
        out.digits = whole / unit;
        const sli_wide step = sli_wide_shifted((sli_wide){0, unit}, shift);
        const sli_wide kept = sli_wide_shifted((sli_wide){0, out.digits * unit}, shift);
        const sli_wide rest = sli_wide_difference(product, kept);
        const int half = sli_wide_compare(sli_wide_shifted(rest, 1), step);
        const bool up = half > 0 || (half == 0 && out.digits % 2);
        const sli_wide error = up ? sli_wide_difference(step, rest) : rest;
        out.digits += up;
        if (unit == 1 || (!error.high && error.low <= five / 2)) break;
    }
    for (; out.places && out.digits % 10 == 0; out.places--) out.digits /= 10;
    return out;
}

static void write_decimal(decimal number, char *text) {
    char digits[SL_NUMBER_TEXT];
    size_t at = sizeof digits;
    digits[--at] = '\0';
    for (int i = 0; i < number.places; i++, number.digits /= 10)
        digits[--at] = (char)('0' + number.digits % 10);
    if (number.places) digits[--at] = '.';
    do digits[--at] = (char)('0' + number.digits % 10);
    while (number.digits /= 10);
    memcpy(text, digits + at, sizeof digits - at);
}

void sl_number_write(double value, char text[SL_NUMBER_TEXT]) {
    if (value == 0) {
        memcpy(text, signbit(value) ? "-0" : "0", signbit(value) ? 3 : 2);
        return;
    }
    if (fabs(value) >= 1e-4 && fabs(value) < 1e15) {
        if (value < 0) *text++ = '-';
        write_decimal(shortest(fabs(value)), text);
        return;
    }
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, SL_NUMBER_TEXT, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    replace(text, decimal_point(), ".");
}

/// Not pow(), whose tables make a module of WebAssembly 7 kB larger.
double sli_power_of_ten(int power) {
    char text[16];
    snprintf(text, sizeof text, "1e%d", power);
    return strtod(text, NULL);
}

static size_t skip_digits(const char *text, size_t length, size_t at) {
    while (at < length && text[at] >= '0' && text[at] <= '9') at++;
    return at;
}

size_t sli_number_length(const char *text, size_t length) {
    size_t at = length && (text[0] == '-' || text[0] == '+');
    const size_t whole = at;
    at = skip_digits(text, length, at);
    size_t digits = at - whole;
    if (at < length && text[at] == '.') {
        const size_t fraction = ++at;
        at = skip_digits(text, length, at);
        digits += at - fraction;
    }
    if (!digits) return 0;
    if (at < length && (text[at] == 'e' || text[at] == 'E')) {
        size_t exponent = at + 1;
        if (exponent < length && (text[exponent] == '-' || text[exponent] == '+')) exponent++;
        const size_t end = skip_digits(text, length, exponent);
        if (end > exponent) at = end;
    }
    return at;
}

/// The longest double takes 1,077 characters without an exponent, down to its last digit.
enum { MOST_CHARACTERS = 2048 };

bool sl_number_read(const char *text, size_t length, double *value) {
    char copy[MOST_CHARACTERS + 16];
    if (length == 0 || length > MOST_CHARACTERS || sli_number_length(text, length) != length)
        return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    replace(copy, ".", decimal_point());
    *value = strtod(copy, NULL);
    return true;
}

// --- of tables

char sl_table_separator(const char *line, size_t length) {
    return memchr(line, ';', length) ? ';' : memchr(line, '\t', length) ? '\t' : ',';
}

bool sl_table_number_read(char separator, const char *text, size_t length, double *value) {
    char copy[MOST_CHARACTERS];
    const char *const comma = separator == ',' ? NULL : memchr(text, ',', length);
    if (!comma || length > sizeof copy) return sl_number_read(text, length, value);
    memcpy(copy, text, length);
    copy[comma - text] = '.';
    return sl_number_read(copy, length, value);
}

void sl_table_text_write(FILE *out, const char *text, bool quoted) {
    quoted |= text[strcspn(text, ",\"\r\n")] || *text == ' ' || *text == '#';
    if (quoted) putc('"', out);
    for (; *text; text++) {
        if (*text == '"') putc('"', out);
        putc(strchr("\r\n", *text) ? ' ' : *text, out);
    }
    if (quoted) putc('"', out);
}

int sl_compare_numbers(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}
