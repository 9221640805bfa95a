/// Lines, areas and ways for JavaScript: ways.js asks, analysis/set_sight/, route/ and reach/
/// answer. Results stay until the next call about the same floor.
#include "bindings/js/src/floor.h"
#include "sightline/exposure.h"
#include "sightline/path.h"
#include "sightline/reach.h"

#include <math.h>
#include <string.h>

struct sli_answers {
    sl_set_region region;
    sl_query *passing; ///< with doors as ways find them
    sl_route_finder *finder;
    double loss;   ///< of shut doors, for the finder; below 0: they are shut
    double radius; ///< of the walker
    sl_route route;
    sl_reach *reach;
};

/// What one thing gives of its exposure.
enum { EXPOSED = 5 };

static sl_context *context(void) {
    return sli_module.context;
}

static void forget_ways(struct sli_answers *a) {
    sl_route_finder_destroy(context(), a->finder);
    sl_query_destroy(context(), a->passing);
    a->finder = NULL, a->passing = NULL;
}

void sli_answers_destroy(struct sli_answers *a) {
    if (!a) return;
    sl_set_region_destroy(context(), &a->region);
    forget_ways(a);
    sl_route_destroy(context(), &a->route);
    sl_reach_destroy(context(), a->reach);
    sl_free(context(), a);
}

static sl_status make_answers(sli_floor *f) {
    if (!f->answers) f->answers = sl_alloc_array(context(), 1, sizeof *f->answers);
    return f->answers ? SL_OK : SL_NO_MEMORY;
}

// --- lines and areas

/// How far lines and areas see until it is set again; below 0: as the map has it.
SLI_EXPORT(int, floor_set_range, sli_floor *f, double range) {
    return (int)(sli_module.status = sl_query_set_range(context(), f->query,
                                                        range < 0 ? f->baked.map.range : range));
}

// Points are read where ways.js writes them, and regions are read where they lie.
_Static_assert(sizeof(sl_point) == 2 * sizeof(double), "points as ways.js knows them");

static sl_status make_region(sli_floor *f, const sl_point *points, size_t count, int is_area,
                             int from_all) {
    sl_set_sight *sight;
    SL_TRY(make_answers(f));
    sl_set_region_destroy(context(), &f->answers->region);
    SL_TRY(sl_set_sight_create(context(), f->query, points, count,
                               is_area ? SL_SET_AREA : SL_SET_LINE, &sight));
    const sl_status status = sl_set_sight_region(
        context(), sight, from_all ? SL_SEEN_FROM_ALL : SL_SEEN_FROM_SOME, &f->answers->region);
    sl_set_sight_destroy(context(), sight);
    return status;
}

/// What is seen from some point of a line or an area, or from all. integers: loops, where their
/// ends and points lie, whether a wall crosses the set. numbers: the area.
SLI_EXPORT(int, floor_region_from, sli_floor *f, const sl_point *points, size_t count, int is_area,
           int from_all) {
    if (!sli_done(make_region(f, points, count, is_area, from_all))) return (int)sli_module.status;
    const sl_set_region *r = &f->answers->region;
    const uint32_t all[4] = {(uint32_t)r->shape.count, (uint32_t)(uintptr_t)r->shape.ends,
                             (uint32_t)(uintptr_t)r->shape.points, r->walled};
    memcpy(sli_module.integers, all, sizeof all);
    sli_module.numbers[0] = r->area;
    return SL_OK;
}

static sl_status ask_places(sl_set_sight *sight, int from_all, const sl_point *places, size_t count,
                            uint8_t *seen) {
    for (size_t i = 0; i < count; i++) {
        bool sees;
        SL_TRY(sl_set_sight_sees(context(), sight, from_all ? SL_SEEN_FROM_ALL : SL_SEEN_FROM_SOME,
                                 places[i], &sees));
        seen[i] = sees;
        SL_TRY(sl_check_cancelled(context()));
    }
    return SL_OK;
}

/// Which places are seen from a set: a byte each.
SLI_EXPORT(int, floor_seen_from, sli_floor *f, const sl_point *points, size_t count, int is_area,
           int from_all, const sl_point *places, size_t place_count, uint8_t *seen) {
    sl_set_sight *sight;
    if (!sli_done(sl_set_sight_create(context(), f->query, points, count,
                                      is_area ? SL_SET_AREA : SL_SET_LINE, &sight)))
        return (int)sli_module.status;
    sli_done(ask_places(sight, from_all, places, place_count, seen));
    sl_set_sight_destroy(context(), sight);
    return (int)sli_module.status;
}

/// How long the thing is, or how large; what of it is seen; how much of the path sees some of it,
/// and all of it; how far along the path it is seen first, or NAN.
static void put_exposure(sl_exposure *e, double row[EXPOSED]) {
    row[0] = e->size, row[1] = e->seen, row[2] = e->some.total, row[3] = e->whole.total;
    row[4] = e->some.count ? e->some.parts[0].from : NAN;
    sl_exposure_destroy(context(), e);
}

/// The exposure of things, `counts[i]` of the points each, to a path: a row each.
SLI_EXPORT(int, floor_exposure, sli_floor *f, const sl_point *path, size_t path_count,
           sl_point *points, size_t *counts, size_t count, int is_area, double *rows) {
    sl_exposed *things = sl_alloc_array(context(), count + 1, sizeof *things);
    sl_exposure *exposures = sl_alloc_array(context(), count + 1, sizeof *exposures);
    sl_status status = things && exposures ? SL_OK : SL_NO_MEMORY;
    for (size_t i = 0; status == SL_OK && i < count; points += counts[i++])
        things[i] = (sl_exposed){{points, &counts[i], 1}, is_area};
    if (status == SL_OK)
        status = sl_exposure_make(context(), f->query, path, path_count, things, count, exposures);
    for (size_t i = 0; status == SL_OK && i < count; i++)
        put_exposure(&exposures[i], rows + EXPOSED * i);
    sl_free(context(), exposures);
    sl_free(context(), things);
    return (int)(sli_module.status = status);
}

/// integers: whether some place near one point may see some place near another.
SLI_EXPORT(int, floor_sees_within, sli_floor *f, double x0, double y0, double radius0, double x1,
           double y1, double radius1, int on_foot) {
    bool sees = false;
    sl_status status = make_answers(f);
    if (status == SL_OK && !f->answers->reach)
        status = sl_reach_create(context(), f->query, &f->answers->reach);
    if (status == SL_OK)
        status = sl_reach_sees_within(context(), f->answers->reach, (sl_point){x0, y0}, radius0,
                                      (sl_point){x1, y1}, radius1,
                                      on_foot ? SL_REACH_ON_FOOT : SL_REACH_STRAIGHT, &sees);
    sli_module.integers[0] = sees;
    return (int)(sli_module.status = status);
}

// --- ways

/// A finder of ways with the doors as they stand; those that are shut are passed at the loss.
static sl_status make_finder(sli_floor *f, double loss, double radius) {
    const sl_map *map = &f->baked.map;
    SL_TRY(make_answers(f));
    struct sli_answers *a = f->answers;
    if (a->finder && a->loss == loss && a->radius == radius) return SL_OK;
    forget_ways(a);
    if (sl_map_steps_differ(map))
        return sl_fail(context(), SL_UNSUPPORTED,
                       "the cells are those of sight, and some walls stop sight or steps alone: "
                       "there are no ways in them");
    SL_TRY(sl_query_over(context(), &f->baked.space, map, NULL, &a->passing));
    double *losses = sl_alloc_array(context(), map->door_count + 1, sizeof *losses);
    if (!losses) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->door_count; i++) {
        const bool is_open = sl_query_door_is_open(f->query, i);
        sl_query_set_door_at(context(), a->passing, i, is_open || loss >= 0);
        losses[i] = is_open ? 0 : loss;
    }
    sl_status status = sl_route_finder_create(context(), a->passing, &a->finder);
    if (status == SL_OK && loss >= 0)
        status = sl_route_finder_set_losses(context(), a->finder, losses, map->door_count);
    if (status == SL_OK && radius > 0)
        status = sl_route_finder_set_radius(context(), a->finder, radius);
    a->loss = loss, a->radius = radius;
    sl_free(context(), losses);
    if (status != SL_OK) forget_ways(a);
    return status;
}

/// The shortest way of a walker, a disc with a radius or a point. `loss`: what passing a shut door
/// costs; below 0: they are not passed.
/// integers: whether there is one, its points, and where they lie. numbers: its length.
SLI_EXPORT(int, floor_path, sli_floor *f, double x0, double y0, double x1, double y1, double loss,
           double radius) {
    sl_status status = make_finder(f, loss, radius);
    if (status == SL_OK)
        status = sl_route_find(context(), f->answers->finder, (sl_point){x0, y0},
                               (sl_point){x1, y1}, &f->answers->route);
    if (!sli_done(status)) return (int)status;
    const sl_route *r = &f->answers->route;
    sli_module.integers[0] = r->found;
    sli_module.integers[1] = (uint32_t)r->count;
    sli_module.integers[2] = (uint32_t)(uintptr_t)r->points;
    sli_module.numbers[0] = r->length;
    return SL_OK;
}
