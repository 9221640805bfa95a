/// Universal VTT (Dungeondraft, DungeonFog, Arkenforge, Dungeon Alchemist): walls as polylines, and
/// portals, which are doors. Files of our own have members of their own, as tabletop_write.c says.
#include "geometry/length.h"
#include "geometry/orient.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "io/tabletop/tabletop.h"
#include "map/source.h"

#include <math.h>

typedef struct uvtt {
    sl_context *context;
    const sl_import_options *options;
    sl_map *map;
    double top;    ///< the file's y that is 0 in the map, which has y up
    double finest; ///< the finest unit of the coordinates
    uint64_t sum;  ///< of their digits, where the file has a mark
    const char *mark;
    size_t walls, points;
    size_t open, closed;
    sli_door_names names;
    uint32_t item; ///< the number of the polyline or portal
    sl_box scene;  ///< in the map's places
    bool is_own;   ///< a file of our own
} uvtt;

static const char *const layer_names[] = {"line_of_sight", "objects_line_of_sight", "portals",
                                          "edge"};
enum { LAYER_COUNT = sizeof layer_names / sizeof *layer_names };

static sl_status read_point(uvtt *reader, const sli_json *at, sl_point *point) {
    SL_TRY(sli_json_object(at));
    const sli_json x = sli_json_member(at, "x"), y = sli_json_member(at, "y");
    sl_point read = {0};
    SL_TRY(sli_json_number(&x, &read.x));
    SL_TRY(sli_json_number(&y, &read.y));
    sli_keep_finest(&reader->finest, sli_shortest_unit(read.x));
    sli_keep_finest(&reader->finest, sli_shortest_unit(read.y));
    if (reader->mark) reader->sum += sli_digits_of_number(read.x) + sli_digits_of_number(read.y);
    read.y = sli_coordinate(reader->top - read.y);
    if (!sl_coordinate_usable(read.y)) return sli_json_fail(&y, "out of range once y points up");
    *point = read;
    return SL_OK;
}

/// Numbers the next item of a list: "line_of_sight[12]".
static sl_status name_item(sl_context *context, sl_map *map, const char *list, size_t index,
                           uint32_t *item) {
    char label[SL_LINE_TEXT];
    snprintf(label, sizeof label, "%s[%zu]", list, index);
    map->source.lines_are_items = true;
    return sli_map_add_label(context, map, ++*item, label);
}

static sl_status read_polyline(uvtt *reader, const sli_json *line) {
    size_t count;
    SL_TRY(sli_json_array(line, &count));
    sl_point before = {0};
    for (size_t i = 0; i < count; i++) {
        const sli_json item = sli_json_item(line, i);
        sl_point point;
        SL_TRY(read_point(reader, &item, &point));
        if (i && !sli_same_point(before, point)) {
            SL_TRY(sl_map_add_wall(reader->context, reader->map, before, point, reader->item));
            reader->walls++;
        } else if (i) {
            reader->points++;
        }
        before = point;
    }
    return SL_OK;
}

static sl_status read_polylines(uvtt *reader, const char *name, const sli_json *lines) {
    size_t count;
    SL_TRY(sli_json_array(lines, &count));
    for (size_t i = 0; i < count; i++) {
        SL_TRY(sl_check_cancelled(reader->context));
        const sli_json line = sli_json_item(lines, i);
        SL_TRY(name_item(reader->context, reader->map, name, i, &reader->item));
        SL_TRY(read_polyline(reader, &line));
    }
    return SL_OK;
}

static sl_status add_portal(uvtt *reader, const sli_json *portal, sl_segment at, bool open) {
    if (sli_same_point(at.a, at.b)) {
        reader->points++;
        return SL_OK;
    }
    *(open ? &reader->open : &reader->closed) += 1;
    char made[32];
    const char *name = sli_name_of_door(&reader->names, portal, made);
    return sl_map_add_door(reader->context, reader->map, name, at, open, reader->item);
}

static sl_status read_portals(uvtt *reader, const sli_json *portals) {
    size_t count;
    SL_TRY(sli_json_array(portals, &count));
    reader->names = sli_door_names_of(portals, false);
    for (size_t i = 0; i < count; i++) {
        const sli_json portal = sli_json_item(portals, i);
        SL_TRY(name_item(reader->context, reader->map, layer_names[2], i, &reader->item));
        SL_TRY(sli_json_object(&portal));
        const sli_json bounds = sli_json_member(&portal, "bounds");
        const sli_json closed = sli_json_member(&portal, "closed");
        size_t ends;
        SL_TRY(sli_json_array(&bounds, &ends));
        if (ends != 2) return sli_json_fail(&bounds, "a portal has 2 ends, this one %zu", ends);
        const sli_json from = sli_json_item(&bounds, 0), to = sli_json_item(&bounds, 1);
        sl_segment at;
        SL_TRY(read_point(reader, &from, &at.a));
        SL_TRY(read_point(reader, &to, &at.b));
        bool said;
        const bool is_closed = sli_json_true(&closed, &said);
        if (closed.value && !said) return sli_json_fail(&closed, "expected true or false");
        // A portal that does not say so is shut, as in the programs that draw it.
        SL_TRY(add_portal(reader, &portal, at, closed.value && !is_closed));
    }
    return SL_OK;
}

/// The lower edge of the map is y 0: its origin and its size say where that is.
static sl_status read_size(uvtt *reader, const sli_json *root) {
    const sli_json resolution = sli_json_member(root, "resolution");
    SL_TRY(sli_json_object(&resolution));
    const sli_json size = sli_json_member(&resolution, "map_size");
    const sli_json origin = sli_json_member(&resolution, "map_origin");
    const sli_json height = sli_json_member(&size, "y"), y = sli_json_member(&origin, "y");
    double first = 0, rows;
    SL_TRY(sli_json_number_if(&y, &first));
    const sli_json pixels = sli_json_member(&resolution, "pixels_per_grid");
    const sli_json left = sli_json_member(&origin, "x"), width = sli_json_member(&size, "x");
    const double x = sli_json_number_or_0(&left), columns = sli_json_number_or_0(&width);
    reader->map->source.pixels = sli_json_number_or_0(&pixels);
    SL_TRY(sli_json_number(&height, &rows));
    reader->top = first + rows;
    const sli_json own = sli_json_member(root, "sightline");
    reader->is_own = own.value != NULL;
    SL_TRY(sli_tabletop_own(&own, &reader->top, &reader->mark, reader->map));
    reader->map->source.transform = sli_y_down(reader->top, 1);
    reader->scene = (sl_box){{x, reader->top - (first + rows)}, {x + columns, reader->top - first}};
    reader->map->source.page = reader->scene;
    return SL_OK;
}

/// Starts of a file of our own.
static sl_status read_starts(uvtt *reader, const sli_json *root) {
    const sli_json own = sli_json_member(root, "sightline");
    const sli_json starts = sli_json_member(&own, "starts");
    size_t count = 0;
    if (starts.value) SL_TRY(sli_json_array(&starts, &count));
    for (size_t i = 0; i < count; i++) {
        const sli_json start = sli_json_item(&starts, i);
        const sli_json at = sli_json_member(&start, "at");
        const sli_json turn = sli_json_member(&start, "heading");
        sl_point point;
        double heading = 0;
        SL_TRY(sli_json_object(&start));
        SL_TRY(read_point(reader, &at, &point));
        SL_TRY(sli_json_number_if(&turn, &heading));
        SL_TRY(sl_map_add_start(reader->context, reader->map, point, heading, 0));
    }
    if (count)
        sl_note(reader->context, "%s: taken: %zu start%s", root->file->name, count,
                count == 1 ? "" : "s");
    return SL_OK;
}

static bool takes(const uvtt *reader, const char *layer) {
    return !reader->options->layers || sli_layers_have(reader->options->layers, layer);
}

/// Whether a place is on a wall, up to the rounding of the file.
static bool is_on(const sl_wall *wall, sl_point at, double near) {
    const sl_point d = {wall->b.x - wall->a.x, wall->b.y - wall->a.y};
    const sl_point w = {at.x - wall->a.x, at.y - wall->a.y};
    const double length = sli_length(d.x, d.y), along = (w.x * d.x + w.y * d.y) / length;
    return along >= -near && along <= length + near && fabs(w.x * d.y - w.y * d.x) / length <= near;
}

/// Some programs do not cut the walls at their portals: a door there opens nothing.
static void tell_blocked(const uvtt *reader, const char *name) {
    const size_t most = (size_t)1 << 26;
    const sl_map *map = reader->map;
    size_t blocked = 0;
    if (map->wall_count && map->door_count > most / map->wall_count) return;
    for (size_t i = 0; i < map->door_count; i++)
        for (size_t k = 0; k < map->wall_count; k++)
            if (is_on(&map->walls[k], map->doors[i].segment.a, map->precision) &&
                is_on(&map->walls[k], map->doors[i].segment.b, map->precision)) {
                blocked++;
                break;
            }
    if (blocked)
        sl_note(reader->context,
                "%s: %zu door%s on a wall that runs on behind: opening %s shows nothing", name,
                blocked, blocked == 1 ? " lies" : "s lie", blocked == 1 ? "it" : "them");
}

/// Some programs count the places of walls from the corner of the map, and not from its origin.
static sl_box find_scene(const uvtt *reader) {
    const sl_box box = reader->scene;
    const double x = box.min.x, y = reader->top - box.max.y;
    const sl_box other = {{0, box.min.y + y}, {box.max.x - x, box.max.y + y}};
    size_t all;
    return sli_edge_holds(reader->map, other, &all) > sli_edge_holds(reader->map, box, &all) ? other
                                                                                             : box;
}

static sl_status add_edge(uvtt *reader, const char *name) {
    const bool asked = reader->options->layers && takes(reader, layer_names[3]);
    sli_things none = {.context = reader->context, .file = name, .options = reader->options};
    sli_edge edge = {.context = reader->context,
                     .file = name,
                     .box = find_scene(reader),
                     .asked = asked,
                     .off = "line_of_sight,objects_line_of_sight,portals",
                     .all = "line_of_sight,objects_line_of_sight,portals,edge"};
    if (!asked && (reader->is_own || reader->options->layers)) return SL_OK;
    sl_status status = sli_edge_find(&edge, reader->map, &none);
    if (status == SL_OK) status = sli_edge_add(&edge, reader->map, ++reader->item);
    sli_edge_destroy(&edge);
    return status;
}

static sl_status read_uvtt(uvtt *reader, const sli_json *root) {
    SL_TRY(sli_json_object(root));
    SL_TRY(read_size(reader, root));
    const sli_json lines = sli_json_member(root, layer_names[0]);
    const sli_json objects = sli_json_member(root, layer_names[1]);
    const sli_json portals = sli_json_member(root, layer_names[2]);
    // Files of the format's first versions have no list of objects.
    if (takes(reader, layer_names[0])) SL_TRY(read_polylines(reader, layer_names[0], &lines));
    const size_t of_lines = reader->walls;
    if (takes(reader, layer_names[1]) && objects.value)
        SL_TRY(read_polylines(reader, layer_names[1], &objects));
    if (takes(reader, layer_names[2]) && portals.value) SL_TRY(read_portals(reader, &portals));
    if (!reader->options->layers && !reader->walls && !reader->closed && !reader->open)
        return sl_fail_at(
            reader->context, root->file->name, 0,
            "the map has no walls and no doors, so nothing is hidden in it: draw them "
            "in the program that wrote it, and export it again");
    SL_TRY(read_starts(reader, root));
    reader->map->precision =
        sli_marked_precision(reader->map, reader->finest, reader->mark, reader->sum);
    strcpy(reader->map->unit, "grid units");
    const sli_json lights = sli_json_member(root, "lights");
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->top, top);
    const sli_tally taken[] = {
        {of_lines, "wall of line_of_sight", "walls of line_of_sight"},
        {reader->walls - of_lines, "of objects_line_of_sight", "of objects_line_of_sight"},
        {reader->closed, "shut door", "shut doors"},
        {reader->open, "open door", "open doors"}};
    const sli_tally left[] = {{reader->points, "line of no length", "lines of no length"},
                              {json_array_size(lights.value), "light", "lights"}};
    char with[SLI_TALLY_TEXT], without[SLI_TALLY_TEXT];
    sl_note(reader->context, "%s: %s%s; unit: grid squares, y = %s - the file's y",
            root->file->name, sli_tally_write("", taken, 4, with),
            sli_tally_write("; left out: ", left, 2, without), top);
    tell_blocked(reader, root->file->name);
    return add_edge(reader, root->file->name);
}

sl_status sli_map_read_uvtt(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    sl_map read = {0};
    uvtt reader = {.context = context, .options = options, .map = &read};
    SL_TRY(sli_layers_check(context, name, options->layers, layer_names, LAYER_COUNT));
    SL_TRY(sli_json_open(context, name, text, size, &file));
    const sli_json root = sli_json_root(&file);
    const sl_status status = read_uvtt(&reader, &root);
    sli_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
