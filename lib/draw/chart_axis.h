/// A chart's axis: where values stand, and which of them are written beside it.
#ifndef SL_DRAW_CHART_AXIS_H
#define SL_DRAW_CHART_AXIS_H

#include "draw/text.h"
#include "sightline/draw.h"

/// An axis fitted to values, and where its ends stand on the page.
typedef struct sl_axis {
    const sl_chart_axis *what;
    double low, high; ///< its ends on the scale: powers of ten for logarithms
    double from, to;  ///< the same on the page
} sl_axis;

/// Fits values from `least` to `most`, which the scale must allow.
sl_axis sl_axis_fit(const sl_chart_axis *what, double least, double most);

/// On the page.
double sl_axis_place(const sl_axis *axis, double value);

typedef struct sl_tick {
    double value;
    bool minor; ///< has no text
    char text[SL_COUNT_TEXT];
} sl_tick;

#define SL_TICKS_MOST 128

/// Ascending, all on the axis.
size_t sl_axis_ticks(const sl_axis *axis, sl_tick ticks[SL_TICKS_MOST]);

#endif
