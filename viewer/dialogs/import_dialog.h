/// The dialog of how a file is read: which of its maps, which layers are solid, and all options of
/// its format, with what it does without them.
#ifndef VIEWER_IMPORT_DIALOG_H
#define VIEWER_IMPORT_DIALOG_H

#include "dialogs/desk.h"

/// The field of the filter of layers, which letters go to where no other field has the focus.
enum { IMPORT_TYPES_INTO = DIALOG_OWN };

/// Opens it. Copies the source, and takes the lists out of `choice`. Without `all` it shows what
/// the file leaves open, and the rest on demand. `then` opens it.
sl_status import_open(desk_state *desk, const document_source *source, sl_map_choice *choice,
                      bool all, void (*then)(desk_state *desk, const document_source *source));

/// A drawing's dialog stands beside the plan, this wide (plain texts), and the plan follows it.
enum { IMPORT_WIDE = 33 };
bool import_is_beside(const desk_state *desk); ///< now, or below a question
/// Shows there why the file could not be read; false where it is not open beside the plan.
bool import_take_failure(desk_state *desk, const char *message);

/// A click in the plan, at a place of the map. A line that is measured begins and ends at ends of
/// walls, where one is within `reach`.
void import_pick_at(desk_state *desk, sl_point at, double reach);
/// Whether the button in focus waits for a click in the plan: then arrows and Return are for the
/// plan, and Escape only ends the waiting.
bool import_picks(const desk_state *desk);
void import_stop_picking(desk_state *desk);

/// What is marked in the plan while the dialog is beside it.
typedef enum import_mark_kind {
    MARK_LEAK,
    MARK_CHOSEN,
    MARK_CLOSED,
    MARK_LINE,
    MARK_END
} import_mark_kind;
typedef struct import_mark {
    import_mark_kind kind;
    sl_segment at;
    double length;
} import_mark;
/// The mark of a number from 0 on; false: there is none.
bool import_mark_at(const desk_state *desk, size_t number, import_mark *out);

void import_draw(desk_state *desk);
void import_act(desk_state *desk, int id);
void import_edited(desk_state *desk, int id);
bool import_key(desk_state *desk, const char *key);
void import_destroy(desk_state *desk);

#endif
