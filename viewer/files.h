/// Settings that are kept between runs ($XDG_CONFIG_HOME/sightline/view.conf), and opening maps:
/// files near the open one and in maps/, dropped files, and the maps of a file that has several.
#ifndef VIEWER_FILES_H
#define VIEWER_FILES_H

#include "app.h"

// --- settings

/// Reads the settings. What cannot be read keeps its default.
void settings_load(app_state *app);
/// Writes the settings. A failure is not reported: the work does not depend on it.
void settings_save(app_state *app);

// --- maps at hand

/// Lists the files at hand, by name.
void shelf_fill(app_state *app, const char *beside);
void shelf_empty(app_state *app);
/// Lists files again, in place of the maps of one file.
void shelf_forget_maps(app_state *app);

/// Opens a file in the background, with those of the app's options that its format takes. If the
/// file has several maps, shows them first. Cuts a 3D model in its middle if no height is given.
/// Reports a failure in the status line.
void shelf_open(app_state *app, const char *path);

/// The same for a source that must use all its options: fails if the format does not take one.
/// Shows several maps only if `ask` is set, and reports nothing.
sl_status shelf_open_source(app_state *app, const document_source *source, bool ask);

/// Opens the same file again with other options. The eye stays where it is.
void shelf_open_again(app_state *app, const sl_import_options *options);

/// The list that is shown: files, or the maps of one.
const sl_map_list *shelf_list(const map_shelf *shelf);
/// Opens a row of the list.
void shelf_choose(app_state *app, size_t row);
/// Moves to another row; stops at both ends.
void shelf_move(app_state *app, int by);

#endif
