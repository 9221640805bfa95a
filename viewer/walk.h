/// How the eye moves.
#ifndef VIEWER_WALK_H
#define VIEWER_WALK_H

#include "app.h"

/// Units of the map a second, by the size of its cells.
double sl_walk_speed(const sl_app *app);

/// Moves by the keys held. Walls stop a walking eye, by an exact test, and it slides along them.
void sl_walk(sl_app *app, double seconds);

/// Puts the eye at the map's first start, or into the middle of its largest cell that counts.
void sl_walk_home(sl_app *app);

#endif
