/// A context for work that ends at a time limit, or keeps what it has at Ctrl-C.
#ifndef DEADLINE_H
#define DEADLINE_H

#include "system/console.h"

typedef struct deadline {
    const sl_hooks *console; ///< the console's hooks
    const char *label;       ///< leads the progress line; NULL: the stage of each report
    double at;               ///< by sl_seconds(); INFINITY for none
    bool asks;               ///< the first Ctrl-C ends the work, too
    bool late;               ///< that, or the time, is what stopped it
} deadline;

/// A context with the console's hooks, which is cancelled at the deadline, too. `limit` must
/// outlive it. The caller destroys it (sl_context_destroy).
sl_status deadline_open(command_console *console, deadline *limit, sl_context **out);

#endif
