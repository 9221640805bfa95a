/// Notes, progress and interruptions of the one context that a command has.
#include "system/console.h"

#include "sightline/support.h"
#include "system/built.h"
#include "system/crew.h"
#include "system/system.h"

#include <errno.h>
#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// --- the progress line

void progress_line_clear(progress_line *line) {
    if (!line->visible) return;
    fputs("\r\033[K", stderr);
    fflush(stderr);
    line->visible = false;
}

void text_append(char *text, size_t size, const char *format, ...) {
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

static void append_time(char *text, size_t size, double seconds) {
    if (seconds < 100)
        text_append(text, size, ", %.0f s", seconds);
    else if (seconds < 6000)
        text_append(text, size, ", %.0f min", seconds / 60);
    else
        text_append(text, size, ", %.1f h", seconds / 3600);
}

/// The width of the terminal in characters, at most `most`. A longer text would continue on the
/// next line, and only that line would be cleared.
static int room_of_terminal(int most) {
    const int width = system_terminal_width();
    return width > 0 && width - 1 < most ? width - 1 : most;
}

/// "cell to cell: 120/2000 cells, 6 %, 34/s, 55 s left"; before there is a rate, the time so far.
static void write_line(const progress_line *line, double elapsed) {
    char text[80] = "";
    const uint64_t more = line->done - line->first;
    text_append(text, sizeof text, "%s: %" PRIu64, line->stage, line->done);
    if (line->total) text_append(text, sizeof text, "/%" PRIu64, line->total);
    text_append(text, sizeof text, " %s", line->unit);
    if (line->total)
        text_append(text, sizeof text, ", %.0f %%", 100 * (double)line->done / (double)line->total);
    if (more && elapsed > 0) {
        const double rate = (double)more / elapsed;
        text_append(text, sizeof text, ", %.*f/s", rate < 10 ? 1 : 0, rate);
        if (line->total >= line->done) {
            append_time(text, sizeof text, (double)(line->total - line->done) / rate);
            text_append(text, sizeof text, " left");
        }
    } else {
        append_time(text, sizeof text, elapsed);
    }
    for (char *at = strchr(text, '_'); at; at = strchr(at, '_')) *at = ' ';
    fprintf(stderr, "\r\033[K%.*s", room_of_terminal(sizeof text), text);
    fflush(stderr);
}

static void show(progress_line *line) {
    const double now = sl_seconds();
    if (now - line->last_shown < 0.1) return;
    write_line(line, now - line->start);
    line->last_shown = now;
    line->visible = true;
}

static void progress_line_report(progress_line *line, const sl_progress *progress) {
    if (!line->shows) return;
    if (strcmp(line->stage, progress->stage) != 0 || progress->done < line->done) {
        snprintf(line->stage, sizeof line->stage, "%s", progress->stage);
        snprintf(line->unit, sizeof line->unit, "%s", progress->unit);
        line->first = progress->done;
        line->start = sl_seconds();
        // What takes less than a tenth of a second needs no line.
        if (!line->visible) line->last_shown = line->start;
    }
    line->done = progress->done;
    line->total = progress->total;
    show(line);
}

/// Call it often while a stage runs: it keeps the line alive between reports.
static void progress_line_tick(progress_line *line) {
    const bool running = line->shows && line->stage[0] && line->done != line->total;
    if (running && ++line->ticks % 64 == 0) show(line);
}

// --- the console

/// Set by SIGINT, SIGTERM or SIGHUP. At file scope because a signal handler is given nothing but
/// the signal's number; lock-free and atomic because worker threads read it.
static atomic_bool interrupted;

/// The same for: whether the first signal is only noted, and whether it came. RISC-V exchanges no
/// single bytes without a lock.
static atomic_bool asks_first;
static atomic_int asked;

/// Signals that came to this process, and the most of which it knows that came to one process.
static atomic_int own, known;

/// The first signal makes the running call stop and tidy up. Where the first one is only noted, the
/// second does this.
void console_hear_interruptions(int count) {
    int before = atomic_load(&known);
    while (before < count && !atomic_compare_exchange_weak(&known, &before, count)) continue;
    if (before >= count) return;
    if (atomic_load(&asks_first) && !atomic_exchange(&asked, 1)) return;
    atomic_store(&interrupted, true);
}

int console_interruptions(void) {
    return atomic_load(&own);
}

/// A signal after the one that stops the call ends the program.
static void on_signal(int number) {
    (void)number;
    console_hear_interruptions(atomic_fetch_add(&own, 1) + 1);
    if (atomic_load(&interrupted)) system_on_interruption(NULL);
}

void console_ask_first(void) {
    atomic_store(&asks_first, true);
}

bool console_is_asked(void) {
    return atomic_load(&asked) != 0;
}

void console_print_text(FILE *stream, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)text[i];
        const unsigned char next = i + 1 < length ? (unsigned char)text[i + 1] : 0;
        // Those of Latin-1 are two bytes in UTF-8.
        const bool second = c == 0xc2 && next >= 0x80 && next < 0xa0;
        putc(c < 0x20 || c == 0x7f || second ? '?' : c, stream);
        i += second;
    }
}

void console_print_line(FILE *stream, const char *before, const char *text, size_t length) {
    fputs(before, stream);
    console_print_text(stream, text, length);
    putc('\n', stream);
}

const char *text_without_folder(const char *text, const char *path) {
    const size_t length = strlen(path);
    const bool begins = strncmp(text, path, length) == 0 && text[length] == ':';
    return begins ? text + (sl_path_name(path) - path) : text;
}

/// The first of several notes on a file of the command line has the file's path, the others its
/// name.
static const char *shorten_note(command_console *console, const char *message) {
    const char *before = console->noted;
    console->noted = NULL;
    for (int i = 0; i < console->word_count; i++) {
        const char *shorter = text_without_folder(message, console->words[i]);
        if (shorter == message) continue;
        console->noted = console->words[i];
        return console->noted == before ? shorter : message;
    }
    return message;
}

static void show_note(void *user, const char *message) {
    command_console *console = user;
    if (console->quiet) return;
    message = shorten_note(console, message);
    progress_line_clear(&console->line);
    console_print_line(stderr, "note: ", message, strlen(message));
}

static void show_progress(void *user, const sl_progress *progress) {
    command_console *console = user;
    if (!console->quiet) progress_line_report(&console->line, progress);
}

/// This is asked far more often than progress is reported. It keeps the line alive during long
/// units of work.
static bool is_cancelled(void *user) {
    command_console *console = user;
    if (pthread_equal(pthread_self(), console->main_thread)) {
        progress_line_tick(&console->line);
        crew_listen();
    }
    return atomic_load(&interrupted);
}

bool console_open(command_console *console) {
    system_on_interruption(on_signal);
    const char *kind = getenv("TERM");
    *console = (command_console){
        .main_thread = pthread_self(),
        .line.shows = system_is_terminal(stderr) && !(kind && strcmp(kind, "dumb") == 0),
    };
    const sl_hooks hooks = {
        .user = console, .progress = show_progress, .note = show_note, .cancelled = is_cancelled};
    console->context = sl_context_create(&hooks);
    const bool good = console->context && built_use_formats(console->context) == SL_OK;
    if (good) return true;
    fputs("sightline: out of memory\n", stderr);
    sl_context_destroy(console->context);
    return false;
}

static int exit_status(sl_status status) {
    switch (status) {
    case SL_OK:
        return 0;
    case SL_NO_MEMORY:
    case SL_CANCELLED:
    case SL_IO:
        return 1;
    case SL_BAD_ARGUMENT:
    case SL_BAD_INPUT:
    case SL_UNSUPPORTED:
        break;
    }
    return 2;
}

/// Whether output failed because its reader went away, as with "| head": no fault of anybody.
/// stdio forgets why a write to stdout failed, so the pipe is asked.
static bool is_reader_gone(const char *message) {
    const char *reason = strerror(EPIPE);
    const size_t length = strlen(message), tail = strlen(reason);
    if (length > tail && strcmp(message + length - tail, reason) == 0) return true;
    return strncmp(message, "standard output:", 16) == 0 && system_reader_is_gone();
}

int console_close(command_console *console, sl_status status) {
    progress_line_clear(&console->line);
    if (status == SL_OK) {
        sl_output output;
        status = sl_output_open(console->context, "-", &output);
        if (status == SL_OK) status = sl_output_close(console->context, &output, SL_OK);
    }
    // A system call that the signal broke off is reported as what it is.
    if (status == SL_IO && atomic_load(&interrupted))
        status = sl_fail(console->context, SL_CANCELLED, "%s", sl_status_name(SL_CANCELLED));
    if (status == SL_OK && console->refuted)
        sl_fail(console->context, SL_OK, "the proof does not hold");
    const char *message = sl_context_message(console->context);
    const bool silent = status == SL_IO && is_reader_gone(message);
    if ((status != SL_OK || console->refuted) && message[0] && !silent)
        console_print_line(stderr, "sightline: ", message, strlen(message));
    sl_context_destroy(console->context);
    if (status == SL_OK && console->refuted) return 1;
    return status == SL_OK && console->fault ? 3 : exit_status(status);
}
