/// Pictures of a baked map, by one drawing code for files and for windows. In a library of its own,
/// sightline_draw, which needs cairo.
#ifndef SIGHTLINE_DRAW_H
#define SIGHTLINE_DRAW_H

#include "sightline/bake.h"

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
    SL_LAYER_STAB_TREE = 16, ///< the chosen cell's stab tree, from portal to portal
    SL_LAYER_STARTS = 32,    ///< starts with their heading, paths, objects
    SL_LAYER_LEGEND = 64,    ///< what the picture shows, its colours and counts, a scale bar
} sl_layer;

#define SL_DRAW_WIDTH_MIN 64
#define SL_DRAW_WIDTH_MAX 20000

/// Start from sl_draw_options_default().
typedef struct sl_draw_options {
    unsigned layers; ///< of sl_layer, or-ed; usually all but the stab tree
    uint32_t cell;   ///< the chosen cell; usually SL_NO_CELL, for none
    double width; ///< of the picture, pixels (PDF: points), SL_DRAW_WIDTH_MIN to ..._MAX; usually
                  ///< 1200. Lines and text grow with it; the height follows the map
    const char *title; ///< UTF-8; NULL for none
    bool dark;         ///< light lines on a dark page
} sl_draw_options;

SL_API sl_draw_options sl_draw_options_default(void);

/// Draws into a file: .png, .svg or .pdf by the ending of its name. The whole map is shown, as
/// large as fits and never stretched; the frame for it is between a sixth and 1.4 times as high as
/// wide, so that a thin map stands free in it. No portal joins the cells that count
/// (sl_baked_counts) with the others: those on the chosen cell's side are shown (those that count
/// where none is chosen) and the others hatched. Where there is no visibility to show that layer is
/// empty. The same input gives the same bytes. SL_BAD_ARGUMENT on an unknown ending or options out
/// of range, SL_IO or SL_NO_MEMORY otherwise; a failure leaves an older file as it was.
SL_API sl_status sl_draw_file(sl_context *context, const sl_baked *baked,
                              const sl_draw_options *options, const char *path);

#ifdef __cplusplus
}
#endif

#endif
