/// Where viewpoints are: evenly over the inside, along paths, or by a density.
#include "sightline/view_cells.h"

#include "sightline/support.h"

#include <math.h>

/// Of viewpoints along paths.
#define MOST_VIEWPOINTS 1e7

/// Places while they are gathered.
typedef struct gathered {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(uint32_t) first;
    SL_ARRAY(double) mass;
} gathered;

/// Adds a place; one without mass counts for nothing.
static sl_status add(sl_context *context, gathered *g, const sl_point *points, uint32_t count,
                     double mass) {
    if (!(mass > 0)) return SL_OK;
    if (g->points.count + count > UINT32_MAX) return sl_fail_memory(context);
    SL_TRY(SL_ARRAY_ROOM(context, &g->points, count));
    SL_TRY(SL_ARRAY_ROOM(context, &g->first, 2));
    SL_TRY(SL_ARRAY_ROOM(context, &g->mass, 1));
    g->first.items[g->first.count++] = (uint32_t)g->points.count;
    for (uint32_t i = 0; i < count; i++) g->points.items[g->points.count++] = points[i];
    g->mass.items[g->mass.count++] = mass;
    return SL_OK;
}

static void drop(sl_context *context, gathered *g) {
    sl_free(context, g->points.items);
    sl_free(context, g->first.items);
    sl_free(context, g->mass.items);
}

/// Hands the places on, or frees them where gathering failed or found none.
static sl_status finish(sl_context *context, gathered *g, sl_status status, const char *none,
                        sl_view_places *out) {
    if (status == SL_OK && !g->mass.count) status = sl_fail(context, SL_BAD_ARGUMENT, "%s", none);
    if (status != SL_OK) {
        drop(context, g);
        return status;
    }
    g->first.items[g->first.count] = (uint32_t)g->points.count;
    *out =
        (sl_view_places){(uint32_t)g->mass.count, g->points.items, g->first.items, g->mass.items};
    return SL_OK;
}

void sl_view_places_destroy(sl_context *context, sl_view_places *places) {
    sl_free(context, places->points);
    sl_free(context, places->first);
    sl_free(context, places->mass);
    *places = (sl_view_places){0};
}

sl_status sl_view_places_inside(sl_context *context, const sl_space *space, sl_view_places *out) {
    gathered g = {0};
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < space->cell_count && status == SL_OK; i++) {
        const sl_cell *c = &space->cells[i];
        if (c->inside)
            status = add(context, &g, space->vertices + c->first_vertex, c->vertex_count,
                         sl_space_area(space, i));
    }
    return finish(context, &g, status, "nothing of the map is inside: no place for viewpoints",
                  out);
}

static bool is_inside(const sl_space *space, sl_point p) {
    const uint32_t cell = sl_space_locate(space, p);
    return cell != SL_NO_CELL && space->cells[cell].inside;
}

/// The points of a path; *before is how far the last one lies behind.
static sl_status add_piece(sl_context *context, gathered *g, const sl_space *space, sl_point from,
                           sl_point to, double step, double *before) {
    const double length = hypot(to.x - from.x, to.y - from.y);
    double at = step - *before;
    for (uint64_t i = 0; at <= length; at += step, i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        const double t = length > 0 ? at / length : 0;
        const sl_point p = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
        if (is_inside(space, p)) SL_TRY(add(context, g, &p, 1, 1));
    }
    *before = length - (at - step);
    return SL_OK;
}

static sl_status add_path(sl_context *context, gathered *g, const sl_space *space,
                          const sl_path *path, double step) {
    double before = step; // so that the first point is one
    sl_point from = path->points[0];
    SL_TRY(add_piece(context, g, space, from, from, step, &before));
    for (size_t i = 1; i < path->count; i++) {
        SL_TRY(add_piece(context, g, space, from, path->points[i], step, &before));
        from = path->points[i];
    }
    return SL_OK;
}

static double length_of(const sl_map *map) {
    double length = 0;
    for (size_t i = 0; i < map->path_count; i++)
        for (size_t k = 1; k < map->paths[i].count; k++) {
            const sl_point a = map->paths[i].points[k - 1], b = map->paths[i].points[k];
            length += hypot(b.x - a.x, b.y - a.y);
        }
    return length;
}

sl_status sl_view_places_paths(sl_context *context, const sl_map *map, const sl_space *space,
                               double step, sl_view_places *out) {
    if (!(step > 0 && isfinite(step)))
        return sl_fail(context, SL_BAD_ARGUMENT, "a step of %g: must be over 0", step);
    const double length = length_of(map);
    if (!(length / step < MOST_VIEWPOINTS))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a step of %g: paths %g long would have more than %g viewpoints", step,
                       length, MOST_VIEWPOINTS);
    gathered g = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < map->path_count && status == SL_OK; i++)
        status = add_path(context, &g, space, &map->paths[i], step);
    return finish(context, &g, status,
                  "no path of the map goes where it is inside: no place for viewpoints", out);
}

sl_status sl_view_places_density(sl_context *context, const sl_space *space, const double *values,
                                 uint32_t columns, uint32_t rows, sl_view_places *out) {
    const sl_box *b = &space->bounds;
    const double width = b->max.x - b->min.x, height = b->max.y - b->min.y;
    gathered g = {0};
    sl_status status = SL_OK;
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns && status == SL_OK; i++) {
            const double x0 = b->min.x + width * i / columns;
            const double x1 = b->min.x + width * (i + 1) / columns;
            const double y0 = b->min.y + height * j / rows;
            const double y1 = b->min.y + height * (j + 1) / rows;
            const sl_point corners[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
            status = add(context, &g, corners, 4, values[(size_t)j * columns + i]);
        }
    return finish(context, &g, status, "the density is nowhere over 0", out);
}
