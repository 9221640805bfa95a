/// The pieces that a line leaves of the faces it passes: polygons from the chosen corners, cut
/// further where they are not convex, with the nodes that lead to them.
#include "space/bsp.h"

// --- joints

/// The part of a passage's line before its k-th stop.
static uint32_t line_joint(const sl_bsp *bsp, const sl_bsp_passage *p, size_t k) {
    return (uint32_t)(1 + p->first_stop + k + (size_t)(p - bsp->passages.items));
}

/// What a wall that passes from a passage to the next one leaves of their portal, on one side.
static uint32_t passing_joint(const sl_bsp *bsp, const sl_bsp_passage *p, bool out, bool left) {
    const size_t first = 1 + bsp->stops.count + bsp->passages.count;
    const size_t number = (size_t)(p - bsp->passages.items);
    return (uint32_t)(first + 2 * (out ? number : number - 1) + left);
}

static uint32_t diagonal_joint(const sl_bsp *bsp, uint32_t line) {
    return (uint32_t)(1 + bsp->stops.count + 3 * bsp->passages.count + line);
}

// --- polygons

static sl_status add_corner(sl_bsp *bsp, sl_bsp_sides *sides, sl_bsp_side side, sl_point to) {
    return sl_same_point(side.from, to) ? SL_OK : sl_bsp_add_side(bsp->context, sides, side);
}

bool sl_bsp_is_passage(const sl_bsp *bsp, uint32_t face) {
    for (size_t i = 0; i < bsp->passages.count; i++)
        if (bsp->passages.items[i].face == face) return true;
    return false;
}

/// What is on the line before the k-th stop.
static uint32_t part_of_line(const sl_bsp_passage *p, const sl_bsp_stop *stops, size_t k) {
    return k == 0 ? p->entry_wall : k == p->stop_count ? p->exit_wall : stops[k - 1].wall;
}

/// The sides along the line, on its left in its direction, on its right against it.
static sl_status add_line_sides(sl_bsp *bsp, const sl_bsp_passage *p, bool left,
                                sl_bsp_sides *out) {
    const sl_bsp_stop *stops = bsp->stops.items + p->first_stop;
    const size_t count = p->stop_count;
    const bool spare = p->failures[left] >= SL_BSP_PATIENCE;
    for (size_t i = 0; i <= count; i++) {
        size_t k = left ? i : count - i; // the k-th part ends in stop k
        sl_point low = k ? stops[k - 1].at : left ? p->entry_left : p->entry_right;
        sl_point high = k < count ? stops[k].at : left ? p->exit_left : p->exit_right;
        const uint32_t what = part_of_line(p, stops, k);
        while (spare && i < count && sl_bsp_is_wall(bsp, what) &&
               sl_bsp_is_wall(bsp, part_of_line(p, stops, left ? k + 1 : k - 1))) {
            k = left ? k + 1 : k - 1;
            i++;
            if (left)
                high = k < count ? stops[k].at : p->exit_left;
            else
                low = k ? stops[k - 1].at : p->entry_right;
        }
        sl_bsp_side side = {.from = left ? low : high, .what = what, .beyond = SL_NO_FACE};
        if (sl_bsp_is_seam(bsp, what)) {
            side.what = SL_BEYOND_EXIT;
            side.seam = (what - bsp->wall_count + 1) & INT32_MAX;
        }
        if (side.what == SL_BEYOND_EXIT) side.joint = line_joint(bsp, p, k);
        if (sl_bsp_is_wall(bsp, what)) {
            const sl_wall *wall = &bsp->walls[what];
            side.reversed = (sl_bsp_key(bsp, wall->a) < sl_bsp_key(bsp, wall->b)) != left;
        }
        SL_TRY(add_corner(bsp, out, side, left ? high : low));
    }
    return SL_OK;
}

/// What one side of the line leaves of a face.
static sl_status make_polygon(sl_bsp *bsp, const sl_bsp_passage *p, bool left, sl_bsp_sides *out) {
    const sl_bsp_sides *sides = &bsp->faces.items[p->face].sides;
    const sl_bsp_crossing *start = left ? &p->exit : &p->entry;
    const sl_bsp_crossing *stop = left ? &p->entry : &p->exit;
    const sl_point from = left ? p->exit_left : p->entry_right;
    const sl_point to = left ? p->entry_left : p->exit_right;
    SL_TRY(add_line_sides(bsp, p, left, out));
    for (size_t i = start->side;; i = i + 1 == sides->count ? 0 : i + 1) {
        if (i == stop->side && stop->at_corner) break;
        sl_bsp_side side = sides->items[i];
        if (i == start->side) side.from = from;
        side.joint = 0;
        if (side.beyond != SL_NO_FACE && sl_bsp_is_passage(bsp, side.beyond))
            side.beyond = SL_NO_FACE;
        if (i == start->side && start->passes) side.joint = passing_joint(bsp, p, left, left);
        if (i == stop->side && stop->passes) side.joint = passing_joint(bsp, p, !left, left);
        SL_TRY(add_corner(bsp, out, side, i == stop->side ? to : sl_side_end(sides, i)));
        if (i == stop->side) break;
    }
    return SL_OK;
}

// --- convex pieces

static void lead(sl_bsp *bsp, sl_bsp_spot place, int32_t child) {
    if (place.node < 0) return; // the place of a face: it is kept until all pieces are made
    sl_node *parent = &bsp->nodes.items[place.node];
    *(place.above ? &parent->above : &parent->below) = child;
}

static sl_status add_node(sl_bsp *bsp, sl_bsp_spot place, uint32_t line, int32_t *node) {
    if (bsp->nodes.count == INT32_MAX || bsp->lines.count > INT32_MAX)
        return sl_fail_memory(bsp->context);
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->nodes, 1));
    *node = (int32_t)bsp->nodes.count;
    bsp->nodes.items[bsp->nodes.count++] = (sl_node){.axis = 2, .line = (int32_t)line};
    lead(bsp, place, *node);
    return SL_OK;
}

static sl_status add_line(sl_bsp *bsp, sl_point a, sl_point b, uint32_t *line) {
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->lines, 1));
    *line = (uint32_t)bsp->lines.count;
    bsp->lines.items[bsp->lines.count++] = (sl_segment){a, b};
    return SL_OK;
}

static sl_status add_piece(sl_bsp *bsp, sl_bsp_piece piece) {
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->pieces, 1));
    bsp->pieces.items[bsp->pieces.count++] = piece;
    return SL_OK;
}

/// Corners from .. to of a polygon, closed by a portal.
static sl_status copy_part(sl_bsp *bsp, const sl_bsp_sides *sides, size_t from, size_t to,
                           uint32_t joint, sl_bsp_sides *out) {
    for (size_t i = from; i != to; i = i + 1 == sides->count ? 0 : i + 1)
        SL_TRY(sl_bsp_add_side(bsp->context, out, sides->items[i]));
    const sl_bsp_side last = {.from = sides->items[to].from,
                              .what = SL_BEYOND_EXIT,
                              .beyond = SL_NO_FACE,
                              .joint = joint};
    return sl_bsp_add_side(bsp->context, out, last);
}

/// Cuts a piece along a diagonal: what is right of it stays in its place, the rest is added.
static sl_status cut_piece(sl_bsp *bsp, size_t number, size_t from, size_t to) {
    sl_bsp_piece piece = bsp->pieces.items[number], other = piece;
    uint32_t line;
    SL_TRY(add_line(bsp, piece.sides.items[from].from, piece.sides.items[to].from, &line));
    SL_TRY(add_node(bsp, piece.place, line, &other.place.node));
    other.place.above = true;
    other.sides = (sl_bsp_sides){0};
    sl_bsp_sides below = {0};
    const uint32_t joint = diagonal_joint(bsp, line);
    sl_status status = copy_part(bsp, &piece.sides, to, from, joint, &other.sides);
    if (status == SL_OK) status = copy_part(bsp, &piece.sides, from, to, joint, &below);
    if (status == SL_OK) status = add_piece(bsp, other);
    if (status != SL_OK) {
        sl_free(bsp->context, other.sides.items);
        sl_free(bsp->context, below.items);
        return status;
    }
    sl_bsp_piece *mine = &bsp->pieces.items[number];
    sl_free(bsp->context, mine->sides.items);
    mine->sides = below;
    mine->place = (sl_bsp_spot){.node = other.place.node, .above = false};
    return SL_OK;
}

/// Cuts pieces until all are convex; *done is false where that cannot be.
static sl_status make_convex(sl_bsp *bsp, bool *done) {
    *done = false;
    for (size_t i = 0; i < bsp->pieces.count;) {
        const sl_bsp_sides *sides = &bsp->pieces.items[i].sides;
        size_t from, to;
        if (sl_bsp_convex(sides)) {
            i++;
            continue;
        }
        if (sides->count < 4 || !sl_bsp_diagonal(sides, &from, &to)) {
            bsp->failed_passage = bsp->pieces.items[i].passage;
            bsp->failed_left = bsp->pieces.items[i].left;
            return SL_OK;
        }
        SL_TRY(cut_piece(bsp, i, from, to));
    }
    *done = true;
    return SL_OK;
}

void sl_bsp_drop_pieces(sl_bsp *bsp) {
    for (size_t i = 0; i < bsp->pieces.count && !bsp->placed; i++)
        sl_free(bsp->context, bsp->pieces.items[i].sides.items);
    bsp->pieces.count = 0;
    bsp->placed = false;
}

/// Where the line ends in a corner on this side, what lies between the two is cut off: it is part
/// of a piece of the other side.
static sl_status cut_corner(sl_bsp *bsp, const sl_bsp_passage *p, bool out, sl_bsp_piece *piece) {
    const sl_bsp_crossing *c = out ? &p->exit : &p->entry;
    const bool is_new = out ? p->exit_new : p->entry_new;
    if (c->at_corner || c->walled || is_new) return SL_OK;
    const sl_point corner = out ? p->exit_left : p->entry_left;
    if (sl_orient(bsp->a, bsp->b, corner) * (piece->left ? 1 : -1) < 0) return SL_OK;
    const sl_bsp_stop *stops = bsp->stops.items + p->first_stop;
    const sl_point stop = stops[out ? p->stop_count - 1 : 0].at;
    uint32_t line;
    int32_t node;
    SL_TRY(out ? add_line(bsp, stop, corner, &line) : add_line(bsp, corner, stop, &line));
    SL_TRY(add_node(bsp, piece->place, line, &node));
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->cuts, 1));
    bsp->cuts.items[bsp->cuts.count++] =
        (sl_bsp_corner_cut){.place = {.node = node, .above = !piece->left},
                            .passage = piece->passage,
                            .joint = line_joint(bsp, p, out ? p->stop_count : 0),
                            .left = !piece->left};
    piece->place = (sl_bsp_spot){.node = node, .above = piece->left};
    return SL_OK;
}

sl_status sl_bsp_make_pieces(sl_bsp *bsp, bool *done) {
    uint32_t line;
    bsp->cuts.count = 0;
    SL_TRY(add_line(bsp, bsp->a, bsp->b, &line));
    for (size_t i = 0; i < bsp->passages.count; i++) {
        sl_bsp_passage *passage = &bsp->passages.items[i];
        SL_TRY(add_node(bsp, (sl_bsp_spot){.node = -1}, line, &passage->node));
        for (int left = 0; left < 2; left++) {
            sl_bsp_piece piece = {.place = {.node = passage->node, .above = left},
                                  .passage = (uint32_t)i,
                                  .left = left};
            for (int out = 0; out < 2; out++) SL_TRY(cut_corner(bsp, passage, out, &piece));
            SL_TRY(add_piece(bsp, piece));
            sl_bsp_piece *added = &bsp->pieces.items[bsp->pieces.count - 1];
            SL_TRY(make_polygon(bsp, passage, left, &added->sides));
        }
    }
    return make_convex(bsp, done);
}
