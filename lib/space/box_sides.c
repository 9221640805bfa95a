/// The sides of boxes, and the ground that boxes are put into.
#include "space/boxes.h"

#include "geometry/orient.h"

#include <math.h>
#include <stdlib.h>

unsigned sl_box_sides(sl_box box, sl_piece sides[4]) {
    const sl_point a = box.min, b = box.max;
    unsigned count = 0;
    if (a.y < b.y) {
        sides[count++] = (sl_piece){.axis = 0, .at = a.x, .lo = a.y, .hi = b.y};
        if (a.x < b.x) sides[count++] = (sl_piece){.axis = 0, .at = b.x, .lo = a.y, .hi = b.y};
    }
    if (a.x < b.x) {
        sides[count++] = (sl_piece){.axis = 1, .at = a.y, .lo = a.x, .hi = b.x};
        if (a.y < b.y) sides[count++] = (sl_piece){.axis = 1, .at = b.y, .lo = a.x, .hi = b.x};
    }
    return count;
}

sl_wall sl_piece_wall(const sl_piece *p) {
    return p->axis ? (sl_wall){.a = {p->lo, p->at}, .b = {p->hi, p->at}}
                   : (sl_wall){.a = {p->at, p->lo}, .b = {p->at, p->hi}};
}

static int compare_pieces(const void *left, const void *right) {
    const sl_piece *a = left, *b = right;
    if (a->axis != b->axis) return a->axis - b->axis;
    if (a->at != b->at) return a->at < b->at ? -1 : 1;
    return (a->lo > b->lo) - (a->lo < b->lo);
}

sl_status sl_piece_add(sl_context *context, sl_piece_list *list, sl_piece piece) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = piece;
    return SL_OK;
}

sl_status sl_piece_add_free(sl_context *context, const sl_piece *walls, size_t count,
                            sl_piece piece, sl_piece_list *out) {
    size_t i = sl_wall_lines_find(walls, count, piece.axis, piece.at, piece.lo);
    for (; i < count && piece.lo < piece.hi; i++) {
        const sl_piece *wall = &walls[i];
        if (wall->axis != piece.axis || wall->at != piece.at || wall->lo >= piece.hi) break;
        sl_piece before = piece;
        before.hi = wall->lo;
        if (before.lo < before.hi) SL_TRY(sl_piece_add(context, out, before));
        piece.lo = fmax(piece.lo, wall->hi);
    }
    return piece.lo < piece.hi ? sl_piece_add(context, out, piece) : SL_OK;
}

/// Sorts pieces, each place once: of those that overlap, the later goes on where the one before it
/// ends. Returns how many are left.
static size_t sort_out(sl_piece *pieces, size_t count) {
    size_t kept = 0;
    if (count) qsort(pieces, count, sizeof *pieces, compare_pieces);
    for (size_t i = 0; i < count; i++) {
        sl_piece piece = pieces[i];
        const sl_piece *last = kept ? &pieces[kept - 1] : NULL;
        if (last && last->axis == piece.axis && last->at == piece.at)
            piece.lo = fmax(piece.lo, last->hi);
        if (piece.lo < piece.hi) pieces[kept++] = piece;
    }
    return kept;
}

/// What of a side lies within the space's bounds; false for nothing.
static bool clip(const sl_box *bounds, sl_piece *side) {
    const double at_lo = side->axis ? bounds->min.y : bounds->min.x;
    const double at_hi = side->axis ? bounds->max.y : bounds->max.x;
    side->lo = fmax(side->lo, side->axis ? bounds->min.x : bounds->min.y);
    side->hi = fmin(side->hi, side->axis ? bounds->max.x : bounds->max.y);
    return side->at >= at_lo && side->at <= at_hi && side->lo < side->hi;
}

static sl_status add_sides(sl_context *context, const sl_box_ground *ground,
                           const sl_moving_box *boxes, size_t count, bool blocking,
                           sl_piece_list *all, sl_piece_list *out) {
    for (size_t i = 0; i < count; i++) {
        sl_piece sides[4];
        const unsigned n = boxes[i].blocks == blocking ? sl_box_sides(boxes[i].box, sides) : 0;
        for (unsigned k = 0; k < n; k++)
            if (clip(&ground->space->bounds, &sides[k]))
                SL_TRY(sl_piece_add(context, all, sides[k]));
    }
    all->count = sort_out(all->items, all->count);
    for (size_t i = 0; i < all->count; i++)
        SL_TRY(sl_piece_add_free(context, ground->walls, ground->wall_count, all->items[i], out));
    return SL_OK;
}

sl_status sl_box_sides_put(sl_context *context, const sl_box_ground *ground,
                           const sl_moving_box *boxes, size_t count, bool blocking,
                           sl_piece_list *out) {
    sl_piece_list all = {0};
    const sl_status status = add_sides(context, ground, boxes, count, blocking, &all, out);
    sl_free(context, all.items);
    return status;
}

// --- cells

/// By separating lines, the box's own and those of the cell's sides.
bool sl_cell_meets_box(const sl_space *space, uint32_t number, sl_box box) {
    const sl_point corners[4] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    bool left = true, right = true, under = true, over = true;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point next = v[i + 1 == cell->vertex_count ? 0 : i + 1];
        bool outside = true;
        for (int k = 0; k < 4 && outside; k++) outside = sl_orient(v[i], next, corners[k]) < 0;
        if (outside) return false;
        left &= v[i].x < box.min.x;
        right &= v[i].x > box.max.x;
        under &= v[i].y < box.min.y;
        over &= v[i].y > box.max.y;
    }
    return !left && !right && !under && !over;
}

// --- the ground

/// The axial ones of a mesh's walls.
static sl_status gather_axial(sl_context *context, const sl_space *space, sl_box_ground *out) {
    sl_piece *pieces = sl_alloc_array(context, space->wall_count, sizeof *pieces);
    size_t count = 0;
    if (!pieces) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_point a = space->walls[i].a, b = space->walls[i].b;
        sl_piece sides[4];
        // A box without width or height has one side.
        if (a.x == b.x || a.y == b.y)
            if (sl_box_sides(
                    (sl_box){{fmin(a.x, b.x), fmin(a.y, b.y)}, {fmax(a.x, b.x), fmax(a.y, b.y)}},
                    sides))
                pieces[count++] = sides[0];
    }
    *out = (sl_box_ground){space, pieces, sort_out(pieces, count)};
    return SL_OK;
}

sl_status sl_box_ground_create(sl_context *context, const sl_space *space, sl_box_ground *out) {
    if (space->directed_count != 2 * space->portal_count)
        return sl_fail(context, SL_UNSUPPORTED, "boxes are put in before one-way glass is");
    if (space->loose)
        return sl_fail(context, SL_UNSUPPORTED,
                       "boxes need cells that fit together, which a file of version 1 does not "
                       "have: bake the map anew");
    if (space->neighbour) return gather_axial(context, space, out);
    sl_piece *walls = NULL;
    SL_TRY(sl_wall_lines(context, "the walls", space->walls, space->wall_count, &walls));
    *out = (sl_box_ground){space, walls, space->wall_count};
    return SL_OK;
}

void sl_box_ground_destroy(sl_context *context, sl_box_ground *ground) {
    sl_free(context, ground->walls);
    *ground = (sl_box_ground){0};
}

// --- putting in

sl_status sl_boxes_put(sl_context *context, const sl_box_ground *ground, const sl_moving_box *boxes,
                       size_t count, sl_boxed_space *out) {
    sl_boxed_space made = {0};
    const sl_status status = ground->space->neighbour
                                 ? sl_boxes_put_mesh(context, ground, boxes, count, &made)
                                 : sl_boxes_put_axial(context, ground, boxes, count, &made);
    if (status == SL_OK)
        *out = made;
    else
        sl_boxed_space_destroy(context, &made);
    return status;
}

void sl_boxed_space_destroy(sl_context *context, sl_boxed_space *boxed) {
    sl_space_destroy(context, &boxed->space);
    sl_free(context, boxed->parents);
    sl_free(context, boxed->first_share);
    sl_free(context, boxed->shares);
    *boxed = (sl_boxed_space){0};
}
