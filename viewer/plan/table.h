/// The table of what the tool at hand has computed: points, lines, corners of a path, areas. It is
/// sorted by a column; a row is chosen in it or in the plan.
#ifndef VIEWER_TABLE_H
#define VIEWER_TABLE_H

#include "plan/view.h"

enum { TABLE_NAME = 64 };

/// Where rows come from.
struct table_source {
    const char *noun; ///< of a row
    size_t (*rows)(const view_state *view);
    size_t (*columns)(const view_state *view);
    void (*name)(const view_state *view, size_t column, char text[TABLE_NAME]);
    double (*value)(const view_state *view, size_t row, size_t column); ///< NAN: none
    /// Where a row is in the plan; a point is a line without length.
    sl_segment (*place)(const view_state *view, size_t row);
    uint32_t (*stamp)(const view_state *view); ///< another one: values may be others
    /// The text of the first column, whose values sort as the texts do; NULL: it has numbers.
    const char *(*text)(const view_state *view, size_t row);
};

/// NULL: the tool at hand has nothing yet.
const table_source *table_source_now(const view_state *view);
/// Follows the tool and its values.
void table_update(view_state *view);
/// The row at a place of the table.
size_t table_row(const table_state *table, size_t place);

/// Sorts by a column, largest first; once more: smallest first; then as the rows come.
void table_sort(view_state *view, size_t column);
/// Shows other columns.
void table_shift(view_state *view, int by);
/// Chooses a row, and shows its place in the plan if it is out of sight; SIZE_MAX: none.
void table_choose(view_state *view, size_t row);
/// Chooses the next row of the table, or one before.
void table_step(view_state *view, int by);
/// Chooses the row of a place in the plan that was clicked.
void table_pick(view_state *view, sl_point at);
/// Marks the chosen row in the plan.
void table_draw_chosen(const view_state *view, const sl_frame *frame);
/// Writes the table as CSV, in the order of the table.
sl_status table_write(view_state *view, const char *path);
void table_destroy(sl_context *context, table_state *table);

#endif
