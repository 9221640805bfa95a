/// Our own JSON export, read as a map (lib/bake/EXPORT.md).
///
/// What a map says is taken: walls, solid ground, doors, mirrors, one-way glass, seams, starts,
/// paths, objects, the view range. What a bake adds is left out: cells, portals, and what they see.
/// Version 1 has only walls and solid ground.
///
/// Walls of version 2 say which of them have solid ground at one hand (`solid_walls`). So the walls
/// stay as they are. Without that, the polygons `solids` add their sides as walls, also along the
/// border of the map.
#include "geometry/orient.h"
#include "io/io_formats.h"
#include "io/parts/document.h"
#include "map/ground.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/bake.h"
#include "sightline/io.h"

#include <math.h>

typedef struct export_reader {
    sl_context *context;
    sl_map *map;
    uint32_t item; ///< the number of the wall, door ... that is read
} export_reader;

typedef sl_status item_reader(export_reader *reader, const sli_json *item);

/// Reads the items of a list, which may be missing. Each gets a number and its place as a name:
/// "doors[2]".
static sl_status read_list(export_reader *reader, const sli_json *root, const char *key,
                           item_reader *read) {
    const sli_json list = sli_json_member(root, key);
    size_t count;
    if (!list.value) return SL_OK;
    SL_TRY(sli_json_array(&list, &count));
    for (size_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(reader->context));
        const sli_json item = sli_json_item(&list, i);
        char label[SL_LINE_TEXT];
        snprintf(label, sizeof label, "%s[%zu]", key, i);
        SL_TRY(sli_map_add_label(reader->context, reader->map, ++reader->item, label));
        SL_TRY(read(reader, &item));
    }
    return SL_OK;
}

// --- values

static sl_status read_point(const sli_json *at, sl_point *point) {
    size_t count;
    SL_TRY(sli_json_array(at, &count));
    if (count != 2) return sli_json_fail(at, "expected 2 numbers: x, y; found %zu", count);
    const sli_json x = sli_json_item(at, 0), y = sli_json_item(at, 1);
    SL_TRY(sli_json_number(&x, &point->x));
    return sli_json_number(&y, &point->y);
}

static sl_status read_segment(const sli_json *at, sl_segment *segment) {
    size_t count;
    double ends[4];
    SL_TRY(sli_json_array(at, &count));
    if (count != 4)
        return sli_json_fail(at, "expected 4 numbers: x0, y0, x1, y1; found %zu", count);
    for (size_t i = 0; i < 4; i++) {
        const sli_json number = sli_json_item(at, i);
        SL_TRY(sli_json_number(&number, &ends[i]));
    }
    *segment = (sl_segment){{ends[0], ends[1]}, {ends[2], ends[3]}};
    return SL_OK;
}

/// As read_segment, but for a segment of no length.
static sl_status read_stretch(const sli_json *at, sl_segment *segment) {
    SL_TRY(read_segment(at, segment));
    if (segment->a.x == segment->b.x && segment->a.y == segment->b.y)
        return sli_json_fail(at, "expected two different ends");
    return SL_OK;
}

/// Points of a list with at least `least`; the caller frees them.
static sl_status read_points(export_reader *reader, const sli_json *list, size_t least,
                             const char *what, sl_point **points, size_t *count) {
    SL_TRY(sli_json_array(list, count));
    if (*count < least)
        return sli_json_fail(list, "expected at least %zu %s%s, found %zu", least, what,
                             least == 1 ? "" : "s", *count);
    *points = sl_alloc_array(reader->context, *count, sizeof **points);
    if (!*points) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t i = 0; i < *count && status == SL_OK; i++) {
        const sli_json point = sli_json_item(list, i);
        status = read_point(&point, &(*points)[i]);
    }
    if (status != SL_OK) sl_free(reader->context, *points);
    return status;
}

static sl_status read_name(const sli_json *item, const char **name) {
    const sli_json at = sli_json_member(item, "name");
    SL_TRY(sli_json_text(&at, name));
    if (!sli_name_usable(*name, strlen(*name)))
        return sli_json_fail(&at, "expected one word without '#'");
    return SL_OK;
}

// --- walls and solid ground

static sl_status read_wall(export_reader *reader, const sli_json *wall) {
    sl_segment at;
    SL_TRY(read_segment(wall, &at));
    return sl_map_add_wall(reader->context, reader->map, at.a, at.b, reader->item);
}

/// A polygon of solid ground. Walls between two of them fall away when the map is cleaned.
static sl_status read_solid(export_reader *reader, const sli_json *polygon) {
    size_t count;
    sl_point *corners;
    SL_TRY(read_points(reader, polygon, 3, "corner", &corners, &count));
    const sl_status status = sli_map_add_ground(reader->context, reader->map, polygon->file->name,
                                                false, corners, count, reader->item);
    sl_free(reader->context, corners);
    return status;
}

/// The walls with solid ground at one hand, by number.
static sl_status read_solid_side(export_reader *reader, const sli_json *sides, const char *hand,
                                 uint32_t ground) {
    const sli_json list = sli_json_member(sides, hand);
    size_t count;
    SL_TRY(sli_json_array(&list, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json number = sli_json_item(&list, i);
        int64_t wall;
        SL_TRY(sli_json_whole(&number, 0, (int64_t)reader->map->wall_count - 1, &wall));
        reader->map->walls[wall].ground |= ground;
    }
    return SL_OK;
}

static sl_status read_walls(export_reader *reader, const sli_json *root) {
    const sli_json walls = sli_json_member(root, "walls");
    const sli_json sides = sli_json_member(root, "solid_walls");
    size_t count;
    SL_TRY(sli_json_array(&walls, &count)); // which must be there
    SL_TRY(read_list(reader, root, "walls", read_wall));
    if (!sides.value) return read_list(reader, root, "solids", read_solid);
    SL_TRY(sli_json_object(&sides));
    SL_TRY(read_solid_side(reader, &sides, "left", SL_SOLID_LEFT));
    return read_solid_side(reader, &sides, "right", SL_SOLID_RIGHT);
}

// --- walls that do not stop all

static sl_status read_stops(const sli_json *item, uint32_t *stops) {
    const sli_json list = sli_json_member(item, "stops");
    size_t count;
    SL_TRY(sli_json_array(&list, &count));
    *stops = 0;
    for (size_t i = 0; i < count; i++) {
        const sli_json name = sli_json_item(&list, i);
        const char *text;
        uint32_t one;
        SL_TRY(sli_json_text(&name, &text));
        if (!sl_stops_read(text, strlen(text), &one) || one & *stops)
            return sli_json_fail(&name, "expected sight or limited, steps or sound, each once");
        *stops |= one;
    }
    if (*stops & SL_STOPS_SIGHT && *stops & SL_STOPS_LIMITED)
        return sli_json_fail(&list, "a wall stops sight or limits it, not both");
    return *stops ? SL_OK : sli_json_fail(&list, "expected at least one of sight, steps, sound");
}

static sl_status read_partial_wall(export_reader *reader, const sli_json *wall) {
    sl_map *map = reader->map;
    const size_t first = map->wall_count;
    sl_segment at;
    uint32_t stops;
    SL_TRY(sli_json_object(wall));
    const sli_json segment = sli_json_member(wall, "segment");
    SL_TRY(read_segment(&segment, &at));
    SL_TRY(read_stops(wall, &stops));
    SL_TRY(sl_map_add_wall(reader->context, map, at.a, at.b, reader->item));
    const char *solid = sli_json_text_of(wall, "solid");
    if (strcmp(solid, "left") == 0) map->walls[first].ground = SL_SOLID_LEFT;
    if (strcmp(solid, "right") == 0) map->walls[first].ground = SL_SOLID_RIGHT;
    return sl_map_walls_stop(reader->context, map, first, stops);
}

/// Walls with a passage are pieces of those in "partial_walls": they are dropped. Before other
/// walls are added.
static sl_status drop_passages(export_reader *reader, const sli_json *root) {
    const sli_json list = sli_json_member(root, "passages");
    sl_map *map = reader->map;
    size_t count, kept = 0;
    if (!list.value) return SL_OK;
    SL_TRY(sli_json_array(&list, &count));
    bool *dropped = sl_alloc_array(reader->context, map->wall_count, sizeof *dropped);
    sl_status status = dropped ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++) {
        const sli_json item = sli_json_item(&list, i), wall = sli_json_member(&item, "wall");
        int64_t number = 0;
        status = sli_json_object(&item);
        if (status == SL_OK)
            status = sli_json_whole(&wall, 0, (int64_t)map->wall_count - 1, &number);
        if (status == SL_OK) dropped[number] = true;
    }
    for (size_t i = 0; i < map->wall_count && status == SL_OK; i++)
        if (!dropped[i]) map->walls[kept++] = map->walls[i];
    if (status == SL_OK) map->wall_count = kept;
    sl_free(reader->context, dropped);
    return status;
}

static sl_status read_channel(export_reader *reader, const sli_json *root) {
    const sli_json channel = sli_json_member(root, "walls_stop");
    const char *text;
    if (!channel.value) return SL_OK;
    SL_TRY(sli_json_text(&channel, &text));
    return sl_stops_read(text, strlen(text), &reader->map->channel) &&
                   reader->map->channel <= SL_STOPS_ALL
               ? SL_OK
               : sli_json_fail(&channel, "expected sight, steps or sound");
}

// --- effects

static bool continues(const sl_segment *first, const sl_segment *next) {
    return first->b.x == next->a.x && first->b.y == next->a.y &&
           sli_orient(first->a, first->b, next->b) == 0;
}

static sl_status read_door_kind(const sli_json *door, sl_door_kind *kind) {
    const sli_json said = sli_json_member(door, "kind");
    const char *word;
    *kind = SL_DOOR_PLAIN;
    if (!said.value) return SL_OK;
    SL_TRY(sli_json_text(&said, &word));
    if (strcmp(word, "breakable") == 0)
        *kind = SL_DOOR_BREAKABLE;
    else if (strcmp(word, "site") == 0)
        *kind = SL_DOOR_SITE;
    else
        return sli_json_fail(&said, "expected \"breakable\" or \"site\"");
    return SL_OK;
}

static sl_status add_door(export_reader *reader, const char *name, sl_segment at, bool open,
                          sl_door_kind kind) {
    SL_TRY(sl_map_add_door(reader->context, reader->map, name, at, open, reader->item));
    reader->map->doors[reader->map->door_count - 1].kind = kind;
    return SL_OK;
}

/// A door, or several of one name: stretches that go on in one line are joined.
static sl_status read_door(export_reader *reader, const sli_json *door) {
    const char *name;
    size_t count;
    SL_TRY(sli_json_object(door));
    SL_TRY(read_name(door, &name));
    const sli_json open = sli_json_member(door, "open");
    bool said = true;
    const bool is_open = open.value ? sli_json_true(&open, &said) : true;
    if (!said) return sli_json_fail(&open, "expected true or false");
    sl_door_kind kind;
    SL_TRY(read_door_kind(door, &kind));
    const sli_json segments = sli_json_member(door, "segments");
    SL_TRY(sli_json_array(&segments, &count));
    if (!count) return sli_json_fail(&segments, "expected at least 1 segment");
    sl_segment at = {0}, next = {0};
    for (size_t i = 0; i < count; i++) {
        const sli_json segment = sli_json_item(&segments, i);
        SL_TRY(read_stretch(&segment, &next));
        const bool joins = i && continues(&at, &next);
        if (i && !joins) SL_TRY(add_door(reader, name, at, is_open, kind));
        at = joins ? (sl_segment){at.a, next.b} : next;
    }
    return add_door(reader, name, at, is_open, kind);
}

static sl_status read_mirror(export_reader *reader, const sli_json *mirror) {
    sl_segment at;
    SL_TRY(read_stretch(mirror, &at));
    return sl_map_add_mirror(reader->context, reader->map, at, reader->item);
}

static sl_status read_one_sided(export_reader *reader, const sli_json *root) {
    const sli_json list = sli_json_member(root, "one_sided_mirrors");
    size_t count;
    if (!list.value) return SL_OK;
    SL_TRY(sli_json_array(&list, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json number = sli_json_item(&list, i);
        int64_t mirror;
        SL_TRY(sli_json_whole(&number, 0, (int64_t)reader->map->mirror_count - 1, &mirror));
        reader->map->mirrors[mirror].one_sided = true;
    }
    return SL_OK;
}

static sl_status read_oneway(export_reader *reader, const sli_json *glass) {
    sl_segment at;
    SL_TRY(read_stretch(glass, &at));
    return sl_map_add_oneway(reader->context, reader->map, at, reader->item);
}

static sl_status read_seam(export_reader *reader, const sli_json *seam) {
    sl_segment at;
    SL_TRY(read_stretch(seam, &at));
    return sl_map_add_seam(reader->context, reader->map, at, reader->item);
}

static sl_status read_range(export_reader *reader, const sli_json *root) {
    const sli_json range = sli_json_member(root, "range");
    if (!range.value) return SL_OK;
    SL_TRY(sli_json_number(&range, &reader->map->range));
    if (!(reader->map->range > 0)) return sli_json_fail(&range, "expected a number greater than 0");
    return SL_OK;
}

// --- places

/// The heading is an angle, not a coordinate: any finite number.
static sl_status read_start(export_reader *reader, const sli_json *start) {
    SL_TRY(sli_json_object(start));
    const sli_json at = sli_json_member(start, "at");
    const sli_json heading = sli_json_member(start, "heading");
    sl_point place;
    SL_TRY(read_point(&at, &place));
    if (heading.value && !json_is_number(heading.value))
        return sli_json_fail(&heading, "expected a number of degrees");
    const double degrees = heading.value ? json_number_value(heading.value) : 0;
    if (!isfinite(degrees)) return sli_json_fail(&heading, "expected a finite number of degrees");
    return sl_map_add_start(reader->context, reader->map, place, degrees, reader->item);
}

static sl_status read_path(export_reader *reader, const sli_json *path) {
    const char *name;
    size_t count;
    sl_point *points;
    SL_TRY(sli_json_object(path));
    SL_TRY(read_name(path, &name));
    const sli_json list = sli_json_member(path, "points");
    SL_TRY(read_points(reader, &list, 1, "point", &points, &count));
    const sl_status status =
        sl_map_add_path(reader->context, reader->map, name, points, count, reader->item);
    sl_free(reader->context, points);
    return status;
}

static sl_status read_object(export_reader *reader, const sli_json *object) {
    const char *name;
    sl_segment at;
    SL_TRY(sli_json_object(object));
    SL_TRY(read_name(object, &name));
    const sli_json box = sli_json_member(object, "box");
    SL_TRY(read_segment(&box, &at));
    const sl_box made = {{fmin(at.a.x, at.b.x), fmin(at.a.y, at.b.y)},
                         {fmax(at.a.x, at.b.x), fmax(at.a.y, at.b.y)}};
    return sl_map_add_object(reader->context, reader->map, name, made, reader->item);
}

// --- all of it

static sl_status check_version(const sli_json *root) {
    SL_TRY(sli_json_object(root));
    const sli_json format = sli_json_member(root, "format");
    const sli_json version = sli_json_member(root, "version");
    const char *name;
    int64_t number = 1;
    if (!format.value)
        return sli_json_fail(root,
                             "no map of a kind that is known: JSON is of Tiled, LDtk, Universal "
                             "VTT, Foundry, GeoJSON or an export of Sightline; export the map as "
                             "one of these, or as DXF or SVG, from the program that made it");
    SL_TRY(sli_json_text(&format, &name));
    if (strcmp(name, "sightline") != 0) return sli_json_fail(&format, "expected \"sightline\"");
    return sli_json_whole_if(&version, 1, SL_JSON_VERSION, &number);
}

/// Says what was taken; what a map has none of is not named.
static void note_taken(const export_reader *reader, const char *file, size_t walls) {
    const sl_map *m = reader->map;
    const struct {
        size_t count;
        const char *one, *several;
    } kinds[] = {{m->door_count, "door", "doors"},
                 {m->mirror_count, "mirror", "mirrors"},
                 {m->oneway_count, "one-way pane", "one-way panes"},
                 {m->seam_count - sl_map_partial_walls(m), "seam", "seams"},
                 {m->start_count, "start", "starts"},
                 {m->path_count, "path", "paths"},
                 {m->object_count, "object", "objects"}};
    char others[256] = "";
    size_t length = 0;
    bool solid = false;
    for (size_t i = 0; i < m->wall_count; i++) solid |= m->walls[i].ground != 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].count)
            length += (size_t)snprintf(others + length, sizeof others - length, ", %zu %s",
                                       kinds[i].count,
                                       kinds[i].count == 1 ? kinds[i].one : kinds[i].several);
    sl_note(
        reader->context,
        "%s: an export; taken: %zu wall%s%s%s; computed again: cells, portals and what they see",
        file, walls, walls == 1 ? "" : "s", solid ? ", solid ground" : "", others);
}

static sl_status read_all(export_reader *reader, const sli_json *root) {
    size_t walls;
    SL_TRY(check_version(root));
    reader->map->source.lines_are_items = true;
    SL_TRY(read_walls(reader, root));
    walls = json_array_size(json_object_get(root->value, "walls"));
    SL_TRY(drop_passages(reader, root));
    SL_TRY(read_list(reader, root, "partial_walls", read_partial_wall));
    SL_TRY(read_channel(reader, root));
    SL_TRY(read_list(reader, root, "doors", read_door));
    SL_TRY(read_list(reader, root, "mirrors", read_mirror));
    SL_TRY(read_one_sided(reader, root));
    SL_TRY(read_list(reader, root, "oneways", read_oneway));
    SL_TRY(read_list(reader, root, "seams", read_seam));
    SL_TRY(read_list(reader, root, "starts", read_start));
    SL_TRY(read_list(reader, root, "paths", read_path));
    SL_TRY(read_list(reader, root, "objects", read_object));
    SL_TRY(read_range(reader, root));
    note_taken(reader, root->file->name, walls);
    return SL_OK;
}

sl_status sli_map_read_export(sl_context *context, const char *name, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map) {
    (void)options;
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    sl_map read = {0};
    export_reader reader = {.context = context, .map = &read};
    const sli_json root = sli_json_root(&file);
    const sl_status status = read_all(&reader, &root);
    sli_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
