/// Objects, moved by hand: the boxes of the map, each of which is seen or not, and blocks sight or
/// does not. Nothing is baked anew.
#ifndef VIEWER_OBJECTS_H
#define VIEWER_OBJECTS_H

#include "app.h"

/// The object whose border is under a place of the plan; UINT32_MAX for none.
uint32_t object_at(const app_state *app, sl_point at);

/// The pointer takes hold of what is under it; false where that is no object.
bool object_take(app_state *app, drag_state *drag);
/// Moves what it holds, by steps of the grid.
void object_move(app_state *app, drag_state *drag, sl_point now);
/// An object that did not block sight does, or the other way round.
void object_toggle(app_state *app, uint32_t object);

/// Those that are seen, those that block, and the one that is held.
void object_draw(app_state *app, const sl_frame *frame);

/// What there is to say of one.
void object_describe(const app_state *app, uint32_t object, char *text, size_t room);

#endif
