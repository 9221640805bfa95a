/// Dividing view space by what pieces of its rooms see, exactly (pieces.h).
#include "base/bits.h"
#include "view_cells/divide.h"
#include "view_cells/tree.h"

static void add_extent(sl_view_divider *d, sl_view_part *part, sl_point middle, uint32_t object,
                       const sl_view_extent *from) {
    sl_view_extent *extent = &d->extents[object];
    if (extent->low[0] == INFINITY) {
        d->seen.items[d->seen.count++] = object;
        part->seen += sl_view_render_object(&d->render, object, middle);
    }
    sl_view_extent_join(extent, from);
}

void sl_view_find_piece_extents(sl_view_divider *d, sl_view_part *part) {
    const sl_view_rooms *rooms = &d->pieces->rooms;
    const sl_point middle = sl_view_part_middle(part);
    d->seen.count = 0;
    part->seen = 0;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const sl_view_piece *piece = &d->pieces->items.items[part->pieces.items[i]];
        const uint32_t room = piece->room, own = rooms->object[room];
        if (own != SL_NO_OBJECT) add_extent(d, part, middle, own, &piece->box);
        for (uint32_t k = rooms->first_side[room]; k < rooms->first_side[room + 1]; k++)
            if (rooms->sides[k].room == SL_NO_ROOM)
                add_extent(d, part, middle, rooms->sides[k].object, &piece->box);
        for (int q = 0; q < SL_VIEW_QUADRANTS; q++) {
            d->pieces->work.weighed += piece->directed[q].objects.count;
            for (size_t k = 0; k < piece->directed[q].objects.count; k++) {
                const sl_view_sight *sight = &piece->directed[q].objects.items[k];
                add_extent(d, part, middle, sight->object, &sight->from);
            }
        }
    }
}

static sl_status add_piece(sl_context *context, sl_view_part *part, uint32_t number) {
    SL_TRY(SL_ARRAY_ROOM(context, &part->pieces, 1));
    part->pieces.items[part->pieces.count++] = number;
    return SL_OK;
}

sl_status sl_view_deal_pieces(sl_view_divider *d, const sl_view_part *part, sl_view_part *below,
                              sl_view_part *above) {
    const int axis = part->split.axis;
    const double position = part->split.position;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const uint32_t number = part->pieces.items[i];
        const sl_view_extent *box = &d->pieces->items.items[number].box;
        if (box->high[axis] <= position) {
            SL_TRY(add_piece(d->context, below, number));
        } else if (box->low[axis] >= position) {
            SL_TRY(add_piece(d->context, above, number));
        } else {
            // Where no viewpoint is, nobody asks what is seen.
            uint32_t other;
            SL_TRY(sl_view_pieces_cut(d->pieces, number, axis, position, below->mass > 0,
                                      above->mass > 0, &other));
            SL_TRY(add_piece(d->context, below, number));
            SL_TRY(add_piece(d->context, above, other));
        }
    }
    return SL_OK;
}

sl_status sl_view_sets_of_pieces(const sl_view_divider *d, sl_view_sets *sets) {
    SL_TRY(sl_view_sets_create(d->context, d->with_mass, d->render.object_count, sets));
    uint32_t leaf = 0;
    for (size_t i = 0; i < d->parts.count; i++) {
        const sl_view_part *part = &d->parts.items[i];
        if (!(part->mass > 0)) continue;
        sl_bits *row = sl_view_set(sets, leaf++);
        for (size_t k = 0; k < part->pieces.count; k++)
            sl_view_piece_add_to(d->pieces, &d->pieces->items.items[part->pieces.items[k]], row);
    }
    return SL_OK;
}
