/// Numbers as decimal text, the same in every locale. A double has at most 17 digits; the shortest
/// text that reads back to the same double is found by trying 15, 16 and 17.
#include "sightline/support.h"

#include <locale.h>
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

void sl_number_write(double value, char text[SL_NUMBER_TEXT]) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, SL_NUMBER_TEXT, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    replace(text, decimal_point(), ".");
}

static size_t skip_digits(const char *text, size_t length, size_t at) {
    while (at < length && text[at] >= '0' && text[at] <= '9') at++;
    return at;
}

size_t sl_number_length(const char *text, size_t length) {
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

bool sl_number_read(const char *text, size_t length, double *value) {
    char copy[512 + 16];
    if (length == 0 || length >= 512 || sl_number_length(text, length) != length) return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    replace(copy, ".", decimal_point());
    *value = strtod(copy, NULL);
    return true;
}
