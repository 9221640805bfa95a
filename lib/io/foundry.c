// Foundry Virtual Tabletop: a scene as it is exported, JSON with a list of walls. A wall has its
// two ends "c", what it does to "sight", a side "dir" that it works on, a kind of "door" and the
// door's state "ds" (Foundry's API, WallData).
#include "io/json.h"
#include "map/scan.h"
#include "sightline/io.h"

#include <math.h>

/// What stops sight. Files older than version 9 say it in "sense" by 0, 1 and 2.
enum { SIGHT_NONE = 0, SENSE_NORMAL = 1, SENSE_LIMITED = 2, SIGHT_LIMITED = 10, SIGHT_NORMAL = 20 };
enum { SIGHT_MOST = 40 };
enum { BOTH_SIDES, LEFT_ONLY, RIGHT_ONLY };
enum { DOOR_NONE, DOOR_PLAIN, DOOR_SECRET };
enum { DOOR_CLOSED, DOOR_OPEN, DOOR_LOCKED };

typedef struct foundry {
    sl_context *context;
    const sl_import_options *options;
    sl_map *map;
    double top; ///< the file's y that is 0 in the map, which has y up: the largest of any wall
    size_t walls, oneways, open, shut, secret;
    size_t unseen, limited, near, points; ///< left out
} foundry;

typedef struct record {
    sl_segment at;
    int64_t sight, side, door, state;
} record;

static sl_status read_ends(const foundry *reader, const sl_json *wall, sl_segment *at) {
    const sl_json c = sl_json_member(wall, "c");
    size_t count;
    SL_TRY(sl_json_array(&c, &count));
    if (count != 4) return sl_json_fail(&c, "expected 4 numbers: x0, y0, x1, y1; found %zu", count);
    double values[4];
    for (size_t i = 0; i < 4; i++) {
        const sl_json number = sl_json_item(&c, i);
        SL_TRY(sl_json_number(&number, &values[i]));
    }
    *at = (sl_segment){{values[0], reader->top - values[1]}, {values[2], reader->top - values[3]}};
    if (!sl_coordinate_usable(at->a.y) || !sl_coordinate_usable(at->b.y))
        return sl_json_fail(&c, "out of range once y points up");
    return SL_OK;
}

static sl_status read_record(const foundry *reader, const sl_json *wall, record *read) {
    SL_TRY(sl_json_object(wall));
    SL_TRY(read_ends(reader, wall, &read->at));
    const sl_json sight = sl_json_member(wall, "sight"), sense = sl_json_member(wall, "sense");
    const sl_json side = sl_json_member(wall, "dir"), door = sl_json_member(wall, "door");
    const sl_json state = sl_json_member(wall, "ds");
    SL_TRY(sl_json_whole_if(sight.value ? &sight : &sense, 0, SIGHT_MOST, &read->sight));
    SL_TRY(sl_json_whole_if(&side, 0, RIGHT_ONLY, &read->side));
    SL_TRY(sl_json_whole_if(&door, 0, DOOR_SECRET, &read->door));
    return sl_json_whole_if(&state, 0, DOOR_LOCKED, &read->state);
}

/// Seen through from where it does not work: a wall for those on its left is passed from its right.
/// Foundry's left is the eye's left on its screen, going from the first end to the second; turning
/// y up leaves the picture as it is.
static sl_status add_wall(foundry *reader, const record *wall) {
    sl_segment at = wall->at;
    if (wall->side == BOTH_SIDES) {
        reader->walls++;
        return sl_map_add_wall(reader->context, reader->map, at.a, at.b, 0);
    }
    if (wall->side == RIGHT_ONLY) at = (sl_segment){at.b, at.a};
    reader->oneways++;
    return sl_map_add_oneway(reader->context, reader->map, at, 0);
}

static sl_status add_door(foundry *reader, const record *wall) {
    const bool open = wall->state == DOOR_OPEN;
    *(open ? &reader->open : &reader->shut) += 1;
    reader->secret += wall->door == DOOR_SECRET;
    if (!reader->options->doors) {
        if (open) return SL_OK;
        SL_TRY(add_wall(reader, wall));
        *(wall->side == BOTH_SIDES ? &reader->walls : &reader->oneways) -= 1;
        return SL_OK;
    }
    char name[32];
    snprintf(name, sizeof name, "door%zu", reader->map->door_count + 1);
    return sl_map_add_door(reader->context, reader->map, name, wall->at, open, 0);
}

static sl_status take(foundry *reader, const record *wall) {
    const sl_segment at = wall->at;
    size_t *left_out = NULL;
    if (at.a.x == at.b.x && at.a.y == at.b.y)
        left_out = &reader->points;
    else if (wall->sight == SIGHT_NONE)
        left_out = &reader->unseen;
    else if (wall->sight == SIGHT_LIMITED || wall->sight == SENSE_LIMITED)
        left_out = &reader->limited;
    else if (wall->sight != SIGHT_NORMAL && wall->sight != SENSE_NORMAL)
        left_out = &reader->near;
    if (left_out) {
        ++*left_out;
        return SL_OK;
    }
    return wall->door == DOOR_NONE ? add_wall(reader, wall) : add_door(reader, wall);
}

/// The largest y of all walls, as the file has it.
static sl_status find_top(foundry *reader, const sl_json *walls, size_t count) {
    double top = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        const sl_json wall = sl_json_item(walls, i);
        sl_segment at;
        SL_TRY(sl_json_object(&wall));
        SL_TRY(read_ends(reader, &wall, &at));
        top = fmax(top, fmax(-at.a.y, -at.b.y));
    }
    reader->top = count ? top : 0;
    return SL_OK;
}

static sl_status read_walls(foundry *reader, const sl_json *walls) {
    size_t count;
    SL_TRY(sl_json_array(walls, &count));
    SL_TRY(find_top(reader, walls, count));
    for (size_t i = 0; i < count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(reader->context));
        const sl_json wall = sl_json_item(walls, i);
        record read = {.sight = SIGHT_NORMAL};
        SL_TRY(read_record(reader, &wall, &read));
        SL_TRY(take(reader, &read));
    }
    char top[SL_NUMBER_TEXT];
    sl_number_write(reader->top, top);
    sl_note(reader->context,
            "%s: %zu walls, %zu one-way; doors: %zu shut, taken as %s, %zu open, %s (%zu of all "
            "secret); left out: %zu that do not stop sight, %zu that stop it only behind another, "
            "%zu that stop it by distance, %zu of no length; unit: pixels, y = %s - the file's y",
            walls->file->name, reader->walls, reader->oneways, reader->shut,
            reader->options->doors ? "doors" : "walls", reader->open,
            reader->options->doors ? "taken as doors" : "left out", reader->secret, reader->unseen,
            reader->limited, reader->near, reader->points, top);
    return SL_OK;
}

/// A scene, or a list of walls alone.
static sl_status read_file(foundry *reader, const sl_json *root) {
    if (json_is_array(root->value)) return read_walls(reader, root);
    SL_TRY(sl_json_object(root));
    const sl_json walls = sl_json_member(root, "walls");
    return read_walls(reader, &walls);
}

sl_status sl_map_read_foundry(sl_context *context, const char *name, const char *text, size_t size,
                              const sl_import_options *options, sl_map *map) {
    sl_json_file file;
    SL_TRY(sl_json_open(context, name, text, size, &file));
    sl_map read = {0};
    foundry reader = {.context = context, .options = options, .map = &read};
    const sl_json root = sl_json_root(&file);
    const sl_status status = read_file(&reader, &root);
    sl_json_close(&file);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}
