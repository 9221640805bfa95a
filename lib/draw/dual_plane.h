/// The dual plane of a portal sequence, drawn into a box of the page.
#ifndef SL_DRAW_DUAL_PLANE_H
#define SL_DRAW_DUAL_PLANE_H

#include "draw/canvas.h"
#include "draw/palette.h"
#include "sightline/dual.h"

/// What part of the plane is shown, and where on the page. Slopes run to the right, heights up.
typedef struct sl_dual_frame {
    double left, top, width, height, unit;
    sl_dual_line low, high;
} sl_dual_frame;

/// Shows the polygon that the sequence had before its last portal, with some room around it, so
/// that it is seen how the last one cuts.
sl_dual_frame sl_dual_frame_fit(const sl_dual *before, double left, double top, double width,
                                double height, double unit);

sl_dual_line sl_dual_frame_line(const sl_dual_frame *frame, sl_point page);

/// One line an end (its half-plane's border, with the side that is allowed shaded by all together),
/// the polygon, the optimum with its margin, and the chosen line.
void sl_draw_dual(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *frame,
                  const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                  sl_dual_line chosen);

#endif
