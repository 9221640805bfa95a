/// From points and boxes to cells.

/// As slrt_side, for the ways from a to b and from a to (x, y).
static int slrt_side_of_line(const unsigned char *a, const unsigned char *b, double x, double y) {
    const double a_x = slrt_f64(a), a_y = slrt_f64(a + 8);
    const slrt_arm along = slrt_make_arm(a_x, a_y, slrt_f64(b), slrt_f64(b + 8));
    const slrt_arm to = slrt_make_arm(a_x, a_y, x, y);
    return slrt_side(&along, &to);
}

/// Where a point is: 1 in a cell, 0 on its border, -1 outside.
static int slrt_place_in(const sl_runtime *rt, uint32_t number, double x, double y) {
    const sl_runtime_cell cell = sl_runtime_get_cell(rt, number);
    const unsigned char *corner = rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell.vertex_count * SLRT_VERTEX_BYTES;
    const unsigned char *before = stop - SLRT_VERTEX_BYTES;
    int place = 1;
    for (; corner < stop && place >= 0; before = corner, corner += SLRT_VERTEX_BYTES) {
        const int side = slrt_side_of_line(before, corner, x, y);
        if (side < place) place = side;
    }
    return place;
}

static bool slrt_holds(const sl_runtime *rt, uint32_t number, double x, double y) {
    return slrt_place_in(rt, number, x, y) >= 0;
}

/// The column or row of a coordinate within the bounds, as in lib/space/index.h. Buckets are made
/// for places that only come near, too, so rounding changes no answer.
static uint32_t slrt_step(double value, double low, double high, uint32_t count) {
    const double step = (value - low) / (high - low) * count;
    const uint32_t whole = step < count ? (uint32_t)step : count - 1;
    return whole < count ? whole : count - 1; // whatever -ffast-math makes of the line above
}

/// The bucket of a point within the bounds.
static size_t slrt_bucket(const sl_runtime *rt, uint32_t columns, uint32_t rows, double x,
                          double y) {
    return (size_t)slrt_step(y, rt->min_y, rt->max_y, rows) * columns +
           slrt_step(x, rt->min_x, rt->max_x, columns);
}

/// Of the cells that hold a point, the one with the highest number here counts.
static int slrt_claim(const sl_runtime *rt, uint32_t cell) {
    return sl_runtime_is_inside(rt, cell) ? 2 : !sl_runtime_is_solid(rt, cell);
}

/// The first cell that holds a point and is inside, else the first that is not solid, else the
/// first. It is among those of the point's bucket, or among all without a grid. Cells tile the
/// bounds, so the last one holds the point if no other does.
static uint32_t slrt_locate_by_grid(const sl_runtime *rt, double x, double y) {
    uint32_t at = 0, end = rt->cell_count, found = SL_RUNTIME_NO_CELL;
    int best = -1;
    if (rt->grid_cells) {
        const unsigned char *bucket =
            rt->grid_offsets + slrt_bucket(rt, rt->grid_columns, rt->grid_rows, x, y) * 4;
        at = slrt_u32(bucket);
        end = slrt_u32(bucket + 4);
    }
    for (; at < end && best < 2; at++) {
        const uint32_t cell = rt->grid_cells ? slrt_u32(rt->grid_cells + (size_t)at * 4) : at;
        const int claim = slrt_claim(rt, cell);
        if (claim <= best) continue;
        if (!(best < 0 && at + 1 == end && !rt->loose) && !slrt_holds(rt, cell, x, y)) continue;
        found = cell;
        best = claim;
    }
    return found;
}

/// The cell below a node of the tree that a point is in, or that is right of it and over it.
static uint32_t slrt_descend(const sl_runtime *rt, int32_t at, double x, double y) {
    while (at >= 0) {
        const unsigned char *node = rt->nodes + (size_t)at * SLRT_NODE_BYTES;
        at = slrt_i32(node + ((slrt_i32(node + 8) ? y : x) >= slrt_f64(node) ? 16 : 12));
    }
    return (uint32_t)~at;
}

/// Where in the tree the search for a point starts.
static int32_t slrt_start(const sl_runtime *rt, double x, double y) {
    if (!rt->tree_starts) return rt->root;
    return slrt_i32(rt->tree_starts + slrt_bucket(rt, rt->tree_columns, rt->tree_rows, x, y) * 4);
}

/// The next smaller number: it is below the same split lines, and below one through the number.
static double slrt_before(double number) {
    int64_t bits;
    if (number == 0) return -4.9406564584124654e-324;
    memcpy(&bits, &number, sizeof bits);
    bits += number > 0 ? -1 : 1;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static bool slrt_in_bounds(const sl_runtime *rt, double x, double y) {
    return x >= rt->min_x && x <= rt->max_x && y >= rt->min_y && y <= rt->max_y;
}

SL_RUNTIME_API uint32_t sl_runtime_locate(const sl_runtime *runtime, double x, double y) {
    uint32_t found;
    int side;
    if (!slrt_in_bounds(runtime, x, y)) return SL_RUNTIME_NO_CELL;
    if (!runtime->nodes) return slrt_locate_by_grid(runtime, x, y);
    found = slrt_descend(runtime, slrt_start(runtime, x, y), x, y);
    for (side = 1; side < 4 && !sl_runtime_is_inside(runtime, found); side++) {
        const uint32_t cell = slrt_descend(runtime, runtime->root, side & 1 ? slrt_before(x) : x,
                                           side & 2 ? slrt_before(y) : y);
        if (slrt_claim(runtime, cell) > slrt_claim(runtime, found)) found = cell;
    }
    return found;
}

// --- from box to cells

/// The lower left and the upper right of a cell's corners.
static void slrt_bounds_of(const sl_runtime *rt, const sl_runtime_cell *cell, double bounds[4]) {
    const unsigned char *corner = rt->vertices + (size_t)cell->first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell->vertex_count * SLRT_VERTEX_BYTES;
    double low_x = slrt_f64(corner), low_y = slrt_f64(corner + 8), high_x = low_x, high_y = low_y;
    while ((corner += SLRT_VERTEX_BYTES) < stop) {
        const double x = slrt_f64(corner), y = slrt_f64(corner + 8);
        low_x = x < low_x ? x : low_x;
        low_y = y < low_y ? y : low_y;
        high_x = x > high_x ? x : high_x;
        high_y = y > high_y ? y : high_y;
    }
    bounds[0] = low_x, bounds[1] = low_y, bounds[2] = high_x, bounds[3] = high_y;
}

/// Whether a cell lies on one side of a box.
static bool slrt_is_beside_box(const sl_runtime *rt, const sl_runtime_cell *cell,
                               const double box[4]) {
    double bounds[4];
    slrt_bounds_of(rt, cell, bounds);
    return bounds[2] < box[0] || bounds[3] < box[1] || bounds[0] > box[2] || bounds[1] > box[3];
}

/// A cell and a box are convex: if they are apart, a side of one of them separates them.
static bool slrt_meets_box(const sl_runtime *rt, uint32_t number, const double box[4]) {
    const sl_runtime_cell cell = sl_runtime_get_cell(rt, number);
    const unsigned char *corner = rt->vertices + (size_t)cell.first_vertex * SLRT_VERTEX_BYTES;
    const unsigned char *stop = corner + (size_t)cell.vertex_count * SLRT_VERTEX_BYTES;
    const unsigned char *before = stop - SLRT_VERTEX_BYTES;
    if (slrt_is_beside_box(rt, &cell, box)) return false;
    for (; corner < stop; before = corner, corner += SLRT_VERTEX_BYTES) {
        // The corner of the box that is farthest to the left of the side.
        const double x = box[slrt_f64(corner + 8) > slrt_f64(before + 8) ? 0 : 2];
        const double y = box[slrt_f64(corner) > slrt_f64(before) ? 3 : 1];
        if (slrt_side_of_line(before, corner, x, y) < 0) return false;
    }
    return true;
}

/// What is done with a cell near a box; false to stop.
typedef bool slrt_visit(void *context, uint32_t cell);

static bool slrt_visit_all(const sl_runtime *rt, slrt_visit *visit, void *context) {
    uint32_t i;
    for (i = 0; i < rt->cell_count; i++)
        if (!visit(context, i)) return false;
    return true;
}

/// The cells of all buckets that a box meets; a cell may come more than once.
static bool slrt_visit_by_grid(const sl_runtime *rt, const double box[4], slrt_visit *visit,
                               void *context) {
    const uint32_t columns = rt->grid_columns, rows = rt->grid_rows;
    const double low_x = box[0] > rt->min_x ? box[0] : rt->min_x;
    const double low_y = box[1] > rt->min_y ? box[1] : rt->min_y;
    const double high_x = box[2] < rt->max_x ? box[2] : rt->max_x;
    const double high_y = box[3] < rt->max_y ? box[3] : rt->max_y;
    const uint32_t right = slrt_step(high_x, rt->min_x, rt->max_x, columns);
    const uint32_t top = slrt_step(high_y, rt->min_y, rt->max_y, rows);
    uint32_t y, x, i;
    for (y = slrt_step(low_y, rt->min_y, rt->max_y, rows); y <= top; y++)
        for (x = slrt_step(low_x, rt->min_x, rt->max_x, columns); x <= right; x++) {
            const unsigned char *bucket = rt->grid_offsets + ((size_t)y * columns + x) * 4;
            for (i = slrt_u32(bucket); i < slrt_u32(bucket + 4); i++)
                if (!visit(context, slrt_u32(rt->grid_cells + (size_t)i * 4))) return false;
        }
    return true;
}

static bool slrt_visit_by_tree(const sl_runtime *rt, const double box[4], slrt_visit *visit,
                               void *context) {
    enum { MOST = 128 };
    int32_t stack[MOST];
    uint32_t count = 1, steps = 2 * rt->node_count + 1; // no more than a tree has
    stack[0] = rt->root;
    while (count && count < MOST - 1 && steps--) {
        const int32_t child = stack[--count];
        const unsigned char *node;
        int axis;
        if (child < 0) {
            if (!visit(context, (uint32_t)~child)) return false;
            continue;
        }
        node = rt->nodes + (size_t)child * SLRT_NODE_BYTES;
        axis = slrt_i32(node + 8) ? 1 : 0;
        if (box[axis] <= slrt_f64(node)) stack[count++] = slrt_i32(node + 12);
        if (box[2 + axis] >= slrt_f64(node)) stack[count++] = slrt_i32(node + 16);
    }
    return !count || slrt_visit_all(rt, visit, context); // too deep, or no tree
}

/// Visits all cells that a box touches, and some that are near: by the grid or the tree, or all if
/// there is neither. False if a visit stopped it.
static bool slrt_visit_near(const sl_runtime *rt, const double box[4], slrt_visit *visit,
                            void *context) {
    if (box[2] < rt->min_x || box[3] < rt->min_y || box[0] > rt->max_x || box[1] > rt->max_y)
        return true;
    if (rt->grid_cells) return slrt_visit_by_grid(rt, box, visit, context);
    if (rt->nodes) return slrt_visit_by_tree(rt, box, visit, context);
    return slrt_visit_all(rt, visit, context);
}

/// So many cells are noted at a time: a number that 32 divides.
#ifndef SLRT_WINDOW
#define SLRT_WINDOW 8192
#endif

/// Cells by number, from `first` on, as bits.
typedef struct slrt_window {
    uint32_t first, next; ///< next: the first one behind the bits
    uint32_t bits[SLRT_WINDOW / 32];
} slrt_window;

static bool slrt_note(void *context, uint32_t cell) {
    slrt_window *w = (slrt_window *)context;
    const uint32_t at = cell - w->first;
    if (cell < w->first) return true;
    if (at < SLRT_WINDOW)
        w->bits[at / 32] |= UINT32_C(1) << at % 32;
    else if (cell < w->next)
        w->next = cell;
    return true;
}

SL_RUNTIME_API uint32_t sl_runtime_box_cells(const sl_runtime *runtime, double min_x, double min_y,
                                             double max_x, double max_y, uint32_t *cells,
                                             uint32_t room) {
    double box[4];
    uint32_t i, bits, cell, count = 0;
    slrt_window w;
    if (!(min_x <= max_x && min_y <= max_y)) return 0;
    box[0] = min_x, box[1] = min_y, box[2] = max_x, box[3] = max_y;
    for (w.first = 0; w.first != SL_RUNTIME_NO_CELL; w.first = w.next) {
        w.next = SL_RUNTIME_NO_CELL;
        memset(w.bits, 0, sizeof w.bits);
        slrt_visit_near(runtime, box, slrt_note, &w);
        for (i = 0; i < SLRT_WINDOW / 32; i++)
            for (bits = w.bits[i], cell = w.first + 32 * i; bits; bits >>= 1, cell++) {
                if (!(bits & 1) || !slrt_meets_box(runtime, cell, box)) continue;
                if (count < room) cells[count] = cell;
                count++;
            }
    }
    return count;
}
