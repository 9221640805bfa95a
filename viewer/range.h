/// The view range, changed by hand: what the eye sees follows at once, what cells see by a bake in
/// the background.
#ifndef VIEWER_RANGE_H
#define VIEWER_RANGE_H

#include "app.h"

/// The farthest that the slider goes: the map's diagonal.
double range_most(const app_state *app);

/// Puts a range, above 0, in place of the one that is set; for the time being without a bake.
void range_set(app_state *app, double range);

/// Sets a range where there is none, and lifts the one that there is.
void range_toggle(app_state *app);

/// The range has been chosen: what cells see is made anew, where it was made with another one.
void range_settle(app_state *app);

/// The circle about the eye.
void range_draw(app_state *app, const sl_frame *frame);

#endif
