/// The layers of LDtk's levels: cells with values (IntGrid), tiles where a level has no cells, and
/// entities.
#include "io/ldtk.h"

#include <stdio.h>
#include <strings.h>

/// The definition in `list` whose uid is the number; the way to it lives in `defs`.
static sli_json find_definition(const sli_ldtk *reader, const char *list, const sli_json *uid,
                                sli_json defs[3]) {
    defs[0] = sli_json_member(&reader->project, "defs");
    defs[1] = sli_json_member(&defs[0], list);
    const size_t count = json_array_size(defs[1].value);
    for (size_t i = 0; uid->value && i < count; i++) {
        defs[2] = sli_json_item(&defs[1], i);
        const sli_json other = sli_json_member(&defs[2], "uid");
        if (other.value && json_equal(uid->value, other.value)) return defs[2];
    }
    return (sli_json){.file = uid->file};
}

/// What values or tiles mean, as far as they were met: most are met often.
#define KNOWN 256
typedef struct known_cells {
    struct {
        bool is_known;
        int64_t value;
        sli_ldtk_cell cell;
    } items[KNOWN];
} known_cells;

/// A layer as its name and --layers have it.
static sli_ldtk_layer layer_of(const sli_ldtk *reader, const sli_json *layer) {
    const char *name = sli_json_text_of(layer, "__identifier");
    sli_ldtk_layer of = {.kind = sli_game_kind_of(name)};
    if (reader->options->layers && sli_layers_ask(reader->options->layers, name, &of.numbers))
        of.kind = SLI_GAME_SOLID;
    return of;
}

/// Keeps the first name, as the level that it is of is read and closed.
static void keep_name(char *kept, size_t size, const char *name) {
    if (!*kept) snprintf(kept, size, "%s", name);
}

/// Fills in the cells and gathers doors.
static sl_status read_cells(sli_ldtk *reader, const sli_json *layer, const sli_json *cells,
                            size_t count, size_t columns, char *squares) {
    sli_json defs[3];
    const sli_json uid = sli_json_member(layer, "layerDefUid");
    const sli_json definition = find_definition(reader, "layers", &uid, defs);
    const sli_json values = sli_json_member(&definition, "intGridValues");
    sli_ldtk_layer of = layer_of(reader, layer);
    of.by_name = sli_ldtk_any_solid(&values);
    of.only_walkable = sli_ldtk_only_walkable(&values);
    of.ceiling = sli_ldtk_any_ceiling(&values);
    reader->side_view |= sli_ldtk_any_platform(&values);
    const bool takes_empty = of.numbers.length ? sli_numbers_have(of.numbers, 0) : of.only_walkable;
    known_cells *known = sl_alloc(reader->context, sizeof *known);
    if (!known) return SL_NO_MEMORY;
    *known = (known_cells){0};
    sl_status status = SL_OK;
    int64_t only = 0;
    bool bare = true;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        if (i % 4096 == 0) status = sl_check_cancelled(reader->context);
        const sli_json item = sli_json_item(cells, i);
        int64_t value = 0;
        if (status == SL_OK) status = sli_json_whole(&item, 0, INT32_MAX, &value);
        if (status != SL_OK || (!value && !takes_empty)) continue;
        const size_t at = (size_t)value % KNOWN;
        if (!known->items[at].is_known || known->items[at].value != value) {
            known->items[at].is_known = true;
            known->items[at].value = value;
            known->items[at].cell = sli_ldtk_meaning(&values, &of, value, &reader->told);
        }
        const sli_ldtk_cell *cell = &known->items[at].cell;
        squares[i] = cell->square == '.' && value ? SLI_LDTK_PASS : cell->square;
        bare &= cell->bare && (!only || only == value);
        only = value;
        reader->tiles.water |= cell->square == '~';
        if (cell->says.kind == SLI_THING_DOOR)
            status = sli_things_add_square(&reader->things, &cell->says, i % columns, i / columns);
    }
    for (size_t i = 0; i < count && bare; i++)
        if (squares[i] == '#') squares[i] = SLI_LDTK_BARE;
    sl_free(reader->context, known);
    return status;
}

sl_status sli_ldtk_read_frame(const sli_json *layer, sli_ldtk_place at, sli_ldtk_frame *out) {
    const sli_json width = sli_json_member(layer, "__cWid"),
                   height = sli_json_member(layer, "__cHei");
    const sli_json size = sli_json_member(layer, "__gridSize");
    const sli_json x = sli_json_member(layer, "__pxTotalOffsetX");
    const sli_json y = sli_json_member(layer, "__pxTotalOffsetY");
    int64_t offset_x = 0, offset_y = 0;
    SL_TRY(sli_json_whole(&width, 1, INT32_MAX, &out->columns));
    SL_TRY(sli_json_whole(&height, 1, INT32_MAX, &out->rows));
    SL_TRY(sli_json_whole(&size, 1, SLI_LDTK_MOST_PIXELS, &out->step));
    SL_TRY(sli_json_whole_if(&x, -SLI_LDTK_MOST_PIXELS, SLI_LDTK_MOST_PIXELS, &offset_x));
    SL_TRY(sli_json_whole_if(&y, -SLI_LDTK_MOST_PIXELS, SLI_LDTK_MOST_PIXELS, &offset_y));
    out->corner = (sl_point){at.x + (double)offset_x, at.y + (double)offset_y};
    return SL_OK;
}

static sl_status read_layer(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at) {
    const sli_json cells = sli_json_member(layer, "intGridCsv");
    sli_ldtk_frame of;
    size_t count;
    SL_TRY(sli_ldtk_read_frame(layer, at, &of));
    if (!cells.value && sli_json_member(layer, "intGrid").value)
        return sli_json_fail(layer, "an LDtk before 0.8 wrote these cells, in a form that is not "
                                    "read: open the project in a newer LDtk and save it");
    SL_TRY(sli_json_array(&cells, &count));
    if (count / (size_t)of.columns != (size_t)of.rows || count % (size_t)of.columns)
        return sli_json_fail(&cells, "%lld x %lld cells are %lld, found %zu", (long long)of.columns,
                             (long long)of.rows, (long long)(of.columns * of.rows), count);
    char *squares;
    const sl_point square = {(double)of.step, (double)of.step};
    SL_TRY(sli_tiles_add(reader->context, &reader->tiles, reader->name, of.corner, square,
                         (size_t)of.columns, (size_t)of.rows, &squares));
    reader->layers++;
    keep_name(reader->asked, sizeof reader->asked, sli_json_text_of(layer, "__identifier"));
    SL_TRY(read_cells(reader, layer, &cells, count, (size_t)of.columns, squares));
    return sli_things_end_block(&reader->things, of.corner, square);
}

// --- layers of tiles, where there is no IntGrid

bool sli_ldtk_find_square(const sli_json *tile, const sli_ldtk_frame *of, size_t *at) {
    const sli_json px = sli_json_member(tile, "px");
    const json_t *x = json_array_get(px.value, 0), *y = json_array_get(px.value, 1);
    if (!json_is_integer(x) || !json_is_integer(y)) return false;
    const int64_t column = json_integer_value(x) / of->step, row = json_integer_value(y) / of->step;
    if (json_integer_value(x) < 0 || json_integer_value(y) < 0 || column >= of->columns ||
        row >= of->rows)
        return false;
    *at = (size_t)(row * of->columns + column);
    return true;
}

/// What a tile makes of its square. All are solid where the layer says so, or those asked for.
static char square_of_tile(const sli_ldtk_layer *layer, const sli_json *tileset, int64_t number) {
    if (layer->kind != SLI_GAME_SOLID) return sli_ldtk_tile(tileset, number);
    return sli_numbers_have(layer->numbers, (uint64_t)number) ? '#' : 0;
}

/// Puts the tiles of one list into their squares.
static sl_status read_tile_list(sli_ldtk *reader, const sli_json *list, const sli_json *tileset,
                                const sli_ldtk_layer *layer, const sli_ldtk_frame *of,
                                char *squares, bool *any) {
    struct {
        bool is_known;
        int64_t tile;
        char square;
    } known[KNOWN] = {{0}};
    for (size_t i = 0; i < json_array_size(list->value); i++) {
        const sli_json tile = sli_json_item(list, i), id = sli_json_member(&tile, "t");
        size_t at;
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(reader->context));
        if (!json_is_integer(id.value) || !sli_ldtk_find_square(&tile, of, &at)) continue;
        const int64_t number = json_integer_value(id.value);
        const size_t slot = (size_t)((uint64_t)number % KNOWN);
        if (!known[slot].is_known || known[slot].tile != number) {
            known[slot].is_known = true;
            known[slot].tile = number;
            known[slot].square = square_of_tile(layer, tileset, number);
        }
        const char square = known[slot].square;
        if (!square || squares[at] == '#') continue;
        squares[at] = square;
        *any = true;
        reader->tiles.water |= square == '~';
    }
    return SL_OK;
}

/// A layer of tiles by its name or its tileset; no layer is taken where neither says anything.
static sl_status read_tiles(sli_ldtk *reader, const sli_json *layer, sli_ldtk_place at) {
    sli_json defs[3];
    const sli_json uid = sli_json_member(layer, "__tilesetDefUid");
    const sli_json tileset = find_definition(reader, "tilesets", &uid, defs);
    const sli_json by_hand = sli_json_member(layer, "gridTiles");
    const sli_json by_rules = sli_json_member(layer, "autoLayerTiles");
    const sli_ldtk_layer says = layer_of(reader, layer);
    sli_ldtk_frame of;
    bool any = false;
    char *squares;
    if (!json_array_size(by_hand.value) && !json_array_size(by_rules.value)) return SL_OK;
    SL_TRY(sli_ldtk_read_frame(layer, at, &of));
    SL_TRY(sli_tiles_check(reader->context, &reader->tiles, reader->name, 0, "a layer of tiles",
                           (uint64_t)of.columns, (uint64_t)of.rows));
    SL_TRY(sli_tiles_add(reader->context, &reader->tiles, reader->name, of.corner,
                         (sl_point){(double)of.step, (double)of.step}, (size_t)of.columns,
                         (size_t)of.rows, &squares));
    SL_TRY(read_tile_list(reader, &by_hand, &tileset, &says, &of, squares, &any));
    SL_TRY(read_tile_list(reader, &by_rules, &tileset, &says, &of, squares, &any));
    reader->tile_layers += any;
    return SL_OK;
}

// --- layers

static bool is_int_grid(const sli_json *layer) {
    return strcmp(sli_json_text_of(layer, "__type"), "IntGrid") == 0;
}

static bool is_tiles(const sli_json *layer) {
    return strcmp(sli_json_text_of(layer, "__type"), "Tiles") == 0 ||
           strcmp(sli_json_text_of(layer, "__type"), "AutoLayer") == 0;
}

static bool says_solid(const sli_json *layer) {
    return sli_game_kind_of(sli_json_text_of(layer, "__identifier")) == SLI_GAME_SOLID;
}

/// What the layers of a level that hold cells say by their names.
typedef struct said {
    bool solid; ///< some are solid
    bool plain; ///< some are no pictures, doors, zones
} said;

static bool is_plain(const sli_json *layer) {
    const sli_game_kind kind = sli_game_kind_of(sli_json_text_of(layer, "__identifier"));
    return kind != SLI_GAME_DRAWN && kind != SLI_GAME_PASS;
}

/// Whether a layer of cells is to be read: those asked for; else those whose names say that they
/// are solid, and water beside them; else all but pictures and zones, where there are others.
static bool is_taken(const sli_ldtk *reader, const sli_json *layer, said all) {
    const char *name = sli_json_text_of(layer, "__identifier");
    const sli_game_kind kind = sli_game_kind_of(name);
    sli_word numbers;
    if (!is_int_grid(layer)) return false;
    if (reader->options->layers) return sli_layers_ask(reader->options->layers, name, &numbers);
    if (all.solid) return kind == SLI_GAME_SOLID || kind == SLI_GAME_WATER;
    return !all.plain || is_plain(layer);
}

/// Whether a layer of cells has a value anywhere. What is no list of numbers is for its reader.
static bool has_values(const sli_json *layer) {
    const sli_json cells = sli_json_member(layer, "intGridCsv");
    bool any = !json_is_array(cells.value);
    for (size_t i = 0; i < json_array_size(cells.value) && !any; i++) {
        const json_t *value = json_array_get(cells.value, i);
        any = !json_is_integer(value) || json_integer_value(value) != 0;
    }
    return any;
}

bool sli_ldtk_has_tiles(const sli_json *layer) {
    const sli_json by_hand = sli_json_member(layer, "gridTiles");
    const sli_json by_rules = sli_json_member(layer, "autoLayerTiles");
    return json_array_size(by_hand.value) || json_array_size(by_rules.value);
}

/// Whether the level has layers of cells: those of tiles count only where it has not, or where all
/// cells are empty and no layer is named for what is solid. An empty layer of walls is a hall.
static bool has_cells(const sli_json *layers) {
    bool any = false, full = false, tiles = false;
    for (size_t i = 0; i < json_array_size(layers->value); i++) {
        const sli_json layer = sli_json_item(layers, i);
        full |= is_int_grid(&layer) && (says_solid(&layer) || has_values(&layer));
        any |= is_int_grid(&layer);
        tiles |= is_tiles(&layer) && sli_ldtk_has_tiles(&layer);
    }
    return any && (full || !tiles);
}

/// Whether the project has entities of this name.
static bool has_entity(const sli_ldtk *reader, sli_word name) {
    const sli_json defs = sli_json_member(&reader->project, "defs");
    const sli_json entities = sli_json_member(&defs, "entities");
    for (size_t i = 0; i < json_array_size(entities.value); i++) {
        const sli_json entity = sli_json_item(&entities, i);
        if (sli_word_is(name, sli_json_text_of(&entity, "identifier"))) return true;
    }
    return false;
}

/// Whether squares without a tile are asked for, and no layer has that name.
static bool asks_void(const sli_ldtk *reader, const sli_json *layers) {
    sli_word numbers;
    if (!reader->options->layers || !sli_layers_ask(reader->options->layers, "void", &numbers))
        return false;
    for (size_t i = 0; i < json_array_size(layers->value); i++) {
        const sli_json layer = sli_json_item(layers, i);
        if (strcmp(sli_json_text_of(&layer, "__identifier"), "void") == 0) return false;
    }
    return true;
}

static sl_status check_layers(sli_ldtk *reader, const sli_json *layers) {
    const char *list = reader->options->layers;
    const bool cells = has_cells(layers);
    reader->void_is_solid |= asks_void(reader, layers);
    for (sli_word name; list && sli_layers_next(&list, &name);) {
        sli_word numbers = {0};
        bool known =
            has_entity(reader, name) || (reader->void_is_solid && sli_word_is(name, "void"));
        sli_name_list there = {.full = false};
        for (size_t i = 0; i < json_array_size(layers->value); i++) {
            const sli_json layer = sli_json_item(layers, i);
            if (!is_int_grid(&layer) && !is_tiles(&layer)) continue;
            const char *own = sli_json_text_of(&layer, "__identifier");
            known |= sli_layers_name(name, own, &numbers);
            if (cells != is_int_grid(&layer)) continue;
            sli_name_list_add(&there, (sli_word){own, strlen(own)});
        }
        if (!known) return sli_fail_layer(reader->context, reader->name, name, "level", &there);
        if (!sli_numbers_good(numbers))
            return sl_fail(reader->context, SL_BAD_ARGUMENT,
                           "%s: layer '%s': expected values such as 1+3-5 behind the ':'",
                           reader->name, sli_show(name).text);
    }
    return SL_OK;
}

sl_status sli_ldtk_read_layers(sli_ldtk *reader, const sli_json *layers, sli_ldtk_place at) {
    size_t count;
    said all = {.solid = false};
    SL_TRY(sli_json_array(layers, &count));
    SL_TRY(check_layers(reader, layers));
    for (size_t i = 0; i < count; i++) {
        const sli_json layer = sli_json_item(layers, i);
        SL_TRY(sli_json_object(&layer));
        all.solid |= is_int_grid(&layer) && says_solid(&layer);
        all.plain |= is_int_grid(&layer) && is_plain(&layer);
    }
    const bool cells = has_cells(layers);
    const sli_ldtk_walls walls = reader->options->layers ? SLI_LDTK_ASKED
                                 : cells                 ? SLI_LDTK_STOPPING
                                                         : SLI_LDTK_NAMED;
    for (size_t i = 0; i < count; i++) {
        const sli_json layer = sli_json_item(layers, i);
        const size_t before = reader->layers + reader->tile_layers;
        sli_word numbers;
        const bool asked = reader->options->layers
                               ? sli_layers_ask(reader->options->layers,
                                                sli_json_text_of(&layer, "__identifier"), &numbers)
                               : !cells;
        if (is_tiles(&layer)) SL_TRY(sli_ldtk_keep_drawn(reader, &layer, at));
        SL_TRY(sli_ldtk_read_entities(reader, &layer, at, walls));
        if (is_taken(reader, &layer, all) && (cells || reader->options->layers))
            SL_TRY(read_layer(reader, &layer, at));
        if (asked && is_tiles(&layer)) SL_TRY(read_tiles(reader, &layer, at));
        reader->other_layers += before == reader->layers + reader->tile_layers;
        reader->empty_cells |= !cells && is_int_grid(&layer);
    }
    return SL_OK;
}
