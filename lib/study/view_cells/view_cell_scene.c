/// The scene that costs depend on: where viewpoints are, and what objects cost to render (Mattausch
/// et al. 2006, sections 3.2 and 3.3).
///
/// Viewpoints are spread evenly over the inside, along paths, or by a density. Each place is a
/// convex polygon or a point, with its share of the probability. An object costs
/// max(a, b * t, c * p) for t walls and a share p of the full circle, as seen from the middle of
/// the view cell.
#include "base/bits.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "sightline/support.h"
#include "study/view_cells/view_cell_tree.h"

#include <math.h>

// --- where viewpoints are

/// The most viewpoints along paths.
#define MOST_VIEWPOINTS 1e7

/// Places while they are gathered.
typedef struct gathered {
    SL_ARRAY(sl_point) points;
    SL_ARRAY(uint32_t) first;
    SL_ARRAY(double) mass;
} gathered;

/// Adds a place; one without mass counts for nothing.
static sl_status add_outline(sl_context *context, gathered *g, const sl_point *points,
                             uint32_t count, double mass) {
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

/// Hands the places to the caller, or frees them where gathering failed or found none.
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
            status = add_outline(context, &g, space->vertices + c->first_vertex, c->vertex_count,
                                 sl_space_area(space, i));
    }
    return finish(context, &g, status, "nothing of the map is inside: no place for viewpoints",
                  out);
}

static bool is_inside(const sl_space *space, sl_point p) {
    const uint32_t cell = sl_space_locate(space, p);
    return cell != SL_NO_CELL && space->cells[cell].inside;
}

/// Adds the points of a piece of a path. *before: how far the last point lies behind.
static sl_status add_piece(sl_context *context, gathered *g, const sl_space *space, sl_point from,
                           sl_point to, double step, double *before) {
    const double length = sli_length(to.x - from.x, to.y - from.y);
    double at = step - *before;
    for (uint64_t i = 0; at <= length; at += step, i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        const double t = length > 0 ? at / length : 0;
        const sl_point p = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
        if (is_inside(space, p)) SL_TRY(add_outline(context, g, &p, 1, 1));
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
            length += sli_length(b.x - a.x, b.y - a.y);
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
            status = add_outline(context, &g, corners, 4, values[(size_t)j * columns + i]);
        }
    return finish(context, &g, status, "the density is nowhere over 0", out);
}

// --- what objects cost

sl_render_cost sl_render_cost_default(void) {
    return (sl_render_cost){.a = 1};
}

static bool is_between(sl_point a, sl_point b, sl_point p) {
    return fmin(a.x, b.x) <= p.x && p.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= p.y &&
           p.y <= fmax(a.y, b.y) && sli_orient(a, b, p) == 0;
}

/// The number of pieces of a cell's boundary that are no portal: its walls.
static uint32_t count_walls(const sl_space *space, const sl_cell *cell) {
    const sl_point *corners = space->vertices + cell->first_vertex;
    uint32_t directed = cell->first_directed, count = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        sl_point at = corners[i];
        const sl_point end = corners[i + 1 < cell->vertex_count ? i + 1 : 0];
        for (; directed < cell->first_directed + cell->directed_count; directed++) {
            const sl_directed_portal *e = &space->directed[directed];
            if (!is_between(at, end, e->right) || !is_between(at, end, e->left)) break;
            count += at.x != e->right.x || at.y != e->right.y;
            at = e->left;
        }
        count += at.x != end.x || at.y != end.y;
    }
    return count;
}

sl_status sli_view_render_make(sl_context *context, const sl_view_scene *scene,
                               sli_view_render *out) {
    const sl_render_cost *cost = &scene->cost;
    if (!(cost->a >= 0 && cost->b >= 0 && cost->c >= 0 && isfinite(cost->a + cost->b + cost->c)))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "render costs %g, %g, %g: must be finite and not negative", cost->a, cost->b,
                       cost->c);
    const bool walls = scene->objects == SL_VIEW_WALLS;
    const uint32_t count = walls ? scene->space->wall_count : scene->space->cell_count;
    sli_view_render made = {.scene = scene, .object_count = count, .even = cost->c == 0};
    made.fixed = sl_alloc_array(context, count, sizeof *made.fixed);
    if (!made.fixed) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t t = walls ? 1 : count_walls(scene->space, &scene->space->cells[i]);
        made.fixed[i] = fmax(cost->a, cost->b * t);
        made.even = made.even && made.fixed[i] == made.fixed[0];
    }
    *out = made;
    return SL_OK;
}

void sli_view_render_destroy(sl_context *context, sli_view_render *render) {
    sl_free(context, render->fixed);
    *render = (sli_view_render){0};
}

/// The angle from one direction to another, -pi to pi.
static double turn(sl_point from, sl_point a, sl_point b) {
    const double ax = a.x - from.x, ay = a.y - from.y, bx = b.x - from.x, by = b.y - from.y;
    return atan2(ax * by - ay * bx, ax * bx + ay * by);
}

double sli_view_render_share(const sli_view_render *render, uint32_t object, sl_point from) {
    const double full = 6.283185307179586;
    const sl_space *space = render->scene->space;
    if (render->scene->objects == SL_VIEW_WALLS)
        return fabs(turn(from, space->walls[object].a, space->walls[object].b)) / full;
    const sl_cell *cell = &space->cells[object];
    const sl_point *corners = space->vertices + cell->first_vertex;
    // About a place inside, the sum reaches a full circle; else it goes out and back.
    double low = 0, high = 0, at = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        at += turn(from, corners[i], corners[i + 1 < cell->vertex_count ? i + 1 : 0]);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    return fmin((high - low) / full, 1);
}

double sli_view_render_set(const sli_view_render *render, const sl_bits *set, size_t words,
                           sl_point from) {
    if (render->even) {
        const uint64_t count = sli_bits_count(set, words);
        return count ? (double)count * render->fixed[0] : 0;
    }
    double sum = 0;
    for (size_t i = 0; i < words; i++)
        for (sl_bits left = set[i]; left; left &= left - 1) {
            const uint32_t object = (uint32_t)(64 * i) + (uint32_t)__builtin_ctzll(left);
            sum += sli_view_render_object(render, object, from);
        }
    return sum;
}
