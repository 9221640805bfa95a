/// The dialog of how a file is read: which of its maps, which layers are solid, and all options of
/// its format, with what it does without them.
#ifndef VIEWER_IMPORT_DIALOG_H
#define VIEWER_IMPORT_DIALOG_H

#include "app/app.h"

/// Opens it. Copies the source, and takes the lists out of `choice`. Without `all` it shows what
/// the file leaves open, and the rest on demand.
sl_status import_open(app_state *app, const document_source *source, sl_map_choice *choice,
                      bool all);

/// Opens it for the file that is open.
void import_open_again(app_state *app);

void import_draw(app_state *app);
void import_act(app_state *app, int id);
void import_edited(app_state *app, int id);
void import_destroy(app_state *app);

#endif
