/// A uniform grid over walls: those near a place, without asking all.
#ifndef SL_SPACE_WALL_GRID_H
#define SL_SPACE_WALL_GRID_H

#include "sightline/map.h"
#include "sightline/support.h"

typedef struct sl_wall_grid {
    sl_box bounds;
    double step;
    uint32_t columns, rows;
    uint32_t *offsets; ///< by square, row after row, one more at the end
    uint32_t *walls;   ///< a wall is in each square that it comes as near to as `reach`, or nearer
} sl_wall_grid;

sl_status sl_wall_grid_create(sl_context *context, const sl_map *map, double reach,
                              sl_wall_grid *out);
void sl_wall_grid_destroy(sl_context *context, sl_wall_grid *grid);

/// The squares' walls about a point within the bounds: all that are within `reach` of it.
static inline const uint32_t *sl_wall_grid_at(const sl_wall_grid *grid, sl_point point,
                                              uint32_t *count) {
    double x = (point.x - grid->bounds.min.x) / grid->step;
    double y = (point.y - grid->bounds.min.y) / grid->step;
    if (!(x >= 0)) x = 0;
    if (!(y >= 0)) y = 0;
    const uint32_t column = x < grid->columns - 1 ? (uint32_t)x : grid->columns - 1;
    const uint32_t row = y < grid->rows - 1 ? (uint32_t)y : grid->rows - 1;
    const uint32_t square = row * grid->columns + column;
    *count = grid->offsets[square + 1] - grid->offsets[square];
    return grid->walls + grid->offsets[square];
}

#endif
