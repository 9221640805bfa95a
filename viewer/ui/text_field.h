/// One line of text that is edited: UTF-8, with a cursor.
#ifndef VIEWER_TEXT_FIELD_H
#define VIEWER_TEXT_FIELD_H

#include <stdbool.h>
#include <stddef.h>

enum { FIELD_TEXT = 4096 };

/// Zeroed, it is empty.
typedef struct text_field {
    char text[FIELD_TEXT];
    size_t at;      ///< the cursor, in bytes; always between two characters
    double shift;   ///< pixels that are out of sight at the left
    double click_x; ///< a click that the next frame turns into a cursor; negative: none
    bool clicked;
    bool chosen; ///< all of it, by Ctrl+A: what is typed replaces it
} text_field;

/// Replaces the text; the cursor goes to its end. Text that is too long is cut.
void field_set(text_field *field, const char *text);

/// Inserts text at the cursor, up to its first control character. Text that does not fit, or is no
/// UTF-8, is left out.
void field_insert(text_field *field, const char *text);

/// A key that edits or moves: Left, Right, Home, End, Backspace, Delete, Ctrl+A (chooses all),
/// Ctrl+U (empties), Ctrl+W (deletes back to the last '/' or space). False for any other key.
/// *changed: the text is another.
bool field_key(text_field *field, const char *key, bool *changed);

#endif
