/// A drag through a large map: the walls that are held move in a world (sightline/world.h), and
/// what the eye sees follows in each frame. A bake of all cells would take longer than a frame.
#ifndef VIEWER_DRAG_WORLD_H
#define VIEWER_DRAG_WORLD_H

#include "plan/view.h"

/// Moves what is held to where the map has it now; begins with that where a drag has begun. False
/// where the map is small, or has something that worlds or this do not know: cells are made anew
/// then.
bool drag_world_step(view_state *view);
/// Takes the world over once it is made, with `wait` at once; and drops all once the document has
/// its cells.
void drag_world_update(view_state *view, bool wait);
/// Drops all, and shows the document as it is.
void drag_world_drop(view_state *view);

/// The query to the walls as they are now; NULL: the document's serves.
sl_query *drag_world_query(const view_state *view);
/// The walls beside those that are held, drawn like a scene of the document and in place of it;
/// NULL: that is right.
const sl_scene *drag_world_walls(view_state *view, const sl_scene *like);
/// Whether the world is being made: what is seen is not that of the map as it is now.
bool drag_world_is_late(const view_state *view);
/// Draws what is held.
void drag_world_draw(const view_state *view, const sl_frame *frame);

#endif
