/// How far the work has come, on one line of a terminal's stderr that is written over at most ten
/// times a second.
#ifndef PROGRESS_LINE_H
#define PROGRESS_LINE_H

#include "sightline/context.h"

/// Zeroed but for `shows`, it is ready.
typedef struct sl_progress_line {
    bool shows;               ///< false: nothing is written
    bool visible;             ///< it stands there and must be cleared before anything else
    char stage[32], unit[32]; ///< of the last report, as are:
    uint64_t done, total;
    uint64_t first;    ///< how far the stage was when it was first heard of,
    double start;      ///< and when that was, in seconds of sl_now()
    double last_shown; ///< the same clock
    unsigned ticks;
} sl_progress_line;

void sl_progress_line_report(sl_progress_line *line, const sl_progress *progress);

/// To be called often while a stage runs: keeps the line alive between reports.
void sl_progress_line_tick(sl_progress_line *line);

void sl_progress_line_clear(sl_progress_line *line);

/// Seconds of a clock that only goes forward.
double sl_now(void);

#endif
