/// A piece of work in a thread of its own, with progress and cancel.
#ifndef VIEWER_TASK_H
#define VIEWER_TASK_H

#include "document.h"

typedef struct task task;

/// Starts `work` with a context of its own that knows all formats. `data` belongs to the task until
/// task_end.
sl_status task_start(sl_context *context, sl_status (*work)(sl_context *context, void *data),
                     void *data, task **out);

/// Whether the work is done: task_end then does not wait.
bool task_done(const task *t);

void task_cancel(task *t);

job_progress task_progress(const task *t);

/// Waits, frees the task, and gives the status of the work; its message goes to the context.
sl_status task_end(sl_context *context, task *t);

#endif
