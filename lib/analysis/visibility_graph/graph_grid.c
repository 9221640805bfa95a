/// The grid of visibility graph analysis: which points of a regular grid belong to the plan.
///
/// From a seed the grid is flooded through free steps: a step leads from a point to the one above,
/// below, left or right of it, if the segment between them meets no wall (sli_sees, open sight). So
/// points in other rooms are reached through doors only, and a point on a wall is never reached.
/// depthmapX fills its grids in the same way, with its own rounding. Points lie at multiples of the
/// step, as its points do.
///
/// Cost: one test of sight for each step, O(points).
#include "sightline/vga.h"

#include "sight/region.h"
#include "sightline/support.h"

#include <math.h>

void sl_vga_grid_destroy(sl_context *context, sl_vga_grid *grid) {
    sl_free(context, grid->points);
    sl_free(context, grid->squares);
    *grid = (sl_vga_grid){0};
}

typedef struct flood {
    sl_context *context;
    const sl_outline *outline;
    sl_vga_grid *grid;
    sl_bits *taken;
    SL_ARRAY(uint32_t) waiting; ///< squares
} flood;

static sl_point point_of(const sl_vga_grid *grid, uint32_t square) {
    return (sl_point){(double)(grid->left + square / grid->rows) * grid->step,
                      (double)(grid->bottom + square % grid->rows) * grid->step};
}

/// Refuses grids that are too large, before more of them is filled.
static sl_status take(flood *f, uint32_t square) {
    if (sl_bits_has(f->taken, square)) return SL_OK;
    if (f->grid->count == SL_VGA_POINTS_MOST)
        return sl_fail(
            f->context, SL_BAD_ARGUMENT,
            "a grid step of %.9g gives more than %u points, too many for a graph; choose "
            "a larger step",
            f->grid->step, SL_VGA_POINTS_MOST);
    SL_TRY(SL_ARRAY_ROOM(f->context, &f->waiting, 1));
    sl_bits_add(f->taken, square);
    f->waiting.items[f->waiting.count++] = square;
    f->grid->count++;
    return SL_OK;
}

static sl_status step_to(flood *f, uint32_t from, uint32_t to) {
    bool free_step;
    if (sl_bits_has(f->taken, to)) return SL_OK;
    SL_TRY(sli_sees(f->context, f->outline, point_of(f->grid, from), point_of(f->grid, to), SL_OPEN,
                    &free_step));
    return free_step ? take(f, to) : SL_OK;
}

static sl_status spread(flood *f) {
    const uint32_t rows = f->grid->rows, columns = f->grid->columns;
    for (uint64_t done = 0; f->waiting.count; done++) {
        const uint32_t square = f->waiting.items[--f->waiting.count];
        const uint32_t column = square / rows, row = square % rows;
        if (done % 4096 == 0) SL_TRY(sl_check_cancelled(f->context));
        if (column > 0) SL_TRY(step_to(f, square, square - rows));
        if (column + 1 < columns) SL_TRY(step_to(f, square, square + rows));
        if (row > 0) SL_TRY(step_to(f, square, square - 1));
        if (row + 1 < rows) SL_TRY(step_to(f, square, square + 1));
    }
    return SL_OK;
}

/// Takes all points inside. sli_sees from a point to itself, with open sight, says whether it is on
/// a wall.
static sl_status take_inside(flood *f) {
    const sl_space *space = f->outline->space;
    const uint32_t squares = f->grid->columns * f->grid->rows;
    for (uint32_t s = 0; s < squares; s++) {
        const sl_point at = point_of(f->grid, s);
        const uint32_t cell = sl_space_locate(space, at);
        bool is_free = false;
        if (s % 4096 == 0) SL_TRY(sl_check_cancelled(f->context));
        if (cell != SL_NO_CELL && space->cells[cell].inside)
            SL_TRY(sli_sees(f->context, f->outline, at, at, SL_OPEN, &is_free));
        if (is_free) SL_TRY(take(f, s));
    }
    return SL_OK;
}

static sl_status take_seeds(flood *f, const sl_point *seeds, size_t count) {
    const sl_vga_grid *grid = f->grid;
    for (size_t i = 0; i < count; i++) {
        const double column = round(seeds[i].x / grid->step) - (double)grid->left;
        const double row = round(seeds[i].y / grid->step) - (double)grid->bottom;
        if (!(column >= 0 && column < grid->columns && row >= 0 && row < grid->rows))
            return sl_fail(f->context, SL_BAD_ARGUMENT,
                           "%.9g,%.9g is outside the map; choose a point in a room", seeds[i].x,
                           seeds[i].y);
        SL_TRY(take(f, (uint32_t)column * grid->rows + (uint32_t)row));
    }
    return spread(f);
}

static sl_status list_points(sl_context *context, const sl_bits *taken, sl_vga_grid *grid) {
    grid->points = sl_alloc_array(context, grid->count, sizeof *grid->points);
    grid->squares = sl_alloc_array(context, grid->count, sizeof *grid->squares);
    if (!grid->points || !grid->squares) return SL_NO_MEMORY;
    uint32_t count = 0;
    for (uint32_t s = 0; s < grid->columns * grid->rows; s++) {
        if (!sl_bits_has(taken, s)) continue;
        grid->points[count] = point_of(grid, s);
        grid->squares[count++] = s;
    }
    return SL_OK;
}

/// The squares whose points lie within the bounds.
static sl_status lay(sl_context *context, sl_box bounds, double step, sl_vga_grid *grid) {
    const double left = ceil(bounds.min.x / step), right = floor(bounds.max.x / step);
    const double bottom = ceil(bounds.min.y / step), top = floor(bounds.max.y / step);
    const double columns = right - left + 1, rows = top - bottom + 1;
    if (!(step > 0) || !isfinite(step))
        return sl_fail(context, SL_BAD_ARGUMENT, "a grid step over 0 is needed");
    if (fabs(left) > 1e15 || fabs(bottom) > 1e15 || columns * rows > 2147483648.0)
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "a grid step of %g gives too many points for a map of %g by %g", step,
                       bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
    grid->step = step;
    grid->left = (int64_t)left;
    grid->bottom = (int64_t)bottom;
    grid->columns = columns > 0 && rows > 0 ? (uint32_t)columns : 0;
    grid->rows = grid->columns ? (uint32_t)rows : 0;
    return SL_OK;
}

sl_status sl_vga_grid_make(sl_context *context, const sl_outline *outline, double step,
                           const sl_point *seeds, size_t seed_count, sl_vga_grid *out) {
    sl_vga_grid grid = {0};
    SL_TRY(lay(context, outline->space->bounds, step, &grid));
    const size_t squares = (size_t)grid.columns * grid.rows;
    flood f = {.context = context, .outline = outline, .grid = &grid};
    f.taken = sl_alloc_array(context, sl_bits_words(squares), sizeof *f.taken);
    sl_status status = f.taken ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = seed_count ? take_seeds(&f, seeds, seed_count) : take_inside(&f);
    if (status == SL_OK) status = list_points(context, f.taken, &grid);
    if (status == SL_OK)
        *out = grid;
    else
        sl_vga_grid_destroy(context, &grid);
    sl_free(context, f.taken);
    sl_free(context, f.waiting.items);
    return status;
}

// --- a part of a grid

void sl_vga_grid_keep(sl_vga_grid *grid, const uint64_t *kept) {
    uint32_t count = 0;
    for (uint32_t p = 0; p < grid->count; p++) {
        if (!sl_bits_has(kept, p)) continue;
        grid->points[count] = grid->points[p];
        grid->squares[count++] = grid->squares[p];
    }
    grid->count = count;
}

sl_status sl_vga_grid_border(sl_context *context, const sl_vga_grid *grid, uint64_t *border) {
    const size_t columns = grid->columns, rows = grid->rows;
    sl_bits *taken = sl_alloc_array(context, sl_bits_words(columns * rows), sizeof *taken);
    if (!taken) return SL_NO_MEMORY;
    for (uint32_t p = 0; p < grid->count; p++) sl_bits_add(taken, grid->squares[p]);
    for (uint32_t p = 0; p < grid->count; p++) {
        const size_t column = grid->squares[p] / rows, row = grid->squares[p] % rows;
        bool whole = column > 0 && row > 0 && column + 1 < columns && row + 1 < rows;
        for (size_t k = 0; k < 9 && whole; k++)
            whole = sl_bits_has(taken, (column + k / 3 - 1) * rows + row + k % 3 - 1);
        if (!whole) sl_bits_add(border, p);
    }
    sl_free(context, taken);
    return SL_OK;
}

uint32_t sl_vga_grid_find(const sl_vga_grid *grid, sl_point place) {
    const double column = round(place.x / grid->step) - (double)grid->left;
    const double row = round(place.y / grid->step) - (double)grid->bottom;
    if (!(column >= 0 && column < grid->columns && row >= 0 && row < grid->rows)) return UINT32_MAX;
    const uint32_t square = (uint32_t)column * grid->rows + (uint32_t)row;
    uint32_t low = 0, high = grid->count;
    while (low < high) { // squares ascend
        const uint32_t middle = low + (high - low) / 2;
        if (grid->squares[middle] < square)
            low = middle + 1;
        else
            high = middle;
    }
    return low < grid->count && grid->squares[low] == square ? low : UINT32_MAX;
}
