/// What layers draw below the walls.
#ifndef VIEWER_LAYER_DRAW_H
#define VIEWER_LAYER_DRAW_H

#include "plan/layers.h"

/// Draws the layers that are shown, in the order of the table. `index` tells which of the plans
/// side by side.
void layers_draw(view_state *view, const sl_frame *frame, int index);

#endif
