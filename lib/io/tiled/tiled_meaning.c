/// What is solid in a map of Tiled where no layer, tile or object says it.
///
/// After the firm words come weaker ones, and the first that gives anything decides: names of
/// layers that stand for something solid (platforms, trees), terrains named Wall, tilesets named
/// walls, objects without a name, type or property. At last a guess from one layer (tiled_guess.c).
///
/// All others are refused, with the layers and what to type: a meadow's grass is no wall.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"

sl_status sli_tiled_check_guess(const sli_tiled_reader *reader) {
    for (size_t i = 0; reader->by > SLI_TILED_BY_BESIDE && i < reader->things.items.count; i++) {
        const sli_thing *thing = &reader->things.items.items[i];
        if (thing->kind == SLI_THING_START && thing->solid)
            return sli_tiled_fail_unsaid(
                reader, "nothing in it says what is solid, and a start stands on what looks so");
    }
    return SL_OK;
}

// --- rules

/// Whether a name is that of a layer of rules: input2_Ground, inputnot_Ground, output1_Walls.
static bool is_rule(const char *name, const char *start) {
    const size_t length = strlen(start);
    if (strncmp(name, start, length) != 0) return false;
    name += length;
    if (strncmp(name, "not", 3) == 0) name += 3;
    return name[strspn(name, "0123456789")] == '_';
}

static void look_for_rules(const sli_json *parent, bool *input, bool *output) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const char *name = sli_json_text_of(&layer, "name");
        *input |= is_rule(name, "input");
        *output |= is_rule(name, "output");
        look_for_rules(&layer, input, output);
    }
}

sl_status sli_tiled_check_rules(const sli_tiled_reader *reader) {
    bool input = false, output = false;
    look_for_rules(reader->map, &input, &output);
    if (!input || !output || reader->options->layers) return SL_OK;
    return sli_json_fail(reader->map,
                         "its layers input_... and output_... are rules by which Tiled "
                         "draws other maps: read a map that they have drawn");
}

// --- the order of the readings

/// The firmest kind that names of layers have. A layer that is full says nothing.
static sli_game_kind find_best(const sli_tiled_reader *reader) {
    sli_game_kind best = SLI_GAME_UNSAID;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        const bool full = !layer->objects && 20 * layer->count >= 19 * layer->squares;
        const sli_game_kind least = layer->objects ? SLI_GAME_LIKELY : SLI_GAME_STANDS;
        if (layer->count && !full && !layer->moves && layer->kind >= least && layer->kind > best)
            best = layer->kind;
    }
    return best;
}

/// A layer that is not solid as a whole has tiles of a tileset that cannot be read.
static sl_status fail_missing(const sli_tiled_reader *reader) {
    const char *missing = NULL;
    char why[200];
    for (size_t i = reader->sets.sets.count; i-- > 0;)
        if (reader->sets.sets.items[i].missing) missing = reader->sets.sets.items[i].missing;
    snprintf(
        why, sizeof why,
        "its tileset '%s' cannot be read, and no layer says that it is solid (it may say so of "
        "%zu tiles)",
        sli_show((sli_word){missing, strlen(missing)}).text, reader->unknown_tiles);
    return sli_tiled_fail_unsaid(reader, why);
}

/// Whether nearly all tiles of the map are taken by names of tilesets: these say nothing then. The
/// layers and tiles that were taken no longer count; shapes and objects stay.
static bool takes_all(sli_tiled_reader *reader) {
    size_t all = 0;
    for (size_t i = 0; i < reader->seen.count; i++)
        all += reader->seen.items[i].objects ? 0 : (size_t)reader->seen.items[i].count;
    if (reader->by != SLI_TILED_BY_SET || 10 * reader->solid_tiles < 9 * all) return false;
    for (size_t i = 0; i < reader->seen.count; i++) reader->seen.items[i].taken = false;
    reader->solid_tiles = 0;
    return true;
}

/// Where a tileset cannot be read, names of layers may tell, or the look of one.
static sl_status find_without_set(sli_tiled_reader *reader) {
    const size_t unknown = reader->unknown_tiles, lost = reader->lost_tiles;
    reader->best = find_best(reader);
    if (!sli_tiled_taken(reader) && reader->best) {
        reader->by = SLI_TILED_BY_NAME;
        SL_TRY(sli_tiled_read_again(reader));
    } else if (!sli_tiled_taken(reader)) {
        SL_TRY(sli_tiled_begin_guess(reader));
    }
    reader->unknown_tiles = unknown;
    reader->lost_tiles = lost;
    return reader->by && (sli_tiled_taken(reader) || reader->guess_why) ? SL_OK
                                                                        : fail_missing(reader);
}

sl_status sli_tiled_find_meaning(sli_tiled_reader *reader) {
    if (reader->void_is_solid) return SL_OK;
    if (reader->unknown_tiles) return find_without_set(reader);
    if (sli_tiled_taken(reader)) return SL_OK;
    if (reader->beside_tiles) {
        reader->by = SLI_TILED_BY_BESIDE;
        SL_TRY(sli_tiled_read_again(reader));
        if (sli_tiled_taken(reader)) return SL_OK;
    }
    reader->best = find_best(reader);
    for (int by = SLI_TILED_BY_NAME; by < SLI_TILED_BY_GUESS; by++) {
        if (by == SLI_TILED_BY_NAME && !reader->best) continue;
        reader->by = (sli_tiled_by)by;
        SL_TRY(sli_tiled_read_again(reader));
        if (sli_tiled_taken(reader) && !takes_all(reader)) return SL_OK;
    }
    // A layer for walls that has none: all is open but what is beyond the map, or the floor.
    if (reader->empty_layers && !sli_tiled_only_floor(reader)) {
        reader->by = SLI_TILED_BY_WORD;
        return SL_OK;
    }
    SL_TRY(sli_tiled_begin_guess(reader));
    if (reader->guess_why) return SL_OK;
    return sli_tiled_fail_unsaid(reader, reader->believed_not
                                             ? "nearly all of its tiles say that they are solid"
                                             : "nothing in it says what is solid");
}
