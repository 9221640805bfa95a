/// A chart laid out on its page: made by chart.c, drawn by chart_paint.c.
#ifndef SL_DRAW_CHART_PAGE_H
#define SL_DRAW_CHART_PAGE_H

#include "draw/chart_axis.h"
#include "draw/chart_labels.h"
#include "draw/palette.h"

/// A mark in its place.
typedef struct sl_spot {
    const sl_chart_mark *mark;
    const sl_chart_series *series;
    sl_point at;
} sl_spot;

typedef struct sl_chart_page {
    const sl_chart *chart;
    sl_palette palette;
    double width, height, margin;
    double text;  ///< size of the text
    sl_box frame; ///< what the axes enclose
    sl_axis x, y;
    sl_tick x_ticks[SL_TICKS_MOST], y_ticks[SL_TICKS_MOST];
    size_t x_tick_count, y_tick_count;
    sl_spot *spots; ///< all marks but those of frontiers; those with a label come first
    size_t spot_count;
    sl_label *labels; ///< of the first label_count spots
    size_t label_count;
    bool bare; ///< labels have no notes, as there is no room for them
    double key_top;
} sl_chart_page;

/// Sizes, in sizes of the text.
#define SL_CHART_DISC        0.48
#define SL_CHART_NUMBER      0.88 ///< numbers at the axes
#define SL_CHART_LABEL       1.0
#define SL_CHART_NOTE        0.86
#define SL_CHART_LINE_HEIGHT 1.3 ///< of lines of a label, in their own size

/// The heading's height. Each paints only where `paint` is set.
double sl_chart_heading(cairo_t *cairo, const sl_chart_page *page, bool paint);

/// The key and the notes from page->key_top down. Returns their height.
double sl_chart_key(cairo_t *cairo, const sl_chart_page *page, bool paint);

/// How far the frame stands from the left margin, for the numbers and the label of the y axis.
double sl_chart_gutter(cairo_t *cairo, const sl_chart_page *page);

/// The box of the words over or under 0, in the frame; without height where there are none.
sl_box sl_chart_words(cairo_t *cairo, const sl_chart_page *page, bool over);

/// Everything.
void sl_chart_paint(cairo_t *cairo, const sl_chart_page *page);

#endif
