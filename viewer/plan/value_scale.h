/// The scale of a set of values: its ends, its quarters, and the number of a value's colour.
#ifndef VIEWER_VALUE_SCALE_H
#define VIEWER_VALUE_SCALE_H

#include "plan/layers.h"

/// Zeroed to start.
typedef struct value_scale {
    double least, most; ///< infinite, most below least, where there is no value
    double *sorted;     ///< ascending
    uint32_t count;
} value_scale;

/// Begins anew, with room for so many values.
sl_status value_scale_begin(sl_context *context, value_scale *scale, uint32_t room);
void value_scale_add(value_scale *scale, double value); ///< NAN: nothing
void value_scale_end(value_scale *scale);
void value_scale_destroy(sl_context *context, value_scale *scale);

/// The share of values below this one.
double value_scale_rank(const value_scale *scale, double value);
/// Adds a row that says where quarters of what `noun` names end.
void value_scale_quarters(const value_scale *scale, const char *noun, legend_key *key);

/// Room for a value in words; a dash stands for none.
enum { SCALE_TEXT = 32 };
void value_scale_say(double value, char text[SCALE_TEXT]);

#endif
