/// An office floor: rows of wings. Along the middle of a wing goes a corridor, at its side another
/// one across, about them are rooms. No two corridors are in line for long, so that what is seen
/// from one does not grow with the floor.
#include "generate/plot.h"

#include <string.h>

enum {
    CORRIDOR = 2,
    ROOM_LEAST = 3,
    ROOM_MOST = 9,
    DEPTH_LEAST = 5, // of the rooms on either side of the corridor
};

/// Rooms in a line, each with its door on the side that the corridor is on.
static sl_status lay_row_of_rooms(sl_plot *plot, sl_rect rect, sl_side door_side) {
    for (int x = rect.x0; x < rect.x1;) {
        int end = x + sl_pick(plot, ROOM_LEAST, ROOM_MOST);
        if (end > rect.x1 - ROOM_LEAST) end = rect.x1;
        const sl_rect room = {x, rect.y0, end, rect.y1};
        const sl_run front = sl_side_of(room, door_side);
        // A wide one may be a lounge, open to the corridor.
        if (end - x > 6 && sl_chance(plot, 30))
            SL_TRY(sl_plot_wall_open(plot, front, x + 2, end - 2));
        else
            SL_TRY(sl_plot_wall_door(plot, front));
        if (end < rect.x1) {
            const sl_run side = sl_side_of(room, SL_RIGHT);
            SL_TRY(sl_chance(plot, 20) ? sl_plot_wall_door(plot, side) : sl_plot_wall(plot, side));
        }
        x = end;
    }
    return SL_OK;
}

/// An open-plan office: one room, with desks as T-shaped screens.
static sl_status lay_open_plan(sl_plot *plot, sl_rect rect, sl_side door_side) {
    const sl_run front = sl_side_of(rect, door_side);
    const int door = sl_pick(plot, front.low + 1, front.high - 4);
    SL_TRY(sl_plot_wall_open(plot, front, door, door + 3));
    const int y = (rect.y0 + rect.y1) / 2;
    for (int x = rect.x0 + 2; x + 3 <= rect.x1 - 1; x += 5) {
        SL_TRY(sl_plot_wall(plot, (sl_run){false, y, x, x + 3}));
        const int end = sl_chance(plot, 50) ? y - 1 : y + 1;
        SL_TRY(sl_plot_wall(
            plot, (sl_run){true, sl_pick(plot, x, x + 3), end < y ? end : y, end < y ? y : end}));
    }
    return SL_OK;
}

static sl_status lay_band(sl_plot *plot, sl_rect rect, sl_side door_side) {
    return sl_chance(plot, 15) ? lay_open_plan(plot, rect, door_side)
                               : lay_row_of_rooms(plot, rect, door_side);
}

/// A wing without the corridor at its side; its own corridor's ends are open. *corridor is where
/// that lies.
static sl_status lay_wing(sl_plot *plot, sl_rect rect, int *corridor) {
    const int y = sl_pick(plot, rect.y0 + DEPTH_LEAST, rect.y1 - DEPTH_LEAST - CORRIDOR);
    *corridor = y;
    for (sl_side side = SL_LEFT; side <= SL_RIGHT; side++)
        SL_TRY(sl_plot_wall_open(plot, sl_side_of(rect, side), y, y + CORRIDOR));
    SL_TRY(lay_band(plot, (sl_rect){rect.x0, rect.y0, rect.x1, y}, SL_TOP));
    return lay_band(plot, (sl_rect){rect.x0, y + CORRIDOR, rect.x1, rect.y1}, SL_BOTTOM);
}

/// A floor while it is laid out: for each unit of its width, whether a door is there in the wall
/// below the row at hand, and in the wall above it.
typedef struct floor_plan {
    sl_plot *plot;
    int x, y, wings, rows, width;
    uint8_t *below, *above;
} floor_plan;

/// The corridor at the side of a wing leads by a door at its lower end into whatever lies in the
/// row below, and often by one at its upper end into the row above.
static void cut_doors(floor_plan *f, int corridor, int row) {
    const int from = corridor - f->x;
    if (row > 0) f->below[from + sl_pick(f->plot, 0, CORRIDOR - 1)] = 1;
    if (row + 1 < f->rows && sl_chance(f->plot, 60))
        f->above[from + sl_pick(f->plot, 0, CORRIDOR - 1)] = 1;
}

/// Corridors are at the right of their wings in one row and at the left in the next.
static sl_status lay_row(floor_plan *f, int row) {
    const bool at_right = row % 2 == 0;
    const int y = f->y + row * SL_WING_HEIGHT;
    int from = f->x;
    for (int i = 0; i < f->wings; i++) {
        int end = f->x + (i + 1) * SL_WING_WIDTH, corridor;
        const bool last = i + 1 == f->wings;
        if (at_right) {
            corridor = end - CORRIDOR - (last ? 0 : sl_pick(f->plot, 0, 6));
            end = corridor;
        } else {
            corridor = from;
            from += CORRIDOR;
            end -= last ? 0 : sl_pick(f->plot, 0, 6);
        }
        cut_doors(f, corridor, row);
        int middle;
        SL_TRY(lay_wing(f->plot, (sl_rect){from, y, end, y + SL_WING_HEIGHT}, &middle));
        if (row == 0 && i == 0) SL_TRY(sl_plot_start(f->plot, from + 1, middle + CORRIDOR / 2.0));
        from = at_right ? end + CORRIDOR : end;
    }
    return SL_OK;
}

/// The wall below a row, but for its doors.
static sl_status add_wall_below(const floor_plan *f, int row) {
    int low = 0;
    for (int i = 0; i <= f->width; i++) {
        if (i < f->width && !f->below[i]) continue;
        SL_TRY(sl_plot_wall(f->plot,
                            (sl_run){false, f->y + row * SL_WING_HEIGHT, f->x + low, f->x + i}));
        low = i + 1;
    }
    return SL_OK;
}

static sl_status lay_rows(floor_plan *f) {
    const int height = f->rows * SL_WING_HEIGHT;
    SL_TRY(sl_plot_box(f->plot, (sl_rect){f->x, f->y, f->x + f->width, f->y + height}));
    for (int row = 0; row < f->rows; row++) {
        memset(f->above, 0, (size_t)f->width);
        SL_TRY(lay_row(f, row));
        if (row > 0) SL_TRY(add_wall_below(f, row));
        uint8_t *swapped = f->below;
        f->below = f->above;
        f->above = swapped;
        SL_TRY(sl_check_cancelled(f->plot->context));
    }
    return SL_OK;
}

sl_status sl_plot_floor(sl_plot *plot, int x, int y, int wings, int rows) {
    floor_plan f = {.plot = plot, .x = x, .y = y, .wings = wings, .rows = rows};
    f.width = wings * SL_WING_WIDTH;
    f.below = sl_alloc_array(plot->context, (size_t)f.width, 1);
    f.above = sl_alloc_array(plot->context, (size_t)f.width, 1);
    const sl_status status = f.below && f.above ? lay_rows(&f) : SL_NO_MEMORY;
    sl_free(plot->context, f.below);
    sl_free(plot->context, f.above);
    return status;
}

sl_status sl_lay_office(sl_plot *plot) {
    return sl_plot_floor(plot, 0, 0, plot->columns, plot->rows);
}
