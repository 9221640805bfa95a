#include "eye_to_cell/box_targets.h"

#include "space/index.h"

#include <math.h>
#include <stdlib.h>

/// A piece of a box's side in a cell.
typedef struct target {
    uint32_t cell;
    sl_directed_portal directed;
} target;

typedef struct gatherer {
    sl_context *context;
    const sl_space *space;
    size_t pieces; ///< so far
    size_t *done;  ///< by cell: the last piece, by its count, that was held against it
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

/// Adds what lies of a piece along a side of a cell, on whose left hand the cell is.
static sl_status add_along(gatherer *g, uint32_t number, const sl_piece *piece, uint32_t box,
                           sl_point p, sl_point q) {
    const double from = along(piece, p), to = along(piece, q);
    const double lo = fmax(piece->lo, fmin(from, to)), hi = fmin(piece->hi, fmax(from, to));
    if (across(piece, p) != piece->at || across(piece, q) != piece->at || lo >= hi) return SL_OK;
    return add(g, number, box, on(piece, from < to ? hi : lo), on(piece, from < to ? lo : hi));
}

/// Adds a piece to all cells that it lies on the boundary of.
static sl_status add_to_cells(gatherer *g, const sl_piece *piece, uint32_t box) {
    const sl_space *s = g->space;
    const sl_box around = {on(piece, piece->lo), on(piece, piece->hi)};
    sl_cell_grid_range r = sl_cell_grid_range_of(s, around);
    g->pieces++;
    for (uint32_t at; sl_cell_grid_next(&s->grid, &r, &at);) {
        const sl_point *v = s->vertices + s->cells[at].first_vertex;
        const uint32_t count = s->cells[at].vertex_count;
        if (g->done[at] == g->pieces) continue;
        g->done[at] = g->pieces;
        for (uint32_t i = 0; i < count; i++)
            SL_TRY(add_along(g, at, piece, box, v[i], v[i + 1 == count ? 0 : i + 1]));
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
        out->items[i] = g->targets.items[i].directed;
        out->first[g->targets.items[i].cell + 1]++;
    }
    for (uint32_t c = 0; c < cells; c++) out->first[c + 1] += out->first[c];
    return SL_OK;
}

static sl_status gather(gatherer *g, const sl_box_ground *ground, const sl_moving_box *boxes,
                        size_t count) {
    g->done = sl_alloc_array(g->context, g->space->cell_count, sizeof *g->done);
    if (!g->done) return SL_NO_MEMORY;
    for (size_t i = 0; i < count; i++) {
        sl_piece sides[4];
        const unsigned n = sl_box_sides(boxes[i].box, sides);
        g->free.count = 0;
        for (unsigned k = 0; k < n; k++)
            SL_TRY(sl_piece_add_free(g->context, ground->walls, ground->wall_count, sides[k],
                                     &g->free));
        for (size_t k = 0; k < g->free.count; k++) {
            const sl_piece *piece = &g->free.items[k];
            SL_TRY(g->space->neighbour ? add_to_cells(g, piece, (uint32_t)i)
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
    sl_free(context, g.done);
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
