/// The window: SDL's events become input, and the frame becomes a texture.
#ifndef VIEWER_WINDOW_H
#define VIEWER_WINDOW_H

#include "app/app.h"

typedef struct app_window app_window;

/// SL_IO without a display. `hidden` asks for SDL's dummy display and software rendering.
sl_status window_open(app_state *app, bool hidden, app_window **out);
void window_close(app_window *window);

/// Draws the app and shows it.
sl_status window_show(app_window *window);

/// Runs until the app wants to quit.
sl_status window_run(app_window *window);

#endif
