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

#include "analysis/placement/cover_check.h"
#include "analysis/placement/proof_corners.h"
#include "geometry/orient.h"
#include "space/index.h"

typedef struct checker {
    sl_context *context;
    const sl_space *space;
    int digits; ///< of coordinates in messages
    sli_proof_scene scene;
    sli_eye *eyes;
    sl_box *eye_boxes; ///< by eye: they hold all that it sees
    uint32_t eye_count;
    sli_box_tree eye_tree;
    sli_box_list near; ///< eyes that may see a place
    sli_ray_parts rays;
    sl_place_verdict *out;
    // The lower bound.
    const sl_cover_problem *columns;
    size_t *row_first; ///< by row: its columns
    uint32_t *row_columns;
    sli_box_list here; ///< witnesses that a place sees, ascending
    // The upper bound.
    sl_box *cell_boxes;
    sli_box_tree cell_tree;
    sli_box_list cells; ///< that may have a place
    sli_directions around;
} checker;

// --- the lower bound

/// Whether a column has all witnesses that are here. Both lists ascend; if a column does not, some
/// may not be found in it, and none that it has not.
static bool has_all(const checker *c, uint32_t column) {
    const sl_cover_problem *all = c->columns;
    size_t at = sli_checked_begin(all, column), found = 0;
    for (; at < all->ends[column] && found < c->here.count; at++)
        found += all->entries[at] == c->here.items[found];
    return found == c->here.count;
}

/// Whether some column has all witnesses that are here.
static bool is_part_of_column(const checker *c) {
    const size_t *first = c->row_first;
    if (!c->here.count) return true;
    uint32_t row = c->here.items[0];
    for (size_t i = 1; i < c->here.count; i++) {
        const uint32_t other = c->here.items[i];
        if (first[other + 1] - first[other] < first[row + 1] - first[row]) row = other;
    }
    for (size_t i = first[row]; i < first[row + 1]; i++)
        if (has_all(c, c->row_columns[i])) return true;
    return false;
}

static void check_set(checker *c, const sli_meet *p) {
    c->out->places++;
    if (c->out->has_extra || is_part_of_column(c)) return;
    c->out->has_extra = true;
    c->out->extra = p->at;
}

static sl_box box_of(const sli_meet *p) {
    sl_box box = {p->at, p->at};
    sli_box_widen(&box, p);
    return box;
}

/// Fills c->near.
static sl_status find_near(checker *c, const sli_meet *p) {
    const sl_box box = box_of(p);
    return sli_box_tree_find(c->context, &c->eye_tree, &box, &c->near);
}

/// Fills c->near with witnesses that see a place, and makes room for as many in c->here.
static sl_status find_seers(checker *c, const sli_meet *p) {
    size_t count = 0;
    SL_TRY(find_near(c, p));
    for (size_t i = 0; i < c->near.count; i++)
        if (sli_eye_sees(&c->scene, &c->eyes[c->near.items[i]], p))
            c->near.items[count++] = c->near.items[i];
    c->near.count = count;
    c->here.count = 0;
    return SL_ARRAY_ROOM(c->context, &c->here, count);
}

static sl_status visit_for_witnesses(void *data, const sli_meet *p, int32_t wall, uint32_t eye) {
    checker *c = data;
    const sl_segment *w = wall < 0 ? NULL : &c->scene.walls[wall];
    const int side = w ? sli_orient(w->a, w->b, c->eyes[eye].at) : 0;
    SL_TRY(find_seers(c, p));
    for (size_t i = 0; i < c->near.count; i++) {
        const uint32_t other = c->near.items[i];
        if (w && sli_orient(w->a, w->b, c->eyes[other].at) * side < 0) continue;
        c->here.items[c->here.count++] = other;
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
static sl_status check_corner(checker *c, const sli_corner *corner) {
    const sli_meet p = sli_meet_point(corner->at);
    const sl_point *others = c->scene.others + corner->first;
    SL_TRY(find_seers(c, &p));
    for (uint32_t k = 0; k < corner->count; k++) {
        const sl_point from = others[k], to = others[(k + 1) % corner->count];
        c->here.count = 0;
        for (size_t i = 0; i < c->near.count; i++) {
            const uint32_t eye = c->near.items[i];
            if (corner->count == 1 || is_within(corner->at, from, to, c->eyes[eye].at))
                c->here.items[c->here.count++] = eye;
        }
        check_set(c, &p);
    }
    return SL_OK;
}

static sl_status check_corners(checker *c) {
    for (uint32_t i = 0; i < c->scene.corner_count; i++)
        SL_TRY(check_corner(c, &c->scene.corners[i]));
    return SL_OK;
}

/// Columns by row.
static sl_status index_columns(checker *c) {
    const sl_cover_problem *all = c->columns;
    const size_t entries = all->column_count ? all->ends[all->column_count - 1] : 0;
    c->row_first = sl_alloc_array(c->context, (size_t)all->row_count + 2, sizeof *c->row_first);
    c->row_columns = sl_alloc_array(c->context, entries, sizeof *c->row_columns);
    if (!c->row_first || !c->row_columns) return SL_NO_MEMORY;
    for (size_t i = 0; i < entries; i++) c->row_first[all->entries[i] + 2]++;
    for (uint32_t i = 1; i <= all->row_count; i++) c->row_first[i + 1] += c->row_first[i];
    size_t at = 0;
    for (uint32_t k = 0; k < all->column_count; k++)
        for (; at < all->ends[k]; at++) c->row_columns[c->row_first[all->entries[at] + 1]++] = k;
    return SL_OK;
}

static sl_status check_lower(checker *c, const sl_placement *claim) {
    c->columns = &claim->columns;
    SL_TRY(index_columns(c));
    for (uint32_t i = 0; i < c->eye_count; i++)
        SL_TRY(sli_ray_add_eye(c->context, &c->scene, &c->eyes[i], i, &c->rays));
    SL_TRY(check_corners(c));
    SL_TRY(sli_rays_visit(c->context, &c->scene, &c->rays, visit_for_witnesses, c));
    if (c->out->has_extra) return SL_OK;
    return sl_cover_check(c->context, c->columns, &claim->proof, &c->out->lower);
}

// --- the upper bound

/// c->near are the eyes that may see the place.
static sl_status check_cell_at(checker *c, uint32_t cell, const sli_meet *p, bool *seen) {
    const sl_cell *k = &c->space->cells[cell];
    const sl_point *corners = c->space->vertices + k->first_vertex;
    c->around.count = 0;
    SL_TRY(sli_directions_add_cell(c->context, c->space, cell, p, &c->around));
    for (size_t i = 0; i < c->near.count; i++)
        SL_TRY(sli_directions_add_eye(c->context, &c->scene, &c->eyes[c->near.items[i]], p,
                                      &c->around));
    if (!c->around.count)
        SL_TRY(
            sli_directions_add(c->context, c->scene.bounds.min, c->scene.bounds.max, &c->around));
    sli_directions_sort(&c->around);
    for (size_t i = 0; i < c->around.count && *seen; i++) {
        const sli_direction sector[] = {c->around.items[i],
                                        c->around.items[(i + 1) % c->around.count]};
        if (!sli_polygon_has_sector(corners, k->vertex_count, p, sector)) continue;
        *seen = false;
        for (size_t e = 0; e < c->near.count && !*seen; e++)
            *seen = sli_eye_sees_sector(&c->scene, &c->eyes[c->near.items[e]], p, sector);
    }
    return SL_OK;
}

static sl_status visit_for_viewpoints(void *data, const sli_meet *p, int32_t wall, uint32_t eye) {
    checker *c = data;
    bool seen = false;
    (void)wall;
    (void)eye;
    if (!c->out->sees_all) return SL_OK;
    c->out->corners++;
    SL_TRY(find_near(c, p));
    for (size_t i = 0; i < c->near.count && !seen; i++)
        seen = sli_eye_sees_around(&c->scene, &c->eyes[c->near.items[i]], p);
    if (seen) return SL_OK;
    const sl_box box = box_of(p);
    SL_TRY(sli_box_tree_find(c->context, &c->cell_tree, &box, &c->cells));
    for (size_t i = 0; i < c->cells.count; i++) {
        const uint32_t k = c->cells.items[i];
        seen = true;
        if (sli_cell_has_meet(c->space, k, &c->cell_boxes[k], p))
            SL_TRY(check_cell_at(c, k, p, &seen));
        if (seen) continue;
        c->out->sees_all = false;
        c->out->unseen = p->at;
        return SL_OK;
    }
    return SL_OK;
}

static sl_status add_border(checker *c, sl_point a, sl_point b) {
    return sli_ray_add(c->context, sli_ray_between(a, b, UINT32_MAX, SLI_PART_BORDER), &c->rays);
}

/// Borders of what is inside that are no walls: openings, and the bounds.
static sl_status add_borders(checker *c) {
    const sl_space *s = c->space;
    const sl_box *b = &s->bounds;
    const sl_point box[] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    for (uint32_t i = 0; i < s->portal_count; i++) {
        const sl_portal *p = &s->portals[i];
        if (s->cells[p->cell[0]].inside != s->cells[p->cell[1]].inside)
            SL_TRY(add_border(c, p->left, p->right));
    }
    for (int i = 0; i < 4; i++) SL_TRY(add_border(c, box[i], box[(i + 1) % 4]));
    return SL_OK;
}

static sl_status check_upper(checker *c) {
    const sl_space *s = c->space;
    c->out->sees_all = true;
    c->cell_boxes = sl_alloc_array(c->context, s->cell_count, sizeof *c->cell_boxes);
    if (!c->cell_boxes) return SL_NO_MEMORY;
    for (uint32_t k = 0; k < s->cell_count; k++) c->cell_boxes[k] = sli_box_of_cell(s, k);
    SL_TRY(sli_box_tree_create(c->context, c->cell_boxes, s->cell_count, &c->cell_tree));
    for (uint32_t i = 0; i < c->eye_count; i++)
        SL_TRY(sli_ray_add_eye(c->context, &c->scene, &c->eyes[i], i, &c->rays));
    SL_TRY(add_borders(c));
    for (uint32_t k = 0; k < s->cell_count; k++)
        for (uint32_t i = 0; s->cells[k].inside && i < s->cells[k].vertex_count; i++) {
            const sli_meet p = sli_meet_point(s->vertices[s->cells[k].first_vertex + i]);
            SL_TRY(visit_for_viewpoints(c, &p, SLI_NO_WALL, 0));
        }
    for (uint32_t i = 0; i < c->scene.corner_count; i++) {
        const sli_meet p = sli_meet_point(c->scene.corners[i].at);
        SL_TRY(visit_for_viewpoints(c, &p, SLI_NO_WALL, 0));
    }
    return sli_rays_visit(c->context, &c->scene, &c->rays, visit_for_viewpoints, c);
}

// --- both

static void clear(checker *c) {
    for (uint32_t i = 0; c->eyes && i < c->eye_count; i++) sli_eye_destroy(c->context, &c->eyes[i]);
    sl_free(c->context, c->eyes);
    sl_free(c->context, c->eye_boxes);
    sl_free(c->context, c->rays.items);
    sl_free(c->context, c->around.items);
    sl_free(c->context, c->cell_boxes);
    sl_free(c->context, c->row_first);
    sl_free(c->context, c->row_columns);
    sl_free(c->context, c->here.items);
    sl_free(c->context, c->near.items);
    sl_free(c->context, c->cells.items);
    sli_box_tree_destroy(c->context, &c->eye_tree);
    sli_box_tree_destroy(c->context, &c->cell_tree);
    sli_proof_scene_destroy(c->context, &c->scene);
}

static sl_status make_eye(checker *c, uint32_t i, sl_point at, bool witness) {
    bool on_wall = false;
    const char *what = witness ? "witness" : "viewpoint";
    if (!sl_space_is_inside(c->space, at))
        return sl_fail(c->context, SL_BAD_ARGUMENT, "%s %u at (%.*g, %.*g) is not inside", what,
                       i + 1, c->digits, at.x, c->digits, at.y);
    SL_TRY(sli_eye_make(c->context, &c->scene, at, &c->eyes[i], &on_wall));
    c->eye_boxes[i] = sli_box_of_eye(&c->scene, &c->eyes[i]);
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
    if (status == SL_OK)
        status = sli_box_tree_create(context, c.eye_boxes, c.eye_count, &c.eye_tree);
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
