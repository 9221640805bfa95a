/// JSON is gathered in memory, and printed when the command has succeeded.
#include "reports/json_print.h"

#include "sightline/support.h"

#include <stdlib.h>
#include <string.h>

void text_make_readable(const char *text, char *out, size_t size) {
    snprintf(out, size, "%s", text);
    if (sl_text_is_utf8(text)) {
        size_t length = strlen(out);
        while ((text[length] & 0xc0) == 0x80) length--; // not within a character
        out[length] = '\0';
        return;
    }
    for (char *at = out; *at; at++)
        if ((unsigned char)*at >= 0x80) *at = '?';
}

static void append(void *user, const char *text, size_t size) {
    json_fields *fields = user;
    if (fields->size + size > fields->room) {
        const size_t room = 2 * (fields->size + size);
        char *grown = realloc(fields->text, room);
        fields->failed |= !grown;
        if (!grown) return;
        fields->text = grown;
        fields->room = room;
    }
    memcpy(fields->text + fields->size, text, size);
    fields->size += size;
}

/// The writer of fields that may have moved since it was used last.
static sl_json_writer *writer_of(json_fields *fields) {
    fields->writer.user = fields;
    return &fields->writer;
}

json_fields json_begin(void) {
    json_fields fields = {.writer.put = append};
    sl_json_put_object(writer_of(&fields));
    return fields;
}

void json_drop(json_fields *fields) {
    free(fields->text);
    *fields = (json_fields){0};
}

sl_json_writer *json_add(json_fields *fields, const char *key) {
    sl_json_writer *json = writer_of(fields);
    char readable[256];
    if (!sl_text_is_utf8(key)) {
        text_make_readable(key, readable, sizeof readable);
        key = readable;
    }
    sl_json_put_key(json, key);
    return json;
}

void json_add_count(json_fields *fields, const char *key, uint64_t count) {
    sl_json_put_integer(json_add(fields, key), (int64_t)count);
}

void json_add_real(json_fields *fields, const char *key, double finite) {
    sl_json_put_real(json_add(fields, key), finite);
}

void json_add_flag(json_fields *fields, const char *key, bool flag) {
    sl_json_put_flag(json_add(fields, key), flag);
}

void json_add_text(json_fields *fields, const char *key, const char *text) {
    sl_json_writer *json = json_add(fields, key);
    char readable[256];
    if (!text) {
        sl_json_put_null(json);
        return;
    }
    if (!sl_text_is_utf8(text)) {
        text_make_readable(text, readable, sizeof readable);
        text = readable;
    }
    sl_json_put_text(json, text);
}

void json_open(json_fields *fields, const char *key) {
    sl_json_put_object(json_add(fields, key));
}

void json_close(json_fields *fields) {
    sl_json_put_end(writer_of(fields), '}');
}

void json_open_list(json_fields *fields, const char *key) {
    sl_json_put_list(json_add(fields, key));
}

void json_open_item(json_fields *fields) {
    sl_json_put_object(writer_of(fields));
}

void json_close_list(json_fields *fields) {
    sl_json_put_end(writer_of(fields), ']');
}

void json_add_box(json_fields *fields, const char *key, sl_box box) {
    const double numbers[] = {box.min.x, box.min.y, box.max.x, box.max.y};
    sl_json_writer *json = json_add(fields, key);
    sl_json_put_list(json);
    for (int i = 0; i < 4; i++) sl_json_put_real(json, numbers[i]);
    sl_json_put_end(json, ']');
}

void json_add_members(json_fields *fields, const char *key, const uint64_t *set, uint32_t count) {
    sl_json_writer *json = json_add(fields, key);
    sl_json_put_list(json);
    for (uint32_t i = 0; i < count; i++)
        if (sl_bits_has(set, i)) sl_json_put_integer(json, i);
    sl_json_put_end(json, ']');
}

void json_add_points(json_fields *fields, const char *key, const sl_point *points, size_t count) {
    sl_json_writer *json = json_add(fields, key);
    sl_json_put_list(json);
    for (size_t i = 0; i < count; i++) {
        sl_json_put_list(json);
        sl_json_put_real(json, points[i].x);
        sl_json_put_real(json, points[i].y);
        sl_json_put_end(json, ']');
    }
    sl_json_put_end(json, ']');
}

void json_add_cleaning(json_fields *fields, const char *key, const sl_clean_account *account) {
    json_open(fields, key);
    json_add_count(fields, "before", account->before);
    json_add_count(fields, "after", account->after);
    json_add_count(fields, "zero_length", account->zero_length);
    json_add_count(fields, "duplicate", account->duplicate);
    json_add_count(fields, "merged", account->merged);
    json_add_count(fields, "split", account->split);
    json_add_count(fields, "welded", account->welded);
    json_add_count(fields, "crossings", account->crossings);
    json_add_real(fields, "largest_move", account->largest_move);
    json_close(fields);
}

sl_status json_print(sl_context *context, json_fields *fields) {
    json_close(fields);
    const bool failed = fields->failed || fields->writer.failed;
    sl_json_writer out = sl_json_writer_to(stdout, 2);
    // A write that fails shows when the program checks its stdout at the end.
    if (!failed) {
        sl_json_put_written(&out, fields->text, fields->size);
        putchar('\n');
    }
    json_drop(fields);
    return failed ? sl_fail_memory(context) : SL_OK;
}
