/// Worlds for JavaScript: world.js asks, world/ answers. Walls change, and questions come in
/// between. Results stay until the next call about the same world.
#include "sightline/world.h"
#include "bindings/js/src/bindings.h"
#include "sightline/import.h"

#include <string.h>

typedef struct world {
    sl_world *world;
    sl_map map; ///< as it was opened: world.h has no names of doors, and not what walls stop
    sl_region region;
    sl_mirrored_region mirrored;
    sl_point *flat; ///< the last region with arcs as chords
    size_t flat_room;
    uint64_t *bits; ///< of a visible set
    uint32_t *row;
} world;

static sl_context *context(void) {
    return sli_module.context;
}

SLI_EXPORT(void, world_close, world *w) {
    if (!w) return;
    sl_region_destroy(context(), &w->region);
    sl_mirrored_region_destroy(context(), &w->mirrored);
    sl_free(context(), w->flat);
    sl_free(context(), w->bits);
    sl_free(context(), w->row);
    sl_world_destroy(context(), w->world);
    sl_map_destroy(context(), &w->map);
    sl_free(context(), w);
}

static sl_status open_map(world *w, const char *name, const char *text, size_t size,
                          const sl_world_options *options) {
    const sl_import_options import = {0};
    SL_TRY(sl_map_parse(context(), name, text, size, &import, &w->map));
    return sl_world_create(context(), &w->map, options, &w->world);
}

/// Reads a map. `box`: the bounds; NULL for those of the map and some more.
SLI_EXPORT(world *, world_open, const char *name, const char *text, size_t size, int rows,
           int open_sight, const sl_box *box) {
    sl_world_options options = sl_world_options_default();
    options.rows = (sl_world_rows)rows;
    options.sight = open_sight ? SL_OPEN : SL_CLOSED;
    if (box) options.bounds = *box;
    world *w = sl_alloc_array(context(), 1, sizeof *w);
    if (sli_done(w ? open_map(w, name, text, size, &options) : SL_NO_MEMORY)) return w;
    world_close(w);
    return NULL;
}

static sl_query *query_of(const world *w) {
    return sl_world_query(w->world);
}

// --- edits

static int done(sl_status status, uint32_t wall) {
    sli_module.integers[0] = wall;
    return (int)(sli_module.status = status);
}

/// `stops`: of SL_WORLD_SEAM; `one_sided`: of mirrors. integers: the wall.
SLI_EXPORT(int, world_add, world *w, int kind, const char *name, int open, uint32_t stops,
           int one_sided, double x0, double y0, double x1, double y1) {
    const sl_segment at = {{x0, y0}, {x1, y1}};
    uint32_t wall = 0;
    if (kind == SL_WORLD_DOOR)
        return done(sl_world_add_door(context(), w->world, name, at, open != 0, &wall), wall);
    if (kind == SL_WORLD_ONEWAY)
        return done(sl_world_add_oneway(context(), w->world, at, &wall), wall);
    if (kind == SL_WORLD_SEAM)
        return done(sl_world_add_partial(context(), w->world, at, stops, &wall), wall);
    if (kind == SL_WORLD_MIRROR)
        return done(sl_world_add_mirror(context(), w->world, at, one_sided != 0, &wall), wall);
    return done(sl_world_add_wall(context(), w->world, at, &wall), wall);
}

SLI_EXPORT(int, world_add_solid, world *w, const sl_point *corners, size_t count, uint32_t *walls) {
    return done(sl_world_add_solid(context(), w->world, corners, count, walls), 0);
}

SLI_EXPORT(int, world_remove, world *w, uint32_t wall) {
    return done(sl_world_remove(context(), w->world, wall), wall);
}

SLI_EXPORT(int, world_move, world *w, uint32_t wall, double x0, double y0, double x1, double y1) {
    return done(sl_world_move(context(), w->world, wall, (sl_segment){{x0, y0}, {x1, y1}}), wall);
}

SLI_EXPORT(int, world_set_open, world *w, uint32_t wall, int open) {
    return done(sl_world_set_open(context(), w->world, wall, open != 0), wall);
}

SLI_EXPORT(void, world_discard, world *w) {
    sl_world_discard(w->world);
}

/// integers: cells that went, that came, and whose rows may have changed: number and place of each.
SLI_EXPORT(int, world_commit, world *w) {
    sl_world_changes c = {0};
    if (!sli_done(sl_world_commit(context(), w->world, &c))) return (int)sli_module.status;
    const uint32_t all[6] = {(uint32_t)c.gone_count, (uint32_t)(uintptr_t)c.gone,
                             (uint32_t)c.came_count, (uint32_t)(uintptr_t)c.came,
                             (uint32_t)c.row_count,  (uint32_t)(uintptr_t)c.rows};
    memcpy(sli_module.integers, all, sizeof all);
    return SL_OK;
}

// --- what there is

/// Of the walls of the map that was opened: the name of a door, what a wall stops, its ground, and
/// whether a mirror has one side.
static const char *put_source(const world *w, uint32_t wall) {
    const sl_map *map = &w->map;
    size_t i = wall;
    sli_module.integers[2] = SL_STOPS_ALL;
    sli_module.integers[3] = sli_module.integers[5] = 0;
    if (i < map->wall_count) sli_module.integers[3] = map->walls[i].ground;
    if (i < map->wall_count) return NULL;
    i -= map->wall_count;
    if (i < map->door_count) return map->doors[i].name;
    i -= map->door_count;
    if (i < map->oneway_count) return NULL;
    i -= map->oneway_count;
    if (i < map->seam_count) {
        sli_module.integers[2] = map->seams[i].stops;
        sli_module.integers[3] = map->seams[i].ground;
        return NULL;
    }
    i -= map->seam_count;
    if (i < map->mirror_count) sli_module.integers[5] = map->mirrors[i].one_sided;
    return NULL;
}

SLI_EXPORT(uint32_t, world_wall_count, const world *w) {
    return sl_world_wall_count(w->world);
}

/// integers: kind, whether open, and of the map that was opened what it stops, its ground, where
/// its name lies and whether it has one side; numbers: its ends. False if there is none of that
/// number.
SLI_EXPORT(int, world_wall, const world *w, uint32_t wall) {
    sl_segment at;
    if (!sl_world_wall(w->world, wall, &at)) return false;
    sli_module.integers[0] = sl_world_kind_of(w->world, wall);
    sli_module.integers[1] = sl_world_is_open(w->world, wall);
    sli_module.integers[4] = (uint32_t)(uintptr_t)put_source(w, wall);
    memcpy(sli_module.numbers, &at, sizeof at);
    return true;
}

SLI_EXPORT(uint32_t, world_cell_count, const world *w) {
    return sl_world_cell_count(w->world);
}

/// integers: corners of a cell and their place; none where there is no such cell.
SLI_EXPORT(void, world_cell, const world *w, uint32_t cell) {
    const sl_space *space = sl_query_asked(query_of(w));
    const bool is_there = cell < space->cell_count;
    sli_module.integers[0] = is_there ? space->cells[cell].vertex_count : 0;
    sli_module.integers[1] =
        is_there ? (uint32_t)(uintptr_t)(space->vertices + space->cells[cell].first_vertex) : 0;
}

/// integers: how many visible sets are still conservative.
SLI_EXPORT(int, world_settle, world *w, double milliseconds) {
    size_t left = 0;
    const sl_status status = sl_world_settle(context(), w->world, milliseconds, &left);
    return done(status, (uint32_t)left);
}

static sl_status make_row(world *w, uint32_t cell, uint32_t *count) {
    const sl_space *space = sl_query_asked(query_of(w));
    const size_t words = sl_eye_words(space);
    sl_free(context(), w->bits);
    sl_free(context(), w->row);
    w->bits = sl_alloc_array(context(), words + 1, sizeof *w->bits);
    w->row = sl_alloc_array(context(), (size_t)space->cell_count + 1, sizeof *w->row);
    if (!w->bits || !w->row) return SL_NO_MEMORY;
    SL_TRY(sl_query_row(context(), query_of(w), cell, false, w->bits));
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (w->bits[c / 64] >> c % 64 & 1) w->row[(*count)++] = c;
    return SL_OK;
}

/// integers: cells that a cell sees: their number and place.
SLI_EXPORT(int, world_row, world *w, uint32_t cell) {
    uint32_t count = 0;
    const sl_space *space = sl_query_asked(query_of(w));
    sl_status status = SL_OK;
    if (cell >= space->cell_count || !space->cells[cell].vertex_count)
        status = sl_fail(context(), SL_BAD_ARGUMENT, "cell: there is no cell %u", cell);
    if (status == SL_OK) status = make_row(w, cell, &count);
    sli_module.integers[1] = (uint32_t)(uintptr_t)w->row;
    return done(status, count);
}

// --- questions

/// The cell that holds a point; -1 outside the bounds.
SLI_EXPORT(int, world_locate, const world *w, double x, double y) {
    return (int)sl_query_locate(query_of(w), (sl_point){x, y});
}

/// integers: whether an eye sees a point.
SLI_EXPORT(int, world_can_see, world *w, double x0, double y0, double x1, double y1) {
    bool sees = false;
    sl_status status = sl_query_set_range(context(), query_of(w), w->map.range);
    if (status == SL_OK)
        status =
            sl_query_sees(context(), query_of(w), (sl_point){x0, y0}, (sl_point){x1, y1}, &sees);
    return done(status, sees);
}

/// integers: the corners of a region with arcs as chords, and their place.
static sl_status put_region(world *w, const sl_region *region, double tolerance) {
    if (!(tolerance > 0)) tolerance = sl_query_range(query_of(w)) / 1000;
    size_t count = sl_region_flatten(region, tolerance, w->flat, w->flat_room);
    if (count > w->flat_room) {
        SL_TRY(sl_reserve(context(), &w->flat, &w->flat_room, count, sizeof *w->flat));
        count = sl_region_flatten(region, tolerance, w->flat, w->flat_room);
    }
    sli_module.integers[0] = (uint32_t)count;
    sli_module.integers[1] = (uint32_t)(uintptr_t)w->flat;
    return SL_OK;
}

static sl_status set_range(const world *w, double range) {
    return sl_query_set_range(context(), query_of(w), range < 0 ? w->map.range : range);
}

/// The visible polygon of a view; `range` below 0: the map's. integers: as put_region().
static sl_status make_region(world *w, sl_point eye, double heading, double fov, double range,
                             double tolerance) {
    SL_TRY(set_range(w, range));
    const sl_view view = sl_query_view(query_of(w), eye, heading, fov);
    SL_TRY(sl_query_region(context(), query_of(w), &view, &w->region));
    return put_region(w, &w->region, tolerance);
}

SLI_EXPORT(int, world_region, world *w, double x, double y, double heading, double fov,
           double range, double tolerance) {
    sli_done(make_region(w, (sl_point){x, y}, heading, fov, range, tolerance));
    return (int)sli_module.status;
}

/// What is seen by mirror, up to `depth` reflections. integers: how many parts there are.
SLI_EXPORT(int, world_mirrored, world *w, double x, double y, double heading, double fov,
           double range, uint32_t depth) {
    sl_query *query = query_of(w);
    sl_status status = set_range(w, range);
    const sl_view view = sl_query_view(query, (sl_point){x, y}, heading, fov);
    if (status == SL_OK)
        status = sl_query_mirrored_region_to(context(), query, &view, depth, &w->mirrored);
    return done(status, status == SL_OK ? (uint32_t)w->mirrored.part_count : 0);
}

/// A part of the last answer of world_mirrored(). integers: as put_region(), then the mirror's wall
/// and how many reflections lead there.
SLI_EXPORT(int, world_mirror_part, world *w, uint32_t number, double tolerance) {
    const sl_mirror_part *part = &w->mirrored.parts[number];
    sli_module.integers[2] = sl_world_mirror_wall(w->world, part->mirror);
    sli_module.integers[3] = part->depth;
    return (int)(sli_module.status = put_region(w, &part->region, tolerance));
}
