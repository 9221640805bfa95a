/// PNG pictures that are written in the background: the plan, and the recorded way as a series.
#ifndef VIEWER_EXPORT_H
#define VIEWER_EXPORT_H

#include "document/recorder.h"
#include "document/task.h"
#include "ui/ui.h"

typedef struct export_job export_job;

/// What draws a picture; `user` is that of the state.
typedef void export_draw(void *user, cairo_t *cairo);

typedef struct export_state {
    sl_context *context;
    ui_state *ui;
    path_recorder *recorder;
    void *user;
    export_draw *draw_window; ///< as on the screen
    export_job *job;          ///< NULL: no pictures are being written
} export_state;

/// Draws a picture of that size now, and writes it in the background. `said` is the message once it
/// is written. Waits for a single picture that is still being written; fails while a series is.
sl_status export_picture(export_state *e, const char *path, const char *said, int width, int height,
                         export_draw *draw);

/// Starts to play the recording, and to write frames: FOLDER/frame-0001.png and so on, one of
/// `every`.
sl_status export_series(export_state *e, const char *folder, unsigned every, export_draw *draw);

/// Waits for a single picture; false while a series is being written.
bool export_is_free(export_state *e);

/// Call in each frame before one looks: gives the place of the eye where a picture is taken next;
/// false for none.
bool export_move(export_state *e, record_frame *at);
/// Call after it: takes the picture, and hears of those that are written.
void export_take(export_state *e);

/// Stops writing; false if nothing is being written. A file is whole, or not there.
bool export_stop(export_state *e);

/// Not running where `job` is NULL, and while a picture is taken: it shows no progress.
job_progress export_progress(const export_job *job);

#endif
