/// Eye-to-cell by mirrors: what is seen in them, exactly.

// In a cell that is entered, the sector is narrowed to each mirror that is there, as to a portal.
// What leaves by it goes back into the cell about the eye's image (polygon_mirrors.h): a search of
// its own, with marks of its own, in the next part of the scratch memory.

enum { SLRT_MOST_REFLECTIONS = 16 };

/// A search, and how it is come to. The search comes first: its `meet` is given that alone.
typedef struct slrt_reflected {
    slrt_search s;
    slrt_search *first;       ///< the eye's own
    unsigned char *by_mirror; ///< by cell: seen in a mirror
    bool *rounded;
    uint64_t patience; ///< of the eye's own search, for what is seen in mirrors
    uint32_t depth;    ///< reflections that are left
    uint32_t mirror;   ///< that the eye was reflected in; SLRT_NONE for the eye itself
} slrt_reflected;

/// The steps that are left for what is seen in mirrors.
static uint64_t *slrt_mirrors_patience(slrt_reflected *r) {
    return r->s.is_image ? &r->s.patience : &r->patience;
}

/// Whether some of a mirror is where a cell is, by their boxes.
static bool slrt_is_near_cell(const unsigned char *mirror, const double *low, const double *high) {
    int i;
    for (i = 0; i < 2; i++) {
        const double a = slrt_f64(mirror + 8 * i), b = slrt_f64(mirror + 16 + 8 * i);
        if ((a < low[i] && b < low[i]) || (a > high[i] && b > high[i])) return false;
    }
    return true;
}

static bool slrt_is_ray(const slrt_search *s, const slrt_sector *sector) {
    const slrt_arm a = slrt_border(s, sector->right), b = slrt_border(s, sector->left);
    return slrt_same_ray(&a, &b);
}

/// Adds what a portal in line with the eye says about the borders. `p` and `q` lead to its right
/// and left end. False if only a line is left that crosses portals along it both ways: no line
/// beside it passes them all.
static bool slrt_run_along(const slrt_search *s, const slrt_arm *p, const slrt_arm *q,
                           slrt_sector *sector) {
    const slrt_arm a = slrt_border(s, sector->right), b = slrt_border(s, sector->left);
    const slrt_arm to_left = slrt_make_arm(p->to_x, p->to_y, q->to_x, q->to_y);
    if (!slrt_same_way(p, q)) { // the eye is on it
        if (!slrt_side(&to_left, &a) && !slrt_same_way(&to_left, &a))
            sector->along |= SLRT_ALONG_RIGHT;
        if (!slrt_side(&to_left, &b) && slrt_same_way(&to_left, &b))
            sector->along |= SLRT_ALONG_LEFT;
    } else if (slrt_same_ray(&a, &b)) {
        // Who goes from its right end to its left end crosses it to the right.
        sector->along |=
            slrt_same_way(&to_left, &a) ? (unsigned)SLRT_ALONG_LEFT : (unsigned)SLRT_ALONG_RIGHT;
    }
    return sector->along != SLRT_ALONG || !slrt_same_ray(&a, &b);
}

/// Narrows a sector of at most 180 degrees to what is between two other borders, p and q; false for
/// nothing.
static bool slrt_narrow_to(const slrt_search *s, const slrt_arm *p, const slrt_arm *q,
                           uint32_t right, uint32_t left, slrt_sector *sector) {
    const slrt_arm a = slrt_border(s, sector->right), b = slrt_border(s, sector->left);
    const int a_p = slrt_side(&a, p), a_q = slrt_side(&a, q);
    const int p_b = slrt_side(p, &b), q_b = slrt_side(q, &b);
    const bool right_within = slrt_within(p, &a, &b, a_p, p_b);
    if (!right_within && !slrt_within(&a, p, q, -a_p, a_q)) return false;
    if (slrt_within(q, &a, &b, a_q, q_b)) {
        if (q_b || !slrt_same_way(q, &b)) sector->along &= ~(unsigned)SLRT_ALONG_LEFT;
        sector->left = left;
    }
    if (right_within) {
        if (a_p || !slrt_same_way(&a, p)) sector->along &= ~(unsigned)SLRT_ALONG_RIGHT;
        sector->right = right;
    }
    return true;
}

/// Narrows a sector to a piece of a mirror, with its ends as the last two arms. False for nothing.
static bool slrt_narrow_to_mirror(slrt_search *s, const slrt_piece *piece, slrt_sector *sector) {
    const slrt_arm right = slrt_make_arm(s->x, s->y, piece->a[0], piece->a[1]);
    const slrt_arm left = slrt_make_arm(s->x, s->y, piece->b[0], piece->b[1]);
    const uint32_t to_right = SLRT_ARM + SLRT_MIRROR_ARM, to_left = to_right + 1;
    const int facing = slrt_side(&right, &left);
    slrt_arm *p = &s->cone[SLRT_MIRROR_ARM], *q = p + 1, u, v;
    *p = slrt_is_zero(&right) ? slrt_make_arm(left.to_x, left.to_y, s->x, s->y) : right;
    *q = slrt_is_zero(&left) ? slrt_make_arm(right.to_x, right.to_y, s->x, s->y) : left;
    if (facing < 0) return false;
    if (sector->right == SLRT_ALL_ROUND) {
        sector->right = to_right;
        sector->left = to_left;
    } else if (!slrt_narrow_to(s, p, q, to_right, to_left, sector)) {
        return false;
    }
    if (facing ? sector->along == SLRT_ALONG && slrt_is_ray(s, sector)
               : !slrt_run_along(s, &right, &left, sector))
        return false;
    if (!(s->range > 0)) return true;
    u = slrt_border(s, sector->right);
    v = slrt_border(s, sector->left);
    return slrt_is_part_in_range(s, &right, &left, sector->right == to_right ? NULL : &u,
                                 sector->left == to_left ? NULL : &v);
}

/// Marks for an eye on a mirror, which is its own image, the cells that it stands in.
static void slrt_mark_own_of_image(const slrt_reflected *from, slrt_search *image) {
    const slrt_search *first = from->first;
    uint32_t i;
    // One alone is not marked, and the path may have run over its number.
    if (first->own_count < 2 || image->x != first->x || image->y != first->y) return;
    for (i = 0; i < first->own_count; i++) {
        const uint32_t own = slrt_own_cells(first)[i];
        image->marks[own] = first->marks[own] & SLRT_OWN;
    }
}

/// Looks from the eye's image, through a piece of a mirror, into the cell before it.
static void slrt_look_in_mirror(slrt_reflected *from, uint32_t cell, uint32_t mirror,
                                const slrt_sector *seen) {
    const sl_runtime *rt = from->s.rt;
    const slrt_arm u = slrt_border(&from->s, seen->right), v = slrt_border(&from->s, seen->left);
    const double eye[2] = {from->s.x, from->s.y};
    uint64_t *patience = slrt_mirrors_patience(from);
    double m[6], image[2], border[4];
    bool rounded = false;
    slrt_sector sector;
    slrt_reflected to;
    slrt_reflection(rt->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES, m);
    slrt_reflect_place(m, eye, image, &rounded);
    if (rounded || *patience <= rt->cell_count / 16 ||
        (from->s.is_image && image[0] == eye[0] && image[1] == eye[1])) {
        *from->rounded = true;
        return;
    }
    to = *from;
    to.mirror = mirror;
    to.depth--;
    to.s.x = image[0], to.s.y = image[1];
    to.s.is_image = true;
    to.s.has_row = false;
    to.s.depth = to.s.room = 0;
    to.s.patience = *patience - rt->cell_count / 16;
    to.s.path += sl_runtime_scratch_count(rt);
    to.s.sectors = to.s.path + 4 * (size_t)rt->cell_count;
    to.s.marks = (unsigned char *)(to.s.path + 6 * (size_t)rt->cell_count);
    memset(to.s.marks, 0, rt->cell_count);
    slrt_mark_own_of_image(from, &to.s);
    slrt_reflect_border(m, &v, border);
    to.s.cone[0] = slrt_arm_of(border);
    slrt_reflect_border(m, &u, border);
    to.s.cone[1] = slrt_arm_of(border);
    sector.right = SLRT_ARM;
    sector.left = SLRT_ARM + 1;
    sector.along = (seen->along & SLRT_ALONG_RIGHT ? (unsigned)SLRT_ALONG_LEFT : 0u) |
                   (seen->along & SLRT_ALONG_LEFT ? (unsigned)SLRT_ALONG_RIGHT : 0u);
    sector.limited = seen->limited;
    slrt_search_from(&to.s, cell, &sector);
    *patience = to.s.patience;
    if (to.s.gave_up) *from->rounded = true;
}

/// Looks into a mirror from a cell, through a sector.
static void slrt_see_in(slrt_reflected *r, uint32_t cell, uint32_t mirror,
                        const slrt_sector *sector) {
    const sl_runtime_cell c = sl_runtime_get_cell(r->s.rt, cell);
    uint32_t i;
    for (i = 0; i < c.vertex_count; i++) {
        slrt_piece piece;
        slrt_sector part = *sector;
        slrt_read_vertex(r->s.rt, &c, i, piece.a);
        slrt_read_vertex(r->s.rt, &c, slrt_next_corner(&c, i), piece.b);
        if (slrt_cut_to_mirror(r->s.rt, cell,
                               r->s.rt->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES,
                               &piece) &&
            slrt_narrow_to_mirror(&r->s, &piece, &part))
            slrt_look_in_mirror(r, cell, mirror, &part);
    }
}

/// Notes a cell that is entered, and looks into its mirrors.
static void slrt_meet_mirrors(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    slrt_reflected *r = (slrt_reflected *)s;
    const sl_runtime *rt = s->rt;
    const sl_runtime_cell c = sl_runtime_get_cell(rt, cell);
    double low[2], high[2], at[2];
    uint64_t *patience = slrt_mirrors_patience(r);
    uint32_t i;
    int k;
    if (s->is_image) r->by_mirror[cell] = 1;
    if (!r->depth) return;
    slrt_read_vertex(rt, &c, 0, low);
    memcpy(high, low, sizeof high);
    for (i = 1; i < c.vertex_count; i++) {
        slrt_read_vertex(rt, &c, i, at);
        for (k = 0; k < 2; k++) {
            if (at[k] < low[k]) low[k] = at[k];
            if (at[k] > high[k]) high[k] = at[k];
        }
    }
    for (i = 0; i < rt->mirror_count && *patience; i++) {
        --*patience;
        // Behind a mirror its own side is behind the line of sight, but for rounding.
        if (i != r->mirror &&
            slrt_is_near_cell(rt->mirror_lines + (size_t)i * SLRT_MIRROR_BYTES, low, high))
            slrt_see_in(r, cell, i, sector);
    }
    if (i < rt->mirror_count) *r->rounded = true;
}

SL_RUNTIME_API size_t sl_runtime_mirrored_scratch_count(const sl_runtime *runtime, uint32_t depth) {
    const size_t most = SLRT_MOST_REFLECTIONS;
    return sl_runtime_scratch_count(runtime) * (1 + (depth < most ? depth : most)) +
           ((size_t)runtime->cell_count + 3) / 4;
}

SL_RUNTIME_API uint32_t sl_runtime_look_into_mirrors(const sl_runtime *runtime,
                                                     const sl_runtime_view *view,
                                                     const unsigned char *shut, double range,
                                                     uint32_t depth, uint32_t *mirrored_scratch,
                                                     uint32_t *cells, uint32_t room,
                                                     uint32_t *direct, bool *rounded) {
    slrt_reflected r;
    uint32_t i;
    *direct = 0;
    *rounded = false;
    memset(&r, 0, sizeof r);
    if (!slrt_start_search(&r.s, runtime, view, shut, range, mirrored_scratch)) return 0;
    r.first = &r.s;
    r.rounded = rounded;
    r.depth = depth;
    if (r.depth > SLRT_MOST_REFLECTIONS) r.depth = SLRT_MOST_REFLECTIONS;
    r.mirror = SLRT_NONE;
    r.patience = (uint64_t)SLRT_PATIENCE * 16 *
                 ((uint64_t)runtime->directed_count + runtime->vertex_count + 16);
    r.s.cells = cells;
    r.s.room = room;
    r.s.in_mirrors = runtime->mirror_count && r.depth;
    r.by_mirror = (unsigned char *)(mirrored_scratch +
                                    sl_runtime_scratch_count(runtime) * (1 + (size_t)r.depth));
    memset(r.by_mirror, 0, runtime->cell_count);
    if (r.s.in_mirrors) r.s.meet = slrt_meet_mirrors;
    slrt_run_search(&r.s);
    *direct = r.s.count;
    if (runtime->mirrors && depth && (!runtime->mirror_count || runtime->loose || r.s.gave_up))
        *rounded = true;
    for (i = 0; r.s.in_mirrors && i < runtime->cell_count; i++)
        if (r.by_mirror[i]) slrt_see(&r.s, i);
    if (*rounded) slrt_see_mirrored(&r.s);
    return r.s.count;
}
