/// What is told of a map of Tiled: what is solid in it and by what, and the next command where that
/// is in doubt.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"

/// The tiles of a layer that say that they are solid, or all, as ":28+33-35"; "" where they are too
/// many, or the layer lies in chunks.
static sl_status list_said(const sli_tiled_reader *reader, const sli_tiled_seen *seen, bool all,
                           char *text, size_t size) {
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
        if (all ? gid != 0 : sli_tiled_word_of_tile(set, tile) == SLI_TILED_SOLID)
            gids[said++] = gid;
    }
    const sl_status status =
        sli_numbers_write(reader->context, gids, said, false, &most, text + 1, size - 1);
    sl_free(reader->context, gids);
    if (status == SL_OK && text[1] && strlen(text) + SLI_TILED_NUMBER_ROOM < size) *text = ':';
    return status;
}

/// A command that takes these tiles of a layer, or all of it. It says so where more is taken
/// without it.
static void write_command(const sli_tiled_reader *reader, const sli_tiled_seen *layer, bool whole,
                          const char *tiles, char *text, size_t size) {
    size_t taken = 0;
    if (!sli_tiled_can_be_typed(layer->name)) {
        snprintf(text, size, SLI_TILED_RENAME);
        return;
    }
    if (!whole && !*tiles) {
        snprintf(text, size, "give them by number in --layers");
        return;
    }
    for (size_t i = 0; i < reader->seen.count; i++) taken += reader->seen.items[i].taken;
    snprintf(text, size, "sightline check '%.300s' --layers '%s%s' -o map.png%s",
             reader->map->file->name, layer->name, whole ? "" : tiles,
             taken > layer->taken ? ", which takes no other layer" : "");
}

/// A layer that its name makes solid, with tiles that say that they are open.
static sl_status tell_denied(const sli_tiled_reader *reader, const sli_tiled_seen *layer) {
    char tiles[240], next[900];
    if (!layer->denied) return SL_OK;
    SL_TRY(list_said(reader, layer, true, tiles, sizeof tiles));
    write_command(reader, layer, false, tiles, next, sizeof next);
    sl_note(reader->context,
            "%s: layer '%s' is named for what is solid, but %zu of its %llu tiles say%s open, and "
            "so they are taken; if they are solid: %s",
            reader->map->file->name, sli_show((sli_word){layer->name, strlen(layer->name)}).text,
            layer->denied, (unsigned long long)layer->count,
            layer->denied == 1 ? "s that it is" : " that they are", next);
    return SL_OK;
}

/// Layers below and above the player whose tiles say that they are solid, and are not taken; and
/// layers named for walls of whose tiles only some say so.
static sl_status tell_said(const sli_tiled_reader *reader) {
    const char *file = reader->map->file->name;
    char tiles[240], next[900];
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        const sli_shown name = sli_show((sli_word){layer->name, strlen(layer->name)});
        const bool decide = layer->tiles_decide;
        SL_TRY(tell_denied(reader, layer));
        if (!layer->beside && !layer->said) continue;
        SL_TRY(list_said(reader, layer, false, tiles, sizeof tiles));
        write_command(reader, layer, decide, tiles, next, sizeof next);
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

/// As sli_tiled_list_taken, but without this layer, or with it.
static void list_taken_but(const sli_tiled_reader *reader, const sli_tiled_seen *changed,
                           char *text, size_t size) {
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->taken == (layer == changed)) continue;
        if (!sli_tiled_can_be_typed(layer->name) || used + strlen(layer->name) + 2 > size) {
            *text = '\0';
            return;
        }
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? "," : "", layer->name);
    }
}

void sli_tiled_list_taken(const sli_tiled_reader *reader, char *text, size_t size) {
    list_taken_but(reader, NULL, text, size);
}

/// Layers of tiles that are named for doors, with tiles that are none, as they do not say that they
/// are solid.
static void tell_doors(const sli_tiled_reader *reader) {
    for (size_t i = 0; i < reader->things.items.count; i++)
        if (reader->things.items.items[i].of_tiles) return;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        char names[400];
        if (layer->objects || !layer->count || !sli_says_door(layer->name)) continue;
        list_taken_but(reader, layer, names, sizeof names);
        if (!*names) continue;
        sl_note(reader->context,
                "%s: layer '%s' (%llu tile%s) is named for doors, and is taken as %s: if %s: "
                "sightline check '%.300s' --layers '%s' -o map.png; tiles of the class 'door' are "
                "doors",
                reader->map->file->name,
                sli_show((sli_word){layer->name, strlen(layer->name)}).text,
                (unsigned long long)layer->count, layer->count == 1 ? "" : "s",
                layer->taken ? "solid" : "open", layer->taken ? "it is open" : "it is solid",
                reader->map->file->name, names);
    }
}

/// The tiles of the layers that are taken.
static uint64_t count_taken(const sli_tiled_reader *reader) {
    uint64_t count = 0;
    for (size_t i = 0; i < reader->seen.count; i++)
        if (reader->seen.items[i].taken && !reader->seen.items[i].objects)
            count += reader->seen.items[i].count;
    return count;
}

/// A layer named for ground, much larger than what is solid, with starts in the air about it and
/// none on its tiles: in a platformer it is solid, too.
static sl_status tell_air(const sli_tiled_reader *reader) {
    const uint64_t taken = count_taken(reader);
    for (size_t i = 0; i < reader->seen.count && !reader->objects; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        size_t starts[2];
        char names[400];
        if (layer->kind != SLI_GAME_GROUND || layer->taken || layer->objects || layer->moves ||
            5 * layer->count > 3 * layer->squares || layer->count < 5 * taken)
            continue;
        SL_TRY(sli_tiled_count_starts(reader, layer, (sli_word){0}, starts));
        sli_tiled_list_taken(reader, names, sizeof names);
        if (!starts[1] || starts[0] || !*names || !sli_tiled_can_be_typed(layer->name)) continue;
        sl_note(reader->context,
                "%s: starts stand in the air about layer '%s' (%llu tiles): if it is solid, too: "
                "sightline check '%.300s' --layers '%s,%s' -o map.png",
                reader->map->file->name, layer->name, (unsigned long long)layer->count,
                reader->map->file->name, names, layer->name);
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
    char next[900];
    write_command(reader, most, true, "", next, sizeof next);
    sl_note(reader->context,
            "%s: only %llu tile%s in layers named for walls: if layer '%s' (%llu tiles) is solid: "
            "%s",
            reader->map->file->name, (unsigned long long)solid, solid == 1 ? " is" : "s are",
            sli_show((sli_word){most->name, strlen(most->name)}).text,
            (unsigned long long)most->count, next);
}

/// What to type for the layer that is the most likely one, where little is taken; "" for none.
static sl_status say_next(const sli_tiled_reader *reader, char *text, size_t size) {
    sli_tiled_example example;
    *text = '\0';
    SL_TRY(sli_tiled_find_example(reader, true, &example));
    return example.layer ? sli_tiled_say_example(reader, example, text, size) : SL_OK;
}

/// One or two objects that say that they are solid, such as a block that a switch moves: what the
/// tiles are is for the game to say.
static sl_status tell_objects(const sli_tiled_reader *reader) {
    sli_tiled_layer_text tiles = {.count = 0};
    char next[1400] = "";
    if (!reader->objects || reader->objects > 2 || reader->solid_tiles || reader->solid_layers)
        return SL_OK;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (!layer->objects && layer->count) sli_tiled_add_layer(&tiles, layer);
    }
    if (!tiles.count) return SL_OK;
    SL_TRY(say_next(reader, next, sizeof next));
    sl_note(reader->context, "%s: only %zu object%s solid, and no tile does%s; layers of tiles: %s",
            reader->map->file->name, reader->objects,
            reader->objects == 1 ? " says that it is" : "s say that they are", next, tiles.text);
    return SL_OK;
}

/// Few tiles that say that they are solid, and nothing else does: they may be tries, such as the
/// first rocks of a map that is not done.
static sl_status tell_tiles(const sli_tiled_reader *reader) {
    sli_tiled_layer_text tiles = {.count = 0};
    uint64_t count = 0;
    char next[1400];
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->objects || !layer->count) continue;
        count += layer->count;
        sli_tiled_add_layer(&tiles, layer);
    }
    if (!reader->solid_tiles || 100 * (uint64_t)reader->solid_tiles > count ||
        reader->solid_layers || reader->objects || reader->shapes)
        return SL_OK;
    SL_TRY(say_next(reader, next, sizeof next));
    sl_note(reader->context,
            "%s: only %zu of %llu tiles say%s solid, and nothing else does%s; layers of tiles: %s",
            reader->map->file->name, reader->solid_tiles, (unsigned long long)count,
            reader->solid_tiles == 1 ? "s that it is" : " that they are", next, tiles.text);
    return SL_OK;
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
        char next[900];
        write_command(reader, layer, true, "", next, sizeof next);
        sl_note(reader->context,
                "%s: only %zu of the %llu tiles of layer '%s' say that they are solid: if all are: "
                "%s",
                reader->map->file->name, layer->solid, (unsigned long long)layer->count,
                sli_show((sli_word){layer->name, strlen(layer->name)}).text, next);
    }
}

/// The next step, where layers are named for what is solid, and are empty.
static sl_status tell_edge_only(const sli_tiled_reader *reader) {
    sli_tiled_example example;
    const sli_tiled_layer_text others = sli_tiled_list_layers(reader, false);
    char as[1400];
    SL_TRY(sli_tiled_find_example(reader, false, &example));
    if (!example.layer) return SL_OK;
    SL_TRY(sli_tiled_say_example(reader, example, as, sizeof as));
    sl_note(reader->context, "%s: only what is beyond its edge is solid%s; layers: %s",
            reader->map->file->name, as, others.text);
    return SL_OK;
}

/// The contrary of a guess, as a command.
static sl_status write_contrary(const sli_tiled_reader *reader, char *text, size_t size) {
    const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
    char layers[300] = "void";
    bool mostly;
    *text = '\0';
    if (!sli_tiled_can_be_typed(layer->name)) return SL_OK;
    if (reader->guessed && reader->guessed_all) {
        snprintf(layers, sizeof layers, "%s:%u", layer->name, (unsigned)reader->guessed);
    } else if (!reader->guessed_all) {
        char tiles[120] = "";
        if (reader->guessed)
            SL_TRY(sli_tiled_choose_tiles(reader, layer, &mostly, tiles, sizeof tiles));
        snprintf(layers, sizeof layers, "%s%s", layer->name, tiles);
    }
    snprintf(text, size,
             "; if it is the other way round: sightline check '%.300s' --layers '%s' -o map.png",
             reader->map->file->name, layers);
    return SL_OK;
}

/// What a guess takes, why, and what takes the contrary.
static sl_status tell_guess(const sli_tiled_reader *reader, const sli_tiled_layer_text *others) {
    const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
    char tile[64] = "its empty squares are", contrary[700];
    if (reader->guessed_all) strcpy(tile, "all tiles are");
    if (reader->guessed)
        snprintf(tile, sizeof tile, reader->guessed_all ? "all tiles but %u are" : "its tile %u is",
                 (unsigned)reader->guessed);
    SL_TRY(write_contrary(reader, contrary, sizeof contrary));
    sl_note(reader->context,
            "%s: nothing in it says what is solid: of layer '%s' %s taken (%s)%s; layers: %s",
            reader->map->file->name, sli_show((sli_word){layer->name, strlen(layer->name)}).text,
            tile, reader->guess_why, contrary, others->text);
    return SL_OK;
}

/// What weaker words take, and a command for the layer that is the most likely one beside them.
static sl_status tell_weaker(const sli_tiled_reader *reader, const sli_tiled_layer_text *taken,
                             const sli_tiled_layer_text *others) {
    static const char *const by[] = {"",
                                     "tiles that say so of layers below and above the player",
                                     "names of layers",
                                     "terrains",
                                     "names of tilesets and pictures",
                                     "objects without a name, type or property"};
    sli_tiled_example example;
    char next[700] = "";
    SL_TRY(sli_tiled_find_example(reader, false, &example));
    if (example.layer && example.rank >= SLI_TILED_PARTIAL &&
        example.layer->count > count_taken(reader) && sli_tiled_can_be_typed(example.layer->name))
        snprintf(next, sizeof next,
                 "; if '%s' is solid instead: sightline check '%.300s' --layers '%s' -o map.png",
                 example.layer->name, reader->map->file->name, example.layer->name);
    sl_note(reader->context, "%s: nothing in it says what is solid: taken by %s: %s%s%s%s",
            reader->map->file->name, by[reader->by], taken->text,
            others->count ? "; not taken: " : "", others->text, next);
    return SL_OK;
}

sl_status sli_tiled_tell_meaning(const sli_tiled_reader *reader) {
    const sli_tiled_layer_text taken = sli_tiled_list_layers(reader, true),
                               others = sli_tiled_list_layers(reader, false);
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
    if (!reader->by) tell_doors(reader);
    if (!reader->by) tell_little(reader);
    if (!reader->by) SL_TRY(tell_objects(reader));
    if (!reader->by) SL_TRY(tell_tiles(reader));
    if (!reader->by) tell_ground(reader);
    if (!reader->by) SL_TRY(tell_air(reader));
    if (reader->by == SLI_TILED_BY_GUESS) return tell_guess(reader, &others);
    if (reader->by) return tell_weaker(reader, &taken, &others);
    if (!taken.count) return others.count ? tell_edge_only(reader) : SL_OK;
    char names[400];
    sli_tiled_list_taken(reader, names, sizeof names);
    if (others.count)
        sl_note(reader->context, "%s: solid: %s%s%s%s; not solid: %s", file, taken.text,
                *names ? ", as --layers '" : "", names, *names ? "' takes alone" : "", others.text);
    return SL_OK;
}
