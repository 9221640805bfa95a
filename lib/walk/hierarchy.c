/// The hierarchy: a tree over the cells, each node with its box, its leaves and its ropes.
#include "walk/hierarchy.h"

#include <math.h>
#include <string.h>

/// A node that waits to be made, and whose child it becomes: a child of the space's tree, or, of a
/// mesh, cells[first .. first + count).
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

static sl_status push(making *m, waiting w) {
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

/// Adds a node; of a leaf, its cell.
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

/// Gives each node that is no leaf the box about its children, and counts its leaves.
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

// --- the tree of a kd-tree's space

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
    SL_TRY(push(m, (waiting){.what = node->above, .parent = id, .side = 1}));
    return push(m, (waiting){.what = node->below, .parent = id, .side = 0});
}

// --- boxes over the cells of a mesh: halves by number, along the longer side of where they lie

static double middle(const sl_box *box, int axis) {
    return axis ? box->min.y / 2 + box->max.y / 2 : box->min.x / 2 + box->max.x / 2;
}

static bool is_before(const making *m, int axis, uint32_t a, uint32_t b) {
    const double at = middle(&m->boxes[a], axis), other = middle(&m->boxes[b], axis);
    return at != other ? at < other : a < b;
}

/// Sorts cells so far that the one of rank `rank` is in its place, and none before it comes behind.
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
        if (k == rank) return; // where the pivot has come to
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
    SL_TRY(push(
        m, (waiting){.parent = id, .side = 1, .first = w->first + half, .count = w->count - half}));
    return push(m, (waiting){.parent = id, .side = 0, .first = w->first, .count = half});
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
    SL_TRY(push(m, (waiting){.what = h->space->root, .parent = -1, .count = count}));
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
    if (status == SL_OK) status = sl_hierarchy_add_walls(context, &h);
    if (status == SL_OK) status = sl_hierarchy_add_occluders(context, &h);
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
