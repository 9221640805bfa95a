/// Reads a table line by line: the first line may name the columns. What stands between its fields
/// is the separator of all lines.
#include "inputs/number_table.h"

#include <math.h>
#include <string.h>

typedef struct reader {
    sl_context *context;
    number_table *to;
    char separator;
    unsigned line;
    size_t row_room, value_room, value_count;
} reader;

void number_table_destroy(sl_context *context, number_table *table) {
    for (size_t i = 0; table->names && i < table->columns; i++) sl_free(context, table->names[i]);
    sl_free(context, table->names);
    sl_free(context, table->lines);
    sl_free(context, table->values);
    *table = (number_table){0};
}

size_t number_table_column(const number_table *table, const char *name) {
    size_t i = 0;
    while (i < table->columns && (!table->names || strcmp(table->names[i], name) != 0)) i++;
    return i;
}

/// A field without the blanks and quotes around it.
static size_t trim(const char **field, size_t length) {
    while (length && strchr(" \"", **field)) (*field)++, length--;
    while (length && strchr(" \"", (*field)[length - 1])) length--;
    return length;
}

/// The length of the field at the start of text[0 .. length).
static size_t field_length(char separator, const char *text, size_t length) {
    const char *end = memchr(text, separator, length);
    return end ? (size_t)(end - text) : length;
}

static size_t count_fields(char separator, const char *line, size_t length) {
    size_t count = 1;
    for (size_t i = 0; i < length; i++) count += line[i] == separator;
    return count;
}

/// A line whose first field is no number holds names.
static bool has_names(char separator, const char *line, size_t length) {
    double value;
    const char *first = line;
    const size_t wide = trim(&first, field_length(separator, line, length));
    return wide && !sl_table_number_read(separator, first, wide, &value);
}

static sl_status read_names(reader *r, const char *line, size_t length) {
    number_table *to = r->to;
    to->names = sl_alloc_array(r->context, to->columns, sizeof *to->names);
    if (!to->names) return SL_NO_MEMORY;
    for (size_t i = 0; i < to->columns; i++) {
        const size_t wide = field_length(r->separator, line, length);
        const char *field = line;
        const size_t trimmed = trim(&field, wide), taken = wide < length ? wide + 1 : wide;
        to->names[i] = sl_copy_text(r->context, field, trimmed);
        if (!to->names[i]) return SL_NO_MEMORY;
        line += taken;
        length -= taken;
    }
    return SL_OK;
}

static sl_status read_row(reader *r, const char *line, size_t length) {
    number_table *to = r->to;
    const size_t count = count_fields(r->separator, line, length);
    if (count != to->columns && !to->rows && to->names)
        return sl_fail_at(r->context, to->path, to->first_line,
                          "%zu name%s of columns; line %u has %zu column%s", to->columns,
                          to->columns == 1 ? "" : "s", r->line, count, count == 1 ? "" : "s");
    if (count != to->columns)
        return sl_fail_at(r->context, to->path, r->line, "%zu column%s; the first line has %zu",
                          count, count == 1 ? "" : "s", to->columns);
    SL_TRY(sl_reserve(r->context, &to->lines, &r->row_room, to->rows + 1, sizeof *to->lines));
    SL_TRY(sl_reserve(r->context, &to->values, &r->value_room, r->value_count + count,
                      sizeof *to->values));
    to->lines[to->rows++] = r->line;
    for (size_t i = 0; i < count; i++) {
        const size_t wide = field_length(r->separator, line, length);
        const char *field = line;
        const size_t trimmed = trim(&field, wide);
        double value = NAN;
        if (trimmed &&
            !(sl_table_number_read(r->separator, field, trimmed, &value) && isfinite(value)))
            return sl_fail_at(r->context, to->path, r->line, "column %zu is no finite number",
                              i + 1);
        to->values[r->value_count++] = value;
        line += wide < length ? wide + 1 : wide;
        length -= wide < length ? wide + 1 : wide;
    }
    return SL_OK;
}

/// The mark of UTF-8 that some spreadsheets write first.
static const char mark[] = {'\xef', '\xbb', '\xbf'};

static sl_status read_lines(reader *r, const char *text, size_t size) {
    number_table *to = r->to;
    const bool marked = size >= sizeof mark && memcmp(text, mark, sizeof mark) == 0;
    for (size_t at = marked ? sizeof mark : 0; at < size;) {
        const char *line = text + at, *end = memchr(line, '\n', size - at);
        size_t length = end ? (size_t)(end - line) : size - at;
        at += length + 1;
        r->line++;
        if (length && line[length - 1] == '\r') length--;
        if (!length || strspn(line, " \t,;") >= length) continue;
        if (memchr(line, '\0', length))
            return sl_fail_at(r->context, to->path, r->line,
                              "a NUL byte: expected a table as plain text (ASCII or UTF-8)");
        if (to->columns) {
            SL_TRY(read_row(r, line, length));
            continue;
        }
        r->separator = sl_table_separator(line, length);
        to->columns = count_fields(r->separator, line, length);
        to->first_line = r->line;
        SL_TRY(has_names(r->separator, line, length) ? read_names(r, line, length)
                                                     : read_row(r, line, length));
    }
    return SL_OK;
}

bool number_table_begins(const char *text, size_t size, size_t columns) {
    const size_t marked = size >= sizeof mark && memcmp(text, mark, sizeof mark) == 0 ? 3 : 0;
    const char *line = text + marked;
    const size_t length = strcspn(line, "\r\n");
    return length && !strchr("#{[<", *line) &&
           count_fields(sl_table_separator(line, length), line, length) >= columns;
}

sl_status number_table_parse(sl_context *context, const char *path, const char *text, size_t size,
                             number_table *out) {
    *out = (number_table){.path = path};
    reader r = {.context = context, .to = out};
    const sl_status status = read_lines(&r, text, size);
    if (status != SL_OK) number_table_destroy(context, out);
    return status;
}

sl_status number_table_read(sl_context *context, const char *path, number_table *out) {
    sl_bytes text;
    SL_TRY(sl_file_read(context, path, &text));
    const sl_status status = number_table_parse(context, path, text.data, text.size, out);
    sl_free(context, text.data);
    return status;
}
