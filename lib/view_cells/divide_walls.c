/// Splits along the walls' own lines.
#include "view_cells/divide.h"

#include "geometry/orient.h"

#include <math.h>

/// Walls that reach into a part by no more than this share of their length do so by rounding.
#define SLIVER 1e-9

/// Whether a wall lies on the line of one of the splits that bound a part.
static bool is_on_border(const sl_view_divider *d, const sl_view_part *part, const sl_wall *wall) {
    for (size_t i = 0; i < part->edges.count; i++) {
        if (part->edges.items[i] == UINT32_MAX) continue;
        const sl_view_node *node = &d->nodes.items[part->edges.items[i]];
        if (node->axis < 2) continue;
        const sl_segment *l = &d->lines.items[node->line];
        if (sl_orient(l->a, l->b, wall->a) == 0 && sl_orient(l->a, l->b, wall->b) == 0) return true;
    }
    return false;
}

/// Whether a wall goes inside a part. Rounded: it only says what is worth trying.
static bool goes_into(const sl_view_part *part, const sl_wall *wall) {
    double t0 = 0, t1 = 1;
    const double dx = wall->b.x - wall->a.x, dy = wall->b.y - wall->a.y;
    for (size_t i = 0; i < part->corners.count; i++) {
        const sl_point a = part->corners.items[i];
        const sl_point b = part->corners.items[i + 1 < part->corners.count ? i + 1 : 0];
        const double nx = b.y - a.y, ny = a.x - b.x; // outwards
        const double from = nx * (wall->a.x - a.x) + ny * (wall->a.y - a.y);
        const double by = nx * dx + ny * dy;
        if (by == 0 && from >= 0) return false;
        if (by > 0) t1 = fmin(t1, -from / by);
        if (by < 0) t0 = fmax(t0, -from / by);
    }
    return t1 - t0 > SLIVER;
}

/// Whether the split leaves corners of the part strictly on both sides.
static bool divides(const sl_view_part *part, const sl_view_split *split) {
    bool below = false, above = false;
    for (size_t i = 0; i < part->corners.count; i++) {
        const double side = sl_view_side(split, part->corners.items[i]);
        below = below || side < 0;
        above = above || side > 0;
    }
    return below && above;
}

sl_view_split sl_view_split_along(const sl_wall *wall) {
    if (wall->a.x == wall->b.x) return (sl_view_split){.axis = 0, .position = wall->a.x};
    if (wall->a.y == wall->b.y) return (sl_view_split){.axis = 1, .position = wall->a.y};
    return (sl_view_split){.axis = 2, .line = {wall->a, wall->b}};
}

sl_status sl_view_walls_within(sl_view_divider *d, const sl_view_part *part, uint32_t most,
                               sl_view_numbers *out) {
    const sl_space *space = d->scene->space;
    const sl_box *box = &part->box;
    out->count = 0;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        if (fmax(w->a.x, w->b.x) < box->min.x || fmin(w->a.x, w->b.x) > box->max.x ||
            fmax(w->a.y, w->b.y) < box->min.y || fmin(w->a.y, w->b.y) > box->max.y ||
            !goes_into(part, w) || is_on_border(d, part, w))
            continue;
        const sl_view_split split = sl_view_split_along(w);
        if (!divides(part, &split)) continue;
        SL_TRY(SL_ARRAY_ROOM(d->context, out, 1));
        out->items[out->count++] = i;
    }
    for (size_t i = 0; i < most && most < out->count; i++) {
        const size_t k = i + (size_t)sl_random_below(&d->random, out->count - i);
        const uint32_t swap = out->items[i];
        out->items[i] = out->items[k];
        out->items[k] = swap;
    }
    if (out->count > most) out->count = most;
    return SL_OK;
}

static sl_status clip_all(sl_view_divider *d, const sl_view_part *part) {
    SL_TRY(SL_ARRAY_ROOM(d->context, &d->clipped, part->segments.count));
    const size_t step = sl_view_step(d, part);
    for (size_t i = 0; i < part->segments.count; i += step)
        d->clipped.items[i] = sl_view_part_clip(part, &d->segments->items[part->segments.items[i]]);
    return SL_OK;
}

/// Marks the objects that are seen on either side of a split.
static void mark_sides(sl_view_divider *d, const sl_view_part *part, const sl_view_split *split) {
    const size_t step = sl_view_step(d, part);
    d->seen.count = 0;
    for (size_t i = 0; i < part->segments.count; i += step) {
        const double a = sl_view_side(split, d->clipped.items[i].a);
        const double b = sl_view_side(split, d->clipped.items[i].b);
        const uint8_t sides =
            (uint8_t)((a < 0 || b < 0) | ((a > 0 || b > 0 || (a >= 0 && b >= 0)) << 1));
        const uint64_t *first = &d->segments->first[part->segments.items[i]];
        for (uint64_t k = first[0]; k < first[1]; k++) {
            const uint32_t object = d->segments->objects[k];
            if (!d->sides[object]) d->seen.items[d->seen.count++] = object;
            d->sides[object] |= sides;
        }
    }
}

static void weigh(sl_view_divider *d, const sl_view_part *part, sl_view_split *split,
                  sl_view_split *best) {
    const sl_point middle = sl_view_part_middle(part);
    double below = 0, above = 0;
    mark_sides(d, part, split);
    for (size_t i = 0; i < d->seen.count; i++) {
        const uint32_t object = d->seen.items[i];
        const double cost = sl_view_render_object(&d->render, object, middle);
        if (d->sides[object] & 1) below += cost;
        if (d->sides[object] & 2) above += cost;
        d->sides[object] = 0;
    }
    const double mass = sl_view_share_below(&part->share, split);
    split->gain = mass * (part->seen - below) + (part->mass - mass) * (part->seen - above);
    if (split->gain > best->gain) *best = *split;
}

sl_status sl_view_choose_walls(sl_view_divider *d, const sl_view_part *part, sl_view_split *best) {
    SL_TRY(sl_view_walls_within(d, part, d->options->wall_splits, &d->walls));
    if (!d->walls.count) return SL_OK;
    SL_TRY(clip_all(d, part));
    for (size_t i = 0; i < d->walls.count; i++) {
        sl_view_split split = sl_view_split_along(&d->scene->space->walls[d->walls.items[i]]);
        weigh(d, part, &split, best);
    }
    return SL_OK;
}
