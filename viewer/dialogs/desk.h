/// What dialogs work on: the document, its file, and the questions about both.
#ifndef VIEWER_DESK_H
#define VIEWER_DESK_H

#include "dialogs/dialog.h"
#include "document/save_job.h"
#include "document/session.h"

typedef enum pending_kind { PENDING_NONE, PENDING_QUIT, PENDING_NEW, PENDING_OPEN } pending_kind;

/// Zeroed, the map is in no file.
typedef struct file_state {
    char *path;     ///< what Save writes to; NULL: it asks for a name
    uint64_t saved; ///< the state of the map that the file has; UINT64_MAX: none
    bool recovered; ///< the map that is being opened is one that was never saved
    char *of;       ///< the file that it is of, then; NULL: none
    char *building; ///< whose storey is open; NULL: none

    size_t cameras;         ///< that no file has; the app says how many
    pending_kind pending;   ///< what waits until changes are saved or given up
    document_source source; ///< to be opened
    document_source tried;  ///< that was opened last

    save_job *job; ///< NULL: nothing is being saved
    bool locked;   ///< nothing may be written: events are random

    session copy;        ///< of unsaved changes
    uint64_t copy_state; ///< the state of the map that it has
    double copy_next;    ///< the clock's time of the next copy
    bool copies;         ///< whether copies are kept at all
    char *failed;        ///< the path that was not saved to; NULL: none
    session offer;       ///< an earlier one that is asked about
} file_state;

/// What is to be done with a path that was chosen: a table of cameras or of what
/// a tool has computed, a plan to compare with,
/// a picture, a sheet of paper, a folder of pictures.
typedef enum path_wish {
    WISH_NONE,
    WISH_READ_TABLE,
    WISH_WRITE_TABLE,
    WISH_WRITE_VALUES,
    WISH_COMPARE,
    WISH_PICTURE,
    WISH_SHEET,
    WISH_FRAMES
} path_wish;

enum { WISH_PATH = 4200 };

struct desk_state {
    sl_context *context;
    ui_state *ui;
    document_state *document;
    dialog_state dialog;
    file_state file;
    sl_import_options options; ///< the command line's, for files opened later too
    bool quit;
    path_wish wish; ///< these two: chosen in the browser; the app does it next
    char wish_path[WISH_PATH];
    void (*compare)(desk_state *desk, const char *path); ///< what a storey is chosen for
    const char *paper, *scale; ///< of the sheet that is printed next, as in sl_sheet
};

enum { TITLE_TEXT = 320 };

#endif
