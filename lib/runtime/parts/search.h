/// Eye-to-cell: the search through portals.

/// Enters a cell, unless that gives nothing new. A line passes a convex cell once. So a cell on the
/// path was seen through a wider sector, and a cell that was entered with a wider one needs no
/// second visit.
static void slrt_enter(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    uint32_t *top = s->path + 4 * (size_t)s->depth;
    unsigned char *marks = s->marks + cell;
    if (s->has_row && !(*marks & SLRT_IN_ROW)) return;
    if (*marks & SLRT_ON_PATH) return;
    if (*marks & SLRT_ENTERED && slrt_covered(s, cell, sector)) return;
    slrt_see(s, cell);
    if (s->meet) s->meet(s, cell, sector);
    *marks = (unsigned char)((*marks & ~(unsigned)(SLRT_ALONG | SLRT_LIMITED)) | SLRT_ENTERED |
                             SLRT_ON_PATH | sector->along | sector->limited);
    s->sectors[2 * (size_t)cell] = sector->right;
    s->sectors[2 * (size_t)cell + 1] = sector->left;
    top[0] = cell;
    top[1] = 0;
    top[2] = sector->right;
    top[3] = sector->left;
    s->depth++;
}

static void slrt_see_row(slrt_search *s) {
    uint32_t i;
    s->gave_up = true;
    for (i = 0; i < s->rt->cell_count; i++)
        if (!s->has_row || s->marks[i] & SLRT_IN_ROW) slrt_see(s, i);
}

/// Takes the next directed portal of the cell on top of the path. Each of the eye's cells is the
/// start of a search: none leads there.
static void slrt_search_on(slrt_search *s, uint32_t *top, uint32_t directed) {
    const uint32_t to = slrt_cell_across(s->rt, directed);
    slrt_sector sector;
    if (s->marks[to] & SLRT_OWN) return;
    sector.right = top[2];
    sector.left = top[3];
    sector.along = s->marks[top[0]] & SLRT_ALONG;
    sector.limited = 0;
    if (s->rt->has_limits) {
        const bool limited = slrt_is_limited(s->rt, directed);
        sector.limited = s->marks[top[0]] & SLRT_LIMITED;
        if (limited && sector.limited) return;
        if (limited) sector.limited = SLRT_LIMITED;
    }
    if (slrt_is_blocked(s, directed) || !slrt_narrow(s, directed, &sector)) return;
    if (s->range > 0 && !slrt_in_range(s, directed, sector.right, sector.left)) return;
    if (s->is_hidden && s->is_hidden(s, directed, &sector)) return;
    slrt_enter(s, to, &sector);
}

/// Whether a sector leads into a cell of the eye's: some of its directions enter the cell, or run
/// along its border. Either the first direction of the sector does, or the sector has the first one
/// of the cell, which is along a side at the eye.
static bool slrt_leads_into(const slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    const sl_runtime_cell c = sl_runtime_get_cell(s->rt, cell);
    const unsigned char *a = s->rt->vertices + (size_t)c.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *b = a + (size_t)(c.vertex_count - 1) * SLRT_VERTEX_BYTES;
    slrt_arm u, v, p, side;
    bool enters = true;
    uint32_t i;
    if (sector->right == SLRT_ALL_ROUND) return true;
    u = slrt_border(s, sector->right);
    v = slrt_border(s, sector->left);
    for (i = 0; i < c.vertex_count; i++, b = a, a += SLRT_VERTEX_BYTES) {
        if (slrt_side_of_line(b, a, s->x, s->y)) continue;
        p = slrt_make_arm(s->x, s->y, slrt_f64(a), slrt_f64(a + 8));
        if (slrt_within(&p, &u, &v, slrt_side(&u, &p), slrt_side(&p, &v))) return true;
        side = slrt_make_arm(slrt_f64(b), slrt_f64(b + 8), slrt_f64(a), slrt_f64(a + 8));
        if (slrt_side(&side, &u) < 0) enters = false;
    }
    return enters;
}

static void slrt_search_from(slrt_search *s, uint32_t cell, const slrt_sector *sector) {
    if (s->is_image || slrt_leads_into(s, cell, sector))
        slrt_enter(s, cell, sector);
    else if (s->in_mirrors)
        s->meet(s, cell, sector); // an eye on a mirror looks into it
    while (s->depth) {
        uint32_t *top = s->path + 4 * (size_t)(s->depth - 1);
        const sl_runtime_cell c = sl_runtime_get_cell(s->rt, top[0]);
        if (top[1] == c.directed_count) {
            s->marks[top[0]] &= (unsigned char)~SLRT_ON_PATH;
            s->depth--;
        } else if (!s->patience) {
            slrt_see_row(s);
            s->depth = 0;
        } else {
            s->patience--;
            slrt_search_on(s, top, c.first_directed + top[1]++);
        }
    }
}

static bool slrt_is_direction(const double *d) {
    const double larger = slrt_larger(d[0], d[1]);
    return d[0] == d[0] && d[1] == d[1] && larger >= 1e-150 && larger <= 1e150;
}

static slrt_arm slrt_direction(double x, double y) {
    return slrt_make_arm(0, 0, slrt_no_dust(x), slrt_no_dust(y));
}

SL_RUNTIME_API size_t sl_runtime_scratch_count(const sl_runtime *runtime) {
    return (size_t)runtime->cell_count * 6 + ((size_t)runtime->cell_count + 3) / 4;
}

/// Cuts the view cone into pieces of less than 180 degrees between the arms of `cone`. 0 for a view
/// all round; `last` is the arm where the last piece ends.
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

/// Looks within the view cone, in pieces. The part of a piece that leaves through a directed portal
/// is one sector. All round, each directed portal is such a piece.
static void slrt_search_cone(slrt_search *s, uint32_t cell) {
    uint32_t i, last = 0;
    const uint32_t pieces = slrt_cut_cone(s, &last);
    slrt_sector sector;
    sector.right = sector.left = SLRT_ALL_ROUND;
    sector.along = 0;
    sector.limited = 0;
    if (!pieces) slrt_search_from(s, cell, &sector);
    for (i = 0; i < pieces; i++) {
        sector.right = SLRT_ARM + i;
        sector.left = SLRT_ARM + (i + 1 < pieces ? i + 1 : last);
        slrt_search_from(s, cell, &sector);
    }
}

/// The smaller one of a caller's range and the map's own; 0 for no limit.
static double slrt_range(const sl_runtime *rt, double range) {
    return range > 0 && !(rt->range > 0 && rt->range < range) ? range : rt->range;
}

SL_RUNTIME_API uint32_t sl_runtime_look(const sl_runtime *runtime, const sl_runtime_view *view,
                                        uint32_t *scratch, uint32_t *cells, uint32_t room) {
    return sl_runtime_look_past(runtime, view, NULL, 0, scratch, cells, room);
}

/// Prepares a search. False if the eye sees nothing.
static bool slrt_start_search(slrt_search *s, const sl_runtime *rt, const sl_runtime_view *view,
                              const unsigned char *shut, double range, uint32_t *scratch) {
    const size_t count = rt->cell_count;
    const bool sees = slrt_place_eye(s, rt, view->x, view->y, shut);
    s->view = view;
    s->range = slrt_range(rt, range);
    s->path = scratch;
    s->sectors = scratch + 4 * count;
    s->marks = (unsigned char *)(scratch + 6 * count);
    return sees;
}

/// The cells that the eye stands in, once they are found. If there are more than one, none of these
/// is entered from another cell. So the path has room for them behind it.
static uint32_t *slrt_own_cells(const slrt_search *s) {
    return s->path + 4 * (size_t)s->rt->cell_count - s->own_count;
}

static void slrt_run_search(slrt_search *s) {
    sl_runtime_run run = sl_runtime_row(s->rt, s->eye_cell);
    uint32_t i;
    s->count = s->own_count = 0;
    s->patience = SLRT_PATIENCE * ((uint64_t)s->rt->directed_count + 16);
    memset(s->marks, 0, s->rt->cell_count);
    s->has_marks = true;
    s->has_row = run.next != run.stop;
    while (sl_runtime_next(&run)) memset(s->marks + run.first, SLRT_IN_ROW, run.end - run.first);
    slrt_follow(s, NULL);
    if (s->has_row && s->rt->has_glass) slrt_allow_rows_in_line(s);
    for (i = s->own_count; i-- > 0;) slrt_own_cells(s)[i] = s->path[i]; // upwards: from the last on
    slrt_search_cone(s, s->eye_cell);
    for (i = 1; i < s->own_count; i++) slrt_search_cone(s, slrt_own_cells(s)[i]);
}

SL_RUNTIME_API uint32_t sl_runtime_look_past(const sl_runtime *runtime, const sl_runtime_view *view,
                                             const unsigned char *shut, double range,
                                             uint32_t *scratch, uint32_t *cells, uint32_t room) {
    slrt_search s;
    if (!slrt_start_search(&s, runtime, view, shut, range, scratch)) return 0;
    s.cells = cells;
    s.room = room;
    slrt_run_search(&s);
    return s.count;
}

/// Adds to a search that has run what is seen by mirror from somewhere in a cell.
static void slrt_see_mirrored_from(slrt_search *s, const sl_runtime *rows, uint32_t cell) {
    sl_runtime_run run = sl_runtime_row(rows, cell);
    slrt_door_pairs pairs = slrt_door_pairs_of(rows, cell);
    uint32_t i;
    while (sl_runtime_next(&run))
        for (i = run.first; i < run.end; i++)
            if (!s->shut || slrt_pair_is_open(&pairs, i, s->shut)) slrt_see(s, i);
}

/// Adds to a search that has run what the eye may see by mirror.
static void slrt_see_mirrored(slrt_search *s) {
    const sl_runtime rows = slrt_mirrored(s->rt);
    uint32_t i;
    if (s->rt->mirrors == SL_RUNTIME_MIRRORS_BAKED && s->has_row) {
        slrt_see_mirrored_from(s, &rows, s->eye_cell);
        for (i = 1; i < s->own_count; i++) slrt_see_mirrored_from(s, &rows, slrt_own_cells(s)[i]);
        return;
    }
    for (i = 0; i < s->rt->cell_count; i++)
        if (!sl_runtime_is_solid(s->rt, i)) slrt_see(s, i);
}

SL_RUNTIME_API uint32_t sl_runtime_look_mirrored(const sl_runtime *runtime,
                                                 const sl_runtime_view *view,
                                                 const unsigned char *shut, double range,
                                                 uint32_t *scratch, uint32_t *cells, uint32_t room,
                                                 uint32_t *direct) {
    slrt_search s;
    *direct = 0;
    if (!slrt_start_search(&s, runtime, view, shut, range, scratch)) return 0;
    s.cells = cells;
    s.room = room;
    slrt_run_search(&s);
    *direct = s.count;
    if (runtime->mirrors) slrt_see_mirrored(&s);
    return s.count;
}
