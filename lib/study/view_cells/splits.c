/// The best split of a part, across an axis or along the line of a wall.
///
/// The gain of a split is the cost of the part less the cost of its halves, each weighted by the
/// probability of a viewpoint there (Mattausch et al. 2006, section 4.2).
///
/// Across an axis: an object is seen below a split where some segment to it starts below it, and
/// above where some segment ends above it. So two numbers of each object count:
///
///     object 1     |-------------|                 seen below from its start on,
///     object 2           |------------------|      seen above up to its end
///     -------------+-----+-------+----------+----> position
///
/// Between two such numbers the cost is linear in the position, as long as the mass is. So the best
/// split is at one of them. One pass over the segments finds the numbers, and one sweep weighs all
/// positions: O(s + n log n) for s segments and n objects. A wall's line is weighed by a pass over
/// the segments for each wall that is tried.
#include "study/view_cells/divide.h"

#include "geometry/orient.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>

/// A share of a length below which rounding alone may have made it: of a part's width, and of a
/// wall's length within a part.
#define SLIVER 1e-9

// --- across an axis

static int compare_events(const void *left, const void *right) {
    const double a = ((const sli_view_event *)left)->at, b = ((const sli_view_event *)right)->at;
    return (a > b) - (a < b);
}

void sli_view_find_extents(sli_view_divider *d, sli_view_part *part) {
    if (d->pieces) {
        sli_view_find_piece_extents(d, part);
        return;
    }
    const sl_point middle = sli_view_part_middle(part);
    const size_t step = sli_view_step(d, part);
    d->seen.count = 0;
    part->seen = 0;
    for (size_t i = 0; i < part->segments.count; i += step) {
        const uint32_t number = part->segments.items[i];
        const sl_segment inner = sli_view_part_clip(part, &d->segments->items[number]);
        const bool right = inner.a.x < inner.b.x, up = inner.a.y < inner.b.y;
        const double x0 = right ? inner.a.x : inner.b.x, x1 = right ? inner.b.x : inner.a.x;
        const double y0 = up ? inner.a.y : inner.b.y, y1 = up ? inner.b.y : inner.a.y;
        for (uint64_t k = d->segments->first[number]; k < d->segments->first[number + 1]; k++) {
            const uint32_t object = d->segments->objects[k];
            sli_view_extent *extent = &d->extents[object];
            if (extent->low[0] == INFINITY) {
                d->seen.items[d->seen.count++] = object;
                part->seen += sli_view_render_object(&d->render, object, middle);
            }
            if (x0 < extent->low[0]) extent->low[0] = x0;
            if (x1 > extent->high[0]) extent->high[0] = x1;
            if (y0 < extent->low[1]) extent->low[1] = y0;
            if (y1 > extent->high[1]) extent->high[1] = y1;
        }
    }
}

void sli_view_forget_extents(sli_view_divider *d) {
    for (size_t i = 0; i < d->seen.count; i++) d->extents[d->seen.items[i]] = sli_view_no_extent();
}

static sl_status add_event(sl_context *context, sli_view_events *events, double at, double cost) {
    SL_TRY(SL_ARRAY_ROOM(context, events, 1));
    events->items[events->count++] = (sli_view_event){at, cost};
    return SL_OK;
}

/// Gathers where objects start and end to be seen between the borders. *below: the cost of those
/// seen from the lower border on.
static sl_status gather_events(sli_view_divider *d, const sli_view_part *part, int axis, double low,
                               double high, double *below) {
    const sl_point middle = sli_view_part_middle(part);
    d->starts.count = d->ends.count = 0;
    *below = 0;
    for (size_t i = 0; i < d->seen.count; i++) {
        const uint32_t object = d->seen.items[i];
        const double cost = sli_view_render_object(&d->render, object, middle);
        const double start = d->extents[object].low[axis], end = d->extents[object].high[axis];
        if (start <= low)
            *below += cost;
        else
            SL_TRY(add_event(d->context, &d->starts, start, cost));
        // An object seen along one split only counts as seen from above it.
        if (end < high)
            SL_TRY(add_event(d->context, &d->ends, end > start ? end : nextafter(end, INFINITY),
                             cost));
    }
    if (d->starts.count)
        qsort(d->starts.items, d->starts.count, sizeof *d->starts.items, compare_events);
    if (d->ends.count) qsort(d->ends.items, d->ends.count, sizeof *d->ends.items, compare_events);
    return SL_OK;
}

static sl_status add_positions(sl_context *context, sli_view_divider *d,
                               const sli_view_events *events, double low, double high) {
    SL_TRY(SL_ARRAY_ROOM(context, &d->positions, events->count));
    for (size_t i = 0; i < events->count; i++) {
        // A map can have no coordinate just above 0.
        const double at = events->items[i].at;
        if (at > low && at < high && sl_coordinate_usable(at))
            d->positions.items[d->positions.count++] = at;
    }
    return SL_OK;
}

/// All positions that can be best, or a random choice of as many as the options allow, in order.
static sl_status gather_positions(sli_view_divider *d, double low, double high) {
    const double margin = SLIVER * (high - low);
    d->positions.count = 0;
    SL_TRY(add_positions(d->context, d, &d->starts, low + margin, high - margin));
    SL_TRY(add_positions(d->context, d, &d->ends, low + margin, high - margin));
    double *at = d->positions.items;
    if (d->options->candidates && d->positions.count > d->options->candidates) {
        for (size_t i = 0; i < d->options->candidates; i++) {
            const size_t k = i + (size_t)sl_random_below(&d->random, d->positions.count - i);
            const double swap = at[i];
            at[i] = at[k];
            at[k] = swap;
        }
        d->positions.count = d->options->candidates;
    }
    if (d->positions.count) qsort(at, d->positions.count, sizeof *at, sl_compare_numbers);
    return SL_OK;
}

/// Of two splits with equal gains the one nearer to the middle is better.
static bool is_better(const sli_view_split *split, const sli_view_split *best,
                      const sli_view_part *part) {
    if (split->gain != best->gain) return split->gain > best->gain;
    if (best->axis == 2 || split->axis != best->axis) return false;
    const double middle =
        sli_along(part->box.min, split->axis) / 2 + sli_along(part->box.max, split->axis) / 2;
    return fabs(split->position - middle) < fabs(best->position - middle);
}

static sl_status weigh_positions(sli_view_divider *d, const sli_view_part *part, int axis,
                                 double below, sli_view_split *best) {
    double above = part->seen;
    size_t start = 0, end = 0;
    for (size_t i = 0; i < d->positions.count; i++) {
        sli_view_split split = {.axis = axis, .position = d->positions.items[i]};
        if (i && split.position == d->positions.items[i - 1]) continue;
        for (; start < d->starts.count && d->starts.items[start].at < split.position; start++)
            below += d->starts.items[start].cost;
        for (; end < d->ends.count && d->ends.items[end].at <= split.position; end++)
            above -= d->ends.items[end].cost;
        // The gain is at most this, however the mass is shared.
        if (part->mass * (part->seen - fmin(below, above)) <= best->gain) continue;
        // A share of a large map takes long to measure.
        SL_TRY(sl_check_cancelled(d->context));
        const double mass = sli_view_share_below(&part->share, &split);
        split.gain = mass * (part->seen - below) + (part->mass - mass) * (part->seen - above);
        if (is_better(&split, best, part)) *best = split;
    }
    return SL_OK;
}

sl_status sli_view_choose_axes(sli_view_divider *d, const sli_view_part *part,
                               sli_view_split *best) {
    for (int axis = 0; axis < 2; axis++) {
        const double low = sli_along(part->box.min, axis), high = sli_along(part->box.max, axis);
        double below;
        SL_TRY(gather_events(d, part, axis, low, high, &below));
        SL_TRY(gather_positions(d, low, high));
        SL_TRY(weigh_positions(d, part, axis, below, best));
    }
    return SL_OK;
}

// --- along walls

/// Whether a wall lies on the line of one of the splits that bound a part.
static bool is_on_border(const sli_view_divider *d, const sli_view_part *part,
                         const sl_wall *wall) {
    for (size_t i = 0; i < part->edges.count; i++) {
        if (part->edges.items[i] == UINT32_MAX) continue;
        const sl_view_node *node = &d->nodes.items[part->edges.items[i]];
        if (node->axis < 2) continue;
        const sl_segment *l = &d->lines.items[node->line];
        if (sli_orient(l->a, l->b, wall->a) == 0 && sli_orient(l->a, l->b, wall->b) == 0)
            return true;
    }
    return false;
}

/// Whether a wall goes inside a part. Rounded: it only chooses which splits to try.
static bool goes_into(const sli_view_part *part, const sl_wall *wall) {
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
static bool divides(const sli_view_part *part, const sli_view_split *split) {
    bool below = false, above = false;
    for (size_t i = 0; i < part->corners.count; i++) {
        const double side = sli_view_side(split, part->corners.items[i]);
        below = below || side < 0;
        above = above || side > 0;
    }
    return below && above;
}

sli_view_split sli_view_split_along(const sl_wall *wall) {
    if (wall->a.x == wall->b.x) return (sli_view_split){.axis = 0, .position = wall->a.x};
    if (wall->a.y == wall->b.y) return (sli_view_split){.axis = 1, .position = wall->a.y};
    return (sli_view_split){.axis = 2, .line = {wall->a, wall->b}};
}

sl_status sli_view_walls_within(sli_view_divider *d, const sli_view_part *part, uint32_t most,
                                sli_view_numbers *out) {
    const sl_space *space = d->scene->space;
    const sl_box *box = &part->box;
    out->count = 0;
    for (uint32_t i = 0; i < space->wall_count; i++) {
        const sl_wall *w = &space->walls[i];
        if (fmax(w->a.x, w->b.x) < box->min.x || fmin(w->a.x, w->b.x) > box->max.x ||
            fmax(w->a.y, w->b.y) < box->min.y || fmin(w->a.y, w->b.y) > box->max.y ||
            !goes_into(part, w) || is_on_border(d, part, w))
            continue;
        const sli_view_split split = sli_view_split_along(w);
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

static sl_status clip_all(sli_view_divider *d, const sli_view_part *part) {
    SL_TRY(SL_ARRAY_ROOM(d->context, &d->clipped, part->segments.count));
    const size_t step = sli_view_step(d, part);
    for (size_t i = 0; i < part->segments.count; i += step)
        d->clipped.items[i] =
            sli_view_part_clip(part, &d->segments->items[part->segments.items[i]]);
    return SL_OK;
}

/// Marks the sides of a split from which each object is seen.
static void mark_sides(sli_view_divider *d, const sli_view_part *part,
                       const sli_view_split *split) {
    const size_t step = sli_view_step(d, part);
    d->seen.count = 0;
    for (size_t i = 0; i < part->segments.count; i += step) {
        const double a = sli_view_side(split, d->clipped.items[i].a);
        const double b = sli_view_side(split, d->clipped.items[i].b);
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

static void weigh_line(sli_view_divider *d, const sli_view_part *part, sli_view_split *split,
                       sli_view_split *best) {
    const sl_point middle = sli_view_part_middle(part);
    double below = 0, above = 0;
    mark_sides(d, part, split);
    for (size_t i = 0; i < d->seen.count; i++) {
        const uint32_t object = d->seen.items[i];
        const double cost = sli_view_render_object(&d->render, object, middle);
        if (d->sides[object] & 1) below += cost;
        if (d->sides[object] & 2) above += cost;
        d->sides[object] = 0;
    }
    const double mass = sli_view_share_below(&part->share, split);
    split->gain = mass * (part->seen - below) + (part->mass - mass) * (part->seen - above);
    if (split->gain > best->gain) *best = *split;
}

sl_status sli_view_choose_walls(sli_view_divider *d, const sli_view_part *part,
                                sli_view_split *best) {
    SL_TRY(sli_view_walls_within(d, part, d->options->wall_splits, &d->walls));
    if (!d->walls.count) return SL_OK;
    SL_TRY(clip_all(d, part));
    for (size_t i = 0; i < d->walls.count; i++) {
        sli_view_split split = sli_view_split_along(&d->scene->space->walls[d->walls.items[i]]);
        SL_TRY(sl_check_cancelled(d->context));
        weigh_line(d, part, &split, best);
    }
    return SL_OK;
}
