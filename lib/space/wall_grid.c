#include "space/wall_grid.h"

#include <math.h>

/// What rounding may add to a computed place, as a share of the map's size.
#define SLACK 0x1p-40

void sl_wall_grid_destroy(sl_context *context, sl_wall_grid *grid) {
    sl_free(context, grid->offsets);
    sl_free(context, grid->walls);
    *grid = (sl_wall_grid){0};
}

/// About a square a wall, and none smaller than what is looked for.
static void choose_step(const sl_map *map, double reach, sl_wall_grid *grid) {
    const double width = grid->bounds.max.x - grid->bounds.min.x;
    const double height = grid->bounds.max.y - grid->bounds.min.y;
    const double longer = fmax(width, height);
    const double wanted = sqrt((double)map->wall_count) + 1;
    grid->step = fmax(fmax(longer / fmin(wanted, 2048), 2 * reach), longer * 0x1p-11);
    if (!(grid->step > 0)) grid->step = 1;
    grid->columns = (uint32_t)(width / grid->step) + 1;
    grid->rows = (uint32_t)(height / grid->step) + 1;
}

static uint32_t index_of(double offset, double step, uint32_t count) {
    const double at = floor(offset / step);
    return at <= 0 ? 0 : at >= count - 1 ? count - 1 : (uint32_t)at;
}

/// Puts a wall into its squares, column by column; only counts them where there is no room yet.
static void put_wall(sl_wall_grid *grid, const sl_wall *wall, uint32_t number, double reach) {
    const sl_point base = grid->bounds.min;
    const bool right = wall->b.x >= wall->a.x;
    const sl_point a = right ? wall->a : wall->b, b = right ? wall->b : wall->a;
    const uint32_t first = index_of(a.x - reach - base.x, grid->step, grid->columns);
    const uint32_t last = index_of(b.x + reach - base.x, grid->step, grid->columns);
    const double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
    for (uint32_t column = first; column <= last; column++) {
        const double from = fmax(a.x, base.x + column * grid->step - reach);
        const double to = fmin(b.x, base.x + (column + 1) * grid->step + reach);
        double low = fmin(a.y, b.y), high = fmax(a.y, b.y);
        if (slope != 0) {
            const double y0 = a.y + (from - a.x) * slope, y1 = a.y + (to - a.x) * slope;
            low = fmax(low, fmin(y0, y1));
            high = fmin(high, fmax(y0, y1));
        }
        const uint32_t bottom = index_of(low - reach - base.y, grid->step, grid->rows);
        const uint32_t top = index_of(high + reach - base.y, grid->step, grid->rows);
        for (uint32_t row = bottom; row <= top; row++) {
            uint32_t *place = &grid->offsets[(size_t)row * grid->columns + column + 1];
            if (grid->walls) grid->walls[*place] = number;
            ++*place;
        }
    }
}

sl_status sl_wall_grid_create(sl_context *context, const sl_map *map, double reach,
                              sl_wall_grid *out) {
    sl_wall_grid grid = {.bounds = sl_map_bounds(map)};
    choose_step(map, reach, &grid);
    const size_t squares = (size_t)grid.columns * grid.rows;
    const sl_point min = grid.bounds.min, max = grid.bounds.max;
    reach += SLACK * (fabs(min.x) + fabs(min.y) + fabs(max.x) + fabs(max.y));
    grid.offsets = sl_alloc_array(context, squares + 1, sizeof *grid.offsets);
    if (!grid.offsets) return SL_NO_MEMORY;
    for (size_t i = 0; i < map->wall_count; i++)
        put_wall(&grid, &map->walls[i], (uint32_t)i, reach);
    uint64_t sum = 0;
    for (size_t i = 0; i < squares; i++) {
        const uint32_t count = grid.offsets[i + 1];
        grid.offsets[i + 1] = (uint32_t)sum;
        sum += count;
    }
    grid.walls = sum <= UINT32_MAX ? sl_alloc_array(context, sum, sizeof *grid.walls) : NULL;
    if (!grid.walls) {
        sl_free(context, grid.offsets);
        return sl_fail_memory(context);
    }
    for (size_t i = 0; i < map->wall_count; i++)
        put_wall(&grid, &map->walls[i], (uint32_t)i, reach);
    *out = grid;
    return SL_OK;
}
