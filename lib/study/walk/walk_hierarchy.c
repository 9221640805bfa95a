/// The hierarchy that a walk traverses: a tree over the cells, each node with its box, its leaves,
/// its occluders and its ropes.
///
/// Over a kd-tree's space the nodes are those of the kd-tree, and children tile their parent. Over
/// a mesh, boxes about halves of the cells stand in their place; those may overlap, so there are no
/// ropes and no propagation.
///
/// A rope (Havran, Bittner & Zara 1998) leads from a face of a node to the least node beyond that
/// holds all of the face:
///
///     +-----+-----+    A node's ropes are its parent's, but for the face between it and its
///     |  A  |     |    sibling. Each rope is then let down the tree, as far as one child
///     +-----+  C  |    holds all of the face. Here the right ropes of A and B lead to C, and
///     |  B  |     |    the left rope of C leads to the node over A and B.
///     +-----+-----+
///
/// Occluders are the walls, where axial ones that overlap or touch in line are joined. Cost of all:
/// O(n log n).
#include "sightline/support.h"
#include "sightline/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- walls on the boundaries of cells

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

/// Sorts the walls of a space, without those of no length.
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
    uint32_t first; ///< of the current cell
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

/// Lists the walls on each cell\'s boundary.
static sl_status add_walls(sl_context *context, sl_hierarchy *h) {
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

/// Joins axial walls that overlap or touch in line.
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

/// Sorts occluders by node.
static void deal(sl_hierarchy *h, const sl_segment *joined, uint32_t *nodes) {
    for (uint32_t i = 0; i < h->occluder_count; i++)
        h->first_occluder[(nodes[i] = node_of(h, &joined[i])) + 1]++;
    for (uint32_t n = 0; n < h->node_count; n++) h->first_occluder[n + 1] += h->first_occluder[n];
    for (uint32_t i = h->occluder_count; i-- > 0;) {
        // Filled from behind: each node's end becomes its beginning.
        h->occluders[--h->first_occluder[nodes[i] + 1]] = joined[i];
    }
    for (uint32_t n = 0; n < h->node_count; n++) h->first_occluder[n] = h->first_occluder[n + 1];
    h->first_occluder[h->node_count] = h->occluder_count;
}

static sl_status add_occluders(sl_context *context, sl_hierarchy *h) {
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

// --- nodes

/// A node to be made, and whose child it becomes. `what`: a child of the space's kd-tree. In a mesh
/// the node is over cells[first .. first + count) instead.
typedef struct waiting {
    int32_t what, parent;
    uint8_t side;
    uint32_t first, count;
} waiting;

typedef struct making {
    sl_context *context;
    sl_hierarchy *h;
    SL_ARRAY(waiting) stack;
    sl_box *boxes;   ///< by cell
    uint32_t *cells; ///< of a mesh, in the order of the leaves
} making;

static sl_status push_node(making *m, waiting w) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->stack, 1));
    m->stack.items[m->stack.count++] = w;
    return SL_OK;
}

static sl_box cell_box(const sl_space *space, uint32_t cell) {
    const sl_point *corner = space->vertices + space->cells[cell].first_vertex;
    sl_box box = {corner[0], corner[0]};
    for (uint32_t i = 1; i < space->cells[cell].vertex_count; i++) {
        box.min = (sl_point){fmin(box.min.x, corner[i].x), fmin(box.min.y, corner[i].y)};
        box.max = (sl_point){fmax(box.max.x, corner[i].x), fmax(box.max.y, corner[i].y)};
    }
    return box;
}

/// Adds a node; `cell` is SL_NO_CELL unless it is a leaf.
static int32_t add_node(making *m, const waiting *w, uint32_t cell) {
    sl_hierarchy *h = m->h;
    const int32_t id = (int32_t)h->node_count++;
    sl_walk_node *node = &h->nodes[id];
    *node = (sl_walk_node){
        .parent = w->parent, .child = {-1, -1}, .cell = cell, .first_leaf = h->leaf_count};
    if (w->parent >= 0) h->nodes[w->parent].child[w->side] = id;
    if (cell != SL_NO_CELL) {
        node->box = m->boxes[cell];
        node->leaf_count = 1;
        h->leaves[h->leaf_count++] = cell;
    }
    return id;
}

/// Gives each inner node the box about its children, and counts its leaves.
static void sum_up(sl_hierarchy *h) {
    for (uint32_t i = h->node_count; i-- > 1;) {
        sl_walk_node *parent = &h->nodes[h->nodes[i].parent];
        const sl_box *box = &h->nodes[i].box;
        if (!parent->leaf_count) parent->box = *box;
        parent->leaf_count += h->nodes[i].leaf_count;
        parent->box.min.x = fmin(parent->box.min.x, box->min.x);
        parent->box.min.y = fmin(parent->box.min.y, box->min.y);
        parent->box.max.x = fmax(parent->box.max.x, box->max.x);
        parent->box.max.y = fmax(parent->box.max.y, box->max.y);
    }
}

// --- nodes of a kd-tree

static sl_status take_node(making *m, const waiting *w) {
    const sl_space *space = m->h->space;
    if (w->what < 0) {
        add_node(m, w, (uint32_t)~w->what);
        return SL_OK;
    }
    const sl_node *node = &space->nodes[w->what];
    const int32_t id = add_node(m, w, SL_NO_CELL);
    m->h->nodes[id].axis = node->axis;
    m->h->nodes[id].position = node->position;
    SL_TRY(push_node(m, (waiting){.what = node->above, .parent = id, .side = 1}));
    return push_node(m, (waiting){.what = node->below, .parent = id, .side = 0});
}

// --- boxes over the cells of a mesh: halved by number, along the longer side of their middles

static double middle(const sl_box *box, int axis) {
    return axis ? box->min.y / 2 + box->max.y / 2 : box->min.x / 2 + box->max.x / 2;
}

static bool is_before(const making *m, int axis, uint32_t a, uint32_t b) {
    const double at = middle(&m->boxes[a], axis), other = middle(&m->boxes[b], axis);
    return at != other ? at < other : a < b;
}

/// Moves the cell of rank `rank` to its place, lower ones before it and higher ones behind it
/// (quickselect).
static void part_at(const making *m, int axis, uint32_t *cells, size_t count, size_t rank) {
    size_t low = 0, high = count - 1;
    while (low < high) {
        const uint32_t pivot = cells[low + (high - low) / 2];
        size_t i = low, k = high;
        for (;;) {
            while (is_before(m, axis, cells[i], pivot)) i++;
            while (is_before(m, axis, pivot, cells[k])) k--;
            if (i >= k) break;
            const uint32_t swap = cells[i];
            cells[i] = cells[k];
            cells[k] = swap;
        }
        if (k == rank) return; // the pivot is there
        if (k < rank)
            low = k + 1;
        else
            high = k - 1;
    }
}

static int longer_axis(const making *m, const waiting *w) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = w->first; i < w->first + w->count; i++)
        for (int axis = 0; axis < 2; axis++) {
            const double at = middle(&m->boxes[m->cells[i]], axis);
            low[axis] = fmin(low[axis], at);
            high[axis] = fmax(high[axis], at);
        }
    return high[1] - low[1] > high[0] - low[0];
}

static sl_status take_cells(making *m, const waiting *w) {
    uint32_t *cells = m->cells + w->first;
    if (w->count == 1) {
        add_node(m, w, *cells);
        return SL_OK;
    }
    const int32_t id = add_node(m, w, SL_NO_CELL);
    const int axis = longer_axis(m, w);
    const uint32_t half = w->count / 2;
    part_at(m, axis, cells, w->count, half);
    m->h->nodes[id].axis = axis;
    m->h->nodes[id].position = middle(&m->boxes[cells[half]], axis);
    SL_TRY(push_node(
        m, (waiting){.parent = id, .side = 1, .first = w->first + half, .count = w->count - half}));
    return push_node(m, (waiting){.parent = id, .side = 0, .first = w->first, .count = half});
}

static sl_status make_nodes(making *m) {
    sl_hierarchy *h = m->h;
    const uint32_t count = h->space->cell_count;
    h->nodes = sl_alloc_array(m->context, 2 * (size_t)count, sizeof *h->nodes);
    h->leaves = sl_alloc_array(m->context, count, sizeof *h->leaves);
    m->boxes = sl_alloc_array(m->context, count, sizeof *m->boxes);
    m->cells = sl_alloc_array(m->context, count, sizeof *m->cells);
    if (!h->nodes || !h->leaves || !m->boxes || !m->cells) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        m->boxes[i] = cell_box(h->space, i);
        m->cells[i] = i;
    }
    SL_TRY(push_node(m, (waiting){.what = h->space->root, .parent = -1, .count = count}));
    while (m->stack.count) {
        const waiting w = m->stack.items[--m->stack.count];
        SL_TRY(h->tiles ? take_node(m, &w) : take_cells(m, &w));
    }
    sum_up(h);
    return SL_OK;
}

// --- ropes

static double low(const sl_box *box, int axis) {
    return axis ? box->min.y : box->min.x;
}

static double high(const sl_box *box, int axis) {
    return axis ? box->max.y : box->max.x;
}

/// Lets a rope down to the least node that holds all of the face.
static int32_t let_down(const sl_hierarchy *h, const sl_box *box, int face, int32_t rope) {
    while (rope >= 0 && h->nodes[rope].cell == SL_NO_CELL) {
        const sl_walk_node *n = &h->nodes[rope];
        const int axis = n->axis;
        if (axis == face / 2)
            rope = n->child[face % 2 == 0];
        else if (high(box, axis) <= n->position)
            rope = n->child[0];
        else if (low(box, axis) >= n->position)
            rope = n->child[1];
        else
            break;
    }
    return rope;
}

static void tie_ropes(sl_hierarchy *h) {
    for (uint32_t i = 0; i < h->node_count; i++) {
        sl_walk_node *n = &h->nodes[i];
        if (!i || !h->tiles) memset(n->rope, -1, sizeof n->rope);
        if (n->cell != SL_NO_CELL || !h->tiles) continue;
        const int axis = n->axis;
        for (int side = 0; side < 2; side++) {
            sl_walk_node *child = &h->nodes[n->child[side]];
            memcpy(child->rope, n->rope, sizeof n->rope);
            child->rope[2 * axis + !side] = n->child[!side];
            for (int face = 0; face < 4; face++)
                child->rope[face] = let_down(h, &child->box, face, child->rope[face]);
        }
    }
}

sl_status sl_hierarchy_make(sl_context *context, const sl_space *space, sl_hierarchy *out) {
    sl_hierarchy h = {.space = space, .tiles = !space->neighbour, .corner_most = 4};
    making m = {.context = context, .h = &h};
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].vertex_count > h.corner_most)
            h.corner_most = space->cells[c].vertex_count;
    sl_status status = make_nodes(&m);
    if (status == SL_OK) status = add_walls(context, &h);
    if (status == SL_OK) status = add_occluders(context, &h);
    if (status == SL_OK) tie_ropes(&h);
    sl_free(context, m.stack.items);
    sl_free(context, m.boxes);
    sl_free(context, m.cells);
    if (status == SL_OK)
        *out = h;
    else
        sl_hierarchy_destroy(context, &h);
    return status;
}

void sl_hierarchy_destroy(sl_context *context, sl_hierarchy *hierarchy) {
    sl_free(context, hierarchy->nodes);
    sl_free(context, hierarchy->leaves);
    sl_free(context, hierarchy->first_wall);
    sl_free(context, hierarchy->walls);
    sl_free(context, hierarchy->first_occluder);
    sl_free(context, hierarchy->occluders);
    *hierarchy = (sl_hierarchy){0};
}
