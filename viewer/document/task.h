/// A piece of work in a thread of its own, with progress and cancel.
#ifndef VIEWER_TASK_H
#define VIEWER_TASK_H

#include "sightline/context.h"

#include <stdbool.h>

typedef struct task task;

/// The progress of the work in the background.
typedef struct job_progress {
    bool running;
    const char *stage;
    double share;         ///< 0 to 1; negative where it is not known
    uint64_t done, total; ///< as the library reports them
} job_progress;

/// What else the thread calls, with the data of the work. Each may be NULL.
typedef struct task_hooks {
    void (*note)(void *data, const char *message); ///< what the library says
    bool (*over)(void *data);                      ///< true: cancels the work
} task_hooks;

/// Starts `work` with a context of its own that knows all formats. `data` belongs to the task until
/// task_end. `stage` is that of the progress at first. `hooks` may be NULL.
sl_status task_start(sl_context *context, sl_status (*work)(sl_context *context, void *data),
                     void *data, const char *stage, const task_hooks *hooks, task **out);

/// Whether the work is done: task_end then does not wait.
bool task_done(const task *t);

void task_cancel(task *t);

job_progress task_progress(const task *t);

/// Waits, frees the task, and gives the status of the work; its message goes to the context.
sl_status task_end(sl_context *context, task *t);

/// Cancels the task, waits, and frees it. NULL: nothing.
void task_drop(sl_context *context, task *t);

#endif
