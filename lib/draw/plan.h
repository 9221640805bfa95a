/// The private part of canvas.h: scenes, frames and text.
#ifndef SL_DRAW_PLAN_H
#define SL_DRAW_PLAN_H

#include "sightline/canvas.h"

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

// --- frames and text

/// The frame and its surroundings, on the page. Nothing beyond is drawn: cairo's fixed-point
/// coordinates overflow beyond 2^23, which a frame zoomed in reaches.
sl_box sl_frame_guard(const sl_frame *frame);

/// A segment's piece in the guard, on the page; false where there is none.
bool sl_frame_segment(const sl_frame *frame, sl_point a, sl_point b, sl_point *from, sl_point *to);

/// Adds a curve to the path. If it reaches far off the frame: the segment between its ends.
void sl_path_curve(cairo_t *cairo, const sl_frame *frame, const sl_point controls[4]);

/// Copies text[0 .. length) as far as there is room, whole characters only.
void sl_text_copy(const char *text, size_t length, char *out, size_t room);

// --- scenes

/// How a cell is filled: not at all (not shown), with a tone of the floor or of visible cells, as
/// the chosen cell, as a doubtful one, or with a step of the heat map.
typedef enum sl_paint {
    SL_PAINT_NONE,
    SL_PAINT_FLOOR,
    SL_PAINT_SEEN = SL_PAINT_FLOOR + SL_TONES,
    SL_PAINT_DOUBTFUL = SL_PAINT_SEEN + SL_TONES,
    SL_PAINT_SOURCE,
    SL_PAINT_HEAT,
} sl_paint;

#define SL_HEAT_STEPS  64
#define SL_PAINT_COUNT (SL_PAINT_HEAT + SL_HEAT_STEPS)

/// A stroke of the stab tree within a cell. It goes between places where sequences cross portals or
/// turn back at mirrors, given by the directed portals of nodes (sl_stab_node). Sequences that
/// share a stroke draw it once, at their least depth.
typedef struct sl_stroke {
    uint32_t from, to, depth, cell;
    bool mirrored; ///< the sequence has been reflected before
} sl_stroke;

struct sl_scene {
    const sl_baked *baked;
    sl_draw_options options;
    sl_palette palette;

    /// Cells by paint: those of paint p are order[paint_begin[p] .. paint_begin[p + 1]).
    uint32_t *order;
    uint32_t paint_begin[SL_PAINT_COUNT + 1];

    bool outside;             ///< cells that do not count are shown, those that do are not
    uint32_t population;      ///< cells shown: what the counts refer to
    double cell_size;         ///< the side of a square of their mean area
    uint32_t portals;         ///< those shown
    bool chosen;              ///< a cell is chosen
    bool shows_seen;          ///< and what it sees is painted
    bool heat;                ///< or each cell's share of the area is
    uint32_t seen, doubtful;  ///< cells, of the population
    double seen_share;        ///< of the population's area
    double least, most, mean; ///< of all shares, where heat
    sl_stroke *strokes;       ///< deepest first
    size_t stroke_count;
    uint64_t tree_nodes, mirrored_nodes; ///< all; those of sequences that are reflected
    uint32_t tree_depth;                 ///< portals in the longest sequence
    sl_point eye; ///< where the stab tree starts: a start in the chosen cell, or its middle
};

/// No portal joins cells that count (sl_baked_counts) with others, so only one group is shown: that
/// of the chosen cell, or without one the cells that count. `baked` is referred to, not copied.
/// `trees` as in sl_scene_create. `out` is untouched on failure.
sl_status sl_scene_make(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                        const sl_stab_trees *trees, sl_scene *out);
void sl_scene_clear(sl_context *context, sl_scene *scene);

bool sl_scene_shows(const sl_scene *scene, uint32_t cell);

/// The colour of a paint.
sl_colour sl_scene_colour(const sl_scene *scene, unsigned paint);

/// Copies the paint of each cell (cell_count entries) for a change by the caller; and back.
void sl_scene_get_paint(const sl_scene *scene, uint8_t *paint);
void sl_scene_set_paint(sl_scene *scene, const uint8_t *paint);

#endif
