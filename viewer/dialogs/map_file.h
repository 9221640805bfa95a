/// The file of the map that is open: new, save, save as, and the question before changes are lost.
/// Maps are saved as map text (.map) or baked (.slv), in the background.
#ifndef VIEWER_MAP_FILE_H
#define VIEWER_MAP_FILE_H

#include "dialogs/desk.h"

/// The name of the map: that of its file, or "Untitled".
void map_file_name(const desk_state *desk, char text[TITLE_TEXT]);
/// A name for a file that is made of the map: "office.png" of office.map.
void map_file_name_output(const desk_state *desk, const char *ending, char text[TITLE_TEXT]);
/// The window's title. A star leads a map with changes that are not saved.
void map_file_title(const desk_state *desk, char text[TITLE_TEXT]);

/// Whether there are changes that are not saved.
bool map_file_changed(const desk_state *desk);

// --- these ask first if changes would be lost

void map_file_new(desk_state *desk); ///< a frame of walls with a start in it
void map_file_quit(desk_state *desk);
void map_file_start(desk_state *desk, const document_source *source); ///< opens; copies the source

/// The cameras were exported, or not: what waits for that goes on, or is given up.
void map_file_exported(desk_state *desk, bool done);

/// Gives changes up without a question.
void map_file_give_up(desk_state *desk);

void map_file_save(desk_state *desk);
/// Asks for a name.
void map_file_save_as(desk_state *desk);

/// A map was opened: its file is known from now on.
void map_file_taken(desk_state *desk);

/// Takes over what was saved. With `wait` it waits for it.
void map_file_tick(desk_state *desk, bool wait);

job_progress map_file_progress(const desk_state *desk);

/// Stops what is being saved; false where nothing is.
bool map_file_stop(desk_state *desk);

/// Stops what is being saved. Removes the copy for recovery: what is not saved was given up.
void map_file_destroy(desk_state *desk);

/// Shows a dialog with the message of a file that was not opened; nothing for SL_OK.
void map_file_check(desk_state *desk, const char *path, sl_status status);

// --- for recovery.c

/// Starts to write a copy of the map. Nothing while something is being saved.
void map_file_copy_to(desk_state *desk, const char *path);
/// Starts with a map that was never saved; takes it over. `of` is its file, NULL for none.
void map_file_recover(desk_state *desk, sl_map *map, const char *of);

#endif
