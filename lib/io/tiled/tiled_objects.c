/// Objects of Tiled's maps: starts, doors and walls, by what they say and what their layer is; and
/// the layers of our own files, which say what they hold.
#include "io/tiled/tiled.h"

#include "io/io_formats.h"
#include "io/parts/layers.h"
#include "map/source.h"

sl_status sli_tiled_read_stops(const sli_json *thing, uint32_t *stops) {
    sli_tiled_properties at = sli_tiled_properties_of(thing);
    const char *name;
    for (sli_json value; sli_tiled_next_property(&at, &name, &value);) {
        const char *text = json_string_value(value.value);
        if (!text || !name || strcmp(name, "stops") != 0) continue;
        if (!sl_stops_read(text, strlen(text), stops))
            return sli_json_fail(&value, "stops: expected sight or limited, steps, sound or "
                                         "several joined by commas");
    }
    return SL_OK;
}

sl_status sli_tiled_name_shape(sli_tiled_reader *reader, const char *label) {
    reader->pen.map->source.lines_are_items = true;
    return sli_map_add_label(reader->context, reader->pen.map, ++reader->pen.item, label);
}

/// "layer Walls, object 12 'crate', line 40"
static sl_status name_object(sli_tiled_reader *reader, const sli_json *layer,
                             const sli_json *object, const sli_tiled_shape *shape) {
    const char *const names[] = {sli_json_text_of(layer, "name"), sli_json_text_of(object, "name")};
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
    return sli_tiled_name_shape(reader, label);
}

static sli_tiled_word word_of_object(const sli_tiled_reader *reader, const sli_json *object,
                                     const sli_tiled_shape *shape) {
    const sli_tiled_word word = sli_tiled_word_of(object, "type");
    if (word != SLI_TILED_UNSAID) return word;
    if (sli_says_solid(sli_json_text_of(object, "name"))) return SLI_TILED_SOLID;
    const uint32_t gid = shape->gid & SLI_TILED_TILE;
    const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
    return set ? sli_tiled_word_of_tile(set, sli_tiled_find_tile(set, gid)) : SLI_TILED_UNSAID;
}

/// Reads an object. In an isometric map it lies in the plan, but turns on the screen. A tile as an
/// object stands upright there: on the diamond as wide as itself whose lowest corner is its place.
static sl_status read_shape(const sli_tiled_reader *reader, const sli_json *object,
                            sli_tiled_shape *shape) {
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
static sli_affine affine_of_layer(const sli_tiled_reader *reader, const sli_tiled_place *at) {
    const sli_affine move = {.xx = 1, .yy = 1, .x0 = at->offset.x, .y0 = at->offset.y};
    if (reader->lattice.orientation != SLI_TILED_ISOMETRIC)
        return sli_affine_after(reader->to_plan, move);
    sli_affine to_plan = reader->to_plan;
    to_plan.x0 = to_plan.y0 = 0;
    const sl_point offset = sli_affine_apply(to_plan, at->offset);
    return (sli_affine){.xx = 1, .yy = 1, .x0 = offset.x, .y0 = offset.y};
}

/// An object of a start or a door: `*taken` where it is one.
static sl_status take_thing(sli_tiled_reader *reader, const sli_json *object,
                            const sli_tiled_place *at, bool *taken) {
    sli_tiled_shape shape;
    SL_TRY(read_shape(reader, object, &shape));
    const char *class = sli_json_text_of(object, "type");
    const uint32_t gid = shape.gid & SLI_TILED_TILE;
    const sli_tiled_set *set = gid ? sli_tiled_find_set(&reader->sets, gid) : NULL;
    const sli_tiled_tile *tile = set ? sli_tiled_find_tile(set, gid) : NULL;
    const char *name = sli_tiled_name_of(object);
    sli_says says = sli_tiled_says_of(object, "type");
    if (!says.kind && !*sli_json_text_of(object, "name")) says = sli_says_of(name, NULL);
    if (!says.kind && tile) says = tile->says;
    SL_TRY(sli_things_ask(&reader->things, name, *class ? class : sli_json_text_of(object, "class"),
                          &says));
    const bool asked = reader->options->start_names != NULL;
    if (says.kind == SLI_THING_START && at->others && !asked) says = (sli_says){0};
    *taken = says.kind != SLI_THING_NONE;
    if (!*taken || reader->by) return SL_OK; // the first reading took it
    if (set && shape.width == 0 && shape.height == 0) {
        shape.width = set->width;
        shape.height = set->height;
    }
    return sli_tiled_take_thing(&reader->things, &says, &shape, affine_of_layer(reader, at),
                                at->word == SLI_TILED_SOLID && shape.kind != SLI_TILED_OTHER);
}

// --- layers that say what they hold

/// Reads an object of such a layer.
static sl_status read_item(sli_tiled_reader *reader, const sli_json *layer, const sli_json *object,
                           const sli_tiled_place *at, sli_layer_item item) {
    sl_map drawn = {0}, *map = reader->pen.map;
    sli_tiled_shape shape;
    SL_TRY(read_shape(reader, object, &shape));
    SL_TRY(name_object(reader, layer, object, &shape));
    const sli_affine outer = reader->pen.affine;
    const sli_affine place = sli_affine_after(outer, affine_of_layer(reader, at));
    const sl_point start = sli_affine_apply(place, (sl_point){shape.x, shape.y});
    const char *name = sli_json_text_of(object, "name");
    if (item.layer == SLI_LAYER_DOOR)
        item.open = sli_tiled_says_of(object, "type").state != SLI_DOOR_SHUT;
    item.name = *name ? name : NULL;
    item.heading = -shape.rotation + 0.0;
    item.points = &start;
    item.count = 1;
    reader->pen.map = &drawn;
    reader->pen.affine = place;
    const sl_status drawing = sli_tiled_draw_shape(&reader->pen, &shape);
    reader->pen.map = map;
    reader->pen.affine = outer;
    const sl_status status = drawing == SL_OK
                                 ? sli_layer_take(reader->context, reader->map->file->name, map,
                                                  &item, &drawn, reader->pen.item)
                                 : drawing;
    sl_map_destroy(reader->context, &drawn);
    reader->objects += item.layer >= SLI_LAYER_WALL && item.layer <= SLI_LAYER_WALL_SOLID;
    return status;
}

sli_layer sli_tiled_kind_of_layer(const sli_tiled_reader *reader, const sli_json *layer) {
    const char *name = sli_json_text_of(layer, "name");
    const sli_layer kind = reader->lattice.orientation == SLI_TILED_ORTHOGONAL
                               ? sli_layer_of((sli_word){name, strlen(name)}, NULL)
                               : SLI_LAYER_NONE;
    return kind == SLI_LAYER_START && reader->options->start_names ? SLI_LAYER_NONE : kind;
}

/// Reads the objects of such a layer. Doors and starts are taken whatever --layers says.
static sl_status read_items(sli_tiled_reader *reader, const sli_json *layer,
                            const sli_tiled_place *at, sli_layer kind) {
    const sli_json objects = sli_json_member(layer, "objects");
    size_t count = 0;
    if (objects.value) SL_TRY(sli_json_array(&objects, &count));
    if (reader->options->layers && !at->asked && kind != SLI_LAYER_DOOR && kind != SLI_LAYER_START)
        return SL_OK;
    for (size_t i = 0; i < count; i++) {
        const sli_json object = sli_json_item(&objects, i);
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(read_item(reader, layer, &object, at, (sli_layer_item){.layer = kind}));
    }
    return SL_OK;
}

/// Draws an object that is solid.
static sl_status draw_object(sli_tiled_reader *reader, const sli_json *layer,
                             const sli_json *object, const sli_tiled_shape *shape,
                             const sli_tiled_place *at, uint32_t stops) {
    const sli_affine outer = reader->pen.affine;
    SL_TRY(name_object(reader, layer, object, shape));
    reader->pen.affine = sli_affine_after(outer, affine_of_layer(reader, at));
    const size_t first = reader->pen.map->wall_count;
    sl_status status = sli_tiled_draw_shape(&reader->pen, shape);
    if (status == SL_OK && stops)
        status = sl_map_walls_stop(reader->context, reader->pen.map, first, stops);
    else if (status == SL_OK)
        status = sli_tiled_add_closed(reader, shape->kind, first, false);
    reader->pen.affine = outer;
    return status;
}

/// An object, with all that its template says: a start, a door, or a wall where it is solid.
static sl_status read_object(sli_tiled_reader *reader, const sli_json *layer,
                             const sli_json *object, const sli_tiled_place *at) {
    sli_tiled_shape shape;
    bool is_thing;
    SL_TRY(read_shape(reader, object, &shape));
    SL_TRY(take_thing(reader, object, at, &is_thing));
    if (is_thing || at->word == SLI_TILED_OPEN) return SL_OK;
    if (reader->by == SLI_TILED_BY_BARE) {
        if (!reader->bare || !sli_tiled_is_bare(object, &shape)) return SL_OK;
        reader->other_objects--;
        reader->objects++;
        return draw_object(reader, layer, object, &shape, at, at->stops);
    }
    const sli_tiled_word own = word_of_object(reader, object, &shape);
    // An enemy or a trigger among walls is none, unless it says so.
    const bool other = own == SLI_TILED_UNSAID && !at->asked &&
                       (sli_game_says_passing(sli_tiled_name_of(object)) ||
                        sli_game_says_passing(sli_json_text_of(object, "type")));
    const sli_tiled_word word = other ? SLI_TILED_OPEN : own;
    uint32_t stops = at->stops;
    SL_TRY(sli_tiled_read_stops(object, &stops));
    const bool taken =
        at->word == SLI_TILED_SOLID || stops ? word != SLI_TILED_OPEN : word == SLI_TILED_SOLID;
    size_t *counted = !taken                          ? &reader->other_objects
                      : shape.kind == SLI_TILED_OTHER ? &reader->other_shapes
                                                      : &reader->objects;
    ++*counted;
    if (counted == &reader->other_objects) {
        const char *name = sli_tiled_name_of(object);
        sli_things_leave(&reader->things, *name ? name : sli_json_text_of(object, "class"));
    }
    if (!taken && word == SLI_TILED_UNSAID && !at->others)
        return sli_tiled_draw_picture(reader, object, &shape, affine_of_layer(reader, at));
    if (counted != &reader->objects) return SL_OK;
    return draw_object(reader, layer, object, &shape, at, stops);
}

sl_status sli_tiled_read_objects(sli_tiled_reader *reader, const sli_json *layer,
                                 const sli_tiled_place *at) {
    const sli_json objects = sli_json_member(layer, "objects");
    const sli_layer kind = sli_tiled_kind_of_layer(reader, layer);
    size_t count = 0;
    if (objects.value) SL_TRY(sli_json_array(&objects, &count));
    if (!reader->by) reader->seen.items[reader->at_layer].count = count;
    if (kind) return reader->by ? SL_OK : read_items(reader, layer, at, kind);
    reader->bare = reader->by == SLI_TILED_BY_BARE && sli_tiled_has_bare(layer);
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < count; i++) {
        const sli_json object = sli_json_item(&objects, i);
        sli_json_file file;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        status = sli_tiled_instance(&reader->templates, &reader->sets, &object, &file);
        const sli_json whole = sli_json_root(&file);
        if (status == SL_OK) status = read_object(reader, layer, file.root ? &whole : &object, at);
        sli_json_close(&file);
    }
    return status;
}
