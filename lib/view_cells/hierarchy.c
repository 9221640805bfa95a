/// Hierarchies of view cells: what their parts cost, and how they are cut (Mattausch et al. 2006,
/// section 5.1). The cost is what a traversal from the top goes by: it undoes the joint first that
/// was made last.
#include "view_cells/render.h"
#include "view_cells/tree.h"

#include <string.h>

void sl_view_hierarchy_destroy(sl_context *context, sl_view_hierarchy *hierarchy) {
    sl_free(context, hierarchy->joints);
    sl_free(context, hierarchy->cost);
    sl_free(context, hierarchy->mass);
    sl_free(context, hierarchy->objects);
    sl_free(context, hierarchy->bytes);
    *hierarchy = (sl_view_hierarchy){0};
}

// --- of splits

sl_status sl_view_join_splits(sl_context *context, const sl_view_scene *scene,
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

// --- what parts cost

static uint64_t number_bytes(uint32_t value) {
    uint64_t bytes = 1;
    while (value >>= 7) bytes++;
    return bytes;
}

/// Whether the first bit at or after `from` that is `value` comes before the end; its place.
static uint32_t next_bit(const sl_bits *set, uint32_t from, uint32_t end, bool value) {
    while (from < end) {
        const sl_bits word = (value ? set[from / 64] : ~set[from / 64]) >> (from % 64);
        if (word) {
            const uint32_t at = from + (uint32_t)__builtin_ctzll(word);
            return at < end ? at : end;
        }
        from = (from / 64 + 1) * 64;
    }
    return end;
}

/// What a set takes as a row of a PVS: runs of objects out and in, in LEB128 (pvs.h).
static uint64_t row_bytes(const sl_bits *set, uint32_t count) {
    uint64_t bytes = 0;
    for (uint32_t at = 0; at < count;) {
        const uint32_t in = next_bit(set, at, count, true);
        if (in == count) break;
        const uint32_t out = next_bit(set, in, count, false);
        bytes += number_bytes(in - at) + number_bytes(out - in);
        at = out;
    }
    return bytes;
}

static uint32_t count_objects(const sl_bits *set, size_t words) {
    uint32_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint32_t)__builtin_popcountll(set[i]);
    return count;
}

static void measure(const sl_view_render *render, const sl_view_sets *sets, const sl_bits *set,
                    sl_point middle, uint32_t number, sl_view_hierarchy *h) {
    h->cost[number] = sl_view_render_set(render, set, sets->words, middle);
    h->objects[number] = count_objects(set, sets->words);
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

/// From the elementary cells up; a joint takes over the row of its first part.
static sl_status measure_all(sl_context *context, const sl_view_render *render,
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
    for (uint32_t i = 0; i < count; i++) {
        row[i] = i;
        h->mass[i] = tree->mass[i];
        middle[i] = sl_view_leaf_middle(tree, i);
        measure(render, rows, sl_view_set(rows, i), middle[i], i, h);
    }
    for (uint32_t i = 0; i + 1 < count; i++) {
        const uint32_t a = h->joints[i].parts[0], b = h->joints[i].parts[1], c = count + i;
        sl_bits *into = sl_view_set(rows, row[a]);
        const sl_bits *from = sl_view_set(rows, row[b]);
        for (size_t k = 0; k < rows->words; k++) into[k] |= from[k];
        row[c] = row[a];
        h->mass[c] = h->mass[a] + h->mass[b];
        const double share = h->mass[b] / h->mass[c];
        middle[c].x = middle[a].x + share * (middle[b].x - middle[a].x);
        middle[c].y = middle[a].y + share * (middle[b].y - middle[a].y);
        measure(render, rows, into, middle[c], c, h);
    }
    sl_free(context, row);
    sl_free(context, middle);
    return SL_OK;
}

sl_status sl_view_evaluate(sl_context *context, const sl_view_scene *scene,
                           const sl_view_tree *tree, const sl_view_hierarchy *hierarchy,
                           const sl_view_sets *sets, sl_view_hierarchy *out) {
    sl_view_render render = {0};
    sl_view_sets rows = {0};
    sl_view_hierarchy made = {0};
    sl_status status = sl_view_render_make(context, scene, &render);
    if (status == SL_OK)
        status = sl_view_sets_create(context, sets->count, sets->object_count, &rows);
    if (status == SL_OK) status = make_arrays(context, hierarchy, &made);
    if (status == SL_OK) status = measure_all(context, &render, tree, sets, &rows, &made);
    sl_view_render_destroy(context, &render);
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
    // From the top down, so that what rounding adds up to stays small where cells are few.
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

uint32_t sl_view_cut_by_count(const sl_view_hierarchy *hierarchy, uint64_t cells) {
    if (!cells) return 1;
    return cells < hierarchy->cell_count ? (uint32_t)cells : hierarchy->cell_count;
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
    // By number: the whole that it is part of; then the number of that one's view cell.
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
