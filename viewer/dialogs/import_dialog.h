/// The dialog of how a file is read: which of its maps, which layers are solid, and all options of
/// its format, with what it does without them.
#ifndef VIEWER_IMPORT_DIALOG_H
#define VIEWER_IMPORT_DIALOG_H

#include "dialogs/desk.h"

/// Opens it. Copies the source, and takes the lists out of `choice`. Without `all` it shows what
/// the file leaves open, and the rest on demand. `then` opens it.
sl_status import_open(desk_state *desk, const document_source *source, sl_map_choice *choice,
                      bool all, void (*then)(desk_state *desk, const document_source *source));

void import_draw(desk_state *desk);
void import_act(desk_state *desk, int id);
void import_edited(desk_state *desk, int id);
void import_destroy(desk_state *desk);

#endif
