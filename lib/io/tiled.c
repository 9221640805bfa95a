/// Tiled's maps, TMX and JSON, as Tiled's manual has them. Both come here as one JSON tree.
///
/// First it is decided what is solid: the layers that the user asks for; else what layers, tiles
/// and objects say of themselves; else a guess, which is reported. Then solid tiles are gathered
/// grid by grid, and shapes are drawn by the pen. Maps of diamonds are read in the plan, where
/// diamonds are squares (tiled_lattice.c), and projected onto the screen at the end.
#include "io/tiled.h"
#include "io/names.h"
#include "io/shapes.h"
#include "sightline/io.h"

#include <math.h>
#include <stdlib.h>

/// Layers of staggered and hexagonal maps are moved by no more pixels.
#define FARTHEST 1e9
/// So many squares of staggered layers and no more.
#define MOST_TURNED ((size_t)1 << 27)

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
    sli_tiled_lattice lattice;
    double top;          ///< the plan's y that is 0 for the pen, which has y up
    sli_affine to_plan;  ///< from the screen
    sl_point offset;     ///< staggered and hexagonal: of the layers with tiles
    sli_tiled_range all; ///< and their tiles
    size_t turned;       ///< squares of staggered blocks
    sli_tiled_sets sets;
    sli_tiles tiles;
    sli_pen pen;
    bool guess;          ///< nothing says what is solid: the first tile layer is guessed from
    uint32_t guessed;    ///< the tile that is taken as solid, 0 where the empty squares are
    char guessed_of[64]; ///< and its layer
    size_t solid_layers, solid_tiles, shapes, objects; ///< taken
    size_t other_layers, other_objects, other_shapes;  ///< left out
    size_t unknown_tiles;                              ///< of tilesets that cannot be read
    size_t doors_left_out;                             ///< tiles that are doors and hexagons
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

/// A rectangle of tiles: a whole layer, or a chunk of one. Staggered ones are turned in the plan,
/// so that their squares are more than their tiles.
typedef struct block {
    sl_point offset;     ///< the layer's, on the screen
    sl_point corner;     ///< the upper left one in the plan
    int64_t column, row; ///< of the first tile
    size_t columns, rows;
    const uint32_t *gids;
    char *squares;
    sli_tiled_range range; ///< of the squares
} block;

static char *square_of(const tiled *reader, const block *all, size_t i) {
    int64_t column = all->column + (int64_t)(i % all->columns);
    int64_t row = all->row + (int64_t)(i / all->columns);
    sli_tiled_square_of(&reader->lattice, &column, &row);
    const int64_t width = all->range.right - all->range.left;
    return all->squares + (row - all->range.top) * width + (column - all->range.left);
}

/// Tiles of hexagonal maps turn about their middles, and are mirrored before that.
static sli_affine turn_hexagon(uint32_t gid, const sli_tiled_set *set) {
    const double degrees =
        (gid & SLI_TILED_DIAGONAL ? 60 : 0) + (gid & SLI_TILED_HEXAGON_120 ? 120 : 0);
    const sli_affine move = {.xx = gid & SLI_TILED_ACROSS ? -1 : 1,
                             .yy = gid & SLI_TILED_DOWN ? -1 : 1};
    const sl_point middle = {set->width / 2, set->height / 2};
    sli_affine turn = sli_affine_after(sli_affine_turn(degrees), move);
    const sl_point moved = sli_affine_apply(turn, middle);
    turn.x0 = middle.x - moved.x;
    turn.y0 = middle.y - moved.y;
    return turn;
}

/// Turns a tile's pixels as its number says. `*out_height` gets how high it is then.
static sli_affine turn_tile(const tiled *reader, uint32_t gid, const sli_tiled_set *set,
                            double *out_height) {
    *out_height = set->height;
    if (reader->lattice.orientation == SLI_TILED_HEXAGONAL) return turn_hexagon(gid, set);
    const bool diagonal = gid & SLI_TILED_DIAGONAL;
    const double width = diagonal ? set->height : set->width;
    const double height = diagonal ? set->width : set->height;
    sli_affine turn = SLI_AFFINE_NONE;
    if (diagonal) turn = (sli_affine){.xy = 1, .yx = 1};
    if (gid & SLI_TILED_ACROSS)
        turn = sli_affine_after((sli_affine){.xx = -1, .yy = 1, .x0 = width}, turn);
    if (gid & SLI_TILED_DOWN)
        turn = sli_affine_after((sli_affine){.xx = 1, .yy = -1, .y0 = height}, turn);
    *out_height = height;
    return turn;
}

/// From the diamond in which the shapes of isometric sets are drawn to the tile's pixels.
static sli_affine affine_of_diamond(const sli_tiled_set *set) {
    const sl_point size = set->diamond;
    if (size.x == 0) return SLI_AFFINE_NONE;
    const double x = size.x / (2 * size.y);
    return (sli_affine){
        .xx = x, .xy = -x, .x0 = size.x / 2, .yx = 0.5, .yy = 0.5, .y0 = set->height - size.y};
}

/// From where a tile's shapes are drawn to the map: turned as its number says, its lower left
/// corner on that of the box of its place.
static sli_affine affine_of_tile(const tiled *reader, const block *all, size_t at,
                                 const sli_tiled_set *set) {
    const int64_t column = all->column + (int64_t)(at % all->columns);
    const int64_t row = all->row + (int64_t)(at / all->columns);
    const sl_point box = sli_tiled_tile_at(&reader->lattice, column, row);
    double height;
    const sli_affine turn = turn_tile(reader, all->gids[at], set, &height);
    const sli_affine move = {.xx = 1,
                             .yy = 1,
                             .x0 = all->offset.x + box.x + set->x,
                             .y0 =
                                 all->offset.y + box.y + reader->lattice.tile.y + set->y - height};
    const sli_affine inner = sli_affine_after(turn, affine_of_diamond(set));
    const sli_affine outer = sli_affine_after(reader->pen.affine, reader->to_plan);
    return sli_affine_after(outer, sli_affine_after(move, inner));
}

/// Whether a tile's shape covers all of its place.
static bool covers(const tiled *reader, const sli_tiled_set *set, const sli_tiled_shape *shape) {
    const sl_point tile = reader->lattice.tile;
    const bool plan = sli_tiled_has_plan(&reader->lattice);
    if (reader->lattice.orientation == SLI_TILED_HEXAGONAL || plan != (set->diamond.x > 0))
        return false;
    const sl_point size = plan ? set->diamond : (sl_point){set->width, set->height};
    // A diamond's shapes are drawn in a square as wide as it is high.
    const sl_point end = plan ? (sl_point){size.y, size.y} : size;
    return shape->kind == SLI_TILED_RECTANGLE && shape->rotation == 0 && shape->x <= 0 &&
           shape->y <= 0 && shape->x + shape->width >= end.x && shape->y + shape->height >= end.y &&
           size.x == tile.x && size.y == tile.y && set->x == 0 && set->y == 0;
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
            *square_of(reader, all, at) = '#';
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

/// A door of one staggered tile. Its neighbours are other doors.
static sl_status add_diamond_door(tiled *reader, const block *all, size_t i,
                                  const sli_tiled_tile *tile) {
    const sl_point step = reader->lattice.step;
    const size_t at = (size_t)(square_of(reader, all, i) - all->squares);
    const size_t width = (size_t)(all->range.right - all->range.left);
    const sli_thing door = {.kind = SLI_THING_DOOR,
                            .middle = {all->corner.x + ((double)(at % width) + 0.5) * step.x,
                                       all->corner.y + ((double)(at / width) + 0.5) * step.y},
                            .of_tiles = true,
                            .u = {step.x / 2, 0},
                            .v = {0, step.y / 2},
                            .open = tile->says.state != SLI_DOOR_SHUT};
    return sli_things_add(&reader->things, tile->says.name, door);
}

/// A door's square is solid where it lies in a solid layer, or is drawn to collide with: if no
/// passage is found for the door, it stays so.
static sl_status take_door(tiled *reader, const place *at, const block *all, size_t i,
                           const sli_tiled_tile *tile) {
    if (at->word == SLI_TILED_SOLID || tile->word == SLI_TILED_SOLID || tile->shapes)
        *square_of(reader, all, i) = '#';
    if (reader->lattice.orientation == SLI_TILED_HEXAGONAL) {
        reader->doors_left_out++;
        return SL_OK;
    }
    if (reader->lattice.orientation == SLI_TILED_STAGGERED)
        return add_diamond_door(reader, all, i, tile);
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
        if (solid) *square_of(reader, all, i) = '#';
        return SL_OK;
    }
    reader->unknown_tiles += set && set->missing;
    if (word == SLI_TILED_SOLID) {
        *square_of(reader, all, i) = '#';
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
            *square_of(reader, all, i) = '#';
    }
    return sli_things_end_block(&reader->things, all->corner, reader->lattice.step);
}

/// Where the block lies in the plan. A staggered one has squares that are none of its tiles.
static sl_status add_block(tiled *reader, block *all) {
    const sli_tiled_lattice *lattice = &reader->lattice;
    const sli_tiled_range tiles = {all->column, all->row, all->column + (int64_t)all->columns,
                                   all->row + (int64_t)all->rows};
    sli_tiled_plan_range(lattice, &tiles, &all->range);
    sli_affine to_plan = reader->to_plan;
    to_plan.x0 = to_plan.y0 = 0;
    sl_point origin = sli_affine_apply(to_plan, all->offset);
    if (lattice->orientation == SLI_TILED_HEXAGONAL) origin = (sl_point){0};
    all->corner = (sl_point){origin.x + (double)all->range.left * lattice->step.x,
                             origin.y + (double)all->range.top * lattice->step.y};
    const size_t columns = (size_t)(all->range.right - all->range.left);
    const size_t rows = (size_t)(all->range.bottom - all->range.top);
    if (lattice->orientation == SLI_TILED_STAGGERED) {
        // A few long rows make large blocks: a short file must not ask for all memory.
        reader->turned += columns > MOST_TURNED / rows ? MOST_TURNED : columns * rows;
        if (reader->turned >= MOST_TURNED)
            return sli_json_fail(reader->map,
                                 "its staggered layers or chunks are too large: together they span "
                                 "more than 2^27 places");
    }
    SL_TRY(sli_tiles_add(reader->context, &reader->tiles, reader->map->file->name, all->corner,
                         lattice->step, columns, rows, &all->squares));
    if (lattice->orientation != SLI_TILED_STAGGERED) return SL_OK;
    memset(all->squares, ' ', columns * rows);
    for (size_t i = 0; i < all->columns * all->rows; i++) *square_of(reader, all, i) = '.';
    return SL_OK;
}

/// Staggered and hexagonal maps have one lattice: layers with other offsets may have no solid tile.
static sl_status check_offset(tiled *reader, const sli_json *holder, const block *all) {
    sli_tiled_range *range = &reader->all;
    const bool first = reader->tiles.blocks.count == 1;
    if (reader->lattice.orientation != SLI_TILED_STAGGERED &&
        reader->lattice.orientation != SLI_TILED_HEXAGONAL)
        return SL_OK;
    if (fabs(all->offset.x) > FARTHEST || fabs(all->offset.y) > FARTHEST)
        return sli_json_fail(holder, "its offset is out of range");
    if (first) {
        reader->offset = all->offset;
        *range = (sli_tiled_range){all->column, all->row, all->column, all->row};
    }
    if (all->offset.x == reader->offset.x && all->offset.y == reader->offset.y) {
        const int64_t right = all->column + (int64_t)all->columns;
        const int64_t bottom = all->row + (int64_t)all->rows;
        if (all->column < range->left) range->left = all->column;
        if (all->row < range->top) range->top = all->row;
        if (right > range->right) range->right = right;
        if (bottom > range->bottom) range->bottom = bottom;
        return SL_OK;
    }
    for (size_t i = 0; i < all->columns * all->rows; i++)
        if (*square_of(reader, all, i) == '#')
            return sli_json_fail(holder, "layers of tiles that are moved differently are taken in "
                                         "orthogonal and isometric maps only");
    sl_free(reader->context, reader->tiles.blocks.items[--reader->tiles.blocks.count].squares);
    return SL_OK;
}

/// `holder` has the size; `column` and `row` are those of its first tile.
static sl_status read_block(tiled *reader, const sli_json *layer, const sli_json *holder,
                            int64_t column, int64_t row, const place *at) {
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
    block all = {.offset = at->offset,
                 .column = column,
                 .row = row,
                 .columns = (size_t)columns,
                 .rows = (size_t)rows,
                 .gids = gids};
    sl_status status = add_block(reader, &all);
    if (status == SL_OK) status = take_tiles(reader, layer, at, &all);
    if (status == SL_OK) status = check_offset(reader, holder, &all);
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
        SL_TRY(read_block(reader, layer, &chunk, column, row, at));
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
    return read_block(reader, layer, layer, 0, 0, at);
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

/// Reads an object. In an isometric map it lies in the plan, but turns on the screen. A tile as an
/// object stands upright there: on the diamond as wide as itself whose lowest corner is its place.
static sl_status read_shape(const tiled *reader, const sli_json *object, sli_tiled_shape *shape) {
    const sli_tiled_lattice *lattice = &reader->lattice;
    SL_TRY(sli_tiled_read_shape(object, shape));
    if (lattice->orientation != SLI_TILED_ISOMETRIC) return SL_OK;
    if (shape->kind == SLI_TILED_PICTURE) {
        const uint32_t gid = shape->gid & SLI_TILED_TILE;
        const sli_tiled_set *set = sli_tiled_find_set(&reader->sets, gid);
        const double own = shape->width != 0 ? shape->width : set ? set->width : 0;
        const double width = own * lattice->tile.y / lattice->tile.x;
        shape->kind = SLI_TILED_RECTANGLE;
        shape->x -= width;
        shape->y -= width;
        shape->width = shape->height = width;
        return SL_OK;
    }
    if (shape->rotation == 0) return SL_OK;
    sli_affine to_screen = sli_tiled_to_screen(lattice), to_plan = reader->to_plan;
    to_screen.x0 = to_plan.x0 = to_plan.y0 = 0;
    shape->turn = sli_affine_after(to_plan, sli_affine_after(shape->turn, to_screen));
    return SL_OK;
}

/// From the objects of a layer to the plan.
static sli_affine affine_of_layer(const tiled *reader, const place *at) {
    const sli_affine move = {.xx = 1, .yy = 1, .x0 = at->offset.x, .y0 = at->offset.y};
    if (reader->lattice.orientation != SLI_TILED_ISOMETRIC)
        return sli_affine_after(reader->to_plan, move);
    sli_affine to_plan = reader->to_plan;
    to_plan.x0 = to_plan.y0 = 0;
    const sl_point offset = sli_affine_apply(to_plan, at->offset);
    return (sli_affine){.xx = 1, .yy = 1, .x0 = offset.x, .y0 = offset.y};
}

/// An object of a start or a door: `*taken` where it is one.
static sl_status take_thing(tiled *reader, const sli_json *object, const place *at, bool *taken) {
    sli_tiled_shape shape;
    SL_TRY(read_shape(reader, object, &shape));
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
    return sli_tiled_take_thing(&reader->things, &says, &shape, affine_of_layer(reader, at),
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
    const sli_affine move = affine_of_layer(reader, at);
    reader->solid_layers += at->word == SLI_TILED_SOLID;
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        const sli_json object = sli_json_item(&objects, i);
        sli_tiled_shape shape;
        bool is_thing;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(read_shape(reader, &object, &shape));
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
    sli_tiled_lattice *lattice = &reader->lattice;
    SL_TRY(sli_tiled_read_lattice(reader->map, lattice));
    const bool plan = sli_tiled_has_plan(lattice);
    reader->to_plan = sli_tiled_to_plan(lattice);
    reader->top = plan ? 0 : lattice->height;
    reader->pen.affine = (sli_affine){.xx = 1, .yy = -1, .y0 = reader->top};
    if (plan) {
        const sli_affine to_screen = sli_tiled_to_screen(lattice);
        const sli_affine up = {.xx = 1, .yy = -1, .y0 = lattice->height};
        reader->things.shown = sli_affine_after(up, to_screen);
        // No vector grows by more than this factor.
        reader->pen.tolerance /=
            hypot(hypot(to_screen.xx, to_screen.xy), hypot(to_screen.yx, to_screen.yy));
    }
    return tiled_check_choice(reader->map, reader->options->layers);
}

/// The names of the layers, for messages: 'Ground', 'Objects' (objects).
typedef struct layer_text {
    char text[320];
    size_t count, length;
} layer_text;

static void add_layers(const sli_json *parent, layer_text *out) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const char *name = text_of(&layer, "name"), *type = text_of(&layer, "type");
        const bool objects = strcmp(type, "objectgroup") == 0;
        if (strcmp(type, "group") == 0) add_layers(&layer, out);
        if (!objects && strcmp(type, "tilelayer") != 0) continue;
        char own[96];
        const int length =
            snprintf(own, sizeof own, "%s'%s'%s", out->count++ ? ", " : "",
                     sli_show((sli_word){name, strlen(name)}).text, objects ? " (objects)" : "");
        // Once a name does not fit, all later ones are left out too.
        if (out->length + (size_t)length + sizeof ", ..." > sizeof out->text) {
            if (out->length < sizeof out->text) strcpy(out->text + out->length, ", ...");
            out->length = sizeof out->text;
            continue;
        }
        memcpy(out->text + out->length, own, (size_t)length + 1);
        out->length += (size_t)length;
    }
}

static layer_text list_layers(const tiled *reader) {
    layer_text out = {.count = 0};
    add_layers(reader->map, &out);
    return out;
}

/// Nothing says what is solid: the lowest tile layer is looked at once more.
static sl_status guess(tiled *reader) {
    sli_tiles_destroy(reader->context, &reader->tiles);
    reader->turned = 0;
    reader->guess = true;
    SL_TRY(read_layers(reader, reader->map, &(place){0}));
    if (!*reader->guessed_of) return SL_OK;
    char tile[48] = "its empty squares are";
    layer_text layers = list_layers(reader);
    if (reader->guessed)
        snprintf(tile, sizeof tile, "its most frequent tile, %u, is", (unsigned)reader->guessed);
    sl_note(reader->context,
            "%s: nothing in it says what is solid: layer %s is the lowest, and %s taken as solid; "
            "--layers NAME or NAME:TILE+TILE-TILE chooses; layers: %s",
            reader->map->file->name, reader->guessed_of, tile, layers.text);
    return SL_OK;
}

static sl_status fail_no_walls(const tiled *reader) {
    const layer_text layers = list_layers(reader);
    const bool said = reader->options->layers || !reader->guess;
    return sli_json_fail(
        reader->map, "%s; %s%s",
        said ? "what it says is solid gives no walls" : "nothing in it says what is solid",
        layers.count ? "--layers NAME chooses; layers: " : "it has no layers", layers.text);
}

static void give_account(const tiled *reader, size_t grids) {
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->lattice.height, top);
    sl_note(reader->context,
            "%s: taken: %zu layers solid as a whole, %zu tiles and %zu shapes of tiles by their "
            "tilesets, %zu objects; merged into %zu walls (grids of tiles: %zu); left out: %zu "
            "layers, %zu objects, %zu shapes of other kinds, %zu lines of no length, %zu tilesets "
            "not found; unit: pixels, y = %s - the file's y",
            reader->map->file->name, reader->solid_layers, reader->solid_tiles, reader->shapes,
            reader->objects, reader->pen.map->wall_count, grids, reader->other_layers,
            reader->other_objects, reader->other_shapes, reader->pen.points, reader->sets.missing,
            top);
    if (reader->doors_left_out)
        sl_note(reader->context,
                "%s: left out: %zu tile%s of doors; in hexagonal maps only objects are doors",
                reader->map->file->name, reader->doors_left_out,
                reader->doors_left_out == 1 ? "" : "s");
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

// --- walls

/// All squares of the plan that are no staggered tiles of the map are solid, as what is beyond it.
static sl_status add_surroundings(tiled *reader) {
    if (reader->lattice.orientation != SLI_TILED_STAGGERED || !reader->tiles.blocks.count)
        return SL_OK;
    const sli_tiled_range *tiles = &reader->all;
    block all = {.offset = reader->offset,
                 .column = tiles->left,
                 .row = tiles->top,
                 .columns = (size_t)(tiles->right - tiles->left),
                 .rows = (size_t)(tiles->bottom - tiles->top)};
    if (all.columns > INT32_MAX / all.rows)
        return sli_json_fail(reader->map,
                             "its tiles are spread over %zu x %zu places: more than "
                             "2^26",
                             all.columns, all.rows);
    SL_TRY(add_block(reader, &all));
    const size_t width = (size_t)(all.range.right - all.range.left);
    const size_t count = width * (size_t)(all.range.bottom - all.range.top);
    // Tiles have a '.' already: they stay as they are in the other blocks.
    for (size_t i = 0; i < count; i++) all.squares[i] = all.squares[i] == ' ' ? '#' : ' ';
    return SL_OK;
}

/// Starts in solid hexagons are marked.
static void place_starts(tiled *reader, const sli_grid *grid) {
    const sli_tiled_lattice *lattice = &reader->lattice;
    const sl_point size = {lattice->stagger_x ? lattice->slope + lattice->side : lattice->tile.x,
                           lattice->stagger_x ? lattice->tile.y : lattice->slope + lattice->side};
    const int64_t left = (int64_t)grid->origin.x;
    const int64_t top = -(int64_t)grid->origin.y - (int64_t)grid->count;
    for (size_t i = 0; i < reader->things.items.count; i++) {
        sli_thing *thing = &reader->things.items.items[i];
        const sl_point at = {thing->middle.x - reader->offset.x,
                             thing->middle.y - reader->offset.y};
        if (!(fabs(at.x) < FARTHEST && fabs(at.y) < FARTHEST)) continue;
        const int64_t column = (int64_t)floor(at.x / size.x), row = (int64_t)floor(at.y / size.y);
        bool found = false, open = false;
        for (int64_t c = column - 1; c <= column + 1; c++)
            for (int64_t r = row - 1; r <= row + 1; r++) {
                if (!sli_tiled_in_hexagon(lattice, c, r, at)) continue;
                found = true;
                open |= !sli_grid_solid(grid, (size_t)(r - top), (size_t)(c - left));
            }
        thing->solid = found && !open;
    }
}

/// The walls of hexagons, in place of those of squares.
static sl_status add_hexagons(void *user, const sli_grid *grid, sl_map *map) {
    tiled *reader = user;
    place_starts(reader, grid);
    return sli_tiled_add_hexagons(reader->context, &reader->lattice, reader->offset, grid, map);
}

static sl_status add_tile_walls(tiled *reader, size_t *grids) {
    const bool hexagons = reader->lattice.orientation == SLI_TILED_HEXAGONAL;
    sl_map *map = reader->pen.map;
    reader->things.top = reader->top;
    reader->things.shapes = map->wall_count;
    SL_TRY(add_surroundings(reader));
    const sli_tiles_options options = {.top = hexagons ? 0 : reader->top,
                                       .solid_between = reader->guess && !reader->guessed,
                                       .things = hexagons ? NULL : &reader->things,
                                       .add_walls = hexagons ? add_hexagons : NULL,
                                       .user = reader};
    SL_TRY(sli_tiles_add_walls(reader->context, &reader->tiles, reader->map->file->name, &options,
                               map, grids));
    // Where squares tell nothing of objects that are doors, the walls of tiles do.
    if (hexagons || reader->lattice.orientation == SLI_TILED_STAGGERED)
        reader->things.shapes = map->wall_count;
    return SL_OK;
}

static sl_status read_map(tiled *reader) {
    SL_TRY(read_head(reader));
    SL_TRY(sli_tiled_read_sets(reader->map, &reader->sets));
    SL_TRY(read_layers(reader, reader->map, &(place){0}));
    if (!reader->solid_layers && !reader->options->layers) {
        if (reader->unknown_tiles) return fail_missing(reader);
        if (!reader->solid_tiles && !reader->shapes && !reader->objects) SL_TRY(guess(reader));
    }
    size_t grids;
    SL_TRY(add_tile_walls(reader, &grids));
    if (!reader->pen.map->wall_count) return fail_no_walls(reader);
    give_account(reader, grids);
    SL_TRY(sli_things_finish(&reader->things, reader->pen.map));
    return sli_tiled_project(reader->map, &reader->lattice, reader->pen.map);
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
