/// What the plan shows beside walls: one table, from which keys, buttons, help, the panel, scripts
/// and settings have their layers.
#ifndef VIEWER_LAYERS_H
#define VIEWER_LAYERS_H

#include "sightline/canvas.h"
#include "sightline/effects.h"
#include "sightline/region.h"

typedef struct sl_app sl_app;

#define SL_IN_EXPLORE   1u ///< 1 << sl_mode
#define SL_IN_LEARN     2u
#define SL_IN_DRAW      4u
#define SL_IN_QUIZ      8u
#define SL_IN_ALL_MODES 15u

/// A row: LAYER(NAME, name, key, label, help, modes, calls, draw).
///
/// `name` is for scripts, `label` and `key` for the panel, `modes` are those in which it is listed
/// and drawn; `calls` are effects, bits, of which the map must call for one, 0 for none. `draw` is
/// called below the walls in each frame, in the order of the table; NULL for what does not change
/// with the eye and is drawn into the picture that is kept (pane_plan.c).
#define SL_LAYERS(LAYER)                                                                           \
    LAYER(CELLS, "cells", "C", "Cells", "cells", SL_IN_ALL_MODES, 0, NULL)                         \
    LAYER(PORTALS, "portals", "P", "Portals", "portals", SL_IN_ALL_MODES, 0, NULL)                 \
    LAYER(SPLITS, "splits", "K", "Splits of the tree", "splits by depth", SL_IN_ALL_MODES, 0,      \
          NULL)                                                                                    \
    LAYER(VIEWS, "views", "F5", "View cells by cost", "view cells that adapt, by cost",            \
          SL_IN_EXPLORE | SL_IN_DRAW, 0, NULL)                                                     \
    LAYER(PVS, "pvs", "V", "Visible set of the cell", "the visible set",                           \
          SL_IN_EXPLORE | SL_IN_DRAW, 0, sl_layer_pvs)                                             \
    LAYER(CULL, "cull", "M", "Cells kept", "cells kept by culling", SL_IN_EXPLORE | SL_IN_DRAW, 0, \
          sl_layer_cull)                                                                           \
    LAYER(REGION, "region", "R", "Visible region", "the visible region",                           \
          SL_IN_EXPLORE | SL_IN_DRAW, 0, sl_layer_region)                                          \
    LAYER(TREE, "tree", "B", "Stab tree of the cell", "the stab tree", SL_IN_EXPLORE | SL_IN_DRAW, \
          0, sl_layer_tree)                                                                        \
    LAYER(NODES, "nodes", "Q", "Nodes without visible sets",                                       \
          "nodes, walking without visible sets", SL_IN_EXPLORE | SL_IN_DRAW, 0, sl_layer_nodes)    \
    LAYER(STARTS, "starts", "J", "Starts, paths, objects", "starts, paths, objects",               \
          SL_IN_ALL_MODES, 0, NULL)                                                                \
    LAYER(WATCH, "watch", "Y", "Who sees the eye", "through one-way glass: who sees the eye",      \
          SL_IN_EXPLORE, SL_EFFECT_ONEWAY, sl_layer_watch)

#define SL_LAYER_NUMBER(NAME, ...) SL_LAYER_NUMBER_##NAME,
enum { SL_LAYERS(SL_LAYER_NUMBER) SL_LAYER_COUNT };
#undef SL_LAYER_NUMBER

/// Layers switched on, as bits: SL_SHOW_CELLS ...
#define SL_SHOW_BIT(NAME, ...) SL_SHOW_##NAME = 1 << SL_LAYER_NUMBER_##NAME,
enum sl_show { SL_LAYERS(SL_SHOW_BIT) SL_SHOW_ALL = (1 << SL_LAYER_COUNT) - 1 };
#undef SL_SHOW_BIT

typedef struct sl_layer_row {
    const char *name;
    unsigned modes, calls;
    /// `index` tells which of the plans side by side.
    void (*draw)(sl_app *app, const sl_frame *frame, int index);
} sl_layer_row;

/// SL_LAYER_COUNT of them.
const sl_layer_row *sl_layer_rows(void);

/// Whether a layer, by SL_LAYER_NUMBER_..., has its place in the present mode and map. Splits are
/// those of a kd-tree: a mesh has none.
bool sl_layers_lists(const sl_app *app, unsigned layer);

/// Whether it is on, too.
bool sl_layers_shows(const sl_app *app, unsigned layer);

/// Draws what is on and has its place.
void sl_layers_draw(sl_app *app, const sl_frame *frame, int index);

/// Over all else in the plan: the keys of what is drawn.
void sl_layers_draw_keys(sl_app *app, const sl_frame *frame);

/// A row of a key: a colour, as it comes out on a cell, and what it stands for.
typedef struct sl_key_row {
    const char *label;
    sl_colour colour;
    double opacity;
    uint32_t count;
} sl_key_row;

/// A key in the lower left of the plan, with a line under its rows; NULL for none.
void sl_layers_draw_key(sl_app *app, const sl_frame *frame, const sl_key_row *rows, int count,
                        const char *line);

/// Draws a region, arcs as arcs.
void sl_layers_draw_region(sl_app *app, const sl_frame *frame, const sl_region *region,
                           sl_colour colour);

void sl_layer_pvs(sl_app *app, const sl_frame *frame, int index);
void sl_layer_cull(sl_app *app, const sl_frame *frame, int index);
void sl_layer_region(sl_app *app, const sl_frame *frame, int index);
void sl_layer_tree(sl_app *app, const sl_frame *frame, int index);
void sl_layer_nodes(sl_app *app, const sl_frame *frame, int index);
void sl_layer_nodes_key(sl_app *app, const sl_frame *frame); ///< its colours and counts
void sl_layer_watch(sl_app *app, const sl_frame *frame, int index);
void sl_layer_watch_key(sl_app *app, const sl_frame *frame);

#endif
