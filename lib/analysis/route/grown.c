/// The plan as the middle of a walker with a radius meets it: each wall grown by the radius.
///
/// A grown wall is its two sides, moved apart by the radius R, and a round cap at each end. Where
/// walls meet, only the part of the circle is left that no wall at the point turns to:
///
///          . - v - .            the arc runs from the left normal of one wall to the right normal
///        s     |R    e          of the next one, if they lie more than half a turn apart. It is
///      --|-----p-----|--        replaced by tangents, which touch it in both ends: the walker
///        | wall  wall|          never comes nearer than R, and corners are up to R / cos(pi / 64)
///                               away.
///
/// The outline is closed. A place on it is as far as R from the walls, or on a tangent. If the wall
/// that is nearest to it is met between its ends, the place is on a side. Else it is nearest to an
/// end, in a direction in which no wall leaves from there: so it is on a tangent.
///
/// Only square roots are taken, so the outline is the same on every machine. All of it is pushed
/// out by more than cleaning and rounding may move it.
#include "analysis/route/route.h"

#include "geometry/length.h"
#include "geometry/orient.h"

#include <stdlib.h>

/// Neighbouring tangents turn by at most pi / 32, of which this is the cosine.
static const double STEP = 0.99518472667219688;

/// Two normals whose cosine is this or more are one: the arc between them is flatter than the
/// slack.
static const double FLAT = 1 - 0x1p-41;

/// Walls that lie apart by half a turn less this sine are met as if it was half a turn.
static const double STRAIGHT = 0x1p-20;

/// A wall as it leaves one of its ends.
typedef struct spoke {
    sl_point at, to;
    sl_point unit; ///< the direction, rounded; that of the other end is exactly the opposite
} spoke;

typedef struct growth {
    sl_context *context;
    double radius; ///< with the slack
    sl_map *map;
    sl_point last; ///< where the outline is
} growth;

/// What covers the rounding of coordinates as large as these, and the moves of cleaning.
static double slack_of(const sl_box *bounds, double radius) {
    const double most = sli_greater(sli_greater(fabs(bounds->min.x), fabs(bounds->max.x)),
                                    sli_greater(fabs(bounds->min.y), fabs(bounds->max.y)));
    return 0x1p-40 * (most + radius);
}

/// By place, then counter-clockwise.
static int compare_spokes(const void *first, const void *second) {
    const spoke *a = first, *b = second;
    const int place = sli_compare_points(a->at, b->at);
    return place ? place : sli_compare_around(a->at, a->to, b->to);
}

static sl_point left_of(sl_point d) {
    return (sl_point){-d.y, d.x};
}

static sl_point right_of(sl_point d) {
    return (sl_point){d.y, -d.x};
}

static sl_point moved(const growth *g, sl_point at, sl_point normal) {
    return (sl_point){at.x + g->radius * normal.x, at.y + g->radius * normal.y};
}

static sl_status go_to(growth *g, sl_point next) {
    const sl_point last = g->last;
    g->last = next;
    return sli_same_point(last, next) ? SL_OK : sl_map_add_wall(g->context, g->map, last, next, 0);
}

/// The middle of an arc of half a turn or less, counter-clockwise.
static sl_point middle_of(sl_point from, sl_point to, double cosine) {
    const sl_point a = cosine > 0 ? from : left_of(from), b = cosine > 0 ? to : right_of(to);
    const sl_point sum = {a.x + b.x, a.y + b.y};
    const double length = sli_length(sum.x, sum.y);
    return (sl_point){sum.x / length, sum.y / length};
}

/// The corners of the tangents around an arc, between its ends.
static sl_status add_tangents(growth *g, sl_point at, sl_point from, sl_point to) {
    const double cosine = sli_dot(from, to);
    if (cosine >= FLAT) return SL_OK;
    if (cosine >= STEP)
        return go_to(
            g, moved(g, at,
                     (sl_point){(from.x + to.x) / (1 + cosine), (from.y + to.y) / (1 + cosine)}));
    const sl_point middle = middle_of(from, to, cosine);
    SL_TRY(add_tangents(g, at, from, middle));
    return add_tangents(g, at, middle, to);
}

/// Whether the way from a spoke to the next one at its point, counter-clockwise, is half a turn or
/// more. A single spoke is its own next one, after a whole turn.
static bool is_open(const spoke *s, const spoke *next, bool is_last) {
    const int turn = sli_turn(s->at, s->to, next->at, next->to);
    const double cosine = sli_dot(s->unit, next->unit);
    if (cosine < 0) return turn <= 0 || sli_cross(s->unit, next->unit) < STRAIGHT;
    return turn < 0 || (turn == 0 && is_last);
}

/// The arcs at one point.
static sl_status add_caps(growth *g, const spoke *spokes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const spoke *s = &spokes[i], *next = &spokes[i + 1 < count ? i + 1 : 0];
        if (!is_open(s, next, i + 1 == count)) continue;
        const sl_point from = left_of(s->unit), to = right_of(next->unit);
        g->last = moved(g, s->at, from);
        SL_TRY(add_tangents(g, s->at, from, to));
        SL_TRY(go_to(g, moved(g, s->at, to)));
    }
    return SL_OK;
}

/// The two sides of a wall, and how it leaves its ends.
static sl_status add_sides(growth *g, const sl_wall *wall, spoke *ends) {
    const double length = sli_length(wall->b.x - wall->a.x, wall->b.y - wall->a.y);
    const sl_point unit = {(wall->b.x - wall->a.x) / length, (wall->b.y - wall->a.y) / length};
    ends[0] = (spoke){wall->a, wall->b, unit};
    ends[1] = (spoke){wall->b, wall->a, {-unit.x, -unit.y}};
    g->last = moved(g, wall->a, left_of(unit));
    SL_TRY(go_to(g, moved(g, wall->b, left_of(unit))));
    g->last = moved(g, wall->a, right_of(unit));
    return go_to(g, moved(g, wall->b, right_of(unit)));
}

/// The bounds stop the walker's middle, as they stop a point.
static sl_status add_bounds(growth *g, const sl_box *b) {
    const sl_point corners[] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    g->last = corners[3];
    for (int i = 0; i < 4; i++) SL_TRY(go_to(g, corners[i]));
    return SL_OK;
}

/// The portals that lead out of a part stop the walker's middle.
static sl_status add_ways_out(growth *g, const sl_space *space, const sli_route_part *part) {
    for (uint32_t c = 0; c < space->cell_count; c++) {
        const sl_cell *cell = &space->cells[c];
        for (uint32_t k = 0; part->has_cell[c] && k < cell->directed_count; k++) {
            const sl_directed_portal *d = &space->directed[cell->first_directed + k];
            g->last = d->right;
            if (!part->has_cell[d->cell]) SL_TRY(go_to(g, d->left));
        }
    }
    return SL_OK;
}

static sl_status add_outline(growth *g, const sl_space *space, const sli_route_part *part,
                             spoke *spokes) {
    size_t count = 0;
    SL_TRY(add_bounds(g, &space->bounds));
    if (part) SL_TRY(add_ways_out(g, space, part));
    for (uint32_t i = 0; i < space->wall_count; i++) {
        if (part && !part->has_wall[i]) continue;
        if (sli_same_point(space->walls[i].a, space->walls[i].b)) continue;
        SL_TRY(add_sides(g, &space->walls[i], &spokes[count]));
        count += 2;
    }
    qsort(spokes, count, sizeof *spokes, compare_spokes);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && sli_same_point(spokes[end].at, spokes[i].at);) end++;
        SL_TRY(add_caps(g, &spokes[i], end - i));
    }
    return SL_OK;
}

/// The cells between the grown walls.
static sl_status subdivide(growth *g, double slack, sl_space *out) {
    sl_clean_account account;
    SL_TRY(sl_map_clean(g->context, g->map, NULL, &account));
    if (account.largest_move > slack / 2)
        return sl_fail(g->context, SL_UNSUPPORTED,
                       "walls grown by a radius of %.9g would move by %.3g in cleaning", g->radius,
                       account.largest_move);
    return sl_subdivision_for(g->map)->subdivide(g->context, g->map, NULL, out);
}

sl_status sli_route_grow(sl_context *context, const sl_space *space, double radius,
                         const sli_route_part *part, sl_space *out) {
    sl_map map = {0};
    const double slack = slack_of(&space->bounds, radius);
    growth g = {.context = context, .radius = radius + slack, .map = &map};
    const size_t count = part ? part->wall_count : space->wall_count;
    spoke *spokes = sl_alloc_array(context, 2 * count, sizeof *spokes);
    sl_status status = spokes ? add_outline(&g, space, part, spokes) : SL_NO_MEMORY;
    sl_free(context, spokes);
    if (status == SL_OK) status = subdivide(&g, slack, out);
    sl_map_destroy(context, &map);
    return status;
}

sl_status sli_route_index_walls(sl_context *context, const sl_space *space, sli_box_tree *out) {
    sl_box *boxes = sl_alloc_array(context, space->wall_count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++)
        boxes[i] = sli_box_around(space->walls[i].a, space->walls[i].b);
    const sl_status status = sli_box_tree_create(context, boxes, space->wall_count, out);
    sl_free(context, boxes);
    return status;
}

/// The wall that is nearest to a place, of those within `least`.
typedef struct nearest_wall {
    const sl_space *space;
    sl_point at;
    double least;
    const sl_wall *wall; ///< NULL: all are farther
} nearest_wall;

static void look_at_wall(void *user, uint32_t number) {
    nearest_wall *n = user;
    const sl_wall *wall = &n->space->walls[number];
    const double away = sli_away_from(wall->a, wall->b, n->at);
    if (!(away < n->least)) return;
    n->least = away;
    n->wall = wall;
}

double sli_route_needed(const sl_space *space, double radius) {
    return SL_ROUTE_ROOM * radius + 2 * slack_of(&space->bounds, radius);
}

sl_status sli_route_check_room(sl_context *context, const sl_space *space,
                               const sli_box_tree *walls, double radius, const char *name,
                               sl_point at) {
    const double needed = sli_route_needed(space, radius);
    nearest_wall n = {space, at, needed, NULL};
    sli_box_tree_near(walls, at, &n.least, look_at_wall, &n);
    if (!n.wall) return SL_OK;
    return sl_fail(context, SL_BAD_ARGUMENT,
                   "%s %.9g,%.9g is too near to the wall from %.9g,%.9g to %.9g,%.9g: %.4g, and a "
                   "walker with radius %.9g needs %.4g",
                   name, at.x, at.y, n.wall->a.x, n.wall->a.y, n.wall->b.x, n.wall->b.y, n.least,
                   radius, needed);
}
