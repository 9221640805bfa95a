/// How a file is opened: what it leaves open is asked, and a failure gets a dialog.
#ifndef VIEWER_OPENING_H
#define VIEWER_OPENING_H

#include "dialogs/desk.h"

/// Opens a file in the background, with those of the app's options that its format takes. A dialog
/// asks what the file leaves open (which of its maps, which layers are solid), and with `ask` for
/// all options. Changes that would be lost are asked about. A failure gets a dialog.
void files_open(desk_state *desk, const char *path, bool ask);
/// The same for one that is no building (dialogs/storeys.h), but may be a storey of one.
void files_open_plan(desk_state *desk, const char *path, bool ask);

/// The same for a file that is dropped on the window: other dialogs go; a question stays, and the
/// file is not opened.
void files_drop(desk_state *desk, const char *path);

/// The same for a source that must use all its options: fails if the format does not take one.
/// Asks for what is left open only if `ask` is set. Reports nothing, and loses changes.
sl_status files_open_source(desk_state *desk, const document_source *source, bool ask);

/// Opens the same file again with other options. The eye stays where it is.
void files_open_again(desk_state *desk, const sl_import_options *options);

/// The dialog that opens files.
void files_browse(desk_state *desk);

/// The dialog of all options, for the file that is open.
void files_import_again(desk_state *desk);

/// The same for a drawing that was opened just now, of which nobody has said yet how to read it.
void files_ask_once(desk_state *desk);

#endif
