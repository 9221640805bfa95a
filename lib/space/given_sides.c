/// What the sides of given cells are: walls, or shared with another cell. Places within the map's
/// snapping distance of each other are one; with none, what is exactly the same.
#include "space/given.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_points(sl_point a, sl_point b) {
    if (a.x != b.x) return a.x < b.x ? -1 : 1;
    return (a.y > b.y) - (a.y < b.y);
}

static sl_bsp_sides *sides_of(const sl_given *given, size_t face) {
    return &given->bsp.faces.items[face].sides;
}

static size_t count_sides(const sl_given *given) {
    size_t count = 0;
    for (size_t f = 0; f < given->bsp.faces.count; f++) count += sides_of(given, f)->count;
    return count;
}

// --- pairs of sides

/// A side, its ends in order.
typedef struct edge {
    sl_point low, high;
    uint32_t face, side;
    bool forward; ///< the side runs from low to high
} edge;

static int compare_edges(const void *left, const void *right) {
    const edge *a = left, *b = right;
    int order = compare_points(a->low, b->low);
    if (!order) order = compare_points(a->high, b->high);
    if (!order) order = (a->face > b->face) - (a->face < b->face);
    return order ? order : (a->side > b->side) - (a->side < b->side);
}

/// All sides that are no walls, those with the same ends together.
static sl_status gather_edges(const sl_given *given, edge **out, size_t *count) {
    edge *edges = sl_alloc_array(given->bsp.context, count_sides(given), sizeof *edges);
    if (!edges) return SL_NO_MEMORY;
    size_t n = 0;
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = sides_of(given, f);
        for (size_t i = 0; i < sides->count; i++) {
            if (sides->items[i].what < SL_BEYOND_BORDER) continue;
            const sl_point from = sides->items[i].from, to = sl_side_end(sides, i);
            const bool forward = compare_points(from, to) < 0;
            edges[n++] = (edge){.low = forward ? from : to,
                                .high = forward ? to : from,
                                .face = (uint32_t)f,
                                .side = (uint32_t)i,
                                .forward = forward};
        }
    }
    if (n) qsort(edges, n, sizeof *edges, compare_edges);
    *out = edges;
    *count = n;
    return SL_OK;
}

static bool same_ends(const edge *a, const edge *b) {
    return sl_same_point(a->low, b->low) && sl_same_point(a->high, b->high);
}

static void join(const sl_given *given, const edge *a, const edge *b) {
    sl_bsp_side *one = &sides_of(given, a->face)->items[a->side];
    sl_bsp_side *other = &sides_of(given, b->face)->items[b->side];
    one->what = other->what = SL_BEYOND_EXIT;
    one->beyond = b->face;
    other->beyond = a->face;
}

static sl_status pair_edges(const sl_given *given, const edge *edges, size_t count) {
    for (size_t i = 0; i < count;) {
        size_t end = i + 1;
        while (end < count && same_ends(&edges[i], &edges[end])) end++;
        const edge *a = &edges[i], *b = &edges[end - 1];
        sl_bsp_side *side = &sides_of(given, a->face)->items[a->side];
        side->what = SL_BEYOND_BORDER;
        side->beyond = SL_NO_FACE;
        if (end - i > 2 || (end - i == 2 && (a->forward == b->forward || a->face == b->face)))
            return sl_given_fail(given, b->face,
                                 "has the side %g %g to %g %g, which cell %lu has at the same "
                                 "hand: the two overlap",
                                 a->low.x, a->low.y, a->high.x, a->high.y,
                                 (unsigned long)given->of.items[a->face]);
        if (end - i == 2) join(given, a, b);
        i = end;
    }
    return SL_OK;
}

sl_status sl_given_pair(sl_given *given) {
    edge *edges = NULL;
    size_t count = 0;
    SL_TRY(gather_edges(given, &edges, &count));
    const sl_status status = pair_edges(given, edges, count);
    sl_free(given->bsp.context, edges);
    return status;
}

// --- corners that mean the same place

typedef struct place {
    sl_point at;
    sl_bsp_side *side; ///< that starts there; NULL for the end of a wall
} place;

static int compare_places(const void *left, const void *right) {
    const place *a = left, *b = right;
    const int order = compare_points(a->at, b->at);
    return order ? order : (a->side != NULL) - (b->side != NULL);
}

static double distance(sl_point a, sl_point b) {
    return hypot(a.x - b.x, a.y - b.y);
}

/// The nearest of the points before the end of a list sorted by x that is within `snap`.
static const sl_point *nearest_before(const sl_point *points, size_t count, sl_point at,
                                      double snap) {
    const sl_point *found = NULL;
    for (size_t i = count; i-- > 0 && points[i].x >= at.x - snap;)
        if (distance(points[i], at) <= (found ? distance(*found, at) : snap)) found = &points[i];
    return found;
}

/// Moves each corner to the nearest wall's end, or else to the first corner that is near enough.
static void snap_places(place *places, size_t count, double snap, sl_point *ends,
                        sl_point *corners) {
    size_t end_count = 0, corner_count = 0, reach = 0;
    for (size_t i = 0; i < count; i++)
        if (!places[i].side) ends[end_count++] = places[i].at;
    for (size_t i = 0; i < count; i++) {
        if (!places[i].side) continue;
        const sl_point at = places[i].at;
        while (reach < end_count && ends[reach].x <= at.x + snap) reach++;
        const sl_point *to = nearest_before(ends, reach, at, snap);
        if (!to) to = nearest_before(corners, corner_count, at, snap);
        if (to)
            places[i].side->from = *to;
        else
            corners[corner_count++] = at;
    }
}

static void drop_repeated(sl_bsp_sides *sides) {
    size_t kept = 0;
    for (size_t i = 0; i < sides->count; i++)
        if (!sl_same_point(sides->items[i].from, sl_side_end(sides, i)))
            sides->items[kept++] = sides->items[i];
    sides->count = kept;
}

static sl_status snap_corners(sl_given *given) {
    sl_context *context = given->bsp.context;
    const sl_map *map = given->map;
    const size_t most = count_sides(given) + 2 * map->wall_count;
    place *places = sl_alloc_array(context, most, sizeof *places);
    sl_point *ends = sl_alloc_array(context, most, sizeof *ends);
    sl_point *corners = sl_alloc_array(context, most, sizeof *corners);
    if (places && ends && corners) {
        size_t n = 0;
        for (size_t i = 0; i < map->wall_count; i++) {
            places[n++].at = map->walls[i].a;
            places[n++].at = map->walls[i].b;
        }
        for (size_t f = 0; f < given->bsp.faces.count; f++)
            for (size_t i = 0; i < sides_of(given, f)->count; i++) {
                sl_bsp_side *side = &sides_of(given, f)->items[i];
                places[n++] = (place){side->from, side};
            }
        qsort(places, n, sizeof *places, compare_places);
        snap_places(places, n, map->snap, ends, corners);
    }
    const bool done = places && ends && corners;
    sl_free(context, places);
    sl_free(context, ends);
    sl_free(context, corners);
    if (!done) return SL_NO_MEMORY;
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        drop_repeated(sides_of(given, f));
        if (sides_of(given, f)->count < 3)
            return sl_given_fail(given, (uint32_t)f, "is no wider than the snapping distance %g",
                                 map->snap);
    }
    return SL_OK;
}

// --- near a side

static bool in_box(sl_point a, sl_point b, sl_point p) {
    return fmin(a.x, b.x) <= p.x && p.x <= fmax(a.x, b.x) && fmin(a.y, b.y) <= p.y &&
           p.y <= fmax(a.y, b.y);
}

/// The share of the way from a to b that is nearest to a point.
static double share_along(sl_point a, sl_point b, sl_point p) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    return (dx * (p.x - a.x) + dy * (p.y - a.y)) / (dx * dx + dy * dy);
}

/// Whether a point is on a segment, or within `snap` of it; the same for both its directions.
static bool is_at(sl_point a, sl_point b, sl_point p, double snap) {
    if (sl_orient(a, b, p) == 0 && in_box(a, b, p)) return true;
    if (!(snap > 0)) return false;
    if (compare_points(a, b) > 0) return is_at(b, a, p, snap);
    const double share = fmin(fmax(share_along(a, b, p), 0), 1);
    return distance(p, (sl_point){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}) <= snap;
}

// --- T-junctions

/// A corner to be put into a side.
typedef struct insert {
    uint32_t face, side;
    double share;
    sl_point at;
} insert;

typedef SL_ARRAY(insert) inserts;

static int compare_inserts(const void *left, const void *right) {
    const insert *a = left, *b = right;
    if (a->face != b->face) return a->face < b->face ? -1 : 1;
    if (a->side != b->side) return a->side < b->side ? -1 : 1;
    if (a->share != b->share) return a->share < b->share ? -1 : 1;
    return compare_points(a->at, b->at);
}

/// Sides as walls of a map, so that a grid can be made of them.
typedef struct open_sides {
    sl_map map;
    SL_ARRAY(edge) edges; ///< by wall of the map
    sl_wall_grid grid;
} open_sides;

static sl_status gather_open(const sl_given *given, open_sides *open) {
    sl_context *context = given->bsp.context;
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = sides_of(given, f);
        for (size_t i = 0; i < sides->count; i++) {
            if (sides->items[i].what != SL_BEYOND_BORDER) continue;
            SL_TRY(SL_ARRAY_ROOM(context, &open->edges, 1));
            open->edges.items[open->edges.count++] =
                (edge){.face = (uint32_t)f, .side = (uint32_t)i};
            SL_TRY(sl_map_add_wall(context, &open->map, sides->items[i].from, sl_side_end(sides, i),
                                   0));
        }
    }
    return SL_OK;
}

static sl_status add_inserts(const sl_given *given, const open_sides *open, sl_point at,
                             inserts *out) {
    const sl_box *b = &open->grid.bounds;
    const double snap = given->map->snap;
    if (at.x < b->min.x - snap || at.x > b->max.x + snap || at.y < b->min.y - snap ||
        at.y > b->max.y + snap)
        return SL_OK;
    uint32_t count;
    const uint32_t *near = sl_wall_grid_at(&open->grid, at, &count);
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *side = &open->map.walls[near[i]];
        if (sl_same_point(side->a, at) || sl_same_point(side->b, at)) continue;
        const double share = share_along(side->a, side->b, at);
        if (!(share > 0 && share < 1) || !is_at(side->a, side->b, at, snap)) continue;
        const edge *e = &open->edges.items[near[i]];
        SL_TRY(SL_ARRAY_ROOM(given->bsp.context, out, 1));
        out->items[out->count++] = (insert){e->face, e->side, share, at};
    }
    return SL_OK;
}

static sl_status find_inserts(const sl_given *given, open_sides *open, inserts *out) {
    const sl_map *map = given->map;
    SL_TRY(gather_open(given, open));
    if (!open->edges.count) return SL_OK;
    SL_TRY(sl_wall_grid_create(given->bsp.context, &open->map, map->snap, &open->grid));
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        if (f % 1024 == 0) SL_TRY(sl_check_cancelled(given->bsp.context));
        for (size_t i = 0; i < sides_of(given, f)->count; i++)
            SL_TRY(add_inserts(given, open, sides_of(given, f)->items[i].from, out));
    }
    for (size_t i = 0; i < map->wall_count; i++) {
        SL_TRY(add_inserts(given, open, map->walls[i].a, out));
        SL_TRY(add_inserts(given, open, map->walls[i].b, out));
    }
    return SL_OK;
}

/// Puts corners into the sides of a face: inserts[0 .. count) are all of it, in order.
static sl_status put_in(sl_given *given, const insert *list, size_t count) {
    const uint32_t face = list[0].face;
    sl_bsp_sides old = *sides_of(given, face), made = {0};
    sl_status status = SL_OK;
    for (size_t i = 0; i < old.count && status == SL_OK; i++) {
        sl_bsp_side side = old.items[i];
        status = sl_bsp_add_side(given->bsp.context, &made, side);
        for (; count && list->side == i && status == SL_OK; list++, count--) {
            if (sl_same_point(made.items[made.count - 1].from, list->at)) continue;
            side.from = list->at;
            status = sl_bsp_add_side(given->bsp.context, &made, side);
        }
    }
    if (status != SL_OK) {
        sl_free(given->bsp.context, made.items);
        return status;
    }
    sl_free(given->bsp.context, old.items);
    *sides_of(given, face) = made;
    return SL_OK;
}

/// Puts a corner into each side that is not known wherever a cell's corner or a wall's end lies on
/// it.
static sl_status split_sides(sl_given *given) {
    open_sides open = {0};
    inserts list = {0};
    sl_status status = find_inserts(given, &open, &list);
    if (list.count) qsort(list.items, list.count, sizeof *list.items, compare_inserts);
    for (size_t i = 0; i < list.count && status == SL_OK;) {
        size_t end = i + 1;
        while (end < list.count && list.items[end].face == list.items[i].face) end++;
        status = put_in(given, &list.items[i], end - i);
        i = end;
    }
    sl_map_destroy(given->bsp.context, &open.map);
    sl_wall_grid_destroy(given->bsp.context, &open.grid);
    sl_free(given->bsp.context, open.edges.items);
    sl_free(given->bsp.context, list.items);
    return status;
}

// --- walls

/// The first wall that both ends of a side are at; SL_NO_WALL for none.
static uint32_t find_wall(const sl_given *given, sl_point from, sl_point to) {
    const sl_map *map = given->map;
    const sl_point middle = {from.x + (to.x - from.x) / 2, from.y + (to.y - from.y) / 2};
    uint32_t count, found = SL_NO_WALL;
    const uint32_t *near = sl_wall_grid_at(&given->grid, middle, &count);
    for (uint32_t i = 0; i < count; i++) {
        const sl_wall *wall = &map->walls[near[i]];
        if (near[i] < found && !sl_same_point(wall->a, wall->b) &&
            is_at(wall->a, wall->b, from, map->snap) && is_at(wall->a, wall->b, to, map->snap))
            found = near[i];
    }
    return found;
}

static void find_walls(sl_given *given) {
    for (size_t f = 0; f < given->bsp.faces.count && given->map->wall_count; f++) {
        const sl_bsp_sides *sides = sides_of(given, f);
        for (size_t i = 0; i < sides->count; i++) {
            sl_bsp_side *side = &sides->items[i];
            if (side->what != SL_BEYOND_BORDER) continue;
            const uint32_t wall = find_wall(given, side->from, sl_side_end(sides, i));
            if (wall != SL_NO_WALL) side->what = wall;
        }
    }
}

/// Along which way of its wall each side runs.
static void direct_walls(sl_given *given) {
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = sides_of(given, f);
        for (size_t i = 0; i < sides->count; i++) {
            sl_bsp_side *side = &sides->items[i];
            if (side->what >= SL_BEYOND_BORDER) continue;
            const sl_wall *wall = &given->map->walls[side->what];
            const sl_point to = sl_side_end(sides, i);
            side->reversed = (to.x - side->from.x) * (wall->b.x - wall->a.x) +
                                 (to.y - side->from.y) * (wall->b.y - wall->a.y) <
                             0;
        }
    }
}

// --- sides of nothing

/// Whether all corners of all cells are on the left of a side or on its line: sight that leaves
/// there comes back nowhere.
static bool is_outermost(const sl_given *given, sl_point from, sl_point to) {
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = sides_of(given, f);
        for (size_t i = 0; i < sides->count; i++)
            if (sl_orient(from, to, sides->items[i].from) < 0) return false;
    }
    return true;
}

static sl_status check_open(const sl_given *given) {
    for (size_t f = 0; f < given->bsp.faces.count; f++) {
        const sl_bsp_sides *sides = sides_of(given, f);
        for (size_t i = 0; i < sides->count; i++) {
            if (sides->items[i].what != SL_BEYOND_BORDER) continue;
            SL_TRY(sl_check_cancelled(given->bsp.context));
            const sl_point from = sides->items[i].from, to = sl_side_end(sides, i);
            if (!is_outermost(given, from, to))
                return sl_given_fail(given, (uint32_t)f,
                                     "has the side %g %g to %g %g, which is along no wall and "
                                     "shared with no cell: sightlines would be lost there; close "
                                     "the gap, or let places farther apart be one (snap)",
                                     from.x, from.y, to.x, to.y);
        }
    }
    return SL_OK;
}

sl_status sl_given_know_sides(sl_given *given) {
    const sl_map *map = given->map;
    if (map->snap > 0 && !map->corner_walls) SL_TRY(snap_corners(given));
    // Cells that tell their walls are only asked about the sides that are left over.
    if (map->corner_walls) SL_TRY(sl_given_pair(given));
    SL_TRY(split_sides(given));
    find_walls(given);
    SL_TRY(sl_given_pair(given));
    direct_walls(given);
    return check_open(given);
}
