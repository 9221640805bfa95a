/// Boxes that move: the cells that they lie in.

// Memory: the first free entry, the first entry of each cell, the first entry of each box, and the
// entries. An entry is four numbers: a cell, a box in it, the cell's next entry, the box's next.

#define SLRT_NO_ENTRY   UINT32_MAX
#define SLRT_EVERYWHERE (UINT32_MAX - 1) ///< in place of a box's first entry: there was no room

enum { SLRT_ENTRY_CELL, SLRT_ENTRY_BOX, SLRT_ENTRY_IN_CELL, SLRT_ENTRY_OF_BOX, SLRT_ENTRY };

static uint32_t *slrt_first_entry(const sl_runtime_boxes *boxes, uint32_t cell) {
    return boxes->memory + 1 + cell;
}

static uint32_t *slrt_own_entry(const sl_runtime_boxes *boxes, uint32_t box) {
    return boxes->memory + 1 + (size_t)boxes->runtime->cell_count + box;
}

static uint32_t *slrt_entry(const sl_runtime_boxes *boxes, uint32_t entry) {
    return boxes->memory + 1 + (size_t)boxes->runtime->cell_count + boxes->count +
           (size_t)SLRT_ENTRY * entry;
}

SL_RUNTIME_API size_t sl_runtime_boxes_count(const sl_runtime *runtime, uint32_t count,
                                             uint32_t room) {
    return 1 + (size_t)runtime->cell_count + count + (size_t)SLRT_ENTRY * room;
}

SL_RUNTIME_API void sl_runtime_boxes_start(sl_runtime_boxes *out, const sl_runtime *runtime,
                                           sl_runtime_box *list, uint32_t count, uint32_t room,
                                           uint32_t *memory) {
    uint32_t i;
    if (room >= SLRT_EVERYWHERE) room = SLRT_EVERYWHERE - 1;
    out->runtime = runtime;
    out->count = count;
    out->room = room;
    out->boxes = list;
    out->memory = memory;
    memset(memory, 0xff, (1 + (size_t)runtime->cell_count + count) * sizeof *memory);
    memory[0] = room ? 0 : SLRT_NO_ENTRY;
    for (i = 0; i < room; i++)
        slrt_entry(out, i)[SLRT_ENTRY_OF_BOX] = i + 1 < room ? i + 1 : SLRT_NO_ENTRY;
    for (i = 0; i < count; i++) {
        memset(&list[i], 0, sizeof list[i]);
        list[i].min_x = list[i].min_y = 1; // it is nowhere
    }
}

/// Takes a box out of its cells.
static void slrt_take_out(sl_runtime_boxes *boxes, uint32_t box) {
    uint32_t *own = slrt_own_entry(boxes, box);
    uint32_t at = *own == SLRT_EVERYWHERE ? SLRT_NO_ENTRY : *own;
    *own = SLRT_NO_ENTRY;
    while (at != SLRT_NO_ENTRY) {
        uint32_t *entry = slrt_entry(boxes, at);
        uint32_t *link = slrt_first_entry(boxes, entry[SLRT_ENTRY_CELL]);
        const uint32_t next = entry[SLRT_ENTRY_OF_BOX];
        while (*link != at) link = &slrt_entry(boxes, *link)[SLRT_ENTRY_IN_CELL];
        *link = entry[SLRT_ENTRY_IN_CELL];
        entry[SLRT_ENTRY_OF_BOX] = boxes->memory[0];
        boxes->memory[0] = at;
        at = next;
    }
}

/// Whether a box without width or height lies along the segment from a to b: not just on an end.
static bool slrt_lies_along(const double box[4], const double *a, const double *b) {
    const int axis = box[0] == box[2] ? 0 : 1; // which coordinate is the same in all of the box
    const double low = a[!axis] < b[!axis] ? a[!axis] : b[!axis];
    const double high = a[!axis] < b[!axis] ? b[!axis] : a[!axis];
    return a[axis] == box[axis] && b[axis] == box[axis] && low < box[2 + !axis] &&
           box[!axis] < high;
}

/// Whether a box without width or height lies on a portal of a cell, or on a wall that steps pass.
static bool slrt_lies_on_way(const sl_runtime *rt, uint32_t number, const sl_runtime_cell *cell,
                             const double box[4]) {
    uint32_t i;
    if (box[0] == box[2] && box[1] == box[3]) return true;
    for (i = cell->first_directed; i < cell->first_directed + cell->directed_count; i++) {
        const sl_runtime_directed_portal portal = sl_runtime_get_directed_portal(rt, i);
        if (slrt_lies_along(box, portal.left, portal.right)) return true;
    }
    i = slrt_next_way(rt, number, slrt_first_passage(rt, number));
    for (; i < rt->passage_count; i = slrt_next_way(rt, number, i + 1)) {
        double right[2], left[2];
        slrt_read_passage(rt, i, right, left);
        if (slrt_lies_along(box, right, left)) return true;
    }
    return false;
}

/// Whether a box has points within a cell, or lies on one of its portals. To touch a cell is not
/// enough: a box at a wall is not seen from the wall's other side.
static bool slrt_reaches_into(const sl_runtime *rt, uint32_t number, const double box[4]) {
    const sl_runtime_cell cell = sl_runtime_get_cell(rt, number);
    const unsigned char *corner = rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell.vertex_count * SLRT_VERTEX_BYTES;
    const unsigned char *before = stop - SLRT_VERTEX_BYTES;
    bool left = true, right = true, under = true, over = true, touches = false;
    if (slrt_is_beside_box(rt, &cell, box)) return false;
    for (; corner < stop; before = corner, corner += SLRT_VERTEX_BYTES) {
        const double x = slrt_f64(corner), y = slrt_f64(corner + 8);
        int k, most = -1;
        for (k = 0; k < 4 && most <= 0; k++) {
            const int side =
                slrt_side_of_line(before, corner, box[k & 1 ? 2 : 0], box[k & 2 ? 3 : 1]);
            if (side > most) most = side;
        }
        if (most < 0) return false;
        touches = touches || !most;
        left = left && x <= box[0];
        under = under && y <= box[1];
        right = right && x >= box[2];
        over = over && y >= box[3];
    }
    if (!touches && !left && !right && !under && !over) return true;
    return (box[0] == box[2] || box[1] == box[3]) && slrt_lies_on_way(rt, number, &cell, box);
}

/// A box that is put into its cells.
typedef struct slrt_placing {
    sl_runtime_boxes *boxes;
    uint32_t box;
    double at[4];
} slrt_placing;

/// Puts a box into a cell, if it reaches into it. False if there is no room.
static bool slrt_put_in_cell(void *context, uint32_t cell) {
    const slrt_placing *placing = (const slrt_placing *)context;
    sl_runtime_boxes *boxes = placing->boxes;
    uint32_t *first = slrt_first_entry(boxes, cell), *own = slrt_own_entry(boxes, placing->box);
    const uint32_t free = boxes->memory[0];
    uint32_t *entry;
    // The last box that came to a cell is the first in its list: a second bucket has the cell too.
    if (*first != SLRT_NO_ENTRY && slrt_entry(boxes, *first)[SLRT_ENTRY_BOX] == placing->box)
        return true;
    if (!slrt_reaches_into(boxes->runtime, cell, placing->at)) return true;
    if (free == SLRT_NO_ENTRY) return false;
    entry = slrt_entry(boxes, free);
    boxes->memory[0] = entry[SLRT_ENTRY_OF_BOX];
    entry[SLRT_ENTRY_CELL] = cell;
    entry[SLRT_ENTRY_BOX] = placing->box;
    entry[SLRT_ENTRY_IN_CELL] = *first;
    entry[SLRT_ENTRY_OF_BOX] = *own;
    *first = *own = free;
    return true;
}

/// Whether a box may be somewhere: its numbers are sound, and in order.
static bool slrt_is_sound_box(const sl_runtime_box *box) {
    return slrt_is_coordinate(box->min_x) && slrt_is_coordinate(box->min_y) &&
           slrt_is_coordinate(box->max_x) && slrt_is_coordinate(box->max_y) &&
           box->min_x <= box->max_x && box->min_y <= box->max_y;
}

SL_RUNTIME_API bool sl_runtime_boxes_move(sl_runtime_boxes *boxes, uint32_t box,
                                          const sl_runtime_box *to) {
    slrt_placing placing;
    placing.boxes = boxes;
    placing.box = box;
    placing.at[0] = to->min_x, placing.at[1] = to->min_y;
    placing.at[2] = to->max_x, placing.at[3] = to->max_y;
    boxes->boxes[box] = *to;
    slrt_take_out(boxes, box);
    if (!slrt_is_sound_box(to) ||
        slrt_visit_near(boxes->runtime, placing.at, slrt_put_in_cell, &placing))
        return true;
    slrt_take_out(boxes, box);
    *slrt_own_entry(boxes, box) = SLRT_EVERYWHERE;
    return false;
}
