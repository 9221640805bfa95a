/// A chart within a page that holds other things too.
#ifndef SL_DRAW_CHART_H
#define SL_DRAW_CHART_H

#include "sightline/draw.h"

#include <cairo.h>

/// Draws into a box of the page (min at the upper left), in text of that size; the chart's own
/// width does not count. The frame is what heading, axes and key leave of the box; labels that find
/// no room in it lose their notes, then are left out. Fails as sl_draw_chart_file does.
sl_status sl_draw_chart_onto(sl_context *context, cairo_t *cairo, const sl_chart *chart, sl_box box,
                             double text);

#endif
