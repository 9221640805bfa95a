/// The dialog that opens and saves files: a field for the path, with completion by Tab, and a list
/// of the folder, of the files opened last, or of the samples.
#ifndef VIEWER_BROWSER_H
#define VIEWER_BROWSER_H

#include "dialogs/desk.h"

typedef void browser_open_file(desk_state *desk, const char *path, bool ask);
typedef void browser_save_file(desk_state *desk, const char *path);

/// What is opened or saved. Frames are a new folder of pictures.
typedef enum browse_kind {
    BROWSE_MAPS,
    BROWSE_PLANS,
    BROWSE_TABLES,
    BROWSE_VALUES,
    BROWSE_PICTURES,
    BROWSE_SHEETS,
    BROWSE_FRAMES
} browse_kind;

/// `then` opens the map or table that is chosen; `ask`: all its options are to be asked for.
void browser_open(desk_state *desk, browse_kind kind, browser_open_file *then);
/// Asks for the path to save under. At first it has this name; pictures, sheets and frames get a
/// number where that is taken.
void browser_save(desk_state *desk, browse_kind kind, const char *name, browser_save_file *then);
/// Asks for the path to save the map under, with this one in the field.
void browser_save_to(desk_state *desk, const char *path, browser_save_file *then);

void browser_draw(desk_state *desk);
void browser_act(desk_state *desk, int id);
void browser_edited(desk_state *desk, int id);
bool browser_key(desk_state *desk, const char *key);
void browser_destroy(desk_state *desk);

#endif
