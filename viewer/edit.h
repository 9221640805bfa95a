/// Walls drawn, moved and deleted by hand.
#ifndef VIEWER_EDIT_H
#define VIEWER_EDIT_H

#include "app.h"

/// The grid's step at the present zoom: 1, 2 or 5 times a power of ten.
double edit_step(const app_state *app);
/// The grid's point nearest to a place.
sl_point edit_snap(const app_state *app, sl_point at);

/// The wall within a few pixels of a place of the map; UINT32_MAX for none.
uint32_t edit_pick(const app_state *app, sl_point at);

/// Adds a wall, in any direction. Does nothing where it has no length.
void edit_add(app_state *app, sl_point from, sl_point end);
void edit_move(app_state *app, uint32_t wall, double dx, double dy);
void edit_delete(app_state *app);

/// Draws the grid, the chosen wall, and the wall that is being drawn or moved.
void edit_draw(app_state *app, const sl_frame *frame);

/// How far a point is from a segment.
double edit_distance(sl_point p, sl_point a, sl_point b);

/// The distance, in the map, within which the pointer takes hold of something.
double edit_reach(const app_state *app);

#endif
