/// What is told of a map of Tiled: what is solid in it and by what, and where nothing says it, the
/// layers and a command.
///
/// The command names a layer only where that is likely to be right: its name is one for what stands
/// in the way, or it is the only layer that may be walls, or most of it is one tile and the others
/// are walls. Else there is no command: a wrong one would be typed.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"

#include <strings.h>

/// Room for "+4294967295-4294967295": what does not fit is left out of a text of numbers.
enum { NUMBER_ROOM = 24 };

/// What to do about a layer whose name no command can have.
#define RENAME "give it a name in Tiled without commas, quotes and blanks at its ends"

/// Layers for a message: 'Ground' (2500 tiles), 'Things' (3 objects).
typedef struct layer_text {
    char text[400];
    size_t count, length;
} layer_text;

static void add_layer(layer_text *out, const sli_tiled_seen *layer) {
    char own[96];
    const char *what = layer->objects ? "object" : "tile";
    const int length =
        snprintf(own, sizeof own, "%s'%s' (%llu %s%s)", out->count++ ? ", " : "",
                 sli_show((sli_word){layer->name, strlen(layer->name)}).text,
                 (unsigned long long)layer->count, what, layer->count == 1 ? "" : "s");
    // Once a name does not fit, all later ones are left out too.
    if (out->length + (size_t)length + sizeof ", ..." > sizeof out->text) {
        if (out->length < sizeof out->text) strcpy(out->text + out->length, ", ...");
        out->length = sizeof out->text;
        return;
    }
    memcpy(out->text + out->length, own, (size_t)length + 1);
    out->length += (size_t)length;
}

/// The layers from which something is taken, or the others that have anything.
static layer_text list_layers(const sli_tiled_reader *reader, bool taken) {
    layer_text out = {.count = 0};
    for (size_t i = 0; i < reader->seen.count; i++)
        if (reader->seen.items[i].taken == taken && (taken || reader->seen.items[i].count))
            add_layer(&out, &reader->seen.items[i]);
    return out;
}

/// A layer of tiles that may be walls: not a picture or a floor.
static bool may_be_walls(const sli_tiled_seen *layer) {
    const bool open = layer->kind != SLI_GAME_UNSAID && layer->kind < SLI_GAME_WATER;
    return layer->count && *layer->name && !layer->objects && !open;
}

static bool is_full(const sli_tiled_seen *layer) {
    return layer->count == layer->squares;
}

/// The layer to name in an example: one that is named for what stands in the way, else the first
/// that may be walls and is not full, else a full one, else any.
static const sli_tiled_seen *find_example(const sli_tiled_reader *reader) {
    const sli_tiled_seen *best = NULL;
    int rank = -1;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (!layer->count || !*layer->name) continue;
        const int own = !may_be_walls(layer)            ? 0
                        : is_full(layer)                ? 1
                        : layer->kind < SLI_GAME_STANDS ? 2
                                                        : 3;
        if (own <= rank) continue;
        rank = own;
        best = layer;
    }
    return best;
}

/// Whether the example is likely to be right. `mostly`: it is full, and most of it is one tile;
/// `same`: what is full is all of one tile.
static bool is_sure(const sli_tiled_reader *reader, const sli_tiled_seen *example, bool mostly,
                    bool same) {
    size_t partial = 0, tiles = 0, things = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        tiles += !layer->objects && layer->count;
        things += layer->objects && layer->count;
        partial += may_be_walls(layer) && !is_full(layer);
    }
    if (example->objects) return !tiles || (same && things == 1);
    if (example->kind >= SLI_GAME_STANDS || mostly) return true;
    // Chests and beds that stand in rooms are not the rooms' walls, nor are those who walk there.
    const bool furniture = strncasecmp(example->name, "object", 6) == 0 ||
                           strncasecmp(example->name, "sprite", 6) == 0 ||
                           strncasecmp(example->name, "entit", 5) == 0 ||
                           sli_game_says_other(example->name);
    return partial == 1 && may_be_walls(example) && 2 * example->count <= example->squares &&
           !furniture;
}

static const sli_tiled_seen *find_objects(const sli_tiled_reader *reader) {
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->objects && layer->count && *layer->name) return layer;
    }
    return NULL;
}

/// Where a layer is full, all of it would be solid: its tiles but the most frequent one, as
/// ":28+33-35"; "" where there are none, or the layer has squares without tiles. *mostly: that one
/// covers three fifths of it.
static sl_status choose_tiles(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
                              bool *mostly, char *text, size_t size) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data");
    const size_t count = (size_t)seen->squares;
    uint32_t *gids;
    size_t most = 0;
    *text = '\0';
    *mostly = false;
    if (seen->objects || seen->count < seen->squares || !data.value) return SL_OK;
    SL_TRY(sli_tiled_read_data(&layer, &data, count, &gids));
    for (size_t i = 0; i < count; i++) gids[i] &= SLI_TILED_TILE;
    const sl_status status =
        sli_numbers_write(reader->context, gids, count, true, &most, text + 1, size - 1);
    sl_free(reader->context, gids);
    *mostly = 5 * most >= 3 * count;
    if (status == SL_OK && text[1]) *text = ':';
    return status;
}

/// Whether a square without a tile lies on both sides of a tile, or above and below it.
static bool is_thin(const uint32_t *gids, size_t count, size_t columns, size_t i) {
    const size_t x = i % columns;
    const bool left = x && (gids[i - 1] & SLI_TILED_TILE);
    const bool right = x + 1 < columns && (gids[i + 1] & SLI_TILED_TILE);
    const bool above = i >= columns && (gids[i - columns] & SLI_TILED_TILE);
    const bool below = i + columns < count && (gids[i + columns] & SLI_TILED_TILE);
    return (!left && !right) || (!above && !below);
}

/// Whether the layer with the most tiles covers less than a quarter of each side of the map and
/// from a twentieth to half of all, and is no thin lines, as walls are: its tiles may be the floor
/// of rooms, and the squares without tiles solid.
static sl_status looks_like_rooms(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
                                  bool *rooms) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data"), width = sli_json_member(&layer, "width");
    const size_t count = (size_t)seen->squares, columns = (size_t)sli_json_number_or_0(&width);
    uint32_t *gids;
    size_t sides[4] = {0}, thin = 0;
    *rooms = false;
    for (size_t i = 0; i < reader->seen.count; i++)
        if (!reader->seen.items[i].objects && reader->seen.items[i].count > seen->count)
            return SL_OK;
    if (seen->objects || 2 * seen->count > count || 20 * seen->count < count || !data.value ||
        !columns || count % columns)
        return SL_OK;
    SL_TRY(sli_tiled_read_data(&layer, &data, count, &gids));
    for (size_t i = 0; i < count; i++) {
        const size_t x = i % columns, y = i / columns;
        const bool tile = gids[i] & SLI_TILED_TILE;
        sides[0] += tile && y == 0;
        sides[1] += tile && i + columns >= count;
        sides[2] += tile && x == 0;
        sides[3] += tile && x + 1 == columns;
        thin += tile && is_thin(gids, count, columns, i);
    }
    sl_free(reader->context, gids);
    *rooms = 4 * sides[0] < columns && 4 * sides[1] < columns && 4 * sides[2] < count / columns &&
             4 * sides[3] < count / columns && 2 * thin < seen->count;
    return SL_OK;
}

/// Whether only one layer has anything.
static bool is_only_layer(const sli_tiled_reader *reader) {
    size_t count = 0;
    for (size_t i = 0; i < reader->seen.count; i++) count += reader->seen.items[i].count > 0;
    return count == 1;
}

/// Whether a layer's name can stand in a command: --layers has commas between names, and no blanks
/// at their ends.
static bool can_be_typed(const char *name) {
    const size_t length = strlen(name);
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)name[i] < ' ' || strchr("',\x7f", name[i])) return false;
    return length && length < 160 && name[0] != ' ' && name[length - 1] != ' ';
}

/// That only the picture shows which tiles of a layer are solid, and their numbers.
static sl_status say_tiles(const sli_tiled_reader *reader, const sli_tiled_seen *seen, char *text,
                           size_t size) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data");
    const size_t count = data.value ? (size_t)seen->squares : 0;
    uint32_t *gids = NULL;
    char numbers[120] = "";
    size_t most, used = 0;
    if (count) SL_TRY(sli_tiled_read_data(&layer, &data, count, &gids));
    for (size_t i = 0; i < count; i++)
        if (gids[i] & SLI_TILED_TILE) gids[used++] = gids[i] & SLI_TILED_TILE;
    const sl_status status =
        sli_numbers_write(reader->context, gids, used, false, &most, numbers, sizeof numbers);
    const bool all = strlen(numbers) + NUMBER_ROOM < sizeof numbers;
    sl_free(reader->context, gids);
    snprintf(text, size,
             "; which of the tiles %s%sof '%s' are solid, only its picture shows: a tile's number "
             "is its ID in Tiled + the tileset's firstgid",
             all ? numbers : "", all && *numbers ? " " : "",
             sli_show((sli_word){seen->name, strlen(seen->name)}).text);
    return status;
}

/// ", as in:" and a command that takes the example; or why there is none.
static sl_status say_example(const sli_tiled_reader *reader, const sli_tiled_seen *example,
                             char *text, size_t size) {
    const char *file = reader->map->file->name;
    char tiles[120];
    bool mostly;
    SL_TRY(choose_tiles(reader, example, &mostly, tiles, sizeof tiles));
    const bool same = !example->objects && example->count == example->squares && !*tiles;
    const sli_tiled_seen *objects = same ? find_objects(reader) : NULL;
    if (objects) example = objects;
    bool rooms;
    SL_TRY(looks_like_rooms(reader, example, &rooms));
    const char *name = example->name;
    const sli_shown shown = sli_show((sli_word){name, strlen(name)});
    if (same && !objects)
        snprintf(text, size, " (all tiles of '%s' are the same: draw walls in a layer Collision)",
                 shown.text);
    else if (rooms)
        snprintf(text, size,
                 ", void the squares without tiles, as in: sightline check '%.150s' --layers void "
                 "-o map.png",
                 file);
    else if (is_only_layer(reader) && !example->objects && 2 * example->count > example->squares &&
             !mostly)
        return say_tiles(reader, example, text, size);
    else if (!is_only_layer(reader) && !is_sure(reader, example, mostly, same))
        snprintf(text, size, "; no name says which one: look at them in Tiled");
    else if (!can_be_typed(name))
        snprintf(text, size, "; to take '%s', " RENAME, shown.text);
    else
        snprintf(text, size, ", as in: sightline check '%.150s' --layers '%s%s' -o map.png", file,
                 name, tiles);
    return SL_OK;
}

sl_status sli_tiled_fail_unsaid(const sli_tiled_reader *reader, const char *why) {
    const char *file = reader->map->file->name;
    const sli_tiled_seen *example = find_example(reader);
    const layer_text taken = list_layers(reader, true), others = list_layers(reader, false);
    const char *between = taken.count && others.count ? ", " : "";
    char as[560];
    if (!reader->seen.count) return sli_json_fail(reader->map, "%s; it has no layers", why);
    if (!example) return sli_json_fail(reader->map, "%s; all its layers are empty", why);
    SL_TRY(say_example(reader, example, as, sizeof as));
    return sl_fail_at(reader->context, file, sli_json_line(reader->map),
                      "%s; --layers NAME takes a layer as solid, NAME:28+33-35 tiles of it%s; "
                      "layers: %s%s%s",
                      why, as, taken.text, between, others.text);
}

sl_status sli_tiled_fail_no_walls(const sli_tiled_reader *reader) {
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (!layer->taken || layer->objects || !layer->count || layer->count < layer->squares)
            continue;
        const sli_word name = {layer->name, strlen(layer->name)};
        char tiles[120];
        bool mostly;
        SL_TRY(choose_tiles(reader, layer, &mostly, tiles, sizeof tiles));
        return sl_fail_at(reader->context, reader->map->file->name, sli_json_line(reader->map),
                          "layer '%s' has a tile on every square, so all is solid and there are no "
                          "walls; name its tiles that are solid, as in --layers '%s%s'%s",
                          sli_show(name).text, sli_show(name).text, *tiles ? tiles : ":28+33-35",
                          reader->options->layers
                              ? ", or leave --layers out: then the tiles that look solid are taken"
                              : "");
    }
    return sli_tiled_fail_unsaid(reader, "what it says is solid gives no walls");
}

// --- what is told

/// The tiles of a layer that say that they are solid, as ":28+33-35"; "" where they are too many,
/// or the layer lies in chunks.
static sl_status list_said(const sli_tiled_reader *reader, const sli_tiled_seen *seen, char *text,
                           size_t size) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data");
    uint32_t *gids;
    size_t said = 0, most;
    memset(text, 0, size);
    if (!data.value) return SL_OK;
    SL_TRY(sli_tiled_read_data(&layer, &data, (size_t)seen->squares, &gids));
    for (size_t i = 0; i < seen->squares; i++) {
        const uint32_t gid = gids[i] & SLI_TILED_TILE;
        const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
        const sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
        if (sli_tiled_word_of_tile(set, tile) == SLI_TILED_SOLID) gids[said++] = gid;
    }
    const sl_status status =
        sli_numbers_write(reader->context, gids, said, false, &most, text + 1, size - 1);
    sl_free(reader->context, gids);
    if (status == SL_OK && text[1] && strlen(text) + NUMBER_ROOM < size) *text = ':';
    return status;
}

/// A command that takes these tiles of a layer, or all of it. It says so where more is taken
/// without it.
static void write_command(const sli_tiled_reader *reader, const sli_tiled_seen *layer, bool whole,
                          const char *tiles, char *text, size_t size) {
    size_t taken = 0;
    if (!can_be_typed(layer->name)) {
        snprintf(text, size, RENAME);
        return;
    }
    if (!whole && !*tiles) {
        snprintf(text, size, "give them by number, as in --layers '%s:28+33-35'", layer->name);
        return;
    }
    for (size_t i = 0; i < reader->seen.count; i++) taken += reader->seen.items[i].taken;
    snprintf(text, size, "sightline check '%.300s' --layers '%s%s' -o map.png%s",
             reader->map->file->name, layer->name, whole ? "" : tiles,
             taken > layer->taken ? ", which takes no other layer" : "");
}

/// Layers below and above the player whose tiles say that they are solid, and are not taken; and
/// layers named for walls of whose tiles only some say so.
static sl_status tell_said(const sli_tiled_reader *reader) {
    const char *file = reader->map->file->name;
    char tiles[240], next[900];
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        const sli_shown name = sli_show((sli_word){layer->name, strlen(layer->name)});
        const bool decide = 2 * layer->said >= layer->count;
        if (!layer->beside && !layer->said) continue;
        SL_TRY(list_said(reader, layer, tiles, sizeof tiles));
        write_command(reader, layer, layer->said && decide, tiles, next, sizeof next);
        if (layer->beside)
            sl_note(reader->context,
                    "%s: layer '%s' is below or above the player: %zu of its tiles say that they "
                    "are solid and are not taken, as other layers are solid; if they stop the "
                    "player: %s",
                    file, name.text, layer->beside, next);
        else if (decide)
            sl_note(reader->context,
                    "%s: layer '%s': %zu of its %llu tiles say that they are solid, and the others "
                    "are taken as open; if these are walls: %s",
                    file, name.text, layer->said, (unsigned long long)layer->count, next);
        else
            sl_note(reader->context,
                    "%s: layer '%s' is taken whole by its name, and only %zu of its %llu tiles "
                    "say%s solid; if no others are: %s",
                    file, name.text, layer->said, (unsigned long long)layer->count,
                    layer->said == 1 ? "s that it is" : " that they are", next);
    }
    return SL_OK;
}

/// Layers that are solid with a few tiles in all, beside one with many more that is not: they may
/// be marks at which enemies turn.
static void tell_little(const sli_tiled_reader *reader) {
    const sli_tiled_seen *most = NULL;
    uint64_t solid = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        const bool plain = layer->kind == SLI_GAME_UNSAID || layer->kind >= SLI_GAME_STANDS;
        const bool full = 20 * layer->count >= 19 * layer->squares;
        if (layer->taken && (layer->objects || layer->count > 2)) return;
        if (layer->taken) solid += layer->count;
        if (!layer->taken && !layer->objects && plain && !full && !layer->moves && *layer->name &&
            (!most || layer->count > most->count))
            most = layer;
    }
    if (!solid || !most || most->count < 20 * solid) return;
    const sli_shown name = sli_show((sli_word){most->name, strlen(most->name)});
    sl_note(reader->context,
            "%s: only %llu tile%s in layers named for walls: if layer '%s' (%llu tiles) is solid: "
            "sightline check '%.300s' --layers '%s' -o map.png",
            reader->map->file->name, (unsigned long long)solid, solid == 1 ? " is" : "s are",
            name.text, (unsigned long long)most->count, reader->map->file->name, name.text);
}

/// One or two objects that say that they are solid, such as a block that a switch moves: what the
/// tiles are is for the game to say.
static void tell_objects(const sli_tiled_reader *reader) {
    layer_text tiles = {.count = 0};
    if (!reader->objects || reader->objects > 2 || reader->solid_tiles || reader->solid_layers)
        return;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (!layer->objects && layer->count) add_layer(&tiles, layer);
    }
    if (!tiles.count) return;
    sl_note(reader->context,
            "%s: only %zu object%s solid, and no tile does: if a layer of tiles is solid, --layers "
            "NAME takes it: %s",
            reader->map->file->name, reader->objects,
            reader->objects == 1 ? " says that it is" : "s say that they are", tiles.text);
}

/// Few tiles that say that they are solid, and nothing else does: they may be tries, such as the
/// first rocks of a map that is not done.
static void tell_tiles(const sli_tiled_reader *reader) {
    layer_text tiles = {.count = 0};
    uint64_t count = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->objects || !layer->count) continue;
        count += layer->count;
        add_layer(&tiles, layer);
    }
    if (!reader->solid_tiles || 100 * (uint64_t)reader->solid_tiles > count ||
        reader->solid_layers || reader->objects || reader->shapes)
        return;
    sl_note(reader->context,
            "%s: only %zu of %llu tiles say%s solid, and nothing else does: if a layer is solid, "
            "--layers NAME takes it, NAME:28+33-35 tiles of it: %s",
            reader->map->file->name, reader->solid_tiles, (unsigned long long)count,
            reader->solid_tiles == 1 ? "s that it is" : " that they are", tiles.text);
}

/// A layer named for ground with much air about it, as in a platformer, of which only a part says
/// that it is solid, and no other layer is: the rest may be platforms that were forgotten, or that
/// one jumps through.
static void tell_ground(const sli_tiled_reader *reader) {
    if (reader->solid_layers) return;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->kind != SLI_GAME_GROUND || 4 * layer->count > layer->squares || !layer->solid ||
            10 * layer->solid > 9 * layer->count)
            continue;
        const sli_shown name = sli_show((sli_word){layer->name, strlen(layer->name)});
        sl_note(reader->context,
                "%s: only %zu of the %llu tiles of layer '%s' say that they are solid: if all are: "
                "sightline check '%.300s' --layers '%s' -o map.png",
                reader->map->file->name, layer->solid, (unsigned long long)layer->count, name.text,
                reader->map->file->name, name.text);
    }
}

/// The next step, where layers are named for what is solid, and are empty.
static sl_status tell_edge_only(const sli_tiled_reader *reader) {
    const sli_tiled_seen *example = find_example(reader);
    const layer_text others = list_layers(reader, false);
    char as[560];
    if (!example) return SL_OK;
    SL_TRY(say_example(reader, example, as, sizeof as));
    sl_note(reader->context,
            "%s: only what is beyond its edge is solid: if more is, --layers NAME takes a layer, "
            "NAME:28+33-35 tiles of it%s; layers: %s",
            reader->map->file->name, as, others.text);
    return SL_OK;
}

sl_status sli_tiled_tell_meaning(const sli_tiled_reader *reader) {
    static const char *const by[] = {"",
                                     "tiles that say so of layers below and above the player",
                                     "names of layers",
                                     "terrains",
                                     "names of tilesets and pictures",
                                     "objects without a name, type or property"};
    const layer_text taken = list_layers(reader, true), others = list_layers(reader, false);
    const char *file = reader->map->file->name;
    if (reader->sets.missing && reader->lost_tiles)
        sl_note(
            reader->context,
            "%s: what a missing tileset says of %zu tiles is not known: solid layers count whole",
            file, reader->lost_tiles);
    if (reader->options->layers || (reader->void_is_solid && !taken.count)) return SL_OK;
    if (reader->believed_not)
        sl_note(reader->context,
                "%s: nearly all tiles of layer '%s' say that they are solid, and it has no gaps: "
                "this is not believed",
                file,
                sli_show((sli_word){reader->believed_not, strlen(reader->believed_not)}).text);
    if (!reader->by) SL_TRY(tell_said(reader));
    if (!reader->by) tell_little(reader);
    if (!reader->by) tell_objects(reader);
    if (!reader->by) tell_tiles(reader);
    if (!reader->by) tell_ground(reader);
    if (reader->by == SLI_TILED_BY_GUESS) {
        const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
        char tile[64] = "its empty squares are";
        if (reader->guessed_all) strcpy(tile, "all tiles are");
        if (reader->guessed)
            snprintf(tile, sizeof tile,
                     reader->guessed_all ? "all tiles but %u are" : "its tile %u is",
                     (unsigned)reader->guessed);
        sl_note(
            reader->context,
            "%s: nothing in it says what is solid: of layer '%s' %s taken (%s); --layers NAME or "
            "NAME:TILE+TILE-TILE chooses; layers: %s",
            file, sli_show((sli_word){layer->name, strlen(layer->name)}).text, tile,
            reader->guess_why, others.text);
    } else if (reader->by) {
        sl_note(
            reader->context,
            "%s: nothing in it says what is solid: taken by %s: %s; --layers NAME,NAME chooses%s%s",
            file, by[reader->by], taken.text, others.count ? "; not taken: " : "", others.text);
    } else if (taken.count && others.count) {
        sl_note(reader->context, "%s: solid: %s; --layers NAME,NAME chooses; not solid: %s", file,
                taken.text, others.text);
    } else if (others.count) {
        return tell_edge_only(reader);
    }
    return SL_OK;
}
