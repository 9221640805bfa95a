/// The visible polygon, and what is seen in mirrors.

// The map stays where it is and the eye is reflected. What the eye sees in a mirror is what its
// image sees straight through the mirror, into the cell before it:
//
//       \    eye    /
//        \         /         The image lies behind the mirror. It looks between two borders, those
//     ===[ mirror ]===       of the piece of the mirror that is seen: a sector, as in polygon.h,
//          \     /           about another eye.
//           image
//
// A border is a direction. An axial mirror changes the sign of its x or its y, which is exact. So
// all signs are right as long as the image is one of doubles. The list of parts is also what waits:
// each part adds those that are seen in it to the end. Cost: a polygon for each part, and for each
// wall seen all mirrors.

typedef struct slrt_mirrors_job {
    sl_runtime_mirror_part *parts;
    uint32_t room, count; ///< of parts, those that wait included
    uint32_t missed;      ///< parts for which there is no room
    uint32_t depth;       ///< the most
    uint32_t here;        ///< the part that is made
    bool added;           ///< some part is added that is seen in that one,
    slrt_arm last;        ///< and the last of these ends there
} slrt_mirrors_job;

static slrt_arm slrt_arm_of(const double *border) {
    return slrt_make_arm(border[2], border[3], border[0], border[1]);
}

/// Whether a piece of a cell's boundary is on the line of a mirror. A side on an oblique wall may
/// be rounded, so the wall is asked.
static bool slrt_is_on_line(const sl_runtime *rt, uint32_t cell, const slrt_piece *piece,
                            const double *from, const double *to) {
    const sl_runtime_cell c = sl_runtime_get_cell(rt, cell);
    double a[2], b[2];
    uint32_t i, wall;
    memcpy(a, piece->a, sizeof a);
    memcpy(b, piece->b, sizeof b);
    for (i = 0; rt->neighbours && rt->walls && i < c.vertex_count; i++) {
        const unsigned char *end;
        slrt_read_vertex(rt, &c, slrt_next_corner(&c, i), b);
        if (!slrt_same_place(b, piece->b)) continue;
        wall = slrt_u32(rt->neighbours + ((size_t)c.first_vertex + i) * 4) & 0x7fffffffu;
        if (wall >= rt->wall_count) return false;
        end = rt->walls + (size_t)wall * 32;
        a[0] = slrt_f64(end), a[1] = slrt_f64(end + 8);
        b[0] = slrt_f64(end + 16), b[1] = slrt_f64(end + 24);
        break;
    }
    return !slrt_turn(a, b, from) && !slrt_turn(a, b, to);
}

/// A number that grows from a to b.
static double slrt_along(const slrt_piece *piece, const double *at) {
    const double x = piece->b[0] - piece->a[0], y = piece->b[1] - piece->a[1];
    if ((x < 0 ? -x : x) >= (y < 0 ? -y : y)) return x > 0 ? at[0] : -at[0];
    return y > 0 ? at[1] : -at[1];
}

/// Cuts a piece of a cell's boundary to a mirror's ends. False if nothing of it reflects.
static bool slrt_cut_to_mirror(const sl_runtime *rt, uint32_t cell, const unsigned char *mirror,
                               slrt_piece *piece) {
    double ends[2][2];
    bool turned;
    ends[0][0] = slrt_f64(mirror), ends[0][1] = slrt_f64(mirror + 8);
    ends[1][0] = slrt_f64(mirror + 16), ends[1][1] = slrt_f64(mirror + 24);
    turned = slrt_along(piece, ends[0]) > slrt_along(piece, ends[1]);
    if ((turned && slrt_u64(mirror + 32)) || !slrt_is_on_line(rt, cell, piece, ends[0], ends[1]) ||
        slrt_along(piece, ends[!turned]) <= slrt_along(piece, piece->a) ||
        slrt_along(piece, ends[turned]) >= slrt_along(piece, piece->b))
        return false;
    if (slrt_along(piece, ends[turned]) > slrt_along(piece, piece->a))
        memcpy(piece->a, ends[turned], sizeof piece->a);
    if (slrt_along(piece, ends[!turned]) < slrt_along(piece, piece->b))
        memcpy(piece->b, ends[!turned], sizeof piece->b);
    return true;
}

/// Reflects directions and places in a mirror's line: (x, y) becomes
/// (m[0] x + m[1] y + m[2], m[3] x + m[4] y + m[5]).
static void slrt_reflection(const unsigned char *mirror, double *m) {
    const double x = slrt_f64(mirror), y = slrt_f64(mirror + 8);
    double u[2];
    u[0] = slrt_f64(mirror + 16) - x;
    u[1] = slrt_f64(mirror + 24) - y;
    if (u[0] != 0 && u[1] != 0) slrt_make_unit(u);
    m[0] = u[0] == 0 ? -1 : u[1] == 0 ? 1 : u[0] * u[0] - u[1] * u[1];
    m[4] = -m[0];
    m[1] = m[3] = u[0] != 0 && u[1] != 0 ? 2 * u[0] * u[1] : 0;
    m[2] = m[1] == 0 ? (u[0] == 0 ? 2 * x : 0) : x - m[0] * x - m[1] * y;
    m[5] = m[1] == 0 ? (u[1] == 0 ? 2 * y : 0) : y - m[3] * x - m[4] * y;
}

/// a + b; *rounded is set if that is not exact (Knuth's two-sum).
static double slrt_sum(double a, double b, bool *rounded) {
    const double sum = a + b, added = sum - a;
    if ((a - (sum - added)) + (b - added) != 0) *rounded = true;
    return sum;
}

static void slrt_reflect_place(const double *m, const double *at, double *out, bool *rounded) {
    const double x = at[0], y = at[1];
    if (m[1] != 0) *rounded = true;
    out[0] = m[1] == 0 ? slrt_sum(m[0] * x, m[2], rounded) : m[0] * x + m[1] * y + m[2];
    out[1] = m[1] == 0 ? slrt_sum(m[4] * y, m[5], rounded) : m[3] * x + m[4] * y + m[5];
}

static void slrt_reflect_border(const double *m, const slrt_arm *arm, double *border) {
    if (m[1] == 0) {
        border[0] = m[0] * arm->to_x, border[1] = m[4] * arm->to_y;
        border[2] = m[0] * arm->from_x, border[3] = m[4] * arm->from_y;
    } else {
        border[0] = m[0] * arm->x + m[1] * arm->y;
        border[1] = m[3] * arm->x + m[4] * arm->y;
        border[2] = border[3] = 0;
    }
}

/// The frame in which the map appears behind one more mirror.
static void slrt_reflect_frame(const double *f, const double *m, double *out) {
    int i;
    for (i = 0; i < 6; i += 3) {
        out[i] = f[i] * m[0] + f[i + 1] * m[3];
        out[i + 1] = f[i] * m[1] + f[i + 1] * m[4];
        out[i + 2] = f[i] * m[2] + f[i + 1] * m[5] + f[i + 2];
    }
}

/// Limits a piece of a mirror to what is within range. False if that is nothing.
static bool slrt_limit_to_range(const slrt_polygon *p, slrt_piece *piece) {
    const slrt_chord c = slrt_chord_of(p, piece->a, piece->b);
    double a[2], b[2], unit[2];
    if (!(p->s.range > 0) || (c.a_inside && c.b_inside)) return true;
    if (!c.a_inside && !c.b_inside && !(c.enter < c.leave && c.enter < 1 && c.leave > 0))
        return false;
    memcpy(a, piece->a, sizeof a);
    memcpy(b, piece->b, sizeof b);
    if (!c.a_inside) slrt_cross_circle(p, &c, c.enter, a, b, piece->a, unit);
    if (!c.b_inside) slrt_cross_circle(p, &c, c.leave, a, b, piece->b, unit);
    return !slrt_same_place(piece->a, piece->b);
}

/// Adds the part that is seen in a piece of a mirror, from the border `right` to `left` or, for
/// SLRT_NONE, its ends.
static void slrt_add_part(const slrt_polygon *p, uint32_t cell, uint32_t mirror,
                          const slrt_piece *piece, uint32_t right, uint32_t left) {
    slrt_mirrors_job *job = (slrt_mirrors_job *)p->job;
    const sl_runtime_mirror_part *from = &job->parts[job->here];
    slrt_arm u = slrt_arm_to(p, piece->a), v = slrt_arm_to(p, piece->b);
    const slrt_arm a = right == SLRT_NONE ? u : slrt_border(&p->s, right);
    const slrt_arm b = left == SLRT_NONE ? v : slrt_border(&p->s, left);
    double m[6];
    sl_runtime_mirror_part *to;
    if (slrt_side(&u, &a) > 0) u = a;
    if (slrt_side(&b, &v) > 0) v = b;
    if (slrt_side(&u, &v) <= 0) return;
    if (job->count == job->room) {
        job->missed++;
        return;
    }
    to = &job->parts[job->count];
    memset(to, 0, sizeof *to);
    to->joins = job->added && to[-1].mirror == mirror && slrt_same_ray(&job->last, &u);
    job->added = true;
    job->last = v;
    job->count++;
    slrt_reflection(p->s.rt->mirror_lines + (size_t)mirror * SLRT_MIRROR_BYTES, m);
    to->mirror = mirror;
    to->parent = job->here;
    to->depth = from->depth + 1;
    to->rounded = from->rounded;
    to->cell = cell;
    slrt_reflect_place(m, from->eye, to->eye, &to->rounded);
    slrt_reflect_frame(from->frame, m, to->frame);
    slrt_reflect_border(m, &v, to->right);
    slrt_reflect_border(m, &u, to->left);
    memcpy(to->at, piece->b, sizeof piece->b);
    memcpy(to->at + 2, piece->a, sizeof piece->a);
}

/// Finds the first place on a piece of a cell's boundary, from a on, that is on a mirror, up to
/// where that mirror ends or an earlier one of the map begins. False for none.
static bool slrt_next_mirror(slrt_polygon *p, uint32_t cell, const slrt_piece *piece,
                             slrt_piece *cut, uint32_t *mirror) {
    const sl_runtime *rt = p->s.rt;
    bool found = false;
    uint32_t i;
    if (p->s.patience < rt->mirror_count) p->broken = true;
    for (i = 0; i < rt->mirror_count && !p->broken; i++) {
        slrt_piece on = *piece;
        if (!slrt_cut_to_mirror(rt, cell, rt->mirror_lines + (size_t)i * SLRT_MIRROR_BYTES, &on) ||
            (found && slrt_along(piece, on.a) >= slrt_along(piece, cut->a)))
            continue;
        if (found && slrt_along(piece, cut->a) < slrt_along(piece, on.b))
            memcpy(on.b, cut->a, sizeof on.b);
        *cut = on;
        *mirror = i;
        found = true;
    }
    p->s.patience -= i;
    return found;
}

/// Adds a wall, and what is seen in the mirrors on it.
static void slrt_see_reflecting(slrt_polygon *p, uint32_t cell, const slrt_piece *piece,
                                uint32_t right, uint32_t left) {
    const slrt_mirrors_job *job = (const slrt_mirrors_job *)p->job;
    const sl_runtime_mirror_part *here = &job->parts[job->here];
    slrt_piece rest = *piece, cut;
    uint32_t mirror = 0;
    slrt_add_wall(p, piece, right, left);
    if (here->depth == job->depth || piece->directed != SLRT_NONE) return;
    while (slrt_along(piece, rest.a) < slrt_along(piece, rest.b) &&
           slrt_next_mirror(p, cell, &rest, &cut, &mirror)) {
        memcpy(rest.a, cut.b, sizeof rest.a);
        // Behind a mirror its own side is behind the line of sight, but for rounding.
        if (!(here->depth && mirror == here->mirror) && slrt_limit_to_range(p, &cut))
            slrt_add_part(p, cell, mirror, &cut, right, left);
    }
}

/// Adds the point where a border meets a piece of a mirror.
static void slrt_add_on_mirror(slrt_polygon *p, const double *border, const double *ends,
                               double *at) {
    const slrt_arm ray = slrt_arm_of(border);
    slrt_piece mirror;
    memcpy(mirror.a, ends, sizeof mirror.a);
    memcpy(mirror.b, ends + 2, sizeof mirror.b);
    slrt_meet_line(p, &ray, &mirror, at);
    slrt_add_point(p, at, true);
}

/// Makes the polygon of a part, and of those behind it in the list that join it: from the right end
/// of the mirror, which is that of the last one, counter-clockwise about the image.
static uint32_t slrt_see_in_mirror(slrt_polygon *p, const sl_runtime_mirror_part *part,
                                   const sl_runtime_mirror_part *joined, uint32_t count) {
    const sl_runtime_mirror_part *rightmost = count ? &joined[count - 1] : part;
    double at[2];
    p->s.x = part->eye[0];
    p->s.y = part->eye[1];
    p->in_sector = true;
    p->first_is_short = true;
    p->started = true; // all that faces the image is on one lap
    slrt_add_on_mirror(p, rightmost->right, rightmost->at, at);
    for (;;) {
        const sl_runtime_mirror_part *one = count ? &joined[count - 1] : part;
        const uint32_t slot = 2 * (count % 2); // the end of the last piece is not computed yet
        p->right = SLRT_ARM + slot;
        p->left = SLRT_ARM + slot + 1;
        p->s.cone[slot] = slrt_arm_of(one->right);
        p->s.cone[slot + 1] = slrt_arm_of(one->left);
        slrt_see_fan_cell(p, one->cell);
        if (!count--) break;
    }
    slrt_end_pending(p);
    slrt_add_on_mirror(p, part->left, part->at, at);
    if (p->s.range > 0) {
        slrt_end_arc(p);
        slrt_put(p, at);
    }
    return p->broken || p->count < 3 || p->written < 3 ? 0 : p->written;
}

/// Makes the polygon of the next part that waits. Returns how many of the list it took.
static uint32_t slrt_make_part(slrt_polygon *p, slrt_mirrors_job *job, uint32_t next) {
    sl_runtime_mirror_part *part = &job->parts[job->here];
    const uint32_t waiting = job->count;
    uint32_t taken = 1;
    p->job = job;
    p->see_wall = slrt_see_reflecting;
    job->added = false;
    *part = job->parts[next];
    if (next) {
        for (; next + taken < waiting && job->parts[next + taken].joins; taken++)
            part->rounded = part->rounded || job->parts[next + taken].rounded;
        part->count = slrt_see_in_mirror(p, part, &job->parts[next] + 1, taken - 1);
    } else {
        slrt_find_fan(p);
        part->count = slrt_see_polygon(p);
    }
    if (part->count)
        job->here++;
    else
        job->count = waiting; // what is not seen shows nothing
    return taken;
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon_mirrored(
    const sl_runtime *runtime, const sl_runtime_view *view, const unsigned char *shut, double range,
    uint32_t depth, uint32_t *scratch, sl_runtime_mirror_part *parts, uint32_t part_room,
    uint32_t *part_count, double *points, uint32_t room) {
    slrt_mirrors_job job;
    slrt_polygon p;
    uint32_t next, all = 0;
    *part_count = 0;
    if (!part_room || !slrt_start_polygon(&p, runtime, view, shut, range, scratch, points, room))
        return 0;
    memset(&job, 0, sizeof job);
    job.parts = parts;
    job.room = part_room;
    job.count = 1;
    job.depth = depth;
    memset(parts, 0, sizeof *parts);
    parts->eye[0] = p.s.x;
    parts->eye[1] = p.s.y;
    parts->frame[0] = parts->frame[4] = 1;
    for (next = 0; next < job.count;) {
        const uint32_t here = job.here;
        next += slrt_make_part(&p, &job, next);
        if (job.here > here) {
            parts[here].first = all;
            all += parts[here].count;
        }
        slrt_start_polygon(&p, runtime, view, shut, range, scratch,
                           all < room ? points + 2 * (size_t)all : NULL,
                           all < room ? room - all : 0);
    }
    *part_count = job.missed ? part_room + job.missed : job.here;
    return all;
}
