// Universal VTT (Dungeondraft, Arkenforge, DungeonFog): JSON with walls as polylines and portals.
#include "geometry/orient.h"
#include "import/json.h"
#include "import/layers.h"
#include "sightline/import.h"

#include <math.h>

typedef struct uvtt {
    sl_context *context;
    const sl_import_options *options;
    sl_map *map;
    double top; ///< the file's y that is 0 in the map, which has y up
    size_t walls, points;
    size_t open, closed;
} uvtt;

static const char *const layer_names[] = {"line_of_sight", "objects_line_of_sight", "portals"};
enum { LAYER_COUNT = sizeof layer_names / sizeof *layer_names };

static sl_status read_point(const uvtt *reader, const sl_json *at, sl_point *point) {
    SL_TRY(sl_json_object(at));
    const sl_json x = sl_json_member(at, "x"), y = sl_json_member(at, "y");
    sl_point read = {0};
    SL_TRY(sl_json_number(&x, &read.x));
    SL_TRY(sl_json_number(&y, &read.y));
    read.y = reader->top - read.y;
    if (!sl_coordinate_usable(read.y)) return sl_json_fail(&y, "out of range once y points up");
    *point = read;
    return SL_OK;
}

static sl_status read_polyline(uvtt *reader, const sl_json *line) {
    size_t count;
    SL_TRY(sl_json_array(line, &count));
    sl_point before = {0};
    for (size_t i = 0; i < count; i++) {
        const sl_json item = sl_json_item(line, i);
        sl_point point;
        SL_TRY(read_point(reader, &item, &point));
        if (i && !sl_same_point(before, point)) {
            SL_TRY(sl_map_add_wall(reader->context, reader->map, before, point, 0));
            reader->walls++;
        } else if (i) {
            reader->points++;
        }
        before = point;
    }
    return SL_OK;
}

static sl_status read_polylines(uvtt *reader, const sl_json *lines) {
    size_t count;
    SL_TRY(sl_json_array(lines, &count));
    for (size_t i = 0; i < count; i++) {
        SL_TRY(sl_check_cancelled(reader->context));
        const sl_json line = sl_json_item(lines, i);
        SL_TRY(read_polyline(reader, &line));
    }
    return SL_OK;
}

static sl_status add_portal(uvtt *reader, sl_segment at, bool open) {
    if (sl_same_point(at.a, at.b)) {
        reader->points++;
        return SL_OK;
    }
    *(open ? &reader->open : &reader->closed) += 1;
    if (!reader->options->doors)
        return open ? SL_OK : sl_map_add_wall(reader->context, reader->map, at.a, at.b, 0);
    char name[32];
    snprintf(name, sizeof name, "door%zu", reader->map->door_count + 1);
    return sl_map_add_door(reader->context, reader->map, name, at, open, 0);
}

static sl_status read_portals(uvtt *reader, const sl_json *portals) {
    size_t count;
    SL_TRY(sl_json_array(portals, &count));
    for (size_t i = 0; i < count; i++) {
        const sl_json portal = sl_json_item(portals, i);
        SL_TRY(sl_json_object(&portal));
        const sl_json bounds = sl_json_member(&portal, "bounds");
        const sl_json closed = sl_json_member(&portal, "closed");
        size_t ends;
        SL_TRY(sl_json_array(&bounds, &ends));
        if (ends != 2) return sl_json_fail(&bounds, "a portal has 2 ends, this one %zu", ends);
        const sl_json from = sl_json_item(&bounds, 0), to = sl_json_item(&bounds, 1);
        sl_segment at;
        SL_TRY(read_point(reader, &from, &at.a));
        SL_TRY(read_point(reader, &to, &at.b));
        bool said;
        const bool is_closed = sl_json_true(&closed, &said);
        if (closed.value && !said) return sl_json_fail(&closed, "expected true or false");
        // A portal that does not say so is shut, as in the programs that draw it.
        SL_TRY(add_portal(reader, at, closed.value && !is_closed));
    }
    return SL_OK;
}

/// The lower edge of the map is y 0: its origin and its size say where that is.
static sl_status read_size(uvtt *reader, const sl_json *root) {
    const sl_json resolution = sl_json_member(root, "resolution");
    SL_TRY(sl_json_object(&resolution));
    const sl_json size = sl_json_member(&resolution, "map_size");
    const sl_json origin = sl_json_member(&resolution, "map_origin");
    const sl_json height = sl_json_member(&size, "y"), y = sl_json_member(&origin, "y");
    double first = 0, rows;
    SL_TRY(sl_json_number_if(&y, &first));
    SL_TRY(sl_json_number(&height, &rows));
    reader->top = first + rows;
    return SL_OK;
}

static bool takes(const uvtt *reader, const char *layer) {
    return !reader->options->layers || sl_layers_have(reader->options->layers, layer);
}

static sl_status check_layers(const uvtt *reader, const char *name) {
    const char *list = reader->options->layers;
    for (sl_word word; list && sl_layers_next(&list, &word);) {
        bool known = false;
        for (size_t i = 0; i < LAYER_COUNT; i++) known |= sl_word_is(word, layer_names[i]);
        if (!known)
            return sl_fail(reader->context, SL_BAD_ARGUMENT,
                           "%s: there is no layer '%s': a Universal VTT file has line_of_sight, "
                           "objects_line_of_sight and portals",
                           name, sl_show(word).text);
    }
    return SL_OK;
}

static sl_status read_file(uvtt *reader, const sl_json *root) {
    SL_TRY(sl_json_object(root));
    SL_TRY(read_size(reader, root));
    const sl_json lines = sl_json_member(root, layer_names[0]);
    const sl_json objects = sl_json_member(root, layer_names[1]);
    const sl_json portals = sl_json_member(root, layer_names[2]);
    // Files of the format's first versions have no list of objects.
    if (takes(reader, layer_names[0])) SL_TRY(read_polylines(reader, &lines));
    const size_t of_lines = reader->walls;
    if (takes(reader, layer_names[1]) && objects.value) SL_TRY(read_polylines(reader, &objects));
    if (takes(reader, layer_names[2]) && portals.value) SL_TRY(read_portals(reader, &portals));
    const sl_json lights = sl_json_member(root, "lights");
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->top, top);
    sl_note(reader->context,
            "%s: %zu walls of line_of_sight, %zu of objects_line_of_sight; %zu closed portals "
            "taken as %s, %zu open ones %s; left out: %zu lines of no length, %zu lights; unit: "
            "grid squares, y = %s - the file's y",
            root->file->name, of_lines, reader->walls - of_lines, reader->closed,
            reader->options->doors ? "doors" : "walls", reader->open,
            reader->options->doors ? "as doors" : "left out", reader->points,
            json_array_size(lights.value), top);
    return SL_OK;
}

sl_status sl_map_read_uvtt(sl_context *context, const char *name, const char *text, size_t size,
                           const sl_import_options *options, sl_map *map) {
    sl_json_file file;
    sl_map read = {0};
    uvtt reader = {.context = context, .options = options, .map = &read};
    SL_TRY(check_layers(&reader, name));
    SL_TRY(sl_json_open(context, name, text, size, &file));
    const sl_json root = sl_json_root(&file);
    const sl_status status = read_file(&reader, &root);
    sl_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
