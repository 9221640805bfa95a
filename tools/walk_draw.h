/// Drawing walls as an engine would, to know what it costs: into a picture of one row of pixels,
/// with a depth buffer.
#ifndef WALK_DRAW_H
#define WALK_DRAW_H

#include "isovist_eyes.h"
#include "sightline/walk.h"

enum { SL_WALK_COLUMNS = 640 };

typedef struct sl_walk_canvas {
    const sl_hierarchy *hierarchy;
    uint64_t *drawn; ///< by wall, the frame in which it was drawn last
    uint64_t frame;
    float nearness[SL_WALK_COLUMNS]; ///< one over the depth; 0 for nothing
    uint32_t wall[SL_WALK_COLUMNS];
} sl_walk_canvas;

sl_status sl_walk_canvas_create(sl_context *context, const sl_hierarchy *hierarchy,
                                sl_walk_canvas **out);
void sl_walk_canvas_destroy(sl_context *context, sl_walk_canvas *canvas);

/// Draws the walls of a set of cells, each once; returns how many walls that were. A view of more
/// than 120 degrees is drawn in several parts side by side.
uint32_t sl_walk_draw(sl_walk_canvas *canvas, const sl_eye *eye, const uint64_t *cells);

#endif
