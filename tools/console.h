/// What a command has of the terminal and the system: the library's context with its hooks (notes,
/// progress, Ctrl-C), the progress line, and how the program ends.
#ifndef CONSOLE_H
#define CONSOLE_H

#include "sightline/context.h"

#include <pthread.h>
#include <stdio.h>

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

typedef struct sl_console {
    sl_context *context;
    pthread_t main_thread; ///< the only one that writes
    sl_progress_line line; ///< shown where stderr is a terminal
    bool quiet;            ///< --quiet: neither notes nor progress
} sl_console;

/// False, after a message, where there is no memory.
bool sl_console_open(sl_console *console);

/// From now on the first Ctrl-C (or SIGTERM) only asks, and the second one makes running calls
/// stop.
void sl_console_ask_first(void);
/// Whether there was one.
bool sl_console_is_asked(void);

/// Prints a line; control characters of a text that others wrote come out as '?', for they could
/// play tricks on a terminal.
void sl_console_print_line(FILE *stream, const char *before, const char *text, size_t length);

/// Checks that all of stdout was written, tells of a failure, and gives the program's exit status:
/// 0 done, 1 the work failed, 2 the arguments or an input are wrong.
int sl_console_close(sl_console *console, sl_status status);

#endif
