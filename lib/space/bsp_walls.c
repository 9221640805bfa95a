/// Walls that were inside faces go to the pieces that they have a point inside of. A wall exactly
/// on a portal is inside none: it closes the portal. One that rounding has left outside all pieces
/// of its face, as a portal was moved, goes to the faces around.
#include "space/bsp.h"

bool sl_bsp_has_wall(const sl_bsp_face *face, uint32_t wall) {
    for (size_t i = 0; i < face->walls.count; i++)
        if (face->walls.items[i] == wall) return true;
    return false;
}

sl_status sl_bsp_add_wall(sl_bsp *bsp, uint32_t number, uint32_t wall) {
    sl_bsp_face *face = &bsp->faces.items[number];
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &face->walls, 1));
    face->walls.items[face->walls.count++] = wall;
    if (face->walls.count > 1) return SL_OK;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->waiting, 1));
    bsp->waiting.items[bsp->waiting.count++] = number;
    return SL_OK;
}

// --- walls on portals

/// Puts a corner into a portal's side and its twin. The side that ends there keeps its number.
static sl_status split_portal(sl_bsp *bsp, uint32_t number, size_t side, sl_point at) {
    sl_bsp_face *face = &bsp->faces.items[number];
    const sl_point from = face->sides.items[side].from, to = sl_side_end(&face->sides, side);
    sl_bsp_face *beyond = &bsp->faces.items[face->sides.items[side].beyond];
    const size_t twin = sl_bsp_find_side(beyond, to, from, number);
    SL_TRY(sl_bsp_insert_corner(bsp->context, beyond, twin, at));
    return sl_bsp_insert_corner(bsp->context, face, side, at);
}

/// Whether c is before d on the way from a to b; all are in line.
static bool is_before(sl_point a, sl_point b, sl_point c, sl_point d) {
    if (a.x != b.x) return a.x < b.x ? c.x < d.x : c.x > d.x;
    return a.y < b.y ? c.y < d.y : c.y > d.y;
}

static void set_wall(sl_bsp_side *side, const sl_wall *wall, uint32_t number, sl_point to) {
    *side = (sl_bsp_side){.from = side->from,
                          .what = number,
                          .beyond = SL_NO_FACE,
                          .reversed = is_before(wall->b, wall->a, side->from, to)};
}

/// Makes a wall of what a wall covers of a portal that it is in line with; a part of a seam only
/// marks it.
static sl_status close_portal(sl_bsp *bsp, uint32_t number, size_t side, uint32_t wall_number) {
    const sl_wall *wall = &bsp->walls[wall_number];
    const sl_bsp_sides *sides = &bsp->faces.items[number].sides;
    const sl_point from = sides->items[side].from, to = sl_side_end(sides, side);
    const bool forward = is_before(from, to, wall->a, wall->b);
    const sl_point low = forward ? wall->a : wall->b, high = forward ? wall->b : wall->a;
    if (!is_before(from, to, low, to) || !is_before(from, to, from, high)) return SL_OK;
    if (is_before(from, to, high, to)) SL_TRY(split_portal(bsp, number, side, high));
    if (is_before(from, to, from, low)) {
        SL_TRY(split_portal(bsp, number, side, low));
        side++;
    }
    sl_bsp_face *face = &bsp->faces.items[number];
    sl_bsp_side *mine = &face->sides.items[side];
    sl_bsp_face *beyond = &bsp->faces.items[mine->beyond];
    const sl_point start = mine->from, end = sl_side_end(&face->sides, side);
    const size_t twin = sl_bsp_find_side(beyond, end, start, number);
    if (sl_bsp_is_seam(bsp, wall_number)) {
        mine->seam = (wall_number - bsp->wall_count + 1) & INT32_MAX;
        beyond->sides.items[twin].seam = mine->seam;
        return SL_OK;
    }
    set_wall(mine, wall, wall_number, end);
    set_wall(&beyond->sides.items[twin], wall, wall_number, start);
    return SL_OK;
}

sl_status sl_bsp_close_portals(sl_bsp *bsp, uint32_t number, uint32_t wall_number) {
    const sl_wall *wall = &bsp->walls[wall_number];
    for (size_t i = 0; i < bsp->faces.items[number].sides.count; i++) {
        const sl_bsp_sides *sides = &bsp->faces.items[number].sides;
        if (sides->items[i].what == SL_BEYOND_EXIT &&
            sl_orient(wall->a, wall->b, sides->items[i].from) == 0 &&
            sl_orient(wall->a, wall->b, sl_side_end(sides, i)) == 0)
            SL_TRY(close_portal(bsp, number, i, wall_number));
    }
    return SL_OK;
}

// --- dealing out

/// Of walls that no piece takes: to the faces beyond the portals of the pieces.
static sl_status deal_around(sl_bsp *bsp, uint32_t passage, uint32_t wall) {
    for (size_t k = 0; k < bsp->pieces.count; k++) {
        if (bsp->pieces.items[k].passage != passage) continue;
        const sl_bsp_sides *sides = &bsp->faces.items[bsp->pieces.items[k].face].sides;
        for (size_t i = 0; i < sides->count; i++) {
            const uint32_t beyond = sides->items[i].beyond;
            size_t along;
            if (sides->items[i].what == SL_BEYOND_EXIT &&
                sl_bsp_hits(&bsp->faces.items[beyond].sides, &bsp->walls[wall], &along) &&
                !sl_bsp_has_wall(&bsp->faces.items[beyond], wall))
                SL_TRY(sl_bsp_add_wall(bsp, beyond, wall));
        }
    }
    return SL_OK;
}

static sl_status deal(sl_bsp *bsp, uint32_t passage, uint32_t number) {
    const sl_wall *wall = &bsp->walls[number];
    const int a = sl_orient(bsp->a, bsp->b, wall->a), b = sl_orient(bsp->a, bsp->b, wall->b);
    if (a == 0 && b == 0) return SL_OK; // it is put in
    bool taken = false;
    for (size_t k = 0; k < bsp->pieces.count; k++) {
        const sl_bsp_piece *piece = &bsp->pieces.items[k];
        const bool beside = piece->left ? a <= 0 && b <= 0 : a >= 0 && b >= 0;
        if (piece->passage != passage || (beside && !piece->reaches_over)) continue;
        size_t along;
        if (sl_bsp_hits(&bsp->faces.items[piece->face].sides, wall, &along)) {
            SL_TRY(sl_bsp_add_wall(bsp, piece->face, number));
            taken = true;
        }
        if (along == SIZE_MAX) continue;
        SL_TRY(sl_bsp_close_portals(bsp, piece->face, number));
        taken = true;
    }
    return taken ? SL_OK : deal_around(bsp, passage, number);
}

sl_status sl_bsp_deal_walls(sl_bsp *bsp) {
    for (uint32_t i = 0; i < bsp->passages.count; i++) {
        const sl_bsp_walls *walls = &bsp->passages.items[i].walls;
        for (size_t k = 0; k < walls->count; k++) SL_TRY(deal(bsp, i, walls->items[k]));
    }
    return SL_OK;
}
