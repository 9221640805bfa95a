/// The geometry of parts of view space: convex polygons, and the mass in them, cut in doubles.
///
/// A part is cut by a line: corners below go to one half, corners above to the other, corners on
/// the line to both, and crossings to both. The places of viewpoints in the part are cut in the
/// same way, and the mass of each is shared by area.
///
/// Rounding here moves borders of view cells by a few units in the last place. It decides no
/// visibility. Cost: O(corners) for each cut or clip.
#include "study/view_cells/divide.h"

#include <math.h>

void sli_view_part_destroy(sl_context *context, sli_view_part *part) {
    sl_free(context, part->corners.items);
    sl_free(context, part->edges.items);
    sl_free(context, part->segments.items);
    sl_free(context, part->pieces.items);
    sl_free(context, part->share.points.items);
    sl_free(context, part->share.ends.items);
    sl_free(context, part->share.mass.items);
    sli_view_part_halves *cut = part->cut;
    if (cut) {
        sli_view_part_destroy(context, &cut->below);
        sli_view_part_destroy(context, &cut->above);
        for (size_t i = 0; i < cut->pieces.count; i++)
            sli_view_halves_destroy(context, &cut->pieces.items[i]);
        sl_free(context, cut->pieces.items);
        sl_free(context, cut);
    }
    *part = (sli_view_part){0};
}

sl_point sli_view_part_middle(const sli_view_part *part) {
    sl_point sum = {0, 0};
    for (size_t i = 0; i < part->corners.count; i++) {
        sum.x += part->corners.items[i].x / (double)part->corners.count;
        sum.y += part->corners.items[i].y / (double)part->corners.count;
    }
    return sum;
}

// --- segments

static void clip_to_polygon(const sli_view_part *part, const sl_segment *s, double *t0,
                            double *t1) {
    for (size_t i = 0; i < part->corners.count; i++) {
        const sl_point a = part->corners.items[i];
        const sl_point b = part->corners.items[i + 1 < part->corners.count ? i + 1 : 0];
        const double nx = b.y - a.y, ny = a.x - b.x; // outwards
        sli_keep_below(nx * (s->a.x - a.x) + ny * (s->a.y - a.y),
                       nx * (s->b.x - s->a.x) + ny * (s->b.y - s->a.y), t0, t1);
    }
}

/// Shortens t0 .. t1 to where a + t * (b - a) is between low and high. It divides only where an end
/// lies outside.
static void clip_axis(double a, double b, double low, double high, double *t0, double *t1) {
    const bool starts_out = a < low || a > high, ends_out = b < low || b > high;
    if (!starts_out && !ends_out) return;
    const double inverse = 1 / (b - a);
    if (starts_out) {
        const double t = ((a < low ? low : high) - a) * inverse;
        if (!(t <= *t0)) *t0 = t;
    }
    if (ends_out) {
        const double t = ((b < low ? low : high) - a) * inverse;
        if (!(t >= *t1)) *t1 = t;
    }
}

sl_segment sli_view_part_clip(const sli_view_part *part, const sl_segment *s) {
    const sl_box *box = &part->box;
    double t0 = 0, t1 = 1;
    clip_axis(s->a.x, s->b.x, box->min.x, box->max.x, &t0, &t1);
    clip_axis(s->a.y, s->b.y, box->min.y, box->max.y, &t0, &t1);
    if (!part->is_box) clip_to_polygon(part, s, &t0, &t1);
    // A segment that misses the part is in its list by rounding.
    if (!(t0 <= t1)) t0 = t1 = t0 >= 0 && t0 <= 1 ? t0 : 0.5;
    const double dx = s->b.x - s->a.x, dy = s->b.y - s->a.y;
    const sl_point a = t0 > 0 ? (sl_point){s->a.x + t0 * dx, s->a.y + t0 * dy} : s->a;
    const sl_point b = t1 < 1 ? (sl_point){s->a.x + t1 * dx, s->a.y + t1 * dy} : s->b;
    return (sl_segment){
        {sli_within(a.x, box->min.x, box->max.x), sli_within(a.y, box->min.y, box->max.y)},
        {sli_within(b.x, box->min.x, box->max.x), sli_within(b.y, box->min.y, box->max.y)}};
}

// --- polygons

static sl_point crossing(const sli_view_split *split, sl_point p, sl_point q, double at_p,
                         double at_q) {
    const double t = at_p / (at_p - at_q);
    sl_point c = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    if (split->axis == 0) c.x = split->position;
    if (split->axis == 1) c.y = split->position;
    return c;
}

/// A point on the split's line near `p`. Areas summed from there need no edge along the line.
static sl_point on_line(const sli_view_split *split, sl_point p) {
    if (split->axis == 0) return (sl_point){split->position, p.y};
    if (split->axis == 1) return (sl_point){p.x, split->position};
    const sl_point a = split->line.a, b = split->line.b;
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double t = (dx * (p.x - a.x) + dy * (p.y - a.y)) / (dx * dx + dy * dy);
    return (sl_point){a.x + t * dx, a.y + t * dy};
}

static double cross_from(sl_point origin, sl_point p, sl_point q) {
    return (p.x - origin.x) * (q.y - origin.y) - (q.x - origin.x) * (p.y - origin.y);
}

/// The share of a convex polygon that is below a split.
static double part_below(const sl_point *points, uint32_t count, const sli_view_split *split) {
    const sl_point origin = on_line(split, points[0]);
    double below = 0, all = 0;
    sl_point p = points[count - 1];
    double at_p = sli_view_side(split, p);
    for (uint32_t i = 0; i < count; i++) {
        const sl_point q = points[i];
        const double at_q = sli_view_side(split, q);
        all += cross_from(origin, p, q);
        if (at_p < 0 || at_q < 0) {
            const sl_point from = at_p < 0 ? p : crossing(split, p, q, at_p, at_q);
            const sl_point to = at_q < 0 ? q : crossing(split, p, q, at_p, at_q);
            below += cross_from(origin, from, to);
        }
        p = q;
        at_p = at_q;
    }
    return all > 0 ? sli_within(below / all, 0, 1) : 0;
}

double sli_view_share_below(const sli_view_share *share, const sli_view_split *split) {
    double sum = 0;
    for (size_t i = 0; i < share->mass.count; i++) {
        const uint32_t first = i ? share->ends.items[i - 1] : 0;
        const uint32_t count = share->ends.items[i] - first;
        const sl_point *points = share->points.items + first;
        bool all = true, any = false;
        for (uint32_t k = 0; k < count; k++) {
            const bool below = sli_view_side(split, points[k]) < 0;
            all = all && below;
            any = any || below;
        }
        if (all)
            sum += share->mass.items[i];
        else if (any)
            sum += share->mass.items[i] * part_below(points, count, split);
    }
    return sum;
}

// --- cutting

static sl_status add_corner(sl_context *context, sli_view_part *part, sl_point at, uint32_t edge) {
    SL_TRY(SL_ARRAY_ROOM(context, &part->corners, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &part->edges, 1));
    part->corners.items[part->corners.count++] = at;
    part->edges.items[part->edges.count++] = edge;
    return SL_OK;
}

/// Cuts the polygon. A corner on the split goes to both halves. The edge that starts there and runs
/// along the split belongs to the node.
static sl_status cut_polygon(sl_context *context, const sli_view_part *part,
                             const sli_view_split *split, uint32_t node, sli_view_part *below,
                             sli_view_part *above) {
    for (size_t i = 0; i < part->corners.count; i++) {
        const size_t next = i + 1 < part->corners.count ? i + 1 : 0;
        const sl_point p = part->corners.items[i], q = part->corners.items[next];
        const uint32_t edge = part->edges.items[i];
        const double at_p = sli_view_side(split, p), at_q = sli_view_side(split, q);
        if (at_p <= 0) SL_TRY(add_corner(context, below, p, at_p == 0 && at_q > 0 ? node : edge));
        if (at_p >= 0) SL_TRY(add_corner(context, above, p, at_p == 0 && at_q < 0 ? node : edge));
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
            const sl_point c = crossing(split, p, q, at_p, at_q);
            SL_TRY(add_corner(context, below, c, at_p < 0 ? node : edge));
            SL_TRY(add_corner(context, above, c, at_p < 0 ? edge : node));
        }
    }
    return SL_OK;
}

static sl_status add_piece(sl_context *context, sli_view_share *share, double mass) {
    if (!(mass > 0)) {
        share->points.count = share->ends.count ? share->ends.items[share->ends.count - 1] : 0;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(context, &share->ends, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &share->mass, 1));
    share->ends.items[share->ends.count++] = (uint32_t)share->points.count;
    share->mass.items[share->mass.count++] = mass;
    return SL_OK;
}

static sl_status add_point(sl_context *context, sli_view_share *share, sl_point p) {
    SL_TRY(SL_ARRAY_ROOM(context, &share->points, 1));
    share->points.items[share->points.count++] = p;
    return SL_OK;
}

static sl_status cut_piece(sl_context *context, const sl_point *points, uint32_t count, double mass,
                           const sli_view_split *split, sli_view_share *below,
                           sli_view_share *above) {
    bool some_below = false, some_above = false;
    for (uint32_t i = 0; i < count; i++) {
        const sl_point p = points[i], q = points[i + 1 < count ? i + 1 : 0];
        const double at_p = sli_view_side(split, p), at_q = sli_view_side(split, q);
        some_below = some_below || at_p < 0;
        some_above = some_above || at_p > 0;
        if (at_p < 0 || (at_p == 0 && count > 1)) SL_TRY(add_point(context, below, p));
        if (at_p >= 0) SL_TRY(add_point(context, above, p));
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
            const sl_point c = crossing(split, p, q, at_p, at_q);
            SL_TRY(add_point(context, below, c));
            SL_TRY(add_point(context, above, c));
        }
    }
    // A point on the split is above it, as in sl_view_tree_locate.
    const double share = count == 1                 ? some_below
                         : some_below && some_above ? part_below(points, count, split)
                                                    : some_below;
    SL_TRY(add_piece(context, below, mass * share));
    return add_piece(context, above, mass * (1 - share));
}

static sl_box box_about(const sli_view_points *points) {
    sl_box box = {points->items[0], points->items[0]};
    for (size_t i = 1; i < points->count; i++) {
        const sl_point p = points->items[i];
        box.min = (sl_point){fmin(box.min.x, p.x), fmin(box.min.y, p.y)};
        box.max = (sl_point){fmax(box.max.x, p.x), fmax(box.max.y, p.y)};
    }
    return box;
}

static void measure(const sli_view_part *from, const sli_view_split *split, sli_view_part *part) {
    part->box = box_about(&part->corners);
    part->is_box = from->is_box && split->axis < 2;
    part->depth = from->depth + 1;
    part->mass = 0;
    for (size_t i = 0; i < part->share.mass.count; i++) part->mass += part->share.mass.items[i];
}

sl_status sli_view_part_cut(sl_context *context, const sli_view_part *part,
                            const sli_view_split *split, uint32_t node, sli_view_part *below,
                            sli_view_part *above) {
    SL_TRY(cut_polygon(context, part, split, node, below, above));
    const sli_view_share *share = &part->share;
    for (size_t i = 0; i < share->mass.count; i++) {
        const uint32_t first = i ? share->ends.items[i - 1] : 0;
        SL_TRY(cut_piece(context, share->points.items + first, share->ends.items[i] - first,
                         share->mass.items[i], split, &below->share, &above->share));
    }
    measure(part, split, below);
    measure(part, split, above);
    return SL_OK;
}
