#include "console.h"

#include "built.h"
#include "sightline/support.h"

#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// Set by SIGINT or SIGTERM. At file scope because a signal handler is given nothing but
/// the signal's number; lock-free and atomic because worker threads read it.
static atomic_bool interrupted;

/// As it: whether the first signal is to ask only, and whether it did.
static atomic_bool asks_first, asked;

static void set_handler(int number, void (*handler)(int)) {
    struct sigaction action = {.sa_handler = handler};
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

/// The first signal makes the running call stop and tidy up; the next one ends the program. Where
/// the first one is to ask only, it is the second and the third that do.
static void on_signal(int number) {
    (void)number;
    if (atomic_load(&asks_first) && !atomic_exchange(&asked, true)) return;
    atomic_store(&interrupted, true);
    set_handler(SIGINT, SIG_DFL);
    set_handler(SIGTERM, SIG_DFL);
}

/// A signal that whoever started the program has it ignore (nohup) stays ignored.
static void catch_signal(int number) {
    struct sigaction now;
    if (sigaction(number, NULL, &now) == 0 && now.sa_handler != SIG_IGN)
        set_handler(number, on_signal);
}

/// Where a standard stream is closed, the next file opened would take its number and be written to
/// as if it were stdout. A descriptor open the wrong way round holds the place and fails instead.
static void hold_standard_streams(void) {
    for (int descriptor = 0; descriptor <= 2; descriptor++)
        if (fcntl(descriptor, F_GETFD) == -1)
            (void)!open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY);
}

void sl_console_ask_first(void) {
    atomic_store(&asks_first, true);
}

bool sl_console_is_asked(void) {
    return atomic_load(&asked);
}

void sl_console_print_line(FILE *stream, const char *before, const char *text, size_t length) {
    fputs(before, stream);
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)text[i];
        const unsigned char next = i + 1 < length ? (unsigned char)text[i + 1] : 0;
        // Those of Latin-1 are two bytes in UTF-8.
        const bool second = c == 0xc2 && next >= 0x80 && next < 0xa0;
        putc(c < 0x20 || c == 0x7f || second ? '?' : c, stream);
        i += second;
    }
    putc('\n', stream);
}

static void show_note(void *user, const char *message) {
    sl_console *console = user;
    if (console->quiet) return;
    sl_progress_line_clear(&console->line);
    sl_console_print_line(stderr, "note: ", message, strlen(message));
}

static void show_progress(void *user, const sl_progress *progress) {
    sl_console *console = user;
    if (!console->quiet) sl_progress_line_report(&console->line, progress);
}

/// Asked far more often than progress is reported, so that the line lives through long units of
/// work.
static bool is_cancelled(void *user) {
    sl_console *console = user;
    if (pthread_equal(pthread_self(), console->main_thread)) sl_progress_line_tick(&console->line);
    return atomic_load(&interrupted);
}

bool sl_console_open(sl_console *console) {
    hold_standard_streams();
    // A reader that goes away and a file that grows beyond its limit are then failed writes.
    set_handler(SIGPIPE, SIG_IGN);
    set_handler(SIGXFSZ, SIG_IGN);
    catch_signal(SIGINT);
    catch_signal(SIGTERM);
    const char *kind = getenv("TERM");
    *console = (sl_console){
        .main_thread = pthread_self(),
        .line.shows = isatty(STDERR_FILENO) && !(kind && strcmp(kind, "dumb") == 0),
    };
    const sl_hooks hooks = {
        .user = console, .progress = show_progress, .note = show_note, .cancelled = is_cancelled};
    console->context = sl_context_create(&hooks);
    const bool good = console->context && sl_built_use_formats(console->context) == SL_OK;
    if (!good) fputs("sightline: out of memory\n", stderr);
    return good;
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

int sl_console_close(sl_console *console, sl_status status) {
    sl_progress_line_clear(&console->line);
    if (status == SL_OK) {
        sl_output output;
        status = sl_output_open(console->context, "-", &output);
        if (status == SL_OK) status = sl_output_commit(console->context, &output);
    }
    // A system call that the signal broke off is reported as what it is.
    if (status == SL_IO && atomic_load(&interrupted))
        status = sl_fail(console->context, SL_CANCELLED, "%s", sl_status_name(SL_CANCELLED));
    const char *message = sl_context_message(console->context);
    if (status != SL_OK && message[0])
        sl_console_print_line(stderr, "sightline: ", message, strlen(message));
    sl_context_destroy(console->context);
    return exit_status(status);
}
