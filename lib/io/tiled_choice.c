#include "io/tiled_choice.h"

#include "io/layers.h"

/// Whether a word of the list is a layer's name, with its tiles or without.
static bool names(sl_word word, const char *layer, sl_word *gids) {
    const size_t length = strlen(layer);
    *gids = (sl_word){word.at + word.length, 0};
    if (sl_word_is(word, layer)) return true;
    if (word.length <= length || word.at[length] != ':' || memcmp(word.at, layer, length) != 0)
        return false;
    *gids = (sl_word){word.at + length + 1, word.length - length - 1};
    return true;
}

bool sl_tiled_asked_for(const char *list, const char *layer, sl_word *gids) {
    for (sl_word word; sl_layers_next(&list, &word);)
        if (names(word, layer, gids)) return true;
    return false;
}

/// A number at the start of the word, cut off from it.
static bool next_number(sl_word *word, uint64_t *number) {
    size_t length = 0;
    for (*number = 0; length < word->length && *number <= UINT32_MAX; length++) {
        const char c = word->at[length];
        if (c < '0' || c > '9') break;
        *number = 10 * *number + (uint64_t)(c - '0');
    }
    *word = (sl_word){word->at + length, word->length - length};
    return length > 0 && *number <= UINT32_MAX;
}

/// The next "28" or "33-35" of numbers with + between; false at the end, and where there is none.
static bool next_range(sl_word *gids, uint64_t *low, uint64_t *high) {
    if (!next_number(gids, low)) return false;
    *high = *low;
    if (gids->length && gids->at[0] == '-') {
        *gids = (sl_word){gids->at + 1, gids->length - 1};
        if (!next_number(gids, high)) return false;
    }
    if (gids->length && gids->at[0] == '+')
        *gids = (sl_word){gids->at + 1, gids->length - 1};
    else if (gids->length)
        return false;
    return true;
}

bool sl_tiled_among(sl_word gids, uint32_t gid) {
    if (!gids.length) return true;
    for (uint64_t low, high; gids.length && next_range(&gids, &low, &high);)
        if (gid >= low && gid <= high) return true;
    return false;
}

static bool are_numbers(sl_word gids) {
    for (uint64_t low, high; gids.length;)
        if (!next_range(&gids, &low, &high)) return false;
    return true;
}

/// Looks for a layer in a list of layers and in its groups.
static bool find_layer(const sl_json *layers, sl_word word, sl_word *gids) {
    for (size_t i = 0; i < json_array_size(layers->value); i++) {
        const sl_json layer = sl_json_item(layers, i), name = sl_json_member(&layer, "name");
        const sl_json inner = sl_json_member(&layer, "layers");
        const char *text = json_string_value(name.value);
        if (text && names(word, text, gids)) return true;
        if (find_layer(&inner, word, gids)) return true;
    }
    return false;
}

sl_status sl_tiled_check_choice(const sl_json *map, const char *list) {
    const sl_json layers = sl_json_member(map, "layers");
    for (sl_word word; list && sl_layers_next(&list, &word);) {
        sl_word gids;
        if (!find_layer(&layers, word, &gids))
            return sl_fail(map->file->context, SL_BAD_ARGUMENT, "%s: there is no layer '%s'",
                           map->file->name, sl_show(word).text);
        if (!are_numbers(gids))
            return sl_fail(map->file->context, SL_BAD_ARGUMENT,
                           "%s: layer '%s': expected tile numbers such as 28+33-35 behind the ':'",
                           map->file->name, sl_show(word).text);
    }
    return SL_OK;
}
