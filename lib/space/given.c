/// Cells that a map brings along (a node builder's, or anyone's), taken as they are into a space.
///
/// Such cells have been rounded: corners that should lie on a straight side bend it, cells meet in
/// T-junctions, corners stand off their walls. What is done about it, in this order: sides that two
/// cells share are found and get the same ends; corners on walls are moved onto the wall's line or
/// behind it, as seen from the cells; cells that are still bent are cut by a diagonal from the
/// bend. Nothing is visible or hidden for it by an epsilon: what comes out is checked by exact
/// signs, and refused where it does not keep the promise of a space.
#include "space/given.h"

#include "space/kd_tree.h"

#include <math.h>
#include <stdarg.h>

sl_status sl_given_fail(const sl_given *given, uint32_t face, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const uint32_t cell = given->of.items[face];
    return sl_fail_at(given->bsp.context, given->source, given->map->cells[cell].line,
                      "cell %lu %s", (unsigned long)cell, text);
}

// --- faces

static double twice_area(const sl_point *corners, size_t count) {
    double sum = 0;
    for (size_t i = 2; i < count; i++)
        sum += (corners[i - 1].x - corners[0].x) * (corners[i].y - corners[0].y) -
               (corners[i].x - corners[0].x) * (corners[i - 1].y - corners[0].y);
    return sum;
}

/// Adds the face of one cell, counter-clockwise.
static sl_status add_face(sl_given *given, uint32_t number) {
    sl_bsp *bsp = &given->bsp;
    const sl_map_cell *cell = &given->map->cells[number];
    const sl_point *corners = given->map->corners + cell->first;
    const uint32_t *walls =
        given->map->corner_walls ? given->map->corner_walls + cell->first : NULL;
    const double area = twice_area(corners, cell->count);
    // What rounding has left no area is between its neighbours no more: their sides are shared.
    if (!(area > 0) && !(area < 0)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->faces, 1));
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &given->of, 1));
    const uint32_t face = (uint32_t)bsp->faces.count;
    given->of.items[given->of.count++] = number;
    sl_bsp_sides *sides = &bsp->faces.items[bsp->faces.count++].sides;
    bsp->faces.items[face] = (sl_bsp_face){0};
    for (size_t i = 0; i < cell->count; i++) {
        // Clockwise, the side behind a corner is the one that led to it.
        const size_t k = area > 0 ? i : cell->count - 1 - i;
        const size_t next = area > 0 ? (k + 1) % cell->count : (k ? k - 1 : cell->count - 1);
        const size_t side = area > 0 ? k : next;
        if (sl_same_point(corners[k], corners[next])) continue;
        const uint32_t wall = walls ? walls[side] : SL_NO_WALL;
        SL_TRY(sl_bsp_add_side(bsp->context, sides,
                               (sl_bsp_side){.from = corners[k],
                                             .what = wall == SL_NO_WALL ? SL_BEYOND_BORDER : wall,
                                             .beyond = SL_NO_FACE}));
    }
    return sides->count >= 3 ? SL_OK : sl_given_fail(given, face, "has fewer than three sides");
}

static sl_status add_faces(sl_given *given) {
    for (size_t i = 0; i < given->map->cell_count; i++) {
        if (i % 1024 == 0) SL_TRY(sl_check_cancelled(given->bsp.context));
        SL_TRY(add_face(given, (uint32_t)i));
    }
    if (given->bsp.faces.count) return SL_OK;
    return sl_fail_at(given->bsp.context, given->source, 0, "the map's cells enclose no area");
}

// --- what must hold

/// Whether a wall has a point in common with a closed convex polygon.
static bool meets(const sl_bsp_sides *sides, const sl_wall *wall) {
    bool left = false, right = false;
    for (size_t i = 0; i < sides->count; i++) {
        const sl_point from = sides->items[i].from, to = sl_side_end(sides, i);
        if (sl_orient(from, to, wall->a) < 0 && sl_orient(from, to, wall->b) < 0) return false;
        const int sign = sl_orient(wall->a, wall->b, from);
        left |= sign >= 0;
        right |= sign <= 0;
    }
    return left && right;
}

/// A wall's side must have its wall in front of it all along, or on it.
static sl_status check_wall(const sl_given *given, uint32_t face, const sl_bsp_side *side,
                            sl_point to) {
    const sl_bsp_sides *sides = &given->bsp.faces.items[face].sides;
    const sl_wall *wall = &given->map->walls[side->what];
    const sl_point from = side->from;
    if (!sl_bsp_behind(wall, side->reversed, from) || !sl_bsp_behind(wall, side->reversed, to))
        return sl_given_fail(given, face,
                             "has the side %g %g to %g %g along a wall, but reaches beyond it "
                             "with a corner that belongs to another wall",
                             from.x, from.y, to.x, to.y);
    if (!meets(sides, wall) || sl_bsp_holds(sides, wall->a) || sl_bsp_holds(sides, wall->b))
        return sl_given_fail(given, face,
                             "has the side %g %g to %g %g along a wall that ends before it does",
                             from.x, from.y, to.x, to.y);
    return SL_OK;
}

static sl_status check_faces(const sl_given *given) {
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = &given->bsp.faces.items[f].sides;
        for (size_t i = 0; i < sides->count; i++)
            if (sides->items[i].what < SL_BEYOND_BORDER)
                SL_TRY(check_wall(given, (uint32_t)f, &sides->items[i], sl_side_end(sides, i)));
    }
    return SL_OK;
}

/// How deep a point lies in a cell.
static double depth_in(const sl_space *space, uint32_t number, sl_point p) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    double depth = HUGE_VAL;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = v[i], b = v[i + 1 == cell->vertex_count ? 0 : i + 1];
        const double dx = b.x - a.x, dy = b.y - a.y;
        depth = fmin(depth, (dx * (p.y - a.y) - dy * (p.x - a.x)) / hypot(dx, dy));
    }
    return depth;
}

/// Where no wall is inside a cell, cells can only overlap by more than rounding where the same
/// walls enclose them: the middle of one is then within another.
static sl_status check_overlap(sl_context *context, const sl_space *space) {
    const sl_box *b = &space->bounds;
    const double slack = 0x1p-20 * fmax(b->max.x - b->min.x, b->max.y - b->min.y);
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        sl_point middle = {0, 0};
        for (uint32_t k = 0; k < cell->vertex_count; k++) {
            middle.x += space->vertices[cell->first_vertex + k].x / cell->vertex_count;
            middle.y += space->vertices[cell->first_vertex + k].y / cell->vertex_count;
        }
        const uint32_t found = sl_space_locate(space, middle);
        if (found != i && found != SL_NO_CELL && depth_in(space, found, middle) > slack)
            return sl_fail(context, SL_BAD_INPUT, "two of them overlap at %g %g", middle.x,
                           middle.y);
    }
    return SL_OK;
}

// --- all of it

static sl_status make_faces(sl_given *given, size_t *taken) {
    SL_TRY(add_faces(given));
    *taken = given->bsp.faces.count;
    SL_TRY(sl_given_know_sides(given));
    SL_TRY(sl_given_place(given));
    SL_TRY(sl_given_cut(given));
    SL_TRY(sl_given_pair(given));
    SL_TRY(check_faces(given));
    return sl_given_plant(given);
}

static void destroy(sl_given *given) {
    sl_context *context = given->bsp.context;
    for (size_t i = 0; i < given->bsp.faces.count; i++)
        sl_free(context, given->bsp.faces.items[i].sides.items);
    sl_free(context, given->bsp.faces.items);
    sl_free(context, given->bsp.nodes.items);
    sl_free(context, given->bsp.lines.items);
    sl_free(context, given->of.items);
    sl_wall_grid_destroy(context, &given->grid);
}

static sl_status make_space(sl_given *given, sl_space *space, size_t *taken) {
    sl_context *context = given->bsp.context;
    const sl_map *map = given->map;
    SL_TRY(sl_wall_grid_create(context, map, map->snap, &given->grid));
    SL_TRY(make_faces(given, taken));
    const sl_seam_parts no_seams = {0};
    SL_TRY(sl_bsp_make_space(&given->bsp, &no_seams, space));
    SL_TRY(sl_mark_inside(context, map, NULL, space));
    sl_status status = sl_space_check(context, space);
    if (status == SL_OK) status = check_overlap(context, space);
    if (status != SL_BAD_INPUT) return status;
    char fault[256];
    snprintf(fault, sizeof fault, "%.250s", sl_context_message(context));
    return sl_fail_at(context, given->source, 0, "the map's cells cannot be taken: %s", fault);
}

sl_status sl_subdivide_given(sl_context *context, const sl_map *map, sl_space *out) {
    sl_given given = {.map = map, .source = map->source ? map->source : "the map"};
    given.bsp = (sl_bsp){.context = context,
                         .walls = map->walls,
                         .wall_count = (uint32_t)map->wall_count,
                         .bounds = sl_padded(sl_map_bounds(map))};
    if (!map->cell_count)
        return sl_fail_at(context, given.source, 0, "the map brings no cells of its own");
    if (map->door_count || map->oneway_count || map->seam_count)
        return sl_fail(
            context, SL_UNSUPPORTED,
            "%s: cells of the map's own cannot tell doors, one-way glass or seams; leave "
            "them out (--without)",
            given.source);
    if (map->cell_count > INT32_MAX / 2 || map->wall_count >= INT32_MAX - 1)
        return sl_fail_memory(context);
    sl_space space = {.bounds = given.bsp.bounds, .partial = 1};
    size_t taken = 0;
    const sl_status status = make_space(&given, &space, &taken);
    destroy(&given);
    if (status != SL_OK) {
        sl_space_destroy(context, &space);
        return status;
    }
    sl_note(context,
            "the map brings %zu cells, %zu of them without area; %u were made of them, as those "
            "that are bent are cut",
            map->cell_count, map->cell_count - taken, space.cell_count);
    sl_report(context, "subdivide", "cells", space.cell_count, space.cell_count);
    *out = space;
    return SL_OK;
}
