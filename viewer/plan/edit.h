/// Walls, corners and doors, drawn, moved and deleted by hand.
#ifndef VIEWER_EDIT_H
#define VIEWER_EDIT_H

#include "plan/view.h"

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

#endif
