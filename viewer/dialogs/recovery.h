/// Copies of maps with unsaved changes (session.h): made every few seconds, removed once the
/// changes are saved or given up, and offered at the next start.
#ifndef VIEWER_RECOVERY_H
#define VIEWER_RECOVERY_H

#include "dialogs/desk.h"

/// Offers what an earlier run has left. Copies are kept from now on.
void recovery_begin(desk_state *desk);

/// Makes a copy if it is time and something has changed.
void recovery_tick(desk_state *desk);

#endif
