/// Objects, moved by hand: the boxes of the map, each of which is seen or not, and blocks sight or
/// does not. Nothing is baked anew.
#ifndef VIEWER_OBJECTS_H
#define VIEWER_OBJECTS_H

#include "app.h"

/// The object whose border is under a place of the plan; UINT32_MAX for none.
uint32_t sl_object_at(const sl_app *app, sl_point at);

/// The pointer takes hold of what is under it; false where that is no object.
bool sl_object_take(sl_app *app, sl_drag *drag);
/// Moves what it holds, by steps of the grid.
void sl_object_move(sl_app *app, sl_drag *drag, sl_point now);
/// An object that did not block sight does, or the other way round.
void sl_object_toggle(sl_app *app, uint32_t object);

/// Those that are seen, those that block, and the one that is held.
void sl_object_draw(sl_app *app, const sl_frame *frame);

/// What there is to say of one.
void sl_object_describe(const sl_app *app, uint32_t object, char *text, size_t room);

#endif
