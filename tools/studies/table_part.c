/// Parts of tables, written and joined.
#include "studies/table_part.h"

#include "arguments/outputs.h"
#include "inputs/inputs.h"
#include "inputs/made_from.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- which part

sl_status share_read(sl_context *context, const char *text, uint32_t *part, uint32_t *count) {
    const char *slash = strchr(text, '/');
    char first[16];
    uint64_t k = 0, n = 0;
    const size_t length = slash ? (size_t)(slash - text) : 0;
    if (!slash || length >= sizeof first)
        return sl_fail(context, SL_BAD_ARGUMENT, "--shard %s: K/N is needed, as 1/8", text);
    memcpy(first, text, length);
    first[length] = '\0';
    SL_TRY(read_count(context, "--shard", first, UINT32_MAX, &k));
    SL_TRY(read_count(context, "--shard", slash + 1, UINT32_MAX, &n));
    if (!k || k > n)
        return sl_fail(context, SL_BAD_ARGUMENT, "--shard %s: K from 1 to N is needed", text);
    *part = (uint32_t)k;
    *count = (uint32_t)n;
    return SL_OK;
}

/// Whether an argument is one of the options that may differ between parts. *separate: its value is
/// the argument after it.
static bool may_differ(const char *argument, bool *separate) {
    static const char *const names[] = {"--shard", "--output", "--threads", "--quiet"};
    const size_t length = strcspn(argument, "=");
    *separate = strcmp(argument, "-o") == 0;
    if (strncmp(argument, "-o", 2) == 0 || strcmp(argument, "-q") == 0) return true;
    for (size_t i = 0; i < sizeof names / sizeof *names && length > 3; i++) {
        if (strncmp(argument, names[i], length) != 0) continue; // options may be cut short
        *separate = !argument[length] && i < 3;
        return true;
    }
    return false;
}

sl_status table_part_plan(sl_context *context, int argc, char **argv, const char *output,
                          table_part *part) {
    if (!part->text) return SL_OK;
    SL_TRY(share_read(context, part->text, &part->part, &part->count));
    if (output && strcmp(output, "-") != 0 && !output_has_ending(output, ".csv"))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--shard %s: -o %s: parts are tables that end in .csv", part->text, output);
    part->made_from = made_from_command(argv[0]);
    for (int i = 1; i < argc; i++) {
        bool separate;
        if (!may_differ(argv[i], &separate))
            SL_TRY(made_from_argument(context, argv[i], &part->made_from));
        else
            i += separate;
    }
    return SL_OK;
}

void table_part_rows(const table_part *part, size_t count, size_t *first, size_t *stop) {
    const uint64_t of = part->count ? part->count : 1, k = part->count ? part->part : 1;
    *first = (size_t)((uint64_t)count * (k - 1) / of);
    *stop = (size_t)((uint64_t)count * k / of);
}

// --- writing

enum { LINE_TEXT = 160 };

/// The lines around a part. `count`: rows of the whole table.
static void write_lines(const table_part *part, size_t count, char begin[LINE_TEXT],
                        char end[LINE_TEXT]) {
    size_t first, stop;
    table_part_rows(part, count, &first, &stop);
    snprintf(begin, LINE_TEXT,
             "# sightline part %" PRIu32 "/%" PRIu32
             ", rows %zu to %zu of %zu, made from k%016" PRIx64 "\n",
             part->part, part->count, first + 1, stop, count, part->made_from);
    snprintf(end, LINE_TEXT, "# end of part %" PRIu32 "/%" PRIu32 "\n", part->part, part->count);
}

static sl_status put_part(sl_context *context, const table_part *part, const field_rows *rows,
                          FILE *out) {
    char begin[LINE_TEXT], end[LINE_TEXT];
    size_t first, stop;
    table_part_rows(part, rows->count, &first, &stop);
    write_lines(part, rows->count, begin, end);
    fputs(begin, out);
    SL_TRY(fields_put_csv(context, rows, first, stop, out));
    fputs(end, out);
    return SL_OK;
}

sl_status table_part_write(sl_context *context, const table_part *part, const field_rows *rows,
                           const char *path) {
    if (!part || !part->count) return fields_write_csv(context, rows, path);
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    return sl_output_close(context, &output, put_part(context, part, rows, output.stream));
}

// --- joining

typedef struct read_part {
    const char *name;
    sl_bytes file;
    table_part is;
    size_t rows;                     ///< of the whole table
    const char *header, *body, *end; ///< the line of names; the rows; what follows them
} read_part;

static size_t line_length(const char *text) {
    const char *end = strchr(text, '\n');
    return end ? (size_t)(end - text) + 1 : strlen(text);
}

/// Takes a word and the number behind it.
static bool take(const char **at, const char *word, int base, uint64_t *number) {
    const char *digits = *at + strlen(word);
    char *end;
    if (strncmp(*at, word, strlen(word)) != 0) return false;
    *number = strtoull(digits, &end, base);
    *at = end;
    return end != digits;
}

/// Reads the numbers of a first line. The caller writes the line anew from them, and compares.
static bool take_begin(const char *text, read_part *p) {
    uint64_t part, count, first, last, rows;
    const bool good = take(&text, "# sightline part ", 10, &part) && take(&text, "/", 10, &count) &&
                      take(&text, ", rows ", 10, &first) && take(&text, " to ", 10, &last) &&
                      take(&text, " of ", 10, &rows) &&
                      take(&text, ", made from k", 16, &p->is.made_from);
    if (!good || !part || part > count || count > UINT32_MAX || rows > UINT32_MAX) return false;
    p->is.part = (uint32_t)part;
    p->is.count = (uint32_t)count;
    p->rows = (size_t)rows;
    return true;
}

/// Reads the lines around a part, and counts its rows.
static sl_status read_lines(sl_context *context, read_part *p) {
    const char *text = p->file.data;
    char begin[LINE_TEXT], end[LINE_TEXT];
    size_t first = 0, stop = 0, line = 2;
    table_part *is = &p->is;
    const bool good = take_begin(text, p);
    if (good) write_lines(is, p->rows, begin, end);
    if (!good || strncmp(text, begin, strlen(begin)) != 0)
        return sl_fail_at(context, p->name, 1,
                          "is no part of a table: 'sightline vga' and 'isovist' write them with "
                          "--shard K/N");
    table_part_rows(is, p->rows, &first, &stop);
    p->header = text + strlen(begin);
    p->body = stop > first ? p->header + line_length(p->header) : p->header;
    p->end = p->body;
    line += p->body > p->header;
    for (size_t row = first; row < stop && *p->end && *p->end != '#'; row++, line++)
        p->end += line_length(p->end);
    if (strcmp(p->end, end) == 0 && strlen(text) == p->file.size) return SL_OK;
    return sl_fail_at(context, p->name, (unsigned)line,
                      "part %" PRIu32 " of %" PRIu32 " is cut short or changed: expected %zu rows, "
                      "then '%.*s'; compute it again",
                      is->part, is->count, stop - first, (int)strlen(end) - 1, end);
}

/// Compares a part with the first one that was given.
static sl_status check_alike(sl_context *context, const read_part *p, const read_part *first) {
    if (p->is.count != first->is.count)
        return sl_fail_at(context, p->name, 1,
                          "is part %" PRIu32 " of %" PRIu32 ", but %s is one of %" PRIu32,
                          p->is.part, p->is.count, first->name, first->is.count);
    if (p->is.made_from != first->is.made_from || p->rows != first->rows)
        return sl_fail_at(context, p->name, 1,
                          "is of another map, of other options or another version than %s",
                          first->name);
    return SL_OK;
}

/// Puts the parts in order. `parts` are as given.
static sl_status order_parts(sl_context *context, const read_part *parts, uint32_t count,
                             const read_part **order) {
    const uint32_t needed = parts[0].is.count;
    for (uint32_t i = 0; i < count; i++) {
        const read_part *p = &parts[i];
        SL_TRY(check_alike(context, p, &parts[0]));
        for (uint32_t k = 0; k < i; k++)
            if (parts[k].is.part == p->is.part)
                return sl_fail_at(context, p->name, 1,
                                  "is part %" PRIu32 " of %" PRIu32 ", as is %s", p->is.part,
                                  needed, parts[k].name);
        order[i] = p;
        for (uint32_t k = i; k && order[k - 1]->is.part > p->is.part; k--) {
            order[k] = order[k - 1];
            order[k - 1] = p;
        }
    }
    uint32_t whole = 0; // so many from the first on
    while (whole < count && order[whole]->is.part == whole + 1) whole++;
    if (whole == needed) return SL_OK;
    return sl_fail(context, SL_BAD_INPUT,
                   "of %" PRIu32 " parts %" PRIu32 " %s given, part %" PRIu32 " is missing", needed,
                   count, count == 1 ? "is" : "are", whole + 1);
}

static void put_parts(const read_part *const *order, uint32_t count, FILE *out) {
    bool named = false;
    for (uint32_t i = 0; i < count; i++) {
        const char *from = named ? order[i]->body : order[i]->header;
        fwrite(from, 1, (size_t)(order[i]->end - from), out);
        named |= order[i]->body > order[i]->header;
    }
}

sl_status table_parts_merge(sl_context *context, const char *const *paths, uint32_t count,
                            const char *output) {
    read_part *parts = sl_alloc_array(context, count, sizeof *parts);
    const read_part **order = sl_alloc_array(context, count, sizeof *order);
    sl_status status = parts && order ? SL_OK : SL_NO_MEMORY;
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        sl_report(context, "read", "parts", i, count);
        parts[i].name = paths[i];
        status = sl_file_read(context, paths[i], &parts[i].file);
        if (status == SL_OK) status = read_lines(context, &parts[i]);
    }
    if (status == SL_OK) status = order_parts(context, parts, count, order);
    sl_output out;
    if (status == SL_OK) status = sl_output_open(context, output, &out);
    if (status == SL_OK) {
        put_parts(order, count, out.stream);
        status = sl_output_close(context, &out, SL_OK);
    }
    for (uint32_t i = 0; parts && i < count; i++) sl_free(context, parts[i].file.data);
    sl_free(context, parts);
    sl_free(context, order);
    return status;
}
