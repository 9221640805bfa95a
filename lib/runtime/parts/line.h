/// A line from cell to cell.

// Nearly always the line from an eye to a point leaves each cell within one portal, until it comes
// to the cell of the point, or to a wall:
//
//     +--------+---------+     The portal by which the line leaves a cell, and then on which side
//     | eye *--|----* .. |     of that portal the point is: before it, the line arrives; behind
//     +--------+---------+     it, the line goes on.
//
// Where the line touches an end of a portal, or an end of the line is on a side, it may go on in
// several cells. Then all cells are followed that it comes to by portals that it meets.
//
// Of all these ways the one counts that passes the fewest limited walls. Those that the eye is on
// do not count for the cells about it.

/// Replaces a number that is too small for a map by 0, as its products would underflow.
static double slrt_no_dust(double number) {
    return number > -1e-200 && number < 1e-200 ? 0 : number;
}

/// Puts an eye, or who walks, at a place. False outside and in solid ground.
static bool slrt_place_eye(slrt_search *s, const sl_runtime *rt, double x, double y,
                           const unsigned char *shut) {
    memset(s, 0, sizeof *s);
    s->rt = rt;
    s->shut = shut;
    s->x = slrt_no_dust(x);
    s->y = slrt_no_dust(y);
    s->eye_cell = sl_runtime_locate(rt, s->x, s->y);
    return s->eye_cell != SL_RUNTIME_NO_CELL && !sl_runtime_is_solid(rt, s->eye_cell);
}

/// Where the line from the eye to a point leads.
typedef enum slrt_finding { SLRT_STOPS, SLRT_ARRIVES, SLRT_TOUCHES } slrt_finding;

static uint32_t slrt_cell_across(const sl_runtime *rt, uint32_t directed) {
    return slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 4);
}

/// The sign of a turn from a directed portal to a point: 1 for the side that its cell is on.
static int slrt_side_of_portal_line(const sl_runtime *rt, uint32_t directed, double x, double y) {
    const unsigned char *left = rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8;
    return slrt_side_of_line(left + 16, left, x, y);
}

/// Whether a line passes between two places of the file (SLRT_ARRIVES), or touches one of them.
static slrt_finding slrt_passes(const slrt_search *s, const slrt_arm *way,
                                const unsigned char *right, const unsigned char *left) {
    const slrt_arm p = slrt_make_arm(s->x, s->y, slrt_f64(right), slrt_f64(right + 8));
    const int side = slrt_side(way, &p);
    slrt_arm q;
    int other;
    if (side > 0) return SLRT_STOPS;
    q = slrt_make_arm(s->x, s->y, slrt_f64(left), slrt_f64(left + 8));
    other = slrt_side(way, &q);
    if (other < 0) return SLRT_STOPS;
    return side && other ? SLRT_ARRIVES : SLRT_TOUCHES;
}

/// The directed portal between whose ends a line leaves a cell, which it has entered likewise;
/// SLRT_NONE for none. `touches` is set if it then leaves at the end of one.
static uint32_t slrt_way_out(const slrt_search *s, const slrt_arm *way, uint32_t cell,
                             bool *touches) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    uint32_t i;
    *touches = false;
    for (i = c.first_directed; i < c.first_directed + c.directed_count; i++) {
        const unsigned char *portal = s->rt->directed + (size_t)i * SLRT_DIRECTED_BYTES;
        const slrt_finding found = slrt_passes(s, way, portal + 24, portal + 8);
        if (found == SLRT_ARRIVES) return i;
        if (found == SLRT_TOUCHES) *touches = true;
    }
    return SLRT_NONE;
}

/// A way out of a cell: the cell that it leads to, and its ends as crossed.
typedef struct slrt_exit {
    uint32_t cell; ///< SLRT_NONE for no way out
    bool is_blocked, is_limited;
    const unsigned char *right, *left;
} slrt_exit;

/// As slrt_way_out, for walls that steps pass. A shut door on one bars it.
static void slrt_passage_out(const slrt_search *s, const slrt_arm *way, uint32_t cell,
                             slrt_exit *out, bool *touches) {
    const sl_runtime *rt = s->rt;
    uint32_t i = slrt_next_way(rt, cell, slrt_first_passage(rt, cell));
    for (; i < rt->passage_count; i = slrt_next_way(rt, cell, i + 1)) {
        const unsigned char *at = rt->passages + (size_t)i * SLRT_PASSAGE_BYTES;
        slrt_finding found;
        out->right = slrt_passage_end(rt, i, 0);
        out->left = slrt_passage_end(rt, i, 1);
        found = slrt_passes(s, way, out->right, out->left);
        if (found == SLRT_ARRIVES) {
            out->cell = slrt_u32(at + 8);
            out->is_blocked = slrt_is_passage_barred(s, i);
            return;
        }
        if (found == SLRT_TOUCHES) *touches = true;
    }
}

/// The way by which a line leaves a cell.
static slrt_exit slrt_exit_of(const slrt_search *s, const slrt_arm *way, uint32_t cell,
                              bool *touches) {
    const uint32_t directed = slrt_way_out(s, way, cell, touches);
    const unsigned char *portal;
    slrt_exit out;
    out.cell = SLRT_NONE;
    out.is_blocked = out.is_limited = false;
    if (directed == SLRT_NONE) {
        if (s->on_foot && s->rt->passage_count && !*touches)
            slrt_passage_out(s, way, cell, &out, touches);
        return out;
    }
    portal = s->rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES;
    out.cell = slrt_cell_across(s->rt, directed);
    out.is_blocked = slrt_is_blocked(s, directed);
    out.is_limited = !s->on_foot && slrt_is_limited(s->rt, directed);
    out.right = portal + 24;
    out.left = portal + 8;
    return out;
}

/// Follows a line as long as it passes between ends of portals. A wall or a shut door that it comes
/// to, or a box, stops it.
static slrt_finding slrt_follow_within(const slrt_search *s, const slrt_arm *way) {
    uint32_t cell = s->eye_cell, steps = s->rt->loose ? 0 : s->rt->cell_count;
    bool limited = false;
    if (slrt_place_in(s->rt, cell, s->x, s->y) <= 0) return SLRT_TOUCHES;
    for (; steps; steps--) {
        bool touches;
        const slrt_exit out = slrt_exit_of(s, way, cell, &touches);
        int place;
        if (s->stops && s->stops(s, way, cell)) return SLRT_STOPS;
        if (touches) return SLRT_TOUCHES;
        place = out.cell == SLRT_NONE
                    ? slrt_place_in(s->rt, cell, way->to_x, way->to_y)
                    : slrt_side_of_line(out.right, out.left, way->to_x, way->to_y);
        if (place > 0) return SLRT_ARRIVES;
        if (!place) return SLRT_TOUCHES;
        if (out.cell == SLRT_NONE || out.is_blocked || (limited && out.is_limited))
            return SLRT_STOPS;
        limited = limited || out.is_limited;
        cell = out.cell;
    }
    return SLRT_TOUCHES;
}

/// Whether the eye is on a directed portal, ends included.
static bool slrt_is_on_portal(const slrt_search *s, uint32_t directed) {
    const slrt_arm p = slrt_border(s, 2 * directed + 1), q = slrt_border(s, 2 * directed);
    return !slrt_same_way(&p, &q) && !slrt_side(&p, &q);
}

/// Adds the row of a cell to the cells that the search may enter.
static void slrt_allow_row(slrt_search *s, uint32_t cell) {
    sl_runtime_run run = sl_runtime_row(s->rt, cell);
    uint32_t i;
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++) s->marks[i] |= SLRT_IN_ROW;
}

/// Allows the rows of the cells at glass that the eye is in line with. A line along it may cross it
/// as rows do not know it; after the last such portal, they know all of it.
static void slrt_allow_rows_in_line(slrt_search *s) {
    const sl_runtime *rt = s->rt;
    uint32_t i;
    for (i = 0; i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12;
        const unsigned char *seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        const unsigned char *portal = rt->portals + (size_t)slrt_u32(on) * SLRT_PORTAL_BYTES;
        if (slrt_u32(seam + 32) != 2 || slrt_side_of_line(seam, seam + 16, s->x, s->y)) continue;
        slrt_allow_row(s, slrt_u32(portal)); // empty for what is no cell
        slrt_allow_row(s, slrt_u32(portal + 4));
    }
}

/// Whether two ranges of numbers, each with its ends in any order, have a number in common.
static bool slrt_overlap(double a, double b, double c, double d) {
    return (a < b ? b : a) >= (c < d ? c : d) && (c < d ? d : c) >= (a < b ? a : b);
}

/// Whether the way from the eye to a point meets a directed portal, ends included.
static bool slrt_way_meets(const slrt_search *s, const slrt_arm *way, uint32_t directed) {
    const slrt_arm p = slrt_border(s, 2 * directed + 1), q = slrt_border(s, 2 * directed);
    const int right = slrt_side(way, &p), left = slrt_side(way, &q);
    if (right * left > 0) return false;
    if (!right && !left)
        return slrt_overlap(s->x, way->to_x, p.to_x, q.to_x) &&
               slrt_overlap(s->y, way->to_y, p.to_y, q.to_y);
    return slrt_side(&p, &q) * slrt_side_of_portal_line(s->rt, directed, way->to_x, way->to_y) <= 0;
}

/// Of so many cells, a list is faster than marks, which have to be cleared first.
enum { SLRT_FEW_CELLS = 32 };

static bool slrt_is_listed(const slrt_search *s, uint32_t cell) {
    uint32_t i;
    if (s->has_marks) return (s->marks[cell] & SLRT_OWN) != 0;
    for (i = 0; i < s->own_count && s->path[i] != cell; i++) {
    }
    return i < s->own_count;
}

/// Until the search starts, the path is the list.
static void slrt_list(slrt_search *s, uint32_t cell) {
    uint32_t i = s->own_count;
    s->path[s->own_count++] = cell;
    if (!s->has_marks && s->own_count < SLRT_FEW_CELLS) return;
    if (!s->has_marks) {
        memset(s->marks, 0, s->rt->cell_count);
        s->has_marks = true;
        i = 0;
    }
    for (; i < s->own_count; i++) s->marks[s->path[i]] |= SLRT_OWN;
}

/// Which portals are gone through.
enum { SLRT_NOT_LIMITED = 1, SLRT_ONLY_LIMITED = 2, SLRT_ANY = 3 };

/// Lists the cells behind the open portals of a cell that a way meets, NULL for the way that is the
/// eye alone.
static void slrt_list_behind(slrt_search *s, const slrt_arm *way, uint32_t cell, int which) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    uint32_t i;
    for (i = c.first_directed; i < c.first_directed + c.directed_count; i++) {
        const uint32_t to = slrt_cell_across(s->rt, i);
        if (!(way ? slrt_way_meets(s, way, i) : slrt_is_on_portal(s, i)) || slrt_is_listed(s, to) ||
            slrt_is_blocked(s, i))
            continue;
        if (which != SLRT_ANY && (which == SLRT_ONLY_LIMITED) != slrt_is_limited(s->rt, i))
            continue;
        slrt_list(s, to);
        if (s->has_row) slrt_allow_row(s, to);
    }
}

/// As slrt_follow, in a file with limited walls: first the cells about the eye, then those that the
/// way leads to, then those behind a limited wall.
static bool slrt_follow_limited(slrt_search *s, const slrt_arm *way) {
    uint32_t at, first;
    int passed;
    slrt_list(s, s->eye_cell);
    for (at = 0; at < s->own_count; at++) slrt_list_behind(s, NULL, s->path[at], SLRT_ANY);
    for (passed = 0, first = 0; passed < 2; passed++) {
        for (at = first; at < s->own_count; at++) {
            if (s->stops && s->stops(s, way, s->path[at])) return false;
            if (slrt_holds(s->rt, s->path[at], way->to_x, way->to_y)) return true;
            slrt_list_behind(s, way, s->path[at], SLRT_NOT_LIMITED);
        }
        first = s->own_count;
        for (at = 0; at < first && !passed; at++)
            slrt_list_behind(s, way, s->path[at], SLRT_ONLY_LIMITED);
    }
    return false;
}

/// Lists the eye's cell and those that it leads to through all open portals that a way meets, until
/// a cell touches the end of the way: then true. NULL for the way that is the eye alone: the cells
/// are the eye's, and their rows count.
static bool slrt_follow(slrt_search *s, const slrt_arm *way) {
    uint32_t at;
    if (way && s->rt->has_limits) return slrt_follow_limited(s, way);
    slrt_list(s, s->eye_cell);
    for (at = 0; at < s->own_count; at++) {
        if (s->stops && s->stops(s, way, s->path[at])) return false;
        if (way && slrt_holds(s->rt, s->path[at], way->to_x, way->to_y)) return true;
        slrt_list_behind(s, way, s->path[at], SLRT_ANY);
    }
    return false;
}
