/// Finds the scenes in files of Foundry.
///
/// A scene is a document with a list of walls. An adventure has a list of scenes. Up to version 10,
/// worlds and compendium packs were databases of NeDB (.db): a document a line; a later line with
/// the same _id replaces an earlier one, and a line with "$$deleted" removes it. Later versions
/// have folders of LevelDB, which are no text. Modules keep lists of scenes under a key of theirs.
#include "io/tabletop/scenes.h"

#include "map/scan.h"

#include <ctype.h>
#include <string.h>

// --- databases

/// A document of a line, as NeDB reads it. `all` has documents by their _id.
static int take_line(json_t *all, json_t *document, unsigned line) {
    char key[32];
    const char *id = json_string_value(json_object_get(document, "_id"));
    if (json_object_get(document, "$$indexCreated")) return 0;
    if (id && json_is_true(json_object_get(document, "$$deleted"))) {
        json_object_del(all, id);
        return 0;
    }
    snprintf(key, sizeof key, "line %u", line);
    if (json_object_set_new(document, SLI_JSON_LINE, json_integer(line))) return -1;
    return json_object_set(all, id ? id : key, document);
}

/// Reads a document a line. Lines that are none are counted, and passed over.
static sl_status read_lines(sli_scenes *scenes, const char *name, const char *text, size_t size) {
    sl_context *context = scenes->context;
    json_t *all = json_object();
    int failed = all ? 0 : -1;
    unsigned line = 0;
    sli_lines lines = sli_lines_of(text, size);
    for (sli_word word; !failed && sli_lines_next(&lines, &word);) {
        line++;
        if (sl_check_cancelled(context) != SL_OK) break;
        if (!sli_trimmed(word).length) continue;
        json_t *document = json_loadb(word.at, word.length, 0, NULL);
        if (json_is_object(document))
            failed = take_line(all, document, line);
        else if (!scenes->bad++)
            scenes->first_bad = line;
        json_decref(document);
    }
    scenes->file = (sli_json_file){.context = context, .name = name, .root = all};
    if (failed) return sl_fail_memory(context);
    return sl_check_cancelled(context);
}

void sli_scenes_tell(const sli_scenes *scenes) {
    const char *name = scenes->file.name;
    const size_t bad = scenes->bad, without = scenes->without;
    if (bad)
        sl_note(scenes->context, "%s:%u: no JSON object; %zu line%s left out", name,
                scenes->first_bad, bad, bad == 1 ? " is" : "s are");
    if (without)
        sl_note(scenes->context, "%s: %zu scene%s no walls and %s left out", name, without,
                without == 1 ? " has" : "s have", without == 1 ? "is" : "are");
}

/// Whether the first line is a JSON object by itself, and others follow.
static bool is_of_lines(const char *text, size_t size) {
    const char *begin = sli_skip_mark(text, size);
    const char *end = begin ? memchr(begin, '\n', size - (size_t)(begin - text)) : NULL;
    if (!end || (size_t)(end - text) + 1 >= size) return false;
    json_t *document = json_loadb(begin, (size_t)(end - begin), 0, NULL);
    const bool is = json_is_object(document);
    json_decref(document);
    return is;
}

// --- names

enum { NAME_MOST = 120, NAME_ROOM = NAME_MOST + 32 };

static void write_low(const char *name, size_t length, char low[NAME_ROOM]) {
    for (size_t i = 0; i < length; i++) low[i] = (char)tolower((unsigned char)name[i]);
    low[length] = '\0';
}

/// A name that no scene before has, in small letters or capitals: "Inn", "Inn:2". `names` says of
/// each the last number.
static sl_status choose_name(sli_scenes *scenes, const char *own, char **out) {
    char name[NAME_ROOM], base[NAME_ROOM], low[NAME_ROOM];
    size_t length = 0;
    for (; own[length] && length < NAME_MOST; length++)
        name[length] = (unsigned char)own[length] < ' ' || own[length] == 0x7f ? '?' : own[length];
    while (length && own[length] && ((unsigned char)own[length] & 0xc0) == 0x80) length--;
    if (!length) length = (size_t)snprintf(name, sizeof name, "scene");
    name[length] = '\0';
    write_low(name, length, base);
    memcpy(low, base, sizeof low);
    json_int_t number = 1;
    for (const json_t *taken; (taken = json_object_get(scenes->names, low)) != NULL;) {
        number = number == 1 ? json_integer_value(taken) + 1 : number + 1;
        snprintf(name + length, sizeof name - length, ":%lld", (long long)number);
        write_low(name, strlen(name), low);
    }
    if (json_object_set_new(scenes->names, low, json_integer(1)) ||
        (number > 1 && json_object_set_new(scenes->names, base, json_integer(number))))
        return sl_fail_memory(scenes->context);
    *out = sl_copy_text(scenes->context, name, strlen(name));
    return *out ? SL_OK : SL_NO_MEMORY;
}

// --- scenes

static sl_status take_scene(sli_scenes *scenes, json_t *json) {
    const char *name = json_string_value(json_object_get(json, "name"));
    SL_TRY(SL_ARRAY_ROOM(scenes->context, &scenes->items, 1));
    sli_scene scene = {.json = json};
    SL_TRY(choose_name(scenes, name ? name : "", &scene.name));
    scenes->items.items[scenes->items.count++] = scene;
    return SL_OK;
}

/// A document: a scene, an adventure, or something else.
static sl_status take_document(sli_scenes *scenes, json_t *document) {
    const json_t *walls = json_object_get(document, "walls");
    json_t *list = json_object_get(document, "scenes");
    if (json_array_size(walls)) return take_scene(scenes, document);
    scenes->without += json_is_array(walls);
    for (size_t i = 0; i < json_array_size(list); i++) {
        json_t *scene = json_array_get(list, i);
        if (json_array_size(json_object_get(scene, "walls")))
            SL_TRY(take_scene(scenes, scene));
        else
            scenes->without++;
    }
    return SL_OK;
}

/// SL_BAD_INPUT for a document without scenes: what it is, by what it has.
static sl_status refuse_document(const sli_scenes *scenes, const json_t *document) {
    static const struct {
        const char *key, *what;
    } kinds[] = {
        {"prototypeToken", "an actor"}, {"token", "an actor"},
        {"pages", "a journal"},         {"packs", "a list of what a module or a world holds"},
        {"results", "a table"},         {"sounds", "a playlist"},
        {"command", "a macro"},         {"cards", "a deck of cards"},
        {"system", "an item"},
    };
    const char *what = "a document";
    for (size_t i = sizeof kinds / sizeof *kinds; i-- > 0;)
        if (json_object_get(document, kinds[i].key)) what = kinds[i].what;
    return sl_fail_at(scenes->context, scenes->file.name, 0,
                      "%s of Foundry, no scene: in Foundry, right-click the scene and choose "
                      "Export Data",
                      what);
}

/// A scene without walls, but for one that Sightline has written.
static bool is_bare(const json_t *scene) {
    const json_t *flags = json_object_get(scene, "flags");
    const json_t *walls = json_object_get(scene, "walls");
    return json_object_get(scene, "padding") && json_is_array(walls) && !json_array_size(walls) &&
           !json_object_get(flags, "sightline");
}

/// The list of scenes under a key of a module's, of which one at least has walls; NULL for none.
static json_t *list_of_module(json_t *root) {
    const char *key;
    json_t *list;
    json_object_foreach(root, key, list) {
        for (size_t i = 0; i < json_array_size(list); i++) {
            const json_t *walls = json_object_get(json_array_get(list, i), "walls");
            if (json_object_get(json_array_get(walls, 0), "c")) return list;
        }
    }
    return NULL;
}

static sl_status take_root(sli_scenes *scenes, bool of_lines) {
    json_t *root = scenes->file.root, *document;
    json_t *list = list_of_module(root);
    if (json_object_get(root, "walls") || json_object_get(root, "scenes")) list = NULL;
    if (list) root = list;
    const json_t *first = json_array_get(root, 0);
    const char *key;
    size_t i;
    if (of_lines) {
        json_object_foreach(root, key, document) SL_TRY(take_document(scenes, document));
    } else if (list || json_object_get(first, "walls") || json_object_get(first, "scenes")) {
        json_array_foreach(root, i, document) SL_TRY(take_document(scenes, document));
    } else if (!json_is_array(json_object_get(root, "scenes")) || json_object_get(root, "walls")) {
        if (json_is_object(root) && !json_object_get(root, "walls") &&
            !json_object_get(root, "scenes"))
            return refuse_document(scenes, root);
        if (is_bare(root))
            return sl_fail_at(scenes->context, scenes->file.name, 0,
                              "the scene has no walls, so nothing is hidden in it");
        return take_scene(scenes, root);
    } else {
        SL_TRY(take_document(scenes, root));
    }
    if (scenes->items.count) return SL_OK;
    return sl_fail_at(scenes->context, scenes->file.name, 0,
                      scenes->without ? "none of its %zu scene%s has walls"
                                      : "it holds no scene with walls",
                      scenes->without, scenes->without == 1 ? "" : "s");
}

/// Files of a folder of LevelDB.
static sl_status fail_binary(sl_context *context, const char *name) {
    return sl_fail_at(context, name, 0,
                      "no text: packs and worlds of Foundry 11 and later are folders of LevelDB; "
                      "in Foundry, right-click the scene and choose Export Data, or unpack the "
                      "folder with Foundry's command fvtt (fvtt package unpack)");
}

sl_status sli_scenes_open(sl_context *context, const char *name, const char *text, size_t size,
                          sli_scenes *scenes) {
    *scenes = (sli_scenes){.context = context};
    if (memchr(text, '\0', size)) return fail_binary(context, name);
    const bool of_lines = is_of_lines(text, size);
    sl_status status = of_lines ? read_lines(scenes, name, text, size)
                                : sli_json_open(context, name, text, size, &scenes->file);
    if (status == SL_OK && !(scenes->names = json_object())) status = sl_fail_memory(context);
    if (status == SL_OK) status = take_root(scenes, of_lines);
    if (status != SL_OK) sli_scenes_close(scenes);
    return status;
}

void sli_scenes_close(sli_scenes *scenes) {
    for (size_t i = 0; i < scenes->items.count; i++)
        sl_free(scenes->context, scenes->items.items[i].name);
    sl_free(scenes->context, scenes->items.items);
    json_decref(scenes->names);
    sli_json_close(&scenes->file);
    *scenes = (sli_scenes){0};
}
