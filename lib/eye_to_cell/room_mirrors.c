#include "sightline/mirrored.h"

#include "effects/mirrors.h"
#include "geometry/orient.h"
#include "sightline/support.h"

typedef struct finder {
    sl_context *context;
    const sl_outline *outline;
    const sl_map *map;
    SL_ARRAY(sl_room_mirror) pieces;
} finder;

/// Adds a piece but for what pieces from number `at` on, of the same side, have of it already.
static sl_status add_new(finder *f, size_t at, sl_room_mirror piece) {
    const sl_point from = piece.right, to = piece.left;
    for (; at < f->pieces.count; at++) {
        const sl_room_mirror have = f->pieces.items[at];
        const double right = sl_mirror_along(from, to, have.right);
        const double left = sl_mirror_along(from, to, have.left);
        if (left <= sl_mirror_along(from, to, from) || right >= sl_mirror_along(from, to, to))
            continue;
        if (right > sl_mirror_along(from, to, from))
            SL_TRY(add_new(f, at + 1, (sl_room_mirror){from, have.right, piece.mirror}));
        if (left < sl_mirror_along(from, to, to))
            SL_TRY(add_new(f, at + 1, (sl_room_mirror){have.left, to, piece.mirror}));
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->pieces, 1));
    f->pieces.items[f->pieces.count++] = piece;
    return SL_OK;
}

/// Adds the mirrors on a side that is a wall.
static sl_status add_side(finder *f, const sl_side *side) {
    const sl_wall *wall = &f->outline->space->walls[side->neighbour - SL_SIDE_WALL];
    const size_t first = f->pieces.count;
    for (uint32_t i = 0; i < f->map->mirror_count; i++) {
        const sl_glass *mirror = &f->map->mirrors[i];
        const sl_segment *at = &mirror->segment;
        sl_room_mirror piece = {.mirror = i};
        if (sl_orient(wall->a, wall->b, at->a) != 0 || sl_orient(wall->a, wall->b, at->b) != 0 ||
            !sl_mirror_covers(mirror, side->start, f->outline->sides[side->next].start,
                              &piece.right, &piece.left))
            continue;
        SL_TRY(add_new(f, first, piece));
    }
    return SL_OK;
}

static sl_status find(finder *f, uint32_t *first) {
    for (uint32_t i = 0; i < f->outline->side_count; i++) {
        const sl_side *side = &f->outline->sides[i];
        first[i] = (uint32_t)f->pieces.count;
        if (i % 4096 == 0) SL_TRY(sl_check_cancelled(f->context));
        if (side->neighbour >= SL_SIDE_WALL && side->neighbour < SL_SIDE_BORDER)
            SL_TRY(add_side(f, side));
    }
    first[f->outline->side_count] = (uint32_t)f->pieces.count;
    return SL_OK;
}

sl_status sl_room_mirrors_make(sl_context *context, const sl_outline *outline, const sl_map *map,
                               sl_room_mirrors *out) {
    finder f = {.context = context, .outline = outline, .map = map};
    uint32_t *first = sl_alloc_array(context, (size_t)outline->side_count + 1, sizeof *first);
    const sl_status status = first ? find(&f, first) : SL_NO_MEMORY;
    if (status == SL_OK) {
        *out = (sl_room_mirrors){outline, map, first, f.pieces.items};
        return SL_OK;
    }
    sl_free(context, f.pieces.items);
    sl_free(context, first);
    return status;
}

void sl_room_mirrors_destroy(sl_context *context, sl_room_mirrors *mirrors) {
    sl_free(context, mirrors->first);
    sl_free(context, mirrors->pieces);
    *mirrors = (sl_room_mirrors){0};
}
