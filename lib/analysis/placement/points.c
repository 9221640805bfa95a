/// Points to place viewpoints at: corners, along walls, on a grid.
#include "sightline/place.h"

#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_POINTS = 1 << 24 };

typedef struct pointer {
    sl_context *context;
    const sl_space *space;
    SL_ARRAY(sl_point) points;
} pointer;

static sl_status add(pointer *p, sl_point at) {
    if (!sl_space_is_inside(p->space, at)) return SL_OK;
    if (p->points.count == MOST_POINTS)
        return sl_fail(p->context, SL_BAD_ARGUMENT, "more than %d points: take a longer step",
                       (int)MOST_POINTS);
    SL_TRY(SL_ARRAY_ROOM(p->context, &p->points, 1));
    p->points.items[p->points.count++] = at;
    return SL_OK;
}

/// Points along a side of a room that is a wall, at equal distances of up to a step.
static sl_status add_along(pointer *p, sl_point a, sl_point b, double step) {
    const sl_point way = {b.x - a.x, b.y - a.y};
    const double parts = step > 0 ? fmax(1, ceil(sli_length(way.x, way.y) / step)) : 1;
    if (!(parts < MOST_POINTS))
        return sl_fail(p->context, SL_BAD_ARGUMENT, "more than %d points: take a longer step",
                       (int)MOST_POINTS);
    for (double i = 0; i < parts; i++) {
        const double share = (i + 0.5) / parts;
        SL_TRY(add(p, (sl_point){a.x + share * way.x - 0x1p-20 * way.y,
                                 a.y + share * way.y + 0x1p-20 * way.x}));
    }
    return SL_OK;
}

static sl_status add_walls(pointer *p, const sl_outline *o, bool corners, double step) {
    for (uint32_t i = 0; i < o->side_count; i++) {
        const sl_point a = o->sides[i].start, b = o->sides[o->sides[i].next].start;
        if (sl_side_is_portal(&o->sides[i])) continue;
        if (!corners) {
            SL_TRY(add_along(p, a, b, step));
            continue;
        }
        SL_TRY(add(p, a));
        SL_TRY(add(p, b));
    }
    return SL_OK;
}

static sl_status add_grid(pointer *p, double step) {
    const sl_box *b = &p->space->bounds;
    const double left = ceil(b->min.x / step), right = floor(b->max.x / step);
    const double low = ceil(b->min.y / step), high = floor(b->max.y / step);
    if (!((right - left + 1) * (high - low + 1) < 64.0 * MOST_POINTS))
        return sl_fail(p->context, SL_BAD_ARGUMENT,
                       "a grid of step %g is too fine: take a longer step", step);
    // Far from the origin left + 1 may be left: what is counted up is the number of the row.
    for (double j = 0; j <= high - low; j++) {
        SL_TRY(sl_check_cancelled(p->context));
        for (double i = 0; i <= right - left; i++)
            SL_TRY(add(p, sli_coordinates((sl_point){(left + i) * step, (low + j) * step})));
    }
    return SL_OK;
}

static int compare_points(const void *left, const void *right) {
    return sli_compare_points(*(const sl_point *)left, *(const sl_point *)right);
}

static void sort_points(pointer *p) {
    size_t count = 0;
    if (!p->points.count) return;
    qsort(p->points.items, p->points.count, sizeof *p->points.items, compare_points);
    for (size_t i = 0; i < p->points.count; i++)
        if (!i || !sli_same_point(p->points.items[i], p->points.items[i - 1]))
            p->points.items[count++] = p->points.items[i];
    p->points.count = count;
}

sl_status sl_place_points(sl_context *context, sl_query *query, sl_place_from from, double step,
                          sl_point **points, uint32_t *count) {
    pointer p = {.context = context};
    const sl_outline *outline;
    const bool grid = from == SL_PLACE_GRID;
    if (!(step >= 0) || !isfinite(step) || (grid && !(step > 0)))
        return sl_fail(context, SL_BAD_ARGUMENT, "step %g: must be %s", step,
                       grid ? "more than 0" : "0 or more");
    SL_TRY(sl_query_space(context, query, &p.space, NULL));
    SL_TRY(sl_query_outline(context, query, &outline));
    sl_status status =
        grid ? add_grid(&p, step) : add_walls(&p, outline, from == SL_PLACE_CORNERS, step);
    if (status == SL_OK && !p.points.count)
        status = sl_fail(context, SL_BAD_ARGUMENT, "no such point is inside");
    if (status != SL_OK) {
        sl_free(context, p.points.items);
        return status;
    }
    sort_points(&p);
    *points = p.points.items;
    *count = (uint32_t)p.points.count;
    return SL_OK;
}

double sl_place_step(const sl_space *space, double range) {
    double area = 0;
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].inside) area += sl_space_area(space, c);
    const double step = sqrt(area) / 20;
    return range > 0 ? fmin(step, range / 3) : step;
}
