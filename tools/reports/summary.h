/// The summary of a table: the mean and the standard deviation of a measure, and where it is
/// highest.
#ifndef SUMMARY_H
#define SUMMARY_H

#include <stdbool.h>
#include <stddef.h>

/// Values by number; NAN for none.
typedef struct summary_values {
    double (*at)(const void *of, size_t index);
    const void *of;
    size_t count;
} summary_values;

enum { SUMMARY_BEST = 10 };

/// False where there is no value.
bool summary_mean(const summary_values *values, double *mean, double *deviation);

/// Prints a line of the summary: the name, the mean and the deviation.
void summary_print_mean(const char *name, const summary_values *values);

/// Finds the highest values, the first of equal ones, and returns how many there are.
size_t summary_best(const summary_values *values, size_t best[SUMMARY_BEST]);

#endif
