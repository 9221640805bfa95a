/// The layers of the plan beside walls: one table. Keys, buttons, help, the panel, scripts and
/// settings use it.
#ifndef VIEWER_LAYER_TABLE_H
#define VIEWER_LAYER_TABLE_H

#include "sightline/effects.h"

#define IN_EXPLORE   1u ///< 1 << view_mode
#define IN_LEARN     2u
#define IN_DRAW      4u
#define IN_QUIZ      8u
#define IN_CAMERAS   16u
#define IN_PLAN      32u
#define IN_ALL_MODES 63u
#define IN_CELLS     15u ///< those that show cells

/// A row: LAYER(NAME, name, key, label, help, modes, calls).
///
/// `name` is for scripts, `label` and `key` are for the panel. `modes` are the modes that list and
/// draw the layer. `calls` are effects, as bits: the map must have one of them; 0: no condition.
#define LAYERS(LAYER)                                                                              \
    LAYER(CELLS, "cells", "C", "Cells", "cells", IN_CELLS, 0)                                      \
    LAYER(PORTALS, "portals", "P", "Portals", "portals", IN_CELLS, 0)                              \
    LAYER(SPLITS, "splits", "K", "Splits of the tree", "splits by depth", IN_CELLS, 0)             \
    LAYER(VIEWS, "views", "F5", "View cells by cost", "view cells that adapt, by cost",            \
          IN_EXPLORE | IN_DRAW, 0)                                                                 \
    LAYER(HEAT, "heat", "1", "Heat map", "heat map of the visibility graph",                       \
          IN_EXPLORE | IN_DRAW | IN_PLAN, 0)                                                       \
    LAYER(PVS, "pvs", "V", "Visible set of the cell", "the visible set", IN_EXPLORE | IN_DRAW, 0)  \
    LAYER(CULL, "cull", "M", "Cells kept", "cells kept by culling", IN_EXPLORE | IN_DRAW, 0)       \
    LAYER(REGION, "region", "R", "Visible region", "the visible region",                           \
          IN_EXPLORE | IN_DRAW | IN_PLAN, 0)                                                       \
    LAYER(TREE, "tree", "B", "Stab tree of the cell", "the stab tree", IN_EXPLORE | IN_DRAW, 0)    \
    LAYER(NODES, "nodes", "Q", "Nodes without visible sets",                                       \
          "nodes, walking without visible sets", IN_EXPLORE | IN_DRAW, 0)                          \
    LAYER(STARTS, "starts", "J", "Starts, paths, objects", "starts, paths, objects", IN_ALL_MODES, \
          0)                                                                                       \
    LAYER(WATCH, "watch", "Y", "Who sees the eye", "through one-way glass: who sees the eye",      \
          IN_EXPLORE, SL_EFFECT_ONEWAY)                                                            \
    LAYER(NUMBERS, "numbers", "0", "Numbers", "numbers of cells, and of portals with a p",         \
          IN_EXPLORE | IN_DRAW, 0)                                                                 \
    LAYER(NAMES, "numbers_too", "0", "Numbers", "numbers, as sentences name cells",                \
          IN_LEARN | IN_QUIZ, 0)

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

#endif
