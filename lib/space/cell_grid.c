/// Each cell is entered row by row: what of it lies in a row of buckets reaches from one column to
/// another. Places are rounded, so rows and columns are taken a little wider than they are: a
/// bucket may hold a cell too many, and never one too few. A millionth of a bucket is far more than
/// rounding, as coordinates are measured from the corner of the bounds, of which a bucket is no
/// less than 2^-16.
#include "space/cell_grid.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 1 << 16 };
static const double SLACK = 1e-6; ///< of a bucket

/// Columns from low to high; none where low > high.
typedef struct span {
    double low, high;
} span;

typedef struct filler {
    const sl_space *space;
    double width, height; ///< of the bounds
    span *rows;           ///< by row: of the cell at hand
    uint32_t *counts;     ///< by bucket: of entries so far
} filler;

/// A corner in units of buckets.
static sl_point in_buckets(const filler *f, sl_point p) {
    const sl_box *b = &f->space->bounds;
    return (sl_point){(p.x - b->min.x) / f->width * f->space->grid.columns,
                      (p.y - b->min.y) / f->height * f->space->grid.rows};
}

static uint32_t clamp(double step, uint32_t count) {
    return step < 0 ? 0 : step < count ? (uint32_t)step : count - 1;
}

/// Widens the rows that a side passes through.
static void add_side(const filler *f, sl_point p, sl_point q) {
    const uint32_t rows = f->space->grid.rows;
    if (p.y > q.y) {
        const sl_point swap = p;
        p = q;
        q = swap;
    }
    const uint32_t first = clamp(p.y - SLACK, rows), last = clamp(q.y + SLACK, rows);
    for (uint32_t row = first; row <= last; row++) {
        const double low = fmax(p.y, row - SLACK), high = fmin(q.y, row + 1 + SLACK);
        const double rise = q.y - p.y;
        double a = p.x, b = q.x;
        if (rise > 0 && first != last) {
            a = p.x + (q.x - p.x) * fmin(1, fmax(0, (low - p.y) / rise));
            b = p.x + (q.x - p.x) * fmin(1, fmax(0, (high - p.y) / rise));
        }
        f->rows[row].low = fmin(f->rows[row].low, fmin(a, b));
        f->rows[row].high = fmax(f->rows[row].high, fmax(a, b));
    }
}

/// Enters a cell into its buckets; where there are no lists yet it is only counted.
static void enter(const filler *f, uint32_t number, uint32_t *cells) {
    const sl_cell *cell = &f->space->cells[number];
    const sl_cell_grid *g = &f->space->grid;
    const sl_point *corners = f->space->vertices + cell->first_vertex;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const double y = in_buckets(f, corners[i]).y;
        low = fmin(low, y);
        high = fmax(high, y);
    }
    const uint32_t first = clamp(low - SLACK, g->rows), last = clamp(high + SLACK, g->rows);
    for (uint32_t row = first; row <= last; row++) f->rows[row] = (span){HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        add_side(f, in_buckets(f, corners[i]),
                 in_buckets(f, corners[i + 1 < cell->vertex_count ? i + 1 : 0]));
    for (uint32_t row = first; row <= last; row++) {
        if (f->rows[row].low > f->rows[row].high) continue;
        const uint32_t from = clamp(f->rows[row].low - SLACK, g->columns);
        const uint32_t to = clamp(f->rows[row].high + SLACK, g->columns);
        for (uint32_t column = from; column <= to; column++) {
            const size_t bucket = (size_t)row * g->columns + column;
            if (cells) cells[g->first[bucket] + f->counts[bucket]] = number;
            f->counts[bucket]++;
        }
    }
}

static uint32_t steps(double share) {
    return share >= 1 ? (uint32_t)fmin(share, MOST_STEPS) : 1;
}

static sl_status fill(sl_context *context, filler *f, sl_cell_grid *g) {
    const sl_space *s = f->space;
    const size_t buckets = (size_t)g->columns * g->rows;
    g->first = sl_alloc_array(context, buckets + 1, sizeof *g->first);
    f->rows = sl_alloc_array(context, g->rows, sizeof *f->rows);
    f->counts = sl_alloc_array(context, buckets, sizeof *f->counts);
    if (!g->first || !f->rows || !f->counts) return SL_NO_MEMORY;
    uint64_t total = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) enter(f, i, NULL);
    for (size_t i = 0; i < buckets; i++) {
        g->first[i] = (uint32_t)total;
        total += f->counts[i];
        if (total > UINT32_MAX) return sl_fail_memory(context);
    }
    g->first[buckets] = g->entry_count = (uint32_t)total;
    g->cells = sl_alloc_array(context, total, sizeof *g->cells);
    if (!g->cells) return SL_NO_MEMORY;
    memset(f->counts, 0, buckets * sizeof *f->counts);
    for (uint32_t i = 0; i < s->cell_count; i++) enter(f, i, g->cells);
    return SL_OK;
}

sl_status sl_cell_grid_make(sl_context *context, sl_space *space) {
    const sl_box *b = &space->bounds;
    filler f = {.space = space, .width = b->max.x - b->min.x, .height = b->max.y - b->min.y};
    sl_cell_grid *g = &space->grid;
    g->columns = steps(sqrt((double)space->cell_count) * sqrt(f.width / f.height));
    g->rows = steps((double)space->cell_count / g->columns);
    const sl_status status = fill(context, &f, g);
    sl_free(context, f.rows);
    sl_free(context, f.counts);
    return status;
}

void sl_cell_grid_destroy(sl_context *context, sl_cell_grid *grid) {
    sl_free(context, grid->first);
    sl_free(context, grid->cells);
    *grid = (sl_cell_grid){0};
}
