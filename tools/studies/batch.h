/// A table with a row for each of many plans: what a command printed of it, and how the command
/// ended. A row is a list of cells, each with the name of its column, so that plans need not have
/// the same columns.
#ifndef BATCH_H
#define BATCH_H

#include "sightline/support.h"

typedef struct batch_cell {
    char *column, *text;
} batch_cell;

typedef struct batch_row {
    SL_ARRAY(batch_cell) cells; ///< none: the plan has not been run
} batch_row;

/// Adds a cell; both texts are copied.
sl_status batch_row_add(sl_context *context, batch_row *row, const char *column, const char *text);
/// NULL where the row has no such cell.
const char *batch_row_at(const batch_row *row, const char *column);
void batch_row_destroy(sl_context *context, batch_row *row);

/// Adds the cells of a JSON object that a command printed: a cell for each number, text and flag,
/// named "outer.inner" within objects. Null is blank. Lists are left out. SL_BAD_INPUT where the
/// text is no object.
sl_status batch_row_add_json(sl_context *context, batch_row *row, const char *text, size_t size);
/// Adds the cells of a table that a command printed: "rows", and NAME_mean and NAME_deviation of
/// each column. With a column "part", also "parts" and "largest_part_rows": then the figures of the
/// graph are those of the largest part. SL_BAD_INPUT where the text is no table of numbers.
sl_status batch_row_add_table(sl_context *context, batch_row *row, const char *text, size_t size);

/// Writes the rows that have cells as CSV (RFC 4180), "-" to stdout. Columns stand in the order in
/// which the rows first have them.
sl_status batch_write(sl_context *context, const batch_row *rows, size_t count, const char *path);
/// Reads such a table. The caller destroys the rows, and frees them. SL_BAD_INPUT, with file and
/// line, where it has no column `needed`, or a row of another length than the first line.
sl_status batch_read(sl_context *context, const char *path, const char *needed, batch_row **rows,
                     size_t *count);

#endif
