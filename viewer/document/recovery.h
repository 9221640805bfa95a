/// Copies of maps with unsaved changes, in $XDG_STATE_HOME/sightline, for when the program ends
/// without saving: made every few seconds, removed once the changes are saved or given up, and
/// offered at the next start.
#ifndef VIEWER_RECOVERY_H
#define VIEWER_RECOVERY_H

#include "app/app.h"

/// Offers what an earlier run has left. Copies are kept from now on.
void recovery_begin(app_state *app);

/// Makes a copy if it is time and something has changed.
void recovery_tick(app_state *app);

/// Removes the copy: the changes are saved or given up.
void recovery_forget(app_state *app);

/// A copy was written, or not.
void recovery_take(app_state *app, sl_status status, uint64_t state);

#endif
