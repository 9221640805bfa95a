/// A part of a map: what lies in a box.
///
/// A wall that crosses the border is cut where it does. Which side it crosses is decided by exact
/// signs; the place is the nearest one that doubles have, on the border itself:
///
///          +-----------+
///     ----x=====      |       = kept
///          |     =====x----   x cut
///          +-----------+
///
/// Polygons of ground are cut as polygons are: where one covers the border from within, its outline
/// goes on along the border. How often polygons cover a place of the border is the sum of
/// SL_SOLID_BEGINS over the walls that cross the border's line before it. So ground that only walls
/// beyond the border told of stays what it is. Time O(n log n) for n walls that cross the border.
#include "map/ground.h"

#include "geometry/crossing.h"
#include "geometry/length.h"
#include "geometry/orient.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- segments. An axis is 0 for x and 1 for y

static double along(sl_point p, int axis) {
    return axis ? p.y : p.x;
}

/// On which side of the box a point lies, across an axis: -1, 0 for within, 1.
static int beyond(const sl_box *box, sl_point p, int axis) {
    return (along(p, axis) > along(box->max, axis)) - (along(p, axis) < along(box->min, axis));
}

static double side_at(const sl_box *box, int axis, int side) {
    return along(side < 0 ? box->min : box->max, axis);
}

/// Where a segment crosses the line of a side. Its ends lie strictly on both hands of it.
static sl_point cross(sl_segment s, int axis, double at) {
    const double low = nextafter(sli_lesser(along(s.a, !axis), along(s.b, !axis)), -INFINITY);
    const double high = nextafter(sli_greater(along(s.a, !axis), along(s.b, !axis)), INFINITY);
    const sl_segment line =
        axis ? (sl_segment){{low, at}, {high, at}} : (sl_segment){{at, low}, {at, high}};
    return sli_crossing(s, line);
}

/// Where a segment that meets the box enters it, coming from its a.
static sl_point enter(const sl_box *box, sl_segment s) {
    const int x = beyond(box, s.a, 0), y = beyond(box, s.a, 1);
    if (!x && !y) return s.a;
    const sl_point corner = {side_at(box, 0, x), side_at(box, 1, y)};
    int axis = x ? 0 : 1;
    if (x && y) { // it crosses the lines of two sides: the second one is the box's
        const int turn = sli_orient(s.a, s.b, corner) * x * y;
        if (!turn) return corner;
        axis = turn > 0;
    }
    const double at = along(corner, axis);
    // An end on the line of the side is where it enters.
    return along(s.b, axis) == at ? s.b : cross(s, axis, at);
}

typedef enum place { INSIDE, CUT, OUTSIDE } place;

/// Cuts a segment to the box, where it is not all inside or all outside.
static place cut(const sl_box *box, sl_segment *s) {
    const int ax = beyond(box, s->a, 0), ay = beyond(box, s->a, 1);
    const int bx = beyond(box, s->b, 0), by = beyond(box, s->b, 1);
    if (!ax && !ay && !bx && !by) return INSIDE;
    if ((ax && ax == bx) || (ay && ay == by)) return OUTSIDE;
    const sl_point corners[] = {
        box->min, {box->max.x, box->min.y}, box->max, {box->min.x, box->max.y}};
    int left = 0, right = 0;
    for (int i = 0; i < 4; i++) {
        const int turn = sli_orient(s->a, s->b, corners[i]);
        left += turn > 0;
        right += turn < 0;
    }
    if (left == 4 || right == 4) return OUTSIDE;
    const sl_segment in = {enter(box, *s), enter(box, (sl_segment){s->b, s->a})};
    if (sli_same_point(in.a, in.b)) return OUTSIDE; // it touches the box in a point
    *s = in;
    return CUT;
}

// --- ground along the border

/// A wall with ground that crosses the line of a side: there, ground is covered `more` times more.
typedef struct step {
    double at;
    int32_t more;
} step;

static int compare_steps(const void *a, const void *b) {
    const double p = ((const step *)a)->at, q = ((const step *)b)->at;
    return (p > q) - (p < q);
}

/// The place on a line, and whether the wall crosses it just inside the box.
static bool step_of(const sl_wall *w, int axis, double line, int side, step *out) {
    const double a = along(w->a, axis), b = along(w->b, axis);
    // Just inside: an end on the line lies beyond it.
    const bool a_beyond = side < 0 ? a <= line : a >= line;
    const bool b_beyond = side < 0 ? b <= line : b >= line;
    const int32_t begins = sli_ground_begins(w->ground);
    if (a_beyond == b_beyond || !begins) return false;
    const sl_point at = a == line   ? w->a
                        : b == line ? w->b
                                    : cross((sl_segment){w->a, w->b}, axis, line);
    // Upwards in x, a rising wall is crossed from its left; upwards in y, from its right.
    const bool from_right = (a < b) == (axis == 0);
    *out = (step){along(at, !axis), from_right ? begins : -begins};
    return true;
}

/// Adds a wall along a side, counter-clockwise round the box, for ground that is covered `times`.
static sl_status add_outline(sl_context *context, sl_map *to, int axis, double line, int side,
                             double low, double high, int32_t times) {
    const sl_point p = axis ? (sl_point){low, line} : (sl_point){line, low};
    const sl_point q = axis ? (sl_point){high, line} : (sl_point){line, high};
    const bool upwards = (axis == 1) == (side < 0);
    SL_TRY(sl_map_add_wall(context, to, upwards ? p : q, upwards ? q : p, 0));
    const uint32_t sides = times > 0 ? SL_SOLID_LEFT : SL_SOLID_RIGHT | SL_OPEN_LEFT;
    to->walls[to->wall_count - 1].ground = sides + (uint32_t)times * SL_SOLID_BEGINS;
    return SL_OK;
}

static sl_status outline_side(sl_context *context, const sl_map *map, const sl_box *box, int axis,
                              int side, sl_map *to) {
    SL_ARRAY(step) steps = {0};
    const double line = side_at(box, axis, side), end = along(box->max, !axis);
    sl_status status = SL_OK;
    for (size_t i = 0; i < map->wall_count && status == SL_OK; i++) {
        step found;
        if (!step_of(&map->walls[i], axis, line, side, &found)) continue;
        status = SL_ARRAY_ROOM(context, &steps, 1);
        if (status == SL_OK) steps.items[steps.count++] = found;
    }
    if (status == SL_OK && steps.count)
        qsort(steps.items, steps.count, sizeof *steps.items, compare_steps);
    double from = along(box->min, !axis);
    int32_t times = 0;
    for (size_t i = 0; i <= steps.count && from < end && status == SL_OK; i++) {
        const double at = i < steps.count ? sli_lesser(steps.items[i].at, end) : end;
        if (at > from) {
            if (times) status = add_outline(context, to, axis, line, side, from, at, times);
            from = at;
        }
        if (i < steps.count) times += steps.items[i].more;
    }
    sl_free(context, steps.items);
    return status;
}

/// A wall on the line of a side: what its polygon covers within the box, the outline says.
static bool is_on_border(const sl_box *box, const sl_wall *w) {
    for (int axis = 0; axis < 2; axis++)
        for (int side = -1; side < 2; side += 2)
            if (along(w->a, axis) == side_at(box, axis, side) &&
                along(w->a, axis) == along(w->b, axis))
                return true;
    return false;
}

// --- what a map holds

typedef struct crop {
    sl_context *context;
    sl_map *map;
    sl_box box;
    sl_crop_account account;
} crop;

/// Whether something of a segment stays. It is cut to the box.
static bool keep(crop *c, sl_point *a, sl_point *b) {
    sl_segment s = {*a, *b};
    const place where = cut(&c->box, &s);
    c->account.inside += where == INSIDE;
    c->account.cut += where == CUT;
    c->account.left_out += where == OUTSIDE;
    *a = s.a;
    *b = s.b;
    return where != OUTSIDE;
}

static size_t crop_glass(crop *c, sl_glass *items, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (keep(c, &items[i].segment.a, &items[i].segment.b)) items[kept++] = items[i];
    return kept;
}

static void crop_lines(crop *c) {
    sl_map *map = c->map;
    size_t kept = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        sl_wall *w = &map->walls[i];
        if (!keep(c, &w->a, &w->b)) continue;
        if (sli_ground_begins(w->ground) && is_on_border(&c->box, w)) w->ground = 0;
        map->walls[kept++] = *w;
    }
    map->wall_count = kept;
    map->mirror_count = crop_glass(c, map->mirrors, map->mirror_count);
    map->oneway_count = crop_glass(c, map->oneways, map->oneway_count);
    map->seam_count = crop_glass(c, map->seams, map->seam_count);
}

static void crop_doors(crop *c) {
    size_t kept = 0;
    for (size_t i = 0; i < c->map->door_count; i++) {
        sl_door *door = &c->map->doors[i];
        sl_free(c->context, door->parts);
        door->parts = NULL;
        door->part_count = 0;
        if (cut(&c->box, &door->segment) != OUTSIDE) {
            c->map->doors[kept++] = *door;
            continue;
        }
        sl_free(c->context, door->name);
        c->account.doors++;
    }
    c->map->door_count = kept;
}

static void crop_things(crop *c) {
    sl_map *map = c->map;
    size_t kept = 0;
    for (size_t i = 0; i < map->start_count; i++)
        if (sli_box_holds(&c->box, map->starts[i].at)) map->starts[kept++] = map->starts[i];
    c->account.starts = map->start_count - kept;
    map->start_count = kept;
    kept = 0;
    for (size_t i = 0; i < map->object_count; i++) {
        sl_object *object = &map->objects[i];
        sl_box *b = &object->box;
        b->min =
            (sl_point){sli_greater(b->min.x, c->box.min.x), sli_greater(b->min.y, c->box.min.y)};
        b->max = (sl_point){sli_lesser(b->max.x, c->box.max.x), sli_lesser(b->max.y, c->box.max.y)};
        if (b->min.x <= b->max.x && b->min.y <= b->max.y)
            map->objects[kept++] = *object;
        else
            sl_free(c->context, object->name);
    }
    c->account.objects = map->object_count - kept;
    map->object_count = kept;
}

/// The map's own cells stay where all their corners do.
static void crop_cells(crop *c) {
    sl_map *map = c->map;
    size_t kept = 0;
    for (size_t i = 0; i < map->cell_count; i++) {
        const sl_point *corners = map->corners + map->cells[i].first;
        bool inside = true;
        for (uint32_t k = 0; k < map->cells[i].count; k++)
            inside &= sli_box_holds(&c->box, corners[k]);
        if (inside) map->cells[kept++] = map->cells[i];
    }
    c->account.cells = map->cell_count - kept;
    size_t corners = 0;
    for (size_t i = 0; i < kept; i++) { // cells are in the order of their corners
        sl_map_cell *cell = &map->cells[i];
        memmove(map->corners + corners, map->corners + cell->first,
                cell->count * sizeof *map->corners);
        cell->first = corners;
        corners += cell->count;
    }
    map->cell_count = kept;
    map->corner_count = corners;
}

/// The parts of a path that are inside, each a path of its name.
static sl_status add_path_parts(crop *c, const sl_path *path, sl_map *to) {
    SL_ARRAY(sl_point) part = {0};
    sl_status status = SL_ARRAY_ROOM(c->context, &part, path->count + 1);
    if (status == SL_OK && sli_box_holds(&c->box, path->points[0]))
        part.items[part.count++] = path->points[0];
    for (size_t i = 1; i < path->count && status == SL_OK; i++) {
        sl_segment leg = {path->points[i - 1], path->points[i]};
        if (cut(&c->box, &leg) == OUTSIDE) continue;
        if (!part.count) part.items[part.count++] = leg.a;
        part.items[part.count++] = leg.b;
        if (sli_box_holds(&c->box, path->points[i])) continue;
        status = sl_map_add_path(c->context, to, path->name, part.items, part.count, path->line);
        part.count = 0;
    }
    if (status == SL_OK && part.count)
        status = sl_map_add_path(c->context, to, path->name, part.items, part.count, path->line);
    sl_free(c->context, part.items);
    return status;
}

/// What is new: outlines of ground, and parts of paths.
static sl_status make_new(crop *c, sl_map *more) {
    for (int axis = 0; axis < 2; axis++)
        for (int side = -1; side < 2; side += 2)
            SL_TRY(outline_side(c->context, c->map, &c->box, axis, side, more));
    for (size_t i = 0; i < c->map->path_count; i++) {
        const size_t before = more->path_count;
        SL_TRY(add_path_parts(c, &c->map->paths[i], more));
        c->account.paths += more->path_count == before;
    }
    return sl_reserve(c->context, &c->map->walls, &c->map->wall_room,
                      c->map->wall_count + more->wall_count, sizeof *c->map->walls);
}

sl_status sl_map_crop(sl_context *context, sl_map *map, sl_box box, sl_crop_account *account) {
    const sl_point p = sli_coordinates(box.min), q = sli_coordinates(box.max);
    crop c = {.context = context,
              .map = map,
              .box = {{sli_lesser(p.x, q.x), sli_lesser(p.y, q.y)},
                      {sli_greater(p.x, q.x), sli_greater(p.y, q.y)}}};
    if (!sl_coordinate_usable(p.x) || !sl_coordinate_usable(p.y) || !sl_coordinate_usable(q.x) ||
        !sl_coordinate_usable(q.y) || p.x == q.x || p.y == q.y)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "crop: expected two opposite corners of a box with an area");
    sl_map more = {0};
    const sl_status status = make_new(&c, &more);
    if (status == SL_OK) {
        crop_lines(&c);
        crop_doors(&c);
        crop_things(&c);
        crop_cells(&c);
        for (size_t i = 0; i < more.wall_count; i++) map->walls[map->wall_count++] = more.walls[i];
        sl_path *paths = map->paths;
        const size_t count = map->path_count, room = map->path_room;
        map->paths = more.paths;
        map->path_count = more.path_count;
        map->path_room = more.path_room;
        more.paths = paths;
        more.path_count = count;
        more.path_room = room;
        sl_free(context, map->interior.places);
        map->interior = (sl_interior){0};
        if (account) *account = c.account;
    }
    sl_map_destroy(context, &more);
    return status;
}
