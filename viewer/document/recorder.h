/// Recorded ways of the eye, and their playback.
#ifndef VIEWER_RECORDER_H
#define VIEWER_RECORDER_H

#include "sightline/map.h"
#include "sightline/support.h"

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

#endif
