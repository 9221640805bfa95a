/// Maps that are JSON with a list of walls: Universal VTT (Dungeondraft, Arkenforge, DungeonFog)
/// and the scenes of Foundry Virtual Tabletop. Files of our own have members of their own, as
/// tabletop_write.c says.
#include "geometry/orient.h"
#include "io/io_formats.h"
#include "io/parts/document.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "io/parts/things.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/io.h"

#include <math.h>

// --- names of doors, which only files of our own have

/// The name that a door of a file of our own has; NULL for none.
static const char *marked_name(const sli_json *door, bool flags) {
    const sli_json of_flags = sli_json_member(door, "flags");
    const sli_json own = sli_json_member(flags ? &of_flags : door, "sightline");
    const char *name = sli_json_text_of(&own, "name");
    return sli_name_usable(name, strlen(name)) ? name : NULL;
}

static bool is_marked(const sli_json *doors, bool flags, const char *name) {
    for (size_t i = 0; i < json_array_size(doors->value); i++) {
        const sli_json door = sli_json_item(doors, i);
        const char *own = marked_name(&door, flags);
        if (own && strcmp(own, name) == 0) return true;
    }
    return false;
}

static bool has_marks(const sli_json *doors, bool flags) {
    for (size_t i = 0; i < json_array_size(doors->value); i++) {
        const sli_json door = sli_json_item(doors, i);
        if (marked_name(&door, flags)) return true;
    }
    return false;
}

/// The naming of doors. `checks`: some doors have names of their own.
typedef struct door_names {
    size_t number;
    bool checks;
} door_names;

/// A door's own name, else "door" and a number: the next one that no door in the list has.
static const char *name_of_door(const sli_json *doors, const sli_json *door, bool flags,
                                door_names *names, char made[32]) {
    const char *own = marked_name(door, flags);
    if (own) return own;
    do snprintf(made, 32, "door%zu", ++names->number);
    while (names->checks && is_marked(doors, flags, made));
    return made;
}

// --- Universal VTT: walls as polylines, and portals

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
    door_names names;
    uint32_t item; ///< the number of the polyline or portal
} uvtt;

static const char *const layer_names[] = {"line_of_sight", "objects_line_of_sight", "portals"};
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

static sl_status add_portal(uvtt *reader, const sli_json *portals, const sli_json *portal,
                            sl_segment at, bool open) {
    if (sli_same_point(at.a, at.b)) {
        reader->points++;
        return SL_OK;
    }
    *(open ? &reader->open : &reader->closed) += 1;
    if (!reader->options->doors)
        return open ? SL_OK
                    : sl_map_add_wall(reader->context, reader->map, at.a, at.b, reader->item);
    char made[32];
    const char *name = name_of_door(portals, portal, false, &reader->names, made);
    return sl_map_add_door(reader->context, reader->map, name, at, open, reader->item);
}

static sl_status read_portals(uvtt *reader, const sli_json *portals) {
    size_t count;
    SL_TRY(sli_json_array(portals, &count));
    reader->names.checks = has_marks(portals, false);
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
        SL_TRY(add_portal(reader, portals, &portal, at, closed.value && !is_closed));
    }
    return SL_OK;
}

/// What a file of our own says of the whole map, in `own`: the y that is 0, the view range, the sum
/// of its digits (NULL for none).
static sl_status read_own(const sli_json *own, double *top, const char **mark, sl_map *map) {
    const sli_json digits = sli_json_member(own, "digits");
    *mark = json_string_value(digits.value);
    const sli_json y0 = sli_json_member(own, "y0"), range = sli_json_member(own, "range");
    SL_TRY(sli_json_number_if(&y0, top));
    SL_TRY(sli_json_number_if(&range, &map->range));
    return range.value && !(map->range > 0) ? sli_json_fail(&range, "a range is greater than 0")
                                            : SL_OK;
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
    SL_TRY(read_own(&own, &reader->top, &reader->mark, reader->map));
    reader->map->source.transform = sli_y_down(reader->top, 1);
    reader->map->source.page =
        (sl_box){{x, reader->top - (first + rows)}, {x + columns, reader->top - first}};
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

static sl_status check_layers(const uvtt *reader, const char *name) {
    const char *list = reader->options->layers;
    for (sli_word word; list && sli_layers_next(&list, &word);) {
        bool known = false;
        for (size_t i = 0; i < LAYER_COUNT; i++) known |= sli_word_is(word, layer_names[i]);
        if (!known)
            return sl_fail(reader->context, SL_BAD_ARGUMENT,
                           "%s: there is no layer '%s': a Universal VTT file has line_of_sight, "
                           "objects_line_of_sight and portals",
                           name, sli_show(word).text);
    }
    return SL_OK;
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
    SL_TRY(read_starts(reader, root));
    reader->map->precision =
        sli_marked_precision(reader->map, reader->finest, reader->mark, reader->sum);
    strcpy(reader->map->unit, "grid units");
    const sli_json lights = sli_json_member(root, "lights");
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->top, top);
    const bool doors = reader->options->doors;
    const sli_tally taken[] = {
        {of_lines, "wall of line_of_sight", "walls of line_of_sight"},
        {reader->walls - of_lines, "of objects_line_of_sight", "of objects_line_of_sight"},
        {reader->closed, doors ? "shut door" : "shut door (a wall)",
         doors ? "shut doors" : "shut doors (walls)"},
        {reader->open, doors ? "open door" : "open door (a gap)",
         doors ? "open doors" : "open doors (gaps)"}};
    const sli_tally left[] = {{reader->points, "line of no length", "lines of no length"},
                              {json_array_size(lights.value), "light", "lights"}};
    char with[SLI_TALLY_TEXT], without[SLI_TALLY_TEXT];
    sl_note(reader->context, "%s: %s%s; unit: grid squares, y = %s - the file's y",
            root->file->name, sli_tally_write("", taken, 4, with),
            sli_tally_write("; left out: ", left, 2, without), top);
    return SL_OK;
}

sl_status sli_map_read_uvtt(sl_context *context, const char *name, const char *text, size_t size,
                            const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    sl_map read = {0};
    uvtt reader = {.context = context, .options = options, .map = &read};
    SL_TRY(check_layers(&reader, name));
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

// --- Foundry: a wall has its two ends "c", what it does to "sight", "move" and "sound", a side
// "dir"
// --- that it works on, a kind of "door" and the door's state "ds" (Foundry's API, WallData). It
// --- stops steps by default, and sound. Light is sight, so "light" is not read

/// What stops sight, and sound. Files older than version 9 say it in "sense" by 0, 1 and 2.
enum { SIGHT_NONE = 0, SENSE_NORMAL = 1, SENSE_LIMITED = 2, SIGHT_LIMITED = 10, SIGHT_NORMAL = 20 };
enum { SIGHT_MOST = 40 };
enum { BOTH_SIDES, LEFT_ONLY, RIGHT_ONLY };
enum { DOOR_NONE, DOOR_PLAIN, DOOR_SECRET };
enum { DOOR_CLOSED, DOOR_OPEN, DOOR_LOCKED };

typedef struct foundry {
    sl_context *context;
    const sl_import_options *options;
    sl_map *map;
    double top;    ///< the file's y that is 0 in the map, which has y up: the largest of any wall
    double finest; ///< the finest unit of the coordinates
    uint64_t sum;  ///< of their digits, where the file has a mark
    const char *mark;
    double pixels; ///< in a unit of the map: 1, but in a file of our own
    bool top_told; ///< the file says its top
    size_t walls, oneways, open, shut, secret;
    size_t partial;        ///< walls that do not stop all
    size_t mirrors, seams; ///< of a file of our own
    door_names names;
    size_t limited;                           ///< walls that limit sight
    size_t unseen, one_limited, near, points; ///< left out, or open to sight
} foundry;

typedef struct record {
    sl_segment at;
    int64_t sight, side, door, state;
    uint32_t stops; ///< as sl_glass.stops
    uint32_t item;  ///< its number in the list, from 1
    bool seam;      ///< of a file of our own
    bool mirror, one_sided;
} record;

static sl_status read_ends(foundry *reader, const sli_json *wall, sl_segment *at) {
    const sli_json c = sli_json_member(wall, "c");
    size_t count;
    SL_TRY(sli_json_array(&c, &count));
    if (count != 4)
        return sli_json_fail(&c, "expected 4 numbers: x0, y0, x1, y1; found %zu", count);
    double values[4];
    for (size_t i = 0; i < 4; i++) {
        const sli_json number = sli_json_item(&c, i);
        SL_TRY(sli_json_number(&number, &values[i]));
        sli_keep_finest(&reader->finest, sli_shortest_unit(values[i]) / reader->pixels);
        if (reader->mark) reader->sum += sli_digits_of_number(values[i]);
        values[i] = sli_coordinate(values[i] / reader->pixels);
        if (!sl_coordinate_usable(values[i])) return sli_json_fail(&number, "out of range");
    }
    *at = (sl_segment){{values[0], sli_coordinate(reader->top - values[1])},
                       {values[2], sli_coordinate(reader->top - values[3])}};
    if (!sl_coordinate_usable(at->a.y) || !sl_coordinate_usable(at->b.y))
        return sli_json_fail(&c, "out of range once y points up");
    return SL_OK;
}

/// A wall that stops sight by distance, or sound by distance or behind another one, counts as open
/// for it.
static bool is_normal(int64_t sense) {
    return sense == SIGHT_NORMAL || sense == SENSE_NORMAL;
}

/// A wall that stops sight behind another one: limited sight.
static bool is_limited(int64_t sense) {
    return sense == SIGHT_LIMITED || sense == SENSE_LIMITED;
}

static int64_t sense_of(const sli_json *wall, const char *key) {
    const sli_json sense = sli_json_member(wall, key);
    return json_is_integer(sense.value) ? json_integer_value(sense.value) : SIGHT_NORMAL;
}

static sl_status read_stops(const sli_json *wall, record *read) {
    const sli_json sight = sli_json_member(wall, "sight"), sense = sli_json_member(wall, "sense");
    const int64_t steps = sense_of(wall, "move"), heard = sense_of(wall, "sound");
    SL_TRY(sli_json_whole_if(sight.value ? &sight : &sense, 0, SIGHT_MOST, &read->sight));
    read->stops = (is_normal(read->sight) ? SL_STOPS_SIGHT : 0u) |
                  (is_limited(read->sight) ? SL_STOPS_LIMITED : 0u) |
                  (steps != SIGHT_NONE ? SL_STOPS_STEPS : 0u) |
                  (is_normal(heard) ? SL_STOPS_SOUND : 0u);
    return SL_OK;
}

static sl_status read_record(foundry *reader, const sli_json *wall, record *read) {
    SL_TRY(sli_json_object(wall));
    SL_TRY(read_ends(reader, wall, &read->at));
    const sli_json side = sli_json_member(wall, "dir"), door = sli_json_member(wall, "door");
    const sli_json state = sli_json_member(wall, "ds");
    SL_TRY(read_stops(wall, read));
    SL_TRY(sli_json_whole_if(&side, 0, RIGHT_ONLY, &read->side));
    SL_TRY(sli_json_whole_if(&door, 0, DOOR_SECRET, &read->door));
    SL_TRY(sli_json_whole_if(&state, 0, DOOR_LOCKED, &read->state));
    const sli_json flags = sli_json_member(wall, "flags");
    const sli_json own = sli_json_member(&flags, "sightline");
    const sli_json seam = sli_json_member(&own, "seam"), mirror = sli_json_member(&own, "mirror");
    const char *sides = json_string_value(mirror.value);
    read->seam = sli_json_true(&seam, NULL);
    read->mirror = sides != NULL;
    read->one_sided = sides && strcmp(sides, "one") == 0;
    if (sides && !read->one_sided && strcmp(sides, "both") != 0)
        return sli_json_fail(&mirror, "expected 'one' or 'both', found '%s'",
                             sli_show((sli_word){sides, strlen(sides)}).text);
    return SL_OK;
}

/// Seen through from where it does not work: a wall for those on its left is passed from its right.
/// Foundry's left is the eye's left on its screen, going from the first end to the second; turning
/// y up leaves the picture as it is.
static sl_status add_wall(foundry *reader, const record *wall) {
    sl_segment at = wall->at;
    if (wall->side == BOTH_SIDES) {
        reader->walls++;
        return sl_map_add_wall(reader->context, reader->map, at.a, at.b, wall->item);
    }
    if (wall->side == RIGHT_ONLY) at = (sl_segment){at.b, at.a};
    reader->oneways++;
    return sl_map_add_oneway(reader->context, reader->map, at, wall->item);
}

/// Mirrors and seams of a file of our own.
static sl_status add_glass(foundry *reader, const record *wall) {
    if (wall->seam) {
        reader->seams++;
        return sl_map_add_seam(reader->context, reader->map, wall->at, wall->item);
    }
    reader->mirrors++;
    SL_TRY(sl_map_add_mirror(reader->context, reader->map, wall->at, wall->item));
    reader->map->mirrors[reader->map->mirror_count - 1].one_sided = wall->one_sided;
    return SL_OK;
}

/// A wall that does not stop all, whatever its side. A door that is seen through is one while it is
/// shut.
static sl_status add_partial(foundry *reader, const record *wall) {
    const size_t first = reader->map->wall_count;
    reader->partial++;
    reader->limited += (wall->stops & SL_STOPS_LIMITED) != 0;
    SL_TRY(sl_map_add_wall(reader->context, reader->map, wall->at.a, wall->at.b, wall->item));
    return sl_map_walls_stop(reader->context, reader->map, first, wall->stops);
}

static sl_status add_door(foundry *reader, const sli_json *walls, const sli_json *json,
                          const record *wall) {
    const bool open = wall->state == DOOR_OPEN;
    *(open ? &reader->open : &reader->shut) += 1;
    reader->secret += wall->door == DOOR_SECRET;
    if (!reader->options->doors) {
        if (open) return SL_OK;
        SL_TRY(add_wall(reader, wall));
        *(wall->side == BOTH_SIDES ? &reader->walls : &reader->oneways) -= 1;
        return SL_OK;
    }
    char made[32];
    const char *name = name_of_door(walls, json, true, &reader->names, made);
    return sl_map_add_door(reader->context, reader->map, name, wall->at, open, wall->item);
}

/// Names a wall by its place in the list and its id: "walls[12], id eX3".
static sl_status name_wall(foundry *reader, const sli_json *wall, const record *read) {
    const char *id = sli_json_text_of(wall, "_id");
    char label[SL_LINE_TEXT];
    snprintf(label, sizeof label, "walls[%u]%s%s", (unsigned)read->item - 1, *id ? ", id " : "",
             sli_show((sli_word){id, strlen(id)}).text);
    return sli_map_add_label(reader->context, reader->map, read->item, label);
}

static sl_status take(foundry *reader, const sli_json *walls, const sli_json *json, record *wall) {
    const sl_segment at = wall->at;
    size_t *left_out = NULL;
    if (wall->side) wall->stops &= SL_STOPS_ALL; // it limits sight one way: open to it
    if (at.a.x == at.b.x && at.a.y == at.b.y)
        left_out = &reader->points;
    else if (wall->seam)
        return add_glass(reader, wall);
    else if (wall->side && is_limited(wall->sight))
        left_out = &reader->one_limited;
    else if (wall->sight != SIGHT_NONE && !is_normal(wall->sight) && !is_limited(wall->sight))
        left_out = &reader->near;
    else if (!wall->stops)
        left_out = &reader->unseen;
    if (left_out) ++*left_out;
    if (left_out == &reader->points || !wall->stops) return SL_OK;
    if (wall->mirror) return add_glass(reader, wall);
    const bool whole = wall->stops & SL_STOPS_SIGHT && (wall->door != DOOR_NONE || wall->side);
    if (wall->stops != SL_STOPS_ALL && !whole)
        return wall->door != DOOR_NONE && wall->state == DOOR_OPEN ? SL_OK
                                                                   : add_partial(reader, wall);
    return wall->door == DOOR_NONE ? add_wall(reader, wall) : add_door(reader, walls, json, wall);
}

/// The largest y of all walls in the file.
static sl_status find_top(foundry *reader, const sli_json *walls, size_t count) {
    double top = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        const sli_json wall = sli_json_item(walls, i);
        sl_segment at;
        SL_TRY(sli_json_object(&wall));
        SL_TRY(read_ends(reader, &wall, &at));
        top = fmax(top, fmax(-at.a.y, -at.b.y));
    }
    reader->top = count ? top : 0;
    return SL_OK;
}

static sl_status read_foundry_walls(foundry *reader, const sli_json *walls) {
    size_t count;
    SL_TRY(sli_json_array(walls, &count));
    if (!reader->top_told) SL_TRY(find_top(reader, walls, count));
    reader->sum = 0;
    reader->names.checks = has_marks(walls, true);
    reader->map->source.transform = sli_y_down(reader->top, reader->pixels);
    reader->map->source.lines_are_items = true;
    for (size_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(reader->context));
        const sli_json wall = sli_json_item(walls, i);
        record read = {.sight = SIGHT_NORMAL, .item = (uint32_t)i + 1};
        SL_TRY(read_record(reader, &wall, &read));
        SL_TRY(name_wall(reader, &wall, &read));
        SL_TRY(take(reader, walls, &wall, &read));
    }
    char top[SL_NUMBER_TEXT], unit[SL_NUMBER_TEXT + 16] = "pixels", pixels[SL_NUMBER_TEXT];
    if (reader->pixels == 1) strcpy(reader->map->unit, "px");
    sl_number_write(reader->top, top);
    sl_number_write(reader->pixels, pixels);
    if (reader->pixels != 1) snprintf(unit, sizeof unit, "%s pixels", pixels);
    const bool doors = reader->options->doors;
    const sli_tally taken[] = {
        {reader->walls, "wall", "walls"},
        {reader->partial, "wall that does not stop all", "walls that do not stop all"},
        {reader->limited, "of them limits sight", "of them limit sight"},
        {reader->oneways, "of them one-way", "of them one-way"},
        {reader->shut, doors ? "shut door" : "shut door (a wall)",
         doors ? "shut doors" : "shut doors (walls)"},
        {reader->open, doors ? "open door" : "open door (a gap)",
         doors ? "open doors" : "open doors (gaps)"},
        {reader->secret, "of them secret", "of them secret"}};
    const sli_tally left[] = {
        {reader->unseen, "that stops nothing", "that stop nothing"},
        {reader->one_limited, "that limits sight from one side", "that limit sight from one side"},
        {reader->near, "that stops sight by distance", "that stop sight by distance"},
        {reader->points, "of no length", "of no length"}};
    char with[SLI_TALLY_TEXT], without[SLI_TALLY_TEXT];
    sl_note(reader->context, "%s: %s%s; unit: %s, y = %s - the file's y", walls->file->name,
            sli_tally_write("", taken, 7, with),
            sli_tally_write("; left out or open: ", left, 4, without), unit, top);
    if (reader->mirrors || reader->seams)
        sl_note(reader->context, "%s: taken by their flags: %zu mirror%s, %zu seam%s",
                walls->file->name, reader->mirrors, reader->mirrors == 1 ? "" : "s", reader->seams,
                reader->seams == 1 ? "" : "s");
    return SL_OK;
}

/// A token stands on squares of the scene's grid, `square` pixels wide. Friendly ones are starts.
/// Turned by 0 degrees it faces down.
static sl_status read_token(sli_things *things, const sli_json *token, double square,
                            double pixels) {
    enum { FRIENDLY = 1 };
    const sli_json disposition = sli_json_member(token, "disposition");
    const sli_json name = sli_json_member(token, "name");
    const char *text = json_string_value(name.value);
    sli_says says = {0};
    if (json_is_integer(disposition.value) && json_integer_value(disposition.value) == FRIENDLY)
        says = (sli_says){.kind = SLI_THING_START, .name = text ? text : "token"};
    SL_TRY(sli_things_ask(things, text, NULL, &says));
    if (!says.kind) return SL_OK;
    const sli_json x = sli_json_member(token, "x"), y = sli_json_member(token, "y");
    const sli_json width = sli_json_member(token, "width");
    const sli_json height = sli_json_member(token, "height");
    const sli_json turn = sli_json_member(token, "rotation");
    sl_point at, size = {1, 1};
    double degrees = 0;
    SL_TRY(sli_json_number(&x, &at.x));
    SL_TRY(sli_json_number(&y, &at.y));
    SL_TRY(sli_json_number_if(&width, &size.x));
    SL_TRY(sli_json_number_if(&height, &size.y));
    SL_TRY(sli_json_number_if(&turn, &degrees));
    const sli_thing start = {
        .kind = SLI_THING_START,
        .middle = {(at.x + size.x * square / 2) / pixels, (at.y + size.y * square / 2) / pixels},
        .heading = sli_heading_of(degrees + 90)};
    return sli_things_add(things, says.name, start);
}

/// The scene's grid is a number, or an object with its size.
static sl_status read_tokens(foundry *reader, const sli_json *root) {
    sli_things things = {.context = reader->context,
                         .file = root->file->name,
                         .options = reader->options,
                         .top = reader->top};
    const sli_json tokens = sli_json_member(root, "tokens"), grid = sli_json_member(root, "grid");
    const sli_json size = sli_json_member(&grid, "size");
    double square = 100;
    sl_status status = SL_OK;
    if (json_is_number(grid.value) || size.value)
        status = sli_json_number(size.value ? &size : &grid, &square);
    for (size_t i = 0; status == SL_OK && i < json_array_size(tokens.value); i++) {
        const sli_json token = sli_json_item(&tokens, i);
        status = read_token(&things, &token, square, reader->pixels);
    }
    if (status == SL_OK) status = sli_things_finish(&things, reader->map);
    sli_things_destroy(&things);
    return status;
}

/// The scene's own size, from y 0 of the file down; the caller adds the top.
static void read_page(foundry *reader, const sli_json *root) {
    const sli_json width = sli_json_member(root, "width"), height = sli_json_member(root, "height");
    const sl_point size = {sli_json_number_or_0(&width), sli_json_number_or_0(&height)};
    reader->map->source.page =
        (sl_box){{0, -size.y / reader->pixels}, {size.x / reader->pixels, 0}};
    reader->map->source.pixels = reader->pixels;
}

/// A scene, or a list of walls alone.
static sl_status read_foundry(foundry *reader, const sli_json *root) {
    const bool alone = json_is_array(root->value);
    if (!alone) SL_TRY(sli_json_object(root));
    const sli_json walls = sli_json_member(root, "walls");
    const sli_json flags = sli_json_member(root, "flags");
    const sli_json own = sli_json_member(&flags, "sightline"), y0 = sli_json_member(&own, "y0");
    const sli_json pixels = sli_json_member(&own, "pixels");
    reader->top_told = y0.value != NULL;
    SL_TRY(sli_json_number_if(&pixels, &reader->pixels));
    if (!(reader->pixels > 0)) return sli_json_fail(&pixels, "expected a number greater than 0");
    SL_TRY(read_own(&own, &reader->top, &reader->mark, reader->map));
    read_page(reader, root);
    SL_TRY(read_foundry_walls(reader, alone ? root : &walls));
    reader->map->source.page.min.y += reader->top;
    reader->map->source.page.max.y += reader->top;
    reader->map->precision =
        sli_marked_precision(reader->map, reader->finest, reader->mark, reader->sum);
    return read_tokens(reader, root);
}

sl_status sli_map_read_foundry(sl_context *context, const char *name, const char *text, size_t size,
                               const sl_import_options *options, sl_map *map) {
    sli_json_file file;
    SL_TRY(sli_json_open(context, name, text, size, &file));
    sl_map read = {0};
    foundry reader = {.context = context, .options = options, .map = &read, .pixels = 1};
    const sli_json root = sli_json_root(&file);
    const sl_status status = read_foundry(&reader, &root);
    sli_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
