/// A view: where an eye is and which way it looks.
#ifndef SIGHTLINE_VIEW_H
#define SIGHTLINE_VIEW_H

#include "sightline/context.h"
#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An eye with its view cone, or with a full circle. The cone is closed and goes counter-clockwise
/// from the ray through `right` to the ray through `left`; it is given by points, so that
/// predicates on it are exact. Rays of one direction make a cone of 0 degrees.
typedef struct sl_view {
    sl_point eye;
    bool full;            ///< all round: `left` and `right` are not looked at
    sl_point left, right; ///< other than the eye
} sl_view;

/// A view of the full circle.
SL_API sl_view sl_view_all_round(sl_point eye);

/// A cone about a heading, in degrees counter-clockwise from +x, `fov` degrees wide in all: from 0
/// to 360, where 360 and more is all round. Its border points are at about `reach` from the eye
/// and rounded; pass the map's size, so that they differ from the eye.
SL_API sl_view sl_view_cone(sl_point eye, double heading, double fov, double reach);

/// Whether the view is one: all its points finite, and the cone's other than the eye. What follows,
/// and all that takes a view, needs that.
SL_API bool sl_view_usable(const sl_view *view);

/// Whether a point is within the cone, its border included. The eye itself always is. Exact.
SL_API bool sl_view_holds(const sl_view *view, sl_point point);

/// Whether any point of a closed segment is within the cone, its border included. Exact.
SL_API bool sl_view_meets_segment(const sl_view *view, sl_segment segment);

/// Likewise a polygon's border, of three corners or more. A polygon that meets the cone does so
/// with its border too: a cone has no end. Exact.
SL_API bool sl_view_meets_polygon(const sl_view *view, const sl_point *corners, size_t count);

#ifdef __cplusplus
}
#endif

#endif
