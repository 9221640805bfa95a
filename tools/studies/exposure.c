/// Things by name.
#include "studies/exposure.h"

#include "arguments/names.h"
#include "inputs/zones.h"

#include <stdio.h>
#include <string.h>

// --- things

static sl_status add_point(sl_context *context, exposed_things *t, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(context, &t->points, 1));
    t->points.items[t->points.count++] = at;
    return SL_OK;
}

static size_t first_point(const exposed_things *t) {
    size_t first = 0;
    for (size_t i = 0, loop = 0; i < t->list.count; loop += t->list.items[i++].parts.count)
        first += t->ends.items[loop + t->list.items[i].parts.count - 1];
    return first;
}

static sl_status end_loop(sl_context *context, exposed_things *t, size_t first) {
    SL_TRY(SL_ARRAY_ROOM(context, &t->ends, 1));
    t->ends.items[t->ends.count++] = t->points.count - first;
    return SL_OK;
}

static sl_status end_thing(sl_context *context, exposed_things *t, const char *name, size_t loops,
                           bool is_area) {
    SL_TRY(SL_ARRAY_ROOM(context, &t->list, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &t->names, 1));
    char *copy = sl_copy_text(context, name, strlen(name));
    if (!copy) return SL_NO_MEMORY;
    t->names.items[t->names.count++] = copy;
    t->list.items[t->list.count++] = (sl_exposed){{.count = loops}, is_area};
    return SL_OK;
}

static sl_status add_line(sl_context *context, exposed_things *t, size_t first, sl_point a,
                          sl_point b) {
    SL_TRY(add_point(context, t, a));
    SL_TRY(add_point(context, t, b));
    return end_loop(context, t, first);
}

static sl_status add_object(sl_context *context, const sl_space *space, const sl_object *object,
                            exposed_things *t) {
    const sl_box b = object->box;
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}},
                   middle = {b.min.x + (b.max.x - b.min.x) / 2, b.min.y + (b.max.y - b.min.y) / 2};
    const bool has_area = b.min.x < b.max.x && b.min.y < b.max.y;
    const bool is_area = has_area && sl_space_is_inside(space, middle);
    const size_t first = first_point(t);
    for (int i = 0; i < (has_area ? 4 : 3); i += has_area ? 1 : 2)
        SL_TRY(add_point(context, t, corners[i]));
    if (has_area && !is_area) SL_TRY(add_point(context, t, corners[0]));
    SL_TRY(end_loop(context, t, first));
    return end_thing(context, t, object->name ? object->name : "", 1, is_area);
}

static sl_status add_door(sl_context *context, const sl_door *door, exposed_things *t) {
    SL_TRY(add_line(context, t, first_point(t), door->segment.a, door->segment.b));
    return end_thing(context, t, door->name ? door->name : "", 1, false);
}

/// The walls of a layer.
static sl_status add_layer(sl_context *context, const sl_map *map, const char *name,
                           exposed_things *t, bool *found) {
    const size_t first = first_point(t);
    size_t loops = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        const char *label = sl_map_label(map, map->walls[i].line);
        if (!label || strcmp(label, name) != 0) continue;
        SL_TRY(add_line(context, t, first, map->walls[i].a, map->walls[i].b));
        loops++;
    }
    *found |= loops > 0;
    return loops ? end_thing(context, t, name, loops, false) : SL_OK;
}

static sl_status add_named(sl_context *context, const sl_baked *baked, const char *name,
                           exposed_things *t) {
    const sl_map *map = &baked->map;
    bool found = false;
    for (size_t i = 0; i < map->object_count; i++) {
        const char *own = map->objects[i].name;
        if (strcmp(name, "objects") != 0 && !(own && strcmp(own, name) == 0)) continue;
        SL_TRY(add_object(context, &baked->space, &map->objects[i], t));
        found = true;
    }
    for (size_t i = 0; i < map->door_count; i++) {
        const char *own = map->doors[i].name;
        if (strcmp(name, "doors") != 0 && !(own && strcmp(own, name) == 0)) continue;
        SL_TRY(add_door(context, &map->doors[i], t));
        found = true;
    }
    SL_TRY(add_layer(context, map, name, t, &found));
    if (found) return SL_OK;
    const name_table objects = {"object", map->objects, sizeof *map->objects, map->object_count,
                                NULL},
                     doors = {"door", map->doors, sizeof *map->doors, map->door_count, NULL};
    char object_names[NAME_LIST], door_names[NAME_LIST];
    name_list(&objects, object_names);
    name_list(&doors, door_names);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--see: '%s' is no file, object, door or layer of the map; its objects: %s; its "
                   "doors: %s",
                   name, object_names, door_names);
}

static sl_status add_names(sl_context *context, const char *text, const sl_baked *baked,
                           exposed_things *t) {
    for (const char *at = text; *at;) {
        const size_t length = strcspn(at, ",");
        char *name = sl_copy_text(context, at, length);
        if (!name) return SL_NO_MEMORY;
        const sl_status status = add_named(context, baked, name, t);
        sl_free(context, name);
        SL_TRY(status);
        at += length + (at[length] == ',');
    }
    return SL_OK;
}

static sl_status add_zones(sl_context *context, const char *text, const input_options *input,
                           const sl_map *map, exposed_things *t) {
    zone_list zones = {0};
    SL_TRY(zones_read(context, "see", text, input, map, &zones));
    sl_status status = SL_OK;
    for (size_t z = 0; z < zones.ends.count && status == SL_OK; z++) {
        size_t end;
        const sl_shape zone = zones_shape_of(&zones, z, &end);
        const size_t first = first_point(t);
        for (size_t i = 0; i < end && status == SL_OK; i++)
            status = add_point(context, t, zone.points[i]);
        if (status == SL_OK) status = end_loop(context, t, first);
        if (status == SL_OK) status = end_thing(context, t, zones.names.items[z], 1, true);
    }
    zones_destroy(context, &zones);
    return status;
}

sl_status exposure_make(sl_context *context, const char *text, const input_options *input,
                        const sl_baked *baked, sl_query *query, const sl_point *path, size_t count,
                        exposed_things *out) {
    if (name_ends_with(text, ".csv") || sl_path_look(text) == SL_PATH_FILE)
        SL_TRY(add_zones(context, text, input, &baked->map, out));
    else
        SL_TRY(add_names(context, text, baked, out));
    const size_t things = out->list.count;
    for (size_t i = 0, point = 0, loop = 0; i < things; i++) {
        sl_shape *const parts = &out->list.items[i].parts;
        parts->points = out->points.items + point;
        parts->ends = out->ends.items + loop;
        loop += parts->count;
        point += parts->ends[parts->count - 1];
    }
    out->exposures = sl_alloc_array(context, things + 1, sizeof *out->exposures);
    if (!out->exposures) return SL_NO_MEMORY;
    return sl_exposure_make(context, query, path, count, out->list.items, things, out->exposures);
}

void exposure_destroy(sl_context *context, exposed_things *t) {
    for (size_t i = 0; i < t->list.count; i++) {
        if (t->exposures) sl_exposure_destroy(context, &t->exposures[i]);
        sl_free(context, t->names.items[i]);
    }
    sl_free(context, t->exposures);
    sl_free(context, t->names.items);
    sl_free(context, t->list.items);
    sl_free(context, t->ends.items);
    sl_free(context, t->points.items);
    *t = (exposed_things){0};
}

// --- the table

static void put_row(FILE *to, const exposed_things *t, size_t i) {
    const sl_exposure *e = &t->exposures[i];
    const double row[6] = {
        e->size,       e->seen,        e->size > 0 ? e->seen / e->size : 0,
        e->some.total, e->whole.total, e->some.count ? e->some.parts[0].from : 0};
    sl_table_text_write(to, t->names.items[i], true);
    fprintf(to, ",%s", t->list.items[i].is_area ? "area" : "lines");
    for (int k = 0; k < 6; k++) {
        char text[SL_NUMBER_TEXT];
        sl_number_write(row[k], text);
        fprintf(to, ",%s", k == 5 && !e->some.count ? "" : text);
    }
    putc('\n', to);
}

sl_status exposure_write(sl_context *context, const exposed_things *t, const char *path) {
    sl_output output;
    SL_TRY(sl_output_open(context, path, &output));
    fputs("name,kind,size,seen,share,path_sees_some,path_sees_all,first_seen_at\n", output.stream);
    for (size_t i = 0; i < t->list.count; i++) put_row(output.stream, t, i);
    return sl_output_close(context, &output, SL_OK);
}

void exposure_say(const exposed_things *t, char *text, size_t size) {
    size_t seen = 0;
    for (size_t i = 0; i < t->list.count; i++) seen += t->exposures[i].some.count > 0;
    snprintf(text, size, "%zu of %zu thing%s seen", seen, t->list.count,
             t->list.count == 1 ? " is" : "s are");
}
