/// One JSON object on stdout, built field by field. Nothing but json_begin() begins what must be
/// printed or dropped: objects within the object are opened and closed in it.
#ifndef JSON_PRINT_H
#define JSON_PRINT_H

#include "sightline/json.h"
#include "sightline/map.h"

/// An object's fields, as they are written so far. A call that finds no memory fails the whole at
/// its end, so that no caller asks each time.
typedef struct json_fields {
    sl_json_writer writer;
    char *text;
    size_t size, room;
    bool failed;
} json_fields;

/// A copy of a text; of one that is no UTF-8, as names of files may be, with '?' for what is not
/// ASCII.
void text_make_readable(const char *text, char *out, size_t size);

json_fields json_begin(void);
/// Frees fields that are not printed.
void json_drop(json_fields *fields);

/// A field whose value the caller puts: lists and objects within it must be closed again.
sl_json_writer *json_add(json_fields *fields, const char *key);
void json_add_count(json_fields *fields, const char *key, uint64_t count);
void json_add_real(json_fields *fields, const char *key, double finite);
void json_add_flag(json_fields *fields, const char *key, bool flag);
/// NULL gives null. A text that is no UTF-8 is made readable.
void json_add_text(json_fields *fields, const char *key, const char *text);
/// [x0, y0, x1, y1]
void json_add_box(json_fields *fields, const char *key, sl_box box);
/// A list of the numbers below `count` whose bits are set: bit n % 64 of word n / 64.
void json_add_members(json_fields *fields, const char *key, const uint64_t *set, uint32_t count);
/// [[x, y], ...]
void json_add_points(json_fields *fields, const char *key, const sl_point *points, size_t count);
/// An object within the object: fields that are added before json_close() are its own.
void json_open(json_fields *fields, const char *key);
void json_close(json_fields *fields);
/// A list of objects: each is opened by json_open_item() and closed by json_close().
void json_open_list(json_fields *fields, const char *key);
void json_open_item(json_fields *fields);
void json_close_list(json_fields *fields);
void json_add_cleaning(json_fields *fields, const char *key, const sl_clean_account *account);

/// Prints the object on stdout and uses it up.
sl_status json_print(sl_context *context, json_fields *fields);

#endif
