/// Results of a session: recorded paths of the eye with their playback, and pictures of the screen
/// as files.
#ifndef VIEWER_SAVE_H
#define VIEWER_SAVE_H

#include "sightline/draw.h"
#include "sightline/map.h"
#include "sightline/support.h"

typedef struct app_state app_state;

// --- paths

/// Where the eye was, sixty times a second.
typedef struct record_frame {
    sl_point at;
    double heading;
} record_frame;

#define RECORD_STEP (1.0 / 60)

/// Zeroed to start.
typedef struct path_recorder {
    bool records, plays;
    double waited;
    size_t next; ///< to be played
    SL_ARRAY(record_frame) frames;
} path_recorder;

/// Records for some time: adds frames.
sl_status record_tick(sl_context *context, path_recorder *recorder, double seconds,
                      record_frame now);
/// Gives the next frame while it plays; false at the end.
bool record_play(path_recorder *recorder, double seconds, record_frame *frame);
/// Replaces the recording by a walk along a path of the map (speed: units a second).
sl_status record_path(sl_context *context, path_recorder *recorder, const sl_path *path,
                      double speed);
void record_destroy(sl_context *context, path_recorder *recorder);

// --- pictures

/// The whole window as .png, .svg or .pdf, by the ending of the name.
sl_status save_window(app_state *app, const char *path);

/// The plan alone; .svg and .pdf contain lines.
sl_status save_plan(app_state *app, const char *path);

/// What these draw: for pictures that are written in the background. `user` is the app.
void save_draw_window(void *user, cairo_t *cairo);
void save_draw_plan(void *user, cairo_t *cairo);

/// Saves the plan under a free name in the present folder: NAME-1.ENDING. A .png is written in the
/// background.
void save_numbered(app_state *app, const char *ending);

/// One picture of so many frames is enough for a film of 30 a second.
enum { SERIES_STEP = 2 };

/// Plays the recording and saves frames at once, as scripts need it: FOLDER/frame-0001.png and so
/// on, one of `every`.
sl_status save_series(app_state *app, const char *folder, unsigned every);

#endif
