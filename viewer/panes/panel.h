/// What several panels have.
#ifndef VIEWER_PANEL_H
#define VIEWER_PANEL_H

#include "lessons/learn.h"
#include "plan/layers.h"
#include "ui/column.h"

/// A sample of a tone in a box, as it looks on a cell.
void legend_swatch(ui_state *ui, sl_box box, const legend_row *row);
/// What the plan shows, and how.
void column_legend(view_state *view, column *c);
/// The layers that belong to the present mode.
void column_layers(view_state *view, column *c);
/// The field of a name that is typed for what is chosen; false: none is.
bool column_name(const view_state *view, column *c);
/// Says what is under the pointer, or else under the eye. Returns whether it is the pointer.
bool pane_say_place(const view_state *view, char *text, size_t room);
/// The same as a part of the panel.
void pane_words(view_state *view, column *c);
/// Why the cell that was asked about is seen or not.
void pane_why(learn_state *learn, column *c);

#endif
