/// Pictures of a baked map, by one drawing code for files and for windows; and charts. In a library
/// of its own, sightline_draw, which needs cairo.
#ifndef SIGHTLINE_DRAW_H
#define SIGHTLINE_DRAW_H

#include "sightline/bake.h"
#include "sightline/explain.h"
#include "sightline/faults.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What is drawn, one over the other.
typedef enum sl_layer {
    SL_LAYER_CELLS = 1,      ///< cells in tones that tell neighbours apart, and their outlines
    SL_LAYER_PORTALS = 2,    ///< portals
    SL_LAYER_WALLS = 4,      ///< walls, doors, mirrors and one-way glass
    SL_LAYER_PVS = 8,        ///< the cells that the chosen cell sees; with none chosen, each cell
                             ///< by the share of the area that it sees
    SL_LAYER_STAB_TREE = 16, ///< the chosen cell's stab tree, from portal to portal or mirror
    SL_LAYER_STARTS = 32,    ///< starts with their heading, paths, objects
    SL_LAYER_LEGEND = 64,    ///< what the picture shows, its colours and counts, a scale bar
    SL_LAYER_NUMBERS = 128,  ///< the numbers of cells, and of portals with a "p", where they have
                             ///< room
} sl_layer;

/// The narrowest picture, in pixels (PDF: points).
#define SL_DRAW_WIDTH_MIN 64
/// The widest picture, in pixels (PDF: points).
#define SL_DRAW_WIDTH_MAX 20000

/// A box that moves.
typedef struct sl_drawn_box {
    sl_box box;
    bool blocks, seen;
} sl_drawn_box;

/// Start from sl_draw_options_default().
typedef struct sl_draw_options {
    unsigned layers; ///< of sl_layer, or-ed; usually all but the stab tree and numbers
    uint32_t cell;   ///< the chosen cell; usually SL_NO_CELL, for none
    double width; ///< of the picture, pixels (PDF: points), SL_DRAW_WIDTH_MIN to ..._MAX; usually
                  ///< 1200. Lines and text grow with it; the height follows the map
    const char *title;         ///< UTF-8; NULL for none
    bool dark;                 ///< light lines on a dark page
    const sl_faults *faults;   ///< marked over all else; NULL for none
    const sl_drawn_box *boxes; ///< for sl_draw_eye
    size_t box_count;
} sl_draw_options;

/// The usual options, as told at each field.
SL_API sl_draw_options sl_draw_options_default(void);

/// Draws into a file: .png, .svg or .pdf by the ending of its name. The whole map is shown, as
/// large as fits and never stretched; the frame for it is between a sixth and 1.4 times as high as
/// wide, so that a thin map stands free in it. No portal joins the cells that count
/// (sl_baked_counts) with the others: those on the chosen cell's side are shown (those that count
/// where none is chosen) and the others hatched. Without starts, cells outside count; they are
/// shown and hatched. Solid ground is filled with one dark tone, in all pictures. Where there is no
/// visibility to show that layer is empty. The same input gives the same bytes. SL_BAD_ARGUMENT on
/// an unknown ending, options out of range or a chosen cell of solid ground, SL_IO or SL_NO_MEMORY
/// otherwise; a failure leaves an older file as it was.
SL_API sl_status sl_draw_file(sl_context *context, const sl_baked *baked,
                              const sl_draw_options *options, const char *path);

/// Draws an explanation, likewise: over the part of the map that it is about the two cells, the
/// portals that a sequence crosses with their left and right ends, and the line that passes them
/// or, of a hidden pair, what stops the first of the misses. The options' width, title and dark
/// count.
SL_API sl_status sl_draw_explanation(sl_context *context, const sl_baked *baked,
                                     const sl_explanation *explanation,
                                     const sl_draw_options *options, const char *path);

/// A polygon that is seen from an eye.
typedef struct sl_drawn_region {
    sl_point eye;
    const sl_point *points;
    size_t count;
    uint32_t depth; ///< the number of mirrors in which it is seen, where it lies in the map; 0: it
                    ///< is seen directly
} sl_drawn_region;

/// What several methods keep of one view, for a picture.
typedef struct sl_eye_layer {
    const char *name;      ///< of the method, for the key
    const uint64_t *cells; ///< bit c % 64 of word c / 64: cell c is kept
} sl_eye_layer;

/// The most layers that sl_draw_eye takes.
#define SL_EYE_LAYERS_MOST 16

/// Draws what an eye sees, likewise: the map, the eye and its cone, and each cell in the colour of
/// the last layer that still keeps it; layers go from loose to tight, each within the one before.
/// Over it `parts` of the visible region: first those seen directly, which are pale, then those
/// seen by mirror, in a colour of their own. The options' width, title and dark count.
/// SL_BAD_ARGUMENT on more layers than SL_EYE_LAYERS_MOST or a view that is not usable.
SL_API sl_status sl_draw_eye(sl_context *context, const sl_baked *baked, const sl_view *view,
                             const sl_eye_layer *layers, size_t layer_count,
                             const sl_drawn_region *parts, size_t part_count,
                             const sl_draw_options *options, const char *path);

// --- what is seen from places

/// Draws the plan with regions over it, what is seen by mirror in a colour of its own, the paler
/// the more mirrors, with a key. The options' width, title and dark count; `caption` is a
/// line below the picture, NULL for none.
SL_API sl_status sl_draw_regions_file(sl_context *context, const sl_baked *baked,
                                      const sl_drawn_region *regions, size_t count,
                                      const char *caption, const sl_draw_options *options,
                                      const char *path);

/// Values on a grid of squares, row after row from the lower left.
typedef struct sl_field {
    const char *name;     ///< what the values are: "area"
    sl_point corner;      ///< the lower left of the first square
    double step;          ///< side of a square
    size_t columns, rows; ///< at least 1
    const double *values; ///< NaN for none
    const char *unit;     ///< of the values: "m²"; NULL for none
    /// The ends of the colour scale, so that several pictures can be compared. Values beyond have
    /// the colours of the ends. Equal, as in a zeroed field: the least and the largest value.
    double least, most;
    /// Values are changes: one colour for gains and one for losses, pale at 0. The scale reaches as
    /// far on both sides of 0.
    bool diverging;
} sl_field;

/// Draws a heat map over the plan with its colour scale, likewise. SL_BAD_ARGUMENT also on a scale
/// whose ends descend, or that are beyond 1e300.
SL_API sl_status sl_draw_field_file(sl_context *context, const sl_baked *baked,
                                    const sl_field *field, const sl_draw_options *options,
                                    const char *path);

/// Polygons coloured by a value each, and lines over them.
typedef struct sl_patches {
    const char *name; ///< what the values are: "render cost"
    const sl_point *points;
    const uint32_t *first; ///< by polygon, and one more: points[first[i] .. first[i + 1])
    const double *values;
    uint32_t count;
    const sl_segment *lines;
    size_t line_count;
} sl_patches;

/// Draws patches under the plan's walls with their colour scale, likewise; `caption` as above.
SL_API sl_status sl_draw_patches_file(sl_context *context, const sl_baked *baked,
                                      const sl_patches *patches, const char *caption,
                                      const sl_draw_options *options, const char *path);

/// Lines coloured by a value each.
typedef struct sl_drawn_lines {
    const char *name; ///< what the values are: "integration"
    const sl_segment *lines;
    const double *values; ///< NaN: the line is thin and grey
    uint32_t count;
    bool alone; ///< without the plan under them
} sl_drawn_lines;

/// Draws lines over the plan with their colour scale, likewise; lines of high values lie on top.
SL_API sl_status sl_draw_lines_file(sl_context *context, const sl_baked *baked,
                                    const sl_drawn_lines *lines, const sl_draw_options *options,
                                    const char *path);

// --- charts

/// How values lie along an axis. Symmetric logarithm: linear between -1 and 1, powers of ten at
/// equal steps on either side.
typedef enum sl_chart_scale { SL_CHART_LINEAR, SL_CHART_LOG, SL_CHART_SYMLOG } sl_chart_scale;

/// An axis reaches as far as what is drawn, and a little farther. Texts here and below are UTF-8,
/// and NULL for none.
typedef struct sl_chart_axis {
    const char *label;
    sl_chart_scale scale;
    bool seconds;     ///< values are durations: "20 ms"
    const char *zero; ///< what 0 is called instead of "0"
    /// What it means to be over and under 0 (y axis only). With both, 0 stands in the middle with a
    /// line of its own, and numbers on either side have no sign.
    const char *over, *under;
} sl_chart_axis;

/// From low to high; nothing where they are equal.
typedef struct sl_chart_span {
    double low, high;
} sl_chart_span;

/// A point of a series. Only x and y are needed.
typedef struct sl_chart_mark {
    double x, y;
    sl_chart_span x_whisker, y_whisker; ///< thin lines through the mark
    sl_chart_span y_band;               ///< a broad pale bar at the mark's x
    const char *label; ///< beside it, apart from all others; in a list below where there is no room
    const char *note;  ///< a smaller line under the label, where there is room for it
} sl_chart_mark;

/// How a series is drawn.
typedef enum sl_chart_style {
    SL_CHART_MARKS, ///< a disc each
    SL_CHART_LINE,  ///< a line from mark to mark, in the order given
    /// A frontier: stairs through marks in ascending x, along x first. They start at the upper (or
    /// lower) edge over the first mark and go on to the right edge behind the last; what lies
    /// between them and 0 and left of them is shaded. Labels, whiskers and bands are not drawn.
    SL_CHART_FRONTIER_OVER,
    SL_CHART_FRONTIER_UNDER,
} sl_chart_style;

/// Colours that a series may have, from 0; told apart under every common colour blindness.
#define SL_CHART_COLOURS 6

/// Marks of one style and colour.
typedef struct sl_chart_series {
    const char *name; ///< in the key; series of one name should be of one style
    sl_chart_style style;
    unsigned colour; ///< below SL_CHART_COLOURS; not used for frontiers
    const sl_chart_mark *marks;
    size_t mark_count;
} sl_chart_series;

/// A chart. Zeroed but for its width, it is an empty frame.
typedef struct sl_chart {
    const char *title, *subtitle;
    const char *notes; ///< lines under the key
    const char *band;  ///< what the bands are, in the key
    sl_chart_axis x, y;
    const sl_chart_series *series;
    size_t series_count;
    double width; ///< as that of sl_draw_options; the height follows, so that all labels fit
    bool dark;
} sl_chart;

/// Draws into a file, as sl_draw_file does. SL_BAD_ARGUMENT on values that are not finite, beyond
/// 1e300, or not positive on a logarithmic axis.
SL_API sl_status sl_draw_chart_file(sl_context *context, const sl_chart *chart, const char *path);

#ifdef __cplusplus
}
#endif

#endif
