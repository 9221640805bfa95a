/// Buildings of several plans (maps/FORMAT.md): one storey at a time is open.
#ifndef VIEWER_STOREYS_H
#define VIEWER_STOREYS_H

#include "dialogs/desk.h"

/// Whether a file is a building, by its ending.
bool storeys_is(const char *path);

/// Opens the only storey of a building, or asks which. SL_BAD_INPUT with file and line,
/// SL_BAD_ARGUMENT for no such file, SL_IO, SL_NO_MEMORY.
sl_status storeys_open(desk_state *desk, const char *path);

/// Asks for a storey of a building, to compare with. `take` as in browser_open(). Fails likewise.
sl_status storeys_compare(desk_state *desk, const char *path,
                          void (*take)(desk_state *desk, const char *path));

/// Asks for another storey of the building that is open.
void storeys_choose(desk_state *desk);

#endif
