/// Walls drawn, moved and deleted by hand.
#ifndef VIEWER_EDIT_H
#define VIEWER_EDIT_H

#include "app.h"

/// The grid's step at the present zoom: 1, 2 or 5 times a power of ten.
double sl_edit_step(const sl_app *app);
/// The grid's point nearest to a place.
sl_point sl_edit_snap(const sl_app *app, sl_point at);

/// The wall within a few pixels of a place of the map; UINT32_MAX for none.
uint32_t sl_edit_pick(const sl_app *app, sl_point at);

/// A new wall, in any direction. Nothing where it has no length.
void sl_edit_add(sl_app *app, sl_point from, sl_point end);
void sl_edit_move(sl_app *app, uint32_t wall, double dx, double dy);
void sl_edit_delete(sl_app *app);

/// The grid, the chosen wall, and the one that is being drawn or moved.
void sl_edit_draw(sl_app *app, const sl_frame *frame);

/// How far a point is from a segment.
double sl_edit_distance(sl_point p, sl_point a, sl_point b);

/// Within which distance, in the map, the pointer takes hold of something.
double sl_edit_reach(const sl_app *app);

#endif
