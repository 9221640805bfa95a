#include "space/boxes.h"
#include "base/base.h"
sl_status sl_boxes_put_mesh(sl_context *context, const sl_box_ground *ground,
                            const sl_moving_box *boxes, size_t count, sl_boxed_space *out) {
    (void)ground;(void)boxes;(void)count;(void)out;
    return sl_fail(context, SL_UNSUPPORTED, "not here yet");
}
