/// Lines of a plan: doors, paths.
#include "inputs/see_lines.h"

#include "inputs/path_points.h"

#include <stdio.h>
#include <string.h>

/// How far the sides of a shut door are from it, as a share of its width.
#define BESIDE 0x1p-20

static sl_status add_segment(sl_context *context, see_lines *lines, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(context, &lines->segments, 1));
    lines->segments.items[lines->segments.count++] = (sl_segment){a, b};
    return SL_OK;
}

static sl_status end_thing(sl_context *context, see_lines *lines, const char *name, size_t length) {
    SL_TRY(SL_ARRAY_ROOM(context, &lines->ends, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &lines->names, 1));
    char *copy = sl_copy_text(context, name, length);
    if (!copy) return SL_NO_MEMORY;
    lines->names.items[lines->names.count++] = copy;
    lines->ends.items[lines->ends.count++] = lines->segments.count;
    return SL_OK;
}

static sl_status add_points(sl_context *context, see_lines *lines, const sl_point *points,
                            size_t count) {
    for (size_t i = 0; i + 1 < count; i++)
        SL_TRY(add_segment(context, lines, points[i], points[i + 1]));
    return SL_OK;
}

/// An open door itself; of a shut one the sides that are inside.
static sl_status add_door(sl_context *context, see_lines *lines, const sl_door *door,
                          const sl_space *space) {
    const sl_point a = door->segment.a, b = door->segment.b;
    const size_t before = lines->segments.count;
    for (int side = -1; side <= 1 && !door->open; side += 2) {
        const sl_point off = {-side * BESIDE * (b.y - a.y), side * BESIDE * (b.x - a.x)};
        const sl_point p = {a.x + off.x, a.y + off.y}, q = {b.x + off.x, b.y + off.y};
        if (sl_space_is_inside(space, (sl_point){p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2}))
            SL_TRY(add_segment(context, lines, p, q));
    }
    return lines->segments.count > before ? SL_OK : add_segment(context, lines, a, b);
}

static bool is_named(const char *name, const char *text, size_t length) {
    return name && strlen(name) == length && strncmp(name, text, length) == 0;
}

/// Adds a name, and a comma before it, to a list that fills `size`.
static void list_name(char *text, size_t size, const char *name) {
    const size_t used = strlen(text);
    if (name && used + 40 < size)
        snprintf(text + used, size - used, "%s%.32s", used ? ", " : "", name);
}

static sl_status refuse_name(sl_context *context, const char *name, size_t length,
                             const sl_map *map) {
    char known[512] = "";
    for (size_t i = 0; i < map->object_count; i++)
        list_name(known, sizeof known, map->objects[i].name);
    for (size_t i = 0; i < map->door_count; i++)
        if (!i || !map->doors[i].name || !map->doors[i - 1].name ||
            strcmp(map->doors[i].name, map->doors[i - 1].name) != 0)
            list_name(known, sizeof known, map->doors[i].name);
    for (size_t i = 0; i < map->path_count; i++) list_name(known, sizeof known, map->paths[i].name);
    if (*known)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--see: '%.*s' is no file, and no object, door or path of the map; it has: "
                       "%s",
                       (int)length, name, known);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--see: there is no file '%.*s', and the map has no objects, doors and paths: "
                   "give a drawing of outlines, or a table with the columns name,x,y",
                   (int)length, name);
}

static bool has_object(const sl_map *map, const char *name, size_t length) {
    for (size_t i = 0; i < map->object_count; i++)
        if (is_named(map->objects[i].name ? map->objects[i].name : "", name, length)) return true;
    return false;
}

/// All doors and paths of a name.
static sl_status take_name(sl_context *context, const char *name, size_t length,
                           const sl_baked *baked, see_lines *out) {
    const sl_map *map = &baked->map;
    const size_t before = out->segments.count;
    for (size_t i = 0; i < map->door_count; i++)
        if (is_named(map->doors[i].name, name, length))
            SL_TRY(add_door(context, out, &map->doors[i], &baked->space));
    for (size_t i = 0; i < map->path_count; i++)
        if (is_named(map->paths[i].name, name, length))
            SL_TRY(add_points(context, out, map->paths[i].points, map->paths[i].count));
    return out->segments.count > before ? end_thing(context, out, name, length)
                                        : refuse_name(context, name, length, map);
}

sl_status see_lines_take(sl_context *context, const char *text, const sl_baked *baked,
                         see_lines *out, char **rest) {
    char *to = *rest = sl_copy_text(context, text, strlen(text));
    if (!to) return SL_NO_MEMORY;
    for (const char *at = text; *at;) {
        const size_t length = strcspn(at, ",");
        const bool object = has_object(&baked->map, at, length);
        if (!object) SL_TRY(take_name(context, at, length, baked, out));
        if (object && to > *rest) *to++ = ',';
        for (size_t i = 0; object && i < length; i++) *to++ = at[i];
        at += length + (at[length] == ',');
    }
    *to = 0;
    return SL_OK;
}

sl_status see_lines_add_path(sl_context *context, const char *name, const sl_map *map,
                             see_lines *out) {
    sl_point *points = NULL;
    size_t count = 0;
    sl_status status = path_points_read(context, "path", name, map, &points, &count);
    if (status == SL_OK && count < 2)
        status = sl_fail(context, SL_BAD_INPUT, "--path %s: a path needs 2 points, not %zu", name,
                         count);
    if (status == SL_OK) status = add_points(context, out, points, count);
    if (status == SL_OK) status = end_thing(context, out, name, strlen(name));
    sl_free(context, points);
    return status;
}

size_t see_lines_of(const see_lines *lines, size_t segment) {
    size_t thing = 0;
    while (lines->ends.items[thing] <= segment) thing++;
    return thing;
}

sl_status see_lines_check(sl_context *context, const sl_baked *baked, const see_lines *lines) {
    for (size_t i = 0; i < lines->segments.count; i++)
        for (int k = 0; k < 2; k++) {
            const sl_segment *s = &lines->segments.items[i];
            const sl_point at = k ? s->b : s->a;
            if (sl_space_locate(&baked->space, at) != SL_NO_CELL) continue;
            return sl_fail(context, SL_BAD_INPUT,
                           "'%s' has a point outside the map's bounds: %.9g,%.9g",
                           lines->names.items[see_lines_of(lines, i)], at.x, at.y);
        }
    return SL_OK;
}

void see_lines_destroy(sl_context *context, see_lines *lines) {
    for (size_t i = 0; i < lines->names.count; i++) sl_free(context, lines->names.items[i]);
    sl_free(context, lines->segments.items);
    sl_free(context, lines->ends.items);
    sl_free(context, lines->names.items);
    *lines = (see_lines){0};
}
