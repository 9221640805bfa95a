/// Bottom-up merging (Mattausch et al. 2006, section 4.3): of all neighbours those two become one
/// of which that costs least. The order is kept: the merge history.
#include "view_cells/heap.h"
#include "view_cells/neighbours.h"
#include "view_cells/render.h"
#include "view_cells/tree.h"

#include <string.h>

typedef SL_ARRAY(uint32_t) numbers;

typedef struct merger {
    sl_context *context;
    const sl_view_tree *tree;
    sl_view_render render;
    uint32_t cell_count, joint_count;
    sl_view_joint *joints;
    sl_view_sets sets;   ///< a row for each elementary cell; joints take over that of their first
    uint32_t *row;       ///< by number
    uint32_t *up;        ///< by number: the joint that it is part of, or itself
    uint32_t *stamp;     ///< by number: of the last list that it was put into
    double *mass, *cost; ///< by number
    sl_point *middle;    ///< by number
    numbers *around;     ///< by number: its neighbours, as they were once
    sl_bits *both;       ///< scratch: a row
    sl_heap queue;
} merger;

/// What holds a part now.
static uint32_t find(merger *m, uint32_t number) {
    uint32_t top = number;
    while (m->up[top] != top) top = m->up[top];
    while (m->up[number] != top) {
        const uint32_t next = m->up[number];
        m->up[number] = top;
        number = next;
    }
    return top;
}

static sl_point middle_of_two(const merger *m, uint32_t a, uint32_t b) {
    const double share = m->mass[b] / (m->mass[a] + m->mass[b]);
    const sl_point p = m->middle[a], q = m->middle[b];
    return (sl_point){p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
}

/// Puts both sets into the scratch row and gives what rendering that costs.
static double cost_of_both(merger *m, uint32_t a, uint32_t b) {
    const sl_bits *one = sl_view_set(&m->sets, m->row[a]);
    const sl_bits *other = sl_view_set(&m->sets, m->row[b]);
    for (size_t i = 0; i < m->sets.words; i++) m->both[i] = one[i] | other[i];
    return sl_view_render_set(&m->render, m->both, m->sets.words, middle_of_two(m, a, b));
}

/// The increase of cost (equation 2).
static sl_status weigh(merger *m, uint32_t a, uint32_t b) {
    const double increase = (m->mass[a] + m->mass[b]) * cost_of_both(m, a, b) -
                            m->mass[a] * m->cost[a] - m->mass[b] * m->cost[b];
    const sl_heap_item item = {-increase, a < b ? a : b, a < b ? b : a};
    return sl_heap_push(m->context, &m->queue, item);
}

static sl_status add_around(merger *m, uint32_t number, uint32_t neighbour) {
    numbers *list = &m->around[number];
    SL_TRY(SL_ARRAY_ROOM(m->context, list, 1));
    list->items[list->count++] = neighbour;
    return SL_OK;
}

/// The list of the two becomes the joint's: its neighbours as they are now, each once.
static sl_status join_around(merger *m, uint32_t a, uint32_t b, uint32_t joint) {
    if (m->around[a].count < m->around[b].count) {
        const uint32_t swap = a;
        a = b;
        b = swap;
    }
    numbers *list = &m->around[joint], *other = &m->around[b];
    *list = m->around[a];
    m->around[a] = (numbers){0};
    SL_TRY(SL_ARRAY_ROOM(m->context, list, other->count));
    // Without neighbours there is nothing to copy from.
    if (other->count)
        memcpy(list->items + list->count, other->items, other->count * sizeof *other->items);
    list->count += other->count;
    sl_free(m->context, other->items);
    *other = (numbers){0};
    size_t kept = 0;
    m->stamp[joint] = joint;
    for (size_t i = 0; i < list->count; i++) {
        const uint32_t top = find(m, list->items[i]);
        if (m->stamp[top] == joint) continue;
        m->stamp[top] = joint;
        list->items[kept++] = top;
    }
    list->count = kept;
    return SL_OK;
}

static sl_status merge_two(merger *m, uint32_t a, uint32_t b) {
    const uint32_t joint = m->cell_count + m->joint_count;
    m->joints[m->joint_count++] = (sl_view_joint){{a, b}};
    m->cost[joint] = cost_of_both(m, a, b);
    m->mass[joint] = m->mass[a] + m->mass[b];
    m->middle[joint] = middle_of_two(m, a, b);
    m->row[joint] = m->row[a];
    memcpy(sl_view_set(&m->sets, m->row[a]), m->both, m->sets.words * sizeof *m->both);
    m->up[a] = m->up[b] = m->up[joint] = joint;
    SL_TRY(join_around(m, a, b, joint));
    for (size_t i = 0; i < m->around[joint].count; i++)
        SL_TRY(weigh(m, joint, m->around[joint].items[i]));
    return SL_OK;
}

/// The two lowest numbers that are whole; from *at on there are some.
static void find_apart(merger *m, uint32_t *at, uint32_t *a, uint32_t *b) {
    while (m->up[*at] != *at) ++*at;
    *a = *at;
    uint32_t next = *at + 1;
    while (m->up[next] != next) next++;
    *b = next;
}

static sl_status merge_all(merger *m) {
    uint32_t apart = 0;
    while (m->joint_count + 1 < m->cell_count) {
        if (m->joint_count % 256 == 0) {
            SL_TRY(sl_check_cancelled(m->context));
            sl_report(m->context, "merge", "view cells", m->joint_count, m->cell_count - 1);
        }
        uint32_t a, b;
        if (m->queue.count) {
            const sl_heap_item item = sl_heap_pop(&m->queue);
            a = item.a;
            b = item.b;
            if (m->up[a] != a || m->up[b] != b) continue;
        } else {
            find_apart(m, &apart, &a, &b);
        }
        SL_TRY(merge_two(m, a, b));
    }
    return SL_OK;
}

static sl_status begin(merger *m, const sl_view_scene *scene, const sl_view_sets *sets) {
    const size_t count = m->cell_count, all = 2 * count;
    SL_TRY(sl_view_render_make(m->context, scene, &m->render));
    SL_TRY(sl_view_sets_create(m->context, sets->count, sets->object_count, &m->sets));
    memcpy(m->sets.bits, sets->bits, count * sets->words * sizeof *sets->bits);
    m->joints = sl_alloc_array(m->context, count, sizeof *m->joints);
    m->row = sl_alloc_array(m->context, all, sizeof *m->row);
    m->up = sl_alloc_array(m->context, all, sizeof *m->up);
    m->stamp = sl_alloc_array(m->context, all, sizeof *m->stamp);
    m->mass = sl_alloc_array(m->context, all, sizeof *m->mass);
    m->cost = sl_alloc_array(m->context, all, sizeof *m->cost);
    m->middle = sl_alloc_array(m->context, all, sizeof *m->middle);
    m->around = sl_alloc_array(m->context, all, sizeof *m->around);
    m->both = sl_alloc_array(m->context, sets->words, sizeof *m->both);
    if (!m->joints || !m->row || !m->up || !m->stamp || !m->mass || !m->cost || !m->middle ||
        !m->around || !m->both)
        return SL_NO_MEMORY;
    for (uint32_t i = 0; i < m->cell_count; i++) {
        m->row[i] = m->up[i] = i;
        m->mass[i] = m->tree->mass[i];
        m->middle[i] = sl_view_leaf_middle(m->tree, i);
        m->cost[i] =
            sl_view_render_set(&m->render, sl_view_set(sets, i), sets->words, m->middle[i]);
    }
    for (size_t i = count; i < all; i++) m->up[i] = UINT32_MAX;
    return SL_OK;
}

static sl_status start_queue(merger *m) {
    sl_view_pairs pairs = {0};
    sl_status status = sl_view_neighbours(m->context, m->tree, &pairs);
    for (size_t i = 0; i < pairs.count && status == SL_OK; i++) {
        const sl_view_pair p = pairs.items[i];
        if (p.a >= m->cell_count || p.b >= m->cell_count) continue;
        status = add_around(m, p.a, p.b);
        if (status == SL_OK) status = add_around(m, p.b, p.a);
        if (status == SL_OK) status = weigh(m, p.a, p.b);
    }
    sl_free(m->context, pairs.items);
    return status;
}

static void destroy(merger *m) {
    for (size_t i = 0; m->around && i < 2 * (size_t)m->cell_count; i++)
        sl_free(m->context, m->around[i].items);
    sl_free(m->context, m->joints);
    sl_free(m->context, m->row);
    sl_free(m->context, m->up);
    sl_free(m->context, m->stamp);
    sl_free(m->context, m->mass);
    sl_free(m->context, m->cost);
    sl_free(m->context, m->middle);
    sl_free(m->context, m->around);
    sl_free(m->context, m->both);
    sl_free(m->context, m->queue.items);
    sl_view_sets_destroy(m->context, &m->sets);
    sl_view_render_destroy(m->context, &m->render);
}

sl_status sl_view_merge(sl_context *context, const sl_view_scene *scene, const sl_view_tree *tree,
                        const sl_view_sets *sets, sl_view_hierarchy *out) {
    merger m = {.context = context, .tree = tree, .cell_count = tree->cell_count};
    sl_status status = begin(&m, scene, sets);
    if (status == SL_OK) status = start_queue(&m);
    if (status == SL_OK) status = merge_all(&m);
    if (status == SL_OK) {
        const sl_view_hierarchy history = {.cell_count = m.cell_count, .joints = m.joints};
        status = sl_view_evaluate(context, scene, tree, &history, sets, out);
    }
    destroy(&m);
    return status;
}
