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
// counter-clockwise order, depth first, and the polygon needs no sorting. A sector that has passed
// a limited wall takes the next one for a wall; those that the eye is on do not count. Signs are
// exact. Pieces
// in one line join; where one ends is computed only when the next one is known not to join. Cost:
// the sides and portals of the cells that are seen, counted once for each sector. (Teller 1992;
// with triangles for cells: Bungiu et al. 2014, Efficient Computation of Visibility Polygons.)

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

/// The borders of what is seen through a portal: those given, or its own ends for SLRT_NONE. False
/// if it is blocked or out of range, and for no portal.
static bool slrt_pass(const slrt_polygon *p, uint32_t portal, uint32_t *right, uint32_t *left) {
    if (portal == SLRT_NONE || slrt_is_blocked(&p->s, portal)) return false;
    if (*right == SLRT_NONE) *right = 2 * portal + 1;
    if (*left == SLRT_NONE) *left = 2 * portal;
    return !(p->s.range > 0) || slrt_in_range(&p->s, portal, *right, *left);
}

static void slrt_see_wall(slrt_polygon *p, uint32_t cell, const slrt_piece *piece, uint32_t right,
                          uint32_t left) {
    if (p->see_wall)
        p->see_wall(p, cell, piece, right, left);
    else
        slrt_add_wall(p, piece, right, left);
}

// The search. The path is a stack of six numbers for each cell: the cell, the portal through which
// it was entered, the portal passed last and its side, and the borders of the sector. With the side
// is SLRT_PAST_LIMIT, if the sector has passed a limited wall.

enum { SLRT_FRAME = 6 };
#define SLRT_PAST_LIMIT 0x80000000u

static void slrt_push(slrt_polygon *p, uint32_t directed, uint32_t right, uint32_t left,
                      uint32_t past) {
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
    top[3] = slrt_side_of_portal(p, &cell, twin) | past;
    if (slrt_is_limited(p->s.rt, directed)) top[3] |= SLRT_PAST_LIMIT;
    top[4] = right;
    top[5] = left;
    p->s.depth++;
    if (p->meet) p->meet(p, top[0]);
}

/// Goes on around the cell on top of the path: adds walls up to the next open portal and enters
/// that, or leaves the cell.
static void slrt_spread_on(slrt_polygon *p) {
    uint32_t *top = p->s.path + (size_t)SLRT_FRAME * (p->s.depth - 1);
    const slrt_arm a = slrt_border(&p->s, top[4]), b = slrt_border(&p->s, top[5]);
    const uint32_t past = top[3] & SLRT_PAST_LIMIT;
    bool within = top[2] != top[1]; // what is right of the sector is passed
    slrt_walk w;
    slrt_piece piece;
    w.cell = sl_runtime_get_cell(p->s.rt, top[0]);
    slrt_walk_start(p, &w, top[1], top[2], top[3] & ~SLRT_PAST_LIMIT, 1);
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
        if (!(past && portal != SLRT_NONE && slrt_is_limited(p->s.rt, portal)) &&
            slrt_pass(p, portal, &right, &left)) {
            top[2] = portal;
            top[3] = w.side | past;
            if (end <= 0) p->s.depth--; // nothing is left to see of this cell
            slrt_push(p, portal, right, left, past);
            return;
        }
        slrt_see_wall(p, top[0], &piece, right, left);
        if (end <= 0) break;
    }
    p->s.depth--;
}

/// Adds what is seen of a piece, or through it.
static void slrt_see_piece(slrt_polygon *p, const slrt_piece *piece, uint32_t right,
                           uint32_t left) {
    const uint32_t portal = piece->directed;
    if (!slrt_pass(p, portal, &right, &left)) {
        slrt_see_wall(p, p->fan_cell, piece, right, left);
        return;
    }
    slrt_push(p, portal, right, left, 0);
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
    p->fan_cell = cell;
    if (p->meet) p->meet(p, cell);
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

/// Finds where the way around the eye starts: clockwise as far as portals lead, or once around. A
/// wall that ends at the eye is seen edge-on, and hides nothing.
static void slrt_find_fan(slrt_polygon *p) {
    slrt_touch touch = slrt_touch_of(p, p->s.eye_cell), last = touch;
    p->fan_first = p->s.eye_cell;
    p->inside = !touch.any;
    p->fan_is_closed = p->inside;
    if (p->inside) return;
    while (touch.behind != SLRT_NONE && !p->broken) {
        p->fan_first = slrt_cell_across(p->s.rt, touch.behind);
        p->fan_is_closed = p->fan_first == p->s.eye_cell;
        if (p->fan_is_closed) return;
        touch = slrt_touch_of(p, p->fan_first);
    }
    while (last.before != SLRT_NONE && !p->broken)
        last = slrt_touch_of(p, slrt_cell_across(p->s.rt, last.before));
    memcpy(p->fan_right, touch.behind_end, sizeof p->fan_right);
    memcpy(p->fan_left, last.before_end, sizeof p->fan_left);
    {
        const slrt_arm right = slrt_arm_to(p, p->fan_right), left = slrt_arm_to(p, p->fan_left);
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
        cell = slrt_cell_across(p->s.rt, before);
        if (p->fan_is_closed && cell == p->fan_first) return;
        slrt_see_fan_cell(p, cell);
    }
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

/// Prepares a polygon. False if the eye sees nothing.
static bool slrt_start_polygon(slrt_polygon *p, const sl_runtime *rt, const sl_runtime_view *view,
                               const unsigned char *shut, double range, uint32_t *scratch,
                               double *points, uint32_t room) {
    // So that no number in units of the range overflows.
    const double least = 1e-100 * (rt->max_x - rt->min_x) + 1e-100 * (rt->max_y - rt->min_y);
    bool sees;
    memset(p, 0, sizeof *p);
    sees = slrt_start_search(&p->s, rt, view, shut, range, scratch);
    if (p->s.range > 0 && p->s.range < least) p->s.range = least;
    p->s.patience =
        (uint64_t)SLRT_PATIENCE * 16 * ((uint64_t)rt->directed_count + rt->vertex_count + 16);
    p->fan_last = UINT32_MAX;
    p->points = points;
    p->room = room;
    return sees && !rt->loose;
}

/// Makes the polygon, after slrt_find_fan. Returns the number of its points.
static uint32_t slrt_see_polygon(slrt_polygon *p) {
    uint32_t last, i;
    const uint32_t pieces = slrt_cut_cone(&p->s, &last);
    p->waits = !pieces && !p->gap;
    if (!pieces) {
        slrt_see_fan(p);
    } else {
        slrt_add_eye(p);
        for (i = 0; i < pieces; i++)
            slrt_see_sector(p, SLRT_ARM + i, SLRT_ARM + (i + 1 < pieces ? i + 1 : last));
    }
    slrt_close(p, !pieces && !p->gap);
    return p->broken || p->count < 3 || p->written < 3 ? 0 : p->written;
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon(const sl_runtime *runtime,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *scratch, double *points,
                                                   uint32_t room) {
    slrt_polygon p;
    if (!slrt_start_polygon(&p, runtime, view, shut, range, scratch, points, room)) return 0;
    slrt_find_fan(&p);
    return slrt_see_polygon(&p);
}
