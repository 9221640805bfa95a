/// What several eyes see together: shapes laid over each other, and the area that one, two or more
/// of them cover.
///
///     sl_shape inside, seen[2] = {{one.points, &one.count, 1}, {other.points, &other.count, 1}};
///     sl_overlay overlay;
///     sl_status status = sl_shape_of_inside(context, &space, &inside); // for all its overlays
///     if (status == SL_OK) status = sl_overlay_make(context, &inside, seen, 2, &overlay);
///
/// Of two regions this gives the area that both see, overlay.areas[2], and that one of them sees,
/// overlay.areas[1], of all that is inside, overlay.areas[0].
#ifndef SIGHTLINE_OVERLAY_H
#define SIGHTLINE_OVERLAY_H

#include "sightline/space.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What one eye sees, or an area that was explored: all that the loops go around. Outer loops run
/// counter-clockwise and holes clockwise. A point counts where the loops go around it any number of
/// times but 0, so loops may overlap: a region with its mirrored parts is one shape. The points of
/// a region (region.h) are a loop; sl_region_flatten makes chords of its arcs.
typedef struct sl_shape {
    const sl_point *points; ///< loop after loop; the last point of each joins its first
    const size_t *ends;     ///< by loop: the number of points up to its last one
    size_t count;           ///< of loops
} sl_shape;

/// Only for a shape that a call of this header made; zeroes it.
SL_API void sl_shape_destroy(sl_context *context, sl_shape *shape);

/// The outline of what is inside of a space. Walls between two places inside are no part of it. The
/// caller destroys the shape. Time O(n log n).
SL_API sl_status sl_shape_of_inside(sl_context *context, const sl_space *space, sl_shape *out);

/// Zeroed, an overlay is empty.
typedef struct sl_overlay {
    size_t shape_count;
    double *areas; ///< areas[k]: of what counts and at least k shapes cover, up to shape_count.
                   ///< So areas[0] is all that counts, and exactly k cover areas[k] - areas[k + 1]
    sl_space pieces;  ///< a mesh that tiles the bounds of all. `inside` marks what counts, and its
                      ///< walls are the cut outlines; the `line` of each is the number of the first
                      ///< shape that it is of. sl_space_locate finds the piece of a point
    uint32_t *counts; ///< by piece: how many shapes cover it
    double *covered;  ///< by shape: what it covers of all that counts
    double *alone;    ///< by shape: what of that no other shape covers
} sl_overlay;

/// Lays shapes over each other. What is within `within` counts; where that is NULL, all that is
/// covered.
///
/// Outlines are cut where they cross. Exact predicates find the crossings, and each gets the
/// nearest representable point. Points within 2^-46 times the largest coordinate of each other
/// become one, as when a map is cleaned, and an outline goes through points half as near to it. So
/// places are right to about that, and nothing else is rounded: the areas are those of the pieces
/// to one rounding. The order of the shapes does not matter.
///
/// Nothing is kept between calls. For an area that grows, lay its outline (sl_overlay_outline) and
/// the new shape over each other.
///
/// Time O((n + k) log n) for n points and k crossings. SL_BAD_ARGUMENT for coordinates that a map
/// may not have. Without points, the overlay has no pieces.
SL_API sl_status sl_overlay_make(sl_context *context, const sl_shape *within,
                                 const sl_shape *shapes, size_t count, sl_overlay *out);
SL_API void sl_overlay_destroy(sl_context *context, sl_overlay *overlay); ///< and zeroes it

/// The outline of what at least so many shapes cover, within or not: 1 for the union, shape_count
/// for the intersection, at least 1. Loops are simple, and meet in single points only. The
/// caller destroys the shape.
SL_API sl_status sl_overlay_outline(sl_context *context, const sl_overlay *overlay, size_t at_least,
                                    sl_shape *out);

#ifdef __cplusplus
}
#endif

#endif
