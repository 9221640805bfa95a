/// Seams go to the faces that they have a point inside of, and mark the portals that they lie on.
#include "space/box_tree.h"
#include "space/bsp.h"

typedef struct seam_deal {
    sl_bsp *bsp;
    sl_box_tree tree;   ///< of the faces
    sl_box_list nearby; ///< faces whose boxes the seam's meets
} seam_deal;

static sl_status make_tree(seam_deal *deal) {
    const sl_bsp *bsp = deal->bsp;
    sl_box *boxes = sl_alloc_array(bsp->context, bsp->faces.count, sizeof *boxes);
    if (!boxes) return SL_NO_MEMORY;
    for (size_t i = 0; i < bsp->faces.count; i++) {
        const sl_bsp_sides *sides = &bsp->faces.items[i].sides;
        boxes[i] = sl_box_around(sides->items[0].from, sides->items[1].from);
        for (size_t k = 2; k < sides->count; k++)
            boxes[i] = sl_box_with(boxes[i], sides->items[k].from);
    }
    const sl_status status = sl_box_tree_create(bsp->context, boxes, bsp->faces.count, &deal->tree);
    sl_free(bsp->context, boxes);
    return status;
}

/// Faces come in ascending order: that of the corners that portals get on the way.
static sl_status deal_seam(seam_deal *deal, uint32_t number) {
    sl_bsp *bsp = deal->bsp;
    const sl_wall *part = &bsp->walls[number];
    const sl_box box = sl_box_around(part->a, part->b);
    SL_TRY(sl_box_tree_find(bsp->context, &deal->tree, &box, &deal->nearby));
    for (size_t i = 0; i < deal->nearby.count; i++) {
        const uint32_t face = deal->nearby.items[i];
        size_t along;
        if (sl_bsp_hits(&bsp->faces.items[face].sides, part, &along))
            SL_TRY(sl_bsp_add_wall(bsp, face, number));
        else if (along != SIZE_MAX)
            SL_TRY(sl_bsp_close_portals(bsp, face, number));
    }
    return SL_OK;
}

sl_status sl_bsp_deal_seams(sl_bsp *bsp, size_t count) {
    seam_deal deal = {.bsp = bsp};
    sl_status status = make_tree(&deal);
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        status = sl_check_cancelled(bsp->context);
        if (status == SL_OK) status = deal_seam(&deal, bsp->wall_count + i);
    }
    sl_box_tree_destroy(bsp->context, &deal.tree);
    sl_free(bsp->context, deal.nearby.items);
    return status;
}
