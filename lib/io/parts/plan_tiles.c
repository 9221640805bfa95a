/// Tiles are many boxes of one size, each a piece of its own, with a narrow joint to the next one
/// in its row and in its column. Walls cut some of them:
///
///     +---+ +---+ +--|
///     |   | |   | |  |      The cut one is as high as the others, has the joint beside a tile, and
///     +---+ +---+ +--|      is smaller. Its fourth side may be missing.
///     +---+ +---+ +--|
///     |   | |   | |  |
///
/// Rooms without doors that are drawn by their inner faces are boxes in rows, too. But they are
/// fewer, larger, and walls between them are thicker than a joint.
///
/// Time O(n log n).
#include "io/parts/plan_tiles.h"

#include <stdlib.h>

enum {
    LEAST_TILES = 48, ///< fewer are no floor
    MOST_LINES = 8,   ///< of a tile that is cut
    PASSES = 8        ///< a cut tile may be beside cut ones only
};
/// The largest tile, as a share of the drawing; the widest joint and how much tiles differ, as
/// shares of a tile.
static const double LARGEST = 1.0 / 12, JOINT = 0.02, SAME = 0.01;

/// Of a piece, by its first wall.
typedef struct cover {
    double sides[4]; ///< how much is drawn of the sides of its box: left, right, below, above
    bool inside;     ///< something is drawn in the box
    bool tile;
    double row_joint, column_joint; ///< to the tile beside it in its row and column; 0: none
} cover;

typedef struct sized {
    double area;
    uint32_t piece;
} sized;

typedef struct finder {
    sli_plan_net *net;
    cover *covers;
    sized *boxes; ///< the pieces that are closed boxes
    size_t count;
    double width, height; ///< of a tile
    sl_bits *tiles;       ///< what is found, by wall
} finder;

static sl_box box_of(const finder *f, uint32_t piece) {
    return f->net->boxes[piece];
}

static bool is_first(const finder *f, uint32_t wall) {
    return sl_root_of(f->net->piece, wall) == wall;
}

// --- boxes

static void cover_side(finder *f, uint32_t wall) {
    const uint32_t piece = sl_root_of(f->net->piece, wall);
    const sl_wall *w = &f->net->map->walls[wall];
    const sl_box box = box_of(f, piece);
    const double away[4] = {fmax(fabs(w->a.x - box.min.x), fabs(w->b.x - box.min.x)),
                            fmax(fabs(w->a.x - box.max.x), fabs(w->b.x - box.max.x)),
                            fmax(fabs(w->a.y - box.min.y), fabs(w->b.y - box.min.y)),
                            fmax(fabs(w->a.y - box.max.y), fabs(w->b.y - box.max.y))};
    int side = 0;
    while (side < 4 && away[side] > f->net->tolerance) side++;
    if (side < 4)
        f->covers[piece].sides[side] += sli_length(w->b.x - w->a.x, w->b.y - w->a.y);
    else
        f->covers[piece].inside = true;
}

static int compare_boxes(const void *left, const void *right) {
    const sized *a = left, *b = right;
    if (a->area != b->area) return a->area < b->area ? -1 : 1;
    return (a->piece > b->piece) - (a->piece < b->piece);
}

/// Finds the closed boxes that are small enough, the smallest first.
static void find_boxes(finder *f) {
    const uint32_t count = (uint32_t)f->net->map->wall_count;
    for (uint32_t i = 0; i < count; i++) cover_side(f, i);
    for (uint32_t i = 0; i < count; i++) {
        const cover *own = &f->covers[i];
        const double w = sli_box_width(box_of(f, i)), h = sli_box_height(box_of(f, i));
        if (!is_first(f, i) || own->inside || fmax(w, h) > LARGEST * f->net->size) continue;
        if (!(fmin(w, h) > 0) || fmin(own->sides[0], own->sides[1]) < (1 - SAME) * h ||
            fmin(own->sides[2], own->sides[3]) < (1 - SAME) * w)
            continue;
        f->boxes[f->count++] = (sized){w * h, i};
    }
    if (f->count) qsort(f->boxes, f->count, sizeof *f->boxes, compare_boxes);
}

/// Takes the commonest size for that of tiles.
static void find_size(finder *f) {
    size_t most = 0, middle = 0;
    for (size_t i = 0, end = 0; i < f->count; i++) {
        while (end < f->count && f->boxes[end].area <= (1 + 2 * SAME) * f->boxes[i].area) end++;
        if (end - i <= most) continue;
        most = end - i;
        middle = i + most / 2;
    }
    if (most < LEAST_TILES) return;
    f->width = sli_box_width(box_of(f, f->boxes[middle].piece));
    f->height = sli_box_height(box_of(f, f->boxes[middle].piece));
    for (size_t i = 0; i < f->count; i++) {
        const sl_box box = box_of(f, f->boxes[i].piece);
        f->covers[f->boxes[i].piece].tile =
            fabs(sli_box_width(box) - f->width) <= SAME * f->width &&
            fabs(sli_box_height(box) - f->height) <= SAME * f->height;
    }
}

// --- rows and columns

/// Whether a tile is beside a box in its row, at a joint: `joint` is how far it is away. `cut`: one
/// edge in common is enough.
static bool are_beside(const finder *f, double joint, double low, double other_low, double high,
                       double other_high, bool upright, bool cut) {
    const double size = upright ? f->height : f->width, across = upright ? f->width : f->height;
    const bool lows = fabs(low - other_low) <= SAME * across;
    const bool highs = fabs(high - other_high) <= SAME * across;
    return joint > 0 && joint <= JOINT * size && (cut ? lows || highs : lows && highs);
}

/// Looks for a tile at one side of a piece.
static sl_status look_at_side(finder *f, uint32_t piece, int side, bool cut) {
    const sl_box box = box_of(f, piece);
    const bool upright = side >= 2;
    sl_point at = {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2};
    if (upright)
        at.y = side == 2 ? box.min.y : box.max.y;
    else
        at.x = side == 0 ? box.min.x : box.max.x;
    const double reach = JOINT * (upright ? f->height : f->width);
    SL_TRY(sli_walls_near(f->net->context, &f->net->index, (sl_segment){at, at}, reach));
    for (size_t i = 0; i < f->net->index.near.count; i++) {
        const uint32_t other = sl_root_of(f->net->piece, f->net->index.near.items[i]);
        const sl_box o = box_of(f, other);
        if (other == piece || !f->covers[other].tile) continue;
        const double joints[4] = {box.min.x - o.max.x, o.min.x - box.max.x, box.min.y - o.max.y,
                                  o.min.y - box.max.y};
        const bool beside =
            upright
                ? are_beside(f, joints[side], box.min.x, o.min.x, box.max.x, o.max.x, true, cut)
                : are_beside(f, joints[side], box.min.y, o.min.y, box.max.y, o.max.y, false, cut);
        if (!beside) continue;
        *(upright ? &f->covers[piece].column_joint : &f->covers[piece].row_joint) = joints[side];
    }
    return SL_OK;
}

static sl_status look_around(finder *f, uint32_t piece, bool cut) {
    for (int side = 0; side < 4; side++) SL_TRY(look_at_side(f, piece, side, cut));
    return SL_OK;
}

/// Leaves the tiles that have one beside them; none, if too few lie in rows and columns.
static sl_status find_rows(finder *f) {
    size_t inner = 0;
    for (size_t i = 0; i < f->count; i++) {
        const uint32_t piece = f->boxes[i].piece;
        if (f->covers[piece].tile) SL_TRY(look_around(f, piece, false));
        inner += f->covers[piece].row_joint > 0 && f->covers[piece].column_joint > 0;
    }
    for (size_t i = 0; i < f->count; i++) {
        cover *own = &f->covers[f->boxes[i].piece];
        own->tile &= inner >= LEAST_TILES && (own->row_joint > 0 || own->column_joint > 0);
    }
    return SL_OK;
}

/// Whether a piece may be what is left of a tile: no line is in it, and it is no larger.
static bool may_be_cut(const finder *f, uint32_t piece) {
    const sl_box box = box_of(f, piece);
    return is_first(f, piece) && !f->covers[piece].tile && !f->covers[piece].inside &&
           f->net->counts[piece] <= MOST_LINES && f->net->counts[piece] > 1 &&
           sli_box_width(box) <= (1 + SAME) * f->width &&
           sli_box_height(box) <= (1 + SAME) * f->height;
}

/// Adds the tiles that are cut.
static sl_status find_cut(finder *f) {
    bool any = true;
    for (int pass = 0; pass < PASSES && any; pass++) {
        any = false;
        for (uint32_t i = 0; i < f->net->map->wall_count; i++) {
            if (!may_be_cut(f, i)) continue;
            SL_TRY(look_around(f, i, true));
            f->covers[i].tile = f->covers[i].row_joint > 0 || f->covers[i].column_joint > 0;
            any |= f->covers[i].tile;
        }
    }
    return SL_OK;
}

// --- tiles that are joined with other lines

/// Where tiles begin along an axis, and how far it is from one to the next.
typedef struct lattice {
    double from, size, pitch;
    double low, high; ///< of all tiles
} lattice;

static double low_of(sl_box box, bool y) {
    return y ? box.min.y : box.min.x;
}

/// The lattice of an axis; its pitch is 0 where no joint was found.
static lattice find_lattice(const finder *f, bool y) {
    const double size = y ? f->height : f->width;
    lattice out = {NAN, size, 0, INFINITY, -INFINITY};
    double steps = 0, count = 0;
    for (size_t i = 0; i < f->count; i++) {
        const cover *own = &f->covers[f->boxes[i].piece];
        const double low = low_of(box_of(f, f->boxes[i].piece), y);
        if (!own->tile) continue;
        if (isnan(out.from)) out.from = low;
        out.low = fmin(out.low, low);
        out.high = fmax(out.high, low + size);
        const double joint = y ? own->column_joint : own->row_joint;
        steps += joint;
        count += joint > 0;
    }
    if (count > 0) out.pitch = size + steps / count;
    return out;
}

/// How far a place is behind the begin of the tile at it, or of the joint before that.
static double behind(const lattice *of, double at) {
    const double joint = of->pitch - of->size;
    return at - of->from - floor((at - of->from + joint / 2) / of->pitch) * of->pitch;
}

/// Whether a line is at the sides of tiles, or of those next to them, and no longer than one.
static bool is_side(const lattice *along, const lattice *across, double from, double to,
                    double at) {
    const double near = (across->pitch - across->size) / 2, length = to - from;
    const double begin = behind(along, from), side = behind(across, at);
    return at >= across->low - across->pitch && at <= across->high + across->pitch &&
           from >= along->low - along->pitch && to <= along->high + along->pitch &&
           fmin(fabs(side), fabs(side - across->size)) <= near && length >= along->size / 2 &&
           begin + length <= along->size + (along->pitch - along->size) / 2;
}

/// Takes the sides of tiles out of larger pieces: lines of at most the length of a tile, where the
/// sides of tiles in their row or column are.
static void find_sides(finder *f) {
    const lattice x = find_lattice(f, false), y = find_lattice(f, true);
    if (!(x.pitch > 0) || !(y.pitch > 0)) return;
    for (uint32_t i = 0; i < f->net->map->wall_count; i++) {
        const sl_wall *w = &f->net->map->walls[i];
        const sl_box box = sli_box_around(w->a, w->b);
        if ((sli_box_height(box) <= f->net->tolerance &&
             is_side(&x, &y, box.min.x, box.max.x, box.min.y)) ||
            (sli_box_width(box) <= f->net->tolerance &&
             is_side(&y, &x, box.min.y, box.max.y, box.min.x)))
            sl_bits_add(f->tiles, i);
    }
}

static sl_status find_all(finder *f) {
    find_boxes(f);
    find_size(f);
    if (!(f->width > 0)) return SL_OK;
    SL_TRY(find_rows(f));
    SL_TRY(find_cut(f));
    for (uint32_t i = 0; i < f->net->map->wall_count; i++)
        if (f->covers[sl_root_of(f->net->piece, i)].tile) sl_bits_add(f->tiles, i);
    find_sides(f);
    return SL_OK;
}

sl_status sli_plan_tiles_find(sli_plan_net *net, sl_bits *tiles, size_t *count) {
    const size_t walls = net->map->wall_count;
    finder f = {.net = net, .tiles = tiles};
    *count = 0;
    if (!net->whole || walls < 4 * LEAST_TILES) return SL_OK;
    f.covers = sl_alloc_array(net->context, walls, sizeof *f.covers);
    f.boxes = sl_alloc_array(net->context, walls, sizeof *f.boxes);
    const sl_status status = f.covers && f.boxes ? find_all(&f) : SL_NO_MEMORY;
    for (uint32_t i = 0; i < walls && status == SL_OK; i++) *count += sl_bits_has(tiles, i);
    sl_free(net->context, f.covers);
    sl_free(net->context, f.boxes);
    return status;
}
