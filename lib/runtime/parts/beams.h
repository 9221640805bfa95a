/// Box to box: what is seen from anywhere in a box, by a search through portals.
///
/// A beam is all lines of sight that start in a part of the box and pass some portals in turn. On
/// each side a bound holds it: behind the portals, no line of the beam is to the left of the left
/// bound.
///
///            l2 |                The left bound leads from a right end to a later left end, as
///        l1 |   |                r1 to l2, or from a corner of the box to a left end. A portal
///     box   |   r2               turns it if its left end lies to the right of it. It stays where
///           r1                   it was if no such line is a bound for sure.
///
/// What is left out is so for sure: a sign that rounding may change counts for sight. And any bound
/// through these points leaves out no line of sight, so which of them is the best may be rounded.

/// A bound. Its points are `from` and `to`: ends of portals, numbered as borders of sectors, or
/// corners of boxes. `from` is SLRT_NONE for no bound, as of two points in one place.
typedef struct slrt_bound {
    uint32_t from, to;
    slrt_arm arm; ///< from one to the other
} slrt_bound;

/// Corners of the box's part that the beams start in, then those of the box: 1 right, 2 top.
#define SLRT_PART_CORNER (UINT32_MAX - 8)
#define SLRT_BOX_CORNER  (UINT32_MAX - 4)

enum { SLRT_RIGHT, SLRT_LEFT };

typedef struct slrt_beam {
    slrt_bound bounds[2];
} slrt_beam;

/// A cell on the path: its number, how many of the ways out are done, the points of the bounds.
enum { SLRT_BEAM_CELL, SLRT_BEAM_DONE, SLRT_BEAM_BOUNDS, SLRT_BEAM_STEP = SLRT_BEAM_BOUNDS + 4 };

/// A beam that came into a cell.
typedef struct slrt_past_beam {
    uint32_t cell, entry; ///< the directed portal that it came through
    uint32_t source;      ///< the cell that it started in
    uint32_t line;        ///< 1 if it is all in one line
    uint32_t bounds[4];
} slrt_past_beam;

/// So many past beams are remembered.
#ifndef SLRT_PAST_BEAMS
#define SLRT_PAST_BEAMS 256
#endif

/// The ways out of the first cell through a directed portal.
enum { SLRT_WAYS = 5 };

/// The limit of portals that the beams of a box come to, for each directed portal of the map.
#ifndef SLRT_BEAM_PATIENCE
#define SLRT_BEAM_PATIENCE 16
#endif

typedef struct slrt_beams {
    const sl_runtime *rt;
    const unsigned char *shut; ///< NULL for none
    double range;              ///< 0 for no limit
    double box[4];             ///< within the bounds of the map
    uint32_t source;           ///< the cell that the beams start in
    double part[4];            ///< the part of the box within the bounds of that cell
    const double *target;      ///< beams beside this box are left out; NULL for none
    /// For each cell that a beam comes to, and the first. True ends the search.
    bool (*meet)(struct slrt_beams *b, uint32_t cell, const slrt_beam *beam);
    void *context;
    uint64_t patience;
    uint32_t *path, depth, *on_path; ///< on_path: a bit for each cell
    slrt_beam beam;                  ///< in the cell on top of the path
    sl_runtime_cell cell;            ///< that cell
    uint32_t entry;                  ///< the directed portal to it, or SLRT_NONE
    slrt_past_beam past[SLRT_PAST_BEAMS];
} slrt_beams;

// --- boxes and lines

/// The part of a box within bounds that it meets.
static void slrt_part_in(const double bounds[4], const double box[4], double part[4]) {
    int k;
    for (k = 0; k < 2; k++) {
        part[k] = box[k] > bounds[k] ? box[k] : bounds[k];
        part[2 + k] = box[2 + k] < bounds[2 + k] ? box[2 + k] : bounds[2 + k];
    }
}

/// The side of a line that a point is on, without the exact sign: 1 left, -1 right, 0 if rounding
/// may decide.
static int slrt_surely(const slrt_arm *line, double x, double y) {
    const double left = line->x * (y - line->from_y), right = line->y * (x - line->from_x);
    const double product = left - right;
    const double bound =
        4e-16 * ((left < 0 ? -left : left) + (right < 0 ? -right : right)) + 1e-300;
    return (product > bound) - (-product > bound);
}

/// Whether all of a box is to the left (1) or right (-1) of a line for sure.
static bool slrt_is_box_beside(const slrt_arm *line, const double box[4], int side) {
    const bool up = side * line->y > 0, right = side * line->x > 0;
    return slrt_surely(line, box[up ? 2 : 0], box[right ? 1 : 3]) * side > 0;
}

static bool slrt_is_beam_beside(const slrt_beam *beam, const double box[4]) {
    const slrt_bound *right = &beam->bounds[SLRT_RIGHT], *left = &beam->bounds[SLRT_LEFT];
    return (right->from != SLRT_NONE && slrt_is_box_beside(&right->arm, box, -1)) ||
           (left->from != SLRT_NONE && slrt_is_box_beside(&left->arm, box, 1));
}

/// Whether a box is out of range of all of the box that looks, for sure.
static bool slrt_is_out_of_range(const slrt_beams *b, const double box[4]) {
    double square = 0;
    int k;
    if (!(b->range > 0)) return false;
    for (k = 0; k < 2; k++) {
        const double over = box[k] - b->box[2 + k], under = b->box[k] - box[2 + k];
        const double gap = (over > under ? over : under) / b->range;
        if (gap > 0) square += gap * gap;
    }
    return square > 1 + 1e-12;
}

// --- bounds

static void slrt_point_of(const slrt_beams *b, uint32_t number, double *x, double *y) {
    if (number >= SLRT_PART_CORNER) {
        const double *box = number < SLRT_BOX_CORNER ? b->part : b->box;
        const uint32_t corner = (number - SLRT_PART_CORNER) % 4;
        *x = box[corner & 1 ? 2 : 0];
        *y = box[corner & 2 ? 3 : 1];
    } else {
        double end[2];
        slrt_read_end(b->rt, number / 2, (int)(number % 2), end);
        *x = end[0];
        *y = end[1];
    }
}

static slrt_bound slrt_make_bound(const slrt_beams *b, uint32_t from, uint32_t to) {
    slrt_bound bound;
    double x, y, to_x, to_y;
    memset(&bound, 0, sizeof bound);
    bound.from = from;
    bound.to = to;
    if (from == SLRT_NONE) return bound;
    slrt_point_of(b, from, &x, &y);
    slrt_point_of(b, to, &to_x, &to_y);
    bound.arm = slrt_make_arm(x, y, to_x, to_y);
    if (slrt_is_zero(&bound.arm)) bound.from = SLRT_NONE;
    return bound;
}

/// The corner of the part from which a line to a point has all of the part on its left or right.
/// SLRT_NONE for a point in the part.
static uint32_t slrt_tangent(const double part[4], double x, double y, int side) {
    // By column and row of the point about the part.
    static const unsigned char corners[3][3][2] = {
        {{1, 2}, {0, 2}, {0, 3}}, {{1, 0}, {0, 0}, {2, 3}}, {{3, 0}, {3, 1}, {2, 1}}};
    const int column = x < part[0] ? 0 : x > part[2] ? 2 : 1;
    const int row = y < part[1] ? 0 : y > part[3] ? 2 : 1;
    if (column == 1 && row == 1) return SLRT_NONE;
    return SLRT_PART_CORNER + corners[column][row][side];
}

/// Turns a bound of a beam to the end of a directed portal on its side, if that leaves more out.
/// `across` leads from the portal's right end to its left; `last` is the last point of the other
/// bound, or SLRT_NONE.
static void slrt_turn_bound(const slrt_beams *b, slrt_bound *bound, uint32_t last,
                            uint32_t directed, const slrt_arm *across, int side) {
    const int sign = side == SLRT_LEFT ? 1 : -1;
    const uint32_t end = 2 * directed + (side == SLRT_RIGHT), from = bound->from;
    const double x = side == SLRT_LEFT ? across->to_x : across->from_x;
    const double y = side == SLRT_LEFT ? across->to_y : across->from_y;
    const slrt_arm *arm = &bound->arm;
    // All lines of the beam have these points on the other side, or start where the first one says.
    uint32_t pivots[4];
    int i;
    if (from != SLRT_NONE && sign * (arm->x * (y - arm->from_y) - arm->y * (x - arm->from_x)) >= 0)
        return;
    pivots[0] = slrt_tangent(b->part, x, y, side);
    pivots[1] = from >= SLRT_PART_CORNER && from < SLRT_BOX_CORNER ? SLRT_NONE : from;
    pivots[2] = last;
    pivots[3] = b->entry == SLRT_NONE ? SLRT_NONE : 2 * b->entry + (side == SLRT_LEFT);
    for (i = 0; i < 4; i++) {
        double from_x, from_y;
        if (pivots[i] == SLRT_NONE || (i == 3 && pivots[3] == last)) continue;
        slrt_point_of(b, pivots[i], &from_x, &from_y);
        if (bound->from != SLRT_NONE && bound->to == end &&
            sign * (arm->x * (from_y - arm->from_y) - arm->y * (from_x - arm->from_x)) <= 0)
            continue;
        // Only from before the portal does a line to its end bound what is behind it.
        if (slrt_surely(across, from_x, from_y) <= 0) continue;
        bound->from = pivots[i];
        bound->to = end;
        bound->arm = slrt_make_arm(from_x, from_y, x, y);
    }
}

// --- portals

/// Whether a directed portal is on a shut door, or on glass that is dark from all of the box.
static bool slrt_is_closed(const slrt_beams *b, uint32_t portal) {
    const sl_runtime *rt = b->rt;
    uint32_t i;
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12, *seam;
        slrt_arm line;
        if (slrt_u32(on) != portal) return false;
        seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        if (slrt_u32(seam + 32) == 1 && b->shut && b->shut[slrt_u32(seam + 36)]) return true;
        if (slrt_u32(seam + 32) != 2) continue;
        line = slrt_make_arm(slrt_f64(seam), slrt_f64(seam + 8), slrt_f64(seam + 16),
                             slrt_f64(seam + 24));
        if (slrt_is_box_beside(&line, b->box, 1)) return true;
    }
    return false;
}

/// Whether a point is beyond a side of the box: left, right, bottom, top.
static bool slrt_is_beyond(const double box[4], const double point[2], int side) {
    return side & 1 ? point[side / 2] > box[2 + side / 2] : point[side / 2] < box[side / 2];
}

/// Whether no corner of the part is before a portal: `across` leads from its right end to its left.
static bool slrt_is_part_on(const slrt_beams *b, const slrt_arm *across) {
    const slrt_arm to =
        slrt_make_arm(across->from_x, across->from_y, b->part[across->y > 0 ? 0 : 2],
                      b->part[across->x > 0 ? 3 : 1]);
    return slrt_side(across, &to) <= 0;
}

/// Whether the part is nearer to a portal's right end than to its left.
static bool slrt_is_part_right(const slrt_beams *b, const slrt_arm *across) {
    return slrt_size(b->part[0] - across->from_x, b->part[1] - across->from_y) <
           slrt_size(b->part[0] - across->to_x, b->part[1] - across->to_y);
}

/// The ways out of the first cell through a directed portal. Lines that cross it within the box are
/// those of the part in the next cell, which has its own beams. All others leave the box before,
/// across one of its sides, and stay beyond it. Way 0 is the whole portal, if it is beyond a side
/// or leads to solid ground; else ways 1 to 4 are what is beyond a side.
static bool slrt_is_whole(const slrt_beams *b, const sl_runtime_directed_portal *p) {
    int side;
    for (side = 0; side < 4; side++)
        if (slrt_is_beyond(b->box, p->left, side) && slrt_is_beyond(b->box, p->right, side))
            return true;
    return sl_runtime_is_solid(b->rt, p->cell);
}

/// Bounds a beam by the side of the box that it leaves across; false for no such beam. From a part
/// that is on the portal's line, only that line crosses it.
static bool slrt_leave_box(const slrt_beams *b, const sl_runtime_directed_portal *p,
                           uint32_t directed, const slrt_arm *across, uint32_t way,
                           slrt_beam *beam) {
    // The ends of the sides, clockwise about the box.
    static const unsigned char from[4] = {0, 3, 1, 2}, to[4] = {2, 1, 0, 3};
    const int side = (int)way - 1;
    bool left = way && slrt_is_beyond(b->box, p->left, side);
    if (way && left == slrt_is_beyond(b->box, p->right, side)) return false;
    if (slrt_is_part_on(b, across) && !sl_runtime_is_solid(b->rt, p->cell)) {
        if (!way) left = slrt_is_part_right(b, across);
        beam->bounds[0] = slrt_make_bound(b, 2 * directed + left, 2 * directed + !left);
        beam->bounds[1] = beam->bounds[0];
    } else if (way) {
        const uint32_t first = SLRT_BOX_CORNER + (left ? from : to)[side];
        const uint32_t last = SLRT_BOX_CORNER + (left ? to : from)[side];
        beam->bounds[left ? SLRT_RIGHT : SLRT_LEFT] = slrt_make_bound(b, first, last);
    }
    return true;
}

static uint32_t slrt_last_point(const slrt_bound *bound) {
    return bound->from == SLRT_NONE ? SLRT_NONE : bound->to;
}

/// Whether no line of a beam crosses a portal, for sure: it lies to one side of a bound, or all
/// lines would cross it the other way. That one end is beside a bound does not tell: lines may come
/// to the other end from behind.
static bool slrt_is_portal_beside(const slrt_beam *beam, const slrt_arm *across) {
    const slrt_bound *right = &beam->bounds[SLRT_RIGHT], *left = &beam->bounds[SLRT_LEFT];
    const bool beside_left =
        left->from != SLRT_NONE && slrt_surely(&left->arm, across->from_x, across->from_y) > 0;
    const bool beside_right =
        right->from != SLRT_NONE && slrt_surely(&right->arm, across->to_x, across->to_y) < 0;
    if (!beside_left && !beside_right) return false;
    if ((beside_left && slrt_surely(&left->arm, across->to_x, across->to_y) > 0) ||
        (beside_right && slrt_surely(&right->arm, across->from_x, across->from_y) < 0))
        return true;
    return right->from != SLRT_NONE && left->from != SLRT_NONE &&
           slrt_side(&right->arm, &left->arm) > 0 && slrt_side(&right->arm, across) < 0 &&
           slrt_side(&left->arm, across) < 0;
}

static bool slrt_is_portal_far(const slrt_beams *b, const slrt_arm *across) {
    double box[4];
    box[0] = across->x < 0 ? across->to_x : across->from_x;
    box[1] = across->y < 0 ? across->to_y : across->from_y;
    box[2] = across->x < 0 ? across->from_x : across->to_x;
    box[3] = across->y < 0 ? across->from_y : across->to_y;
    return slrt_is_out_of_range(b, box);
}

/// The part of the beam on top of the path that leaves through a directed portal; false for none.
static bool slrt_pass_portal(const slrt_beams *b, const sl_runtime_directed_portal *p,
                             uint32_t directed, uint32_t way, slrt_beam *out) {
    const slrt_arm across = slrt_make_arm(p->right[0], p->right[1], p->left[0], p->left[1]);
    slrt_bound *right = &out->bounds[SLRT_RIGHT], *left = &out->bounds[SLRT_LEFT];
    uint32_t right_last, left_last;
    if (slrt_is_portal_beside(&b->beam, &across)) return false;
    *out = b->beam;
    if ((b->range > 0 && slrt_is_portal_far(b, &across)) || slrt_is_closed(b, p->portal) ||
        (b->depth == 1 && !slrt_leave_box(b, p, directed, &across, way, out)))
        return false;
    right_last = slrt_last_point(right);
    left_last = slrt_last_point(left);
    slrt_turn_bound(b, right, left_last, directed, &across, SLRT_RIGHT);
    slrt_turn_bound(b, left, right_last, directed, &across, SLRT_LEFT);
    return !b->target || !slrt_is_beam_beside(out, b->target);
}

// --- the search

/// Whether a beam is all in one line.
static bool slrt_is_one_line(const slrt_beam *beam) {
    const slrt_bound *right = &beam->bounds[SLRT_RIGHT], *left = &beam->bounds[SLRT_LEFT];
    const slrt_arm to =
        slrt_make_arm(right->arm.from_x, right->arm.from_y, left->arm.to_x, left->arm.to_y);
    return right->from != SLRT_NONE && left->from != SLRT_NONE &&
           !slrt_side(&right->arm, &left->arm) && !slrt_side(&right->arm, &to) &&
           slrt_same_way(&right->arm, &left->arm);
}

static int slrt_turn_of(const slrt_arm *line, const double point[2]) {
    const slrt_arm to = slrt_make_arm(line->from_x, line->from_y, point[0], point[1]);
    return slrt_side(line, &to);
}

/// Whether a line is that of a past beam, and touches the portal through which that came.
static bool slrt_is_past_line(const slrt_beams *b, const slrt_past_beam *past,
                              const slrt_arm *line) {
    const slrt_bound was = slrt_make_bound(b, past->bounds[0], past->bounds[1]);
    const double from[2] = {line->from_x, line->from_y};
    double right[2], left[2];
    slrt_read_end(b->rt, past->entry, 1, right);
    slrt_read_end(b->rt, past->entry, 0, left);
    return !slrt_side(&was.arm, line) && !slrt_turn_of(&was.arm, from) &&
           slrt_same_way(&was.arm, line) && slrt_turn_of(line, right) <= 0 &&
           slrt_turn_of(line, left) >= 0;
}

/// Whether a beam that came to a cell before had all lines of this one, and bounds that hold for
/// them. If not, this one takes its place. (It is not enough that the other one has shown all that
/// this one does of the cell: behind the next portal it may show less.)
static bool slrt_is_past(slrt_beams *b, uint32_t cell, uint32_t entry, const slrt_beam *beam) {
    const bool line = slrt_is_one_line(beam);
    slrt_past_beam now, *past = &b->past[(line ? cell : entry) % SLRT_PAST_BEAMS];
    int side;
    now.cell = cell;
    now.entry = entry;
    now.source = b->source;
    now.line = line;
    for (side = 0; side < 2; side++) {
        now.bounds[2 * side] = beam->bounds[side].from;
        now.bounds[2 * side + 1] = beam->bounds[side].to;
    }
    if (line && past->line && past->cell == cell && past->source == b->source &&
        slrt_is_past_line(b, past, &beam->bounds[SLRT_RIGHT].arm))
        return true;
    if (!memcmp(past, &now, sizeof now)) return true;
    *past = now;
    return false;
}

/// Puts a cell on top of the path.
static void slrt_come_to(slrt_beams *b, uint32_t cell, uint32_t entry, const slrt_beam *beam) {
    uint32_t *top = b->path + SLRT_BEAM_STEP * (size_t)b->depth++;
    int side;
    top[SLRT_BEAM_CELL] = cell;
    top[SLRT_BEAM_DONE] = 0;
    for (side = 0; side < 2; side++) {
        top[SLRT_BEAM_BOUNDS + 2 * side] = beam->bounds[side].from;
        top[SLRT_BEAM_BOUNDS + 2 * side + 1] = beam->bounds[side].to;
    }
    b->on_path[cell / 32] |= UINT32_C(1) << cell % 32;
    b->cell = sl_runtime_get_cell(b->rt, cell);
    b->entry = entry;
    b->beam = *beam;
}

static void slrt_leave_top(slrt_beams *b) {
    const uint32_t cell = b->path[SLRT_BEAM_STEP * (size_t)--b->depth];
    b->on_path[cell / 32] &= ~(UINT32_C(1) << cell % 32);
}

/// How many ways there are out of the cell on top.
static uint32_t slrt_ways(const slrt_beams *b) {
    return b->cell.directed_count * (b->depth == 1 ? SLRT_WAYS : 1);
}

/// Goes back to a cell with ways that are not done.
static void slrt_go_back(slrt_beams *b) {
    const uint32_t *top;
    do {
        slrt_leave_top(b);
        if (!b->depth) return;
        top = b->path + SLRT_BEAM_STEP * (size_t)(b->depth - 1);
        b->cell = sl_runtime_get_cell(b->rt, top[SLRT_BEAM_CELL]);
    } while (top[SLRT_BEAM_DONE] == slrt_ways(b));
    b->beam.bounds[0] = slrt_make_bound(b, top[SLRT_BEAM_BOUNDS], top[SLRT_BEAM_BOUNDS + 1]);
    b->beam.bounds[1] = slrt_make_bound(b, top[SLRT_BEAM_BOUNDS + 2], top[SLRT_BEAM_BOUNDS + 3]);
    b->entry = SLRT_NONE;
    if (b->depth == 1) return;
    top -= SLRT_BEAM_STEP;
    b->entry = sl_runtime_get_cell(b->rt, top[SLRT_BEAM_CELL]).first_directed +
               (top[SLRT_BEAM_DONE] - 1) / (b->depth == 2 ? SLRT_WAYS : 1);
}

/// Follows the next way out of the cell on top. True if `meet` ends the search.
static bool slrt_go_on(slrt_beams *b) {
    uint32_t *done = b->path + SLRT_BEAM_STEP * (size_t)(b->depth - 1) + SLRT_BEAM_DONE;
    const uint32_t ways = b->depth == 1 ? SLRT_WAYS : 1, way = *done % ways;
    const uint32_t directed = b->cell.first_directed + (*done)++ / ways;
    const sl_runtime_directed_portal p = sl_runtime_get_directed_portal(b->rt, directed);
    slrt_beam beam;
    if (b->depth == 1 && !way) {
        if (!slrt_is_whole(b, &p)) return false;
        *done += SLRT_WAYS - 1;
    }
    // A line passes a convex cell once.
    if (b->on_path[p.cell / 32] >> p.cell % 32 & 1 ||
        !slrt_pass_portal(b, &p, directed, way, &beam) || slrt_is_past(b, p.cell, directed, &beam))
        return false;
    slrt_come_to(b, p.cell, directed, &beam);
    return b->meet(b, p.cell, &beam);
}

/// Sends beams from the part of the box that is in a cell. Returns true if `meet` ended the search,
/// or it took too long.
static bool slrt_send_beams(slrt_beams *b, uint32_t source) {
    slrt_beam beam;
    double bounds[4];
    bool ended;
    memset(&beam, 0, sizeof beam);
    beam.bounds[0].from = beam.bounds[1].from = SLRT_NONE;
    b->source = source;
    b->depth = 0;
    slrt_come_to(b, source, SLRT_NONE, &beam);
    slrt_bounds_of(b->rt, &b->cell, bounds);
    slrt_part_in(bounds, b->box, b->part);
    ended = b->meet(b, source, &beam);
    while (b->depth && !ended) {
        const uint32_t *top = b->path + SLRT_BEAM_STEP * (size_t)(b->depth - 1);
        if (top[SLRT_BEAM_DONE] == slrt_ways(b))
            slrt_go_back(b);
        else if (b->patience--)
            ended = slrt_go_on(b);
        else
            ended = true;
    }
    while (b->depth) slrt_leave_top(b);
    return ended;
}
