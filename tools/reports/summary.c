/// Means, deviations and the best value of a column, where some values may be missing.
#include "reports/summary.h"

#include <math.h>
#include <stdio.h>

/// Deviations are scaled by a power of two, which rounds nothing: squares of areas would be too
/// large on a map as large as one can be.
bool summary_mean(const summary_values *values, double *mean, double *deviation) {
    double sum = 0, squares = 0, count = 0, widest = 0;
    int scale;
    for (size_t i = 0; i < values->count; i++) {
        const double value = values->at(values->of, i);
        if (isnan(value)) continue;
        sum += value;
        count++;
    }
    *mean = sum / count;
    for (size_t i = 0; i < values->count; i++) {
        const double value = values->at(values->of, i);
        if (!isnan(value)) widest = fmax(widest, fabs(value - *mean));
    }
    frexp(widest, &scale);
    for (size_t i = 0; i < values->count; i++) {
        const double away = ldexp(values->at(values->of, i) - *mean, -scale);
        if (!isnan(away)) squares += away * away;
    }
    *deviation = ldexp(sqrt(squares / count), scale);
    return count > 0;
}

void summary_print_mean(const char *name, const summary_values *values) {
    double mean, deviation;
    if (summary_mean(values, &mean, &deviation))
        printf("  %-36s %12.6g %12.6g\n", name, mean, deviation);
    else
        printf("  %-36s %12s\n", name, "not defined");
}

size_t summary_best(const summary_values *values, size_t best[SUMMARY_BEST]) {
    size_t count = 0;
    for (size_t i = 0; i < values->count; i++) {
        const double value = values->at(values->of, i);
        size_t at = count;
        if (isnan(value)) continue;
        while (at && value > values->at(values->of, best[at - 1])) at--;
        if (at == SUMMARY_BEST) continue;
        if (count < SUMMARY_BEST) count++;
        for (size_t k = count - 1; k > at; k--) best[k] = best[k - 1];
        best[at] = i;
    }
    return count;
}
