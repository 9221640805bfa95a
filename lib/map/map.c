/// The map: adding, copying, bounds.
#include "sightline/map.h"

#include "geometry/orient.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool sl_coordinate_usable(double value) {
    const double magnitude = fabs(value);
    return value == 0 || (magnitude >= SL_COORDINATE_MIN && magnitude <= SL_COORDINATE_MAX);
}

/// The length of the UTF-8 character at the start of the text, 0 where there is none
/// (RFC 3629: no overlong forms, no surrogates, nothing over U+10FFFF).
static size_t character_length(const unsigned char *text, size_t size) {
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (text[0] < 0x80) return 1;
    const size_t length = text[0] < 0xc0 ? 0 : text[0] < 0xe0 ? 2 : text[0] < 0xf0 ? 3 : 4;
    if (length == 0 || text[0] > 0xf4 || length > size) return 0;
    uint32_t code = text[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80) return 0;
        code = code << 6 | (text[i] & 0x3fu);
    }
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return code < least[length] || code > 0x10ffff || surrogate ? 0 : length;
}

bool sli_name_usable(const char *name, size_t length) {
    const unsigned char *text = (const unsigned char *)name;
    for (size_t i = 0; i < length;) {
        if (text[i] <= 0x20 || text[i] == 0x7f || text[i] == '#') return false;
        const size_t step = character_length(text + i, length - i);
        if (!step) return false;
        i += step;
    }
    return length > 0;
}

void sl_map_destroy(sl_context *context, sl_map *map) {
    for (size_t i = 0; i < map->door_count; i++) {
        sl_free(context, map->doors[i].name);
        sl_free(context, map->doors[i].parts);
    }
    for (size_t i = 0; i < map->object_count; i++) sl_free(context, map->objects[i].name);
    for (size_t i = 0; i < map->path_count; i++) {
        sl_free(context, map->paths[i].name);
        sl_free(context, map->paths[i].points);
    }
    sl_free(context, map->interior.places);
    sl_free(context, map->walls);
    sl_free(context, map->doors);
    sl_free(context, map->mirrors);
    sl_free(context, map->oneways);
    sl_free(context, map->seams);
    sl_free(context, map->starts);
    sl_free(context, map->paths);
    sl_free(context, map->objects);
    sli_source_destroy(context, &map->source);
    sl_map_drop_cells(context, map);
    *map = (sl_map){0};
}

void sl_map_drop_cells(sl_context *context, sl_map *map) {
    sl_free(context, map->cells);
    sl_free(context, map->corners);
    map->cells = NULL;
    map->corners = NULL;
    map->cell_count = map->corner_count = 0;
    map->cell_room = map->corner_room = 0;
    map->snap = 0;
    map->snap_line = 0;
}

/// Makes 0 of coordinates that are too small to be used.
static sl_status settle_point(sl_context *context, const char *what, sl_point *point) {
    *point = sli_coordinates(*point);
    if (sl_coordinate_usable(point->x) && sl_coordinate_usable(point->y)) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT, "%s: coordinates %g %g: expected magnitudes up to %g",
                   what, point->x, point->y, SL_COORDINATE_MAX);
}

static sl_status settle_ends(sl_context *context, const char *what, sl_point *a, sl_point *b) {
    SL_TRY(settle_point(context, what, a));
    return settle_point(context, what, b);
}

sl_status sli_copy_points(sl_context *context, const char *what, const sl_point *points,
                          size_t count, sl_point **out) {
    sl_point *copy = sl_alloc_array(context, count, sizeof *copy);
    if (!copy) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        copy[i] = points[i];
        status = settle_point(context, what, &copy[i]);
    }
    *out = status == SL_OK ? copy : NULL;
    if (status != SL_OK) sl_free(context, copy);
    return status;
}

/// A copy of the name of a door, path or object.
static sl_status copy_name(sl_context *context, const char *what, const char *name, char **copy) {
    const size_t length = strlen(name);
    if (!sli_name_usable(name, length))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%s: name '%s': expected one word of UTF-8 without '#'", what,
                       sli_show((sli_word){name, length}).text);
    *copy = sl_copy_text(context, name, length);
    return *copy ? SL_OK : SL_NO_MEMORY;
}

/// Makes room for one more item in an array of the map.
#define MAP_ROOM(context, map, items, thing)                                                       \
    sl_reserve((context), &(map)->items, &(map)->thing##_room, (map)->thing##_count + 1,           \
               sizeof *(map)->items)

sl_status sl_map_add_wall(sl_context *context, sl_map *map, sl_point a, sl_point b, uint32_t line) {
    SL_TRY(settle_ends(context, "wall", &a, &b));
    SL_TRY(MAP_ROOM(context, map, walls, wall));
    map->walls[map->wall_count++] = (sl_wall){.a = a, .b = b, .line = line};
    return SL_OK;
}

sl_status sl_map_add_walls(sl_context *context, sl_map *map, const sl_wall *walls, size_t count) {
    for (size_t i = 0; i < count; i++) {
        SL_TRY(sl_map_add_wall(context, map, walls[i].a, walls[i].b, walls[i].line));
        map->walls[map->wall_count - 1].ground = walls[i].ground;
    }
    return SL_OK;
}

sl_status sl_map_add_door(sl_context *context, sl_map *map, const char *name, sl_segment at,
                          bool open, uint32_t line) {
    SL_TRY(settle_ends(context, "door", &at.a, &at.b));
    SL_TRY(MAP_ROOM(context, map, doors, door));
    sl_door door = {.segment = at, .open = open, .line = line};
    SL_TRY(copy_name(context, "door", name, &door.name));
    map->doors[map->door_count++] = door;
    return SL_OK;
}

sl_status sl_map_add_mirror(sl_context *context, sl_map *map, sl_segment at, uint32_t line) {
    SL_TRY(settle_ends(context, "mirror", &at.a, &at.b));
    SL_TRY(MAP_ROOM(context, map, mirrors, mirror));
    map->mirrors[map->mirror_count++] = (sl_glass){.segment = at, .line = line};
    return SL_OK;
}

sl_status sl_map_add_oneway(sl_context *context, sl_map *map, sl_segment at, uint32_t line) {
    SL_TRY(settle_ends(context, "oneway", &at.a, &at.b));
    SL_TRY(MAP_ROOM(context, map, oneways, oneway));
    map->oneways[map->oneway_count++] = (sl_glass){.segment = at, .line = line};
    return SL_OK;
}

sl_status sl_map_add_seam(sl_context *context, sl_map *map, sl_segment at, uint32_t line) {
    SL_TRY(settle_ends(context, "seam", &at.a, &at.b));
    SL_TRY(MAP_ROOM(context, map, seams, seam));
    map->seams[map->seam_count++] = (sl_glass){.segment = at, .line = line};
    return SL_OK;
}

sl_status sli_map_add_border(sl_context *context, sl_map *map, sl_segment at) {
    if (sl_coordinate_usable(at.a.x) && sl_coordinate_usable(at.a.y) &&
        sl_coordinate_usable(at.b.x) && sl_coordinate_usable(at.b.y))
        return sl_map_add_seam(context, map, at, 0);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "border from %g %g to %g %g: expected 0 or magnitudes from %g to %g", at.a.x,
                   at.a.y, at.b.x, at.b.y, SL_COORDINATE_MIN, SL_COORDINATE_MAX);
}

sl_status sl_map_add_start(sl_context *context, sl_map *map, sl_point at, double heading,
                           uint32_t line) {
    SL_TRY(settle_point(context, "start", &at));
    if (!isfinite(heading))
        return sl_fail(context, SL_BAD_ARGUMENT, "start: heading %g: expected a finite angle",
                       heading);
    SL_TRY(MAP_ROOM(context, map, starts, start));
    map->starts[map->start_count++] = (sl_start){.at = at, .heading = heading, .line = line};
    return SL_OK;
}

sl_status sl_map_add_path(sl_context *context, sl_map *map, const char *name,
                          const sl_point *points, size_t count, uint32_t line) {
    if (count == 0) return sl_fail(context, SL_BAD_ARGUMENT, "path: expected at least one point");
    SL_TRY(MAP_ROOM(context, map, paths, path));
    sl_path path = {.count = count, .line = line};
    SL_TRY(sli_copy_points(context, "path", points, count, &path.points));
    const sl_status status = copy_name(context, "path", name, &path.name);
    if (status != SL_OK) {
        sl_free(context, path.points);
        return status;
    }
    map->paths[map->path_count++] = path;
    return SL_OK;
}

sl_status sl_map_add_object(sl_context *context, sl_map *map, const char *name, sl_box box,
                            uint32_t line) {
    SL_TRY(settle_ends(context, "object", &box.min, &box.max));
    if (box.min.x > box.max.x || box.min.y > box.max.y)
        return sl_fail(context, SL_BAD_ARGUMENT, "object: the box's min is over its max");
    SL_TRY(MAP_ROOM(context, map, objects, object));
    sl_object object = {.box = box, .line = line};
    SL_TRY(copy_name(context, "object", name, &object.name));
    map->objects[map->object_count++] = object;
    return SL_OK;
}

static sl_status add_cell(sl_context *context, sl_map *map, const sl_point *corners, size_t count,
                          uint32_t line) {
    const size_t distinct = sli_distinct_corners(corners, count);
    if (distinct < 3 || distinct > UINT32_MAX)
        return sl_fail(context, SL_BAD_ARGUMENT, "cell: expected at least three different corners");
    const size_t total = map->corner_count + distinct;
    SL_TRY(MAP_ROOM(context, map, cells, cell));
    SL_TRY(sl_reserve(context, &map->corners, &map->corner_room, total, sizeof *map->corners));
    map->cells[map->cell_count++] =
        (sl_map_cell){.first = map->corner_count, .count = (uint32_t)distinct, .line = line};
    for (size_t i = 0; i < count; i++)
        if (!sli_corner_repeats(corners, count, i)) map->corners[map->corner_count++] = corners[i];
    return SL_OK;
}

sl_status sl_map_add_cell(sl_context *context, sl_map *map, const sl_point *corners, size_t count,
                          uint32_t line) {
    sl_point *settled;
    SL_TRY(sli_copy_points(context, "cell", corners, count, &settled));
    const sl_status status = add_cell(context, map, settled, count, line);
    sl_free(context, settled);
    return status;
}

/// Adds a point to a box; the first one makes it.
static void grow(sl_box *box, bool *any, sl_point point) {
    if (!*any) *box = (sl_box){.min = point, .max = point};
    *any = true;
    if (point.x < box->min.x) box->min.x = point.x;
    if (point.y < box->min.y) box->min.y = point.y;
    if (point.x > box->max.x) box->max.x = point.x;
    if (point.y > box->max.y) box->max.y = point.y;
}

static void grow_segment(sl_box *box, bool *any, sl_segment segment) {
    grow(box, any, segment.a);
    grow(box, any, segment.b);
}

sl_box sl_map_bounds(const sl_map *map) {
    sl_box box = {0};
    bool any = false;
    for (size_t i = 0; i < map->wall_count; i++)
        grow_segment(&box, &any, (sl_segment){map->walls[i].a, map->walls[i].b});
    for (size_t i = 0; i < map->door_count; i++) grow_segment(&box, &any, map->doors[i].segment);
    for (size_t i = 0; i < map->mirror_count; i++)
        grow_segment(&box, &any, map->mirrors[i].segment);
    for (size_t i = 0; i < map->oneway_count; i++)
        grow_segment(&box, &any, map->oneways[i].segment);
    for (size_t i = 0; i < map->seam_count; i++) grow_segment(&box, &any, map->seams[i].segment);
    for (size_t i = 0; i < map->start_count; i++) grow(&box, &any, map->starts[i].at);
    for (size_t i = 0; i < map->path_count; i++)
        for (size_t k = 0; k < map->paths[i].count; k++) grow(&box, &any, map->paths[i].points[k]);
    for (size_t i = 0; i < map->object_count; i++)
        grow_segment(&box, &any, (sl_segment){map->objects[i].box.min, map->objects[i].box.max});
    for (size_t i = 0; i < map->corner_count; i++) grow(&box, &any, map->corners[i]);
    return box;
}

int sl_map_digits(const sl_map *map) {
    const sl_box box = sl_map_bounds(map);
    const double most =
        fmax(fmax(fabs(box.min.x), fabs(box.min.y)), fmax(fabs(box.max.x), fabs(box.max.y)));
    double across = hypot(box.max.x - box.min.x, box.max.y - box.min.y), walls = 0;
    for (size_t i = 0; i < map->wall_count; i++)
        walls +=
            hypot(map->walls[i].b.x - map->walls[i].a.x, map->walls[i].b.y - map->walls[i].a.y);
    if (walls > 0 && walls < across) across = walls; // a stray lies far away
    if (!(across > 0 && most > 0)) return 6;
    return (int)fmin(fmax(ceil(log10(most / across) - 0.5), 0) + 6, 17);
}

// --- copies

static sl_status copy_effects(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->door_count; i++) {
        const sl_door *d = &from->doors[i];
        SL_TRY(sl_map_add_door(context, to, d->name, d->segment, d->open, d->line));
        to->doors[i].kind = d->kind;
        if (!d->parts) continue;
        to->doors[i].parts = sl_alloc_array(context, d->part_count, sizeof *d->parts);
        if (!to->doors[i].parts) return SL_NO_MEMORY;
        memcpy(to->doors[i].parts, d->parts, d->part_count * sizeof *d->parts);
        to->doors[i].part_count = d->part_count;
    }
    for (size_t i = 0; i < from->mirror_count; i++) {
        SL_TRY(sl_map_add_mirror(context, to, from->mirrors[i].segment, from->mirrors[i].line));
        to->mirrors[i].one_sided = from->mirrors[i].one_sided;
    }
    for (size_t i = 0; i < from->oneway_count; i++)
        SL_TRY(sl_map_add_oneway(context, to, from->oneways[i].segment, from->oneways[i].line));
    for (size_t i = 0; i < from->seam_count; i++) {
        SL_TRY(sl_map_add_seam(context, to, from->seams[i].segment, from->seams[i].line));
        to->seams[i].entrance = from->seams[i].entrance;
        to->seams[i].stops = from->seams[i].stops;
        to->seams[i].ground = from->seams[i].ground;
    }
    return SL_OK;
}

static sl_status copy_cells(sl_context *context, const sl_map *from, sl_map *to) {
    to->snap = from->snap;
    to->snap_line = from->snap_line;
    for (size_t i = 0; i < from->cell_count; i++) {
        const sl_map_cell *cell = &from->cells[i];
        SL_TRY(sl_map_add_cell(context, to, from->corners + cell->first, cell->count, cell->line));
    }
    return SL_OK;
}

static sl_status copy_things(sl_context *context, const sl_map *from, sl_map *to) {
    for (size_t i = 0; i < from->start_count; i++)
        SL_TRY(sl_map_add_start(context, to, from->starts[i].at, from->starts[i].heading,
                                from->starts[i].line));
    for (size_t i = 0; i < from->path_count; i++)
        SL_TRY(sl_map_add_path(context, to, from->paths[i].name, from->paths[i].points,
                               from->paths[i].count, from->paths[i].line));
    for (size_t i = 0; i < from->object_count; i++)
        SL_TRY(sl_map_add_object(context, to, from->objects[i].name, from->objects[i].box,
                                 from->objects[i].line));
    return SL_OK;
}

static sl_status copy_interior(sl_context *context, const sl_map *from, sl_map *to) {
    const size_t count = from->interior.place_count;
    sl_point *places = count ? sl_alloc_array(context, count, sizeof *places) : NULL;
    if (count && !places) return SL_NO_MEMORY;
    if (count) memcpy(places, from->interior.places, count * sizeof *places);
    to->interior = from->interior;
    to->interior.places = places;
    return SL_OK;
}

sl_status sl_map_copy(sl_context *context, const sl_map *from, sl_map *to) {
    sl_map map = {.precision = from->precision,
                  .channel = from->channel,
                  .range = from->range,
                  .range_line = from->range_line,
                  .unit_line = from->unit_line,
                  .earth = from->earth,
                  .earth_line = from->earth_line,
                  .entrance = from->entrance,
                  .entrance_line = from->entrance_line,
                  .entrance_by_doors = from->entrance_by_doors,
                  .entrance_may_be_wide = from->entrance_may_be_wide,
                  .ground_guessed = from->ground_guessed};
    memcpy(map.unit, from->unit, sizeof map.unit);
    sl_status status = sl_map_add_walls(context, &map, from->walls, from->wall_count);
    if (status == SL_OK) status = copy_effects(context, from, &map);
    if (status == SL_OK) status = copy_cells(context, from, &map);
    if (status == SL_OK) status = copy_things(context, from, &map);
    if (status == SL_OK) status = copy_interior(context, from, &map);
    if (status == SL_OK) status = sli_source_copy(context, &from->source, &map.source);
    if (status == SL_OK)
        *to = map;
    else
        sl_map_destroy(context, &map);
    return status;
}
