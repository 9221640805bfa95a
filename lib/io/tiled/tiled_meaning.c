/// What is solid in a map of Tiled where no layer, tile or object says it.
///
/// After the firm words come weaker ones, and the first that gives anything decides: names of
/// layers that stand for something solid (platforms, trees), terrains named Wall, tilesets named
/// walls, objects without a name, type or property. At last one layer is looked at, and only rules
/// that hold for few maps count:
///
/// - Where the only layer of tiles is named for a floor, there is a wall where it has no tile. So
///   it is where one layer is named for where one walks ("walkable").
/// - Where the map or a tileset is named for a dungeon or a sewer, and one tile covers at least
///   half of the lowest layer and of its edge, that tile is rock, unless the layer is named for
///   ground or floor, or most objects stand on it.
/// - Where three or more objects stand on the only layer, four of five on squares without tiles or
///   on tiles, what they do not stand on is solid.
/// - Where the only layer has tiles all around its edge, or below and not above, and is empty for
///   a good part, the tiles are walls or the ground of a platformer. So is the only layer named for
///   ground, if all layers together leave air above it.
/// - Where the only layer is full, and its most frequent tile covers half of it but not the edge,
///   that tile is a floor, and the others are walls, if 19 of 20 of them are as those on the edge.
///
/// The only layer is also the only one with gaps, on floors that cover all. Pictures, coins and
/// layers with a fiftieth of the tiles of another one do not count.
///
/// All others are refused, with the layers and what to type: a meadow's grass is no wall.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"

#include <stdlib.h>

// --- the guess

/// A block as the rules look at it.
typedef struct look {
    const uint32_t *gids;
    size_t columns, rows;
} look;

static uint32_t tile_at(const look *at, size_t column, size_t row) {
    return at->gids[row * at->columns + column] & SLI_TILED_TILE;
}

bool sli_tiled_is_thin(const uint32_t *gids, size_t count, size_t columns, size_t i) {
    const size_t x = i % columns;
    const bool left = x && (gids[i - 1] & SLI_TILED_TILE);
    const bool right = x + 1 < columns && (gids[i + 1] & SLI_TILED_TILE);
    const bool above = i >= columns && (gids[i - columns] & SLI_TILED_TILE);
    const bool below = i + columns < count && (gids[i + columns] & SLI_TILED_TILE);
    return (!left && !right) || (!above && !below);
}

/// Whether most tiles have none on both sides, or above and below: they may be walls about rooms as
/// well as ways through rock.
static bool are_thin(const look *at, size_t tiles) {
    size_t thin = 0;
    for (size_t i = 0; i < at->columns * at->rows; i++)
        thin += tile_at(at, i % at->columns, i / at->columns) &&
                sli_tiled_is_thin(at->gids, at->columns * at->rows, at->columns, i);
    return 2 * thin >= tiles;
}

/// How many squares of a row have a tile.
static size_t tiles_of_row(const look *at, size_t row) {
    size_t count = 0;
    for (size_t i = 0; i < at->columns; i++) count += tile_at(at, i, row) != 0;
    return count;
}

/// How many squares of the edge have this tile, or any other than it.
static size_t on_edge(const look *at, uint32_t gid) {
    size_t count = 0;
    for (size_t i = 0; i < at->columns; i++)
        count += (size_t)(tile_at(at, i, 0) == gid) + (tile_at(at, i, at->rows - 1) == gid);
    for (size_t i = 0; i < at->rows; i++)
        count += (size_t)(tile_at(at, 0, i) == gid) + (tile_at(at, at->columns - 1, i) == gid);
    return count;
}

/// The squares of the box about all tiles.
static size_t count_about(const look *at) {
    size_t left = at->columns, right = 0, top = at->rows, bottom = 0;
    for (size_t row = 0; row < at->rows; row++)
        for (size_t i = 0; i < at->columns; i++) {
            if (!tile_at(at, i, row)) continue;
            if (i < left) left = i;
            if (i >= right) right = i + 1;
            if (row < top) top = row;
            bottom = row + 1;
        }
    return right > left ? (right - left) * (bottom - top) : 0;
}

static int compare_gids(const void *left, const void *right) {
    const uint32_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

/// The most frequent tile, the lowest of those, and how often it is there; 0 is an empty square.
static sl_status find_most(sl_context *context, const uint32_t *gids, size_t count, uint32_t *gid,
                           size_t *most) {
    uint32_t *sorted = sl_alloc_array(context, count, sizeof *sorted);
    if (!sorted) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) sorted[i] = gids[i] & SLI_TILED_TILE;
    qsort(sorted, count, sizeof *sorted, compare_gids);
    *most = 0;
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i; next < count && sorted[next] == sorted[i]; next++) continue;
        if (next - i <= *most) continue;
        *most = next - i;
        *gid = sorted[i];
    }
    sl_free(context, sorted);
    return SL_OK;
}

static bool is_inside(const sli_tiled_reader *reader) {
    bool inside = sli_game_says_inside(sl_path_name(reader->map->file->name));
    for (size_t i = 0; i < reader->sets.sets.count; i++)
        inside |= reader->sets.sets.items[i].inside;
    return inside;
}

/// The tiles of the layer of tiles with the most of them that has gaps.
static uint64_t find_largest(const sli_tiled_reader *reader) {
    uint64_t most = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (!layer->objects && layer->count < layer->squares && layer->count > most)
            most = layer->count;
    }
    return most;
}

/// The layers of tiles that are no pictures, no places that one passes, no coins and no scraps.
/// *first: the number of the first one; *partial: of those with gaps the number of the first, and
/// how many there are.
static size_t count_plain(const sli_tiled_reader *reader, size_t *first, size_t partial[2]) {
    const uint64_t largest = find_largest(reader);
    size_t count = 0;
    partial[1] = 0;
    for (size_t i = reader->seen.count; i-- > 0;) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->objects || !layer->count || layer->kind == SLI_GAME_DRAWN ||
            layer->kind == SLI_GAME_PASS || sli_game_says_other(layer->name) ||
            50 * layer->count < largest)
            continue;
        count++;
        *first = i;
        if (layer->count == layer->squares) continue;
        partial[0] = i;
        partial[1]++;
    }
    return count;
}

/// How many squares have tiles of which some lie on the edge.
static sl_status count_as_edge(sl_context *context, const look *at, size_t *count) {
    const size_t edge = 2 * (at->columns + at->rows);
    uint32_t *gids = sl_alloc_array(context, edge, sizeof *gids), *end = gids;
    if (!gids) return SL_NO_MEMORY;
    for (size_t i = 0; i < at->columns; i++) {
        *end++ = tile_at(at, i, 0);
        *end++ = tile_at(at, i, at->rows - 1);
    }
    for (size_t i = 0; i < at->rows; i++) {
        *end++ = tile_at(at, 0, i);
        *end++ = tile_at(at, at->columns - 1, i);
    }
    qsort(gids, edge, sizeof *gids, compare_gids);
    *count = 0;
    for (size_t i = 0; i < at->columns * at->rows; i++) {
        const uint32_t own = at->gids[i] & SLI_TILED_TILE;
        *count += bsearch(&own, gids, edge, sizeof *gids, compare_gids) != NULL;
    }
    sl_free(context, gids);
    return SL_OK;
}

/// The number of the only layer that is named for ground, where the layers of tiles that are no
/// pictures leave two fifths of the squares empty; that of no layer else.
static size_t find_ground(const sli_tiled_reader *reader) {
    size_t found = reader->seen.count, grounds = 0;
    uint64_t tiles = 0, squares = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->objects || layer->kind == SLI_GAME_DRAWN) continue;
        tiles += layer->count;
        if (layer->kind != SLI_GAME_GROUND || !layer->count) continue;
        found = i;
        squares = layer->squares;
        grounds++;
    }
    return grounds == 1 && 5 * tiles <= 3 * squares ? found : reader->seen.count;
}

/// Whether all that is drawn is one layer that is named for a floor, and has gaps.
static bool only_floor(const sli_tiled_reader *reader) {
    size_t first, partial[2];
    if (count_plain(reader, &first, partial) != 1) return false;
    const sli_tiled_seen *layer = &reader->seen.items[first];
    return layer->kind == SLI_GAME_FLOOR && layer->count < layer->squares;
}

/// Whether a layer of tiles says where one walks, and not everywhere.
static bool says_walkable(const sli_tiled_seen *layer) {
    return !layer->objects && layer->count && layer->count < layer->squares &&
           sli_says_walkable(layer->name);
}

/// The number of the only layer that says where one walks; that of no layer else.
static size_t find_walkable(const sli_tiled_reader *reader) {
    size_t found = reader->seen.count, count = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        if (!says_walkable(&reader->seen.items[i])) continue;
        found = i;
        count++;
    }
    return count == 1 ? found : reader->seen.count;
}

sl_status sli_tiled_guess(sli_tiled_reader *reader, const uint32_t *gids, size_t columns,
                          size_t rows) {
    const look at = {gids, columns, rows};
    const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
    const size_t count = columns * rows, edge = 2 * (columns + rows);
    const size_t empty = count - (size_t)layer->count, bare = on_edge(&at, 0);
    const bool only = reader->guess_only, floor = layer->kind == SLI_GAME_FLOOR;
    // The most frequent tile of what is named for ground is no rock.
    const bool ground = floor || layer->kind == SLI_GAME_GROUND;
    size_t most, as_edge;
    uint32_t gid = 0;
    if (layer->squares != count) return SL_OK; // one chunk of several
    SL_TRY(find_most(reader->context, gids, count, &gid, &most));
    SL_TRY(count_as_edge(reader->context, &at, &as_edge));
    bool on_most;
    const sli_tiled_stand stand =
        sli_tiled_where_objects_stand(reader, gids, columns, rows, gid, &on_most);
    if (only_floor(reader)) {
        reader->guess_why = "where the floor has no tile is a wall";
    } else if (says_walkable(layer)) {
        reader->guess_why = "one does not walk where it has no tile";
    } else if (is_inside(reader) && !(gid && ground) && !on_most && !reader->unknown_tiles &&
               !(!gid && are_thin(&at, (size_t)layer->count)) && 2 * most >= count &&
               2 * on_edge(&at, gid) >= edge) {
        reader->guessed = gid;
        reader->guess_why = gid ? "the most frequent tile of a dungeon, which is on its edge too"
                                : "the empty squares of a dungeon";
    } else if (only && !floor && 5 * empty >= count && 20 * bare <= edge) {
        reader->guessed_all = true;
        reader->guess_why = "its tiles lie all around its edge";
    } else if (only && !floor && 5 * empty >= 2 * count &&
               2 * tiles_of_row(&at, rows - 1) >= columns && 4 * tiles_of_row(&at, 0) <= columns) {
        reader->guessed_all = true;
        reader->guess_why = "its tiles lie below and not above, as in a platformer";
    } else if (reader->guess_layer == find_ground(reader) && 5 * empty >= 2 * count &&
               5 * tiles_of_row(&at, rows - 1) >= 2 * columns &&
               4 * tiles_of_row(&at, 0) <= columns) {
        reader->guessed_all = true;
        reader->guess_why = "it is named for ground, with air above it";
    } else if (only && !ground && gid && !empty && 2 * most >= count && !on_edge(&at, gid) &&
               20 * as_edge >= 19 * (count - most)) {
        reader->guessed_all = true;
        reader->guessed = gid;
        reader->guess_why = "the most frequent tile does not come to its edge";
    } else if (only && !floor && stand == SLI_TILED_STAND_ON_EMPTY &&
               10 * layer->count >= count_about(&at)) {
        reader->guessed_all = true;
        reader->guess_why = "objects stand where it has no tiles";
    } else if (only && stand == SLI_TILED_STAND_ON_TILES && 10 * empty >= count) {
        reader->guess_why = "objects stand on its tiles";
    }
    return SL_OK;
}

static sl_status guess(sli_tiled_reader *reader) {
    reader->by = SLI_TILED_BY_GUESS;
    const size_t ground = find_ground(reader), walkable = find_walkable(reader);
    size_t partial[2] = {0};
    const size_t plain = count_plain(reader, &reader->guess_layer, partial);
    reader->guess_only = plain == 1;
    if (walkable < reader->seen.count) {
        reader->guess_layer = walkable;
        return sli_tiled_read_again(reader);
    }
    if (plain > 1 && !is_inside(reader)) {
        // On a floor that is drawn everywhere lies one layer more, which is no path.
        const sli_tiled_seen *more = &reader->seen.items[partial[0]];
        reader->guess_only = partial[1] == 1 && !sli_game_says_furniture(more->name) &&
                             more->kind != SLI_GAME_GROUND && more->kind != SLI_GAME_FLOOR;
        if (reader->guess_only) reader->guess_layer = partial[0];
        if (ground < reader->seen.count) reader->guess_layer = ground;
    }
    return sli_tiled_read_again(reader);
}

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
        SL_TRY(guess(reader));
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
    if (reader->empty_layers && !only_floor(reader)) {
        reader->by = SLI_TILED_BY_WORD;
        return SL_OK;
    }
    SL_TRY(guess(reader));
    if (reader->guess_why) return SL_OK;
    return sli_tiled_fail_unsaid(reader, reader->believed_not
                                             ? "nearly all of its tiles say that they are solid"
                                             : "nothing in it says what is solid");
}
