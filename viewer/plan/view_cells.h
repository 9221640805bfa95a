/// The layer of view cells that adapt to what is seen: a cut of the merge history of the map, which
/// is made in the background, coloured by cost.
#ifndef VIEWER_VIEW_CELLS_H
#define VIEWER_VIEW_CELLS_H

#include "document/document.h"
#include "sightline/draw.h"
#include "sightline/view_cells.h"

typedef struct app_state app_state;
typedef struct view_layer view_layer;
typedef struct legend_key legend_key;

/// Starts the job for the open document where the layer needs it, and takes over its result. Waits
/// for it if `wait` is set.
void view_layer_update(app_state *app, bool wait);
/// Stops the job; false if none runs.
bool view_layer_stop(app_state *app);
void view_layer_destroy(sl_context *context, view_layer *layer); ///< NULL: nothing

/// NULL: nothing runs.
job_progress view_layer_progress(const view_layer *layer);

/// How many view cells are shown, and how many elementary ones there are; 0 before they exist, and
/// for NULL.
uint32_t view_layer_shown(const view_layer *layer);
uint32_t view_layer_most(const view_layer *layer);

/// Goes through the merge history to this number of view cells, or to the largest one there is.
void view_layer_go(app_state *app, uint32_t cells);

/// Draws the view cells. The picture depends on the document, the number, the mark and the theme
/// alone.
void view_layer_draw(const app_state *app, cairo_t *cairo, const sl_frame *frame);
/// Their key: count, cost, memory, colours. False where none are shown.
bool view_layer_key(const app_state *app, legend_key *key);

/// The marked view cell of the cut; SL_NO_VIEW_CELL: none.
uint32_t view_layer_marked(const view_layer *layer);
/// Marks the view cell with the largest cost, then the next one by cost.
void view_layer_mark_next(app_state *app);

#endif
