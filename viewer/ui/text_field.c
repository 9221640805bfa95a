/// One line of text that is edited. The cursor is a place in bytes. It only steps over whole
/// characters: a byte 10xxxxxx is never the first one of a character.
#include "ui/text_field.h"

#include <string.h>

void field_set(text_field *field, const char *text) {
    *field = (text_field){.click_x = -1};
    field_insert(field, text);
}

static bool continues(char byte) {
    return ((unsigned char)byte & 0xc0) == 0x80;
}

static size_t before(const text_field *field, size_t at) {
    if (at) at--;
    while (at && continues(field->text[at])) at--;
    return at;
}

static size_t after(const text_field *field, size_t at) {
    if (field->text[at]) at++;
    while (continues(field->text[at])) at++;
    return at;
}

/// The length of the character that begins there; 0 where it is none.
static size_t character(const char *text) {
    const unsigned char first = (unsigned char)*text;
    const size_t length = first < 0x80   ? 1
                          : first < 0xc2 ? 0
                          : first < 0xe0 ? 2
                          : first < 0xf0 ? 3
                          : first < 0xf5 ? 4
                                         : 0;
    for (size_t i = 1; i < length; i++)
        if (!continues(text[i])) return 0;
    return first < 0x20 || first == 0x7f ? 0 : length;
}

void field_insert(text_field *field, const char *text) {
    size_t length = 0;
    if (field->chosen && character(text)) field_set(field, "");
    const size_t all = strlen(field->text);
    for (size_t next; (next = character(text + length)) > 0; length += next)
        if (all + length + next >= FIELD_TEXT) break;
    memmove(field->text + field->at + length, field->text + field->at, all - field->at + 1);
    memcpy(field->text + field->at, text, length);
    field->at += length;
}

static void erase(text_field *field, size_t from, size_t end) {
    memmove(field->text + from, field->text + end, strlen(field->text + end) + 1);
    field->at = from;
}

static size_t word_before(const text_field *field) {
    size_t at = field->at;
    if (at) at--;
    while (at && field->text[at - 1] != '/' && field->text[at - 1] != ' ') at--;
    return at;
}

bool field_key(text_field *field, const char *key, bool *changed) {
    const size_t at = field->at, all = strlen(field->text);
    const bool chosen = field->chosen;
    const bool erases = strcmp(key, "Backspace") == 0 || strcmp(key, "Delete") == 0;
    if ((chosen && erases) || strcmp(key, "Ctrl+U") == 0)
        erase(field, 0, all);
    else if (strcmp(key, "Left") == 0)
        field->at = before(field, at);
    else if (strcmp(key, "Right") == 0)
        field->at = after(field, at);
    else if (strcmp(key, "Home") == 0)
        field->at = 0;
    else if (strcmp(key, "End") == 0 || strcmp(key, "Ctrl+A") == 0)
        field->at = all;
    else if (strcmp(key, "Backspace") == 0)
        erase(field, before(field, at), at);
    else if (strcmp(key, "Delete") == 0)
        erase(field, at, after(field, at));
    else if (strcmp(key, "Ctrl+W") == 0)
        erase(field, word_before(field), at);
    else
        return false; // a letter comes as text too
    field->chosen = strcmp(key, "Ctrl+A") == 0 && all;
    *changed = strlen(field->text) != all;
    return true;
}
