/// What to type for a map of Tiled: the layer that is most likely solid, as a command.
///
/// The command names the layer that is the most likely one: by its name, by where starts stand,
/// with gaps rather than full; what is hidden, named for chests and coins, or a scrap comes last.
/// Of a full layer it names tiles: all but the one that most of it is of, or those along its edge.
/// Where it is not sure, it says so.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"

#include <math.h>

void sli_tiled_add_layer(sli_tiled_layer_text *out, const sli_tiled_seen *layer) {
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

sli_tiled_layer_text sli_tiled_list_layers(const sli_tiled_reader *reader, bool taken) {
    sli_tiled_layer_text out = {.count = 0};
    for (size_t i = 0; i < reader->seen.count; i++)
        if (reader->seen.items[i].taken == taken && (taken || reader->seen.items[i].count))
            sli_tiled_add_layer(&out, &reader->seen.items[i]);
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

static bool is_hidden(const sli_tiled_reader *reader, const sli_tiled_seen *layer) {
    const sli_json json = {.file = reader->map->file, .value = layer->layer};
    const sli_json visible = sli_json_member(&json, "visible");
    bool said;
    const bool shown = sli_json_true(&visible, &said);
    return said && !shown;
}

/// Whether a layer is hidden in Tiled beside one that is shown and has more tiles: without a name
/// for what stops, it is a try or a scrap.
static bool is_try(const sli_tiled_reader *reader, const sli_tiled_seen *layer) {
    if (!is_hidden(reader, layer)) return false;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *other = &reader->seen.items[i];
        if (!other->objects && other->count > layer->count && !is_hidden(reader, other))
            return true;
    }
    return false;
}

/// Chests and beds that stand in rooms are not the rooms' walls, nor are those who walk there.
static bool is_furniture(const sli_tiled_seen *layer) {
    return sli_game_says_furniture(layer->name) || sli_game_says_other(layer->name);
}

/// The square of a start; false for what is none.
static bool find_square(const sli_tiled_reader *reader, const sli_thing *thing, double at[2]) {
    at[0] = floor(thing->middle.x / reader->lattice.step.x);
    at[1] = floor(thing->middle.y / reader->lattice.step.y);
    return thing->kind == SLI_THING_START;
}

/// Adds the starts on tiles of a layer or a chunk. It is not unpacked where none stands in it.
static sl_status add_starts(const sli_tiled_reader *reader, const sli_json *layer,
                            const sli_json *holder, sli_word numbers, size_t *on) {
    static const char *const keys[] = {"x", "y", "width", "height"};
    const sli_json data = sli_json_member(holder, "data");
    double box[4];
    uint32_t *gids = NULL;
    for (size_t i = 0; i < 4; i++) {
        const sli_json number = sli_json_member(holder, keys[i]);
        box[i] = i < 2 && holder == layer ? 0 : sli_json_number_or_0(&number);
    }
    for (size_t i = 0; i < reader->things.items.count; i++) {
        double at[2];
        if (!find_square(reader, &reader->things.items.items[i], at)) continue;
        const double x = at[0] - box[0], y = at[1] - box[1];
        if (!(x >= 0 && y >= 0 && x < box[2] && y < box[3])) continue;
        if (!gids) SL_TRY(sli_tiled_read_data(layer, &data, (size_t)(box[2] * box[3]), &gids));
        const uint32_t gid = gids[(size_t)(y * box[2] + x)] & SLI_TILED_TILE;
        *on += gid && sli_numbers_have(numbers, gid);
    }
    sl_free(reader->context, gids);
    return SL_OK;
}

sl_status sli_tiled_count_starts(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
                                 sli_word numbers, size_t counts[2]) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data");
    const sli_json chunks = sli_json_member(&layer, "chunks");
    size_t all = 0;
    double at[2];
    counts[0] = counts[1] = 0;
    const sli_tiled_orientation kind = reader->lattice.orientation;
    if (seen->objects || (kind != SLI_TILED_ORTHOGONAL && kind != SLI_TILED_ISOMETRIC))
        return SL_OK;
    for (size_t i = 0; i < reader->things.items.count; i++)
        all += find_square(reader, &reader->things.items.items[i], at);
    for (size_t i = 0; i < json_array_size(chunks.value); i++) {
        const sli_json chunk = sli_json_item(&chunks, i);
        SL_TRY(add_starts(reader, &layer, &chunk, numbers, &counts[0]));
    }
    if (!chunks.value && data.value)
        SL_TRY(add_starts(reader, &layer, &layer, numbers, &counts[0]));
    counts[1] = all > counts[0] ? all - counts[0] : 0;
    return SL_OK;
}

static sl_status rank_layer(const sli_tiled_reader *reader, const sli_tiled_seen *layer,
                            uint64_t largest, int *rank) {
    size_t starts[2];
    // What is named for ground and hidden is what one stands on.
    const bool ground = layer->kind == SLI_GAME_GROUND && is_hidden(reader, layer);
    *rank = SLI_TILED_NOT_SOLID;
    if (!may_be_walls(layer) && !ground) return SL_OK;
    SL_TRY(sli_tiled_count_starts(reader, layer, (sli_word){0}, starts));
    const bool full = is_full(layer);
    const bool scraps = is_try(reader, layer) || is_furniture(layer) || 50 * layer->count < largest;
    *rank = layer->kind >= SLI_GAME_STANDS && (full || !starts[0]) ? SLI_TILED_NAMED
            : ground                                               ? SLI_TILED_BESIDE_STARTS
            : scraps                                               ? SLI_TILED_SCRAPS
            : full                                                 ? SLI_TILED_RANK_FULL
            : starts[0]                                            ? SLI_TILED_NOT_SOLID
            : starts[1]                                            ? SLI_TILED_BESIDE_STARTS
                                                                   : SLI_TILED_PARTIAL;
    return SL_OK;
}

sl_status sli_tiled_find_example(const sli_tiled_reader *reader, bool taken_too,
                                 sli_tiled_example *out) {
    uint64_t largest = 0;
    *out = (sli_tiled_example){.rank = -1};
    for (size_t i = 0; i < reader->seen.count; i++)
        if (!reader->seen.items[i].objects && !is_full(&reader->seen.items[i]) &&
            reader->seen.items[i].count > largest)
            largest = reader->seen.items[i].count;
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        int rank;
        if (!layer->count || !*layer->name || (layer->taken && !taken_too)) continue;
        SL_TRY(rank_layer(reader, layer, largest, &rank));
        out->likely += rank >= SLI_TILED_PARTIAL;
        if (rank <= out->rank) continue;
        out->rank = rank;
        out->layer = layer;
    }
    return SL_OK;
}

/// Whether the example is likely to be right. `mostly`: it is full, and most of it is one tile;
/// `same`: what is full is all of one tile.
static bool is_sure(const sli_tiled_reader *reader, const sli_tiled_example *example, bool mostly,
                    bool same) {
    const sli_tiled_seen *layer = example->layer;
    size_t tiles = 0, things = 0;
    for (size_t i = 0; i < reader->seen.count; i++) {
        tiles += !reader->seen.items[i].objects && reader->seen.items[i].count;
        things += reader->seen.items[i].objects && reader->seen.items[i].count;
    }
    if (layer->objects) return !tiles || (same && things == 1);
    if (example->rank == SLI_TILED_NAMED || mostly) return true;
    return example->likely == 1 && example->rank >= SLI_TILED_PARTIAL &&
           2 * layer->count <= layer->squares;
}

/// Whether some object of a layer has a shape, is no point, and no start or door.
static bool has_shapes(const sli_tiled_reader *reader, const sli_tiled_seen *seen) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json objects = sli_json_member(&layer, "objects");
    for (size_t i = 0; i < json_array_size(objects.value); i++) {
        const sli_json object = sli_json_item(&objects, i);
        const sli_json width = sli_json_member(&object, "width");
        if (sli_tiled_says_of(&object, "type").kind != SLI_THING_NONE) continue;
        if (sli_json_number_or_0(&width) > 0 || sli_json_member(&object, "polygon").value ||
            sli_json_member(&object, "polyline").value)
            return true;
    }
    return false;
}

static const sli_tiled_seen *find_objects(const sli_tiled_reader *reader) {
    for (size_t i = 0; i < reader->seen.count; i++) {
        const sli_tiled_seen *layer = &reader->seen.items[i];
        if (layer->objects && layer->count && *layer->name && has_shapes(reader, layer))
            return layer;
    }
    return NULL;
}

sl_status sli_tiled_choose_tiles(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
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

bool sli_tiled_can_be_typed(const char *name) {
    const size_t length = strlen(name);
    for (size_t i = 0; i < length; i++)
        if ((unsigned char)name[i] < ' ' || strchr("',\x7f", name[i])) return false;
    return length && length < 160 && name[0] != ' ' && name[length - 1] != ' ';
}

/// A command with tiles of a full layer, as ":28+33-35": those along its edge, where walls are, if
/// they cover up to three fifths of it and no start stands on them; "" where they do not.
static sl_status find_edge(const sli_tiled_reader *reader, const sli_tiled_seen *seen,
                           const uint32_t *gids, char *text, size_t size) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json width = sli_json_member(&layer, "width");
    const size_t count = (size_t)seen->squares, columns = (size_t)sli_json_number_or_0(&width);
    const size_t rows = columns ? count / columns : 0;
    size_t starts[2], on_edge = 0, used = 0, most;
    *text = '\0';
    if (rows < 3 || columns < 3) return SL_OK;
    uint32_t *edge = sl_alloc_array(reader->context, 2 * (columns + rows), sizeof *edge);
    if (!edge) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const size_t x = i % columns, y = i / columns;
        const bool inner = x && y && x + 1 < columns && y + 1 < rows;
        if (!inner && (gids[i] & SLI_TILED_TILE)) edge[used++] = gids[i] & SLI_TILED_TILE;
    }
    const sl_status status =
        sli_numbers_write(reader->context, edge, used, false, &most, text + 1, size - 1);
    sl_free(reader->context, edge);
    SL_TRY(status);
    const sli_word numbers = {text + 1, strlen(text + 1)};
    for (size_t i = 0; i < count; i++)
        on_edge += sli_numbers_have(numbers, gids[i] & SLI_TILED_TILE);
    SL_TRY(sli_tiled_count_starts(reader, seen, numbers, starts));
    const bool all = numbers.length && numbers.length + SLI_TILED_NUMBER_ROOM < size;
    *text = all && 5 * on_edge <= 3 * count && !starts[0] ? ':' : '\0';
    return SL_OK;
}

/// The tile of three fourths of the upper row that is a fifth of all and not in the lowest row: the
/// air of a platformer; 0 for none.
static uint32_t find_air(const uint32_t *gids, size_t columns, size_t rows) {
    uint32_t air = 0;
    size_t votes = 0, above = 0, all = 0;
    for (size_t i = 0; i < columns; i++) {
        const uint32_t gid = gids[i] & SLI_TILED_TILE;
        if (!votes) air = gid;
        votes += gid == air ? 1 : -(size_t)1;
    }
    for (size_t i = 0; i < columns * rows; i++) {
        const bool own = (gids[i] & SLI_TILED_TILE) == air;
        if (own && i / columns + 1 == rows) return 0;
        above += own && i < columns;
        all += own;
    }
    return 4 * above >= 3 * columns && 5 * all >= columns * rows ? air : 0;
}

/// All tiles of a full layer but that of the air, as ":28+33-35", if no start stands on them; ""
/// where there is no such tile, or they are too many.
static sl_status find_others(const sli_tiled_reader *reader, const sli_tiled_seen *seen, char *text,
                             size_t size) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data"), width = sli_json_member(&layer, "width");
    const size_t count = (size_t)seen->squares, columns = (size_t)sli_json_number_or_0(&width);
    uint32_t *gids;
    size_t used = 0, most, starts[2] = {0};
    memset(text, 0, size);
    if (!is_full(seen) || !data.value || columns < 3 || count % columns || count / columns < 3)
        return SL_OK;
    SL_TRY(sli_tiled_read_data(&layer, &data, count, &gids));
    const uint32_t open = find_air(gids, columns, count / columns);
    for (size_t i = 0; open && i < count; i++) {
        const uint32_t gid = gids[i] & SLI_TILED_TILE;
        if (gid && gid != open) gids[used++] = gid;
    }
    sl_status status =
        sli_numbers_write(reader->context, gids, used, false, &most, text + 1, size - 1);
    sl_free(reader->context, gids);
    const sli_word numbers = {text + 1, strlen(text + 1)};
    if (status == SL_OK && numbers.length)
        status = sli_tiled_count_starts(reader, seen, numbers, starts);
    const bool all = numbers.length && numbers.length + SLI_TILED_NUMBER_ROOM < size;
    *text = all && !starts[0] ? ':' : '\0';
    return status;
}

/// That only the picture shows which tiles of a layer are solid, and their numbers.
static sl_status say_tiles(const sli_tiled_reader *reader, const sli_tiled_seen *seen, char *text,
                           size_t size) {
    const sli_json layer = {.file = reader->map->file, .value = seen->layer};
    const sli_json data = sli_json_member(&layer, "data");
    const size_t count = data.value ? (size_t)seen->squares : 0;
    const sli_shown name = sli_show((sli_word){seen->name, strlen(seen->name)});
    uint32_t *gids = NULL;
    char numbers[120] = "", edge[120] = "", next[600] = "";
    size_t most, used = 0;
    if (count) SL_TRY(sli_tiled_read_data(&layer, &data, count, &gids));
    sl_status status = count ? find_edge(reader, seen, gids, edge, sizeof edge) : SL_OK;
    for (size_t i = 0; i < count; i++)
        if (gids[i] & SLI_TILED_TILE) gids[used++] = gids[i] & SLI_TILED_TILE;
    if (status == SL_OK)
        status =
            sli_numbers_write(reader->context, gids, used, false, &most, numbers, sizeof numbers);
    const bool all = strlen(numbers) + SLI_TILED_NUMBER_ROOM < sizeof numbers;
    sl_free(reader->context, gids);
    const char *what = "those that lie along its edge";
    if (status == SL_OK && !*edge) {
        what = "all but the tile of its upper row";
        status = find_others(reader, seen, edge, sizeof edge);
    }
    if (*edge && sli_tiled_can_be_typed(seen->name))
        snprintf(next, sizeof next,
                 "; to take %s: sightline check '%.300s' --layers '%s%s' -o map.png", what,
                 reader->map->file->name, seen->name, edge);
    snprintf(text, size,
             "; which of the tiles %s%sof '%s' are solid, only its picture shows: a tile's number "
             "is its ID in Tiled + the tileset's firstgid%s",
             all ? numbers : "", all && *numbers ? " " : "", name.text, next);
    return status;
}

sl_status sli_tiled_say_example(const sli_tiled_reader *reader, sli_tiled_example best, char *text,
                                size_t size) {
    const char *file = reader->map->file->name;
    const sli_tiled_seen *example = best.layer;
    char tiles[120];
    bool mostly, rooms;
    size_t starts[2] = {0};
    SL_TRY(sli_tiled_choose_tiles(reader, example, &mostly, tiles, sizeof tiles));
    if (*tiles)
        SL_TRY(sli_tiled_count_starts(reader, example, (sli_word){tiles + 1, strlen(tiles + 1)},
                                      starts));
    mostly &= !starts[0];
    const bool full = !example->objects && is_full(example), same = full && !*tiles;
    const sli_tiled_seen *objects = same ? find_objects(reader) : NULL;
    if (objects) best.layer = example = objects;
    SL_TRY(looks_like_rooms(reader, example, &rooms));
    const char *name = example->name;
    const sli_shown shown = sli_show((sli_word){name, strlen(name)});
    const bool half = is_only_layer(reader) && 2 * example->count > example->squares;
    const bool open = example->kind == SLI_GAME_DRAWN || example->kind == SLI_GAME_PASS;
    if (best.rank == SLI_TILED_NOT_SOLID && open)
        snprintf(text, size, "; no layer is likely solid: draw walls in a layer Collision");
    else if (example->objects && !has_shapes(reader, example))
        snprintf(text, size, "; its objects have no shapes: draw walls in a layer Collision");
    else if (same && !objects)
        snprintf(text, size, "; all tiles of '%s' are the same: draw walls in a layer Collision",
                 shown.text);
    else if (rooms)
        snprintf(text, size,
                 "; to take the squares without tiles as solid: sightline check '%.300s' --layers "
                 "void -o map.png",
                 file);
    else if (!example->objects && !mostly && best.rank != SLI_TILED_NAMED && (full || half))
        return say_tiles(reader, example, text, size);
    else if (!sli_tiled_can_be_typed(name))
        snprintf(text, size, "; to take '%s', " SLI_TILED_RENAME, shown.text);
    else
        snprintf(text, size, "; %s: sightline check '%.300s' --layers '%s%s' -o map.png",
                 is_sure(reader, &best, mostly, same) ? "to take a layer as solid"
                                                      : "perhaps, if a look shows so",
                 file, name, tiles);
    return SL_OK;
}

/// Whether a layer without a name has something.
static bool has_nameless(const sli_tiled_reader *reader) {
    for (size_t i = 0; i < reader->seen.count; i++)
        if (reader->seen.items[i].count && !*reader->seen.items[i].name) return true;
    return false;
}

sl_status sli_tiled_fail_unsaid(const sli_tiled_reader *reader, const char *why) {
    const char *file = reader->map->file->name;
    sli_tiled_example example;
    const sli_tiled_layer_text taken = sli_tiled_list_layers(reader, true),
                               others = sli_tiled_list_layers(reader, false);
    const char *between = taken.count && others.count ? ", " : "";
    char as[1400];
    SL_TRY(sli_tiled_find_example(reader, true, &example));
    if (!reader->seen.count) return sli_json_fail(reader->map, "%s; it has no layers", why);
    if (!example.layer && has_nameless(reader))
        return sli_json_fail(reader->map, "%s; its layers have no names: name them in Tiled", why);
    if (!example.layer) return sli_json_fail(reader->map, "%s; all its layers are empty", why);
    SL_TRY(sli_tiled_say_example(reader, example, as, sizeof as));
    return sl_fail_at(reader->context, file, sli_json_line(reader->map), "%s%s; layers: %s%s%s",
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
        SL_TRY(sli_tiled_choose_tiles(reader, layer, &mostly, tiles, sizeof tiles));
        return sl_fail_at(reader->context, reader->map->file->name, sli_json_line(reader->map),
                          "layer '%s' has a tile on every square, so all is solid and there are no "
                          "walls; name its tiles that are solid, as in --layers '%s%s'%s",
                          sli_show(name).text, sli_show(name).text, tiles,
                          reader->options->layers
                              ? ", or leave --layers out: then the tiles that look solid are taken"
                              : "");
    }
    return sli_tiled_fail_unsaid(reader, "what it says is solid gives no walls");
}
