/// Trees of elementary view cells: point location, neighbours, borders, and the sets of leaves.
///
/// A tree is a binary space partition. Each side of a leaf knows the node that made it. So leaves
/// that share a piece of boundary are found split by split: the sides below a split and those above
/// it are sorted along it and paired in one sweep, O(n log n):
///
///          above |  A  |     B     |        pairs: (A, D), (B, D), (B, E)
///       split ---+-----+--+--------+---
///          below |   D    |   E    |
#include "study/view_cells/view_cell_tree.h"

#include "geometry/orient.h"

#include <stdlib.h>
#include <string.h>

void sl_view_tree_destroy(sl_context *context, sl_view_tree *tree) {
    sl_free(context, tree->nodes);
    sl_free(context, tree->lines);
    sl_free(context, tree->corners);
    sl_free(context, tree->edges);
    sl_free(context, tree->first);
    sl_free(context, tree->mass);
    *tree = (sl_view_tree){0};
}

uint32_t sl_view_tree_locate(const sl_view_tree *tree, sl_point point) {
    const sl_box *b = &tree->bounds;
    if (!tree->leaf_count || !(point.x >= b->min.x && point.x <= b->max.x) ||
        !(point.y >= b->min.y && point.y <= b->max.y))
        return SL_NO_VIEW_CELL;
    int32_t at = tree->root;
    while (at >= 0) {
        const sl_view_node *node = &tree->nodes[at];
        bool below;
        if (node->axis < 2) {
            below = (node->axis ? point.y : point.x) < node->position;
        } else {
            const sl_segment *line = &tree->lines[node->line];
            below = sli_orient(line->a, line->b, point) < 0;
        }
        at = below ? node->below : node->above;
    }
    return (uint32_t)~at;
}

/// The mean of its corners, from the first one: large coordinates lose nothing.
sl_point sli_view_leaf_middle(const sl_view_tree *tree, uint32_t leaf) {
    const sl_point *corners = tree->corners + tree->first[leaf];
    const uint32_t count = tree->first[leaf + 1] - tree->first[leaf];
    sl_point sum = {0, 0};
    for (uint32_t i = 1; i < count; i++) {
        sum.x += (corners[i].x - corners[0].x) / count;
        sum.y += (corners[i].y - corners[0].y) / count;
    }
    return (sl_point){corners[0].x + sum.x, corners[0].y + sum.y};
}

uint32_t sli_view_cell_home(const sl_space *homes, const sl_space *space, uint32_t cell) {
    if (homes->neighbour) return sl_space_locate(homes, sl_space_middle(space, cell));
    const sl_cell *c = &space->cells[cell];
    sl_point least = space->vertices[c->first_vertex];
    for (uint32_t i = 1; i < c->vertex_count; i++) {
        const sl_point p = space->vertices[c->first_vertex + i];
        least = (sl_point){fmin(least.x, p.x), fmin(least.y, p.y)};
    }
    return sl_space_locate(homes, least);
}

uint32_t sli_view_cell_leaf(const sl_view_tree *tree, const sl_space *space, uint32_t cell) {
    const sl_cell *c = &space->cells[cell];
    int32_t at = tree->root;
    while (at >= 0) {
        const sl_view_node *node = &tree->nodes[at];
        double least = 0, most = 0;
        for (uint32_t i = 0; i < c->vertex_count; i++) {
            const double side =
                sli_view_node_side(tree, node, space->vertices[c->first_vertex + i]);
            least = fmin(least, side);
            most = fmax(most, side);
        }
        at = -least > most ? node->below : node->above;
    }
    return (uint32_t)~at;
}

// --- sets

void sl_view_sets_destroy(sl_context *context, sl_view_sets *sets) {
    sl_free(context, sets->bits);
    *sets = (sl_view_sets){0};
}

sl_status sli_view_sets_create(sl_context *context, uint32_t count, uint32_t object_count,
                               sl_view_sets *sets) {
    const size_t words = sl_bits_words(object_count);
    if (words && count > SIZE_MAX / words) return sl_fail_memory(context);
    uint64_t *bits = sl_alloc_array(context, count * words, sizeof *bits);
    if (!bits) return SL_NO_MEMORY;
    *sets = (sl_view_sets){count, object_count, words, bits};
    return SL_OK;
}

// --- neighbours

/// A side of a leaf on a split: from low to high along it.
typedef struct side {
    uint32_t node, leaf;
    bool above;
    double low, high;
    sl_point from, to; ///< the ends there
} side;

typedef SL_ARRAY(side) sides;

static int compare_sides(const void *left, const void *right) {
    const side *a = left, *b = right;
    if (a->node != b->node) return a->node < b->node ? -1 : 1;
    if (a->above != b->above) return a->above ? 1 : -1;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return (a->leaf > b->leaf) - (a->leaf < b->leaf);
}

double sli_view_along(const sl_view_tree *tree, const sl_view_node *node, sl_point p) {
    if (node->axis < 2) return node->axis ? p.x : p.y;
    const sl_segment *l = &tree->lines[node->line];
    return fabs(l->b.x - l->a.x) >= fabs(l->b.y - l->a.y) ? p.x : p.y;
}

/// A leaf is at the left of its sides, which go counter-clockwise: `grows` says that one goes where
/// `along` grows.
static bool is_above(const sl_view_tree *tree, const sl_view_node *node, bool grows) {
    if (node->axis < 2) return grows == (node->axis == 1);
    const sl_segment *l = &tree->lines[node->line];
    return grows == (sli_view_along(tree, node, l->a) < sli_view_along(tree, node, l->b));
}

static sl_status gather(sl_context *context, const sl_view_tree *tree, sides *all) {
    for (uint32_t leaf = 0; leaf < tree->leaf_count; leaf++) {
        const uint32_t first = tree->first[leaf], end = tree->first[leaf + 1];
        SL_TRY(SL_ARRAY_ROOM(context, all, end - first));
        for (uint32_t i = first; i < end; i++) {
            const uint32_t number = tree->edges[i];
            if (number == UINT32_MAX) continue;
            const sl_view_node *node = &tree->nodes[number];
            const sl_point p = tree->corners[i], q = tree->corners[i + 1 < end ? i + 1 : first];
            const double from = sli_view_along(tree, node, p), to = sli_view_along(tree, node, q);
            if (from == to) continue;
            const bool above = is_above(tree, node, from < to);
            all->items[all->count++] = from < to ? (side){number, leaf, above, from, to, p, q}
                                                 : (side){number, leaf, above, to, from, q, p};
        }
    }
    return SL_OK;
}

/// Sides on either side of one split, in order along it: below[0 .. middle), then above.
static sl_status pair_up(sl_context *context, const side *below, const side *middle,
                         const side *end, sli_view_pairs *out) {
    const side *above = middle;
    while (below < middle && above < end) {
        if (fmax(below->low, above->low) < fmin(below->high, above->high)) {
            SL_TRY(SL_ARRAY_ROOM(context, out, 1));
            const sl_segment shared = {below->low > above->low ? below->from : above->from,
                                       below->high < above->high ? below->to : above->to};
            out->items[out->count++] = (sli_view_pair){below->leaf, above->leaf, shared};
        }
        if (below->high <= above->high)
            below++;
        else
            above++;
    }
    return SL_OK;
}

sl_status sli_view_neighbours(sl_context *context, const sl_view_tree *tree, sli_view_pairs *out) {
    sides all = {0};
    sl_status status = gather(context, tree, &all);
    if (status == SL_OK && all.count) qsort(all.items, all.count, sizeof *all.items, compare_sides);
    for (size_t i = 0, middle, end; i < all.count && status == SL_OK; i = end) {
        const uint32_t node = all.items[i].node;
        for (middle = i; middle < all.count && all.items[middle].node == node; middle++)
            if (all.items[middle].above) break;
        for (end = middle; end < all.count && all.items[end].node == node;) end++;
        status = pair_up(context, all.items + i, all.items + middle, all.items + end, out);
    }
    sl_free(context, all.items);
    return status;
}

sl_status sl_view_borders(sl_context *context, const sl_view_tree *tree, const uint32_t *view_cells,
                          sl_segment **borders, size_t *count) {
    sli_view_pairs pairs = {0};
    sl_status status = sli_view_neighbours(context, tree, &pairs);
    sl_segment *made = NULL;
    if (status == SL_OK) made = sl_alloc_array(context, pairs.count, sizeof *made);
    if (status == SL_OK && !made) status = SL_NO_MEMORY;
    size_t found = 0;
    for (size_t i = 0; i < pairs.count && status == SL_OK; i++) {
        const sli_view_pair *p = &pairs.items[i];
        const uint32_t a = p->a < tree->cell_count ? view_cells[p->a] : SL_NO_VIEW_CELL;
        const uint32_t b = p->b < tree->cell_count ? view_cells[p->b] : SL_NO_VIEW_CELL;
        if (a != b) made[found++] = p->shared;
    }
    sl_free(context, pairs.items);
    if (status != SL_OK) return status;
    *borders = made;
    *count = found;
    return SL_OK;
}
