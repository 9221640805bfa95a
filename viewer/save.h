/// What is on the screen, as a file.
#ifndef VIEWER_SAVE_H
#define VIEWER_SAVE_H

#include "app.h"

/// The whole window as .png, .svg or .pdf, by the ending of the name.
sl_status sl_save_window(sl_app *app, const char *path);

/// The plan alone, likewise; in .svg and .pdf as lines.
sl_status sl_save_plan(sl_app *app, const char *path);

/// The plan under a name that is free: NAME-1.ENDING in the present folder.
void sl_save_numbered(sl_app *app, const char *ending);

/// Plays what was recorded and saves each frame: FOLDER/frame-0001.png and on, `every` frames one.
sl_status sl_save_series(sl_app *app, const char *folder, unsigned every);

#endif
