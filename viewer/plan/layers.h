/// Which layers are shown, and the shapes that they are drawn with: sets of cells, regions, the
/// ramp of values.
#ifndef VIEWER_LAYERS_H
#define VIEWER_LAYERS_H

#include "plan/view.h"
#include "sightline/region.h"
#include "ui/tones.h"

typedef struct layer_row {
    const char *name;
    unsigned modes, calls;
} layer_row;

/// LAYER_COUNT of them.
const layer_row *layer_table(void);

/// Whether a layer, by LAYER_..., belongs to the present mode and map. Splits belong to a kd-tree:
/// a mesh has none.
bool layers_lists(const view_state *view, unsigned layer);

/// Whether it is also switched on.
bool layers_shows(const view_state *view, unsigned layer);

/// The layer that fills the plan: the one that was switched on last; LAYER_COUNT: none.
unsigned layers_fill(const view_state *view);
/// Switches it on, and then it fills the plan if it can; or off.
void layers_toggle(view_state *view, unsigned layer);
/// Has it fill the plan. Once it is switched off, the layer does that did before.
void layers_set_fill(view_state *view, unsigned layer);

/// Draws a set of cells without those of another (NULL: none): filled where its layer fills the
/// plan, else as a line round the set.
void layers_draw_set(view_state *view, const sl_frame *frame, const uint64_t *cells,
                     const uint64_t *without, tone which, bool fills);

/// Draws the portals of a set of cells once more (NULL: of those inside): a solid fill covers those
/// below it.
void layers_draw_portals(const view_state *view, cairo_t *cairo, const sl_frame *frame,
                         const uint64_t *cells, const uint64_t *without);

/// Fills one cell with a tone, and outlines it.
void layers_draw_cell(view_state *view, const sl_frame *frame, uint32_t cell, tone which);

/// Draws a region likewise. Arcs are drawn as arcs.
void layers_draw_region(view_state *view, const sl_frame *frame, const sl_region *region,
                        tone which, bool fills);

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

/// The tone of a culling method, when another one or itself is chosen.
tone layers_method_tone(size_t method, size_t chosen);

/// Colours of values: over areas, of lines, which would be lost in the page's colour, and of
/// changes.
typedef enum ramp_kind { RAMP_NONE, RAMP_AREAS, RAMP_LINES, RAMP_CHANGES } ramp_kind;

/// The key of a layer that is coloured by values: rows of words, and the ramp between its ends.
typedef struct legend_key {
    struct {
        char label[64], text[96];
    } rows[10];
    int count;
    ramp_kind ramp;
    char least[32], most[32];
} legend_key;

void legend_key_add(legend_key *key, const char *label, const char *text);

/// The number of a value's colour, and that colour.
enum { RAMP_STEPS = 32 };
int ramp_step(double value, double least, double most);
sl_colour ramp_colour(const ui_state *ui, ramp_kind kind, int step);

/// Clips to the cells inside: squares and view cells reach into walled-in space.
void layers_clip_inside(const document_state *document, cairo_t *cairo, const sl_frame *frame);

void layer_nodes(view_state *view, const sl_frame *frame, int index);
int layer_nodes_legend(const view_state *view, legend_row *rows); ///< at most 6
/// What the walk did, in words; NULL where it is not shown.
const char *layer_nodes_words(const view_state *view, char text[96]);
void layer_watch(view_state *view, const sl_frame *frame, int index);
int layer_watch_legend(const view_state *view, legend_row *rows); ///< at most 4

void node_layer_destroy(sl_context *context, node_layer *layer); ///< NULL: nothing

void watch_layer_destroy(sl_context *context, watch_layer *layer); ///< NULL: nothing

#endif
