/// Frame times.
#ifndef VIEWER_METER_H
#define VIEWER_METER_H

#include <stddef.h>

enum { SL_METER_MOST = 20000 };

typedef struct sl_meter {
    double seconds[SL_METER_MOST];
    size_t count;
} sl_meter;

void sl_meter_add(sl_meter *meter, double seconds);

typedef struct sl_meter_summary {
    double mean, median, p95, worst; ///< seconds
} sl_meter_summary;

/// Sorts what was measured.
sl_meter_summary sl_meter_sum_up(sl_meter *meter);

#endif
