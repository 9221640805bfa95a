/// Doors, shut and opened: at once, without a new bake.
#ifndef VIEWER_DOORS_H
#define VIEWER_DOORS_H

#include "app.h"

/// The door under a place of the plan; UINT32_MAX for none.
uint32_t sl_door_at(const sl_app *app, sl_point at);

/// Shuts a door that is open, and opens one that is shut.
void sl_door_toggle(sl_app *app, uint32_t door);

/// The door nearest to the eye.
void sl_door_toggle_nearest(sl_app *app);

#endif
