/// Boxes that move are not offered to JavaScript. So their sources are left out of the module,
/// which would be a sixteenth larger with them, and a query that asks for boxes is refused.
#include "eye_to_cell/eye_search.h"
#include "sightline/moving.h"
#include "sightline/support.h"

static sl_status refuse(sl_context *context) {
    return sl_fail(context, SL_UNSUPPORTED, "boxes are not part of this module");
}

sl_status sli_moving_boxes_check(sl_context *context, const sl_moving_box *boxes, size_t count) {
    (void)boxes;
    return count ? refuse(context) : SL_OK;
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

// Without boxes none of these is reached, but for the one that lets go of nothing.

sl_status sli_box_lists_make(sl_context *context, const sl_space *space, const sl_moving_box *boxes,
                             size_t count, sli_box_lists *out) {
    (void)space;
    (void)boxes;
    (void)count;
    (void)out;
    return refuse(context);
}

void sli_box_lists_destroy(sl_context *context, sli_box_lists *lists) {
    (void)context;
    (void)lists;
}

sl_status sli_eye_boxes_seen(sl_context *context, sl_eye_search *search, const sli_box_lists *lists,
                             const sl_view *view, uint64_t *cells, bool *seen) {
    (void)search;
    (void)lists;
    (void)view;
    (void)cells;
    (void)seen;
    return refuse(context);
}

void sli_eye_meet_boxes(sli_eye_query *query, const sli_eye_step *at, bool first) {
    (void)query;
    (void)at;
    (void)first;
}
