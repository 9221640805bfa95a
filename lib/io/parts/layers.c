/// Layers by name: all of a map as a drawing.
///
/// A drawing has lines and outlines, no doors or mirrors. So each kind of thing has a layer of its
/// own, named "sightline-" and the word of the map text: "sightline-door". The writers of SVG, DXF
/// and Tiled files take their shapes from here, and their readers give them back here. A reader
/// draws a shape by its pen into an empty map first, which does all transforms; the lines that come
/// out become what the layer says. Files without such layers are read as they always were.
///
/// Files with y down need the y that is 0 in the map. To take y from it must round nothing: each y
/// is tried both ways. 0 always works, as it changes the sign alone; the drawing then lies above
/// its page.
#include "io/parts/layers.h"

#include "map/ground.h"
#include "map/source.h"

#include <math.h>
#include <strings.h>

// --- names

static const char *const names[SLI_LAYER_COUNT] = {
    [SLI_LAYER_NONE] = "",
    [SLI_LAYER_WALL] = "sightline-wall",
    [SLI_LAYER_SOLID] = "sightline-solid",
    [SLI_LAYER_OPEN] = "sightline-open",
    [SLI_LAYER_WALL_SOLID] = "sightline-wall-solid",
    [SLI_LAYER_DOOR] = "sightline-door",
    [SLI_LAYER_MIRROR] = "sightline-mirror",
    [SLI_LAYER_MIRROR_ONE] = "sightline-mirror-one",
    [SLI_LAYER_ONEWAY] = "sightline-oneway",
    [SLI_LAYER_SEAM] = "sightline-seam",
    [SLI_LAYER_START] = "sightline-start",
    [SLI_LAYER_PATH] = "sightline-path",
    [SLI_LAYER_OBJECT] = "sightline-object",
    [SLI_LAYER_CELL] = "sightline-cell",
    [SLI_LAYER_WRONG] = "",
    [SLI_LAYER_PARTIAL] = "sightline-wall-stops-sight",
    "sightline-wall-stops-steps",
    "sightline-wall-stops-sight-steps",
    "sightline-wall-stops-sound",
    "sightline-wall-stops-sight-sound",
    "sightline-wall-stops-steps-sound",
    [SLI_LAYER_PARTIAL_SOLID] = "sightline-solid-stops-sight",
    "sightline-solid-stops-steps",
    "sightline-solid-stops-sight-steps",
    "sightline-solid-stops-sound",
    "sightline-solid-stops-sight-sound",
    "sightline-solid-stops-steps-sound",
    [SLI_LAYER_PARTIAL_WALL_SOLID] = "sightline-wall-solid-stops-sight",
    "sightline-wall-solid-stops-steps",
    "sightline-wall-solid-stops-sight-steps",
    "sightline-wall-solid-stops-sound",
    "sightline-wall-solid-stops-sight-sound",
    "sightline-wall-solid-stops-steps-sound",
};

/// Whether a layer's name says what walls stop.
static bool says_stops(sli_word name) {
    static const char *const begins[] = {"sightline-wall-stops", "sightline-solid-stops",
                                         "sightline-wall-solid-stops"};
    for (int i = 0; i < 3; i++)
        if (name.length >= strlen(begins[i]) &&
            strncasecmp(name.at, begins[i], strlen(begins[i])) == 0)
            return true;
    return false;
}

const char *sli_layer_name(sli_layer layer) {
    return names[layer];
}

sli_layer sli_layer_of(sli_word name, sli_word *rest) {
    sli_layer found = SLI_LAYER_NONE;
    size_t longest = 0;
    for (int i = SLI_LAYER_NONE + 1; i < SLI_LAYER_COUNT; i++) {
        const size_t length = strlen(names[i]);
        if (i == SLI_LAYER_WRONG || length <= longest || name.length < length ||
            strncasecmp(name.at, names[i], length) != 0)
            continue;
        if (name.length > length && (!rest || name.at[length] != '-')) continue;
        found = (sli_layer)i;
        longest = length;
    }
    if (says_stops(name) && (!sli_layer_stops(found) || name.length > longest))
        return SLI_LAYER_WRONG; // such layers have no name behind
    if (rest && found) {
        const size_t behind = longest + (name.length > longest);
        *rest = (sli_word){name.at + behind, name.length - behind};
    }
    return found;
}

// --- reading

/// The corners that the lines run through from end to end; NULL where they do not, or for lack of
/// memory. For an outline the last corner is the first one again, and is not counted.
static sl_point *corners_of(sl_context *context, const sl_map *drawn, bool closed, size_t *count) {
    const size_t lines = drawn->wall_count;
    *count = closed ? lines : lines + 1;
    sl_point *corners = sl_alloc_array(context, lines + 1, sizeof *corners);
    for (size_t i = 0; corners && i < lines; i++) {
        corners[i] = drawn->walls[i].a;
        corners[i + 1] = drawn->walls[i].b;
    }
    return corners;
}

static bool is_joined(const sl_map *drawn, bool closed) {
    const size_t count = drawn->wall_count;
    if (count < (closed ? 3 : 1)) return false;
    for (size_t i = 0; i < count; i++) {
        if (i + 1 == count && !closed) return true;
        const sl_point to = drawn->walls[i].b, next = drawn->walls[i + 1 < count ? i + 1 : 0].a;
        if (to.x != next.x || to.y != next.y) return false;
    }
    return true;
}

enum { MADE_NAME = 32 };

/// A name of the map text: the item's own, else its kind and a number.
static const char *name_of(const sli_layer_item *item, const char *kind, size_t before,
                           char made[MADE_NAME]) {
    if (item->name && sli_name_usable(item->name, strlen(item->name))) return item->name;
    snprintf(made, MADE_NAME, "%s%zu", kind, before + 1);
    return made;
}

static sl_status take_outline(sl_context *context, const char *file, sl_map *map,
                              const sli_layer_item *item, const sl_map *drawn, uint32_t line) {
    const bool closed = item->layer != SLI_LAYER_PATH;
    char made[MADE_NAME];
    size_t count;
    if (!drawn->wall_count) return SL_OK;
    if (!is_joined(drawn, closed))
        return sl_fail_at(context, file, line, "layer %s: expected %s", names[item->layer],
                          closed ? "a closed outline" : "lines that go on from end to end");
    sl_point *corners = corners_of(context, drawn, closed, &count);
    if (!corners) return SL_NO_MEMORY;
    sl_status status;
    if (item->layer == SLI_LAYER_PATH) {
        status = sl_map_add_path(context, map, name_of(item, "path", map->path_count, made),
                                 corners, count, line);
    } else if (item->layer == SLI_LAYER_CELL) {
        status = sl_map_add_cell(context, map, corners, count, line);
    } else {
        status = sli_map_add_ground(context, map, file, item->layer == SLI_LAYER_OPEN, corners,
                                    count, line);
    }
    sl_free(context, corners);
    return status;
}

static sl_status take_line(sl_context *context, sl_map *map, const sli_layer_item *item,
                           const sl_wall *wall, const char *name) {
    const sl_segment at = {wall->a, wall->b};
    switch (item->layer) {
    case SLI_LAYER_DOOR:
        return sl_map_add_door(context, map, name, at, item->open, wall->line);
    case SLI_LAYER_ONEWAY:
        return sl_map_add_oneway(context, map, at, wall->line);
    case SLI_LAYER_SEAM:
        return sl_map_add_seam(context, map, at, wall->line);
    case SLI_LAYER_MIRROR:
    case SLI_LAYER_MIRROR_ONE:
        SL_TRY(sl_map_add_mirror(context, map, at, wall->line));
        map->mirrors[map->mirror_count - 1].one_sided = item->layer == SLI_LAYER_MIRROR_ONE;
        return SL_OK;
    case SLI_LAYER_WALL_SOLID:
        SL_TRY(sl_map_add_wall(context, map, at.a, at.b, wall->line));
        map->walls[map->wall_count - 1].ground = SL_SOLID_LEFT | SL_SOLID_BEGINS;
        return SL_OK;
    default:
        return sl_map_add_wall(context, map, at.a, at.b, wall->line);
    }
}

/// Walls that do not stop all, with solid ground at their left or without, or ground with such.
static sl_status take_partial(sl_context *context, const char *file, sl_map *map,
                              const sli_layer_item *item, const sl_map *drawn, uint32_t line) {
    const size_t first = map->wall_count;
    if (item->layer >= SLI_LAYER_PARTIAL_SOLID && item->layer < SLI_LAYER_PARTIAL_WALL_SOLID)
        SL_TRY(take_outline(context, file, map, item, drawn, line));
    else
        SL_TRY(sl_map_add_walls(context, map, drawn->walls, drawn->wall_count));
    if (item->layer >= SLI_LAYER_PARTIAL_WALL_SOLID)
        for (size_t i = first; i < map->wall_count; i++) map->walls[i].ground = SL_SOLID_LEFT;
    return sl_map_walls_stop(context, map, first, sli_layer_stops(item->layer));
}

sl_status sli_layer_take(sl_context *context, const char *file, sl_map *map,
                         const sli_layer_item *item, const sl_map *drawn, uint32_t line) {
    char made[MADE_NAME];
    const char *name;
    if (sli_layer_stops(item->layer)) return take_partial(context, file, map, item, drawn, line);
    switch (item->layer) {
    case SLI_LAYER_WRONG:
        return sl_fail_at(context, file, line,
                          "a layer whose walls stop something: expected a name such as %s, with "
                          "sight, steps, sound or two of them in this order",
                          names[SLI_LAYER_PARTIAL]);
    case SLI_LAYER_START:
        if (!item->count) return SL_OK;
        return sl_map_add_start(context, map, item->points[0], item->heading, line);
    case SLI_LAYER_OBJECT:
        if (!drawn->wall_count) return SL_OK;
        name = name_of(item, "object", map->object_count, made);
        return sl_map_add_object(context, map, name, sl_map_bounds(drawn), line);
    case SLI_LAYER_SOLID:
    case SLI_LAYER_OPEN:
    case SLI_LAYER_PATH:
    case SLI_LAYER_CELL:
        return take_outline(context, file, map, item, drawn, line);
    default:
        name = name_of(item, "door", map->door_count, made);
        for (size_t i = 0; i < drawn->wall_count; i++)
            SL_TRY(take_line(context, map, item, &drawn->walls[i], name));
        return SL_OK;
    }
}

double sli_heading_through(sli_affine affine, double heading) {
    static const double radians = 0.017453292519943295;
    if (affine.xx > 0 && affine.xx == affine.yy && affine.xy == 0 && affine.yx == 0) return heading;
    const double x = cos(heading * radians), y = sin(heading * radians);
    return atan2(affine.yx * x + affine.yy * y, affine.xx * x + affine.xy * y) / radians;
}

void sli_layers_note(sl_context *context, const char *file, const sl_map *map) {
    const struct {
        size_t count;
        const char *one, *many;
    } things[] = {
        {map->door_count, "line of a door", "lines of doors"},
        {map->mirror_count, "mirror", "mirrors"},
        {map->oneway_count, "pane of one-way glass", "panes of one-way glass"},
        {sl_map_partial_walls(map), "wall that does not stop all", "walls that do not stop all"},
        {map->seam_count - sl_map_partial_walls(map), "seam", "seams"},
        {map->start_count, "start", "starts"},
        {map->path_count, "path", "paths"},
        {map->object_count, "object", "objects"},
        {map->cell_count, "cell", "cells"},
    };
    char text[256] = "";
    for (size_t i = 0; i < sizeof things / sizeof *things; i++) {
        const size_t used = strlen(text);
        if (things[i].count)
            snprintf(text + used, sizeof text - used, "%s%zu %s", used ? ", " : "", things[i].count,
                     things[i].count == 1 ? things[i].one : things[i].many);
    }
    if (*text) sl_note(context, "%s: also read: %s", file, text);
}

// --- writing

typedef struct layer_writer {
    sl_context *context;
    const sl_map *map;
    const sli_layer_sink *sink;
    sli_layer layer; ///< that is begun
    bool solid;      ///< which polygons of a trace are asked for
    uint32_t stops;  ///< what the walls do that are being written; 0: all
    size_t count;
} layer_writer;

static sl_status emit(layer_writer *writer, const sli_layer_item *item) {
    if (item->layer != writer->layer) {
        if (writer->layer) writer->sink->end(writer->sink->user);
        writer->sink->begin(writer->sink->user, item->layer);
        writer->layer = item->layer;
    }
    writer->sink->item(writer->sink->user, item);
    return ++writer->count % 1024 ? SL_OK : sl_check_cancelled(writer->context);
}

static sl_status emit_line(layer_writer *writer, sli_layer layer, sl_point a, sl_point b) {
    const sl_point ends[2] = {a, b};
    return emit(writer, &(sli_layer_item){.layer = layer, .points = ends, .count = 2});
}

static sl_status emit_plain(void *user, sl_point from, sl_point to, uint32_t line) {
    (void)line;
    return emit_line(user, SLI_LAYER_WALL, from, to);
}

static sl_status emit_polygon(void *user, const sl_point *corners, size_t count, bool solid,
                              uint32_t line) {
    layer_writer *writer = user;
    (void)line;
    if (solid != writer->solid) return SL_OK;
    return emit(writer, &(sli_layer_item){.layer = solid ? SLI_LAYER_SOLID : SLI_LAYER_OPEN,
                                          .points = corners,
                                          .count = count,
                                          .closed = true});
}

static sl_status pass_polygon(void *user, const sl_point *corners, size_t count, bool solid,
                              uint32_t line) {
    (void)user, (void)corners, (void)count, (void)solid, (void)line;
    return SL_OK;
}

static sl_status emit_solid_wall(void *user, sl_point from, sl_point to, uint32_t line) {
    (void)line;
    return emit_line(user, SLI_LAYER_WALL_SOLID, from, to);
}

static sl_status pass_wall(void *user, sl_point from, sl_point to, uint32_t line) {
    (void)user, (void)from, (void)to, (void)line;
    return SL_OK;
}

/// Walls without solid ground beside them; then solid ground, as in map text.
static sl_status write_walls(layer_writer *writer) {
    const sl_map *map = writer->map;
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        const bool solid = wall->ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT);
        if (solid && !sli_ground_parts_rooms(wall->ground)) continue;
        SL_TRY(emit_line(writer, SLI_LAYER_WALL, wall->a, wall->b));
    }
    const sli_loop_user users[] = {
        {.user = writer, .plain = emit_plain},
        {.user = writer, .polygon = emit_polygon, .wall = pass_wall},
        {.user = writer, .polygon = emit_polygon, .wall = pass_wall},
        {.user = writer, .polygon = pass_polygon, .wall = emit_solid_wall},
    };
    for (size_t i = 0; i < sizeof users / sizeof *users; i++) {
        writer->solid = i == 1;
        SL_TRY(sli_ground_trace(writer->context, map->walls, map->wall_count, &users[i]));
    }
    return SL_OK;
}

static sl_status write_glass(layer_writer *writer) {
    const sl_map *map = writer->map;
    for (size_t i = 0; i < map->door_count; i++) {
        const sl_door *door = &map->doors[i];
        const sl_point ends[2] = {door->segment.a, door->segment.b};
        SL_TRY(emit(writer, &(sli_layer_item){.layer = SLI_LAYER_DOOR,
                                              .name = door->name,
                                              .open = door->open,
                                              .points = ends,
                                              .count = 2}));
    }
    for (int one = 0; one < 2; one++)
        for (size_t i = 0; i < map->mirror_count; i++)
            if (map->mirrors[i].one_sided == (one == 1))
                SL_TRY(emit_line(writer, one ? SLI_LAYER_MIRROR_ONE : SLI_LAYER_MIRROR,
                                 map->mirrors[i].segment.a, map->mirrors[i].segment.b));
    for (size_t i = 0; i < map->oneway_count; i++)
        SL_TRY(emit_line(writer, SLI_LAYER_ONEWAY, map->oneways[i].segment.a,
                         map->oneways[i].segment.b));
    for (size_t i = 0; i < map->seam_count; i++)
        if (!map->seams[i].stops)
            SL_TRY(emit_line(writer, SLI_LAYER_SEAM, map->seams[i].segment.a,
                             map->seams[i].segment.b));
    return SL_OK;
}

/// Of the layers for what is being written that does not stop all.
static sli_layer partial(const layer_writer *writer, sli_layer first) {
    return (sli_layer)(first + writer->stops - 1);
}

static sl_status emit_partial(void *user, sl_point from, sl_point to, uint32_t line) {
    layer_writer *writer = user;
    (void)line;
    return emit_line(writer, partial(writer, SLI_LAYER_PARTIAL), from, to);
}

static sl_status emit_partial_wall_solid(void *user, sl_point from, sl_point to, uint32_t line) {
    layer_writer *writer = user;
    (void)line;
    return emit_line(writer, partial(writer, SLI_LAYER_PARTIAL_WALL_SOLID), from, to);
}

static sl_status emit_partial_solid(void *user, const sl_point *corners, size_t count, bool solid,
                                    uint32_t line) {
    layer_writer *writer = user;
    (void)line;
    if (!solid) return SL_OK;
    return emit(writer, &(sli_layer_item){.layer = partial(writer, SLI_LAYER_PARTIAL_SOLID),
                                          .points = corners,
                                          .count = count,
                                          .closed = true});
}

/// Open ground within walls that do not stop all is written wall by wall.
static sl_status emit_partial_open(void *user, const sl_point *corners, size_t count, bool solid,
                                   uint32_t line) {
    for (size_t i = 0; i < count && !solid; i++)
        SL_TRY(emit_partial_wall_solid(user, corners[i], corners[(i + 1) % count], line));
    return SL_OK;
}

/// Walls that do not stop all: those without ground, then the outlines of ground, then what is left
/// of those with ground.
static sl_status write_partial(layer_writer *writer) {
    const sl_map *map = writer->map;
    sl_wall *walls = sl_alloc_array(writer->context, map->seam_count, sizeof *walls);
    sl_status status = walls ? SL_OK : SL_NO_MEMORY;
    for (writer->stops = 1; writer->stops < SL_STOPS_ALL && status == SL_OK; writer->stops++) {
        size_t count = 0;
        for (size_t i = 0; i < map->seam_count && status == SL_OK; i++) {
            const sl_glass *wall = &map->seams[i];
            const sl_segment at = wall->segment;
            if (wall->stops != writer->stops) continue;
            if (wall->ground & (SL_SOLID_LEFT | SL_SOLID_RIGHT) &&
                !sli_ground_parts_rooms(wall->ground))
                walls[count++] = (sl_wall){at.a, at.b, wall->line, wall->ground};
            else
                status = emit_partial(writer, at.a, at.b, 0);
        }
        const sli_loop_user users[] = {
            {.user = writer, .polygon = emit_partial_solid, .wall = pass_wall},
            {.user = writer, .polygon = emit_partial_open, .wall = emit_partial_wall_solid},
        };
        for (size_t i = 0; i < 2 && status == SL_OK; i++)
            status = sli_ground_trace(writer->context, walls, count, &users[i]);
    }
    sl_free(writer->context, walls);
    return status;
}

static bool has_length(const sl_point *points, size_t count) {
    for (size_t i = 1; i < count; i++)
        if (points[i].x != points[0].x || points[i].y != points[0].y) return true;
    return false;
}

static sl_status write_others(layer_writer *writer) {
    const sl_map *map = writer->map;
    size_t left_out = 0;
    for (size_t i = 0; i < map->start_count; i++)
        SL_TRY(emit(writer, &(sli_layer_item){.layer = SLI_LAYER_START,
                                              .points = &map->starts[i].at,
                                              .count = 1,
                                              .heading = map->starts[i].heading}));
    for (size_t i = 0; i < map->path_count; i++) {
        const sl_path *path = &map->paths[i];
        const sli_layer_item item = {.layer = SLI_LAYER_PATH,
                                     .name = path->name,
                                     .points = path->points,
                                     .count = path->count};
        if (has_length(item.points, item.count))
            SL_TRY(emit(writer, &item));
        else
            left_out++;
    }
    for (size_t i = 0; i < map->object_count; i++) {
        const sl_box b = map->objects[i].box;
        const sl_point corners[4] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
        const sli_layer_item item = {.layer = SLI_LAYER_OBJECT,
                                     .name = map->objects[i].name,
                                     .points = corners,
                                     .count = 4,
                                     .closed = true};
        if (has_length(corners, 4))
            SL_TRY(emit(writer, &item));
        else
            left_out++;
    }
    if (left_out)
        sl_note(writer->context, "left out: %zu path%s or object%s of no length", left_out,
                left_out == 1 ? "" : "s", left_out == 1 ? "" : "s");
    return SL_OK;
}

static sl_status write_cells(layer_writer *writer) {
    const sl_map *map = writer->map;
    for (size_t i = 0; i < map->cell_count; i++)
        SL_TRY(emit(writer, &(sli_layer_item){.layer = SLI_LAYER_CELL,
                                              .points = map->corners + map->cells[i].first,
                                              .count = map->cells[i].count,
                                              .closed = true}));
    return SL_OK;
}

sl_status sli_layers_write(sl_context *context, const sl_map *map, const sli_layer_sink *sink) {
    layer_writer writer = {.context = context, .map = map, .sink = sink};
    SL_TRY(write_walls(&writer));
    if (sl_map_partial_walls(map)) SL_TRY(write_partial(&writer));
    SL_TRY(write_glass(&writer));
    SL_TRY(write_others(&writer));
    SL_TRY(write_cells(&writer));
    if (writer.layer) sink->end(sink->user);
    return SL_OK;
}

// --- y down

double sli_turned_y(double top, double y) {
    return top - y + 0.0;
}

static bool keeps(double top, double y) {
    return top - (top - y) == y;
}

static bool keeps_both(double top, sl_segment at) {
    return keeps(top, at.a.y) && keeps(top, at.b.y);
}

static bool keeps_glass(double top, const sl_glass *glass, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!keeps_both(top, glass[i].segment)) return false;
    return true;
}

/// Whether each y of the map comes back as the same number.
static bool keeps_all(const sl_map *map, double top) {
    bool good = keeps_glass(top, map->mirrors, map->mirror_count) &&
                keeps_glass(top, map->oneways, map->oneway_count) &&
                keeps_glass(top, map->seams, map->seam_count);
    for (size_t i = 0; i < map->wall_count && good; i++)
        good = keeps(top, map->walls[i].a.y) && keeps(top, map->walls[i].b.y);
    for (size_t i = 0; i < map->door_count && good; i++)
        good = keeps_both(top, map->doors[i].segment);
    for (size_t i = 0; i < map->start_count && good; i++) good = keeps(top, map->starts[i].at.y);
    for (size_t i = 0; i < map->path_count && good; i++)
        for (size_t k = 0; k < map->paths[i].count && good; k++)
            good = keeps(top, map->paths[i].points[k].y);
    for (size_t i = 0; i < map->object_count && good; i++)
        good = keeps(top, map->objects[i].box.min.y) && keeps(top, map->objects[i].box.max.y);
    for (size_t i = 0; i < map->corner_count && good; i++) good = keeps(top, map->corners[i].y);
    return good;
}

static bool has_page(const sl_map *map) {
    return map->source.page.max.x > map->source.page.min.x &&
           map->source.page.max.y > map->source.page.min.y;
}

sl_box sli_page_of(const sl_map *map) {
    if (has_page(map)) return map->source.page;
    const sl_box b = sl_map_bounds(map);
    const sl_box page = {{floor(b.min.x), floor(b.min.y)}, {ceil(b.max.x), ceil(b.max.y)}};
    return (sl_box){page.min, {fmax(page.max.x, page.min.x + 1), fmax(page.max.y, page.min.y + 1)}};
}

double sli_choose_top(const sl_map *map) {
    const double top = map->source.transform.origin.y;
    if (has_page(map) && keeps_all(map, top)) return top;
    const double edge = ceil(sl_map_bounds(map).max.y);
    return keeps_all(map, edge) ? edge + 0.0 : 0;
}

// --- text

void sli_put_number(FILE *stream, double value, uint64_t *sum) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value + 0.0, text);
    *sum += sli_digits_of(text, strlen(text));
    fputs(text, stream);
}

void sli_write_mark(const sl_map *map, uint64_t sum, char text[SLI_MARK_TEXT]) {
    char precision[SL_NUMBER_TEXT];
    sl_number_write(map->precision, precision);
    snprintf(text, SLI_MARK_TEXT, "%016llx %s", (unsigned long long)sum, precision);
}

/// Of the characters that names may have XML forbids two (XML 1.0, 2.2): U+FFFE and U+FFFF.
static sl_status check_xml_name(sl_context *context, const sl_map *map, const char *name,
                                uint32_t line) {
    if (!strstr(name, "\xef\xbf\xbe") && !strstr(name, "\xef\xbf\xbf")) return SL_OK;
    return sli_map_fail(context, map, SL_UNSUPPORTED, line,
                        "a name has the character U+FFFE or U+FFFF, which XML files cannot have");
}

sl_status sli_check_xml_names(sl_context *context, const sl_map *map) {
    for (size_t i = 0; i < map->door_count; i++)
        SL_TRY(check_xml_name(context, map, map->doors[i].name, map->doors[i].line));
    for (size_t i = 0; i < map->path_count; i++)
        SL_TRY(check_xml_name(context, map, map->paths[i].name, map->paths[i].line));
    for (size_t i = 0; i < map->object_count; i++)
        SL_TRY(check_xml_name(context, map, map->objects[i].name, map->objects[i].line));
    return SL_OK;
}

void sli_put_escaped(FILE *stream, const char *text) {
    for (; *text; text++) {
        const char *const entity = *text == '&'   ? "&amp;"
                                   : *text == '<' ? "&lt;"
                                   : *text == '>' ? "&gt;"
                                   : *text == '"' ? "&quot;"
                                                  : NULL;
        if (entity)
            fputs(entity, stream);
        else
            putc(*text, stream);
    }
}
