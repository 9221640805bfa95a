/// What a command printed of one plan, as cells. The command itself has written the text, so the
/// reader of JSON takes what the command's writer puts, and refuses the rest.
#include "inputs/number_table.h"
#include "reports/summary.h"
#include "studies/batch.h"
#include "studies/vga_table.h"

#include <math.h>
#include <string.h>

sl_status batch_row_add(sl_context *context, batch_row *row, const char *column, const char *text) {
    SL_TRY(SL_ARRAY_ROOM(context, &row->cells, 1));
    batch_cell cell = {sl_copy_text(context, column, strlen(column)),
                       sl_copy_text(context, text, strlen(text))};
    if (!cell.column || !cell.text) {
        sl_free(context, cell.column);
        sl_free(context, cell.text);
        return SL_NO_MEMORY;
    }
    row->cells.items[row->cells.count++] = cell;
    return SL_OK;
}

const char *batch_row_at(const batch_row *row, const char *column) {
    for (size_t i = 0; i < row->cells.count; i++)
        if (strcmp(row->cells.items[i].column, column) == 0) return row->cells.items[i].text;
    return NULL;
}

void batch_row_destroy(sl_context *context, batch_row *row) {
    for (size_t i = 0; i < row->cells.count; i++) {
        sl_free(context, row->cells.items[i].column);
        sl_free(context, row->cells.items[i].text);
    }
    sl_free(context, row->cells.items);
    *row = (batch_row){0};
}

// --- JSON

enum { NAME_MOST = 256, TEXT_MOST = 4096 };

typedef struct json_reader {
    sl_context *context;
    batch_row *row;
    const char *at, *end;
} json_reader;

static sl_status fail_json(sl_context *context) {
    return sl_fail(context, SL_BAD_INPUT, "the command has printed no JSON object");
}

static bool is_next(json_reader *r, char c) {
    while (r->at < r->end && strchr(" \t\r\n", *r->at) && *r->at) r->at++;
    return r->at < r->end && *r->at == c;
}

static bool take(json_reader *r, char c) {
    const bool there = is_next(r, c);
    r->at += there;
    return there;
}

/// A text in quotes; what is longer than `size` is cut. \u stands before control characters only.
static bool take_text(json_reader *r, char *text, size_t size) {
    static const char names[] = "bfnrt", meant[] = "\b\f\n\r\t";
    size_t used = 0;
    if (!take(r, '"')) return false;
    while (r->at < r->end && *r->at != '"') {
        char c = *r->at++;
        if (c == '\\' && r->at < r->end) {
            c = *r->at++;
            const char *name = strchr(names, c);
            if (c == 'u') {
                if (r->end - r->at < 4) return false;
                c = '?';
                r->at += 4;
            } else if (c && name) {
                c = meant[name - names];
            }
        }
        if (used + 1 < size) text[used++] = c;
    }
    text[used] = '\0';
    return take(r, '"');
}

static bool skip_list(json_reader *r) {
    char text[2];
    unsigned depth = 0;
    while (r->at < r->end) {
        if (is_next(r, '"')) {
            if (!take_text(r, text, sizeof text)) return false;
            continue;
        }
        if (r->at == r->end) return false;
        const char c = *r->at++;
        depth += c == '[' || c == '{';
        depth -= c == ']' || c == '}';
        if (!depth) return true;
    }
    return false;
}

/// A number, true, false or null: its shortest text.
static bool take_word(json_reader *r, char text[SL_NUMBER_TEXT]) {
    const char *from = r->at;
    while (r->at < r->end && !strchr(",]} \t\r\n", *r->at)) r->at++;
    const size_t length = (size_t)(r->at - from);
    double value;
    if (sl_number_read(from, length, &value) && isfinite(value)) {
        // Whole numbers of 64 bits stay as they are.
        if (memchr(from, '.', length) || memchr(from, 'e', length) || length >= SL_NUMBER_TEXT)
            sl_number_write(value, text);
        else
            snprintf(text, SL_NUMBER_TEXT, "%.*s", (int)length, from);
        return true;
    }
    const bool known = (length == 4 && (!memcmp(from, "true", 4) || !memcmp(from, "null", 4))) ||
                       (length == 5 && !memcmp(from, "false", 5));
    snprintf(text, SL_NUMBER_TEXT, "%.*s", known && *from != 'n' ? (int)length : 0, from);
    return known;
}

static sl_status take_members(json_reader *r, const char *outer);

static sl_status take_value(json_reader *r, const char *name) {
    char text[TEXT_MOST];
    if (is_next(r, '{')) return take_members(r, name);
    if (is_next(r, '[')) return skip_list(r) ? SL_OK : fail_json(r->context);
    const bool good = is_next(r, '"') ? take_text(r, text, sizeof text) : take_word(r, text);
    return good ? batch_row_add(r->context, r->row, name, text) : fail_json(r->context);
}

static sl_status take_members(json_reader *r, const char *outer) {
    if (!take(r, '{')) return fail_json(r->context);
    if (take(r, '}')) return SL_OK;
    do {
        char key[NAME_MOST], name[NAME_MOST];
        if (!take_text(r, key, sizeof key) || !take(r, ':')) return fail_json(r->context);
        const int length = snprintf(name, sizeof name, "%s%s%s", outer, *outer ? "." : "", key);
        if (length < 0 || length >= NAME_MOST) return fail_json(r->context);
        SL_TRY(take_value(r, name));
    } while (take(r, ','));
    return take(r, '}') ? SL_OK : fail_json(r->context);
}

sl_status batch_row_add_json(sl_context *context, batch_row *row, const char *text, size_t size) {
    json_reader r = {context, row, text, text + size};
    SL_TRY(take_members(&r, ""));
    is_next(&r, '\0');
    return r.at == r.end ? SL_OK : fail_json(context);
}

// --- tables

typedef struct table_column {
    const number_table *table;
    size_t number, parts; ///< `parts`: the column that says the part of each row; none of the table
} table_column;

/// The value of a row of the largest part, which is 1; of any row where there are no parts.
static double value_at(const void *of, size_t row) {
    const table_column *column = of;
    if (column->parts < column->table->columns &&
        number_table_at(column->table, row, column->parts) != 1)
        return NAN;
    return number_table_at(column->table, row, column->number);
}

static sl_status add_number(sl_context *context, batch_row *row, const char *column,
                            const char *after, double value) {
    char name[NAME_MOST], text[SL_NUMBER_TEXT] = "";
    snprintf(name, sizeof name, "%s%s", column, after);
    if (isfinite(value)) sl_number_write(value, text);
    return batch_row_add(context, row, name, text);
}

static sl_status add_parts(sl_context *context, batch_row *row, const number_table *table,
                           size_t parts) {
    double count = 0, largest = 0;
    for (size_t i = 0; i < table->rows; i++) {
        count = fmax(count, number_table_at(table, i, parts));
        largest += number_table_at(table, i, parts) == 1;
    }
    SL_TRY(add_number(context, row, "parts", "", count));
    return add_number(context, row, "largest_part_rows", "", largest);
}

/// Whether a column's figures are those of the largest part, as in the summary of `vga`.
static bool is_of_part(const char *name) {
    size_t count;
    sl_measures(SL_VGA, &count);
    const size_t measure = sl_measure_find(SL_VGA, name);
    return measure < count && vga_measure_is_of_part(measure);
}

static sl_status add_columns(sl_context *context, batch_row *row, const number_table *table) {
    const size_t parts = number_table_column(table, "part");
    SL_TRY(add_number(context, row, "rows", "", (double)table->rows));
    if (parts < table->columns) SL_TRY(add_parts(context, row, table, parts));
    for (size_t i = 0; i < table->columns; i++) {
        if (i == parts) continue;
        const table_column column = {table, i,
                                     is_of_part(table->names[i]) ? parts : table->columns};
        double mean = NAN, deviation = NAN;
        summary_mean(&(summary_values){value_at, &column, table->rows}, &mean, &deviation);
        SL_TRY(add_number(context, row, table->names[i], "_mean", mean));
        SL_TRY(add_number(context, row, table->names[i], "_deviation", deviation));
    }
    return SL_OK;
}

sl_status batch_row_add_table(sl_context *context, batch_row *row, const char *text, size_t size) {
    number_table table;
    SL_TRY(number_table_parse(context, "the command's table", text, size, &table));
    const sl_status status =
        table.names ? add_columns(context, row, &table)
                    : sl_fail(context, SL_BAD_INPUT, "the command has printed no table");
    number_table_destroy(context, &table);
    return status;
}
