/// The file of the map that is open: new, save, save as, and the question before changes are lost.
/// Maps are saved as map text (.map) or baked (.slv), in the background.
#ifndef VIEWER_MAP_FILE_H
#define VIEWER_MAP_FILE_H

#include "document/document.h"
#include "document/task.h"

typedef struct app_state app_state;

typedef enum pending_kind { PENDING_NONE, PENDING_QUIT, PENDING_NEW, PENDING_OPEN } pending_kind;

typedef struct save_job save_job;

/// Zeroed, the map is in no file.
typedef struct file_state {
    char *path;     ///< what Save writes to; NULL: it asks for a name
    uint64_t saved; ///< the state of the map that the file has; UINT64_MAX: none
    bool recovered; ///< the map that is being opened is one that was never saved
    char *of;       ///< the file that it is of, then; NULL: none

    pending_kind pending;   ///< what waits until changes are saved or given up
    document_source source; ///< to be opened
    document_source tried;  ///< that was opened last

    task *task; ///< NULL: nothing is being saved
    save_job *job;
    bool locked; ///< nothing may be written: events are random

    char *copy;          ///< recovery: the file of unsaved changes; NULL: none yet
    int lock;            ///< of it, open while we run
    uint64_t copy_state; ///< the state of the map that it has
    double copy_next;    ///< the clock's time of the next copy
    bool copies;         ///< whether copies are kept at all
    char *failed;        ///< the path that was not saved to; NULL: none
    char *offer;         ///< the copy of an earlier session that is asked about; NULL: none
    int offer_lock;
} file_state;

enum { TITLE_TEXT = 320 };

/// The name of the map: that of its file, or "Untitled".
void map_file_name(const app_state *app, char text[TITLE_TEXT]);
/// The window's title. A star leads a map with changes that are not saved.
void map_file_title(const app_state *app, char text[TITLE_TEXT]);

/// Whether there are changes that are not saved.
bool map_file_changed(const app_state *app);

// --- these ask first if changes would be lost

void map_file_new(app_state *app); ///< a frame of walls with a start in it
void map_file_quit(app_state *app);
void map_file_start(app_state *app, const document_source *source); ///< opens; copies the source

/// Gives changes up without a question.
void map_file_give_up(app_state *app);

void map_file_save(app_state *app);
/// Asks for a name.
void map_file_save_as(app_state *app);
/// Saves under a name, which becomes the map's. Without an ending it gets ".map". A failure gets a
/// dialog.
void map_file_save_to(app_state *app, const char *path);

/// A map was opened: its file is known from now on.
void map_file_taken(app_state *app);

/// Takes over what was saved. With `wait` it waits for it.
void map_file_tick(app_state *app, bool wait);

job_progress map_file_progress(const app_state *app);

/// Stops what is being saved; false where nothing is.
bool map_file_stop(app_state *app);

/// Stops what is being saved. Removes the copy for recovery: what is not saved was given up.
void map_file_destroy(app_state *app);

// --- for recovery.c

/// Starts to write a copy of the map. Nothing while something is being saved.
void map_file_copy_to(app_state *app, const char *path);
/// Starts with a map that was never saved; takes it over. `of` is its file, NULL for none.
void map_file_recover(app_state *app, sl_map *map, const char *of);

#endif
