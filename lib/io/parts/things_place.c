/// Where doors and starts stand among the squares of a map.
///
/// An object tells roughly where a door is: a rectangle of some squares, a tile, a line. The
/// squares tell the rest. A door runs from a solid square to the opposite one, as in an ASCII plan:
///
///     . . . . . .        . . # . . .       Left: a door of two squares in a passage. Right: a door
///     # # - - # #        . . | . . .       that is drawn on a solid square. The square is opened,
///     . . . . . .        . . # . . .       as a passage then leads through.
///
/// 1. The squares of the door are those whose centres it covers, at least the one of its middle.
/// 2. For each of both ways, a line of its squares must be open and end at solid squares, or at
///    other doors, and open squares must lead away on both sides. The squares stay as they are;
///    only if this fails are all squares of the door opened.
/// 3. If both ways are possible, the longer side decides.
/// 4. What is not found here is left to things.c: doors in the open, among no squares that tell.
///
/// Doors that lie side by side end at each other: before anything is decided, squares of doors are
/// marked '+' where they are open and 'X' where they are solid. Objects come first, and their
/// squares become 'o': a door of tiles whose squares all belong to objects is the same door once
/// more. So is one beside which an object much smaller than a square lies on a wall. Time O(squares
/// of all doors).
#include "io/parts/things.h"

#include <math.h>

// --- doors among squares

/// Squares of a row or a column: from .. to, without `to`. Where both are equal the door lies on
/// the border before that square.
typedef struct range {
    size_t from, to;
} range;

/// A door among the squares of a grid. Distances are in squares, from the grid's upper left corner.
typedef struct spot {
    sli_grid *grid;
    const sli_thing *thing;
    sl_point middle, half;
    range columns, rows;
} spot;

/// A door has so many squares and no more.
#define MOST_SQUARES 4096

static bool find_range(double middle, double half, size_t count, range *out) {
    if (!(middle >= 0 && middle <= (double)count)) return false;
    const double from = fmax(ceil(middle - half - 0.5), 0);
    const double to = fmin(floor(middle + half - 0.5) + 1, (double)count);
    *out = (range){(size_t)from, (size_t)fmax(to, 0)};
    if (from < to) return true;
    const size_t own = (size_t)middle;
    *out = (range){own, own + ((double)own != middle)};
    return true;
}

/// False where the door's middle is outside the grid.
static bool find_spot(const sli_things *things, sli_grid *grid, const sli_thing *thing, spot *out) {
    const double upper = things->top - (grid->origin.y + (double)grid->count * grid->step.y);
    *out = (spot){.grid = grid, .thing = thing};
    out->middle = (sl_point){(thing->middle.x - grid->origin.x) / grid->step.x,
                             (thing->middle.y - upper) / grid->step.y};
    out->half = (sl_point){(fabs(thing->u.x) + fabs(thing->v.x)) / grid->step.x,
                           (fabs(thing->u.y) + fabs(thing->v.y)) / grid->step.y};
    return find_range(out->middle.x, out->half.x, grid->rows[0].length, &out->columns) &&
           find_range(out->middle.y, out->half.y, grid->count, &out->rows);
}

/// A line, or a box of less than half a square: it runs along its longer side.
static bool is_thin(const spot *at) {
    return at->thing->is_line ||
           (fmin(at->half.x, at->half.y) < 0.25 && fmax(at->half.x, at->half.y) >= 0.25);
}

static bool is_axial(const sli_thing *thing) {
    return (thing->u.x == 0 || thing->u.y == 0) && (thing->v.x == 0 || thing->v.y == 0);
}

/// Whether the squares are to say where the door is.
static bool has_squares(const spot *at) {
    const size_t columns = at->columns.to - at->columns.from, rows = at->rows.to - at->rows.from;
    return is_axial(at->thing) && columns <= MOST_SQUARES && rows <= MOST_SQUARES &&
           columns * rows <= MOST_SQUARES;
}

static char *square_at(const sli_grid *grid, size_t row, size_t column) {
    return &grid->squares[row * grid->rows[0].length + column];
}

/// Changes the door's squares of one kind to another.
static void change(const spot *at, char from, char to) {
    for (size_t row = at->rows.from; row < at->rows.to; row++)
        for (size_t column = at->columns.from; column < at->columns.to; column++)
            if (*square_at(at->grid, row, column) == from) *square_at(at->grid, row, column) = to;
}

/// A door that is looked at as running from left to right, or turned.
typedef struct door_way {
    const spot *at;
    bool upright;
    range along, across;
    double middle; ///< across
    bool cut;      ///< its solid squares are opened
} door_way;

static door_way way_of(const spot *at, bool upright, bool cut) {
    return (door_way){.at = at,
                      .upright = upright,
                      .along = upright ? at->rows : at->columns,
                      .across = upright ? at->columns : at->rows,
                      .middle = upright ? at->middle.x : at->middle.y,
                      .cut = cut};
}

static char kind_at(const door_way *way, size_t along, size_t across) {
    return way->upright ? sli_grid_square(way->at->grid, along, across)
                        : sli_grid_square(way->at->grid, across, along);
}

static bool is_own(const door_way *way, size_t along, size_t across) {
    return along >= way->along.from && along < way->along.to && across >= way->across.from &&
           across < way->across.to;
}

/// Solid squares of other doors count as open here, and as closed below.
static bool is_open(const door_way *way, size_t along, size_t across) {
    const char kind = kind_at(way, along, across);
    if (is_own(way, along, across)) return way->cut || (kind != '#' && kind != 'X');
    return kind != '#';
}

static bool ends_at(const door_way *way, size_t along, size_t across) {
    if (is_own(way, along, across)) return !is_open(way, along, across);
    const char kind = kind_at(way, along, across);
    return kind != '.';
}

/// The line lies on the border between two lines of squares, or within one.
static bool is_open_line(const door_way *way, size_t along, size_t across) {
    if (way->across.from < way->across.to) return is_open(way, along, across);
    return kind_at(way, along, across - 1) != '#' && kind_at(way, along, across) != '#';
}

static bool ends_line(const door_way *way, size_t along, size_t across) {
    if (ends_at(way, along, across)) return true;
    return way->across.from == way->across.to && ends_at(way, along, across - 1);
}

/// The open squares of a line of the door, if they are in one piece and end at solid squares.
static bool find_run(const door_way *way, size_t across, range *run) {
    size_t from = way->along.from;
    while (from < way->along.to && !is_open_line(way, from, across)) from++;
    size_t to = from;
    while (to < way->along.to && is_open_line(way, to, across)) to++;
    *run = (range){from, to};
    for (size_t i = to; i < way->along.to; i++)
        if (is_open_line(way, i, across)) return false;
    return from < to && ends_line(way, from - 1, across) && ends_line(way, to, across);
}

/// Whether open squares lead from one side of the door to the other.
static bool leads_through(const door_way *way, range run) {
    for (size_t across = way->across.from; across <= way->across.to + 1; across++) {
        bool any = false;
        for (size_t i = run.from; i < run.to && !any; i++) any = is_open(way, i, across - 1);
        if (!any) return false;
    }
    return true;
}

static sl_segment segment_of(const sli_things *things, const door_way *way, size_t across,
                             range run) {
    const sli_grid *grid = way->at->grid;
    const bool border = way->across.from == way->across.to;
    const bool within = way->middle >= (double)across && way->middle <= (double)across + 1;
    if (way->upright) {
        const sl_point low = sli_grid_corner(grid, run.to - 1, across);
        const double high = sli_grid_corner(grid, run.from - 1, across).y;
        const double x = border   ? low.x
                         : within ? way->at->thing->middle.x
                                  : low.x + grid->step.x / 2;
        return (sl_segment){{x, low.y}, {x, high}};
    }
    const sl_point left = sli_grid_corner(grid, across, run.from);
    const double right = sli_grid_corner(grid, across, run.to).x;
    const double y = border   ? sli_grid_corner(grid, across - 1, run.from).y
                     : within ? things->top - way->at->thing->middle.y
                              : left.y + grid->step.y / 2;
    return (sl_segment){{left.x, y}, {right, y}};
}

/// Of the lines that end at solid squares the one next to the door's middle.
static bool find_way(const sli_things *things, const door_way *way, sl_segment *out) {
    bool found = false;
    double least = 0;
    size_t across = way->across.from, best = across;
    range best_run = {0};
    do {
        range run;
        if (!find_run(way, across, &run)) continue;
        const double away = fabs((double)across + 0.5 - way->middle);
        if (found && away >= least) continue;
        found = true;
        least = away;
        best = across;
        best_run = run;
    } while (++across < way->across.to);
    if (!found || !leads_through(way, best_run)) return false;
    *out = segment_of(things, way, best, best_run);
    return true;
}

/// Tries the ways that the door's shape leaves open, the longer side first.
static bool find_segment(const sli_things *things, const spot *at, bool cut, sl_segment *out) {
    const bool taller = at->half.y > at->half.x;
    const door_way longer = way_of(at, taller, cut), other = way_of(at, !taller, cut);
    if (find_way(things, &longer, out)) return true;
    return !is_thin(at) && find_way(things, &other, out);
}

static void place_door(const sli_things *things, const spot *at, sli_thing *door) {
    if (find_segment(things, at, false, &door->at))
        door->placed = true;
    else
        door->placed = door->cut = find_segment(things, at, true, &door->at);
    change(at, 'X', door->cut ? '+' : '#');
    if (door->cut) change(at, '#', '+');
    if (!door->placed) change(at, '+', '.');
    if (door->placed) change(at, '+', 'o');
}

static bool is_all(const spot *at, char kind) {
    for (size_t row = at->rows.from; row < at->rows.to; row++)
        for (size_t column = at->columns.from; column < at->columns.to; column++)
            if (*square_at(at->grid, row, column) != kind) return false;
    return at->rows.from < at->rows.to && at->columns.from < at->columns.to;
}

/// An object less than half a square large, on a solid square: it may stand for a door beside it.
static bool is_mark(const spot *at) {
    const sl_point middle = at->middle;
    return !at->thing->is_line && fmax(at->half.x, at->half.y) < 0.25 &&
           sli_grid_solid(at->grid, (size_t)middle.y, (size_t)middle.x);
}

/// How far a mark is from the box of a door of tiles, in squares.
static double away_from(const spot *mark, const sli_thing *tiles) {
    const sl_point step = mark->grid->step, from = mark->thing->middle;
    const double x = fabs(from.x - tiles->middle.x) - tiles->u.x;
    const double y = fabs(from.y - tiles->middle.y) - tiles->v.y;
    return fmax(fmax(x / step.x - mark->half.x, y / step.y - mark->half.y), 0);
}

/// Marks of doors that lie on a wall within a third of a square of a door of tiles are that door:
/// the wall there is no door.
static void join_marks(sli_things *things, sli_grid *grid) {
    enum { MOST = 1 << 24 };
    const double near = 1.0 / 3;
    size_t looks = 0;
    for (size_t i = 0; i < things->items.count && looks < MOST; i++) {
        sli_thing *mark = &things->items.items[i];
        spot at;
        if (mark->kind != SLI_THING_DOOR || mark->of_tiles || mark->placed) continue;
        if (!find_spot(things, grid, mark, &at) || !is_mark(&at)) continue;
        looks += things->items.count;
        for (size_t k = 0; k < things->items.count; k++) {
            const sli_thing *tiles = &things->items.items[k];
            if (!tiles->of_tiles || tiles->placed || away_from(&at, tiles) > near) continue;
            mark->middle = tiles->middle;
            mark->u = tiles->u;
            mark->v = tiles->v;
            mark->open &= tiles->open;
            break;
        }
    }
}

static sl_status place_doors(sli_things *things, sli_grid *grid, bool of_tiles) {
    for (size_t i = 0; i < things->items.count; i++) {
        sli_thing *door = &things->items.items[i];
        spot at;
        if (i % 64 == 0) SL_TRY(sl_check_cancelled(things->context));
        if (door->kind != SLI_THING_DOOR || door->of_tiles != of_tiles) continue;
        if (!find_spot(things, grid, door, &at) || !has_squares(&at)) continue;
        door->again |= of_tiles && !door->placed && is_all(&at, 'o');
        if (door->placed && door->cut)
            change(&at, '#', '+');
        else if (!door->placed && !door->again)
            place_door(things, &at, door);
    }
    return SL_OK;
}

/// Whether the middle is on a solid square; for a thin door also on the border of one.
static bool is_solid_at(const spot *at) {
    const double x = at->middle.x, y = at->middle.y;
    const size_t column = (size_t)x, row = (size_t)y;
    const size_t left = column - (is_thin(at) && (double)column == x);
    const size_t above = row - (is_thin(at) && (double)row == y);
    bool solid = false;
    for (size_t r = above; r != row + 1; r++)
        for (size_t c = left; c != column + 1; c++) {
            const char kind = sli_grid_square(at->grid, r, c);
            solid |= kind == '#' || kind == 'X';
        }
    return solid;
}

/// Whether all squares that a door touches in its middle are solid: in another grid than the one
/// that has its passage.
static bool is_buried(const sli_things *things, const spot *at) {
    const sli_thing *door = at->thing;
    const sli_grid *grid = at->grid;
    sl_point middle = at->middle;
    if (door->placed) {
        const double top = things->top - (grid->origin.y + (double)grid->count * grid->step.y);
        const double x = (door->at.a.x + door->at.b.x) / 2;
        const double y = things->top - (door->at.a.y + door->at.b.y) / 2;
        middle = (sl_point){(x - grid->origin.x) / grid->step.x, (y - top) / grid->step.y};
    }
    if (!(middle.x >= 0 && middle.x <= (double)grid->rows[0].length && middle.y >= 0 &&
          middle.y <= (double)grid->count))
        return false;
    const size_t column = (size_t)middle.x, row = (size_t)middle.y;
    const size_t columns = 1 + ((double)column == middle.x), rows = 1 + ((double)row == middle.y);
    for (size_t i = 0; i < rows * columns; i++)
        if (!sli_grid_solid(grid, row - i / columns, column - i % columns)) return false;
    return true;
}

// --- starts among squares

/// A start on the border of a solid square moves to the middle of an open square beside it, the
/// first of: right and below, left and below, right and above, left and above.
static void place_start(const sli_things *things, const spot *at, sli_thing *start) {
    const size_t column = (size_t)at->middle.x, row = (size_t)at->middle.y;
    const size_t columns = 1 + ((double)column == at->middle.x);
    const size_t rows = 1 + ((double)row == at->middle.y);
    size_t solid = 0, best = SIZE_MAX;
    for (size_t i = rows * columns; i-- > 0;) {
        if (sli_grid_solid(at->grid, row - i / columns, column - i % columns))
            solid++;
        else
            best = i;
    }
    if (!solid || start->moved || start->solid) return;
    if (best == SIZE_MAX) {
        start->solid = true;
        return;
    }
    const sl_point corner =
        sli_grid_corner(at->grid, row - best / columns, column - best % columns);
    start->moved = true;
    start->middle = (sl_point){corner.x + at->grid->step.x / 2,
                               things->top - (corner.y + at->grid->step.y / 2)};
}

// --- all of a grid

sl_status sli_things_place(sli_things *things, sli_grid *grid) {
    spot at;
    things->grids++;
    join_marks(things, grid);
    for (size_t i = 0; i < things->items.count; i++) {
        const sli_thing *door = &things->items.items[i];
        if (door->kind != SLI_THING_DOOR || door->placed) continue;
        if (!find_spot(things, grid, door, &at) || !has_squares(&at)) continue;
        change(&at, '.', '+');
        change(&at, '#', 'X');
    }
    SL_TRY(place_doors(things, grid, false));
    SL_TRY(place_doors(things, grid, true));
    for (size_t i = 0; i < things->items.count; i++) {
        sli_thing *thing = &things->items.items[i];
        if (!find_spot(things, grid, thing, &at)) continue;
        thing->inside = true;
        if (thing->kind == SLI_THING_DOOR) thing->buried |= is_buried(things, &at);
        if (thing->kind == SLI_THING_START)
            place_start(things, &at, thing);
        else if (!thing->placed)
            thing->solid |= is_solid_at(&at);
    }
    return SL_OK;
}
