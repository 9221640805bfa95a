/// The points of the polygon: where pieces join, and how a range cuts them.

static slrt_arm slrt_arm_to(const slrt_polygon *p, const double *point) {
    return slrt_make_arm(p->s.x, p->s.y, point[0], point[1]);
}

/// If a damaged file has corners far outside its bounds, a point may be no number: then there is no
/// polygon.
static void slrt_put(slrt_polygon *p, const double *point) {
    p->broken = p->broken || !slrt_is_finite(point[0]) || !slrt_is_finite(point[1]);
    if (p->written < p->room) memcpy(p->points + 2 * (size_t)p->written, point, 2 * sizeof *point);
    p->written++;
}

/// Limits a number to those between a and b.
static double slrt_limited(double a, double value, double b) {
    const double low = a < b ? a : b, high = a < b ? b : a;
    return !(value >= low) ? low : value > high ? high : value;
}

// The range cuts the polygon, edge by edge, by a circle about the eye:
//
//          q____
//     p'  /      An edge on a wall, from p to q, keeps what is inside. Before and after it stand
//      .-+--.    arcs between the directions of its ends. Radial edges end at the circle. Arcs in a
//     (  |   )   row join, and become chords. All that is in doubles, in units of the range and
//      `-*--'    relative to the eye. Every edge and arc adds the point where it starts.

static double slrt_dot(const double *u, const double *v) {
    return u[0] * v[0] + u[1] * v[1];
}

static double slrt_turned(const double *u, const double *v) {
    return u[0] * v[1] - u[1] * v[0];
}

/// The square root, by Newton's steps; 0 for what has none.
static double slrt_root(double square) {
    uint64_t bits;
    double root;
    int i;
    if (!(square > 0)) return 0;
    memcpy(&bits, &square, sizeof bits);
    bits = (bits >> 1) + (UINT64_C(1023) << 51); // halves the exponent
    memcpy(&root, &bits, sizeof root);
    for (i = 0; i < 5; i++) root = (root + square / root) / 2;
    return root;
}

/// Makes a vector's length 1.
static void slrt_make_unit(double *u) {
    const double larger = slrt_larger(u[0], u[1]);
    double length;
    u[0] /= larger;
    u[1] /= larger;
    length = slrt_root(slrt_dot(u, u));
    u[0] /= length;
    u[1] /= length;
}

/// Adds a point that is given in units of the range.
static void slrt_put_unit(slrt_polygon *p, const double *u) {
    double point[2];
    point[0] = p->s.x + u[0] * p->s.range;
    point[1] = p->s.y + u[1] * p->s.range;
    slrt_put(p, point);
}

/// Adds the chords of an arc that is begun: it is halved until a part is at most 1/128 of the
/// circle.
static void slrt_end_arc(slrt_polygon *p) {
    const double most = 0.0024090935; // the square of such a chord
    double part[2], at[2];
    int i, count = 1;
    if (!p->has_arc) return;
    p->has_arc = false;
    slrt_put_unit(p, p->arc);
    memcpy(part, p->arc_end, sizeof part);
    for (; count < 256; count *= 2) {
        const double x = part[0] - p->arc[0], y = part[1] - p->arc[1];
        if (!(x * x + y * y > most)) break;
        part[0] = y, part[1] = -x; // the direction of the middle
        slrt_make_unit(part);
    }
    memcpy(at, p->arc, sizeof at);
    for (i = 1; i < count; i++) {
        const double cosine = slrt_dot(p->arc, part), sine = slrt_turned(p->arc, part);
        const double x = at[0];
        at[0] = cosine * x - sine * at[1];
        at[1] = cosine * at[1] + sine * x;
        slrt_put_unit(p, at);
    }
}

/// Goes on with the arc, or begins one. One that is shorter than rounding is left out.
static void slrt_add_arc(slrt_polygon *p, const double *from, const double *to) {
    if (!(slrt_turned(from, to) > 1e-15) && slrt_dot(from, to) > 0) return;
    if (!p->has_arc || slrt_turned(p->arc, to) <= 0) {
        slrt_end_arc(p);
        memcpy(p->arc, from, sizeof p->arc);
    }
    memcpy(p->arc_end, to, sizeof p->arc_end);
    p->has_arc = true;
}

/// An edge in units of the range: its ends, the directions to them, and what of it, in shares from
/// 0 to 1, is inside.
typedef struct slrt_chord {
    double a[2], along[2], from[2], to[2];
    bool a_inside, b_inside;
    double enter, leave;
} slrt_chord;

static slrt_chord slrt_chord_of(const slrt_polygon *p, const double *a, const double *b) {
    slrt_chord c;
    double length, distance, foot, half;
    c.a[0] = c.from[0] = (a[0] - p->s.x) / p->s.range;
    c.a[1] = c.from[1] = (a[1] - p->s.y) / p->s.range;
    c.to[0] = (b[0] - p->s.x) / p->s.range;
    c.to[1] = (b[1] - p->s.y) / p->s.range;
    c.along[0] = c.to[0] - c.a[0];
    c.along[1] = c.to[1] - c.a[1];
    c.a_inside = slrt_dot(c.from, c.from) <= 1;
    c.b_inside = slrt_dot(c.to, c.to) <= 1;
    if (!c.a_inside) slrt_make_unit(c.from);
    if (!c.b_inside) slrt_make_unit(c.to);
    length = slrt_root(slrt_dot(c.along, c.along));
    distance = slrt_turned(c.a, c.along) / length;
    foot = -slrt_dot(c.a, c.along) / length;
    half = slrt_root((1 - distance) * (1 + distance));
    c.enter = (foot - half) / length;
    c.leave = (foot + half) / length;
    return c;
}

/// Where an edge crosses the circle: as a point, and in units of the range.
static void slrt_cross_circle(const slrt_polygon *p, const slrt_chord *c, double share,
                              const double *a, const double *b, double *point, double *unit) {
    unit[0] = c->a[0] + share * c->along[0];
    unit[1] = c->a[1] + share * c->along[1];
    point[0] = slrt_limited(a[0], p->s.x + unit[0] * p->s.range, b[0]);
    point[1] = slrt_limited(a[1], p->s.y + unit[1] * p->s.range, b[1]);
}

/// Adds what a range leaves of an edge.
static void slrt_cut_edge(slrt_polygon *p, const double *a, const double *b, bool radial) {
    const slrt_chord c = slrt_chord_of(p, a, b);
    double point[2], unit[2];
    if (c.a_inside) {
        slrt_end_arc(p);
        slrt_put(p, a);
    } else if (radial) {
        if (!c.b_inside) return;
        slrt_end_arc(p);
        slrt_put_unit(p, c.from);
    } else if (c.b_inside || (c.enter < c.leave && c.enter < 1 && c.leave > 0)) {
        slrt_cross_circle(p, &c, c.enter, a, b, point, unit);
        slrt_add_arc(p, c.from, unit);
        slrt_end_arc(p);
        slrt_put(p, point);
    } else {
        slrt_add_arc(p, c.from, c.to);
        return;
    }
    if (c.b_inside || radial) return;
    slrt_cross_circle(p, &c, c.leave, a, b, point, unit);
    slrt_add_arc(p, unit, c.to);
}

// The points of the polygon.

/// Adds a point, unless it is the last one. `radial`: the edge to it leads from or to the eye.
static void slrt_add_point(slrt_polygon *p, const double *point, bool radial) {
    if (p->count && slrt_same_place(p->last, point)) {
        p->first_is_short = p->first_is_short || p->count == 1;
        return;
    }
    if (!(p->s.range > 0)) {
        slrt_put(p, point);
    } else if (p->count == 1 && p->waits) {
        memcpy(p->second, point, sizeof p->second);
        p->second_is_radial = radial;
    } else if (p->count) {
        slrt_cut_edge(p, p->last, point, radial);
    }
    memcpy(p->last, point, sizeof p->last);
    if (!p->count) memcpy(p->first, point, sizeof p->first);
    p->count++;
}

/// Where a ray meets the line of a piece.
static void slrt_meet_line(const slrt_polygon *p, const slrt_arm *ray, const slrt_piece *piece,
                           double *out) {
    const double *a = piece->a, *b = piece->b;
    double share;
    if (a[0] == b[0]) {
        share = (a[0] - p->s.x) / ray->x;
    } else if (a[1] == b[1]) {
        share = (a[1] - p->s.y) / ray->y;
    } else {
        const slrt_pair x = slrt_difference(b[0], a[0]), y = slrt_difference(b[1], a[1]);
        share = slrt_cross(slrt_difference(a[0], p->s.x), slrt_difference(a[1], p->s.y), x, y) /
                slrt_cross(slrt_difference(ray->to_x, ray->from_x),
                           slrt_difference(ray->to_y, ray->from_y), x, y);
    }
    out[0] = slrt_limited(a[0], p->s.x + ray->x * share, b[0]);
    out[1] = slrt_limited(a[1], p->s.y + ray->y * share, b[1]);
}

/// The end of a piece: its own, or where a border meets its line.
static void slrt_place(const slrt_polygon *p, uint32_t border, const double *own,
                       const slrt_piece *piece, double *out) {
    if (border == SLRT_NONE) {
        memcpy(out, own, 2 * sizeof *out);
    } else {
        const slrt_arm ray = slrt_border(&p->s, border);
        slrt_meet_line(p, &ray, piece, out);
    }
}

/// Whether two pieces lie in one line.
static bool slrt_in_line(const slrt_piece *piece, const slrt_piece *other) {
    const double *a = piece->a, *b = piece->b;
    if (a[0] == b[0]) return other->a[0] == a[0] && other->b[0] == a[0];
    if (a[1] == b[1]) return other->a[1] == a[1] && other->b[1] == a[1];
    return !slrt_turn(a, b, other->a) && !slrt_turn(a, b, other->b);
}

/// Adds the end of the pending piece.
static void slrt_end_pending(slrt_polygon *p) {
    double end[2];
    if (!p->pending) return;
    slrt_place(p, p->piece_left, p->piece_end, &p->piece, end);
    slrt_add_point(p, end, false);
    p->pending = false;
}

static bool slrt_joins(const slrt_polygon *p, const slrt_piece *piece) {
    return p->pending && slrt_in_line(&p->piece, piece);
}

/// Adds the start of a piece that does not join the pending one.
static void slrt_start_piece(slrt_polygon *p, const slrt_piece *piece, const double *start) {
    slrt_end_pending(p);
    if (!p->count) p->first_piece = *piece;
    slrt_add_point(p, start, true);
}

/// Goes on with a piece up to a border, or to a place for SLRT_NONE.
static void slrt_extend_piece(slrt_polygon *p, const slrt_piece *piece, uint32_t left,
                              const double *end) {
    p->pending = true;
    p->piece = *piece;
    p->piece_left = left;
    memcpy(p->piece_end, end, sizeof p->piece_end);
}

/// Adds a wall, from the border `right` to the border `left` or, for SLRT_NONE, its own ends.
static void slrt_add_wall(slrt_polygon *p, const slrt_piece *piece, uint32_t right, uint32_t left) {
    if (!slrt_joins(p, piece)) {
        double start[2];
        slrt_place(p, right, piece->a, piece, start);
        slrt_start_piece(p, piece, start);
    }
    slrt_extend_piece(p, piece, left, piece->b);
}

/// Adds the eye, where the polygon has it as a corner.
static void slrt_add_eye(slrt_polygon *p) {
    double eye[2];
    eye[0] = p->s.x;
    eye[1] = p->s.y;
    slrt_end_pending(p);
    if (!p->count) p->first_is_short = true; // no piece starts there
    slrt_add_point(p, eye, true);
}

/// Ends the polygon. All round, the last piece may go on as the first one. Then that one's start
/// goes, unless rounding made it the end too.
static void slrt_close(slrt_polygon *p, bool all_round) {
    const bool goes_on = all_round && p->pending && p->count > 1 && !p->first_is_short &&
                         slrt_in_line(&p->first_piece, &p->piece);
    bool meets;
    if (!goes_on) slrt_end_pending(p);
    meets = p->count > 1 && slrt_same_place(p->first, p->last);
    if (goes_on || meets) p->count--;
    if (!(p->s.range > 0)) {
        if (goes_on && p->room) memcpy(p->points, p->last, sizeof p->last);
        p->written = p->count;
        return;
    }
    if (p->count < 2) return;
    if (goes_on) {
        slrt_cut_edge(p, p->last, p->second, false);
    } else {
        if (!meets) slrt_cut_edge(p, p->last, p->first, true);
        if (p->waits) slrt_cut_edge(p, p->first, p->second, p->second_is_radial);
    }
    slrt_end_arc(p);
}
