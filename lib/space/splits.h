/// Where the splits of a tree lie, to be shown and told: rounded, and nothing is decided by it.
#ifndef SL_SPACE_SPLITS_H
#define SL_SPACE_SPLITS_H

#include "base/base.h"
#include "sightline/space.h"

/// A convex polygon, counter-clockwise: sl_splits.corners[first .. first + count). Nothing of it
/// may be left: count 0.
typedef struct sl_split_region {
    size_t first, count;
} sl_split_region;

/// What a node splits on one way down to it.
typedef struct sl_split {
    uint32_t node, depth; ///< nodes above it
    sl_split_region below, above;
    sl_segment along; ///< the piece of the node's line; two equal ends where only a corner is on it
} sl_split;

/// Zeroed, it is empty. The splits of node n are splits.items[first[n] .. first[n + 1]): one in a
/// kd-tree; as many in a BSP as there are ways to the node that leave something, which may be none.
typedef struct sl_splits {
    SL_ARRAY(sl_split) splits;
    uint32_t *first;
    uint32_t node_count;
    SL_ARRAY(sl_point) corners;
} sl_splits;

/// The splits of a space, which must be one that sl_space_check finds no fault in.
sl_status sl_splits_make(sl_context *context, const sl_space *space, sl_splits *out);
void sl_splits_destroy(sl_context *context, sl_splits *splits); ///< and zeroes it

/// The share of a node's split that walls on its line cover: 0 to 1.
double sl_splits_covered(const sl_splits *splits, const sl_space *space, uint32_t node);

#endif
