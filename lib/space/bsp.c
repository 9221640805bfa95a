/// The BSP (auto-partition: Teller 1992, Visibility Computations in Densely Occluded Polyhedral
/// Environments): a face with walls inside is split along the line of one of them. What the corners
/// are made of is told in bsp.h.
#include "space/bsp.h"

#include "space/kd_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

sl_bsp_options sl_bsp_options_default(void) {
    return (sl_bsp_options){.cuts = 4, .imbalance = 1, .obscured = 1, .candidates = 24};
}

// --- the first face

/// What a wall covers of a side of the bounds.
typedef struct cover {
    double low, high;
    uint32_t wall;
    bool reversed;
} cover;

static int compare_covers(const void *left, const void *right) {
    const cover *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

/// A place along a side of the bounds, walked counter-clockwise from corner `number`.
static double along_border(int number, sl_point p) {
    return number == 0 ? p.x : number == 1 ? p.y : number == 2 ? -p.x : -p.y;
}

static sl_point on_border(const sl_box *b, int number, double along) {
    return number == 0   ? (sl_point){along, b->min.y}
           : number == 1 ? (sl_point){b->max.x, along}
           : number == 2 ? (sl_point){-along, b->max.y}
                         : (sl_point){b->min.x, -along};
}

static bool is_on_border(const sl_box *b, int number, sl_point p) {
    return sl_same_point(p, on_border(b, number, along_border(number, p)));
}

static sl_status add_border_side(sl_bsp *bsp, sl_bsp_face *face, int number, const cover *covers,
                                 size_t count) {
    const sl_box *b = &bsp->bounds;
    const sl_point corners[4] = {b->min, {b->max.x, b->min.y}, b->max, {b->min.x, b->max.y}};
    double at = along_border(number, corners[number]);
    const double end = along_border(number, corners[(number + 1) % 4]);
    for (size_t i = 0; i <= count; i++) {
        const double low = i < count ? covers[i].low : end;
        sl_bsp_side side = {.what = SL_BEYOND_BORDER, .beyond = SL_NO_FACE};
        if (low > at) {
            side.from = on_border(b, number, at);
            SL_TRY(sl_bsp_add_side(bsp->context, &face->sides, side));
            at = low;
        }
        if (i == count || covers[i].high <= at) continue;
        side.from = on_border(b, number, at);
        side.what = covers[i].wall;
        side.reversed = covers[i].reversed;
        SL_TRY(sl_bsp_add_side(bsp->context, &face->sides, side));
        at = covers[i].high;
    }
    return SL_OK;
}

static sl_status add_border(sl_bsp *bsp, sl_bsp_face *face, int number, cover *covers) {
    size_t count = 0;
    for (size_t i = 0; i < bsp->wall_count; i++) {
        const sl_wall *wall = &bsp->walls[i];
        if (!is_on_border(&bsp->bounds, number, wall->a) ||
            !is_on_border(&bsp->bounds, number, wall->b))
            continue;
        const double a = along_border(number, wall->a), b = along_border(number, wall->b);
        if (a != b) covers[count++] = (cover){fmin(a, b), fmax(a, b), (uint32_t)i, a > b};
    }
    if (count) qsort(covers, count, sizeof *covers, compare_covers);
    return add_border_side(bsp, face, number, covers, count);
}

/// The whole of the bounds, with the walls inside.
static sl_status make_first_face(sl_bsp *bsp) {
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->faces, 1));
    sl_bsp_face *face = &bsp->faces.items[bsp->faces.count++];
    *face = (sl_bsp_face){0};
    bsp->root = ~0;
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &face->places, 1));
    face->places.items[face->places.count++] = (sl_bsp_spot){.node = -1};
    cover *covers = sl_alloc_array(bsp->context, bsp->wall_count, sizeof *covers);
    if (!covers) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (int number = 0; number < 4 && status == SL_OK; number++)
        status = add_border(bsp, face, number, covers);
    sl_free(bsp->context, covers);
    SL_TRY(status);
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &face->walls, bsp->wall_count));
    for (size_t i = 0; i < bsp->wall_count; i++) {
        const sl_wall *wall = &bsp->walls[i];
        size_t along;
        if (!sl_same_point(wall->a, wall->b) && sl_bsp_hits(&face->sides, wall, &along))
            face->walls.items[face->walls.count++] = (uint32_t)i;
    }
    return SL_OK;
}

// --- splitting

static void forget_passages(sl_bsp *bsp) {
    for (size_t i = 0; i < bsp->passages.count; i++)
        sl_free(bsp->context, bsp->passages.items[i].walls.items);
    bsp->passages.count = 0;
}

/// What cannot be put in now may be when others have been.
static void set_aside(sl_bsp_face *face, size_t number) {
    const size_t last = face->walls.count - ++face->set_aside;
    const uint32_t wall = face->walls.items[number];
    face->walls.items[number] = face->walls.items[last];
    face->walls.items[last] = wall;
}

/// Puts the wall of that number in a face in, or sets it aside.
static sl_status put_in(sl_bsp *bsp, uint32_t face, size_t number) {
    const uint32_t wall = bsp->faces.items[face].walls.items[number];
    const size_t nodes = bsp->nodes.count, lines = bsp->lines.count;
    bool done = false, more = true;
    SL_TRY(sl_bsp_trace(bsp, face, wall));
    while (!done && more) {
        sl_bsp_drop_pieces(bsp);
        bsp->nodes.count = nodes;
        bsp->lines.count = lines;
        sl_bsp_place(bsp);
        if (bsp->unplaced) break;
        SL_TRY(sl_bsp_make_pieces(bsp, &done));
        if (!done) more = sl_bsp_try_farther(bsp);
    }
    if (!done) {
        bsp->nodes.count = nodes;
        bsp->lines.count = lines;
        forget_passages(bsp);
        set_aside(&bsp->faces.items[face], number);
        return SL_OK;
    }
    SL_TRY(sl_bsp_replace_faces(bsp));
    SL_TRY(sl_bsp_deal_walls(bsp));
    forget_passages(bsp);
    sl_bsp_drop_pieces(bsp);
    return SL_OK;
}

static sl_status wait_for(sl_bsp *bsp, uint32_t face) {
    SL_TRY(SL_ARRAY_ROOM(bsp->context, &bsp->waiting, 1));
    bsp->waiting.items[bsp->waiting.count++] = face;
    return SL_OK;
}

static sl_status split_waiting(sl_bsp *bsp) {
    while (bsp->waiting.count) {
        const uint32_t number = bsp->waiting.items[--bsp->waiting.count];
        const sl_bsp_face *face = &bsp->faces.items[number];
        if (face->walls.count == face->set_aside) continue;
        SL_TRY(sl_check_cancelled(bsp->context));
        SL_TRY(put_in(bsp, number, sl_bsp_choose(bsp, face)));
        if (!bsp->of_space) sl_report(bsp->context, "subdivide", "cells", bsp->faces.count, 0);
        face = &bsp->faces.items[number];
        if (face->walls.count > face->set_aside) SL_TRY(wait_for(bsp, number));
    }
    return SL_OK;
}

static sl_status wait_for_set_aside(sl_bsp *bsp) {
    for (uint32_t i = 0; i < bsp->faces.count; i++) {
        if (!bsp->faces.items[i].set_aside) continue;
        bsp->faces.items[i].set_aside = 0;
        SL_TRY(wait_for(bsp, i));
    }
    return SL_OK;
}

/// Tries again what was set aside or lost as long as any face is split. What is left then are walls
/// in faces of the size of rounding, which do without: sight may be added there.
sl_status sl_bsp_settle(sl_bsp *bsp) {
    SL_TRY(split_waiting(bsp));
    for (size_t before = 0; before < bsp->faces.count;) {
        before = bsp->faces.count;
        SL_TRY(wait_for_set_aside(bsp));
        SL_TRY(sl_bsp_find_lost(bsp));
        SL_TRY(split_waiting(bsp));
    }
    return SL_OK;
}

static size_t count_seams_left(const sl_bsp *bsp) {
    size_t left = 0;
    for (size_t i = 0; i < bsp->faces.count; i++)
        for (size_t k = 0; k < bsp->faces.items[i].walls.count; k++)
            left += sl_bsp_is_seam(bsp, bsp->faces.items[i].walls.items[k]);
    return left;
}

static sl_status split_all(sl_bsp *bsp, size_t seam_count) {
    SL_TRY(make_first_face(bsp));
    SL_TRY(wait_for(bsp, 0));
    SL_TRY(sl_bsp_settle(bsp));
    if (!seam_count) return SL_OK;
    SL_TRY(sl_bsp_deal_seams(bsp, seam_count));
    SL_TRY(sl_bsp_settle(bsp));
    bsp->seams_left_out = count_seams_left(bsp);
    return SL_OK;
}

void sl_bsp_destroy(sl_bsp *bsp) {
    forget_passages(bsp);
    sl_bsp_drop_pieces(bsp);
    for (size_t i = 0; i < bsp->faces.count; i++) {
        sl_free(bsp->context, bsp->faces.items[i].sides.items);
        sl_free(bsp->context, bsp->faces.items[i].places.items);
        sl_free(bsp->context, bsp->faces.items[i].walls.items);
    }
    sl_free(bsp->context, bsp->faces.items);
    sl_free(bsp->context, bsp->nodes.items);
    sl_free(bsp->context, bsp->lines.items);
    sl_free(bsp->context, bsp->waiting.items);
    sl_free(bsp->context, bsp->passages.items);
    sl_free(bsp->context, bsp->stops.items);
    sl_free(bsp->context, bsp->pieces.items);
    sl_free(bsp->context, bsp->cuts.items);
    sl_free(bsp->context, bsp->on_line.items);
    sl_free(bsp->context, bsp->along.items);
    sl_free(bsp->context, bsp->signs.items);
}

/// The map's walls, and the parts of its seams behind them.
static sl_status gather_walls(sl_context *context, const sl_map *map, const sl_seam_parts *seams,
                              sl_wall **out) {
    const size_t count = map->wall_count + seams->parts.count;
    if (count >= INT32_MAX - 1) return sl_fail_memory(context);
    sl_wall *walls = sl_alloc_array(context, count, sizeof *walls);
    if (!walls) return SL_NO_MEMORY;
    memcpy(walls, map->walls, map->wall_count * sizeof *walls);
    for (size_t i = 0; i < seams->parts.count; i++)
        walls[map->wall_count + i] =
            (sl_wall){.a = seams->parts.items[i].a, .b = seams->parts.items[i].b};
    *out = walls;
    return SL_OK;
}

static sl_status subdivide(sl_context *context, const sl_map *map, const sl_bsp_options *options,
                           const sl_seam_parts *seams, sl_space *space) {
    sl_wall *walls = NULL;
    if (seams->parts.count) SL_TRY(gather_walls(context, map, seams, &walls));
    sl_bsp bsp = {.context = context,
                  .walls = walls ? walls : map->walls,
                  .wall_count = (uint32_t)map->wall_count,
                  .options = options,
                  .bounds = space->bounds};
    sl_status status = split_all(&bsp, seams->parts.count);
    if (status == SL_OK) status = sl_bsp_make_space(&bsp, seams, space);
    if (status == SL_OK) status = sl_mark_inside(context, map, NULL, space);
    if (status == SL_OK && bsp.seams_left_out)
        sl_note(context, "rounding left no room for a seam in %zu cells: they are seen across",
                bsp.seams_left_out);
    sl_bsp_destroy(&bsp);
    sl_free(context, walls);
    return status;
}

static bool is_weight(double value) {
    return value >= 0 && isfinite(value);
}

sl_status sl_subdivide_bsp(sl_context *context, const sl_map *map, const sl_bsp_options *options,
                           sl_space *out) {
    if (!is_weight(options->cuts) || !is_weight(options->imbalance) ||
        !is_weight(options->obscured) || !options->candidates)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "the weights of a split must be finite and not negative, and one candidate "
                       "at least be tried");
    SL_TRY(sl_check_has_walls(context, map));
    if (map->wall_count >= INT32_MAX - 1) return sl_fail_memory(context);
    sl_space space = {.bounds = sl_padded(sl_map_bounds(map))};
    sl_seam_parts seams = {0};
    sl_status status = sl_seams_of_map(context, map, false, &space);
    if (status == SL_OK && space.seam_count) status = sl_seams_part(context, &space, &seams);
    if (status == SL_OK) status = subdivide(context, map, options, &seams, &space);
    sl_seam_parts_destroy(context, &seams);
    if (status == SL_OK) {
        sl_report(context, "subdivide", "cells", space.cell_count, space.cell_count);
        *out = space;
    } else
        sl_space_destroy(context, &space);
    return status;
}
