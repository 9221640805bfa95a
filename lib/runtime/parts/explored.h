/// What was explored: the tiles of a grid.

// The triangles of the eye and an edge each cover a visible polygon. In a row of tiles a triangle
// has one run of middles.

SL_RUNTIME_API sl_runtime_grid sl_runtime_grid_over(const sl_runtime *runtime, double tile) {
    const double wide = (runtime->max_x - runtime->min_x) / tile;
    const double high = (runtime->max_y - runtime->min_y) / tile;
    sl_runtime_grid grid;
    memset(&grid, 0, sizeof grid);
    grid.min_x = runtime->min_x;
    grid.min_y = runtime->min_y;
    grid.tile = tile;
    if (!(tile > 0) || !(wide < 2147483647.0) || !((wide + 1) * (high + 1) < 2147483648.0))
        return grid;
    grid.columns = (uint32_t)wide + ((uint32_t)wide < wide);
    grid.rows = (uint32_t)high + ((uint32_t)high < high);
    return grid;
}

/// The first tile of `count` along an axis whose middle is not before a place.
static uint32_t slrt_first_tile(double place, double min, double tile, uint32_t count) {
    const double at = (place - min) / tile - 0.5;
    if (!(at > 0)) return 0;
    if (at >= count) return count;
    return (uint32_t)at + ((uint32_t)at < at);
}

/// Widens a run by where an edge of a triangle crosses a line at a height.
static void slrt_widen_run(const double *a, const double *b, double y, double *low, double *high) {
    double x = a[0];
    if ((a[1] < y && b[1] < y) || (a[1] > y && b[1] > y)) return;
    if (a[1] != b[1]) x += (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    if (x < *low) *low = x;
    if (x > *high) *high = x;
    if (a[1] != b[1]) return;
    if (b[0] < *low) *low = b[0];
    if (b[0] > *high) *high = b[0];
}

static uint32_t slrt_explore_row(const sl_runtime_grid *grid, uint32_t row, double low,
                                 double high) {
    uint32_t i = slrt_first_tile(low, grid->min_x, grid->tile, grid->columns), found = 0;
    for (; i < grid->columns && grid->min_x + (i + 0.5) * grid->tile <= high; i++) {
        const size_t n = (size_t)row * grid->columns + i;
        found += !(grid->bits[n / 8] >> n % 8 & 1);
        grid->bits[n / 8] |= (unsigned char)(1 << n % 8);
    }
    return found;
}

SL_RUNTIME_API uint32_t sl_runtime_explore(const sl_runtime_grid *grid, double x, double y,
                                           const double *points, uint32_t count) {
    double eye[2];
    uint32_t i, row, found = 0;
    eye[0] = x;
    eye[1] = y;
    for (i = 0; i < count; i++) {
        const double *a = points + 2 * (size_t)i, *b = i + 1 < count ? a + 2 : points;
        double bottom = a[1] < b[1] ? a[1] : b[1], top = a[1] < b[1] ? b[1] : a[1];
        if (y < bottom) bottom = y;
        if (y > top) top = y;
        row = slrt_first_tile(bottom, grid->min_y, grid->tile, grid->rows);
        for (; row < grid->rows; row++) {
            const double middle = grid->min_y + (row + 0.5) * grid->tile;
            double low = DBL_MAX, high = -DBL_MAX;
            if (middle > top) break;
            slrt_widen_run(eye, a, middle, &low, &high);
            slrt_widen_run(a, b, middle, &low, &high);
            slrt_widen_run(b, eye, middle, &low, &high);
            if (low <= high) found += slrt_explore_row(grid, row, low, high);
        }
    }
    return found;
}
