/// Dividing view space by what pieces of its rooms see, exactly (pieces.h).
#include "sightline/support.h"
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

/// On which sides of a split a piece lies: 1 below, 2 above, 3 both.
static int sides_of(const sl_view_pieces *pieces, uint32_t number, const sl_view_split *split) {
    const sl_view_extent *box = &pieces->items.items[number].box;
    if (box->high[split->axis] <= split->position) return 1;
    return box->low[split->axis] >= split->position ? 2 : 3;
}

sl_status sl_view_halve_pieces(sl_context *context, const sl_view_pieces *pieces,
                               sl_view_looker *looker, const sl_view_part *part,
                               sl_view_part_halves *cut) {
    const sl_view_split *split = &part->split;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const uint32_t number = part->pieces.items[i];
        if (sides_of(pieces, number, split) != 3) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &cut->pieces, 1));
        sl_view_halves *halves = &cut->pieces.items[cut->pieces.count++];
        *halves = (sl_view_halves){0};
        // Where no viewpoint is, nobody asks what is seen.
        SL_TRY(sl_view_pieces_halve(context, pieces, looker, number, split->axis, split->position,
                                    cut->below.mass > 0, cut->above.mass > 0, halves));
    }
    return SL_OK;
}

sl_status sl_view_deal_pieces(sl_view_divider *d, const sl_view_part *part,
                              sl_view_part_halves *cut) {
    size_t next = 0;
    for (size_t i = 0; i < part->pieces.count; i++) {
        const uint32_t number = part->pieces.items[i];
        const int sides = sides_of(d->pieces, number, &part->split);
        uint32_t above = number;
        if (sides == 3)
            SL_TRY(sl_view_pieces_cut(d->pieces, number, &cut->pieces.items[next++], &above));
        if (sides & 1) SL_TRY(add_piece(d->context, &cut->below, number));
        if (sides & 2) SL_TRY(add_piece(d->context, &cut->above, above));
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
