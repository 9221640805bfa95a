/// Worlds for Python: edits of walls, and questions in between.
#include "facade.h"

#include <stdlib.h>
#include <string.h>

slp_world *slp_world_new(void) {
    slp_world *world = calloc(1, sizeof *world);
    if (!world) return NULL;
    if (slp_base_begin(&world->base)) return world;
    free(world);
    return NULL;
}

void slp_world_free(slp_world *world) {
    if (!world) return;
    sl_region_destroy(world->base.context, &world->region);
    sl_world_destroy(world->base.context, world->world);
    slp_base_end(&world->base);
    free(world);
}

int slp_world_begin(slp_world *world, const slp_plan *plan, const double *box, int rows, int open) {
    sl_world_options options = sl_world_options_default();
    options.rows = (sl_world_rows)rows;
    options.sight = open ? SL_OPEN : SL_CLOSED;
    if (box) options.bounds = (sl_box){{box[0], box[1]}, {box[2], box[3]}};
    return sl_world_create(world->base.context, &plan->map, &options, &world->world);
}

// --- edits

static sl_segment segment_at(const double *s) {
    return (sl_segment){{s[0], s[1]}, {s[2], s[3]}};
}

/// A number that no wall has stays one.
static uint32_t wall_of(int64_t number) {
    return number < 0 || number > UINT32_MAX ? UINT32_MAX : (uint32_t)number;
}

static sl_status add_one(slp_world *w, const char *kind, const char *name, int open, int stops,
                         bool one_sided, sl_segment at, uint32_t *wall) {
    sl_context *context = w->base.context;
    if (strcmp(kind, "wall") == 0)
        return sl_world_add_partial(context, w->world, at, (uint32_t)stops, wall);
    if (strcmp(kind, "door") == 0)
        return sl_world_add_door(context, w->world, name, at, open != 0, wall);
    if (strcmp(kind, "oneway") == 0) return sl_world_add_oneway(context, w->world, at, wall);
    if (strcmp(kind, "seam") == 0) return sl_world_add_partial(context, w->world, at, 0, wall);
    if (strcmp(kind, "mirror") == 0)
        return sl_world_add_mirror(context, w->world, at, one_sided, wall);
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "there is no kind '%.40s'; kinds: wall, door, oneway, seam, mirror", kind);
}

int slp_world_add(slp_world *world, const char *kind, const char *name, int open, int stops,
                  int one_sided, const double *segments, size_t count, int64_t *numbers) {
    sl_status status = SL_OK;
    size_t made = 0;
    for (; made < count && status == SL_OK; made++) {
        uint32_t wall;
        status = add_one(world, kind, name, open, stops, one_sided != 0,
                         segment_at(segments + 4 * made), &wall);
        if (status != SL_OK) break;
        numbers[made] = wall;
    }
    // All or none of them. Walls of this edit are removed without memory.
    while (status != SL_OK && made)
        sl_world_remove(world->base.context, world->world, wall_of(numbers[--made]));
    return status;
}

int slp_world_add_solid(slp_world *world, const double *corners, size_t count, int64_t *numbers) {
    sl_context *context = world->base.context;
    uint32_t *walls = sl_alloc_array(context, count, sizeof *walls);
    sl_point *points = sl_alloc_array(context, count, sizeof *points);
    sl_status status = walls && points ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; i < count && status == SL_OK; i++)
        points[i] = (sl_point){corners[2 * i], corners[2 * i + 1]};
    if (status == SL_OK) status = sl_world_add_solid(context, world->world, points, count, walls);
    for (size_t i = 0; i < count && status == SL_OK; i++) numbers[i] = walls[i];
    sl_free(context, walls);
    sl_free(context, points);
    return status;
}

int slp_world_remove(slp_world *world, const int64_t *numbers, size_t count) {
    for (size_t i = 0; i < count; i++)
        SL_TRY(sl_world_remove(world->base.context, world->world, wall_of(numbers[i])));
    return SL_OK;
}

int slp_world_move(slp_world *world, int64_t number, const double *segment) {
    return sl_world_move(world->base.context, world->world, wall_of(number), segment_at(segment));
}

int slp_world_set_open(slp_world *world, int64_t number, int open) {
    return sl_world_set_open(world->base.context, world->world, wall_of(number), open != 0);
}

int slp_world_commit(slp_world *world) {
    return sl_world_commit(world->base.context, world->world, NULL);
}

void slp_world_discard(slp_world *world) {
    sl_world_discard(world->world);
}

int slp_world_settle(slp_world *world, double milliseconds, int64_t *left) {
    size_t count = 0;
    SL_TRY(sl_world_settle(world->base.context, world->world, milliseconds, &count));
    *left = (int64_t)count;
    return SL_OK;
}

int slp_world_plan(slp_world *world, slp_plan *plan) {
    sl_map map = {0};
    SL_TRY(sl_world_copy_map(plan->base.context, world->world, NULL, &map));
    sl_map_destroy(plan->base.context, &plan->map);
    plan->map = map;
    return SL_OK;
}

// --- questions

int slp_world_can_see(slp_world *world, const double *eyes, const double *points, size_t count,
                      uint8_t *sees) {
    sl_context *context = world->base.context;
    for (size_t i = 0; i < count; i++) {
        const sl_point eye = {eyes[2 * i], eyes[2 * i + 1]};
        const sl_point at = {points[2 * i], points[2 * i + 1]};
        bool seen = false;
        SL_TRY(sl_query_sees(context, sl_world_query(world->world), eye, at, &seen));
        sees[i] = seen;
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(context));
    }
    return SL_OK;
}

int slp_world_may_see(slp_world *world, const double *eyes, const double *points, size_t count,
                      uint8_t *sees) {
    const sl_pvs *pvs = &sl_world_visibility(world->world)->pvs;
    const sl_query *query = sl_world_query(world->world);
    if (!pvs->cell_count)
        return sl_fail(world->base.context, SL_BAD_ARGUMENT,
                       "this world keeps no visible sets: give edit() rows='now' or 'later'");
    for (size_t i = 0; i < count; i++) {
        const uint32_t a = sl_query_locate(query, (sl_point){eyes[2 * i], eyes[2 * i + 1]});
        const uint32_t b = sl_query_locate(query, (sl_point){points[2 * i], points[2 * i + 1]});
        sees[i] = a != SL_NO_CELL && b != SL_NO_CELL && sl_pvs_sees(pvs, a, b);
    }
    return SL_OK;
}

/// Without a tolerance of the caller's, a thousandth of the range.
static double tolerance_of(const slp_world *world, double tolerance) {
    return tolerance > 0 ? tolerance : sl_query_range(sl_world_query(world->world)) / 1000;
}

int slp_world_region(slp_world *world, const double *eye, double heading, double fov,
                     double tolerance, int64_t *corners) {
    sl_query *query = sl_world_query(world->world);
    const sl_view view = sl_query_view(query, (sl_point){eye[0], eye[1]}, heading, fov);
    SL_TRY(sl_query_region(world->base.context, query, &view, &world->region));
    *corners = (int64_t)sl_region_flatten(&world->region, tolerance_of(world, tolerance), NULL, 0);
    return SL_OK;
}

void slp_world_region_points(const slp_world *world, double tolerance, double *points,
                             size_t count) {
    sl_region_flatten(&world->region, tolerance_of(world, tolerance), (sl_point *)(void *)points,
                      count);
}
