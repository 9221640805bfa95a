/// What a command has of the terminal and the system: the library's context with its hooks (notes,
/// progress, Ctrl-C), the progress line, and how the program ends.
#ifndef CONSOLE_H
#define CONSOLE_H

#include "sightline/context.h"

#include <pthread.h>
#include <stdio.h>

/// Zeroed but for `shows`, it is ready.
typedef struct progress_line {
    bool shows;               ///< false: nothing is written
    bool visible;             ///< it stands there and must be cleared before anything else
    char stage[32], unit[32]; ///< of the last report, as are:
    uint64_t done, total;
    uint64_t first;    ///< how far the stage was when it was first heard of,
    double start;      ///< and when that was, in seconds of sl_seconds()
    double last_shown; ///< the same clock
    unsigned ticks;
} progress_line;

void progress_line_report(progress_line *line, const sl_progress *progress);

/// To be called often while a stage runs: keeps the line alive between reports.
void progress_line_tick(progress_line *line);

void progress_line_clear(progress_line *line);

typedef struct command_console {
    sl_context *context;
    pthread_t main_thread; ///< the only one that writes
    progress_line line;    ///< shown where stderr is a terminal
    bool quiet;            ///< --quiet: neither notes nor progress
} command_console;

/// False, after a message, where there is no memory.
bool console_open(command_console *console);

/// From now on the first Ctrl-C (or SIGTERM) only asks, and the second one makes running calls
/// stop.
void console_ask_first(void);
/// Whether there was one.
bool console_is_asked(void);

/// Prints a line; control characters of a text that others wrote come out as '?', for they could
/// play tricks on a terminal.
void console_print_line(FILE *stream, const char *before, const char *text, size_t length);

/// Checks that all of stdout was written, tells of a failure, and gives the program's exit status:
/// 0 done, 1 the work failed, 2 the arguments or an input are wrong.
int console_close(command_console *console, sl_status status);

#endif
