#include "plan/value_scale.h"

#include "sightline/support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void value_scale_destroy(sl_context *context, value_scale *scale) {
    sl_free(context, scale->sorted);
    *scale = (value_scale){0};
}

sl_status value_scale_begin(sl_context *context, value_scale *scale, uint32_t room) {
    value_scale_destroy(context, scale);
    scale->sorted = sl_alloc_array(context, (size_t)room + 1, sizeof *scale->sorted);
    return scale->sorted ? SL_OK : SL_NO_MEMORY;
}

void value_scale_add(value_scale *scale, double value) {
    if (!isnan(value)) scale->sorted[scale->count++] = value;
}

void value_scale_end(value_scale *scale) {
    qsort(scale->sorted, scale->count, sizeof *scale->sorted, sl_compare_numbers);
    scale->least = scale->count ? scale->sorted[0] : INFINITY;
    scale->most = scale->count ? scale->sorted[scale->count - 1] : -INFINITY;
}

double value_scale_rank(const value_scale *scale, double value) {
    uint32_t low = 0, high = scale->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (scale->sorted[middle] < value)
            low = middle + 1;
        else
            high = middle;
    }
    return scale->count ? (double)low / scale->count : 0;
}

/// The value that a share of the values is below.
static double quantile(const value_scale *scale, double share) {
    if (!scale->count) return NAN;
    return scale->sorted[(uint32_t)fmin(share * scale->count, scale->count - 1.0)];
}

void value_scale_say(double value, char text[SCALE_TEXT]) {
    if (isnan(value))
        snprintf(text, SCALE_TEXT, "\xe2\x80\x93");
    else
        snprintf(text, SCALE_TEXT, value != round(value) || fabs(value) >= 1e6 ? "%.4g" : "%.0f",
                 value);
}

void value_scale_quarters(const value_scale *scale, const char *noun, legend_key *key) {
    char text[3][SCALE_TEXT], all[100], label[64];
    for (int i = 0; i < 3; i++) value_scale_say(quantile(scale, 0.25 * (i + 1)), text[i]);
    snprintf(all, sizeof all, "%s, %s, %s", text[0], text[1], text[2]);
    snprintf(label, sizeof label, "quarters of the %s end at", noun);
    legend_key_add(key, label, all);
}
