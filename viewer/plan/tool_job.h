/// Work in the background for a tool of the Plan mode: of what is present now, done once, and done
/// anew when doors or walls change.
#ifndef VIEWER_TOOL_JOB_H
#define VIEWER_TOOL_JOB_H

#include "plan/view.h"

/// Zeroed to start.
typedef struct tool_job {
    sl_query *query; ///< a copy for the work; NULL: none yet
    task *task;      ///< NULL: none runs
    uint32_t version;
    bool made, stopped; ///< the work is done; it failed or was stopped, and is not tried again
} tool_job;

/// Stops the work and forgets that it was done. What it works on belongs to the caller again.
void tool_job_drop(sl_context *context, tool_job *job);
/// Whether what was made, or is in the making, is of other doors or walls than those of now.
bool tool_job_is_old(const view_state *view, const tool_job *job);
/// Starts the work where it is not done, and takes its end. Returns whether it has just ended well.
/// With `wait` it waits for that. `data` belongs to the work until then; a failure is reported.
bool tool_job_update(view_state *view, tool_job *job, bool wait,
                     sl_status (*work)(sl_context *context, void *data), void *data);
/// Stops the work; false if none runs.
bool tool_job_stop(sl_context *context, tool_job *job);
job_progress tool_job_progress(const tool_job *job);

#endif
