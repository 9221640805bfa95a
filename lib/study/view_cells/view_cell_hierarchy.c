/// Hierarchies of view cells: the merge history, what its parts cost, and its cuts (Mattausch et
/// al. 2006, sections 4.3 and 5.1).
///
/// Merging goes bottom up. Of all neighbours, always those two become one for which that costs
/// least (equation 2). The order is kept:
///
///         6         Elementary cells 0 to 3, joints 4 to 6. A cut into n view cells undoes the
///       .-+-.       last n - 1 joints: for n = 3, joints 6 and 5 are undone, and 4, 2 and 3 are
///       4   5       the view cells.
///      .+. .+.
///      0 1 2 3      Costs are summed from the top down: rounding errors stay small where cells
///                   are few.
///
/// A heap holds the pairs of neighbours by the increase in cost. A pair is stale where one of the
/// two has been merged; it is then dropped. The joint takes over the longer of the two lists of
/// neighbours. Cost: O(p log p) heap steps for p pairs, each new pair with one union of two sets.
#include "base/bits.h"
#include "study/view_cells/divide.h"
#include "study/view_cells/view_cell_tree.h"

#include <string.h>

// --- merging

typedef SL_ARRAY(uint32_t) number_list;

typedef struct merger {
    sl_context *context;
    const sl_view_tree *tree;
    sli_view_render render;
    uint32_t cell_count, joint_count;
    sl_view_joint *joints;
    sl_view_sets sets;   ///< a row for each elementary cell; a joint takes over its first part's
    uint32_t *row;       ///< by number
    uint32_t *up;        ///< by number: a joint above it, or itself (union-find)
    uint32_t *stamp;     ///< by number: the last list that it was put into
    double *mass, *cost; ///< by number
    sl_point *middle;    ///< by number
    number_list *around; ///< by number: its neighbours, some since merged
    sl_bits *both;       ///< scratch: a row
    sli_view_queue queue;
} merger;

/// The part that holds a number now (find with path compression).
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

/// The middle of two parts together, by mass. All arrays are by number.
static sl_point middle_of_two(const double *mass, const sl_point *middle, uint32_t a, uint32_t b) {
    const double share = mass[b] / (mass[a] + mass[b]);
    const sl_point p = middle[a], q = middle[b];
    return (sl_point){p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
}

/// Unites two sets in the scratch row; the cost of rendering it.
static double cost_of_both(merger *m, uint32_t a, uint32_t b) {
    const sl_bits *one = sli_view_set(&m->sets, m->row[a]);
    const sl_bits *other = sli_view_set(&m->sets, m->row[b]);
    for (size_t i = 0; i < m->sets.words; i++) m->both[i] = one[i] | other[i];
    return sli_view_render_set(&m->render, m->both, m->sets.words,
                               middle_of_two(m->mass, m->middle, a, b));
}

/// Queues a pair by the increase in cost of merging it (equation 2).
static sl_status weigh(merger *m, uint32_t a, uint32_t b) {
    const double increase = (m->mass[a] + m->mass[b]) * cost_of_both(m, a, b) -
                            m->mass[a] * m->cost[a] - m->mass[b] * m->cost[b];
    const sli_view_entry item = {-increase, a < b ? a : b, a < b ? b : a};
    return sli_view_queue_push(m->context, &m->queue, item);
}

static sl_status add_around(merger *m, uint32_t number, uint32_t neighbour) {
    number_list *list = &m->around[number];
    SL_TRY(SL_ARRAY_ROOM(m->context, list, 1));
    list->items[list->count++] = neighbour;
    return SL_OK;
}

/// Joins the lists of neighbours of two parts: the joint's neighbours as they are now, each once.
static sl_status join_around(merger *m, uint32_t a, uint32_t b, uint32_t joint) {
    if (m->around[a].count < m->around[b].count) {
        const uint32_t swap = a;
        a = b;
        b = swap;
    }
    number_list *list = &m->around[joint], *other = &m->around[b];
    *list = m->around[a];
    m->around[a] = (number_list){0};
    SL_TRY(SL_ARRAY_ROOM(m->context, list, other->count));
    // Without neighbours there is nothing to copy from.
    if (other->count)
        memcpy(list->items + list->count, other->items, other->count * sizeof *other->items);
    list->count += other->count;
    sl_free(m->context, other->items);
    *other = (number_list){0};
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
    m->middle[joint] = middle_of_two(m->mass, m->middle, a, b);
    m->row[joint] = m->row[a];
    memcpy(sli_view_set(&m->sets, m->row[a]), m->both, m->sets.words * sizeof *m->both);
    m->up[a] = m->up[b] = m->up[joint] = joint;
    SL_TRY(join_around(m, a, b, joint));
    for (size_t i = 0; i < m->around[joint].count; i++)
        SL_TRY(weigh(m, joint, m->around[joint].items[i]));
    return SL_OK;
}

/// Finds the two lowest numbers that are not merged, from *at on.
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
            const sli_view_entry item = sli_view_queue_pop(&m->queue);
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

static sl_status begin_merging(merger *m, const sl_view_scene *scene, const sl_view_sets *sets) {
    const size_t count = m->cell_count, all = 2 * count;
    SL_TRY(sli_view_render_make(m->context, scene, &m->render));
    SL_TRY(sli_view_sets_create(m->context, sets->count, sets->object_count, &m->sets));
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
        if (i % 256 == 0) SL_TRY(sl_check_cancelled(m->context));
        m->row[i] = m->up[i] = i;
        m->mass[i] = m->tree->mass[i];
        m->middle[i] = sli_view_leaf_middle(m->tree, i);
        m->cost[i] =
            sli_view_render_set(&m->render, sli_view_set(sets, i), sets->words, m->middle[i]);
    }
    for (size_t i = count; i < all; i++) m->up[i] = UINT32_MAX;
    return SL_OK;
}

static sl_status start_queue(merger *m) {
    sli_view_pairs pairs = {0};
    sl_status status = sli_view_neighbours(m->context, m->tree, &pairs);
    for (size_t i = 0; i < pairs.count && status == SL_OK; i++) {
        const sli_view_pair p = pairs.items[i];
        if (p.a >= m->cell_count || p.b >= m->cell_count) continue;
        if (i % 256 == 0) status = sl_check_cancelled(m->context);
        if (status == SL_OK) status = add_around(m, p.a, p.b);
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
    sli_view_render_destroy(m->context, &m->render);
}

static sl_status merge(sl_context *context, const sl_view_scene *scene, const sl_view_tree *tree,
                       const sl_view_sets *sets, sl_view_hierarchy *out) {
    merger m = {.context = context, .tree = tree, .cell_count = tree->cell_count};
    sl_status status = begin_merging(&m, scene, sets);
    if (status == SL_OK) status = start_queue(&m);
    if (status == SL_OK) status = merge_all(&m);
    if (status == SL_OK) {
        const sl_view_hierarchy history = {.cell_count = m.cell_count, .joints = m.joints};
        status = sl_view_evaluate(context, scene, tree, &history, sets, out);
    }
    destroy(&m);
    return status;
}

// --- measuring

void sl_view_hierarchy_destroy(sl_context *context, sl_view_hierarchy *hierarchy) {
    sl_free(context, hierarchy->joints);
    sl_free(context, hierarchy->cost);
    sl_free(context, hierarchy->mass);
    sl_free(context, hierarchy->objects);
    sl_free(context, hierarchy->bytes);
    *hierarchy = (sl_view_hierarchy){0};
}

// --- of splits

static sl_status join_splits(sl_context *context, const sl_view_scene *scene,
                             const sl_view_tree *tree, const sl_view_sets *sets,
                             sl_view_hierarchy *out) {
    // By node: its number, SL_NO_VIEW_CELL for empty space.
    uint32_t *number = sl_alloc_array(context, tree->node_count, sizeof *number);
    sl_view_hierarchy made = {.cell_count = tree->cell_count};
    made.joints = sl_alloc_array(context, tree->cell_count, sizeof *made.joints);
    sl_status status = number && made.joints ? SL_OK : SL_NO_MEMORY;
    uint32_t next = tree->cell_count;
    for (uint32_t i = tree->node_count; i-- > 0 && status == SL_OK;) {
        const int32_t children[2] = {tree->nodes[i].below, tree->nodes[i].above};
        uint32_t parts[2];
        for (int k = 0; k < 2; k++) {
            parts[k] = children[k] >= 0 ? number[children[k]] : (uint32_t)~children[k];
            if (children[k] < 0 && parts[k] >= tree->cell_count) parts[k] = SL_NO_VIEW_CELL;
        }
        number[i] = parts[0] == SL_NO_VIEW_CELL ? parts[1] : parts[0];
        if (parts[0] == SL_NO_VIEW_CELL || parts[1] == SL_NO_VIEW_CELL) continue;
        made.joints[next - tree->cell_count] = (sl_view_joint){{parts[0], parts[1]}};
        number[i] = next++;
    }
    if (status == SL_OK) status = sl_view_evaluate(context, scene, tree, &made, sets, out);
    sl_free(context, number);
    sl_view_hierarchy_destroy(context, &made);
    return status;
}

sl_status sl_view_hierarchy_make(sl_context *context, const sl_view_scene *scene,
                                 const sl_view_tree *tree, const sl_view_sets *sets, bool merges,
                                 sl_view_hierarchy *out) {
    return (merges ? merge : join_splits)(context, scene, tree, sets, out);
}

// --- what parts cost

static uint64_t number_bytes(uint32_t value) {
    uint64_t bytes = 1;
    while (value >>= 7) bytes++;
    return bytes;
}

/// The bytes of a set as a row of a PVS: runs of objects out and in, in LEB128 (pvs.h).
static uint64_t row_bytes(const sl_bits *set, uint32_t count) {
    uint64_t bytes = 0;
    for (uint32_t at = 0; at < count;) {
        const uint32_t in = (uint32_t)sli_bits_next(set, count, at, true);
        if (in == count) break;
        const uint32_t out = (uint32_t)sli_bits_next(set, count, in, false);
        bytes += number_bytes(in - at) + number_bytes(out - in);
        at = out;
    }
    return bytes;
}

static void measure(const sli_view_render *render, const sl_view_sets *sets, const sl_bits *set,
                    sl_point middle, uint32_t number, sl_view_hierarchy *h) {
    h->cost[number] = sli_view_render_set(render, set, sets->words, middle);
    h->objects[number] = (uint32_t)sli_bits_count(set, sets->words);
    h->bytes[number] = row_bytes(set, sets->object_count);
}

static sl_status make_arrays(sl_context *context, const sl_view_hierarchy *joints,
                             sl_view_hierarchy *out) {
    const size_t count = joints->cell_count, all = 2 * count;
    out->cell_count = joints->cell_count;
    out->joints = sl_alloc_array(context, count, sizeof *out->joints);
    out->cost = sl_alloc_array(context, all, sizeof *out->cost);
    out->mass = sl_alloc_array(context, all, sizeof *out->mass);
    out->objects = sl_alloc_array(context, all, sizeof *out->objects);
    out->bytes = sl_alloc_array(context, all, sizeof *out->bytes);
    if (!out->joints || !out->cost || !out->mass || !out->objects || !out->bytes)
        return SL_NO_MEMORY;
    memcpy(out->joints, joints->joints, (count - 1) * sizeof *out->joints);
    return SL_OK;
}

/// Measures from the elementary cells up. A joint takes over the row of its first part.
static sl_status measure_all(sl_context *context, const sli_view_render *render,
                             const sl_view_tree *tree, const sl_view_sets *sets, sl_view_sets *rows,
                             sl_view_hierarchy *h) {
    const uint32_t count = h->cell_count;
    uint32_t *row = sl_alloc_array(context, 2 * (size_t)count, sizeof *row);
    sl_point *middle = sl_alloc_array(context, 2 * (size_t)count, sizeof *middle);
    if (!row || !middle) {
        sl_free(context, row);
        sl_free(context, middle);
        return SL_NO_MEMORY;
    }
    memcpy(rows->bits, sets->bits, count * sets->words * sizeof *sets->bits);
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        if (i % 256 == 0) status = sl_check_cancelled(context);
        row[i] = i;
        h->mass[i] = tree->mass[i];
        middle[i] = sli_view_leaf_middle(tree, i);
        measure(render, rows, sli_view_set(rows, i), middle[i], i, h);
    }
    for (uint32_t i = 0; i + 1 < count && status == SL_OK; i++) {
        if (i % 256 == 0) status = sl_check_cancelled(context);
        const uint32_t a = h->joints[i].parts[0], b = h->joints[i].parts[1], c = count + i;
        sl_bits *into = sli_view_set(rows, row[a]);
        const sl_bits *from = sli_view_set(rows, row[b]);
        for (size_t k = 0; k < rows->words; k++) into[k] |= from[k];
        row[c] = row[a];
        h->mass[c] = h->mass[a] + h->mass[b];
        middle[c] = middle_of_two(h->mass, middle, a, b);
        measure(render, rows, into, middle[c], c, h);
    }
    sl_free(context, row);
    sl_free(context, middle);
    return status;
}

sl_status sl_view_evaluate(sl_context *context, const sl_view_scene *scene,
                           const sl_view_tree *tree, const sl_view_hierarchy *hierarchy,
                           const sl_view_sets *sets, sl_view_hierarchy *out) {
    sli_view_render render = {0};
    sl_view_sets rows = {0};
    sl_view_hierarchy made = {0};
    sl_status status = sli_view_render_make(context, scene, &render);
    if (status == SL_OK)
        status = sli_view_sets_create(context, sets->count, sets->object_count, &rows);
    if (status == SL_OK) status = make_arrays(context, hierarchy, &made);
    if (status == SL_OK) status = measure_all(context, &render, tree, sets, &rows, &made);
    sli_view_render_destroy(context, &render);
    sl_view_sets_destroy(context, &rows);
    if (status == SL_OK)
        *out = made;
    else
        sl_view_hierarchy_destroy(context, &made);
    return status;
}

// --- cuts

void sl_view_curve(const sl_view_hierarchy *h, double *costs, uint64_t *bytes) {
    const uint32_t count = h->cell_count;
    // From the top down: rounding errors stay small where cells are few.
    double cost = 0;
    uint64_t size = 0;
    const uint32_t top = count > 1 ? 2 * count - 2 : 0;
    cost = h->mass[top] * h->cost[top];
    size = h->bytes[top];
    for (uint32_t cells = 1; cells <= count; cells++) {
        if (costs) costs[cells - 1] = cost;
        if (bytes) bytes[cells - 1] = size;
        if (cells == count) break;
        const uint32_t joint = 2 * count - 1 - cells;
        const uint32_t *parts = h->joints[joint - count].parts;
        cost += h->mass[parts[0]] * h->cost[parts[0]] + h->mass[parts[1]] * h->cost[parts[1]] -
                h->mass[joint] * h->cost[joint];
        size += h->bytes[parts[0]] + h->bytes[parts[1]] - h->bytes[joint];
    }
}

sl_status sl_view_cut_by_bytes(sl_context *context, const sl_view_hierarchy *hierarchy,
                               uint64_t bytes, uint32_t *cells) {
    uint64_t *sizes = sl_alloc_array(context, hierarchy->cell_count, sizeof *sizes);
    if (!sizes) return SL_NO_MEMORY;
    sl_view_curve(hierarchy, NULL, sizes);
    uint32_t fit = 0;
    while (fit < hierarchy->cell_count && sizes[fit] <= bytes) fit++;
    const uint64_t least = sizes[0];
    sl_free(context, sizes);
    if (!fit)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "%llu bytes: even one view cell's visible set takes %llu",
                       (unsigned long long)bytes, (unsigned long long)least);
    *cells = fit;
    return SL_OK;
}

sl_status sl_view_cut_by_cost(sl_context *context, const sl_view_hierarchy *hierarchy,
                              double tolerance, uint32_t *cells) {
    if (!(tolerance >= 0))
        return sl_fail(context, SL_BAD_ARGUMENT, "a tolerance of %g: must not be negative",
                       tolerance);
    const uint32_t count = hierarchy->cell_count;
    double *costs = sl_alloc_array(context, count, sizeof *costs);
    if (!costs) return SL_NO_MEMORY;
    sl_view_curve(hierarchy, costs, NULL);
    uint32_t at = 1;
    while (at < count && costs[at - 1] > (1 + tolerance) * costs[count - 1]) at++;
    sl_free(context, costs);
    *cells = at;
    return SL_OK;
}

sl_status sl_view_cut(sl_context *context, const sl_view_hierarchy *hierarchy, uint32_t cells,
                      uint32_t *view_cells, uint32_t *numbers) {
    const uint32_t count = hierarchy->cell_count;
    if (!cells || cells > count)
        return sl_fail(context, SL_BAD_ARGUMENT, "%u view cells: 1 to %u are possible", cells,
                       count);
    const uint32_t joints = count - cells, all = count + joints;
    // By number: the whole that it is part of; then the view cell of that whole.
    uint32_t *top = sl_alloc_array(context, all, sizeof *top);
    uint32_t *cell_of = sl_alloc_array(context, all, sizeof *cell_of);
    if (!top || !cell_of) {
        sl_free(context, top);
        sl_free(context, cell_of);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < all; i++) {
        top[i] = i;
        cell_of[i] = UINT32_MAX;
    }
    for (uint32_t i = joints; i-- > 0;)
        for (int k = 0; k < 2; k++) top[hierarchy->joints[i].parts[k]] = top[count + i];
    uint32_t next = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *cell = &cell_of[top[i]];
        if (*cell == UINT32_MAX) {
            numbers[next] = top[i];
            *cell = next++;
        }
        view_cells[i] = *cell;
    }
    sl_free(context, top);
    sl_free(context, cell_of);
    return SL_OK;
}
