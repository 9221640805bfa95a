/// LDtk projects and separate level files: JSON (https://ldtk.io/json). Of a level's layers those
/// of type IntGrid give walls: a whole number a cell, 0 for none. Entities give starts and doors.
#include "io/io_formats.h"
#include "io/parts/document.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "io/parts/things.h"
#include "map/source.h"
#include "sightline/io.h"

#include <math.h>
#include <strings.h>

#define MOST_PIXELS 1000000000

typedef struct ldtk {
    sl_context *context;
    const char *name;
    const sl_import_options *options;
    sli_json root;
    sli_tiles tiles;
    sli_things things;
    double bottom;   ///< the largest y of the levels taken, in pixels from the world's origin
    int64_t depth;   ///< of the levels taken
    char taken[160]; ///< the first level that is taken, as the account shows it
    bool by_name;    ///< of the values of some layer those are solid that say so
    size_t levels, other_levels, other_depths;
    size_t layers, other_layers, entities;
} ldtk;

/// A level's place in its world, in pixels, y down.
typedef struct place {
    double x, y;
} place;

/// Whether an IntGrid layer's values have identifiers that say which of them are solid; the layer's
/// definition is found by its number.
static sli_json find_values(const ldtk *reader, const sli_json *layer, sli_json defs[3]) {
    defs[0] = sli_json_member(&reader->root, "defs");
    defs[1] = sli_json_member(&defs[0], "layers");
    const sli_json uid = sli_json_member(layer, "layerDefUid");
    const size_t count = json_array_size(defs[1].value);
    for (size_t i = 0; uid.value && i < count; i++) {
        defs[2] = sli_json_item(&defs[1], i);
        const sli_json other = sli_json_member(&defs[2], "uid");
        if (other.value && json_equal(uid.value, other.value))
            return sli_json_member(&defs[2], "intGridValues");
    }
    return (sli_json){.file = layer->file};
}

static bool any_says_solid(const sli_json *values) {
    for (size_t i = 0; i < json_array_size(values->value); i++) {
        const sli_json value = sli_json_item(values, i);
        if (sli_says_solid(sli_json_text_of(&value, "identifier"))) return true;
    }
    return false;
}

/// What a value of the cells stands for.
typedef struct cell_meaning {
    bool solid;
    sli_says says;
} cell_meaning;

/// Without names all values but 0 are solid. A door is solid then too: if no passage is found for
/// it, it stays so.
static cell_meaning meaning_of(const sli_json *values, bool by_name, int64_t cell) {
    cell_meaning meaning = {.solid = !by_name && cell != 0};
    for (size_t i = 0; cell && i < json_array_size(values->value); i++) {
        const sli_json value = sli_json_item(values, i), number = sli_json_member(&value, "value");
        const char *name = sli_json_text_of(&value, "identifier");
        if (!json_is_integer(number.value) || json_integer_value(number.value) != cell) continue;
        meaning.solid |= sli_says_solid(name);
        meaning.says = sli_says_of(name, NULL);
        break;
    }
    return meaning;
}

/// Fills in the solid cells and gathers doors; most cells are like the one before.
static sl_status read_cells(ldtk *reader, const sli_json *layer, const sli_json *cells,
                            size_t count, size_t columns, char *squares) {
    sli_json defs[3];
    const sli_json values = find_values(reader, layer, defs);
    const bool by_name = any_says_solid(&values);
    reader->by_name |= by_name;
    int64_t before = 0;
    cell_meaning meaning = {0};
    for (size_t i = 0; i < count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(reader->context));
        const sli_json cell = sli_json_item(cells, i);
        int64_t value;
        SL_TRY(sli_json_whole(&cell, 0, INT32_MAX, &value));
        if (value != before) meaning = meaning_of(&values, by_name, value);
        before = value;
        if (meaning.solid) squares[i] = '#';
        if (meaning.says.kind == SLI_THING_DOOR)
            SL_TRY(sli_things_add_square(&reader->things, &meaning.says, i % columns, i / columns));
    }
    return SL_OK;
}

static sl_status read_layer(ldtk *reader, const sli_json *layer, place at) {
    const sli_json cells = sli_json_member(layer, "intGridCsv");
    const sli_json width = sli_json_member(layer, "__cWid"),
                   height = sli_json_member(layer, "__cHei");
    const sli_json size = sli_json_member(layer, "__gridSize");
    const sli_json x = sli_json_member(layer, "__pxTotalOffsetX");
    const sli_json y = sli_json_member(layer, "__pxTotalOffsetY");
    int64_t columns, rows, step, offset_x = 0, offset_y = 0;
    size_t count;
    SL_TRY(sli_json_whole(&width, 1, INT32_MAX, &columns));
    SL_TRY(sli_json_whole(&height, 1, INT32_MAX, &rows));
    SL_TRY(sli_json_whole(&size, 1, MOST_PIXELS, &step));
    SL_TRY(sli_json_whole_if(&x, -MOST_PIXELS, MOST_PIXELS, &offset_x));
    SL_TRY(sli_json_whole_if(&y, -MOST_PIXELS, MOST_PIXELS, &offset_y));
    SL_TRY(sli_json_array(&cells, &count));
    if (count / (size_t)columns != (size_t)rows || count % (size_t)columns)
        return sli_json_fail(&cells, "%lld x %lld cells are %lld, found %zu", (long long)columns,
                             (long long)rows, (long long)(columns * rows), count);
    char *squares;
    const sl_point corner = {at.x + (double)offset_x, at.y + (double)offset_y};
    const sl_point square = {(double)step, (double)step};
    SL_TRY(sli_tiles_add(reader->context, &reader->tiles, reader->name, corner, square,
                         (size_t)columns, (size_t)rows, &squares));
    reader->layers++;
    SL_TRY(read_cells(reader, layer, &cells, count, (size_t)columns, squares));
    return sli_things_end_block(&reader->things, corner, square);
}

// --- entities

/// Two numbers of an array, where it is there.
static sl_status read_pair(const sli_json *pair, sl_point *out) {
    if (!pair->value) return SL_OK;
    const sli_json x = sli_json_item(pair, 0), y = sli_json_item(pair, 1);
    SL_TRY(sli_json_number(&x, &out->x));
    return sli_json_number(&y, &out->y);
}

/// The heading, if the field names one: clockwise degrees, or a direction on the screen.
static void find_heading(const char *field, const sli_json *value, double *heading) {
    static const char *const fields[] = {"angle", "rotation", "heading", "facing", "direction"};
    static const struct {
        const char *name;
        double heading;
    } words[] = {{"right", 0},  {"east", 0},   {"up", 90},    {"north", 90},
                 {"left", 180}, {"west", 180}, {"down", 270}, {"south", 270}};
    bool known = false;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        known |= strcasecmp(field, fields[i]) == 0;
    const char *text = json_string_value(value->value);
    if (!known) return;
    if (json_is_number(value->value)) *heading = sli_heading_of(json_number_value(value->value));
    for (size_t i = 0; text && i < sizeof words / sizeof *words; i++)
        if (strcasecmp(text, words[i].name) == 0) *heading = words[i].heading;
}

/// What a field `lockedWith` names is a key: the door is shut. No value, no lock.
static bool names_key(const char *field, const sli_json *value) {
    const char *text = json_string_value(value->value);
    return strcasecmp(field, "lockedWith") == 0 &&
           ((text && *text) || json_object_size(value->value) || json_array_size(value->value));
}

/// `own` becomes the text of the field "name", if there is one.
static void read_fields(const sli_json *entity, sli_says *says, double *heading, const char **own) {
    const sli_json fields = sli_json_member(entity, "fieldInstances");
    for (size_t i = 0; i < json_array_size(fields.value); i++) {
        const sli_json field = sli_json_item(&fields, i);
        const sli_json value = sli_json_member(&field, "__value");
        const char *name = sli_json_text_of(&field, "__identifier");
        const char *text = json_string_value(value.value);
        if (json_is_boolean(value.value)) sli_says_add(says, name, json_is_true(value.value));
        if (text) sli_says_add_text(says, name, text);
        if (names_key(name, &value)) sli_says_add(says, "locked", true);
        if (text && *text && strcasecmp(name, "name") == 0) *own = text;
        find_heading(name, &value, heading);
    }
}

/// Adds an entity that is a start or a door. Its pivot is at its place "px".
static sl_status read_entity(ldtk *reader, const sli_json *entity, sl_point corner, double step) {
    const char *name = sli_json_text_of(entity, "__identifier");
    sli_says says = sli_says_of(name, NULL);
    const char *own = name;
    double heading = 0;
    read_fields(entity, &says, &heading, &own);
    if (says.kind == SLI_THING_DOOR && own != name) says.name = own;
    SL_TRY(sli_things_ask(&reader->things, name, NULL, &says));
    if (!says.kind) {
        sli_things_leave(&reader->things, name);
        return SL_OK;
    }
    const sli_json px = sli_json_member(entity, "px"), pivot = sli_json_member(entity, "__pivot");
    const sli_json width = sli_json_member(entity, "width");
    const sli_json height = sli_json_member(entity, "height");
    sl_point at = {0}, part = {0}, size = {step, step};
    if (!px.value) return sli_json_fail(&px, "expected two numbers, found nothing");
    SL_TRY(read_pair(&px, &at));
    SL_TRY(read_pair(&pivot, &part));
    SL_TRY(sli_json_number_if(&width, &size.x));
    SL_TRY(sli_json_number_if(&height, &size.y));
    reader->entities--;
    const sli_thing thing = {.kind = says.kind,
                             .middle = {corner.x + at.x + (0.5 - part.x) * size.x,
                                        corner.y + at.y + (0.5 - part.y) * size.y},
                             .u = {size.x / 2, 0},
                             .v = {0, size.y / 2},
                             .open = says.state != SLI_DOOR_SHUT,
                             .heading = heading};
    return sli_things_add(&reader->things, says.name, thing);
}

static sl_status read_entities(ldtk *reader, const sli_json *layer, place at) {
    const sli_json entities = sli_json_member(layer, "entityInstances");
    const sli_json x = sli_json_member(layer, "__pxTotalOffsetX");
    const sli_json y = sli_json_member(layer, "__pxTotalOffsetY");
    const sli_json size = sli_json_member(layer, "__gridSize");
    const size_t count = json_array_size(entities.value);
    sl_point corner = {0};
    double step = 0;
    if (!count) return SL_OK;
    SL_TRY(sli_json_number_if(&x, &corner.x));
    SL_TRY(sli_json_number_if(&y, &corner.y));
    SL_TRY(sli_json_number_if(&size, &step));
    corner = (sl_point){at.x + corner.x, at.y + corner.y};
    reader->entities += count;
    for (size_t i = 0; i < count; i++) {
        const sli_json entity = sli_json_item(&entities, i);
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(read_entity(reader, &entity, corner, step));
    }
    return SL_OK;
}

// --- layers

static bool is_int_grid(const sli_json *layer) {
    return strcmp(sli_json_text_of(layer, "__type"), "IntGrid") == 0;
}

/// Whether a layer is to be read: those asked for; else those whose names say that they are solid;
/// else all.
static bool is_taken(const ldtk *reader, const sli_json *layer, bool some_say_solid) {
    const char *name = sli_json_text_of(layer, "__identifier");
    if (!is_int_grid(layer)) return false;
    if (reader->options->layers) return sli_layers_have(reader->options->layers, name);
    return !some_say_solid || sli_says_solid(name);
}

static sl_status check_layers(const ldtk *reader, const sli_json *layers) {
    const char *list = reader->options->layers;
    for (sli_word name; list && sli_layers_next(&list, &name);) {
        bool known = false;
        sli_name_list there = {.full = false};
        for (size_t i = 0; i < json_array_size(layers->value); i++) {
            const sli_json layer = sli_json_item(layers, i);
            if (!is_int_grid(&layer)) continue;
            const char *own = sli_json_text_of(&layer, "__identifier");
            known |= sli_word_is(name, own);
            sli_name_list_add(&there, (sli_word){own, strlen(own)});
        }
        if (!known) return sli_fail_layer(reader->context, reader->name, name, "level", &there);
    }
    return SL_OK;
}

static sl_status read_layers(ldtk *reader, const sli_json *layers, place at) {
    size_t count;
    bool some_say_solid = false;
    SL_TRY(sli_json_array(layers, &count));
    SL_TRY(check_layers(reader, layers));
    for (size_t i = 0; i < count; i++) {
        const sli_json layer = sli_json_item(layers, i);
        SL_TRY(sli_json_object(&layer));
        some_say_solid |=
            is_int_grid(&layer) && sli_says_solid(sli_json_text_of(&layer, "__identifier"));
    }
    for (size_t i = 0; i < count; i++) {
        const sli_json layer = sli_json_item(layers, i);
        SL_TRY(read_entities(reader, &layer, at));
        if (is_taken(reader, &layer, some_say_solid))
            SL_TRY(read_layer(reader, &layer, at));
        else
            reader->other_layers++;
    }
    return SL_OK;
}

/// A level that lies in a file of its own.
static sl_status read_separate(ldtk *reader, const sli_json *path, place at) {
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
        status = read_layers(reader, &layers, at);
        sli_json_close(&file);
    }
    sl_free(reader->context, bytes.data);
    sl_free(reader->context, from);
    return status;
}

static sl_status read_level(ldtk *reader, const sli_json *level, place at) {
    const sli_json layers = sli_json_member(level, "layerInstances");
    const sli_json path = sli_json_member(level, "externalRelPath");
    const sli_json height = sli_json_member(level, "pxHei");
    int64_t pixels;
    SL_TRY(sli_json_whole(&height, 1, MOST_PIXELS, &pixels));
    const double bottom = at.y + (double)pixels;
    reader->bottom = reader->levels ? fmax(reader->bottom, bottom) : bottom;
    if (!reader->levels) {
        const char *name = sli_json_text_of(level, "identifier");
        snprintf(reader->taken, sizeof reader->taken, "%s",
                 sli_show((sli_word){name, strlen(name)}).text);
    }
    reader->levels++;
    if (!layers.value && path.value) return read_separate(reader, &path, at);
    return read_layers(reader, &layers, at);
}

/// All levels of a world, or of the project where it has but one, each in its place.
static sl_status read_world(ldtk *reader, const sli_json *world) {
    const sli_json levels = sli_json_member(world, "levels");
    const char *layout = sli_json_text_of(world, "worldLayout");
    const bool across = strcmp(layout, "LinearHorizontal") == 0;
    const bool down = strcmp(layout, "LinearVertical") == 0;
    place at = {0};
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
        SL_TRY(sli_json_whole_if(&x, -MOST_PIXELS, MOST_PIXELS, &left));
        SL_TRY(sli_json_whole_if(&y, -MOST_PIXELS, MOST_PIXELS, &top));
        SL_TRY(sli_json_whole_if(&layer, INT32_MIN, INT32_MAX, &depth));
        SL_TRY(sli_json_whole(&width, 1, MOST_PIXELS, &columns));
        SL_TRY(sli_json_whole(&height, 1, MOST_PIXELS, &rows));
        if (i == 0) reader->depth = depth;
        if (depth != reader->depth) {
            reader->other_depths++;
            continue;
        }
        if (!across && !down) at = (place){(double)left, (double)top};
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
static sl_status read_one_of(ldtk *reader, const sli_json *world, bool *found) {
    const sli_json levels = sli_json_member(world, "levels");
    const char *map = reader->options->map;
    size_t count;
    SL_TRY(sli_json_array(&levels, &count));
    for (size_t i = 0; i < count && !*found; i++) {
        const sli_json level = sli_json_item(&levels, i);
        SL_TRY(sli_json_object(&level));
        if (map && !is_named(&level, map)) continue;
        *found = true;
        SL_TRY(read_level(reader, &level, (place){0}));
        reader->other_levels += count - 1;
    }
    return SL_OK;
}

static sl_status read_project(ldtk *reader) {
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

/// What was taken, merged and left out.
static void give_account(const ldtk *reader, const sl_map *map) {
    char bottom[SL_NUMBER_TEXT];
    sl_number_write(reader->bottom, bottom);
    const sli_tally left[] = {
        {reader->other_levels, "other level", "other levels"},
        {reader->other_depths, "level at another depth", "levels at other depths"},
        {reader->other_layers, "other layer", "other layers"},
        {reader->entities, "entity", "entities"}};
    char without[SLI_TALLY_TEXT];
    sl_note(reader->context,
            "%s: level %s%s: %zu IntGrid layer%s give%s %zu walls; solid are %s%s; unit: pixels, "
            "y = %s - the file's y",
            reader->name, reader->taken, reader->levels > 1 ? " and all of its world" : "",
            reader->layers, reader->layers == 1 ? "" : "s", reader->layers == 1 ? "s" : "",
            map->wall_count, reader->by_name ? "the values whose names say so" : "all values but 0",
            sli_tally_write("; left out: ", left, 4, without), bottom);
}

static sl_status read_file(ldtk *reader, sl_map *map) {
    const sli_json levels = sli_json_member(&reader->root, "levels");
    const sli_json worlds = sli_json_member(&reader->root, "worlds");
    const char *own = sli_json_text_of(&reader->root, "identifier");
    SL_TRY(sli_json_object(&reader->root));
    if (levels.value || worlds.value)
        SL_TRY(read_project(reader));
    else if (reader->options->map && !is_named(&reader->root, reader->options->map))
        return sl_fail(reader->context, SL_BAD_ARGUMENT, "%s: the level's name is '%s'",
                       reader->name, sli_show((sli_word){own, strlen(own)}).text);
    else
        SL_TRY(read_level(reader, &reader->root, (place){0}));
    if (reader->layers == 0)
        return sli_json_fail(&reader->root, "level %s has no IntGrid layer", reader->taken);
    reader->things.top = reader->bottom;
    const sli_tiles_options options = {.top = reader->bottom,
                                       .solid_between = true,
                                       .all_closed = true,
                                       .things = &reader->things};
    SL_TRY(sli_tiles_add_walls(reader->context, &reader->tiles, reader->name, &options, map));
    strcpy(map->unit, "px");
    map->source.transform = sli_y_down(reader->bottom, 1);
    give_account(reader, map);
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
    ldtk reader = {.context = context,
                   .name = name,
                   .options = options,
                   .root = sli_json_root(&file),
                   .things = {.context = context, .file = name, .options = options}};
    const sl_status status = read_file(&reader, &read);
    sli_tiles_destroy(context, &reader.tiles);
    sli_things_destroy(&reader.things);
    sli_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
