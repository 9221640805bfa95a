/// The buckets that locate a point in a mesh.
#ifndef SL_SPACE_CELL_GRID_H
#define SL_SPACE_CELL_GRID_H

#include "sightline/space.h"

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

#endif
