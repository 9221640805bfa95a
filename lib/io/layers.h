/// The layers that a user asks for: names with commas between.
#ifndef SL_IMPORT_LAYERS_H
#define SL_IMPORT_LAYERS_H

#include "map/scan.h"

/// The next name of a list, moving `*list` behind it, without the blanks about it; false at the
/// end. Empty names are passed over.
static inline bool sl_layers_next(const char **list, sl_word *name) {
    while (**list) {
        const char *begin = *list, *end = begin + strcspn(begin, ",");
        *list = *end ? end + 1 : end;
        while (begin < end && *begin == ' ') begin++;
        while (end > begin && end[-1] == ' ') end--;
        *name = (sl_word){begin, (size_t)(end - begin)};
        if (name->length) return true;
    }
    return false;
}

/// Whether a layer of this name is in the list.
static inline bool sl_layers_have(const char *list, const char *layer) {
    for (sl_word name; sl_layers_next(&list, &name);)
        if (sl_word_is(name, layer)) return true;
    return false;
}

#endif
