/// The visibility graph for searches of paths (metric.c, angular.c): the points that turn paths,
/// and for each point the words of its row that are not empty.
///
/// Points are numbered along a Z-curve (tiles.c), first those that turn paths. So the 64 points of
/// a word fill a small box, and a row has few words. Cost: O(edges), and 16 bytes for each word.
#include "analysis/visibility_graph/graph_paths.h"
#include "base/base.h"

#include <string.h>

void sli_vga_sights_destroy(sl_context *context, sli_vga_sights *s) {
    sl_free(context, s->slots);
    sl_free(context, s->points);
    sl_free(context, s->starts);
    sl_free(context, s->x);
    sl_free(context, s->y);
    sl_free(context, s->parts);
    sl_free(context, s->turning);
    sl_free(context, s->boxes);
    sl_free(context, s->first);
    sl_free(context, s->others);
    sl_free(context, s->words.items);
}

sl_status sli_vga_order_paths(sl_context *context, const sl_vga_grid *grid, const sl_bits *turning,
                              uint32_t *slots, uint32_t *points, uint32_t *starts,
                              uint32_t *turning_count) {
    uint32_t turn = 0, other = 0;
    SL_TRY(sli_vga_order(context, grid, slots, starts));
    for (uint32_t p = 0; p < grid->count; p++) other += sl_bits_has(turning, p);
    *turning_count = other;
    for (uint32_t i = 0; i < grid->count; i++) { // along the curve
        const uint32_t point = starts[i];
        const uint32_t slot = sl_bits_has(turning, point) ? turn++ : other++;
        points[slot] = point;
        slots[point] = starts[i] = slot;
    }
    return SL_OK;
}

static void place_points(sli_vga_sights *s) {
    const sl_vga_grid *grid = s->job->grid;
    for (uint32_t slot = 0; slot < s->count; slot++) {
        const uint32_t point = s->points[slot];
        const float x = (float)(grid->squares[point] / grid->rows);
        const float y = (float)(grid->squares[point] % grid->rows);
        sli_vga_box *box = &s->boxes[slot / 64];
        if (slot % 64 == 0) *box = (sli_vga_box){x, x, y, y};
        box->left = fminf(box->left, x);
        box->right = fmaxf(box->right, x);
        box->bottom = fminf(box->bottom, y);
        box->top = fmaxf(box->top, y);
        s->x[slot] = x;
        s->y[slot] = y;
        if (sl_bits_has(s->job->turning, point)) sl_bits_add(s->turning, slot);
    }
}

/// Lists some words of a row.
static sl_status list_words(sl_context *context, sli_vga_sights *s, const sl_bits *row,
                            bool turning) {
    for (size_t b = 0; b < s->bundles; b++) {
        const uint64_t seen = row[b] & (turning ? s->turning[b] : ~s->turning[b]);
        if (!seen) continue;
        SL_TRY(SL_ARRAY_ROOM(context, &s->words, 1));
        s->words.items[s->words.count++] = (sli_vga_word){(uint32_t)b, seen};
    }
    return SL_OK;
}

/// Lists the words of a row: points that turn paths, then the others. `row` is scratch.
static sl_status list_row(sl_context *context, sli_vga_sights *s, uint32_t slot, sl_bits *row) {
    const sl_vga_graph *graph = s->job->graph;
    memset(row, 0, s->bundles * sizeof *row);
    for (sl_vga_run run = sl_vga_row(graph, s->points[slot]); sl_vga_next(&run);)
        for (uint32_t q = run.first; q < run.stop; q++) sl_bits_add(row, s->slots[q]);
    s->first[slot] = s->words.count;
    SL_TRY(list_words(context, s, row, true));
    s->others[slot] = s->words.count;
    return list_words(context, s, row, false);
}

/// Joins parts where a point sees one of another: one-way glass leads from part to part.
static void join_parts(sli_vga_sights *s, uint32_t *joined, uint32_t parts) {
    for (uint32_t part = 0; part < parts; part++) joined[part] = part;
    for (uint32_t at = 0; at < s->count; at++) {
        for (size_t i = s->first[at]; i < s->first[at + 1]; i++) {
            const sli_vga_word *word = &s->words.items[i];
            for (sl_bits rest = word->seen; rest; rest &= rest - 1) {
                const uint32_t q = word->bundle * 64 + (uint32_t)__builtin_ctzll(rest);
                if (s->parts[q] == s->parts[at]) continue;
                const uint32_t a = sl_root_of(joined, s->parts[at]);
                const uint32_t b = sl_root_of(joined, s->parts[q]);
                joined[a > b ? a : b] = a > b ? b : a;
            }
        }
    }
    for (uint32_t q = 0; q < s->count; q++) s->parts[q] = sl_root_of(joined, s->parts[q]);
}

/// Gives a number to a slot and to all that paths lead to from there, and takes them out of `left`.
static void number_part(sli_vga_sights *s, uint32_t slot, uint32_t part, uint32_t *queue,
                        sl_bits *left) {
    size_t head = 0, tail = 0;
    queue[tail++] = slot;
    sl_bits_flip(left, slot);
    while (head < tail) {
        const uint32_t at = queue[head++];
        s->parts[at] = part;
        for (size_t i = s->first[at]; i < s->first[at + 1]; i++) {
            const sli_vga_word *word = &s->words.items[i];
            for (sl_bits q = word->seen & left[word->bundle]; q; q &= q - 1)
                queue[tail++] = word->bundle * 64 + (uint32_t)__builtin_ctzll(q);
            left[word->bundle] &= ~word->seen;
        }
    }
}

/// Numbers the parts of the graph that no path joins, in any direction. `left` holds all slots, and
/// is used up.
static void number_parts(sli_vga_sights *s, uint32_t *queue, sl_bits *left) {
    uint32_t parts = 0;
    for (size_t b = 0; b < s->bundles; b++)
        while (left[b])
            number_part(s, (uint32_t)(b * 64) + (uint32_t)__builtin_ctzll(left[b]), parts++, queue,
                        left);
    if (parts > 1) join_parts(s, queue, parts);
}

sl_status sli_vga_sights_make(sl_context *context, const sli_vga_job *job, sli_vga_sights *s) {
    *s = (sli_vga_sights){.job = job, .kept_ways = SLI_VGA_KEPT_WAYS};
    s->count = job->graph->count;
    s->bundles = sl_bits_words(s->count);
    sl_bits *row = sl_alloc_array(context, s->bundles, sizeof *row);
    uint32_t *queue = sl_alloc_array(context, s->count, sizeof *queue);
    s->parts = sl_alloc_array(context, s->bundles * 64, sizeof *s->parts);
    s->slots = sl_alloc_array(context, s->count, sizeof *s->slots);
    s->points = sl_alloc_array(context, s->count, sizeof *s->points);
    s->starts = sl_alloc_array(context, s->count, sizeof *s->starts);
    s->x = sl_alloc_array(context, s->bundles * 64, sizeof *s->x);
    s->y = sl_alloc_array(context, s->bundles * 64, sizeof *s->y);
    s->turning = sl_alloc_array(context, s->bundles, sizeof *s->turning);
    s->boxes = sl_alloc_array(context, s->bundles, sizeof *s->boxes);
    s->first = sl_alloc_array(context, (size_t)s->count + 1, sizeof *s->first);
    s->others = sl_alloc_array(context, s->count, sizeof *s->others);
    const bool room = row && queue && s->parts && s->slots && s->points && s->starts && s->x &&
                      s->y && s->turning && s->boxes && s->first && s->others;
    sl_status status = room ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK)
        status = sli_vga_order_paths(context, job->grid, job->turning, s->slots, s->points,
                                     s->starts, &s->turning_count);
    if (status == SL_OK) place_points(s);
    for (uint32_t slot = 0; slot < s->count && status == SL_OK; slot++) {
        if (slot % 64 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK) status = list_row(context, s, slot, row);
    }
    if (status == SL_OK) {
        s->first[s->count] = s->words.count;
        sli_shrink(context, &s->words.items, &s->words.capacity, s->words.count,
                   sizeof *s->words.items);
        memset(row, 0, s->bundles * sizeof *row);
        for (uint32_t slot = 0; slot < s->count; slot++) sl_bits_add(row, slot);
        number_parts(s, queue, row);
    }
    sl_free(context, queue);
    sl_free(context, row);
    return status;
}

// --- searches from all points

static sl_status begin_path_worker(sl_context *context, void *all, void **walker) {
    const sli_vga_searches *searches = all;
    return searches->begin(context, searches, walker);
}

static void end_path_worker(sl_context *context, void *all, void *walker) {
    ((const sli_vga_searches *)all)->end(context, walker);
}

static sl_status measure_unit(sl_context *context, void *all, void *walker, size_t unit) {
    const sli_vga_searches *searches = all;
    const sli_vga_sights *s = searches->sights;
    for (size_t i = unit * 64; i < s->count && i < unit * 64 + 64; i++) {
        if (!sli_vga_is_asked(s->job->options, s->points[s->starts[i]])) continue;
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(searches->measure(context, walker, s->starts[i]));
    }
    return SL_OK;
}

sl_status sli_vga_search_all(sl_context *context, const sli_vga_searches *searches) {
    const sli_vga_sights *s = searches->sights;
    sli_vga_searches mine = *searches;
    const sl_work work = {.job = &mine,
                          .begin = begin_path_worker,
                          .unit = measure_unit,
                          .end = end_path_worker,
                          .stage = searches->stage,
                          .units = "bundles of points"};
    return sl_work_run(context, &work, s->bundles, s->job->options->threads);
}

sl_status sli_vga_measure_paths(sl_context *context, const sli_vga_job *job) {
    sli_vga_sights sights;
    sl_status status = sli_vga_sights_make(context, job, &sights);
    if (status == SL_OK && job->options->parts & SL_VGA_METRIC)
        status = sli_vga_measure_metric(context, &sights);
    if (status == SL_OK && job->options->parts & SL_VGA_ANGULAR)
        status = sli_vga_measure_angular(context, &sights);
    sli_vga_sights_destroy(context, &sights);
    return status;
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
