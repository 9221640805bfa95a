/// A guess of what is solid in a map of Tiled, from one layer of tiles: by its name, its look, or
/// where starts and objects stand on it. Only rules that hold for few maps count:
///
/// - Where the only layer of tiles is named for a floor, there is a wall where it has no tile. So
///   it is where one layer is named for where one walks ("walkable").
/// - Where the map or a tileset is named for a dungeon or a sewer, and one tile covers at least
///   half of the lowest layer and of its edge, that tile is rock, unless the layer is named for
///   ground or floor, or most objects stand on it.
/// - Where three or more objects stand on the only layer, four of five on squares without tiles or
///   on tiles, what they do not stand on is solid.
/// - So it is where starts stand on squares without tiles, and none on a tile.
/// - Where the tiles of the only layer are lines about squares without tiles, they are walls.
///   Where layers are named for ladders, coins or platforms, and the map is wide, they are ground.
/// - Where the only layer has tiles all around its edge, or below and not above, and is empty for
///   a good part, the tiles are walls or the ground of a platformer. So is the only layer named for
///   ground, if all layers together leave air above it.
/// - Where the only layer is full, and its most frequent tile covers half of it but not the edge,
///   that tile is a floor, and the others are walls, if 19 of 20 of them are as those on the edge.
///
/// The only layer is also the only one with gaps, on floors that cover all. Pictures, coins and
/// layers with a fiftieth of the tiles of another one do not count.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"

#include <math.h>
#include <stdlib.h>

/// A block as the rules look at it.
typedef struct look {
    const uint32_t *gids;
    size_t columns, rows;
} look;

static uint32_t tile_at(const look *at, size_t column, size_t row) {
    return at->gids[row * at->columns + column] & SLI_TILED_TILE;
}

/// Whether hardly a tile has tiles all around: they may be walls about rooms as well as ways
/// through rock. Floors of rooms are wider.
static bool are_lines(const look *at, size_t tiles) {
    enum { FEW = 50 };
    size_t inner = 0;
    for (size_t y = 0; y < at->rows; y++)
        for (size_t x = 0; x < at->columns; x++) {
            bool all = true;
            for (size_t row = y ? y - 1 : 0; row <= y + 1 && row < at->rows; row++)
                for (size_t i = x ? x - 1 : 0; i <= x + 1 && i < at->columns; i++)
                    all &= tile_at(at, i, row) != 0;
            inner += all;
        }
    return FEW * inner <= tiles;
}

/// How many squares without a tile have tiles on all four sides, near or far, as in a room whose
/// doors stand open.
static sl_status count_within(sl_context *context, const look *at, size_t *within) {
    enum { ABOVE = 1, BELOW = 2, LEFT = 4 };
    const size_t count = at->columns * at->rows;
    char *sides = sl_alloc_array(context, count, 1);
    *within = 0;
    if (!sides) return SL_NO_MEMORY;
    memset(sides, 0, count);
    for (size_t x = 0; x < at->columns; x++) {
        bool above = false, below = false;
        for (size_t y = 0; y < at->rows; y++) {
            const size_t up = at->rows - 1 - y;
            if (above) sides[y * at->columns + x] |= ABOVE;
            if (below) sides[up * at->columns + x] |= BELOW;
            above |= tile_at(at, x, y) != 0;
            below |= tile_at(at, x, up) != 0;
        }
    }
    for (size_t y = 0; y < at->rows; y++) {
        bool left = false, right = false;
        for (size_t x = 0; x < at->columns; x++) {
            if (left) sides[y * at->columns + x] |= LEFT;
            left |= tile_at(at, x, y) != 0;
        }
        for (size_t x = at->columns; x-- > 0;) {
            const bool all = sides[y * at->columns + x] == (ABOVE | BELOW | LEFT);
            *within += right && all && !tile_at(at, x, y);
            right |= tile_at(at, x, y) != 0;
        }
    }
    sl_free(context, sides);
    return SL_OK;
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
bool sli_tiled_only_floor(const sli_tiled_reader *reader) {
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

/// Whether layers are those of a platformer, and the map is wide.
static bool is_side_view(const sli_tiled_reader *reader, const look *at) {
    static const char *const words[] = {"ladder", "leiter", "escalera", "coin", "platform", "jump"};
    for (size_t i = 0; at->columns >= 2 * at->rows && i < reader->seen.count; i++) {
        const char *name = reader->seen.items[i].name;
        for (sli_name_word word; reader->seen.items[i].count && sli_word_next(&name, &word);)
            if (sli_word_in(&word, words, sizeof words / sizeof *words)) return true;
    }
    return false;
}

/// Whether starts stand on squares without a tile, and none on a tile.
static bool start_beside(const sli_tiled_reader *reader, const look *at) {
    const sl_point step = reader->lattice.step;
    size_t on = 0, off = 0;
    for (size_t i = 0; i < reader->things.items.count; i++) {
        const sli_thing *thing = &reader->things.items.items[i];
        const double x = floor(thing->middle.x / step.x), y = floor(thing->middle.y / step.y);
        if (thing->kind != SLI_THING_START || !(x >= 0 && y >= 0)) continue;
        if (x >= (double)at->columns || y >= (double)at->rows) continue;
        ++*(tile_at(at, (size_t)x, (size_t)y) ? &on : &off);
    }
    return off && !on && reader->lattice.orientation == SLI_TILED_ORTHOGONAL;
}

/// By names: of the layer, of the map, of tilesets.
static sl_status guess_by_name(sli_tiled_reader *reader, const look *at, bool on_most) {
    const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
    const size_t count = at->columns * at->rows;
    // The most frequent tile of what is named for ground is no rock.
    const bool ground = layer->kind == SLI_GAME_FLOOR || layer->kind == SLI_GAME_GROUND;
    size_t most;
    uint32_t gid = 0;
    SL_TRY(find_most(reader->context, at->gids, count, &gid, &most));
    if (sli_tiled_only_floor(reader)) {
        reader->guess_why = "where the floor has no tile is a wall";
    } else if (says_walkable(layer)) {
        reader->guess_why = "one does not walk where it has no tile";
    } else if (is_inside(reader) && !(gid && ground) && !on_most && !reader->unknown_tiles &&
               (gid || !are_lines(at, (size_t)layer->count)) && 2 * most >= count &&
               2 * on_edge(at, gid) >= 2 * (at->columns + at->rows)) {
        reader->guessed = gid;
        reader->guess_why = gid ? "the most frequent tile of a dungeon, which is on its edge too"
                                : "the empty squares of a dungeon";
    }
    return SL_OK;
}

/// By the look of the only layer, or of the only one named for ground.
static sl_status guess_by_look(sli_tiled_reader *reader, const look *at) {
    const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
    const size_t count = at->columns * at->rows, empty = count - (size_t)layer->count;
    const size_t edge = 2 * (at->columns + at->rows), bare = on_edge(at, 0);
    const size_t above = tiles_of_row(at, 0), below = tiles_of_row(at, at->rows - 1);
    const bool only = reader->guess_only, floor = layer->kind == SLI_GAME_FLOOR;
    const bool air = 5 * empty >= 2 * count && 4 * above <= at->columns;
    const char *why = NULL;
    size_t most, as_edge, within;
    uint32_t gid = 0;
    SL_TRY(find_most(reader->context, at->gids, count, &gid, &most));
    SL_TRY(count_as_edge(reader->context, at, &as_edge));
    SL_TRY(count_within(reader->context, at, &within));
    if (only && !floor && 5 * empty >= count && 20 * bare <= edge) {
        why = "its tiles lie all around its edge";
    } else if (only && !floor && air && 2 * below >= at->columns) {
        why = "its tiles lie below and not above, as in a platformer";
    } else if (reader->guess_layer == find_ground(reader) && air && 5 * below >= 2 * at->columns) {
        why = "it is named for ground, with air above it";
    } else if (only && !floor && layer->kind != SLI_GAME_GROUND && gid && !empty &&
               2 * most >= count && !on_edge(at, gid) && 20 * as_edge >= 19 * (count - most)) {
        reader->guessed = gid;
        why = "the most frequent tile does not come to its edge";
    } else if (only && !floor && 5 * empty >= count && is_side_view(reader, at)) {
        why = "other layers are those of a platformer";
    } else if (only && !floor && 2 * empty >= count && within >= (size_t)layer->count &&
               are_lines(at, (size_t)layer->count)) {
        why = "its tiles are lines about empty squares";
    }
    reader->guessed_all = why != NULL;
    reader->guess_why = why;
    return SL_OK;
}

sl_status sli_tiled_guess(sli_tiled_reader *reader, const uint32_t *gids, size_t columns,
                          size_t rows) {
    const look at = {gids, columns, rows};
    const sli_tiled_seen *layer = &reader->seen.items[reader->guess_layer];
    const size_t count = columns * rows, empty = count - (size_t)layer->count;
    const bool floor = layer->kind == SLI_GAME_FLOOR;
    size_t most;
    uint32_t gid = 0;
    bool on_most;
    if (layer->squares != count) return SL_OK; // one chunk of several
    SL_TRY(find_most(reader->context, gids, count, &gid, &most));
    const sli_tiled_stand stand =
        sli_tiled_where_objects_stand(reader, gids, columns, rows, gid, &on_most);
    SL_TRY(guess_by_name(reader, &at, on_most));
    if (!reader->guess_why) SL_TRY(guess_by_look(reader, &at));
    if (reader->guess_why || !reader->guess_only) return SL_OK;
    if (!floor && stand == SLI_TILED_STAND_ON_EMPTY && 10 * layer->count >= count_about(&at)) {
        reader->guessed_all = true;
        reader->guess_why = "objects stand where it has no tiles";
    } else if (stand == SLI_TILED_STAND_ON_TILES && 10 * empty >= count) {
        reader->guess_why = "objects stand on its tiles";
    } else if (!floor && 10 * layer->count >= count_about(&at) && start_beside(reader, &at)) {
        reader->guessed_all = true;
        reader->guess_why = "starts stand where it has no tiles";
    }
    return SL_OK;
}

sl_status sli_tiled_begin_guess(sli_tiled_reader *reader) {
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
