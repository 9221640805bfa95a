/// Grids of solid and open squares: plans, tiles, pixels. Their solid squares become few long
/// walls.
#ifndef SL_MAP_GRID_H
#define SL_MAP_GRID_H

#include "map/scan.h"

/// The most squares of a grid that is not spelt out in its file a character each.
#define SL_GRID_MOST ((size_t)1 << 28)

/// Rows of squares from the top down, of any lengths; a character a square, '#' solid, all others
/// open. What is not there is solid, or open where `open_neighbour` says so.
typedef struct sl_grid {
    sl_word *rows;
    size_t count;        ///< of the rows
    sl_point origin;     ///< the lower left corner of the last row's first square
    sl_point step;       ///< the size of a square, over 0
    uint32_t first_line; ///< the line that the first row has in its file; 0 where rows are no lines
    bool open_neighbour;
    char *squares; ///< of sl_grid_create: row after row, each `rows[0].length` long; else NULL
} sl_grid;

/// A grid of width x height open squares ('.') of size 1 at the origin, to be filled in through
/// `squares`. Both sides at least 1, SL_GRID_MOST squares at most: the caller has seen to it, and
/// calls sl_grid_destroy.
sl_status sl_grid_create(sl_context *context, size_t width, size_t height, sl_grid *grid);
/// Does nothing to one that is zeroed.
void sl_grid_destroy(sl_context *context, sl_grid *grid);

/// `row` and `column` may be one less than 0, as SIZE_MAX, or beyond the last.
static inline char sl_grid_square(const sl_grid *grid, size_t row, size_t column) {
    if (row < grid->count && column < grid->rows[row].length) return grid->rows[row].at[column];
    return grid->open_neighbour ? '.' : '#';
}

static inline bool sl_grid_solid(const sl_grid *grid, size_t row, size_t column) {
    return sl_grid_square(grid, row, column) == '#';
}

/// The place of a square's lower left corner; for row SIZE_MAX and column one behind the last, that
/// of the upper right corner of the squares next to them.
static inline sl_point sl_grid_corner(const sl_grid *grid, size_t row, size_t column) {
    return (sl_point){grid->origin.x + (double)column * grid->step.x,
                      grid->origin.y + (double)(grid->count - 1 - row) * grid->step.y};
}

/// Adds a wall for each longest straight piece of the boundary between solid and open squares, in
/// the order in which they end, from the top down. Each level or upright line has one coordinate,
/// computed once, so that walls in line are in line. Time O(squares).
sl_status sl_grid_add_walls(sl_context *context, const sl_grid *grid, sl_map *map);

#endif
