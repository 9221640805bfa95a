/// The heat map: a measure of the visibility graph, by colour, over a grid of points. A task makes
/// the graph in the background. Steps are counted from the pointer, live.
#ifndef VIEWER_HEAT_H
#define VIEWER_HEAT_H

#include "document/document.h"
#include "plan/heat_graph.h"
#include "sightline/draw.h"

typedef struct app_state app_state;
typedef struct heat_layer heat_layer;
typedef struct legend_key legend_key;

/// What is chosen of it. Zeroed: the first measure, on a grid of the usual step.
typedef struct heat_choice {
    size_t measure, before; ///< by heat_measure(); the one before steps were chosen
    double step;            ///< 0: the usual one
    bool held;              ///< the colour scale stays as it is
    double least, most;     ///< its ends then
    uint32_t stamp;         ///< grows with every change of what is drawn
} heat_choice;

/// Starts the work for the open document where the layer needs it, and takes over its results.
/// Waits for the work if `wait` is set.
void heat_layer_update(app_state *app, bool wait);
/// Follows the pointer, once the place of the plan is known.
void heat_layer_follow(app_state *app);
/// Stops the work; false if none runs.
bool heat_layer_stop(app_state *app);
void heat_layer_destroy(sl_context *context, heat_layer *layer); ///< NULL: nothing

/// NULL: nothing runs.
job_progress heat_layer_progress(const heat_layer *layer);

/// The values that are shown, by point, and their graph; NULL: none are.
const double *heat_layer_values(const app_state *app, const heat_graph **graph);
/// The ends of the colour scale. Only where values are shown.
void heat_layer_scale(const app_state *app, double *least, double *most);

/// Draws the squares, where the layer fills the plan.
void heat_layer_draw(const app_state *app, cairo_t *cairo, const sl_frame *frame);
/// The key: measure, value under the pointer, grid, colours. False where nothing is shown.
bool heat_layer_key(const app_state *app, legend_key *key);

// --- choices

/// The name of the chosen measure in words.
void heat_say_measure(const app_state *app, char text[64]);
void heat_choose(app_state *app, int by); ///< the next measure, or one before
void heat_toggle_steps(app_state *app);   ///< steps from the pointer, or the measure before
void heat_toggle_held(app_state *app);    ///< keeps the colour scale, or lets it follow the values
/// The place of the grid's step among those that can be chosen, from 0 (coarse) to *last.
int heat_step_place(const app_state *app, int *last);
void heat_set_step(app_state *app, int place);
double heat_step(const app_state *app);

#endif
