/// The visible polygon.

// The view spreads from the cells at the eye through open portals, as sectors between two borders:
//
//      +---------+--------.-+
//      |         |    .  left     On the way around the next cell, counter-clockwise from the
//      |         b .        |     portal ab, pieces of its boundary come that are right of the
//      |  eye *  |   seen   |     sector, then those within it, then those left of it. A wall is
//      |         a .        |     added to the polygon; a portal is entered with the sector
//      |         |    .  right    between its ends.
//      +---------+--------.-+
//
// Invariant: cells are convex and a sector is narrower than half a circle. So pieces within come in
// counter-clockwise order, depth first, and the polygon needs no sorting. Signs are exact. Pieces
// in one line join; where one ends is computed only when the next one is known not to join. Cost:
// the sides and portals of the cells that are seen, counted once for each sector. (Teller 1992;
// with triangles for cells: Bungiu et al. 2014, Efficient Computation of Visibility Polygons.)

static slrt_arm slrt_arm_to(const slrt_polygon *p, const double *point) {
    return slrt_make_arm(p->s.x, p->s.y, point[0], point[1]);
}

/// The other cell's directed portal of the same portal; SLRT_NONE in a file that is not sound.
static uint32_t slrt_twin(const slrt_polygon *p, uint32_t directed) {
    const unsigned char *at = p->s.rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES;
    const uint32_t portal = slrt_u32(at);
    const sl_runtime_cell cell = sl_runtime_get_cell(p->s.rt, slrt_u32(at + 4));
    uint32_t i;
    for (i = cell.first_directed; i < cell.first_directed + cell.directed_count; i++)
        if (i != directed &&
            slrt_u32(p->s.rt->directed + (size_t)i * SLRT_DIRECTED_BYTES) == portal)
            return i;
    return SLRT_NONE;
}

/// If a damaged file has corners far outside its bounds, a point may be no number: then there is no
/// polygon. As bits, which no fast-math option changes.
static bool slrt_is_number(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits >> 52 & 0x7ff) != 0x7ff;
}

static void slrt_put(slrt_polygon *p, const double *point) {
    p->broken = p->broken || !slrt_is_number(point[0]) || !slrt_is_number(point[1]);
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

/// The cross product u x v of arms, rounded once or twice: the sum of its exact parts.
static double slrt_cross(const slrt_arm *u, const slrt_arm *v) {
    double parts[16], sum = 0;
    int i, count = 0;
    count = slrt_add_product(parts, count, u->to_x, v->to_y);
    count = slrt_add_product(parts, count, u->to_x, -v->from_y);
    count = slrt_add_product(parts, count, -u->from_x, v->to_y);
    count = slrt_add_product(parts, count, u->from_x, v->from_y);
    count = slrt_add_product(parts, count, -u->to_y, v->to_x);
    count = slrt_add_product(parts, count, u->to_y, v->from_x);
    count = slrt_add_product(parts, count, u->from_y, v->to_x);
    count = slrt_add_product(parts, count, -u->from_y, v->from_x);
    for (i = 0; i < count; i++) sum += parts[i];
    return sum;
}

/// The end of a piece: its own, or where a border meets its line.
static void slrt_place(const slrt_polygon *p, uint32_t border, const double *own,
                       const slrt_piece *piece, double *out) {
    const double *a = piece->a, *b = piece->b;
    slrt_arm ray, along, to;
    double share;
    if (border == SLRT_NONE) {
        memcpy(out, own, 2 * sizeof *out);
        return;
    }
    ray = slrt_border(&p->s, border);
    if (a[0] == b[0]) {
        share = (a[0] - p->s.x) / ray.x;
    } else if (a[1] == b[1]) {
        share = (a[1] - p->s.y) / ray.y;
    } else {
        along = slrt_make_arm(a[0], a[1], b[0], b[1]);
        to = slrt_arm_to(p, a);
        share = slrt_cross(&to, &along) / slrt_cross(&ray, &along);
    }
    out[0] = slrt_limited(a[0], p->s.x + ray.x * share, b[0]);
    out[1] = slrt_limited(a[1], p->s.y + ray.y * share, b[1]);
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
    slrt_place(p, p->piece_left, p->piece.b, &p->piece, end);
    slrt_add_point(p, end, false);
    p->pending = false;
}

/// Adds a wall, from the border `right` to the border `left` or, for SLRT_NONE, its own ends.
static void slrt_add_wall(slrt_polygon *p, const slrt_piece *piece, uint32_t right, uint32_t left) {
    if (!p->pending || !slrt_in_line(&p->piece, piece)) {
        double start[2];
        slrt_place(p, right, piece->a, piece, start);
        slrt_end_pending(p);
        if (!p->count) p->first_piece = *piece;
        slrt_add_point(p, start, true);
    }
    p->pending = true;
    p->piece = *piece;
    p->piece_left = left;
}

/// Adds the eye, where the polygon has it as a corner.
static void slrt_add_eye(slrt_polygon *p) {
    double eye[2];
    eye[0] = p->s.x;
    eye[1] = p->s.y;
    slrt_end_pending(p);
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

/// The borders of what is seen through a portal: those given, or its own ends for SLRT_NONE. False
/// if it is blocked or out of range, and for no portal.
static bool slrt_pass(const slrt_polygon *p, uint32_t portal, uint32_t *right, uint32_t *left) {
    if (portal == SLRT_NONE || slrt_is_blocked(&p->s, portal)) return false;
    if (*right == SLRT_NONE) *right = 2 * portal + 1;
    if (*left == SLRT_NONE) *left = 2 * portal;
    return !(p->s.range > 0) || slrt_in_range(&p->s, portal, *right, *left);
}

// The search. The path is a stack of six numbers for each cell: the cell, the portal through which
// it was entered, the portal passed last and its side, and the borders of the sector.

enum { SLRT_FRAME = 6 };

static void slrt_push(slrt_polygon *p, uint32_t directed, uint32_t right, uint32_t left) {
    uint32_t *top = p->s.path + (size_t)SLRT_FRAME * p->s.depth;
    const uint32_t twin = slrt_twin(p, directed);
    sl_runtime_cell cell;
    if (twin == SLRT_NONE || p->s.depth == p->s.rt->cell_count) {
        p->broken = true;
        return;
    }
    top[0] = slrt_u32(p->s.rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 4);
    cell = sl_runtime_get_cell(p->s.rt, top[0]);
    top[1] = top[2] = twin;
    top[3] = slrt_side_of_portal(p, &cell, twin);
    top[4] = right;
    top[5] = left;
    p->s.depth++;
}

/// Goes on around the cell on top of the path: adds walls up to the next open portal and enters
/// that, or leaves the cell.
static void slrt_spread_on(slrt_polygon *p) {
    uint32_t *top = p->s.path + (size_t)SLRT_FRAME * (p->s.depth - 1);
    const slrt_arm a = slrt_border(&p->s, top[4]), b = slrt_border(&p->s, top[5]);
    bool within = top[2] != top[1]; // what is right of the sector is passed
    slrt_walk w;
    slrt_piece piece;
    w.cell = sl_runtime_get_cell(p->s.rt, top[0]);
    slrt_walk_start(p, &w, top[1], top[2], top[3], 1);
    while (slrt_walk_next(p, &w, &piece)) {
        const uint32_t portal = piece.directed;
        const slrt_arm to = slrt_arm_to(p, piece.b);
        uint32_t right = SLRT_NONE, left = SLRT_NONE;
        int end;
        if (!within) {
            const slrt_arm from = slrt_arm_to(p, piece.a);
            if (slrt_side(&a, &to) <= 0) continue;
            if (slrt_side(&from, &a) > 0) right = top[4];
            within = true;
        }
        end = slrt_side(&to, &b);
        if (end < 0) left = top[5];
        if (slrt_pass(p, portal, &right, &left)) {
            top[2] = portal;
            top[3] = w.side;
            if (end <= 0) p->s.depth--; // nothing is left to see of this cell
            slrt_push(p, portal, right, left);
            return;
        }
        slrt_add_wall(p, &piece, right, left);
        if (end <= 0) break;
    }
    p->s.depth--;
}

/// Adds what is seen of a piece, or through it.
static void slrt_see_piece(slrt_polygon *p, const slrt_piece *piece, uint32_t right,
                           uint32_t left) {
    const uint32_t portal = piece->directed;
    if (!slrt_pass(p, portal, &right, &left)) {
        slrt_add_wall(p, piece, right, left);
        return;
    }
    slrt_push(p, portal, right, left);
    while (p->s.depth && !p->broken) slrt_spread_on(p);
}

// The fan: the pieces about the eye, of all cells that touch it.

/// Sees a piece of the fan, as far as it is in the sector. The fan may start anywhere. So the first
/// lap begins with the piece that the sector starts in, and the second lap ends before that piece.
static void slrt_see_fan_piece(slrt_polygon *p, const slrt_piece *piece, const slrt_arm *from,
                               const slrt_arm *to) {
    uint32_t right = SLRT_NONE, left = SLRT_NONE;
    if (p->in_sector) {
        const slrt_arm a = slrt_border(&p->s, p->right), b = slrt_border(&p->s, p->left);
        const int from_a = slrt_side(from, &a), a_to = slrt_side(&a, to);
        const bool starts = from_a >= 0 && a_to > 0;
        if (starts) p->done = p->second_lap && p->started;
        if (starts && !p->second_lap) p->started = true;
        if (p->done || (!p->second_lap && !p->started)) return;
        if (!starts && (from_a > 0 || slrt_side(from, &b) <= 0)) return;
        if (from_a > 0) right = p->right;
        if (a_to <= 0 || slrt_side(to, &b) < 0) left = p->left;
    }
    // The fan starts behind the gap: who comes to an earlier piece has passed it.
    if (p->gap && (p->fan_at < p->fan_last || (p->fan_at == p->fan_last && right == SLRT_NONE)))
        slrt_add_eye(p);
    p->fan_last = p->fan_at;
    slrt_see_piece(p, piece, right, left);
}

/// Goes around a cell of the fan. On its border, the eye sees a run of pieces: it begins behind one
/// that does not face the eye.
static void slrt_see_fan_cell(slrt_polygon *p, uint32_t cell) {
    bool run = p->inside, ready = p->inside;
    slrt_walk w;
    slrt_piece piece;
    slrt_walk_around(p, &w, cell, p->inside ? 1 : 2);
    while (slrt_walk_next(p, &w, &piece)) {
        const slrt_arm from = slrt_arm_to(p, piece.a), to = slrt_arm_to(p, piece.b);
        const bool faces = slrt_side(&from, &to) > 0;
        if (faces && ready) {
            run = true;
            slrt_see_fan_piece(p, &piece, &from, &to);
            p->fan_at++;
        } else if (!faces && run && !p->inside) {
            return;
        }
        ready = ready || !faces;
    }
}

/// What of a cell's boundary is at the eye: counter-clockwise behind it and before it.
typedef struct slrt_touch {
    bool any;
    uint32_t behind, before; ///< open portals, or SLRT_NONE
    double behind_end[2], before_end[2];
} slrt_touch;

static slrt_touch slrt_touch_of(slrt_polygon *p, uint32_t cell) {
    slrt_touch touch;
    slrt_walk w;
    slrt_piece piece;
    memset(&touch, 0, sizeof touch);
    touch.behind = touch.before = SLRT_NONE;
    slrt_walk_around(p, &w, cell, 1);
    while (slrt_walk_next(p, &w, &piece)) {
        const slrt_arm from = slrt_arm_to(p, piece.a), to = slrt_arm_to(p, piece.b);
        uint32_t open;
        if (slrt_side(&from, &to) || slrt_same_way(&from, &to)) continue;
        open = piece.directed != SLRT_NONE && slrt_is_blocked(&p->s, piece.directed)
                   ? SLRT_NONE
                   : piece.directed;
        touch.any = true;
        if (!slrt_is_zero(&to)) {
            touch.behind = open;
            memcpy(touch.behind_end, piece.b, sizeof piece.b);
        }
        if (!slrt_is_zero(&from)) {
            touch.before = open;
            memcpy(touch.before_end, piece.a, sizeof piece.a);
        }
    }
    return touch;
}

static uint32_t slrt_cell_behind(const slrt_polygon *p, uint32_t directed) {
    return slrt_u32(p->s.rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 4);
}

/// Finds where the way around the eye starts: clockwise as far as portals lead, or once around. A
/// wall that ends at the eye is seen edge-on, and hides nothing.
static void slrt_find_fan(slrt_polygon *p) {
    slrt_touch touch = slrt_touch_of(p, p->s.eye_cell), last = touch;
    p->fan_first = p->s.eye_cell;
    p->inside = !touch.any;
    p->fan_is_closed = p->inside;
    if (p->inside) return;
    while (touch.behind != SLRT_NONE && !p->broken) {
        p->fan_first = slrt_cell_behind(p, touch.behind);
        p->fan_is_closed = p->fan_first == p->s.eye_cell;
        if (p->fan_is_closed) return;
        touch = slrt_touch_of(p, p->fan_first);
    }
    while (last.before != SLRT_NONE && !p->broken)
        last = slrt_touch_of(p, slrt_cell_behind(p, last.before));
    {
        const slrt_arm right = slrt_arm_to(p, touch.behind_end);
        const slrt_arm left = slrt_arm_to(p, last.before_end);
        p->gap = !slrt_same_ray(&right, &left);
    }
}

/// Sees the whole fan, once around.
static void slrt_see_fan(slrt_polygon *p) {
    uint32_t cell = p->fan_first;
    p->fan_at = 0;
    slrt_see_fan_cell(p, cell);
    while (!p->inside && !p->broken) {
        const uint32_t before = slrt_touch_of(p, cell).before;
        if (before == SLRT_NONE) return;
        cell = slrt_cell_behind(p, before);
        if (p->fan_is_closed && cell == p->fan_first) return;
        slrt_see_fan_cell(p, cell);
    }
}

/// Cuts the view cone into sectors of up to 180 degrees between the arms of `cone`, as
/// slrt_search_cone does. 0 for a view all round; `last` is the arm where the last sector ends.
static uint32_t slrt_cut_cone(slrt_search *s, uint32_t *last) {
    const double *right = s->view->right, *left = s->view->left;
    if (s->view->all_round || !slrt_is_direction(right) || !slrt_is_direction(left)) return 0;
    s->cone[0] = slrt_direction(right[0], right[1]);
    s->cone[1] = slrt_direction(-right[1], right[0]);
    s->cone[2] = slrt_direction(-right[0], -right[1]);
    s->cone[3] = slrt_direction(left[0], left[1]);
    *last = 3;
    return slrt_side(&s->cone[0], &s->cone[3]) > 0 || slrt_same_ray(&s->cone[0], &s->cone[3]) ? 1
                                                                                              : 3;
}

/// Sees what is in a sector of less than 180 degrees.
static void slrt_see_sector(slrt_polygon *p, uint32_t right, uint32_t left) {
    const slrt_arm a = slrt_border(&p->s, right), b = slrt_border(&p->s, left);
    if (slrt_side(&a, &b) <= 0) return;
    p->in_sector = true;
    p->right = right;
    p->left = left;
    p->second_lap = p->started = p->done = false;
    slrt_see_fan(p);
    p->second_lap = true;
    slrt_see_fan(p);
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon(const sl_runtime *runtime,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *scratch, double *points,
                                                   uint32_t room) {
    const double x = slrt_no_dust(view->x), y = slrt_no_dust(view->y);
    const uint32_t cell = sl_runtime_locate(runtime, x, y);
    // So that no number in units of the range overflows.
    const double least =
        1e-100 * (runtime->max_x - runtime->min_x) + 1e-100 * (runtime->max_y - runtime->min_y);
    uint32_t last, i, pieces;
    slrt_polygon p;
    if (runtime->loose || cell == SL_RUNTIME_NO_CELL || sl_runtime_is_solid(runtime, cell))
        return 0;
    memset(&p, 0, sizeof p);
    p.s.rt = runtime;
    p.s.view = view;
    p.s.shut = shut;
    p.s.range = slrt_range(runtime, range);
    if (p.s.range > 0 && p.s.range < least) p.s.range = least;
    p.s.x = x;
    p.s.y = y;
    p.s.path = scratch;
    p.s.patience = (uint64_t)SLRT_PATIENCE * 16 *
                   ((uint64_t)runtime->directed_count + runtime->vertex_count + 16);
    p.s.eye_cell = cell;
    p.points = points;
    p.room = room;
    slrt_find_fan(&p);
    pieces = slrt_cut_cone(&p.s, &last);
    p.fan_last = UINT32_MAX;
    p.waits = !pieces && !p.gap;
    if (!pieces) {
        slrt_see_fan(&p);
    } else {
        slrt_add_eye(&p);
        for (i = 0; i < pieces; i++)
            slrt_see_sector(&p, SLRT_ARM + i, SLRT_ARM + (i + 1 < pieces ? i + 1 : last));
    }
    slrt_close(&p, !pieces && !p.gap);
    return p.broken || p.count < 3 || p.written < 3 ? 0 : p.written;
}
