/// What a command needs of the terminal and the system: the library's context with its hooks
/// (notes, progress, Ctrl-C), the progress line, and the end of the program.
#ifndef CONSOLE_H
#define CONSOLE_H

#include "sightline/context.h"

#include <pthread.h>
#include <stdio.h>

/// Ready when all but `shows` is zero.
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

void progress_line_clear(progress_line *line);

typedef struct command_console {
    sl_context *context;
    pthread_t main_thread; ///< the only one that writes
    progress_line line;    ///< shown where stderr is a terminal
    bool quiet;            ///< --quiet: neither notes nor progress
    const char *summary;   ///< what the command does, in a few words
    bool fault;            ///< check --strict found a fault, or path no way: the exit status
                           ///< is 3
    bool refuted;          ///< place --verify: a proof does not hold: the exit status is 1
    char *const *words;    ///< of the command line
    int word_count;
    const char *noted; ///< the one of them, a file's path, that the last note began with
} command_console;

/// False where there is no memory; a message has been printed.
bool console_open(command_console *console);

/// From now on the first Ctrl-C (SIGTERM, SIGHUP) is only noted. The second one stops running
/// calls.
void console_ask_first(void);
/// Whether there was one.
bool console_is_asked(void);

/// How many there were in this process.
int console_interruptions(void);
/// Another process that shares the work had so many. This one does as if they had come to it: what
/// comes to several processes at once counts once.
void console_hear_interruptions(int count);

/// Prints text from a file. Control characters become '?', since they could play tricks on the
/// terminal.
void console_print_text(FILE *stream, const char *text, size_t length);
/// Prints a line of such text.
void console_print_line(FILE *stream, const char *before, const char *text, size_t length);

/// A message without the folder of a file, where it begins with the file's path: "FILE:LINE: ...".
const char *text_without_folder(const char *text, const char *path);

/// Adds to a text in `size` bytes, as far as there is room.
void text_append(char *text, size_t size, const char *format, ...) SL_PRINTF(3, 4);

/// Checks that all of stdout was written, prints the message of a failure, and gives the exit
/// status of the program: 0 done, 1 the work failed, 2 the arguments or an input file are wrong, 3
/// a fault that a check was to find.
int console_close(command_console *console, sl_status status);

#endif
