/// Many boxes that are seen through: which of them does an eye see?
///
/// No cell is cut. Each cell has a list of the boxes that reach into it. The exact search enters a
/// cell with an arc of directions, and asks the boxes of that cell. A box is seen there if box, arc
/// and cell have a point in common: how, box_sector.h says, a part that the runtime header has in
/// common with the library.
///
/// Invariant: a list has no box that only touches its cell, so a box at a wall is not seen from the
/// wall's other side. Cost: a box that moves costs the cells near it; an eye costs the sides of the
/// cells that it sees, once for each box in them. (Culling objects by cells: Teller 1992, section
/// 5.3.)
#include "geometry/crossing.h"
#include "sight/eye_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the cells of a box

/// Whether a box without width or height lies on a portal of a cell: not just on its end.
static bool lies_on_portal(const sl_space *space, const sl_cell *cell, sl_box box) {
    const bool upright = box.min.x == box.max.x;
    if (upright && box.min.y == box.max.y) return true;
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const sl_directed_portal *d = &space->directed[cell->first_directed + i];
        const sl_point a = d->left, b = d->right;
        if (upright ? a.x == box.min.x && b.x == box.min.x && fmin(a.y, b.y) < box.max.y &&
                          box.min.y < fmax(a.y, b.y)
                    : a.y == box.min.y && b.y == box.min.y && fmin(a.x, b.x) < box.max.x &&
                          box.min.x < fmax(a.x, b.x))
            return true;
    }
    return false;
}

/// Whether a box has points within a cell, or lies on one of its portals.
static bool reaches_into(const sl_space *space, uint32_t number, sl_box box) {
    const sl_point corners[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    bool left = true, right = true, under = true, over = true, touches = false;
    if (!sli_cell_meets_box(space, number, box)) return false;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point next = v[i + 1 == cell->vertex_count ? 0 : i + 1];
        int most = -1;
        for (int k = 0; k < 4 && most <= 0; k++) {
            const int side = sli_orient(v[i], next, corners[k]);
            if (side > most) most = side;
        }
        touches |= most == 0;
        left &= v[i].x <= box.min.x;
        right &= v[i].x >= box.max.x;
        under &= v[i].y <= box.min.y;
        over &= v[i].y >= box.max.y;
    }
    if (!touches && !left && !right && !under && !over) return true;
    return (box.min.x == box.max.x || box.min.y == box.max.y) && lies_on_portal(space, cell, box);
}

/// A box in a cell.
typedef struct pair {
    uint32_t cell, box;
} pair;

typedef struct gatherer {
    sl_context *context;
    const sl_space *space;
    uint32_t *last; ///< by cell: the last box that was tested against it, plus 1
    SL_ARRAY(pair) pairs;
    SL_ARRAY(int32_t) stack;
} gatherer;

static sl_status add_box_piece(gatherer *g, uint32_t cell, uint32_t box, sl_box at) {
    if (g->last[cell] == box + 1) return SL_OK;
    g->last[cell] = box + 1;
    if (!reaches_into(g->space, cell, at)) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->pairs, 1));
    g->pairs.items[g->pairs.count++] = (pair){cell, box};
    return SL_OK;
}

static sl_status add_down_tree(gatherer *g, uint32_t box, sl_box at) {
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->stack, 1));
    g->stack.items[g->stack.count++] = g->space->root;
    while (g->stack.count) {
        const int32_t child = g->stack.items[--g->stack.count];
        if (child < 0) {
            SL_TRY(add_box_piece(g, (uint32_t)~child, box, at));
            continue;
        }
        const sl_node *node = &g->space->nodes[child];
        SL_TRY(SL_ARRAY_ROOM(g->context, &g->stack, 2));
        if ((node->axis ? at.min.y : at.min.x) <= node->position)
            g->stack.items[g->stack.count++] = node->below;
        if ((node->axis ? at.max.y : at.max.x) >= node->position)
            g->stack.items[g->stack.count++] = node->above;
    }
    return SL_OK;
}

static sl_status gather(gatherer *g, const sl_moving_box *boxes, size_t count) {
    const sl_space *s = g->space;
    g->last = sl_alloc_array(g->context, s->cell_count, sizeof *g->last);
    if (!g->last) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        if (!s->neighbour) {
            SL_TRY(add_down_tree(g, i, boxes[i].box));
            continue;
        }
        sli_cell_grid_range r = sli_cell_grid_range_of(s, boxes[i].box);
        for (uint32_t cell; sli_cell_grid_next(&s->grid, &r, &cell);)
            SL_TRY(add_box_piece(g, cell, i, boxes[i].box));
    }
    return SL_OK;
}

/// Sorts the pairs by cell.
static sl_status write_lists(const gatherer *g, sli_box_lists *out) {
    const uint32_t cells = g->space->cell_count;
    if (g->pairs.count > UINT32_MAX) return sl_fail_memory(g->context);
    out->first = sl_alloc_array(g->context, (size_t)cells + 2, sizeof *out->first);
    out->items = sl_alloc_array(g->context, g->pairs.count, sizeof *out->items);
    if (!out->first || !out->items) return SL_NO_MEMORY;
    for (size_t i = 0; i < g->pairs.count; i++) out->first[g->pairs.items[i].cell + 2]++;
    for (uint32_t c = 0; c < cells; c++) out->first[c + 2] += out->first[c + 1];
    for (size_t i = 0; i < g->pairs.count; i++)
        out->items[out->first[g->pairs.items[i].cell + 1]++] = g->pairs.items[i].box;
    return SL_OK;
}

void sli_box_lists_destroy(sl_context *context, sli_box_lists *lists) {
    sl_free(context, lists->first);
    sl_free(context, lists->items);
    *lists = (sli_box_lists){0};
}

sl_status sli_box_lists_make(sl_context *context, const sl_space *space, const sl_moving_box *boxes,
                             size_t count, sli_box_lists *out) {
    SL_TRY(sli_boxes_check(context, boxes, count));
    gatherer g = {.context = context, .space = space};
    *out = (sli_box_lists){.boxes = boxes, .count = count};
    sl_status status = gather(&g, boxes, count);
    if (status == SL_OK) status = write_lists(&g, out);
    sl_free(context, g.last);
    sl_free(context, g.pairs.items);
    sl_free(context, g.stack.items);
    if (status != SL_OK) sli_box_lists_destroy(context, out);
    return status;
}

// --- a box, an arc and a cell

typedef sl_point slrt_point;
typedef sli_eye_query slrt_eye;
typedef sli_ray slrt_ray;

static sl_point slrt_eye_at(const sli_eye_query *query) {
    return query->pivot.eye;
}

static sl_point slrt_vertex(const sli_eye_query *query, uint32_t number) {
    return query->space->vertices[number];
}

static int slrt_turn_to(const sli_eye_query *query, const sli_ray *ray, sl_point at) {
    const int turn = sli_orient(query->pivot.eye, ray->point, at);
    return ray->away ? -turn : turn;
}

static int slrt_ray_sign(const sli_eye_query *query, const sli_ray *ray, int axis) {
    const double from = axis ? query->pivot.eye.y : query->pivot.eye.x;
    const double to = axis ? ray->point.y : ray->point.x;
    const int sign = (to > from) - (to < from);
    return ray->away ? -sign : sign;
}

static int slrt_way_turn(const sli_eye_query *query, const sli_ray *ray, sl_point a, sl_point b) {
    const int turn = sli_turn(a, b, query->pivot.eye, ray->point);
    return ray->away ? -turn : turn;
}

static int slrt_side_meets(const sli_eye_query *query, const sli_ray *ray, sl_point a, sl_point b,
                           int axis, double at) {
    const int sign = sli_axial_meet_side(query->pivot.eye, ray->point, a, b, axis, at);
    return ray->away ? -sign : sign;
}

#include "runtime/parts/box_sector.h"

/// For an eye on a wall that bounds a cell behind it: a line along that wall comes into the cell by
/// a portal farther on. Whether it meets a box from there on.
static bool meets_behind_wall(const sli_eye_query *query, uint32_t number, const double box[4],
                              const sli_ray *ray) {
    const sl_cell *cell = &query->space->cells[number];
    const sl_point eye = query->pivot.eye;
    for (uint32_t i = 0; i < cell->directed_count; i++) {
        const sl_directed_portal *d = &query->space->directed[cell->first_directed + i];
        sli_eye_query from = *query;
        if (sli_orient(d->left, d->right, eye) != 0) continue;
        const sli_ray ends[2] = {sli_ray_to(d->left), sli_ray_to(d->right)};
        if (sli_same_point(d->left, eye) || sli_same_point(d->right, eye) ||
            !sli_ray_same_way(&from.pivot, ends[0], ends[1]))
            continue; // the eye is on the portal, behind the wall
        if (!sli_ray_same_way(&from.pivot, ends[0], *ray)) continue;
        // From the nearer end on.
        const bool left_is_near = fabs(d->left.x - eye.x) + fabs(d->left.y - eye.y) <
                                  fabs(d->right.x - eye.x) + fabs(d->right.y - eye.y);
        from.pivot.eye = left_is_near ? d->left : d->right;
        const sli_ray on = sli_ray_to(left_is_near ? d->right : d->left);
        if (slrt_box_meets_sector(&from, box, &on, &on)) return true;
    }
    return false;
}

static bool sees_in_arc(const sli_eye_query *query, uint32_t cell, sl_box box, const sli_arc *arc) {
    const double at[4] = {box.min.x, box.min.y, box.max.x, box.max.y};
    const sl_cell *c = &query->space->cells[cell];
    if (!slrt_box_meets_within(query, at, c->first_vertex, c->vertex_count, &arc->right,
                               &arc->left))
        return false;
    return arc->span != SLI_SPAN_RAY || !sli_cell_holds(query->space, cell, query->pivot.eye) ||
           sli_eye_is_in(query, cell) || meets_behind_wall(query, cell, at, &arc->right);
}

/// Whether the eye sees a box in a cell of its own. A wide cone is two halves, from each border on.
static bool sees_in_cone(const sli_eye_query *query, uint32_t cell, sl_box box) {
    const sli_cone *cone = &query->cone;
    if (cone->full) return true;
    if (!cone->wide) return sees_in_arc(query, cell, box, &cone->arc);
    sli_arc halves[2] = {{cone->arc.left, cone->arc.left, SLI_SPAN_HALF},
                         {cone->arc.right, cone->arc.right, SLI_SPAN_HALF}};
    halves[0].left.away = !halves[0].left.away;
    halves[1].right.away = !halves[1].right.away;
    return sees_in_arc(query, cell, box, &halves[0]) || sees_in_arc(query, cell, box, &halves[1]);
}

void sli_eye_meet_boxes(sli_eye_query *query, const sli_eye_step *at, bool first) {
    const sli_box_lists *lists = query->search->boxes;
    const uint32_t cell = at->at.cell;
    for (uint32_t i = lists->first[cell]; i < lists->first[cell + 1]; i++) {
        bool *seen = &query->search->boxes_seen[lists->items[i]];
        const sl_box box = lists->boxes[lists->items[i]].box;
        if (*seen) continue;
        if (first) *seen = sees_in_cone(query, cell, box);
        for (unsigned k = 0; k < at->arc_count && !*seen; k++)
            *seen = sees_in_arc(query, cell, box, &at->arcs[k]);
    }
}

sl_status sli_eye_boxes_seen(sl_context *context, sli_eye_search *search,
                             const sli_box_lists *lists, const sl_view *view, uint64_t *cells,
                             bool *seen) {
    sl_eye_account account;
    if (lists->count) memset(seen, 0, lists->count * sizeof *seen);
    search->boxes = lists;
    search->boxes_seen = seen;
    const sl_status status = sli_eye_exact(context, search, view, cells, &account);
    search->boxes = NULL;
    const sl_point eye = view->eye;
    if (status != SL_OK || sli_eye_cell(search->space, eye) == SL_NO_CELL) return status;
    for (size_t i = 0; i < lists->count; i++) seen[i] |= sli_box_holds(&lists->boxes[i].box, eye);
    return SL_OK;
}
