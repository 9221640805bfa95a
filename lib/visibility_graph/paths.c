/// Metric and angular depth: the paths from a point to all others along a visibility graph, the
/// shortest ones and those that turn least (depthmapX, vgametric.cpp and vgaangular.cpp of its
/// salalib; Dijkstra 1959).
///
/// A path goes from point to point, and turns only at points beside walls. So only those points are
/// expanded, besides the first, and besides points straight ahead for angles.
///
/// Few ways on from a point can gain. Points are tried 64 at a time, a word of a row. A word is
/// passed over where the path to its box is no shorter than the longest path to its points so far.
/// For turns, neighbours that were seen from the point before are passed over too:
///
///        p --------- u           The way p, q never turns more than p, u, q: the direction p to q
///          \        /            lies between p to u and u to q. So only neighbours of u that p
///            \    /              does not see can gain by u.
///              q
///
/// (It is never longer either. But of equally long paths depthmapX takes the one that single
/// precision makes shorter, and it counts that path's turns. So lengths are tried as there.)
/// Distances are counted in squares and in single precision, and ties go to the lower number.
///
/// Cost: for each point, O(points beside walls * points / 64) and a heap operation for each gain
/// of such a point.
#include "visibility_graph/measures.h"

#include <math.h>
#include <string.h>

#define RIGHT_ANGLE 1.5707963267948966

enum { NONE = -1 };

typedef struct entry {
    float key;
    int32_t point, before; ///< before: the point of the path before it, or NONE
} entry;

typedef struct square_box {
    int32_t left, right, bottom, top;
} square_box;

typedef struct walker {
    const sli_vga_job *job;
    int32_t *x, *y; ///< by point: its square
    float *length;  ///< by point: of its path so far, in squares; INFINITY: none
    float *turn;    ///< by point, in right angles; of a shortest path: when the path is final
    // By word of a row, for its 64 points: the largest of these, and the box around the points.
    float *most;
    square_box *boxes;
    int32_t *last;   ///< by point: the point of its path before it, or NONE
    int32_t *before; ///< by point that was expanded: the point of its path before it, or NONE
    sl_bits *done;   ///< points whose paths are final
    SL_ARRAY(entry) heap;
    uint32_t from;
} walker;

// --- the heap

static bool is_before(entry a, entry b) {
    return a.key < b.key || (a.key == b.key && a.point < b.point);
}

static sl_status push(sl_context *context, walker *w, entry e) {
    SL_TRY(SL_ARRAY_ROOM(context, &w->heap, 1));
    size_t i = w->heap.count++;
    for (; i && is_before(e, w->heap.items[(i - 1) / 2]); i = (i - 1) / 2)
        w->heap.items[i] = w->heap.items[(i - 1) / 2];
    w->heap.items[i] = e;
    return SL_OK;
}

static entry pop(walker *w) {
    entry *items = w->heap.items;
    const entry first = items[0], moved = items[--w->heap.count];
    size_t i = 0;
    for (;;) {
        size_t child = 2 * i + 1;
        if (child >= w->heap.count) break;
        if (child + 1 < w->heap.count && is_before(items[child + 1], items[child])) child++;
        if (!is_before(items[child], moved)) break;
        items[i] = items[child];
        i = child;
    }
    items[i] = moved;
    return first;
}

// --- geometry of squares

static double distance(const walker *w, int32_t a, int32_t b) {
    const double dx = w->x[a] - w->x[b], dy = w->y[a] - w->y[b];
    return sqrt(dx * dx + dy * dy);
}

/// The cosine of the turn of the path before, at, to.
static double cosine_at(const walker *w, int32_t before, int32_t at, int32_t to) {
    const double ax = w->x[to] - w->x[at], ay = w->y[to] - w->y[at];
    const double bx = w->x[at] - w->x[before], by = w->y[at] - w->y[before];
    return (ax * bx + ay * by) / sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
}

/// The turn itself, in right angles.
static float turn_of(double cosine) {
    return (float)(acos(fmin(fmax(cosine, -1), 1)) / RIGHT_ANGLE);
}

/// A little less than the turn, quickly: a polynomial (Abramowitz and Stegun 1964, 4.4.45) with an
/// error of 7e-5.
static double least_turn(double cosine) {
    const double c = fmin(fabs(cosine), 1);
    const double angle =
        sqrt(1 - c) * (1.5707288 + c * (-0.2121144 + c * (0.0742610 + c * -0.0187293)));
    return (cosine < 0 ? 2 * RIGHT_ANGLE - angle : angle) / RIGHT_ANGLE - 1e-4;
}

// --- paths

static bool may_turn(const walker *w, int32_t point) {
    return sl_bits_has(w->job->turning, (size_t)point);
}

static sl_status gain_length(sl_context *context, walker *w, entry at, int32_t to) {
    const float old = w->length[to];
    const double dx = w->x[at.point] - w->x[to], dy = w->y[at.point] - w->y[to];
    const double left = (double)old - at.key, square = dx * dx + dy * dy;
    if (square > left * left * (1 + 1e-12)) return SL_OK; // without a root
    const double step = sqrt(square);
    if (at.key + step >= old) return SL_OK;
    w->length[to] = at.key + (float)step;
    w->last[to] = at.point;
    // A path that is shorter by less than a float tells is there already, with its way so far.
    if (w->length[to] == old || !may_turn(w, to)) return SL_OK;
    return push(context, w, (entry){w->length[to], to, at.point});
}

static sl_status gain_turn(sl_context *context, walker *w, entry at, int32_t to) {
    const float old = w->turn[to];
    float turn = 0;
    if (at.key >= old) return SL_OK;
    if (at.before != NONE) {
        const double cosine = cosine_at(w, at.before, at.point, to);
        if (at.key + least_turn(cosine) >= old) return SL_OK;
        turn = turn_of(cosine);
    }
    if (at.key + turn >= old) return SL_OK;
    w->turn[to] = at.key + turn;
    // Only straight ahead, and beside walls, are points expanded.
    if (w->turn[to] > 0 && !may_turn(w, to)) return SL_OK;
    return push(context, w, (entry){w->turn[to], to, at.point});
}

/// The largest of 64 values.
static float most_of(const float *values) {
    float most[8] = {0};
    for (int i = 0; i < 64; i += 8)
        for (int k = 0; k < 8; k++) most[k] = values[i + k] > most[k] ? values[i + k] : most[k];
    for (int k = 1; k < 8; k++) most[0] = most[k] > most[0] ? most[k] : most[0];
    return most[0];
}

static double distance_to_box(const walker *w, int32_t point, const square_box *box) {
    const int32_t x = w->x[point], y = w->y[point];
    const double dx = x < box->left ? box->left - x : x > box->right ? x - box->right : 0;
    const double dy = y < box->bottom ? box->bottom - y : y > box->top ? y - box->top : 0;
    return dx == 0 ? dy : dy == 0 ? dx : sqrt(dx * dx + dy * dy);
}

/// Tries the ways on from a point. 64 points at a time are passed over where none can gain.
static sl_status expand_length(sl_context *context, walker *w, entry at) {
    const sl_vga_graph *graph = w->job->graph;
    const sl_bits *row = sli_vga_row(graph, (uint32_t)at.point);
    for (size_t k = 0; k < graph->words; k++) {
        sl_bits rest = row[k] & ~w->done[k];
        if (!rest || at.key >= w->most[k] ||
            at.key + distance_to_box(w, at.point, &w->boxes[k]) >= w->most[k])
            continue;
        for (; rest; rest &= rest - 1)
            SL_TRY(gain_length(context, w, at, (int32_t)(k * 64) + __builtin_ctzll(rest)));
        w->most[k] = most_of(w->length + k * 64);
    }
    return SL_OK;
}

static sl_status expand_turn(sl_context *context, walker *w, entry at) {
    const sl_vga_graph *graph = w->job->graph;
    const sl_bits *row = sli_vga_row(graph, (uint32_t)at.point);
    const sl_bits *known = at.before == NONE ? NULL : sli_vga_row(graph, (uint32_t)at.before);
    for (size_t k = 0; k < graph->words; k++) {
        sl_bits rest = row[k] & ~w->done[k];
        if (known) rest &= ~known[k];
        if (!rest || at.key >= w->most[k]) continue;
        for (; rest; rest &= rest - 1)
            SL_TRY(gain_turn(context, w, at, (int32_t)(k * 64) + __builtin_ctzll(rest)));
        w->most[k] = most_of(w->turn + k * 64);
    }
    return SL_OK;
}

static sl_status begin_paths(sl_context *context, walker *w, uint32_t from) {
    const uint32_t count = w->job->graph->count;
    w->from = from;
    w->heap.count = 0;
    memset(w->done, 0, w->job->graph->words * sizeof *w->done);
    for (uint32_t i = 0; i < count; i++) w->length[i] = w->turn[i] = INFINITY;
    for (size_t k = 0; k < w->job->graph->words; k++) w->most[k] = INFINITY;
    w->length[from] = w->turn[from] = 0;
    return push(context, w, (entry){0, (int32_t)from, NONE});
}

/// The turn of a path whose last step is known, and all before it.
static float turn_to(const walker *w, int32_t point) {
    const int32_t at = w->last[point], before = w->before[at];
    return before == NONE ? 0 : w->turn[at] + turn_of(cosine_at(w, before, at, point));
}

/// Paths to all points in sight are final at once.
static void finish_seen(walker *w) {
    const sl_bits *row = sli_vga_row(w->job->graph, w->from);
    for (size_t k = 0; k < w->job->graph->words; k++) w->done[k] |= row[k];
}

static sl_status find_shortest(sl_context *context, walker *w) {
    const double radius = w->job->options->metric_radius, step = w->job->grid->step;
    while (w->heap.count) {
        const entry e = pop(w);
        if (radius > 0 && e.key * step > radius) break;
        if (e.key > w->length[e.point]) continue; // a shorter path has come since
        w->before[e.point] = e.before;
        if (e.before != NONE) w->turn[e.point] = turn_to(w, e.point);
        SL_TRY(expand_length(context, w, e));
        sl_bits_add(w->done, (size_t)e.point);
    }
    return SL_OK;
}

static sl_status measure_metric(sl_context *context, walker *w, uint32_t from) {
    const sl_vga_options *options = w->job->options;
    const double step = w->job->grid->step;
    double length = 0, turn = 0, straight = 0, nodes = 0;
    SL_TRY(begin_paths(context, w, from));
    SL_TRY(find_shortest(context, w));
    for (uint32_t p = 0; p < w->job->graph->count; p++) {
        if (w->length[p] == INFINITY) continue;
        if (options->metric_radius > 0 && w->length[p] * step > options->metric_radius) continue;
        length += w->length[p] * step;
        if (p != from) turn += w->turn[p] == INFINITY ? turn_to(w, (int32_t)p) : w->turn[p];
        straight += step * distance(w, (int32_t)p, (int32_t)from);
        nodes++;
    }
    sl_vga_measures *out = &w->job->measures[from];
    out->metric_mean_shortest_path_distance = length / nodes;
    out->metric_mean_shortest_path_angle = turn / nodes;
    out->metric_mean_straight_line_distance = straight / nodes;
    out->metric_node_count = nodes;
    return SL_OK;
}

static sl_status measure_angular(sl_context *context, walker *w, uint32_t from) {
    const double radius = w->job->options->angular_radius;
    double turn = 0, nodes = 0;
    SL_TRY(begin_paths(context, w, from));
    while (w->heap.count) {
        const entry e = pop(w);
        if (radius > 0 && e.key > radius) break;
        if (e.key > w->turn[e.point]) continue; // a better path has come since
        SL_TRY(expand_turn(context, w, e));
        sl_bits_add(w->done, (size_t)e.point);
        if (e.before == NONE) finish_seen(w);
    }
    for (uint32_t p = 0; p < w->job->graph->count; p++) {
        if (w->turn[p] == INFINITY || (radius > 0 && w->turn[p] > radius)) continue;
        turn += w->turn[p];
        nodes++;
    }
    sl_vga_measures *out = &w->job->measures[from];
    out->angular_mean_depth = turn / nodes;
    out->angular_total_depth = turn;
    out->angular_node_count = nodes;
    return SL_OK;
}

// --- all points

static void end(sl_context *context, void *all, void *state) {
    (void)all;
    walker *w = state;
    sl_free(context, w->x);
    sl_free(context, w->y);
    sl_free(context, w->length);
    sl_free(context, w->turn);
    sl_free(context, w->most);
    sl_free(context, w->boxes);
    sl_free(context, w->last);
    sl_free(context, w->before);
    sl_free(context, w->done);
    sl_free(context, w->heap.items);
    sl_free(context, w);
}

static sl_status begin(sl_context *context, void *all, void **state) {
    const sli_vga_job *j = all;
    const uint32_t count = j->graph->count;
    walker *w = sl_alloc_array(context, 1, sizeof *w);
    if (!w) return SL_NO_MEMORY;
    w->job = j;
    const size_t words = j->graph->words;
    w->x = sl_alloc_array(context, count, sizeof *w->x);
    w->y = sl_alloc_array(context, count, sizeof *w->y);
    w->length = sl_alloc_array(context, words * 64, sizeof *w->length);
    w->turn = sl_alloc_array(context, words * 64, sizeof *w->turn);
    w->most = sl_alloc_array(context, words, sizeof *w->most);
    w->boxes = sl_alloc_array(context, words, sizeof *w->boxes);
    w->last = sl_alloc_array(context, count, sizeof *w->last);
    w->before = sl_alloc_array(context, count, sizeof *w->before);
    w->done = sl_alloc_array(context, words, sizeof *w->done);
    if (!w->x || !w->y || !w->length || !w->turn || !w->most || !w->boxes || !w->last ||
        !w->before || !w->done) {
        end(context, all, w);
        return SL_NO_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        w->x[i] = (int32_t)(j->grid->squares[i] / j->grid->rows);
        w->y[i] = (int32_t)(j->grid->squares[i] % j->grid->rows);
        square_box *box = &w->boxes[i / 64];
        if (i % 64 == 0) *box = (square_box){w->x[i], w->x[i], w->y[i], w->y[i]};
        box->right = w->x[i]; // columns ascend
        if (w->y[i] < box->bottom) box->bottom = w->y[i];
        if (w->y[i] > box->top) box->top = w->y[i];
    }
    *state = w;
    return SL_OK;
}

enum { POINTS_A_UNIT = 16 };

static sl_status measure_unit(sl_context *context, void *all, void *state, size_t unit) {
    const sli_vga_job *j = all;
    const uint32_t first = (uint32_t)unit * POINTS_A_UNIT;
    for (uint32_t p = first; p < j->graph->count && p < first + POINTS_A_UNIT; p++) {
        SL_TRY(sl_check_cancelled(context));
        if (j->options->parts & SL_VGA_METRIC) SL_TRY(measure_metric(context, state, p));
        if (j->options->parts & SL_VGA_ANGULAR) SL_TRY(measure_angular(context, state, p));
    }
    return SL_OK;
}

sl_status sli_vga_measure_paths(sl_context *context, const sli_vga_job *job) {
    sli_vga_job mine = *job;
    const sl_work work = {.job = &mine,
                          .begin = begin,
                          .unit = measure_unit,
                          .end = end,
                          .stage = "paths",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, (job->graph->count + POINTS_A_UNIT - 1) / POINTS_A_UNIT,
                       job->options->threads);
}

// --- points beside walls

/// Squares of a grid with one more on each side.
typedef struct ring {
    int64_t left, bottom, columns, rows;
    double step;
    sl_bits *touched;
} ring;

/// Marks the squares that a wall touches, row by row: in the band of a row, the wall spans the
/// columns between its crossings with the band's two lines.
static void mark_wall(const ring *r, const sl_wall *wall) {
    const double slack = 1e-10;
    const double ax = wall->a.x / r->step - (double)r->left + 0.5;
    const double ay = wall->a.y / r->step - (double)r->bottom + 0.5;
    const double bx = wall->b.x / r->step - (double)r->left + 0.5;
    const double by = wall->b.y / r->step - (double)r->bottom + 0.5;
    const double low = fmin(ay, by), high = fmax(ay, by);
    const double first = fmax(floor(low - slack), 0);
    const double last = fmin(floor(high + slack), (double)r->rows - 1);
    for (double row = first; row <= last; row++) {
        double left = fmin(ax, bx), right = fmax(ax, bx);
        if (by != ay) {
            const double slope = (bx - ax) / (by - ay);
            const double enter = ax + (fmax(low, row) - ay) * slope;
            const double leave = ax + (fmin(high, row + 1) - ay) * slope;
            left = fmin(enter, leave);
            right = fmax(enter, leave);
        }
        const double from = fmax(floor(left - slack), 0);
        const double to = fmin(floor(right + slack), (double)r->columns - 1);
        for (double column = from; column <= to; column++)
            sl_bits_add(r->touched, (size_t)column * (size_t)r->rows + (size_t)row);
    }
}

sl_status sli_vga_find_turning(sl_context *context, const sl_outline *outline,
                               const sl_vga_grid *grid, sl_bits **out) {
    const sl_space *space = outline->space;
    ring r = {grid->left - 1,          grid->bottom - 1, (int64_t)grid->columns + 2,
              (int64_t)grid->rows + 2, grid->step,       NULL};
    sl_bits *turning = sl_alloc_array(context, sl_bits_words(grid->count), sizeof *turning);
    r.touched =
        sl_alloc_array(context, sl_bits_words((size_t)(r.columns * r.rows)), sizeof *r.touched);
    if (!r.touched || !turning) {
        sl_free(context, r.touched);
        sl_free(context, turning);
        return SL_NO_MEMORY;
    }
    for (uint32_t w = 0; w < space->wall_count; w++) mark_wall(&r, &space->walls[w]);
    for (uint32_t p = 0; p < grid->count; p++) {
        const int64_t column = grid->squares[p] / grid->rows, row = grid->squares[p] % grid->rows;
        for (int k = 0; k < 9; k++)
            if (sl_bits_has(r.touched, (size_t)((column + k / 3) * r.rows + row + k % 3)))
                sl_bits_add(turning, p);
    }
    sl_free(context, r.touched);
    *out = turning;
    return SL_OK;
}
