/// Putting pieces in the place of the faces that a line has passed: numbers, the tree, portals.
#include "space/bsp.h"

#include <string.h>

size_t sl_bsp_find_side(const sl_bsp_face *face, sl_point from, sl_point to, uint32_t beyond) {
    for (size_t i = 0; i < face->sides.count; i++) {
        const sl_bsp_side *side = &face->sides.items[i];
        if (side->beyond == beyond && sl_same_point(side->from, from) &&
            sl_same_point(sl_side_end(&face->sides, i), to))
            return i;
    }
    return SIZE_MAX;
}

sl_status sl_bsp_insert_corner(sl_context *context, sl_bsp_face *face, size_t side, sl_point at) {
    SL_TRY(SL_ARRAY_ROOM(context, &face->sides, 1));
    sl_bsp_side *items = face->sides.items;
    memmove(items + side + 1, items + side, (face->sides.count - side) * sizeof *items);
    items[side + 1].from = at;
    face->sides.count++;
    return SL_OK;
}

/// Where the line ends in a new corner on a portal, the face beyond gets it as well.
static sl_status tell_face_beyond(sl_bsp *bsp, const sl_bsp_passage *passage, bool out) {
    const bool is_new = out ? passage->exit_new : passage->entry_new;
    const size_t number = out ? passage->exit.side : passage->entry.side;
    const sl_bsp_sides *sides = &bsp->faces.items[passage->face].sides;
    const sl_bsp_side *side = &sides->items[number];
    if (!is_new || side->what != SL_BEYOND_EXIT || sl_bsp_is_passage(bsp, side->beyond))
        return SL_OK;
    sl_bsp_face *beyond = &bsp->faces.items[side->beyond];
    const size_t twin =
        sl_bsp_find_side(beyond, sl_side_end(sides, number), side->from, passage->face);
    return sl_bsp_insert_corner(bsp->context, beyond, twin,
                                out ? passage->exit_left : passage->entry_left);
}

/// Two sides of pieces that are one portal. One between faces that the line has passed beside it
/// is told by its place, on one side of the line.
static bool is_twin(const sl_bsp_piece *a, size_t i, const sl_bsp_piece *b, size_t k) {
    const sl_bsp_side *s = &a->sides.items[i], *t = &b->sides.items[k];
    return t->what == SL_BEYOND_EXIT && t->beyond == SL_NO_FACE && s->joint == t->joint &&
           (s->joint || (a->passage != b->passage && a->left == b->left)) &&
           sl_same_point(s->from, sl_side_end(&b->sides, k)) &&
           sl_same_point(t->from, sl_side_end(&a->sides, i));
}

/// Joins a portal's side to the piece behind it.
static sl_status join(sl_bsp *bsp, size_t number, size_t side) {
    sl_bsp_piece *piece = &bsp->pieces.items[number];
    for (size_t n = 0; n < bsp->pieces.count; n++) {
        sl_bsp_piece *other = &bsp->pieces.items[n];
        for (size_t k = 0; n != number && k < other->sides.count; k++) {
            if (!is_twin(piece, side, other, k)) continue;
            piece->sides.items[side].beyond = other->face;
            other->sides.items[k].beyond = piece->face;
            return SL_OK;
        }
    }
    return sl_fail(bsp->context, SL_UNSUPPORTED, "a portal has lost its other side");
}

/// Gives the pieces their faces: one of each passage takes the number of the face that was.
static sl_status number_pieces(sl_bsp *bsp) {
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->faces, bsp->pieces.count));
    if (bsp->faces.count + bsp->pieces.count > INT32_MAX) return sl_fail_memory(bsp->context);
    for (size_t i = 0; i < bsp->passages.count; i++) {
        bool first = true;
        for (size_t k = 0; k < bsp->pieces.count; k++) {
            sl_bsp_piece *piece = &bsp->pieces.items[k];
            if (piece->passage != i) continue;
            piece->face = first ? bsp->passages.items[i].face : (uint32_t)bsp->faces.count;
            const uint32_t of = bsp->faces.items[bsp->passages.items[i].face].of;
            if (!first) bsp->faces.items[bsp->faces.count++] = (sl_bsp_face){.of = of};
            first = false;
        }
    }
    return SL_OK;
}

/// Puts something, a node or ~face, in a place of the tree.
static void lead(sl_bsp *bsp, sl_bsp_spot place, int32_t child) {
    if (place.node < 0)
        bsp->root = child;
    else if (place.above)
        bsp->nodes.items[place.node].above = child;
    else
        bsp->nodes.items[place.node].below = child;
}

static sl_status add_place(sl_bsp *bsp, uint32_t number, sl_bsp_spot place) {
    sl_bsp_face *face = &bsp->faces.items[number];
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &face->places, 1));
    face->places.items[face->places.count++] = place;
    lead(bsp, place, ~(int32_t)number);
    return SL_OK;
}

/// The faces' places in the tree are taken by nodes, their numbers by pieces.
static void take_faces_away(sl_bsp *bsp) {
    for (size_t i = 0; i < bsp->passages.count; i++) {
        sl_bsp_passage *passage = &bsp->passages.items[i];
        sl_bsp_face *face = &bsp->faces.items[passage->face];
        for (size_t k = 0; k < face->places.count; k++)
            lead(bsp, face->places.items[k], passage->node);
        passage->walls = face->walls;
        sl_free(bsp->context, face->places.items);
        sl_free(bsp->context, face->sides.items);
        *face = (sl_bsp_face){.of = face->of};
    }
    for (size_t i = 0; i < bsp->pieces.count; i++)
        bsp->faces.items[bsp->pieces.items[i].face].sides = bsp->pieces.items[i].sides;
    bsp->placed = true;
}

static bool has_joint(const sl_bsp_sides *sides, uint32_t joint) {
    for (size_t i = 0; i < sides->count; i++)
        if (sides->items[i].joint == joint) return true;
    return false;
}

static sl_status place_pieces(sl_bsp *bsp) {
    for (size_t i = 0; i < bsp->pieces.count; i++) {
        sl_bsp_piece *piece = &bsp->pieces.items[i];
        SL_TRY(add_place(bsp, piece->face, piece->place));
        for (size_t k = 0; k < bsp->cuts.count; k++) {
            const sl_bsp_corner_cut *cut = &bsp->cuts.items[k];
            if (cut->passage != piece->passage || cut->left != piece->left ||
                !has_joint(&piece->sides, cut->joint))
                continue;
            piece->reaches_over = true;
            SL_TRY(add_place(bsp, piece->face, cut->place));
        }
    }
    return SL_OK;
}

/// Tells the faces around which piece is beyond their portals now.
static void tell_faces_around(sl_bsp *bsp, const sl_bsp_piece *piece) {
    const uint32_t old = bsp->passages.items[piece->passage].face;
    for (size_t i = 0; i < piece->sides.count && piece->face != old; i++) {
        const sl_bsp_side *side = &piece->sides.items[i];
        if (side->what != SL_BEYOND_EXIT || side->beyond == SL_NO_FACE) continue;
        sl_bsp_face *beyond = &bsp->faces.items[side->beyond];
        const size_t twin =
            sl_bsp_find_side(beyond, sl_side_end(&piece->sides, i), side->from, old);
        if (twin != SIZE_MAX) beyond->sides.items[twin].beyond = piece->face;
    }
}

static sl_status join_pieces(sl_bsp *bsp) {
    for (size_t n = 0; n < bsp->pieces.count; n++) {
        const sl_bsp_sides *sides = &bsp->pieces.items[n].sides;
        for (size_t i = 0; i < sides->count; i++)
            if (sides->items[i].what == SL_BEYOND_EXIT && sides->items[i].beyond == SL_NO_FACE)
                SL_TRY(join(bsp, n, i));
    }
    return SL_OK;
}

sl_status sl_bsp_replace_faces(sl_bsp *bsp) {
    for (size_t i = 0; i < bsp->passages.count; i++)
        for (int out = 0; out < 2; out++)
            SL_TRY(tell_face_beyond(bsp, &bsp->passages.items[i], out));
    SL_TRY(number_pieces(bsp));
    take_faces_away(bsp);
    SL_TRY(place_pieces(bsp));
    for (size_t i = 0; i < bsp->pieces.count; i++) tell_faces_around(bsp, &bsp->pieces.items[i]);
    return join_pieces(bsp);
}
