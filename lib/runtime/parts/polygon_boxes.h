/// The visible polygon past boxes.

// The polygon is made without boxes, and the boxes of the cells that it comes to are gathered. If
// some of these block, it is made again: each piece of a wall is compared with the envelope of
// their sides (box_envelope.h, box_sieve.h).
//
//         \   |          Sides of boxes that go through the eye hide nothing, but they part what is
//      .---*--+  the     around it, as walls there do. The eye sees the part that begins with its
//      |  / box  eye     own cell. What lies beside that part is hidden: arcs at no distance at
//      all.

SL_RUNTIME_API size_t sl_runtime_boxes_scratch_count(const sl_runtime_boxes *boxes) {
    return sl_runtime_scratch_count(boxes->runtime) + 2 * (size_t)boxes->count +
           SLRT_ARC_WORDS * slrt_arcs_room(boxes->count);
}

static slrt_point slrt_cross_side(slrt_point a, slrt_point b, const slrt_box_side *side) {
    const int axis = side->axis;
    const double from = axis ? a.y : a.x, to = axis ? b.y : b.x;
    const double share = (side->at - from) / (to - from);
    slrt_point cross;
    cross.x = axis ? slrt_limited(a.x, a.x + share * (b.x - a.x), b.x) : side->at;
    cross.y = axis ? side->at : slrt_limited(a.y, a.y + share * (b.y - a.y), b.y);
    return cross;
}

static void slrt_place_bound(const slrt_polygon *p, const slrt_part_end *at,
                             const slrt_piece *piece, double *out) {
    if (at->on) {
        out[0] = at->ray.to_x;
        out[1] = at->ray.to_y;
    } else {
        slrt_meet_line(p, &at->ray, piece, out);
    }
}

static void slrt_see_part(const slrt_sieve *s, uint32_t number, const slrt_box_side *side,
                          const slrt_part_end *from, const slrt_part_end *to) {
    slrt_polygon *p = s->sight;
    const slrt_point a = side ? side->a : s->a, b = side ? side->b : s->b;
    slrt_piece piece;
    double end[2];
    if (!side && number != SLRT_NO_SIDE) {
        slrt_add_eye(p);
        return;
    }
    piece.a[0] = a.x, piece.a[1] = a.y;
    piece.b[0] = b.x, piece.b[1] = b.y;
    piece.directed = SLRT_NONE;
    if (!slrt_joins(p, &piece)) {
        slrt_place_bound(p, from, &piece, end);
        slrt_start_piece(p, &piece, end);
    }
    slrt_place_bound(p, to, &piece, end);
    slrt_extend_piece(p, &piece, SLRT_NONE, end);
}

/// What is done with the boxes of a polygon.
typedef struct slrt_past_boxes {
    const sl_runtime_boxes *boxes;
    uint32_t *blockers, count; ///< boxes that block in the cells that are seen
    uint32_t *marks;           ///< by box: whether it is one
    slrt_envelope_maker maker;
} slrt_past_boxes;

static void slrt_gather_boxes(slrt_polygon *p, uint32_t cell) {
    slrt_past_boxes *past = (slrt_past_boxes *)p->job;
    uint32_t at = *slrt_first_entry(past->boxes, cell);
    while (at != SLRT_NO_ENTRY) {
        const uint32_t *entry = slrt_entry(past->boxes, at);
        const uint32_t box = entry[SLRT_ENTRY_BOX];
        if (past->boxes->boxes[box].blocks && !past->marks[box]) {
            past->marks[box] = 1;
            past->blockers[past->count++] = box;
        }
        at = entry[SLRT_ENTRY_IN_CELL];
    }
}

static void slrt_see_past_boxes(slrt_polygon *p, uint32_t cell, const slrt_piece *piece,
                                uint32_t right, uint32_t left) {
    const slrt_past_boxes *past = (const slrt_past_boxes *)p->job;
    slrt_sieve s;
    (void)cell;
    s.envelope = &past->maker.e;
    s.sight = p;
    s.a.x = piece->a[0], s.a.y = piece->a[1];
    s.b.x = piece->b[0], s.b.y = piece->b[1];
    s.start = slrt_bound_at(&s, s.a, right == SLRT_NONE);
    s.stop = slrt_bound_at(&s, s.b, left == SLRT_NONE);
    if (right != SLRT_NONE) s.start.ray = slrt_border(&p->s, right);
    if (left != SLRT_NONE) s.stop.ray = slrt_border(&p->s, left);
    slrt_sieve_piece(&s);
}

// Where sides of boxes go through the eye.

/// A point straight along an axis from the eye: 0 right, 1 above, 2 left, 3 under.
static slrt_point slrt_axis_point(const slrt_polygon *p, int quarter) {
    const sl_runtime *rt = p->s.rt;
    slrt_point at = slrt_eye_at(&p->s);
    const double x = slrt_larger(at.x, rt->max_x - rt->min_x);
    const double y = slrt_larger(at.y, rt->max_y - rt->min_y);
    at.x += quarter == 0 ? x : quarter == 2 ? -x : 0;
    at.y += quarter == 1 ? y : quarter == 3 ? -y : 0;
    return at;
}

/// The directions, as bits of quarters, in which sides of a box leave the eye.
static unsigned slrt_sides_at_eye(const slrt_polygon *p, const sl_runtime_box *box) {
    const double x = p->s.x, y = p->s.y;
    unsigned found = 0;
    if (!slrt_box_holds(box, x, y)) return 0;
    if (y == box->min_y || y == box->max_y) {
        if (x < box->max_x) found |= 1;
        if (x > box->min_x) found |= 4;
    }
    if (x == box->min_x || x == box->max_x) {
        if (y < box->max_y) found |= 2;
        if (y > box->min_y) found |= 8;
    }
    return found;
}

/// Whether a ray is in the sector from u to v, of at most 180 degrees, but not on v.
static bool slrt_begins_in(const slrt_arm *u, const slrt_arm *v, const slrt_arm *ray) {
    return (slrt_side(u, ray) > 0 && slrt_side(ray, v) > 0) || slrt_same_ray(u, ray);
}

/// Where, counter-clockwise, the quadrant begins that counts for an eye on the border of a box: the
/// part of it that the eye's cell is in. It is the one right of the eye and over it, if the cell
/// reaches into that, else the next one in the order of sl_runtime_locate.
static slrt_point slrt_find_quadrant(slrt_polygon *p, int toward[2]) {
    const slrt_touch touch = slrt_touch_of(p, p->s.eye_cell);
    const slrt_arm u = slrt_arm_to(p, touch.behind_end), v = slrt_arm_to(p, touch.before_end);
    slrt_point at = slrt_axis_point(p, 0);
    int i;
    for (i = 0; i < 4; i++) {
        const int quarter = i == 2 ? 3 : i == 3 ? 2 : i;
        const slrt_point from = slrt_axis_point(p, quarter);
        const slrt_arm a = slrt_ray_to(&p->s, from);
        const slrt_arm b = slrt_ray_to(&p->s, slrt_axis_point(p, (quarter + 1) % 4));
        toward[0] = i & 1 ? -1 : 1;
        toward[1] = i & 2 ? -1 : 1;
        if (!touch.any || slrt_begins_in(&u, &v, &a)) return from;
        at.x = touch.behind_end[0], at.y = touch.behind_end[1];
        if (slrt_begins_in(&a, &b, &u)) return at;
    }
    return at;
}

/// Whether the ray through p comes before the one through q, counter-clockwise from behind `base`
/// once around to it.
static bool slrt_comes_before(const slrt_eye *eye, slrt_point base, slrt_point p, slrt_point q) {
    const slrt_arm b = slrt_ray_to(eye, base), u = slrt_ray_to(eye, p), v = slrt_ray_to(eye, q);
    const int b_u = slrt_side(&b, &u), b_v = slrt_side(&b, &v);
    const int lap_u = b_u > 0 ? 0 : b_u < 0 ? 2 : slrt_same_way(&b, &u) ? 3 : 1;
    const int lap_v = b_v > 0 ? 0 : b_v < 0 ? 2 : slrt_same_way(&b, &v) ? 3 : 1;
    return lap_u != lap_v ? lap_u < lap_v : slrt_side(&u, &v) > 0;
}

/// Hides all directions from one to another one, in parts that end at the axes.
static void slrt_hide_from_eye(slrt_polygon *p, slrt_envelope_maker *m, slrt_point from,
                               slrt_point to) {
    uint32_t i;
    for (i = 0; i < 5; i++) {
        const slrt_arm u = slrt_ray_to(&p->s, from), v = slrt_ray_to(&p->s, to);
        const int x = slrt_ray_sign(&p->s, &u, 0), y = slrt_ray_sign(&p->s, &u, 1);
        const int next = x > 0 && y >= 0 ? 1 : x <= 0 && y > 0 ? 2 : x < 0 ? 3 : 0;
        const slrt_point axis = slrt_axis_point(p, next);
        const bool ends = slrt_side(&u, &v) > 0 && slrt_point_turn(&p->s, to, axis) >= 0;
        slrt_push_run(m, SLRT_AT_EYE + i, from, ends ? to : axis);
        if (m->run_count > 1) slrt_merge_last(m);
        if (ends) return;
        from = axis;
    }
}

/// Hides what the eye does not see as sides of boxes, perhaps with walls, part what is around it.
/// One side alone, or a wall in its direction, is seen edge-on.
static void slrt_part_at_eye(slrt_polygon *p, slrt_past_boxes *past) {
    slrt_point rays[6], base, first, last;
    unsigned sides = 0;
    uint32_t i, count = 0;
    for (i = 0; i < past->count; i++)
        sides |= slrt_sides_at_eye(p, &past->boxes->boxes[past->blockers[i]]);
    if (!sides) return;
    for (i = 0; i < 4; i++)
        if (sides >> i & 1) rays[count++] = slrt_axis_point(p, (int)i);
    if (!p->fan_is_closed) {
        rays[count].x = p->fan_right[0], rays[count++].y = p->fan_right[1];
        rays[count].x = p->fan_left[0], rays[count++].y = p->fan_left[1];
    }
    base = slrt_find_quadrant(p, past->maker.toward);
    first = last = rays[0];
    for (i = 1; i < count; i++) {
        if (slrt_comes_before(&p->s, base, rays[i], first)) first = rays[i];
        if (slrt_comes_before(&p->s, base, last, rays[i])) last = rays[i];
    }
    if (slrt_comes_before(&p->s, base, first, last))
        slrt_hide_from_eye(p, &past->maker, first, last);
}

/// Makes the envelope of the boxes gathered. False if nothing of them hides anything.
static bool slrt_make_envelope(slrt_polygon *p, slrt_past_boxes *past, uint32_t *memory) {
    uint32_t i;
    slrt_start_envelope(&past->maker, &p->s, past->boxes->boxes, memory,
                        slrt_arcs_room(past->boxes->count));
    slrt_part_at_eye(p, past);
    for (i = 0; i < past->count; i++) slrt_add_box(&past->maker, past->blockers[i]);
    slrt_finish_envelope(&past->maker);
    p->broken = p->broken || past->maker.is_full;
    return past->maker.e.count != 0;
}

SL_RUNTIME_API uint32_t sl_runtime_visible_polygon_past_boxes(const sl_runtime_boxes *boxes,
                                                              const sl_runtime_view *view,
                                                              const unsigned char *shut,
                                                              double range, uint32_t *boxes_scratch,
                                                              double *points, uint32_t room) {
    const sl_runtime *rt = boxes->runtime;
    slrt_past_boxes past;
    slrt_polygon p;
    uint32_t count;
    past.boxes = boxes;
    past.blockers = boxes_scratch + sl_runtime_scratch_count(rt);
    past.marks = past.blockers + boxes->count;
    past.count = 0;
    if (boxes->count) memset(past.marks, 0, boxes->count * sizeof *past.marks);
    if (!slrt_start_polygon(&p, rt, view, shut, range, boxes_scratch, points, room)) return 0;
    p.meet = slrt_gather_boxes;
    p.job = &past;
    slrt_find_fan(&p);
    count = slrt_see_polygon(&p);
    if (!count || !past.count) return count;
    slrt_start_polygon(&p, rt, view, shut, range, boxes_scratch, points, room);
    slrt_find_fan(&p);
    if (!slrt_make_envelope(&p, &past, past.marks + boxes->count)) return count;
    p.see_wall = slrt_see_past_boxes;
    p.job = &past;
    return slrt_see_polygon(&p);
}
