/// A view: where an eye is and which way it looks.
#ifndef SIGHTLINE_VIEW_H
#define SIGHTLINE_VIEW_H

#include "sightline/context.h"
#include "sightline/geometry.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An eye with its view cone, or with a full circle. The cone goes counter-clockwise from the ray
/// through `right` to the ray through `left`, borders included. It is given by points, so
/// predicates on it are exact. Two rays of one direction make a cone of 0 degrees.
typedef struct sl_view {
    sl_point eye;
    bool full;            ///< all round: `left` and `right` are not used
    sl_point left, right; ///< other than the eye
} sl_view;

/// A view of the full circle.
SL_API sl_view sl_view_all_round(sl_point eye);

/// A cone about a heading, in degrees counter-clockwise from +x, `fov` degrees wide: 0 to 360,
/// where 360 and more is all round. The border points are rounded and lie about `reach` from the
/// eye. Pass the map's size, so that they differ from the eye.
SL_API sl_view sl_view_cone(sl_point eye, double heading, double fov, double reach);

/// Whether a view is usable: its points are finite, and the cone's points differ from the eye. All
/// functions that take a view need that.
SL_API bool sl_view_usable(const sl_view *view);

/// Whether a point is within the cone, its border included. The eye itself always is. Exact.
SL_API bool sl_view_holds(const sl_view *view, sl_point point);

/// Whether any point of a closed segment is within the cone, its border included. Exact.
SL_API bool sl_view_meets_segment(const sl_view *view, sl_segment segment);

/// Whether any point of a polygon of three corners or more is within the cone. Its border decides:
/// a cone has no end. Exact.
SL_API bool sl_view_meets_polygon(const sl_view *view, const sl_point *corners, size_t count);

#ifdef __cplusplus
}
#endif

#endif
