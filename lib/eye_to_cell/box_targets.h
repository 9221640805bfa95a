/// What of boxes is to be met in each cell: the pieces of their sides there.
#ifndef SL_BOX_TARGETS_H
#define SL_BOX_TARGETS_H

#include "space/boxes.h"

typedef struct sl_box_targets {
    uint32_t *first; ///< by cell, and one more: its targets are items[first[c] .. first[c + 1])
    sl_directed_portal
        *items; ///< as crossed on the way out of the cell; `portal`: the box's number
} sl_box_targets;

/// The pieces that no axial wall of the ground covers, in a space with the boxes in it: all lie on
/// the boundaries of cells. `out` is zeroed, and to be destroyed whatever comes.
sl_status sl_box_targets_find(sl_context *context, const sl_box_ground *ground,
                              const sl_space *space, const sl_moving_box *boxes, size_t count,
                              sl_box_targets *out);
void sl_box_targets_destroy(sl_context *context, sl_box_targets *targets);

#endif
