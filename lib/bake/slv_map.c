/// The things of a map (doors, starts, objects, paths, mirrors) as items of a baked file, so that a
/// game reads no map text. Both the writer and the reader of the library make them from the map:
/// the one to write them, the other to compare. Coordinates too small to be used are 0, as in the
/// map text that is read.
#include "bake/slv.h"
#include "geometry/orient.h"

#include <math.h>
#include <string.h>

/// Where names go.
typedef struct names {
    char *bytes; ///< NULL: they are only counted
    size_t count;
} names;

static sli_slv_name add_name(names *to, const char *name) {
    const size_t length = strlen(name);
    const sli_slv_name at = {(uint32_t)to->count, (uint32_t)length};
    if (to->bytes) memcpy(to->bytes + to->count, name, length);
    to->count += length;
    return at;
}

static size_t count_names(const sl_map *map) {
    names to = {0};
    for (size_t i = 0; i < map->door_count; i++) add_name(&to, map->doors[i].name);
    for (size_t i = 0; i < map->object_count; i++) add_name(&to, map->objects[i].name);
    for (size_t i = 0; i < map->path_count; i++) add_name(&to, map->paths[i].name);
    return to.count;
}

static size_t count_points(const sl_map *map) {
    size_t count = 0;
    for (size_t i = 0; i < map->path_count; i++) count += map->paths[i].count;
    return count;
}

enum { NAMES, DOORS, STARTS, OBJECTS, PATHS, POINTS, MIRRORS };

static void fill_paths(const sl_map *map, names *to, sli_slv_path *paths, sl_point *points) {
    uint32_t count = 0;
    for (size_t i = 0; i < map->path_count; i++) {
        const sl_path *path = &map->paths[i];
        paths[i] = (sli_slv_path){add_name(to, path->name), count, (uint32_t)path->count};
        for (size_t k = 0; k < path->count; k++) points[count++] = sli_coordinates(path->points[k]);
    }
}

static uint32_t door_state(const sl_door *door) {
    return (door->open ? SLI_SLV_DOOR_OPEN : 0) |
           (door->kind == SL_DOOR_BREAKABLE ? SLI_SLV_DOOR_BREAKABLE : 0) |
           (door->kind == SL_DOOR_SITE ? SLI_SLV_DOOR_SITE : 0);
}

static void fill(const sl_map *map, sli_slv_part_of_map *parts) {
    names to = {.bytes = parts[NAMES].items};
    sli_slv_door *doors = parts[DOORS].items;
    sli_slv_start *starts = parts[STARTS].items;
    sli_slv_object *objects = parts[OBJECTS].items;
    sli_slv_mirror *mirrors = parts[MIRRORS].items;
    for (size_t i = 0; i < map->door_count; i++)
        doors[i] = (sli_slv_door){add_name(&to, map->doors[i].name), door_state(&map->doors[i])};
    for (size_t i = 0; i < map->start_count; i++) {
        const sl_point at = sli_coordinates(map->starts[i].at);
        starts[i] = (sli_slv_start){at.x, at.y, map->starts[i].heading};
    }
    for (size_t i = 0; i < map->object_count; i++) {
        const sl_box box = map->objects[i].box;
        objects[i] = (sli_slv_object){add_name(&to, map->objects[i].name),
                                      {sli_coordinates(box.min), sli_coordinates(box.max)}};
    }
    fill_paths(map, &to, parts[PATHS].items, parts[POINTS].items);
    for (size_t i = 0; i < map->mirror_count; i++) {
        const sl_segment s = map->mirrors[i].segment;
        mirrors[i] = (sli_slv_mirror){{sli_coordinates(s.a), sli_coordinates(s.b)},
                                      map->mirrors[i].one_sided};
    }
}

sl_status sli_slv_things_make(sl_context *context, const sl_map *map, sli_slv_things *out) {
    const sl_transform *t = &map->source.transform;
    *out = (sli_slv_things){
        .info = {map->range, t->origin.x, t->origin.y, t->scale, t->y_down},
        .parts = {[NAMES] = {"MAPN", 1, count_names(map), NULL},
                  [DOORS] = {"DOOR", sizeof(sli_slv_door), map->door_count, NULL},
                  [STARTS] = {"STRT", sizeof(sli_slv_start), map->start_count, NULL},
                  [OBJECTS] = {"OBJE", sizeof(sli_slv_object), map->object_count, NULL},
                  [PATHS] = {"PATH", sizeof(sli_slv_path), map->path_count, NULL},
                  [POINTS] = {"PAPO", sizeof(sl_point), count_points(map), NULL},
                  [MIRRORS] = {"MIRR", sizeof(sli_slv_mirror), map->mirror_count, NULL}}};
    sl_transform same;
    if (!sli_slv_transform(&out->info, &same))
        return sl_fail(context, SL_UNSUPPORTED,
                       "a baked file has no room for the map's transform: origin %g, %g, scale %g",
                       t->origin.x, t->origin.y, t->scale);
    for (size_t i = 0; i < SLI_SLV_MAP_PARTS; i++) {
        sli_slv_part_of_map *part = &out->parts[i];
        if (part->count > INT32_MAX)
            return sl_fail(context, SL_UNSUPPORTED, "a baked file has no room for %llu items of %s",
                           (unsigned long long)part->count, part->tag);
        part->items = sl_alloc_array(context, (size_t)part->count, part->item_bytes);
        if (!part->items) return SL_NO_MEMORY;
    }
    fill(map, out->parts);
    return SL_OK;
}

void sli_slv_things_destroy(sl_context *context, sli_slv_things *things) {
    for (size_t i = 0; i < SLI_SLV_MAP_PARTS; i++) sl_free(context, things->parts[i].items);
    *things = (sli_slv_things){0};
}

sl_status sli_slv_things_check_again(sl_context *context, const char *name, const sl_map *written,
                                     const sl_map *again) {
    sli_slv_things one = {0}, other = {0};
    sl_status status = sli_slv_things_make(context, written, &one);
    if (status == SL_OK) status = sli_slv_things_make(context, again, &other);
    for (size_t i = 0; i < SLI_SLV_MAP_PARTS && status == SL_OK; i++) {
        const sli_slv_part_of_map *a = &one.parts[i], *b = &other.parts[i];
        if (a->count != b->count ||
            memcmp(a->items, b->items, (size_t)a->count * a->item_bytes) != 0)
            status = sl_fail_at(context, name, 0, "section %s is not that of the map", a->tag);
    }
    sli_slv_things_destroy(context, &one);
    sli_slv_things_destroy(context, &other);
    return status;
}

bool sli_slv_transform(const sli_slv_map_info *info, sl_transform *out) {
    *out = (sl_transform){{info->origin_x, info->origin_y}, info->scale, info->y_down != 0};
    return info->y_down <= 1 && fabs(info->origin_x) <= 2 * SL_COORDINATE_MAX &&
           fabs(info->origin_y) <= 2 * SL_COORDINATE_MAX &&
           (info->scale == 0 ||
            (info->scale >= SL_COORDINATE_MIN && info->scale <= SL_COORDINATE_MAX));
}
