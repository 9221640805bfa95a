/// Cell to cell: the lines through a sequence of portals.

// All lines with the left ends of some portals on their left and the right ends on their right form
// a convex polygon in the plane of lines. Its corners are lines through two ends. On an edge a line
// turns about one end, the pivot. One more portal cuts the polygon by two half-planes, and all
// signs are of three ends: exact. (The funnel of the library is the same; stab/funnel.c has more.)
//
// Ends are numbered as borders of sectors: 2 * directed portal for the left one, 1 more for the
// right one.

/// A corner: the line from one end to another, and the end about which it turns to the next one.
typedef struct slrt_corner {
    uint32_t from, to, pivot;
} slrt_corner;

/// A step of a sequence: a cell, how many of its ways out are done, the directed portals that bound
/// the directions of all so far, the first one, and the polygon's corners.
typedef struct slrt_stab_step {
    uint32_t cell, done;
    uint32_t least, most;
    uint32_t line;         ///< the first directed portal; SLRT_NONE before it
    uint32_t first, count; ///< corners; none for one portal
} slrt_stab_step;

/// The corners of all steps of a sequence, one behind the other.
typedef struct slrt_stab {
    const sl_runtime *rt;
    slrt_corner *corners;
    uint32_t room;
    bool full; ///< there was no room: nothing is decided
} slrt_stab;

static void slrt_stab_end(const slrt_stab *s, uint32_t end, double *at) {
    slrt_read_end(s->rt, end / 2, (int)(end % 2), at);
}

static slrt_arm slrt_stab_arm(const slrt_stab *s, uint32_t from, uint32_t to) {
    double a[2], b[2];
    slrt_stab_end(s, from, a);
    slrt_stab_end(s, to, b);
    return slrt_make_arm(a[0], a[1], b[0], b[1]);
}

/// Whether the line of a corner has a new end on the right side: 1, on it: 0.
static int slrt_stab_side(const slrt_stab *s, const slrt_corner *c, uint32_t end) {
    double from[2], to[2], at[2];
    int turn;
    if (end == c->from || end == c->to) return 0;
    slrt_stab_end(s, c->from, from);
    slrt_stab_end(s, c->to, to);
    slrt_stab_end(s, end, at);
    turn = slrt_turn(from, to, at);
    return end % 2 ? -turn : turn;
}

static slrt_corner slrt_make_corner(uint32_t from, uint32_t to, uint32_t pivot) {
    slrt_corner corner;
    corner.from = from;
    corner.to = to;
    corner.pivot = pivot;
    return corner;
}

/// The corner that a new end makes on the edge that turns about `pivot`. `leaving`: going round,
/// the cut starts there. The sense of the turn says which of the two ends comes first.
static slrt_corner slrt_cut_at(uint32_t pivot, uint32_t end, bool leaving) {
    const bool pivot_first = (!(pivot % 2) != leaving) == !(end % 2);
    return slrt_make_corner(pivot_first ? pivot : end, pivot_first ? end : pivot,
                            leaving ? end : pivot);
}

/// Cuts by an end while there is no polygon: the first portal, `line`, is all there is. The next
/// one is on another side of a cell, so one end of it at most is on the same line, and not between
/// the ends of the first.
static void slrt_cut_line(slrt_stab *s, slrt_stab_step *step, uint32_t end) {
    const uint32_t left = 2 * step->line, right = left + 1;
    slrt_corner *to = s->corners + step->first;
    double a[2], b[2], at[2];
    bool upwards;
    int side;
    slrt_stab_end(s, right, a);
    slrt_stab_end(s, left, b);
    slrt_stab_end(s, end, at);
    side = slrt_turn(a, b, at);
    if (!side) return;
    if (step->first + 3 > s->room) {
        s->full = true;
        return;
    }
    // Of the two directions along the line, the end leaves one. Upwards: from right to left.
    upwards = !(end % 2) == (side > 0);
    to[0] = upwards ? slrt_make_corner(right, left, left) : slrt_make_corner(left, right, right);
    to[1] = slrt_cut_at(upwards ? left : right, end, true);
    to[2] = slrt_cut_at(upwards ? right : left, end, false);
    step->count = 3;
}

/// Cuts the polygon `from`, of `count` corners, by an end, into the step's place. False if no line
/// is left. The corners outside follow on each other: behind the last one of them come the corners
/// that are kept.
static bool slrt_cut_polygon(slrt_stab *s, slrt_stab_step *step, const slrt_corner *from,
                             uint32_t count, uint32_t end) {
    slrt_corner *to = s->corners + step->first;
    uint32_t i, out = 0, last_out = 0, kept;
    int before = slrt_stab_side(s, &from[count - 1], end), entering = 0, leaving = 0;
    if (step->first + count + 2 > s->room) {
        s->full = true;
        return true;
    }
    for (i = 0; i < count; i++) {
        const int side = slrt_stab_side(s, &from[i], end);
        if (side >= 0 && before < 0) {
            last_out = i ? i - 1 : count - 1;
            entering = side;
        }
        if (side < 0 && before >= 0) leaving = before;
        if (side < 0) out++;
        before = side;
    }
    if (out == count) return false;
    step->count = 0;
    if (!out) last_out = count - 1;
    for (i = last_out, kept = count - out; kept; kept--) {
        i = i + 1 < count ? i + 1 : 0;
        to[step->count++] = from[i];
    }
    if (!out) return true;
    if (leaving > 0) to[step->count++] = slrt_cut_at(from[i].pivot, end, true);
    to[step->count - 1].pivot = end;
    if (entering > 0) to[step->count++] = slrt_cut_at(from[last_out].pivot, end, false);
    return true;
}

/// Whether some direction crosses a directed portal and all before it strictly forwards. Their
/// directions, from right end to left, span less than half a turn.
static bool slrt_stab_direction(const slrt_stab *s, slrt_stab_step *step, uint32_t directed) {
    const slrt_arm least = slrt_stab_arm(s, 2 * step->least + 1, 2 * step->least);
    const slrt_arm most = slrt_stab_arm(s, 2 * step->most + 1, 2 * step->most);
    const slrt_arm across = slrt_stab_arm(s, 2 * directed + 1, 2 * directed);
    const int from_least = slrt_side(&least, &across), from_most = slrt_side(&most, &across);
    if (!from_least && !from_most) return slrt_same_way(&least, &across);
    if (from_least >= 0 && from_most <= 0) return true;
    if (from_least <= 0 && from_most >= 0) return false;
    if (from_most > 0)
        step->most = directed;
    else
        step->least = directed;
    return true;
}

/// Adds a directed portal to the sequence whose last step is `last`: makes `step`, whose corners
/// come behind those of all others. False if no line passes all portals.
static bool slrt_stab_push(slrt_stab *s, const slrt_stab_step *last, uint32_t directed,
                           slrt_stab_step *step) {
    enum { MOST = 64 };
    slrt_corner between[MOST];
    *step = *last;
    step->done = 0;
    step->first = last->first + last->count;
    if (last->line == SLRT_NONE) {
        step->line = step->least = step->most = directed;
        return true;
    }
    if (!slrt_stab_direction(s, step, directed)) return false;
    if (!last->count)
        slrt_cut_line(s, step, 2 * directed);
    else if (!slrt_cut_polygon(s, step, s->corners + last->first, last->count, 2 * directed))
        return false;
    if (!step->count) {
        slrt_cut_line(s, step, 2 * directed + 1);
        return true;
    }
    if (s->full || step->count > MOST) {
        s->full = true;
        return true;
    }
    memcpy(between, s->corners + step->first, step->count * sizeof *between);
    return slrt_cut_polygon(s, step, between, step->count, 2 * directed + 1);
}
