/// The view range, changed by hand: what the eye sees follows at once, what cells see by a bake in
/// the background.
#ifndef VIEWER_RANGE_H
#define VIEWER_RANGE_H

#include "app.h"

/// The farthest that the slider goes: the map's diagonal.
double sl_range_most(const sl_app *app);

/// Puts a range, above 0, in place of the one that is set; for the time being without a bake.
void sl_range_set(sl_app *app, double range);

/// Sets a range where there is none, and lifts the one that there is.
void sl_range_toggle(sl_app *app);

/// The range has been chosen: what cells see is made anew, where it was made with another one.
void sl_range_settle(sl_app *app);

/// The circle about the eye.
void sl_range_draw(sl_app *app, const sl_frame *frame);

#endif
