/// PNG pictures that are written in the background: the plan, and the recorded way as a series.
#ifndef VIEWER_EXPORT_H
#define VIEWER_EXPORT_H

#include "document/document.h"

typedef struct app_state app_state;
typedef struct export_job export_job;

/// Draws the plan now, and writes it in the background. `said` is the message once it is written.
/// Waits for a single picture that is still being written; fails while a series is.
sl_status export_plan(app_state *app, const char *path, const char *said);

/// Starts to play the recording, and to write frames: FOLDER/frame-0001.png and so on, one of
/// `every`.
sl_status export_series(app_state *app, const char *folder, unsigned every);

/// Waits for a single picture; false while a series is being written.
bool export_is_free(app_state *app);

/// Call in each frame before one looks: puts the eye where the next picture is taken.
void export_move(app_state *app);
/// Call after it: takes the picture, and hears of those that are written.
void export_take(app_state *app);

/// Stops writing; false if nothing is being written. A file is whole, or not there.
bool export_stop(app_state *app);

/// Not running where `job` is NULL, and while a picture is taken: it shows no progress.
job_progress export_progress(const export_job *job);

#endif
