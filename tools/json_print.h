/// One JSON object on stdout, built field by field.
#ifndef JSON_PRINT_H
#define JSON_PRINT_H

#include "sightline/json_write.h"
#include "sightline/map.h"

/// An object's fields, as they are written so far. A call that finds no memory fails the whole at
/// its end, so that no caller asks each time.
typedef struct sl_json_fields {
    sl_json_writer writer;
    char *text;
    size_t size, room;
    bool failed;
} sl_json_fields;

/// A copy of a text; of one that is no UTF-8, as names of files may be, with '?' for what is not
/// ASCII.
void sl_text_make_readable(const char *text, char *out, size_t size);

sl_json_fields sl_json_begin(void);
/// Frees fields that are not printed or added to others.
void sl_json_drop(sl_json_fields *fields);

/// A field whose value the caller puts: lists and objects within it must be closed again.
sl_json_writer *sl_json_add(sl_json_fields *fields, const char *key);
void sl_json_add_count(sl_json_fields *fields, const char *key, uint64_t count);
void sl_json_add_real(sl_json_fields *fields, const char *key, double finite);
void sl_json_add_flag(sl_json_fields *fields, const char *key, bool flag);
/// NULL gives null. A text that is no UTF-8 is made readable.
void sl_json_add_text(sl_json_fields *fields, const char *key, const char *text);
/// [x0, y0, x1, y1]
void sl_json_add_box(sl_json_fields *fields, const char *key, sl_box box);
/// A list of the numbers below `count` whose bits are set: bit n % 64 of word n / 64.
void sl_json_add_members(sl_json_fields *fields, const char *key, const uint64_t *set,
                         uint32_t count);
/// [[x, y], ...]
void sl_json_add_points(sl_json_fields *fields, const char *key, const sl_point *points,
                        size_t count);
/// An object within the object; `inner` is used up.
void sl_json_add_fields(sl_json_fields *fields, const char *key, sl_json_fields *inner);
/// A list of such objects; all of them are used up.
void sl_json_add_list(sl_json_fields *fields, const char *key, sl_json_fields *items, size_t count);
void sl_json_add_cleaning(sl_json_fields *fields, const char *key, const sl_clean_account *account);

/// [x, y]
void sl_json_put_point(sl_json_writer *json, sl_point point);

/// Prints the object and uses it up.
sl_status sl_json_print(sl_context *context, sl_json_fields *fields);

#endif
