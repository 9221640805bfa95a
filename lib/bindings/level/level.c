/// The runtime header behind a handle that owns its memory.
#define SIGHTLINE_LEVEL_BUILDS
#include "sightline_level.h"

#define SL_RUNTIME_API static inline // some calls are not asked here
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include "runtime/sightline_runtime.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct sl_level {
    sl_runtime runtime;
    sl_runtime_transform transform;
    unsigned char *bytes;
    sl_runtime_state state;
    uint32_t *state_memory;
    const unsigned char *shut; ///< by door: of the state
    char **names;              ///< by door
    uint32_t *scratch;
    int32_t *cells;          ///< room for all
    double *points;          ///< an answer, which grows
    uint32_t room;           ///< of `points`, in numbers
    unsigned char *relevant; ///< an answer
    sl_runtime_boxes boxes;
    uint32_t *box_scratch; ///< NULL without boxes
    unsigned char *seen;   ///< by box
};

static _Thread_local const char *last_error = "no fault";

static void *fail(const char *why) {
    last_error = why;
    return NULL;
}

/// Room for at least one item; NULL if memory is short.
static void *room_for(size_t count, size_t size) {
    return calloc(count ? count : 1, size);
}

// --- opening

static void free_boxes(sl_level *level) {
    free(level->boxes.boxes);
    free(level->boxes.memory);
    free(level->box_scratch);
    free(level->seen);
    memset(&level->boxes, 0, sizeof level->boxes);
    level->box_scratch = NULL;
    level->seen = NULL;
}

void sl_level_close(sl_level *level) {
    if (!level) return;
    free_boxes(level);
    for (uint32_t i = 0; level->names && i < level->runtime.door_count; i++) free(level->names[i]);
    free(level->names);
    free(level->bytes);
    free(level->state_memory);
    free(level->scratch);
    free(level->cells);
    free(level->points);
    free(level->relevant);
    free(level);
}

static bool copy_doors(sl_level *level) {
    const sl_runtime *rt = &level->runtime;
    level->state_memory = room_for(sl_runtime_state_count(rt), sizeof *level->state_memory);
    level->names = room_for(rt->door_count, sizeof *level->names);
    if (!level->state_memory || !level->names) return false;
    sl_runtime_state_start(&level->state, rt, level->state_memory);
    level->shut = level->state.shut;
    for (uint32_t i = 0; i < rt->door_count; i++) {
        const sl_runtime_name name = sl_runtime_door_name(rt, i);
        level->names[i] = room_for((size_t)name.length + 1, 1);
        if (!level->names[i]) return false;
        memcpy(level->names[i], name.text, name.length);
    }
    return true;
}

/// Takes over the bytes.
static sl_level *open_own(unsigned char *bytes, size_t size) {
    sl_level *level = room_for(1, sizeof *level);
    if (!level) {
        free(bytes);
        return fail("out of memory");
    }
    level->bytes = bytes;
    const sl_runtime_status status = sl_runtime_open(bytes, size, &level->runtime);
    if (status != SL_RUNTIME_OK) {
        sl_level_close(level);
        return fail(sl_runtime_status_text(status));
    }
    level->transform.scale = 1;
    level->scratch = room_for(sl_runtime_scratch_count(&level->runtime), sizeof *level->scratch);
    level->cells = room_for(level->runtime.cell_count, sizeof *level->cells);
    if (level->scratch && level->cells && copy_doors(level)) return level;
    sl_level_close(level);
    return fail("out of memory");
}

sl_level *sl_level_open(const void *bytes, size_t size) {
    unsigned char *copy = room_for(size, 1);
    if (!copy) return fail("out of memory");
    if (bytes && size) memcpy(copy, bytes, size);
    return open_own(copy, bytes ? size : 0);
}

/// Reads a file to its end, for pipes too.
static unsigned char *read_file(FILE *file, size_t *size) {
    size_t room = 1 << 16;
    unsigned char *bytes = malloc(room);
    *size = 0;
    while (bytes) {
        *size += fread(bytes + *size, 1, room - *size, file);
        if (*size < room) break;
        unsigned char *more = realloc(bytes, room *= 2);
        if (!more) free(bytes);
        bytes = more;
    }
    if (!bytes) return fail("out of memory");
    if (!ferror(file)) return bytes;
    free(bytes);
    return fail("cannot be read");
}

sl_level *sl_level_open_file(const char *name) {
    FILE *file = fopen(name, "rb");
    if (!file) return fail("cannot be opened");
    size_t size;
    unsigned char *bytes = read_file(file, &size);
    fclose(file);
    return bytes ? open_own(bytes, size) : NULL;
}

const char *sl_level_error(void) {
    return last_error;
}

// --- coordinates

int32_t sl_level_use_file_coordinates(sl_level *level) {
    sl_runtime_transform of_file;
    if (!sl_runtime_map_transform(&level->runtime, &of_file)) return 0;
    level->transform = of_file;
    return 1;
}

void sl_level_use_coordinates(sl_level *level, double origin_x, double origin_y, double scale,
                              int32_t y_down) {
    level->transform = (sl_runtime_transform){origin_x, origin_y, scale, y_down != 0};
}

int32_t sl_level_y_is_down(const sl_level *level) {
    return level->transform.y_down;
}

/// A heading, there or in the map; 0 has no sign.
static double turned(const sl_level *level, double heading) {
    return level->transform.y_down ? 0 - heading : heading;
}

/// Turns the ends of a box, min x, min y, max x, max y, around where y points the other way.
static void order_box(const sl_level *level, double box[4]) {
    if (!level->transform.y_down) return;
    const double low = box[3];
    box[3] = box[1];
    box[1] = low;
}

// --- the map

int32_t sl_level_cell_count(const sl_level *level) {
    return (int32_t)level->runtime.cell_count;
}

void sl_level_bounds(const sl_level *level, double bounds[4]) {
    const sl_runtime *rt = &level->runtime;
    bounds[0] = rt->min_x;
    bounds[1] = rt->min_y;
    bounds[2] = rt->max_x;
    bounds[3] = rt->max_y;
    sl_runtime_from_map(&level->transform, bounds, 2);
    order_box(level, bounds);
}

/// Room for so many numbers in the level's answer; NULL if memory is short.
static double *answer(sl_level *level, size_t count) {
    if (count <= level->room) return level->points;
    if (count > UINT32_MAX) return NULL;
    double *points = realloc(level->points, count * sizeof *points);
    if (!points) return NULL;
    level->room = (uint32_t)count;
    return level->points = points;
}

static bool is_cell(const sl_level *level, int32_t cell) {
    return cell >= 0 && (uint32_t)cell < level->runtime.cell_count;
}

const double *sl_level_cell_corners(sl_level *level, int32_t cell, int32_t *count) {
    *count = 0;
    if (!is_cell(level, cell)) return NULL;
    const sl_runtime_cell at = sl_runtime_get_cell(&level->runtime, (uint32_t)cell);
    double *points = answer(level, 2 * (size_t)at.vertex_count);
    if (!points) return NULL;
    for (uint32_t i = 0; i < at.vertex_count; i++)
        sl_runtime_get_vertex(&level->runtime, at.first_vertex + i, &points[2 * i],
                              &points[2 * i + 1]);
    sl_runtime_from_map(&level->transform, points, at.vertex_count);
    *count = (int32_t)at.vertex_count;
    return points;
}

int32_t sl_level_is_solid(const sl_level *level, int32_t cell) {
    return is_cell(level, cell) && sl_runtime_is_solid(&level->runtime, (uint32_t)cell);
}

int32_t sl_level_start_count(const sl_level *level) {
    return (int32_t)sl_runtime_start_count(&level->runtime);
}

int32_t sl_level_start(const sl_level *level, int32_t number, double start[3]) {
    sl_runtime_viewpoint found;
    if (number < 0 || !sl_runtime_start(&level->runtime, (uint32_t)number, &found)) return 0;
    start[0] = found.x;
    start[1] = found.y;
    start[2] = turned(level, found.heading);
    sl_runtime_from_map(&level->transform, start, 1);
    return 1;
}

// --- doors

static bool is_door(const sl_level *level, int32_t door) {
    return door >= 0 && (uint32_t)door < level->runtime.door_count;
}

int32_t sl_level_door_count(const sl_level *level) {
    return (int32_t)level->runtime.door_count;
}

const char *sl_level_door_name(const sl_level *level, int32_t door) {
    return is_door(level, door) ? level->names[door] : NULL;
}

int32_t sl_level_find_door(const sl_level *level, const char *name, int32_t from) {
    for (int32_t i = from < 0 ? 0 : from; is_door(level, i); i++)
        if (strcmp(level->names[i], name) == 0) return i;
    return -1;
}

int32_t sl_level_door_kind(const sl_level *level, int32_t door) {
    return is_door(level, door) ? (int32_t)sl_runtime_get_door_kind(&level->runtime, (uint32_t)door)
                                : -1;
}

int32_t sl_level_set_door(sl_level *level, int32_t door, int32_t open) {
    return is_door(level, door) && sl_runtime_state_set_door(&level->state, (uint32_t)door, !open);
}

int32_t sl_level_settle(sl_level *level, int32_t portals) {
    return (int32_t)sl_runtime_settle(&level->state, portals > 0 ? (uint32_t)portals : 0);
}

int32_t sl_level_door_is_open(const sl_level *level, int32_t door) {
    return is_door(level, door) && !level->shut[door];
}

const double *sl_level_door_segments(sl_level *level, int32_t door, int32_t *count) {
    *count = 0;
    if (!is_door(level, door)) return NULL;
    const uint32_t found = sl_runtime_door_segments(&level->runtime, (uint32_t)door, NULL, 0);
    double *points = answer(level, 4 * (size_t)found);
    if (!points) return NULL;
    // A segment is four doubles, in the order of the answer.
    sl_runtime_door_segments(&level->runtime, (uint32_t)door, (sl_runtime_segment *)points, found);
    sl_runtime_from_map(&level->transform, points, 2 * found);
    *count = (int32_t)found;
    return points;
}

// --- questions

int32_t sl_level_locate(const sl_level *level, double x, double y) {
    double at[2] = {x, y};
    sl_runtime_to_map(&level->transform, at, 1);
    const uint32_t cell = sl_runtime_locate(&level->runtime, at[0], at[1]);
    return cell == SL_RUNTIME_NO_CELL ? -1 : (int32_t)cell;
}

int32_t sl_level_can_see(const sl_level *level, int32_t from, int32_t to) {
    if (!is_cell(level, from) || !is_cell(level, to)) return 0;
    if (!level->runtime.mirrors)
        return sl_runtime_state_can_see(&level->state, (uint32_t)from, (uint32_t)to);
    return sl_runtime_can_see_mirrored(&level->runtime, (uint32_t)from, (uint32_t)to, level->shut);
}

int32_t sl_level_sees(sl_level *level, double x0, double y0, double x1, double y1) {
    double ends[4] = {x0, y0, x1, y1};
    sl_runtime_to_map(&level->transform, ends, 2);
    return level->box_scratch
               ? sl_runtime_sees_past_boxes(&level->boxes, ends[0], ends[1], ends[2], ends[3],
                                            level->shut, 0, level->box_scratch)
               : sl_runtime_sees(&level->runtime, ends[0], ends[1], ends[2], ends[3], level->shut,
                                 0, level->scratch);
}

int32_t sl_level_can_walk(sl_level *level, double x0, double y0, double x1, double y1,
                          int32_t own) {
    double ends[4] = {x0, y0, x1, y1};
    sl_runtime_to_map(&level->transform, ends, 2);
    return level->box_scratch
               ? sl_runtime_can_walk_past_boxes(&level->boxes, ends[0], ends[1], ends[2], ends[3],
                                                level->shut,
                                                own < 0 ? SL_RUNTIME_NO_BOX : (uint32_t)own)
               : sl_runtime_can_walk(&level->runtime, ends[0], ends[1], ends[2], ends[3],
                                     level->shut);
}

int32_t sl_level_walk(sl_level *level, double x0, double y0, double x1, double y1, double radius,
                      int32_t own, double at[2]) {
    double ends[4] = {x0, y0, x1, y1};
    const sl_runtime_walker walker = {radius / level->transform.scale, level->shut,
                                      level->box_scratch ? &level->boxes : NULL,
                                      own < 0 ? SL_RUNTIME_NO_BOX : (uint32_t)own};
    sl_runtime_to_map(&level->transform, ends, 2);
    const bool comes = sl_runtime_walk(&level->runtime, &walker, ends[0], ends[1], ends[2], ends[3],
                                       level->scratch, &at[0], &at[1]);
    sl_runtime_from_map(&level->transform, at, 1);
    return comes;
}

/// Boxes of a list of numbers, in the map; NULL if memory is short.
static sl_runtime_box *boxes_of(const sl_level *level, const double *numbers, int32_t count) {
    sl_runtime_box *boxes = room_for(count > 0 ? (size_t)count : 0, sizeof *boxes);
    for (int32_t i = 0; boxes && i < count; i++) {
        double ends[4];
        memcpy(ends, numbers + 4 * (size_t)i, sizeof ends);
        sl_runtime_to_map(&level->transform, ends, 2);
        order_box(level, ends);
        boxes[i] = (sl_runtime_box){ends[0], ends[1], ends[2], ends[3], false};
    }
    return boxes;
}

const unsigned char *sl_level_relevant(sl_level *level, const double *players, int32_t player_count,
                                       double margin, const double *things, int32_t thing_count) {
    const uint32_t lookers = player_count > 0 ? (uint32_t)player_count : 0;
    const uint32_t seen = thing_count > 0 ? (uint32_t)thing_count : 0;
    sl_runtime_box *from = boxes_of(level, players, player_count);
    sl_runtime_box *to = boxes_of(level, things, thing_count);
    uint32_t *scratch = room_for(sl_runtime_relevant_count(&level->runtime, seen), sizeof *scratch);
    unsigned char *bits = room_for(lookers, (size_t)seen / 8 + 1);
    const bool fits = from && to && scratch && bits;
    if (fits)
        sl_runtime_relevant(&level->runtime, from, lookers, margin / level->transform.scale, to,
                            seen, level->shut, 0, scratch, bits);
    free(from);
    free(to);
    free(scratch);
    free(level->relevant);
    if (!fits) free(bits);
    return level->relevant = fits ? bits : NULL;
}

/// An eye with its view, in the map, and its range there.
typedef struct eye {
    sl_runtime_view view;
    double range;
} eye;

static eye eye_of(const sl_level *level, double x, double y, double heading, double fov,
                  double range) {
    const double degree = 3.14159265358979323846 / 180, angle = turned(level, heading) * degree;
    double at[2] = {x, y};
    sl_runtime_to_map(&level->transform, at, 1);
    return (eye){fov < 180 ? sl_runtime_view_toward(at[0], at[1], cos(angle), sin(angle),
                                                    tan(fmax(fov, 0) / 2 * degree))
                           : sl_runtime_view_all_round(at[0], at[1]),
                 range / level->transform.scale};
}

const int32_t *sl_level_look(sl_level *level, double x, double y, double heading, double fov,
                             double range, int32_t *count) {
    const eye e = eye_of(level, x, y, heading, fov, range);
    uint32_t *cells = (uint32_t *)level->cells;
    const uint32_t room = level->runtime.cell_count;
    *count =
        (int32_t)(level->box_scratch
                      ? sl_runtime_look_past_boxes(&level->boxes, &e.view, level->shut, e.range,
                                                   level->box_scratch, level->seen, cells, room)
                      : sl_runtime_look_past(&level->runtime, &e.view, level->shut, e.range,
                                             level->scratch, cells, room));
    return level->cells;
}

const double *sl_level_visible_polygon(sl_level *level, double x, double y, double heading,
                                       double fov, double range, int32_t *count) {
    const eye e = eye_of(level, x, y, heading, fov, range);
    uint32_t found = 0;
    *count = 0;
    for (bool fits = false; !fits;) {
        found = level->box_scratch
                    ? sl_runtime_visible_polygon_past_boxes(&level->boxes, &e.view, level->shut,
                                                            e.range, level->box_scratch,
                                                            level->points, level->room / 2)
                    : sl_runtime_visible_polygon(&level->runtime, &e.view, level->shut, e.range,
                                                 level->scratch, level->points, level->room / 2);
        fits = found <= level->room / 2;
        if (!fits && !answer(level, 2 * (size_t)found)) return NULL;
    }
    sl_runtime_from_map(&level->transform, level->points, found);
    *count = (int32_t)found;
    return level->points;
}

// --- boxes

/// Makes the lists of boxes anew, with room for so many pairs of a box and a cell.
static bool start_boxes(sl_level *level, uint32_t count, uint32_t pairs) {
    const size_t size = sl_runtime_boxes_count(&level->runtime, count, pairs);
    uint32_t *memory = room_for(size, sizeof *memory);
    sl_runtime_box *list = room_for(count, sizeof *list);
    if (!memory || !list) {
        free(memory);
        free(list);
        return false;
    }
    free(level->boxes.boxes);
    free(level->boxes.memory);
    sl_runtime_boxes_start(&level->boxes, &level->runtime, list, count, pairs, memory);
    return true;
}

int32_t sl_level_set_box_count(sl_level *level, int32_t count) {
    const uint32_t boxes = count > 0 ? (uint32_t)count : 0;
    free_boxes(level);
    if (!boxes) return 1;
    if (boxes > UINT32_MAX / 64 || !start_boxes(level, boxes, 8 * boxes)) return 0;
    level->box_scratch =
        room_for(sl_runtime_boxes_scratch_count(&level->boxes), sizeof *level->box_scratch);
    level->seen = room_for(boxes, 1);
    if (level->box_scratch && level->seen) return 1;
    free_boxes(level);
    return 0;
}

/// Twice the room for pairs, with all boxes where they are. False if memory is short.
static bool grow_boxes(sl_level *level) {
    const sl_runtime_boxes old = level->boxes;
    if (old.room > UINT32_MAX / 2) return false;
    memset(&level->boxes, 0, sizeof level->boxes);
    if (!start_boxes(level, old.count, 2 * old.room)) {
        level->boxes = old;
        return false;
    }
    for (uint32_t i = 0; i < old.count; i++) sl_runtime_boxes_move(&level->boxes, i, &old.boxes[i]);
    free(old.boxes);
    free(old.memory);
    return true;
}

void sl_level_move_box(sl_level *level, int32_t box, double min_x, double min_y, double max_x,
                       double max_y, int32_t blocks) {
    if (box < 0 || (uint32_t)box >= level->boxes.count) return;
    double ends[4] = {min_x, min_y, max_x, max_y};
    sl_runtime_to_map(&level->transform, ends, 2);
    order_box(level, ends);
    const sl_runtime_box to = {ends[0], ends[1], ends[2], ends[3], blocks != 0};
    // Without more memory the box counts as seen by every eye, which misses nothing.
    while (!sl_runtime_boxes_move(&level->boxes, (uint32_t)box, &to) && grow_boxes(level)) {
    }
}

const unsigned char *sl_level_boxes_seen(sl_level *level, double x, double y, double heading,
                                         double fov, double range, int32_t *count) {
    const eye e = eye_of(level, x, y, heading, fov, range);
    *count = (int32_t)level->boxes.count;
    if (!level->box_scratch) return NULL;
    sl_runtime_boxes_seen(&level->boxes, &e.view, level->shut, e.range, level->box_scratch,
                          level->seen);
    return level->seen;
}
