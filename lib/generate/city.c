/// An old town. Where two streets cross, one of them is broken: it goes on a few steps aside, so
/// that nobody looks down a street for long. Blocks are houses with rooms and doors to the street,
/// houses about a court, or parks.
#include "generate/plot.h"

enum {
    PITCH = 24, // of the blocks
    STREET = 3, // its width
    ASIDE = 5,  // the farthest that a street is off its place
    BREAK = 4,  // where it is broken, how far its parts are apart at least
    ROOM = 3,   // the least width of a room
    COURT = 5,  // the depth of a house about a court
    COURT_LEAST = 2 * COURT + 4,
};

/// The streets. along[j * columns + i] tells how far the level street below block (i, j) is off its
/// place, across[j * columns + i] the upright one at the left of it.
typedef struct town {
    sl_plot *plot;
    int *along, *across;
} town;

/// A block or a part of it, and on which sides there is a street.
typedef struct block {
    sl_rect rect;
    bool street[SL_SIDES];
    bool corner; ///< in a corner of the town
} block;

// --- streets

static int aside_from(sl_plot *plot, int old) {
    const bool down = old > ASIDE - BREAK || (old >= BREAK - ASIDE && sl_chance(plot, 50));
    return down ? sl_pick(plot, -ASIDE, old - BREAK) : sl_pick(plot, old + BREAK, ASIDE);
}

/// At each crossing one street keeps its line. The corners of the four blocks about it then keep
/// apart.
static void place_streets(town *t) {
    sl_plot *plot = t->plot;
    const size_t columns = (size_t)plot->columns;
    for (size_t i = 1; i < columns; i++) t->across[i] = sl_pick(plot, -ASIDE, ASIDE);
    for (size_t j = 1; j < (size_t)plot->rows; j++) {
        t->along[j * columns] = sl_pick(plot, -ASIDE, ASIDE);
        for (size_t i = 1; i < columns; i++) {
            const size_t at = j * columns + i;
            const int west = t->along[at - 1], south = t->across[at - columns];
            const bool broken_along = sl_chance(plot, 50);
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
    if (b.street[SL_LEFT]) b.rect.x0 += t->across[at] + STREET;
    if (b.street[SL_RIGHT]) b.rect.x1 += t->across[at + 1];
    if (b.street[SL_BOTTOM]) b.rect.y0 += t->along[at] + STREET;
    if (b.street[SL_TOP]) b.rect.y1 += t->along[at + columns];
    b.corner = (i == 0 || i + 1 == columns) && (j == 0 || j + 1 == rows);
    return b;
}

// --- houses

/// One side of a house: a door to the street if it is the one chosen, or now and then.
static sl_status add_front(sl_plot *plot, const block *house, sl_side side, sl_side chosen) {
    const sl_run run = sl_side_of(house->rect, side);
    const bool door = house->street[side] && (side == chosen || sl_chance(plot, 20));
    return door ? sl_plot_wall_door(plot, run) : sl_plot_wall(plot, run);
}

/// Any side with a street; SL_SIDES for none.
static sl_side choose_street(sl_plot *plot, const block *house) {
    sl_side sides[SL_SIDES];
    int count = 0;
    for (sl_side side = 0; side < SL_SIDES; side++)
        if (house->street[side]) sides[count++] = side;
    return count ? sides[sl_pick(plot, 0, count - 1)] : SL_SIDES;
}

/// A house of a block: walls on the block's border, rooms within. What divides it from the next
/// house is added there.
static sl_status add_house(sl_plot *plot, const block *whole, sl_rect rect) {
    const block house = {.rect = rect,
                         .street = {whole->street[SL_LEFT] && rect.x0 == whole->rect.x0,
                                    whole->street[SL_RIGHT] && rect.x1 == whole->rect.x1,
                                    whole->street[SL_BOTTOM] && rect.y0 == whole->rect.y0,
                                    whole->street[SL_TOP] && rect.y1 == whole->rect.y1}};
    const sl_side chosen = choose_street(plot, &house);
    for (sl_side side = 0; side < SL_SIDES; side++) {
        const bool border = side == SL_LEFT     ? rect.x0 == whole->rect.x0
                            : side == SL_RIGHT  ? rect.x1 == whole->rect.x1
                            : side == SL_BOTTOM ? rect.y0 == whole->rect.y0
                                                : rect.y1 == whole->rect.y1;
        if (border) SL_TRY(add_front(plot, &house, side, chosen));
    }
    return sl_plot_rooms(plot, rect, ROOM);
}

/// Up to four houses. In a corner of the town one of them may have no street: doors lead there
/// through the others.
static sl_status add_houses(sl_plot *plot, const block *b) {
    const sl_rect r = b->rect;
    const int x = r.x1 - r.x0 >= 14 ? sl_pick(plot, r.x0 + 5, r.x1 - 5) : r.x1;
    const int y = r.y1 - r.y0 >= 14 ? sl_pick(plot, r.y0 + 5, r.y1 - 5) : r.y1;
    const sl_run dividing[4] = {
        {true, x, r.y0, y}, {true, x, y, r.y1}, {false, y, r.x0, x}, {false, y, x, r.x1}};
    const sl_rect houses[4] = {
        {r.x0, r.y0, x, y}, {x, r.y0, r.x1, y}, {r.x0, y, x, r.y1}, {x, y, r.x1, r.y1}};
    for (int i = 0; i < 4; i++) {
        const sl_run run = dividing[i];
        if (run.low == run.high || run.at == (run.upright ? r.x1 : r.y1)) continue;
        SL_TRY(b->corner ? sl_plot_wall_door(plot, run) : sl_plot_wall(plot, run));
    }
    for (int i = 0; i < 4; i++)
        if (houses[i].x0 < houses[i].x1 && houses[i].y0 < houses[i].y1)
            SL_TRY(add_house(plot, b, houses[i]));
    return SL_OK;
}

/// Four wings about a court, each with a door to it.
static sl_status add_court(sl_plot *plot, const block *b) {
    const sl_rect r = b->rect;
    const sl_rect court = {r.x0 + COURT, r.y0 + COURT, r.x1 - COURT, r.y1 - COURT};
    const sl_rect wings[SL_SIDES] = {{r.x0, r.y0, court.x0, r.y1},
                                     {court.x1, r.y0, r.x1, r.y1},
                                     {court.x0, r.y0, court.x1, court.y0},
                                     {court.x0, court.y1, court.x1, r.y1}};
    const sl_side chosen = choose_street(plot, b);
    for (sl_side side = 0; side < SL_SIDES; side++) {
        SL_TRY(add_front(plot, b, side, chosen));
        SL_TRY(sl_plot_wall_door(plot, sl_side_of(court, side)));
        SL_TRY(sl_plot_rooms(plot, wings[side], ROOM));
    }
    // Between the wings, at the court's corners.
    for (int i = 0; i < 2; i++) {
        const int x = i ? court.x1 : court.x0;
        SL_TRY(sl_plot_wall(plot, (sl_run){true, x, r.y0, court.y0}));
        SL_TRY(sl_plot_wall(plot, (sl_run){true, x, court.y1, r.y1}));
    }
    return SL_OK;
}

/// Trees, as squares.
static sl_status add_park(sl_plot *plot, const block *b) {
    for (int y = b->rect.y0 + 1; y + 4 <= b->rect.y1; y += 4)
        for (int x = b->rect.x0 + 1; x + 4 <= b->rect.x1; x += 4) {
            if (sl_chance(plot, 30)) continue;
            const int size = sl_pick(plot, 1, 2);
            const int left = x + sl_pick(plot, 0, 1), low = y + sl_pick(plot, 0, 1);
            SL_TRY(sl_plot_box(plot, (sl_rect){left, low, left + size, low + size}));
        }
    return SL_OK;
}

// --- the town

static sl_status add_block(town *t, int i, int j) {
    const block b = block_at(t, i, j);
    const bool large = b.rect.x1 - b.rect.x0 >= COURT_LEAST && b.rect.y1 - b.rect.y0 >= COURT_LEAST;
    const int chance = sl_pick(t->plot, 0, 99);
    if (chance < 12) return add_park(t->plot, &b);
    return large && chance < 40 ? add_court(t->plot, &b) : add_houses(t->plot, &b);
}

static sl_status lay(town *t) {
    sl_plot *plot = t->plot;
    place_streets(t);
    SL_TRY(sl_plot_box(plot, (sl_rect){0, 0, PITCH * plot->columns, PITCH * plot->rows}));
    for (int j = 0; j < plot->rows; j++) {
        for (int i = 0; i < plot->columns; i++) SL_TRY(add_block(t, i, j));
        SL_TRY(sl_plot_row_done(plot, j));
    }
    const int street = t->along[plot->columns + 1];
    return sl_plot_start(plot, PITCH + PITCH / 2.0, PITCH + street + STREET / 2.0);
}

sl_status sl_lay_city(sl_plot *plot) {
    const size_t count = (size_t)plot->columns * (size_t)plot->rows;
    town t = {.plot = plot,
              .along = sl_alloc_array(plot->context, count, sizeof *t.along),
              .across = sl_alloc_array(plot->context, count, sizeof *t.across)};
    const sl_status status = t.along && t.across ? lay(&t) : SL_NO_MEMORY;
    sl_free(plot->context, t.along);
    sl_free(plot->context, t.across);
    return status;
}
