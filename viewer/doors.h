/// Doors, shut and opened: at once, without a new bake.
#ifndef VIEWER_DOORS_H
#define VIEWER_DOORS_H

#include "app.h"

/// The door under a place of the plan; UINT32_MAX for none.
uint32_t door_at(const app_state *app, sl_point at);

/// Shuts a door that is open, and opens one that is shut.
void door_toggle(app_state *app, uint32_t door);

/// The door nearest to the eye.
void door_toggle_nearest(app_state *app);

#endif
