#include "eye_to_cell/box_targets.h"

#include "geometry/orient.h"
#include "space/box_tree.h"

#include <math.h>
#include <stdlib.h>

/// A piece of a box's side in a cell.
typedef struct target {
    uint32_t cell;
    sl_exit exit;
} target;

typedef struct gatherer {
    sl_context *context;
    const sl_space *space;
    sl_box *around; ///< by cell; NULL for a kd-tree's space
    SL_ARRAY(target) targets;
    SL_ARRAY(int32_t) stack;
    sl_piece_list free;
} gatherer;

static sl_status add(gatherer *g, uint32_t cell, uint32_t box, sl_point left, sl_point right) {
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->targets, 1));
    g->targets.items[g->targets.count++] = (target){cell, {box, SL_NO_CELL, left, right}};
    return SL_OK;
}

// --- where cells are boxes

/// Adds a piece where it lies on the boundary of a cell.
static sl_status add_on_boundary(gatherer *g, uint32_t cell, const sl_piece *side, uint32_t box) {
    const sl_point *corners = g->space->vertices + g->space->cells[cell].first_vertex;
    const sl_point min = corners[0], max = corners[2];
    const bool below = side->at == (side->axis ? max.y : max.x);
    const bool above = side->at == (side->axis ? min.y : min.x);
    const double lo = fmax(side->lo, side->axis ? min.x : min.y);
    const double hi = fmin(side->hi, side->axis ? max.x : max.y);
    if (!(below || above) || lo >= hi) return SL_OK;
    // Going up in the line's coordinate, the left hand is at high y (axis 0) or at low x (axis 1).
    const sl_point a = side->axis ? (sl_point){lo, side->at} : (sl_point){side->at, hi};
    const sl_point b = side->axis ? (sl_point){hi, side->at} : (sl_point){side->at, lo};
    return add(g, cell, box, below ? a : b, below ? b : a);
}

/// Adds a piece to all cells that it lies on the boundary of.
static sl_status add_down_tree(gatherer *g, const sl_piece *side, uint32_t box) {
    g->stack.count = 0;
    SL_TRY(SL_ARRAY_ROOM(g->context, &g->stack, 1));
    g->stack.items[g->stack.count++] = g->space->root;
    while (g->stack.count) {
        const int32_t child = g->stack.items[--g->stack.count];
        if (child < 0) {
            SL_TRY(add_on_boundary(g, (uint32_t)~child, side, box));
            continue;
        }
        const sl_node *node = &g->space->nodes[child];
        const double lo = node->axis == side->axis ? side->at : side->lo;
        const double hi = node->axis == side->axis ? side->at : side->hi;
        SL_TRY(SL_ARRAY_ROOM(g->context, &g->stack, 2));
        if (lo <= node->position) g->stack.items[g->stack.count++] = node->below;
        if (hi >= node->position) g->stack.items[g->stack.count++] = node->above;
    }
    return SL_OK;
}

// --- where cells are convex

static double along(const sl_piece *side, sl_point p) {
    return side->axis ? p.x : p.y;
}

static double across(const sl_piece *side, sl_point p) {
    return side->axis ? p.y : p.x;
}

static sl_point on(const sl_piece *side, double at) {
    return side->axis ? (sl_point){at, side->at} : (sl_point){side->at, at};
}

/// Where a piece's line crosses a side of a cell, moved by what rounding may have done to that:
/// down (-1) or up (1), but not past the side's ends.
static double crossing(const sl_piece *side, sl_point p, sl_point q, int way) {
    const double from = along(side, p), to = along(side, q);
    const double share = (side->at - across(side, p)) / (across(side, q) - across(side, p));
    const double at = from + share * (to - from) + way * 0x1p-50 * (fabs(from) + fabs(to));
    return fmax(fmin(at, fmax(from, to)), fmin(from, to));
}

/// What a cell has of a piece strictly inside. Whether that is anything is exact; its ends are,
/// where they are the piece's own.
static bool clip(const sl_space *space, uint32_t number, const sl_piece *piece, double *lo,
                 double *hi) {
    const sl_cell *cell = &space->cells[number];
    const sl_point *v = space->vertices + cell->first_vertex;
    const sl_point a = on(piece, piece->lo), b = on(piece, piece->hi);
    bool under = false, over = false;
    *lo = piece->lo, *hi = piece->hi;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const sl_point p = v[i], q = v[i + 1 == cell->vertex_count ? 0 : i + 1];
        const int at_a = sl_orient(p, q, a), at_b = sl_orient(p, q, b);
        under |= across(piece, p) < piece->at;
        over |= across(piece, p) > piece->at;
        if (at_a <= 0 && at_b <= 0) return false;
        // The line of a side may be crossed beyond the side, where another one ends the piece.
        const double at_p = across(piece, p), at_q = across(piece, q);
        const bool meets = fmin(at_p, at_q) <= piece->at && piece->at <= fmax(at_p, at_q);
        if (meets && at_a < 0) *lo = fmax(*lo, crossing(piece, p, q, -1));
        if (meets && at_b < 0) *hi = fmin(*hi, crossing(piece, p, q, 1));
    }
    return under && over && *lo < *hi;
}

/// Adds what lies of a piece along a side of a cell, on whose left hand the cell is.
static sl_status add_along(gatherer *g, uint32_t number, const sl_piece *piece, uint32_t box,
                           sl_point p, sl_point q) {
    const double from = along(piece, p), to = along(piece, q);
    const double lo = fmax(piece->lo, fmin(from, to)), hi = fmin(piece->hi, fmax(from, to));
    if (across(piece, p) != piece->at || across(piece, q) != piece->at || lo >= hi) return SL_OK;
    return add(g, number, box, on(piece, from < to ? hi : lo), on(piece, from < to ? lo : hi));
}

static sl_status add_to_cell(gatherer *g, uint32_t number, const sl_piece *piece, uint32_t box) {
    const sl_cell *cell = &g->space->cells[number];
    const sl_point *v = g->space->vertices + cell->first_vertex;
    double lo, hi;
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        SL_TRY(add_along(g, number, piece, box, v[i], v[i + 1 == cell->vertex_count ? 0 : i + 1]));
    if (!clip(g->space, number, piece, &lo, &hi)) return SL_OK;
    SL_TRY(add(g, number, box, on(piece, lo), on(piece, hi)));
    return add(g, number, box, on(piece, hi), on(piece, lo));
}

static sl_status add_to_cells(gatherer *g, const sl_piece *piece, uint32_t box) {
    const sl_point a = on(piece, piece->lo), b = on(piece, piece->hi);
    const sl_box side = sl_box_around(a, b);
    for (uint32_t i = 0; i < g->space->cell_count; i++) {
        const sl_box *cell = &g->around[i];
        if (cell->min.x <= side.max.x && side.min.x <= cell->max.x && cell->min.y <= side.max.y &&
            side.min.y <= cell->max.y)
            SL_TRY(add_to_cell(g, i, piece, box));
    }
    return SL_OK;
}

static sl_status put_boxes_around(gatherer *g) {
    g->around = sl_alloc_array(g->context, g->space->cell_count, sizeof *g->around);
    if (!g->around) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < g->space->cell_count; i++) {
        const sl_cell *cell = &g->space->cells[i];
        const sl_point *v = g->space->vertices + cell->first_vertex;
        g->around[i] = (sl_box){v[0], v[0]};
        for (uint32_t k = 1; k < cell->vertex_count; k++)
            g->around[i] = sl_box_with(g->around[i], v[k]);
    }
    return SL_OK;
}

// --- all of them

static int compare_targets(const void *left, const void *right) {
    const target *a = left, *b = right;
    return (a->cell > b->cell) - (a->cell < b->cell);
}

static sl_status write_targets(gatherer *g, sl_box_targets *out) {
    const uint32_t cells = g->space->cell_count;
    out->first = sl_alloc_array(g->context, (size_t)cells + 1, sizeof *out->first);
    out->items = sl_alloc_array(g->context, g->targets.count, sizeof *out->items);
    if (!out->first || !out->items) return SL_NO_MEMORY;
    if (g->targets.count > UINT32_MAX) return sl_fail_memory(g->context);
    if (g->targets.count)
        qsort(g->targets.items, g->targets.count, sizeof *g->targets.items, compare_targets);
    for (size_t i = 0; i < g->targets.count; i++) {
        out->items[i] = g->targets.items[i].exit;
        out->first[g->targets.items[i].cell + 1]++;
    }
    for (uint32_t c = 0; c < cells; c++) out->first[c + 1] += out->first[c];
    return SL_OK;
}

static sl_status gather(gatherer *g, const sl_box_ground *ground, const sl_moving_box *boxes,
                        size_t count) {
    if (g->space->beyond && count) SL_TRY(put_boxes_around(g));
    for (size_t i = 0; i < count; i++) {
        sl_piece sides[4];
        const unsigned n = sl_box_sides(boxes[i].box, sides);
        g->free.count = 0;
        for (unsigned k = 0; k < n; k++)
            SL_TRY(sl_piece_add_free(g->context, ground->walls, ground->wall_count, sides[k],
                                     &g->free));
        for (size_t k = 0; k < g->free.count; k++) {
            const sl_piece *piece = &g->free.items[k];
            SL_TRY(g->space->beyond ? add_to_cells(g, piece, (uint32_t)i)
                                    : add_down_tree(g, piece, (uint32_t)i));
        }
    }
    return SL_OK;
}

sl_status sl_box_targets_find(sl_context *context, const sl_box_ground *ground,
                              const sl_space *space, const sl_moving_box *boxes, size_t count,
                              sl_box_targets *out) {
    gatherer g = {.context = context, .space = space};
    sl_status status = gather(&g, ground, boxes, count);
    if (status == SL_OK) status = write_targets(&g, out);
    sl_free(context, g.around);
    sl_free(context, g.targets.items);
    sl_free(context, g.stack.items);
    sl_free(context, g.free.items);
    return status;
}

void sl_box_targets_destroy(sl_context *context, sl_box_targets *targets) {
    sl_free(context, targets->first);
    sl_free(context, targets->items);
    *targets = (sl_box_targets){0};
}
