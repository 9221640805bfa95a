/// Words in names that say what a thing is (solid, a start, a door), and files that a file names.
#include "io/parts/names.h"

#include "map/scan.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// --- words

static const char *const solid_words[] = {
    // English
    "wall",
    "solid",
    "collide",
    "collider",
    "collidable",
    "collideable",
    "obstacle",
    "block",
    "blocked",
    "blocking",
    "blocker",
    "occluder",
    "occlusion",
    "opaque",
    "impassable",
    "collides",
    "coll",
    "impassible",
    "unpassable",
    "unwalkable",
    "nonwalkable",
    "nowalk",
    "nopass",
    "barrier",
    "boundary",
    "boundaries",
    "boundry",
    "boundries",
    "bounds",
    // German, French, Spanish, Portuguese, Italian, Swedish, Polish
    "mauer",
    "mauern",
    "wände",
    "waende",
    "hindernis",
    "hindernisse",
    "mur",
    "solide",
    "solido",
    "sólido",
    "solida",
    "sólida",
    "obstaculo",
    "obstáculo",
    "muro",
    "pared",
    "paredes",
    "colisión",
    "parede",
    "colisao",
    "colisão",
    "colisoes",
    "colisões",
    "bloqueo",
    "muri",
    "muratura",
    "parete",
    "pareti",
    "ostacolo",
    "ostacoli",
    "vägg",
    "väggar",
    "ściana",
    "ściany",
    "sciana",
    "sciany",
    "kolizja",
    "kolizje",
    // Russian, Chinese, Japanese, Korean
    "стена",
    "стены",
    "коллизия",
    "коллизии",
    "препятствие",
    "препятствия",
    "墙",
    "墙壁",
    "墙体",
    "牆",
    "牆壁",
    "碰撞",
    "碰撞层",
    "障碍",
    "障碍物",
    "障碍层",
    "阻挡",
    "阻挡层",
    "壁",
    "障害物",
    "当たり判定",
    "벽",
    "충돌",
    "장애물",
};
static const char *const solid_neutral[] = {
    "layer", "tile",    "object",   "group", "map",    "area", "shape",  "box",
    "is",    "ge",      "has",      "ebene", "calque", "capa", "camada", "mask",
    "rect",  "polygon", "geometry", "est",   "ist",    "es",
};
/// "no walk", "not passable": the second word of what is solid.
static const char *const not_words[] = {"no", "non", "not", "un", "cannot", "cant"};
static const char *const walk_words[] = {"walk",        "walkable",    "walking",   "pass",
                                         "passable",    "passing",     "passage",   "passthrough",
                                         "traversable", "walkthrough", "accessible"};
static const char *const walk_neutral[] = {"is", "can", "tile", "be", "on", "through", "ge"};
static const char *const start_words[] = {"player",         "spawn",
                                          "start",          "starting",
                                          "entrance",       "hero",
                                          "playerstart",    "playerspawn",
                                          "playerpos",      "spawnpoint",
                                          "startpoint",     "startpos",
                                          "spawnpos",       "startposition",
                                          "playerposition", "playerspawnpoint",
                                          "spawnposition",  "playercharacter",
                                          "entry",          "entrypoint",
                                          "playerentry",    "startlayer",
                                          "protagonist"};
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

/// A byte of a letter beyond ASCII.
static bool is_other(char c) {
    return (unsigned char)c >= 0x80;
}

bool sli_word_in(const sli_name_word *word, const char *const *list, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const size_t stem = strlen(list[i]);
        if (word->length < stem || memcmp(word->text, list[i], stem) != 0) continue;
        const char *ending = word->text + stem;
        if (word->length == stem || strcmp(ending, "s") == 0 || strcmp(ending, "es") == 0)
            return true;
    }
    return false;
}
#define IS_ONE_OF(word, list) sli_word_in(word, list, COUNT(list))

/// Capitals of Latin-1 and Cyrillic in two bytes of UTF-8 become small letters.
static void make_small(char *text, size_t length) {
    for (size_t i = 0; i + 1 < length; i++) {
        unsigned char *two = (unsigned char *)text + i;
        if (two[0] == 0xc3 && two[1] >= 0x80 && two[1] <= 0x9e && two[1] != 0x97) two[1] += 0x20;
        if (two[0] == 0xd0 && two[1] >= 0x90 && two[1] <= 0x9f) two[1] += 0x20;
        if (two[0] == 0xd0 && two[1] >= 0xa0 && two[1] <= 0xaf) two[0]++, two[1] -= 0x20;
    }
}

bool sli_word_next(const char **at, sli_name_word *out) {
    *out = (sli_name_word){0};
    while (**at && !is_small(**at) && !is_capital(**at) && !is_other(**at)) ++*at;
    if (!**at) return false;
    const char *from = *at;
    size_t length = 0;
    for (; is_small(**at) || is_capital(**at) || is_other(**at); ++*at, length++) {
        if (*at > from && is_capital(**at) && is_small((*at)[-1])) break;
        if (length + 1 < SLI_LONGEST_WORD)
            out->text[length] = is_capital(**at) ? (char)(**at - 'A' + 'a') : **at;
    }
    if (length + 1 < SLI_LONGEST_WORD)
        out->length = length;
    else
        *out = (sli_name_word){0};
    make_small(out->text, out->length);
    return true;
}

/// Whether all words are in one of two lists, one in the first at least.
static bool says(const char *name, const char *const *first, size_t first_count,
                 const char *const *neutral, size_t neutral_count) {
    bool said = false;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        if (sli_word_in(&word, first, first_count))
            said = true;
        else if (!sli_word_in(&word, neutral, neutral_count))
            return false;
    }
    return said;
}

bool sli_word_is_collision(const sli_name_word *word) {
    const char *at = word->text;
    if ((*at != 'c' && *at != 'k') || at[1] != 'o' || at[2] != 'l') return false;
    for (at += 2; *at == 'l';) at++;
    if (at[0] != 'i' || at[1] != 's') return false;
    for (at++; *at == 's';) at++;
    at += *at == 'i';
    return at[0] == 'o' && at[1] == 'n';
}

static bool is_solid(const sli_name_word *word) {
    return IS_ONE_OF(word, solid_words) || sli_word_is_collision(word);
}

bool sli_says_solid(const char *name) {
    bool said = false, negated = false;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        if (!negated && IS_ONE_OF(&word, not_words)) {
            negated = true;
            continue;
        }
        if (negated != IS_ONE_OF(&word, walk_words)) return false;
        said |= negated || is_solid(&word);
        if (!negated && !is_solid(&word) && !IS_ONE_OF(&word, solid_neutral)) return false;
        negated = false;
    }
    return said && !negated;
}

bool sli_says_walkable(const char *name) {
    return says(name, walk_words, COUNT(walk_words), walk_neutral, COUNT(walk_neutral));
}

bool sli_mentions_solid(const char *name) {
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (is_solid(&word)) return true;
    return false;
}

bool sli_says_start(const char *name) {
    return says(name, start_words, COUNT(start_words), start_neutral, COUNT(start_neutral));
}

static bool has_word(const char *text, const sli_name_word *word) {
    for (sli_name_word own; sli_word_next(&text, &own);)
        if (strcmp(own.text, word->text) == 0) return true;
    return false;
}

bool sli_says_start_at(const char *name, const char *place) {
    bool said = false;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        if (IS_ONE_OF(&word, start_words))
            said = true;
        else if (!IS_ONE_OF(&word, start_neutral) && !has_word(place, &word))
            return false;
    }
    return said;
}

bool sli_says_door(const char *name) {
    bool first = true, leads = false, said = false;
    for (sli_name_word word; sli_word_next(&name, &word); first = false) {
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
    for (sli_name_word word; sli_word_next(&name, &word);)
        if (IS_ONE_OF(&word, door_words)) return true;
    return false;
}

bool sli_says_door_alone(const char *name) {
    return says(name, door_words, COUNT(door_words), state_neutral, COUNT(state_neutral));
}

sli_door_state sli_says_state(const char *name) {
    sli_door_state state = SLI_DOOR_UNSAID;
    for (sli_name_word word; sli_word_next(&name, &word);) {
        if (IS_ONE_OF(&word, shut_words)) return SLI_DOOR_SHUT;
        if (IS_ONE_OF(&word, open_words)) state = SLI_DOOR_OPEN;
    }
    return state;
}

// --- layers with numbers

bool sli_layers_name(sli_word word, const char *layer, sli_word *numbers) {
    const size_t length = strlen(layer);
    *numbers = (sli_word){word.at + word.length, 0};
    if (sli_word_is(word, layer)) return true;
    if (word.length <= length || word.at[length] != ':' || memcmp(word.at, layer, length) != 0)
        return false;
    *numbers = (sli_word){word.at + length + 1, word.length - length - 1};
    return true;
}

bool sli_layers_ask(const char *list, const char *layer, sli_word *numbers) {
    for (sli_word word; sli_layers_next(&list, &word);)
        if (sli_layers_name(word, layer, numbers)) return true;
    return false;
}

/// A number at the start of the word, cut off from it.
static bool next_number(sli_word *word, uint64_t *number) {
    size_t length = 0;
    for (*number = 0; length < word->length && *number <= UINT32_MAX; length++) {
        const char c = word->at[length];
        if (c < '0' || c > '9') break;
        *number = 10 * *number + (uint64_t)(c - '0');
    }
    *word = (sli_word){word->at + length, word->length - length};
    return length > 0 && *number <= UINT32_MAX;
}

/// The next "28" or "33-35" of numbers with + between; false at the end, and where there is none.
static bool next_range(sli_word *numbers, uint64_t *low, uint64_t *high) {
    if (!next_number(numbers, low)) return false;
    *high = *low;
    if (numbers->length && numbers->at[0] == '-') {
        *numbers = (sli_word){numbers->at + 1, numbers->length - 1};
        if (!next_number(numbers, high)) return false;
    }
    if (numbers->length && numbers->at[0] == '+')
        *numbers = (sli_word){numbers->at + 1, numbers->length - 1};
    else if (numbers->length)
        return false;
    return true;
}

bool sli_numbers_have(sli_word numbers, uint64_t number) {
    if (!numbers.length) return true;
    for (uint64_t low, high; numbers.length && next_range(&numbers, &low, &high);)
        if (number >= low && number <= high) return true;
    return false;
}

bool sli_numbers_good(sli_word numbers) {
    for (uint64_t low, high; numbers.length;)
        if (!next_range(&numbers, &low, &high)) return false;
    return true;
}

const char *sli_name_list_cut(sli_name_list *list, size_t most) {
    static const char end[] = ", ...";
    size_t at = most - strlen(end) + 1;
    if (strlen(list->text) <= most) return list->text;
    while (at && strncmp(list->text + at - 1, ", ", 2) != 0) at--;
    strcpy(list->text + (at ? at - 1 : 0), at ? end : "...");
    return list->text;
}

static int compare_numbers(const void *left, const void *right) {
    const uint32_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

/// The most frequent of sorted numbers, the lowest of those, and how often it is there.
static uint32_t find_commonest(const uint32_t *sorted, size_t count, size_t *most) {
    uint32_t commonest = 0;
    *most = 0;
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i; next < count && sorted[next] == sorted[i]; next++) continue;
        if (next - i <= *most) continue;
        *most = next - i;
        commonest = sorted[i];
    }
    return commonest;
}

sl_status sli_numbers_write(sl_context *context, const uint32_t *numbers, size_t count,
                            bool but_commonest, size_t *most, char *text, size_t size) {
    uint32_t *sorted = sl_alloc_array(context, count ? count : 1, sizeof *sorted);
    if (!sorted) return SL_NO_MEMORY;
    if (count) memcpy(sorted, numbers, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, compare_numbers);
    const uint32_t commonest = find_commonest(sorted, count, most);
    const uint64_t but = but_commonest ? commonest : UINT64_MAX;
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1;
             next < count && sorted[next] <= sorted[next - 1] + 1 && sorted[next] != but;)
            next++;
        if (sorted[i] == but) {
            for (next = i; next < count && sorted[next] == but;) next++;
            continue;
        }
        char own[40];
        const int length =
            snprintf(own, sizeof own, sorted[i] == sorted[next - 1] ? "%s%u" : "%s%u-%u",
                     used ? "+" : "", (unsigned)sorted[i], (unsigned)sorted[next - 1]);
        if (used + (size_t)length + 1 > size) break;
        memcpy(text + used, own, (size_t)length + 1);
        used += (size_t)length;
    }
    sl_free(context, sorted);
    return SL_OK;
}

// --- files beside a file

#define MOST_BYTES ((off_t)1 << 30)

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
    char *from = sli_beside_path(context, name, (sli_word){relative, strlen(relative)});
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

sl_status sli_layers_check(sl_context *context, const char *name, const char *list,
                           const char *const *layers, size_t count) {
    sli_name_list there = {0};
    for (size_t i = 0; i < count; i++)
        sli_name_list_add(&there, (sli_word){layers[i], strlen(layers[i])});
    for (sli_word word; list && sli_layers_next(&list, &word);) {
        bool known = false;
        for (size_t i = 0; i < count; i++) known |= sli_word_is(word, layers[i]);
        if (!known) return sli_fail_layer(context, name, word, "file", &there);
    }
    return SL_OK;
}
