/// Maps of houses.
///
/// City: an old town. Where two streets cross, one of them is broken: it goes on a few steps aside,
/// so that nobody looks down a street for long. Blocks are houses with rooms and doors to the
/// street, houses about a court, or parks.
///
/// Office: rows of wings. A corridor goes along the middle of a wing, another one across at its
/// side, and rooms lie about them. No two corridors are in line for long, so that what is seen from
/// one does not grow with the floor. Tower: such floors side by side; no sight goes from one to
/// another.
#include "study/generate/plot.h"

#include <string.h>

// --- a city

enum {
    PITCH = 24,     // of the blocks
    STREET = 3,     // its width
    ASIDE = 5,      // the farthest that a street is off its place
    BREAK = 4,      // where it is broken, how far its parts are apart at least
    HOUSE_ROOM = 3, // the least width of a room
    COURT = 5,      // the depth of a house about a court
    COURT_LEAST = 2 * COURT + 4,
};

/// The streets. along[j * columns + i] is how far the level street below block (i, j) is off its
/// place; across[j * columns + i] is the same for the upright street at its left.
typedef struct town {
    sli_plot *plot;
    int *along, *across;
} town;

/// A block or a part of it, and on which sides there is a street.
typedef struct block {
    sli_rect rect;
    bool street[SLI_SIDES];
    bool corner; ///< in a corner of the town
} block;

// --- streets

static int aside_from(sli_plot *plot, int old) {
    const bool down = old > ASIDE - BREAK || (old >= BREAK - ASIDE && sli_chance(plot, 50));
    return down ? sli_pick(plot, -ASIDE, old - BREAK) : sli_pick(plot, old + BREAK, ASIDE);
}

/// At each crossing one street keeps its line. The corners of the four blocks about it then keep
/// apart.
static void place_streets(town *t) {
    sli_plot *plot = t->plot;
    const size_t columns = (size_t)plot->columns;
    for (size_t i = 1; i < columns; i++) t->across[i] = sli_pick(plot, -ASIDE, ASIDE);
    for (size_t j = 1; j < (size_t)plot->rows; j++) {
        t->along[j * columns] = sli_pick(plot, -ASIDE, ASIDE);
        for (size_t i = 1; i < columns; i++) {
            const size_t at = j * columns + i;
            const int west = t->along[at - 1], south = t->across[at - columns];
            const bool broken_along = sli_chance(plot, 50);
            t->along[at] = broken_along ? aside_from(plot, west) : west;
            t->across[at] = broken_along ? south : aside_from(plot, south);
        }
    }
}

/// The block (i, j); at the town's border no street is between it and the town's wall.
static block block_at(const town *t, int i, int j) {
    const int columns = t->plot->columns, rows = t->plot->rows, at = j * columns + i;
    block b = {.rect = {i * PITCH, j * PITCH, (i + 1) * PITCH, (j + 1) * PITCH},
               .street = {i > 0, i + 1 < columns, j > 0, j + 1 < rows}};
    if (b.street[SLI_LEFT]) b.rect.x0 += t->across[at] + STREET;
    if (b.street[SLI_RIGHT]) b.rect.x1 += t->across[at + 1];
    if (b.street[SLI_BOTTOM]) b.rect.y0 += t->along[at] + STREET;
    if (b.street[SLI_TOP]) b.rect.y1 += t->along[at + columns];
    b.corner = (i == 0 || i + 1 == columns) && (j == 0 || j + 1 == rows);
    return b;
}

// --- houses

/// One side of a house: a door to the street if it is the one chosen, or now and then.
static sl_status add_front(sli_plot *plot, const block *house, sl_side side, sl_side chosen) {
    const sli_run run = sli_side_of(house->rect, side);
    const bool door = house->street[side] && (side == chosen || sli_chance(plot, 20));
    return door ? sli_plot_wall_door(plot, run) : sli_plot_wall(plot, run);
}

/// Any side with a street; SLI_SIDES for none.
static sl_side choose_street(sli_plot *plot, const block *house) {
    sl_side sides[SLI_SIDES];
    int count = 0;
    for (sl_side side = 0; side < SLI_SIDES; side++)
        if (house->street[side]) sides[count++] = side;
    return count ? sides[sli_pick(plot, 0, count - 1)] : SLI_SIDES;
}

/// A house of a block: walls on the block's border, rooms within. What divides it from the next
/// house is added there.
static sl_status add_house(sli_plot *plot, const block *whole, sli_rect rect) {
    const block house = {.rect = rect,
                         .street = {whole->street[SLI_LEFT] && rect.x0 == whole->rect.x0,
                                    whole->street[SLI_RIGHT] && rect.x1 == whole->rect.x1,
                                    whole->street[SLI_BOTTOM] && rect.y0 == whole->rect.y0,
                                    whole->street[SLI_TOP] && rect.y1 == whole->rect.y1}};
    const sl_side chosen = choose_street(plot, &house);
    for (sl_side side = 0; side < SLI_SIDES; side++) {
        const bool border = side == SLI_LEFT     ? rect.x0 == whole->rect.x0
                            : side == SLI_RIGHT  ? rect.x1 == whole->rect.x1
                            : side == SLI_BOTTOM ? rect.y0 == whole->rect.y0
                                                 : rect.y1 == whole->rect.y1;
        if (border) SL_TRY(add_front(plot, &house, side, chosen));
    }
    return sli_plot_rooms(plot, rect, HOUSE_ROOM);
}

/// Up to four houses. In a corner of the town one of them may have no street: doors lead there
/// through the others.
static sl_status add_houses(sli_plot *plot, const block *b) {
    const sli_rect r = b->rect;
    const int x = r.x1 - r.x0 >= 14 ? sli_pick(plot, r.x0 + 5, r.x1 - 5) : r.x1;
    const int y = r.y1 - r.y0 >= 14 ? sli_pick(plot, r.y0 + 5, r.y1 - 5) : r.y1;
    const sli_run dividing[4] = {
        {true, x, r.y0, y}, {true, x, y, r.y1}, {false, y, r.x0, x}, {false, y, x, r.x1}};
    const sli_rect houses[4] = {
        {r.x0, r.y0, x, y}, {x, r.y0, r.x1, y}, {r.x0, y, x, r.y1}, {x, y, r.x1, r.y1}};
    for (int i = 0; i < 4; i++) {
        const sli_run run = dividing[i];
        if (run.low == run.high || run.at == (run.upright ? r.x1 : r.y1)) continue;
        SL_TRY(b->corner ? sli_plot_wall_door(plot, run) : sli_plot_wall(plot, run));
    }
    for (int i = 0; i < 4; i++)
        if (houses[i].x0 < houses[i].x1 && houses[i].y0 < houses[i].y1)
            SL_TRY(add_house(plot, b, houses[i]));
    return SL_OK;
}

/// Four wings about a court, each with a door to it.
static sl_status add_court(sli_plot *plot, const block *b) {
    const sli_rect r = b->rect;
    const sli_rect court = {r.x0 + COURT, r.y0 + COURT, r.x1 - COURT, r.y1 - COURT};
    const sli_rect wings[SLI_SIDES] = {{r.x0, r.y0, court.x0, r.y1},
                                       {court.x1, r.y0, r.x1, r.y1},
                                       {court.x0, r.y0, court.x1, court.y0},
                                       {court.x0, court.y1, court.x1, r.y1}};
    const sl_side chosen = choose_street(plot, b);
    for (sl_side side = 0; side < SLI_SIDES; side++) {
        SL_TRY(add_front(plot, b, side, chosen));
        SL_TRY(sli_plot_wall_door(plot, sli_side_of(court, side)));
        SL_TRY(sli_plot_rooms(plot, wings[side], HOUSE_ROOM));
    }
    // Between the wings, at the court's corners.
    for (int i = 0; i < 2; i++) {
        const int x = i ? court.x1 : court.x0;
        SL_TRY(sli_plot_wall(plot, (sli_run){true, x, r.y0, court.y0}));
        SL_TRY(sli_plot_wall(plot, (sli_run){true, x, court.y1, r.y1}));
    }
    return SL_OK;
}

/// Trees, as squares.
static sl_status add_park(sli_plot *plot, const block *b) {
    for (int y = b->rect.y0 + 1; y + 4 <= b->rect.y1; y += 4)
        for (int x = b->rect.x0 + 1; x + 4 <= b->rect.x1; x += 4) {
            if (sli_chance(plot, 30)) continue;
            const int size = sli_pick(plot, 1, 2);
            const int left = x + sli_pick(plot, 0, 1), low = y + sli_pick(plot, 0, 1);
            SL_TRY(sli_plot_box(plot, (sli_rect){left, low, left + size, low + size}));
        }
    return SL_OK;
}

// --- the town

static sl_status add_block(town *t, int i, int j) {
    const block b = block_at(t, i, j);
    const bool large = b.rect.x1 - b.rect.x0 >= COURT_LEAST && b.rect.y1 - b.rect.y0 >= COURT_LEAST;
    const int chance = sli_pick(t->plot, 0, 99);
    if (chance < 12) return add_park(t->plot, &b);
    return large && chance < 40 ? add_court(t->plot, &b) : add_houses(t->plot, &b);
}

static sl_status lay_town(town *t) {
    sli_plot *plot = t->plot;
    place_streets(t);
    SL_TRY(sli_plot_box(plot, (sli_rect){0, 0, PITCH * plot->columns, PITCH * plot->rows}));
    for (int j = 0; j < plot->rows; j++) {
        for (int i = 0; i < plot->columns; i++) SL_TRY(add_block(t, i, j));
        SL_TRY(sli_plot_row_done(plot, j));
    }
    const int street = t->along[plot->columns + 1];
    return sli_plot_start(plot, PITCH + PITCH / 2.0, PITCH + street + STREET / 2.0);
}

sl_status sli_lay_city(sli_plot *plot) {
    const size_t count = (size_t)plot->columns * (size_t)plot->rows;
    town t = {.plot = plot,
              .along = sl_alloc_array(plot->context, count, sizeof *t.along),
              .across = sl_alloc_array(plot->context, count, sizeof *t.across)};
    const sl_status status = t.along && t.across ? lay_town(&t) : SL_NO_MEMORY;
    sl_free(plot->context, t.along);
    sl_free(plot->context, t.across);
    return status;
}

// --- an office floor

/// A wing's share of the floor.
enum { WING_WIDTH = 28, WING_HEIGHT = 18 };

enum {
    CORRIDOR = 2,
    ROOM_LEAST = 3,
    ROOM_MOST = 9,
    DEPTH_LEAST = 5, // of the rooms on either side of the corridor
};

/// Rooms in a line, each with its door on the side that the corridor is on.
static sl_status lay_row_of_rooms(sli_plot *plot, sli_rect rect, sl_side door_side) {
    for (int x = rect.x0; x < rect.x1;) {
        int end = x + sli_pick(plot, ROOM_LEAST, ROOM_MOST);
        if (end > rect.x1 - ROOM_LEAST) end = rect.x1;
        const sli_rect room = {x, rect.y0, end, rect.y1};
        const sli_run front = sli_side_of(room, door_side);
        // A wide one may be a lounge, open to the corridor.
        if (end - x > 6 && sli_chance(plot, 30))
            SL_TRY(sli_plot_wall_open(plot, front, x + 2, end - 2));
        else
            SL_TRY(sli_plot_wall_door(plot, front));
        if (end < rect.x1) {
            const sli_run side = sli_side_of(room, SLI_RIGHT);
            SL_TRY(sli_chance(plot, 20) ? sli_plot_wall_door(plot, side)
                                        : sli_plot_wall(plot, side));
        }
        x = end;
    }
    return SL_OK;
}

/// An open-plan office: one room, with desks as T-shaped screens.
static sl_status lay_open_plan(sli_plot *plot, sli_rect rect, sl_side door_side) {
    const sli_run front = sli_side_of(rect, door_side);
    const int door = sli_pick(plot, front.low + 1, front.high - 4);
    SL_TRY(sli_plot_wall_open(plot, front, door, door + 3));
    const int y = (rect.y0 + rect.y1) / 2;
    for (int x = rect.x0 + 2; x + 3 <= rect.x1 - 1; x += 5) {
        SL_TRY(sli_plot_wall(plot, (sli_run){false, y, x, x + 3}));
        const int end = sli_chance(plot, 50) ? y - 1 : y + 1;
        SL_TRY(sli_plot_wall(
            plot, (sli_run){true, sli_pick(plot, x, x + 3), end < y ? end : y, end < y ? y : end}));
    }
    return SL_OK;
}

static sl_status lay_band(sli_plot *plot, sli_rect rect, sl_side door_side) {
    return sli_chance(plot, 15) ? lay_open_plan(plot, rect, door_side)
                                : lay_row_of_rooms(plot, rect, door_side);
}

/// A wing without the corridor at its side; its own corridor's ends are open. *corridor is where
/// that lies.
static sl_status lay_wing(sli_plot *plot, sli_rect rect, int *corridor) {
    const int y = sli_pick(plot, rect.y0 + DEPTH_LEAST, rect.y1 - DEPTH_LEAST - CORRIDOR);
    *corridor = y;
    for (sl_side side = SLI_LEFT; side <= SLI_RIGHT; side++)
        SL_TRY(sli_plot_wall_open(plot, sli_side_of(rect, side), y, y + CORRIDOR));
    SL_TRY(lay_band(plot, (sli_rect){rect.x0, rect.y0, rect.x1, y}, SLI_TOP));
    return lay_band(plot, (sli_rect){rect.x0, y + CORRIDOR, rect.x1, rect.y1}, SLI_BOTTOM);
}

/// A floor while it is laid out: for each unit of its width, whether a door is there in the wall
/// below the row at hand, and in the wall above it.
typedef struct floor_plan {
    sli_plot *plot;
    int x, y, wings, rows, width;
    uint8_t *below, *above;
} floor_plan;

/// The corridor at the side of a wing leads by a door at its lower end into whatever lies in the
/// row below, and often by one at its upper end into the row above.
static void cut_doors(floor_plan *f, int corridor, int row) {
    const int from = corridor - f->x;
    if (row > 0) f->below[from + sli_pick(f->plot, 0, CORRIDOR - 1)] = 1;
    if (row + 1 < f->rows && sli_chance(f->plot, 60))
        f->above[from + sli_pick(f->plot, 0, CORRIDOR - 1)] = 1;
}

/// Corridors are at the right of their wings in one row and at the left in the next.
static sl_status lay_row(floor_plan *f, int row) {
    const bool at_right = row % 2 == 0;
    const int y = f->y + row * WING_HEIGHT;
    int from = f->x;
    for (int i = 0; i < f->wings; i++) {
        int end = f->x + (i + 1) * WING_WIDTH, corridor;
        const bool last = i + 1 == f->wings;
        if (at_right) {
            corridor = end - CORRIDOR - (last ? 0 : sli_pick(f->plot, 0, 6));
            end = corridor;
        } else {
            corridor = from;
            from += CORRIDOR;
            end -= last ? 0 : sli_pick(f->plot, 0, 6);
        }
        cut_doors(f, corridor, row);
        int middle;
        SL_TRY(lay_wing(f->plot, (sli_rect){from, y, end, y + WING_HEIGHT}, &middle));
        if (row == 0 && i == 0) SL_TRY(sli_plot_start(f->plot, from + 1, middle + CORRIDOR / 2.0));
        from = at_right ? end + CORRIDOR : end;
    }
    return SL_OK;
}

/// The wall below a row, but for its doors.
static sl_status add_wall_below(const floor_plan *f, int row) {
    int low = 0;
    for (int i = 0; i <= f->width; i++) {
        if (i < f->width && !f->below[i]) continue;
        SL_TRY(sli_plot_wall(f->plot,
                             (sli_run){false, f->y + row * WING_HEIGHT, f->x + low, f->x + i}));
        low = i + 1;
    }
    return SL_OK;
}

static sl_status lay_rows(floor_plan *f) {
    const int height = f->rows * WING_HEIGHT;
    SL_TRY(sli_plot_box(f->plot, (sli_rect){f->x, f->y, f->x + f->width, f->y + height}));
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

/// An office floor of wings x rows on a corner, with a start in its first corridor; about it is a
/// wall.
static sl_status lay_floor(sli_plot *plot, int x, int y, int wings, int rows) {
    floor_plan f = {.plot = plot, .x = x, .y = y, .wings = wings, .rows = rows};
    f.width = wings * WING_WIDTH;
    f.below = sl_alloc_array(plot->context, (size_t)f.width, 1);
    f.above = sl_alloc_array(plot->context, (size_t)f.width, 1);
    const sl_status status = f.below && f.above ? lay_rows(&f) : SL_NO_MEMORY;
    sl_free(plot->context, f.below);
    sl_free(plot->context, f.above);
    return status;
}

sl_status sli_lay_office(sli_plot *plot) {
    return lay_floor(plot, 0, 0, plot->columns, plot->rows);
}

// --- a tower

enum { WINGS = 3, WING_ROWS = 2, BETWEEN = 8 };

sl_status sli_lay_tower(sli_plot *plot) {
    for (int i = 0; i < plot->count; i++) {
        const int column = i % plot->columns, row = i / plot->columns;
        SL_TRY(lay_floor(plot, column * (WINGS * WING_WIDTH + BETWEEN),
                         row * (WING_ROWS * WING_HEIGHT + BETWEEN), WINGS, WING_ROWS));
        if (column + 1 == plot->columns) SL_TRY(sli_plot_row_done(plot, row));
    }
    return SL_OK;
}
