/// Tiled's maps, TMX and JSON, as Tiled's manual has them. Both come here as one JSON tree.
///
/// First it is decided what is solid: the layers that the user asks for; else what layers, tiles
/// and objects say of themselves; else a guess, which is reported. Then solid tiles are gathered
/// grid by grid, and shapes are drawn by the pen.
#include "io/tiled.h"
#include "io/names.h"
#include "io/shapes.h"
#include "sightline/io.h"

#include <stdlib.h>

// --- the layers asked for: NAME takes all tiles of a layer, or all layers of a group;
// --- NAME:28+33-35 the tiles of these numbers

/// Whether a word of the list is a layer's name, with its tiles or without.
static bool names(sli_word word, const char *layer, sli_word *gids) {
    const size_t length = strlen(layer);
    *gids = (sli_word){word.at + word.length, 0};
    if (sli_word_is(word, layer)) return true;
    if (word.length <= length || word.at[length] != ':' || memcmp(word.at, layer, length) != 0)
        return false;
    *gids = (sli_word){word.at + length + 1, word.length - length - 1};
    return true;
}

/// Whether a layer of this name is in the list; `*gids` gets its tiles' numbers, of no length for
/// all.
static bool tiled_asked_for(const char *list, const char *layer, sli_word *gids) {
    for (sli_word word; sli_layers_next(&list, &word);)
        if (names(word, layer, gids)) return true;
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
static bool next_range(sli_word *gids, uint64_t *low, uint64_t *high) {
    if (!next_number(gids, low)) return false;
    *high = *low;
    if (gids->length && gids->at[0] == '-') {
        *gids = (sli_word){gids->at + 1, gids->length - 1};
        if (!next_number(gids, high)) return false;
    }
    if (gids->length && gids->at[0] == '+')
        *gids = (sli_word){gids->at + 1, gids->length - 1};
    else if (gids->length)
        return false;
    return true;
}

/// Whether a tile is among the numbers; any tile is among none.
static bool tiled_among(sli_word gids, uint32_t gid) {
    if (!gids.length) return true;
    for (uint64_t low, high; gids.length && next_range(&gids, &low, &high);)
        if (gid >= low && gid <= high) return true;
    return false;
}

static bool are_numbers(sli_word gids) {
    for (uint64_t low, high; gids.length;)
        if (!next_range(&gids, &low, &high)) return false;
    return true;
}

/// Looks for a layer in a list of layers and in its groups.
static bool find_layer(const sli_json *layers, sli_word word, sli_word *gids) {
    for (size_t i = 0; i < json_array_size(layers->value); i++) {
        const sli_json layer = sli_json_item(layers, i), name = sli_json_member(&layer, "name");
        const sli_json inner = sli_json_member(&layer, "layers");
        const char *text = json_string_value(name.value);
        if (text && names(word, text, gids)) return true;
        if (find_layer(&inner, word, gids)) return true;
    }
    return false;
}

/// SL_BAD_ARGUMENT where the list names a layer that `map` has not, or its numbers are none.
static sl_status tiled_check_choice(const sli_json *map, const char *list) {
    const sli_json layers = sli_json_member(map, "layers");
    for (sli_word word; list && sli_layers_next(&list, &word);) {
        sli_word gids;
        if (!find_layer(&layers, word, &gids))
            return sl_fail(map->file->context, SL_BAD_ARGUMENT, "%s: there is no layer '%s'",
                           map->file->name, sli_show(word).text);
        if (!are_numbers(gids))
            return sl_fail(map->file->context, SL_BAD_ARGUMENT,
                           "%s: layer '%s': expected tile numbers such as 28+33-35 behind the ':'",
                           map->file->name, sli_show(word).text);
    }
    return SL_OK;
}

// --- reading a map

typedef struct tiled {
    sl_context *context;
    const sl_import_options *options;
    const sli_json *map;
    sl_point tile; ///< the size of the map's tiles, pixels
    double top;    ///< the file's y that is 0 in the map, which has y up
    sli_tiled_sets sets;
    sli_tiles tiles;
    sli_pen pen;
    bool guess;          ///< nothing says what is solid: the first tile layer is guessed from
    uint32_t guessed;    ///< the tile that is taken as solid, 0 where the empty squares are
    char guessed_of[64]; ///< and its layer
    size_t solid_layers, solid_tiles, shapes, objects; ///< taken
    size_t other_layers, other_objects, other_shapes;  ///< left out
    size_t unknown_tiles;                              ///< of tilesets that cannot be read
    sli_things things;
    sli_tiled_templates templates;
} tiled;

/// A layer's place, and what is said of it, its groups included.
typedef struct place {
    sl_point offset; ///< pixels, y down
    sli_tiled_word word;
    sli_word gids; ///< the tiles that are asked for; of no length for all
    bool asked;
} place;

static const char *text_of(const sli_json *parent, const char *key) {
    const sli_json member = sli_json_member(parent, key);
    const char *text = json_string_value(member.value);
    return text ? text : "";
}

/// Where a layer lies in its group's place, and whether it is solid.
static sl_status find_place(const tiled *reader, const sli_json *layer, const place *outer,
                            place *own) {
    const sli_json x = sli_json_member(layer, "offsetx"), y = sli_json_member(layer, "offsety");
    const char *name = text_of(layer, "name");
    sl_point offset = {0};
    SL_TRY(sli_json_number_if(&x, &offset.x));
    SL_TRY(sli_json_number_if(&y, &offset.y));
    *own = *outer;
    own->offset = (sl_point){outer->offset.x + offset.x, outer->offset.y + offset.y};
    if (reader->options->layers) {
        sli_word gids;
        if (tiled_asked_for(reader->options->layers, name, &gids)) {
            own->asked = true;
            own->gids = gids;
        }
        own->word = own->asked ? SLI_TILED_SOLID : SLI_TILED_OPEN;
        return SL_OK;
    }
    const sli_tiled_word said = sli_tiled_word_of(layer, "class");
    if (said != SLI_TILED_UNSAID)
        own->word = said;
    else if (sli_says_solid(name))
        own->word = SLI_TILED_SOLID;
    return SL_OK;
}

// --- tiles

/// A rectangle of tiles: a whole layer, or a chunk of one.
typedef struct block {
    sl_point corner; ///< the upper left one, pixels, y down
    size_t columns, rows;
    const uint32_t *gids;
    char *squares;
} block;

/// From a tile's own pixels, y down, to the map: turned as its number says, its lower left corner
/// on that of its square.
static sli_affine affine_of_tile(const tiled *reader, const block *all, size_t at,
                                 const sli_tiled_set *set) {
    const uint32_t gid = all->gids[at];
    const bool diagonal = gid & SLI_TILED_DIAGONAL;
    const double width = diagonal ? set->height : set->width;
    const double height = diagonal ? set->width : set->height;
    const double left = all->corner.x + (double)(at % all->columns) * reader->tile.x + set->x;
    const double low = all->corner.y + (double)(at / all->columns + 1) * reader->tile.y + set->y;
    sli_affine turn = SLI_AFFINE_NONE;
    if (diagonal) turn = (sli_affine){.xy = 1, .yx = 1};
    if (gid & SLI_TILED_ACROSS)
        turn = sli_affine_after((sli_affine){.xx = -1, .yy = 1, .x0 = width}, turn);
    if (gid & SLI_TILED_DOWN)
        turn = sli_affine_after((sli_affine){.xx = 1, .yy = -1, .y0 = height}, turn);
    const sli_affine move = {.xx = 1, .yy = 1, .x0 = left, .y0 = low - height};
    return sli_affine_after(reader->pen.affine, sli_affine_after(move, turn));
}

/// Whether a tile's shape covers all of its square.
static bool covers(const tiled *reader, const sli_tiled_set *set, const sli_tiled_shape *shape) {
    return shape->kind == SLI_TILED_RECTANGLE && shape->rotation == 0 && shape->x <= 0 &&
           shape->y <= 0 && shape->x + shape->width >= set->width &&
           shape->y + shape->height >= set->height && set->width == reader->tile.x &&
           set->height == reader->tile.y && set->x == 0 && set->y == 0;
}

/// Gives the next shape a number and a name. Shapes of tilesets stand in other files than the map,
/// so that a line of its own would say nothing.
static sl_status name_shape(tiled *reader, const char *label) {
    reader->pen.map->lines_are_items = true;
    return sl_map_add_label(reader->context, reader->pen.map, ++reader->pen.item, label);
}

static sl_status name_tile_shape(tiled *reader, uint32_t gid, size_t number) {
    char label[SL_LINE_TEXT];
    snprintf(label, sizeof label, "tile %u, shape %zu", (unsigned)(gid & SLI_TILED_TILE),
             number + 1);
    return name_shape(reader, label);
}

/// "layer Walls, object 12 'crate', line 40"
static sl_status name_object(tiled *reader, const sli_json *layer, const sli_json *object,
                             const sli_tiled_shape *shape) {
    const char *const names[] = {text_of(layer, "name"), text_of(object, "name")};
    const sli_json number = sli_json_member(object, "id");
    int64_t id = 0;
    char label[SL_LINE_TEXT];
    SL_TRY(sli_json_whole_if(&number, INT32_MIN, INT32_MAX, &id));
    int used = snprintf(label, sizeof label, "layer %s, object %d",
                        sli_show((sli_word){names[0], strlen(names[0])}).text, (int)id);
    if (*names[1])
        used += snprintf(label + used, sizeof label - (size_t)used, " '%s'",
                         sli_show((sli_word){names[1], strlen(names[1])}).text);
    if (shape->line)
        snprintf(label + used, sizeof label - (size_t)used, ", line %u", (unsigned)shape->line);
    return name_shape(reader, label);
}

static sl_status draw_tile_shapes(tiled *reader, const block *all, size_t at,
                                  const sli_tiled_set *set, json_t *shapes) {
    const sli_json list = {
        .file = set->file.root ? &set->file : reader->map->file, .value = shapes, .key = "objects"};
    const sli_affine outer = reader->pen.affine;
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < json_array_size(shapes); i++) {
        const sli_json object = sli_json_item(&list, i);
        sli_tiled_shape shape;
        SL_TRY(sli_tiled_read_shape(&object, &shape));
        if (covers(reader, set, &shape)) {
            all->squares[at] = '#';
            reader->solid_tiles++;
            continue;
        }
        *(shape.kind < SLI_TILED_PICTURE ? &reader->shapes : &reader->other_shapes) += 1;
        if (shape.kind >= SLI_TILED_PICTURE) continue;
        SL_TRY(name_tile_shape(reader, all->gids[at], i));
        reader->pen.affine = affine_of_tile(reader, all, at, set);
        status = sli_tiled_draw_shape(&reader->pen, &shape);
        reader->pen.affine = outer;
    }
    return status;
}

/// A door's square is solid where it lies in a solid layer, or is drawn to collide with: if no
/// passage is found for the door, it stays so.
static sl_status take_door(tiled *reader, const place *at, const block *all, size_t i,
                           const sli_tiled_tile *tile) {
    if (at->word == SLI_TILED_SOLID || tile->word == SLI_TILED_SOLID || tile->shapes)
        all->squares[i] = '#';
    return sli_things_add_square(&reader->things, &tile->says, i % all->columns, i / all->columns);
}

/// What a tile's set says of it.
static sli_tiled_word word_of_tile(const sli_tiled_set *set, const sli_tiled_tile *tile) {
    if (tile && tile->word != SLI_TILED_UNSAID) return tile->word;
    return set ? set->word : SLI_TILED_UNSAID;
}

static sl_status take_tile(tiled *reader, const place *at, const block *all, size_t i) {
    const uint32_t gid = all->gids[i] & SLI_TILED_TILE;
    if (!gid) return SL_OK;
    const sli_tiled_set *set = sli_tiled_find_set(&reader->sets, gid);
    const sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
    const sli_tiled_word word = word_of_tile(set, tile);
    if (tile && tile->says.kind == SLI_THING_DOOR && !at->gids.length)
        return take_door(reader, at, all, i, tile);
    if (at->word == SLI_TILED_SOLID) {
        const bool solid = at->gids.length ? tiled_among(at->gids, gid) : word != SLI_TILED_OPEN;
        if (solid) all->squares[i] = '#';
        return SL_OK;
    }
    reader->unknown_tiles += set && set->missing;
    if (word == SLI_TILED_SOLID) {
        all->squares[i] = '#';
        reader->solid_tiles++;
    }
    if (word != SLI_TILED_UNSAID || !tile || !tile->shapes) return SL_OK;
    return draw_tile_shapes(reader, all, i, set, tile->shapes);
}

static int compare_gids(const void *left, const void *right) {
    const uint32_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

/// The tile that is taken as solid where nothing says what is: none (0) where some squares are
/// empty, else the most frequent one, the lowest of those.
static sl_status guess_tile(const tiled *reader, const block *all, uint32_t *guess) {
    const size_t count = all->columns * all->rows;
    uint32_t *sorted = sl_alloc_array(reader->context, count, sizeof *sorted);
    if (!sorted) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) sorted[i] = all->gids[i] & SLI_TILED_TILE;
    qsort(sorted, count, sizeof *sorted, compare_gids);
    size_t most = 0;
    *guess = 0;
    for (size_t i = 0, next; sorted[0] && i < count; i = next) {
        for (next = i; next < count && sorted[next] == sorted[i]; next++) continue;
        if (next - i <= most) continue;
        most = next - i;
        *guess = sorted[i];
    }
    sl_free(reader->context, sorted);
    return SL_OK;
}

static sl_status take_tiles(tiled *reader, const sli_json *layer, const place *at,
                            const block *all) {
    const size_t count = all->columns * all->rows;
    if (reader->guess && !*reader->guessed_of) {
        const char *name = text_of(layer, "name");
        snprintf(reader->guessed_of, sizeof reader->guessed_of, "'%s'",
                 sli_show((sli_word){name, strlen(name)}).text);
        SL_TRY(guess_tile(reader, all, &reader->guessed));
    }
    for (size_t i = 0; i < count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(reader->context));
        if (!reader->guess)
            SL_TRY(take_tile(reader, at, all, i));
        else if ((all->gids[i] & SLI_TILED_TILE) == reader->guessed)
            all->squares[i] = '#';
    }
    return sli_things_end_block(&reader->things, all->corner, reader->tile);
}

/// `holder` has the size; `corner` is where its first tile is.
static sl_status read_block(tiled *reader, const sli_json *layer, const sli_json *holder,
                            sl_point corner, const place *at) {
    const sli_json width = sli_json_member(holder, "width");
    const sli_json height = sli_json_member(holder, "height");
    const sli_json data = sli_json_member(holder, "data");
    int64_t columns, rows;
    SL_TRY(sli_json_whole(&width, 1, INT32_MAX, &columns));
    SL_TRY(sli_json_whole(&height, 1, INT32_MAX, &rows));
    if (columns * rows > INT32_MAX)
        return sli_json_fail(holder, "%lld x %lld tiles are more than can be read",
                             (long long)columns, (long long)rows);
    uint32_t *gids;
    SL_TRY(sli_tiled_read_data(layer, &data, (size_t)(columns * rows), &gids));
    block all = {.corner = corner, .columns = (size_t)columns, .rows = (size_t)rows, .gids = gids};
    sl_status status = sli_tiles_add(reader->context, &reader->tiles, reader->map->file->name,
                                     corner, reader->tile, all.columns, all.rows, &all.squares);
    if (status == SL_OK) status = take_tiles(reader, layer, at, &all);
    sl_free(reader->context, gids);
    return status;
}

static sl_status read_chunks(tiled *reader, const sli_json *layer, const sli_json *chunks,
                             const place *at) {
    size_t count;
    SL_TRY(sli_json_array(chunks, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json chunk = sli_json_item(chunks, i);
        const sli_json x = sli_json_member(&chunk, "x"), y = sli_json_member(&chunk, "y");
        int64_t column, row;
        SL_TRY(sli_json_object(&chunk));
        SL_TRY(sli_json_whole(&x, INT32_MIN, INT32_MAX, &column));
        SL_TRY(sli_json_whole(&y, INT32_MIN, INT32_MAX, &row));
        const sl_point corner = {at->offset.x + (double)column * reader->tile.x,
                                 at->offset.y + (double)row * reader->tile.y};
        SL_TRY(read_block(reader, layer, &chunk, corner, at));
    }
    return SL_OK;
}

static sl_status read_tile_layer(tiled *reader, const sli_json *layer, const place *at) {
    const sli_json chunks = sli_json_member(layer, "chunks");
    const sli_json infinite = sli_json_member(reader->map, "infinite");
    // Only the lowest layer is guessed from.
    if (reader->guess && *reader->guessed_of) return SL_OK;
    reader->solid_layers += at->word == SLI_TILED_SOLID;
    if (chunks.value) return read_chunks(reader, layer, &chunks, at);
    // A layer without bounds that nothing is drawn on has no chunk.
    if (sli_json_true(&infinite, NULL)) return SL_OK;
    return read_block(reader, layer, layer, at->offset, at);
}

// --- objects

static sli_tiled_word word_of_object(const tiled *reader, const sli_json *object,
                                     const sli_tiled_shape *shape) {
    const sli_tiled_word word = sli_tiled_word_of(object, "type");
    if (word != SLI_TILED_UNSAID) return word;
    if (sli_says_solid(text_of(object, "name"))) return SLI_TILED_SOLID;
    const uint32_t gid = shape->gid & SLI_TILED_TILE;
    const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
    return set ? word_of_tile(set, sli_tiled_find_tile(set, gid)) : SLI_TILED_UNSAID;
}

/// An object of a start or a door: `*taken` where it is one.
static sl_status take_thing(tiled *reader, const sli_json *object, const place *at, bool *taken) {
    sli_tiled_shape shape;
    SL_TRY(sli_tiled_read_shape(object, &shape));
    const char *class = text_of(object, "type");
    const uint32_t gid = shape.gid & SLI_TILED_TILE;
    const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
    const sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
    sli_says says = sli_tiled_says_of(object, "type");
    if (!says.kind && tile) says = tile->says;
    SL_TRY(sli_things_ask(&reader->things, text_of(object, "name"),
                          *class ? class : text_of(object, "class"), &says));
    *taken = says.kind != SLI_THING_NONE;
    if (!*taken) return SL_OK;
    if (set && shape.width == 0 && shape.height == 0) {
        shape.width = set->width;
        shape.height = set->height;
    }
    return sli_tiled_take_thing(&reader->things, &says, &shape, at->offset,
                                at->word == SLI_TILED_SOLID && shape.kind != SLI_TILED_OTHER);
}

/// The same for an instance of a template too.
static sl_status look_for_thing(tiled *reader, const sli_json *object, const place *at,
                                bool *taken) {
    sli_json_file file;
    sl_status status = sli_tiled_instance(&reader->templates, object, &file);
    const sli_json whole = sli_json_root(&file);
    if (status == SL_OK) status = take_thing(reader, file.root ? &whole : object, at, taken);
    sli_json_close(&file);
    return status;
}

/// The objects of a layer: starts and doors, and walls where the layer is not said to be open.
static sl_status read_objects(tiled *reader, const sli_json *layer, const place *at) {
    const sli_json objects = sli_json_member(layer, "objects");
    size_t count = 0;
    if (objects.value) SL_TRY(sli_json_array(&objects, &count));
    const sli_affine outer = reader->pen.affine;
    const sli_affine move = {.xx = 1, .yy = 1, .x0 = at->offset.x, .y0 = at->offset.y};
    reader->solid_layers += at->word == SLI_TILED_SOLID;
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        const sli_json object = sli_json_item(&objects, i);
        sli_tiled_shape shape;
        bool is_thing;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(sli_tiled_read_shape(&object, &shape));
        SL_TRY(look_for_thing(reader, &object, at, &is_thing));
        if (is_thing || at->word == SLI_TILED_OPEN) continue;
        const sli_tiled_word word = word_of_object(reader, &object, &shape);
        const bool taken =
            at->word == SLI_TILED_SOLID ? word != SLI_TILED_OPEN : word == SLI_TILED_SOLID;
        size_t *counted = !taken                          ? &reader->other_objects
                          : shape.kind == SLI_TILED_OTHER ? &reader->other_shapes
                                                          : &reader->objects;
        ++*counted;
        if (!taken || shape.kind == SLI_TILED_OTHER) continue;
        SL_TRY(name_object(reader, layer, &object, &shape));
        reader->pen.affine = sli_affine_after(outer, move);
        status = sli_tiled_draw_shape(&reader->pen, &shape);
        reader->pen.affine = outer;
    }
    return status;
}

// --- layers

static sl_status read_layers(tiled *reader, const sli_json *parent, const place *outer) {
    const sli_json layers = sli_json_member(parent, "layers");
    size_t count = 0;
    if (layers.value) SL_TRY(sli_json_array(&layers, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json layer = sli_json_item(&layers, i);
        SL_TRY(sli_json_object(&layer));
        const char *type = text_of(&layer, "type");
        place own;
        SL_TRY(find_place(reader, &layer, outer, &own));
        if (strcmp(type, "group") == 0)
            SL_TRY(read_layers(reader, &layer, &own));
        else if (own.word != SLI_TILED_OPEN && strcmp(type, "tilelayer") == 0)
            SL_TRY(read_tile_layer(reader, &layer, &own));
        else if (strcmp(type, "objectgroup") == 0 && !reader->guess)
            SL_TRY(read_objects(reader, &layer, &own));
        if (strcmp(type, "group") != 0 && !reader->guess)
            reader->other_layers +=
                own.word == SLI_TILED_OPEN ||
                (strcmp(type, "tilelayer") != 0 && strcmp(type, "objectgroup") != 0);
    }
    return SL_OK;
}

static sl_status read_head(tiled *reader) {
    const sli_json orientation = sli_json_member(reader->map, "orientation");
    const sli_json width = sli_json_member(reader->map, "tilewidth");
    const sli_json height = sli_json_member(reader->map, "tileheight");
    const sli_json rows = sli_json_member(reader->map, "height");
    const char *name = "orthogonal";
    int64_t count;
    SL_TRY(sli_json_object(reader->map));
    if (orientation.value) SL_TRY(sli_json_text(&orientation, &name));
    if (strcmp(name, "orthogonal") != 0)
        return sli_json_fail(&orientation, "'%s': only orthogonal maps are taken",
                             sli_show((sli_word){name, strlen(name)}).text);
    SL_TRY(sli_json_number(&width, &reader->tile.x));
    SL_TRY(sli_json_number(&height, &reader->tile.y));
    SL_TRY(sli_json_whole(&rows, 0, INT32_MAX, &count));
    reader->top = (double)count * reader->tile.y;
    reader->pen.affine = (sli_affine){.xx = 1, .yy = -1, .y0 = reader->top};
    return tiled_check_choice(reader->map, reader->options->layers);
}

/// Nothing says what is solid: the lowest tile layer is looked at once more.
static sl_status guess(tiled *reader) {
    sli_tiles_destroy(reader->context, &reader->tiles);
    reader->guess = true;
    SL_TRY(read_layers(reader, reader->map, &(place){0}));
    if (!*reader->guessed_of) return SL_OK;
    char tile[48] = "its empty squares are";
    if (reader->guessed)
        snprintf(tile, sizeof tile, "its most frequent tile, %u, is", (unsigned)reader->guessed);
    sl_note(reader->context,
            "%s: nothing in it says what is solid: layer %s is the lowest, and %s taken as solid; "
            "--layers NAME or NAME:TILE+TILE-TILE chooses",
            reader->map->file->name, reader->guessed_of, tile);
    return SL_OK;
}

static void give_account(const tiled *reader, size_t grids) {
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->top, top);
    sl_note(reader->context,
            "%s: taken: %zu layers solid as a whole, %zu tiles and %zu shapes of tiles by their "
            "tilesets, %zu objects; merged into %zu walls (grids of tiles: %zu); left out: %zu "
            "layers, %zu objects, %zu shapes of other kinds, %zu lines of no length, %zu tilesets "
            "not found; unit: pixels, y = %s - the file's y",
            reader->map->file->name, reader->solid_layers, reader->solid_tiles, reader->shapes,
            reader->objects, reader->pen.map->wall_count, grids, reader->other_layers,
            reader->other_objects, reader->other_shapes, reader->pen.points, reader->sets.missing,
            top);
}

/// A layer that is not solid as a whole has tiles of a tileset that cannot be read.
static sl_status fail_missing(const tiled *reader) {
    const char *missing = NULL;
    for (size_t i = reader->sets.sets.count; i-- > 0;)
        if (reader->sets.sets.items[i].missing) missing = reader->sets.sets.items[i].missing;
    return sli_json_fail(reader->map,
                         "its tileset '%s' cannot be read, and no layer says that it is solid; "
                         "--layers NAME chooses",
                         sli_show((sli_word){missing, strlen(missing)}).text);
}

static sl_status read_map(tiled *reader) {
    SL_TRY(read_head(reader));
    SL_TRY(sli_tiled_read_sets(reader->map, &reader->sets));
    SL_TRY(read_layers(reader, reader->map, &(place){0}));
    if (!reader->solid_layers && !reader->options->layers) {
        if (reader->unknown_tiles) return fail_missing(reader);
        if (!reader->solid_tiles && !reader->shapes && !reader->objects) SL_TRY(guess(reader));
    }
    reader->things.top = reader->top;
    reader->things.shapes = reader->pen.map->wall_count;
    const sli_tiles_options options = {.top = reader->top,
                                       .solid_between = reader->guess && !reader->guessed,
                                       .things = &reader->things};
    size_t grids;
    SL_TRY(sli_tiles_add_walls(reader->context, &reader->tiles, reader->map->file->name, &options,
                               reader->pen.map, &grids));
    if (!reader->pen.map->wall_count)
        return sli_json_fail(reader->map, "nothing in it says what is solid");
    give_account(reader, grids);
    return sli_things_finish(&reader->things, reader->pen.map);
}

/// Reads a tree, and closes its file.
static sl_status read_tree(sl_context *context, sli_json_file *file,
                           const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    const sli_json root = sli_json_root(file);
    tiled reader = {
        .context = context,
        .options = options,
        .map = &root,
        .things = {.context = context, .file = file->name, .options = options},
        .pen = {
            .context = context, .name = file->name, .map = &read, .tolerance = options->tolerance}};
    const sl_status status = read_map(&reader);
    sli_tiles_destroy(context, &reader.tiles);
    sli_tiled_destroy_sets(context, &reader.sets);
    sli_tiled_destroy_templates(context, &reader.templates);
    sli_things_destroy(&reader.things);
    sli_json_close(file);
    // The map's lines are numbers of shapes, if it has any: doors and starts are none of them.
    for (size_t i = 0; i < read.door_count && read.lines_are_items; i++) read.doors[i].line = 0;
    for (size_t i = 0; i < read.start_count && read.lines_are_items; i++) read.starts[i].line = 0;
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sl_map_read_tmx(sl_context *context, const char *name, const char *text, size_t size,
                          const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_tiled_from_xml(context, name, "map", text, size, &file));
    return read_tree(context, &file, options, map);
}

sl_status sl_map_read_tmj(sl_context *context, const char *name, const char *text, size_t size,
                          const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    return read_tree(context, &file, options, map);
}
