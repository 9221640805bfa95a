/// A chart on its page: axes, places of labels, painting. chart.c and chart_labels.c lay it out,
/// chart_paint.c paints it.
#ifndef SL_DRAW_CHART_H
#define SL_DRAW_CHART_H

#include "draw/draw_plan.h"

// --- axes

/// An axis fitted to values, with the places of its ends on the page.
typedef struct sli_axis {
    const sl_chart_axis *what;
    double low, high; ///< its ends on the scale: powers of ten for logarithms
    double from, to;  ///< the same on the page
} sli_axis;

/// Fits values from `least` to `most`, which the scale must allow.
sli_axis sli_axis_fit(const sl_chart_axis *what, double least, double most);

/// The place of a value on the page.
double sli_axis_place(const sli_axis *axis, double value);

typedef struct sli_tick {
    double value;
    bool minor; ///< has no text
    char text[SL_COUNT_TEXT];
} sli_tick;

#define SLI_TICKS_MOST 128

/// Ticks in ascending order, all on the axis. Returns their number.
size_t sli_axis_ticks(const sli_axis *axis, sli_tick ticks[SLI_TICKS_MOST]);

// --- labels

/// A label: its size, its anchor, and the place that it got. In page coordinates.
typedef struct sli_label {
    sl_point anchor;
    double width, height;
    bool placed;   ///< false: there was no room
    sl_box box;    ///< where it stands
    sl_point knee; ///< where the line from its anchor meets it
    /// Used by the search. In place n of the array: the label whose turn is the n-th, and the same
    /// for the best order so far.
    size_t turn, best_turn;
} sli_label;

/// What labels and their lines must not touch.
typedef struct sli_obstacle {
    sl_box box;
    size_t owner;     ///< the label whose line may cross it; SIZE_MAX for none
    bool lines_cross; ///< any line may; so may one that starts within it
} sli_obstacle;

/// Room for labels: within `frame`, `gap` away from obstacles and other labels, and `clearance`
/// from their own anchors.
typedef struct sli_label_room {
    sl_box frame;
    const sli_obstacle *obstacles;
    size_t obstacle_count;
    double gap, clearance;
} sli_label_room;

/// Places each label as near to its anchor as possible, so that its line crosses no obstacle, label
/// or other line. Returns whether all found room.
bool sli_labels_place(sli_label *labels, size_t count, const sli_label_room *room);

// --- the page

/// A mark in its place.
typedef struct sli_spot {
    const sl_chart_mark *mark;
    const sl_chart_series *series;
    sl_point at;
} sli_spot;

typedef struct sli_chart_page {
    const sl_chart *chart;
    sl_palette palette;
    double width, height, margin;
    double text;  ///< size of the text
    sl_box frame; ///< what the axes enclose
    sli_axis x, y;
    sli_tick x_ticks[SLI_TICKS_MOST], y_ticks[SLI_TICKS_MOST];
    size_t x_tick_count, y_tick_count;
    sli_spot *spots; ///< all marks but those of frontiers; those with a label come first
    size_t spot_count;
    sli_label *labels; ///< of the first label_count spots
    size_t label_count;
    bool bare; ///< labels have no notes, as there is no room for them
    double key_top;
} sli_chart_page;

/// Sizes, in sizes of the text.
#define SLI_CHART_DISC        0.48
#define SLI_CHART_NUMBER      0.88 ///< numbers at the axes
#define SLI_CHART_LABEL       1.0
#define SLI_CHART_NOTE        0.86
#define SLI_CHART_LINE_HEIGHT 1.3 ///< of lines of a label, in their own size

/// The height of the heading. This and the next paint only if `paint` is set.
double sli_chart_heading(cairo_t *cairo, const sli_chart_page *page, bool paint);

/// The height of the key and the notes, from page->key_top down.
double sli_chart_key(cairo_t *cairo, const sli_chart_page *page, bool paint);

/// The room left of the frame for the numbers and the label of the y axis.
double sli_chart_gutter(cairo_t *cairo, const sli_chart_page *page);

/// The box of the words over or under 0, in the frame; without height if there are none.
sl_box sli_chart_words(cairo_t *cairo, const sli_chart_page *page, bool over);

/// Paints all.
void sli_chart_paint(cairo_t *cairo, const sli_chart_page *page);

#endif
