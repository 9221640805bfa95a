/// What the tool at hand adds to a sheet of paper: areas, lines, places and names over the plan,
/// and words below it.
#ifndef VIEWER_SHEET_PARTS_H
#define VIEWER_SHEET_PARTS_H

#include "plan/view.h"

enum { SHEET_NAME = 160 };

/// Zeroed, nothing.
typedef struct sheet_parts {
    SL_ARRAY(sl_drawn_part) parts;
    SL_ARRAY(sl_plan_label) labels;
    SL_ARRAY(sl_point) points;    ///< of the visible region
    SL_ARRAY(sl_segment) lines;   ///< of all parts
    SL_ARRAY(size_t) line_counts; ///< by part
    sl_point places[2];
    size_t end; ///< of the visible region, as a shape
    char names[2][SHEET_NAME];
    SL_ARRAY(char) words; ///< with a 0 at the end, which `count` leaves out; empty for none
} sheet_parts;

/// Adds what is shown; `over_heat`: the heat map stays to be seen below it.
sl_status sheet_parts_fill(const view_state *view, bool over_heat, sheet_parts *out);
void sheet_parts_apply(const sheet_parts *parts, sl_draw_options *options);
void sheet_parts_destroy(sl_context *context, sheet_parts *parts);

#endif
