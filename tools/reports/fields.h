/// Records of tables and reports: lists of fields, each with its key and value. They are printed as
/// lines of CSV, as members of JSON objects, or as properties of GeoJSON.
#ifndef FIELDS_H
#define FIELDS_H

#include "reports/json_print.h"
#include "sightline/json.h"

enum { FIELDS_MOST = 64 };

typedef struct table_field {
    const char *key;
    enum {
        FIELD_NONE,     ///< blank in CSV, null in JSON
        FIELD_LEFT_OUT, ///< blank in CSV, no member in JSON
        FIELD_TEXT,
        FIELD_REAL,
        FIELD_COUNT
    } kind;
    const char *text;
    double real;
    uint64_t count;
} table_field;

/// NULL: none.
table_field field_text(const char *key, const char *text);
/// NAN: none.
table_field field_real(const char *key, double real);
table_field field_count(const char *key, uint64_t count);

/// Rows of fields with the same keys.
typedef struct field_rows {
    /// Fills the fields of a row, and returns how many.
    size_t (*list)(const void *of, size_t row, table_field fields[FIELDS_MOST]);
    const void *of;
    size_t count;
} field_rows;

/// Writes the rows from `first` up to `stop`, without it. The line of keys comes before the first.
sl_status fields_put_csv(sl_context *context, const field_rows *rows, size_t first, size_t stop,
                         FILE *out);
/// Writes a table, "-" for stdout. Its first line has the keys.
sl_status fields_write_csv(sl_context *context, const field_rows *rows, const char *path);
/// A list of objects.
void fields_add_json(json_fields *json, const char *key, const field_rows *rows);
/// The fields of a row, to a feature that is begun.
void fields_add_properties(sl_geojson_writer *out, const field_rows *rows, size_t row);

/// A number of a table, nothing for NAN, and what comes behind it.
void csv_put(FILE *out, double value, const char *after);
/// A text of a table (sl_table_text_write), and what comes behind it.
void csv_put_text(FILE *out, const char *text, const char *after);

/// The name of a measure or a stage in words: "visual control".
void words_of(const char *name, char *text, size_t size);

#endif
