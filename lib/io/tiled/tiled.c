/// Tiled's maps, TMX and JSON, as Tiled's manual has them. Both come here as one JSON tree.
///
/// First it is decided what is solid: the layers that the user asks for; else what layers, tiles
/// and objects say of themselves; else a guess, which is reported. Then solid tiles are gathered
/// grid by grid, and shapes are drawn by the pen. Maps of diamonds are read in the plan, where
/// diamonds are squares (tiled_lattice.c), and projected onto the screen at the end.
#include "io/tiled/tiled.h"
#include "geometry/length.h"
#include "io/io_formats.h"
#include "io/parts/layers.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "map/source.h"
#include "sightline/io.h"

#include <strings.h>

// --- the layers asked for

/// Looks for a layer in a list of layers and in its groups.
static bool find_layer(const sli_json *layers, sli_word word, sli_word *gids) {
    for (size_t i = 0; i < json_array_size(layers->value); i++) {
        const sli_json layer = sli_json_item(layers, i), inner = sli_json_member(&layer, "layers");
        if (sli_layers_name(word, sli_json_text_of(&layer, "name"), gids)) return true;
        if (find_layer(&inner, word, gids)) return true;
    }
    return false;
}

/// Lists the layers that can be asked for: those of tiles and objects, and their groups.
static void name_layers(const sli_json *parent, sli_name_list *out) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const char *name = sli_json_text_of(&layer, "name");
        if (*name) sli_name_list_add(out, (sli_word){name, strlen(name)});
        name_layers(&layer, out);
    }
}

/// SL_BAD_ARGUMENT where the list names a layer that `map` has not, or its numbers are none.
static sl_status tiled_check_choice(const sli_json *map, const char *list) {
    const sli_json layers = sli_json_member(map, "layers");
    for (sli_word word; list && sli_layers_next(&list, &word);) {
        sli_word gids;
        if (!find_layer(&layers, word, &gids)) {
            if (sli_word_is(word, "void")) continue;
            sli_name_list there = {.full = false};
            name_layers(map, &there);
            return sli_fail_layer(map->file->context, map->file->name, word, "map", &there);
        }
        if (!sli_numbers_good(gids))
            return sl_fail(map->file->context, SL_BAD_ARGUMENT,
                           "%s: layer '%s': expected tile numbers such as 28+33-35 behind the ':'",
                           map->file->name, sli_show(word).text);
    }
    return SL_OK;
}

// --- reading a map

/// Whether a property of the map, such as "collisionLayer", names this layer.
static bool map_names(const sli_tiled_reader *reader, const char *layer) {
    sli_tiled_properties at = sli_tiled_properties_of(reader->map);
    const char *name;
    for (sli_json value; sli_tiled_next_property(&at, &name, &value);) {
        const char *text = json_string_value(value.value);
        if (*layer && name && text && sli_says_solid(name) && sli_layers_have(text, layer))
            return true;
    }
    return false;
}

/// What a layer is in the reading at hand; `own` has its name's kind, and what its group is.
static sli_tiled_word word_of_layer(const sli_tiled_reader *reader, const sli_json *layer,
                                    const sli_tiled_place *own) {
    const char *name = sli_json_text_of(layer, "name");
    const sli_tiled_word said = sli_tiled_word_of(layer, "class");
    const bool objects =
        reader->walls_are_pictures && strcmp(sli_json_text_of(layer, "type"), "objectgroup") == 0;
    if (said != SLI_TILED_UNSAID) return said;
    switch (reader->by) {
    case SLI_TILED_BY_WORD:
        if (sli_game_says_stops(name) || map_names(reader, name) ||
            (reader->borders && sli_tiled_is_border(layer)))
            return SLI_TILED_SOLID;
        if (reader->walls_are_pictures && !objects) return own->word;
        return (objects ? own->kind : sli_game_kind_of(name)) == SLI_GAME_SOLID ? SLI_TILED_SOLID
                                                                                : own->word;
    case SLI_TILED_BY_NAME:
        return own->kind == reader->best && !own->moves ? SLI_TILED_SOLID : SLI_TILED_UNSAID;
    case SLI_TILED_BY_TERRAIN:
    case SLI_TILED_BY_SET:
        return own->kind == SLI_GAME_DRAWN || own->moves ? SLI_TILED_OPEN : SLI_TILED_UNSAID;
    case SLI_TILED_BY_BESIDE:
    case SLI_TILED_BY_BARE:
    case SLI_TILED_BY_GUESS:
        break;
    }
    return SLI_TILED_UNSAID;
}

/// What a layer is by its name. In a platformer, the layer of tiles that one stands on is often
/// called "Level". With a number that is a storey; a group of this name holds all.
static sli_game_kind kind_of_layer(const sli_json *layer) {
    const char *name = sli_json_text_of(layer, "name");
    const bool tiles = strcmp(sli_json_text_of(layer, "type"), "tilelayer") == 0;
    return tiles && strcasecmp(name, "level") == 0 ? SLI_GAME_LIKELY : sli_game_kind_of(name);
}

/// Where a layer lies in its group's place, and whether it is solid.
static sl_status find_place(const sli_tiled_reader *reader, const sli_json *layer,
                            const sli_tiled_place *outer, sli_tiled_place *own) {
    const sli_json x = sli_json_member(layer, "offsetx"), y = sli_json_member(layer, "offsety");
    const char *name = sli_json_text_of(layer, "name");
    sl_point offset = {0}, moves = {1, 1};
    SL_TRY(sli_json_number_if(&x, &offset.x));
    SL_TRY(sli_json_number_if(&y, &offset.y));
    const sli_json across = sli_json_member(layer, "parallaxx");
    const sli_json down = sli_json_member(layer, "parallaxy");
    SL_TRY(sli_json_number_if(&across, &moves.x));
    SL_TRY(sli_json_number_if(&down, &moves.y));
    *own = *outer;
    own->offset = (sl_point){outer->offset.x + offset.x, outer->offset.y + offset.y};
    own->moves |= moves.x != 1 || moves.y != 1;
    own->beside |= sli_game_says_beside_player(name);
    const sli_game_kind kind = kind_of_layer(layer);
    if (kind != SLI_GAME_UNSAID) own->kind = kind;
    const bool tiles = strcmp(sli_json_text_of(layer, "type"), "tilelayer") == 0;
    own->doors = tiles && sli_says_door(name) ? name : NULL;
    SL_TRY(sli_tiled_read_stops(layer, &own->stops));
    if (reader->options->layers) {
        sli_word gids;
        if (sli_layers_ask(reader->options->layers, name, &gids)) {
            own->asked = true;
            own->gids = gids;
        }
        own->word = own->asked ? SLI_TILED_SOLID : SLI_TILED_OPEN;
        return SL_OK;
    }
    own->word = word_of_layer(reader, layer, own);
    own->tiles_decide = false;
    own->said = own->denied = 0;
    if (!tiles || own->word != SLI_TILED_SOLID || reader->by || map_names(reader, name) ||
        sli_tiled_word_of(layer, "class") != SLI_TILED_UNSAID)
        return SL_OK;
    return sli_tiled_ask_tiles(reader, layer, sli_game_says_stops(name), own);
}

/// What a file of our own says of the whole map.
static sl_status read_marks(sli_tiled_reader *reader) {
    sl_map *map = reader->pen.map;
    sli_tiled_properties at = sli_tiled_properties_of(reader->map);
    const char *name;
    for (sli_json value; sli_tiled_next_property(&at, &name, &value);) {
        double *to = !name                                  ? NULL
                     : strcmp(name, "sightline-range") == 0 ? &map->range
                     : strcmp(name, "sightline-snap") == 0  ? &map->snap
                     : strcmp(name, "sightline-y0") == 0    ? &reader->lattice.height
                                                            : NULL;
        if (!to) continue;
        SL_TRY(sli_json_number(&value, to));
        if (to != &reader->lattice.height && !(*to > 0))
            return sli_json_fail(&value, "%s: expected a number greater than 0", name);
    }
    return SL_OK;
}

/// Tiles are joined over all layers, and stop all.
static void note_stops_of_tiles(const sli_tiled_reader *reader, const sli_json *layer,
                                const sli_tiled_place *at) {
    const char *name = sli_json_text_of(layer, "name");
    if (at->stops && !reader->by)
        sl_note(reader->context,
                "%s: layer %s: the property 'stops' is for objects; tiles stop all",
                layer->file->name, sli_show((sli_word){name, strlen(name)}).text);
}

// --- layers

static sl_status see_layer(sli_tiled_reader *reader, const sli_json *layer,
                           const sli_tiled_place *own, bool objects) {
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->seen, 1));
    reader->seen.items[reader->seen.count++] =
        (sli_tiled_seen){.name = sli_json_text_of(layer, "name"),
                         .layer = layer->value,
                         .objects = objects,
                         .moves = own->moves,
                         .kind = own->kind,
                         .tiles_decide = own->tiles_decide,
                         .said = own->said,
                         .denied = own->denied};
    return SL_OK;
}

/// Reads a layer of tiles or objects.
static sl_status read_layer(sli_tiled_reader *reader, const sli_json *layer,
                            const sli_tiled_place *own, bool objects) {
    const size_t before = sli_tiled_taken(reader), tiles = reader->solid_tiles;
    if (!reader->by) SL_TRY(see_layer(reader, layer, own, objects));
    // Objects that are named for houses and trees may be places only.
    const bool places =
        reader->by && reader->by != SLI_TILED_BY_BARE && objects && own->kind < SLI_GAME_LIKELY;
    if (objects)
        SL_TRY(places ? SL_OK : sli_tiled_read_objects(reader, layer, own));
    else if (own->word != SLI_TILED_OPEN || (!reader->by && sli_tiled_is_start_layer(layer))) {
        note_stops_of_tiles(reader, layer, own);
        SL_TRY(sli_tiled_read_tile_layer(reader, layer, own));
    }
    sli_tiled_seen *seen = &reader->seen.items[reader->at_layer++];
    const bool solid = own->word == SLI_TILED_SOLID && !places &&
                       !(objects && sli_tiled_kind_of_layer(reader, layer) != SLI_LAYER_NONE);
    // Objects that are no walls, in a layer whose name says little, do not decide.
    const bool none =
        objects && reader->by == SLI_TILED_BY_NAME && sli_tiled_taken(reader) == before;
    reader->solid_layers += solid && seen->count && !none;
    reader->empty_layers += solid && !seen->count;
    seen->taken |= sli_tiled_taken(reader) > before;
    if (!reader->by) seen->solid = reader->solid_tiles - tiles;
    return SL_OK;
}

static sl_status read_layers(sli_tiled_reader *reader, const sli_json *parent,
                             const sli_tiled_place *outer) {
    const sli_json layers = sli_json_member(parent, "layers");
    size_t count = 0;
    if (layers.value) SL_TRY(sli_json_array(&layers, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json layer = sli_json_item(&layers, i);
        SL_TRY(sli_json_object(&layer));
        const char *type = sli_json_text_of(&layer, "type");
        const bool tiles = strcmp(type, "tilelayer") == 0;
        const bool objects = strcmp(type, "objectgroup") == 0;
        sli_tiled_place own;
        SL_TRY(find_place(reader, &layer, outer, &own));
        own.others |= objects && sli_game_says_other(sli_json_text_of(&layer, "name"));
        if (strcmp(type, "group") == 0)
            SL_TRY(read_layers(reader, &layer, &own));
        else if (tiles || objects)
            SL_TRY(read_layer(reader, &layer, &own, objects));
        if (strcmp(type, "group") != 0 && !reader->by)
            reader->other_layers += own.word == SLI_TILED_OPEN || (!tiles && !objects);
    }
    return SL_OK;
}

sl_status sli_tiled_read_again(sli_tiled_reader *reader) {
    sli_tiles_destroy(reader->context, &reader->tiles);
    reader->at_layer = 0;
    return read_layers(reader, reader->map, &(sli_tiled_place){0});
}

static sl_status read_head(sli_tiled_reader *reader) {
    sli_tiled_lattice *lattice = &reader->lattice;
    SL_TRY(sli_tiled_read_lattice(reader->map, lattice));
    const double height = lattice->height;
    if (lattice->orientation == SLI_TILED_ORTHOGONAL) {
        const sli_json columns = sli_json_member(reader->map, "width");
        const double width = sli_json_number_or_0(&columns);
        SL_TRY(read_marks(reader));
        reader->pen.map->source.page =
            (sl_box){{0, lattice->height - height}, {width * lattice->tile.x, lattice->height}};
        reader->pen.map->source.pixels = 1;
    }
    const bool plan = sli_tiled_has_plan(lattice);
    reader->to_plan = sli_tiled_to_plan(lattice);
    reader->top = plan ? 0 : lattice->height;
    reader->pen.affine = (sli_affine){.xx = 1, .yy = -1, .y0 = reader->top};
    reader->pen.map->source.transform = sli_y_down(lattice->height, 1);
    if (plan) {
        const sli_affine to_screen = sli_tiled_to_screen(lattice);
        reader->things.shown = to_screen;
        // No vector grows by more than this factor.
        reader->pen.tolerance /= sli_length(sli_length(to_screen.xx, to_screen.xy),
                                            sli_length(to_screen.yx, to_screen.yy));
    }
    return tiled_check_choice(reader->map, reader->options->layers);
}

static void give_account(const sli_tiled_reader *reader) {
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->lattice.height, top);
    const sli_tally taken[] = {{reader->solid_layers, "solid layer", "solid layers"},
                               {reader->solid_tiles, "solid tile", "solid tiles"},
                               {reader->shapes, "shape of a tile", "shapes of tiles"},
                               {reader->objects, "object", "objects"}};
    const sli_tally left[] = {
        {reader->other_layers, "layer", "layers"},
        {reader->other_objects, "object", "objects"},
        {reader->other_shapes, "shape of another kind", "shapes of other kinds"},
        {reader->pen.points, "line of no length", "lines of no length"},
        {reader->sets.missing, "tileset that is missing", "tilesets that are missing"}};
    char from[SLI_TALLY_TEXT], without[SLI_TALLY_TEXT];
    sl_note(reader->context, "%s: %zu wall%s%s%s; unit: pixels, y = %s - the file's y",
            reader->map->file->name, reader->pen.map->wall_count,
            reader->pen.map->wall_count == 1 ? "" : "s", sli_tally_write(" from ", taken, 4, from),
            sli_tally_write("; left out: ", left, 5, without), top);
    if (reader->lost_shapes)
        sl_note(reader->context,
                "%s: left out: %zu collision shape%s of tiles that are objects: they are drawn in "
                "orthogonal maps only; draw their outlines in a layer 'Collision'",
                reader->map->file->name, reader->lost_shapes, reader->lost_shapes == 1 ? "" : "s");
    if (reader->doors_left_out)
        sl_note(reader->context,
                "%s: left out: %zu tile%s of doors; in hexagonal maps only objects are doors",
                reader->map->file->name, reader->doors_left_out,
                reader->doors_left_out == 1 ? "" : "s");
}

static sl_status read_map(sli_tiled_reader *reader) {
    SL_TRY(read_head(reader));
    SL_TRY(sli_tiled_check_rules(reader));
    SL_TRY(sli_tiled_read_sets(reader->map, &reader->sets));
    SL_TRY(sli_tiled_look_beside(reader));
    SL_TRY(sli_tiled_read_again(reader));
    if (!reader->solid_layers && !reader->options->layers) SL_TRY(sli_tiled_find_meaning(reader));
    SL_TRY(sli_tiled_settle_closed(reader));
    SL_TRY(sli_tiled_settle_void(reader));
    SL_TRY(sli_tiled_add_tile_walls(reader));
    const sl_map *map = reader->pen.map;
    if (!map->wall_count && !sl_map_partial_walls(map)) return sli_tiled_fail_no_walls(reader);
    SL_TRY(sli_tiled_check_guess(reader));
    strcpy(reader->pen.map->unit, "px");
    give_account(reader);
    SL_TRY(sli_tiled_tell_meaning(reader));
    sli_layers_note(reader->context, reader->map->file->name, reader->pen.map);
    SL_TRY(sli_things_finish(&reader->things, reader->pen.map));
    return sli_tiled_project(reader->map, &reader->lattice, reader->pen.map);
}

static sli_tiled_reader begin_reader(sl_context *context, const sli_json *root,
                                     const sl_import_options *options, sl_map *map) {
    const char *name = root->file->name;
    return (sli_tiled_reader){
        .context = context,
        .options = options,
        .map = root,
        .things = {.context = context, .file = name, .options = options},
        .pen = {.context = context, .name = name, .map = map, .tolerance = options->tolerance}};
}

static void end_reader(sl_context *context, sli_tiled_reader *reader) {
    sli_tiles_destroy(context, &reader->tiles);
    sli_tiled_destroy_sets(context, &reader->sets);
    sli_tiled_destroy_templates(context, &reader->templates);
    sli_things_destroy(&reader->things);
    sl_free(context, reader->seen.items);
    sl_free(context, reader->closed.items);
}

/// Reads a tree, and closes its file.
static sl_status read_tree(sl_context *context, sli_json_file *file,
                           const sl_import_options *options, sl_map *map) {
    sl_map read = {0};
    sl_import_options own = *options;
    const sli_json root = sli_json_root(file), layers = sli_json_member(&root, "layers");
    const sli_word empty = {"void", 4};
    sli_word gids;
    const bool asks_void =
        own.layers && sli_layers_have(own.layers, empty.at) && !find_layer(&layers, empty, &gids);
    if (asks_void && sli_tiled_only_void(own.layers)) own.layers = NULL;
    sli_tiled_reader reader = begin_reader(context, &root, &own, &read);
    reader.void_is_solid = asks_void;
    const sl_status status = read_map(&reader);
    end_reader(context, &reader);
    sli_json_close(file);
    // The map's lines are numbers of shapes, if it has any: doors and starts are none of them.
    for (size_t i = 0; i < read.door_count && read.source.lines_are_items; i++)
        read.doors[i].line = 0;
    for (size_t i = 0; i < read.start_count && read.source.lines_are_items; i++)
        read.starts[i].line = 0;
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

static sl_status list_names(sl_context *context, const sli_json *parent, sl_map_list *list) {
    const sli_json layers = sli_json_member(parent, "layers");
    for (size_t i = 0; i < json_array_size(layers.value); i++) {
        const sli_json layer = sli_json_item(&layers, i);
        const char *name = sli_json_text_of(&layer, "name"),
                   *type = sli_json_text_of(&layer, "type");
        if (strcmp(type, "group") == 0) SL_TRY(list_names(context, &layer, list));
        if (strcmp(type, "objectgroup") == 0 || strcmp(type, "tilelayer") == 0)
            SL_TRY(sl_map_list_add(context, list, name, strlen(name)));
    }
    return SL_OK;
}

/// Lists the layers of a tree, reads it to find out what it says is solid, and closes its file.
static sl_status list_tree(sl_context *context, sli_json_file *file, sl_map_list *list,
                           bool *unsaid) {
    sl_map read = {0};
    const sl_import_options options = sl_import_options_default();
    const sli_json root = sli_json_root(file);
    sli_tiled_reader reader = begin_reader(context, &root, &options, &read);
    sl_status status = read_head(&reader);
    if (status == SL_OK) status = sli_tiled_read_sets(reader.map, &reader.sets);
    if (status == SL_OK) status = sli_tiled_read_again(&reader);
    if (status == SL_OK) status = list_names(context, &root, list);
    if (status != SL_OK) sl_map_list_destroy(context, list);
    *unsaid = !reader.solid_layers && (reader.unknown_tiles || !sli_tiled_taken(&reader));
    end_reader(context, &reader);
    sl_map_destroy(context, &read);
    sli_json_close(file);
    return status;
}

sl_status sli_map_read_tmx(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_tiled_from_xml(context, name, "map", text, size, &file));
    return read_tree(context, &file, options, map);
}

sl_status sli_map_read_tmj(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    return read_tree(context, &file, options, map);
}

sl_status sli_map_layers_tmx(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list, bool *unsaid) {
    sli_json_file file;
    SL_TRY(sli_tiled_from_xml(context, name, "map", text, size, &file));
    return list_tree(context, &file, list, unsaid);
}

sl_status sli_map_layers_tmj(sl_context *context, const char *name, const char *text, size_t size,
                             sl_map_list *list, bool *unsaid) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    return list_tree(context, &file, list, unsaid);
}
