/// The heat map: a measure of the visibility graph, by colour, over a grid of points. A task makes
/// the graph in the background. Steps are counted from the pointer, live.
#ifndef VIEWER_HEAT_H
#define VIEWER_HEAT_H

#include "plan/heat_graph.h"
#include "plan/layers.h"

/// Starts the work for the open document where the layer needs it, and takes over its results.
/// Waits for the work if `wait` is set.
void heat_layer_update(view_state *view, bool wait);
/// Follows the pointer, once the place of the plan is known.
void heat_layer_follow(view_state *view);
/// Stops the work; false if none runs.
bool heat_layer_stop(view_state *view);
void heat_layer_destroy(sl_context *context, heat_layer *layer); ///< NULL: nothing

/// NULL: nothing runs.
job_progress heat_layer_progress(const heat_layer *layer);

/// The values that are shown, by point, and their graph; NULL: none are.
const double *heat_layer_values(const view_state *view, const heat_graph **graph);
/// The part of the graph that a point is in, from 1, the largest first, as in the column `part` of
/// the command; 0: there is one part alone.
uint32_t heat_layer_part(const view_state *view, uint32_t point);
/// Whether they are changes: those of another plan less those of this one.
bool heat_layer_changes(const view_state *view);
/// The ends of the colour scale. Only where values are shown.
void heat_layer_scale(const view_state *view, double *least, double *most);

/// Draws the squares, where the layer fills the plan.
void heat_layer_draw(const view_state *view, cairo_t *cairo, const sl_frame *frame);
/// Draws lines between levels, where another layer does.
void layer_heat(view_state *view, const sl_frame *frame, int index);
/// The key: measure, value under the pointer, grid, colours. False where nothing is shown.
bool heat_layer_key(const view_state *view, legend_key *key);

// --- choices

/// The name of the chosen measure in words.
void heat_say_measure(const view_state *view, char text[64]);
void heat_choose(view_state *view, int by); ///< the next measure, or one before
void heat_toggle_steps(view_state *view);   ///< steps from the pointer, or the measure before
void heat_toggle_ranks(view_state *view);   ///< colours by rank, or by value
void heat_toggle_held(view_state *view); ///< keeps the colour scale, or lets it follow the values
/// The place of the grid's step among those that can be chosen, from 0 (coarse) to *last.
int heat_step_place(const view_state *view, int *last);
void heat_set_step(view_state *view, int place);
/// To the next place, finer (1) or coarser (-1): from a typed step to the one beside it.
void heat_turn_step(view_state *view, int by);
/// Sets any step that gives a grid of a size that is computed; false for others.
bool heat_type_step(view_state *view, double step);
double heat_step(const view_state *view);

#endif
