/// Boxes that move are not offered to JavaScript. So their sources are left out of the module,
/// which would be a sixteenth larger with them, and a query that asks for boxes is refused.
#include "sightline/moving.h"
#include "sightline/support.h"

static sl_status refuse(sl_context *context) {
    return sl_fail(context, SL_UNSUPPORTED, "boxes are not part of this module");
}

sl_status sl_moving_create(sl_context *context, const sl_space *space,
                           const sl_visibility *visibility, sl_moving **out) {
    (void)space;
    (void)visibility;
    (void)out;
    return refuse(context);
}

// Without a sl_moving none of these is reached.

void sl_moving_destroy(sl_context *context, sl_moving *moving) {
    (void)context;
    (void)moving;
}

sl_status sl_moving_place(sl_context *context, sl_moving *moving, const sl_moving_box *boxes,
                          size_t count) {
    (void)moving;
    (void)boxes;
    (void)count;
    return refuse(context);
}

void sl_moving_limit(sl_moving *moving, double range) {
    (void)moving;
    (void)range;
}

sl_status sl_moving_add_mirrors(sl_context *context, sl_moving *moving, const sl_map *map,
                                uint32_t depth) {
    (void)moving;
    (void)map;
    (void)depth;
    return refuse(context);
}

sl_status sl_moving_add_glass(sl_context *context, sl_moving *moving) {
    (void)moving;
    return refuse(context);
}

sl_status sl_moving_outline(sl_context *context, sl_moving *moving, const sl_outline **out) {
    (void)moving;
    (void)out;
    return refuse(context);
}

sl_status sl_moving_look(sl_context *context, sl_moving *moving, const sl_view *view,
                         uint64_t *cells, bool *seen, sl_eye_account *account) {
    (void)moving;
    (void)view;
    (void)cells;
    (void)seen;
    (void)account;
    return refuse(context);
}

sl_status sl_moving_look_mirrored(sl_context *context, sl_moving *moving, const sl_view *view,
                                  uint64_t *cells, bool *seen, sl_eye_account *account) {
    return sl_moving_look(context, moving, view, cells, seen, account);
}
