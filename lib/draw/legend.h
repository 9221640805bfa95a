/// Around the plan: the heading over it, and below it what the marks mean, the counts, the scale.
#ifndef SL_DRAW_LEGEND_H
#define SL_DRAW_LEGEND_H

#include "draw/canvas.h"
#include "draw/marks.h"
#include "draw/scene.h"

/// The page's strip for a heading or a legend.
typedef struct sl_strip {
    double left, top, width;
    double text; ///< size of the text
    bool paint;  ///< false only measures
} sl_strip;

/// The title, and under it what the picture shows and how that was found. Returns its height.
double sl_draw_heading(cairo_t *cairo, const sl_scene *scene, const sl_strip *strip);

/// A key for all that is drawn, in lines as the width allows, and a scale bar at the right. Returns
/// its height, which does not depend on the frame or the pens.
double sl_draw_legend(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame,
                      const sl_pens *pens, const sl_strip *strip);

#endif
