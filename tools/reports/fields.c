/// One list of fields, printed three ways.
#include "reports/fields.h"

#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

table_field field_text(const char *key, const char *text) {
    return (table_field){.key = key, .kind = text ? FIELD_TEXT : FIELD_NONE, .text = text};
}

table_field field_real(const char *key, double real) {
    return (table_field){.key = key, .kind = isnan(real) ? FIELD_NONE : FIELD_REAL, .real = real};
}

table_field field_count(const char *key, uint64_t count) {
    return (table_field){.key = key, .kind = FIELD_COUNT, .count = count};
}

// --- CSV

void csv_put(FILE *out, double value, const char *after) {
    char text[SL_NUMBER_TEXT] = "";
    if (!isnan(value)) sl_number_write(value, text);
    fputs(text, out);
    fputs(after, out);
}

void csv_put_text(FILE *out, const char *text, const char *after) {
    sl_table_text_write(out, text, false);
    fputs(after, out);
}

sl_status fields_put_csv(sl_context *context, const field_rows *rows, size_t first, size_t stop,
                         FILE *out) {
    table_field fields[FIELDS_MOST];
    for (size_t row = first; row < stop; row++) {
        const size_t count = rows->list(rows->of, row, fields);
        if (row % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        for (size_t i = 0; i < count && row == first; i++)
            fprintf(out, "%s%s", fields[i].key, i + 1 < count ? "," : "\n");
        for (size_t i = 0; i < count; i++) {
            const table_field *f = &fields[i];
            if (f->kind == FIELD_TEXT) csv_put_text(out, f->text, "");
            if (f->kind == FIELD_REAL) csv_put(out, f->real, "");
            if (f->kind == FIELD_COUNT) fprintf(out, "%" PRIu64, f->count);
            putc(i + 1 < count ? ',' : '\n', out);
        }
    }
    return SL_OK;
}

sl_status fields_write_csv(sl_context *context, const field_rows *rows, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output,
                           fields_put_csv(context, rows, 0, rows->count, output.stream));
}

// --- JSON

void fields_add_json(json_fields *json, const char *key, const field_rows *rows) {
    table_field fields[FIELDS_MOST];
    json_open_list(json, key);
    for (size_t row = 0; row < rows->count; row++) {
        const size_t count = rows->list(rows->of, row, fields);
        json_open_item(json);
        for (size_t i = 0; i < count; i++) {
            const table_field *f = &fields[i];
            if (f->kind == FIELD_REAL)
                json_add_real(json, f->key, f->real);
            else if (f->kind == FIELD_COUNT)
                json_add_count(json, f->key, f->count);
            else if (f->kind != FIELD_LEFT_OUT)
                json_add_text(json, f->key, f->kind == FIELD_TEXT ? f->text : NULL);
        }
        json_close(json);
    }
    json_close_list(json);
}

void fields_add_properties(sl_geojson_writer *out, const field_rows *rows, size_t row) {
    table_field fields[FIELDS_MOST];
    const size_t count = rows->list(rows->of, row, fields);
    for (size_t i = 0; i < count; i++)
        if (fields[i].kind == FIELD_COUNT)
            sl_geojson_add_count(out, fields[i].key, fields[i].count);
        else
            sl_geojson_add_real(out, fields[i].key, fields[i].real);
}

// --- words

void words_of(const char *name, char *text, size_t size) {
    snprintf(text, size, "%s", name);
    for (char *at = text; *at; at++)
        if (*at == '_') *at = ' ';
}
