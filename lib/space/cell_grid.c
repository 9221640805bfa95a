/// Each cell is entered row by row: what of it lies in a row of buckets reaches from one column to
/// another. Places are rounded, so rows and columns are taken a little wider than they are: a
/// bucket may hold a cell too many, and never one too few. A millionth of a bucket is far more than
/// rounding, as coordinates are measured from the corner of the bounds, of which a bucket is no
/// less than 2^-16.
///
/// There are four buckets for each cell, so that half of all places lie in a bucket of one or two
/// cells. Buckets are as long as cells are on average, in x and in y. Where many long cells lie
/// askew there would be too many entries: such a grid has fewer buckets.
#include "space/cell_grid.h"

#include "sightline/support.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 1 << 16, BUCKETS_PER_CELL = 4, ENTRIES_PER_CELL = 32 };
static const double SLACK = 1e-6; ///< of a bucket

/// Columns from low to high; none where low > high.
typedef struct span {
    double low, high;
} span;

typedef struct filler {
    const sl_space *space;
    sl_cell_grid *grid;
    double width, height; ///< of the bounds
    double slack;         ///< of a bucket
    span *rows;           ///< by row: of the cell at hand
    uint32_t *counts;     ///< by bucket: of entries so far
    uint64_t total;       ///< of all counts
} filler;

/// A corner in units of buckets.
static sl_point in_buckets(const filler *f, sl_point p) {
    const sl_box *b = &f->space->bounds;
    return (sl_point){(p.x - b->min.x) / f->width * f->grid->columns,
                      (p.y - b->min.y) / f->height * f->grid->rows};
}

static uint32_t clamp(double step, uint32_t count) {
    return step < 0 ? 0 : step < count ? (uint32_t)step : count - 1;
}

/// Widens the rows that a side passes through.
static void add_side(const filler *f, sl_point p, sl_point q) {
    const uint32_t rows = f->grid->rows;
    if (p.y > q.y) {
        const sl_point swap = p;
        p = q;
        q = swap;
    }
    const uint32_t first = clamp(p.y - f->slack, rows), last = clamp(q.y + f->slack, rows);
    for (uint32_t row = first; row <= last; row++) {
        const double low = fmax(p.y, row - f->slack), high = fmin(q.y, row + 1 + f->slack);
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
static void enter(filler *f, uint32_t number, uint32_t *cells) {
    const sl_cell *cell = &f->space->cells[number];
    const sl_cell_grid *g = f->grid;
    const sl_point *corners = f->space->vertices + cell->first_vertex;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (uint32_t i = 0; i < cell->vertex_count; i++) {
        const double y = in_buckets(f, corners[i]).y;
        low = fmin(low, y);
        high = fmax(high, y);
    }
    const uint32_t first = clamp(low - f->slack, g->rows), last = clamp(high + f->slack, g->rows);
    for (uint32_t row = first; row <= last; row++) f->rows[row] = (span){HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < cell->vertex_count; i++)
        add_side(f, in_buckets(f, corners[i]),
                 in_buckets(f, corners[i + 1 < cell->vertex_count ? i + 1 : 0]));
    for (uint32_t row = first; row <= last; row++) {
        if (f->rows[row].low > f->rows[row].high) continue;
        const uint32_t from = clamp(f->rows[row].low - f->slack, g->columns);
        const uint32_t to = clamp(f->rows[row].high + f->slack, g->columns);
        for (uint32_t column = from; column <= to; column++) {
            const size_t bucket = (size_t)row * g->columns + column;
            if (cells) cells[g->first[bucket] + f->counts[bucket]] = number;
            f->counts[bucket]++;
        }
        f->total += to - from + 1;
    }
}

static sl_status fill_lists(sl_context *context, filler *f, uint64_t most) {
    const uint32_t cells = f->space->cell_count;
    sl_cell_grid *g = f->grid;
    const size_t buckets = (size_t)g->columns * g->rows;
    g->first = sl_alloc_array(context, buckets + 1, sizeof *g->first);
    f->rows = sl_alloc_array(context, g->rows, sizeof *f->rows);
    f->counts = sl_alloc_array(context, buckets, sizeof *f->counts);
    if (!g->first || !f->rows || !f->counts) return SL_NO_MEMORY;
    for (uint32_t i = 0; i < cells && f->total <= most; i++) enter(f, i, NULL);
    if (f->total > most) return SL_OK;
    g->first[0] = 0;
    for (size_t i = 0; i < buckets; i++) g->first[i + 1] = g->first[i] + f->counts[i];
    g->entry_count = g->first[buckets];
    g->cells = sl_alloc_array(context, g->entry_count, sizeof *g->cells);
    if (!g->cells) return SL_NO_MEMORY;
    memset(f->counts, 0, buckets * sizeof *f->counts);
    for (uint32_t i = 0; i < cells; i++) enter(f, i, g->cells);
    return SL_OK;
}

/// Fills a grid whose columns and rows are set; leaves `cells` NULL where it would have more than
/// `most` entries.
static sl_status fill(sl_context *context, const sl_space *space, double slack, uint64_t most,
                      sl_cell_grid *grid) {
    const sl_box *b = &space->bounds;
    filler f = {.space = space,
                .grid = grid,
                .width = b->max.x - b->min.x,
                .height = b->max.y - b->min.y,
                .slack = slack};
    const sl_status status = fill_lists(context, &f, most);
    sl_free(context, f.rows);
    sl_free(context, f.counts);
    return status;
}

/// How much wider than high cells are on average, both as shares of the bounds.
static double shape_of_cells(const sl_space *s) {
    const sl_box *b = &s->bounds;
    double wide = 0, high = 0;
    for (uint32_t i = 0; i < s->cell_count; i++) {
        const sl_point *v = s->vertices + s->cells[i].first_vertex;
        sl_point min = v[0], max = v[0];
        for (uint32_t k = 1; k < s->cells[i].vertex_count; k++) {
            min = (sl_point){fmin(min.x, v[k].x), fmin(min.y, v[k].y)};
            max = (sl_point){fmax(max.x, v[k].x), fmax(max.y, v[k].y)};
        }
        wide += (max.x - min.x) / (b->max.x - b->min.x);
        high += (max.y - min.y) / (b->max.y - b->min.y);
    }
    return wide / high;
}

static uint32_t steps(double share) {
    return share >= 1 ? (uint32_t)fmin(share, MOST_STEPS) : 1;
}

sl_status sl_cell_grid_make(sl_context *context, sl_space *space) {
    sl_cell_grid *g = &space->grid;
    const double shape = shape_of_cells(space);
    const uint64_t most = (uint64_t)space->cell_count * ENTRIES_PER_CELL;
    double buckets = (double)space->cell_count * BUCKETS_PER_CELL;
    sl_status status = SL_OK;
    for (; status == SL_OK && !g->cells; buckets /= 4) {
        sl_cell_grid_destroy(context, g);
        g->columns = steps(fmin(buckets, sqrt(buckets / shape)));
        g->rows = steps(buckets / g->columns);
        status = fill(context, space, SLACK, most < UINT32_MAX ? most : UINT32_MAX, g);
    }
    return status;
}

static bool is_in_bucket(const sl_cell_grid *g, size_t bucket, uint32_t cell) {
    for (uint32_t i = g->first[bucket]; i < g->first[bucket + 1]; i++)
        if (g->cells[i] == cell) return true;
    return false;
}

static sl_status compare(sl_context *context, const sl_cell_grid *grid, const sl_cell_grid *least) {
    if (!least->cells)
        return sl_fail(context, SL_BAD_INPUT, "the grid of buckets has too few entries");
    const size_t buckets = (size_t)grid->columns * grid->rows;
    for (size_t b = 0; b < buckets; b++)
        for (uint32_t i = least->first[b]; i < least->first[b + 1]; i++)
            if (!is_in_bucket(grid, b, least->cells[i]))
                return sl_fail(context, SL_BAD_INPUT,
                               "cell %u is not in a bucket that it reaches into", least->cells[i]);
    return SL_OK;
}

sl_status sl_cell_grid_check(sl_context *context, const sl_space *space) {
    sl_cell_grid least = {.columns = space->grid.columns, .rows = space->grid.rows};
    sl_status status = fill(context, space, SLACK / 2, space->grid.entry_count, &least);
    if (status == SL_OK) status = compare(context, &space->grid, &least);
    sl_cell_grid_destroy(context, &least);
    return status;
}

void sl_cell_grid_destroy(sl_context *context, sl_cell_grid *grid) {
    sl_free(context, grid->first);
    sl_free(context, grid->cells);
    *grid = (sl_cell_grid){0};
}
