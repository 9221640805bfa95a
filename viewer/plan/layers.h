/// The layers of the plan beside walls: one table. Keys, buttons, help, the panel, scripts and
/// settings use it.
#ifndef VIEWER_LAYERS_H
#define VIEWER_LAYERS_H

#include "document/document.h"
#include "sightline/draw.h"
#include "sightline/effects.h"
#include "sightline/region.h"
#include "ui/tones.h"
#include "ui/ui.h"

typedef struct app_state app_state;

#define IN_EXPLORE   1u ///< 1 << app_mode
#define IN_LEARN     2u
#define IN_DRAW      4u
#define IN_QUIZ      8u
#define IN_ALL_MODES 15u

/// A row: LAYER(NAME, name, key, label, help, modes, calls, draw).
///
/// `name` is for scripts, `label` and `key` are for the panel. `modes` are the modes that list and
/// draw the layer. `calls` are effects, as bits: the map must have one of them; 0: no condition.
/// `draw` runs below the walls in each frame, in the order of the table. It is NULL for layers that
/// do not change with the eye: they go into the kept picture (pane_plan.c).
#define LAYERS(LAYER)                                                                              \
    LAYER(CELLS, "cells", "C", "Cells", "cells", IN_ALL_MODES, 0, NULL)                            \
    LAYER(PORTALS, "portals", "P", "Portals", "portals", IN_ALL_MODES, 0, NULL)                    \
    LAYER(SPLITS, "splits", "K", "Splits of the tree", "splits by depth", IN_ALL_MODES, 0, NULL)   \
    LAYER(VIEWS, "views", "F5", "View cells by cost", "view cells that adapt, by cost",            \
          IN_EXPLORE | IN_DRAW, 0, NULL)                                                           \
    LAYER(HEAT, "heat", "1", "Heat map", "heat map of the visibility graph", IN_EXPLORE | IN_DRAW, \
          0, layer_heat)                                                                           \
    LAYER(PVS, "pvs", "V", "Visible set of the cell", "the visible set", IN_EXPLORE | IN_DRAW, 0,  \
          layer_pvs)                                                                               \
    LAYER(CULL, "cull", "M", "Cells kept", "cells kept by culling", IN_EXPLORE | IN_DRAW, 0,       \
          layer_cull)                                                                              \
    LAYER(REGION, "region", "R", "Visible region", "the visible region", IN_EXPLORE | IN_DRAW, 0,  \
          layer_region)                                                                            \
    LAYER(TREE, "tree", "B", "Stab tree of the cell", "the stab tree", IN_EXPLORE | IN_DRAW, 0,    \
          layer_tree)                                                                              \
    LAYER(NODES, "nodes", "Q", "Nodes without visible sets",                                       \
          "nodes, walking without visible sets", IN_EXPLORE | IN_DRAW, 0, layer_nodes)             \
    LAYER(STARTS, "starts", "J", "Starts, paths, objects", "starts, paths, objects", IN_ALL_MODES, \
          0, NULL)                                                                                 \
    LAYER(WATCH, "watch", "Y", "Who sees the eye", "through one-way glass: who sees the eye",      \
          IN_EXPLORE, SL_EFFECT_ONEWAY, layer_watch)                                               \
    LAYER(NUMBERS, "numbers", "0", "Numbers", "numbers of cells, and of portals with a p",         \
          IN_EXPLORE | IN_DRAW, 0, NULL)                                                           \
    LAYER(NAMES, "numbers_too", "0", "Numbers", "numbers, as sentences name cells",                \
          IN_LEARN | IN_QUIZ, 0, NULL)

#define LAYER_NUMBER(NAME, ...) LAYER_##NAME,
enum { LAYERS(LAYER_NUMBER) LAYER_COUNT };
#undef LAYER_NUMBER

/// Layers switched on, as bits: SHOW_CELLS ...
#define SHOW_BIT(NAME, ...) SHOW_##NAME = 1 << LAYER_##NAME,
enum show_bit { LAYERS(SHOW_BIT) SHOW_ALL = (1 << LAYER_COUNT) - 1 };
#undef SHOW_BIT

/// Layers that can fill the plan. One of them does; the others are lines.
#define SHOW_FILLS                                                                                 \
    (SHOW_VIEWS | SHOW_HEAT | SHOW_PVS | SHOW_CULL | SHOW_REGION | SHOW_NODES | SHOW_WATCH)

typedef struct layer_row {
    const char *name;
    unsigned modes, calls;
    /// `index` tells which of the plans side by side.
    void (*draw)(app_state *app, const sl_frame *frame, int index);
} layer_row;

/// LAYER_COUNT of them.
const layer_row *layer_table(void);

/// Whether a layer, by LAYER_..., belongs to the present mode and map. Splits belong to a kd-tree:
/// a mesh has none.
bool layers_lists(const app_state *app, unsigned layer);

/// Whether it is also switched on.
bool layers_shows(const app_state *app, unsigned layer);

/// Draws the layers that are shown.
void layers_draw(app_state *app, const sl_frame *frame, int index);

/// The layer that fills the plan: the one that was switched on last; LAYER_COUNT: none.
unsigned layers_fill(const app_state *app);
/// Has it fill the plan. Once it is switched off, the layer does that did before.
void layers_set_fill(app_state *app, unsigned layer);

/// Draws a set of cells without those of another (NULL: none): filled where its layer fills the
/// plan, else as a line round the set.
void layers_draw_set(app_state *app, const sl_frame *frame, const uint64_t *cells,
                     const uint64_t *without, tone which, bool fills);

/// Draws the portals of a set of cells once more (NULL: of all): a solid fill covers those below
/// it.
void layers_draw_portals(const app_state *app, cairo_t *cairo, const sl_frame *frame,
                         const uint64_t *cells, const uint64_t *without);

/// Fills one cell with a tone, and outlines it.
void layers_draw_cell(app_state *app, const sl_frame *frame, uint32_t cell, tone which);

/// Draws a region likewise. Arcs are drawn as arcs.
void layers_draw_region(app_state *app, const sl_frame *frame, const sl_region *region, tone which,
                        bool fills);

// --- the legend

/// A row of the legend: a tone as an area or as a line, or a line of its own.
typedef struct legend_row {
    const char *label;
    enum legend_mark {
        LEGEND_AREA,
        LEGEND_LINE,
        LEGEND_STROKE,
        LEGEND_DASHED,
        LEGEND_PLAIN,
        LEGEND_START, ///< from here on: the marks of things
        LEGEND_EYE,
        LEGEND_DOOR,
        LEGEND_MIRROR,
        LEGEND_ONEWAY,
        LEGEND_OBJECT,
        LEGEND_OUTSIDE,
    } mark;
    tone which;       ///< of an area or a line
    sl_colour colour; ///< of a stroke, or of an area in a plain colour
    char value[24];   ///< at the right; may be empty
} legend_row;

enum { LEGEND_MOST = 32 };

/// Writes what is shown now, and how. Returns the number of rows.
int layers_legend(const app_state *app, legend_row rows[LEGEND_MOST]);

/// A sample of a tone in a box, as it looks on a cell.
void layers_swatch(ui_state *ui, sl_box box, const legend_row *row);
/// The tone of a culling method, when another one or itself is chosen.
tone layers_method_tone(size_t method, size_t chosen);

/// A row with its sample; returns the lower edge.
double layers_legend_row(ui_state *ui, double left, double right, double y, const legend_row *row);

/// The key of a layer that is coloured by values: rows of words, and the ramp between its ends.
typedef struct legend_key {
    struct {
        char label[64], text[96];
    } rows[8];
    int count;
    bool ramp;
    char least[32], most[32];
} legend_key;

void legend_key_add(legend_key *key, const char *label, const char *text);

/// The number of a value's colour, and that colour.
enum { RAMP_STEPS = 32 };
int ramp_step(double value, double least, double most);
sl_colour ramp_colour(const ui_state *ui, int step);

/// Draws the keys of such layers in a column; returns the lower edge.
double layers_key_column(app_state *app, double left, double right, double y);

/// Draws the legend over the plan, where no panel has it; and the keys.
void layers_draw_keys(app_state *app, const sl_frame *frame, bool vector);

/// Clips to the cells inside: squares and view cells reach into walled-in space.
void layers_clip_inside(const document_state *document, cairo_t *cairo, const sl_frame *frame);

void layer_heat(app_state *app, const sl_frame *frame, int index);
void layer_pvs(app_state *app, const sl_frame *frame, int index);
void layer_cull(app_state *app, const sl_frame *frame, int index);
void layer_region(app_state *app, const sl_frame *frame, int index);
void layer_tree(app_state *app, const sl_frame *frame, int index);
void layer_nodes(app_state *app, const sl_frame *frame, int index);
int layer_nodes_legend(const app_state *app, legend_row *rows); ///< at most 6
/// What the walk did, in words; NULL where it is not shown.
const char *layer_nodes_words(const app_state *app, char text[96]);
void layer_watch(app_state *app, const sl_frame *frame, int index);
int layer_watch_legend(const app_state *app, legend_row *rows); ///< at most 4

typedef struct node_layer node_layer;

void node_layer_destroy(sl_context *context, node_layer *layer); ///< NULL: nothing

/// What the layer keeps from frame to frame.
typedef struct watch_layer watch_layer;

void watch_layer_destroy(sl_context *context, watch_layer *layer); ///< NULL: nothing

#endif
