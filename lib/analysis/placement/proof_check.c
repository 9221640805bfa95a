/// The check of both bounds (place_proof.h). Both try the corners of arrangements:
///
/// Take all places that see some witnesses. They are a closed set. Its lowest place, of these the
/// leftmost one, is a corner: of walls, of a ray on which a region ends and a wall, or of two such
/// rays. Else the set goes on from there along a line, both ways, as each region beside a place is
/// all around it, or ends at lines through the place. So it is enough to try corners.
///
/// What nobody sees has a lowest place, too, if we add its border. There, in some direction, it
/// goes on. So everything is seen if it is seen in all directions around all corners. For this the
/// borders of what is inside count as rays.
#include "sightline/place_proof.h"

#include "analysis/placement/proof_sight.h"
#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

/// A part of a line on which regions may end.
typedef struct ray_part {
    sl_segment line;
    sli_meet to;
    sl_box box;   ///< holds all of it
    uint32_t eye; ///< UINT32_MAX: none
    int32_t wall; ///< at its end
} ray_part;

/// A direction, from a to b.
typedef sl_segment direction;

typedef struct checker {
    sl_context *context;
    const sl_space *space;
    int digits; ///< of coordinates in messages
    sli_proof_scene scene;
    sli_eye *eyes;
    sl_box *eye_boxes; ///< by eye: they hold all that it sees
    uint32_t eye_count;
    SL_ARRAY(ray_part) rays;
    sl_status (*visit)(struct checker *c, const sli_meet *p, int32_t wall, uint32_t eye);
    sl_place_verdict *out;
    // The lower bound.
    const sl_cover_problem *columns;
    sl_bits *sets;     ///< of the columns
    size_t *row_first; ///< by row: its columns
    uint32_t *row_columns;
    sl_bits *here;
    size_t words;
    // The upper bound.
    sl_box *cell_boxes;
    SL_ARRAY(direction) around;
} checker;

// --- corners of the arrangement

static void widen(sl_box *box, const sli_meet *p) {
    const sl_box b = {{p->at.x - p->error, p->at.y - p->error},
                      {p->at.x + p->error, p->at.y + p->error}};
    if (!(b.min.x >= box->min.x)) box->min.x = b.min.x;
    if (!(b.min.y >= box->min.y)) box->min.y = b.min.y;
    if (!(b.max.x <= box->max.x)) box->max.x = b.max.x;
    if (!(b.max.y <= box->max.y)) box->max.y = b.max.y;
}

static bool may_hold(const sl_box *box, const sli_meet *p) {
    return !(p->at.x + p->error < box->min.x) && !(p->at.x - p->error > box->max.x) &&
           !(p->at.y + p->error < box->min.y) && !(p->at.y - p->error > box->max.y);
}

static sl_status add_ray(checker *c, sl_segment line, sl_point from, sli_meet to, uint32_t eye,
                         int32_t wall) {
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->rays, 1));
    ray_part *r = &c->rays.items[c->rays.count++];
    *r = (ray_part){line, to, {from, from}, eye, wall};
    widen(&r->box, &to);
    return SL_OK;
}

static sl_status add_eye_rays(checker *c, uint32_t eye) {
    const sli_eye *e = &c->eyes[eye];
    for (uint32_t i = 0; i < e->ray_count; i++) {
        const sli_proof_ray *r = &e->rays[i];
        const sl_segment line = {e->at, r->to};
        if (r->window)
            SL_TRY(
                add_ray(c, line, r->to, sli_meet_lines(line, c->scene.walls[r->end]), eye, r->end));
    }
    return SL_OK;
}

static int compare_rays(const void *left, const void *right) {
    const ray_part *a = left, *b = right;
    if (a->box.min.x != b->box.min.x) return a->box.min.x < b->box.min.x ? -1 : 1;
    return (a->eye > b->eye) - (a->eye < b->eye);
}

/// Whether the lines of a place meet in a corner of walls. Corners are tried for themselves: a
/// place there stands between two walls, which rays do not know.
static bool is_corner(const checker *c, const sli_meet *p) {
    uint32_t low = 0, high = c->scene.corner_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (c->scene.corners[middle].at.x < p->at.x - p->error)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < c->scene.corner_count; low++) {
        const sl_point at = c->scene.corners[low].at;
        if (at.x > p->at.x + p->error) return false;
        if (!sli_orient(p->s.a, p->s.b, at) && !sli_orient(p->t.a, p->t.b, at)) return true;
    }
    return false;
}

static sl_status visit_crossing(checker *c, const ray_part *r, const ray_part *s) {
    if (r->eye == s->eye) return SL_OK; // rays of one eye meet only there
    if (!sli_turn(r->line.a, r->line.b, s->line.a, s->line.b)) return SL_OK;
    const sli_meet p = sli_meet_lines(r->line, s->line);
    if (!may_hold(&r->box, &p) || !may_hold(&s->box, &p) || is_corner(c, &p)) return SL_OK;
    return c->visit(c, &p, SLI_NO_WALL, r->eye);
}

/// Ends of rays, and all crossings of two.
static sl_status visit_rays(checker *c) {
    if (c->rays.count) qsort(c->rays.items, c->rays.count, sizeof *c->rays.items, compare_rays);
    for (size_t i = 0; i < c->rays.count; i++) {
        const ray_part *r = &c->rays.items[i];
        SL_TRY(sl_check_cancelled(c->context));
        if (r->eye != UINT32_MAX && !is_corner(c, &r->to))
            SL_TRY(c->visit(c, &r->to, r->wall, r->eye));
        for (size_t k = i + 1; k < c->rays.count; k++) {
            const ray_part *s = &c->rays.items[k];
            if (s->box.min.x > r->box.max.x) break;
            if (s->box.min.y > r->box.max.y || s->box.max.y < r->box.min.y) continue;
            SL_TRY(visit_crossing(c, r, s));
        }
    }
    return SL_OK;
}

// --- the lower bound

/// Whether a column has all witnesses that are here.
static bool is_part_of_column(const checker *c) {
    const sl_cover_problem *all = c->columns;
    uint32_t row = UINT32_MAX;
    for (uint32_t i = 0; i < all->row_count; i++)
        if (sl_bits_has(c->here, i) &&
            (row == UINT32_MAX ||
             c->row_first[i + 1] - c->row_first[i] < c->row_first[row + 1] - c->row_first[row]))
            row = i;
    if (row == UINT32_MAX) return true;
    for (size_t i = c->row_first[row]; i < c->row_first[row + 1]; i++) {
        const sl_bits *set = c->sets + c->row_columns[i] * c->words;
        bool within = true;
        for (size_t w = 0; w < c->words && within; w++) within = !(c->here[w] & ~set[w]);
        if (within) return true;
    }
    return false;
}

static void check_set(checker *c, const sli_meet *p) {
    c->out->places++;
    if (c->out->has_extra || is_part_of_column(c)) return;
    c->out->has_extra = true;
    c->out->extra = p->at;
}

static bool sees(const checker *c, uint32_t eye, const sli_meet *p) {
    return may_hold(&c->eye_boxes[eye], p) && sli_eye_sees(&c->scene, &c->eyes[eye], p);
}

static sl_status visit_for_witnesses(checker *c, const sli_meet *p, int32_t wall, uint32_t eye) {
    const sl_segment *w = wall < 0 ? NULL : &c->scene.walls[wall];
    const int side = w ? sli_orient(w->a, w->b, c->eyes[eye].at) : 0;
    for (size_t i = 0; i < c->words; i++) c->here[i] = 0;
    for (uint32_t i = 0; i < c->eye_count; i++) {
        if (w && sli_orient(w->a, w->b, c->eyes[i].at) * side < 0) continue;
        if (sees(c, i, p)) sl_bits_add(c->here, i);
    }
    check_set(c, p);
    return SL_OK;
}

/// Whether a point is between two directions from a corner, counter-clockwise, or on one of them.
static bool is_within(sl_point corner, sl_point from, sl_point to, sl_point p) {
    const int turn = sli_orient(corner, from, to);
    const int one = sli_orient(corner, from, p), two = sli_orient(corner, p, to);
    return turn < 0 ? !(one < 0 && two < 0) : one >= 0 && (two >= 0 || turn == 0);
}

/// A place in a corner stands between two walls that are neighbours there.
static void check_corner(checker *c, const sli_corner *corner, bool *seen) {
    const sli_meet p = sli_meet_point(corner->at);
    const sl_point *others = c->scene.others + corner->first;
    for (uint32_t i = 0; i < c->eye_count; i++) seen[i] = sees(c, i, &p);
    for (uint32_t k = 0; k < corner->count; k++) {
        const sl_point from = others[k], to = others[(k + 1) % corner->count];
        for (size_t i = 0; i < c->words; i++) c->here[i] = 0;
        for (uint32_t i = 0; i < c->eye_count; i++)
            if (seen[i] && (corner->count == 1 || is_within(corner->at, from, to, c->eyes[i].at)))
                sl_bits_add(c->here, i);
        check_set(c, &p);
    }
}

static sl_status check_corners(checker *c) {
    bool *seen = sl_alloc_array(c->context, c->eye_count, sizeof *seen);
    if (!seen) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < c->scene.corner_count; i++)
        check_corner(c, &c->scene.corners[i], seen);
    sl_free(c->context, seen);
    return SL_OK;
}

/// Columns as sets of bits, and by row.
static sl_status index_columns(checker *c) {
    const sl_cover_problem *all = c->columns;
    const size_t entries = all->column_count ? all->ends[all->column_count - 1] : 0;
    c->words = sl_bits_words(all->row_count);
    c->here = sl_alloc_array(c->context, c->words, sizeof *c->here);
    c->sets = sl_alloc_array(c->context, c->words * all->column_count, sizeof *c->sets);
    c->row_first = sl_alloc_array(c->context, (size_t)all->row_count + 2, sizeof *c->row_first);
    c->row_columns = sl_alloc_array(c->context, entries, sizeof *c->row_columns);
    if (!c->here || !c->sets || !c->row_first || !c->row_columns) return SL_NO_MEMORY;
    for (size_t i = 0; i < entries; i++) c->row_first[all->entries[i] + 2]++;
    for (uint32_t i = 1; i <= all->row_count; i++) c->row_first[i + 1] += c->row_first[i];
    size_t at = 0;
    for (uint32_t k = 0; k < all->column_count; k++)
        for (; at < all->ends[k]; at++) {
            sl_bits_add(c->sets + k * c->words, all->entries[at]);
            c->row_columns[c->row_first[all->entries[at] + 1]++] = k;
        }
    return SL_OK;
}

static sl_status check_lower(checker *c, const sl_placement *claim) {
    c->columns = &claim->columns;
    c->visit = visit_for_witnesses;
    SL_TRY(index_columns(c));
    for (uint32_t i = 0; i < c->eye_count; i++) SL_TRY(add_eye_rays(c, i));
    SL_TRY(check_corners(c));
    SL_TRY(visit_rays(c));
    if (c->out->has_extra) return SL_OK;
    return sl_cover_check(c->context, c->columns, &claim->proof, &c->out->lower);
}

// --- the upper bound

/// The sign of b's turn from a, where b is within half a turn and not in line with it: for a
/// sector, of its first direction, or of its last where the first one is in line.
static int side_of_sector(direction line, const direction *sector) {
    const int first = sli_turn(line.a, line.b, sector[0].a, sector[0].b);
    if (first) return first;
    const int last = sli_turn(line.a, line.b, sector[1].a, sector[1].b);
    if (last) return last;
    return sli_compare_points(line.a, line.b) == sli_compare_points(sector[0].a, sector[0].b) ? 1
                                                                                              : -1;
}

/// Whether an eye sees the beginning of a sector at a place.
static bool sees_sector(const checker *c, const sli_eye *e, const sli_meet *p,
                        const direction *sector) {
    const sli_bearing b = sli_eye_bearing(e, p);
    uint32_t ray = b.ray;
    const uint32_t last = e->ray_count - 1;
    if (b.here) {
        for (ray = 0; ray < e->ray_count; ray++) {
            const direction from = {e->at, e->rays[ray].to},
                            to = {e->at, e->rays[ray == last ? 0 : ray + 1].to};
            if (side_of_sector(from, sector) > 0 && side_of_sector(to, sector) < 0) break;
        }
        return ray < e->ray_count && e->rays[ray].cone != SLI_SHUT;
    }
    if (b.on && side_of_sector((direction){e->at, e->rays[ray].to}, sector) < 0)
        ray = ray ? ray - 1 : last;
    const int32_t wall = e->rays[ray].cone;
    if (wall < 0) return false;
    const int side = sli_eye_side(&c->scene, e, wall, p);
    if (side) return side > 0;
    const sl_segment *w = &c->scene.walls[wall];
    return side_of_sector(*w, sector) * sli_orient(w->a, w->b, e->at) > 0;
}

/// Whether an eye sees all around a place.
static bool sees_around(const checker *c, uint32_t eye, const sli_meet *p) {
    const sli_eye *e = &c->eyes[eye];
    if (!may_hold(&c->eye_boxes[eye], p)) return false;
    const sli_bearing b = sli_eye_bearing(e, p);
    if (b.on) return false;
    const int32_t wall = e->rays[b.ray].cone;
    return wall >= 0 && sli_eye_side(&c->scene, e, wall, p) > 0;
}

static sl_status add_direction(checker *c, sl_point a, sl_point b) {
    SL_TRY(SL_ARRAY_ROOM(c->context, &c->around, 2));
    c->around.items[c->around.count++] = (direction){a, b};
    c->around.items[c->around.count++] = (direction){b, a};
    return SL_OK;
}

/// Lines through a place at which regions end.
static sl_status add_eye_directions(checker *c, const sli_eye *e, const sli_meet *p) {
    const sli_bearing b = sli_eye_bearing(e, p);
    if (b.here) {
        for (uint32_t i = 0; i < e->ray_count; i++) SL_TRY(add_direction(c, e->at, e->rays[i].to));
        return SL_OK;
    }
    if (b.on) SL_TRY(add_direction(c, e->at, e->rays[b.ray].to));
    const uint32_t rays[] = {b.ray, b.ray ? b.ray - 1 : e->ray_count - 1};
    for (int i = 0; i < (b.on ? 2 : 1); i++) {
        const int32_t wall = e->rays[rays[i]].cone;
        if (wall < 0 || sli_eye_side(&c->scene, e, wall, p)) continue;
        SL_TRY(add_direction(c, c->scene.walls[wall].a, c->scene.walls[wall].b));
    }
    return SL_OK;
}

static int compare_directions(const void *left, const void *right) {
    const direction *a = left, *b = right;
    const int one = sli_compare_points(a->a, a->b), two = sli_compare_points(b->a, b->b);
    if (one != two) return one < two ? -1 : 1;
    return -sli_turn(a->a, a->b, b->a, b->b);
}

static bool is_cell_at(const checker *c, uint32_t cell, const sli_meet *p) {
    const sl_cell *k = &c->space->cells[cell];
    const sl_point *corners = c->space->vertices + k->first_vertex;
    if (!k->inside || !may_hold(&c->cell_boxes[cell], p)) return false;
    for (uint32_t i = 0; i < k->vertex_count; i++)
        if (sli_meet_side(p, corners[i], corners[(i + 1) % k->vertex_count]) < 0) return false;
    return true;
}

/// Sorts directions, and keeps one of each.
static void sort_directions(checker *c) {
    size_t kept = 0;
    qsort(c->around.items, c->around.count, sizeof *c->around.items, compare_directions);
    for (size_t i = 0; i < c->around.count; i++)
        if (!kept || compare_directions(&c->around.items[kept - 1], &c->around.items[i]))
            c->around.items[kept++] = c->around.items[i];
    c->around.count = kept;
}

static bool is_in_cell(const checker *c, const sl_cell *k, const sli_meet *p,
                       const direction *sector) {
    const sl_point *corners = c->space->vertices + k->first_vertex;
    for (uint32_t i = 0; i < k->vertex_count; i++) {
        const direction edge = {corners[i], corners[(i + 1) % k->vertex_count]};
        if (!sli_meet_side(p, edge.a, edge.b) && side_of_sector(edge, sector) < 0) return false;
    }
    return true;
}

static sl_status check_cell_at(checker *c, const sl_cell *k, const sli_meet *p, bool *seen) {
    const sl_point *corners = c->space->vertices + k->first_vertex;
    c->around.count = 0;
    for (uint32_t i = 0; i < k->vertex_count; i++) {
        const sl_point a = corners[i], b = corners[(i + 1) % k->vertex_count];
        if (!sli_meet_side(p, a, b)) SL_TRY(add_direction(c, a, b));
    }
    for (uint32_t i = 0; i < c->eye_count; i++)
        if (may_hold(&c->eye_boxes[i], p)) SL_TRY(add_eye_directions(c, &c->eyes[i], p));
    if (!c->around.count) SL_TRY(add_direction(c, c->scene.bounds.min, c->scene.bounds.max));
    sort_directions(c);
    for (size_t i = 0; i < c->around.count && *seen; i++) {
        const direction sector[] = {c->around.items[i], c->around.items[(i + 1) % c->around.count]};
        if (!is_in_cell(c, k, p, sector)) continue;
        *seen = false;
        for (uint32_t e = 0; e < c->eye_count && !*seen; e++)
            *seen = may_hold(&c->eye_boxes[e], p) && sees_sector(c, &c->eyes[e], p, sector);
    }
    return SL_OK;
}

static sl_status visit_for_viewpoints(checker *c, const sli_meet *p, int32_t wall, uint32_t eye) {
    bool seen = false;
    (void)wall;
    (void)eye;
    if (!c->out->sees_all) return SL_OK;
    c->out->corners++;
    for (uint32_t i = 0; i < c->eye_count && !seen; i++) seen = sees_around(c, i, p);
    if (seen) return SL_OK;
    for (uint32_t k = 0; k < c->space->cell_count; k++) {
        seen = true;
        if (is_cell_at(c, k, p)) SL_TRY(check_cell_at(c, &c->space->cells[k], p, &seen));
        if (seen) continue;
        c->out->sees_all = false;
        c->out->unseen = p->at;
        return SL_OK;
    }
    return SL_OK;
}

/// Borders of what is inside that are no walls: openings, and the bounds.
static sl_status add_borders(checker *c) {
    const sl_space *s = c->space;
    const sl_box *b = &s->bounds;
    const sl_point box[] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    for (uint32_t i = 0; i < s->portal_count; i++) {
        const sl_portal *p = &s->portals[i];
        if (s->cells[p->cell[0]].inside != s->cells[p->cell[1]].inside)
            SL_TRY(add_ray(c, (sl_segment){p->left, p->right}, p->left, sli_meet_point(p->right),
                           UINT32_MAX, SLI_NO_WALL));
    }
    for (int i = 0; i < 4; i++)
        SL_TRY(add_ray(c, (sl_segment){box[i], box[(i + 1) % 4]}, box[i],
                       sli_meet_point(box[(i + 1) % 4]), UINT32_MAX, SLI_NO_WALL));
    return SL_OK;
}

static sl_status check_upper(checker *c) {
    const sl_space *s = c->space;
    c->visit = visit_for_viewpoints;
    c->out->sees_all = true;
    c->cell_boxes = sl_alloc_array(c->context, s->cell_count, sizeof *c->cell_boxes);
    if (!c->cell_boxes) return SL_NO_MEMORY;
    for (uint32_t k = 0; k < s->cell_count; k++) {
        const sl_point *corners = s->vertices + s->cells[k].first_vertex;
        c->cell_boxes[k] = (sl_box){corners[0], corners[0]};
        for (uint32_t i = 1; i < s->cells[k].vertex_count; i++) {
            const sli_meet p = sli_meet_point(corners[i]);
            widen(&c->cell_boxes[k], &p);
        }
    }
    for (uint32_t i = 0; i < c->eye_count; i++) SL_TRY(add_eye_rays(c, i));
    SL_TRY(add_borders(c));
    for (uint32_t k = 0; k < s->cell_count; k++)
        for (uint32_t i = 0; s->cells[k].inside && i < s->cells[k].vertex_count; i++) {
            const sli_meet p = sli_meet_point(s->vertices[s->cells[k].first_vertex + i]);
            SL_TRY(c->visit(c, &p, SLI_NO_WALL, 0));
        }
    for (uint32_t i = 0; i < c->scene.corner_count; i++) {
        const sli_meet p = sli_meet_point(c->scene.corners[i].at);
        SL_TRY(c->visit(c, &p, SLI_NO_WALL, 0));
    }
    return visit_rays(c);
}

// --- both

static void clear(checker *c) {
    for (uint32_t i = 0; c->eyes && i < c->eye_count; i++) sli_eye_destroy(c->context, &c->eyes[i]);
    sl_free(c->context, c->eyes);
    sl_free(c->context, c->eye_boxes);
    sl_free(c->context, c->rays.items);
    sl_free(c->context, c->around.items);
    sl_free(c->context, c->cell_boxes);
    sl_free(c->context, c->sets);
    sl_free(c->context, c->row_first);
    sl_free(c->context, c->row_columns);
    sl_free(c->context, c->here);
    sli_proof_scene_destroy(c->context, &c->scene);
}

/// Each cone of an eye is a triangle, from the eye to the wall that ends it. On the rays themselves
/// sight may go farther.
static sl_box box_of_eye(const checker *c, const sli_eye *e) {
    static const sl_box all = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}};
    sl_box box = {e->at, e->at};
    for (uint32_t i = 0; i < e->ray_count; i++) {
        const sl_segment line = {e->at, e->rays[i].to};
        const int32_t walls[] = {e->rays[i].cone, e->rays[(i ? i : e->ray_count) - 1].cone,
                                 e->rays[i].end};
        for (int k = 0; k < 3; k++) {
            if (walls[k] == SLI_SHUT) continue;
            if (walls[k] < 0) return all;
            const sli_meet p = sli_meet_lines(line, c->scene.walls[walls[k]]);
            if (!isfinite(p.at.x) || !isfinite(p.at.y) || !isfinite(p.error)) return all;
            widen(&box, &p);
        }
    }
    return box;
}

static sl_status make_eye(checker *c, uint32_t i, sl_point at, bool witness) {
    bool on_wall = false;
    const char *what = witness ? "witness" : "viewpoint";
    if (!sl_space_is_inside(c->space, at))
        return sl_fail(c->context, SL_BAD_ARGUMENT, "%s %u at (%.*g, %.*g) is not inside", what,
                       i + 1, c->digits, at.x, c->digits, at.y);
    SL_TRY(sli_eye_make(c->context, &c->scene, at, &c->eyes[i], &on_wall));
    c->eye_boxes[i] = box_of_eye(c, &c->eyes[i]);
    if (witness && on_wall)
        return sl_fail(c->context, SL_BAD_ARGUMENT, "witness %u at (%.*g, %.*g) is on a wall",
                       i + 1, c->digits, at.x, c->digits, at.y);
    return SL_OK;
}

static sl_status check_bound(sl_context *context, const sl_space *space, const sl_map *map,
                             const sl_placement *claim, bool lower, sl_place_verdict *out) {
    checker c = {.context = context, .space = space, .digits = sl_map_digits(map), .out = out};
    c.eye_count = lower ? claim->witness_count : claim->count;
    sl_status status = sli_proof_scene_make(context, space, map, &c.scene);
    c.eyes = sl_alloc_array(context, c.eye_count, sizeof *c.eyes);
    c.eye_boxes = sl_alloc_array(context, c.eye_count, sizeof *c.eye_boxes);
    if (!c.eyes || !c.eye_boxes) status = SL_NO_MEMORY;
    for (uint32_t i = 0; status == SL_OK && i < c.eye_count; i++)
        status = make_eye(&c, i, lower ? claim->witnesses[i].at : claim->viewpoints[i].at, lower);
    if (status == SL_OK) status = lower ? check_lower(&c, claim) : check_upper(&c);
    clear(&c);
    return status;
}

sl_status sl_place_proof_check(sl_context *context, sl_query *query, const sl_placement *claim,
                               sl_place_verdict *out) {
    const sl_map *map = sl_query_map(query);
    const sl_space *space;
    *out = (sl_place_verdict){0};
    if (map->mirror_count || map->oneway_count || sl_map_limited_walls(map))
        return sl_fail(context, SL_UNSUPPORTED,
                       "placement knows no mirrors, one-way glass and limited walls");
    SL_TRY(sl_query_space(context, query, &space, NULL));
    SL_TRY(check_bound(context, space, sl_query_map(query), claim, false, out));
    return check_bound(context, space, sl_query_map(query), claim, true, out);
}
