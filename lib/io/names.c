/// Names that say "solid", and files that a file names.
#include "io/names.h"

#include "map/scan.h"

#include <errno.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>

// --- words

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

/// Whether a word, in small letters, is in the list. A plural with s or es counts too.
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

bool sli_says_solid(const char *name) {
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

// --- files beside a file

#define MOST_BYTES ((off_t)1 << 30)

char *sli_beside_path(sl_context *context, const char *name, const char *relative) {
    const char *slash = strrchr(name, '/');
    const size_t folder = slash && relative[0] != '/' ? (size_t)(slash + 1 - name) : 0;
    const size_t length = strlen(relative);
    char *path = sl_alloc(context, folder + length + 1);
    if (!path) return NULL;
    memcpy(path, name, folder);
    memcpy(path + folder, relative, length + 1);
    for (char *at = path + folder; *at; at++)
        if (*at == '\\') *at = '/';
    return path;
}

bool sli_beside_is_there(const char *path) {
    struct stat there;
    return stat(path, &there) == 0 && S_ISREG(there.st_mode);
}

static sl_status fail_beside(sl_context *context, const char *name, const char *path,
                             const char *why) {
    return sl_fail_at(context, name, 0, "it names the file %.200s: %s", path, why);
}

sl_status sli_beside_read(sl_context *context, const char *name, const char *relative, char **path,
                          sl_bytes *bytes) {
    char *from = sli_beside_path(context, name, relative);
    if (!from) return SL_NO_MEMORY;
    struct stat there;
    sl_status status = SL_OK;
    if (stat(from, &there) != 0)
        status = fail_beside(context, name, from, strerror(errno));
    else if (!S_ISREG(there.st_mode))
        status = fail_beside(context, name, from, "no plain file");
    else if (there.st_size > MOST_BYTES)
        status = fail_beside(context, name, from, "larger than 2^30 bytes");
    else
        status = sl_file_read(context, from, bytes);
    if (status == SL_OK)
        *path = from;
    else
        sl_free(context, from);
    return status;
}
