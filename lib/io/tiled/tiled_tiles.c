/// The tiles of Tiled's maps: which are solid, and the walls about them.
///
/// A block is a rectangle of tiles, a whole layer or a chunk of one. Its solid tiles become solid
/// squares of the plan (tiled_lattice.c), its doors and tiles' shapes are taken along. A staggered
/// block lies askew in the plan: it is a part of a larger block of squares. When all is read,
/// blocks of one grid become one, and what is beyond the map is solid.
///
///     a   b   c        - - c f      A staggered block, and its squares in the plan:
///       d   e   f      - b e i      those with '-' are no tiles of the block.
///     g   h   i        a d h -
///                      - g - -
///
/// Time O(tiles), for staggered blocks O(squares).
#include "io/tiled/tiled.h"

#include "io/parts/limits.h"
#include "sightline/import.h"

#include <math.h>

/// Layers of staggered and hexagonal maps are moved by no more pixels.
#define FARTHEST 1e9

// --- what a block's tiles are

/// A rectangle of tiles: a whole layer, or a chunk of one. Staggered ones are turned in the plan,
/// so that their squares are more than their tiles.
typedef struct block {
    sl_point offset;     ///< the layer's, on the screen
    sl_point corner;     ///< the upper left one in the plan
    int64_t column, row; ///< of the first tile
    size_t columns, rows;
    const uint32_t *gids;
    bool says_too_much; ///< its tiles say that nearly all of it is solid
    char *squares;
    sli_tiled_range range; ///< of the squares
} block;

static char *square_of(const sli_tiled_reader *reader, const block *all, size_t i) {
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
static sli_affine turn_tile(const sli_tiled_reader *reader, uint32_t gid, const sli_tiled_set *set,
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
static sli_affine affine_of_tile(const sli_tiled_reader *reader, const block *all, size_t at,
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
static bool covers(const sli_tiled_reader *reader, const sli_tiled_set *set,
                   const sli_tiled_shape *shape) {
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

static sli_json shapes_of(const sli_tiled_reader *reader, const sli_tiled_set *set,
                          const sli_tiled_tile *tile) {
    return (sli_json){.file = set->file.root ? &set->file : reader->map->file,
                      .value = tile->shapes,
                      .key = "objects"};
}

/// Names a tile's shapes and counts what they draw, once.
static sl_status meet_tile(sli_tiled_reader *reader, const sli_tiled_set *set,
                           sli_tiled_tile *tile) {
    const sli_json list = shapes_of(reader, set, tile);
    bool whole = false;
    if (tile->item) return SL_OK;
    tile->item = reader->pen.item + 1;
    for (size_t i = 0; i < json_array_size(tile->shapes); i++) {
        const sli_json object = sli_json_item(&list, i);
        char label[SL_LINE_TEXT];
        sli_tiled_shape shape;
        SL_TRY(sli_tiled_read_shape(&object, &shape));
        snprintf(label, sizeof label, "tile %u, shape %zu", (unsigned)(set->first + tile->id),
                 i + 1);
        SL_TRY(sli_tiled_name_shape(reader, label));
        // The first one that covers the tile makes a square solid, which was counted as such.
        if (!whole && (whole = covers(reader, set, &shape))) continue;
        tile->drawn++;
        tile->walls += sli_tiled_shape_walls(&reader->pen, &shape);
    }
    return SL_OK;
}

static sl_status draw_closed(sli_tiled_reader *reader, const sli_tiled_shape *shape) {
    const size_t first = reader->pen.map->wall_count;
    SL_TRY(sli_tiled_draw_shape(&reader->pen, shape));
    return sli_tiled_add_closed(reader, shape->kind, first, true);
}

static sl_status draw_tile_shapes(sli_tiled_reader *reader, const block *all, size_t at,
                                  const sli_tiled_set *set, const sli_tiled_tile *tile) {
    const sli_json list = shapes_of(reader, set, tile);
    const sli_affine outer = reader->pen.affine;
    const uint32_t last = reader->pen.item;
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < json_array_size(tile->shapes); i++) {
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
        reader->pen.item = tile->item + (uint32_t)i;
        reader->pen.affine = affine_of_tile(reader, all, at, set);
        status = draw_closed(reader, &shape);
        reader->pen.affine = outer;
        reader->pen.item = last;
    }
    return status;
}

/// From a tile's pixels to the layer of an object that shows it: stretched to the object's size,
/// its lower left corner on the object's place, about which it turns.
static sli_affine affine_of_picture(const sli_tiled_reader *reader, const sli_tiled_set *set,
                                    const sli_tiled_shape *shape) {
    double height;
    const uint32_t mirrors = SLI_TILED_ACROSS | SLI_TILED_DOWN | SLI_TILED_TILE;
    const sli_affine inner = turn_tile(reader, shape->gid & mirrors, set, &height);
    const double x = shape->width > 0 ? shape->width / set->width : 1;
    const double y = shape->height > 0 ? shape->height / set->height : 1;
    const sli_affine scale = {.xx = x, .yy = y, .y0 = -y * set->height};
    sli_affine turn = shape->turn;
    turn.x0 = shape->x;
    turn.y0 = shape->y;
    return sli_affine_after(turn, sli_affine_after(scale, inner));
}

sl_status sli_tiled_draw_picture(sli_tiled_reader *reader, const sli_json *object,
                                 const sli_tiled_shape *shape, sli_affine layer) {
    const uint32_t gid = shape->gid & SLI_TILED_TILE;
    const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
    sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
    const bool other = sli_game_says_other(sli_json_text_of(object, "name")) ||
                       sli_game_says_other(sli_json_text_of(object, "type"));
    if (!tile || !tile->shapes || other || reader->by) return SL_OK;
    if (set->diamond.x > 0 || reader->lattice.orientation != SLI_TILED_ORTHOGONAL) {
        reader->lost_shapes += json_array_size(tile->shapes);
        return SL_OK;
    }
    if (!(set->width > 0 && set->height > 0)) return SL_OK;
    SL_TRY(meet_tile(reader, set, tile));
    reader->tile_shapes = sli_limit_sum(reader->tile_shapes, json_array_size(tile->shapes));
    SL_TRY(sli_limit_check(reader->context, reader->map->file->name, 0, SLI_LIMIT_ENTITIES,
                           reader->tile_shapes, "the tiles' shapes, as often as they are drawn"));
    const sli_json list = shapes_of(reader, set, tile);
    const sli_affine outer = reader->pen.affine;
    const sli_affine place = sli_affine_after(layer, affine_of_picture(reader, set, shape));
    const uint32_t last = reader->pen.item;
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < json_array_size(tile->shapes); i++) {
        const sli_json item = sli_json_item(&list, i);
        sli_tiled_shape own;
        SL_TRY(sli_tiled_read_shape(&item, &own));
        *(own.kind < SLI_TILED_PICTURE ? &reader->shapes : &reader->other_shapes) += 1;
        if (own.kind >= SLI_TILED_PICTURE) continue;
        reader->pen.item = tile->item + (uint32_t)i;
        reader->pen.affine = sli_affine_after(outer, place);
        status = draw_closed(reader, &own);
        reader->pen.affine = outer;
        reader->pen.item = last;
    }
    return status;
}

/// A door of one staggered tile. Its neighbours are other doors.
static sl_status add_diamond_door(sli_tiled_reader *reader, const block *all, size_t i,
                                  const sli_says *says) {
    const sl_point step = reader->lattice.step;
    const size_t at = (size_t)(square_of(reader, all, i) - all->squares);
    const size_t width = (size_t)(all->range.right - all->range.left);
    const sli_thing door = {.kind = SLI_THING_DOOR,
                            .middle = {all->corner.x + ((double)(at % width) + 0.5) * step.x,
                                       all->corner.y + ((double)(at / width) + 0.5) * step.y},
                            .of_tiles = true,
                            .u = {step.x / 2, 0},
                            .v = {0, step.y / 2},
                            .open = says->state != SLI_DOOR_SHUT};
    return sli_things_add(&reader->things, says->name, door);
}

/// A door's square is solid where it lies in a solid layer, or is drawn to collide with: if no
/// passage is found for the door, it stays so.
static sl_status take_door(sli_tiled_reader *reader, const sli_tiled_place *at, const block *all,
                           size_t i, const sli_tiled_tile *tile, const sli_says *says) {
    if (at->word == SLI_TILED_SOLID || tile->word == SLI_TILED_SOLID || tile->shapes)
        *square_of(reader, all, i) = '#';
    if (reader->by) return SL_OK; // the first reading took it
    if (reader->lattice.orientation == SLI_TILED_HEXAGONAL) {
        reader->doors_left_out++;
        return SL_OK;
    }
    if (reader->lattice.orientation == SLI_TILED_STAGGERED)
        return add_diamond_door(reader, all, i, says);
    return sli_things_add_square(&reader->things, says, i % all->columns, i / all->columns);
}

/// Whether a tile is a door: it says so, or it is solid in a layer that is named for doors. That
/// one is shut, if the name does not say otherwise.
static bool is_door(const sli_tiled_place *at, const sli_tiled_tile *tile, sli_says *says) {
    if (!tile || at->gids.length) return false;
    *says = tile->says;
    if (says->kind == SLI_THING_DOOR) return true;
    if (!at->doors || (tile->word != SLI_TILED_SOLID && !tile->shapes)) return false;
    *says = sli_says_of(at->doors, NULL);
    if (!says->state) says->state = SLI_DOOR_SHUT;
    return says->kind == SLI_THING_DOOR;
}

sli_tiled_word sli_tiled_word_of_tile(const sli_tiled_set *set, const sli_tiled_tile *tile) {
    if (tile && tile->word != SLI_TILED_UNSAID) return tile->word;
    return set ? set->word : SLI_TILED_UNSAID;
}

/// What counts of a tile in the reading at hand.
static sli_tiled_word word_by(const sli_tiled_reader *reader, const sli_tiled_set *set,
                              const sli_tiled_tile *tile) {
    const sli_tiled_word word = sli_tiled_word_of_tile(set, tile);
    if (word != SLI_TILED_UNSAID) return word;
    const bool solid =
        (reader->by == SLI_TILED_BY_TERRAIN && tile && tile->terrain) ||
        (reader->by == SLI_TILED_BY_SET && ((set && set->named) || (tile && tile->named)));
    return solid ? SLI_TILED_SOLID : SLI_TILED_UNSAID;
}

static sl_status take_tile(sli_tiled_reader *reader, const sli_tiled_place *at, const block *all,
                           size_t i) {
    const uint32_t gid = all->gids[i] & SLI_TILED_TILE;
    if (!gid) return SL_OK;
    const sli_tiled_set *set = sli_tiled_find_set(&reader->sets, gid);
    const sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
    sli_tiled_word word = word_by(reader, set, tile);
    if (all->says_too_much && word == SLI_TILED_SOLID) word = SLI_TILED_UNSAID;
    if (at->beside && at->word == SLI_TILED_UNSAID && word == SLI_TILED_SOLID && !reader->by) {
        reader->beside_tiles++;
        reader->seen.items[reader->at_layer].beside++;
        return SL_OK;
    }
    if (set && set->missing) reader->lost_tiles++;
    sli_says says;
    if (is_door(at, tile, &says)) return take_door(reader, at, all, i, tile, &says);
    if (at->word == SLI_TILED_SOLID && !at->tiles_decide) {
        const bool solid =
            at->gids.length ? sli_numbers_have(at->gids, gid) : word != SLI_TILED_OPEN;
        if (solid) *square_of(reader, all, i) = '#';
        return SL_OK;
    }
    reader->unknown_tiles += set && set->missing;
    if (word == SLI_TILED_SOLID) {
        *square_of(reader, all, i) = '#';
        reader->solid_tiles++;
    }
    if (word != SLI_TILED_UNSAID || !tile || !tile->shapes) return SL_OK;
    return draw_tile_shapes(reader, all, i, set, tile);
}

/// Before any is drawn: one tile may have many shapes, and a layer has many such tiles.
static sl_status check_shapes(sli_tiled_reader *reader, const sli_tiled_place *at,
                              const block *all) {
    const char *name = reader->map->file->name;
    for (size_t i = 0; i < all->columns * all->rows; i++) {
        const uint32_t gid = all->gids[i] & SLI_TILED_TILE;
        const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
        sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
        if (!tile || !tile->shapes || (at->word == SLI_TILED_SOLID && !at->tiles_decide) ||
            sli_tiled_word_of_tile(set, tile) != SLI_TILED_UNSAID)
            continue;
        sli_says says;
        if (is_door(at, tile, &says)) continue;
        SL_TRY(meet_tile(reader, set, tile));
        reader->tile_shapes = sli_limit_sum(reader->tile_shapes, tile->drawn);
        reader->tile_walls = sli_limit_sum(reader->tile_walls, tile->walls);
    }
    SL_TRY(sli_limit_check(reader->context, name, 0, SLI_LIMIT_ENTITIES, reader->tile_shapes,
                           "the tiles' shapes, as often as they are drawn"));
    return sli_limit_check(reader->context, name, 0, SLI_LIMIT_WALLS, reader->tile_walls,
                           "the tiles' shapes give");
}

/// A layer of tiles may be where one starts: WorkAdventure's maps have such.
bool sli_tiled_is_start_layer(const sli_json *layer) {
    sli_tiled_properties at = sli_tiled_properties_of(layer);
    const char *name;
    for (sli_json value; sli_tiled_next_property(&at, &name, &value);)
        if (name && strcmp(name, "startLayer") == 0 && sli_json_true(&value, NULL)) return true;
    return sli_says_start(sli_json_text_of(layer, "name"));
}

/// The tile next to the middle of all, or `count` where there is none.
static size_t find_middle(const block *all) {
    const size_t count = all->columns * all->rows;
    double x = 0, y = 0, any = 0, least = INFINITY;
    for (size_t i = 0; i < count; i++) {
        if (!(all->gids[i] & SLI_TILED_TILE)) continue;
        x += (double)(i % all->columns);
        y += (double)(i / all->columns);
        any++;
    }
    size_t best = count;
    for (size_t i = 0; i < count; i++) {
        const double dx = (double)(i % all->columns) - x / any;
        const double dy = (double)(i / all->columns) - y / any;
        if (!(all->gids[i] & SLI_TILED_TILE) || !(dx * dx + dy * dy < least)) continue;
        least = dx * dx + dy * dy;
        best = i;
    }
    return best;
}

/// The middle of a tile in the places of things.
static sl_point middle_of(const sli_tiled_reader *reader, const block *all, size_t i) {
    const sl_point step = reader->lattice.step, tile = reader->lattice.tile;
    if (reader->lattice.orientation == SLI_TILED_HEXAGONAL) {
        const sl_point at =
            sli_tiled_tile_at(&reader->lattice, all->column + (int64_t)(i % all->columns),
                              all->row + (int64_t)(i / all->columns));
        return (sl_point){all->offset.x + at.x + tile.x / 2, all->offset.y + at.y + tile.y / 2};
    }
    const size_t at = (size_t)(square_of(reader, all, i) - all->squares);
    const size_t width = (size_t)(all->range.right - all->range.left);
    return (sl_point){all->corner.x + ((double)(at % width) + 0.5) * step.x,
                      all->corner.y + ((double)(at / width) + 0.5) * step.y};
}

static sl_status take_start(sli_tiled_reader *reader, const sli_json *layer, const block *all) {
    const char *name = sli_json_text_of(layer, "name");
    const size_t middle = find_middle(all);
    if (!sli_tiled_is_start_layer(layer) || middle == all->columns * all->rows) return SL_OK;
    sli_says says = {.kind = SLI_THING_START, .name = *name ? name : "start"};
    SL_TRY(sli_things_ask(&reader->things, name, NULL, &says));
    if (says.kind != SLI_THING_START) return SL_OK;
    const sli_thing start = {.kind = SLI_THING_START,
                             .middle = middle_of(reader, all, middle),
                             .line = sli_json_line(layer)};
    size_t tiles = 0;
    for (size_t i = 0; i < all->columns * all->rows; i++)
        tiles += (all->gids[i] & SLI_TILED_TILE) != 0;
    // Of several chunks the one with the most tiles.
    const bool again = reader->start_layer == layer->value;
    if (again && tiles <= reader->start_tiles) return SL_OK;
    reader->start_layer = layer->value;
    reader->start_tiles = tiles;
    if (again) {
        reader->things.items.items[reader->start_at].middle = start.middle;
        return SL_OK;
    }
    reader->start_at = reader->things.items.count;
    return sli_things_add(&reader->things, says.name, start);
}

/// The layer that is guessed from.
static sl_status guess_tiles(sli_tiled_reader *reader, const block *all) {
    SL_TRY(sli_tiled_guess(reader, all->gids, all->columns, all->rows));
    for (size_t i = 0; reader->guess_why && i < all->columns * all->rows; i++) {
        const uint32_t gid = all->gids[i] & SLI_TILED_TILE;
        if (reader->guessed_all ? gid && gid != reader->guessed : gid == reader->guessed)
            *square_of(reader, all, i) = '#';
    }
    return SL_OK;
}

static sl_status take_tiles(sli_tiled_reader *reader, const sli_json *layer,
                            const sli_tiled_place *at, const block *all) {
    const size_t count = all->columns * all->rows;
    sli_tiled_seen *seen = &reader->seen.items[reader->at_layer];
    if (reader->by == SLI_TILED_BY_GUESS) return guess_tiles(reader, all);
    if (at->word == SLI_TILED_OPEN) return take_start(reader, layer, all);
    SL_TRY(check_shapes(reader, at, all));
    for (size_t i = 0; i < count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(reader->context));
        if (!reader->by) seen->count += (all->gids[i] & SLI_TILED_TILE) != 0;
        SL_TRY(take_tile(reader, at, all, i));
    }
    if (!reader->by) {
        seen->squares += count;
        SL_TRY(take_start(reader, layer, all));
    }
    return sli_things_end_block(&reader->things, all->corner, reader->lattice.step);
}

/// Where the block lies in the plan. A staggered one has squares that are none of its tiles.
static sl_status add_block(sli_tiled_reader *reader, block *all) {
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
    SL_TRY(sli_tiles_add(reader->context, &reader->tiles, reader->map->file->name, all->corner,
                         lattice->step, columns, rows, &all->squares));
    if (lattice->orientation != SLI_TILED_STAGGERED) return SL_OK;
    memset(all->squares, ' ', columns * rows);
    for (size_t i = 0; i < all->columns * all->rows; i++) *square_of(reader, all, i) = '.';
    return SL_OK;
}

static void drop_last_block(sli_tiled_reader *reader) {
    const sli_tile_block *last = &reader->tiles.blocks.items[--reader->tiles.blocks.count];
    reader->tiles.squares -= (uint64_t)last->columns * last->rows;
    sl_free(reader->context, last->squares);
}

/// Staggered and hexagonal maps have one lattice: layers with other offsets may have no solid tile.
static sl_status check_offset(sli_tiled_reader *reader, const sli_json *holder, const block *all) {
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
    drop_last_block(reader);
    return SL_OK;
}

sl_status sli_tiled_check_squares(const sli_tiled_reader *reader, const sli_json *layer,
                                  int64_t columns, int64_t rows) {
    const char *name = sli_json_text_of(layer, "name");
    char what[96];
    snprintf(what, sizeof what, "layer '%s'", sli_show((sli_word){name, strlen(name)}).text);
    return sli_tiles_check(reader->context, &reader->tiles, reader->map->file->name,
                           sli_json_line(layer), what, (uint64_t)columns, (uint64_t)rows);
}

/// `holder` has the size; `column` and `row` are those of its first tile.
static sl_status read_block(sli_tiled_reader *reader, const sli_json *layer, const sli_json *holder,
                            int64_t column, int64_t row, const sli_tiled_place *at) {
    const sli_json width = sli_json_member(holder, "width");
    const sli_json height = sli_json_member(holder, "height");
    const sli_json data = sli_json_member(holder, "data");
    int64_t columns, rows;
    SL_TRY(sli_json_whole(&width, 1, INT32_MAX, &columns));
    SL_TRY(sli_json_whole(&height, 1, INT32_MAX, &rows));
    uint32_t *gids;
    SL_TRY(sli_tiled_check_squares(reader, layer, columns, rows));
    SL_TRY(sli_tiled_read_data(layer, &data, (size_t)(columns * rows), &gids));
    block all = {.offset = at->offset,
                 .column = column,
                 .row = row,
                 .columns = (size_t)columns,
                 .rows = (size_t)rows,
                 .gids = gids};
    // A chunk may well be all rock.
    all.says_too_much = holder == layer && at->word == SLI_TILED_UNSAID &&
                        sli_tiled_all_solid(&reader->sets, gids, (size_t)(columns * rows));
    if (all.says_too_much && !reader->believed_not)
        reader->believed_not = sli_json_text_of(layer, "name");
    sl_status status = add_block(reader, &all);
    if (status == SL_OK) status = take_tiles(reader, layer, at, &all);
    if (status == SL_OK && at->word == SLI_TILED_OPEN)
        drop_last_block(reader);
    else if (status == SL_OK)
        status = check_offset(reader, holder, &all);
    sl_free(reader->context, gids);
    return status;
}

static sl_status read_chunks(sli_tiled_reader *reader, const sli_json *layer,
                             const sli_json *chunks, const sli_tiled_place *at) {
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

sl_status sli_tiled_read_tile_layer(sli_tiled_reader *reader, const sli_json *layer,
                                    const sli_tiled_place *at) {
    const sli_json chunks = sli_json_member(layer, "chunks");
    const sli_json infinite = sli_json_member(reader->map, "infinite");
    if (reader->by == SLI_TILED_BY_GUESS && reader->at_layer != reader->guess_layer) return SL_OK;
    if (chunks.value) return read_chunks(reader, layer, &chunks, at);
    // A layer without bounds that nothing is drawn on has no chunk.
    if (sli_json_true(&infinite, NULL)) return SL_OK;
    return read_block(reader, layer, layer, 0, 0, at);
}

// --- walls

/// All squares of the plan that are no staggered tiles of the map are solid, as what is beyond it.
static sl_status add_surroundings(sli_tiled_reader *reader) {
    if (reader->lattice.orientation != SLI_TILED_STAGGERED || !reader->tiles.blocks.count)
        return SL_OK;
    const sli_tiled_range *tiles = &reader->all;
    block all = {.offset = reader->offset,
                 .column = tiles->left,
                 .row = tiles->top,
                 .columns = (size_t)(tiles->right - tiles->left),
                 .rows = (size_t)(tiles->bottom - tiles->top)};
    SL_TRY(sli_tiles_check(reader->context, &reader->tiles, reader->map->file->name, 0,
                           "its tiles are spread over", all.columns, all.rows));
    SL_TRY(add_block(reader, &all));
    const size_t width = (size_t)(all.range.right - all.range.left);
    const size_t count = width * (size_t)(all.range.bottom - all.range.top);
    // Tiles have a '.' already: they stay as they are in the other blocks.
    for (size_t i = 0; i < count; i++) all.squares[i] = all.squares[i] == ' ' ? '#' : ' ';
    return SL_OK;
}

/// Starts in solid hexagons are marked.
static void place_starts(sli_tiled_reader *reader, const sli_grid *grid) {
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
    sli_tiled_reader *reader = user;
    place_starts(reader, grid);
    return sli_tiled_add_hexagons(reader->context, &reader->lattice, reader->offset, grid, map);
}

sl_status sli_tiled_add_tile_walls(sli_tiled_reader *reader) {
    const bool hexagons = reader->lattice.orientation == SLI_TILED_HEXAGONAL;
    sl_map *map = reader->pen.map;
    reader->things.top = reader->top;
    reader->things.shapes = map->wall_count;
    SL_TRY(add_surroundings(reader));
    const sli_tiles_options options = {.top = hexagons ? 0 : reader->top,
                                       .solid_between = reader->by == SLI_TILED_BY_GUESS &&
                                                        !reader->guessed && !reader->guessed_all,
                                       .other_ground = reader->solid_closed > 0,
                                       .things = hexagons ? NULL : &reader->things,
                                       .add_walls = hexagons ? add_hexagons : NULL,
                                       .user = reader};
    SL_TRY(sli_tiles_add_walls(reader->context, &reader->tiles, reader->map->file->name, &options,
                               map));
    // Where squares tell nothing of objects that are doors, the walls of tiles do.
    if (hexagons || reader->lattice.orientation == SLI_TILED_STAGGERED)
        reader->things.shapes = map->wall_count;
    return SL_OK;
}
