/// The plan itself: the layers of a scene, drawn onto whatever cairo draws on, through any frame.
/// Files and windows share it.
#ifndef SL_DRAW_PLAN_H
#define SL_DRAW_PLAN_H

#include "draw/canvas.h"
#include "draw/scene.h"

/// Draws the layers that the scene's options ask for (all but the legend), over what is there.
/// What cairo could not do stays in cairo_status(cairo). SL_CANCELLED between layers.
sl_status sl_draw_onto(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                       const sl_frame *frame);

/// Of these layers the walls and the starts alone, over what is drawn on the cells.
sl_status sl_draw_walls_onto(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                             const sl_frame *frame);

/// Of these layers the stab tree alone.
void sl_draw_tree_onto(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame);

#endif
