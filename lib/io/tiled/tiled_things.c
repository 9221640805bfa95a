/// Starts and doors of Tiled's maps: what objects and tiles say of themselves, where objects lie,
/// and instances of templates.
///
/// A template is an object in a file of its own. An instance has all that the template has, but
/// for what it says otherwise. Each file is read once.
#include "io/tiled/tiled.h"

#include "io/parts/names.h"
#include "map/scan.h"

#include <string.h>

// --- what things say

sli_says sli_tiled_says_of(const sli_json *thing, const char *class_key) {
    const char *class = sli_json_text_of(thing, class_key);
    sli_says says = sli_says_of(sli_json_text_of(thing, "name"),
                                *class ? class : sli_json_text_of(thing, "class"));
    sli_tiled_properties at = sli_tiled_properties_of(thing);
    const char *name;
    for (sli_json value; sli_tiled_next_property(&at, &name, &value);) {
        bool said;
        const bool yes = sli_json_true(&value, &said);
        const char *text = json_string_value(value.value);
        if (name && said) sli_says_add(&says, name, yes);
        if (name && !said && text) sli_says_add_text(&says, name, text);
    }
    return says;
}

// --- templates

struct sli_tiled_template {
    char *source, *path;
    sli_json_file file;
    json_t *object; ///< NULL where the file cannot be read
};

static sl_status read_template(sl_context *context, const char *map, sli_tiled_template *out) {
    sl_bytes bytes;
    const sl_status found = sli_beside_read(context, map, out->source, &out->path, &bytes);
    if (found == SL_BAD_INPUT) {
        sl_note(context, "%s: its template '%s' cannot be read", map,
                sli_show((sli_word){out->source, strlen(out->source)}).text);
        return SL_OK;
    }
    SL_TRY(found);
    const sl_status status =
        sli_tiled_looks_like_xml(&bytes)
            ? sli_tiled_from_xml(context, out->path, "template", bytes.data, bytes.size, &out->file)
            : sli_json_open(context, out->path, bytes.data, bytes.size, &out->file);
    sl_free(context, bytes.data);
    SL_TRY(status);
    const sli_json root = sli_json_root(&out->file), list = sli_json_member(&root, "objects");
    const sli_json first = sli_json_item(&list, 0), own = sli_json_member(&root, "object");
    out->object = own.value ? own.value : first.value;
    return SL_OK;
}

static sl_status find_template(sli_tiled_templates *templates, const sli_json *from,
                               const char *source, const sli_tiled_template **out) {
    sl_context *context = from->file->context;
    for (size_t i = 0; i < templates->count; i++) {
        if (strcmp(templates->items[i].source, source) != 0) continue;
        *out = &templates->items[i];
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, templates, 1));
    sli_tiled_template *own = &templates->items[templates->count];
    *own = (sli_tiled_template){.source = sl_copy_text(context, source, strlen(source))};
    if (!own->source) return SL_NO_MEMORY;
    templates->count++;
    SL_TRY(read_template(context, from->file->name, own));
    *out = own;
    return SL_OK;
}

void sli_tiled_destroy_templates(sl_context *context, sli_tiled_templates *templates) {
    for (size_t i = 0; i < templates->count; i++) {
        sli_json_close(&templates->items[i].file);
        sl_free(context, templates->items[i].source);
        sl_free(context, templates->items[i].path);
    }
    sl_free(context, templates->items);
    *templates = (sli_tiled_templates){0};
}

static bool has_property(const json_t *list, const json_t *property) {
    const json_t *name = json_object_get(property, "name");
    for (size_t i = 0; name && i < json_array_size(list); i++)
        if (json_equal(json_object_get(json_array_get(list, i), "name"), name)) return true;
    return false;
}

/// Adds the properties of the template that the instance does not have.
static bool add_properties(json_t *object, const json_t *of_template) {
    const json_t *own = json_object_get(object, "properties");
    if (!json_is_array(own) || own == of_template) return true;
    json_t *all = json_copy((json_t *)(uintptr_t)own);
    bool good = all != NULL;
    for (size_t i = 0; good && i < json_array_size(of_template); i++) {
        json_t *item = json_array_get(of_template, i);
        if (!has_property(own, item)) good = json_array_append(all, item) == 0;
    }
    if (good) return json_object_set_new(object, "properties", all) == 0;
    json_decref(all);
    return false;
}

/// The number that a template's tile has in the map; the largest one, which is of no set, where the
/// map does not have its set. The template names one set, by a path from its own folder.
static json_int_t gid_in_map(const sli_json_file *file, const json_t *object,
                             const sli_tiled_sets *sets) {
    const sli_json root = sli_json_root(file), of = sli_json_member(&root, "tileset");
    const sli_json list = sli_json_member(&root, "tilesets"), first = sli_json_item(&list, 0);
    const sli_json *own = of.value ? &of : &first;
    const sli_json begin = sli_json_member(own, "firstgid");
    const sli_json gid = {.file = file, .value = json_object_get(object, "gid")};
    const char *name = sl_path_name(sli_json_text_of(own, "source"));
    const double number = sli_json_number_or_0(&gid), from = sli_json_number_or_0(&begin);
    for (size_t i = 0; i < sets->sets.count; i++) {
        const sli_tiled_set *set = &sets->sets.items[i];
        if (!set->source || strcmp(sl_path_name(set->source), name) != 0) continue;
        const uint32_t turned = (uint32_t)number & ~SLI_TILED_TILE;
        const uint32_t tile = (uint32_t)number & SLI_TILED_TILE;
        if (from >= 1 && tile >= from)
            return (json_int_t)(turned | (tile - (uint32_t)from + set->first));
    }
    return SLI_TILED_TILE;
}

sl_status sli_tiled_instance(sli_tiled_templates *templates, const sli_tiled_sets *sets,
                             const sli_json *object, sli_json_file *file) {
    const char *source = sli_json_text_of(object, "template");
    const sli_tiled_template *of = NULL;
    json_t *from = NULL;
    *file = (sli_json_file){
        .context = object->file->context, .name = object->file->name, .numbers_as_text = true};
    if (!*source) return SL_OK;
    SL_TRY(find_template(templates, object, source, &of));
    from = of->object;
    file->root = json_is_object(from) ? json_copy(from) : json_object();
    if (!file->root || json_object_update(file->root, object->value) != 0 ||
        !add_properties(file->root, json_object_get(from, "properties")))
        return sl_fail_memory(object->file->context);
    // Without its template nobody knows what it is.
    if (from) json_object_del(file->root, "template");
    const bool of_template = json_object_get(from, "gid") && !json_object_get(object->value, "gid");
    if (of_template && json_object_set_new(file->root, "gid",
                                           json_integer(gid_in_map(&of->file, from, sets))) != 0)
        return sl_fail_memory(object->file->context);
    return SL_OK;
}

// --- objects

/// Puts a box from the object's place on: its middle and its half sides.
static void set_box(sli_thing *thing, const sli_tiled_shape *shape, sli_affine place, double top) {
    sli_affine turn = shape->turn;
    turn.x0 = shape->x;
    turn.y0 = shape->y;
    turn = sli_affine_after(place, turn);
    const sl_point middle = {shape->width / 2, top + shape->height / 2};
    thing->middle = sli_affine_apply(turn, middle);
    thing->u = (sl_point){turn.xx * shape->width / 2, turn.yx * shape->width / 2};
    thing->v = (sl_point){turn.xy * shape->height / 2, turn.yy * shape->height / 2};
}

static sl_status add_lines(sli_things *things, const char *name, sli_thing thing,
                           const sl_map *drawn) {
    thing.is_line = true;
    for (size_t i = 0; i < drawn->wall_count; i++) {
        const sl_wall *line = &drawn->walls[i];
        thing.middle = (sl_point){(line->a.x + line->b.x) / 2, (line->a.y + line->b.y) / 2};
        thing.u = (sl_point){(line->b.x - line->a.x) / 2, (line->b.y - line->a.y) / 2};
        thing.goes_on = i > 0;
        SL_TRY(sli_things_add(things, name, thing));
    }
    return SL_OK;
}

/// A polygon, or a start that is drawn by points, is the box about it.
static sl_status add_drawn(sli_things *things, const sli_tiled_shape *shape, const char *name,
                           sli_thing thing, const sl_map *drawn) {
    if (thing.kind == SLI_THING_DOOR && shape->kind == SLI_TILED_POLYLINE)
        return add_lines(things, name, thing, drawn);
    const sl_box box = sl_map_bounds(drawn);
    thing.u = (sl_point){(box.max.x - box.min.x) / 2, 0};
    thing.v = (sl_point){0, (box.max.y - box.min.y) / 2};
    thing.middle = (sl_point){box.min.x + thing.u.x, box.min.y + thing.v.y};
    return sli_things_add(things, name, thing);
}

sl_status sli_tiled_take_thing(sli_things *things, const sli_says *says,
                               const sli_tiled_shape *shape, sli_affine place, bool is_wall) {
    sli_thing thing = {.kind = says->kind,
                       .open = says->state != SLI_DOOR_SHUT,
                       .is_wall = is_wall,
                       .heading = sli_heading_of(shape->rotation),
                       .line = shape->line};
    if (shape->kind != SLI_TILED_POLYGON && shape->kind != SLI_TILED_POLYLINE) {
        set_box(&thing, shape, place, shape->kind == SLI_TILED_PICTURE ? -shape->height : 0);
        return sli_things_add(things, says->name, thing);
    }
    sl_map drawn = {0};
    sli_pen pen = {
        .context = things->context, .name = things->file, .map = &drawn, .affine = place};
    sl_status status = sli_tiled_draw_shape(&pen, shape);
    if (status == SL_OK) status = add_drawn(things, shape, says->name, thing, &drawn);
    sl_map_destroy(things->context, &drawn);
    return status;
}
