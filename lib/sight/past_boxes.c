/// Sight past boxes, with no cell cut: the visible region, and the line between two points.
///
/// Of the region, the pieces that region.c finds are compared with the sides of boxes on their way
/// into the polygon. How, the two parts say that the runtime header has in common with the library:
/// box_envelope.h finds the nearest sides in all directions, box_sieve.h what stands before a
/// piece. Here is what these parts need of the library, and what becomes of what they find.
#include "sight/past_boxes.h"

#include "geometry/crossing.h"

#include <assert.h>
#include <string.h>

// --- what the parts need

typedef sl_point slrt_point;
typedef sli_eye_place slrt_eye;
typedef sl_moving_box slrt_box_list;

static sl_point slrt_eye_at(const sli_eye_place *eye) {
    return eye->point.at;
}

static int slrt_point_turn(const sli_eye_place *eye, sl_point a, sl_point b) {
    return sli_orient(eye->point.at, a, b);
}

static void slrt_read_box(const sl_moving_box *boxes, uint32_t number, double box[4]) {
    const sl_box *b = &boxes[number].box;
    box[0] = b->min.x, box[1] = b->min.y, box[2] = b->max.x, box[3] = b->max.y;
}

#include "runtime/parts/box_envelope.h"

/// The pieces of the side of a room, or of a wall at the eye, on their way into a region.
typedef struct slrt_sight {
    sl_context *context;
    sl_region *region;
    uint32_t neighbour;
    const sli_eye_ray *a, *b; ///< the ends of that side
    sl_status status;
} slrt_sight;

typedef sli_eye_ray slrt_ray;

static sli_eye_ray slrt_ray_to(const sli_eye_place *eye, sl_point at) {
    return sli_eye_ray_through(eye, at);
}

static inline int slrt_turn_to(const sli_eye_place *eye, const sli_eye_ray *ray, sl_point at) {
    return sli_orient(eye->point.at, ray->at, at);
}

static int slrt_ray_sign(const sli_eye_place *eye, const sli_eye_ray *ray, int axis) {
    (void)eye;
    const double part = axis ? ray->offset.y : ray->offset.x;
    return (part > 0) - (part < 0);
}

static int slrt_side_meets(const sli_eye_place *eye, const sli_eye_ray *ray, sl_point a, sl_point b,
                           int axis, double at) {
    return sli_axial_meet_side(eye->point.at, ray->at, a, b, axis, at);
}

#include "runtime/parts/box_sieve.h"

static sl_point slrt_cross_side(sl_point a, sl_point b, const slrt_box_side *side) {
    return sli_crossing((sl_segment){a, b}, (sl_segment){side->a, side->b});
}

// --- the envelope

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
                                const sli_eye_place *eye, const sl_box *reach,
                                sli_box_envelope *out) {
    size_t counted = 0;
    slrt_envelope_maker maker;
    slrt_start_envelope(&maker, eye, boxes, NULL, 0);
    out->boxes = boxes;
    out->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (!counts(&boxes[i], reach)) continue;
        maker.room = slrt_arcs_room(++counted);
        out->arcs.count = 0;
        SL_TRY(SL_ARRAY_ROOM(context, &out->arcs, SLRT_ARC_WORDS * maker.room));
        maker.e.memory = out->arcs.items;
        slrt_add_box(&maker, (uint32_t)i);
    }
    slrt_finish_envelope(&maker);
    assert(!maker.is_full);
    out->count = maker.e.count;
    return SL_OK;
}

// --- pieces behind the envelope

/// Adds the part of a side from a to b between two bounds.
static sl_status put(slrt_sight *s, uint32_t neighbour, const sli_eye_ray *a, const sli_eye_ray *b,
                     const slrt_part_end *from, const slrt_part_end *to, bool rounded) {
    sl_region *region = s->region;
    struct sli_region_memory *m = region->memory;
    if (!m->pending || m->piece.neighbour != neighbour || neighbour == SLI_PIECE_FAR) {
        SL_TRY(sli_region_start_piece(s->context, region, neighbour, from->on ? &from->ray : a, b,
                                      from->on ? NULL : &from->ray));
        if (rounded) region->edges[region->count - 1].exact = false;
    }
    m->piece.a = a->at;
    m->piece.b = b->at;
    m->piece.left = to->ray;
    m->piece.to_end = to->on;
    return SL_OK;
}

static void slrt_see_part(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to) {
    slrt_sight *out = s->sight;
    const bool rounded = from->crosses && s->a.x != s->b.x && s->a.y != s->b.y;
    if (out->status != SL_OK) return;
    if (number == SLRT_NO_SIDE) {
        out->status = put(out, out->neighbour, out->a, out->b, from, to, rounded);
    } else {
        const sli_eye_ray a = slrt_ray_to(s->envelope->eye, side->a);
        const sli_eye_ray b = slrt_ray_to(s->envelope->eye, side->b);
        out->status = put(out, SL_SIDE_WALL + SL_BOX_WALL + number, &a, &b, from, to, rounded);
    }
}

/// A wall at the eye, seen edge-on: up to the first box on it.
static void pass_edge_on(const slrt_sieve *s) {
    const slrt_envelope *e = s->envelope;
    const sl_point eye = e->eye->point.at;
    const bool starts = sli_same_point(s->a, eye);
    const sl_point end = starts ? s->b : s->a;
    sl_point stop = end;
    for (size_t i = 0; i < e->count; i++) {
        const slrt_arc arc = slrt_get_arc(e, i);
        const slrt_box_side side = slrt_side_of(e, arc.side);
        const int right = sli_orient(eye, arc.right, end), left = sli_orient(eye, end, arc.left);
        const double from = slrt_across(&side, eye), to = slrt_across(&side, end);
        if (starts ? right < 0 || left <= 0 : right <= 0 || left < 0) continue;
        if (side.at > from ? to <= side.at : to >= side.at) continue;
        if (sli_orient(eye, end, side.a) == 0)
            stop = side.a;
        else if (sli_orient(eye, end, side.b) == 0)
            stop = side.b;
        else
            stop = sli_crossing((sl_segment){eye, end}, (sl_segment){side.a, side.b});
    }
    const slrt_part_end from = slrt_bound_at(s, starts ? eye : stop, true);
    const slrt_part_end to = slrt_bound_at(s, starts ? stop : eye, true);
    s->sight->status = put(s->sight, s->sight->neighbour, &from.ray, &to.ray, &from, &to, false);
}

sl_status sli_region_see_past(sl_context *context, sl_region *region, uint32_t neighbour,
                              const sli_eye_ray *a, const sli_eye_ray *b, const sli_eye_ray *right,
                              const sli_eye_ray *left) {
    const sli_eye_place *eye = &region->memory->eye;
    const sli_box_envelope *kept = &region->memory->envelope;
    const slrt_envelope e = {eye, kept->boxes, kept->arcs.items, kept->count};
    slrt_sight sight = {context, region, neighbour, a, b, SL_OK};
    const slrt_sieve s = {.envelope = &e,
                          .sight = &sight,
                          .a = a->at,
                          .b = b->at,
                          .start = {.ray = right ? *right : *a, .on = !right},
                          .stop = {.ray = left ? *left : *b, .on = !left}};
    if (sli_same_point(a->at, eye->point.at) || sli_same_point(b->at, eye->point.at))
        pass_edge_on(&s);
    else
        slrt_sieve_piece(&s);
    return sight.status;
}

// --- lines between two points

/// Where a point is: within a box (1), on its border (0) or outside (-1).
static int place_in(sl_box box, sl_point p) {
    if (p.x < box.min.x || p.x > box.max.x || p.y < box.min.y || p.y > box.max.y) return -1;
    return p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y;
}
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
