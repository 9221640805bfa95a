/// The buckets that locate a point in a mesh.
#ifndef SL_SPACE_CELL_GRID_H
#define SL_SPACE_CELL_GRID_H

#include "sightline/space.h"

#include <math.h>
#include <stdbool.h>

/// Makes the grid of a space whose cells, vertices and bounds are there: four buckets for each cell
/// or fewer, and 32 entries at most.
sl_status sl_cell_grid_make(sl_context *context, sl_space *space);

/// Checks that each cell is in all buckets that it reaches into, given a grid that can be read and
/// cells within the bounds. SL_BAD_INPUT names one that is not.
sl_status sl_cell_grid_check(sl_context *context, const sl_space *space);

void sl_cell_grid_destroy(sl_context *context, sl_cell_grid *grid); ///< and zeroes it

/// The column or row of a coordinate: count of them from low to high. It never falls as the
/// coordinate grows, so that a bucket is a box whatever is rounded.
static inline uint32_t sl_cell_grid_step(double value, double low, double high, uint32_t count) {
    const double step = (value - low) / (high - low) * count;
    return step < count ? (uint32_t)step : count - 1;
}

/// The bucket of a point within the bounds.
static inline uint32_t sl_cell_grid_bucket(const sl_space *space, sl_point point) {
    const sl_box *b = &space->bounds;
    const sl_cell_grid *g = &space->grid;
    return sl_cell_grid_step(point.y, b->min.y, b->max.y, g->rows) * g->columns +
           sl_cell_grid_step(point.x, b->min.x, b->max.x, g->columns);
}

/// The buckets that a box meets, and the place among them.
typedef struct sl_cell_grid_range {
    uint32_t from_column, to_column, to_row; ///< the last ones too
    uint32_t column, row, entry;             ///< of the place; the entry from the bucket's first on
} sl_cell_grid_range;

/// At the start; of a box out of the bounds, the buckets nearest to it.
static inline sl_cell_grid_range sl_cell_grid_range_of(const sl_space *space, sl_box box) {
    const sl_box *b = &space->bounds;
    const sl_cell_grid *g = &space->grid;
    const double left = fmin(fmax(box.min.x, b->min.x), b->max.x);
    const double right = fmin(fmax(box.max.x, b->min.x), b->max.x);
    const double low = fmin(fmax(box.min.y, b->min.y), b->max.y);
    const double high = fmin(fmax(box.max.y, b->min.y), b->max.y);
    sl_cell_grid_range r = {.from_column = sl_cell_grid_step(left, b->min.x, b->max.x, g->columns),
                            .to_column = sl_cell_grid_step(right, b->min.x, b->max.x, g->columns),
                            .to_row = sl_cell_grid_step(high, b->min.y, b->max.y, g->rows),
                            .row = sl_cell_grid_step(low, b->min.y, b->max.y, g->rows)};
    r.column = r.from_column;
    return r;
}

/// The next cell that may meet the box; a cell may come several times. False behind the last.
static inline bool sl_cell_grid_next(const sl_cell_grid *g, sl_cell_grid_range *r, uint32_t *cell) {
    for (; r->row <= r->to_row; r->row++, r->column = r->from_column)
        for (; r->column <= r->to_column; r->column++, r->entry = 0) {
            const uint32_t bucket = r->row * g->columns + r->column;
            const uint32_t at = g->first[bucket] + r->entry;
            if (at == g->first[bucket + 1]) continue;
            r->entry++;
            *cell = g->cells[at];
            return true;
        }
    return false;
}

#endif
