/// Boxes: what of them is seen.

// A search enters a cell with a sector of directions. A box in that cell is seen there if box,
// sector and cell have a point in common (box_sector.h).
//
// A box that blocks takes an open arc from the sectors of what is behind it: the directions that
// pass its inside. What of a sector is left is tested the same way. Cost: for each visit of a cell,
// the cell's boxes, times the blocking boxes that are seen past walls.

enum { SLRT_BOX_PAST_WALLS = 1, SLRT_BOX_SEEN = 2, SLRT_BOX_HIDDEN = 4 };

static bool slrt_box_holds(const sl_runtime_box *box, double x, double y) {
    return box->min_x <= x && x <= box->max_x && box->min_y <= y && y <= box->max_y;
}

static slrt_arm slrt_arm_to_corner(const slrt_search *s, const sl_runtime_box *box, int right,
                                   int top) {
    return slrt_make_arm(s->x, s->y, right ? box->max_x : box->min_x,
                         top ? box->max_y : box->min_y);
}

/// Whether a box, which reaches into a cell, has a point in that cell and in a sector in which the
/// eye sees into it.
static bool slrt_sees_box_in(const slrt_search *s, const sl_runtime_box *box, uint32_t cell,
                             const slrt_arm *u, const slrt_arm *v) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    double at[4];
    slrt_read_box(box, 0, at);
    return slrt_box_meets_within(s, at, c.first_vertex, c.vertex_count, u, v);
}

/// Where the lines of sight are that a box stops.
typedef enum slrt_shadow { SLRT_NOWHERE, SLRT_IN_ARC, SLRT_ALL_ROUND_IT } slrt_shadow;

/// The directions from `right` to `left` in which a box lies, for an eye that is not within it.
/// Those between them pass its inside. Where the eye is on a side, they go along that side.
static slrt_shadow slrt_shadow_of(const slrt_search *s, const sl_runtime_box *box, slrt_arm *right,
                                  slrt_arm *left) {
    // By column and row of the eye about the box: the corners (1 right, 2 top) of the borders.
    static const unsigned char corners[3][3][2] = {
        {{1, 2}, {0, 2}, {0, 3}}, {{1, 0}, {0, 0}, {2, 3}}, {{3, 0}, {3, 1}, {2, 1}}};
    const int column = s->x <= box->min_x ? 0 : s->x >= box->max_x ? 2 : 1;
    const int row = s->y <= box->min_y ? 0 : s->y >= box->max_y ? 2 : 1;
    const unsigned char *at = corners[column][row];
    if (column == 1 && row == 1) return SLRT_ALL_ROUND_IT;
    if (slrt_box_holds(box, s->x, s->y) && (box->min_x == box->max_x || box->min_y == box->max_y))
        return SLRT_NOWHERE;
    *right = slrt_arm_to_corner(s, box, at[0] & 1, at[0] & 2);
    *left = slrt_arm_to_corner(s, box, at[1] & 1, at[1] & 2);
    return SLRT_IN_ARC;
}

/// Whether a box lies before another one, so that a line through both passes it first. Where a flat
/// box touches the other one, or the eye is within the box (`strictly`), a line comes to both in
/// one point. Then it does not hide the other one.
static bool slrt_is_before(const slrt_search *s, const sl_runtime_box *near_box,
                           const sl_runtime_box *far_box, bool strictly) {
    const bool flat_x = strictly || near_box->min_x == near_box->max_x;
    const bool flat_y = strictly || near_box->min_y == near_box->max_y;
    const double right = far_box->min_x - near_box->max_x, left = near_box->min_x - far_box->max_x;
    const double over = far_box->min_y - near_box->max_y, under = near_box->min_y - far_box->max_y;
    return ((flat_x ? right > 0 : right >= 0) && s->x <= far_box->min_x) ||
           ((flat_x ? left > 0 : left >= 0) && s->x >= far_box->max_x) ||
           ((flat_y ? over > 0 : over >= 0) && s->y <= far_box->min_y) ||
           ((flat_y ? under > 0 : under >= 0) && s->y >= far_box->max_y);
}

/// Whether all of a box is on the eye's side of a directed portal's line.
static bool slrt_is_before_portal(const slrt_search *s, const sl_runtime_box *box,
                                  uint32_t directed, bool within) {
    const unsigned char *left = s->rt->directed + (size_t)directed * SLRT_DIRECTED_BYTES + 8;
    int k;
    for (k = 0; k < 4; k++)
        if (slrt_side_of_line(left + 16, left, k & 1 ? box->max_x : box->min_x,
                              k & 2 ? box->max_y : box->min_y) < (within ? 1 : 0))
            return false;
    return true;
}

/// What boxes may hide: a box, or what is behind a directed portal.
typedef struct slrt_target {
    uint32_t box; ///< SLRT_NO_ENTRY for none
    uint32_t directed;
    const uint32_t *blockers; ///< the boxes that may hide it
    uint32_t blocker_count;
} slrt_target;

/// The arc that a blocking box may take from what is seen of a target. (Of a portal that is so only
/// if slrt_is_before_portal; that takes longer to find out than whether the arc counts.)
static slrt_shadow slrt_shadow_on(const slrt_search *s, const slrt_target *target, uint32_t blocker,
                                  slrt_arm *right, slrt_arm *left) {
    const sl_runtime_box *box = &s->boxes->boxes[blocker];
    const bool within =
        box->min_x < s->x && s->x < box->max_x && box->min_y < s->y && s->y < box->max_y;
    if (target->box != SLRT_NO_ENTRY &&
        (blocker == target->box || !slrt_is_before(s, box, &s->boxes->boxes[target->box], within)))
        return SLRT_NOWHERE;
    return slrt_shadow_of(s, box, right, left);
}

static bool slrt_is_inside(const slrt_arm *v, const slrt_arm *right, const slrt_arm *left) {
    return slrt_side(right, v) > 0 && slrt_side(v, left) > 0;
}

/// Whether a box hides a direction of a target.
static slrt_shadow slrt_hides(const slrt_search *s, const slrt_target *target, uint32_t blocker,
                              const slrt_arm *direction, slrt_arm *right, slrt_arm *left) {
    const slrt_shadow shadow = slrt_shadow_on(s, target, blocker, right, left);
    if (shadow == SLRT_NOWHERE ||
        (shadow == SLRT_IN_ARC && !slrt_is_inside(direction, right, left)))
        return SLRT_NOWHERE;
    if (target->box == SLRT_NO_ENTRY &&
        !slrt_is_before_portal(s, &s->boxes->boxes[blocker], target->directed,
                               shadow == SLRT_ALL_ROUND_IT))
        return SLRT_NOWHERE;
    return shadow;
}

/// Turns `from` to the left until no box hides that direction; false if all up to `to` is hidden.
static bool slrt_skip_hidden(const slrt_search *s, const slrt_target *target, slrt_arm *from,
                             const slrt_arm *to) {
    bool moved = true;
    while (moved) {
        uint32_t i;
        moved = false;
        for (i = 0; i < target->blocker_count; i++) {
            slrt_arm right, left;
            const slrt_shadow shadow =
                slrt_hides(s, target, target->blockers[i], from, &right, &left);
            if (shadow == SLRT_NOWHERE) continue;
            if (shadow == SLRT_ALL_ROUND_IT || slrt_is_inside(to, &right, &left)) return false;
            *from = left;
            moved = true;
        }
    }
    return true;
}

/// The first shadow between two directions, borders included: moves `to` to where it starts, and
/// `next` to where it ends. False for none.
static bool slrt_find_shadow(const slrt_search *s, const slrt_target *target, const slrt_arm *from,
                             slrt_arm *to, slrt_arm *next) {
    bool found = false;
    uint32_t i;
    for (i = 0; i < target->blocker_count; i++) {
        slrt_arm right, left;
        if (slrt_shadow_on(s, target, target->blockers[i], &right, &left) != SLRT_IN_ARC ||
            slrt_same_ray(&right, &left) ||
            !slrt_within(&right, from, to, slrt_side(from, &right), slrt_side(&right, to)))
            continue;
        *to = right;
        *next = left;
        found = true;
    }
    return found;
}

/// Leaves out blockers that hide nothing between two directions.
static void slrt_choose_blockers(const slrt_search *s, slrt_target *target, const slrt_arm *from,
                                 const slrt_arm *to) {
    uint32_t *chosen = s->chosen;
    uint32_t i, count = 0;
    for (i = 0; i < target->blocker_count; i++) {
        slrt_arm right, left;
        const uint32_t blocker = target->blockers[i];
        const slrt_shadow shadow = slrt_shadow_on(s, target, blocker, &right, &left);
        if (shadow == SLRT_NOWHERE) continue;
        if (shadow == SLRT_IN_ARC && !slrt_is_inside(from, &right, &left) &&
            !slrt_within(&right, from, to, slrt_side(from, &right), slrt_side(&right, to)))
            continue;
        chosen[count++] = blocker;
    }
    target->blockers = chosen;
    target->blocker_count = count;
}

/// Whether the eye sees a box in a cell past the boxes that block, within the sector from u to v.
static bool slrt_sees_box_past(const slrt_search *s, uint32_t box, uint32_t cell, slrt_arm u,
                               const slrt_arm *v) {
    slrt_target target;
    target.box = box;
    target.directed = 0;
    target.blockers = s->blockers;
    target.blocker_count = s->blocker_count;
    if (!slrt_sees_box_in(s, &s->boxes->boxes[box], cell, &u, v)) return false;
    slrt_choose_blockers(s, &target, &u, v);
    while (slrt_skip_hidden(s, &target, &u, v)) {
        slrt_arm to = *v, next;
        const bool more = slrt_find_shadow(s, &target, &u, &to, &next);
        if (slrt_sees_box_in(s, &s->boxes->boxes[box], cell, &u, &to)) return true;
        if (!more || slrt_same_ray(&to, v) || slrt_is_inside(v, &to, &next)) return false;
        u = next;
    }
    return false;
}

/// Whether others hide all of a box, walls aside.
static bool slrt_is_hidden_box(const slrt_search *s, uint32_t box) {
    slrt_arm from, to;
    slrt_target target;
    target.box = box;
    target.directed = 0;
    target.blockers = s->blockers;
    target.blocker_count = s->blocker_count;
    if (slrt_shadow_of(s, &s->boxes->boxes[box], &from, &to) != SLRT_IN_ARC) return false;
    slrt_choose_blockers(s, &target, &from, &to);
    return !slrt_skip_hidden(s, &target, &from, &to);
}

/// Whether boxes hide all that a sector shows behind a directed portal.
static bool slrt_is_hidden_portal(const slrt_search *s, uint32_t directed,
                                  const slrt_sector *sector) {
    slrt_arm from = slrt_border(s, sector->right);
    const slrt_arm to = slrt_border(s, sector->left);
    slrt_target target;
    target.box = SLRT_NO_ENTRY;
    target.directed = directed;
    target.blockers = s->blockers;
    target.blocker_count = s->blocker_count;
    return !slrt_skip_hidden(s, &target, &from, &to);
}

/// Whether some of a box is within range.
static bool slrt_box_in_range(const slrt_search *s, const sl_runtime_box *box) {
    const double x = s->x < box->min_x   ? box->min_x - s->x
                     : s->x > box->max_x ? s->x - box->max_x
                                         : 0;
    const double y = s->y < box->min_y   ? box->min_y - s->y
                     : s->y > box->max_y ? s->y - box->max_y
                                         : 0;
    const double limit = s->range * (1 + 1e-12);
    return !(s->range > 0) || !(x * x + y * y > limit * limit);
}

/// For an eye on a wall that bounds a cell behind it: a line along that wall comes into the cell by
/// a portal farther on. Whether it meets a box from there on.
static bool slrt_meets_behind_wall(const slrt_search *s, const sl_runtime_box *box, uint32_t cell,
                                   const slrt_arm *ray) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    slrt_search from = *s;
    double at[4];
    uint32_t i;
    slrt_read_box(box, 0, at);
    for (i = c.first_directed; i < c.first_directed + c.directed_count; i++) {
        const slrt_arm p = slrt_border(s, 2 * i + 1), q = slrt_border(s, 2 * i);
        const slrt_arm along = slrt_make_arm(p.to_x, p.to_y, q.to_x, q.to_y);
        const bool p_is_near = slrt_same_way(&along, ray);
        if (slrt_side(&p, &q) || !slrt_same_way(&p, &q) || slrt_is_blocked(s, i)) continue;
        if (!slrt_same_ray(&p, ray)) continue;
        from.x = p_is_near ? p.to_x : q.to_x;
        from.y = p_is_near ? p.to_y : q.to_y;
        if (slrt_box_meets_sector(&from, at, ray, ray)) return true;
    }
    return false;
}

static bool slrt_sees_box(const slrt_search *s, uint32_t box, uint32_t cell,
                          const slrt_sector *sector) {
    const sl_runtime_box *at = &s->boxes->boxes[box];
    slrt_arm u, v;
    if (!slrt_box_in_range(s, at)) return false;
    if (sector->right != SLRT_ALL_ROUND) {
        u = slrt_border(s, sector->right);
        v = slrt_border(s, sector->left);
    } else if (!s->is_hidden || slrt_box_holds(at, s->x, s->y)) {
        return true;
    } else {
        slrt_shadow_of(s, at, &u, &v);
    }
    if (!(s->marks[cell] & SLRT_OWN) && slrt_same_ray(&u, &v) &&
        slrt_holds(s->rt, cell, s->x, s->y) && !slrt_meets_behind_wall(s, at, cell, &u))
        return false;
    return s->is_hidden ? slrt_sees_box_past(s, box, cell, u, &v)
                        : slrt_sees_box_in(s, at, cell, &u, &v);
}

/// Marks the boxes that are seen in a cell, through a sector.
static void slrt_meet_boxes(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    const unsigned char wanted = s->is_hidden ? SLRT_BOX_PAST_WALLS : 0;
    const unsigned char found = s->is_hidden ? SLRT_BOX_SEEN : SLRT_BOX_PAST_WALLS;
    uint32_t at = *slrt_first_entry(s->boxes, cell);
    while (at != SLRT_NO_ENTRY) {
        const uint32_t *entry = slrt_entry(s->boxes, at);
        unsigned char *mark = s->box_marks + entry[SLRT_ENTRY_BOX];
        if (*mark == wanted && slrt_sees_box(s, entry[SLRT_ENTRY_BOX], cell, sector)) *mark = found;
        at = entry[SLRT_ENTRY_IN_CELL];
    }
}
