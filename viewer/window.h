/// The window: SDL's events become input, and the frame becomes a texture.
#ifndef VIEWER_WINDOW_H
#define VIEWER_WINDOW_H

#include "app.h"

typedef struct sl_window sl_window;

/// SL_IO where there is no display. `hidden` asks for SDL's dummy display and software rendering.
sl_status sl_window_open(sl_app *app, bool hidden, sl_window **out);
void sl_window_close(sl_window *window);

/// Draws the app and shows it.
sl_status sl_window_show(sl_window *window);

/// Runs until the app wants to quit.
sl_status sl_window_run(sl_window *window);

#endif
