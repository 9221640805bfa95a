/// Boxes that move, drawn over what an eye sees.
#ifndef SL_DRAW_BOXES_H
#define SL_DRAW_BOXES_H

#include "draw/canvas.h"
#include "draw/palette.h"
#include "sightline/draw.h"

/// Those that block are full, those that are hidden dashed.
void sl_draw_boxes(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                   const sl_drawn_box *boxes, size_t count);

/// What is seen past them, lighter than the rest.
void sl_draw_lit(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                 const sl_drawn_region *region);

/// What these marks say, from a place on the page on, in one line. Returns the height, 0 where
/// there are no boxes. Without `paint` nothing is drawn.
double sl_draw_boxes_key(cairo_t *cairo, const sl_palette *palette, size_t count, sl_point at,
                         double size, bool paint);

#endif
