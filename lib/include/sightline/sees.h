/// Single lines of sight: whether one point sees another, and what a ray meets first.
#ifndef SIGHTLINE_SEES_H
#define SIGHTLINE_SEES_H

#include "sightline/outline.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether a point is seen. Exact. SL_CLOSED: portals lead from the cell that sl_space_locate gives
/// for the eye to one that touches the point, and the segment between them touches every one; so it
/// may graze walls, but crosses none. SL_OPEN: that, and the segment has no point in common with a
/// wall. False where either point is outside the bounds.
SL_API sl_status sl_sees(sl_context *context, const sl_outline *outline, sl_point eye,
                         sl_point point, sl_sight sight, bool *out);

/// What a ray meets.
typedef struct sl_hit {
    uint32_t wall;  ///< UINT32_MAX: the border of the map
    sl_point point; ///< rounded; on the wall where that is axial
} sl_hit;

/// The first wall on the ray from an eye through a point, just to the left of it: a corner that the
/// ray touches stops it where the corner's walls reach to its left. Of an eye on a wall from which
/// the ray does not lead away into what the eye sees (region.h), that wall, at the eye. Which wall
/// it is, is exact. SL_BAD_ARGUMENT where the eye is outside the bounds, the points are one, or not
/// finite.
SL_API sl_status sl_ray_cast(sl_context *context, const sl_outline *outline, sl_point eye,
                             sl_point through, sl_hit *out);

#ifdef __cplusplus
}
#endif

#endif
