/// The maps at hand: those beside the one that is open, and those of the present folder and its
/// maps/.
#ifndef VIEWER_SHELF_H
#define VIEWER_SHELF_H

#include "app.h"

/// Lists them into the app, by name.
void sl_shelf_fill(sl_app *app, const char *beside);

#endif
