/// The finder of ways: its memory, and the way that a search has found.
#include "analysis/route/route.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <string.h>

// --- the finder

static void drop_tables(sl_context *context, sl_route_finder *f) {
    sl_free(context, f->corner_of);
    sl_free(context, f->part_of);
    sl_free(context, f->ends);
    sl_free(context, f->counts);
    sl_free(context, f->corners);
    sl_free(context, f->turns);
    sl_free(context, f->at_start);
    sl_free(context, f->at_goal);
    sl_free(context, f->list);
    sl_free(context, f->losses);
    sl_free(context, f->cells);
    f->losses = NULL;
    f->cells = NULL;
    f->corner_of = f->part_of = f->ends = f->counts = f->at_start = f->at_goal = f->list = NULL;
    f->corners = NULL;
    f->turns = NULL;
    f->space = NULL;
    sli_route_drop_blocks(context, &f->blocks);
    sl_space_destroy(context, &f->room);
}

static void drop_all(sl_context *context, sl_route_finder *f) {
    drop_tables(context, f);
    sli_box_tree_destroy(context, &f->walls);
    sl_route_finder_destroy(context, f->point);
    f->point = NULL;
    f->has_all = false;
    f->grown = 0;
}

/// The losses of the doors, by portal.
static sl_status make_losses(sl_context *context, sl_route_finder *f, const sl_space *space) {
    if (!f->by_door) return SL_OK;
    f->losses = sl_alloc_array(context, space->portal_count, sizeof *f->losses);
    if (!f->losses) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->seam_portal_count; i++) {
        const sl_seam *seam = &space->seams[space->seam_portals[i].seam];
        if (seam->kind == SL_SEAM_DOOR && seam->number < f->door_count)
            f->losses[space->seam_portals[i].portal] += f->by_door[seam->number];
    }
    return SL_OK;
}

/// Whether some portal is crossed one way only.
static bool has_glass(const sl_space *s, uint32_t *counts) {
    bool found = false;
    memset(counts, 0, s->portal_count * sizeof *counts);
    for (uint32_t c = 0; c < s->cell_count; c++)
        for (uint32_t k = 0; k < s->cells[c].directed_count; k++)
            counts[s->directed[s->cells[c].first_directed + k].portal]++;
    for (uint32_t i = 0; i < s->portal_count && !found; i++) found = counts[i] == 1;
    return found;
}

static sl_status make_tables(sl_context *context, sl_route_finder *f, const sl_space *space) {
    const size_t ends = (f->by_door ? 4 : 2) * (size_t)space->portal_count,
                 sides = 2 * (size_t)space->directed_count;
    f->corner_of = sl_alloc_array(context, sides, sizeof *f->corner_of);
    f->part_of = sl_alloc_array(context, space->cell_count, sizeof *f->part_of);
    f->ends = sl_alloc_array(context, ends, sizeof *f->ends);
    f->counts = sl_alloc_array(context, ends, sizeof *f->counts);
    f->corners = sl_alloc_array(context, ends, sizeof *f->corners);
    f->turns = sl_alloc_array(context, sides, sizeof *f->turns);
    f->cells = sl_alloc_array(context, space->cell_count, sizeof *f->cells);
    f->at_start = sl_alloc_array(context, space->cell_count, sizeof *f->at_start);
    f->at_goal = sl_alloc_array(context, space->cell_count, sizeof *f->at_goal);
    f->list = sl_alloc_array(context, space->cell_count, sizeof *f->list);
    if (!f->corner_of || !f->part_of || !f->ends || !f->counts || !f->corners || !f->turns ||
        !f->cells || !f->at_start || !f->at_goal || !f->list)
        return SL_NO_MEMORY;
    SL_TRY(make_losses(context, f, space));
    f->space = space;
    f->stamp = 0;
    f->has_glass = has_glass(space, f->counts);
    SL_TRY(sli_route_corners(context, f));
    return sli_route_find_blocks(context, f);
}

/// The middle of a walker is on one side of glass, and the rest of it on the other.
static sl_status check_glass(sl_context *context, const sl_space *space) {
    for (uint32_t i = 0; i < space->seam_count; i++)
        if (space->seams[i].kind == SL_SEAM_ONEWAY)
            return sl_fail(context, SL_UNSUPPORTED,
                           "ways for a walker with a radius do not pass one-way glass: use radius "
                           "0, or a map without it");
    return SL_OK;
}

sl_status sli_route_make_room(sl_context *context, sl_route_finder *finder,
                              const sli_route_part *part) {
    drop_tables(context, finder);
    SL_TRY(sli_route_grow(context, finder->point->space, finder->radius, part, &finder->room));
    return make_tables(context, finder, &finder->room);
}

sl_status sl_route_finder_update(sl_context *context, sl_route_finder *finder) {
    const sl_space *space;
    drop_all(context, finder);
    SL_TRY(sl_query_space(context, finder->query, &space, NULL));
    if (space->loose)
        return sl_fail(context, SL_UNSUPPORTED,
                       "ways need a space without gaps: bake the map again");
    if (!(finder->radius > 0)) return make_tables(context, finder, space);
    SL_TRY(check_glass(context, space));
    SL_TRY(sli_route_index_walls(context, space, &finder->walls));
    return sl_route_finder_create(context, finder->query, &finder->point);
}

sl_status sl_route_finder_set_radius(sl_context *context, sl_route_finder *finder, double radius) {
    if (!(radius >= 0 && radius <= SL_COORDINATE_MAX))
        return sl_fail(context, SL_BAD_ARGUMENT, "the radius is %.9g: expected 0 to %g", radius,
                       SL_COORDINATE_MAX);
    if (radius > 0 && finder->by_door)
        return sl_fail(context, SL_UNSUPPORTED, "a walker with a radius passes no door at a loss");
    finder->radius = radius;
    return sl_route_finder_update(context, finder);
}

sl_status sl_route_finder_set_losses(sl_context *context, sl_route_finder *finder,
                                     const double *losses, size_t count) {
    double *own = NULL;
    if (losses && finder->radius > 0)
        return sl_fail(context, SL_UNSUPPORTED, "a walker with a radius passes no door at a loss");
    for (size_t i = 0; losses && i < count; i++)
        if (!(losses[i] >= 0 && isfinite(losses[i])))
            return sl_fail(context, SL_BAD_ARGUMENT,
                           "the loss of door %zu is %.9g: it must be 0 or more", i, losses[i]);
    if (losses && !(own = sl_alloc_array(context, count, sizeof *own))) return SL_NO_MEMORY;
    for (size_t i = 0; losses && i < count; i++) own[i] = losses[i];
    sl_free(context, finder->by_door);
    finder->by_door = own;
    finder->door_count = own ? count : 0;
    return sl_route_finder_update(context, finder);
}

sl_status sl_route_finder_create(sl_context *context, sl_query *query, sl_route_finder **out) {
    sl_route_finder *finder = sl_alloc_array(context, 1, sizeof *finder);
    if (!finder) return SL_NO_MEMORY;
    finder->query = query;
    const sl_status status = sl_route_finder_update(context, finder);
    if (status == SL_OK)
        *out = finder;
    else
        sl_route_finder_destroy(context, finder);
    return status;
}

void sl_route_finder_destroy(sl_context *context, sl_route_finder *finder) {
    if (!finder) return;
    drop_all(context, finder);
    sl_free(context, finder->by_door);
    sl_free(context, finder->nodes.items);
    sl_free(context, finder->open.items);
    sl_free(context, finder);
}

void sl_route_destroy(sl_context *context, sl_route *route) {
    sl_free(context, route->points);
    sl_free(context, route->portals);
    *route = (sl_route){0};
}

// --- the way

/// Adds a point at the end. A point in line with its neighbours is no corner.
static void add_point(sl_route *route, sl_point p) {
    size_t n = route->count;
    if (n && sli_same_point(route->points[n - 1], p)) return;
    while (n > 1 && sli_orient(route->points[n - 2], route->points[n - 1], p) == 0 &&
           sli_goes_on(route->points[n - 2], route->points[n - 1], p))
        n--;
    route->points[n] = p;
    route->count = n + 1;
}

static void turn_over(void *items, size_t count, size_t size) {
    char *first = items, keep[sizeof(sl_point)];
    for (size_t i = 0; i < count / 2; i++) {
        char *a = first + i * size, *b = first + (count - 1 - i) * size;
        memcpy(keep, a, size);
        memcpy(a, b, size);
        memcpy(b, keep, size);
    }
}

/// The sum of the pieces and of the losses on the way.
static double length_of(const sl_route_finder *f, const sl_route *route) {
    double sum = 0, rest = 0;
    for (size_t i = 0; i < route->portal_count; i++) sum += sli_route_loss(f, route->portals[i]);
    for (size_t i = 1; i < route->count; i++) {
        const sl_point a = route->points[i - 1], b = route->points[i];
        double left_out;
        sum = sli_two_sum(sum, sli_length(b.x - a.x, b.y - a.y), &left_out);
        rest += left_out;
    }
    return sum + rest;
}

/// Whether a node came through a portal; others only turn, or end.
static bool passes_portal(const sl_route_finder *f, const sli_route_node *node) {
    return !node->is_last && node->entry != SLI_ROUTE_NONE &&
           node->entry != f->nodes.items[node->parent].entry;
}

static sl_status add_portal(sl_context *context, sl_route *route, uint32_t portal) {
    SL_TRY(sl_reserve(context, &route->portals, &route->portal_room, route->portal_count + 1,
                      sizeof *route->portals));
    route->portals[route->portal_count++] = portal;
    return SL_OK;
}

/// The directed portal of a cell by which one goes on around a point; NULL: there is none.
static const sl_directed_portal *next_around(const sl_route_finder *f, uint32_t cell,
                                             uint32_t portal, sl_point at, int side) {
    const sl_cell *c = &f->space->cells[cell];
    for (uint32_t k = 0; k < c->directed_count; k++) {
        const sl_directed_portal *d = &f->space->directed[c->first_directed + k];
        if (d->portal != portal && !(sli_route_loss(f, d->portal) > 0) &&
            sli_same_point(side == SLI_ROUTE_LEFT ? d->left : d->right, at))
            return d;
    }
    return NULL;
}

/// Adds the portals that lead around a corner from one cell to another one, the last one first.
static sl_status add_around(sl_context *context, const sl_route_finder *f, uint32_t from,
                            uint32_t to, sl_point at, sl_route *route) {
    const size_t count = route->portal_count;
    for (int side = 0; side < 2; side++) {
        const sl_directed_portal *d = NULL;
        for (uint32_t cell = from; cell != to; cell = d->cell) {
            d = next_around(f, cell, d ? d->portal : SLI_ROUTE_NONE, at, side);
            if (!d || d->cell == from) break;
            SL_TRY(add_portal(context, route, d->portal));
        }
        if (d && d->cell == to) break;
        route->portal_count = count;
    }
    turn_over(route->portals + count, route->portal_count - count, sizeof *route->portals);
    return SL_OK;
}

/// The way to a last node, from its end.
static sl_status read_way(sl_context *context, const sl_route_finder *f, uint32_t last,
                          sl_point from, sl_point to, sl_route *route) {
    const sli_route_node *nodes = f->nodes.items;
    SL_TRY(sl_reserve(context, &route->points, &route->room, 2, sizeof *route->points));
    add_point(route, to);
    for (uint32_t i = last; i != SLI_ROUTE_NONE; i = nodes[i].parent) {
        const uint32_t turning = sli_route_turning(f, i);
        if (nodes[turning].cell != nodes[i].cell)
            SL_TRY(
                add_around(context, f, nodes[turning].cell, nodes[i].cell, nodes[i].root, route));
        i = turning;
        SL_TRY(sl_reserve(context, &route->points, &route->room, route->count + 2,
                          sizeof *route->points));
        add_point(route, nodes[i].root);
        if (passes_portal(f, &nodes[i]))
            SL_TRY(add_portal(context, route, f->space->directed[nodes[i].entry].portal));
    }
    if (route->count == 1) route->points[route->count++] = from; // the two points are one
    turn_over(route->points, route->count, sizeof *route->points);
    turn_over(route->portals, route->portal_count, sizeof *route->portals);
    route->length = length_of(f, route);
    route->found = true;
    return SL_OK;
}

sl_status sli_route_stand_in(sl_context *context, const sl_route_finder *f, const char *name,
                             sl_point at, uint32_t *cell) {
    const sl_space *space;
    SL_TRY(sl_query_space(context, f->query, &space, NULL));
    *cell = sl_space_locate(space, at);
    if (*cell == SL_NO_CELL)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %.9g,%.9g is outside the map's bounds", name,
                       at.x, at.y);
    if (space->cells[*cell].solid)
        return sl_fail(context, SL_BAD_ARGUMENT, "%s %.9g,%.9g is in solid ground", name, at.x,
                       at.y);
    if (!(f->radius > 0)) return SL_OK;
    return sli_route_check_room(context, space, &f->walls, f->radius, name, at);
}

void sli_route_begin(sl_route_finder *f) {
    if (++f->stamp) return;
    const size_t cells = f->space->cell_count;
    memset(f->at_start, 0, cells * sizeof *f->at_start);
    memset(f->at_goal, 0, cells * sizeof *f->at_goal);
    memset(f->cells, 0, cells * sizeof *f->cells);
    memset(f->corners, 0,
           (f->losses ? 4 : 2) * (size_t)f->space->portal_count * sizeof *f->corners);
    memset(f->turns, 0, 2 * (size_t)f->space->directed_count * sizeof *f->turns);
    if (f->blocks.stamp) memset(f->blocks.stamp, 0, cells * sizeof *f->blocks.stamp);
    f->stamp = 1;
}

static void empty_route(sl_route *route) {
    route->found = false;
    route->count = route->portal_count = 0;
    route->length = 0;
}

sl_status sli_route_find_here(sl_context *context, sl_route_finder *f, sl_point from, sl_point to,
                              sl_route *route) {
    const uint32_t start = sl_space_locate(f->space, from), goal = sl_space_locate(f->space, to);
    uint32_t last = SLI_ROUTE_NONE;
    uint64_t nodes = 0;
    empty_route(route);
    sli_route_begin(f);
    const uint32_t goals = sli_route_stand(f, to, goal, f->at_goal);
    if (f->part_of[start] != f->part_of[goal]) return SL_OK;
    for (uint32_t i = 0; i < goals; i++) sli_route_open_blocks(f, start, f->list[i]);
    SL_TRY(sli_route_search(context, f, from, to, &nodes, &last));
    route->nodes += nodes;
    return last == SLI_ROUTE_NONE ? SL_OK : read_way(context, f, last, from, to, route);
}

sl_status sl_route_find(sl_context *context, sl_route_finder *finder, sl_point from, sl_point to,
                        sl_route *route) {
    uint32_t start, goal;
    empty_route(route);
    route->nodes = 0;
    SL_TRY(sli_route_stand_in(context, finder, "from", from, &start));
    SL_TRY(sli_route_stand_in(context, finder, "to", to, &goal));
    if (finder->radius > 0)
        SL_TRY(sli_route_find_wide(context, finder, from, to, route));
    else
        SL_TRY(sli_route_find_here(context, finder, from, to, route));
    if (finder->radius > 0) route->portal_count = 0; // they are not the query's
    if (route->found) return SL_OK;
    sli_route_stand(finder, from, sl_space_locate(finder->space, from), finder->at_start);
    route->nearest = sli_route_nearest(finder, to);
    return SL_OK;
}

sl_status sli_route_widen(sl_context *context, const sl_space *space, double limit, double *out) {
    const sl_box *b = &space->bounds;
    if (!(limit >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "the limit is %.9g: it must be 0 or more", limit);
    *out = limit * (1 + 0x1p-30) + 0x1p-38 * sli_greater(b->max.x - b->min.x, b->max.y - b->min.y);
    return SL_OK;
}

sl_status sl_route_distances(sl_context *context, sl_route_finder *finder, sl_point from,
                             double limit, sl_route_near *cells) {
    uint32_t start;
    double most = 0;
    if (finder->radius > 0)
        return sl_fail(context, SL_UNSUPPORTED,
                       "distances of cells are those of a walker without a radius");
    SL_TRY(sli_route_widen(context, finder->space, limit, &most));
    SL_TRY(sli_route_stand_in(context, finder, "from", from, &start));
    sli_route_begin(finder);
    return sli_route_spread(context, finder, from, most, cells, NULL, NULL);
}
