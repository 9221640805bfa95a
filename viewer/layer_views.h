/// The layer of view cells: the cut of the merge history that is shown, coloured by cost. The
/// history is made in the background once the layer is on.
#ifndef VIEWER_LAYER_VIEWS_H
#define VIEWER_LAYER_VIEWS_H

#include "document.h"
#include "sightline/canvas.h"

typedef struct sl_app sl_app;
typedef struct sl_view_layer sl_view_layer;

/// Begins the work for the document that is open where it is wanted, and takes over what it has
/// done; waits for it where `wait` is set.
void sl_view_layer_update(sl_app *app, bool wait);
/// Stops the work; false where there is none.
bool sl_view_layer_stop(sl_app *app);
void sl_view_layer_destroy(sl_context *context, sl_view_layer *layer); ///< NULL: nothing

/// NULL: nothing runs.
sl_document_progress sl_view_layer_progress(const sl_view_layer *layer);

/// How many view cells are shown, and how many elementary ones there are: 0 while they are not
/// there. NULL: 0.
uint32_t sl_view_layer_shown(const sl_view_layer *layer);
uint32_t sl_view_layer_most(const sl_view_layer *layer);

/// Walks through the merge history to so many view cells, as many as there are at most.
void sl_view_layer_go(sl_app *app, uint32_t cells);

/// Draws the view cells that are shown: the same for the same document, number, mark and theme.
void sl_view_layer_draw(const sl_app *app, cairo_t *cairo, const sl_frame *frame);
/// Their key: count, cost, memory, colours.
void sl_view_layer_draw_key(sl_app *app, const sl_frame *frame);

/// The view cell that is marked, of the cut; SL_NO_VIEW_CELL: none.
uint32_t sl_view_layer_marked(const sl_view_layer *layer);
/// Marks the view cell of the largest cost; from there on the next one, by cost.
void sl_view_layer_mark_next(sl_app *app);

#endif
