/// Figures of a subdivision as it comes about: the splits of a kd-tree, or the triangles and cells
/// of a mesh. They show the inside of the library, so this header is not public.
#ifndef SL_DRAW_LESSON_H
#define SL_DRAW_LESSON_H

#include "sightline/draw.h"
#include "space/kd_tree.h"
#include "space/mesh.h"

/// The first `count` splits of a kd-tree (sli_splits_make) down to a depth (1: the first one
/// alone), each within its node's box. Deeper splits are thinner, in the colours of the ramp.
void sli_draw_splits(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                     const sli_split *splits, uint32_t count, uint32_t depth);

/// A split with both its sides, and the splits before it.
void sli_draw_split(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                    const sli_split *splits, uint32_t node);

/// The points of a mesh: ends of walls and seams, and corners of the bounds.
void sli_draw_mesh_points(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                          const sli_mesh_steps *steps);

/// The Delaunay triangles of the points, and the walls and seams that are no sides of them.
void sli_draw_mesh_delaunay(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                            const sli_mesh_steps *steps);

/// The triangles with all walls and seams as sides; new sides are marked.
void sli_draw_mesh_triangles(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                             const sli_mesh_steps *steps);

/// The cells before the side at `place` is tried: sides that stay, sides still to be tried, and
/// that side with the cells beside it. It is dashed if it is taken out. A place behind the last
/// side draws the final cells.
sl_status sli_draw_mesh_side(sl_context *context, cairo_t *cairo, const sl_palette *palette,
                             const sl_frame *frame, const sli_mesh_steps *steps, size_t place);

/// If that side has to stay: the corner that would turn right without it.
void sli_draw_mesh_corner(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                          const sli_mesh_steps *steps, size_t place);

#endif
