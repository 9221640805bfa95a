/// The view cell hierarchy with its cache (Nirenstein & Blake 2004, superset simplification; as
/// Laine 2005 compares it): view cells are divided in two again and again. The faces between two
/// halves are looked from once, among what the whole sees; what they see is kept, so that a half
/// sees what lies in it and what its own outer faces, all looked from by then, have been found to
/// see.
#include "from_region/methods.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// View cells order[first .. end); the root is node 0, a parent before its children.
typedef struct node {
    uint32_t first, end, depth;
    uint32_t parent;
} node;

/// A step of work: a node's visible set to be put together, or a face to look from.
typedef struct task {
    uint32_t node; ///< whose set is made, or refined
    uint32_t face; ///< UINT32_MAX: make the set
    uint32_t depth;
} task;

typedef struct placed_cell {
    double x, y;
    uint32_t cell;
} placed_cell;

typedef struct hierarchy {
    placed_cell *cells;
    SL_ARRAY(node) nodes;
    uint32_t *leaf; ///< by view cell: its node
    task *tasks;
    size_t *after;
    sl_bits *cache; ///< by face: what it sees
    sl_bits *sets;  ///< by node
} hierarchy;

// --- dividing

static sl_status place_cells(sl_context *context, const sl_regions *scene, placed_cell *cells) {
    const uint32_t count = scene->counts.view_cells;
    sl_box *boxes = sl_alloc_array(context, count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < count; i++)
        boxes[i] = (sl_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t leaf = 0; leaf < scene->space.cell_count; leaf++) {
        if (scene->view_cell[leaf] == SL_NO_VIEW_CELL) continue;
        sl_box *box = &boxes[scene->view_cell[leaf]];
        const sl_box own = sl_leaf_box(&scene->space, leaf);
        box->min.x = fmin(box->min.x, own.min.x);
        box->min.y = fmin(box->min.y, own.min.y);
        box->max.x = fmax(box->max.x, own.max.x);
        box->max.y = fmax(box->max.y, own.max.y);
    }
    for (uint32_t i = 0; i < count; i++)
        cells[i] = (placed_cell){boxes[i].min.x + (boxes[i].max.x - boxes[i].min.x) / 2,
                                 boxes[i].min.y + (boxes[i].max.y - boxes[i].min.y) / 2, i};
    sl_free(context, boxes);
    return SL_OK;
}

static int compare_x(const void *left, const void *right) {
    const placed_cell *a = left, *b = right;
    if (a->x != b->x) return a->x < b->x ? -1 : 1;
    return (a->cell > b->cell) - (a->cell < b->cell);
}

static int compare_y(const void *left, const void *right) {
    const placed_cell *a = left, *b = right;
    if (a->y != b->y) return a->y < b->y ? -1 : 1;
    return (a->cell > b->cell) - (a->cell < b->cell);
}

/// Sorts a node's view cells across the longer way of their middles and cuts at half of it.
static uint32_t cut(placed_cell *cells, uint32_t first, uint32_t end) {
    sl_box box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = first; i < end; i++) {
        box.min.x = fmin(box.min.x, cells[i].x);
        box.min.y = fmin(box.min.y, cells[i].y);
        box.max.x = fmax(box.max.x, cells[i].x);
        box.max.y = fmax(box.max.y, cells[i].y);
    }
    const bool wide = box.max.x - box.min.x >= box.max.y - box.min.y;
    const double middle =
        wide ? box.min.x + (box.max.x - box.min.x) / 2 : box.min.y + (box.max.y - box.min.y) / 2;
    qsort(cells + first, end - first, sizeof *cells, wide ? compare_x : compare_y);
    uint32_t at = first;
    while (at < end && (wide ? cells[at].x : cells[at].y) < middle) at++;
    return at > first && at < end ? at : first + (end - first) / 2;
}

static sl_status divide(sl_context *context, hierarchy *h, uint32_t count) {
    SL_TRY(SL_ARRAY_ROOM(context, &h->nodes, 1));
    h->nodes.items[h->nodes.count++] = (node){.end = count};
    for (uint32_t i = 0; i < h->nodes.count; i++) {
        const node n = h->nodes.items[i];
        if (n.end - n.first <= 1) {
            if (n.end > n.first) h->leaf[h->cells[n.first].cell] = i;
            continue;
        }
        const uint32_t at = cut(h->cells, n.first, n.end);
        SL_TRY(SL_ARRAY_ROOM(context, &h->nodes, 2));
        h->nodes.items[h->nodes.count++] = (node){n.first, at, n.depth + 1, i};
        h->nodes.items[h->nodes.count++] = (node){at, n.end, n.depth + 1, i};
    }
    return SL_OK;
}

/// The node whose halves a face lies between; the root for those of the compound's boundary.
static uint32_t node_of(const hierarchy *h, const sl_face *face) {
    if (face->to == SL_NO_VIEW_CELL) return 0;
    uint32_t a = h->leaf[face->from], b = h->leaf[face->to];
    while (a != b) {
        // Parents come before their children.
        if (a > b)
            a = h->nodes.items[a].parent;
        else
            b = h->nodes.items[b].parent;
    }
    return a;
}

// --- the steps, from the root down

/// Sets of a depth are made when all faces of less depth are done, and faces of a depth looked from
/// when its sets are.
static size_t rank_of(const task *t) {
    return 2 * (size_t)t->depth + (t->face != UINT32_MAX);
}

static sl_status list_tasks(sl_context *context, const sl_regions *scene, hierarchy *h) {
    const size_t nodes = h->nodes.count, count = nodes + scene->counts.faces;
    uint32_t depth = h->nodes.items[nodes - 1].depth;
    const size_t ranks = 2 * (size_t)depth + 2;
    size_t *starts = sl_alloc_array(context, ranks + 1, sizeof *starts);
    task *found = sl_alloc_array(context, count, sizeof *found);
    if (!starts || !found) {
        sl_free(context, starts);
        sl_free(context, found);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < nodes; i++) found[i] = (task){i, UINT32_MAX, h->nodes.items[i].depth};
    for (uint32_t i = 0; i < scene->counts.faces; i++) {
        const uint32_t at = node_of(h, &scene->faces.items[i]);
        found[nodes + i] = (task){at, i, h->nodes.items[at].depth};
    }
    for (size_t i = 0; i < count; i++) starts[rank_of(&found[i]) + 1]++;
    for (size_t rank = 0; rank < ranks; rank++) {
        starts[rank + 1] += starts[rank];
        for (size_t i = starts[rank]; i < starts[rank + 1]; i++) h->after[i] = starts[rank];
    }
    for (size_t i = 0; i < count; i++) h->tasks[starts[rank_of(&found[i])]++] = found[i];
    sl_free(context, starts);
    sl_free(context, found);
    return SL_OK;
}

/// What lies in a node, and what its outer faces see; all objects for the root.
static void make_set(const sl_from_region_work *work, uint32_t number) {
    const sl_regions *scene = work->scene;
    const hierarchy *h = work->own;
    const node *n = &h->nodes.items[number];
    sl_bits *set = h->sets + number * scene->words;
    if (number == 0) memcpy(set, work->all, scene->words * sizeof *set);
    for (uint32_t i = n->first; i < n->end && number; i++) {
        const uint32_t cell = h->cells[i].cell;
        sl_row_or(set, sl_regions_inside(scene, cell), scene->words);
        for (uint32_t f = scene->first_face[cell]; f < scene->first_face[cell + 1]; f++) {
            const uint32_t to = scene->faces.items[f].to;
            bool outer = to == SL_NO_VIEW_CELL;
            if (!outer) {
                uint32_t above = h->leaf[to];
                while (above > number) above = h->nodes.items[above].parent;
                outer = above != number;
            }
            if (outer) sl_row_or(set, h->cache + f * scene->words, scene->words);
        }
    }
    if (n->end - n->first != 1) return;
    sl_bits *row = work->seen + h->cells[n->first].cell * scene->words;
    // A compound of one view cell has its root for a leaf.
    memcpy(row, number ? set : sl_regions_inside(scene, h->cells[n->first].cell),
           scene->words * sizeof *row);
}

static sl_status task_unit(sl_context *context, sl_from_region_work *work,
                           sl_from_region_thread *thread, size_t unit) {
    const hierarchy *h = work->own;
    const task t = h->tasks[unit];
    const size_t words = work->scene->words;
    const sl_bits *set = h->sets + t.node * words;
    if (t.face == UINT32_MAX) {
        make_set(work, t.node);
        return SL_OK;
    }
    thread->candidates += sl_row_count(set, words);
    sl_bits *seen = h->cache + t.face * words;
    SL_TRY(sl_from_region_look(context, work, thread, t.face, -1, set, seen));
    const node *n = &h->nodes.items[t.node];
    if (n->end - n->first > 1) return SL_OK;
    // The boundary of a compound of one view cell: nobody else puts it together.
    pthread_mutex_lock(&work->lock);
    sl_row_or(work->seen + h->cells[n->first].cell * words, seen, words);
    pthread_mutex_unlock(&work->lock);
    return SL_OK;
}

static sl_status run(sl_context *context, sl_from_region_work *work, hierarchy *h) {
    const sl_regions *scene = work->scene;
    const size_t cells = scene->counts.view_cells, faces = scene->counts.faces;
    if (!cells) return SL_OK;
    h->cells = sl_alloc_array(context, cells, sizeof *h->cells);
    h->leaf = sl_alloc_array(context, cells, sizeof *h->leaf);
    h->tasks = sl_alloc_array(context, 2 * cells + faces, sizeof *h->tasks);
    h->after = sl_alloc_array(context, 2 * cells + faces, sizeof *h->after);
    h->cache = sl_alloc_array(context, faces, scene->words * sizeof *h->cache);
    h->sets = sl_alloc_array(context, 2 * cells, scene->words * sizeof *h->sets);
    if (!h->cells || !h->leaf || !h->tasks || !h->after || !h->cache || !h->sets)
        return SL_NO_MEMORY;
    SL_TRY(place_cells(context, scene, h->cells));
    SL_TRY(divide(context, h, (uint32_t)cells));
    SL_TRY(list_tasks(context, scene, h));
    return sl_from_region_run(context, work, h->nodes.count + faces, h->after);
}

sl_status sl_from_region_hierarchy(sl_context *context, sl_from_region_work *work) {
    hierarchy h = {0};
    work->own = &h;
    work->unit = task_unit;
    const sl_status status = run(context, work, &h);
    sl_free(context, h.cells);
    sl_free(context, h.nodes.items);
    sl_free(context, h.leaf);
    sl_free(context, h.tasks);
    sl_free(context, h.after);
    sl_free(context, h.cache);
    sl_free(context, h.sets);
    return status;
}
