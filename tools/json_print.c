#include "json_print.h"

#include "sightline/support.h"

#include <string.h>

void sl_text_make_readable(const char *text, char *out, size_t size) {
    json_t *value = json_string(text); // NULL for what is no UTF-8
    snprintf(out, size, "%s", text);
    // The copy may end within a character.
    if (!value || strlen(text) >= size)
        for (char *at = out; *at; at++)
            if ((unsigned char)*at >= 0x80) *at = '?';
    json_decref(value);
}

sl_json_fields sl_json_begin(void) {
    json_t *object = json_object();
    return (sl_json_fields){.object = object, .failed = !object};
}

static void add(sl_json_fields *fields, const char *key, json_t *value) {
    if (json_object_set_new(fields->object, key, value) != 0) fields->failed = true;
}

void sl_json_add_count(sl_json_fields *fields, const char *key, uint64_t count) {
    add(fields, key, json_integer((json_int_t)count));
}

void sl_json_add_real(sl_json_fields *fields, const char *key, double finite) {
    add(fields, key, json_real(finite));
}

void sl_json_add_flag(sl_json_fields *fields, const char *key, bool flag) {
    add(fields, key, json_boolean(flag));
}

void sl_json_add_text(sl_json_fields *fields, const char *key, const char *text) {
    json_t *value = text ? json_string(text) : json_null();
    if (!value) {
        char readable[256];
        sl_text_make_readable(text, readable, sizeof readable);
        value = json_string(readable);
    }
    add(fields, key, value);
}

void sl_json_add_list(sl_json_fields *fields, const char *key, sl_json_fields *items,
                      size_t count) {
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        if (items[i].failed || json_array_append_new(list, items[i].object) != 0)
            fields->failed = true;
        items[i] = (sl_json_fields){0};
    }
    add(fields, key, list);
}

void sl_json_add_box(sl_json_fields *fields, const char *key, sl_box box) {
    add(fields, key, json_pack("[f, f, f, f]", box.min.x, box.min.y, box.max.x, box.max.y));
}

void sl_json_add_members(sl_json_fields *fields, const char *key, const uint64_t *set,
                         uint32_t count) {
    json_t *list = json_array();
    for (uint32_t i = 0; i < count; i++)
        if (sl_bits_has(set, i) && json_array_append_new(list, json_integer(i)) != 0)
            fields->failed = true;
    add(fields, key, list);
}

void sl_json_add_points(sl_json_fields *fields, const char *key, const sl_point *points,
                        size_t count) {
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        if (json_array_append_new(list, json_pack("[f, f]", points[i].x, points[i].y)) != 0)
            fields->failed = true;
    add(fields, key, list);
}

void sl_json_add_fields(sl_json_fields *fields, const char *key, sl_json_fields *inner) {
    if (inner->failed) fields->failed = true;
    add(fields, key, inner->object);
    *inner = (sl_json_fields){0};
}

void sl_json_add_cleaning(sl_json_fields *fields, const char *key,
                          const sl_clean_account *account) {
    sl_json_fields cleaning = sl_json_begin();
    sl_json_add_count(&cleaning, "before", account->before);
    sl_json_add_count(&cleaning, "after", account->after);
    sl_json_add_count(&cleaning, "zero_length", account->zero_length);
    sl_json_add_count(&cleaning, "duplicate", account->duplicate);
    sl_json_add_count(&cleaning, "merged", account->merged);
    sl_json_add_count(&cleaning, "split", account->split);
    sl_json_add_count(&cleaning, "welded", account->welded);
    sl_json_add_count(&cleaning, "crossings", account->crossings);
    sl_json_add_real(&cleaning, "largest_move", account->largest_move);
    sl_json_add_fields(fields, key, &cleaning);
}

sl_status sl_json_print(sl_context *context, sl_json_fields *fields) {
    const bool failed = fields->failed;
    // A write that fails shows when the program checks its stdout at the end.
    if (!failed && json_dumpf(fields->object, stdout, JSON_INDENT(2)) == 0) putchar('\n');
    json_decref(fields->object);
    *fields = (sl_json_fields){0};
    return failed ? sl_fail_memory(context) : SL_OK;
}
