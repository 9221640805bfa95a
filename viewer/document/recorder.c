/// Where the eye was, sixty times a second.
#include "document/recorder.h"

#include <math.h>

/// Ten minutes.
enum { FRAMES_MOST = 36000 };

static sl_status add_frame(sl_context *context, path_recorder *recorder, record_frame frame) {
    if (recorder->frames.count >= FRAMES_MOST) {
        recorder->records = false;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &recorder->frames, 1));
    recorder->frames.items[recorder->frames.count++] = frame;
    return SL_OK;
}

sl_status record_tick(sl_context *context, path_recorder *recorder, double seconds,
                      record_frame now) {
    if (!recorder->records) return SL_OK;
    for (recorder->waited += seconds; recorder->waited >= RECORD_STEP * 0.999;
         recorder->waited -= RECORD_STEP)
        SL_TRY(add_frame(context, recorder, now));
    return SL_OK;
}

bool record_play(path_recorder *recorder, double seconds, record_frame *frame) {
    if (!recorder->plays) return false;
    recorder->waited += seconds;
    const size_t steps = (size_t)(recorder->waited / RECORD_STEP + 0.001);
    recorder->waited -= (double)steps * RECORD_STEP;
    if (recorder->next >= recorder->frames.count) {
        recorder->plays = false;
        return false;
    }
    *frame = recorder->frames.items[recorder->next];
    recorder->next += steps;
    return true;
}

sl_status record_path(sl_context *context, path_recorder *recorder, const sl_path *path,
                      double speed) {
    recorder->frames.count = 0;
    for (size_t i = 1; i < path->count; i++) {
        const sl_point a = path->points[i - 1], b = path->points[i];
        const double length = hypot(b.x - a.x, b.y - a.y);
        const double heading = atan2(b.y - a.y, b.x - a.x) * (180 / 3.14159265358979323846);
        const double steps = fmin(ceil(length / (speed * RECORD_STEP)), FRAMES_MOST);
        for (double k = 0; k < steps; k++)
            SL_TRY(add_frame(
                context, recorder,
                (record_frame){{a.x + (b.x - a.x) * k / steps, a.y + (b.y - a.y) * k / steps},
                               heading}));
    }
    return SL_OK;
}

void record_destroy(sl_context *context, path_recorder *recorder) {
    sl_free(context, recorder->frames.items);
    *recorder = (path_recorder){0};
}
