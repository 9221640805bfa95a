/// Where the splits of a kd-tree lie.
#ifndef SL_SPACE_SPLITS_H
#define SL_SPACE_SPLITS_H

#include "sightline/space.h"

/// What a node splits.
typedef struct sl_split {
    uint32_t depth; ///< nodes above it
    sl_box below, above;
    sl_segment along; ///< the piece of the split line that is in the node's box
} sl_split;

/// The splits of a space by node, node_count of them; to be freed with sl_free(). A mesh has none.
/// The space must be one that sl_space_check finds no fault in.
sl_status sl_splits_make(sl_context *context, const sl_space *space, sl_split **out);

/// The share of a node's split that walls on its line cover: 0 to 1.
double sl_splits_covered(const sl_split *splits, const sl_space *space, uint32_t node);

#endif
