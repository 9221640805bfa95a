#include "document/measure.h"

#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void measure_say(double value, const char *unit, const char *power, char text[MEASURE_TEXT]) {
    // Four digits, also where %g would write an exponent.
    const double step = value >= 9999.5 && value < 1e15 ? pow(10, floor(log10(value)) - 3) : 0;
    snprintf(text, MEASURE_TEXT, step > 0 ? "%.0f%s%s%s" : "%.4g%s%s%s",
             step > 0 ? step * round(value / step) : value, *unit ? " " : "", unit,
             *unit ? power : "");
}

bool measure_read(const char *text, double *value, const char **unit) {
    const size_t digits = strspn(text, "0123456789.,+-eE");
    *unit = text + digits + strspn(text + digits, " ");
    return sl_table_number_read(';', text, digits, value) && isfinite(*value);
}
