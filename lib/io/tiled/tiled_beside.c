/// Four doubts about what a map of Tiled says, which only a look at all of its tiles settles.
///
/// - Layers of tiles named for walls may be their picture only. Where others say what stops a
///   player (a layer "collisions", objects), and these lie on at least a third of the pictured
///   walls, they alone count: the picture runs on over doorways. Where they lie elsewhere, they are
///   furniture or borders, and the walls count, too. Looked at in orthogonal maps with bounds;
///   objects by their boxes.
/// - A layer without gaps, nearly all of whose tiles say that they are solid, is a floor with a
///   property that was set on all tiles. It would leave no room to stand in.
/// - A layer named for walls has tiles that say that they are solid, and others that do not. If the
///   first are at least half, a game asks the tiles: the others are doors that stand open.
/// - Objects named for borders, of which nothing else is said, count where tiles say what is solid
///   or have shapes to collide with. Alone they are a weaker word, as names of other layers are.
///
/// Time O(tiles + objects).
#include "io/tiled/tiled.h"

#include "io/parts/limits.h"

#include <math.h>

bool sli_tiled_all_solid(const sli_tiled_sets *sets, const uint32_t *gids, size_t count) {
    size_t any = 0, solid = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t gid = gids[i] & SLI_TILED_TILE;
        const sli_tiled_set *set = gid ? sli_tiled_find_set(sets, gid) : NULL;
        any += gid != 0;
        solid +=
            set && sli_tiled_word_of_tile(set, sli_tiled_find_tile(set, gid)) == SLI_TILED_SOLID;
    }
    return solid && 20 * any >= 19 * count && 20 * solid >= 19 * any;
}

/// The tiles of a layer.
typedef struct said_tiles {
    size_t all, solid, open; ///< those that say that they are solid, or open
    bool unknown;            ///< a tileset of some is missing
} said_tiles;

/// Adds the tiles of a layer or a chunk. Tiles of doors are open by themselves.
static sl_status count_said(const sli_tiled_reader *reader, const sli_json *layer,
                            const sli_json *holder, said_tiles *out) {
    const sli_json width = sli_json_member(holder, "width");
    const sli_json height = sli_json_member(holder, "height");
    const sli_json data = sli_json_member(holder, "data");
    int64_t columns, rows;
    uint32_t *gids;
    SL_TRY(sli_json_whole(&width, 1, INT32_MAX, &columns));
    SL_TRY(sli_json_whole(&height, 1, INT32_MAX, &rows));
    SL_TRY(sli_tiled_check_squares(reader, layer, columns, rows));
    const size_t count = (size_t)(columns * rows);
    SL_TRY(sli_tiled_read_data(layer, &data, count, &gids));
    for (size_t i = 0; i < count; i++) {
        const uint32_t gid = gids[i] & SLI_TILED_TILE;
        const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
        const sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
        const sli_tiled_word word = sli_tiled_word_of_tile(set, tile);
        const bool door = tile && tile->says.kind == SLI_THING_DOOR;
        out->all += gid != 0;
        out->unknown |= set && set->missing;
        out->solid += word == SLI_TILED_SOLID;
        out->open += word == SLI_TILED_OPEN && !door;
    }
    sl_free(reader->context, gids);
    return SL_OK;
}

/// Whether some tile of some set says what it is: else a layer need not be looked through.
static bool any_says(const sli_tiled_sets *sets) {
    for (size_t i = 0; i < sets->sets.count; i++) {
        const sli_tiled_set *set = &sets->sets.items[i];
        if (set->word != SLI_TILED_UNSAID) return true;
        for (size_t k = 0; k < set->tiles.count; k++)
            if (set->tiles.items[k].word != SLI_TILED_UNSAID) return true;
    }
    return false;
}

sl_status sli_tiled_ask_tiles(const sli_tiled_reader *reader, const sli_json *layer, bool stops,
                              sli_tiled_place *own) {
    const sli_json infinite = sli_json_member(reader->map, "infinite");
    const sli_json chunks = sli_json_member(layer, "chunks");
    said_tiles count = {0};
    if (!any_says(&reader->sets)) return SL_OK;
    if (!chunks.value && !sli_json_true(&infinite, NULL))
        SL_TRY(count_said(reader, layer, layer, &count));
    for (size_t i = 0; i < json_array_size(chunks.value); i++) {
        const sli_json chunk = sli_json_item(&chunks, i);
        SL_TRY(sli_json_object(&chunk));
        SL_TRY(count_said(reader, layer, &chunk, &count));
    }
    own->denied = count.open;
    if (!count.solid || count.solid + count.open == count.all || count.unknown) return SL_OK;
    // A few tiles that say nothing in a layer named for collision are no contradiction.
    if (stops && 10 * (count.solid + count.open) > 9 * count.all) return SL_OK;
    own->tiles_decide = !stops && 2 * count.solid >= count.all;
    own->said = count.solid;
    return SL_OK;
}

// --- pictures of walls

enum { PICTURED = 1, STOPS = 2 };

/// The squares of the map, and what lies on them.
typedef struct beside {
    const sli_tiled_reader *reader;
    char *squares;
    int32_t *boxes; ///< by corner of squares: where boxes begin and end (mark_boxes)
    size_t columns, rows;
} beside;

static size_t clamp(double at, size_t most) {
    return at > 0 ? (at < (double)most ? (size_t)at : most) : 0;
}

/// Keeps a box of pixels: the squares whose middles lie in it. At two of its corners it begins, at
/// the others it ends, so that sums along rows and columns are the number of boxes over a square.
static void keep_box(const beside *all, sl_point low, sl_point high) {
    const sl_point tile = all->reader->lattice.tile;
    const size_t left = clamp(ceil(low.x / tile.x - 0.5), all->columns);
    const size_t top = clamp(ceil(low.y / tile.y - 0.5), all->rows);
    const size_t right = clamp(ceil(high.x / tile.x - 0.5), all->columns);
    const size_t bottom = clamp(ceil(high.y / tile.y - 0.5), all->rows);
    const size_t width = all->columns + 1;
    if (left >= right || top >= bottom) return;
    all->boxes[top * width + left]++;
    all->boxes[top * width + right]--;
    all->boxes[bottom * width + left]--;
    all->boxes[bottom * width + right]++;
}

/// Marks the squares under all boxes.
static void mark_boxes(const beside *all) {
    const size_t width = all->columns + 1;
    for (size_t row = 0; row < all->rows; row++)
        for (size_t i = 0; i < all->columns; i++) {
            int32_t *at = &all->boxes[row * width + i];
            if (i) *at += at[-1];
            if (row) *at += *(at - width);
            if (i && row) *at -= *(at - width - 1);
            if (*at) all->squares[row * all->columns + i] |= STOPS;
        }
}

static void mark_object(const beside *all, const sli_json *object, const sli_tiled_place *at) {
    const char *const keys[] = {"x", "y", "width", "height"};
    double box[4];
    for (size_t i = 0; i < 4; i++) {
        const sli_json number = sli_json_member(object, keys[i]);
        box[i] = sli_json_number_or_0(&number);
    }
    const sl_point low = {at->offset.x + box[0], at->offset.y + box[1]};
    keep_box(all, low, (sl_point){low.x + box[2], low.y + box[3]});
}

static void mark_objects(const beside *all, const sli_json *layer, const sli_tiled_place *at) {
    const sli_json objects = sli_json_member(layer, "objects");
    for (size_t i = 0; i < json_array_size(objects.value); i++) {
        const sli_json object = sli_json_item(&objects, i);
        const sli_tiled_word word = sli_tiled_word_of(&object, "type");
        if (word == SLI_TILED_SOLID || (word == SLI_TILED_UNSAID && at->word == SLI_TILED_SOLID))
            mark_object(all, &object, at);
    }
}

/// Marks the tiles of a layer of walls, or of one that stops.
static sl_status mark_tiles(const beside *all, const sli_json *layer, char mark) {
    const sli_json data = sli_json_member(layer, "data"), width = sli_json_member(layer, "width");
    const sli_json height = sli_json_member(layer, "height");
    const double columns = sli_json_number_or_0(&width), rows = sli_json_number_or_0(&height);
    const size_t count = all->columns * all->rows;
    uint32_t *gids;
    if (columns != (double)all->columns || rows != (double)all->rows) return SL_OK;
    SL_TRY(sli_tiled_read_data(layer, &data, count, &gids));
    for (size_t i = 0; i < count; i++)
        if (gids[i] & SLI_TILED_TILE) all->squares[i] |= mark;
    sl_free(all->reader->context, gids);
    return SL_OK;
}

/// `outer` has the place of the group, and whether that is solid.
static sl_status mark_layers(const beside *all, const sli_json *parent,
                             const sli_tiled_place *outer) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const char *name = sli_json_text_of(&layer, "name");
        const char *type = sli_json_text_of(&layer, "type");
        const sli_tiled_word said = sli_tiled_word_of(&layer, "class");
        const sli_json x = sli_json_member(&layer, "offsetx"),
                       y = sli_json_member(&layer, "offsety");
        sli_tiled_place own = *outer;
        sl_point offset = {0};
        SL_TRY(sli_json_number_if(&x, &offset.x));
        SL_TRY(sli_json_number_if(&y, &offset.y));
        own.offset = (sl_point){own.offset.x + offset.x, own.offset.y + offset.y};
        if (said != SLI_TILED_UNSAID || sli_game_says_stops(name))
            own.word = said == SLI_TILED_OPEN ? said : SLI_TILED_SOLID;
        const sli_game_kind kind = sli_game_kind_of(name);
        if (kind != SLI_GAME_UNSAID) own.kind = kind;
        const bool objects = strcmp(type, "objectgroup") == 0;
        const bool walls = own.word == SLI_TILED_UNSAID && own.kind == SLI_GAME_SOLID;
        if (walls && objects) own.word = SLI_TILED_SOLID;
        if (strcmp(type, "group") == 0) SL_TRY(mark_layers(all, &layer, &own));
        if (objects) mark_objects(all, &layer, &own);
        if (strcmp(type, "tilelayer") == 0 && (walls || own.word == SLI_TILED_SOLID))
            SL_TRY(mark_tiles(all, &layer, walls ? PICTURED : STOPS));
    }
    return SL_OK;
}

/// Whether a layer of tiles is as large as the map, with as many squares as are allowed. A map
/// without one may be of any size.
static sl_status find_tiles(const sli_tiled_reader *reader, const sli_json *parent, double columns,
                            double rows, bool *found) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value) && !*found; i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const sli_json width = sli_json_member(&layer, "width");
        const sli_json height = sli_json_member(&layer, "height");
        const char *type = sli_json_text_of(&layer, "type");
        if (strcmp(type, "group") == 0) SL_TRY(find_tiles(reader, &layer, columns, rows, found));
        if (strcmp(type, "tilelayer") != 0 || sli_json_number_or_0(&width) != columns ||
            sli_json_number_or_0(&height) != rows)
            continue;
        *found = true;
        return sli_tiled_check_squares(reader, &layer, (int64_t)columns, (int64_t)rows);
    }
    return SL_OK;
}

/// Whether some tile has shapes to collide with.
static bool any_shapes(const sli_tiled_sets *sets) {
    for (size_t i = 0; i < sets->sets.count; i++)
        for (size_t k = 0; k < sets->sets.items[i].tiles.count; k++)
            if (sets->sets.items[i].tiles.items[k].shapes) return true;
    return false;
}

sl_status sli_tiled_look_beside(sli_tiled_reader *reader) {
    const sli_json width = sli_json_member(reader->map, "width");
    const sli_json height = sli_json_member(reader->map, "height");
    const sli_json infinite = sli_json_member(reader->map, "infinite");
    const double columns = sli_json_number_or_0(&width), rows = sli_json_number_or_0(&height);
    bool found = false;
    reader->borders = any_says(&reader->sets) || any_shapes(&reader->sets);
    if (reader->options->layers || sli_json_true(&infinite, NULL) ||
        reader->lattice.orientation != SLI_TILED_ORTHOGONAL || !(columns >= 1 && rows >= 1) ||
        columns > INT32_MAX || rows > INT32_MAX || !(reader->lattice.tile.x > 0) ||
        !(reader->lattice.tile.y > 0))
        return SL_OK;
    SL_TRY(find_tiles(reader, reader->map, columns, rows, &found));
    if (!found) return SL_OK;
    beside all = {.reader = reader, .columns = (size_t)columns, .rows = (size_t)rows};
    const size_t count = all.columns * all.rows;
    const size_t corners = (all.columns + 1) * (all.rows + 1);
    all.squares = sl_alloc_array(reader->context, count, 1);
    all.boxes = sl_alloc_array(reader->context, corners, sizeof *all.boxes);
    sl_status status = all.squares && all.boxes ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        memset(all.squares, 0, count);
        memset(all.boxes, 0, corners * sizeof *all.boxes);
        status = mark_layers(&all, reader->map, &(sli_tiled_place){0});
        mark_boxes(&all);
    }
    size_t pictured = 0, both = 0;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        pictured += (all.squares[i] & PICTURED) != 0;
        both += all.squares[i] == (PICTURED | STOPS);
    }
    reader->walls_are_pictures = both && 3 * both >= pictured;
    sl_free(reader->context, all.squares);
    sl_free(reader->context, all.boxes);
    return status;
}
