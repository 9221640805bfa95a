#include "walk/hierarchy.h"

#include <math.h>
#include <stdlib.h>

/// A wall, or a side of a cell: axis 0 for x = at, 1 for y = at, from lo to hi along it; 2 for a
/// wall that is not axial.
typedef struct run {
    int axis;
    double at, lo, hi;
    uint32_t wall;
} run;

static run run_of(sl_point a, sl_point b, uint32_t wall) {
    const bool upright = a.x == b.x;
    const double from = upright ? a.y : a.x, to = upright ? b.y : b.x;
    return (run){.axis = upright      ? 0
                         : a.y == b.y ? 1
                                      : 2,
                 .at = upright ? a.x : a.y,
                 .lo = fmin(from, to),
                 .hi = fmax(from, to),
                 .wall = wall};
}

/// By line, and along it.
static int by_place(const void *left, const void *right) {
    const run *p = left, *q = right;
    if (p->axis != q->axis) return p->axis - q->axis;
    if (p->at != q->at) return p->at < q->at ? -1 : 1;
    if (p->lo != q->lo) return p->lo < q->lo ? -1 : 1;
    return (p->wall > q->wall) - (p->wall < q->wall);
}

/// The walls of a space, sorted; those of no length are left out.
static run *sort_walls(sl_context *context, const sl_space *space, uint32_t *count) {
    run *runs = sl_alloc_array(context, space->wall_count, sizeof *runs);
    *count = 0;
    if (!runs) return NULL;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        const run r = run_of(w->a, w->b, i);
        if (r.lo < r.hi) runs[(*count)++] = r;
    }
    qsort(runs, *count, sizeof *runs, by_place);
    return runs;
}

typedef struct wall_list {
    SL_ARRAY(uint32_t) items;
    uint32_t first; ///< of the cell at hand
} wall_list;

static sl_status add_wall(sl_context *context, wall_list *list, uint32_t wall) {
    for (size_t i = list->first; i < list->items.count; i++)
        if (list->items.items[i] == wall) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(context, &list->items, 1));
    list->items.items[list->items.count++] = wall;
    return SL_OK;
}

/// The walls on a side of a kd-tree's cell. Clean walls do not overlap: those of a line are sorted
/// by their upper ends as well.
static sl_status add_side(sl_context *context, const run *walls, uint32_t count, const run *side,
                          wall_list *list) {
    uint32_t below = 0, end = count;
    while (below < end) {
        const uint32_t middle = below + (end - below) / 2;
        const run *w = &walls[middle];
        const bool before = w->axis != side->axis ? w->axis < side->axis
                            : w->at != side->at   ? w->at < side->at
                                                  : w->hi <= side->lo;
        if (before)
            below = middle + 1;
        else
            end = middle;
    }
    for (; below < count; below++) {
        const run *w = &walls[below];
        if (w->axis != side->axis || w->at != side->at || w->lo >= side->hi) break;
        SL_TRY(add_wall(context, list, w->wall));
    }
    return SL_OK;
}

static sl_status add_cell(sl_context *context, const sl_space *space, const run *walls,
                          uint32_t count, uint32_t cell, wall_list *list) {
    const sl_cell *c = &space->cells[cell];
    for (uint32_t i = 0; i < c->vertex_count; i++) {
        const uint32_t at = c->first_vertex + i;
        const uint32_t next = c->first_vertex + (i + 1) % c->vertex_count;
        if (space->neighbour) {
            if (space->neighbour[at] < SL_NEIGHBOUR_BORDER)
                SL_TRY(add_wall(context, list, space->neighbour[at] & ~SL_NEIGHBOUR_RIGHT));
            continue;
        }
        const run side = run_of(space->vertices[at], space->vertices[next], 0);
        SL_TRY(add_side(context, walls, count, &side, list));
    }
    return SL_OK;
}

sl_status sl_hierarchy_add_walls(sl_context *context, sl_hierarchy *h) {
    const sl_space *space = h->space;
    wall_list list = {.first = 0};
    uint32_t count;
    run *walls = sort_walls(context, space, &count);
    h->first_wall = sl_alloc_array(context, (size_t)space->cell_count + 1, sizeof *h->first_wall);
    sl_status status = walls && h->first_wall ? SL_OK : SL_NO_MEMORY;
    for (uint32_t c = 0; c < space->cell_count && status == SL_OK; c++) {
        list.first = (uint32_t)list.items.count;
        status = add_cell(context, space, walls, count, c, &list);
        if (status == SL_OK) h->first_wall[c + 1] = (uint32_t)list.items.count;
        if (status == SL_OK && c % 4096 == 0) status = sl_check_cancelled(context);
    }
    sl_free(context, walls);
    h->walls = list.items.items;
    return status;
}

/// The walls, where axial ones that overlap or touch in line are one.
static void join_walls(const sl_space *space, const run *walls, uint32_t count, sl_segment *joined,
                       uint32_t *joined_count) {
    *joined_count = 0;
    for (uint32_t i = 0; i < count;) {
        run r = walls[i++];
        const sl_wall *w = &space->walls[r.wall];
        sl_segment *out = &joined[(*joined_count)++];
        *out = (sl_segment){w->a, w->b};
        if (r.axis == 2) continue;
        for (; i < count && walls[i].axis == r.axis && walls[i].at == r.at && walls[i].lo <= r.hi;
             i++)
            r.hi = fmax(r.hi, walls[i].hi);
        *out = r.axis ? (sl_segment){{r.lo, r.at}, {r.hi, r.at}}
                      : (sl_segment){{r.at, r.lo}, {r.at, r.hi}};
    }
}

/// Whether a wall lies within a box, and not along one of its sides.
static bool is_within(const sl_segment *s, const sl_box *b) {
    const double left = fmin(s->a.x, s->b.x), right = fmax(s->a.x, s->b.x);
    const double low = fmin(s->a.y, s->b.y), high = fmax(s->a.y, s->b.y);
    return left >= b->min.x && right <= b->max.x && low >= b->min.y && high <= b->max.y &&
           left < b->max.x && right > b->min.x && low < b->max.y && high > b->min.y;
}

/// The least node that a wall lies within; never a leaf, as no wall is inside a cell.
static uint32_t node_of(const sl_hierarchy *h, const sl_segment *wall) {
    uint32_t at = 0;
    for (int side = 0; side < 2;) {
        const int32_t child = h->nodes[at].child[side++];
        if (child < 0 || h->nodes[child].cell != SL_NO_CELL ||
            !is_within(wall, &h->nodes[child].box))
            continue;
        at = (uint32_t)child;
        side = 0;
    }
    return at;
}

/// Sorts walls by node.
static void deal(sl_hierarchy *h, const sl_segment *joined, uint32_t *nodes) {
    for (uint32_t i = 0; i < h->occluder_count; i++)
        h->first_occluder[(nodes[i] = node_of(h, &joined[i])) + 1]++;
    for (uint32_t n = 0; n < h->node_count; n++) h->first_occluder[n + 1] += h->first_occluder[n];
    for (uint32_t i = h->occluder_count; i-- > 0;) {
        // Filled from behind, each node's end comes to be its beginning.
        h->occluders[--h->first_occluder[nodes[i] + 1]] = joined[i];
    }
    for (uint32_t n = 0; n < h->node_count; n++) h->first_occluder[n] = h->first_occluder[n + 1];
    h->first_occluder[h->node_count] = h->occluder_count;
}

sl_status sl_hierarchy_add_occluders(sl_context *context, sl_hierarchy *h) {
    uint32_t count;
    run *walls = sort_walls(context, h->space, &count);
    sl_segment *joined = sl_alloc_array(context, count, sizeof *joined);
    uint32_t *nodes = sl_alloc_array(context, count, sizeof *nodes);
    h->occluders = sl_alloc_array(context, count, sizeof *h->occluders);
    h->first_occluder =
        sl_alloc_array(context, (size_t)h->node_count + 1, sizeof *h->first_occluder);
    sl_status status = SL_NO_MEMORY;
    if (walls && joined && nodes && h->occluders && h->first_occluder) {
        join_walls(h->space, walls, count, joined, &h->occluder_count);
        deal(h, joined, nodes);
        status = SL_OK;
    }
    sl_free(context, walls);
    sl_free(context, joined);
    sl_free(context, nodes);
    return status;
}
