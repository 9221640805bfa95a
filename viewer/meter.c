#include "meter.h"

#include <stdlib.h>

void meter_add(frame_meter *meter, double seconds) {
    if (meter->count < METER_MOST) meter->seconds[meter->count++] = seconds;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

meter_summary meter_sum_up(frame_meter *meter) {
    meter_summary sum = {0};
    if (!meter->count) return sum;
    qsort(meter->seconds, meter->count, sizeof *meter->seconds, by_value);
    for (size_t i = 0; i < meter->count; i++) sum.mean += meter->seconds[i] / (double)meter->count;
    sum.median = meter->seconds[meter->count / 2];
    sum.p95 = meter->seconds[meter->count * 95 / 100];
    sum.worst = meter->seconds[meter->count - 1];
    return sum;
}
