/// What the objects of a map tell of its only layer of tiles, where nothing says what is solid:
/// they stand where one can stand. On squares without tiles, and the tiles are walls; on tiles, and
/// the tiles are floor. One of five may stand otherwise, such as a chest in a wall.
#include "io/tiled/tiled.h"

#include <math.h>

typedef struct stands {
    const uint32_t *gids;
    size_t columns, rows;
    sl_point tile;
    uint32_t most;
    size_t on_tiles, on_empty, on_most;
} stands;

static double number_of(const sli_json *object, const char *key) {
    const sli_json number = sli_json_member(object, key);
    return sli_json_number_or_0(&number);
}

/// An object that is about as large as a tile or two; larger ones are zones, and say nothing.
static void look_at_object(stands *s, const sli_json *object) {
    const double width = number_of(object, "width"), height = number_of(object, "height");
    const bool picture = number_of(object, "gid") > 0;
    const double x = number_of(object, "x") + width / 2;
    const double y = number_of(object, "y") + (picture ? -height : height) / 2;
    const double column = floor(x / s->tile.x), row = floor(y / s->tile.y);
    if (width > 2 * s->tile.x || height > 2 * s->tile.y) return;
    if (!(column >= 0 && row >= 0 && column < (double)s->columns && row < (double)s->rows)) return;
    const uint32_t gid = s->gids[(size_t)row * s->columns + (size_t)column] & SLI_TILED_TILE;
    ++*(gid ? &s->on_tiles : &s->on_empty);
    s->on_most += gid == s->most;
}

static void look_at_layers(stands *s, const sli_json *parent) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const sli_json objects = sli_json_member(&layer, "objects");
        for (size_t k = 0; k < json_array_size(objects.value); k++) {
            const sli_json object = sli_json_item(&objects, k);
            look_at_object(s, &object);
        }
        look_at_layers(s, &layer);
    }
}

sli_tiled_stand sli_tiled_where_objects_stand(const sli_tiled_reader *reader, const uint32_t *gids,
                                              size_t columns, size_t rows, uint32_t most,
                                              bool *on_most) {
    enum { LEAST = 3, FEW = 4 };
    const sl_point tile = reader->lattice.tile;
    stands s = {.gids = gids, .columns = columns, .rows = rows, .tile = tile, .most = most};
    *on_most = false;
    if (reader->lattice.orientation != SLI_TILED_ORTHOGONAL) return SLI_TILED_STAND_UNKNOWN;
    look_at_layers(&s, reader->map);
    if (s.on_tiles + s.on_empty < LEAST) return SLI_TILED_STAND_UNKNOWN;
    *on_most = 2 * s.on_most > s.on_tiles + s.on_empty;
    return s.on_empty >= FEW * s.on_tiles   ? SLI_TILED_STAND_ON_EMPTY
           : s.on_tiles >= FEW * s.on_empty ? SLI_TILED_STAND_ON_TILES
                                            : SLI_TILED_STAND_UNKNOWN;
}

bool sli_tiled_is_bare(const sli_json *object, const sli_tiled_shape *shape) {
    static const char *const words[] = {"name", "type", "class", "template"};
    const sli_json properties = sli_json_member(object, "properties");
    bool bare = shape->kind < SLI_TILED_POLYLINE && !json_array_size(properties.value) &&
                !json_object_size(properties.value);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        bare &= !*sli_json_text_of(object, words[i]);
    return bare && (shape->kind == SLI_TILED_POLYGON || (shape->width > 0 && shape->height > 0));
}

/// Whether a layer of objects may be bodies: its name says nothing, or that of what one stands on
/// in a platformer.
static bool may_be_bodies(const char *name) {
    static const char *const words[] = {"ground", "brick", "pipe"};
    if (sli_game_says_other(name)) return false;
    const char *at = name;
    for (sli_name_word word; sli_word_next(&at, &word);)
        if (sli_word_in(&word, words, sizeof words / sizeof *words)) return true;
    return sli_game_kind_of(name) == SLI_GAME_UNSAID;
}

/// Whether objects of which nothing is said are at least four in a layer, and half of its objects.
static bool are_bare(const sli_json *layer) {
    enum { LEAST = 4 };
    const sli_json objects = sli_json_member(layer, "objects");
    const size_t all = json_array_size(objects.value);
    size_t count = 0;
    for (size_t i = 0; i < all; i++) {
        const sli_json object = sli_json_item(&objects, i);
        sli_tiled_shape shape;
        if (sli_tiled_read_shape(&object, &shape) != SL_OK) return false;
        count += sli_tiled_is_bare(&object, &shape);
    }
    return count >= LEAST && 2 * count >= all;
}

bool sli_tiled_has_bare(const sli_json *layer) {
    return may_be_bodies(sli_json_text_of(layer, "name")) && are_bare(layer);
}

bool sli_tiled_is_border(const sli_json *layer) {
    static const char *const words[] = {"border", "hitbox", "physics"};
    const char *name = sli_json_text_of(layer, "name"), *at = name;
    bool said = false;
    for (sli_name_word word; sli_word_next(&at, &word);)
        said |= sli_word_in(&word, words, sizeof words / sizeof *words);
    return said && sli_game_kind_of(name) == SLI_GAME_LIKELY && !sli_game_says_other(name) &&
           are_bare(layer);
}
