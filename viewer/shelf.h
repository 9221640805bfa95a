/// Opening files: those at hand (beside the one that is open, in the present folder and its maps/),
/// those that are dropped, and which of its maps where a file has several.
#ifndef VIEWER_SHELF_H
#define VIEWER_SHELF_H

#include "app.h"

/// Lists the files at hand, by name.
void sl_shelf_fill(sl_app *app, const char *beside);
void sl_shelf_empty(sl_app *app);
/// The list is that of files again.
void sl_shelf_forget_maps(sl_app *app);

/// Opens a file with those of the app's options that its format has a use for, in the background;
/// asks first which of its maps, where it has several. A 3D model is cut in its middle where no
/// height is given. What is wrong is said in the status line.
void sl_shelf_open(sl_app *app, const char *path);

/// As that, for a source whose options are all meant: where the format has no use for one, it
/// fails. Asks only where `ask` is set, and says nothing.
sl_status sl_shelf_open_source(sl_app *app, const sl_document_source *source, bool ask);

/// The file that is open once more, with other options; the eye stays where it is.
void sl_shelf_open_again(sl_app *app, const sl_import_options *options);

/// What the list shows: files, or the maps of one.
const sl_map_list *sl_shelf_list(const sl_app *app);
/// Opens what stands in a row of it.
void sl_shelf_choose(sl_app *app, size_t row);
/// Moves to another row; stops at both ends.
void sl_shelf_move(sl_app *app, int by);

#endif
