/// A part of a plan: what lies within the closed outlines of a drawing or map.
#ifndef WITHIN_H
#define WITHIN_H

#include "inputs/inputs.h"

/// What the options say.
typedef struct within_plan {
    const char *path; ///< NULL: all of the plan
    const char *layers;
} within_plan;

/// --within and --within-layers. `help` says what the former does.
option_table within_option_table(within_plan *plan, const char *help);

/// `help` of grids.
#define WITHIN_GRID                                                                                \
    "only grid points within the closed outlines of a drawing or map; the file may be the map "    \
    "itself"

/// Refuses layers without a drawing.
sl_status within_check(sl_context *context, const within_plan *plan);

/// Reads the outlines. `input`: how the plan itself is read.
sl_status within_read(sl_context *context, const within_plan *plan, const input_options *input,
                      sl_map *outlines);

/// Whether a ray to the right of a point crosses the segment from a to b. Exact; a segment that the
/// point lies on is not crossed.
bool within_crosses(sl_point point, sl_point a, sl_point b);

/// Whether an odd number of outlines lies on the way from a point out. Exact.
bool within_has(const sl_map *outlines, sl_point point);

/// SL_BAD_ARGUMENT: no point of the grid is within.
sl_status within_fail(sl_context *context, const within_plan *plan);

/// Makes a space in which the outlines are walls too. Its inside is what is inside of the plan's
/// space and within. Shut doors must be walls of that space. SL_BAD_ARGUMENT if nothing is.
sl_status within_space(sl_context *context, const within_plan *plan, const input_options *input,
                       const sl_space *space, sl_space *out);

#endif
