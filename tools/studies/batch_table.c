/// Tables of plans as CSV, written and read back.
#include "studies/batch.h"

#include "reports/fields.h"

#include <stdio.h>
#include <string.h>

// --- writing

typedef SL_ARRAY(const char *) name_list;

static sl_status list_columns(sl_context *context, const batch_row *rows, size_t count,
                              name_list *names) {
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < rows[i].cells.count; k++) {
            const char *name = rows[i].cells.items[k].column;
            size_t n = 0;
            while (n < names->count && strcmp(names->items[n], name) != 0) n++;
            if (n < names->count) continue;
            SL_TRY(SL_ARRAY_ROOM(context, names, 1));
            names->items[names->count++] = name;
        }
    }
    return SL_OK;
}

static void put_rows(FILE *out, const batch_row *rows, size_t count, const name_list *names) {
    for (size_t n = 0; n < names->count; n++)
        csv_put_text(out, names->items[n], n + 1 < names->count ? "," : "\n");
    for (size_t i = 0; i < count; i++) {
        for (size_t n = 0; rows[i].cells.count && n < names->count; n++) {
            const char *text = batch_row_at(&rows[i], names->items[n]);
            csv_put_text(out, text ? text : "", n + 1 < names->count ? "," : "\n");
        }
    }
}

sl_status batch_write(sl_context *context, const batch_row *rows, size_t count, const char *path) {
    name_list names = {0};
    sl_status status = list_columns(context, rows, count, &names);
    sl_output output;
    if (status == SL_OK) status = sl_output_open(context, path, &output);
    if (status == SL_OK) {
        put_rows(output.stream, rows, count, &names);
        status = sl_output_close(context, &output, SL_OK);
    }
    sl_free(context, names.items);
    return status;
}

// --- reading

/// The field that begins at *at, in place: without its quotes, a 0 behind it. *at moves to the next
/// field; *last: none follows on this line.
static char *take_field(char **at, bool *last) {
    char *from = *at, *to = from, *text = from;
    bool quoted = *from == '"';
    for (from += quoted; *from && (quoted || !strchr(",\n", *from)); from++) {
        if (quoted && *from == '"' && from[1] != '"') {
            quoted = false;
            continue;
        }
        if (quoted && *from == '"') from++;
        if (quoted || *from != '\r') *to++ = *from;
    }
    *last = *from != ',';
    *at = from + (*from != '\0');
    *to = '\0';
    return text;
}

typedef struct table_reader {
    sl_context *context;
    const char *path;
    name_list names;
    SL_ARRAY(batch_row) rows;
} table_reader;

static sl_status read_names(table_reader *r, char **at, const char *needed) {
    bool last = false, found = false;
    while (!last) {
        const char *name = take_field(at, &last);
        found |= strcmp(name, needed) == 0;
        SL_TRY(SL_ARRAY_ROOM(r->context, &r->names, 1));
        r->names.items[r->names.count++] = name;
    }
    if (found) return SL_OK;
    return sl_fail_at(r->context, r->path, 1, "no table of 'sightline batch': it has no column %s",
                      needed);
}

static sl_status read_row(table_reader *r, char **at, unsigned line) {
    SL_TRY(SL_ARRAY_ROOM(r->context, &r->rows, 1));
    batch_row *row = &r->rows.items[r->rows.count++];
    *row = (batch_row){0};
    bool last = false;
    size_t column = 0;
    for (; !last; column++) {
        const char *text = take_field(at, &last);
        if (column < r->names.count)
            SL_TRY(batch_row_add(r->context, row, r->names.items[column], text));
    }
    if (column == r->names.count) return SL_OK;
    return sl_fail_at(r->context, r->path, line, "%zu fields; the first line has %zu", column,
                      r->names.count);
}

sl_status batch_read(sl_context *context, const char *path, const char *needed, batch_row **rows,
                     size_t *count) {
    table_reader r = {.context = context, .path = path};
    sl_bytes file;
    SL_TRY(sl_file_read(context, path, &file));
    char *at = file.data;
    sl_status status = read_names(&r, &at, needed);
    for (unsigned line = 2; status == SL_OK && *at; line++) status = read_row(&r, &at, line);
    if (status != SL_OK) {
        for (size_t i = 0; i < r.rows.count; i++) batch_row_destroy(context, &r.rows.items[i]);
        sl_free(context, r.rows.items);
        r.rows.items = NULL;
        r.rows.count = 0;
    }
    sl_free(context, r.names.items);
    sl_free(context, file.data);
    *rows = r.rows.items;
    *count = r.rows.count;
    return status;
}
