/// Single lines of sight: does one point see another, and what does a ray meet first?
#ifndef SIGHTLINE_SEES_H
#define SIGHTLINE_SEES_H

#include "sightline/outline.h"
#include "sightline/stab.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether an eye sees a point. Exact. SL_CLOSED: portals lead from a cell that the eye stands in
/// (view.h) to a cell that touches the point, and the segment between eye and point touches each of
/// them. It may graze walls on either side, but crosses none. (One that grazes walls on both sides
/// leads the culling methods to no cell, as eye_to_cell.h says.) SL_OPEN: the same, and the segment
/// has no point in common with a wall. False where either point is outside the bounds, and where
/// the eye is in solid ground.
SL_API sl_status sl_sees(sl_context *context, const sl_outline *outline, sl_point eye,
                         sl_point point, sl_sight sight, bool *out);

/// What a ray meets.
typedef struct sl_hit {
    uint32_t wall;  ///< UINT32_MAX: the border of the map
    sl_point point; ///< rounded; on the wall where that is axial
} sl_hit;

/// The first wall on the ray from an eye through a point, just to the left of the ray: a corner
/// that the ray touches stops it where the corner's walls reach to its left. For an eye on a wall,
/// whose ray does not lead into what the eye sees (region.h), it is that wall, at the eye. The wall
/// is exact; the point is rounded. SL_BAD_ARGUMENT where the eye is outside the bounds or in solid
/// ground, the two points are the same, or one is not finite.
SL_API sl_status sl_ray_cast(sl_context *context, const sl_outline *outline, sl_point eye,
                             sl_point through, sl_hit *out);

#ifdef __cplusplus
}
#endif

#endif
