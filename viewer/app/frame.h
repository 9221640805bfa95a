/// The frame that is drawn from the state.
#ifndef VIEWER_FRAME_H
#define VIEWER_FRAME_H

#include "app/app.h"

/// Draws the whole window of width x height.
void app_draw(app_state *app, cairo_t *cairo);

/// Fits the map into a plan of that size, if the camera is to fit.
void app_fit(app_state *app, sl_box plan);

#endif
