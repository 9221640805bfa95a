/// How the state of the viewer starts and ends.
#ifndef VIEWER_START_H
#define VIEWER_START_H

#include "app/app.h"

/// Nothing is open. Its parts point to each other: it stays where it is.
void app_init(app_state *app, sl_context *context);
void app_destroy(app_state *app);

#endif
