/// Pictures of a baked map, by one drawing code for files and for windows; and charts. In a library
/// of its own, sightline_draw, which needs cairo. The second part draws into a cairo context of
/// your own: plans, cells, regions, eyes, portals, text, charts. The pictures are made of it, and
/// so is the viewer.
///
///     sl_scene *scene;
///     sl_draw_options options = sl_draw_options_default();
///     sl_frame frame = sl_frame_fit(baked->space.bounds, 0, 0, 800, 600, 1);
///     sl_scene_create(context, baked, &options, NULL, &scene);
///     sl_draw_plan(context, cairo, scene, options.layers, &frame);
///     sl_scene_destroy(context, scene);
///
/// The functions that draw return nothing: cairo_status(cairo) keeps what cairo could not do. They
/// may change the context's source, line width, dash, cap, join, font and path.
#ifndef SIGHTLINE_DRAW_H
#define SIGHTLINE_DRAW_H

#include "sightline/bake.h"
#include "sightline/coverage.h"
#include "sightline/dual.h"
#include "sightline/explain.h"
#include "sightline/faults.h"
#include "sightline/region.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What is drawn, one over the other.
typedef enum sl_layer {
    SL_LAYER_CELLS = 1,   ///< cells in tones that tell neighbours apart, and their outlines
    SL_LAYER_PORTALS = 2, ///< portals
    SL_LAYER_WALLS = 4,   ///< walls, doors, mirrors and one-way glass. Walls that do not stop all
                          ///< are hollow, or dashed where the space does not have them
    SL_LAYER_PVS = 8,     ///< the cells that the chosen cell sees; with none chosen, each cell
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

/// A sheet of paper on which the plan stands to scale, with a title block: the title, a scale bar,
/// and north where it is known. It is a PDF or an SVG, in which letters stay text, and which has a
/// layer for each kind of thing. The map must say its unit (sl_map.unit). Zeroed: no sheet.
typedef struct sl_sheet {
    const char *paper; ///< "A4" to "A0", either way round as the plan fits; NULL: no sheet
    const char *scale; ///< "1:100"; NULL: the largest round scale that fits
    const char *note;  ///< a line under the title, UTF-8; NULL for none
    sl_point north;    ///< a direction in the map; zeroed: as sl_map.earth says, if it does
    double *drawn_at;  ///< set to N where the plan is drawn at 1:N; NULL: not asked for
} sl_sheet;

/// A colour without transparency.
typedef struct sl_colour {
    double red, green, blue; ///< sRGB, 0 to 1
} sl_colour;

/// A part of a plan that is drawn over it in one colour: an area below the walls, lines and places
/// above them. Each of these may be missing.
typedef struct sl_drawn_part {
    const char *name; ///< UTF-8, for the key; NULL: not in the key
    sl_colour colour;
    sl_shape area;
    double opacity; ///< of the area, 0 to 1
    const sl_segment *lines;
    size_t line_count;
    bool dashed;            ///< the lines
    const sl_point *places; ///< each a disc
    size_t place_count;
} sl_drawn_part;

/// A name on a plan, about a place.
typedef struct sl_plan_label {
    const char *text; ///< UTF-8
    sl_point at;
    double width; ///< in the map, that it should not exceed: it is set smaller, then cut
} sl_plan_label;

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
    const sl_drawn_part *parts; ///< for pictures of a whole plan, these five; over all but labels
    size_t part_count;
    const sl_plan_label *labels; ///< over all else
    size_t label_count;
    const char *words; ///< UTF-8, below the key; '\n' begins a new line; NULL for none
    /// For pictures of a whole plan, in place of the width. SL_BAD_ARGUMENT if the plan does not
    /// fit at the scale: the message has one that does.
    sl_sheet sheet;
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

/// Checks, before work whose result is to be drawn, that the plan alone fits the options' sheet of
/// paper (sl_sheet). With a long key it may still be too large. SL_BAD_ARGUMENT where it does not
/// fit: the message has a scale at which there is room for a usual key, too.
SL_API sl_status sl_draw_check_sheet(sl_context *context, const sl_baked *baked,
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

/// What is seen from a line or an area (set_sight.h).
typedef struct sl_drawn_set {
    const sl_point *points; ///< of the set
    size_t count;
    bool is_area;       ///< the points are corners of an area; else of a line
    sl_shape some, all; ///< what is seen from some of its points, and from all
} sl_drawn_set;

/// Draws the plan with both regions and the set, with a key. Options and caption as in
/// sl_draw_regions_file.
SL_API sl_status sl_draw_set_file(sl_context *context, const sl_baked *baked,
                                  const sl_drawn_set *set, const char *caption,
                                  const sl_draw_options *options, const char *path);

/// What several viewpoints see together (coverage.h).
typedef struct sl_drawn_coverage {
    const sl_space *pieces; ///< a mesh; `inside` marks what counts
    const uint32_t *counts; ///< by piece: how many viewpoints see it
    const sl_viewpoint *viewpoints;
    const char *const *names; ///< by viewpoint; NULL for its number, from 1
    const sl_shape *regions;  ///< by viewpoint: what it sees
    size_t count;             ///< of viewpoints
    const sl_point *blind;    ///< places of blind spots to number, from 1
    size_t blind_count;
    const sl_point *path; ///< a path over it; NULL for none
    size_t path_count;
    const sl_segment *unseen; ///< of the path
    size_t unseen_count;
} sl_drawn_coverage;

/// Draws the plan in the colours of how many viewpoints see each place: 0, 1, 2, 3 and more. Each
/// viewpoint has a colour of its own for its mark, its cone and the border of what it sees. Blind
/// spots are numbered. What of the path is not seen is thick. `caption` as above; '\n' begins a new
/// line.
SL_API sl_status sl_draw_coverage_file(sl_context *context, const sl_baked *baked,
                                       const sl_drawn_coverage *coverage, const char *caption,
                                       const sl_draw_options *options, const char *path);

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
    /// Squares that are no part of the scale, though something is there: they are grey. NULL for
    /// none. Their values are NaN.
    const bool *grey;
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

// --- documents

/// What a block of a document is.
typedef enum sl_document_block_kind {
    SL_BLOCK_TITLE,
    SL_BLOCK_HEADING, ///< in the outline of the file, too
    SL_BLOCK_TEXT,    ///< a paragraph; '\n' begins a new line
    SL_BLOCK_TABLE,
    SL_BLOCK_PICTURE,
} sl_document_block_kind;

/// A block of a document: what its kind has; the rest is zeroed. Texts are UTF-8.
typedef struct sl_document_block {
    sl_document_block_kind kind;
    const char *text; ///< of a picture: a line below it, NULL for none
    /// Of a table: cells row by row, the first row being its head. The last column breaks into
    /// lines as the page needs.
    const char *const *cells;
    size_t columns, rows;
    const sl_baked *baked; ///< of a picture
    /// Of a picture: one of them, drawn over the plan. All NULL: the plan with its starts.
    const sl_field *field;
    const sl_drawn_lines *lines;
    const sl_drawn_coverage *coverage;
    const sl_plan_label *labels; ///< of a picture, over all else
    size_t label_count;
} sl_document_block;

/// Writes blocks as a PDF of A4 pages, which have numbers. `title` stands at the foot of each, and
/// in the file's description. Letters stay text. The same input gives the same bytes.
/// SL_BAD_ARGUMENT if `path` does not end in .pdf, for a table without columns, and as the pictures
/// say; SL_IO or SL_NO_MEMORY otherwise; a failure leaves an older file as it was.
SL_API sl_status sl_draw_document_file(sl_context *context, const sl_document_block *blocks,
                                       size_t count, const char *title, const char *path);

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

// === Drawing into a cairo context of your own

/// As in cairo.h, so that this header needs none of cairo's.
typedef struct _cairo cairo_t; // NOLINT: the name is cairo's own

// --- from the map to the page

/// Where a map stands on a page: a frame, and what part of the map it shows. Page coordinates run
/// right and down from the page's upper left corner.
typedef struct sl_frame {
    sl_point corner;  ///< the map's point at the frame's lower left
    double scale;     ///< page units for one unit of the map, the same both ways
    double left, top; ///< the frame's place on the page
    double width, height;
    double unit; ///< the unit of line widths: 1 on a page 1200 wide
} sl_frame;

/// A frame that shows all of `bounds`, as large as the given place allows and in its middle.
/// Nothing is stretched.
SL_API sl_frame sl_frame_fit(sl_box bounds, double left, double top, double width, double height,
                             double unit);

/// The place of a point on the page. It is exact enough for maps far from the origin, and stays
/// finite.
SL_API sl_point sl_frame_point(const sl_frame *frame, sl_point point);

/// Whether a point's place is in the frame or close to it. `place` may be NULL.
SL_API bool sl_frame_holds(const sl_frame *frame, sl_point point, sl_point *place);

/// These add to the path, cut to the frame and its surroundings: cairo's numbers overflow far away.
SL_API void sl_path_segment(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b);
SL_API void sl_path_polygon(cairo_t *cairo, const sl_frame *frame, const sl_point *corners,
                            size_t count); ///< convex where it has to be cut

// --- colours

/// Neighbouring cells get different tones where that many suffice.
#define SL_TONES 4

/// The colours of a picture.
typedef struct sl_palette {
    sl_colour page, ground, hatch;   ///< paper, what is outside, the lines over it
    sl_colour solid;                 ///< solid ground
    sl_colour floor[SL_TONES];       ///< cells
    sl_colour seen[SL_TONES];        ///< cells that the chosen cell sees
    sl_colour source, source_edge;   ///< the chosen cell
    sl_colour doubtful;              ///< cells that only rounding shows or hides
    sl_colour wall, outline, portal; ///< lines
    sl_colour tree, start, path, door, glass, object;
    sl_colour mirrored;   ///< what is seen by mirror
    sl_colour ink, faint; ///< text
    bool dark;
} sl_palette;

/// The colours of pictures, dark on light or light on dark.
SL_API sl_palette sl_palette_make(bool dark);

/// The heat map's ramp, `value` from 0 to 1. Its lightness changes evenly and in one direction, so
/// that the order holds for every eye and in grey print.
SL_API sl_colour sl_palette_ramp(bool dark, double value);

/// The ramp of changes, `value` from 0 to 1: blue for losses, the page's grey at 0.5, red for
/// gains, equally strong (the ends of RdBu, Harrower and Brewer 2003).
SL_API sl_colour sl_palette_changes(bool dark, double value);

/// A colour between two, in sRGB: `share` 0 gives a, 1 gives b.
SL_API sl_colour sl_colour_mix(sl_colour a, sl_colour b, double share);

/// Makes a colour the context's source.
SL_API void sl_set_colour(cairo_t *cairo, sl_colour colour);

// --- text, UTF-8. Letters that the font lacks come from other fonts. A surface keeps the last
// texts that were set on it: draw on one surface in one thread alone.

/// Sets the font and its size. Letters are not fitted to pixels, so that pictures of any width and
/// kind are laid out alike.
SL_API void sl_text_font(cairo_t *cairo, double size, bool bold);

/// The width of a text in the font that is set, in page units.
SL_API double sl_text_width(cairo_t *cairo, const char *text);

/// Draws from the left end of the base line.
SL_API void sl_text_show(cairo_t *cairo, sl_colour colour, double x, double y, const char *text);

/// The same, no wider than `width`: the text is set smaller, down to two thirds of `size`, then
/// cut.
SL_API void sl_text_show_within(cairo_t *cairo, sl_colour colour, double x, double y, double width,
                                double size, bool bold, const char *text);

/// The number of lines that a text takes in the font that is set, where none is wider than `width`.
/// Lines break between words, and within a word that is wider; '\n' begins a new one.
SL_API unsigned sl_text_lines(cairo_t *cairo, double width, const char *text);

/// Draws a text in such lines, from the left end of the first base line; the next ones are
/// `spacing` apart. Returns their number.
SL_API unsigned sl_text_show_lines(cairo_t *cairo, sl_colour colour, double x, double y,
                                   double width, double spacing, const char *text);

/// The longest text of sl_text_count, its 0 included.
#define SL_COUNT_TEXT 64

/// A count with its thousands set apart, and what is counted: "1 204 cells", "1 cell".
SL_API void sl_text_count(uint64_t count, const char *unit, char text[SL_COUNT_TEXT]);

/// A share from 0 to 1 as a percentage: "23.4 %".
SL_API void sl_text_percent(double share, char text[SL_COUNT_TEXT]);

// --- the plan

/// What a plan shows, worked out once from a baked map: each cell's colour, the counts, the strokes
/// of the stab tree. One scene serves any number of frames.
typedef struct sl_scene sl_scene;

/// `baked` is referred to, not copied; options are as in sl_draw_file. `trees`: NULL for those of
/// `baked`, else stab trees in their place, read here only. SL_BAD_ARGUMENT for a chosen cell that
/// the map does not have or that is solid ground. `*out` is untouched on failure.
SL_API sl_status sl_scene_create(sl_context *context, const sl_baked *baked,
                                 const sl_draw_options *options, const sl_stab_trees *trees,
                                 sl_scene **out);
SL_API void sl_scene_destroy(sl_context *context, sl_scene *scene); ///< NULL: nothing

/// The portals in the longest sequence of the stab tree; 0 where the scene has none.
SL_API uint32_t sl_scene_tree_depth(const sl_scene *scene);

/// Draws layers (of sl_layer, or-ed; the legend has no place here) over what is there. SL_CANCELLED
/// between layers.
SL_API sl_status sl_draw_plan(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                              unsigned layers, const sl_frame *frame);

/// Draws the walls and the starts alone, as far as the scene's options ask for them: over what is
/// drawn on the cells.
SL_API sl_status sl_draw_walls(sl_context *context, cairo_t *cairo, const sl_scene *scene,
                               const sl_frame *frame);

/// Draws the stab tree alone, down to a depth, as it starts from a place in the chosen cell.
SL_API void sl_draw_tree(cairo_t *cairo, const sl_scene *scene, sl_point from, uint32_t depth,
                         const sl_frame *frame);

// --- what is seen

/// Outlines one cell, and fills it where `opacity` is not 0.
SL_API void sl_draw_cell(cairo_t *cairo, const sl_space *space, const sl_frame *frame,
                         uint32_t cell, sl_colour colour, double opacity, double width);

/// Draws a cone about a heading in degrees, `fov` degrees wide and `reach` long on the page; a
/// circle where it is all round.
SL_API void sl_draw_cone(cairo_t *cairo, const sl_frame *frame, sl_point eye, double heading,
                         double fov, double reach, sl_colour colour);

/// Draws an eye with its heading.
SL_API void sl_draw_eye_mark(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                             sl_point eye, double heading, double radius);

/// Draws the portals of a sequence: left ends as discs, right ends as squares. `last_stops` marks
/// the last one as that which no line passes.
SL_API void sl_draw_portal_ends(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                                const sl_portal_ends *portals, uint32_t count, bool last_stops);

/// Draws what keeps lines from portals: the ends of a conflict, large, and between those of either
/// side a segment or triangle. Portals that turn get an arrow each way that they are crossed. "L3"
/// is the left end of portal 3, counted from 1.
SL_API void sl_draw_conflict(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                             const sl_portal_ends *portals, const sl_conflict *conflict);

/// The colour of a class of coverage (coverage.h). Blind spots stand out; the others are one tone,
/// the deeper the more viewpoints.
SL_API sl_colour sl_coverage_colour(const sl_palette *palette, uint32_t kind);

/// Colours that tell viewpoints apart, for colour-blind eyes too.
SL_API sl_colour sl_viewpoint_colour(const sl_palette *palette, size_t viewpoint);

/// Fills the pieces in the colours of their classes. Several times as fast with
/// CAIRO_ANTIALIAS_NONE. SL_CANCELLED between classes.
SL_API sl_status sl_draw_coverage_areas(sl_context *context, cairo_t *cairo,
                                        const sl_palette *palette,
                                        const sl_drawn_coverage *coverage, const sl_frame *frame);

/// Draws the border of what each viewpoint sees.
SL_API void sl_draw_coverage_borders(cairo_t *cairo, const sl_palette *palette,
                                     const sl_drawn_coverage *coverage, const sl_frame *frame);

/// Draws viewpoints with their cones and names, and the numbers of blind spots. Marks that would
/// lie on others stand beside their places, joined with them by lines. Needs no pieces and no
/// regions. SL_NO_MEMORY.
SL_API sl_status sl_draw_coverage_marks(sl_context *context, cairo_t *cairo,
                                        const sl_palette *palette,
                                        const sl_drawn_coverage *coverage, const sl_frame *frame);

/// Draws a ring about a place of the map.
SL_API void sl_draw_ring(cairo_t *cairo, const sl_frame *frame, sl_point at, double radius,
                         sl_colour colour, double width);

/// Draws a straight line between two points of the map.
SL_API void sl_draw_line(cairo_t *cairo, const sl_frame *frame, sl_point a, sl_point b,
                         sl_colour colour, double width);

// --- the dual plane of a portal sequence

/// The part of the plane that is shown, and its place on the page. Slopes run right, heights up.
typedef struct sl_dual_frame {
    double left, top, width, height, unit;
    sl_dual_line low, high;
} sl_dual_frame;

/// Shows the polygon before its last portal, with some room around it: so one sees how the last
/// portal cuts. What contradicts itself is inside; a conflict of no ends says that nothing does.
SL_API sl_dual_frame sl_dual_frame_fit(const sl_dual *dual, const sl_dual *before,
                                       const sl_portal_ends *portals, const sl_conflict *conflict,
                                       double left, double top, double width, double height,
                                       double unit);

/// What is marked in a dual plane. Zeroed: nothing.
typedef struct sl_dual_marks {
    const sl_conflict *conflict; ///< its borders are thick, its place is framed; NULL for none
    const sl_stab_end *end;      ///< one border is thick, with its equation; NULL for none
    double text; ///< the size of numbers on the axes and of names at borders; 0 for none
} sl_dual_marks;

/// The place of a line on the page.
SL_API sl_point sl_dual_frame_point(const sl_dual_frame *frame, sl_dual_line line);

/// The line at a place of the page.
SL_API sl_dual_line sl_dual_frame_line(const sl_dual_frame *frame, sl_point page);

/// Draws the border of each end's half-plane, the polygon, the optimum with its margin, and the
/// chosen line. Teeth on the last borders point to the side that is forbidden. `marks`: NULL for
/// none.
SL_API void sl_draw_dual(cairo_t *cairo, const sl_palette *palette, const sl_dual_frame *frame,
                         const sl_dual *dual, const sl_portal_ends *portals, uint32_t count,
                         sl_dual_line chosen, const sl_dual_marks *marks);

// --- charts and files

/// Draws a chart into a box of the page (min at the upper left), with text of that size; the
/// chart's own width does not count. Labels that find no room lose their notes, then are left out.
/// Fails as sl_draw_chart_file does.
SL_API sl_status sl_draw_chart_onto(sl_context *context, cairo_t *cairo, const sl_chart *chart,
                                    sl_box box, double text);

/// Makes a picture file: .png, .svg or .pdf by the ending of its name. `draw` draws a page of
/// `width` x `height` pixels (PDF: points). `title` (NULL for none) goes into the file's
/// description where the kind has one. A failure leaves an older file as it was.
SL_API sl_status sl_draw_page_file(sl_context *context, const char *path, int width, int height,
                                   const char *title, void (*draw)(void *user, cairo_t *cairo),
                                   void *user);

#ifdef __cplusplus
}
#endif

#endif
