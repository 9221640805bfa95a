/// Plans for Python: a map in the making, read from a file or given by arrays.
#include "facade.h"
#include "sightline/io.h"
#include "sightline/version.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- what both handles have

static bool is_cancelled(void *user) {
    slp_base *base = user;
    return atomic_load(&base->cancelled) || (base->until > 0 && sl_seconds() > base->until);
}

/// Keeps a note as a line. Without memory it is lost, and nothing else.
static void keep_note(void *user, const char *message) {
    slp_base *base = user;
    const size_t length = strlen(message);
    if (SL_ARRAY_ROOM(base->context, &base->notes, length + 2) != SL_OK) return;
    memcpy(base->notes.items + base->notes.count, message, length);
    base->notes.count += length + 1;
    base->notes.items[base->notes.count - 1] = '\n';
    base->notes.items[base->notes.count] = '\0';
}

bool slp_base_begin(slp_base *base) {
    const sl_hooks hooks = {.user = base, .note = keep_note, .cancelled = is_cancelled};
    base->context = sl_context_create(&hooks);
    if (!base->context) return false;
    if (sl_io_use(base->context) == SL_OK) return true;
    sl_context_destroy(base->context);
    return false;
}

void slp_base_end(slp_base *base) {
    slp_lines_forget(base);
    sl_free(base->context, base->notes.items);
    sl_context_destroy(base->context);
}

const char *slp_version(void) {
    return sl_version();
}

const char *slp_message(const void *handle) {
    return sl_context_message(((const slp_base *)handle)->context);
}

const char *slp_notes(const void *handle) {
    const slp_base *base = handle;
    return base->notes.items ? base->notes.items : "";
}

void slp_cancel(void *handle, int cancelled) {
    atomic_store(&((slp_base *)handle)->cancelled, cancelled != 0);
}

// --- plans

slp_plan *slp_plan_new(void) {
    slp_plan *plan = calloc(1, sizeof *plan);
    if (!plan) return NULL;
    if (slp_base_begin(&plan->base)) return plan;
    free(plan);
    return NULL;
}

void slp_plan_free(slp_plan *plan) {
    if (!plan) return;
    sl_map_destroy(plan->base.context, &plan->map);
    slp_base_end(&plan->base);
    free(plan);
}

/// Also sets the limits of reading.
static sl_import_options import_options(sl_context *context, const slp_import *given) {
    sl_context_set_limits(context, &(sl_limits){.squares = given->max_squares,
                                                .pixels = given->max_pixels,
                                                .walls = given->max_walls,
                                                .entities = given->max_entities,
                                                .depth = given->max_depth});
    sl_import_options options = sl_import_options_default();
    options.map = given->map;
    options.layers = given->layers;
    options.start_names = given->start_names;
    options.unit = given->unit;
    options.has_slice = !isnan(given->slice);
    if (options.has_slice) options.slice = given->slice;
    options.tolerance = given->tolerance;
    options.entrance = given->entrance;
    options.threshold = given->threshold;
    options.doors = given->doors;
    options.sectors = given->sectors;
    options.cells = given->cells;
    options.planar = given->planar;
    options.degrees = given->degrees;
    options.has_crop = given->crop != NULL;
    if (given->crop)
        options.crop = (sl_box){{given->crop[0], given->crop[1]}, {given->crop[2], given->crop[3]}};
    return options;
}

int slp_plan_read(slp_plan *plan, const char *path, const slp_import *given) {
    const sl_import_options options = import_options(plan->base.context, given);
    return sl_map_read(plan->base.context, path, &options, &plan->map);
}

int slp_plan_parse(slp_plan *plan, const char *name, const char *text, size_t size,
                   const slp_import *given) {
    const sl_import_options options = import_options(plan->base.context, given);
    return sl_map_parse(plan->base.context, name, text, size, &options, &plan->map);
}

int slp_plan_write(slp_plan *plan, const char *path, const char *name) {
    const sl_map_format *format;
    SL_TRY(sl_map_format_to_write(plan->base.context, path, path, name, &format));
    return sl_map_write(plan->base.context, &plan->map, format, path);
}

static sl_status add_one(slp_plan *plan, const char *kind, const char *name, int open,
                         sl_segment at) {
    sl_context *context = plan->base.context;
    if (strcmp(kind, "wall") == 0) return sl_map_add_wall(context, &plan->map, at.a, at.b, 0);
    if (strcmp(kind, "door") == 0)
        return sl_map_add_door(context, &plan->map, name, at, open != 0, 0);
    if (strcmp(kind, "mirror") == 0) return sl_map_add_mirror(context, &plan->map, at, 0);
    if (strcmp(kind, "oneway") == 0) return sl_map_add_oneway(context, &plan->map, at, 0);
    if (strcmp(kind, "seam") == 0) return sl_map_add_seam(context, &plan->map, at, 0);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "there is no kind '%.40s'; kinds: wall, door, mirror, oneway, seam", kind);
}

int slp_plan_add(slp_plan *plan, const char *kind, const char *name, int open,
                 const double *segments, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const double *s = segments + 4 * i;
        SL_TRY(add_one(plan, kind, name, open, (sl_segment){{s[0], s[1]}, {s[2], s[3]}}));
    }
    return SL_OK;
}

int slp_plan_add_ground(slp_plan *plan, int solid, const double *corners, size_t count) {
    sl_point *points = sl_alloc_array(plan->base.context, count, sizeof *points);
    if (!points) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) points[i] = (sl_point){corners[2 * i], corners[2 * i + 1]};
    const sl_status status = (solid ? sl_map_add_solid : sl_map_add_open)(
        plan->base.context, &plan->map, points, count, 0);
    sl_free(plan->base.context, points);
    return status;
}

int slp_plan_add_start(slp_plan *plan, double x, double y, double heading) {
    return sl_map_add_start(plan->base.context, &plan->map, (sl_point){x, y}, heading, 0);
}

int slp_plan_set_range(slp_plan *plan, double range) {
    if (range != 0 && (!(range > 0) || !sl_coordinate_usable(range)))
        return sl_fail(plan->base.context, SL_BAD_ARGUMENT,
                       "the range must be 0 or more, and finite; 0: no limit");
    plan->map.range = range;
    return SL_OK;
}

double slp_plan_entrance(const slp_plan *plan) {
    return plan->map.entrance;
}

int slp_plan_set_entrance(slp_plan *plan, double width) {
    if (width < 0 || !sl_coordinate_usable(width))
        return sl_fail(
            plan->base.context, SL_BAD_ARGUMENT,
            "the entrance must be a number from %g to %g; 0: as the unit or the plan says",
            SL_COORDINATE_MIN, SL_COORDINATE_MAX);
    plan->map.entrance = width;
    plan->map.entrance_by_doors = false;
    return SL_OK;
}

int slp_plan_set_door(slp_plan *plan, const char *name, int open) {
    bool found = false;
    for (size_t i = 0; i < plan->map.door_count; i++) {
        if (strcmp(plan->map.doors[i].name, name) != 0) continue;
        plan->map.doors[i].open = open != 0;
        found = true;
    }
    if (found) return SL_OK;
    return sl_fail(plan->base.context, SL_BAD_ARGUMENT, "there is no door '%.64s'", name);
}

// --- what a map holds

static const sl_map *map_of(const void *handle, int is_level) {
    return is_level ? &((const slp_level *)handle)->baked.map : &((const slp_plan *)handle)->map;
}

static void put_row(double *rows, size_t i, sl_segment s) {
    if (!rows) return;
    double *row = rows + 4 * i;
    row[0] = s.a.x, row[1] = s.a.y, row[2] = s.b.x, row[3] = s.b.y;
}

static size_t put_walls(const sl_wall *walls, size_t count, double *rows) {
    for (size_t i = 0; i < count; i++) put_row(rows, i, (sl_segment){walls[i].a, walls[i].b});
    return count;
}

static size_t put_glass(const sl_glass *glass, size_t count, double *rows) {
    for (size_t i = 0; i < count; i++) put_row(rows, i, glass[i].segment);
    return count;
}

/// Those that stop nothing; others are windows, curtains and the like.
static size_t put_seams(const sl_map *map, double *rows) {
    size_t count = 0;
    for (size_t i = 0; i < map->seam_count; i++)
        if (!map->seams[i].stops) put_row(rows, count++, map->seams[i].segment);
    return count;
}

size_t slp_segments(const void *handle, int is_level, const char *kind, double *rows) {
    const sl_map *map = map_of(handle, is_level);
    if (strcmp(kind, "wall") == 0) {
        const sl_space *space = &((const slp_level *)handle)->baked.space;
        return is_level ? put_walls(space->walls, space->wall_count, rows)
                        : put_walls(map->walls, map->wall_count, rows);
    }
    if (strcmp(kind, "mirror") == 0) return put_glass(map->mirrors, map->mirror_count, rows);
    if (strcmp(kind, "oneway") == 0) return put_glass(map->oneways, map->oneway_count, rows);
    if (strcmp(kind, "seam") == 0) return put_seams(map, rows);
    if (strcmp(kind, "door") == 0) {
        for (size_t i = 0; i < map->door_count; i++) put_row(rows, i, map->doors[i].segment);
        return map->door_count;
    }
    if (strcmp(kind, "start") == 0) {
        for (size_t i = 0; i < map->start_count; i++)
            put_row(rows, i, (sl_segment){map->starts[i].at, {map->starts[i].heading, 0}});
        return map->start_count;
    }
    if (strcmp(kind, "object") != 0) return 0;
    for (size_t i = 0; i < map->object_count; i++)
        put_row(rows, i, (sl_segment){map->objects[i].box.min, map->objects[i].box.max});
    return map->object_count;
}

const char *slp_name(const void *handle, int is_level, const char *kind, size_t number) {
    const sl_map *map = map_of(handle, is_level);
    if (strcmp(kind, "door") == 0 && number < map->door_count) return map->doors[number].name;
    if (strcmp(kind, "object") == 0 && number < map->object_count) return map->objects[number].name;
    return NULL;
}

int slp_door_open(const void *handle, int is_level, size_t number) {
    const sl_map *map = map_of(handle, is_level);
    if (number >= map->door_count) return 0;
    return is_level ? !((const slp_level *)handle)->shut[number] : map->doors[number].open;
}

double slp_range(const void *handle, int is_level) {
    return is_level ? ((const slp_level *)handle)->range : map_of(handle, is_level)->range;
}

const char *slp_unit(const void *handle, int is_level) {
    return map_of(handle, is_level)->unit;
}

void slp_bounds(const void *handle, int is_level, double box[4]) {
    const sl_box b = is_level ? ((const slp_level *)handle)->baked.space.bounds
                              : sl_map_bounds(map_of(handle, is_level));
    box[0] = b.min.x, box[1] = b.min.y, box[2] = b.max.x, box[3] = b.max.y;
}

void slp_transform(const void *handle, int is_level, double values[4]) {
    const sl_transform t = map_of(handle, is_level)->source.transform;
    values[0] = t.origin.x, values[1] = t.origin.y, values[2] = t.scale, values[3] = t.y_down;
}
