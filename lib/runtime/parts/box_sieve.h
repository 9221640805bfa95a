/// What stands before a piece of a wall: the sides of boxes that are nearer.

// A piece is compared with the arcs of the envelope that it meets. Within one arc its line and that
// of the side cross once at most. So the order at both ends of an interval says which is nearer:
//
//        1           2        the piece is behind side 1, before the gap and side 2 it is seen,
//     .-----.      .---.      side 3 crosses it. What is seen comes counter-clockwise, part by
//     |  ---+------+---+--*-  part, and one part ends where the next one starts, or straight
//                        / 3  before it or behind it.
//
// Only where a side crosses an oblique wall is a point rounded, and nothing is compared with that.
//
// Beside what box_envelope.h needs, the header and the library say what these are:
//
//     slrt_sight         where parts go
//     slrt_ray           from the eye; slrt_ray_to makes it through a point other than the eye
//     slrt_turn_to       which side of a ray a point is on: 1 left, -1 right, 0 in one line; exact
//     slrt_ray_sign      whether a ray goes up along an axis (0: x) or down: 1, -1, 0
//     slrt_side_meets    on which side of an axial line (axis 0: x = at) a ray with the direction u
//                        meets the line through a and b: the sign of
//                        u_m (s x (a - eye)) - (s x u)(at - eye_m) for s = b - a and the coordinate
//                        m of the axis; exact
//
// and define after it the functions that it declares without a body.

/// Where a part starts or ends: at a ray.
typedef struct slrt_part_end {
    slrt_ray ray;
    bool on;      ///< the ray's point is on the part, and is where it ends
    bool crosses; ///< there the piece and a side cross
} slrt_part_end;

/// A piece from a to b as the eye sees it, of which the part from `start` to `stop` is asked for.
typedef struct slrt_sieve {
    const slrt_envelope *envelope;
    slrt_sight *sight;
    slrt_point a, b;
    slrt_part_end start, stop;
} slrt_sieve;

/// Where the line through a and b crosses a side.
static slrt_point slrt_cross_side(slrt_point a, slrt_point b, const slrt_box_side *side);

/// Takes what is seen between two bounds: of a side of a box, or of the piece (SLRT_NO_SIDE).
static void slrt_see_part(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to);

static slrt_part_end slrt_bound_at(const slrt_sieve *s, slrt_point p, bool on) {
    slrt_part_end bound;
    bound.ray = slrt_ray_to(s->envelope->eye, p);
    bound.on = on;
    bound.crosses = false;
    return bound;
}

/// A bound as one of a side, whose end may be on its ray.
static slrt_part_end slrt_bound_on(const slrt_sieve *s, const slrt_part_end *at, slrt_point end) {
    slrt_part_end bound = *at;
    if (at->crosses) return bound;
    if (!slrt_turn_to(s->envelope->eye, &at->ray, end)) return slrt_bound_at(s, end, true);
    bound.on = false;
    return bound;
}

static void slrt_see_side(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to) {
    slrt_part_end start, stop;
    if (number >= SLRT_AT_EYE) {
        slrt_see_part(s, number, NULL, from, to);
        return;
    }
    start = slrt_bound_on(s, from, side->a);
    stop = slrt_bound_on(s, to, side->b);
    slrt_see_part(s, number, side, &start, &stop);
}

/// Whether the piece is behind a side (1), before it (-1) or at it, on a ray that meets both.
static int slrt_depth_at(const slrt_sieve *s, const slrt_box_side *side, const slrt_ray *ray) {
    const slrt_eye *eye = s->envelope->eye;
    const int sign = slrt_side_meets(eye, ray, s->a, s->b, side->axis, side->at);
    return side->at > slrt_across(side, slrt_eye_at(eye)) ? -sign : sign;
}

/// How far the parts of a piece have come: what is before `at` is added, but for the piece itself
/// from `from` on while it is `open`.
typedef struct slrt_sieving {
    slrt_part_end at, from;
    bool open;
} slrt_sieving;

/// Ends the part of the piece that is open.
static void slrt_shut(const slrt_sieve *s, slrt_sieving *now, const slrt_part_end *at) {
    if (now->open) slrt_see_part(s, SLRT_NO_SIDE, NULL, &now->from, at);
    now->open = false;
}

static void slrt_open(slrt_sieving *now, const slrt_part_end *at) {
    if (!now->open) now->from = *at;
    now->open = true;
}

/// Goes on to a bound, with the side of an arc all the way.
static void slrt_pass_side(const slrt_sieve *s, slrt_sieving *now, uint32_t number,
                           const slrt_part_end *to) {
    slrt_box_side side;
    int first = 1, last = 1;
    if (number < SLRT_AT_EYE) {
        side = slrt_side_of(s->envelope, number);
        first = slrt_depth_at(s, &side, &now->at.ray);
        last = slrt_depth_at(s, &side, &to->ray);
    }
    if (first <= 0 && last <= 0) {
        slrt_open(now, &now->at);
    } else if (first >= 0 && last >= 0) {
        slrt_shut(s, now, &now->at);
        slrt_see_side(s, number, &side, &now->at, to);
    } else {
        slrt_part_end middle = slrt_bound_at(s, slrt_cross_side(s->a, s->b, &side), true);
        middle.crosses = true;
        if (first < 0) {
            slrt_open(now, &now->at);
            slrt_shut(s, now, &middle);
            slrt_see_side(s, number, &side, &middle, to);
        } else {
            slrt_shut(s, now, &now->at);
            slrt_see_side(s, number, &side, &now->at, &middle);
            slrt_open(now, &middle);
        }
    }
    now->at = *to;
}

/// The first arc that ends beyond the start of the piece.
static size_t slrt_first_arc(const slrt_sieve *s) {
    const slrt_envelope *e = s->envelope;
    const slrt_point eye = slrt_eye_at(e->eye);
    const slrt_ray *start = &s->start.ray;
    const int half =
        slrt_half_of(slrt_ray_sign(e->eye, start, 0), slrt_ray_sign(e->eye, start, 1), false);
    size_t low = 0, high = e->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const slrt_point left = slrt_get_arc(e, middle).left;
        const int order = slrt_half_at(eye, left, true) - half;
        if (order ? order < 0 : slrt_turn_to(e->eye, start, left) <= 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < e->count ? low : 0;
}

/// Whether an arc and the piece have directions in common. *held: the piece starts within the arc.
static bool slrt_meets_arc(const slrt_sieve *s, const slrt_arc *arc, bool is_first, bool *held) {
    const slrt_eye *eye = s->envelope->eye;
    const int from = slrt_turn_to(eye, &s->start.ray, arc->right);
    *held = is_first && from <= 0 && slrt_turn_to(eye, &s->start.ray, arc->left) > 0;
    return *held || (from >= 0 && slrt_turn_to(eye, &s->stop.ray, arc->right) < 0);
}

/// Sees a piece past the boxes.
static void slrt_sieve_piece(const slrt_sieve *s) {
    const slrt_envelope *e = s->envelope;
    size_t k = slrt_first_arc(s), i;
    slrt_arc arc = slrt_get_arc(e, k);
    slrt_sieving now;
    bool held, done = false;
    if (!slrt_meets_arc(s, &arc, true, &held)) {
        slrt_see_part(s, SLRT_NO_SIDE, NULL, &s->start, &s->stop);
        return;
    }
    now.at = now.from = s->start;
    now.open = false;
    for (i = 0; i < e->count && !done; i++) {
        slrt_part_end to;
        if (i && !slrt_meets_arc(s, &arc, false, &held)) break;
        if (!held && slrt_turn_to(e->eye, &now.at.ray, arc.right) > 0) {
            slrt_open(&now, &now.at);
            now.at = slrt_bound_at(s, arc.right, false);
        }
        done = slrt_turn_to(e->eye, &s->stop.ray, arc.left) >= 0;
        to = done ? s->stop : slrt_bound_at(s, arc.left, false);
        slrt_pass_side(s, &now, arc.side, &to);
        k = k + 1 < e->count ? k + 1 : 0;
        arc = slrt_get_arc(e, k);
    }
    if (!done) slrt_open(&now, &now.at);
    slrt_shut(s, &now, &s->stop);
}
