#include "space/splits.h"

#include "sightline/support.h"

#include <math.h>

static sl_split split(const sl_node *node, sl_box box, uint32_t depth) {
    sl_split s = {depth, box, box, {box.min, box.max}};
    if (node->axis == 0)
        s.below.max.x = s.above.min.x = s.along.a.x = s.along.b.x = node->position;
    else
        s.below.max.y = s.above.min.y = s.along.a.y = s.along.b.y = node->position;
    return s;
}

sl_status sl_splits_make(sl_context *context, const sl_space *space, sl_split **out) {
    sl_split *splits = sl_alloc_array(context, space->node_count, sizeof *splits);
    if (!splits) return SL_NO_MEMORY;
    // A node stands before its children: each finds its box and depth in its own place.
    if (space->node_count) splits[space->root].below = space->bounds;
    for (uint32_t i = 0; i < space->node_count; i++) {
        const sl_node *node = &space->nodes[i];
        splits[i] = split(node, splits[i].below, splits[i].depth);
        if (node->below >= 0)
            splits[node->below] = (sl_split){splits[i].depth + 1, .below = splits[i].below};
        if (node->above >= 0)
            splits[node->above] = (sl_split){splits[i].depth + 1, .below = splits[i].above};
    }
    *out = splits;
    return SL_OK;
}

double sl_splits_covered(const sl_split *splits, const sl_space *space, uint32_t node) {
    const bool upright = space->nodes[node].axis == 0;
    const double position = space->nodes[node].position;
    const sl_segment along = splits[node].along;
    const double low = upright ? along.a.y : along.a.x, high = upright ? along.b.y : along.b.x;
    double sum = 0;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        if ((upright ? w->a.x : w->a.y) != position || (upright ? w->b.x : w->b.y) != position)
            continue;
        const double a = upright ? w->a.y : w->a.x, b = upright ? w->b.y : w->b.x;
        sum += fmax(0, fmin(fmax(a, b), high) - fmax(fmin(a, b), low));
    }
    return high > low ? fmin(sum / (high - low), 1) : 0;
}
