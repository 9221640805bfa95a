/// Sight for checks of proofs (proof_sight.h).
#include "analysis/placement/proof_sight.h"
#include "analysis/placement/place_ground.h"

#include "geometry/crossing.h"
#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

sli_meet sli_meet_point(sl_point at) {
    return (sli_meet){.given = true, .at = at};
}

/// Where lines meet that are nearly parallel: exactly, then rounded.
static void meet_exactly(sli_meet *p) {
    p->error = INFINITY;
    if (!sli_turn(p->s.a, p->s.b, p->t.a, p->t.b)) return;
    const sl_point at = sli_crossing(p->s, p->t);
    if (!sl_coordinate_usable(at.x) || !sl_coordinate_usable(at.y)) return;
    p->at = at;
    p->error = 0x1p-50 * fmax(fabs(at.x), fabs(at.y)) + 2 * SL_COORDINATE_MIN;
}

/// Rounded products of rounded differences are wrong by less than 8 units of rounding of what is
/// added up. A divisor that is near its own error leaves the place open, or nearly so.
sli_meet sli_meet_lines(sl_segment s, sl_segment t) {
    const double unit = 0x1p-50;
    const sl_point u = {s.b.x - s.a.x, s.b.y - s.a.y}, v = {t.b.x - t.a.x, t.b.y - t.a.y},
                   w = {t.a.x - s.a.x, t.a.y - s.a.y};
    const double above = w.x * v.y - w.y * v.x, below = u.x * v.y - u.y * v.x;
    const double above_error = unit * (fabs(w.x * v.y) + fabs(w.y * v.x)) + 0x1p-900;
    const double below_error = unit * (fabs(u.x * v.y) + fabs(u.y * v.x)) + 0x1p-900;
    const double share = above / below;
    sli_meet p = {.s = s, .t = t, .at = s.a, .error = INFINITY};
    if (fabs(below) > 4 * below_error && isfinite(share)) {
        const double error =
            2 * (above_error + fabs(share) * below_error) / fabs(below) + unit * fabs(share);
        const double x = fabs(u.x) * error + unit * (fabs(s.a.x) + fabs(share * u.x)),
                     y = fabs(u.y) * error + unit * (fabs(s.a.y) + fabs(share * u.y));
        p.at = (sl_point){s.a.x + share * u.x, s.a.y + share * u.y};
        p.error = x > y ? x : y;
    }
    const double size = fabs(s.a.x) + fabs(s.a.y) + fabs(t.a.x) + fabs(t.a.y);
    if (!(p.error <= 0x1p-30 * size)) meet_exactly(&p);
    return p;
}

static bool is_line(const sl_segment *s, sl_point a, sl_point b) {
    return (sli_same_point(s->a, a) && sli_same_point(s->b, b)) ||
           (sli_same_point(s->a, b) && sli_same_point(s->b, a));
}

static int order_of(double a, double b) {
    return (a > b) - (a < b);
}

/// Quick for lines along an axis, on which many points are: whether the side is known, *side.
static bool is_axial_side(const sli_meet *p, sl_point a, sl_point b, int *side) {
    const bool level = a.y == b.y;
    if (!level && a.x != b.x) return false;
    if (p->given) {
        *side = level ? order_of(b.x, a.x) * order_of(p->at.y, a.y)
                      : order_of(a.y, b.y) * order_of(p->at.x, a.x);
        return true;
    }
    *side = 0;
    return level ? (p->s.a.y == a.y && p->s.b.y == a.y) || (p->t.a.y == a.y && p->t.b.y == a.y)
                 : (p->s.a.x == a.x && p->s.b.x == a.x) || (p->t.a.x == a.x && p->t.b.x == a.x);
}

int sli_meet_side(const sli_meet *p, sl_point a, sl_point b) {
    int side;
    if (is_axial_side(p, a, b, &side)) return side;
    if (p->given) return sli_orient(a, b, p->at);
    const sl_point u = {b.x - a.x, b.y - a.y}, v = {p->at.x - a.x, p->at.y - a.y};
    const double left = u.x * v.y, right = u.y * v.x, value = left - right;
    const double bound = 1.0625 * (fabs(u.x) + fabs(u.y)) * p->error +
                         0x1p-50 * (fabs(left) + fabs(right)) + 0x1p-900;
    if (value > bound) return 1;
    if (-value > bound) return -1;
    if (is_line(&p->s, a, b) || is_line(&p->t, a, b)) return 0;
    const int turn = sli_turn(a, b, p->s.a, p->s.b);
    if (!turn) return sli_orient(a, b, p->s.a);
    if (!sli_turn(a, b, p->t.a, p->t.b)) return sli_orient(a, b, p->t.a);
    return turn * sli_meet_order(p->s, p->t, (sl_segment){a, b});
}

void sli_box_widen(sl_box *box, const sli_meet *p) {
    const sl_box b = {{p->at.x - p->error, p->at.y - p->error},
                      {p->at.x + p->error, p->at.y + p->error}};
    if (!(b.min.x >= box->min.x)) box->min.x = b.min.x;
    if (!(b.min.y >= box->min.y)) box->min.y = b.min.y;
    if (!(b.max.x <= box->max.x)) box->max.x = b.max.x;
    if (!(b.max.y <= box->max.y)) box->max.y = b.max.y;
}

// --- walls and corners

typedef struct wall_end {
    sl_point at, other;
    uint32_t slot;
} wall_end;

static bool is_lower(sl_point from, sl_point to) {
    return to.y < from.y || (to.y == from.y && to.x < from.x);
}

/// Counter-clockwise from east; on one ray the nearer first.
static int compare_around(sl_point eye, sl_point a, sl_point b) {
    const int low = is_lower(eye, a) - is_lower(eye, b);
    if (low) return low;
    const int turn = sli_orient(eye, a, b);
    if (turn) return -turn;
    const int order = sli_compare_points(a, b);
    return sli_compare_points(eye, a) < 0 ? order : -order;
}

static int compare_ends(const void *left, const void *right) {
    const wall_end *a = left, *b = right;
    const int order = sli_compare_points(a->at, b->at);
    return order ? order : compare_around(a->at, a->other, b->other);
}

static void number_corners(sli_proof_scene *s, wall_end *ends) {
    const uint32_t count = 2 * s->wall_count;
    qsort(ends, count, sizeof *ends, compare_ends);
    for (uint32_t i = 0; i < count; i++) {
        if (!i || !sli_same_point(ends[i].at, ends[i - 1].at))
            s->corners[s->corner_count++] = (sli_corner){ends[i].at, i, 0};
        s->corners[s->corner_count - 1].count++;
        s->others[i] = ends[i].other;
        s->other_walls[i] = ends[i].slot / 2;
        s->ends[ends[i].slot] = s->corner_count - 1;
    }
}

static bool is_within(const sl_segment *w, sl_point p) {
    if (sli_same_point(w->a, p) || sli_same_point(w->b, p)) return false;
    return sli_compare_points(w->a, p) != sli_compare_points(w->b, p) &&
           sli_orient(w->a, w->b, p) == 0;
}

/// Cuts the walls that a point is within: where shut doors end, so that all walls meet at common
/// ends.
static sl_status cut_walls(sl_context *context, sl_point at, size_t *room, sli_proof_scene *s) {
    for (uint32_t i = 0, count = s->wall_count; i < count; i++) {
        if (!is_within(&s->walls[i], at)) continue;
        SL_TRY(sl_reserve(context, &s->walls, room, (size_t)s->wall_count + 1, sizeof *s->walls));
        s->walls[s->wall_count++] = (sl_segment){at, s->walls[i].b};
        s->walls[i].b = at;
    }
    return SL_OK;
}

static sl_status add_walls(sl_context *context, const sl_space *space, const sl_map *map,
                           sli_proof_scene *out) {
    const sl_box b = space->bounds;
    const double more = (b.max.x - b.min.x) + (b.max.y - b.min.y);
    const sl_point low = {b.min.x - more, b.min.y - more}, high = {b.max.x + more, b.max.y + more};
    const sl_point box[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    out->bounds = (sl_box){low, high};
    size_t room = (size_t)space->wall_count + 4;
    out->walls = sl_alloc_array(context, room, sizeof *out->walls);
    if (!out->walls) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_segment w = {space->walls[i].a, space->walls[i].b};
        if (!sli_same_point(w.a, w.b)) out->walls[out->wall_count++] = w;
    }
    out->around = out->wall_count;
    for (uint32_t i = 0; i < 4; i++)
        out->walls[out->wall_count++] = (sl_segment){box[3 - i], box[(4 - i) % 4]};
    for (size_t i = 0; i < map->door_count; i++)
        for (size_t k = 0; k < sli_door_piece_count(&map->doors[i]); k++) {
            const sl_segment piece = sli_door_piece(&map->doors[i], k);
            SL_TRY(cut_walls(context, piece.a, &room, out));
            SL_TRY(cut_walls(context, piece.b, &room, out));
        }
    return SL_OK;
}

static sl_status make_tree(sl_context *context, sli_proof_scene *s) {
    sl_box *boxes = sl_alloc_array(context, s->wall_count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < s->wall_count; i++)
        boxes[i] = sli_box_with((sl_box){s->walls[i].a, s->walls[i].a}, s->walls[i].b);
    const sl_status status = sli_box_tree_create(context, boxes, s->wall_count, &s->tree);
    sl_free(context, boxes);
    return status;
}

sl_status sli_proof_scene_make(sl_context *context, const sl_space *space, const sl_map *map,
                               sli_proof_scene *out) {
    *out = (sli_proof_scene){.space = space};
    SL_TRY(add_walls(context, space, map, out));
    const size_t count = 2 * (size_t)out->wall_count;
    wall_end *ends = sl_alloc_array(context, count, sizeof *ends);
    out->ends = sl_alloc_array(context, count, sizeof *out->ends);
    out->corners = sl_alloc_array(context, count, sizeof *out->corners);
    out->others = sl_alloc_array(context, count, sizeof *out->others);
    out->other_walls = sl_alloc_array(context, count, sizeof *out->other_walls);
    const bool made = ends && out->ends && out->corners && out->others && out->other_walls;
    for (uint32_t n = 0; made && n < out->wall_count; n++) {
        const sl_segment w = out->walls[n];
        ends[2 * n] = (wall_end){w.a, w.b, 2 * n};
        ends[2 * n + 1] = (wall_end){w.b, w.a, 2 * n + 1};
    }
    if (made) number_corners(out, ends);
    sl_free(context, ends);
    return made ? make_tree(context, out) : SL_NO_MEMORY;
}

void sli_proof_scene_destroy(sl_context *context, sli_proof_scene *s) {
    sl_free(context, s->walls);
    sl_free(context, s->ends);
    sl_free(context, s->corners);
    sl_free(context, s->others);
    sl_free(context, s->other_walls);
    sli_box_tree_destroy(context, &s->tree);
    *s = (sli_proof_scene){0};
}

// --- eyes

// An eye looks at the walls that meet a box around it, and at those around everything. If all that
// it sees before these is within the box, other walls hide nothing of that: they do not meet the
// box, and the ways to what is seen are within it, as it is convex. Else the box grows.

/// Half of the first box's side, in half circumferences of the bounds over the root of the number
/// of walls.
enum { FIRST_STEPS = 1 };

/// A corner as the eye sees it; or a point at an axis, which makes every cone narrow.
typedef struct sighted {
    const sl_point *eye;
    sl_point at;
    uint32_t corner; ///< UINT32_MAX: none
} sighted;

typedef struct eye_maker {
    const sli_proof_scene *scene;
    sl_point eye;
    sli_box_list walls; ///< that it looks at
    sighted *all;
    uint32_t *group;      ///< by corner
    uint32_t *first;      ///< by group, and one more
    int32_t *cone, *span; ///< by group: the nearest wall behind it, and on its first ray
    int32_t *cone_ranges, *span_ranges; ///< the same as trees, by ranges of groups
    bool *shut;                         ///< by group: a wall at the eye leads there
    uint32_t count, groups;
    bool on_wall;
} eye_maker;

static int compare_sighted(const void *left, const void *right) {
    const sighted *a = left, *b = right;
    const int order = compare_around(*a->eye, a->at, b->at);
    return order ? order : (a->corner > b->corner) - (a->corner < b->corner);
}

static void sort_around(eye_maker *m) {
    const sli_proof_scene *s = m->scene;
    const sl_point axes[] = {{s->bounds.max.x, m->eye.y},
                             {m->eye.x, s->bounds.max.y},
                             {s->bounds.min.x, m->eye.y},
                             {m->eye.x, s->bounds.min.y}};
    for (size_t i = 0; i < 2 * m->walls.count; i++) {
        const uint32_t corner = s->ends[2 * (size_t)m->walls.items[i / 2] + i % 2];
        if (m->group[corner]) continue; // it is there
        m->group[corner] = 1;
        if (!sli_same_point(s->corners[corner].at, m->eye))
            m->all[m->count++] = (sighted){&m->eye, s->corners[corner].at, corner};
    }
    for (int i = 0; i < 4; i++) m->all[m->count++] = (sighted){&m->eye, axes[i], UINT32_MAX};
    qsort(m->all, m->count, sizeof *m->all, compare_sighted);
    for (uint32_t i = 0; i < m->count; i++) {
        const sl_point a = m->all[i ? i - 1 : 0].at, b = m->all[i].at;
        if (!i || is_lower(m->eye, a) != is_lower(m->eye, b) || sli_orient(m->eye, a, b))
            m->first[m->groups++] = i;
        if (m->all[i].corner != UINT32_MAX) m->group[m->all[i].corner] = m->groups - 1;
    }
    m->first[m->groups] = m->count;
}

/// Of two walls that both cross a cone, and do not cross each other: whether a is the nearer one.
static bool is_nearer(const eye_maker *m, int32_t a, int32_t b) {
    const sl_segment *s = &m->scene->walls[a], *t = &m->scene->walls[b];
    const int eye = sli_orient(s->a, s->b, m->eye);
    const int one = eye * sli_orient(s->a, s->b, t->a), two = eye * sli_orient(s->a, s->b, t->b);
    if (one <= 0 && two <= 0) return true;
    if (one >= 0 && two >= 0) return false;
    const int other = sli_orient(t->a, t->b, m->eye);
    return other * sli_orient(t->a, t->b, s->a) >= 0 && other * sli_orient(t->a, t->b, s->b) >= 0;
}

static void lay(const eye_maker *m, int32_t *nearest, int32_t wall) {
    if (wall != SLI_NO_WALL && (*nearest == SLI_NO_WALL || is_nearer(m, wall, *nearest)))
        *nearest = wall;
}

/// Lays a wall on groups from..to - 1, in a tree whose node i has the children 2 i and 2 i + 1. Of
/// two walls that cross all cones of a node, one is the nearer in all of them: a node keeps that.
static void lay_range(const eye_maker *m, int32_t *ranges, uint32_t from, uint32_t to,
                      int32_t wall) {
    for (from += m->groups, to += m->groups; from < to; from /= 2, to /= 2) {
        if (from % 2) lay(m, &ranges[from++], wall);
        if (to % 2) lay(m, &ranges[--to], wall);
    }
}

/// The same from `from` on around to `to`, where they differ.
static void lay_around(const eye_maker *m, int32_t *ranges, uint32_t from, uint32_t to,
                       int32_t wall) {
    if (from < to) {
        lay_range(m, ranges, from, to, wall);
    } else if (from > to) {
        lay_range(m, ranges, from, m->groups, wall);
        lay_range(m, ranges, 0, to, wall);
    }
}

/// The nearest wall of each group is that of the nodes above it.
static void settle(eye_maker *m) {
    for (uint32_t g = 0; g < m->groups; g++)
        for (uint32_t i = g + m->groups; i; i /= 2) {
            lay(m, &m->cone[g], m->cone_ranges[i]);
            lay(m, &m->span[g], m->span_ranges[i]);
        }
}

static bool is_between(sl_point a, sl_point p, sl_point b) {
    const int one = sli_compare_points(a, p), two = sli_compare_points(p, b);
    return one == two && one != 0;
}

static void lay_wall(eye_maker *m, uint32_t wall) {
    const sl_segment w = m->scene->walls[wall];
    const uint32_t *ends = &m->scene->ends[2 * (size_t)wall];
    const int turn = sli_orient(m->eye, w.a, w.b);
    if (!turn) {
        const bool at_a = sli_same_point(w.a, m->eye), at_b = sli_same_point(w.b, m->eye);
        if (!at_a && !at_b && !is_between(w.a, m->eye, w.b)) return;
        m->on_wall = true;
        if (!at_a) m->shut[m->group[ends[0]]] = true;
        if (!at_b) m->shut[m->group[ends[1]]] = true;
        return;
    }
    const uint32_t from = m->group[ends[turn < 0]], to = m->group[ends[turn > 0]];
    if (from == to) return;
    lay_around(m, m->cone_ranges, from, to, (int32_t)wall);
    lay_around(m, m->span_ranges, (from + 1) % m->groups, to, (int32_t)wall);
}

/// A direction at the border of the eye's cell such that the cell follows counter-clockwise.
static bool find_cell_direction(const eye_maker *m, sl_point *to) {
    const sl_space *space = m->scene->space;
    const uint32_t at = sl_space_locate(space, m->eye);
    if (at == SL_NO_CELL) return false;
    const sl_cell *cell = &space->cells[at];
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point a = space->vertices[cell->first_vertex + i];
        *to = space->vertices[cell->first_vertex + (i + 1) % cell->vertex_count];
        if (sli_same_point(a, m->eye)) return true;
        if (sli_orient(a, *to, m->eye) == 0 && is_between(a, m->eye, *to)) return true;
    }
    return false;
}

/// An eye on a wall sees only from one side of it: the other cones are shut.
static void shut_cones(eye_maker *m) {
    sl_point to;
    uint32_t in = 0;
    if (!find_cell_direction(m, &to)) {
        for (uint32_t g = 0; g < m->groups; g++) m->cone[g] = SLI_SHUT;
        return;
    }
    for (uint32_t g = 0; g < m->groups; g++) {
        const sl_point at = m->all[m->first[g]].at;
        const int low = is_lower(m->eye, at) - is_lower(m->eye, to);
        if (low < 0 || (low == 0 && sli_orient(m->eye, at, to) >= 0)) in = g;
    }
    uint32_t left = (in + 1) % m->groups, right = in;
    while (!m->shut[left]) left = (left + 1) % m->groups;
    while (!m->shut[right]) right = (right + m->groups - 1) % m->groups;
    for (uint32_t g = left; g != right; g = (g + 1) % m->groups) m->cone[g] = SLI_SHUT;
}

/// A wall at the first corner of a group, before its end, that has walls on both sides of the ray;
/// else the wall that crosses the ray.
static int32_t end_of(const eye_maker *m, uint32_t g, bool *at_once) {
    const sli_proof_scene *s = m->scene;
    const int32_t span = m->span[g];
    *at_once = false;
    for (uint32_t i = m->first[g]; i < m->first[g + 1]; i++) {
        if (m->all[i].corner == UINT32_MAX) continue;
        const sli_corner *c = &s->corners[m->all[i].corner];
        bool left = false, right = false;
        if (span >= 0) {
            const sl_segment *w = &s->walls[span];
            const int side = sli_orient(w->a, w->b, c->at) * sli_orient(w->a, w->b, m->eye);
            *at_once = *at_once || (side <= 0 && i == m->first[g]);
            if (side <= 0) return span;
        }
        for (uint32_t k = 0; k < c->count; k++) {
            const int turn = sli_orient(m->eye, c->at, s->others[c->first + k]);
            left = left || turn > 0;
            right = right || turn < 0;
        }
        if (!left || !right) continue;
        *at_once = i == m->first[g];
        for (uint32_t k = 0; k < c->count; k++) {
            const uint32_t w = s->other_walls[c->first + k];
            if (sli_orient(s->walls[w].a, s->walls[w].b, m->eye)) return (int32_t)w;
        }
    }
    return span;
}

static void keep_rays(const eye_maker *m, sli_eye *out) {
    bool lower = false;
    for (uint32_t g = 0; g < m->groups; g++) {
        const int32_t before = m->cone[(g ? g : m->groups) - 1], after = m->cone[g];
        bool axis = false, at_once;
        for (uint32_t i = m->first[g]; i < m->first[g + 1]; i++)
            axis = axis || m->all[i].corner == UINT32_MAX;
        if (before == after && !axis) continue;
        const sighted *first = &m->all[m->first[g]];
        if (!lower && is_lower(m->eye, first->at)) lower = true, out->west = out->ray_count;
        const int32_t end = end_of(m, g, &at_once);
        out->rays[out->ray_count++] =
            (sli_proof_ray){first->at, after, end,
                            before != after && !at_once && end >= 0 && first->corner != UINT32_MAX};
    }
}

/// The walls that meet a box, ascending, and then those around everything.
static sl_status find_walls(sl_context *context, eye_maker *m, const sl_box *box) {
    const sli_proof_scene *s = m->scene;
    sli_box_list *walls = &m->walls;
    size_t count = 0;
    SL_TRY(sli_box_tree_find(context, &s->tree, box, walls));
    for (size_t i = 0; i < walls->count; i++)
        if (walls->items[i] - s->around >= 4) walls->items[count++] = walls->items[i];
    walls->count = count;
    SL_TRY(SL_ARRAY_ROOM(context, walls, 4));
    for (uint32_t i = 0; i < 4; i++) walls->items[walls->count++] = s->around + i;
    return SL_OK;
}

/// Looks at the walls that meet a box.
static sl_status look(sl_context *context, eye_maker *m, const sl_box *box, sli_eye *out) {
    SL_TRY(find_walls(context, m, box));
    const size_t room = 2 * m->walls.count + 5;
    m->all = sl_alloc_array(context, room, sizeof *m->all);
    m->group = sl_alloc_array(context, m->scene->corner_count, sizeof *m->group);
    m->first = sl_alloc_array(context, room, sizeof *m->first);
    m->cone = sl_alloc_array(context, room, sizeof *m->cone);
    m->span = sl_alloc_array(context, room, sizeof *m->span);
    m->cone_ranges = sl_alloc_array(context, 2 * room, sizeof *m->cone_ranges);
    m->span_ranges = sl_alloc_array(context, 2 * room, sizeof *m->span_ranges);
    m->shut = sl_alloc_array(context, room, sizeof *m->shut);
    if (!m->all || !m->group || !m->first || !m->cone || !m->span || !m->cone_ranges ||
        !m->span_ranges || !m->shut)
        return SL_NO_MEMORY;
    for (size_t i = 0; i < room; i++) m->cone[i] = m->span[i] = SLI_NO_WALL;
    for (size_t i = 0; i < 2 * room; i++) m->cone_ranges[i] = m->span_ranges[i] = SLI_NO_WALL;
    sort_around(m);
    for (size_t i = 0; i < m->walls.count; i++) lay_wall(m, m->walls.items[i]);
    settle(m);
    if (m->on_wall) shut_cones(m);
    out->rays = sl_alloc_array(context, m->groups, sizeof *out->rays);
    if (!out->rays) return SL_NO_MEMORY;
    keep_rays(m, out);
    return SL_OK;
}

static sl_status look_within(sl_context *context, const sli_proof_scene *scene, const sl_box *box,
                             sli_eye *out, bool *on_wall) {
    eye_maker m = {.scene = scene, .eye = out->at};
    const sl_status status = look(context, &m, box, out);
    *on_wall = m.on_wall;
    sl_free(context, m.walls.items);
    sl_free(context, m.all);
    sl_free(context, m.group);
    sl_free(context, m.first);
    sl_free(context, m.cone);
    sl_free(context, m.span);
    sl_free(context, m.cone_ranges);
    sl_free(context, m.span_ranges);
    sl_free(context, m.shut);
    return status;
}

static bool has_box(const sl_box *box, const sl_box *other) {
    return box->min.x <= other->min.x && box->min.y <= other->min.y && box->max.x >= other->max.x &&
           box->max.y >= other->max.y;
}

/// A box around what is known to hold all that is seen, but up to twice as far from the eye.
static sl_box grow(const sl_box *box, sl_point at, const sl_box *sees) {
    return (sl_box){{fmin(box->min.x, fmax(sees->min.x, 2 * box->min.x - at.x)),
                     fmin(box->min.y, fmax(sees->min.y, 2 * box->min.y - at.y))},
                    {fmax(box->max.x, fmin(sees->max.x, 2 * box->max.x - at.x)),
                     fmax(box->max.y, fmin(sees->max.y, 2 * box->max.y - at.y))}};
}

sl_status sli_eye_make(sl_context *context, const sli_proof_scene *scene, sl_point at, sli_eye *out,
                       bool *on_wall) {
    const sl_box *all = &scene->bounds;
    const double size = all->max.x - all->min.x + all->max.y - all->min.y;
    const double step = FIRST_STEPS * size / sqrt(scene->wall_count);
    sl_box box = {{at.x - step, at.y - step}, {at.x + step, at.y + step}};
    for (;;) {
        *out = (sli_eye){.at = at, .north = {at.x, scene->bounds.max.y}};
        SL_TRY(look_within(context, scene, &box, out, on_wall));
        const sl_box sees = sli_box_of_eye(scene, out);
        if (has_box(&box, &sees) || has_box(&box, all)) return SL_OK;
        sli_eye_destroy(context, out);
        box = grow(&box, at, &sees);
    }
}

void sli_eye_destroy(sl_context *context, sli_eye *eye) {
    sl_free(context, eye->rays);
    *eye = (sli_eye){0};
}

sli_bearing sli_eye_bearing(const sli_eye *eye, const sli_meet *p) {
    const int up = sli_meet_side(p, eye->at, eye->rays[0].to);
    if (!up) {
        const int side = sli_meet_side(p, eye->at, eye->north);
        if (!side) return (sli_bearing){0, true, true};
        return (sli_bearing){side < 0 ? 0 : eye->west, true, false};
    }
    uint32_t low = up > 0 ? 0 : eye->west, high = up > 0 ? eye->west : eye->ray_count;
    int at = up > 0 ? 1 : sli_meet_side(p, eye->at, eye->rays[low].to);
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        const int side = sli_meet_side(p, eye->at, eye->rays[middle].to);
        if (side < 0)
            high = middle;
        else
            low = middle, at = side;
    }
    return (sli_bearing){low, at == 0, false};
}

int sli_eye_side(const sli_proof_scene *scene, const sli_eye *eye, int32_t wall,
                 const sli_meet *p) {
    const sl_segment *w = &scene->walls[wall];
    return sli_meet_side(p, w->a, w->b) * sli_orient(w->a, w->b, eye->at);
}

bool sli_eye_sees(const sli_proof_scene *scene, const sli_eye *eye, const sli_meet *p) {
    const sli_bearing b = sli_eye_bearing(eye, p);
    if (b.here) return true;
    const int32_t wall = b.on ? eye->rays[b.ray].end : eye->rays[b.ray].cone;
    return wall < 0 ? wall == SLI_NO_WALL : sli_eye_side(scene, eye, wall, p) >= 0;
}

/// Each cone of an eye is a triangle, from the eye to the wall that ends it. On the rays themselves
/// sight may go farther.
sl_box sli_box_of_eye(const sli_proof_scene *scene, const sli_eye *e) {
    sl_box box = {e->at, e->at};
    for (uint32_t i = 0; i < e->ray_count; i++) {
        const sl_segment line = {e->at, e->rays[i].to};
        const int32_t walls[] = {e->rays[i].cone, e->rays[(i ? i : e->ray_count) - 1].cone,
                                 e->rays[i].end};
        for (int k = 0; k < 3; k++) {
            if (walls[k] == SLI_SHUT) continue;
            if (walls[k] < 0) return scene->bounds;
            const sli_meet p = sli_meet_lines(line, scene->walls[walls[k]]);
            if (!isfinite(p.at.x) || !isfinite(p.at.y) || !isfinite(p.error)) return scene->bounds;
            sli_box_widen(&box, &p);
        }
    }
    return box;
}
