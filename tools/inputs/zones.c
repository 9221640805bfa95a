/// Zones: objects of the map, tables of corners, outlines.
#include "inputs/zones.h"

#include "sightline/viewpoint.h"

#include <stdio.h>
#include <string.h>

static sl_status add_corner(sl_context *context, zone_list *zones, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(context, &zones->points, 1));
    zones->points.items[zones->points.count++] = at;
    return SL_OK;
}

static size_t first_of(const zone_list *zones, size_t zone) {
    return zone ? zones->ends.items[zone - 1] : 0;
}

/// Makes the corners behind the last zone a zone, counter-clockwise. False where it has no area.
static bool turn_left(zone_list *zones) {
    const size_t first = first_of(zones, zones->ends.count), count = zones->points.count - first;
    sl_point *const p = zones->points.items + first;
    double area = 0;
    for (size_t i = 1; i + 1 < count; i++)
        area +=
            (p[i].x - p[0].x) * (p[i + 1].y - p[0].y) - (p[i].y - p[0].y) * (p[i + 1].x - p[0].x);
    for (size_t i = 0; area < 0 && i < count / 2; i++) {
        const sl_point last = p[count - 1 - i];
        p[count - 1 - i] = p[i];
        p[i] = last;
    }
    return area != 0;
}

static sl_status end_zone(sl_context *context, zone_list *zones, const char *name) {
    SL_TRY(SL_ARRAY_ROOM(context, &zones->ends, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &zones->names, 1));
    char *copy = sl_copy_text(context, name, strlen(name));
    if (!copy) return SL_NO_MEMORY;
    zones->names.items[zones->names.count++] = copy;
    zones->ends.items[zones->ends.count++] = zones->points.count;
    return SL_OK;
}

// --- a table of corners

static bool same_name(const sl_camera *a, const sl_camera *b) {
    return (!a->name && !b->name) || (a->name && b->name && strcmp(a->name, b->name) == 0);
}

/// Reads corners. Refuses the table that `rooms` writes, which has a point for each room.
static sl_status read_corners(sl_context *context, const char *path, sl_cameras *out) {
    static const char rooms[] = "room,x,y,";
    const sl_viewpoint like = {.fov = 360};
    sl_bytes text;
    SL_TRY(sl_file_read(context, path, &text));
    const bool lists_rooms =
        text.size >= sizeof rooms && !memcmp(text.data, rooms, sizeof rooms - 1);
    const sl_status status =
        lists_rooms ? sl_fail_at(context, path, 1,
                                 "a table of rooms, with one point for each, has no zones: a zone "
                                 "needs a line for each corner, name,x,y")
                    : sl_cameras_parse(context, path, text.data, text.size, &like, out);
    sl_free(context, text.data);
    return status;
}

static sl_status read_table(sl_context *context, const char *path, zone_list *out) {
    sl_cameras corners = {0};
    SL_TRY(read_corners(context, path, &corners));
    sl_status status = SL_OK;
    for (size_t i = 0, next; status == SL_OK && i < corners.count; i = next) {
        const sl_camera *first = &corners.items[i];
        for (next = i; next < corners.count && same_name(first, &corners.items[next]); next++) {
            status = add_corner(context, out, corners.items[next].view.at);
            if (status != SL_OK) break;
        }
        if (status == SL_OK && (next - i < 3 || !turn_left(out)))
            status = sl_fail_at(context, path, first->line,
                                "zone '%s' has no area: a zone needs a line for each corner, "
                                "name,x,y",
                                first->name ? first->name : "");
        if (status == SL_OK) status = end_zone(context, out, first->name ? first->name : "");
    }
    sl_cameras_destroy(context, &corners);
    return status;
}

// --- outlines

static bool same_point(sl_point a, sl_point b) {
    return a.x == b.x && a.y == b.y;
}

/// A closed outline is a run of walls, each from the end of the one before it.
static sl_status chain(sl_context *context, const sl_map *outlines, zone_list *out) {
    char name[SL_LINE_TEXT];
    const sl_wall *walls = outlines->walls;
    for (size_t i = 0, next; i < outlines->wall_count; i = next) {
        const sl_point start = walls[i].a;
        for (next = i + 1; next < outlines->wall_count; next++)
            if (same_point(walls[next - 1].b, start) ||
                !same_point(walls[next].a, walls[next - 1].b))
                break;
        if (!same_point(walls[next - 1].b, start) || next - i < 3) continue;
        for (size_t k = i; k < next; k++) SL_TRY(add_corner(context, out, walls[k].a));
        if (!turn_left(out)) {
            out->points.count = first_of(out, out->ends.count);
            continue;
        }
        const char *label = sl_map_label(outlines, walls[i].line);
        snprintf(name, sizeof name, "%s%s%zu", label ? label : "", label ? " " : "",
                 out->ends.count + 1);
        SL_TRY(end_zone(context, out, name));
    }
    return SL_OK;
}

static sl_status read_outlines(sl_context *context, const char *option, const char *path,
                               const input_options *input, zone_list *out) {
    const within_plan plan = {.path = path};
    sl_map outlines = {0};
    SL_TRY(within_read(context, &plan, input, &outlines));
    sl_status status = chain(context, &outlines, out);
    if (status == SL_OK && !out->ends.count)
        status = sl_fail(context, SL_BAD_INPUT,
                         "--%s %s: it has no closed outline, so there is no zone", option, path);
    sl_map_destroy(context, &outlines);
    return status;
}

// --- objects

static sl_status add_object(sl_context *context, const sl_object *object, zone_list *out) {
    const sl_box b = object->box;
    const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    for (int i = 0; i < 4; i++) SL_TRY(add_corner(context, out, corners[i]));
    return end_zone(context, out, object->name ? object->name : "");
}

static sl_status refuse_name(sl_context *context, const char *option, const char *name,
                             size_t length, const sl_map *map) {
    char known[256] = "";
    size_t used = 0;
    for (size_t i = 0; i < map->object_count && used + 40 < sizeof known; i++)
        used += (size_t)snprintf(known + used, sizeof known - used, "%s%.32s", i ? ", " : "",
                                 map->objects[i].name ? map->objects[i].name : "");
    if (used)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "--%s: '%.*s' is no file and no object of the map; its objects: %s", option,
                       (int)length, name, known);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "--%s: there is no file '%.*s', and the map has no objects: give a drawing of "
                   "outlines, or a table with the columns name,x,y",
                   option, (int)length, name);
}

static sl_status read_names(sl_context *context, const char *option, const char *text,
                            const sl_map *map, zone_list *out) {
    for (const char *at = text; *at;) {
        const size_t length = strcspn(at, ",");
        bool found = false;
        for (size_t i = 0; i < map->object_count; i++) {
            const char *name = map->objects[i].name ? map->objects[i].name : "";
            if (strlen(name) != length || strncmp(name, at, length) != 0) continue;
            SL_TRY(add_object(context, &map->objects[i], out));
            found = true;
        }
        if (!found) return refuse_name(context, option, at, length, map);
        at += length + (at[length] == ',');
    }
    return SL_OK;
}

sl_status zones_read(sl_context *context, const char *option, const char *text,
                     const input_options *input, const sl_map *map, zone_list *out) {
    const size_t length = strlen(text);
    const bool table = length > 4 && strcmp(text + length - 4, ".csv") == 0;
    sl_status status;
    if (table)
        status = read_table(context, text, out);
    else if (sl_path_look(text) == SL_PATH_FILE)
        status = read_outlines(context, option, text, input, out);
    else
        status = read_names(context, option, text, map, out);
    if (status != SL_OK) zones_destroy(context, out);
    return status;
}

sl_shape zones_shape(const zone_list *zones) {
    return (sl_shape){zones->points.items, zones->ends.items, zones->ends.count};
}

sl_shape zones_shape_of(const zone_list *zones, size_t zone, size_t *end) {
    const size_t first = first_of(zones, zone);
    *end = zones->ends.items[zone] - first;
    return (sl_shape){zones->points.items + first, end, 1};
}

bool zones_shape_holds(const sl_shape *zone, sl_point at) {
    bool within = false;
    const size_t end = zone->ends[0];
    for (size_t i = 0; i < end; i++)
        within ^= within_crosses(at, zone->points[i], zone->points[i + 1 < end ? i + 1 : 0]);
    return within;
}

bool zones_hold(const zone_list *zones, sl_point at) {
    for (size_t z = 0; z < zones->ends.count; z++) {
        size_t end;
        const sl_shape zone = zones_shape_of(zones, z, &end);
        if (zones_shape_holds(&zone, at)) return true;
    }
    return false;
}

void zones_destroy(sl_context *context, zone_list *zones) {
    for (size_t i = 0; i < zones->names.count; i++) sl_free(context, zones->names.items[i]);
    sl_free(context, zones->points.items);
    sl_free(context, zones->ends.items);
    sl_free(context, zones->names.items);
    *zones = (zone_list){0};
}
