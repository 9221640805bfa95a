/// Files: settings that are remembered from one time to the next
/// ($XDG_CONFIG_HOME/sightline/view.conf), and opening maps: those at hand (beside the one that is
/// open, in the present folder and its maps/), those that are dropped, and which of its maps where
/// a file has several.
#ifndef VIEWER_FILES_H
#define VIEWER_FILES_H

#include "app.h"

// --- settings

/// Takes over what is remembered; what cannot be read is as if it had never been.
void settings_load(app_state *app);
/// Remembers. Where that fails nothing is said: it is no part of the work.
void settings_save(app_state *app);

// --- maps at hand

/// Lists the files at hand, by name.
void shelf_fill(app_state *app, const char *beside);
void shelf_empty(app_state *app);
/// The list is that of files again.
void shelf_forget_maps(app_state *app);

/// Opens a file with those of the app's options that its format has a use for, in the background;
/// asks first which of its maps, where it has several. A 3D model is cut in its middle where no
/// height is given. What is wrong is said in the status line.
void shelf_open(app_state *app, const char *path);

/// As that, for a source whose options are all meant: where the format has no use for one, it
/// fails. Asks only where `ask` is set, and says nothing.
sl_status shelf_open_source(app_state *app, const document_source *source, bool ask);

/// The file that is open once more, with other options; the eye stays where it is.
void shelf_open_again(app_state *app, const sl_import_options *options);

/// What the list shows: files, or the maps of one.
const sl_map_list *shelf_list(const map_shelf *shelf);
/// Opens what stands in a row of it.
void shelf_choose(app_state *app, size_t row);
/// Moves to another row; stops at both ends.
void shelf_move(app_state *app, int by);

#endif
