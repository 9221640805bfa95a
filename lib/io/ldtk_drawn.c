/// Layers of tiles of LDtk's levels of which nothing says what is solid.
///
/// Who starts there, and the entities that are as large as a cell, stand where one can stand:
///
///     . . # #      all on squares without tiles: the tiles are solid
///     . P . #
///     # # # #
///
///     . . . .      all on tiles: where there is none is solid
///     . # P #
///     . # # #
///
/// This is taken where the level has one layer of tiles, pictures aside, and two at least say so.
/// Of several layers it ranks what a command for the user names: nobody who starts stands on what
/// that takes.
#include "io/ldtk.h"

#include <math.h>
#include <stdio.h>

// --- remembering layers

/// The numbers of a layer's tiles, for the message; sl_free(*out) is the caller's.
static sl_status list_tiles(const sli_ldtk *reader, const sli_json lists[2], uint32_t **out,
                            size_t *count) {
    const size_t all = json_array_size(lists[0].value) + json_array_size(lists[1].value);
    uint32_t *tiles = sl_alloc_array(reader->context, all, sizeof *tiles);
    *out = tiles;
    *count = 0;
    if (!tiles) return SL_NO_MEMORY;
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < json_array_size(lists[k].value); i++) {
            const sli_json tile = sli_json_item(&lists[k], i), id = sli_json_member(&tile, "t");
            const json_int_t number = json_integer_value(id.value);
            if (number >= 0 && number <= UINT32_MAX) tiles[(*count)++] = (uint32_t)number;
        }
    return SL_OK;
}

/// Whether tiles of these numbers lie at a sixteenth of the squares along the layer's edge at
/// least. Walls do, and ground; the floor of rooms in rock does not.
static sl_status lie_at_edge(const sli_json *layer, const sli_json lists[2], const char *numbers,
                             bool *edge) {
    const sli_word asked = {numbers, strlen(numbers)};
    sli_ldtk_frame of;
    size_t there = 0, at;
    SL_TRY(sli_ldtk_read_frame(layer, (sli_ldtk_place){0}, &of));
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < json_array_size(lists[k].value); i++) {
            const sli_json tile = sli_json_item(&lists[k], i), id = sli_json_member(&tile, "t");
            if (!sli_ldtk_find_square(&tile, &of, &at)) continue;
            const size_t x = at % (size_t)of.columns, y = at / (size_t)of.columns;
            there += (!x || !y || x + 1 == (size_t)of.columns || y + 1 == (size_t)of.rows) &&
                     sli_numbers_have(asked, (uint64_t)json_integer_value(id.value));
        }
    *edge = 16 * there >= (size_t)(2 * (of.columns + of.rows));
    return SL_OK;
}

/// What a command takes of a layer: where tiles cover it, its tiles but the most frequent one.
static sl_status find_asked(const sli_ldtk *reader, const sli_json *layer, const sli_json lists[2],
                            const uint32_t *tiles, size_t count, sli_ldtk_drawn *drawn) {
    const sli_json width = sli_json_member(layer, "__cWid"),
                   height = sli_json_member(layer, "__cHei");
    const double squares = sli_json_number_or_0(&width) * sli_json_number_or_0(&height);
    char *text = drawn->asked;
    size_t most;
    if ((double)count < squares) return SL_OK;
    SL_TRY(sli_numbers_write(reader->context, tiles, count, true, &most, text + 1,
                             sizeof drawn->asked - 1));
    bool edge = false;
    if (text[1]) SL_TRY(lie_at_edge(layer, lists, text + 1, &edge));
    if (text[1]) *text = ':';
    drawn->unsure = 5 * most < 3 * count || !edge;
    return SL_OK;
}

/// Adds a layer of tiles, with their numbers where these are few: "Tiles:0-5".
static sl_status add_tile_name(sli_ldtk *reader, const char *name, const uint32_t *tiles,
                               size_t count) {
    char text[160], numbers[48];
    size_t most;
    SL_TRY(sli_numbers_write(reader->context, tiles, count, false, &most, numbers, sizeof numbers));
    const bool few = *numbers && strlen(numbers) < 24;
    snprintf(text, sizeof text, few ? "%.80s:%s" : "%.80s", name, numbers);
    sli_name_list_add(&reader->tile_names, (sli_word){text, strlen(text)});
    return SL_OK;
}

/// Squares are kept up to so many, unless they are asked for: else nothing is known of who stands
/// on them.
enum { MOST_SQUARES = 1 << 24 };

/// Keeps the squares of a layer of a level.
static sl_status keep_squares(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at,
                              const sli_json lists[2], size_t number) {
    const char *asked = reader->drawn.items[number].asked;
    const sli_word numbers = {*asked ? asked + 1 : asked, *asked ? strlen(asked + 1) : 0};
    sli_ldtk_frame of;
    char *squares;
    size_t square;
    SL_TRY(sli_ldtk_read_frame(layer, at, &of));
    if (!reader->void_is_solid && of.columns > MOST_SQUARES / of.rows) return SL_OK;
    SL_TRY(sli_tiles_check(reader->context, &reader->shown, reader->name, 0, "a layer of tiles",
                           (uint64_t)of.columns, (uint64_t)of.rows));
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->shown_layer, 1));
    SL_TRY(sli_tiles_add(reader->context, &reader->shown, reader->name, of.corner,
                         (sl_point){(double)of.step, (double)of.step}, (size_t)of.columns,
                         (size_t)of.rows, &squares));
    reader->shown_layer.items[reader->shown_layer.count++] = number;
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < json_array_size(lists[k].value); i++) {
            const sli_json tile = sli_json_item(&lists[k], i), id = sli_json_member(&tile, "t");
            if (i % 4096 == 0) SL_TRY(sl_check_cancelled(reader->context));
            if (!json_is_integer(id.value) || !sli_ldtk_find_square(&tile, &of, &square)) continue;
            if (sli_numbers_have(numbers, (uint64_t)json_integer_value(id.value)))
                squares[square] = '#';
            else if (squares[square] != '#')
                squares[square] = '+';
        }
    return SL_OK;
}

sl_status sli_ldtk_keep_drawn(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at) {
    const char *name = sli_json_text_of(layer, "__identifier");
    const sli_json lists[2] = {sli_json_member(layer, "gridTiles"),
                               sli_json_member(layer, "autoLayerTiles")};
    size_t number = 0, count;
    uint32_t *tiles;
    if (!sli_ldtk_has_tiles(layer)) return SL_OK;
    while (number < reader->drawn.count && strncmp(reader->drawn.items[number].name, name,
                                                   sizeof reader->drawn.items->name - 1) != 0)
        number++;
    if (number == reader->drawn.count) {
        SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->drawn, 1));
        sli_ldtk_drawn *drawn = &reader->drawn.items[reader->drawn.count++];
        *drawn = (sli_ldtk_drawn){
            .kind = sli_game_kind_of(name), .layer = json_incref(layer->value), .at = at};
        snprintf(drawn->name, sizeof drawn->name, "%s", name);
        sl_status status = list_tiles(reader, lists, &tiles, &count);
        if (status == SL_OK) status = find_asked(reader, layer, lists, tiles, count, drawn);
        if (status == SL_OK) status = add_tile_name(reader, name, tiles, count);
        sl_free(reader->context, tiles);
        SL_TRY(status);
    }
    return keep_squares(reader, layer, at, lists, number);
}

// --- where starts and entities stand

/// How many stand on tiles that an example takes, on other tiles, and where there is none; how many
/// have a tile about them, and none above: in a platformer they may have sunk into the ground.
typedef struct stands {
    size_t starts[4], others[4];
    size_t tiles, squares; ///< of the layer
} stands;

enum { ON_EXAMPLE, ON_TILE, ON_NONE, SUNK };

static bool has_tile(const sli_tile_block *block, size_t square) {
    return block->squares[square] != '.';
}

/// Whether none of the three squares above one has a tile.
static bool is_top(const sli_tile_block *block, size_t square) {
    const size_t x = square % block->columns, above = square - block->columns;
    return square < block->columns ||
           (!has_tile(block, above) && (!x || !has_tile(block, above - 1)) &&
            (x + 1 == block->columns || !has_tile(block, above + 1)));
}

static void stand_on(const sli_tile_block *block, sl_point at, size_t counts[4]) {
    const double x = (at.x - block->corner.x) / block->step.x;
    const double y = (at.y - block->corner.y) / block->step.y;
    if (!(x >= 0 && y >= 0 && x < (double)block->columns && y < (double)block->rows)) return;
    const size_t square = (size_t)y * block->columns + (size_t)x;
    counts[!has_tile(block, square)        ? ON_NONE
           : is_top(block, square)         ? SUNK
           : block->squares[square] == '#' ? ON_EXAMPLE
                                           : ON_TILE]++;
}

static stands look_at(const sli_ldtk *reader, size_t number) {
    stands all = {.tiles = 0};
    for (size_t i = 0; i < reader->shown.blocks.count; i++) {
        const sli_tile_block *block = &reader->shown.blocks.items[i];
        if (reader->shown_layer.items[i] != number) continue;
        all.squares += block->columns * block->rows;
        for (size_t k = 0; k < block->columns * block->rows; k++) all.tiles += has_tile(block, k);
        for (size_t k = 0; k < reader->things.items.count; k++)
            if (reader->things.items.items[k].kind == SLI_THING_START)
                stand_on(block, reader->things.items.items[k].middle, all.starts);
        for (size_t k = 0; k < reader->others.count; k++)
            if (reader->others.items[k].small)
                stand_on(block, reader->others.items[k].middle, all.others);
    }
    return all;
}

/// Whether the starts, and most of the others, stand where a layer has no tiles.
static bool stand_beside(const stands *all) {
    const size_t on = all->others[ON_EXAMPLE] + all->others[ON_TILE], off = all->others[ON_NONE];
    const bool starts = all->starts[ON_EXAMPLE] || all->starts[ON_TILE] || all->starts[SUNK];
    return !starts && (all->starts[ON_NONE] ? off >= 2 * on : off >= 3 && !on);
}

/// Whether the starts, and most of the others, stand on its tiles, three at least.
static bool stand_on_tiles(const stands *all) {
    const size_t on = all->others[ON_EXAMPLE] + all->others[ON_TILE], off = all->others[ON_NONE];
    const size_t starts = all->starts[ON_EXAMPLE] + all->starts[ON_TILE];
    return !all->starts[ON_NONE] && starts + on >= 3 && (starts ? on >= 2 * off : !off);
}

/// Whether the tiles of a layer of one level lie below and not above, with much air between, as in
/// a platformer.
static bool lies_below(const sli_ldtk *reader, size_t number, const stands *all) {
    const sli_tile_block *block = NULL;
    size_t above = 0, below = 0;
    for (size_t i = 0; i < reader->shown.blocks.count; i++) {
        if (reader->shown_layer.items[i] != number) continue;
        if (block) return false;
        block = &reader->shown.blocks.items[i];
    }
    for (size_t i = 0; block && i < block->columns; i++) {
        above += has_tile(block, i);
        below += has_tile(block, (block->rows - 1) * block->columns + i);
    }
    return block && 5 * (all->squares - all->tiles) >= 2 * all->squares &&
           2 * below >= block->columns && 4 * above <= block->columns;
}

/// A layer that may be solid: no picture, and nothing that one passes.
static bool is_plain(const sli_ldtk_drawn *drawn) {
    return drawn->kind != SLI_GAME_DRAWN && drawn->kind != SLI_GAME_PASS;
}

/// The only plain layer, or the number of layers.
static size_t find_only(const sli_ldtk *reader) {
    size_t count = 0, only = reader->drawn.count;
    for (size_t i = 0; i < reader->drawn.count; i++) {
        if (!is_plain(&reader->drawn.items[i])) continue;
        only = i;
        count++;
    }
    return count == 1 ? only : reader->drawn.count;
}

static void guess(sli_ldtk *reader) {
    const size_t only = find_only(reader);
    if (only == reader->drawn.count) return;
    const stands all = look_at(reader, only);
    const size_t on =
        all.starts[ON_EXAMPLE] + all.starts[ON_TILE] + all.others[ON_EXAMPLE] + all.others[ON_TILE];
    const size_t beside = all.starts[ON_NONE] + all.others[ON_NONE];
    const bool floor = reader->drawn.items[only].kind == SLI_GAME_FLOOR;
    if (10 * all.tiles < all.squares || 10 * (all.squares - all.tiles) < all.squares) return;
    reader->guessed = only;
    reader->stood_of = on + beside;
    if (!floor && beside >= 2 && stand_beside(&all)) {
        reader->guess = SLI_LDTK_GUESS_TILES;
        reader->stood = beside;
    } else if (stand_on_tiles(&all)) {
        reader->guess = SLI_LDTK_GUESS_EMPTY;
        reader->stood = on;
    } else if (!floor && !on && !all.starts[SUNK] && lies_below(reader, only, &all)) {
        reader->guess = SLI_LDTK_GUESS_TILES;
        reader->stood_of = 0;
    }
}

// --- what is taken

static sl_status add_block(sli_ldtk *reader, const sli_tile_block *of, char **squares) {
    SL_TRY(sli_tiles_check(reader->context, &reader->tiles, reader->name, 0, "a layer of tiles",
                           of->columns, of->rows));
    return sli_tiles_add(reader->context, &reader->tiles, reader->name, of->corner, of->step,
                         of->columns, of->rows, squares);
}

static sl_status take_tiles(sli_ldtk *reader, size_t number) {
    for (size_t i = 0; i < reader->shown.blocks.count; i++) {
        const sli_tile_block *block = &reader->shown.blocks.items[i];
        char *squares;
        if (reader->shown_layer.items[i] != number) continue;
        SL_TRY(add_block(reader, block, &squares));
        for (size_t k = 0; k < block->columns * block->rows; k++)
            if (block->squares[k] != '.') squares[k] = '#';
    }
    return SL_OK;
}

/// Opens the squares of `to` whose middles lie under a tile.
static void open_under(const sli_tile_block *block, const sli_tile_block *to, char *squares) {
    for (size_t k = 0; k < to->columns * to->rows; k++) {
        const sl_point at = {to->corner.x + ((double)(k % to->columns) + 0.5) * to->step.x,
                             to->corner.y + ((double)(k / to->columns) + 0.5) * to->step.y};
        size_t counts[4] = {0};
        stand_on(block, at, counts);
        if (counts[ON_EXAMPLE] || counts[ON_TILE] || counts[SUNK]) squares[k] = '.';
    }
}

static bool overlaps(const sli_tile_block *block, const sl_box *page) {
    const double right = block->corner.x + (double)block->columns * block->step.x;
    const double bottom = block->corner.y + (double)block->rows * block->step.y;
    return block->corner.x < page->max.x && right > page->min.x && block->corner.y < page->max.y &&
           bottom > page->min.y;
}

/// Makes the squares of a level solid on which no layer has a tile; in the finest grid.
static sl_status take_void(sli_ldtk *reader, const sl_box *page) {
    double step = page->max.x - page->min.x;
    for (size_t i = 0; i < reader->shown.blocks.count; i++)
        if (overlaps(&reader->shown.blocks.items[i], page))
            step = fmin(step, reader->shown.blocks.items[i].step.x);
    const double columns = ceil((page->max.x - page->min.x) / step);
    const double rows = ceil((page->max.y - page->min.y) / step);
    const sli_tile_block to = {.corner = page->min,
                               .step = {step, step},
                               .columns = (size_t)columns,
                               .rows = (size_t)rows};
    char *squares;
    SL_TRY(add_block(reader, &to, &squares));
    memset(squares, '#', to.columns * to.rows);
    for (size_t i = 0; i < reader->shown.blocks.count; i++) {
        SL_TRY(sl_check_cancelled(reader->context));
        if (overlaps(&reader->shown.blocks.items[i], page))
            open_under(&reader->shown.blocks.items[i], &to, squares);
    }
    return SL_OK;
}

sl_status sli_ldtk_settle_drawn(sli_ldtk *reader) {
    const bool none = !reader->layers && !reader->tile_layers && !reader->walls.count;
    if (none && !reader->options->layers && !reader->marks) guess(reader);
    reader->void_is_solid |= reader->guess == SLI_LDTK_GUESS_EMPTY;
    reader->tile_layers += reader->guess != SLI_LDTK_NO_GUESS;
    if (reader->void_is_solid && !reader->tile_layers) reader->tile_layers = reader->drawn.count;
    if (reader->guess == SLI_LDTK_GUESS_TILES) SL_TRY(take_tiles(reader, reader->guessed));
    for (size_t i = 0; i < reader->pages.count && reader->void_is_solid; i++)
        SL_TRY(take_void(reader, &reader->pages.items[i]));
    return SL_OK;
}

// --- what to type

/// How likely a layer is solid: 0 for not at all.
static int rank_of(const sli_ldtk *reader, size_t number) {
    const sli_ldtk_drawn *drawn = &reader->drawn.items[number];
    const stands all = look_at(reader, number);
    const bool full = *drawn->asked || drawn->unsure;
    const size_t on = all.starts[ON_EXAMPLE] + (full ? 0 : all.starts[ON_TILE] + all.starts[SUNK]);
    if (on || drawn->unsure) return 0;
    if (drawn->kind >= SLI_GAME_STANDS) return 4;
    // Scraps are no rooms; what is named for a floor or the sea lies under them.
    const bool under = drawn->kind == SLI_GAME_FLOOR || drawn->kind == SLI_GAME_GROUND ||
                       drawn->kind == SLI_GAME_WATER;
    if (under || !is_plain(drawn) || 10 * all.tiles < all.squares) return 1;
    return full || !stand_beside(&all) ? 2 : 3;
}

/// Whether starts and entities stand on tiles of some layer, and each has squares without tiles.
static bool stand_in_void(const sli_ldtk *reader) {
    bool any = false;
    for (size_t i = 0; i < reader->drawn.count; i++) {
        const stands all = look_at(reader, i);
        if (10 * (all.squares - all.tiles) < all.squares) return false;
        any |= stand_on_tiles(&all);
    }
    return any;
}

/// Whether a start or a small entity stands on the square of a tile.
static bool is_stood_on(const sli_ldtk *reader, const sli_ldtk_frame *of, size_t square) {
    const double step = (double)of->step;
    const sl_point low = {of->corner.x + (double)(square % (size_t)of->columns) * step,
                          of->corner.y + (double)(square / (size_t)of->columns) * step};
    const sl_box box = {low, {low.x + step, low.y + step}};
    for (size_t i = 0; i < reader->things.items.count; i++)
        if (reader->things.items.items[i].kind == SLI_THING_START &&
            sli_box_holds(&box, reader->things.items.items[i].middle))
            return true;
    for (size_t i = 0; i < reader->others.count; i++)
        if (reader->others.items[i].small && sli_box_holds(&box, reader->others.items[i].middle))
            return true;
    return false;
}

static bool is_among(const uint32_t *tiles, size_t count, uint32_t tile) {
    bool found = false;
    for (size_t i = 0; i < count; i++) found |= tiles[i] == tile;
    return found;
}

/// The tiles of a layer but those in which somebody has sunk, as ":17+33"; "" where there are none,
/// or more than eight. Such tiles are tufts of grass on the ground.
static sl_status find_beneath(const sli_ldtk *reader, const sli_ldtk_drawn *drawn, char *text,
                              size_t size) {
    const sli_json layer = {.file = reader->root.file, .value = drawn->layer};
    const sli_json lists[2] = {sli_json_member(&layer, "gridTiles"),
                               sli_json_member(&layer, "autoLayerTiles")};
    sli_ldtk_frame of;
    uint32_t *tiles, sunk[9];
    enum { MOST_SUNK = sizeof sunk / sizeof *sunk - 1 };
    size_t count, used = 0, square, most, at = 0;
    *text = '\0';
    SL_TRY(sli_ldtk_read_frame(&layer, drawn->at, &of));
    SL_TRY(list_tiles(reader, lists, &tiles, &count));
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < json_array_size(lists[k].value); i++) {
            const sli_json tile = sli_json_item(&lists[k], i), id = sli_json_member(&tile, "t");
            const uint32_t number = (uint32_t)json_integer_value(id.value);
            if (used <= MOST_SUNK && !is_among(sunk, used, number) &&
                sli_ldtk_find_square(&tile, &of, &square) && is_stood_on(reader, &of, square))
                sunk[used++] = number;
        }
    for (size_t i = 0; i < count; i++)
        if (!is_among(sunk, used, tiles[i])) tiles[at++] = tiles[i];
    const sl_status status =
        sli_numbers_write(reader->context, tiles, at, false, &most, text + 1, size - 1);
    sl_free(reader->context, tiles);
    *text = used && used <= MOST_SUNK && text[1] ? ':' : '\0';
    return status;
}

void sli_ldtk_destroy_drawn(sli_ldtk *reader) {
    for (size_t i = 0; i < reader->drawn.count; i++) json_decref(reader->drawn.items[i].layer);
    sl_free(reader->context, reader->drawn.items);
    sl_free(reader->context, reader->shown_layer.items);
    sli_tiles_destroy(reader->context, &reader->shown);
}

sl_status sli_ldtk_show_example(const sli_ldtk *reader, char text[SLI_LDTK_EXAMPLE]) {
    const sli_ldtk_drawn *best = NULL;
    char beneath[80] = "";
    int most = 0;
    for (size_t i = 0; i < reader->drawn.count; i++) {
        const int rank = rank_of(reader, i);
        if (rank <= most) continue;
        most = rank;
        best = &reader->drawn.items[i];
    }
    const bool empty = most < 3 && !reader->tile_layers && stand_in_void(reader);
    const size_t only = find_only(reader);
    if (!best && only < reader->drawn.count && !*reader->drawn.items[only].asked &&
        look_at(reader, only).starts[SUNK]) {
        best = &reader->drawn.items[only];
        SL_TRY(find_beneath(reader, best, beneath, sizeof beneath));
        if (!*beneath) best = NULL;
    }
    if (reader->marks)
        snprintf(text, SLI_LDTK_EXAMPLE,
                 "; to take the %zu entities '%.80s' as solid: sightline check '%.300s' --map "
                 "'%.80s' --layers '%.80s' -o map.png",
                 reader->marks, reader->mark, reader->name, reader->taken, reader->mark);
    else if (empty || best)
        snprintf(text, SLI_LDTK_EXAMPLE,
                 "; %s: sightline check '%.300s' --map '%.80s' --layers '%.80s%s' -o map.png",
                 empty          ? "to take squares without tiles as solid"
                 : most < 2     ? "perhaps, if a look shows so"
                 : *best->asked ? "to take these tiles of one as solid"
                                : "to take the tiles of one as solid",
                 reader->name, reader->taken, empty ? "void" : best->name,
                 empty      ? ""
                 : *beneath ? beneath
                            : best->asked);
    else
        snprintf(text, SLI_LDTK_EXAMPLE,
                 "; which tiles of '%.80s' are solid, only its picture shows: tiles of a tileset "
                 "are counted from 0, row by row",
                 reader->drawn.count ? reader->drawn.items[0].name : "");
    return SL_OK;
}
