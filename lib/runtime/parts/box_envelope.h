/// Boxes about an eye: in each direction, the nearest side of all.

// Of each box the sides that face the eye count. They are merged, box by box, to their lower
// envelope about the eye: arcs, each with the one side that is nearest there.
//
//       wall ----------------------      arcs, counter-clockwise: side 1, side 2, a gap, side 3
//                  .--------.
//                  |   2  .-|--.         Where two sides cross, the upright one is nearer on the
//                 1|      |3|  |         side of the x axis, the level one on that of the y axis.
//                  '------|-'  |
//             eye *       '----'
//
// Invariant: arcs start and end at rays through exact points: corners of boxes, places where their
// sides cross. So all signs are exact. An arc is less than half a turn, and none passes +x. Cost:
// O(n log n) for n boxes (Hershberger 1989, Finding the upper envelope of n line segments in
// O(n log n) time: merging; here about an eye).
//
// The header and the library have this part and box_sieve.h in common. Each says before them what
// these are:
//
//     slrt_point         x, y
//     slrt_eye           an eye, which slrt_eye_at gives as a point
//     slrt_point_turn    which side of the ray from the eye through a point another point is on: 1
//                        left, -1 right, 0 in one line; exact
//     slrt_box_list      an array of boxes, of which slrt_read_box gives one: min x, min y, max x,
//                        max y

/// The directions from `right` to `left` in which one side of a box is the nearest of all. Side k
/// of box i is number 4 * i + k: its left, right, lower and upper side.
typedef struct slrt_arc {
    slrt_point right, left; ///< on its rays
    uint32_t side;
} slrt_arc;

/// In place of a side, for all numbers from here on: what the eye itself hides, as it stands where
/// sides of boxes part what is around it.
#define SLRT_AT_EYE (UINT32_MAX - 8)
/// No side, but what stands behind all of them.
#define SLRT_NO_SIDE UINT32_MAX

enum { SLRT_ARC_WORDS = (sizeof(slrt_arc) + 3) / 4 };

/// The envelope. Its memory is the caller's, of any alignment: see slrt_arcs_room.
typedef struct slrt_envelope {
    const slrt_eye *eye;
    const slrt_box_list *boxes;
    uint32_t *memory;
    size_t count; ///< of arcs
} slrt_envelope;

/// An envelope as it is made.
typedef struct slrt_envelope_maker {
    slrt_envelope e;
    int toward[2];   ///< a quadrant that is seen, by its signs: if the eye is on a box's border, it
                     ///< says whether the eye is in it
    size_t room;     ///< of arcs
    size_t floor;    ///< those from here on are being merged
    uint32_t last;   ///< the side of the last one
    size_t runs[64]; ///< where each run starts that waits to be merged
    unsigned char ranks[64]; ///< of these: a run of rank r has 2^r boxes
    unsigned run_count;
    bool is_full; ///< there were more, which slrt_arcs_room rules out where signs are right
} slrt_envelope_maker;

/// Room for the arcs of so many boxes. Corners of a box end three arcs. Counter-clockwise from the
/// x axis two sides cross from an upright one to a level one, so that each crossing needs a corner
/// or an end at which a level side gives way to an upright one: one for each box. So there are up
/// to 4n + 6 arcs. Runs that wait have up to 5n + 8, and merging them takes room for the result.
static size_t slrt_arcs_room(size_t boxes) {
    return 9 * boxes + 40;
}

/// A side of a box, as the eye sees it from right to left.
typedef struct slrt_box_side {
    slrt_point a, b;
    double at; ///< its x (axis 0) or y (axis 1)
    int axis;
} slrt_box_side;

static slrt_box_side slrt_side_of(const slrt_envelope *e, uint32_t number) {
    const int k = (int)(number % 4), axis = k >= 2;
    const slrt_point eye = slrt_eye_at(e->eye);
    slrt_box_side side;
    slrt_point low, high;
    double box[4];
    slrt_read_box(e->boxes, number / 4, box);
    side.axis = axis;
    side.at = box[axis + 2 * (k % 2)];
    low.x = axis ? box[0] : side.at;
    high.x = axis ? box[2] : side.at;
    low.y = axis ? side.at : box[1];
    high.y = axis ? side.at : box[3];
    if (axis ? side.at < eye.y : side.at > eye.x) {
        side.a = low, side.b = high;
    } else {
        side.a = high, side.b = low;
    }
    return side;
}

static double slrt_across(const slrt_box_side *side, slrt_point p) {
    return side->axis ? p.y : p.x;
}

/// Where a direction lies, given the signs of its x and y: 0 from +x on, 1 from -x on, 2 for an end
/// at +x, once around.
static int slrt_half_of(int x, int y, bool is_end) {
    if (y) return y < 0;
    return x < 0 ? 1 : is_end ? 2 : 0;
}

static int slrt_half_at(slrt_point eye, slrt_point p, bool is_end) {
    if (p.y != eye.y) return p.y < eye.y;
    return slrt_half_of(p.x < eye.x ? -1 : 1, 0, is_end);
}

/// The order of the directions of two points, counter-clockwise from +x.
static int slrt_point_order(const slrt_eye *eye, slrt_point p, bool p_ends, slrt_point q,
                            bool q_ends) {
    const slrt_point at = slrt_eye_at(eye);
    const int a = slrt_half_at(at, p, p_ends), b = slrt_half_at(at, q, q_ends);
    return a != b ? a - b : -slrt_point_turn(eye, p, q);
}

static slrt_arc slrt_get_arc(const slrt_envelope *e, size_t i) {
    slrt_arc arc;
    memcpy(&arc, e->memory + SLRT_ARC_WORDS * i, sizeof arc);
    return arc;
}

/// Adds an arc. One that goes on along the side of the last one becomes one with it.
static void slrt_push_arc(slrt_envelope_maker *m, uint32_t side, slrt_point right,
                          slrt_point left) {
    slrt_arc arc;
    if (m->e.count > m->floor && m->last == side) {
        arc = slrt_get_arc(&m->e, m->e.count - 1);
        if (arc.left.x == right.x && arc.left.y == right.y) {
            right = arc.right;
            m->e.count--;
        }
    }
    if (m->e.count == m->room) {
        m->is_full = true;
        return;
    }
    arc.right = right;
    arc.left = left;
    arc.side = m->last = side;
    memcpy(m->e.memory + SLRT_ARC_WORDS * m->e.count++, &arc, sizeof arc);
}

/// Adds the nearer one of two sides for all directions from `right` to `left`. At one distance it
/// is the first one.
static void slrt_push_nearer(slrt_envelope_maker *m, uint32_t a, uint32_t b, slrt_point right,
                             slrt_point left) {
    const slrt_point eye = slrt_eye_at(m->e.eye);
    slrt_box_side side_a, side_b;
    slrt_point cross;
    uint32_t first, then;
    if (a >= SLRT_AT_EYE || b >= SLRT_AT_EYE) {
        slrt_push_arc(m, a >= SLRT_AT_EYE ? a : b, right, left);
        return;
    }
    side_a = slrt_side_of(&m->e, a);
    side_b = slrt_side_of(&m->e, b);
    if (side_a.axis == side_b.axis) {
        const bool before = side_a.at<side_b.at, ahead = side_a.at> slrt_across(&side_a, eye);
        slrt_push_arc(m, side_a.at == side_b.at || before == ahead ? a : b, right, left);
        return;
    }
    cross.x = side_a.axis ? side_b.at : side_a.at;
    cross.y = side_a.axis ? side_a.at : side_b.at;
    // Closer to the x axis than the crossing, the upright side is nearer.
    first = ((cross.x > eye.x) == (cross.y > eye.y)) == (side_a.axis == 0) ? a : b;
    then = first == a ? b : a;
    if (slrt_point_turn(m->e.eye, left, cross) >= 0) {
        slrt_push_arc(m, first, right, left);
    } else if (slrt_point_turn(m->e.eye, right, cross) <= 0) {
        slrt_push_arc(m, then, right, left);
    } else {
        slrt_push_arc(m, first, right, cross);
        slrt_push_arc(m, then, cross, left);
    }
}

/// A run of arcs that is used up from its start.
typedef struct slrt_run {
    slrt_arc arc; ///< what is left of the first one
    size_t at, end;
} slrt_run;

static slrt_run slrt_start_run(const slrt_envelope_maker *m, size_t at, size_t end) {
    slrt_run run;
    run.arc = slrt_get_arc(&m->e, at);
    run.at = at;
    run.end = end;
    return run;
}

static void slrt_next_arc(const slrt_envelope_maker *m, slrt_run *run) {
    if (++run->at < run->end) run->arc = slrt_get_arc(&m->e, run->at);
}

static void slrt_push_rest(slrt_envelope_maker *m, slrt_run *run) {
    for (; run->at < run->end; slrt_next_arc(m, run))
        slrt_push_arc(m, run->arc.side, run->arc.right, run->arc.left);
}

/// Merges two runs, with what comes first of them.
static void slrt_merge_next(slrt_envelope_maker *m, slrt_run *a, slrt_run *b) {
    const int order = slrt_point_order(m->e.eye, a->arc.right, false, b->arc.right, false);
    if (order) {
        // The one that starts first goes up to its end, or to where the other one starts.
        slrt_run *first = order < 0 ? a : b;
        const slrt_point stop = order < 0 ? b->arc.right : a->arc.right;
        const bool apart = slrt_point_order(m->e.eye, first->arc.left, true, stop, false) <= 0;
        slrt_push_arc(m, first->arc.side, first->arc.right, apart ? first->arc.left : stop);
        first->arc.right = stop;
        if (apart) slrt_next_arc(m, first);
    } else {
        const int ends = slrt_point_order(m->e.eye, a->arc.left, true, b->arc.left, true);
        const slrt_point stop = ends <= 0 ? a->arc.left : b->arc.left;
        slrt_push_nearer(m, a->arc.side, b->arc.side, a->arc.right, stop);
        a->arc.right = b->arc.right = stop;
        if (ends <= 0) slrt_next_arc(m, a);
        if (ends >= 0) slrt_next_arc(m, b);
    }
}

/// Merges the last two runs.
static void slrt_merge_last(slrt_envelope_maker *m) {
    const size_t to = m->runs[m->run_count - 2], stop = m->e.count;
    slrt_run a, b;
    size_t i;
    m->run_count--;
    m->ranks[m->run_count - 1]++;
    a = slrt_start_run(m, to, m->runs[m->run_count]);
    b = slrt_start_run(m, m->runs[m->run_count], stop);
    m->floor = stop;
    while (a.at < a.end && b.at < b.end) slrt_merge_next(m, &a, &b);
    slrt_push_rest(m, &a);
    slrt_push_rest(m, &b);
    m->e.count -= stop - to;
    for (i = to; i < m->e.count; i++)
        memcpy(m->e.memory + SLRT_ARC_WORDS * i, m->e.memory + SLRT_ARC_WORDS * (i + stop - to),
               sizeof(slrt_arc));
}

static void slrt_start_envelope(slrt_envelope_maker *m, const slrt_eye *eye,
                                const slrt_box_list *boxes, uint32_t *memory, size_t room) {
    m->e.eye = eye;
    m->e.boxes = boxes;
    m->e.memory = memory;
    m->e.count = 0;
    m->toward[0] = m->toward[1] = 1;
    m->room = room;
    m->run_count = 0;
    m->is_full = false;
}

/// Starts a run with an arc, in two parts where it passes +x.
static void slrt_push_run(slrt_envelope_maker *m, uint32_t side, slrt_point right,
                          slrt_point left) {
    m->floor = m->runs[m->run_count] = m->e.count;
    m->ranks[m->run_count++] = 0;
    if (slrt_point_order(m->e.eye, right, false, left, true) < 0) {
        slrt_push_arc(m, side, right, left);
    } else {
        slrt_point split;
        split.x = slrt_side_of(&m->e, side).at;
        split.y = slrt_eye_at(m->e.eye).y;
        slrt_push_arc(m, side, split, left);
        slrt_push_arc(m, side, right, split);
    }
}

/// Whether the eye is in a box and the quadrant that it sees too.
static bool slrt_looks_from_within(const slrt_envelope_maker *m, const double *box) {
    const slrt_point eye = slrt_eye_at(m->e.eye);
    return (m->toward[0] > 0 ? box[0] <= eye.x && eye.x < box[2]
                             : box[0] < eye.x && eye.x <= box[2]) &&
           (m->toward[1] > 0 ? box[1] <= eye.y && eye.y < box[3]
                             : box[1] < eye.y && eye.y <= box[3]);
}

/// Whether the eye sees side k of a box, if nothing else is there: one that faces it, or any from
/// within.
static bool slrt_sees_side(const slrt_envelope_maker *m, const double *box, bool is_in, int k) {
    const slrt_point eye = slrt_eye_at(m->e.eye);
    const int axis = k >= 2;
    const double from = axis ? eye.y : eye.x, at = box[axis + 2 * (k % 2)];
    if (!(box[!axis] < box[2 + !axis])) return false;
    if (is_in) return from != at;
    return k % 2 ? from > at : from < at;
}

/// Adds a box. Runs of as many boxes are merged: so each arc takes part in few merges.
static void slrt_add_box(slrt_envelope_maker *m, uint32_t number) {
    const unsigned before = m->run_count;
    bool is_in;
    double box[4];
    int k;
    slrt_read_box(m->e.boxes, number, box);
    is_in = slrt_looks_from_within(m, box);
    for (k = 0; k < 4; k++) {
        slrt_box_side side;
        if (!slrt_sees_side(m, box, is_in, k)) continue;
        side = slrt_side_of(&m->e, 4 * number + (uint32_t)k);
        slrt_push_run(m, 4 * number + (uint32_t)k, side.a, side.b);
        if (m->run_count > before + 1) slrt_merge_last(m);
    }
    if (m->run_count == before) return;
    m->ranks[before] = 0;
    while (m->run_count > 1 && m->ranks[m->run_count - 2] == m->ranks[m->run_count - 1])
        slrt_merge_last(m);
}

static void slrt_finish_envelope(slrt_envelope_maker *m) {
    while (m->run_count > 1) slrt_merge_last(m);
}
