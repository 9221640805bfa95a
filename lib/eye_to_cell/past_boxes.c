/// Sight past boxes, with no cell cut: the visible region, and the line between two points. Of the
/// region, the pieces that region.c finds are compared with the sides of boxes on their way into
/// the polygon.
///
/// Of each box the sides that face the eye count. First they are merged, pair by pair, to their
/// lower envelope about the eye: arcs, each with the one side that is nearest there.
///
///       wall ----------------------      arcs, counter-clockwise: side 1, side 2, a gap, side 3.
///                  .--------.            Merged with the piece of wall, they give what is seen:
///                  |   2  .-|--.         1, 2, the wall, 3, the wall again.
///                 1|      |3|  |
///                  '------|-'  |         Within one arc of each, two lines cross once at most. The
///             eye *                      order at both ends of an interval says which is nearer.
///
/// Invariant: arcs start and end at rays through exact points: corners of boxes, places where their
/// sides cross. So all signs are exact. Only where a side crosses an oblique wall is a point
/// rounded, and nothing is compared with that.
///
/// Cost: O(n log n) for n boxes within reach, then for each piece the arcs that it meets
/// (Hershberger 1989, Finding the upper envelope of n line segments in O(n log n) time: merging;
/// here about an eye).
#include "eye_to_cell/past_boxes.h"

#include "geometry/crossing.h"

/// Where a point is: within a box (1), on its border (0) or outside (-1).
static int place_in(sl_box box, sl_point p) {
    if (p.x < box.min.x || p.x > box.max.x || p.y < box.min.y || p.y > box.max.y) return -1;
    return p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y;
}

// --- directions about the eye

/// Where a point's direction lies: 0 from +x on, 1 from -x on, 2 for an end at +x, once around.
static int half_of(sl_point eye, sl_point p, bool is_end) {
    if (p.y == eye.y && p.x > eye.x) return is_end ? 2 : 0;
    return p.y > eye.y || (p.y == eye.y && p.x > eye.x) ? 0 : 1;
}

/// Orders the directions of two points, counter-clockwise from +x.
static int compare_ends(sl_point eye, sl_point p, bool p_ends, sl_point q, bool q_ends) {
    const int a = half_of(eye, p, p_ends), b = half_of(eye, q, q_ends);
    return a != b ? a - b : -sli_orient(eye, p, q);
}

/// Whether a direction is within an arc of less than half a turn, or at its right end.
static bool starts_within(sl_point eye, sl_point right, sl_point left, sl_point p) {
    return sli_orient(eye, right, p) >= 0 && sli_orient(eye, p, left) > 0;
}

// --- the envelope

static double across(const sli_box_arc *arc, sl_point p) {
    return arc->axis ? p.y : p.x;
}

static sl_status push(sl_context *context, sli_box_arcs *to, sli_box_arc arc, sl_point right,
                      sl_point left) {
    SL_TRY(SL_ARRAY_ROOM(context, to, 1));
    arc.right = right;
    arc.left = left;
    to->items[to->count++] = arc;
    return SL_OK;
}

/// Adds the nearer one of two sides for all directions from `right` to `left`. At one distance it
/// is the first one.
static sl_status push_nearer(sl_context *context, sl_point eye, const sli_box_arc *a,
                             const sli_box_arc *b, sl_point right, sl_point left,
                             sli_box_arcs *to) {
    if (a->axis == b->axis) {
        const bool closer = a->at == b->at || (a->at < b->at) == (a->at > across(a, eye));
        return push(context, to, closer ? *a : *b, right, left);
    }
    const sli_box_arc *upright = a->axis ? b : a, *level = a->axis ? a : b;
    const sl_point cross = {upright->at, level->at};
    // Closer to the x axis than the crossing, the upright side is nearer.
    const bool upright_first = (cross.x > eye.x) == (cross.y > eye.y);
    const sli_box_arc *first = upright_first ? upright : level;
    const sli_box_arc *then = upright_first ? level : upright;
    if (sli_orient(eye, left, cross) >= 0) return push(context, to, *first, right, left);
    if (sli_orient(eye, right, cross) <= 0) return push(context, to, *then, right, left);
    SL_TRY(push(context, to, *first, right, cross));
    return push(context, to, *then, cross, left);
}

/// Merges two runs of arcs. Both are used up.
static sl_status merge(sl_context *context, sl_point eye, sli_box_arc *a, const sli_box_arc *a_end,
                       sli_box_arc *b, const sli_box_arc *b_end, sli_box_arcs *to) {
    while (a < a_end && b < b_end) {
        const int order = compare_ends(eye, a->right, false, b->right, false);
        if (order) {
            // The one that starts first goes up to its end, or to where the other one starts.
            sli_box_arc *first = order < 0 ? a : b;
            const sl_point stop = order < 0 ? b->right : a->right;
            const bool apart = compare_ends(eye, first->left, true, stop, false) <= 0;
            SL_TRY(push(context, to, *first, first->right, apart ? first->left : stop));
            first->right = stop;
            if (apart && order < 0) a++;
            if (apart && order > 0) b++;
            continue;
        }
        const int ends = compare_ends(eye, a->left, true, b->left, true);
        const sl_point stop = ends <= 0 ? a->left : b->left;
        SL_TRY(push_nearer(context, eye, a, b, a->right, stop, to));
        a->right = b->right = stop;
        a += ends <= 0;
        b += ends >= 0;
    }
    for (; a < a_end; a++) SL_TRY(push(context, to, *a, a->right, a->left));
    for (; b < b_end; b++) SL_TRY(push(context, to, *b, b->right, b->left));
    return SL_OK;
}

/// Merges the last two runs. `first`: where each run starts.
static sl_status merge_last(sl_context *context, sl_point eye, sli_box_envelope *e, size_t first,
                            size_t second) {
    const sli_box_arc *end = e->arcs.items + e->arcs.count;
    e->scratch.count = 0;
    SL_TRY(merge(context, eye, e->arcs.items + first, e->arcs.items + second,
                 e->arcs.items + second, end, &e->scratch));
    e->arcs.count = first;
    SL_TRY(SL_ARRAY_ROOM(context, &e->arcs, e->scratch.count));
    for (size_t i = 0; i < e->scratch.count; i++)
        e->arcs.items[e->arcs.count++] = e->scratch.items[i];
    return SL_OK;
}

/// Adds a side as a run of its own: one arc, or two where it passes +x.
static sl_status push_side(sl_context *context, sl_point eye, sli_box_arc side, sli_box_arcs *to) {
    if (compare_ends(eye, side.right, false, side.left, true) < 0)
        return push(context, to, side, side.right, side.left);
    const sl_point split = {side.at, eye.y};
    SL_TRY(push(context, to, side, split, side.left));
    return push(context, to, side, side.right, split);
}

/// The sides of a box that an eye sees if nothing else is there: those that face it, or from within
/// all of them. Returns how many.
static unsigned sides_of(sl_box box, sl_point eye, uint32_t wall, sli_box_arc sides[4]) {
    const double at[4] = {box.min.x, box.max.x, box.min.y, box.max.y};
    const bool within = place_in(box, eye) > 0;
    unsigned count = 0;
    for (unsigned k = 0; k < 4; k++) {
        const bool axis = k >= 2, low = k % 2 == 0;
        const double from = axis ? eye.y : eye.x;
        if (!(axis ? box.min.x < box.max.x : box.min.y < box.max.y)) continue;
        if (!within && (low ? from >= at[k] : from <= at[k])) continue;
        const sl_point lower = axis ? (sl_point){box.min.x, at[k]} : (sl_point){at[k], box.min.y};
        const sl_point upper = axis ? (sl_point){box.max.x, at[k]} : (sl_point){at[k], box.max.y};
        const bool upwards = axis ? at[k] < from : at[k] > from;
        const sl_point a = upwards ? lower : upper, b = upwards ? upper : lower;
        sides[count++] = (sli_box_arc){
            .right = a, .left = b, .a = a, .b = b, .at = at[k], .axis = axis, .wall = wall + k};
    }
    return count;
}

sl_box sli_region_reach(const sl_region *region, const sl_box *bounds) {
    sl_box reach = {region->points[0], region->points[0]};
    bool arcs = false;
    for (size_t i = 0; i < region->count; i++) {
        const sl_point p = region->points[i];
        reach.min = (sl_point){fmin(reach.min.x, p.x), fmin(reach.min.y, p.y)};
        reach.max = (sl_point){fmax(reach.max.x, p.x), fmax(reach.max.y, p.y)};
        arcs |= region->edges[i].kind == SL_EDGE_ARC;
    }
    // Points are rounded by some units in the last place; this is more by far.
    const double width = bounds->max.x - bounds->min.x, height = bounds->max.y - bounds->min.y;
    const double far_x = fmax(fabs(bounds->min.x), fabs(bounds->max.x));
    const double far_y = fmax(fabs(bounds->min.y), fabs(bounds->max.y));
    const double spare = 1e-9 * (width + height) + 1e-13 * (far_x + far_y);
    const double round = arcs ? region->range : 0;
    const sl_point eye = region->view.eye;
    reach.min = (sl_point){fmin(reach.min.x, eye.x - round), fmin(reach.min.y, eye.y - round)};
    reach.max = (sl_point){fmax(reach.max.x, eye.x + round), fmax(reach.max.y, eye.y + round)};
    return (sl_box){{reach.min.x - spare, reach.min.y - spare},
                    {reach.max.x + spare, reach.max.y + spare}};
}

static bool counts(const sl_moving_box *box, const sl_box *reach) {
    const sl_box *b = &box->box;
    return box->blocks && (!reach || (b->max.x >= reach->min.x && b->min.x <= reach->max.x &&
                                      b->max.y >= reach->min.y && b->min.y <= reach->max.y));
}

sl_status sli_box_envelope_make(sl_context *context, const sl_moving_box *boxes, size_t count,
                                sl_point eye, const sl_box *reach, sli_box_envelope *e) {
    enum { RUNS = 64 };
    size_t first[RUNS], rank[RUNS], runs = 0;
    e->arcs.count = 0;
    for (size_t i = 0; i < count; i++) {
        sli_box_arc sides[4];
        const unsigned n = counts(&boxes[i], reach)
                               ? sides_of(boxes[i].box, eye, SL_BOX_WALL + 4 * (uint32_t)i, sides)
                               : 0;
        for (unsigned k = 0; k < n; k++) {
            first[runs] = e->arcs.count;
            rank[runs++] = 0;
            SL_TRY(push_side(context, eye, sides[k], &e->arcs));
            for (; runs > 1 && rank[runs - 2] == rank[runs - 1]; runs--, rank[runs - 1]++)
                SL_TRY(merge_last(context, eye, e, first[runs - 2], first[runs - 1]));
        }
    }
    for (; runs > 1; runs--) SL_TRY(merge_last(context, eye, e, first[runs - 2], first[runs - 1]));
    return SL_OK;
}

// --- pieces behind the envelope

/// Where a part of a piece starts or ends: at a ray.
typedef struct bound {
    sli_eye_ray ray;
    bool on;      ///< the ray's point is on the side, and is where the part ends
    bool crosses; ///< there the piece and a side of a box cross
    bool rounded; ///< the point was rounded
} bound;

typedef struct sieve {
    sl_context *context;
    sl_region *region;
    uint32_t neighbour;
    const sli_eye_ray *a, *b; ///< the ends of the side that the piece is of
    bound start, stop;        ///< of the piece
} sieve;

static sl_point eye_of(const sieve *s) {
    return s->region->memory->eye.point.at;
}

static bool before(const sieve *s, sl_point p, sl_point q) {
    return sli_orient(eye_of(s), p, q) > 0;
}

/// Adds the part of a side from a to b between two bounds.
static sl_status put(const sieve *s, uint32_t neighbour, const sli_eye_ray *a, const sli_eye_ray *b,
                     const bound *from, const bound *to) {
    struct sli_region_memory *m = s->region->memory;
    if (!m->pending || m->piece.neighbour != neighbour || neighbour == SLI_PIECE_FAR) {
        SL_TRY(sli_region_start_piece(s->context, s->region, neighbour, from->on ? &from->ray : a,
                                      b, from->on ? NULL : &from->ray));
        if (from->rounded) s->region->edges[s->region->count - 1].exact = false;
    }
    m->piece.a = a->at;
    m->piece.b = b->at;
    m->piece.left = to->ray;
    m->piece.to_end = to->on;
    return SL_OK;
}

static sl_status put_piece(const sieve *s, const bound *from, const bound *to) {
    return put(s, s->neighbour, s->a, s->b, from, to);
}

/// A bound of the piece as one of a box's side, whose end may be on its ray.
static bound bound_on(const sieve *s, const bound *at, const sli_eye_ray *end) {
    if (at->crosses) return *at;
    if (sli_orient(eye_of(s), at->ray.at, end->at) != 0) return (bound){.ray = at->ray};
    return (bound){.ray = *end, .on = true};
}

static sl_status put_box(const sieve *s, const sli_box_arc *arc, const bound *from,
                         const bound *to) {
    const sli_eye_place *eye = &s->region->memory->eye;
    const sli_eye_ray a = sli_eye_ray_through(eye, arc->a), b = sli_eye_ray_through(eye, arc->b);
    const bound start = bound_on(s, from, &a), stop = bound_on(s, to, &b);
    return put(s, SL_SIDE_WALL + arc->wall, &a, &b, &start, &stop);
}

/// Whether the piece is behind the side of a box (1), before it (-1) or at it, on a ray that meets
/// both.
static int depth_at(const sieve *s, const sli_box_arc *arc, sl_point through) {
    const sl_point eye = eye_of(s);
    const int sign = sli_axial_meet_side(eye, through, s->a->at, s->b->at, arc->axis, arc->at);
    return arc->at > across(arc, eye) ? -sign : sign;
}

/// Where the piece and the side cross.
static bound crossing_of(const sieve *s, const sli_box_arc *arc) {
    const sl_point a = s->a->at, b = s->b->at;
    const sl_point at = sli_crossing((sl_segment){a, b}, (sl_segment){arc->a, arc->b});
    return (bound){.ray = sli_eye_ray_through(&s->region->memory->eye, at),
                   .on = true,
                   .crosses = true,
                   .rounded = a.x != b.x && a.y != b.y};
}

/// Adds what is seen from `from` to `to`, where an arc of the envelope is all the way. *from is
/// where the piece itself is seen from on, which is not added yet; *open: whether it is seen.
static sl_status pass_arc(const sieve *s, const sli_box_arc *arc, bound *from, bool *open,
                          const bound *at, const bound *to) {
    const int first = depth_at(s, arc, at->ray.at), last = depth_at(s, arc, to->ray.at);
    if (first <= 0 && last <= 0) {
        if (!*open) *from = *at;
        *open = true;
        return SL_OK;
    }
    if (first >= 0 && last >= 0) {
        if (*open) SL_TRY(put_piece(s, from, at));
        *open = false;
        return put_box(s, arc, at, to);
    }
    const bound middle = crossing_of(s, arc);
    if (first < 0) {
        SL_TRY(put_piece(s, *open ? from : at, &middle));
        *open = false;
        return put_box(s, arc, &middle, to);
    }
    if (*open) SL_TRY(put_piece(s, from, at));
    SL_TRY(put_box(s, arc, at, &middle));
    *from = middle;
    *open = true;
    return SL_OK;
}

/// The first arc that ends beyond the start of the piece.
static size_t first_arc(const sieve *s, const sli_box_arcs *arcs) {
    size_t low = 0, high = arcs->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (compare_ends(eye_of(s), arcs->items[middle].left, true, s->start.ray.at, false) <= 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < arcs->count ? low : 0;
}

static sl_status pass_arcs(const sieve *s) {
    const sli_box_arcs *arcs = &s->region->memory->envelope.arcs;
    const sl_point eye = eye_of(s), right = s->start.ray.at, left = s->stop.ray.at;
    bound from = s->start, at = s->start;
    bool open = false, done = false;
    size_t k = first_arc(s, arcs);
    for (size_t i = 0; i < arcs->count && !done; i++, k = k + 1 < arcs->count ? k + 1 : 0) {
        const sli_box_arc *arc = &arcs->items[k];
        const bool held = i == 0 && starts_within(eye, arc->right, arc->left, right);
        if (!held && !starts_within(eye, right, left, arc->right)) break;
        if (!held && before(s, at.ray.at, arc->right)) {
            if (!open) from = at;
            open = true;
            at = (bound){.ray = sli_eye_ray_through(&s->region->memory->eye, arc->right)};
        }
        done = !before(s, arc->left, left);
        const bound to =
            done ? s->stop
                 : (bound){.ray = sli_eye_ray_through(&s->region->memory->eye, arc->left)};
        SL_TRY(pass_arc(s, arc, &from, &open, &at, &to));
        at = to;
    }
    if (done) return open ? put_piece(s, &from, &s->stop) : SL_OK;
    return put_piece(s, open ? &from : &at, &s->stop);
}

/// A wall at the eye, seen edge-on: up to the first box on it.
static sl_status pass_edge_on(const sieve *s) {
    const sli_box_arcs *arcs = &s->region->memory->envelope.arcs;
    const sl_point eye = eye_of(s);
    const bool starts = sli_same_point(s->a->at, eye);
    const sl_point end = starts ? s->b->at : s->a->at;
    sl_point stop = end;
    for (size_t i = 0; i < arcs->count; i++) {
        const sli_box_arc *arc = &arcs->items[i];
        const int right = sli_orient(eye, arc->right, end), left = sli_orient(eye, end, arc->left);
        const double from = across(arc, eye), to = across(arc, end);
        if (starts ? right < 0 || left <= 0 : right <= 0 || left < 0) continue;
        if (arc->at > from ? to <= arc->at : to >= arc->at) continue;
        if (sli_orient(eye, end, arc->a) == 0)
            stop = arc->a;
        else if (sli_orient(eye, end, arc->b) == 0)
            stop = arc->b;
        else
            stop = sli_crossing((sl_segment){eye, end}, (sl_segment){arc->a, arc->b});
    }
    const sli_eye_ray at = sli_eye_ray_through(&s->region->memory->eye, stop);
    const sli_eye_ray *a = starts ? s->a : &at, *b = starts ? &at : s->b;
    const bound from = {.ray = *a, .on = true}, to = {.ray = *b, .on = true};
    return put(s, s->neighbour, a, b, &from, &to);
}

sl_status sli_region_see_past(sl_context *context, sl_region *region, uint32_t neighbour,
                              const sli_eye_ray *a, const sli_eye_ray *b, const sli_eye_ray *right,
                              const sli_eye_ray *left) {
    const sieve s = {.context = context,
                     .region = region,
                     .neighbour = neighbour,
                     .a = a,
                     .b = b,
                     .start = {.ray = right ? *right : *a, .on = !right},
                     .stop = {.ray = left ? *left : *b, .on = !left}};
    const sl_point eye = eye_of(&s);
    return sli_same_point(a->at, eye) || sli_same_point(b->at, eye) ? pass_edge_on(&s)
                                                                    : pass_arcs(&s);
}

// --- lines between two points

bool sli_boxes_touch(const sl_moving_box *boxes, size_t count, sl_point eye) {
    for (size_t i = 0; i < count; i++)
        if (boxes[i].blocks && place_in(boxes[i].box, eye) == 0) return true;
    return false;
}

/// Whether two ranges have nothing in common, not even an end.
static bool apart(double a, double b, double low, double high) {
    return fmax(a, b) < low || fmin(a, b) > high;
}

/// What a box, which is no point, does to the line between two points.
static sli_between between_by(sl_box box, sl_point a, sl_point b) {
    if (apart(a.x, b.x, box.min.x, box.max.x) || apart(a.y, b.y, box.min.y, box.max.y))
        return SLI_CLEAR;
    const int place_a = place_in(box, a), place_b = place_in(box, b);
    if (place_a > 0 && place_b > 0) return SLI_CLEAR;
    unsigned left = 0, right = 0;
    for (int k = 0; k < 4; k++) {
        const sl_point corner = {k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y};
        const int side = sli_orient(a, b, corner);
        left += side > 0;
        right += side < 0;
    }
    if (left == 4 || right == 4) return SLI_CLEAR;
    // They meet, as no line along a side or along the segment keeps them apart. If no end is on the
    // border, and the box has points at both hands, the segment goes through.
    const bool flat = box.min.x == box.max.x || box.min.y == box.max.y;
    const bool through = left && right && (!flat || left + right == 4);
    return place_a && place_b && through ? SLI_HIDDEN : SLI_TOUCHED;
}

sli_between sli_boxes_between(const sl_moving_box *boxes, size_t count, sl_point a, sl_point b) {
    sli_between all = SLI_CLEAR;
    for (size_t i = 0; i < count; i++) {
        const sl_box box = boxes[i].box;
        if (!boxes[i].blocks || (box.min.x == box.max.x && box.min.y == box.max.y)) continue;
        const sli_between one = between_by(box, a, b);
        if (one == SLI_HIDDEN) return SLI_HIDDEN;
        if (one == SLI_TOUCHED) all = SLI_TOUCHED;
    }
    return all;
}
