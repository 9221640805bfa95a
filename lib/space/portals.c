/// Portals and directed portals of a kd-tree's space.
///
/// A portal lies on a split line, between a cell below it and a cell above it. For each node, both
/// lists of cells that touch the line are gathered in order, and merged:
///
///     above   |   A   |     B      |  C  |
///     split   =====...:....====....:.....=       = wall   . free
///     below   |      D      |     E      |
///
/// Each common stretch of two cells, without the walls on it, gives portals: here D-A, D-B, E-B and
/// E-C. Seams on the line cut portals too. Time: linear in the portals, plus sorting.
#include "space/kd_tree.h"

#include "geometry/orient.h"
#include "sightline/support.h"

#include <stdlib.h>

typedef SL_ARRAY(uint32_t) cell_list;
typedef SL_ARRAY(sl_portal) portal_list;

typedef struct portal_maker {
    const sli_kd_tree *tree;
    SL_ARRAY(int32_t) stack;
    cell_list below, above; ///< the cells that touch a split line, in order along it
    portal_list portals;
    const sl_node *split;   ///< at work
    const sli_piece *walls; ///< on its line, in order; those before `next` are behind
    size_t wall_count, next;
} portal_maker;

/// Gathers the cells in a subtree that touch the line of a split on `axis`. The subtree lies above
/// the split or below it.
static sl_status gather_cells(sl_context *context, portal_maker *maker, int32_t child, int axis,
                              bool above, cell_list *out) {
    out->count = maker->stack.count = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &maker->stack, 1));
    maker->stack.items[maker->stack.count++] = child;
    while (maker->stack.count) {
        const int32_t next = maker->stack.items[--maker->stack.count];
        if (next < 0) {
            SL_TRY(SL_ARRAY_ROOM(context, out, 1));
            out->items[out->count++] = (uint32_t)~next;
            continue;
        }
        const sl_node *node = &maker->tree->nodes.items[next];
        SL_TRY(SL_ARRAY_ROOM(context, &maker->stack, 2));
        if (node->axis != axis || above)
            maker->stack.items[maker->stack.count + (node->axis != axis)] = node->below;
        if (node->axis != axis || !above) maker->stack.items[maker->stack.count] = node->above;
        maker->stack.count += node->axis == axis ? 1 : 2;
    }
    return SL_OK;
}

static void extent(const sl_box *box, int axis, double *lo, double *hi) {
    *lo = axis ? box->min.y : box->min.x;
    *hi = axis ? box->max.y : box->max.x;
}

static sl_status add_portal(sl_context *context, portal_maker *maker, uint32_t below,
                            uint32_t above, double lo, double hi) {
    const double at = maker->split->position;
    SL_TRY(SL_ARRAY_ROOM(context, &maker->portals, 1));
    // On the way up across the split, the left hand is at high y (axis 0) or at low x (axis 1).
    maker->portals.items[maker->portals.count++] =
        maker->split->axis == 0 ? (sl_portal){{below, above}, {at, hi}, {at, lo}}
                                : (sl_portal){{below, above}, {lo, at}, {hi, at}};
    return SL_OK;
}

/// Adds lo .. hi, cut where a seam on the line begins or ends.
static sl_status add_cut_piece(sl_context *context, portal_maker *maker, uint32_t below,
                               uint32_t above, double lo, double hi) {
    for (size_t i = maker->next; i < maker->wall_count && maker->walls[i].lo < hi; i++) {
        const sli_piece *seam = &maker->walls[i];
        if (!seam->seam || seam->hi <= lo) continue;
        const double cuts[2] = {seam->lo, seam->hi};
        for (int k = 0; k < 2; k++) {
            if (cuts[k] <= lo || cuts[k] >= hi) continue;
            SL_TRY(add_portal(context, maker, below, above, lo, cuts[k]));
            lo = cuts[k];
        }
    }
    return add_portal(context, maker, below, above, lo, hi);
}

/// Adds the parts of lo .. hi that walls leave free. Moves on past walls that end before lo.
static sl_status add_free_pieces(sl_context *context, portal_maker *maker, uint32_t below,
                                 uint32_t above, double lo, double hi) {
    const sli_piece *walls = maker->walls;
    while (maker->next < maker->wall_count && walls[maker->next].hi <= lo) maker->next++;
    for (size_t i = maker->next; i < maker->wall_count && walls[i].lo < hi; i++) {
        if (walls[i].seam) continue;
        if (walls[i].lo > lo) SL_TRY(add_cut_piece(context, maker, below, above, lo, walls[i].lo));
        if (walls[i].hi > lo) lo = walls[i].hi;
    }
    return lo < hi ? add_cut_piece(context, maker, below, above, lo, hi) : SL_OK;
}

static sl_status make_portals_of(sl_context *context, portal_maker *maker, size_t node) {
    const sli_kd_tree *tree = maker->tree;
    const sl_node *split = &tree->nodes.items[node];
    SL_TRY(gather_cells(context, maker, split->below, split->axis, false, &maker->below));
    SL_TRY(gather_cells(context, maker, split->above, split->axis, true, &maker->above));
    maker->split = split;
    maker->walls = tree->on_splits.items + tree->splits.items[node].first;
    maker->wall_count = tree->splits.items[node].count;
    maker->next = 0;
    for (size_t i = 0, j = 0; i < maker->below.count && j < maker->above.count;) {
        const uint32_t below = maker->below.items[i], above = maker->above.items[j];
        double lo, hi, other_lo, other_hi;
        extent(&tree->cells.items[below], !split->axis, &lo, &hi);
        extent(&tree->cells.items[above], !split->axis, &other_lo, &other_hi);
        i += hi <= other_hi;
        j += other_hi <= hi;
        if (other_lo > lo) lo = other_lo;
        if (other_hi < hi) hi = other_hi;
        SL_TRY(add_free_pieces(context, maker, below, above, lo, hi));
    }
    return SL_OK;
}

int sli_compare_portals(const void *left, const void *right) {
    const sl_portal *a = left, *b = right;
    if (a->cell[0] != b->cell[0]) return a->cell[0] < b->cell[0] ? -1 : 1;
    if (a->cell[1] != b->cell[1]) return a->cell[1] < b->cell[1] ? -1 : 1;
    return sli_compare_points(a->right, b->right);
}

/// The order of two directed portals of a cell: counter-clockwise from the lower left corner. The
/// right end of a directed portal comes first on this way.
static int compare_directed(const void *left, const void *right) {
    const sl_directed_portal *a = left, *b = right;
    const sl_point u = {a->left.x - a->right.x, a->left.y - a->right.y};
    const sl_point v = {b->left.x - b->right.x, b->left.y - b->right.y};
    const int edge_a = u.x > 0 ? 0 : u.y > 0 ? 1 : u.x < 0 ? 2 : 3;
    const int edge_b = v.x > 0 ? 0 : v.y > 0 ? 1 : v.x < 0 ? 2 : 3;
    if (edge_a != edge_b) return edge_a - edge_b;
    const int order = sli_compare_points(a->right, b->right);
    return edge_a < 2 ? order : -order;
}

sl_status sli_make_directed(sl_context *context, sl_space *space) {
    space->directed = sl_alloc_array(context, space->directed_count, sizeof *space->directed);
    if (!space->directed) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < space->portal_count; i++)
        for (int side = 0; side < 2; side++)
            space->cells[space->portals[i].cell[side]].directed_count++;
    uint32_t first = 0;
    for (uint32_t i = 0; i < space->cell_count; i++) {
        space->cells[i].first_directed = first;
        first += space->cells[i].directed_count;
        space->cells[i].directed_count = 0;
    }
    for (uint32_t i = 0; i < space->portal_count; i++) {
        const sl_portal *p = &space->portals[i];
        for (int side = 0; side < 2; side++) {
            sl_cell *cell = &space->cells[p->cell[side]];
            space->directed[cell->first_directed + cell->directed_count++] =
                (sl_directed_portal){.portal = i,
                                     .cell = p->cell[!side],
                                     .left = side ? p->right : p->left,
                                     .right = side ? p->left : p->right};
        }
    }
    for (uint32_t i = 0; i < space->cell_count; i++) {
        const sl_cell *cell = &space->cells[i];
        qsort(space->directed + cell->first_directed, cell->directed_count, sizeof *space->directed,
              compare_directed);
    }
    return SL_OK;
}

static sl_status make_all(sl_context *context, portal_maker *maker, sl_space *space) {
    for (size_t node = 0; node < maker->tree->nodes.count; node++) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(make_portals_of(context, maker, node));
    }
    if (maker->portals.count > UINT32_MAX / 2) return sl_fail_memory(context);
    if (maker->portals.count)
        qsort(maker->portals.items, maker->portals.count, sizeof *maker->portals.items,
              sli_compare_portals);
    SL_TRY(sl_check_cancelled(context));
    space->portals = maker->portals.items;
    space->portal_count = (uint32_t)maker->portals.count;
    space->directed_count = 2 * space->portal_count;
    maker->portals.items = NULL;
    return sli_make_directed(context, space);
}

sl_status sli_make_portals(sl_context *context, const sli_kd_tree *tree, sl_space *space) {
    portal_maker maker = {.tree = tree};
    const sl_status status = make_all(context, &maker, space);
    sl_free(context, maker.stack.items);
    sl_free(context, maker.below.items);
    sl_free(context, maker.above.items);
    sl_free(context, maker.portals.items);
    return status;
}
