/// Walls, corners and doors, drawn, moved and deleted by hand.
#ifndef VIEWER_EDIT_H
#define VIEWER_EDIT_H

#include "plan/view.h"

/// The grid's step at the present zoom: 1, 2 or 5 times a power of ten.
double edit_step(const view_state *view);
/// The grid's point nearest to a place.
sl_point edit_snap(const view_state *view, sl_point at);

void edit_delete(view_state *view);

/// What is under the pointer is held from now on: a corner with all ends there, a door, a wall; on
/// free ground a new wall begins. Where doors are drawn, a new one begins anywhere but on a door.
/// Returns what it is.
drag_kind edit_take(view_state *view, drag_state *drag);
/// Moves what is held, by steps of the grid. The plan follows at once.
void edit_drag(view_state *view, drag_state *drag, sl_point now);
/// Lets it go.
void edit_drop(view_state *view, const drag_state *drag);
/// Ends a drag, and takes back what it changed. False if nothing that can be edited is held.
bool edit_cancel(view_state *view);

/// Draws the grid, the chosen wall, and what is held or could be.
void edit_draw(view_state *view, const sl_frame *frame);

/// How far a point is from a segment.
double edit_distance(sl_point p, sl_point a, sl_point b);

/// The distance, in the map, within which the pointer takes hold of something.
double edit_reach(const view_state *view);

#endif
