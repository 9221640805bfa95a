/// What comes from keys and pointer, in the terms of the page.
#ifndef VIEWER_INPUT_H
#define VIEWER_INPUT_H

#include "app.h"

/// A key goes down or up, by its name in the table of actions.
void sl_input_key(sl_app *app, const char *key, bool down);

typedef enum sl_button { SL_BUTTON_LEFT, SL_BUTTON_MIDDLE, SL_BUTTON_RIGHT } sl_button;

void sl_input_press(sl_app *app, sl_button button, sl_point at);
void sl_input_move(sl_app *app, sl_point to);
void sl_input_release(sl_app *app, sl_point at);
/// Turned away from the user is positive.
void sl_input_wheel(sl_app *app, double steps);

#endif
