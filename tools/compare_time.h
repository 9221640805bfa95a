/// Running a method again and again until its time is known, within a limit.
#ifndef COMPARE_TIME_H
#define COMPARE_TIME_H

#include "compare_judge.h"
#include "console.h"

typedef struct sl_timing {
    unsigned repeat; ///< how often; 0 for as often as the time needs to be known well
    double limit;    ///< seconds that one run may take
} sl_timing;

/// Fills in the run's outcome, times and visibility. A run that reaches the limit, or is refused by
/// its method, is no failure. `label` leads the progress line.
sl_status sl_compare_time(sl_console *console, const sl_space *space, const sl_see_options *options,
                          const sl_timing *timing, const char *label, sl_compare_run *run);

#endif
