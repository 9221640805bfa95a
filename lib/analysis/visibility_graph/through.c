/// Through vision (Turner 2007): how many lines between points that see each other pass a point.
///
/// A line from p to q passes one square a column (or a row, if it is steep): the one nearest to it,
/// or both where it runs exactly between two. All of this is whole numbers. Exactly diagonal lines
/// pass no point: depthmapX counts them so.
///
/// Cost: O(edges * their length in squares). Threads count for themselves, and add up at the end.
#include "analysis/visibility_graph/graph_measures.h"

#include <stdatomic.h>
#include <stdlib.h>

typedef struct passing {
    const sli_vga_job *job;
    _Atomic uint64_t *counts; ///< by square
} passing;

static int64_t floor_div(int64_t a, int64_t b) {
    return a / b - (a % b < 0);
}

/// Adds the squares between two squares, which are dx columns and dy rows apart.
static void pass(uint64_t *counts, int64_t from, int64_t rows, int64_t dx, int64_t dy) {
    const int64_t ax = dx < 0 ? -dx : dx, ay = dy < 0 ? -dy : dy;
    if (ax == ay) return;
    const bool steep = ay > ax;
    const int64_t length = steep ? ay : ax, minor = steep ? dx : dy;
    const int64_t along = steep ? (dy > 0 ? 1 : -1) : dx > 0 ? rows : -rows;
    const int64_t across = steep ? rows : 1;
    for (int64_t k = 1; k < length; k++) {
        const int64_t twice = 2 * k * minor + length;
        const int64_t offset = floor_div(twice, 2 * length);
        counts[from + k * along + offset * across]++;
        if (twice % (2 * length) == 0) counts[from + k * along + (offset - 1) * across]++;
    }
}

static sl_status begin_through_worker(sl_context *context, void *all, void **state) {
    const sl_vga_grid *grid = ((const passing *)all)->job->grid;
    *state = sl_alloc_array(context, (size_t)grid->columns * grid->rows, sizeof(uint64_t));
    return *state ? SL_OK : SL_NO_MEMORY;
}

static void end_through_worker(sl_context *context, void *all, void *state) {
    const passing *p = all;
    const uint64_t *counts = state;
    const size_t squares = (size_t)p->job->grid->columns * p->job->grid->rows;
    for (size_t i = 0; i < squares; i++)
        if (counts[i]) atomic_fetch_add(&p->counts[i], counts[i]);
    sl_free(context, state);
}

enum { POINTS_A_UNIT = 64 };

static sl_status pass_unit(sl_context *context, void *all, void *state, size_t unit) {
    const sli_vga_job *j = ((const passing *)all)->job;
    const sl_vga_grid *grid = j->grid;
    const uint32_t first = (uint32_t)unit * POINTS_A_UNIT;
    for (uint32_t p = first; p < grid->count && p < first + POINTS_A_UNIT; p++) {
        const int64_t rows = grid->rows, from = grid->squares[p];
        SL_TRY(sl_check_cancelled(context));
        for (sl_vga_run run = sl_vga_row(j->graph, p); sl_vga_next(&run);)
            for (uint32_t q = run.first; q < run.stop; q++) {
                const int64_t to = grid->squares[q];
                pass(state, from, rows, to / rows - from / rows, to % rows - from % rows);
            }
    }
    return SL_OK;
}

sl_status sli_vga_measure_through(sl_context *context, const sli_vga_job *job) {
    const sl_vga_grid *grid = job->grid;
    void *block =
        sl_alloc_array(context, (size_t)grid->columns * grid->rows, sizeof(_Atomic uint64_t));
    if (!block) return SL_NO_MEMORY;
    passing p = {job, block};
    const sl_work work = {.job = &p,
                          .begin = begin_through_worker,
                          .unit = pass_unit,
                          .end = end_through_worker,
                          .stage = "through vision",
                          .units = "bundles of points"};
    const sl_status status = sl_work_run(
        context, &work, (grid->count + POINTS_A_UNIT - 1) / POINTS_A_UNIT, job->options->threads);
    for (uint32_t i = 0; i < grid->count && status == SL_OK; i++)
        job->measures[i].through_vision = (double)atomic_load(&p.counts[grid->squares[i]]);
    sl_free(context, block);
    return status;
}
