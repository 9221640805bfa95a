#include "progress_line.h"

#include "sightline/support.h"

#include <inttypes.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

double sl_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

void sl_progress_line_clear(sl_progress_line *line) {
    if (!line->visible) return;
    fputs("\r\033[K", stderr);
    fflush(stderr);
    line->visible = false;
}

/// Adds to the text, as far as there is room.
static void append(char *text, size_t size, const char *format, ...) SL_PRINTF(3, 4);

static void append(char *text, size_t size, const char *format, ...) {
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

static void append_time(char *text, size_t size, double seconds) {
    if (seconds < 100)
        append(text, size, ", %.0f s", seconds);
    else if (seconds < 6000)
        append(text, size, ", %.0f min", seconds / 60);
    else
        append(text, size, ", %.1f h", seconds / 3600);
}

/// Characters that a line of the terminal has room for, at most `most`: a longer one would go on in
/// the next, and only that one would be cleared.
static int room_of_terminal(int most) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return most;
    return size.ws_col - 1 < most ? size.ws_col - 1 : most;
}

/// "cell to cell: 120/2000 cells, 6 %, 34/s, 55 s left"; before there is a rate, the time so far.
static void write_line(const sl_progress_line *line, double elapsed) {
    char text[80] = "";
    const uint64_t more = line->done - line->first;
    append(text, sizeof text, "%s: %" PRIu64, line->stage, line->done);
    if (line->total) append(text, sizeof text, "/%" PRIu64, line->total);
    append(text, sizeof text, " %s", line->unit);
    if (line->total)
        append(text, sizeof text, ", %.0f %%", 100 * (double)line->done / (double)line->total);
    if (more && elapsed > 0) {
        const double rate = (double)more / elapsed;
        append(text, sizeof text, ", %.*f/s", rate < 10 ? 1 : 0, rate);
        if (line->total >= line->done) {
            append_time(text, sizeof text, (double)(line->total - line->done) / rate);
            append(text, sizeof text, " left");
        }
    } else {
        append_time(text, sizeof text, elapsed);
    }
    for (char *at = strchr(text, '_'); at; at = strchr(at, '_')) *at = ' ';
    fprintf(stderr, "\r\033[K%.*s", room_of_terminal(sizeof text), text);
    fflush(stderr);
}

static void show(sl_progress_line *line) {
    const double now = sl_now();
    if (now - line->last_shown < 0.1) return;
    write_line(line, now - line->start);
    line->last_shown = now;
    line->visible = true;
}

void sl_progress_line_report(sl_progress_line *line, const sl_progress *progress) {
    if (!line->shows) return;
    if (strcmp(line->stage, progress->stage) != 0 || progress->done < line->done) {
        snprintf(line->stage, sizeof line->stage, "%s", progress->stage);
        snprintf(line->unit, sizeof line->unit, "%s", progress->unit);
        line->first = progress->done;
        line->start = sl_now();
        // What takes less than a tenth of a second needs no line.
        if (!line->visible) line->last_shown = line->start;
    }
    line->done = progress->done;
    line->total = progress->total;
    show(line);
}

void sl_progress_line_tick(sl_progress_line *line) {
    const bool running = line->shows && line->stage[0] && line->done != line->total;
    if (running && ++line->ticks % 64 == 0) show(line);
}
