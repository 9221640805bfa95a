/// Frame times.
#ifndef VIEWER_METER_H
#define VIEWER_METER_H

#include <stddef.h>

enum { METER_MOST = 20000 };

typedef struct frame_meter {
    double seconds[METER_MOST];
    size_t count;
} frame_meter;

void meter_add(frame_meter *meter, double seconds);

typedef struct meter_summary {
    double mean, median, p95, worst; ///< seconds
} meter_summary;

/// Sorts what was measured.
meter_summary meter_sum_up(frame_meter *meter);

#endif
