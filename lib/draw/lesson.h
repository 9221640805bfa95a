/// Figures of a subdivision as it comes about: the splits of a kd-tree, or the triangles and cells
/// of a mesh. They show the inside of the library, so this header is not public.
#ifndef SL_DRAW_LESSON_H
#define SL_DRAW_LESSON_H

#include "sightline/canvas.h"
#include "space/mesh_steps.h"
#include "space/splits.h"

/// The first `count` splits of a kd-tree (sl_splits_make) down to a depth (1: the first alone),
/// each within its node's box: the deeper the thinner, in the steps of the heat map's ramp.
void sl_draw_splits(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                    const sl_split *splits, uint32_t count, uint32_t depth);

/// A node's split with both its sides, and the splits made before it.
void sl_draw_split(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                   const sl_split *splits, uint32_t node);

/// The points of a mesh: ends of walls and seams, and corners of the bounds.
void sl_draw_mesh_points(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                         const sl_mesh_steps *steps);

/// The Delaunay triangles of the points, and which walls and seams are no sides of them.
void sl_draw_mesh_delaunay(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                           const sl_mesh_steps *steps);

/// The triangles with all walls and seams as sides, and which of the sides are new.
void sl_draw_mesh_triangles(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                            const sl_mesh_steps *steps);

/// The cells before the side of a place is tried: sides that stay, sides that are still to be
/// tried, and that side with the cells beside it, dashed where it is taken out. A place behind the
/// last side gives the cells as they are at last.
sl_status sl_draw_mesh_side(sl_context *context, cairo_t *cairo, const sl_palette *palette,
                            const sl_frame *frame, const sl_mesh_steps *steps, size_t place);

/// The corner that would turn right without the side of a place, where it has to stay for that.
void sl_draw_mesh_corner(cairo_t *cairo, const sl_palette *palette, const sl_frame *frame,
                         const sl_mesh_steps *steps, size_t place);

#endif
