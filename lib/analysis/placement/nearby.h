/// Boxes that can be found by what they meet, while more are added: regions and points near a
/// place, without looking at all.
#ifndef SLI_PLACE_NEARBY_H
#define SLI_PLACE_NEARBY_H

#include "space/index.h"

/// Zeroed, it is empty.
typedef struct sli_nearby {
    SL_ARRAY(sl_box) boxes;
    sli_box_tree tree; ///< of the first boxes
    size_t in_tree;
    sli_box_list found; ///< by the last search, ascending
} sli_nearby;

static inline bool sli_boxes_meet(const sl_box *a, const sl_box *b) {
    return a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y &&
           b->min.y <= a->max.y;
}

/// Adds a box, which gets the next number.
sl_status sli_nearby_add(sl_context *context, sli_nearby *near, sl_box box);
/// Finds all boxes that meet one; a common border is enough.
sl_status sli_nearby_find(sl_context *context, sli_nearby *near, sl_box box);
sl_status sli_nearby_find_at(sl_context *context, sli_nearby *near, sl_point point);
void sli_nearby_clear(sl_context *context, sli_nearby *near); ///< leaves no box
void sli_nearby_destroy(sl_context *context, sli_nearby *near);

#endif
