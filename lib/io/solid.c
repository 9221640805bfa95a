#include "io/solid.h"

#include <stddef.h>
#include <string.h>

static const char *const solid_words[] = {
    "wall",     "solid",     "collision", "collide",    "collider",
    "obstacle", "block",     "blocked",   "blocking",   "blocker",
    "occluder", "occlusion", "opaque",    "impassable", "collides",
};
static const char *const neutral_words[] = {
    "layer", "tile", "object", "group", "map", "area", "shape", "box",
};
#define COUNT(list) (sizeof(list) / sizeof *(list))

static bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}

static bool is_small(char c) {
    return c >= 'a' && c <= 'z';
}

/// Whether a word, in small letters, is in the list, as it is or with an s or es behind it.
static bool in_list(const char *word, size_t length, const char *const *list, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const size_t stem = strlen(list[i]);
        if (length < stem || memcmp(word, list[i], stem) != 0) continue;
        const char *ending = word + stem;
        if (length == stem || strcmp(ending, "s") == 0 || strcmp(ending, "es") == 0) return true;
    }
    return false;
}

/// The word that begins at `*at`, in small letters; moves behind it. 0 for one too long to know.
static size_t next_word(const char **at, char word[16]) {
    size_t length = 0;
    const char *from = *at;
    for (; is_small(**at) || is_capital(**at); ++*at) {
        if (*at > from && is_capital(**at) && is_small((*at)[-1])) break;
        if (length < 15) word[length] = is_capital(**at) ? (char)(**at - 'A' + 'a') : **at;
        length++;
    }
    word[length < 15 ? length : 0] = '\0';
    return length < 15 ? length : 0;
}

bool sl_says_solid(const char *name) {
    bool solid = false;
    while (*name) {
        if (!is_small(*name) && !is_capital(*name)) {
            // Letters beyond ASCII are of words that are not in the lists.
            if ((unsigned char)*name >= 0x80) return false;
            name++;
            continue;
        }
        char word[16];
        const size_t length = next_word(&name, word);
        if (in_list(word, length, solid_words, COUNT(solid_words)))
            solid = true;
        else if (!in_list(word, length, neutral_words, COUNT(neutral_words)))
            return false;
    }
    return solid;
}
