#include "map/grid.h"

#define NONE SIZE_MAX

sl_status sl_grid_create(sl_context *context, size_t width, size_t height, sl_grid *grid) {
    sl_word *rows = sl_alloc_array(context, height, sizeof *rows);
    char *squares = sl_alloc_array(context, height, width);
    if (!rows || !squares) {
        sl_free(context, rows);
        sl_free(context, squares);
        return SL_NO_MEMORY;
    }
    memset(squares, '.', width * height);
    for (size_t row = 0; row < height; row++) rows[row] = (sl_word){squares + row * width, width};
    *grid = (sl_grid){.rows = rows, .count = height, .step = {1, 1}, .squares = squares};
    return SL_OK;
}

void sl_grid_destroy(sl_context *context, sl_grid *grid) {
    sl_free(context, grid->rows);
    sl_free(context, grid->squares);
    *grid = (sl_grid){0};
}

static size_t row_length(const sl_grid *grid, size_t row) {
    return row < grid->count ? grid->rows[row].length : 0;
}

/// How many columns can differ from what is beyond, in a row or in the one above it.
static size_t columns_about(const sl_grid *grid, size_t row) {
    const size_t above = row_length(grid, row - 1), here = row_length(grid, row);
    return above > here ? above : here;
}

static uint32_t line_of(const sl_grid *grid, size_t row) {
    if (!grid->first_line) return 0;
    return grid->first_line + (uint32_t)(row < grid->count ? row : row - 1);
}

/// The walls between a row and the one above it; `row` may be one behind the last.
static sl_status add_level(sl_context *context, const sl_grid *grid, size_t row, sl_map *map) {
    const size_t length = columns_about(grid, row);
    for (size_t column = 0, first = NONE; column <= length; column++) {
        const bool wall = sl_grid_solid(grid, row - 1, column) != sl_grid_solid(grid, row, column);
        if (wall && first == NONE) first = column;
        if (wall || first == NONE) continue;
        SL_TRY(sl_map_add_wall(context, map, sl_grid_corner(grid, row - 1, first),
                               sl_grid_corner(grid, row - 1, column), line_of(grid, row)));
        first = NONE;
    }
    return SL_OK;
}

/// Begins and ends the walls between the columns of a row; one behind the last ends them all.
/// `open_runs` has for each column's left edge the row where its wall begins, or NONE.
static sl_status add_uprights(sl_context *context, const sl_grid *grid, size_t row,
                              size_t *open_runs, sl_map *map) {
    const size_t length = columns_about(grid, row);
    for (size_t column = 0; column <= length; column++) {
        size_t *first = &open_runs[column];
        const bool wall = sl_grid_solid(grid, row, column - 1) != sl_grid_solid(grid, row, column);
        if (wall && *first == NONE) *first = row;
        if (wall || *first == NONE) continue;
        SL_TRY(sl_map_add_wall(context, map, sl_grid_corner(grid, row - 1, column),
                               sl_grid_corner(grid, *first - 1, column), line_of(grid, *first)));
        *first = NONE;
    }
    return SL_OK;
}

sl_status sl_grid_add_walls(sl_context *context, const sl_grid *grid, sl_map *map) {
    size_t width = 0;
    for (size_t row = 0; row < grid->count; row++)
        if (grid->rows[row].length > width) width = grid->rows[row].length;
    size_t *open_runs = sl_alloc_array(context, width + 1, sizeof *open_runs);
    if (!open_runs) return SL_NO_MEMORY;
    for (size_t column = 0; column <= width; column++) open_runs[column] = NONE;
    sl_status status = SL_OK;
    for (size_t row = 0; status == SL_OK && row <= grid->count; row++) {
        if (row % 256 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK) status = add_level(context, grid, row, map);
        if (status == SL_OK) status = add_uprights(context, grid, row, open_runs, map);
    }
    sl_free(context, open_runs);
    return status;
}
