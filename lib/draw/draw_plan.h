/// The private part of draw.h: scenes, frames and text.
#ifndef SL_DRAW_PLAN_H
#define SL_DRAW_PLAN_H

#include "sightline/draw.h"

#include <cairo.h>
#include <stdbool.h>
#include <stddef.h>

// --- frames and text

/// The frame and its surroundings, on the page. Nothing beyond is drawn: cairo's fixed-point
/// coordinates overflow beyond 2^23, which a frame zoomed in reaches.
sl_box sli_frame_guard(const sl_frame *frame);

/// A segment's piece in the guard, on the page; false where there is none.
bool sli_frame_segment(const sl_frame *frame, sl_point a, sl_point b, sl_point *from, sl_point *to);

/// Adds a curve to the path. If it reaches far off the frame: the segment between its ends.
void sli_path_curve(cairo_t *cairo, const sl_frame *frame, const sl_point controls[4]);

/// Copies text[0 .. length) as far as there is room, whole characters only.
void sli_text_copy(const char *text, size_t length, char *out, size_t room);

// --- scenes

/// How a cell is filled: not at all (not shown), as solid ground, with a tone of the floor or of
/// visible cells, as the chosen cell, as a doubtful one, or with a step of the heat map.
typedef enum sli_paint {
    SLI_PAINT_NONE,
    SLI_PAINT_SOLID,
    SLI_PAINT_FLOOR,
    SLI_PAINT_SEEN = SLI_PAINT_FLOOR + SL_TONES,
    SLI_PAINT_DOUBTFUL = SLI_PAINT_SEEN + SL_TONES,
    SLI_PAINT_SOURCE,
    SLI_PAINT_HEAT,
} sli_paint;

#define SLI_HEAT_STEPS  64
#define SLI_PAINT_COUNT (SLI_PAINT_HEAT + SLI_HEAT_STEPS)

/// A stroke of the stab tree within a cell. It goes between places where sequences cross portals or
/// turn back at mirrors, given by the directed portals of nodes (sl_stab_node). Sequences that
/// share a stroke draw it once, at their least depth.
typedef struct sli_stroke {
    uint32_t from, to, depth, cell;
    bool mirrored; ///< the sequence has been reflected before
} sli_stroke;

struct sl_scene {
    const sl_baked *baked;
    sl_draw_options options;
    sl_palette palette;

    /// Cells by paint: those of paint p are order[paint_begin[p] .. paint_begin[p + 1]).
    uint32_t *order;
    uint32_t paint_begin[SLI_PAINT_COUNT + 1];

    bool outside;             ///< cells that do not count are shown, those that do are not
    uint32_t population;      ///< cells shown: what the counts refer to
    uint32_t solid;           ///< cells of solid ground: filled, but neither shown nor counted
    uint32_t hatched;         ///< of the population, cells outside
    double cell_size;         ///< the side of a square of their mean area
    uint32_t portals;         ///< those shown
    bool chosen;              ///< a cell is chosen
    bool shows_seen;          ///< and what it sees is painted
    bool heat;                ///< or each cell's share of the area is
    uint32_t seen, doubtful;  ///< cells, of the population
    uint32_t seen_beyond;     ///< other cells that are seen, through windows
    double seen_share;        ///< of the population's area
    double least, most, mean; ///< of all shares, where heat
    sli_stroke *strokes;      ///< deepest first
    size_t stroke_count;
    uint64_t tree_nodes, mirrored_nodes; ///< all; those of sequences that are reflected
    uint32_t tree_depth;                 ///< portals in the longest sequence
    sl_point eye; ///< where the stab tree starts: a start in the chosen cell, or its middle
};

/// No portal joins cells that count (sl_baked_counts) with others, so only one group is shown: that
/// of the chosen cell, or without one the cells that count. Solid ground is in neither group: it is
/// filled in one colour, without the borders of its cells. `baked` is referred to, not copied.
/// `trees` as in sl_scene_create. `out` is untouched on failure.
sl_status sli_scene_make(sl_context *context, const sl_baked *baked, const sl_draw_options *options,
                         const sl_stab_trees *trees, sl_scene *out);
void sli_scene_clear(sl_context *context, sl_scene *scene);

/// SL_BAD_ARGUMENT for a chosen cell that the map does not have, and for solid ground.
sl_status sli_scene_check_cell(sl_context *context, const sl_baked *baked, uint32_t cell);

/// Whether a cell is of the group that is shown. Never true of solid ground.
bool sli_scene_shows(const sl_scene *scene, uint32_t cell);

/// Draws the numbers of cells and portals where they have room.
void sli_draw_numbers(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame);

/// Fills solid ground once more, over what was drawn since.
void sli_draw_solid(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame);
/// The same of all cells but those that are kept, `kept` by cell, and of the ground there.
void sli_draw_beside(cairo_t *cairo, const sl_scene *scene, const sl_frame *frame,
                     const bool *kept);

/// The colour of a paint.
sl_colour sli_scene_colour(const sl_scene *scene, unsigned paint);

/// Copies the paint of each cell (cell_count entries) for a change by the caller; and back.
void sli_scene_get_paint(const sl_scene *scene, uint8_t *paint);
void sli_scene_set_paint(sl_scene *scene, const uint8_t *paint);

#endif
