/// The best split across an axis.
///
/// An object is seen below a split where some segment to it starts below it, and above where some
/// segment ends above it: so of each object two numbers are all that counts, and one pass over the
/// segments finds them. Between two such numbers what both halves see stays as it is and the cost
/// is linear in the position as long as the mass is, so the best split is at one of them: all are
/// weighed, in one sweep over them.
#include "view_cells/divide.h"

#include <math.h>
#include <stdlib.h>

/// Splits nearer than this share of a part's width to its border would leave slivers that rounding
/// alone has made.
#define SLIVER 1e-9

static int compare_events(const void *left, const void *right) {
    const double a = ((const sl_view_event *)left)->at, b = ((const sl_view_event *)right)->at;
    return (a > b) - (a < b);
}

static int compare_positions(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/// Finds for each object where it is seen within the part, and what rendering all of them costs.
void sl_view_find_extents(sl_view_divider *d, sl_view_part *part) {
    if (d->pieces) {
        sl_view_find_piece_extents(d, part);
        return;
    }
    const sl_point middle = sl_view_part_middle(part);
    const size_t step = sl_view_step(d, part);
    d->seen.count = 0;
    part->seen = 0;
    for (size_t i = 0; i < part->segments.count; i += step) {
        const uint32_t number = part->segments.items[i];
        const sl_segment inner = sl_view_part_clip(part, &d->segments->items[number]);
        const bool right = inner.a.x < inner.b.x, up = inner.a.y < inner.b.y;
        const double x0 = right ? inner.a.x : inner.b.x, x1 = right ? inner.b.x : inner.a.x;
        const double y0 = up ? inner.a.y : inner.b.y, y1 = up ? inner.b.y : inner.a.y;
        for (uint64_t k = d->segments->first[number]; k < d->segments->first[number + 1]; k++) {
            const uint32_t object = d->segments->objects[k];
            sl_view_extent *extent = &d->extents[object];
            if (extent->low[0] == INFINITY) {
                d->seen.items[d->seen.count++] = object;
                part->seen += sl_view_render_object(&d->render, object, middle);
            }
            if (x0 < extent->low[0]) extent->low[0] = x0;
            if (x1 > extent->high[0]) extent->high[0] = x1;
            if (y0 < extent->low[1]) extent->low[1] = y0;
            if (y1 > extent->high[1]) extent->high[1] = y1;
        }
    }
}

void sl_view_forget_extents(sl_view_divider *d) {
    for (size_t i = 0; i < d->seen.count; i++) d->extents[d->seen.items[i]] = sl_view_no_extent();
}

static sl_status add_event(sl_context *context, sl_view_events *events, double at, double cost) {
    SL_TRY(SL_ARRAY_ROOM(context, events, 1));
    events->items[events->count++] = (sl_view_event){at, cost};
    return SL_OK;
}

/// Gathers where objects start and end to be seen between the borders; *below is the cost of those
/// that are seen from the lower border on.
static sl_status gather_events(sl_view_divider *d, const sl_view_part *part, int axis, double low,
                               double high, double *below) {
    const sl_point middle = sl_view_part_middle(part);
    d->starts.count = d->ends.count = 0;
    *below = 0;
    for (size_t i = 0; i < d->seen.count; i++) {
        const uint32_t object = d->seen.items[i];
        const double cost = sl_view_render_object(&d->render, object, middle);
        const double start = d->extents[object].low[axis], end = d->extents[object].high[axis];
        if (start <= low)
            *below += cost;
        else
            SL_TRY(add_event(d->context, &d->starts, start, cost));
        // Seen along one split only, it is seen from above it.
        if (end < high)
            SL_TRY(add_event(d->context, &d->ends, end > start ? end : nextafter(end, INFINITY),
                             cost));
    }
    if (d->starts.count)
        qsort(d->starts.items, d->starts.count, sizeof *d->starts.items, compare_events);
    if (d->ends.count) qsort(d->ends.items, d->ends.count, sizeof *d->ends.items, compare_events);
    return SL_OK;
}

static sl_status add_positions(sl_context *context, sl_view_divider *d,
                               const sl_view_events *events, double low, double high) {
    SL_TRY(SL_ARRAY_ROOM(context, &d->positions, events->count));
    for (size_t i = 0; i < events->count; i++) {
        // Just above 0 there is none that a map can have.
        const double at = events->items[i].at;
        if (at > low && at < high && sl_coordinate_usable(at))
            d->positions.items[d->positions.count++] = at;
    }
    return SL_OK;
}

/// All positions that can be best, or as many of them as the options allow, in order.
static sl_status gather_positions(sl_view_divider *d, double low, double high) {
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
    if (d->positions.count) qsort(at, d->positions.count, sizeof *at, compare_positions);
    return SL_OK;
}

/// Of equal gains the split nearer to the middle is better.
static bool is_better(const sl_view_split *split, const sl_view_split *best,
                      const sl_view_part *part) {
    if (split->gain != best->gain) return split->gain > best->gain;
    if (best->axis == 2 || split->axis != best->axis) return false;
    const double middle =
        sl_along(part->box.min, split->axis) / 2 + sl_along(part->box.max, split->axis) / 2;
    return fabs(split->position - middle) < fabs(best->position - middle);
}

static void weigh(sl_view_divider *d, const sl_view_part *part, int axis, double below,
                  sl_view_split *best) {
    double above = part->seen;
    size_t start = 0, end = 0;
    for (size_t i = 0; i < d->positions.count; i++) {
        sl_view_split split = {.axis = axis, .position = d->positions.items[i]};
        if (i && split.position == d->positions.items[i - 1]) continue;
        for (; start < d->starts.count && d->starts.items[start].at < split.position; start++)
            below += d->starts.items[start].cost;
        for (; end < d->ends.count && d->ends.items[end].at <= split.position; end++)
            above -= d->ends.items[end].cost;
        // No share of the mass can gain more than this.
        if (part->mass * (part->seen - fmin(below, above)) <= best->gain) continue;
        const double mass = sl_view_share_below(&part->share, &split);
        split.gain = mass * (part->seen - below) + (part->mass - mass) * (part->seen - above);
        if (is_better(&split, best, part)) *best = split;
    }
}

sl_status sl_view_choose_axes(sl_view_divider *d, const sl_view_part *part, sl_view_split *best) {
    for (int axis = 0; axis < 2; axis++) {
        const double low = sl_along(part->box.min, axis), high = sl_along(part->box.max, axis);
        double below;
        SL_TRY(gather_events(d, part, axis, low, high, &below));
        SL_TRY(gather_positions(d, low, high));
        weigh(d, part, axis, below, best);
    }
    return SL_OK;
}
