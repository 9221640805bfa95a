#include "walk/walk_parts.h"

#include <string.h>

void sl_walk_look_at(sl_walk *w, uint32_t node, sl_walk_look *l) {
    const sl_walk_node *n = &w->hierarchy->nodes[node];
    const sl_space *space = w->hierarchy->space;
    sl_pivot *pivot = &w->occlusion->shadows.pivot;
    const sl_box *b = &n->box;
    l->cut = false;
    l->shape = (sl_shape){l->box_corners, 4, *b, true};
    if (n->cell != SL_NO_CELL && !w->hierarchy->tiles) {
        const sl_cell *c = &space->cells[n->cell];
        l->shape = (sl_shape){space->vertices + c->first_vertex, c->vertex_count, *b, false};
    } else {
        l->box_corners[0] = b->min;
        l->box_corners[1] = (sl_point){b->max.x, b->min.y};
        l->box_corners[2] = b->max;
        l->box_corners[3] = (sl_point){b->min.x, b->max.y};
    }
    l->sector_count = sl_shape_sectors(pivot, &l->shape, w->sectors);
    if (w->cone.kind == SL_CONE_ALL) return;
    // From the last on, so that the parts of one take the room behind those yet to come.
    uint32_t kept = 2 * w->hierarchy->corner_most;
    for (uint32_t i = l->sector_count; i-- > 0;) {
        sl_sector parts[2];
        const unsigned count = sl_sector_in_cone(pivot, &w->cone, &w->sectors[i], parts, &l->cut);
        for (unsigned k = count; k-- > 0;) w->sectors[--kept] = parts[k];
    }
    l->sector_count = 2 * w->hierarchy->corner_most - kept;
    memmove(w->sectors, w->sectors + kept, l->sector_count * sizeof *w->sectors);
}

sl_node_state sl_walk_test(sl_walk *w, const sl_walk_look *l) {
    unsigned bits = l->cut ? SL_BEHIND : 0;
    for (uint32_t i = 0; i < l->sector_count && bits != SL_LOOK_BOTH; i++)
        w->test->look(w->occlusion, &l->shape, &w->sectors[i], &bits);
    return bits == SL_LOOK_BOTH ? SL_NODE_PARTIAL
           : bits == SL_BEFORE  ? SL_NODE_VISIBLE
                                : SL_NODE_INVISIBLE;
}
