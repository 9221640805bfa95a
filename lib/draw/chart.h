/// A chart on its page: axes, places of labels, painting. chart.c and chart_labels.c lay it out,
/// chart_paint.c paints it.
#ifndef SL_DRAW_CHART_H
#define SL_DRAW_CHART_H

#include "draw/plan.h"

// --- axes

/// An axis fitted to values, with the places of its ends on the page.
typedef struct sl_axis {
    const sl_chart_axis *what;
    double low, high; ///< its ends on the scale: powers of ten for logarithms
    double from, to;  ///< the same on the page
} sl_axis;

/// Fits values from `least` to `most`, which the scale must allow.
sl_axis sl_axis_fit(const sl_chart_axis *what, double least, double most);

/// The place of a value on the page.
double sl_axis_place(const sl_axis *axis, double value);

typedef struct sl_tick {
    double value;
    bool minor; ///< has no text
    char text[SL_COUNT_TEXT];
} sl_tick;

#define SL_TICKS_MOST 128

/// Ticks in ascending order, all on the axis. Returns their number.
size_t sl_axis_ticks(const sl_axis *axis, sl_tick ticks[SL_TICKS_MOST]);

// --- labels

/// A label: its size, its anchor, and the place that it got. In page coordinates.
typedef struct sl_label {
    sl_point anchor;
    double width, height;
    bool placed;   ///< false: there was no room
    sl_box box;    ///< where it stands
    sl_point knee; ///< where the line from its anchor meets it
    /// Used by the search. In place n of the array: the label whose turn is the n-th, and the same
    /// for the best order so far.
    size_t turn, best_turn;
} sl_label;

/// What labels and their lines must not touch.
typedef struct sl_obstacle {
    sl_box box;
    size_t owner;     ///< the label whose line may cross it; SIZE_MAX for none
    bool lines_cross; ///< any line may; so may one that starts within it
} sl_obstacle;

/// Room for labels: within `frame`, `gap` away from obstacles and other labels, and `clearance`
/// from their own anchors.
typedef struct sl_label_room {
    sl_box frame;
    const sl_obstacle *obstacles;
    size_t obstacle_count;
    double gap, clearance;
} sl_label_room;

/// Places each label as near to its anchor as possible, so that its line crosses no obstacle, label
/// or other line. Returns whether all found room.
bool sl_labels_place(sl_label *labels, size_t count, const sl_label_room *room);

// --- the page

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

/// The height of the heading. This and the next paint only if `paint` is set.
double sl_chart_heading(cairo_t *cairo, const sl_chart_page *page, bool paint);

/// The height of the key and the notes, from page->key_top down.
double sl_chart_key(cairo_t *cairo, const sl_chart_page *page, bool paint);

/// The room left of the frame for the numbers and the label of the y axis.
double sl_chart_gutter(cairo_t *cairo, const sl_chart_page *page);

/// The box of the words over or under 0, in the frame; without height if there are none.
sl_box sl_chart_words(cairo_t *cairo, const sl_chart_page *page, bool over);

/// Paints all.
void sl_chart_paint(cairo_t *cairo, const sl_chart_page *page);

#endif
