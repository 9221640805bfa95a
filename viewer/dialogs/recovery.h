/// Copies of maps with unsaved changes, in $XDG_STATE_HOME/sightline, for when the program ends
/// without saving: made every few seconds, removed once the changes are saved or given up, and
/// offered at the next start.
#ifndef VIEWER_RECOVERY_H
#define VIEWER_RECOVERY_H

#include "dialogs/desk.h"

/// Offers what an earlier run has left. Copies are kept from now on.
void recovery_begin(desk_state *desk);

/// Makes a copy if it is time and something has changed.
void recovery_tick(desk_state *desk);

/// Removes the copy: the changes are saved or given up.
void recovery_forget(desk_state *desk);

/// A copy was written, or not.
void recovery_take(desk_state *desk, sl_status status, uint64_t state);

#endif
