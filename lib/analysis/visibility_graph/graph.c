/// The visibility graph: which points of a grid see each other, exactly.
///
/// The points are sorted into the rooms of the outline once. Then each eye looks through the rooms
/// as a visible region does (region.c): through a portal the view goes on as a cone between two
/// corners, and the points of the room behind it that lie within the cone are seen.
///
///         +-----------+-------------+
///         |           a   .  '  left|    Corners are input coordinates, so each test of a point
///         |  eye *   .|  seen  o    |    against `left` and `right` is one exact sign.
///         |          '|    o        |
///         |           b .  right    |
///         +-----------+----'--------+
///
/// Sight is closed: a sightline may graze corners. Where only one ray passes two corners, the cone
/// has no width. Such a ray is followed on its own, room by room.
///
/// A view that has passed a limited wall takes the next one for a wall. Those that the eye is on do
/// not count.
///
/// Cost: for each eye, the sides of the rooms that it sees and the points in them. Invariant: a
/// cone is narrower than half a circle, and the rooms behind a portal lie beyond its line.
#include "base/bits.h"
#include "geometry/length.h"
#include "sightline/vga.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <math.h>

void sl_vga_graph_destroy(sl_context *context, sl_vga_graph *graph) {
    sl_free(context, graph->rows);
    *graph = (sl_vga_graph){0};
}

uint64_t sl_vga_graph_bytes(uint32_t points) {
    return (uint64_t)points * sl_bits_words(points) * sizeof(uint64_t);
}

// --- points by room

/// Points on the border of rooms are listed in each of them.
typedef struct room_points {
    uint32_t *first;  ///< by room, and one more: into `points`
    uint32_t *points; ///< numbers in the grid, ascending in each room
    uint32_t *home;   ///< by point: a room that holds it
} room_points;

static bool room_holds(const sl_outline *o, uint32_t room, sl_point point) {
    for (uint32_t i = o->first[room]; i < sl_outline_stop(o, room); i++)
        if (sli_orient(o->sides[i].start, o->sides[o->sides[i].next].start, point) < 0)
            return false;
    return true;
}

/// The rooms that touch a point, joined to its own room by portals there.
typedef struct touching {
    SL_ARRAY(uint32_t) rooms;
} touching;

static bool is_listed(const touching *t, uint32_t room) {
    for (size_t i = 0; i < t->rooms.count; i++)
        if (t->rooms.items[i] == room) return true;
    return false;
}

/// `room_of`: by side, its room.
static sl_status find_touching(sl_context *context, const sl_outline *o, const uint32_t *room_of,
                               uint32_t home, sl_point point, touching *t) {
    t->rooms.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &t->rooms, 1));
    t->rooms.items[t->rooms.count++] = home;
    for (size_t k = 0; k < t->rooms.count; k++) {
        const uint32_t room = t->rooms.items[k];
        for (uint32_t i = o->first[room]; i < sl_outline_stop(o, room); i++) {
            const sl_side *side = &o->sides[i];
            if (!sl_side_is_portal(side) ||
                sli_orient(side->start, o->sides[side->next].start, point) != 0)
                continue;
            const uint32_t other = room_of[side->neighbour];
            if (is_listed(t, other) || !room_holds(o, other, point)) continue;
            SL_TRY(SL_ARRAY_ROOM(context, &t->rooms, 1));
            t->rooms.items[t->rooms.count++] = other;
        }
    }
    return SL_OK;
}

static void room_points_destroy(sl_context *context, room_points *r) {
    sl_free(context, r->first);
    sl_free(context, r->points);
    sl_free(context, r->home);
}

typedef struct placed {
    uint32_t room, point;
} placed;

static sl_status sort_points(sl_context *context, const sl_outline *o, const uint32_t *room_of,
                             const sl_vga_grid *grid, room_points *out) {
    SL_ARRAY(placed) all = {0};
    touching t = {0};
    sl_status status = SL_OK;
    out->first = sl_alloc_array(context, (size_t)o->room_count + 1, sizeof *out->first);
    out->home = sl_alloc_array(context, grid->count, sizeof *out->home);
    if (!out->first || !out->home) status = SL_NO_MEMORY;
    for (uint32_t p = 0; p < grid->count && status == SL_OK; p++) {
        const uint32_t cell = sl_space_locate(o->space, grid->points[p]);
        if (cell == SL_NO_CELL)
            status = sl_fail(context, SL_BAD_ARGUMENT, "a point of the grid is outside the map");
        if (status != SL_OK) break;
        out->home[p] = sl_outline_room(o, cell, grid->points[p]);
        status = find_touching(context, o, room_of, out->home[p], grid->points[p], &t);
        if (status == SL_OK) status = SL_ARRAY_ROOM(context, &all, t.rooms.count);
        for (size_t i = 0; i < t.rooms.count && status == SL_OK; i++) {
            all.items[all.count++] = (placed){t.rooms.items[i], p};
            out->first[t.rooms.items[i] + 1]++;
        }
    }
    if (status == SL_OK) out->points = sl_alloc_array(context, all.count, sizeof *out->points);
    if (status == SL_OK && !out->points) status = SL_NO_MEMORY;
    if (status == SL_OK) {
        for (uint32_t r = 0; r < o->room_count; r++) out->first[r + 1] += out->first[r];
        for (size_t i = all.count; i-- > 0;) // from behind, so that numbers ascend
            out->points[--out->first[all.items[i].room + 1]] = all.items[i].point;
        // Each entry now has moved to the start of its room, one place too early in the list.
        for (uint32_t r = 0; r < o->room_count; r++) out->first[r] = out->first[r + 1];
        out->first[o->room_count] = (uint32_t)all.count;
    }
    sl_free(context, all.items);
    sl_free(context, t.rooms.items);
    return status;
}

// --- looking

typedef struct frame {
    uint32_t entry; ///< the side through which the room is entered
    bool limited;   ///< the way to the room passes a limited wall
    sl_point right, left;
} frame;

typedef struct looker {
    const sl_outline *outline;
    const sl_vga_grid *grid;
    const room_points *by_room;
    const uint32_t *room_of;
    sl_point eye;
    sl_bits *row;
    SL_ARRAY(frame) frames;
    SL_ARRAY(uint32_t) ray_rooms;
    SL_ARRAY(uint32_t) later; ///< rooms of a ray behind a limited wall
    touching at_eye;
} looker;

static void see_all(looker *l, uint32_t room) {
    for (uint32_t i = l->by_room->first[room]; i < l->by_room->first[room + 1]; i++)
        sl_bits_add(l->row, l->by_room->points[i]);
}

static void see_within(looker *l, uint32_t room, sl_point right, sl_point left) {
    for (uint32_t i = l->by_room->first[room]; i < l->by_room->first[room + 1]; i++) {
        const uint32_t p = l->by_room->points[i];
        const sl_point at = l->grid->points[p];
        if (sli_orient(l->eye, right, at) >= 0 && sli_orient(l->eye, at, left) >= 0)
            sl_bits_add(l->row, p);
    }
}

// Directions from the eye through `via`. Two directions in one line are the same, or opposite.

static bool is_ahead(sl_point eye, sl_point via, sl_point at) {
    const double dx = via.x - eye.x, dy = via.y - eye.y;
    return fabs(dx) >= fabs(dy) ? (at.x > eye.x) == (via.x > eye.x) && at.x != eye.x
                                : (at.y > eye.y) == (via.y > eye.y) && at.y != eye.y;
}

/// Whether the ray meets a side of a room that it is in, or has come to.
static bool ray_meets(const looker *l, sl_point via, const sl_side *side) {
    const sl_point a = side->start, b = l->outline->sides[side->next].start;
    const int facing = sli_orient(a, b, l->eye);
    const int to_a = sli_orient(l->eye, via, a), to_b = sli_orient(l->eye, via, b);
    if (facing == 0)
        return to_a == 0 && to_b == 0 && (is_ahead(l->eye, via, a) || is_ahead(l->eye, via, b));
    if (facing < 0 || to_a > 0 || to_b < 0) return false;
    if (to_a == 0) return is_ahead(l->eye, via, a);
    if (to_b == 0) return is_ahead(l->eye, via, b);
    return true;
}

static bool is_limited(const sl_outline *o, uint32_t side) {
    return o->limited && o->limited[side] != SL_NO_SEAM;
}

/// Lists a room of a ray, once.
static sl_status add_ray_room(sl_context *context, looker *l, uint32_t room) {
    for (size_t i = 0; i < l->ray_rooms.count; i++)
        if (l->ray_rooms.items[i] == room) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &l->ray_rooms, 1));
    l->ray_rooms.items[l->ray_rooms.count++] = room;
    return SL_OK;
}

/// Lists the rooms of a ray behind limited walls, where all before them are done.
static sl_status add_later_rooms(sl_context *context, looker *l) {
    for (size_t i = 0; i < l->later.count; i++) SL_TRY(add_ray_room(context, l, l->later.items[i]));
    l->later.count = 0;
    return SL_OK;
}

/// Follows one ray through all rooms that it touches, from a room on. `limited`: it has passed a
/// limited wall.
static sl_status follow_ray(sl_context *context, looker *l, uint32_t room, sl_point via,
                            bool limited) {
    const sl_outline *o = l->outline;
    l->ray_rooms.count = l->later.count = 0;
    SL_TRY(add_ray_room(context, l, room));
    for (size_t k = 0; k < l->ray_rooms.count || l->later.count; k++) {
        if (k == l->ray_rooms.count) {
            limited = true;
            SL_TRY(add_later_rooms(context, l));
            if (k == l->ray_rooms.count) break;
        }
        const uint32_t at = l->ray_rooms.items[k];
        for (uint32_t i = l->by_room->first[at]; i < l->by_room->first[at + 1]; i++) {
            const uint32_t p = l->by_room->points[i];
            if (sli_orient(l->eye, via, l->grid->points[p]) == 0 &&
                is_ahead(l->eye, via, l->grid->points[p]))
                sl_bits_add(l->row, p);
        }
        for (uint32_t i = o->first[at]; i < o->first[at + 1]; i++) {
            if (!sl_side_is_portal(&o->sides[i]) || !ray_meets(l, via, &o->sides[i])) continue;
            const uint32_t next = l->room_of[o->sides[i].neighbour];
            if (!is_limited(o, i)) {
                SL_TRY(add_ray_room(context, l, next));
            } else if (!limited) {
                SL_TRY(SL_ARRAY_ROOM(context, &l->later, 1));
                l->later.items[l->later.count++] = next;
            }
        }
    }
    return SL_OK;
}

/// Follows the rays along a portal in line with the eye, where they lie between two rays.
static sl_status look_along(sl_context *context, looker *l, const sl_side *side,
                            const sl_point *right, const sl_point *left, bool limited) {
    const sl_point ends[2] = {side->start, l->outline->sides[side->next].start};
    for (int e = 0; e < 2; e++) {
        if (sli_same_point(ends[e], l->eye)) continue;
        if (right &&
            (sli_orient(l->eye, *right, ends[e]) < 0 || sli_orient(l->eye, ends[e], *left) < 0))
            continue;
        SL_TRY(follow_ray(context, l, l->room_of[side->neighbour], ends[e], limited));
    }
    return SL_OK;
}

/// Takes the view on through one side of a room, as far as it lies between two rays. `limited`: it
/// has passed a limited wall.
static sl_status look_through(sl_context *context, looker *l, uint32_t i, const sl_point *right,
                              const sl_point *left, bool limited) {
    const sl_side *side = &l->outline->sides[i];
    sl_point a = side->start, b = l->outline->sides[side->next].start;
    const int facing = sli_orient(a, b, l->eye);
    if (!sl_side_is_portal(side) || facing < 0) return SL_OK;
    if (is_limited(l->outline, i)) {
        if (limited) return SL_OK;
        limited = true;
    }
    if (facing == 0) return look_along(context, l, side, right, left, limited);
    if (right && sli_orient(l->eye, *right, a) < 0) a = *right;
    if (left && sli_orient(l->eye, b, *left) < 0) b = *left;
    const int width = sli_orient(l->eye, a, b);
    if (width < 0) return SL_OK;
    if (width == 0) return follow_ray(context, l, l->room_of[side->neighbour], a, limited);
    SL_TRY(SL_ARRAY_ROOM(context, &l->frames, 1));
    l->frames.items[l->frames.count++] = (frame){side->neighbour, limited, a, b};
    return SL_OK;
}

/// Takes the view on from a room: all of it from the eye's own, else as it came in.
static sl_status look_around_room(sl_context *context, looker *l, uint32_t room, const frame *in) {
    for (uint32_t i = l->outline->first[room]; i < l->outline->first[room + 1]; i++)
        if (!in)
            SL_TRY(look_through(context, l, i, NULL, NULL, false));
        else if (i != in->entry)
            SL_TRY(look_through(context, l, i, &in->right, &in->left, in->limited));
    return SL_OK;
}

static sl_status look(sl_context *context, looker *l, uint32_t eye) {
    l->eye = l->grid->points[eye];
    SL_TRY(
        find_touching(context, l->outline, l->room_of, l->by_room->home[eye], l->eye, &l->at_eye));
    for (size_t k = 0; k < l->at_eye.rooms.count; k++) {
        const uint32_t room = l->at_eye.rooms.items[k];
        see_all(l, room);
        SL_TRY(look_around_room(context, l, room, NULL));
        while (l->frames.count) {
            const frame f = l->frames.items[--l->frames.count];
            const uint32_t at = l->room_of[f.entry];
            see_within(l, at, f.right, f.left);
            SL_TRY(look_around_room(context, l, at, &f));
        }
    }
    return SL_OK;
}

// --- all eyes

enum { EYES_A_UNIT = 64 };

typedef struct job {
    looker like; ///< what all threads share of a looker
    double range;
    sl_vga_graph *graph;
} job;

static sl_status begin_graph_worker(sl_context *context, void *all, void **state) {
    looker *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    *l = ((job *)all)->like;
    *state = l;
    return SL_OK;
}

static void end_graph_worker(sl_context *context, void *all, void *state) {
    (void)all;
    looker *l = state;
    sl_free(context, l->frames.items);
    sl_free(context, l->ray_rooms.items);
    sl_free(context, l->later.items);
    sl_free(context, l->at_eye.rooms.items);
    sl_free(context, l);
}

/// Takes out what is farther than the range.
static void keep_in_range(const sl_vga_grid *grid, uint32_t eye, double range, sl_bits *row) {
    for (uint32_t p = 0; p < grid->count; p++) {
        if (!sl_bits_has(row, p)) continue;
        const sl_point a = grid->points[eye], b = grid->points[p];
        if (sli_length(a.x - b.x, a.y - b.y) > range) sl_bits_flip(row, p);
    }
}

static sl_status look_from_unit(sl_context *context, void *all, void *state, size_t unit) {
    const job *j = all;
    looker *l = state;
    const uint32_t count = l->grid->count, first = (uint32_t)unit * EYES_A_UNIT;
    for (uint32_t eye = first; eye < count && eye < first + EYES_A_UNIT; eye++) {
        l->row = j->graph->rows + eye * j->graph->words;
        SL_TRY(look(context, l, eye));
        sl_bits_add(l->row, eye);
        sl_bits_flip(l->row, eye);
        if (j->range > 0) keep_in_range(l->grid, eye, j->range, l->row);
    }
    return SL_OK;
}

static sl_status connect(sl_context *context, job *j, unsigned threads) {
    const sl_work work = {.job = j,
                          .begin = begin_graph_worker,
                          .unit = look_from_unit,
                          .end = end_graph_worker,
                          .stage = "visibility graph",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, (j->graph->count + EYES_A_UNIT - 1) / EYES_A_UNIT, threads);
}

sl_status sl_vga_graph_make(sl_context *context, const sl_outline *outline, const sl_vga_grid *grid,
                            double range, unsigned threads, sl_vga_graph *out) {
    room_points by_room = {0};
    sl_vga_graph graph = {.count = grid->count, .words = sl_bits_words(grid->count)};
    uint32_t *room_of = sl_alloc_array(context, outline->side_count, sizeof *room_of);
    sl_status status = room_of ? SL_OK : SL_NO_MEMORY;
    for (uint32_t r = 0; r < outline->room_count && status == SL_OK; r++)
        for (uint32_t i = outline->first[r]; i < outline->first[r + 1]; i++) room_of[i] = r;
    if (status == SL_OK) status = sort_points(context, outline, room_of, grid, &by_room);
    if (status == SL_OK) {
        graph.rows = sl_alloc_array(context, graph.count * graph.words, sizeof *graph.rows);
        if (!graph.rows) status = SL_NO_MEMORY;
    }
    job j = {.like = {.outline = outline, .grid = grid, .by_room = &by_room, .room_of = room_of},
             .range = range,
             .graph = &graph};
    if (status == SL_OK) status = connect(context, &j, threads);
    room_points_destroy(context, &by_room);
    sl_free(context, room_of);
    if (status != SL_OK) {
        sl_vga_graph_destroy(context, &graph);
        return status;
    }
    graph.edges = sli_bits_count(graph.rows, graph.count * graph.words);
    *out = graph;
    return SL_OK;
}

sl_status sl_vga_graph_turn(sl_context *context, sl_vga_graph *graph) {
    uint64_t *rows = sl_alloc_array(context, graph->count * graph->words, sizeof *rows);
    if (!rows) return SL_NO_MEMORY;
    for (size_t p = 0; p < graph->count; p++)
        for (size_t w = 0; w < graph->words; w++)
            for (uint64_t rest = graph->rows[p * graph->words + w]; rest; rest &= rest - 1)
                sl_bits_add(rows + (w * 64 + (size_t)__builtin_ctzll(rest)) * graph->words, p);
    sl_free(context, graph->rows);
    graph->rows = rows;
    return SL_OK;
}
