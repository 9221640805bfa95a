/// Names: the layers that a user asks for, the words that say what a thing is, the files that a
/// file names.
#ifndef SL_NAMES_H
#define SL_NAMES_H

#include "map/scan.h"
#include "sightline/support.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

// --- layers: names with commas between

/// The first name of a list that asks for large pieces only, in small letters.
#define SLI_LAYERS_LARGE "large"
/// Layers of an SVG drawing that has none of this name: the picture in it.
#define SLI_LAYERS_PICTURE "picture"

/// The next name of a list, moving `*list` behind it, without the blanks about it; false at the
/// end. Empty names are passed over.
static inline bool sli_layers_next(const char **list, sli_word *name) {
    while (**list) {
        const char *begin = *list, *end = begin + strcspn(begin, ",");
        *list = *end ? end + 1 : end;
        while (begin < end && *begin == ' ') begin++;
        while (end > begin && end[-1] == ' ') end--;
        *name = (sli_word){begin, (size_t)(end - begin)};
        if (name->length) return true;
    }
    return false;
}

/// Whether a layer of this name is in the list.
static inline bool sli_layers_have(const char *list, const char *layer) {
    for (sli_word name; sli_layers_next(&list, &name);)
        if (sli_word_is(name, layer)) return true;
    return false;
}

// --- layers with numbers: NAME takes all of a layer, or all layers of a group; NAME:28+33-35 the
// --- tiles or values of these numbers

/// Whether a word of the list is a layer's name, with numbers or without; `*numbers` gets them, of
/// no length for all.
bool sli_layers_name(sli_word word, const char *layer, sli_word *numbers);
/// The same for the first such word of a list.
bool sli_layers_ask(const char *list, const char *layer, sli_word *numbers);
/// Whether the numbers are written as they must be.
bool sli_numbers_good(sli_word numbers);
/// Whether a number is among them; any is among none.
bool sli_numbers_have(sli_word numbers, uint64_t number);
/// Writes the numbers, or all but the most frequent one, as they are asked for: "1+3-5"; "" for
/// none. What does not fit is left out. *most: how often the most frequent one is there.
sl_status sli_numbers_write(sl_context *context, const uint32_t *numbers, size_t count,
                            bool but_commonest, size_t *most, char *text, size_t size);

/// Names for a message: "walls, doors, ...". Zeroed, it is empty.
typedef struct sli_name_list {
    char text[512];
    bool full; ///< a name did not fit; those behind it are left out, too
} sli_name_list;

static inline void sli_name_list_add(sli_name_list *list, sli_word name) {
    const size_t used = strlen(list->text);
    if (list->full) return;
    list->full = used > sizeof list->text - 80;
    if (list->full)
        snprintf(list->text + used, sizeof list->text - used, ", ...");
    else
        snprintf(list->text + used, sizeof list->text - used, "%s%.60s", used ? ", " : "",
                 sli_show(name).text);
}

/// The list with `most` characters at most: what is longer is cut between two names, ", ...".
const char *sli_name_list_cut(sli_name_list *list, size_t most);

/// SL_BAD_ARGUMENT: a layer that is asked for is not in a file of this name.
static inline sl_status sli_fail_layer(sl_context *context, const char *file, sli_word name,
                                       const char *where, const sli_name_list *there) {
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: there is no layer '%s' in the %s; it has %s",
                   file, sli_show(name).text, where,
                   *there->text ? there->text : "none with a name");
}

/// SL_BAD_ARGUMENT where the list, which may be NULL, has a layer that is none of these.
sl_status sli_layers_check(sl_context *context, const char *name, const char *list,
                           const char *const *layers, size_t count);

// --- words for what stops sight

enum { SLI_LONGEST_WORD = 40 };

/// A word of a name, in small letters; empty for one too long to know.
typedef struct sli_name_word {
    char text[SLI_LONGEST_WORD];
    size_t length;
} sli_name_word;

/// The next word of the name; moves behind it. False at the end. Words are runs of letters, and end
/// before a capital that follows a small letter. All letters beyond ASCII are letters.
bool sli_word_next(const char **at, sli_name_word *word);
/// Whether the word is in the list. A plural with s or es counts too.
bool sli_word_in(const sli_name_word *word, const char *const *list, size_t count);
/// Whether the word begins as "collision" does in English or a language beside it, with letters
/// doubled or left out.
bool sli_word_is_collision(const sli_name_word *word);

/// Whether all words of the name are words for what is solid (wall, solid, collision, collider,
/// obstacle, block, barrier, impassable ..., Mauer, mur, muro, стена, 墙 ..., one or many; "no
/// walk") or for nothing in particular (layer, tile, object, group, map, area, shape, box, is ...),
/// one of the first at least: "Collision_Layer 2", "wallTiles", but not "wall_tops".
bool sli_says_solid(const char *name);
/// The same for a property that says the contrary: "walkable", "isPassable".
bool sli_says_walkable(const char *name);
/// Whether some word is one for what is solid: "wall_tops".
bool sli_mentions_solid(const char *name);

// --- words for starts and doors

/// Whether all words of the name are words for a viewpoint (player, spawn, start, entrance ...) or
/// for nothing in particular (point, position, marker ...), one of the first at least:
/// "Player_Spawn 2", but not "starting_room" or "enemy_spawn".
bool sli_says_start(const char *name);
/// The same where words of the place may stand beside them: "spawn_cellar" in cellar.tmx.
bool sli_says_start_at(const char *name, const char *place);

/// Whether the name is that of a door or gate: its last word says so ("KitchenDoor"), or its first
/// one and all others say what door ("door_left"), but not "door_key" or "trap door".
bool sli_says_door(const char *name);

typedef enum sli_door_state { SLI_DOOR_UNSAID, SLI_DOOR_OPEN, SLI_DOOR_SHUT } sli_door_state;

/// What the words say of a door: open, opened; closed, shut, locked (one of these is enough).
sli_door_state sli_says_state(const char *name);
/// For names of properties that are true or false, which have no other words: "open", "isLocked";
/// "door", "is_door".
sli_door_state sli_says_state_alone(const char *name);
bool sli_says_door_alone(const char *name);
/// "state", "door_status": a property whose value is a word, as in sli_says_state.
bool sli_says_state_by_word(const char *name);
/// Whether some word is that of a door: "wooden door of the hall", which is none by sli_says_door.
bool sli_mentions_door(const char *name);

// --- tilesets, levels and pictures in other files

/// Whether there is a plain file: a device may never end.
bool sli_beside_is_there(const char *path);

/// Reads such a file. `path` gets the path it was read from, bytes->data the bytes; sl_free is the
/// caller's for both. SL_BAD_INPUT, naming both files, where it cannot be read or is no plain file
/// of at most 2^30 bytes.
sl_status sli_beside_read(sl_context *context, const char *name, const char *relative, char **path,
                          sl_bytes *bytes);

// --- what a reader took and left out

/// A number of things, by their names in the singular and the plural.
typedef struct sli_tally {
    size_t count;
    const char *one, *several;
} sli_tally;

enum { SLI_TALLY_TEXT = 900 };

/// Writes "2 tiles, 1 object" after `lead`: the numbers that are not 0. Writes nothing, and no
/// lead, if all are.
const char *sli_tally_write(const char *lead, const sli_tally *items, size_t count,
                            char text[SLI_TALLY_TEXT]);

#endif
