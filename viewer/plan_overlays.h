/// What changes in the plan from frame to frame, by mode.
#ifndef VIEWER_PLAN_OVERLAYS_H
#define VIEWER_PLAN_OVERLAYS_H

#include "app.h"

/// Cells and regions; `index` tells which of the plans side by side.
void sl_overlays_below_walls(sl_app *app, const sl_frame *frame, int index);

/// The eye, lines and marks.
void sl_overlays_above_walls(sl_app *app, const sl_frame *frame);

#endif
