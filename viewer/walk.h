/// How the eye moves.
#ifndef VIEWER_WALK_H
#define VIEWER_WALK_H

#include "app.h"

/// Units of the map a second, by the size of its cells.
double walk_speed(const app_state *app);

/// Moves by the keys held. Walls stop a walking eye, by an exact test, and it slides along them.
void walk_tick(app_state *app, double seconds);

/// Puts the eye at the map's first start, or into the middle of its largest cell that counts.
void walk_home(app_state *app);

#endif
