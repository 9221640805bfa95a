/// Words in names that say what a thing is (solid, a start, a door), and files that a file names.
#include "io/parts/names.h"

#include "map/scan.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

// --- words

#define LONGEST 24

static const char *const solid_words[] = {
    "wall",     "solid",     "collision", "collide",    "collider",
    "obstacle", "block",     "blocked",   "blocking",   "blocker",
    "occluder", "occlusion", "opaque",    "impassable", "collides",
};
static const char *const solid_neutral[] = {
    "layer", "tile", "object", "group", "map", "area", "shape", "box",
};
static const char *const start_words[] = {"player",           "spawn",         "start",
                                          "starting",         "entrance",      "hero",
                                          "playerstart",      "playerspawn",   "playerpos",
                                          "spawnpoint",       "startpoint",    "startpos",
                                          "spawnpos",         "startposition", "playerposition",
                                          "playerspawnpoint", "spawnposition", "playercharacter"};
static const char *const start_neutral[] = {
    "point",  "position", "pos",  "location", "loc",  "place", "marker",    "object",
    "entity", "tile",     "area", "zone",     "main", "here",  "character", "default",
};
static const char *const door_words[] = {"door", "gate", "doorway", "gateway"};
/// What may stand behind the word "door", as in "door_left".
static const char *const door_neutral[] = {
    "object", "tile",  "entity", "wood",   "wooden",   "iron",   "metal",  "steel",      "stone",
    "left",   "right", "top",    "bottom", "up",       "down",   "north",  "south",      "east",
    "west",   "front", "back",   "main",   "open",     "opened", "closed", "shut",       "locked",
    "secret", "small", "big",    "large",  "double",   "single", "side",   "horizontal", "vertical",
    "exit",   "inner", "outer",  "red",    "green",    "blue",   "yellow", "h",          "v",
    "hidden", "a",     "b",      "c",      "entrance",
};
/// Words before "door" with which it is no door in a wall.
static const char *const door_others[] = {"trap", "no",     "not", "fake",
                                          "to",   "behind", "at",  "near"};
static const char *const open_words[] = {"open", "opened"};
static const char *const shut_words[] = {"closed", "shut", "locked"};
#define COUNT(list) (sizeof(list) / sizeof *(list))

static bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}

static bool is_small(char c) {
    return c >= 'a' && c <= 'z';
}

/// A word of a name, in small letters; empty for one too long to know.
typedef struct name_word {
    char text[LONGEST];
    size_t length;
} name_word;

/// Whether a word is in the list. A plural with s or es counts too.
static bool in_list(const name_word *word, const char *const *list, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const size_t stem = strlen(list[i]);
        if (word->length < stem || memcmp(word->text, list[i], stem) != 0) continue;
        const char *ending = word->text + stem;
        if (word->length == stem || strcmp(ending, "s") == 0 || strcmp(ending, "es") == 0)
            return true;
    }
    return false;
}
#define IS_ONE_OF(word, list) in_list(word, list, COUNT(list))

/// The next word of the name; moves behind it. False at the end. A letter beyond ASCII gives an
/// empty word: its words are in no list.
static bool next_word(const char **at, name_word *out) {
    *out = (name_word){0};
    while (**at && !is_small(**at) && !is_capital(**at) && (unsigned char)**at < 0x80) ++*at;
    if (!**at) return false;
    const char *from = *at;
    size_t length = 0;
    for (; is_small(**at) || is_capital(**at); ++*at, length++) {
        if (*at > from && is_capital(**at) && is_small((*at)[-1])) break;
        if (length + 1 < LONGEST)
            out->text[length] = is_capital(**at) ? (char)(**at - 'A' + 'a') : **at;
    }
    if (!length) ++*at;
    if (length + 1 < LONGEST)
        out->length = length;
    else
        *out = (name_word){0};
    return true;
}

/// Whether all words are in one of two lists, one in the first at least.
static bool says(const char *name, const char *const *first, size_t first_count,
                 const char *const *neutral, size_t neutral_count) {
    bool said = false;
    for (name_word word; next_word(&name, &word);) {
        if (in_list(&word, first, first_count))
            said = true;
        else if (!in_list(&word, neutral, neutral_count))
            return false;
    }
    return said;
}

bool sli_says_solid(const char *name) {
    return says(name, solid_words, COUNT(solid_words), solid_neutral, COUNT(solid_neutral));
}

bool sli_says_start(const char *name) {
    return says(name, start_words, COUNT(start_words), start_neutral, COUNT(start_neutral));
}

bool sli_says_door(const char *name) {
    bool first = true, leads = false, said = false;
    for (name_word word; next_word(&name, &word); first = false) {
        if (IS_ONE_OF(&word, door_others)) return false;
        const bool door = IS_ONE_OF(&word, door_words);
        leads |= first && door;
        said = door || (leads && said && IS_ONE_OF(&word, door_neutral));
    }
    return said;
}

/// Words beside the state in a property's name, as in "is_open".
static const char *const state_neutral[] = {"is", "starts", "initially", "door", "gate"};

sli_door_state sli_says_state_alone(const char *name) {
    if (says(name, open_words, COUNT(open_words), state_neutral, COUNT(state_neutral)))
        return SLI_DOOR_OPEN;
    if (says(name, shut_words, COUNT(shut_words), state_neutral, COUNT(state_neutral)))
        return SLI_DOOR_SHUT;
    return SLI_DOOR_UNSAID;
}

bool sli_says_state_by_word(const char *name) {
    static const char *const words[] = {"state", "status"};
    return says(name, words, COUNT(words), state_neutral, COUNT(state_neutral));
}

bool sli_mentions_door(const char *name) {
    for (name_word word; next_word(&name, &word);)
        if (IS_ONE_OF(&word, door_words)) return true;
    return false;
}

bool sli_says_door_alone(const char *name) {
    return says(name, door_words, COUNT(door_words), state_neutral, COUNT(state_neutral));
}

sli_door_state sli_says_state(const char *name) {
    sli_door_state state = SLI_DOOR_UNSAID;
    for (name_word word; next_word(&name, &word);) {
        if (IS_ONE_OF(&word, shut_words)) return SLI_DOOR_SHUT;
        if (IS_ONE_OF(&word, open_words)) state = SLI_DOOR_OPEN;
    }
    return state;
}

// --- files beside a file

#define MOST_BYTES ((off_t)1 << 30)

char *sli_beside_path(sl_context *context, const char *name, const char *relative) {
    const size_t folder = relative[0] != '/' ? (size_t)(sl_path_name(name) - name) : 0;
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

const char *sli_tally_write(const char *lead, const sli_tally *items, size_t count,
                            char text[SLI_TALLY_TEXT]) {
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        if (!items[i].count || used >= SLI_TALLY_TEXT) continue;
        used +=
            (size_t)snprintf(text + used, SLI_TALLY_TEXT - used, "%s%zu %s", used ? ", " : lead,
                             items[i].count, items[i].count == 1 ? items[i].one : items[i].several);
    }
    return text;
}
