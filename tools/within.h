/// A part of a plan: what lies within the closed outlines of a drawing or map.
#ifndef WITHIN_H
#define WITHIN_H

#include "inputs.h"

/// What the options say.
typedef struct within_plan {
    const char *path; ///< NULL: all of the plan
    const char *layers;
} within_plan;

/// --within and --within-layers
option_table within_option_table(within_plan *plan);

/// Refuses layers without a drawing.
sl_status within_check(sl_context *context, const within_plan *plan);

/// Reads the outlines. `input`: how the plan itself is read.
sl_status within_read(sl_context *context, const within_plan *plan, const input_options *input,
                      sl_map *outlines);

/// Whether an odd number of outlines lies on the way from a point out. Exact.
bool within_has(const sl_map *outlines, sl_point point);

/// SL_BAD_ARGUMENT: no point of the grid is within.
sl_status within_fail(sl_context *context, const within_plan *plan);

#endif
