/// Recorded paths of the eye, and their playback.
#ifndef VIEWER_RECORD_H
#define VIEWER_RECORD_H

#include "sightline/map.h"
#include "sightline/support.h"

/// Where the eye was, sixty times a second.
typedef struct sl_record_frame {
    sl_point at;
    double heading;
} sl_record_frame;

#define SL_RECORD_STEP (1.0 / 60)

/// Zeroed to start.
typedef struct sl_recorder {
    bool records, plays;
    double waited;
    size_t next; ///< to be played
    SL_ARRAY(sl_record_frame) frames;
} sl_recorder;

/// Goes on by a time while it records: adds frames.
sl_status sl_record_tick(sl_context *context, sl_recorder *recorder, double seconds,
                         sl_record_frame now);
/// The next frame while it plays; false at the end.
bool sl_record_play(sl_recorder *recorder, double seconds, sl_record_frame *frame);
/// In place of a recording, the way along a path of the map at a speed (units a second).
sl_status sl_record_path(sl_context *context, sl_recorder *recorder, const sl_path *path,
                         double speed);
void sl_record_destroy(sl_context *context, sl_recorder *recorder);

#endif
