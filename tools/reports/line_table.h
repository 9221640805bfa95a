/// Tables of lines with measures: their files, a summary and a picture. `sightline axial` and
/// `sightline segments` share them.
#ifndef LINE_TABLE_H
#define LINE_TABLE_H

#include "inputs/inputs.h"
#include "sightline/draw.h"
#include "sightline/support.h"

enum { LINE_COLUMN_NAME = 96 };

/// A column: a value for each line; NAN for none.
typedef struct line_column {
    char name[LINE_COLUMN_NAME];
    size_t measure; ///< by its number in the table of measures
    double *values;
} line_column;

typedef struct line_table {
    const sl_segment *lines;
    uint32_t count;
    sl_earth earth;    ///< where the map lies (sl_map.earth)
    const char *unit;  ///< of lengths (sl_map.unit)
    const char *layer; ///< of the lines in a drawing
    SL_ARRAY(line_column) columns;
} line_table;

void line_table_destroy(sl_context *context, line_table *table);

/// Adds a column for each measure of an analysis. `values` has `size` bytes for each line. `radius`
/// is what the names of those that a radius limits end with: "_r3"; where it is not the first one
/// ("" or not), only those are added.
sl_status line_table_add(sl_context *context, line_table *table, sl_analysis analysis,
                         const void *values, size_t size, const char *radius);

/// The first column of a measure.
const line_column *line_table_column(const line_table *table, size_t measure);

/// GeoJSON or DXF where the name ends so, else CSV with the columns x1, y1, x2, y2 first. "-" is
/// stdout.
sl_status line_table_write(sl_context *context, const line_table *table, const char *path);

/// Prints mean and deviation of each column, and the ten highest values of one.
void line_table_print(const line_table *table, const char *what, const line_column *column);

/// Draws the lines in the colours of one column. `baked`: the plan under them; NULL for none.
sl_status line_table_draw(sl_context *context, const line_table *table, const line_column *column,
                          const sl_baked *baked, const char *input, const char *map,
                          const sl_draw_options *drawing, const char *path);

/// Whether a file holds drawn lines, by its name: .csv or .geojson.
bool lines_are_drawn(const char *path);

/// Lines as they are drawn: the walls of a map in any format, GeoJSON (.geojson), or a table with
/// the columns x1, y1, x2, y2 (.csv). "-" is stdin: a table or a map. Only `walls` of the map are
/// filled.
sl_status lines_read(sl_context *context, const char *path, const input_options *input,
                     sl_map *map);

#endif
