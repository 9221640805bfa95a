/// What an eye sees, drawn by the number of mirrors in which it sees it.
#ifndef SL_DRAW_SEEN_H
#define SL_DRAW_SEEN_H

#include "draw/canvas.h"
#include "draw/palette.h"
#include "sightline/draw.h"

/// A polygon: blue where it is seen directly, else in the colour of what is seen by mirror, the
/// paler the more mirrors.
void sl_draw_seen(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                  const sl_drawn_region *region);

/// What those colours say, from a place on the page on, in lines as the width allows. Returns the
/// height: 0, and nothing is drawn, where nothing is seen by mirror. Without `paint` nothing is
/// drawn.
double sl_draw_seen_key(cairo_t *cairo, const sl_palette *palette, const sl_drawn_region *regions,
                        size_t count, sl_point at, double width, double size, bool paint);

#endif
