/// The marks that stand for things: drawn alike in the plan and in its legend, in page coordinates.
#ifndef SL_DRAW_MARKS_H
#define SL_DRAW_MARKS_H

#include "draw/draw_plan.h"

#define SLI_FULL_TURN 6.283185307179586 ///< in radians

/// Widths of lines, and the size of a start's mark. They follow the size of the cells on the page,
/// within bounds that keep them visible and apart.
typedef struct sli_pens {
    double wall, portal, outline, tree, mark;
} sli_pens;

sli_pens sli_pens_for(const sl_scene *scene, const sl_frame *frame);

/// Makes a colour the source, so that what is below shines through: `opacity` from 0 to 1.
void sli_set_faded(cairo_t *cairo, sl_colour colour, double opacity);

/// Each strokes the path.
void sli_pen_stroke(cairo_t *cairo, sl_colour colour, double width);
void sli_pen_wall(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens);
void sli_pen_portal(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens);
void sli_pen_outline(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens);
void sli_pen_source_edge(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens);
void sli_pen_path(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens);
void sli_pen_object(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens);
/// Fainter and thinner the more portals (`depth`) lie between it and the source cell.
void sli_pen_tree(cairo_t *cairo, sl_colour colour, const sli_pens *pens, uint32_t depth);
void sli_pen_tree_dots(cairo_t *cairo, sl_colour colour, uint32_t depth); ///< fills the path
double sli_tree_width(const sli_pens *pens, uint32_t depth);

/// Adds the mark of a portal's end to the path: a disc for left ones, a square for right ones.
void sli_path_portal_end(cairo_t *cairo, sl_point at, bool left, double radius);

/// Slanting lines over a box; `phase` moves them.
void sli_mark_hatch(cairo_t *cairo, const sl_palette *palette, sl_box box, double spacing,
                    double phase);
/// An arrow head that points along the heading, in degrees counter-clockwise from right.
void sli_mark_start(cairo_t *cairo, const sl_palette *palette, sl_point at, double heading,
                    double size);
void sli_mark_door(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                   sl_point b, bool open);
void sli_mark_mirror(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                     sl_point b);
/// What a wall that does not stop all is in the picture's space.
typedef enum sli_partial { SLI_PARTIAL_OPEN, SLI_PARTIAL_LIMITED, SLI_PARTIAL_WALL } sli_partial;

static inline sli_partial sli_partial_of(const sl_map *map, uint32_t stops) {
    if (stops & sl_map_channel(map)) return SLI_PARTIAL_WALL;
    const bool limits = stops & SL_STOPS_LIMITED && sl_map_channel(map) & SL_STOPS_SIGHT;
    return limits ? SLI_PARTIAL_LIMITED : SLI_PARTIAL_OPEN;
}

/// A wall that does not stop all: hollow for a wall, dashed where it is open, with dashes and dots
/// where it limits sight.
void sli_mark_partial(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                      sl_point b, sli_partial what);
/// Its arrow points in the direction that one can look: from the right of `a` to `b` to the left.
void sli_mark_oneway(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens, sl_point a,
                     sl_point b);

/// A shape and a colour for each kind of fault, from one point to another.
void sli_mark_fault(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens,
                    sl_fault_kind kind, sl_point a, sl_point b);

/// All faults over the plan.
void sli_draw_faults(cairo_t *cairo, const sl_palette *palette, const sli_pens *pens,
                     const sl_frame *frame, const sl_faults *faults);

/// Draws a polygon by its depth: blue where it is seen directly, else in the colour of what is seen
/// by mirror, the paler the more mirrors.
void sli_draw_seen(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                   const sl_drawn_region *region);

/// Room for an equation.
#define SLI_EQUATION_TEXT 96

/// The half-plane of an end: "b <= 0.52 - 0.31 a" for a left one, with the signs of print.
void sli_dual_equation(const sl_dual *dual, sl_point end, bool left, char text[SLI_EQUATION_TEXT]);

#endif
