/// The frame that is drawn from the state.
#ifndef VIEWER_FRAME_H
#define VIEWER_FRAME_H

#include "app/app.h"

/// Draws the whole window of width x height.
void app_draw(app_state *app, cairo_t *cairo);
/// The same; `user` is the app.
void frame_draw(void *user, cairo_t *cairo);

#endif
