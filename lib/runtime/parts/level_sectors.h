/// Eye-to-cell: sectors of directions, and how a portal narrows them.

SL_RUNTIME_API sl_runtime_view sl_runtime_view_all_round(double x, double y) {
    sl_runtime_view view;
    memset(&view, 0, sizeof view);
    view.x = x;
    view.y = y;
    view.all_round = true;
    return view;
}

SL_RUNTIME_API sl_runtime_view sl_runtime_view_toward(double x, double y, double direction_x,
                                                      double direction_y, double tan_half) {
    sl_runtime_view view = sl_runtime_view_all_round(x, y);
    view.all_round = false;
    view.right[0] = direction_x + direction_y * tan_half;
    view.right[1] = direction_y - direction_x * tan_half;
    view.left[0] = direction_x - direction_y * tan_half;
    view.left[1] = direction_y + direction_x * tan_half;
    return view;
}

/// A border of a sector is a number: 2e for the left end of directed portal e, 2e + 1 for the right
/// end; or one of the cone's arms.
#define SLRT_ARM       (UINT32_MAX - 6)
#define SLRT_ALL_ROUND UINT32_MAX                 ///< no borders: the eye is in the cell
enum { SLRT_MOST_ARMS = 6, SLRT_MIRROR_ARM = 4 }; ///< the last two: the ends of a mirror

/// The limit of steps for each directed portal of the map. In sound maps few need more than one;
/// four is the most seen.
#ifndef SLRT_PATIENCE
#define SLRT_PATIENCE 256
#endif

enum {
    SLRT_SEEN = 1,
    SLRT_ENTERED = 2,
    SLRT_ON_PATH = 4,
    SLRT_IN_ROW = 8,
    // Of the last visit: which borders of the sector run along a portal that was crossed. A line on
    // the right border has crossed it to the left, one on the left border to the right.
    SLRT_ALONG_RIGHT = 16,
    SLRT_ALONG_LEFT = 32,
    SLRT_ALONG = SLRT_ALONG_RIGHT | SLRT_ALONG_LEFT,
    SLRT_OWN = 64,     ///< one of the eye's cells, or on the way to a point
    SLRT_LIMITED = 128 ///< of the last visit: the way there crosses a limited wall
};

/// What of a cell's surroundings the eye sees through the portals passed: a sector, and which of
/// its borders run along portals (of SLRT_ALONG).
typedef struct slrt_sector {
    uint32_t right, left;
    unsigned along;
    unsigned limited; ///< SLRT_LIMITED if a limited wall is among the portals, else 0
} slrt_sector;

/// A depth-first search. The path is a stack of four numbers for each cell: the cell, the number of
/// its directed portals that are done, and the right and left border of the sector through which
/// the eye sees it.
typedef struct slrt_search {
    const sl_runtime *rt;
    const sl_runtime_view *view;
    const unsigned char *shut; ///< NULL for none
    double range;              ///< 0 for no limit
    double x, y;               ///< the eye
    uint32_t eye_cell;         ///< that sl_runtime_locate gives
    uint32_t own_count;        ///< of the cells listed: the eye's, or those on a way
    bool has_marks;            ///< the marks of these say so
    slrt_arm cone[SLRT_MOST_ARMS];
    uint32_t *path, depth;
    uint32_t *sectors; ///< by cell: the borders of the sector of its last visit
    unsigned char *marks;
    bool has_row;
    bool on_foot; ///< glass is a wall from both sides, and steps count in place of sight
    uint32_t *cells, room, count;
    uint64_t patience;
    bool in_mirrors; ///< `meet` looks into mirrors
    bool is_image;   ///< the eye is an image, which stands in no cell
    /// NULL for a search without boxes and mirrors, and till boxes hide. By these a program that
    /// asks for none is built without what is only for them.
    void (*meet)(struct slrt_search *s, uint32_t cell, const slrt_sector *sector);
    bool (*is_hidden)(const struct slrt_search *s, uint32_t directed, const slrt_sector *sector);
    bool (*stops)(const struct slrt_search *s, const slrt_arm *way, uint32_t cell);
    const sl_runtime_boxes *boxes;     ///< the rest is about them
    uint32_t except;                   ///< a box that stops nothing
    unsigned char *box_marks;          ///< by box, of SLRT_BOX_*
    uint32_t *blockers, blocker_count; ///< those that hide something
    uint32_t *chosen;                  ///< room for as many as there are boxes
    bool gave_up;                      ///< the search took too long
} slrt_search;

static slrt_arm slrt_border(const slrt_search *s, uint32_t border) {
    const unsigned char *end;
    if (border >= SLRT_ARM) return s->cone[border - SLRT_ARM];
    end = s->rt->directed + (size_t)(border / 2) * SLRT_DIRECTED_BYTES + 8 + 16 * (border % 2);
    return slrt_make_arm(s->x, s->y, slrt_f64(end), slrt_f64(end + 8));
}

static bool slrt_is_zero(const slrt_arm *arm) {
    return arm->to_x == arm->from_x && arm->to_y == arm->from_y;
}

/// Whether v is in the sector from a counter-clockwise to b, of at most 180 degrees, borders
/// included. The signs of a x v and v x b are given.
static bool slrt_within(const slrt_arm *v, const slrt_arm *a, const slrt_arm *b, int from_a,
                        int to_b) {
    if (from_a < 0 || to_b < 0) return false;
    return (from_a && to_b) || slrt_same_way(a, v) || slrt_same_way(b, v);
}

static bool slrt_same_ray(const slrt_arm *u, const slrt_arm *v) {
    return !slrt_side(u, v) && slrt_same_way(u, v);
}

/// Whether a portal with the ends p and q has a direction of the sector from a to b.
static bool slrt_is_ahead(const slrt_arm *p, const slrt_arm *q, const slrt_arm *a,
                          const slrt_arm *b) {
    return slrt_within(p, a, b, slrt_side(a, p), slrt_side(p, b)) ||
           slrt_within(a, p, q, slrt_side(p, a), slrt_side(a, q));
}

/// Narrows a sector to its part that leaves the last cell on the path through a directed portal,
/// which the eye is not on; false for none. The first cell is one of the eye's. What a sector
/// reaches of any other one is ahead, within less than 180 degrees. (sli_arc_narrow in the
/// library.)
static bool slrt_narrow(const slrt_search *s, uint32_t directed, slrt_sector *sector) {
    const uint32_t portal_right = 2 * directed + 1, portal_left = 2 * directed;
    const slrt_arm p = slrt_border(s, portal_right), q = slrt_border(s, portal_left);
    slrt_arm right = p, left = q, to_left;
    int turn;
    if (sector->right == SLRT_ALL_ROUND) {
        sector->right = portal_right;
        sector->left = portal_left;
    } else {
        right = slrt_border(s, sector->right);
        left = slrt_border(s, sector->left);
        if (s->depth == 1 && !slrt_is_ahead(&p, &q, &right, &left)) return false;
        if (slrt_side(&right, &p) > 0) {
            right = p;
            sector->right = portal_right;
            sector->along &= ~(unsigned)SLRT_ALONG_RIGHT;
        }
        if (slrt_side(&left, &q) < 0) {
            left = q;
            sector->left = portal_left;
            sector->along &= ~(unsigned)SLRT_ALONG_LEFT;
        }
    }
    turn = slrt_side(&right, &left);
    if (turn) return turn > 0;
    if (!slrt_side(&p, &q)) {
        // Who goes from its right end to its left end crosses it to the right.
        to_left = slrt_make_arm(p.to_x, p.to_y, q.to_x, q.to_y);
        sector->along |= slrt_same_way(&to_left, &right) ? (unsigned)SLRT_ALONG_LEFT
                                                         : (unsigned)SLRT_ALONG_RIGHT;
    }
    return sector->along != SLRT_ALONG; // no line beside it passes all portals along it
}

/// Whether a directed portal, from its right end to its left, goes as the glass that it is on: it
/// leads to the dark.
static bool slrt_leads_along(const sl_runtime *rt, uint32_t directed, const unsigned char *glass) {
    const unsigned char *ends = rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8;
    const slrt_arm to_left =
        slrt_make_arm(slrt_f64(ends + 16), slrt_f64(ends + 24), slrt_f64(ends), slrt_f64(ends + 8));
    const slrt_arm along = slrt_make_arm(slrt_f64(glass), slrt_f64(glass + 8), slrt_f64(glass + 16),
                                         slrt_f64(glass + 24));
    return slrt_same_way(&to_left, &along);
}

/// Whether one-way glass keeps sight from the eye. From its a to its b, it is seen through from the
/// right to the left. For an eye on its line, the eye's cell decides; for an image there, which way
/// the portal leads.
static bool slrt_is_dark(const slrt_search *s, const unsigned char *glass, uint32_t directed) {
    const sl_runtime_cell cell = sl_runtime_get_cell(s->rt, s->eye_cell);
    const unsigned char *corner = s->rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const int side = slrt_side_of_line(glass, glass + 16, s->x, s->y);
    uint32_t i;
    if (side) return side > 0;
    if (s->is_image) return slrt_leads_along(s->rt, directed, glass);
    for (i = 0; i < cell.vertex_count; i++, corner += SLRT_VERTEX_BYTES)
        if (slrt_side_of_line(glass, glass + 16, slrt_f64(corner), slrt_f64(corner + 8)) > 0)
            return true;
    return false;
}

/// Whether a directed portal is on a shut door or dark glass, and so a wall; on foot, also on a
/// wall that stops steps alone.
static bool slrt_is_blocked(const slrt_search *s, uint32_t directed) {
    const sl_runtime *rt = s->rt;
    const uint32_t portal = slrt_u32(rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES);
    uint32_t i;
    if (!rt->seam_portal_count) return false;
    for (i = slrt_first_seam(rt, portal); i < rt->seam_portal_count; i++) {
        const unsigned char *on = rt->seam_portals + (size_t)i * 12, *seam;
        if (slrt_u32(on) != portal) return false;
        seam = rt->seams + (size_t)slrt_u32(on + 4) * 40;
        if (slrt_u32(seam + 32) == 1 && s->shut && s->shut[slrt_u32(seam + 36)]) return true;
        if (slrt_u32(seam + 32) == 2 && (s->on_foot || slrt_is_dark(s, seam, directed)))
            return true;
        if (s->on_foot && slrt_seam_stops(rt, slrt_u32(on + 4)) & SL_RUNTIME_STOPS_STEPS)
            return true;
    }
    return false;
}

static double slrt_size(double x, double y) {
    return (x < 0 ? -x : x) + (y < 0 ? -y : y);
}

/// Where, from 0 to 1, a ray from the eye meets the way from p to q. p and q are given relative to
/// the eye. Also gives a bound for rounding; false if the place is unknown.
static bool slrt_meet(const slrt_arm *ray, const slrt_arm *p, const slrt_arm *q, double *at,
                      double *error) {
    const double size = slrt_size(ray->x, ray->y);
    const double at_p = ray->x * p->y - ray->y * p->x, at_q = ray->x * q->y - ray->y * q->x;
    const double error_p = 1e-15 * size * slrt_size(p->x, p->y);
    const double error_q = 1e-15 * size * slrt_size(q->x, q->y);
    const double width = at_q - at_p;
    if (!(width > 4 * (error_p + error_q))) return false;
    *at = -at_p / width;
    *error = 2 * (error_p + (*at < 0 ? -*at : *at) * (error_p + error_q)) / width + 1e-15;
    return true;
}

/// Whether the part of a segment from p to q between two borders is within range; NULL for its end.
static inline bool slrt_is_part_in_range(const slrt_search *s, const slrt_arm *p, const slrt_arm *q,
                                         const slrt_arm *right, const slrt_arm *left) {
    const double x = q->x - p->x, y = q->y - p->y, square = x * x + y * y;
    const double ends = slrt_size(p->x, p->y) + slrt_size(q->x, q->y);
    const double limit = s->range * (1 + 1e-12) + 1e-14 * ends;
    double from = 0, to = 1, at, error, near_x, near_y;
    if (right && slrt_meet(right, p, q, &at, &error) && at - error > from) from = at - error;
    if (left && slrt_meet(left, p, q, &at, &error) && at + error < to) to = at + error;
    at = square > 0 ? -(p->x * x + p->y * y) / square : 0;
    if (at > to) at = to;
    if (!(at >= from)) at = from;
    near_x = p->x + at * x;
    near_y = p->y + at * y;
    return !(near_x * near_x + near_y * near_y > limit * limit);
}

/// The same for the part of a directed portal between two borders of a sector, or all of it.
static bool slrt_in_range(const slrt_search *s, uint32_t directed, uint32_t right, uint32_t left) {
    const slrt_arm p = slrt_border(s, 2 * directed + 1), q = slrt_border(s, 2 * directed);
    slrt_arm a, b;
    if (right / 2 != directed) a = slrt_border(s, right);
    if (left / 2 != directed) b = slrt_border(s, left);
    return slrt_is_part_in_range(s, &p, &q, right / 2 != directed ? &a : NULL,
                                 left / 2 != directed ? &b : NULL);
}

/// Whether a cell's last visit has seen all that a visit through another sector would.
static bool slrt_covered(const slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    const uint32_t was_right = s->sectors[2 * (size_t)cell];
    const uint32_t was_left = s->sectors[2 * (size_t)cell + 1];
    const unsigned more = s->marks[cell] & SLRT_ALONG & ~sector->along;
    slrt_arm a, b, v, w;
    int a_v, w_b;
    if (s->marks[cell] & SLRT_LIMITED && !sector->limited) return false;
    if (was_right == sector->right && was_left == sector->left) return !more;
    a = slrt_border(s, was_right);
    b = slrt_border(s, was_left);
    v = slrt_border(s, sector->right);
    w = slrt_border(s, sector->left);
    a_v = slrt_side(&a, &v);
    w_b = slrt_side(&w, &b);
    if ((!a_v && more & SLRT_ALONG_RIGHT) || (!w_b && more & SLRT_ALONG_LEFT)) return false;
    return slrt_within(&v, &a, &b, a_v, slrt_side(&v, &b)) &&
           slrt_within(&w, &a, &b, slrt_side(&a, &w), w_b);
}

static void slrt_see(slrt_search *s, uint32_t cell) {
    if (s->marks[cell] & SLRT_SEEN) return;
    s->marks[cell] |= SLRT_SEEN;
    if (s->count < s->room) s->cells[s->count] = cell;
    s->count++;
}
