/// Boxes: what is asked.

/// Twice the distance from the eye to a box's middle, squared.
static double slrt_away(const slrt_search *s, uint32_t box) {
    const sl_runtime_box *at = &s->boxes->boxes[box];
    const double x = at->min_x + at->max_x - 2 * s->x, y = at->min_y + at->max_y - 2 * s->y;
    return x * x + y * y;
}

/// Sorts boxes, the nearest first (Shell 1959).
static void slrt_sort_by_distance(const slrt_search *s, uint32_t *boxes, uint32_t count) {
    uint32_t gap, i, k;
    for (gap = count / 2; gap; gap = gap == 2 ? 1 : (uint32_t)(gap / 2.2))
        for (i = gap; i < count; i++) {
            const uint32_t box = boxes[i];
            const double away = slrt_away(s, box);
            for (k = i; k >= gap && slrt_away(s, boxes[k - gap]) > away; k -= gap)
                boxes[k] = boxes[k - gap];
            boxes[k] = box;
        }
}

/// Whether boxes hide all of another one: the first `front` blockers, or all of them.
static bool slrt_is_hidden_by(slrt_search *s, uint32_t box, uint32_t front) {
    const uint32_t all = s->blocker_count;
    bool hidden;
    if (s->box_marks[box] != SLRT_BOX_PAST_WALLS) return false;
    s->blocker_count = front;
    hidden = slrt_is_hidden_box(s, box);
    s->blocker_count = all;
    return hidden || slrt_is_hidden_box(s, box);
}

/// Marks the boxes that others hide wholly, walls aside. Few boxes near the eye hide most of a
/// crowd. So boxes are asked the nearest first, against those that are not hidden themselves, and
/// only then against all. Blockers that are not hidden gather at the front of the list, and are
/// what is left: what hides a box wholly also hides what is behind that box.
static void slrt_hide_boxes(slrt_search *s) {
    uint32_t i, front = 0;
    slrt_sort_by_distance(s, s->blockers, s->blocker_count);
    for (i = 0; i < s->blocker_count; i++) {
        const uint32_t box = s->blockers[i];
        if (slrt_is_hidden_by(s, box, front)) {
            s->box_marks[box] = SLRT_BOX_HIDDEN;
        } else {
            s->blockers[i] = s->blockers[front];
            s->blockers[front++] = box;
        }
    }
    for (i = 0; i < s->boxes->count; i++)
        if (!s->boxes->boxes[i].blocks && slrt_is_hidden_by(s, i, front))
            s->box_marks[i] = SLRT_BOX_HIDDEN;
    s->blocker_count = front;
}

/// The first search finds the boxes that are seen past walls. If some of them block, a second one
/// asks which of these are seen past the others, and leaves out cells that are hidden.
static void slrt_look_at_boxes(slrt_search *s) {
    const sl_runtime_boxes *boxes = s->boxes;
    uint32_t i;
    for (i = 0; i < boxes->count; i++)
        if (slrt_box_holds(&boxes->boxes[i], s->x, s->y) && slrt_is_sound_box(&boxes->boxes[i]))
            s->box_marks[i] = SLRT_BOX_SEEN;
    slrt_run_search(s);
    for (i = 0; i < boxes->count && !s->gave_up; i++)
        if (s->box_marks[i] && boxes->boxes[i].blocks) s->blockers[s->blocker_count++] = i;
    if (!s->blocker_count) return;
    s->is_hidden = slrt_is_hidden_portal;
    slrt_hide_boxes(s);
    slrt_run_search(s);
}

SL_RUNTIME_API uint32_t sl_runtime_look_past_boxes(const sl_runtime_boxes *boxes,
                                                   const sl_runtime_view *view,
                                                   const unsigned char *shut, double range,
                                                   uint32_t *boxes_scratch, unsigned char *seen,
                                                   uint32_t *cells, uint32_t room) {
    slrt_search s;
    uint32_t i;
    unsigned char wanted;
    if (boxes->count) memset(seen, 0, boxes->count);
    if (!slrt_start_search(&s, boxes->runtime, view, shut, range, boxes_scratch)) return 0;
    s.cells = cells;
    s.room = room;
    s.meet = slrt_meet_boxes;
    s.boxes = boxes;
    s.box_marks = seen;
    s.blockers = boxes_scratch + sl_runtime_scratch_count(boxes->runtime);
    s.chosen = s.blockers + boxes->count;
    slrt_look_at_boxes(&s);
    wanted = s.is_hidden ? SLRT_BOX_SEEN : SLRT_BOX_SEEN | SLRT_BOX_PAST_WALLS;
    for (i = 0; i < boxes->count; i++) {
        const uint32_t own = *slrt_own_entry(boxes, i);
        seen[i] = seen[i] & wanted || own == SLRT_EVERYWHERE || (s.gave_up && own != SLRT_NO_ENTRY);
    }
    return s.count;
}

SL_RUNTIME_API uint32_t sl_runtime_boxes_seen(const sl_runtime_boxes *boxes,
                                              const sl_runtime_view *view,
                                              const unsigned char *shut, double range,
                                              uint32_t *boxes_scratch, unsigned char *seen) {
    uint32_t i, count = 0;
    sl_runtime_look_past_boxes(boxes, view, shut, range, boxes_scratch, seen, NULL, 0);
    for (i = 0; i < boxes->count; i++) count += seen[i];
    return count;
}
