/// What stands in a panel, one below the other: headings, paragraphs, rows, buttons, sliders.
#ifndef VIEWER_COLUMN_H
#define VIEWER_COLUMN_H

#include "ui/ui.h"

/// Where the next thing goes: between `left` and `right`, from `y` down.
typedef struct column {
    sl_box box; ///< of the panel
    double left, right, y;
} column;

column column_begin(ui_state *ui, sl_box box);
void column_end(ui_state *ui, const column *c);

double column_width(const column *c);
/// Whether the panel has no room for columns of numbers beside each other.
bool column_is_narrow(const ui_state *ui, const column *c);

/// `right` stands at its right end; NULL: nothing.
void column_heading(ui_state *ui, column *c, const char *text, const char *right);
/// A paragraph below what is there.
void column_words(ui_state *ui, column *c, double size, sl_colour colour, const char *text);
/// The row of a switch, with its key; `name` is an action's.
void column_check(ui_state *ui, column *c, const char *name);
/// A row with a colour (NULL: none), a label and a value at the right; the caller makes it a hit.
/// Returns its box.
sl_box column_row(ui_state *ui, column *c, const sl_colour *colour, const char *label,
                  const char *value, bool chosen);
/// A button from x on, or on the next line where it has no room. Returns where the next one begins.
double column_button(ui_state *ui, column *c, double x, const char *label, bool on, int action);
/// The buttons of actions, on as many lines as they need; the names end with NULL.
void column_buttons(ui_state *ui, column *c, const char *const *names);
/// The sliders that are shown now.
void column_sliders(ui_state *ui, column *c);

#endif
