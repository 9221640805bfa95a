#include "generate/plot.h"

#include <assert.h>

int sl_pick(sl_plot *plot, int low, int high) {
    assert(low <= high);
    return low + (int)sl_random_below(&plot->random, (uint64_t)(high - low) + 1);
}

bool sl_chance(sl_plot *plot, int percent) {
    return sl_random_below(&plot->random, 100) < (uint64_t)percent;
}

sl_status sl_plot_wall(sl_plot *plot, sl_run run) {
    if (run.low >= run.high) return SL_OK;
    sl_point a = {run.at, run.low}, b = {run.at, run.high};
    if (!run.upright) {
        a = (sl_point){run.low, run.at};
        b = (sl_point){run.high, run.at};
    }
    return sl_map_add_wall(plot->context, plot->map, a, b, 0);
}

sl_status sl_plot_wall_open(sl_plot *plot, sl_run run, int low, int high) {
    assert(run.low <= low && low < high && high <= run.high);
    SL_TRY(sl_plot_wall(plot, (sl_run){run.upright, run.at, run.low, low}));
    return sl_plot_wall(plot, (sl_run){run.upright, run.at, high, run.high});
}

sl_status sl_plot_wall_door(sl_plot *plot, sl_run run) {
    const int door = sl_pick(plot, run.low, run.high - 1);
    return sl_plot_wall_open(plot, run, door, door + 1);
}

sl_run sl_side_of(sl_rect rect, sl_side side) {
    switch (side) {
    case SL_LEFT:
        return (sl_run){true, rect.x0, rect.y0, rect.y1};
    case SL_RIGHT:
        return (sl_run){true, rect.x1, rect.y0, rect.y1};
    case SL_BOTTOM:
        return (sl_run){false, rect.y0, rect.x0, rect.x1};
    default:
        return (sl_run){false, rect.y1, rect.x0, rect.x1};
    }
}

sl_status sl_plot_box(sl_plot *plot, sl_rect rect) {
    for (sl_side side = 0; side < SL_SIDES; side++)
        SL_TRY(sl_plot_wall(plot, sl_side_of(rect, side)));
    return SL_OK;
}

sl_status sl_plot_start(sl_plot *plot, double x, double y) {
    return sl_map_add_start(plot->context, plot->map, (sl_point){x, y}, 0, 0);
}

sl_status sl_plot_row_done(sl_plot *plot, int row) {
    sl_report(plot->context, "generate", "rows", (uint64_t)row + 1, (uint64_t)plot->rows);
    return sl_check_cancelled(plot->context);
}

sl_status sl_plot_rooms(sl_plot *plot, sl_rect rect, int least) {
    const int width = rect.x1 - rect.x0, height = rect.y1 - rect.y0;
    const bool wide = width >= 2 * least, high = height >= 2 * least;
    if (!wide && !high) return SL_OK;
    // Some rooms are left large.
    if (width * height <= 6 * least * least && sl_chance(plot, 35)) return SL_OK;
    const bool upright =
        wide && (!high || width > height || (width == height && sl_chance(plot, 50)));
    sl_rect first = rect, second = rect;
    if (upright)
        first.x1 = second.x0 = sl_pick(plot, rect.x0 + least, rect.x1 - least);
    else
        first.y1 = second.y0 = sl_pick(plot, rect.y0 + least, rect.y1 - least);
    SL_TRY(sl_plot_wall_door(plot, sl_side_of(first, upright ? SL_RIGHT : SL_TOP)));
    SL_TRY(sl_plot_rooms(plot, first, least));
    return sl_plot_rooms(plot, second, least);
}
