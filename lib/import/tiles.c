#include "import/tiles.h"

#include <math.h>

#define MOST_SQUARES ((size_t)1 << 26)
#define MOST_SIDE    1048576
#define MOST_GRIDS   4096
/// Tiles are counted from the first block of a grid; farther out they are on another grid.
#define FARTHEST 1e9

void sl_tiles_destroy(sl_context *context, sl_tiles *tiles) {
    for (size_t i = 0; i < tiles->blocks.count; i++)
        sl_free(context, tiles->blocks.items[i].squares);
    sl_free(context, tiles->blocks.items);
    *tiles = (sl_tiles){0};
}

/// Whether tiles of this size have corners of their own, up to `count` of them from `from` on, and
/// a grid of such tiles has usable coordinates.
static bool can_be_told_apart(double from, double step, size_t count) {
    const double to = from + step * (double)count;
    const double farthest = fmax(fabs(from), fabs(to));
    return step >= 1e-9 && farthest <= 1e15 && farthest / step <= 1e12;
}

sl_status sl_tiles_add(sl_context *context, sl_tiles *tiles, const char *name, sl_point corner,
                       sl_point step, size_t columns, size_t rows, char **squares) {
    if (columns > MOST_SQUARES / rows)
        return sl_fail_at(context, name, 0, "%zu x %zu tiles: more than 2^26", columns, rows);
    if (!can_be_told_apart(corner.x, step.x, columns) || !can_be_told_apart(corner.y, step.y, rows))
        return sl_fail_at(context, name, 0,
                          "%zu x %zu tiles of %g x %g pixels at %g %g: out of range", columns, rows,
                          step.x, step.y, corner.x, corner.y);
    SL_TRY(SL_ARRAY_ROOM(context, &tiles->blocks, 1));
    char *open = sl_alloc_array(context, rows, columns);
    if (!open) return SL_NO_MEMORY;
    memset(open, '.', rows * columns);
    tiles->blocks.items[tiles->blocks.count++] = (sl_tile_block){
        .corner = corner, .step = step, .columns = columns, .rows = rows, .squares = open};
    *squares = open;
    return SL_OK;
}

/// Where a block lies on the grid of the first one, in tiles; false where it is on another.
static bool place_on(const sl_tile_block *first, const sl_tile_block *block, double *column,
                     double *row) {
    if (block->step.x != first->step.x || block->step.y != first->step.y) return false;
    *column = (block->corner.x - first->corner.x) / first->step.x;
    *row = (block->corner.y - first->corner.y) / first->step.y;
    return floor(*column) == *column && floor(*row) == *row && fabs(*column) < FARTHEST &&
           fabs(*row) < FARTHEST;
}

/// The blocks of one grid: which they are, and the tiles that they span.
typedef struct span {
    const sl_tile_block *first;
    double left, top, right, bottom;
} span;

static span find_span(const sl_tiles *tiles, const sl_tile_block *first) {
    span all = {.first = first};
    for (size_t i = 0; i < tiles->blocks.count; i++) {
        const sl_tile_block *block = &tiles->blocks.items[i];
        double column, row;
        if (block->done || !place_on(first, block, &column, &row)) continue;
        all.left = fmin(all.left, column);
        all.top = fmin(all.top, row);
        all.right = fmax(all.right, column + (double)block->columns);
        all.bottom = fmax(all.bottom, row + (double)block->rows);
    }
    return all;
}

/// Puts one kind of square of a block in its place.
static void put(const sl_tile_block *block, size_t column, size_t row, char kind, sl_grid *grid) {
    const size_t width = grid->rows[0].length;
    for (size_t y = 0; y < block->rows; y++) {
        const char *from = block->squares + y * block->columns;
        char *to = grid->squares + (row + y) * width + column;
        for (size_t x = 0; x < block->columns; x++)
            if (kind == '.' || from[x] == kind) to[x] = kind;
    }
}

static void put_all(sl_tiles *tiles, const span *all, char kind, sl_grid *grid) {
    // The first block is what the others are held against: it is done last.
    const size_t first = (size_t)(all->first - tiles->blocks.items);
    for (size_t i = tiles->blocks.count; i-- > first;) {
        sl_tile_block *block = &tiles->blocks.items[i];
        double column, row;
        if (block->done || !place_on(all->first, block, &column, &row)) continue;
        put(block, (size_t)(column - all->left), (size_t)(row - all->top), kind, grid);
        block->done = kind == '#';
    }
}

static sl_status add_grid(sl_context *context, sl_tiles *tiles, const char *name, const span *all,
                          const sl_tiles_options *options, bool closed, sl_map *map) {
    const double width = all->right - all->left, height = all->bottom - all->top;
    if (!can_be_told_apart(options->top, all->first->step.y, 0))
        return sl_fail_at(context, name, 0, "its tiles are out of range: its lower edge is at %g",
                          options->top);
    if (width > MOST_SIDE || height > MOST_SIDE || width * height > (double)MOST_SQUARES)
        return sl_fail_at(
            context, name, 0,
            "its tiles are spread over %.0f x %.0f squares: more than 2^26, or 2^20 on a side",
            width, height);
    const sl_point step = all->first->step, corner = all->first->corner;
    sl_grid grid;
    SL_TRY(sl_grid_create(context, (size_t)width, (size_t)height, &grid));
    if (options->solid_between) {
        memset(grid.squares, '#', (size_t)width * (size_t)height);
        put_all(tiles, all, '.', &grid);
    }
    put_all(tiles, all, '#', &grid);
    grid.step = step;
    grid.origin =
        (sl_point){corner.x + all->left * step.x, options->top - (corner.y + all->bottom * step.y)};
    grid.open_outside = !closed;
    const sl_status status = sl_grid_add_walls(context, &grid, map);
    sl_grid_destroy(context, &grid);
    return status;
}

sl_status sl_tiles_add_walls(sl_context *context, sl_tiles *tiles, const char *name,
                             const sl_tiles_options *options, sl_map *map, size_t *grids) {
    size_t count = 0;
    for (size_t i = 0; i < tiles->blocks.count; i++) {
        if (tiles->blocks.items[i].done) continue;
        SL_TRY(sl_check_cancelled(context));
        if (count == MOST_GRIDS)
            return sl_fail_at(context, name, 0, "its layers lie on more than %d grids", MOST_GRIDS);
        const span all = find_span(tiles, &tiles->blocks.items[i]);
        const bool closed = count == 0 || options->all_closed;
        SL_TRY(add_grid(context, tiles, name, &all, options, closed, map));
        count++;
    }
    *grids = count;
    return SL_OK;
}
