/// A hall of pillars. Each stands near its place on a grid, but far enough from it to reach into
/// the lines of its neighbours: no straight aisle is left.
#include "generate/plot.h"

enum {
    PITCH = 16,
    SIDE_LEAST = 4,
    SIDE_MOST = 10,
    ASTRAY = 5,   // how far a pillar may be beyond its square: less than half of it
    APART = 1,    // the least way between two pillars
    ATTEMPTS = 8, // to find a place for one
};

static bool are_apart(sl_rect a, sl_rect b) {
    return a.x1 + APART <= b.x0 || b.x1 + APART <= a.x0 || a.y1 + APART <= b.y0 ||
           b.y1 + APART <= a.y0;
}

static int place(sl_plot *plot, int index, int count, int side) {
    const int low = index > 0 ? index * PITCH - ASTRAY : 0;
    const int high = (index + 1) * PITCH + (index + 1 < count ? ASTRAY : 0);
    return sl_pick(plot, low, high - side);
}

/// Whether a pillar keeps apart from those of the squares about its own that have one already.
static bool fits(const sl_plot *plot, const sl_rect *pillars, int column, int row, sl_rect pillar) {
    for (int y = row > 0 ? row - 1 : 0; y <= row; y++)
        for (int x = column > 0 ? column - 1 : 0; x <= column + 1 && x < plot->columns; x++) {
            const sl_rect *other = &pillars[(size_t)y * (size_t)plot->columns + (size_t)x];
            if (other->x1 && !are_apart(*other, pillar)) return false;
        }
    return true;
}

/// No pillar where there is no place found. `pillars` are zeroed where there is none yet.
static sl_status add_pillar(sl_plot *plot, sl_rect *pillars, int column, int row) {
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        const int width = sl_pick(plot, SIDE_LEAST, SIDE_MOST);
        const int height = sl_pick(plot, SIDE_LEAST, SIDE_MOST);
        const int x = place(plot, column, plot->columns, width);
        const int y = place(plot, row, plot->rows, height);
        const sl_rect pillar = {x, y, x + width, y + height};
        if (!fits(plot, pillars, column, row, pillar)) continue;
        pillars[(size_t)row * (size_t)plot->columns + (size_t)column] = pillar;
        return sl_plot_box(plot, pillar);
    }
    return SL_OK;
}

static sl_status lay(sl_plot *plot, sl_rect *pillars) {
    SL_TRY(sl_plot_box(plot, (sl_rect){0, 0, PITCH * plot->columns, PITCH * plot->rows}));
    for (int row = 0; row < plot->rows; row++) {
        // The first square is left free for the start.
        for (int column = row == 0; column < plot->columns; column++)
            SL_TRY(add_pillar(plot, pillars, column, row));
        SL_TRY(sl_plot_row_done(plot, row));
    }
    return sl_plot_start(plot, PITCH / 2.0, PITCH / 2.0);
}

sl_status sl_lay_pillars(sl_plot *plot) {
    const size_t count = (size_t)plot->columns * (size_t)plot->rows;
    sl_rect *pillars = sl_alloc_array(plot->context, count, sizeof *pillars);
    const sl_status status = pillars ? lay(plot, pillars) : SL_NO_MEMORY;
    sl_free(plot->context, pillars);
    return status;
}
