/// Keys and pointer, in places of the page.
#ifndef VIEWER_INPUT_H
#define VIEWER_INPUT_H

#include "app/app.h"

/// A key goes down or up, by its name in the table of actions.
void input_key(app_state *app, const char *key, bool down);

/// Whether any action or widget takes a key.
bool input_takes(const char *key);

/// Typed text, UTF-8: goes into the text field that is typed into, if any.
void input_text(app_state *app, const char *text);

typedef enum button_kind { BUTTON_LEFT, BUTTON_MIDDLE, BUTTON_RIGHT } button_kind;

void input_press(app_state *app, button_kind button, sl_point at);
void input_move(app_state *app, sl_point to);
void input_release(app_state *app, sl_point at);
/// Positive: turned away from the user.
void input_wheel(app_state *app, double steps);

#endif
