/// LDtk projects and separate level files: JSON (https://ldtk.io/json). Of a level's layers those
/// of type IntGrid give walls: a whole number a cell, 0 for none. Where a level has none, tiles do,
/// by their layer's name or the enums of their tileset. Entities give starts and doors.
#include "io/ldtk.h"

#include "io/io_formats.h"
#include "map/source.h"
#include "sightline/io.h"

#include <math.h>
#include <stdlib.h>
#include <strings.h>

/// A level that lies in a file of its own.
static sl_status read_separate(sli_ldtk *reader, const sli_json *path, sli_ldtk_place at) {
    const char *relative;
    SL_TRY(sli_json_text(path, &relative));
    char *from;
    sl_bytes bytes;
    SL_TRY(sli_beside_read(reader->context, reader->name, relative, &from, &bytes));
    sli_json_file file;
    sl_status status = sli_json_open(reader->context, from, bytes.data, bytes.size, &file);
    if (status == SL_OK) {
        const sli_json level = sli_json_root(&file);
        const sli_json layers = sli_json_member(&level, "layerInstances");
        status = sli_ldtk_read_layers(reader, &layers, at);
        sli_json_close(&file);
    }
    sl_free(reader->context, bytes.data);
    sl_free(reader->context, from);
    return status;
}

static sl_status read_level(sli_ldtk *reader, const sli_json *level, sli_ldtk_place at) {
    const sli_json layers = sli_json_member(level, "layerInstances");
    const sli_json path = sli_json_member(level, "externalRelPath");
    const sli_json height = sli_json_member(level, "pxHei");
    const sli_json width = sli_json_member(level, "pxWid");
    int64_t rows, columns;
    SL_TRY(sli_json_whole(&height, 1, SLI_LDTK_MOST_PIXELS, &rows));
    SL_TRY(sli_json_whole(&width, 1, SLI_LDTK_MOST_PIXELS, &columns));
    const double bottom = at.y + (double)rows;
    const sl_box own = {{at.x, at.y}, {at.x + (double)columns, bottom}};
    SL_TRY(SL_ARRAY_ROOM(reader->context, &reader->pages, 1));
    reader->pages.items[reader->pages.count++] = own;
    reader->bottom = reader->levels ? fmax(reader->bottom, bottom) : bottom;
    if (!reader->levels) {
        const char *name = sli_json_text_of(level, "identifier");
        snprintf(reader->taken, sizeof reader->taken, "%s",
                 sli_show((sli_word){name, strlen(name)}).text);
    }
    reader->levels++;
    if (!layers.value && path.value) return read_separate(reader, &path, at);
    return sli_ldtk_read_layers(reader, &layers, at);
}

/// All levels of a world, or of the project where it has but one, each in its place.
static sl_status read_world(sli_ldtk *reader, const sli_json *world) {
    const sli_json levels = sli_json_member(world, "levels");
    const char *layout = sli_json_text_of(world, "worldLayout");
    const bool across = strcmp(layout, "LinearHorizontal") == 0;
    const bool down = strcmp(layout, "LinearVertical") == 0;
    sli_ldtk_place at = {0};
    size_t count;
    SL_TRY(sli_json_array(&levels, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json level = sli_json_item(&levels, i);
        const sli_json x = sli_json_member(&level, "worldX"), y = sli_json_member(&level, "worldY");
        const sli_json width = sli_json_member(&level, "pxWid");
        const sli_json height = sli_json_member(&level, "pxHei");
        const sli_json layer = sli_json_member(&level, "worldDepth");
        int64_t left = 0, top = 0, depth = 0, columns, rows;
        SL_TRY(sli_json_object(&level));
        SL_TRY(sli_json_whole_if(&x, -SLI_LDTK_MOST_PIXELS, SLI_LDTK_MOST_PIXELS, &left));
        SL_TRY(sli_json_whole_if(&y, -SLI_LDTK_MOST_PIXELS, SLI_LDTK_MOST_PIXELS, &top));
        SL_TRY(sli_json_whole_if(&layer, INT32_MIN, INT32_MAX, &depth));
        SL_TRY(sli_json_whole(&width, 1, SLI_LDTK_MOST_PIXELS, &columns));
        SL_TRY(sli_json_whole(&height, 1, SLI_LDTK_MOST_PIXELS, &rows));
        if (i == 0) reader->depth = depth;
        if (depth != reader->depth) {
            reader->other_depths++;
            continue;
        }
        if (!across && !down) at = (sli_ldtk_place){(double)left, (double)top};
        SL_TRY(read_level(reader, &level, at));
        if (across) at.x += (double)columns;
        if (down) at.y += (double)rows;
    }
    return SL_OK;
}

static bool is_named(const sli_json *thing, const char *name) {
    return strcmp(sli_json_text_of(thing, "identifier"), name) == 0 ||
           strcmp(sli_json_text_of(thing, "iid"), name) == 0;
}

/// Reads the level that is asked for, or the first; `*found` where it is in this world.
static sl_status read_one_of(sli_ldtk *reader, const sli_json *world, bool *found) {
    const sli_json levels = sli_json_member(world, "levels");
    const char *map = reader->options->map;
    size_t count;
    SL_TRY(sli_json_array(&levels, &count));
    for (size_t i = 0; i < count && !*found; i++) {
        const sli_json level = sli_json_item(&levels, i);
        SL_TRY(sli_json_object(&level));
        if (map && !is_named(&level, map)) continue;
        *found = true;
        SL_TRY(read_level(reader, &level, (sli_ldtk_place){0}));
        reader->other_levels += count - 1;
    }
    return SL_OK;
}

static sl_status read_project(sli_ldtk *reader) {
    const sli_json worlds = sli_json_member(&reader->root, "worlds");
    const char *map = reader->options->map;
    const size_t count = json_array_size(worlds.value);
    bool found = false;
    if (count == 0) SL_TRY(read_one_of(reader, &reader->root, &found));
    for (size_t i = 0; i < count && !found; i++) {
        const sli_json world = sli_json_item(&worlds, i);
        SL_TRY(sli_json_object(&world));
        SL_TRY(read_one_of(reader, &world, &found));
    }
    if (found) return SL_OK;
    if (!map) return sli_json_fail(&reader->root, "the project has no level");
    if (count == 0 && strcmp(map, "all") == 0) return read_world(reader, &reader->root);
    for (size_t i = 0; i < count; i++) {
        const sli_json world = sli_json_item(&worlds, i);
        if (is_named(&world, map) || strcmp(map, "all") == 0) return read_world(reader, &world);
    }
    return sl_fail(reader->context, SL_BAD_ARGUMENT,
                   "%s: there is no level or world '%s' ('all' takes the first world's levels)",
                   reader->name, sli_show((sli_word){map, strlen(map)}).text);
}

/// Writes "; open: a, b" for a list that has anything.
static void add_list(char *text, size_t size, const char *lead, const sli_name_list *list) {
    const size_t used = strlen(text);
    if (*list->text && used < size) snprintf(text + used, size - used, "%s%s", lead, list->text);
}

/// Tells what the values are taken for, and what changes it.
static void tell_values(const sli_ldtk *reader, const sli_ldtk_settled *as) {
    char text[900] = "";
    const sli_ldtk_told *told = &reader->told;
    const bool several = strchr(told->solid.text, ',') != NULL;
    if (as->bare_open)
        sl_note(
            reader->context,
            "%s: a start stands on the only value, which has no name: it is taken as floor, and "
            "empty cells as solid; if it is what is solid: sightline check '%.300s' --map "
            "'%.80s' --layers '%.80s' -o map.png",
            reader->name, reader->name, reader->taken, reader->asked);
    if (reader->options->layers || !(told->named || several)) return;
    add_list(text, sizeof text,
             told->named ? "solid: " : "solid, as none has a name: ", &told->solid);
    add_list(text, sizeof text,
             as->stands_open     ? "; floor, as entities stand on it: "
             : *told->solid.text ? ", "
                                 : "solid: ",
             &told->stands);
    add_list(text, sizeof text,
             as->ground_solid ? "; solid ground: " : "; open ground: ", &told->ground);
    if (as->beside_solid) add_list(text, sizeof text, "; solid ground: ", &told->beside);
    add_list(text, sizeof text, "; stops steps, not sight: ", &told->water);
    const bool beside = *told->beside.text && !as->beside_solid;
    if (beside) add_list(text, sizeof text, "; open: ", &told->beside);
    add_list(text, sizeof text, beside ? ", " : "; open: ", &told->open);
    const char *own = *text == ';' ? text + 2 : text;
    sl_note(reader->context, "%s: values: %s; --layers %s:%s takes values by their numbers",
            reader->name, own, reader->asked, *told->numbers ? told->numbers : told->others);
}

static bool has_solid(const sli_ldtk *reader) {
    for (size_t i = 0; i < reader->tiles.blocks.count; i++) {
        const sli_tile_block *block = &reader->tiles.blocks.items[i];
        if (memchr(block->squares, '#', block->columns * block->rows)) return true;
    }
    return false;
}

/// What empty cells beside open ground are, and what takes the contrary.
static void tell_bare(const sli_ldtk *reader, const sli_ldtk_settled *as) {
    const char *numbers = reader->told.numbers;
    char next[SLI_LDTK_EXAMPLE];
    snprintf(next, sizeof next,
             "sightline check '%.300s' --map '%.80s' --layers '%.80s:%s%s%s' -o "
             "map.png",
             reader->name, reader->taken, reader->asked, as->bare_solid ? "" : "0",
             !as->bare_solid && *numbers ? "+" : "", numbers);
    if (as->bare_solid)
        sl_note(
            reader->context,
            "%s: %.0f %% of the cells are empty, and taken as solid, as starts stand on a floor "
            "that ends there; if one walks there%s%s",
            reader->name, 100 * as->bare, *numbers ? ": " : ", give them a value in LDtk",
            *numbers ? next : "");
    else
        sl_note(reader->context,
                "%s: %.0f %% of the cells are empty, and open as the ground is; if they are solid: "
                "%s",
                reader->name, 100 * as->bare, next);
}

/// What is taken of a layer of tiles by a guess, and what takes the contrary.
static void tell_guess(const sli_ldtk *reader) {
    const bool tiles = reader->guess == SLI_LDTK_GUESS_TILES;
    const char *layer = reader->drawn.items[reader->guessed].name;
    char why[120] = "they lie below and not above, as in a platformer";
    if (reader->stood_of)
        snprintf(why, sizeof why, "%zu of %zu starts and entities stand %s", reader->stood,
                 reader->stood_of, tiles ? "where there is none" : "on tiles");
    sl_note(reader->context,
            "%s: nothing in it says what is solid: %s of layer '%s' are taken (%s); if it is the "
            "other way round: sightline check '%.300s' --map '%.80s' --layers '%.80s' -o map.png",
            reader->name, tiles ? "the tiles" : "the squares without tiles", layer, why,
            reader->name, reader->taken, tiles ? "void" : layer);
}

/// What may be walls, and is not: layers of tiles, and cells without a value.
static sl_status tell_doubts(sli_ldtk *reader, const sli_ldtk_settled *as) {
    char example[SLI_LDTK_EXAMPLE];
    if (reader->options->layers) return SL_OK;
    if (reader->guess) {
        tell_guess(reader);
    } else if (reader->drawn.count && (!reader->layers || !has_solid(reader))) {
        SL_TRY(sli_ldtk_show_example(reader, example));
        sl_note(reader->context, "%s: %s; layers of tiles: %s%s", reader->name,
                reader->layers ? "no cell is solid, so the level's edge is its walls"
                               : "layers are told by their names and enums",
                sli_name_list_cut(&reader->tile_names, 150), example);
    }
    if (as->bare > 0.1)
        tell_bare(reader, as);
    else
        sli_ldtk_note_outside(reader);
    return SL_OK;
}

/// What was taken, merged and left out.
static sl_status give_account(sli_ldtk *reader, const sl_map *map, const sli_ldtk_settled *as) {
    char bottom[SL_NUMBER_TEXT];
    sl_number_write(reader->bottom, bottom);
    const sli_tally left[] = {
        {reader->other_levels, "other level", "other levels"},
        {reader->other_depths, "level at another depth", "levels at other depths"},
        {reader->other_layers, "other layer", "other layers"},
        {reader->entities, "entity", "entities"}};
    const sli_tally beside[] = {
        {reader->walls.count, "entity named as solid", "entities named as solid"}};
    char without[SLI_TALLY_TEXT], entities[SLI_TALLY_TEXT];
    const char *world = reader->levels > 1 ? " and all of its world" : "";
    const size_t count = reader->layers ? reader->layers : reader->tile_layers;
    if (reader->walls.count && !count) {
        sl_note(reader->context,
                "%s: level %s%s: %zu %s %zu walls%s; unit: pixels, y = %s - the file's y",
                reader->name, reader->taken, world, reader->walls.count,
                reader->walls.count == 1 ? "entity named as a wall gives"
                                         : "entities named as walls give",
                map->wall_count, sli_tally_write("; left out: ", left, 4, without), bottom);
        return SL_OK;
    }
    sl_note(reader->context,
            "%s: level %s%s: %zu %s layer%s%s give%s %zu wall%s; solid are %s%s; unit: pixels, "
            "y = %s - the file's y",
            reader->name, reader->taken, world, count, reader->layers ? "IntGrid" : "tile",
            count == 1 ? "" : "s", sli_tally_write(" and ", beside, 1, entities),
            count == 1 && !reader->walls.count ? "s" : "", map->wall_count,
            map->wall_count == 1 ? "" : "s",
            reader->void_is_solid ? "squares without tiles"
            : !reader->layers     ? "tiles whose layer or enum says so"
            : as->bare_open       ? "the empty cells"
            : reader->told.named  ? "values by their names"
                                  : "all values but 0",
            sli_tally_write("; left out: ", left, 4, without), bottom);
    tell_values(reader, as);
    return tell_doubts(reader, as);
}

/// SL_BAD_INPUT where the level has nothing that says what is solid.
static sl_status check_any(sli_ldtk *reader, bool unsure) {
    char next[1200] = "; it has no tiles", example[SLI_LDTK_EXAMPLE];
    const bool none = !reader->layers && !reader->tile_layers && !reader->walls.count;
    if (none && (reader->drawn.count || reader->marks)) {
        SL_TRY(sli_ldtk_show_example(reader, example));
        snprintf(next, sizeof next, "; layers of tiles: %s%s",
                 reader->drawn.count ? sli_name_list_cut(&reader->tile_names, 150) : "none",
                 example);
    }
    if (none)
        return sli_json_fail(&reader->root,
                             "level %s has no IntGrid layer%s, and no layer of tiles whose name or "
                             "whose tileset's enums say what is solid (Wall, Solid, Collision)%s",
                             reader->taken, reader->empty_cells ? " with values" : "", next);
    const char *numbers = reader->told.numbers;
    if (unsure)
        return sl_fail_at(reader->context, reader->name, 0,
                          "the values %s may be walls or open ground; if they are walls: sightline "
                          "check '%.300s' --map '%.80s' --layers '%.80s' -o map.png%s%s%s%s%s",
                          reader->told.ground.text, reader->name, reader->taken, reader->asked,
                          *numbers ? "; if they are open, with --layers '" : "",
                          *numbers ? reader->asked : "", *numbers ? ":" : "", numbers,
                          *numbers ? "'" : "");
    return SL_OK;
}

/// SL_BAD_INPUT where all is solid: nothing is left to see.
static sl_status check_walls(sli_ldtk *reader, const sl_map *map) {
    char next[700] = "";
    if (map->wall_count || sl_map_partial_walls(map)) return SL_OK;
    const sli_ldtk_told *told = &reader->told;
    const bool several = strchr(told->solid.text, ',') || *told->stands.text;
    const char *numbers = *told->numbers ? told->numbers : told->others;
    if (reader->layers && several)
        snprintf(next, sizeof next,
                 "; to take values by their numbers: sightline check '%.300s' --map '%.80s' "
                 "--layers '%.80s:%.*s' -o map.png",
                 reader->name, reader->taken, reader->asked, (int)strcspn(numbers, "+"), numbers);
    else if (!reader->layers)
        snprintf(next, sizeof next, "; give some by number; layers of tiles: %s",
                 sli_name_list_cut(&reader->tile_names, 150));
    return sl_fail_at(reader->context, reader->name, 0,
                      "level %s: every cell is solid, so there are no walls%s", reader->taken,
                      next);
}

/// The project of a level's file: NAME.ldtk beside the folder NAME that it lies in. Its definitions
/// name the values. `*project` has no root where there is none.
static sl_status open_project(sli_ldtk *reader, sli_json_file *project, char **path) {
    char *whole = realpath(reader->name, NULL), relative[300];
    char *end = whole ? strrchr(whole, '/') : NULL;
    if (end) *end = '\0';
    const char *folder = end ? sl_path_name(whole) : "";
    const int length = snprintf(relative, sizeof relative, "../%s.ldtk", folder);
    *path =
        *folder && (size_t)length < sizeof relative
            ? sli_beside_path(reader->context, reader->name, (sli_word){relative, strlen(relative)})
            : sl_copy_text(reader->context, "", 0);
    free(whole);
    if (!*path) return SL_NO_MEMORY;
    if (!sli_beside_is_there(*path)) {
        sl_note(reader->context, "%s: its project is not there: its values have no names",
                reader->name);
        return SL_OK;
    }
    sl_bytes bytes;
    SL_TRY(sl_file_read(reader->context, *path, &bytes));
    const sl_status status = sli_json_open(reader->context, *path, bytes.data, bytes.size, project);
    sl_free(reader->context, bytes.data);
    return status;
}

static sl_status read_alone(sli_ldtk *reader) {
    const char *own = sli_json_text_of(&reader->root, "identifier");
    if (reader->options->map && !is_named(&reader->root, reader->options->map))
        return sl_fail(reader->context, SL_BAD_ARGUMENT, "%s: the level's name is '%s'",
                       reader->name, sli_show((sli_word){own, strlen(own)}).text);
    sli_json_file project = {.root = NULL};
    char *path = NULL;
    sl_status status = open_project(reader, &project, &path);
    if (project.root) reader->project = sli_json_root(&project);
    if (status == SL_OK) status = read_level(reader, &reader->root, (sli_ldtk_place){0});
    reader->project = reader->root;
    sli_json_close(&project);
    sl_free(reader->context, path);
    return status;
}

static sl_status read_file(sli_ldtk *reader, sl_map *map) {
    const sli_json levels = sli_json_member(&reader->root, "levels");
    const sli_json worlds = sli_json_member(&reader->root, "worlds");
    sli_ldtk_settled settled;
    SL_TRY(sli_json_object(&reader->root));
    SL_TRY(levels.value || worlds.value ? read_project(reader) : read_alone(reader));
    SL_TRY(sli_ldtk_settle_walls(reader));
    SL_TRY(sli_ldtk_settle_drawn(reader));
    sli_ldtk_settle_ground(reader, &settled);
    SL_TRY(check_any(reader, settled.unsure));
    reader->things.top = reader->bottom;
    const sli_tiles_options options = {.top = reader->bottom,
                                       .solid_between = true,
                                       .all_closed = true,
                                       .other_ground = reader->walls.count > 0,
                                       .things = &reader->things};
    SL_TRY(sli_tiles_add_walls(reader->context, &reader->tiles, reader->name, &options, map));
    SL_TRY(sli_ldtk_add_walls(reader, map));
    strcpy(map->unit, "px");
    map->source.transform = sli_y_down(reader->bottom, 1);
    SL_TRY(give_account(reader, map, &settled));
    SL_TRY(check_walls(reader, map));
    return sli_things_finish(&reader->things, map);
}

static sl_status list_name(sl_context *context, const sli_json *thing, sl_map_list *list) {
    const sli_json name = sli_json_member(thing, "identifier");
    const char *text;
    SL_TRY(sli_json_text(&name, &text));
    return sl_map_list_add(context, list, text, strlen(text));
}

static sl_status list_levels(sl_context *context, const sli_json *world, sl_map_list *list) {
    const sli_json levels = sli_json_member(world, "levels");
    size_t count = 0;
    if (levels.value) SL_TRY(sli_json_array(&levels, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json level = sli_json_item(&levels, i);
        SL_TRY(list_name(context, &level, list));
    }
    return SL_OK;
}

/// All levels, then what takes a whole world: its name, or "all" where there is one only.
static sl_status list_all(sl_context *context, const sli_json *root, sl_map_list *list) {
    const sli_json worlds = sli_json_member(root, "worlds"),
                   levels = sli_json_member(root, "levels");
    SL_TRY(sli_json_object(root));
    if (!worlds.value && !levels.value) return list_name(context, root, list);
    const size_t count = json_array_size(worlds.value);
    if (!count) SL_TRY(list_levels(context, root, list));
    for (size_t i = 0; i < count; i++) {
        const sli_json world = sli_json_item(&worlds, i);
        SL_TRY(list_levels(context, &world, list));
    }
    for (size_t i = 0; i < count; i++) {
        const sli_json world = sli_json_item(&worlds, i);
        SL_TRY(list_name(context, &world, list));
    }
    return !count && list->count > 1 ? sl_map_list_add(context, list, "all", 3) : SL_OK;
}

sl_status sli_map_list_ldtk(sl_context *context, const char *name, const char *text, size_t size,
                            sl_map_list *list) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    const sli_json root = sli_json_root(&file);
    const sl_status status = list_all(context, &root, list);
    sli_json_close(&file);
    if (status != SL_OK) sl_map_list_destroy(context, list);
    return status;
}

sl_status sli_map_read_ldtk(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    sl_map read = {0};
    sli_ldtk reader = {.context = context,
                       .name = name,
                       .options = options,
                       .root = sli_json_root(&file),
                       .project = sli_json_root(&file),
                       .things = {.context = context, .file = name, .options = options}};
    const sl_status status = read_file(&reader, &read);
    sli_tiles_destroy(context, &reader.tiles);
    sli_ldtk_destroy_drawn(&reader);
    sli_things_destroy(&reader.things);
    sl_free(context, reader.others.items);
    sl_free(context, reader.walls.items);
    sl_free(context, reader.pages.items);
    sli_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
