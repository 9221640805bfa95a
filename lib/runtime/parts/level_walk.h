/// Whether a step passes no wall and no shut door.

/// Whether the segments from a to b and from c to d have a point in common.
static bool slrt_meets(const double *a, const double *b, const double *c, const double *d) {
    int i;
    for (i = 0; i < 2; i++) {
        if (a[i] < c[i] && a[i] < d[i] && b[i] < c[i] && b[i] < d[i]) return false;
        if (a[i] > c[i] && a[i] > d[i] && b[i] > c[i] && b[i] > d[i]) return false;
    }
    return slrt_turn(a, b, c) * slrt_turn(a, b, d) <= 0 &&
           slrt_turn(c, d, a) * slrt_turn(c, d, b) <= 0;
}

/// The same for a segment of the file.
static bool slrt_touches(const double *a, const double *b, const unsigned char *segment) {
    double c[2], d[2];
    int i;
    for (i = 0; i < 2; i++) {
        c[i] = slrt_f64(segment + 8 * i);
        d[i] = slrt_f64(segment + 16 + 8 * i);
    }
    return slrt_meets(a, b, c, d);
}

static bool slrt_is_on_border(const sl_runtime *rt, const slrt_piece *piece) {
    const double *a = piece->a, *b = piece->b;
    return (a[0] == b[0] && (a[0] == rt->min_x || a[0] == rt->max_x)) ||
           (a[1] == b[1] && (a[1] == rt->min_y || a[1] == rt->max_y));
}

/// So many cells of a step that touches something are gone through.
enum { SLRT_STEP_CELLS = 32 };

/// Whether a step that touches portals' ends or sides of cells is free. All cells that it touches
/// are found through portals that it touches, up to its first wall: the cells about a point are
/// joined by portals that end there, but for walls that do. SLRT_TOUCHES where that is not known:
/// on the map's border, which may be wall in part, beside walls that steps pass, and for many
/// cells.
static slrt_finding slrt_step_by_cells(const slrt_search *s, const slrt_arm *way,
                                       const double *from, const double *to) {
    uint32_t cells[SLRT_STEP_CELLS], count = 1, i, k;
    slrt_polygon p;
    if (s->rt->loose) return SLRT_TOUCHES;
    memset(&p, 0, sizeof p);
    p.s = *s;
    p.s.patience = (uint64_t)16 * ((uint64_t)s->rt->directed_count + s->rt->vertex_count + 16);
    cells[0] = s->eye_cell;
    for (i = 0; i < count; i++) {
        slrt_walk w;
        slrt_piece piece;
        if (s->stops && s->stops(s, way, cells[i])) return SLRT_STOPS;
        slrt_walk_around(&p, &w, cells[i], 1);
        while (slrt_walk_next(&p, &w, &piece)) {
            uint32_t next;
            if (!slrt_meets(from, to, piece.a, piece.b)) continue;
            if (piece.directed == SLRT_NONE)
                return slrt_is_on_border(s->rt, &piece) || slrt_has_way(s->rt, cells[i])
                           ? SLRT_TOUCHES
                           : SLRT_STOPS;
            if (slrt_is_blocked(s, piece.directed)) return SLRT_STOPS;
            next = slrt_cell_across(s->rt, piece.directed);
            for (k = 0; k < count && cells[k] != next; k++) {
            }
            if (k < count) continue;
            if (count == SLRT_STEP_CELLS) return SLRT_TOUCHES;
            cells[count++] = next;
        }
    }
    return p.broken ? SLRT_TOUCHES : SLRT_ARRIVES;
}

/// Whether a step touches no wall, shut door, glass or box of all there are.
static bool slrt_step_by_walls(const slrt_search *s, const slrt_arm *way, const double *from,
                               const double *to) {
    const sl_runtime *rt = s->rt;
    uint32_t i;
    for (i = 0; i < rt->wall_count; i++)
        if (slrt_touches(from, to, rt->walls + (size_t)i * 32) && slrt_wall_stops_steps(rt, i))
            return false;
    for (i = 0; i < rt->seam_count; i++)
        if (slrt_seam_stops_steps(s, i) && slrt_touches(from, to, rt->seams + (size_t)i * 40))
            return false;
    for (i = 0; s->stops && i < rt->cell_count; i++)
        if (s->stops(s, way, i)) return false;
    return true;
}

/// Whether who stands at a search's eye can step to a point.
static bool slrt_can_step(slrt_search *s, double x, double y) {
    const double from[2] = {s->x, s->y}, to[2] = {slrt_no_dust(x), slrt_no_dust(y)};
    const slrt_arm way = slrt_make_arm(from[0], from[1], to[0], to[1]);
    slrt_finding found;
    if (!s->rt->walls || !slrt_in_bounds(s->rt, to[0], to[1])) return false;
    s->on_foot = true;
    found = slrt_follow_within(s, &way);
    if (found == SLRT_TOUCHES) found = slrt_step_by_cells(s, &way, from, to);
    if (found != SLRT_TOUCHES) return found == SLRT_ARRIVES;
    return sl_runtime_locate(s->rt, to[0], to[1]) != SL_RUNTIME_NO_CELL &&
           slrt_step_by_walls(s, &way, from, to);
}

SL_RUNTIME_API bool sl_runtime_can_walk(const sl_runtime *runtime, double x0, double y0, double x1,
                                        double y1, const unsigned char *shut) {
    slrt_search s;
    return slrt_place_eye(&s, runtime, x0, y0, shut) && slrt_can_step(&s, x1, y1);
}
