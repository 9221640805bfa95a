/// The boundary of a cell, piece by piece.

/// No directed portal: a wall, or the border of the map. Also: no border, but a piece's own end.
#define SLRT_NONE UINT32_MAX

/// A piece of a cell's boundary, counter-clockwise from a to b.
typedef struct slrt_piece {
    double a[2], b[2];
    uint32_t directed; ///< the portal, if it is one
} slrt_piece;

/// A walk around a cell, counter-clockwise, some times from a portal's left end to there again.
typedef struct slrt_walk {
    sl_runtime_cell cell;
    uint32_t stop;       ///< the portal at which a lap ends; SLRT_NONE in a cell without portals
    uint32_t next;       ///< the next portal
    bool is_here;        ///< it is on this side, ahead
    uint32_t side, laps; ///< the side that `at` lies on, and the laps to do
    uint32_t corners;    ///< to pass at most: a bound for files that are not sound
    double at[2], a[2], b[2]; ///< the side goes from a to b
} slrt_walk;

/// A polygon as it grows, and the part of the view about the eye that is being looked at.
typedef struct slrt_polygon {
    slrt_search s;
    bool broken; ///< the file is not sound, or the search takes too long
    double *points;
    uint32_t room, written;
    uint32_t count;           ///< of points, before a range cuts the polygon
    double first[2], last[2]; ///< of these
    double second[2];         ///< with a range: the edge to it waits until the polygon closes
    bool second_is_radial, waits;
    bool has_arc; ///< an arc is begun, from `arc` to `arc_end`
    double arc[2], arc_end[2];
    bool pending;           ///< the end of the last piece is not added yet
    slrt_piece piece;       ///< that piece
    uint32_t piece_left;    ///< the border where it ends, or SLRT_NONE for
    double piece_end[2];    ///< this place
    slrt_piece first_piece; ///< that starts at the first point
    bool first_is_short;    ///< it is shorter than a step of doubles
    bool inside;            ///< the eye lies within its cell
    uint32_t fan_first;     ///< the cell where the way around the eye starts
    bool fan_is_closed;     ///< it leads back to that cell
    bool gap;               ///< the eye lies on a wall, which hides some directions
    double fan_right[2];    ///< if it is not closed: where walls end it, and may be one wall
    double fan_left[2];
    bool in_sector;       ///< only what is between these borders is looked at
    uint32_t right, left; ///< borders of the sector
    bool second_lap, started, done;
    uint32_t fan_at, fan_last; ///< the number of the piece of the fan, and of the last one seen
    uint32_t fan_cell;         ///< its cell
    /// For cells that are entered, and in place of adding a wall; NULL for none. By these a program
    /// that asks for no boxes and mirrors is built without what is only for them.
    void (*meet)(struct slrt_polygon *p, uint32_t cell);
    void (*see_wall)(struct slrt_polygon *p, uint32_t cell, const slrt_piece *piece, uint32_t right,
                     uint32_t left);
    void *job; ///< theirs
} slrt_polygon;

static void slrt_read_vertex(const sl_runtime *rt, const sl_runtime_cell *cell, uint32_t corner,
                             double *out) {
    sl_runtime_get_vertex(rt, cell->first_vertex + corner, &out[0], &out[1]);
}

/// Reads the left (0) or right (1) end of a directed portal.
static void slrt_read_end(const sl_runtime *rt, uint32_t directed, int right, double *out) {
    const unsigned char *at =
        rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8 + 16 * right;
    out[0] = slrt_f64(at);
    out[1] = slrt_f64(at + 8);
}

static bool slrt_same_place(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

static bool slrt_is_between(double a, double value, double b) {
    return (a <= value && value <= b) || (b <= value && value <= a);
}

static int slrt_turn(const double *a, const double *b, const double *c) {
    const slrt_arm along = slrt_make_arm(a[0], a[1], b[0], b[1]);
    const slrt_arm to = slrt_make_arm(a[0], a[1], c[0], c[1]);
    return slrt_side(&along, &to);
}

/// Whether a point is in the box of the segment from a to b: on it, if that is axial.
static bool slrt_is_on(const double *a, const double *b, const double *point) {
    return slrt_is_between(a[0], point[0], b[0]) && slrt_is_between(a[1], point[1], b[1]);
}

/// Whether a seam is along all of the way from p to q. Files say on which seams portals are, but
/// not walls.
static bool slrt_seam_covers(const sl_runtime *rt, uint32_t number, const double *p,
                             const double *q) {
    const unsigned char *seam = rt->seams + (size_t)number * 40;
    double a[2], b[2];
    int i;
    for (i = 0; i < 2; i++) {
        a[i] = slrt_f64(seam + 8 * i);
        b[i] = slrt_f64(seam + 16 + 8 * i);
    }
    return slrt_is_on(a, b, p) && slrt_is_on(a, b, q) && !slrt_turn(a, b, p) && !slrt_turn(a, b, q);
}

/// Whether a seam is a shut door, glass, or a wall that stops steps.
static bool slrt_seam_stops_steps(const slrt_search *s, uint32_t number) {
    const unsigned char *seam = s->rt->seams + (size_t)number * 40;
    const uint32_t kind = slrt_u32(seam + 32);
    return kind == 2 || (kind == 1 && s->shut && s->shut[slrt_u32(seam + 36)]) ||
           (slrt_seam_stops(s->rt, number) & SL_RUNTIME_STOPS_STEPS) != 0;
}

/// Whether something along a passage stops steps, which pass its wall. Time: the seams.
static bool slrt_is_passage_barred(const slrt_search *s, uint32_t passage) {
    double right[2], left[2];
    uint32_t i;
    slrt_read_passage(s->rt, passage, right, left);
    for (i = 0; i < s->rt->seam_count; i++)
        if (slrt_seam_stops_steps(s, i) && slrt_seam_covers(s->rt, i, right, left)) return true;
    return false;
}

static uint32_t slrt_next_corner(const sl_runtime_cell *cell, uint32_t corner) {
    return corner + 1 < cell->vertex_count ? corner + 1 : 0;
}

/// Whether a side of a cell is a portal, in a file with a grid: a portal is a whole side there.
static bool slrt_is_portal_side(const sl_runtime *rt, const sl_runtime_cell *cell, uint32_t side) {
    return slrt_u32(rt->neighbours + ((size_t)cell->first_vertex + side) * 4) == UINT32_MAX;
}

/// The side of a cell that a portal is on. Without a grid, all walls are axial.
static uint32_t slrt_side_of_portal(slrt_polygon *p, const sl_runtime_cell *cell,
                                    uint32_t directed) {
    const sl_runtime *rt = p->s.rt;
    uint32_t before = directed - cell->first_directed, side;
    double left[2], right[2], a[2], b[2];
    slrt_read_end(rt, directed, 0, left);
    slrt_read_end(rt, directed, 1, right);
    for (side = 0; side < cell->vertex_count; side++) {
        if (rt->neighbours) {
            if (slrt_is_portal_side(rt, cell, side) && !before--) return side;
            continue;
        }
        slrt_read_vertex(rt, cell, side, a);
        slrt_read_vertex(rt, cell, slrt_next_corner(cell, side), b);
        if (slrt_is_on(a, b, right) && slrt_is_on(a, b, left)) return side;
    }
    p->broken = true;
    return 0;
}

/// Whether the next portal of a walk is on this side, and not before its place.
static bool slrt_walk_is_at_portal(const slrt_polygon *p, const slrt_walk *w) {
    const int axis = w->a[0] == w->b[0];
    double left[2], right[2];
    if (w->stop == SLRT_NONE) return false;
    if (p->s.rt->neighbours)
        return slrt_same_place(w->at, w->a) && slrt_is_portal_side(p->s.rt, &w->cell, w->side);
    slrt_read_end(p->s.rt, w->next, 1, right);
    if (w->a[axis] < w->b[axis] ? right[axis] < w->at[axis] : right[axis] > w->at[axis])
        return false;
    slrt_read_end(p->s.rt, w->next, 0, left);
    return slrt_is_on(w->a, w->b, right) && slrt_is_on(w->a, w->b, left);
}

/// Goes on to the next side.
static void slrt_walk_turn(slrt_polygon *p, slrt_walk *w) {
    if (!w->corners) p->broken = true;
    w->corners--;
    w->side = slrt_next_corner(&w->cell, w->side);
    memcpy(w->a, w->b, sizeof w->a);
    slrt_read_vertex(p->s.rt, &w->cell, slrt_next_corner(&w->cell, w->side), w->b);
    w->is_here = slrt_walk_is_at_portal(p, w);
}

/// Goes on with a walk behind a portal.
static void slrt_walk_pass(slrt_polygon *p, slrt_walk *w, uint32_t portal) {
    const uint32_t first = w->cell.first_directed;
    w->next = portal + 1 < first + w->cell.directed_count ? portal + 1 : first;
    slrt_read_end(p->s.rt, portal, 0, w->at);
    if (slrt_same_place(w->at, w->b))
        slrt_walk_turn(p, w);
    else
        w->is_here = slrt_walk_is_at_portal(p, w);
}

/// Starts a walk behind a portal on a known side. In a cell without portals it starts at a corner.
static void slrt_walk_start(slrt_polygon *p, slrt_walk *w, uint32_t stop, uint32_t passed,
                            uint32_t side, uint32_t laps) {
    w->stop = stop;
    w->side = side;
    w->laps = laps;
    w->corners = (laps + 1) * w->cell.vertex_count;
    slrt_read_vertex(p->s.rt, &w->cell, side, w->a);
    slrt_read_vertex(p->s.rt, &w->cell, slrt_next_corner(&w->cell, side), w->b);
    if (stop != SLRT_NONE) {
        slrt_walk_pass(p, w, passed);
        return;
    }
    memcpy(w->at, w->a, sizeof w->at);
    w->is_here = false;
}

/// Starts a walk all around a cell, from its first portal on.
static void slrt_walk_around(slrt_polygon *p, slrt_walk *w, uint32_t cell, uint32_t laps) {
    w->cell = sl_runtime_get_cell(p->s.rt, cell);
    if (w->cell.directed_count) {
        const uint32_t first = w->cell.first_directed;
        slrt_walk_start(p, w, first, first, slrt_side_of_portal(p, &w->cell, first), laps);
    } else {
        slrt_walk_start(p, w, SLRT_NONE, SLRT_NONE, 0, laps);
    }
}

static void slrt_end_piece_at(slrt_walk *w, const double *end, slrt_piece *piece) {
    memcpy(piece->a, w->at, sizeof piece->a);
    memcpy(piece->b, end, sizeof piece->b);
    memcpy(w->at, end, sizeof w->at);
    piece->directed = SLRT_NONE;
}

/// Takes the next piece of the boundary, to a corner, to a portal, or of a portal.
static void slrt_walk_step(slrt_polygon *p, slrt_walk *w, slrt_piece *piece) {
    double end[2];
    if (!w->is_here) {
        slrt_end_piece_at(w, w->b, piece);
        slrt_walk_turn(p, w);
        if (w->stop == SLRT_NONE && !w->side) w->laps--;
        return;
    }
    slrt_read_end(p->s.rt, w->next, 1, end);
    if (!slrt_same_place(w->at, end)) {
        slrt_end_piece_at(w, end, piece);
        return;
    }
    slrt_read_end(p->s.rt, w->next, 0, end);
    slrt_end_piece_at(w, end, piece);
    piece->directed = w->next;
    if (w->next == w->stop) w->laps--;
    if (w->laps) slrt_walk_pass(p, w, w->next);
}

/// Takes the next piece that is not just a point; false at the end.
static bool slrt_walk_next(slrt_polygon *p, slrt_walk *w, slrt_piece *piece) {
    do {
        if (!p->s.patience) p->broken = true;
        if (!w->laps || p->broken) return false;
        p->s.patience--;
        slrt_walk_step(p, w, piece);
    } while (slrt_same_place(piece->a, piece->b));
    return true;
}
