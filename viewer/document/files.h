/// What is kept between runs in $XDG_CONFIG_HOME/sightline: settings (view.conf) and the files
/// opened last (recent); and how a file is opened.
#ifndef VIEWER_FILES_H
#define VIEWER_FILES_H

#include "app/app.h"

// --- settings

/// Reads the settings. What cannot be read keeps its default.
void settings_load(app_state *app);
/// Writes the settings. A failure is not reported: the work does not depend on it.
void settings_save(app_state *app);

// --- recent files

/// Adds the files opened last to an empty list, the newest first.
sl_status recent_list(sl_context *context, sl_map_list *list);
/// Puts a file first.
void recent_add(app_state *app, const char *name);

// --- opening

enum { PATH_TEXT = 4096 };

/// The program's own folder in that of a variable ("XDG_STATE_HOME") or, where it is not set, of
/// the home folder (".local/state"). False where there is neither. Makes it if `make` is set.
bool files_folder(const char *variable, const char *beside_home, char path[PATH_TEXT], bool make);

/// Reads what kind of file the source is, and which choices it offers; a baked file offers none.
/// Cuts a 3D model in its middle if no height is given.
sl_status files_look(sl_context *context, document_source *source, sl_map_choice *choice);

/// Opens a file in the background, with those of the app's options that its format takes. A dialog
/// asks what the file leaves open (which of its maps, which layers are solid), and with `ask` for
/// all options. Changes that would be lost are asked about. A failure gets a dialog.
void files_open(app_state *app, const char *path, bool ask);

/// The same for a file that is dropped on the window: other dialogs go; a question stays, and the
/// file is not opened.
void files_drop(app_state *app, const char *path);

/// The same for a source that must use all its options: fails if the format does not take one.
/// Asks for what is left open only if `ask` is set. Reports nothing, and loses changes.
sl_status files_open_source(app_state *app, const document_source *source, bool ask);

/// Opens the same file again with other options. The eye stays where it is.
void files_open_again(app_state *app, const sl_import_options *options);

/// Shows a dialog with the message of a file that was not opened; nothing for SL_OK.
void files_check(app_state *app, const char *path, sl_status status);

#endif
