/// The hierarchy: the space's tree as a tree of its own, each node with its box, its leaves and its
/// ropes.
#include "walk/hierarchy.h"

#include "base/bits.h"

#include <math.h>
#include <string.h>

/// A node that waits to be made: a child of the space's tree, and whose child it becomes.
typedef struct waiting {
    int32_t what, parent;
    uint8_t side;
} waiting;

typedef struct making {
    sl_context *context;
    const sl_space *space;
    SL_ARRAY(sl_walk_node) nodes;
    SL_ARRAY(waiting) stack;
    sl_bits *taken; ///< nodes and cells of the space: a BSP may lead to one in several ways
} making;

static sl_status push(making *m, int32_t what, int32_t parent, uint8_t side) {
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->stack, 1));
    m->stack.items[m->stack.count++] = (waiting){what, parent, side};
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

static sl_status add_node(making *m, const waiting *w) {
    const sl_space *space = m->space;
    const int32_t id = (int32_t)m->nodes.count;
    const bool is_cell = w->what < 0;
    const size_t taken = is_cell ? space->node_count + (size_t)~w->what : (size_t)w->what;
    if (sl_bits_has(m->taken, taken)) return SL_OK;
    sl_bits_add(m->taken, taken);
    SL_TRY(SL_ARRAY_ROOM(m->context, &m->nodes, 1));
    sl_walk_node node = {.parent = w->parent, .child = {-1, -1}, .cell = SL_NO_CELL};
    if (is_cell) {
        node.cell = (uint32_t)~w->what;
        node.box = cell_box(space, node.cell);
    } else {
        node.split = (uint32_t)w->what;
        SL_TRY(push(m, space->nodes[w->what].above, id, 1));
        SL_TRY(push(m, space->nodes[w->what].below, id, 0));
    }
    if (w->parent >= 0) m->nodes.items[w->parent].child[w->side] = id;
    m->nodes.items[m->nodes.count++] = node;
    return SL_OK;
}

/// Takes out what has no leaf below it, and puts an only child in its parent's place: goes up,
/// children before their parents, and notes in `parent` of what is taken out what stands for it.
static void collapse(making *m) {
    for (size_t i = m->nodes.count; i-- > 0;) {
        sl_walk_node *n = &m->nodes.items[i];
        if (n->cell != SL_NO_CELL) continue;
        for (int side = 0; side < 2; side++) {
            const int32_t c = n->child[side];
            if (c < 0) continue;
            const sl_walk_node *child = &m->nodes.items[c];
            const bool is_out = child->cell == SL_NO_CELL && child->child[1] < 0;
            if (is_out) n->child[side] = child->child[0];
        }
        if (n->child[0] < 0) {
            n->child[0] = n->child[1];
            n->child[1] = -1;
        }
    }
}

/// Numbers what is left anew, parents first and the nodes of a subtree together.
static sl_status number(making *m, sl_hierarchy *h) {
    int32_t root = 0;
    const sl_walk_node *old = m->nodes.items;
    while (old[root].cell == SL_NO_CELL && old[root].child[1] < 0) root = old[root].child[0];
    m->stack.count = 0;
    SL_TRY(push(m, root, -1, 0));
    while (m->stack.count) {
        const waiting w = m->stack.items[--m->stack.count];
        const int32_t id = (int32_t)h->node_count++;
        sl_walk_node *node = &h->nodes[id];
        *node = old[w.what];
        node->parent = w.parent;
        node->first_leaf = h->leaf_count;
        if (w.parent >= 0) h->nodes[w.parent].child[w.side] = id;
        if (node->cell != SL_NO_CELL) {
            node->leaf_count = 1;
            h->leaves[h->leaf_count++] = node->cell;
            continue;
        }
        SL_TRY(push(m, old[w.what].child[1], id, 1));
        SL_TRY(push(m, old[w.what].child[0], id, 0));
    }
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
    return SL_OK;
}

static sl_status make_nodes(making *m, sl_hierarchy *h) {
    const sl_space *space = m->space;
    const size_t things = (size_t)space->node_count + space->cell_count;
    m->taken = sl_alloc_array(m->context, sl_bits_words(things), sizeof *m->taken);
    if (!m->taken) return SL_NO_MEMORY;
    SL_TRY(push(m, space->root, -1, 0));
    while (m->stack.count) {
        const waiting w = m->stack.items[--m->stack.count];
        SL_TRY(add_node(m, &w));
    }
    collapse(m);
    h->nodes = sl_alloc_array(m->context, m->nodes.count, sizeof *h->nodes);
    h->leaves = sl_alloc_array(m->context, space->cell_count, sizeof *h->leaves);
    return h->nodes && h->leaves ? number(m, h) : SL_NO_MEMORY;
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
        const sl_node *split = &h->space->nodes[n->split];
        const int axis = split->axis;
        if (axis == face / 2)
            rope = n->child[face % 2 == 0];
        else if (high(box, axis) <= split->position)
            rope = n->child[0];
        else if (low(box, axis) >= split->position)
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
        const int axis = h->space->nodes[n->split].axis;
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
    sl_hierarchy h = {.space = space, .tiles = !space->beyond, .corner_most = 4};
    making m = {.context = context, .space = space};
    for (uint32_t c = 0; c < space->cell_count; c++)
        if (space->cells[c].vertex_count > h.corner_most)
            h.corner_most = space->cells[c].vertex_count;
    sl_status status = make_nodes(&m, &h);
    if (status == SL_OK) status = sl_hierarchy_add_walls(context, &h);
    if (status == SL_OK) status = sl_hierarchy_add_occluders(context, &h);
    if (status == SL_OK) tie_ropes(&h);
    sl_free(context, m.nodes.items);
    sl_free(context, m.stack.items);
    sl_free(context, m.taken);
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
