/// Pictures of the window and of the plan, as files.
#ifndef VIEWER_PICTURES_H
#define VIEWER_PICTURES_H

#include "app/app.h"

/// The whole window as .png, .svg or .pdf, by the ending of the name.
sl_status save_window(app_state *app, const char *path);

/// The plan alone; .svg and .pdf contain lines.
sl_status save_plan(app_state *app, const char *path);

/// Saves the plan, and says so; with the account if that is shown: NAME-account.ENDING. A .png is
/// written in the background.
sl_status save_picture(app_state *app, const char *path);

/// One picture of so many frames is enough for a film of 30 a second.
enum { SERIES_STEP = 2 };

/// Plays the recording and saves frames: FOLDER/frame-0001.png and so on, one of `every`. Under
/// scripts at once, else in the background.
sl_status save_series(app_state *app, const char *folder, unsigned every);

#endif
