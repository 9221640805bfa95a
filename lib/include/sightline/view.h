/// A view: where an eye is and which way it looks.
///
/// An eye stands in the cell that sl_space_locate gives, and in each cell that portals at the eye
/// join with it: it is on the portal, or on its end, and so on from cell to cell. It sees what it
/// sees from any of these cells. All that asks what an eye sees keeps to this: the region, the
/// culling methods, boxes, queries and the runtime header. So:
///
/// - An eye on a portal, or where portals meet, sees to all sides.
/// - At the end of a wall, and at a corner of solid ground, it sees all around, but for what lies
///   behind the wall or in the solid ground. No direction along the wall hides anything.
/// - Within a wall, between its ends, it sees one side, that of its cell. So nobody looks through a
///   wall that has no thickness.
/// - Where walls meet, they part what is around the eye. It sees the part that has its cell.
/// - A shut door is a wall. So is one-way glass for an eye on its dark side. For an eye in line
///   with glass, it is dark if any of the cell that sl_space_locate gives is on its dark side.
/// - A cone sees those of the eye's cells that it leads into: some of its directions enter the
///   cell, or run along its border. It does not see a cell that it only leaves. So an eye on a wall
///   that looks into the wall sees no cell.
/// - An eye outside the bounds or in solid ground stands in no cell, and sees nothing.
///
/// What is looked at has no side: a point on a wall or on a shut door is seen from both. So of two
/// points each sees the other or none does, unless one of them is where walls, shut doors or glass
/// part what is around it, or glass is between them.
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

#ifdef __cplusplus
}
#endif

#endif
