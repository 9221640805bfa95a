/// Grids of solid and open squares: plans, tiles, pixels. The borders of solid squares become a few
/// long walls.
#ifndef SL_MAP_GRID_H
#define SL_MAP_GRID_H

#include "map/scan.h"

/// The limit for grids whose file does not have one character for each square.
#define SLI_GRID_MOST ((size_t)1 << 28)

/// Rows of squares from the top down, of any lengths. Each square is a character: '#' is solid, all
/// others are open. Squares outside the rows are solid, or open with `open_outside`.
typedef struct sli_grid {
    sli_word *rows;
    size_t count;        ///< of the rows
    sl_point origin;     ///< the lower left corner of the last row's first square
    sl_point step;       ///< the size of a square, above 0
    uint32_t first_line; ///< the line of the first row in its file; 0 where rows are not lines
    bool open_outside;
    bool sure;     ///< open squares are open whatever else the map says: no other grid lies on them
    char *squares; ///< from sli_grid_create: row after row, each `rows[0].length` long; else NULL
} sli_grid;

/// A grid of width x height open squares ('.') of size 1 at the origin. Fill it in through
/// `squares`. The caller makes sure that both sides are at least 1, with at most SLI_GRID_MOST
/// squares, and calls sli_grid_destroy.
sl_status sli_grid_create(sl_context *context, size_t width, size_t height, sli_grid *grid);
/// Does nothing to a zeroed grid.
void sli_grid_destroy(sl_context *context, sli_grid *grid);

/// `row` and `column` may be one before the first (SIZE_MAX), or beyond the last.
static inline char sli_grid_square(const sli_grid *grid, size_t row, size_t column) {
    if (row < grid->count && column < grid->rows[row].length) return grid->rows[row].at[column];
    return grid->open_outside ? '.' : '#';
}

static inline bool sli_grid_solid(const sli_grid *grid, size_t row, size_t column) {
    return sli_grid_square(grid, row, column) == '#';
}

/// The lower left corner of a square. Row SIZE_MAX, or the column after the last, gives the upper
/// or right corner of the squares next to it.
static inline sl_point sli_grid_corner(const sli_grid *grid, size_t row, size_t column) {
    return (sl_point){grid->origin.x + (double)column * grid->step.x,
                      grid->origin.y + (double)(grid->count - 1 - row) * grid->step.y};
}

/// Adds a wall for each longest straight piece of the boundary between solid and open squares that
/// has the solid ones on one side, in the order in which they end, from the top down. The
/// coordinate of a line is computed once, so that walls in one line have equal coordinates. Time
/// O(squares).
sl_status sli_grid_add_walls(sl_context *context, const sli_grid *grid, sl_map *map);

#endif
