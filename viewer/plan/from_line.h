/// What is seen from a line that is dragged in the plan: from some point of it, and from all.
#ifndef VIEWER_FROM_LINE_H
#define VIEWER_FROM_LINE_H

#include "plan/tool_job.h"
#include "sightline/set_sight.h"

struct from_line {
    tool_job job;
    bool drawn; ///< there is a line
    sl_point ends[2];
    sl_set_region seen[2]; ///< by sl_set_seen; the job's until it is made
};

/// Begins a line here. Its other end follows the pointer until it is dropped.
void from_line_begin(view_state *view, sl_point at);
void from_line_move(view_state *view, sl_point to);

/// Follows doors and walls. With `wait` it waits for what is seen.
void from_line_update(view_state *view, bool wait);
/// NULL: there is no line, or what it sees is not there yet.
const from_line *from_line_seen(const view_state *view);
void from_line_draw_below(view_state *view, const sl_frame *frame);
void from_line_draw_above(const view_state *view, const sl_frame *frame);
/// Forgets the line. False where there was none.
bool from_line_clear(view_state *view);
void from_line_destroy(sl_context *context, from_line *layer); ///< NULL: nothing

#endif
