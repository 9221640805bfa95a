/// The console's hooks, and a clock.
#include "system/deadline.h"

#include "sightline/support.h"

static void show_progress(void *user, const sl_progress *progress) {
    const deadline *d = user;
    sl_progress shown = *progress;
    if (d->label) shown.stage = d->label;
    if (d->console->progress) d->console->progress(d->console->user, &shown);
}

static void show_note(void *user, const char *message) {
    const deadline *d = user;
    if (d->console->note) d->console->note(d->console->user, message);
}

static bool is_cancelled(void *user) {
    deadline *d = user;
    if (d->console->cancelled && d->console->cancelled(d->console->user)) return true;
    const bool late = sl_seconds() >= d->at || (d->asks && console_is_asked());
    if (late) d->late = true;
    return late;
}

sl_status deadline_open(command_console *console, deadline *limit, sl_context **out) {
    limit->console = sl_context_hooks(console->context);
    if (limit->asks) console_ask_first();
    const sl_hooks hooks = {
        .user = limit, .progress = show_progress, .note = show_note, .cancelled = is_cancelled};
    *out = sl_context_create(&hooks);
    return *out ? SL_OK : sl_fail_memory(console->context);
}
