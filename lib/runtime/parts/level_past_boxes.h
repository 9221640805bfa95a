/// Boxes that block: points and steps past them.

// A line meets a box in a cell that both have points in, so only the lists of the cells along the
// line are asked.

static bool slrt_is_in_box(const sl_runtime_box *box, double x, double y) {
    return box->min_x < x && x < box->max_x && box->min_y < y && y < box->max_y;
}

/// Whether ranges of numbers have none in common, `touch`: or just an end.
static bool slrt_is_apart(double a, double b, double low, double high, bool touch) {
    const double least = a < b ? a : b, most = a < b ? b : a;
    return touch ? most < low || least > high : most <= low || least >= high;
}

/// Whether a line passes the inside of a box; `touch`: or touches it. The inside of a flat box is
/// what lies between its ends. A line and a box are convex: if they are apart, a side of the box or
/// the line itself separates them.
static bool slrt_passes_box(const slrt_arm *way, const sl_runtime_box *box, bool touch) {
    bool left = false, right = false;
    int k;
    if (slrt_is_apart(way->from_x, way->to_x, box->min_x, box->max_x, touch) ||
        slrt_is_apart(way->from_y, way->to_y, box->min_y, box->max_y, touch))
        return false;
    for (k = 0; k < 4; k++) {
        const slrt_arm corner =
            slrt_make_arm(way->from_x, way->from_y, k & 1 ? box->max_x : box->min_x,
                          k & 2 ? box->max_y : box->min_y);
        const int side = slrt_side(way, &corner);
        left = left || side > 0 || (touch && !side);
        right = right || side < 0 || (touch && !side);
    }
    return left && right;
}

/// Whether a box in a cell stops a line of sight, or a step.
static bool slrt_is_stopped(const slrt_search *s, const slrt_arm *way, uint32_t cell) {
    uint32_t at = *slrt_first_entry(s->boxes, cell);
    for (; at != SLRT_NO_ENTRY; at = slrt_entry(s->boxes, at)[SLRT_ENTRY_IN_CELL]) {
        const uint32_t number = slrt_entry(s->boxes, at)[SLRT_ENTRY_BOX];
        const sl_runtime_box *box = &s->boxes->boxes[number];
        if (!box->blocks || number == s->except || !slrt_passes_box(way, box, s->on_foot)) continue;
        if (s->on_foot ||
            !((slrt_is_in_box(box, s->x, s->y) && slrt_box_holds(box, way->to_x, way->to_y)) ||
              (slrt_is_in_box(box, way->to_x, way->to_y) && slrt_box_holds(box, s->x, s->y))))
            return true;
    }
    return false;
}

static void slrt_heed_boxes(slrt_search *s, const sl_runtime_boxes *boxes, uint32_t except) {
    s->boxes = boxes;
    s->except = except;
    s->stops = slrt_is_stopped;
}

SL_RUNTIME_API bool sl_runtime_sees_past_boxes(const sl_runtime_boxes *boxes, double x0, double y0,
                                               double x1, double y1, const unsigned char *shut,
                                               double range, uint32_t *boxes_scratch) {
    const sl_runtime_view view = sl_runtime_view_all_round(x0, y0);
    slrt_search s;
    if (!slrt_start_search(&s, boxes->runtime, &view, shut, range, boxes_scratch)) return false;
    slrt_heed_boxes(&s, boxes, SL_RUNTIME_NO_BOX);
    return slrt_sees_point(&s, x1, y1);
}

SL_RUNTIME_API bool sl_runtime_can_walk_past_boxes(const sl_runtime_boxes *boxes, double x0,
                                                   double y0, double x1, double y1,
                                                   const unsigned char *shut, uint32_t except) {
    slrt_search s;
    if (!slrt_place_eye(&s, boxes->runtime, x0, y0, shut)) return false;
    slrt_heed_boxes(&s, boxes, except);
    return slrt_can_step(&s, x1, y1);
}
