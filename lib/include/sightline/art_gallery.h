/// The art gallery theorem by Fisk's colouring: a polygon with n corners and without holes needs at
/// most n/3 guards.
///
///     sl_shape inside;
///     sl_fisk fisk;
///     sl_status status = sl_shape_of_inside(context, &space, &inside);
///     if (status == SL_OK) status = sl_fisk_colour(context, &inside, &fisk);
///     // guards stand at inside.points[fisk.guards[i]]
///
/// Fisk 1978, A short proof of Chvátal's watchman theorem. For the fewest guards see place.h.
#ifndef SIGHTLINE_ART_GALLERY_H
#define SIGHTLINE_ART_GALLERY_H

#include "sightline/overlay.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A corner of the polygon with its two neighbours in what is left of the polygon, in order
/// counter-clockwise. Taking the ear off cuts the middle corner away.
typedef struct sl_ear {
    uint32_t before, tip, after; ///< corners
} sl_ear;

/// Zeroed, it is empty.
typedef struct sl_fisk {
    sl_ear *ears;       ///< in the order in which they are taken off: a triangulation
    uint32_t ear_count; ///< corners - 2; the last one is what is left
    /// By corner: 0, 1 or 2. The last ear gets three colours. Back to the first one, each tip gets
    /// the colour that its two neighbours do not have. So each triangle has all three.
    uint8_t *colours;
    uint32_t corner_count;
    uint32_t sizes[3];    ///< by colour: the number of corners
    uint8_t least;        ///< the colour with the fewest corners, the first of several
    uint32_t *guards;     ///< its corners, ascending. Each triangle has one, so they see everything
    uint32_t guard_count; ///< at most corners / 3
} sl_fisk;

/// Triangulates a polygon by taking ears off, and colours its corners. Exact: no corner is moved,
/// and corners on a straight line are allowed.
///
/// SL_UNSUPPORTED for several loops: for a polygon with holes the proof fails. SL_BAD_ARGUMENT,
/// with the corners, for a border that meets itself and for fewer than three corners. The same
/// input gives the same triangles. Time O(n^2), for most polygons.
SL_API sl_status sl_fisk_colour(sl_context *context, const sl_shape *polygon, sl_fisk *out);
SL_API void sl_fisk_destroy(sl_context *context, sl_fisk *fisk); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif
