/// The core library for JavaScript: each question of bake.js and scene.js is one function here, and
/// each of these asks the public headers. Nothing is decided here.
///
/// A scene is a baked map with what questions about it need. Functions that can fail return the
/// status (0: done) or, where they return a place, NULL. message() then says why. Arrays that a
/// function gives stay in the memory of the module, as views for JavaScript, until the next call
/// about the same scene. What the module has beside scenes is in module.c.
#include "bake/export.h"
#include "bindings/js/src/bindings.h"
#include "sightline/json.h"
#include "sightline/sightline.h"

#include <stdlib.h>
#include <string.h>

typedef struct scene {
    sl_baked baked;
    sl_bake_account account;
    sl_query *query;
    uint64_t *cells; ///< the last set of cells, as bits
    uint32_t *list;  ///< and as numbers
    sl_region region;
    sl_mirrored_region mirrored;
    sl_point *flat;
    size_t flat_room;
    sl_steps steps;
} scene;

/// Of the next bake.
static sl_bake_options bake_options;
/// Of the next map; 0: as it says.
static double entrance;

// --- options

static bool is(const char *a, const char *b) {
    return strcmp(a, b) == 0;
}

static sl_status find_method(const char *name, const sl_see_method **out) {
    *out = name[0] ? sl_see_method_named(name) : NULL;
    if (*out || !name[0]) return SL_OK;
    return sl_fail(sli_module.context, SL_BAD_ARGUMENT, "method: there is no method '%s'", name);
}

static sl_status find_subdivision(const char *name, const sl_subdivision **out) {
    size_t count;
    const sl_subdivision *all = sl_subdivisions(&count);
    *out = NULL;
    if (!name[0]) return SL_OK;
    for (size_t i = 0; i < count; i++)
        if (is(all[i].name, name)) *out = &all[i];
    if (*out) return SL_OK;
    return sl_fail(sli_module.context, SL_BAD_ARGUMENT, "subdivide: there is no way '%s'", name);
}

/// Options of the next bake. An empty name, and a number below 0, stand for the default. `width` is
/// that of entrances.
SLI_EXPORT(int, options, const char *method, const char *subdivide, int open_sight, int inside,
           int trees, int check, double weld, double mirror_depth, double door_limit,
           double samples, double seed, double width) {
    sl_bake_options *o = &bake_options;
    *o = sl_bake_options_default();
    o->see.threads = 1;
    if (!sli_done(find_method(method, &o->method))) return (int)sli_module.status;
    if (!sli_done(find_subdivision(subdivide, &o->subdivision))) return (int)sli_module.status;
    o->see.sight = open_sight ? SL_OPEN : SL_CLOSED;
    o->see.inside_only = inside;
    o->see.trees = trees;
    o->check = check;
    o->clean.weld = weld >= 0 ? weld : o->clean.weld;
    if (mirror_depth >= 0) o->mirror_depth = (uint32_t)mirror_depth;
    if (door_limit >= 0) o->door_limit = (uint32_t)door_limit;
    if (samples >= 0) o->see.samples = (uint32_t)samples;
    if (seed >= 0) o->see.seed = (uint64_t)seed;
    entrance = width;
    return SL_OK;
}

// --- maps

/// What is made of a map once it is read, as the options of the command.
static struct {
    bool has_start;
    sl_point start;
    uint32_t channel; ///< 0: sight
    unsigned without;
} reading;

static sl_status find_effects(const char *list, unsigned *out) {
    size_t count;
    const sl_effect *const *all = sl_effects(&count);
    for (size_t length, i; *list; list += length + (list[length] != '\0')) {
        length = strcspn(list, ",");
        for (i = 0; i < count; i++)
            if (strlen(all[i]->name) == length && memcmp(all[i]->name, list, length) == 0) break;
        if (i == count)
            return sl_fail(sli_module.context, SL_BAD_ARGUMENT,
                           "without: there is no effect '%.*s'", (int)(length < 40 ? length : 40),
                           list);
        *out |= 1u << i;
    }
    return SL_OK;
}

/// Options of the next maps that are read. `start` may be NULL; `stops`: 0 for sight, 1 for steps,
/// 2 for sound; `without`: names of effects with commas between.
SLI_EXPORT(int, map_options, const sl_point *start, int stops, const char *without) {
    memset(&reading, 0, sizeof reading);
    reading.has_start = start != NULL;
    if (start) reading.start = *start;
    reading.channel = stops ? UINT32_C(1) << stops : 0;
    sli_done(find_effects(without, &reading.without));
    return (int)sli_module.status;
}

static sl_status add_start(sl_map *map) {
    const sl_box b = sl_map_bounds(map);
    const sl_point at = reading.start;
    if (!reading.has_start) return SL_OK;
    if (at.x < b.min.x || at.x > b.max.x || at.y < b.min.y || at.y > b.max.y)
        return sl_fail(sli_module.context, SL_BAD_ARGUMENT, "start: outside the map");
    return sl_map_add_start(sli_module.context, map, at, 0, 0);
}

/// `name` is for messages, and its ending says what the text is.
static sl_status read_map(const char *name, const char *text, size_t size, sl_map *map) {
    const sl_subdivision *way = bake_options.subdivision;
    const sl_import_options import = {.cells = way && way->takes_cells, .entrance = entrance};
    SL_TRY(sl_map_parse(sli_module.context, name, text, size, &import, map));
    if (way && !way->takes_cells) sl_map_drop_cells(sli_module.context, map);
    SL_TRY(add_start(map));
    if (reading.channel) map->channel = reading.channel;
    sl_effects_leave_out(sli_module.context, map, reading.without);
    return SL_OK;
}

/// A map in the format of that name ("text", "plan"): see written().
SLI_EXPORT(int, map_write, const char *name, const char *text, size_t size, const char *format) {
    sl_map map = {0};
    sl_status status = read_map(name, text, size, &map);
    size_t count;
    const sl_map_format *formats = sl_map_formats(sli_module.context, &count);
    while (count && !is(format, formats[count - 1].name)) count--;
    sl_output output;
    if (status == SL_OK && !count)
        status = sl_fail(sli_module.context, SL_BAD_ARGUMENT, "format: there is no map format '%s'",
                         format);
    else if (status == SL_OK)
        status = sl_output_open(sli_module.context, "", &output);
    if (status == SL_OK)
        status = sl_output_close(sli_module.context, &output,
                                 formats[count - 1].write(sli_module.context, &map, output.stream));
    sl_map_destroy(sli_module.context, &map);
    return (int)(sli_module.status = status);
}

static void put_point(sl_json_writer *json, sl_point point) {
    sl_json_put_real(json, point.x);
    sl_json_put_real(json, point.y);
}

static void put_count(sl_json_writer *json, const char *key, uint32_t value) {
    sl_json_put_key(json, key);
    if (value == UINT32_MAX)
        sl_json_put_null(json);
    else
        sl_json_put_integer(json, value);
}

static void put_fault(sl_json_writer *json, const sl_map *map, const sl_faults *faults,
                      const sl_fault *fault) {
    sl_json_put_object(json);
    sl_json_put_key(json, "kind");
    sl_json_put_text(json, sl_fault_name(fault->kind));
    sl_json_put_key(json, "at");
    sl_json_put_list(json);
    put_point(json, fault->at.a);
    put_point(json, fault->at.b);
    sl_json_put_end(json, ']');
    sl_json_put_key(json, "size");
    sl_json_put_real(json, fault->size);
    sl_json_put_key(json, "lines");
    sl_json_put_list(json);
    for (int i = 0; i < 2; i++)
        if (fault->walls[i] != UINT32_MAX)
            sl_json_put_integer(json, map->walls[fault->walls[i]].line);
    sl_json_put_end(json, ']');
    put_count(json, "cell", fault->cell);
    put_count(json, "cells", fault->cells);
    sl_json_put_key(json, "needsDecision");
    sl_json_put_flag(json, fault->stays);
    sl_json_put_key(json, "way");
    sl_json_put_list(json);
    for (uint32_t i = 0; i < fault->point_count; i++)
        put_point(json, faults->points[fault->first_point + i]);
    sl_json_put_end(json, ']');
    sl_json_put_end(json, '}');
}

static sl_status print_faults(const sl_map *map, const sl_space *space, const sl_faults *faults,
                              sl_inside inside, const char *said) {
    static const char *const doubts[] = {"sure", "leaks", "small", "few", "none", "opening"};
    const sl_ground_shares shares = sl_space_ground(space);
    const double parts[] = {shares.inside, shares.outside, shares.solid};
    static const char *const names[] = {"inside", "outside", "solid"};
    sl_output output;
    SL_TRY(sl_output_open(sli_module.context, "", &output));
    sl_json_writer json = sl_json_writer_to(output.stream, 0);
    sl_json_put_object(&json);
    sl_json_put_key(&json, "doubt");
    sl_json_put_text(&json, doubts[inside]);
    sl_json_put_key(&json, "said");
    sl_json_put_text(&json, said);
    for (int i = 0; i < 3; i++) {
        sl_json_put_key(&json, names[i]);
        sl_json_put_real(&json, parts[i]);
    }
    sl_json_put_key(&json, "welded");
    sl_json_put_integer(&json, faults->welded);
    sl_json_put_key(&json, "faults");
    sl_json_put_list(&json);
    for (uint32_t i = 0; i < faults->count; i++) put_fault(&json, map, faults, &faults->items[i]);
    sl_json_put_end(&json, ']');
    sl_json_put_end(&json, '}');
    return sl_output_close(sli_module.context, &output, SL_OK);
}

static sl_status check_map(const sl_map *map, sl_baked *baked, sl_map *copy, sl_faults *faults,
                           double gap, double thin) {
    const sl_faults_options options = {.gap = gap, .thin = thin, .clean = &bake_options.clean};
    sl_bake_account account = {0};
    sl_inside inside;
    char said[SL_INSIDE_TEXT];
    SL_TRY(sl_map_copy(sli_module.context, map, copy));
    SL_TRY(sl_bake_space(sli_module.context, copy, &bake_options, baked, &account));
    SL_TRY(sl_find_faults(sli_module.context, map, &baked->space, &options, faults));
    SL_TRY(sl_doubt_inside(sli_module.context, &baked->map, &baked->space, &inside));
    SL_TRY(sl_say_inside(sli_module.context, &baked->map, &baked->space, said));
    return print_faults(map, &baked->space, faults, inside, said);
}

/// Faults of a map as JSON: see written().
SLI_EXPORT(int, map_check, const char *name, const char *text, size_t size, double gap,
           double thin) {
    sl_map map = {0}, copy = {0};
    sl_baked baked = {0};
    sl_faults faults = {0};
    sl_status status = read_map(name, text, size, &map);
    map.channel = SL_STOPS_STEPS; // a window keeps a room closed, a curtain does not
    if (status == SL_OK) status = sl_map_settle_stops(sli_module.context, &map, NULL);
    if (status == SL_OK) status = check_map(&map, &baked, &copy, &faults, gap, thin);
    sl_faults_destroy(sli_module.context, &faults);
    sl_baked_destroy(sli_module.context, &baked);
    sl_map_destroy(sli_module.context, &copy);
    sl_map_destroy(sli_module.context, &map);
    return (int)(sli_module.status = status);
}

// --- scenes

SLI_EXPORT(void, scene_close, scene *s) {
    if (!s) return;
    sl_query_destroy(sli_module.context, s->query);
    sl_region_destroy(sli_module.context, &s->region);
    sl_mirrored_region_destroy(sli_module.context, &s->mirrored);
    sl_steps_destroy(sli_module.context, &s->steps);
    sl_free(sli_module.context, s->flat);
    sl_free(sli_module.context, s->cells);
    sl_free(sli_module.context, s->list);
    sl_baked_destroy(sli_module.context, &s->baked);
    sl_free(sli_module.context, s);
}

/// What questions need, once the map is baked.
static sl_status equip(scene *s) {
    s->cells = sl_alloc_array(sli_module.context, sl_eye_words(&s->baked.space), sizeof *s->cells);
    s->list = sl_alloc_array(sli_module.context, s->baked.space.cell_count, sizeof *s->list);
    if (!s->cells || !s->list) return SL_NO_MEMORY;
    return sl_query_create(sli_module.context, &s->baked, &s->query);
}

static sl_status bake_text(scene *s, const char *name, const char *text, size_t size) {
    sl_map map = {0};
    sl_status status = read_map(name, text, size, &map);
    if (status == SL_OK)
        status = sl_bake(sli_module.context, &map, &bake_options, &s->baked, &s->account);
    sl_map_destroy(sli_module.context, &map);
    return status;
}

/// Closes a scene that could not be made; keeps the message.
static scene *finish(scene *s, sl_status status) {
    if (status == SL_OK) status = equip(s);
    if (sli_done(status)) return s;
    scene_close(s);
    return NULL;
}

/// Bakes a map by the options.
SLI_EXPORT(scene *, scene_bake, const char *name, const char *text, size_t size) {
    scene *s = sl_alloc_array(sli_module.context, 1, sizeof *s);
    if (!s) return finish(s, SL_NO_MEMORY);
    return finish(s, bake_text(s, name, text, size));
}

/// Opens the bytes of a baked file.
SLI_EXPORT(scene *, scene_open, const char *name, const char *bytes, size_t size) {
    scene *s = sl_alloc_array(sli_module.context, 1, sizeof *s);
    if (!s) return finish(s, SL_NO_MEMORY);
    return finish(s, sl_baked_parse(sli_module.context, name, bytes, size, &s->baked));
}

/// The baked file: see written().
SLI_EXPORT(int, scene_write, scene *s) {
    return (int)(sli_module.status = sl_baked_write(sli_module.context, &s->baked, ""));
}

/// What is inside, for people, where that is not plain: see written().
SLI_EXPORT(int, scene_inside, scene *s) {
    char said[SL_INSIDE_TEXT];
    sl_output output;
    sl_status status = sl_say_inside(sli_module.context, &s->baked.map, &s->baked.space, said);
    if (status == SL_OK) status = sl_output_open(sli_module.context, "", &output);
    if (status == SL_OK) {
        fputs(said, output.stream);
        status = sl_output_close(sli_module.context, &output, SL_OK);
    }
    return (int)(sli_module.status = status);
}

/// An export by its name: see written(). The table of all exports is not asked: it would bring the
/// C export, which is text for a compiler.
SLI_EXPORT(int, scene_export, scene *s, const char *format, double version) {
    const sl_export_options options = {.json_version = (uint32_t)version};
    if (is(format, "json"))
        sli_module.status = sli_export_json(sli_module.context, &s->baked, &options, "");
    else if (is(format, "geojson"))
        sli_module.status = sli_export_geojson(sli_module.context, &s->baked, &options, "");
    else if (is(format, "csv"))
        sli_module.status = sli_export_csv(sli_module.context, &s->baked, &options, "");
    else
        sli_module.status =
            sl_fail(sli_module.context, SL_BAD_ARGUMENT, "format: there is no export '%s'", format);
    return (int)sli_module.status;
}

/// integers: counts and places of the arrays, as core.js names them; numbers: bounds, range.
SLI_EXPORT(void, scene_describe, const scene *s) {
    const sl_space *space = &s->baked.space;
    const sl_map *map = &s->baked.map;
    const uint32_t table[] = {space->cell_count,
                              (uint32_t)(uintptr_t)space->cells,
                              space->vertex_count,
                              (uint32_t)(uintptr_t)space->vertices,
                              space->portal_count,
                              (uint32_t)(uintptr_t)space->portals,
                              space->directed_count,
                              (uint32_t)(uintptr_t)space->directed,
                              space->wall_count,
                              (uint32_t)(uintptr_t)space->walls,
                              space->node_count,
                              (uint32_t)(uintptr_t)space->nodes,
                              space->seam_count,
                              (uint32_t)(uintptr_t)space->seams,
                              space->seam_portal_count,
                              (uint32_t)(uintptr_t)space->seam_portals,
                              (uint32_t)(uintptr_t)space->neighbour,
                              (uint32_t)space->root,
                              space->inside_count,
                              (uint32_t)map->door_count,
                              (uint32_t)map->mirror_count,
                              (uint32_t)map->oneway_count,
                              (uint32_t)map->start_count,
                              (uint32_t)(uintptr_t)map->starts,
                              (uint32_t)s->baked.visibility.sight,
                              (uint32_t)s->baked.visibility.guarantee,
                              (uint32_t)(uintptr_t)s->baked.method};
    memcpy(sli_module.integers, table, sizeof table);
    const double numbers[] = {space->bounds.min.x, space->bounds.min.y, space->bounds.max.x,
                              space->bounds.max.y, map->range};
    memcpy(sli_module.numbers, numbers, sizeof numbers);
}

/// numbers: what cleaning and the stages did.
SLI_EXPORT(void, scene_account, const scene *s) {
    const sl_bake_account *a = &s->account;
    const sl_see_account *see = &s->baked.visibility.account;
    const double numbers[] = {(double)a->cleaning.before,
                              (double)a->cleaning.after,
                              (double)a->cleaning.welded,
                              (double)a->cleaning.split,
                              (double)a->cleaning.crossings,
                              a->cleaning.largest_move,
                              a->cleaning.tolerance,
                              a->seconds.clean,
                              a->seconds.subdivide,
                              a->seconds.check,
                              a->seconds.see,
                              (double)see->pairs,
                              (double)see->tests,
                              (double)see->nodes,
                              (double)see->sweep.pieces,
                              (double)see->deepest};
    memcpy(sli_module.numbers, numbers, sizeof numbers);
}

/// integers: the places of a door's name and of its segments (its parts), their number, shut.
SLI_EXPORT(void, scene_door, const scene *s, uint32_t number) {
    const sl_door *door = &s->baked.map.doors[number];
    sli_module.integers[0] = (uint32_t)(uintptr_t)door->name;
    sli_module.integers[1] = (uint32_t)(uintptr_t)(door->parts ? door->parts : &door->segment);
    sli_module.integers[2] = door->parts ? (uint32_t)door->part_count : 1;
    sli_module.integers[3] = !sl_query_door_is_open(s->query, number);
}

/// integers: the place of a mirror's (kind 0) or a one-way glass' (kind 1) segment, one-sided.
SLI_EXPORT(void, scene_glass, const scene *s, int kind, uint32_t number) {
    const sl_map *map = &s->baked.map;
    const sl_glass *glass = kind ? &map->oneways[number] : &map->mirrors[number];
    sli_module.integers[0] = (uint32_t)(uintptr_t)&glass->segment;
    sli_module.integers[1] = glass->one_sided;
}

SLI_EXPORT(int, scene_set_door, scene *s, const char *name, int open) {
    return (int)(sli_module.status = sl_query_set_door(sli_module.context, s->query, name, open));
}

SLI_EXPORT(uint32_t, scene_locate, const scene *s, double x, double y) {
    return sl_query_locate(s->query, (sl_point){x, y});
}

// --- what sees what

static sl_status check_cell(const scene *s, uint32_t cell) {
    if (cell < s->baked.space.cell_count) return SL_OK;
    return sl_fail(sli_module.context, SL_BAD_ARGUMENT, "cell %u: there are %u cells",
                   (unsigned)cell, (unsigned)s->baked.space.cell_count);
}

/// Puts the set of cells into the list; integers: their number and place.
static void list_cells(scene *s) {
    uint32_t count = 0;
    for (size_t word = 0; word < sl_eye_words(&s->baked.space); word++)
        for (uint64_t rest = s->cells[word]; rest; rest &= rest - 1)
            s->list[count++] = (uint32_t)(64 * word) + (uint32_t)__builtin_ctzll(rest);
    sli_module.integers[0] = count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)s->list;
}

/// The row of a cell, directly or by mirror. integers: number and place.
SLI_EXPORT(int, scene_row, scene *s, int by_mirror, uint32_t cell) {
    if (sli_done(sl_query_row(sli_module.context, s->query, cell, by_mirror, s->cells)))
        list_cells(s);
    return (int)sli_module.status;
}

/// integers[0]: whether cell `from` sees cell `to` directly.
SLI_EXPORT(int, scene_cell_sees, scene *s, uint32_t from, uint32_t to) {
    bool sees = false;
    sli_done(sl_query_can_see(sli_module.context, s->query, from, to, &sees));
    sli_module.integers[0] = sees;
    return (int)sli_module.status;
}

static sl_status set_range(scene *s, double range) {
    return sl_query_set_range(sli_module.context, s->query, range < 0 ? s->baked.map.range : range);
}

/// integers[0]: whether an eye sees a point. A range below 0 is the map's own, here and below.
SLI_EXPORT(int, scene_can_see, scene *s, double x, double y, double to_x, double to_y,
           double range) {
    bool sees = false;
    if (sli_done(set_range(s, range)))
        sli_done(sl_query_sees(sli_module.context, s->query, (sl_point){x, y},
                               (sl_point){to_x, to_y}, &sees));
    sli_module.integers[0] = sees;
    return (int)sli_module.status;
}

static sl_status find_culling(const char *name, const sl_eye_method **out) {
    size_t count;
    const sl_eye_method *all = sl_eye_methods(&count);
    *out = NULL;
    if (!name[0]) return SL_OK;
    for (size_t i = 0; i < count; i++)
        if (is(all[i].name, name)) *out = &all[i];
    if (*out) return SL_OK;
    return sl_fail(sli_module.context, SL_BAD_ARGUMENT, "method: there is no culling method '%s'",
                   name);
}

static sl_status look(scene *s, const sl_view *view, double range, const char *method,
                      int by_mirror) {
    const sl_eye_method *culling;
    SL_TRY(find_culling(method, &culling));
    SL_TRY(set_range(s, range));
    if (by_mirror)
        return sl_query_look_mirrored(sli_module.context, s->query, view, culling, s->cells, NULL);
    return sl_query_look(sli_module.context, s->query, view, culling, s->cells, NULL);
}

/// The cells that a view sees. integers: number and place.
SLI_EXPORT(int, scene_look, scene *s, double x, double y, double heading, double fov, double range,
           const char *method, int by_mirror) {
    const sl_view view = sl_query_view(s->query, (sl_point){x, y}, heading, fov);
    if (sli_done(look(s, &view, range, method, by_mirror))) list_cells(s);
    return (int)sli_module.status;
}

// --- regions

/// integers: count, places of points and edges, the eye's cell; then the same as chords.
static sl_status show_region(scene *s, const sl_region *region, double tolerance) {
    sli_module.integers[0] = (uint32_t)region->count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)region->points;
    sli_module.integers[2] = (uint32_t)(uintptr_t)region->edges;
    sli_module.integers[3] = region->cell;
    sli_module.integers[4] = sli_module.integers[0];
    sli_module.integers[5] = sli_module.integers[1];
    if (!(region->range > 0)) return SL_OK;
    size_t count = sl_region_flatten(region, tolerance, s->flat, s->flat_room);
    if (count > s->flat_room) {
        SL_TRY(sl_reserve(sli_module.context, &s->flat, &s->flat_room, count, sizeof *s->flat));
        count = sl_region_flatten(region, tolerance, s->flat, s->flat_room);
    }
    sli_module.integers[4] = (uint32_t)count;
    sli_module.integers[5] = (uint32_t)(uintptr_t)s->flat;
    return SL_OK;
}

static sl_status make_region(scene *s, const sl_view *view, double range) {
    SL_TRY(set_range(s, range));
    return sl_query_region(sli_module.context, s->query, view, &s->region);
}

/// The visible region of a view. Arcs become chords that lie within `tolerance` of them.
SLI_EXPORT(int, scene_region, scene *s, double x, double y, double heading, double fov,
           double range, double tolerance) {
    const sl_view view = sl_query_view(s->query, (sl_point){x, y}, heading, fov);
    if (sli_done(make_region(s, &view, range))) sli_done(show_region(s, &s->region, tolerance));
    return (int)sli_module.status;
}

#define NAME(name, group, unit, meaning) #name " "

/// The names of a region's measures, in the order of their values. What they mean is in
/// measures.d.ts: pages load no more than they need.
SLI_EXPORT(const char *, region_names, void) {
    return SL_ISOVIST_MEASURES(NAME) SL_RADIAL_MEASURES(NAME);
}

/// numbers: the measures of the last region, in the order of sl_region_measures.
SLI_EXPORT(void, scene_measures, const scene *s) {
    const sl_region_measures m = sl_region_measure(&s->region);
    _Static_assert(sizeof m <= sizeof sli_module.numbers, "room for all measures");
    memcpy(sli_module.numbers, &m, sizeof m);
}

/// What is seen directly and by mirror; integers[0]: the number of parts seen by mirror.
SLI_EXPORT(int, scene_mirrored_region, scene *s, double x, double y, double heading, double fov,
           double range, uint32_t depth) {
    const sl_view view = sl_query_view(s->query, (sl_point){x, y}, heading, fov);
    sl_status status = set_range(s, range);
    if (status == SL_OK) status = sl_query_set_mirror_depth(sli_module.context, s->query, depth);
    if (status == SL_OK)
        status = sl_query_mirrored_region(sli_module.context, s->query, &view, &s->mirrored);
    sli_module.integers[0] = status == SL_OK ? (uint32_t)s->mirrored.part_count : 0;
    return (int)(sli_module.status = status);
}

/// A part of the last mirrored region. integers: as scene_region(), then mirror, parent, depth, and
/// the place of its points in mirrored space.
SLI_EXPORT(int, scene_mirror_part, scene *s, uint32_t number, double tolerance) {
    const sl_mirror_part *part = &s->mirrored.parts[number];
    if (!sli_done(show_region(s, &part->region, tolerance))) return (int)sli_module.status;
    sli_module.integers[6] = part->mirror;
    sli_module.integers[7] = part->parent;
    sli_module.integers[8] = part->depth;
    sli_module.integers[9] = (uint32_t)(uintptr_t)part->image;
    return SL_OK;
}

// --- why

static sl_status explain(scene *s, sl_explained *a, uint32_t from, uint32_t to, uint32_t misses,
                         double tests, uint32_t mirror_depth) {
    sl_explain_options options = sl_explain_options_default();
    const sl_explain_state state = {a->shut, mirror_depth};
    options.sight = s->baked.visibility.sight;
    options.most_misses = misses;
    options.most_tests = (uint64_t)tests;
    SL_TRY(check_cell(s, from));
    SL_TRY(check_cell(s, to));
    SL_TRY(sl_explain_effects(sli_module.context, &s->baked.space, &s->baked.map, &state, &options,
                              from, to, &a->e));
    sl_output output;
    SL_TRY(sl_output_open(sli_module.context, "", &output));
    return sl_output_close(sli_module.context, &output,
                           sl_explained_json(sli_module.context, a, output.stream));
}

/// Why a pair of cells is seen or hidden, as the JSON of `sightline explain`: see written().
SLI_EXPORT(int, scene_explain, scene *s, uint32_t from, uint32_t to, uint32_t misses, double tests,
           uint32_t mirror_depth) {
    sl_explained a = {.baked = &s->baked};
    bool *shut = sl_alloc_array(sli_module.context, s->baked.map.door_count, sizeof *shut);
    for (size_t i = 0; shut && i < s->baked.map.door_count; i++)
        shut[i] = !sl_query_door_is_open(s->query, i);
    a.shut = shut;
    sli_module.status = shut ? explain(s, &a, from, to, misses, tests, mirror_depth) : SL_NO_MEMORY;
    sl_effect_explanation_destroy(sli_module.context, &a.e);
    sl_free(sli_module.context, shut);
    return (int)sli_module.status;
}

/// The depth-first search from a cell. integers: number of steps, their place, whether complete.
SLI_EXPORT(int, scene_steps, scene *s, uint32_t cell, double most) {
    sl_steps_options options = sl_steps_options_default();
    options.sight = s->baked.visibility.sight;
    if (most >= 0) options.most = (size_t)most;
    sl_steps_destroy(sli_module.context, &s->steps);
    if (!sli_done(check_cell(s, cell))) return (int)sli_module.status;
    sli_done(sl_steps_record(sli_module.context, &s->baked.space, &options, cell, &s->steps));
    sli_module.integers[0] = (uint32_t)s->steps.count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)s->steps.steps;
    sli_module.integers[2] = s->steps.complete;
    return (int)sli_module.status;
}

// --- portal sequences on their own, for lessons

/// The dual of `count` portals, each left x, y, right x, y. integers: corners of the polygon and
/// their place; numbers: origin, along, scale, best slope and height, margin.
SLI_EXPORT(void, dual, const sl_portal_ends *portals, uint32_t count, uint32_t cutting) {
    static sl_dual made;
    sl_dual_make(portals, count, cutting, &made);
    sli_module.integers[0] = made.corner_count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)made.corners;
    const double numbers[] = {made.origin.x, made.origin.y,   made.along.x,     made.along.y,
                              made.scale,    made.best.slope, made.best.height, made.margin};
    memcpy(sli_module.numbers, numbers, sizeof numbers);
}

/// What keeps lines from a portal sequence. integers: verdict, turns, number of ends, then portal
/// and side of each (1: left).
SLI_EXPORT(int, conflict, const sl_portal_ends *portals, uint32_t count) {
    sl_conflict found = {0};
    if (!sli_done(sl_conflict_find(sli_module.context, portals, count, &found)))
        return (int)sli_module.status;
    sli_module.integers[0] = found.verdict;
    sli_module.integers[1] = found.turns;
    sli_module.integers[2] = found.end_count;
    for (uint32_t i = 0; i < found.end_count; i++) {
        sli_module.integers[3 + 2 * i] = found.ends[i].portal;
        sli_module.integers[4 + 2 * i] = found.ends[i].left;
    }
    return SL_OK;
}
