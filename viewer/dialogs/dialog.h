/// Dialogs: sheets over the window that take all keys and clicks, one over the other. Each kind is
/// a row of a table, which the app has: what draws it, and what its buttons do.
///
/// A sheet is drawn anew in each frame, by its widgets one after the other. The frame keeps their
/// places, numbers and order. Keys and clicks go by those of the last frame.
#ifndef VIEWER_DIALOG_H
#define VIEWER_DIALOG_H

#include "ui/ui.h"

/// What dialogs work on (desk.h).
typedef struct desk_state desk_state;

typedef enum dialog_kind {
    DIALOG_NONE,
    DIALOG_MENU,
    DIALOG_BROWSER,
    DIALOG_IMPORT,
    DIALOG_QUESTION,
    DIALOG_KINDS,
} dialog_kind;

/// Numbers of widgets that all dialogs share; a dialog's own begin at DIALOG_OWN and are below 256.
enum { DIALOG_CANCEL = 1, DIALOG_MAIN, DIALOG_OWN };

/// Where a list stands.
typedef struct dialog_list {
    size_t at;          ///< the row that is chosen; SIZE_MAX: none
    size_t first, page; ///< the first row that is shown, and how many are
    size_t count;
    bool acts;  ///< a click acts at once; else the second one on a row
    bool marks; ///< to act on a row marks it: Return does the main thing
} dialog_list;

typedef enum item_kind { ITEM_BUTTON, ITEM_CHECK, ITEM_FIELD, ITEM_LIST } item_kind;

typedef struct dialog_item {
    item_kind kind;
    int id;
    text_field *field;
    dialog_list *list;
    sl_box box;
} dialog_item;

enum { DIALOGS_MOST = 4, ITEMS_MOST = 40, ANSWERS_MOST = 8 };

/// A question, or a message where it has one answer.
typedef struct question_state {
    char title[96], text[2048];
    const char *answers[ANSWERS_MOST]; ///< a letter of the keyboard leads each: "S:Save"
    int count;
    void (*then)(desk_state *desk, int answer); ///< NULL: nothing
} question_state;

/// What a dialog is made of. Functions but `draw` and `act` may be NULL.
typedef struct dialog_row {
    void (*draw)(desk_state *desk);
    void (*act)(desk_state *desk, int id);          ///< a button, a check, a row twice
    void (*edited)(desk_state *desk, int id);       ///< a field, or the choice of a list
    bool (*key)(desk_state *desk, const char *key); ///< before all others; false: not its own
    void (*destroy)(desk_state *desk);              ///< at the end of the program
    int types_into; ///< the field that text goes to while no other one has the focus; 0: none
} dialog_row;

typedef struct dialog_state {
    desk_state *desk;
    ui_state *ui;
    const dialog_row *rows; ///< DIALOG_KINDS of them
    dialog_kind stack[DIALOGS_MOST];
    int focus[DIALOGS_MOST]; ///< the number of a widget
    int tab_from; ///< the widget that Tab goes on from, where it is not the one in focus; else 0
    question_state questions[DIALOGS_MOST];
    int depth;
    dialog_item items[ITEMS_MOST]; ///< of the last frame
    int item_count;
    char deaf[48];                 ///< the key that opened the dialog: its letter is no text
    char title[320], problem[512]; ///< as shown in the last frame
    double text;                   ///< the size of text outside of the sheet
    sl_box dock;                   ///< where a sheet may stand beside the plan
    bool beside;                   ///< the uppermost one does: clicks in the plan are not its own
    dialog_list menu;
    const char *chosen; ///< the action that the menu chose: the caller runs it; NULL: none
    struct browser_state *browser; ///< NULL: never opened
    struct import_state *import;   ///< likewise
} dialog_state;

/// The uppermost one.
dialog_kind dialog_open_now(const dialog_state *d);

void dialog_push(dialog_state *d, dialog_kind kind, int focus);
void dialog_pop(dialog_state *d);
/// Closes all but a question, which waits for its answer; false where there is one.
bool dialog_clear(dialog_state *d);
void dialog_destroy(dialog_state *d);

void dialog_draw(dialog_state *d);

/// Whether the uppermost one was not drawn yet: keys find no widgets in it.
bool dialog_is_unseen(const dialog_state *d);

// --- input: each is for an open dialog

void dialog_key(dialog_state *d, const char *key, bool down);
void dialog_text(dialog_state *d, const char *text);
void dialog_press(dialog_state *d, const hit_area *hit, sl_point at);
void dialog_wheel(dialog_state *d, double steps);

// --- for those that draw: sizes are in units of plain text, boxes in pixels

/// Begins a sheet. It is made to fit the window: text gets smaller where there is no room. Returns
/// the box below the title.
sl_box dialog_begin(dialog_state *d, double width, double height, const char *title);
/// The same for one that stands in `dock`, and leaves the plan in sight.
sl_box dialog_begin_beside(dialog_state *d, double width, double height, const char *title);
void dialog_end(dialog_state *d);

/// Says what is wrong, in lines up to the one at `at`; nothing for "".
void dialog_problem(dialog_state *d, sl_point at, double width, const char *text);
/// What it takes above its last line, in plain texts, where it is `width` of them wide.
double dialog_problem_height(dialog_state *d, double width, const char *text);

/// The height of a row of widgets, in units of plain text.
#define DIALOG_ROW 2.1

/// A button on a sheet.
typedef struct dialog_label {
    int id;
    const char *label;
} dialog_label;

/// Buttons side by side, the last one ending at x; returns where the first one begins.
double dialog_buttons(dialog_state *d, double x, double y, const dialog_label *buttons, int count);
/// How wide they are together.
double dialog_buttons_width(dialog_state *d, const dialog_label *buttons, int count);
/// A button without a ground, such as the head of a column.
void dialog_head(dialog_state *d, int id, sl_box box, const char *label);
void dialog_check(dialog_state *d, int id, sl_box row, const char *label, bool on);
void dialog_field(dialog_state *d, int id, sl_box box, text_field *field, const char *hint);
/// A frame for rows; says which are to be drawn: list->first up to list->first + list->page.
void dialog_list_frame(dialog_state *d, int id, sl_box box, dialog_list *list);
/// A row of the list that was begun last; returns its box.
sl_box dialog_list_row(dialog_state *d, int id, sl_box box, const dialog_list *list, size_t row);

/// Moves the choice of a list, and shows it.
void dialog_list_go(dialog_list *list, size_t row);

#endif
