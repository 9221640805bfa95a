/// View cells in the background: from a map to the merge history, in a thread of its own. It shares
/// nothing with the document, which may change meanwhile.
#ifndef VIEWER_VIEW_JOB_H
#define VIEWER_VIEW_JOB_H

#include "document.h"
#include "sightline/view_cells.h"

/// What the work comes to. Zeroed: nothing yet.
typedef struct view_history {
    sl_view_tree tree;
    sl_view_hierarchy hierarchy; ///< told by other lines than those that it was made by
} view_history;

void view_history_destroy(sl_context *context, view_history *history); ///< and zeroes it

typedef struct view_job view_job;

/// Starts the thread, on a copy of the map: as many lines and elementary view cells as
/// `sightline viewcells` takes unless told.
sl_status view_job_start(sl_context *context, const sl_map *map, view_job **out);
void view_job_cancel(view_job *job);
bool view_job_is_done(const view_job *job);
job_progress view_job_progress(const view_job *job);

/// Waits for the thread and frees the job. `*out` is the caller's from then on, and untouched where
/// the work failed, of which status and message tell.
sl_status view_job_end(sl_context *context, view_job *job, view_history *out);

#endif
