/// The grid that things are drawn on by hand, and how near the pointer has to be to them.
#ifndef VIEWER_GRID_H
#define VIEWER_GRID_H

#include "plan/view.h"

/// The grid's step at the present zoom: 1, 2 or 5 times a power of ten.
double grid_step(const view_state *view);
/// The grid's point nearest to a place.
sl_point grid_snap(const view_state *view, sl_point at);

/// From one place to another, in whole steps of the grid.
sl_point grid_moved(const view_state *view, sl_point from, sl_point to);

/// How far a point is from a segment.
double grid_distance(sl_point p, sl_point a, sl_point b);

/// The distance, in the map, within which the pointer takes hold of something.
double grid_reach(const view_state *view);

#endif
