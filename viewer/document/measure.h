/// Numbers with their unit, as people read and type them.
#ifndef VIEWER_MEASURE_H
#define VIEWER_MEASURE_H

#include <stdbool.h>

enum { MEASURE_TEXT = 96 };

/// Four digits: "12.3 m", or with `power`, a raised 2, an area, "12.3 m²". A unit of "" is none.
void measure_say(double value, const char *unit, const char *power, char text[MEASURE_TEXT]);

/// Reads a number, as "4.20 m" or "4,2". *unit: the text behind it, "" for none. False where no
/// finite number stands first.
bool measure_read(const char *text, double *value, const char **unit);

#endif
