/// Scenes of Foundry Virtual Tabletop. A wall has its two ends "c", what it does to "sight", "move"
/// and "sound", a side "dir" that it works on, a kind of "door" and the door's state "ds"
/// (Foundry's API, WallData). It stops steps by default, and sound. Light is sight, so "light" is
/// not read.
///
/// The scene is read with its y turned up about 0 first, and its edge is found (edge.c). Then it is
/// read so that the lowest of all walls has y 0.
#include "geometry/orient.h"
#include "io/io_formats.h"
#include "io/parts/names.h"
#include "io/parts/shapes.h"
#include "io/tabletop/scenes.h"
#include "io/tabletop/tabletop.h"
#include "map/source.h"

#include <math.h>

/// What stops sight, and sound. Files older than version 9 say it in "sense" by 0, 1 and 2.
enum { SIGHT_NONE = 0, SENSE_NORMAL = 1, SENSE_LIMITED = 2, SIGHT_LIMITED = 10, SIGHT_NORMAL = 20 };
enum { SIGHT_NEAR = 30, SIGHT_FAR = 40, ODD_MOST = 1000000 };
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
    sli_door_names names;
    size_t limited;                           ///< walls that limit sight
    size_t unseen, one_limited, near, points; ///< left out, or open to sight
    size_t near_sound, glass_doors;           ///< likewise, to sound and to steps
    size_t one_sided_doors;                   ///< which stop both sides here
    size_t odd, first_odd;                    ///< values that no version has, the first item
    size_t high;                              ///< walls with a height
} foundry;

static const char *const layer_names[] = {"walls", "edge"};

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

static bool is_known(int64_t sense) {
    return sense == SIGHT_NONE || is_normal(sense) || is_limited(sense) || sense == SIGHT_NEAR ||
           sense == SIGHT_FAR;
}

/// What a wall does; SIGHT_NORMAL where it does not say. A value that no version of Foundry has is
/// counted.
static sl_status read_sense(foundry *reader, const sli_json *sense, const record *wall,
                            int64_t *out) {
    SL_TRY(sli_json_whole_if(sense, -ODD_MOST, ODD_MOST, out));
    if (is_known(*out)) return SL_OK;
    if (!reader->odd++) reader->first_odd = wall->item;
    return SL_OK;
}

/// Sound and steps: what is no number says nothing.
static sl_status read_other_sense(foundry *reader, const sli_json *wall, const char *key,
                                  const record *read, int64_t *out) {
    const sli_json sense = sli_json_member(wall, key);
    return json_is_number(sense.value) ? read_sense(reader, &sense, read, out) : SL_OK;
}

static sl_status read_stops(foundry *reader, const sli_json *wall, record *read) {
    const sli_json sight = sli_json_member(wall, "sight"), sense = sli_json_member(wall, "sense");
    int64_t steps = SIGHT_NORMAL, heard = SIGHT_NORMAL;
    SL_TRY(read_sense(reader, sight.value ? &sight : &sense, read, &read->sight));
    SL_TRY(read_other_sense(reader, wall, "move", read, &steps));
    SL_TRY(read_other_sense(reader, wall, "sound", read, &heard));
    reader->near_sound += heard != SIGHT_NONE && !is_normal(heard);
    read->stops = (is_normal(read->sight) ? SL_STOPS_SIGHT : 0u) |
                  (is_limited(read->sight) ? SL_STOPS_LIMITED : 0u) |
                  (steps != SIGHT_NONE ? SL_STOPS_STEPS : 0u) |
                  (is_normal(heard) ? SL_STOPS_SOUND : 0u);
    return SL_OK;
}

/// Whether a module says how high a wall is (Wall Height, Levels): the scene has several floors.
static bool has_height(const sli_json *flags) {
    static const char *const names[] = {"wall-height", "wallHeight"};
    static const char *const keys[] = {"top", "bottom", "wallHeightTop", "wallHeightBottom"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const sli_json height = sli_json_member(flags, names[i]);
        for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
            if (json_is_number(sli_json_member(&height, keys[k]).value)) return true;
    }
    return false;
}

static sl_status read_record(foundry *reader, const sli_json *wall, record *read) {
    SL_TRY(sli_json_object(wall));
    SL_TRY(read_ends(reader, wall, &read->at));
    const sli_json side = sli_json_member(wall, "dir"), door = sli_json_member(wall, "door");
    const sli_json state = sli_json_member(wall, "ds");
    SL_TRY(read_stops(reader, wall, read));
    SL_TRY(sli_json_whole_if(&side, 0, RIGHT_ONLY, &read->side));
    SL_TRY(sli_json_whole_if(&door, 0, DOOR_SECRET, &read->door));
    SL_TRY(sli_json_whole_if(&state, 0, DOOR_LOCKED, &read->state));
    const sli_json flags = sli_json_member(wall, "flags");
    const sli_json own = sli_json_member(&flags, "sightline");
    reader->high += has_height(&flags);
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

static sl_status add_door(foundry *reader, const sli_json *json, const record *wall) {
    const bool open = wall->state == DOOR_OPEN;
    *(open ? &reader->open : &reader->shut) += 1;
    reader->secret += wall->door == DOOR_SECRET;
    reader->one_sided_doors += wall->side != BOTH_SIDES;
    char made[32];
    const char *name = sli_name_of_door(&reader->names, json, made);
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

/// What a wall's kind leaves of what it stops: nothing that is seen is hidden, and doors are
/// passed.
static void settle_stops(foundry *reader, record *wall) {
    const bool is_door = wall->door != DOOR_NONE;
    if (wall->side) wall->stops &= SL_STOPS_ALL; // it limits sight one way: open to it
    if (wall->side && is_limited(wall->sight))
        reader->one_limited++;
    else if (wall->sight != SIGHT_NONE && !is_normal(wall->sight) && !is_limited(wall->sight))
        reader->near++;
    else if (!wall->stops)
        reader->unseen++;
    if (!is_door || wall->stops & SL_STOPS_SIGHT || !wall->stops) return;
    reader->glass_doors++;
    wall->stops = wall->state == DOOR_OPEN ? 0 : wall->stops & ~(uint32_t)SL_STOPS_STEPS;
}

static sl_status take(foundry *reader, const sli_json *json, record *wall) {
    if (sli_same_point(wall->at.a, wall->at.b)) {
        reader->points++;
        return SL_OK;
    }
    if (wall->seam) return add_glass(reader, wall);
    settle_stops(reader, wall);
    if (!wall->stops) return SL_OK;
    if (wall->mirror) return add_glass(reader, wall);
    if (wall->door != DOOR_NONE && wall->stops & SL_STOPS_SIGHT)
        return add_door(reader, json, wall);
    if (wall->stops == SL_STOPS_ALL || (wall->side && wall->stops & SL_STOPS_SIGHT))
        return add_wall(reader, wall);
    return add_partial(reader, wall);
}

/// The largest y of all walls in the file becomes the top, if all are in range below it.
static sl_status find_top(foundry *reader, const sli_json *walls, size_t count) {
    double top = -HUGE_VAL, least = HUGE_VAL;
    reader->top = 0;
    for (int turn = 0; turn < 2; turn++) {
        for (size_t i = 0; i < count; i++) {
            const sli_json wall = sli_json_item(walls, i);
            sl_segment at;
            SL_TRY(sli_json_object(&wall));
            SL_TRY(read_ends(reader, &wall, &at));
            top = turn ? top : fmax(top, fmax(-at.a.y, -at.b.y));
            least = turn ? least : fmin(least, fmin(-at.a.y, -at.b.y));
        }
        reader->top = count ? top + 0.0 : 0;
        if (!count || sl_coordinate_usable(sli_coordinate(top - least))) break;
    }
    return SL_OK;
}

static sl_status read_walls(foundry *reader, const sli_json *walls, size_t count) {
    reader->sum = 0;
    reader->names = sli_door_names_of(walls, true);
    reader->map->source.lines_are_items = true;
    if (reader->pixels == 1) strcpy(reader->map->unit, "px");
    for (size_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(reader->context));
        const sli_json wall = sli_json_item(walls, i);
        record read = {.sight = SIGHT_NORMAL, .item = (uint32_t)i + 1};
        SL_TRY(read_record(reader, &wall, &read));
        SL_TRY(name_wall(reader, &wall, &read));
        SL_TRY(take(reader, &wall, &read));
    }
    reader->map->precision =
        sli_marked_precision(reader->map, reader->finest, reader->mark, reader->sum);
    return SL_OK;
}

/// What is in doubt.
static void tell_doubts(const foundry *reader, const char *file) {
    if (reader->odd)
        sl_note(reader->context,
                "%s: %zu value%s of sight, move or sound that Foundry does not have, first in "
                "walls[%zu]: open to sight and sound, shut to steps",
                file, reader->odd, reader->odd == 1 ? "" : "s", reader->first_odd - 1);
    if (reader->high)
        sl_note(reader->context,
                "%s: %zu wall%s of a certain height: all floors of the scene lie on each other",
                file, reader->high, reader->high == 1 ? " is" : "s are");
    if (reader->one_sided_doors)
        sl_note(reader->context, "%s: %zu door%s on one side only; shut, %s both sides here", file,
                reader->one_sided_doors, reader->one_sided_doors == 1 ? " works" : "s work",
                reader->one_sided_doors == 1 ? "it stops" : "they stop");
}

static void tell_walls(const foundry *reader, const char *file) {
    char top[SL_NUMBER_TEXT], unit[SL_NUMBER_TEXT + 16] = "pixels", pixels[SL_NUMBER_TEXT];
    sl_number_write(reader->top, top);
    sl_number_write(reader->pixels, pixels);
    if (reader->pixels != 1) snprintf(unit, sizeof unit, "%s pixels", pixels);
    const bool any = reader->walls || reader->partial || reader->shut || reader->open;
    const sli_tally taken[] = {
        {reader->walls, "wall", "walls"},
        {reader->partial, "wall that does not stop all", "walls that do not stop all"},
        {reader->limited, "of them limits sight", "of them limit sight"},
        {reader->oneways, "of them one-way", "of them one-way"},
        {reader->shut, "shut door", "shut doors"},
        {reader->open, "open door", "open doors"},
        {reader->secret, "of them secret", "of them secret"}};
    const sli_tally left[] = {
        {reader->unseen, "that stops nothing", "that stop nothing"},
        {reader->one_limited, "that limits sight from one side", "that limit sight from one side"},
        {reader->near, "that stops sight by distance", "that stop sight by distance"},
        {reader->near_sound, "that limits sound or stops it by distance",
         "that limit sound or stop it by distance"},
        {reader->glass_doors, "door that is seen through", "doors that are seen through"},
        {reader->points, "of no length", "of no length"}};
    char with[SLI_TALLY_TEXT], without[SLI_TALLY_TEXT];
    sl_note(reader->context, "%s: %s%s%s; unit: %s, y = %s - the file's y", file,
            any ? "" : "no walls", sli_tally_write("", taken, sizeof taken / sizeof *taken, with),
            sli_tally_write("; left out or open: ", left, sizeof left / sizeof *left, without),
            unit, top);
    if (reader->mirrors || reader->seams)
        sl_note(reader->context, "%s: taken by their flags: %zu mirror%s, %zu seam%s", file,
                reader->mirrors, reader->mirrors == 1 ? "" : "s", reader->seams,
                reader->seams == 1 ? "" : "s");
    tell_doubts(reader, file);
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

/// The side of a square: the scene's grid is a number, or an object with its size.
static sl_status read_square(const sli_json *root, double *square) {
    const sli_json grid = sli_json_member(root, "grid"), size = sli_json_member(&grid, "size");
    *square = 100;
    if (!json_is_number(grid.value) && !size.value) return SL_OK;
    return sli_json_number(size.value ? &size : &grid, square);
}

static sl_status read_tokens(foundry *reader, const sli_json *root, sli_things *things) {
    const sli_json tokens = sli_json_member(root, "tokens");
    double square;
    SL_TRY(read_square(root, &square));
    for (size_t i = 0; i < json_array_size(tokens.value); i++) {
        const sli_json token = sli_json_item(&tokens, i);
        SL_TRY(read_token(things, &token, square, reader->pixels));
    }
    return SL_OK;
}

// --- the scene's size

static double number_in(const sli_json *root, const char *object, const char *key) {
    const sli_json within = sli_json_member(root, object);
    const sli_json number = sli_json_member(object ? &within : root, key);
    return sli_json_number_or_0(&number);
}

/// The page, from y 0 of the file down: as large as the scene.
static void read_page(foundry *reader, const sli_json *root) {
    const sl_point size = {number_in(root, NULL, "width"), number_in(root, NULL, "height")};
    reader->map->source.page = (sl_box){{0, reader->top - size.y / reader->pixels},
                                        {size.x / reader->pixels, reader->top}};
    reader->map->source.pixels = reader->pixels;
}

/// Where the scene lies on its canvas, which is larger by a share of the scene, in whole squares;
/// where the map has y 0 at the file's. Foundry 12 pads a scene without a grid by whole pixels.
static sl_box scene_with(const sli_json *root, double padding, double pixels) {
    const sl_point size = {number_in(root, NULL, "width"), number_in(root, NULL, "height")};
    const sli_json grid = sli_json_member(root, "grid"), style = sli_json_member(&grid, "style");
    const sli_json old = sli_json_member(root, "gridType"), type = sli_json_member(&grid, "type");
    const sli_json kind = type.value ? type : old;
    const bool whole =
        json_is_integer(kind.value) && json_integer_value(kind.value) == 0 && style.value != NULL;
    double square;
    if (read_square(root, &square) != SL_OK || !(square > 0) || whole) square = 1;
    const double x = ceil(padding * size.x / square) * square -
                     number_in(root, "background", "offsetX") - number_in(root, NULL, "shiftX");
    const double y = ceil(padding * size.y / square) * square -
                     number_in(root, "background", "offsetY") - number_in(root, NULL, "shiftY");
    return (sl_box){{x / pixels, -(y + size.y) / pixels}, {(x + size.x) / pixels, -y / pixels}};
}

/// A scene that does not say its padding has the usual one, or none: where its walls are.
static sl_box find_scene(const foundry *reader, const sli_json *root) {
    const sli_json padding = sli_json_member(root, "padding");
    const double usual = 0.25;
    size_t all;
    const sl_box bare = scene_with(root, sli_json_number_or_0(&padding), reader->pixels);
    const sl_box padded = scene_with(root, usual, reader->pixels);
    if (padding.value) return bare;
    return sli_edge_holds(reader->map, padded, &all) > sli_edge_holds(reader->map, bare, &all)
               ? padded
               : bare;
}

// --- the whole

/// Reads the walls again, below the right top.
static sl_status read_below(foundry *reader, const sli_json *walls, size_t count, double top) {
    const double range = reader->map->range;
    sl_map_destroy(reader->context, reader->map);
    reader->map->range = range;
    *reader = (foundry){.context = reader->context,
                        .options = reader->options,
                        .map = reader->map,
                        .top = top,
                        .mark = reader->mark,
                        .pixels = reader->pixels,
                        .top_told = reader->top_told};
    return read_walls(reader, walls, count);
}

/// Finds the edge of a map that has y 0 at the file's, and then gives the lowest wall y 0.
static sl_status find_edge(foundry *reader, const sli_json *root, double lowest, bool asked,
                           sli_things *things, sli_edge *edge) {
    bool usable = true;
    edge->box = find_scene(reader, root);
    edge->asked = asked;
    SL_TRY(sli_edge_find(edge, reader->map, things));
    for (size_t i = 0; i < edge->pieces.count; i++)
        lowest = fmax(lowest, fmax(-edge->pieces.items[i].a.y, -edge->pieces.items[i].b.y));
    for (size_t i = 0; i < edge->pieces.count; i++) {
        sl_segment *piece = &edge->pieces.items[i];
        piece->a.y = sli_coordinate(lowest + piece->a.y);
        piece->b.y = sli_coordinate(lowest + piece->b.y);
        usable &= sl_coordinate_usable(piece->a.y) && sl_coordinate_usable(piece->b.y);
    }
    things->top = lowest;
    return usable ? SL_OK : sli_json_fail(root, "its edge is out of range once y points up");
}

static sl_status read_rest(foundry *reader, const sli_json *root, const sli_json *walls,
                           sli_things *things, sli_edge *edge) {
    const char *const layers = reader->options->layers;
    const sli_json flags = sli_json_member(root, "flags");
    const bool asked = layers && sli_layers_have(layers, "edge");
    const bool finds = asked || (!layers && !sli_json_member(&flags, "sightline").value);
    size_t count;
    SL_TRY(sli_json_array(walls, &count));
    if (layers && !sli_layers_have(layers, "walls")) count = 0;
    if (!reader->top_told) SL_TRY(find_top(reader, walls, count));
    const double lowest = reader->top;
    if (finds) reader->top = 0;
    SL_TRY(read_walls(reader, walls, count));
    things->top = reader->top;
    SL_TRY(read_tokens(reader, root, things));
    if (finds) SL_TRY(find_edge(reader, root, lowest, asked, things, edge));
    if (things->top != reader->top) SL_TRY(read_below(reader, walls, count, things->top));
    tell_walls(reader, root->file->name);
    SL_TRY(sli_edge_add(edge, reader->map, (uint32_t)json_array_size(walls->value) + 1));
    reader->map->source.transform = sli_y_down(reader->top, reader->pixels);
    read_page(reader, root);
    return sli_things_finish(things, reader->map);
}

/// A scene, or a list of walls alone.
static sl_status read_scene(foundry *reader, const sli_json *root) {
    const bool alone = json_is_array(root->value);
    if (!alone) SL_TRY(sli_json_object(root));
    const sli_json walls = sli_json_member(root, "walls");
    const sli_json flags = sli_json_member(root, "flags");
    const sli_json own = sli_json_member(&flags, "sightline"), y0 = sli_json_member(&own, "y0");
    const sli_json pixels = sli_json_member(&own, "pixels");
    const char *const file = root->file->name;
    sli_things things = {.context = reader->context, .file = file, .options = reader->options};
    sli_edge edge = {.context = reader->context, .file = file, .off = "walls", .all = "walls,edge"};
    reader->top_told = y0.value != NULL;
    SL_TRY(sli_json_number_if(&pixels, &reader->pixels));
    if (!(reader->pixels > 0)) return sli_json_fail(&pixels, "expected a number greater than 0");
    SL_TRY(sli_tabletop_own(&own, &reader->top, &reader->mark, reader->map));
    const sl_status status = read_rest(reader, root, alone ? root : &walls, &things, &edge);
    sli_things_destroy(&things);
    sli_edge_destroy(&edge);
    return status;
}

/// The scene that is asked for; else the first.
static json_t *scene_of(const sli_scenes *scenes, const char *name) {
    for (size_t i = 0; name && i < scenes->items.count; i++)
        if (strcmp(scenes->items.items[i].name, name) == 0) return scenes->items.items[i].json;
    return scenes->items.items[0].json;
}

sl_status sli_map_read_foundry(sl_context *context, const char *name, const char *text, size_t size,
                               const sl_import_options *options, sl_map *map) {
    sli_scenes scenes;
    SL_TRY(sli_layers_check(context, name, options->layers, layer_names,
                            sizeof layer_names / sizeof *layer_names));
    SL_TRY(sli_scenes_open(context, name, text, size, &scenes));
    sl_map read = {0};
    foundry reader = {.context = context, .options = options, .map = &read, .pixels = 1};
    const sli_json root = {.file = &scenes.file, .value = scene_of(&scenes, options->map)};
    const sl_status status = read_scene(&reader, &root);
    sli_scenes_tell(&scenes);
    sli_scenes_close(&scenes);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

sl_status sli_map_list_foundry(sl_context *context, const char *name, const char *text, size_t size,
                               sl_map_list *list) {
    sli_scenes scenes;
    SL_TRY(sli_scenes_open(context, name, text, size, &scenes));
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < scenes.items.count; i++) {
        const char *scene = scenes.items.items[i].name;
        status = sl_map_list_add(context, list, scene, strlen(scene));
    }
    sli_scenes_close(&scenes);
    if (status != SL_OK) sl_map_list_destroy(context, list);
    return status;
}
