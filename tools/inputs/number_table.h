/// Tables of numbers out of files: CSV, or with tabs or semicolons between the columns. The first
/// line decides what stands between them. With semicolons or tabs, numbers may have decimal commas.
#ifndef NUMBER_TABLE_H
#define NUMBER_TABLE_H

#include "sightline/support.h"

/// Rows of numbers. NAN stands for an empty field.
typedef struct number_table {
    const char *path;
    char **names;        ///< of the columns; NULL where the file has no line of names
    unsigned first_line; ///< the line of the names, or of the first row without them
    size_t columns, rows;
    unsigned *lines; ///< by row: its line in the file
    double *values;  ///< row after row
} number_table;

/// Reads a table, "-" from stdin. The first line may hold names. SL_BAD_INPUT, with file and line,
/// for a field that is neither empty nor a finite number, and for a row of another length. Where
/// the line of names differs from the first row, the names are at fault.
sl_status number_table_read(sl_context *context, const char *path, number_table *out);
/// As number_table_read, from memory. `path` is for messages.
sl_status number_table_parse(sl_context *context, const char *path, const char *text, size_t size,
                             number_table *out);

/// Whether the first line of a text is that of a table with so many columns or more, and not that
/// of a map. A 0 stands behind the text.
bool number_table_begins(const char *text, size_t size, size_t columns);

void number_table_destroy(sl_context *context, number_table *table);

/// The column of a name; `columns` for none.
size_t number_table_column(const number_table *table, const char *name);

static inline double number_table_at(const number_table *table, size_t row, size_t column) {
    return table->values[row * table->columns + column];
}

#endif
