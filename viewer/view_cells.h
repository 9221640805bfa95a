/// View cells that adapt to what is seen: the work in the background, from a map to the merge
/// history, and the layer that shows a cut of it, coloured by cost.
#ifndef VIEWER_VIEW_CELLS_H
#define VIEWER_VIEW_CELLS_H

#include "document.h"
#include "sightline/canvas.h"
#include "sightline/view_cells.h"

// --- the job

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

// --- the layer

typedef struct app_state app_state;
typedef struct view_layer view_layer;

/// Begins the work for the document that is open where it is wanted, and takes over what it has
/// done; waits for it where `wait` is set.
void view_layer_update(app_state *app, bool wait);
/// Stops the work; false where there is none.
bool view_layer_stop(app_state *app);
void view_layer_destroy(sl_context *context, view_layer *layer); ///< NULL: nothing

/// NULL: nothing runs.
job_progress view_layer_progress(const view_layer *layer);

/// How many view cells are shown, and how many elementary ones there are: 0 while they are not
/// there. NULL: 0.
uint32_t view_layer_shown(const view_layer *layer);
uint32_t view_layer_most(const view_layer *layer);

/// Walks through the merge history to so many view cells, as many as there are at most.
void view_layer_go(app_state *app, uint32_t cells);

/// Draws the view cells that are shown: the same for the same document, number, mark and theme.
void view_layer_draw(const app_state *app, cairo_t *cairo, const sl_frame *frame);
/// Their key: count, cost, memory, colours.
void view_layer_draw_key(app_state *app, const sl_frame *frame);

/// The view cell that is marked, of the cut; SL_NO_VIEW_CELL: none.
uint32_t view_layer_marked(const view_layer *layer);
/// Marks the view cell of the largest cost; from there on the next one, by cost.
void view_layer_mark_next(app_state *app);

#endif
