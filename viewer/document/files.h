/// What is kept between runs in $XDG_CONFIG_HOME/sightline, such as the files opened last (recent);
/// and what a file is.
#ifndef VIEWER_FILES_H
#define VIEWER_FILES_H

#include "document/document.h"

enum { PATH_TEXT = 4096 };

/// The name of a file without its folders.
const char *files_base(const char *path);
/// Whether a path ends so, in any case of letters.
bool files_end_in(const char *path, const char *ending);
/// Whether a map can be saved there: by the ending.
bool files_savable(const char *path);

/// Replaces a text by a copy of another one; NULL: none.
sl_status files_set_text(sl_context *context, char **to, const char *text);

/// The program's own folder in that of a variable ("XDG_STATE_HOME") or, where it is not set, of
/// the home folder (".local/state"). False where there is neither. Makes it if `make` is set.
bool files_folder(const char *variable, const char *beside_home, char path[PATH_TEXT], bool make);

/// The path of a file that is kept there. False without a home folder. Makes the folders if `make`
/// is set.
bool files_kept(const char *name, char path[PATH_TEXT], bool make);

// --- recent files

/// Adds the files opened last to an empty list, the newest first.
sl_status recent_list(sl_context *context, sl_map_list *list);
/// Puts a file first.
void recent_add(sl_context *context, const char *name);

// --- files

/// Reads what kind of file the source is, and which choices it offers; a baked file offers none.
/// Cuts a 3D model in its middle if no height is given.
sl_status files_look(sl_context *context, document_source *source, sl_map_choice *choice);

#endif
