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
/// The points of a room stand in strips, one a column. A cone sees a run of each: along a strip,
/// the side of a ray changes once. A rounded crossing says where to look for the change, and exact
/// signs find it.
///
/// Cost: for each eye, the sides of the rooms that it sees and the strips in them. Invariant: a
/// cone is narrower than half a circle, and the rooms behind a portal lie beyond its line.
#include "analysis/visibility_graph/graph_rows.h"
#include "base/bits.h"
#include "geometry/length.h"

#include "geometry/orient.h"
#include "sightline/support.h"
#include "space/outline.h"

#include <math.h>

// --- points by room

/// Points of a column that follow each other, from the lowest up.
typedef struct strip {
    uint32_t first, count;
} strip;

/// Points on the border of rooms are listed in each of them.
typedef struct room_points {
    uint32_t *first; ///< by room, and one more: into `strips`
    SL_ARRAY(strip) strips;
    uint32_t *home; ///< by point: a room that holds it
} room_points;

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
            if (is_listed(t, other) || !sli_outline_room_holds(o, other, point)) continue;
            SL_TRY(SL_ARRAY_ROOM(context, &t->rooms, 1));
            t->rooms.items[t->rooms.count++] = other;
        }
    }
    return SL_OK;
}

static void room_points_destroy(sl_context *context, room_points *r) {
    sl_free(context, r->first);
    sl_free(context, r->strips.items);
    sl_free(context, r->home);
}

/// Adds a point of a room, or the start of a strip. Points come in ascending order.
static sl_status add_to_strip(sl_context *context, const sl_vga_grid *grid, uint32_t point,
                              size_t first, room_points *out) {
    strip *last = out->strips.count > first ? &out->strips.items[out->strips.count - 1] : NULL;
    if (last && last->first + last->count == point &&
        grid->squares[point] == grid->squares[point - 1] + 1 && grid->squares[point] % grid->rows) {
        last->count++;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &out->strips, 1));
    out->strips.items[out->strips.count++] = (strip){point, 1};
    return SL_OK;
}

/// Puts the points of each room into strips. `first`: by room, and one more: into `points`.
static sl_status cut_strips(sl_context *context, const sl_outline *o, const sl_vga_grid *grid,
                            const size_t *first, const uint32_t *points, room_points *out) {
    for (uint32_t r = 0; r < o->room_count; r++) {
        if (out->strips.count > UINT32_MAX) return SL_NO_MEMORY;
        out->first[r] = (uint32_t)out->strips.count;
        for (size_t i = first[r]; i < first[r + 1]; i++)
            SL_TRY(add_to_strip(context, grid, points[i], out->first[r], out));
    }
    out->first[o->room_count] = (uint32_t)out->strips.count;
    return SL_OK;
}

typedef struct placed {
    uint32_t room, point;
} placed;

/// The rooms of each point, in ascending order of points.
typedef struct placing {
    SL_ARRAY(placed) all;
    touching at_point;
    size_t *first;    ///< by room, and two more
    uint32_t *points; ///< by room
} placing;

static sl_status place_points(sl_context *context, const sl_outline *o, const uint32_t *room_of,
                              const sl_vga_grid *grid, uint32_t *home, placing *s) {
    for (uint32_t p = 0; p < grid->count; p++) {
        const uint32_t cell = sl_space_locate(o->space, grid->points[p]);
        if (cell == SL_NO_CELL)
            return sl_fail(context, SL_BAD_ARGUMENT, "a point of the grid is outside the map");
        home[p] = sl_outline_room(o, cell, grid->points[p]);
        SL_TRY(find_touching(context, o, room_of, home[p], grid->points[p], &s->at_point));
        SL_TRY(SL_ARRAY_ROOM(context, &s->all, s->at_point.rooms.count));
        for (size_t i = 0; i < s->at_point.rooms.count; i++) {
            s->all.items[s->all.count++] = (placed){s->at_point.rooms.items[i], p};
            s->first[s->at_point.rooms.items[i] + 2]++;
        }
    }
    s->points = sl_alloc_array(context, s->all.count, sizeof *s->points);
    if (!s->points) return SL_NO_MEMORY;
    for (uint32_t r = 1; r < o->room_count; r++) s->first[r + 1] += s->first[r];
    for (size_t i = 0; i < s->all.count; i++) // then each start has moved to the end of its room
        s->points[s->first[s->all.items[i].room + 1]++] = s->all.items[i].point;
    return SL_OK;
}

static sl_status sort_points(sl_context *context, const sl_outline *o, const uint32_t *room_of,
                             const sl_vga_grid *grid, room_points *out) {
    placing s = {.first = sl_alloc_array(context, (size_t)o->room_count + 2, sizeof *s.first)};
    out->first = sl_alloc_array(context, (size_t)o->room_count + 1, sizeof *out->first);
    out->home = sl_alloc_array(context, grid->count, sizeof *out->home);
    sl_status status = s.first && out->first && out->home ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = place_points(context, o, room_of, grid, out->home, &s);
    if (status == SL_OK) status = cut_strips(context, o, grid, s.first, s.points, out);
    sl_free(context, s.all.items);
    sl_free(context, s.at_point.rooms.items);
    sl_free(context, s.first);
    sl_free(context, s.points);
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
    double range; ///< 0: no limit
    sl_point eye;
    sl_bits *row;
    SL_ARRAY(frame) frames;
    SL_ARRAY(uint32_t) ray_rooms;
    SL_ARRAY(uint32_t) later; ///< rooms of a ray behind a limited wall
    touching at_eye;
} looker;

/// Whether a distance is beyond the range by more than rounding, so that nothing there is asked.
static bool is_far(const looker *l, double distance) {
    return l->range > 0 && distance > l->range * (1 + 0x1p-40);
}

static sl_point strip_start(const looker *l, const strip *s) {
    return l->grid->points[s->first];
}

static void see_all(looker *l, uint32_t room) {
    for (uint32_t i = l->by_room->first[room]; i < l->by_room->first[room + 1]; i++) {
        const strip *s = &l->by_room->strips.items[i];
        sli_bits_add_run(l->row, s->first, s->first + s->count);
    }
}

/// A ray from the eye. Along a strip, the side that points lie on changes once: from right to left
/// where the ray goes to the right.
typedef struct ray {
    sl_point via;
    bool rightward, leftward; ///< neither: it goes straight up or down
    double slope;
} ray;

static ray ray_through(const looker *l, sl_point via) {
    return (ray){via, via.x > l->eye.x, via.x < l->eye.x, (via.y - l->eye.y) / (via.x - l->eye.x)};
}

static int side_of(const looker *l, const ray *r, uint32_t point) {
    return sli_orient(l->eye, r->via, l->grid->points[point]);
}

/// Where along a strip the side comes to be `least` or more, or falls below it. `r` is not upright.
static uint32_t crossing(const looker *l, const ray *r, const strip *s, int least) {
    const sl_point start = strip_start(l, s);
    const double guess =
        (l->eye.y + r->slope * (start.x - l->eye.x) - start.y) / l->grid->step + 0.5;
    uint32_t at = guess > 0 ? guess < s->count ? (uint32_t)guess : s->count : 0;
    while (at > 0 && (side_of(l, r, s->first + at - 1) >= least) == r->rightward) at--;
    while (at < s->count && (side_of(l, r, s->first + at) >= least) != r->rightward) at++;
    return at;
}

/// Takes from a strip the points on one side of a ray: `left` or on it, or right or on it.
static void keep_side(const looker *l, const ray *r, bool left, strip *s) {
    const int least = left ? 0 : 1; // right or on it: below 1
    if (!r->rightward && !r->leftward) {
        if ((side_of(l, r, s->first) >= least) != left) s->count = 0;
        return;
    }
    const uint32_t at = crossing(l, r, s, least);
    if (r->rightward == left) {
        s->first += at;
        s->count -= at;
    } else {
        s->count = at;
    }
}

static void see_within(looker *l, uint32_t room, sl_point right, sl_point left) {
    const ray from = ray_through(l, right), to = ray_through(l, left);
    for (uint32_t i = l->by_room->first[room]; i < l->by_room->first[room + 1]; i++) {
        strip s = l->by_room->strips.items[i];
        if (is_far(l, fabs(strip_start(l, &s).x - l->eye.x))) continue;
        keep_side(l, &from, true, &s);
        if (s.count) keep_side(l, &to, false, &s);
        if (s.count) sli_bits_add_run(l->row, s.first, s.first + s.count);
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

/// Sees the points of a room on a ray.
static void see_along(looker *l, uint32_t room, sl_point via) {
    const ray r = ray_through(l, via);
    for (uint32_t i = l->by_room->first[room]; i < l->by_room->first[room + 1]; i++) {
        strip s = l->by_room->strips.items[i];
        if (r.rightward ? strip_start(l, &s).x < l->eye.x
                        : r.leftward && strip_start(l, &s).x > l->eye.x)
            continue;
        keep_side(l, &r, true, &s);
        if (s.count) keep_side(l, &r, false, &s);
        for (uint32_t p = s.first; p < s.first + s.count; p++)
            if (is_ahead(l->eye, via, l->grid->points[p])) sl_bits_add(l->row, p);
    }
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
        see_along(l, at, via);
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

/// To the smallest box around two points.
static double distance_to_box(sl_point from, sl_point a, sl_point b) {
    const double x = fmax(fmax(fmin(a.x, b.x) - from.x, from.x - fmax(a.x, b.x)), 0);
    const double y = fmax(fmax(fmin(a.y, b.y) - from.y, from.y - fmax(a.y, b.y)), 0);
    return sli_length(x, y);
}

/// Takes the view on through one side of a room, as far as it lies between two rays. `limited`: it
/// has passed a limited wall.
static sl_status look_through(sl_context *context, looker *l, uint32_t i, const sl_point *right,
                              const sl_point *left, bool limited) {
    const sl_side *side = &l->outline->sides[i];
    sl_point a = side->start, b = l->outline->sides[side->next].start;
    if (!sl_side_is_portal(side) || is_far(l, distance_to_box(l->eye, a, b))) return SL_OK;
    const int facing = sli_orient(a, b, l->eye);
    if (facing < 0) return SL_OK;
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

/// Takes out what is farther than the range.
static void keep_in_range(const looker *l) {
    for (size_t w = 0; w < sl_bits_words(l->grid->count); w++)
        for (sl_bits rest = l->row[w]; rest; rest &= rest - 1) {
            const size_t p = w * 64 + (size_t)__builtin_ctzll(rest);
            const sl_point a = l->eye, b = l->grid->points[p];
            if (sli_length(a.x - b.x, a.y - b.y) > l->range) sl_bits_flip(l->row, p);
        }
}

static sl_status look(sl_context *context, void *all, void *state, uint32_t eye, sl_bits *row) {
    looker *l = state;
    (void)all;
    l->row = row;
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
    if (l->range > 0) keep_in_range(l);
    return SL_OK;
}

// --- all eyes

/// What all lookers share.
typedef struct scene {
    room_points by_room;
    uint32_t *room_of;
    looker like;
    uint32_t samples; ///< rows that are looked at, where not all are
} scene;

static sl_status begin_looker(sl_context *context, void *all, void **state) {
    looker *l = sl_alloc_array(context, 1, sizeof *l);
    if (!l) return SL_NO_MEMORY;
    *l = ((const scene *)all)->like;
    *state = l;
    return SL_OK;
}

static void end_looker(sl_context *context, void *all, void *state) {
    (void)all;
    looker *l = state;
    sl_free(context, l->frames.items);
    sl_free(context, l->ray_rooms.items);
    sl_free(context, l->later.items);
    sl_free(context, l->at_eye.rooms.items);
    sl_free(context, l);
}

static void scene_destroy(sl_context *context, scene *s) {
    room_points_destroy(context, &s->by_room);
    sl_free(context, s->room_of);
}

static sl_status scene_make(sl_context *context, const sl_outline *outline, const sl_vga_grid *grid,
                            double range, scene *s) {
    s->room_of = sl_alloc_array(context, outline->side_count, sizeof *s->room_of);
    if (!s->room_of) return SL_NO_MEMORY;
    for (uint32_t r = 0; r < outline->room_count; r++)
        for (uint32_t i = outline->first[r]; i < outline->first[r + 1]; i++) s->room_of[i] = r;
    s->like = (looker){.outline = outline,
                       .grid = grid,
                       .by_room = &s->by_room,
                       .room_of = s->room_of,
                       .range = range};
    return sort_points(context, outline, s->room_of, grid, &s->by_room);
}

/// Whether there is one-way glass: a portal to the dark side.
static bool has_glass(const sl_outline *o) {
    for (uint32_t r = 0; r < o->room_count; r++)
        for (uint32_t i = o->first[r]; i < sl_outline_stop(o, r); i++)
            if (sl_side_is_portal(&o->sides[i]) &&
                !sl_side_is_portal(&o->sides[o->sides[i].neighbour]))
                return true;
    return false;
}

sl_status sl_vga_graph_make(sl_context *context, const sl_outline *outline, const sl_vga_grid *grid,
                            double range, unsigned threads, sl_vga_graph *out) {
    scene s = {0};
    const sli_vga_source source = {.count = grid->count,
                                   .points = grid->count,
                                   .directed = has_glass(outline),
                                   .job = &s,
                                   .begin = begin_looker,
                                   .end = end_looker,
                                   .look = look,
                                   .stage = "visibility graph"};
    sl_status status = scene_make(context, outline, grid, range, &s);
    if (status == SL_OK) status = sli_vga_graph_write(context, &source, threads, out);
    scene_destroy(context, &s);
    return status;
}

// --- the size, before

/// Samples are spread over all points.
static sl_status look_from_sample(sl_context *context, void *all, void *state, uint32_t sample,
                                  sl_bits *row) {
    const scene *s = all;
    return look(context, all, state,
                (uint32_t)((uint64_t)sample * s->like.grid->count / s->samples), row);
}

sl_status sl_vga_graph_bytes(sl_context *context, const sl_outline *outline,
                             const sl_vga_grid *grid, double range, uint64_t *bytes) {
    scene s = {.samples = grid->count < 256 ? grid->count : 256};
    const sli_vga_source source = {.count = s.samples,
                                   .points = grid->count,
                                   .job = &s,
                                   .begin = begin_looker,
                                   .end = end_looker,
                                   .look = look_from_sample};
    sl_vga_graph sample = {0};
    sl_status status = scene_make(context, outline, grid, range, &s);
    if (status == SL_OK) status = sli_vga_graph_write(context, &source, 1, &sample);
    if (status == SL_OK && s.samples)
        *bytes = (uint64_t)((double)sli_vga_graph_size(&sample) / s.samples * grid->count);
    else
        *bytes = 0;
    sl_vga_graph_destroy(context, &sample);
    scene_destroy(context, &s);
    return status;
}
