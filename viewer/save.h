/// What is on the screen, as a file.
#ifndef VIEWER_SAVE_H
#define VIEWER_SAVE_H

#include "app.h"

/// The whole window as .png, .svg or .pdf, by the ending of the name.
sl_status save_window(app_state *app, const char *path);

/// The plan alone, likewise; in .svg and .pdf as lines.
sl_status save_plan(app_state *app, const char *path);

/// The plan under a name that is free: NAME-1.ENDING in the present folder.
void save_numbered(app_state *app, const char *ending);

/// Plays what was recorded and saves each frame: FOLDER/frame-0001.png and on, `every` frames one.
sl_status save_series(app_state *app, const char *folder, unsigned every);

#endif
