/// The layer of view cells that adapt to what is seen: a cut of the merge history of the map, which
/// is made in the background, coloured by cost.
#ifndef VIEWER_VIEW_CELLS_H
#define VIEWER_VIEW_CELLS_H

#include "plan/layers.h"
#include "sightline/view_cells.h"

/// Starts the job for the open document where the layer needs it, and takes over its result. Waits
/// for it if `wait` is set.
void view_layer_update(view_state *view, bool wait);
/// Stops the job; false if none runs.
bool view_layer_stop(view_state *view);
void view_layer_destroy(sl_context *context, view_layer *layer); ///< NULL: nothing

/// NULL: nothing runs.
job_progress view_layer_progress(const view_layer *layer);

/// How many view cells are shown, and how many elementary ones there are; 0 before they exist, and
/// for NULL.
uint32_t view_layer_shown(const view_layer *layer);
uint32_t view_layer_most(const view_layer *layer);

/// Goes through the merge history to this number of view cells, or to the largest one there is.
void view_layer_go(view_state *view, uint32_t cells);

/// Draws the view cells. The picture depends on the document, the number, the mark and the theme
/// alone.
void view_layer_draw(const view_state *view, cairo_t *cairo, const sl_frame *frame);
/// Their key: count, cost, memory, colours. False where none are shown.
bool view_layer_key(const view_state *view, legend_key *key);

/// The marked view cell of the cut; SL_NO_VIEW_CELL: none.
uint32_t view_layer_marked(const view_layer *layer);
/// Marks the view cell with the largest cost, then the next one by cost.
void view_layer_mark_next(view_state *view);

#endif
