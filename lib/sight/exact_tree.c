/// The exact method down a stab tree: only sequences that have a sightline are tested from the eye.
///
/// The nodes of a tree come parents first, in the order of a depth-first search. So a stack of the
/// nodes above the current one is enough. If the nodes come in another order, that shows, and the
/// search over portals is used instead.
#include "sight/eye_search.h"

/// The tree of a cell, and how many nodes; NULL where it is not kept.
static const sl_stab_node *tree_of(const sli_eye_query *query, uint32_t cell, uint64_t *count) {
    const sl_stab_trees *trees = &query->search->visibility->trees;
    if (!trees->cell_count) return NULL;
    *count = trees->offsets[cell + 1] - trees->offsets[cell];
    return *count ? trees->nodes + trees->offsets[cell] : NULL;
}

/// Goes down to a node; nodes that nothing is seen of stay on the way, without arcs, and so do
/// mirrors, and cells that the eye stands in: what is seen from there is searched for by itself.
static void go_down(sli_eye_query *query, const sli_eye_step *from, const sl_stab_node *node,
                    uint32_t number, sli_eye_step *to) {
    const bool first = from->at.next == 0, dead = !first && !from->arc_count;
    const bool passes =
        !dead && !sl_stab_is_mirror(node) && sli_eye_may_see(query, node->cell) &&
        sli_eye_pass_in_range(query, from, first, &query->space->directed[node->directed], to) &&
        !to->near &&
        sli_eye_may_cross(query->search, from, query->space->directed[node->directed].portal, to);
    if (passes) {
        query->nodes++;
        sl_bits_add(query->cells, node->cell);
    } else
        *to = (sli_eye_step){.at.cell = node->cell};
    to->at.next = number;
}

sl_status sli_eye_exact_tree(sl_context *context, sli_eye_query *query, uint32_t fan, bool *done) {
    const sli_eye_step start = sli_eye_first_step(query, fan);
    uint64_t node_count = 0;
    const sl_stab_node *nodes = tree_of(query, start.at.cell, &node_count);
    *done = false;
    if (!nodes) return SL_OK;
    sli_eye_step *steps = query->search->steps;
    size_t count = 1;
    steps[0] = start;
    if (sli_eye_leads_into(query, start.at.cell)) sl_bits_add(query->cells, start.at.cell);
    query->nodes++;
    for (uint64_t i = 1; i < node_count; i++) {
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(context));
        while (count && steps[count - 1].at.next != nodes[i].parent) count--;
        if (!count || count > query->space->cell_count) return SL_OK;
        go_down(query, &steps[count - 1], &nodes[i], (uint32_t)i, &steps[count]);
        count++;
    }
    *done = true;
    return SL_OK;
}
