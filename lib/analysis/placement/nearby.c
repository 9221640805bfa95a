/// Boxes near a place: a packed tree of most of them, and a short list of those that came since.
/// The list is looked through one by one. Where it is longer than some times the root of what the
/// tree has, all boxes are packed anew. So adding n boxes, and looking after each, takes
/// O(n^1.5 log n) together; lists that grew with the tree took O(n^2).
#include "analysis/placement/nearby.h"

enum { SHORT_LIST = 64, LONG_ROOTS = 8 };

sl_status sli_nearby_add(sl_context *context, sli_nearby *near, sl_box box) {
    SL_TRY(SL_ARRAY_ROOM(context, &near->boxes, 1));
    near->boxes.items[near->boxes.count++] = box;
    return SL_OK;
}

static sl_status pack(sl_context *context, sli_nearby *near) {
    sli_box_tree_destroy(context, &near->tree);
    near->in_tree = 0;
    SL_TRY(sli_box_tree_create(context, near->boxes.items, near->boxes.count, &near->tree));
    near->in_tree = near->boxes.count;
    return SL_OK;
}

sl_status sli_nearby_find(sl_context *context, sli_nearby *near, sl_box box) {
    const size_t fresh = near->boxes.count - near->in_tree;
    if (fresh > SHORT_LIST && fresh / LONG_ROOTS * fresh / LONG_ROOTS > near->in_tree)
        SL_TRY(pack(context, near));
    sli_box_list *found = &near->found;
    found->count = 0;
    if (near->in_tree) SL_TRY(sli_box_tree_find(context, &near->tree, &box, found));
    for (size_t i = near->in_tree; i < near->boxes.count; i++) {
        if (!sli_boxes_meet(&near->boxes.items[i], &box)) continue;
        SL_TRY(SL_ARRAY_ROOM(context, found, 1));
        found->items[found->count++] = (uint32_t)i;
    }
    return SL_OK;
}

sl_status sli_nearby_find_at(sl_context *context, sli_nearby *near, sl_point point) {
    return sli_nearby_find(context, near, (sl_box){point, point});
}

void sli_nearby_clear(sl_context *context, sli_nearby *near) {
    sli_box_tree_destroy(context, &near->tree);
    near->in_tree = near->boxes.count = 0;
}

void sli_nearby_destroy(sl_context *context, sli_nearby *near) {
    sli_nearby_clear(context, near);
    sl_free(context, near->boxes.items);
    sl_free(context, near->found.items);
    *near = (sli_nearby){0};
}
