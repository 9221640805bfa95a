#include "view_cells/render.h"

#include "geometry/orient.h"

#include <math.h>

sl_render_cost sl_render_cost_default(void) {
    return (sl_render_cost){.a = 1};
}

static bool is_between(sl_point a, sl_point b, sl_point p) {
    return fmin(a.x, b.x) <= p.x && p.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= p.y &&
           p.y <= fmax(a.y, b.y) && sl_orient(a, b, p) == 0;
}

/// How many pieces of a cell's boundary are no portal: what is rendered of it.
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

sl_status sl_view_render_make(sl_context *context, const sl_view_scene *scene,
                              sl_view_render *out) {
    const sl_render_cost *cost = &scene->cost;
    if (!(cost->a >= 0 && cost->b >= 0 && cost->c >= 0 && isfinite(cost->a + cost->b + cost->c)))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "render costs %g, %g, %g: must be finite and not negative", cost->a, cost->b,
                       cost->c);
    const bool walls = scene->objects == SL_VIEW_WALLS;
    const uint32_t count = walls ? scene->space->wall_count : scene->space->cell_count;
    sl_view_render made = {.scene = scene, .object_count = count, .even = cost->c == 0};
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

void sl_view_render_destroy(sl_context *context, sl_view_render *render) {
    sl_free(context, render->fixed);
    *render = (sl_view_render){0};
}

/// The angle from one direction to another, -pi to pi.
static double turn(sl_point from, sl_point a, sl_point b) {
    const double ax = a.x - from.x, ay = a.y - from.y, bx = b.x - from.x, by = b.y - from.y;
    return atan2(ax * by - ay * bx, ax * bx + ay * by);
}

double sl_view_render_share(const sl_view_render *render, uint32_t object, sl_point from) {
    const double full = 6.283185307179586;
    const sl_space *space = render->scene->space;
    if (render->scene->objects == SL_VIEW_WALLS)
        return fabs(turn(from, space->walls[object].a, space->walls[object].b)) / full;
    const sl_cell *cell = &space->cells[object];
    const sl_point *corners = space->vertices + cell->first_vertex;
    // Once round a polygon about the place it is a full circle; else it goes out and back.
    double low = 0, high = 0, at = 0;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        at += turn(from, corners[i], corners[i + 1 < cell->vertex_count ? i + 1 : 0]);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    return fmin((high - low) / full, 1);
}

double sl_view_render_set(const sl_view_render *render, const sl_bits *set, size_t words,
                          sl_point from) {
    if (render->even) {
        uint64_t count = 0;
        for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(set[i]);
        return count ? (double)count * render->fixed[0] : 0;
    }
    double sum = 0;
    for (size_t i = 0; i < words; i++)
        for (sl_bits left = set[i]; left; left &= left - 1) {
            const uint32_t object = (uint32_t)(64 * i) + (uint32_t)__builtin_ctzll(left);
            sum += sl_view_render_object(render, object, from);
        }
    return sum;
}
