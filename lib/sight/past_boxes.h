/// What stands between an eye and what it sees, of boxes that block: with no cell cut.
#ifndef SL_PAST_BOXES_H
#define SL_PAST_BOXES_H

#include "sight/region_parts.h"
#include "sightline/space.h"

/// Whether an eye is on the border of a box that blocks. The sides there part what is around it.
bool sli_boxes_touch(const sl_moving_box *boxes, size_t count, sl_point eye);

/// What boxes do to the line between two points.
typedef enum sli_between {
    SLI_CLEAR,   ///< it meets no side of a box that blocks
    SLI_HIDDEN,  ///< it crosses one
    SLI_TOUCHED, ///< it touches some, and crosses none at a place where it touches no other
} sli_between;

sli_between sli_boxes_between(const sl_moving_box *boxes, size_t count, sl_point a, sl_point b);

/// As sli_region_make, past those of the boxes that block. The eye is on no border of one. An edge
/// on a box's side has the wall SL_BOX_WALL says.
sl_status sli_region_make_past(sl_context *context, const sl_outline *outline,
                               const sl_moving_box *boxes, size_t count, const sl_view *view,
                               double range, sl_region *region);

// --- parts of it

/// Up to so many boxes are taken as they are. Of more, those count that meet what is seen without
/// them.
enum { SLI_FEW_BOXES = 4 };

/// What a region that is not empty lies in, or some more: its points may be rounded.
sl_box sli_region_reach(const sl_region *region, const sl_box *bounds);

/// Makes the envelope of boxes about an eye: of those that meet `reach`, or of all where that is
/// NULL.
sl_status sli_box_envelope_make(sl_context *context, const sl_moving_box *boxes, size_t count,
                                const sli_eye_place *eye, const sl_box *reach,
                                sli_box_envelope *envelope);

/// Adds a piece to a region with an envelope, as far as it is seen, and the sides before it. As
/// see_piece in region.c: from `right` to `left`, or where these are NULL from and to its ends.
sl_status sli_region_see_past(sl_context *context, sl_region *region, uint32_t neighbour,
                              const sli_eye_ray *a, const sli_eye_ray *b, const sli_eye_ray *right,
                              const sli_eye_ray *left);

#endif
