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

/// So many cells of a step are gone through.
enum { SLRT_STEP_CELLS = 32 };

typedef enum slrt_way { SLRT_WAY_CLEAR, SLRT_WAY_STOPPED, SLRT_WAY_UNKNOWN } slrt_way;

/// Whether a step touches a wall. All cells that it touches are found through portals that it
/// touches, up to its first wall: the cells about a point are joined by portals that end there, but
/// for walls that do. Unknown on the map's border, which may be wall in part, and for many cells.
static slrt_way slrt_way_of(const sl_runtime *rt, const double *from, const double *to,
                            uint32_t start) {
    uint32_t cells[SLRT_STEP_CELLS], count = 1, i, k;
    slrt_polygon p;
    if (rt->loose) return SLRT_WAY_UNKNOWN;
    memset(&p, 0, sizeof p);
    p.s.rt = rt;
    p.s.patience = (uint64_t)16 * ((uint64_t)rt->directed_count + rt->vertex_count + 16);
    cells[0] = start;
    for (i = 0; i < count; i++) {
        slrt_walk w;
        slrt_piece piece;
        slrt_walk_around(&p, &w, cells[i], 1);
        while (slrt_walk_next(&p, &w, &piece)) {
            uint32_t next;
            if (!slrt_meets(from, to, piece.a, piece.b)) continue;
            if (piece.directed == SLRT_NONE)
                return slrt_is_on_border(rt, &piece) ? SLRT_WAY_UNKNOWN : SLRT_WAY_STOPPED;
            next = slrt_u32(rt->directed + (size_t)piece.directed * SLRT_DIRECTED_BYTES + 4);
            for (k = 0; k < count && cells[k] != next; k++) {
            }
            if (k < count) continue;
            if (count == SLRT_STEP_CELLS) return SLRT_WAY_UNKNOWN;
            cells[count++] = next;
        }
    }
    return p.broken ? SLRT_WAY_UNKNOWN : SLRT_WAY_CLEAR;
}

static bool slrt_touches_wall(const sl_runtime *rt, const double *from, const double *to,
                              uint32_t start) {
    const slrt_way way = slrt_way_of(rt, from, to, start);
    uint32_t i;
    if (way != SLRT_WAY_UNKNOWN) return way == SLRT_WAY_STOPPED;
    for (i = 0; i < rt->wall_count; i++)
        if (slrt_touches(from, to, rt->walls + (size_t)i * 32)) return true;
    return false;
}

SL_RUNTIME_API bool sl_runtime_can_walk(const sl_runtime *runtime, double x0, double y0, double x1,
                                        double y1, const unsigned char *shut) {
    const double from[2] = {slrt_no_dust(x0), slrt_no_dust(y0)};
    const double to[2] = {slrt_no_dust(x1), slrt_no_dust(y1)};
    const uint32_t start = sl_runtime_locate(runtime, from[0], from[1]);
    const uint32_t end = sl_runtime_locate(runtime, to[0], to[1]);
    uint32_t i;
    if (!runtime->walls || start == SL_RUNTIME_NO_CELL || end == SL_RUNTIME_NO_CELL ||
        sl_runtime_is_solid(runtime, start) || slrt_touches_wall(runtime, from, to, start))
        return false;
    for (i = 0; i < runtime->seam_count; i++) {
        const unsigned char *seam = runtime->seams + (size_t)i * 40;
        const uint32_t kind = slrt_u32(seam + 32);
        if ((kind == 2 || (kind == 1 && shut && shut[slrt_u32(seam + 36)])) &&
            slrt_touches(from, to, seam))
            return false;
    }
    return true;
}
