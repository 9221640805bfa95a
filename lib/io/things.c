/// Starts and doors of games' maps: objects that are named "Player" or "Door", and where they
/// stand among the squares.
///
/// An object tells roughly where a door is: a rectangle of some squares, a tile, a line. The
/// squares tell the rest. A door runs from a solid square to the opposite one, as in an ASCII plan:
///
///     # # . . # #        # # # # # #       D: squares of the door, - its segment. On the right the
///     # . D D . #        . . D . . .       door stands on solid squares: they are opened, if a
///     # # - - # #        . . | . . .       passage then leads through.
///     # . . . . #        # # # # # #
///
/// 1. The squares of the door are those whose centres it covers, at least the one of its middle.
/// 2. For each of both ways, a line of its squares must be open and end at solid squares, or at
///    other doors, and open squares must lead away on both sides. The squares stay as they are;
///    only if this fails are all squares of the door opened.
/// 3. If both ways are possible, the longer side decides.
/// 4. A door in the open, among no squares that tell, is taken as it is drawn: along its longer
///    side. A square one, and one on solid ground, is left out.
///
/// Doors that lie side by side end at each other: before anything is decided, squares of doors are
/// marked '+' where they are open and 'X' where they are solid. Objects come first, and their
/// squares become 'o': a door of tiles whose squares all belong to objects is the same door once
/// more. Time O(squares of all doors).
#include "io/things.h"

#include "sightline/support.h"

#include <math.h>
#include <stdlib.h>
#include <strings.h>

// --- what objects say

sli_says sli_says_of(const char *name, const char *class_name) {
    const char *texts[] = {class_name ? class_name : "", name ? name : ""};
    for (size_t i = 0; i < 2; i++) {
        const char *own = *texts[1] ? texts[1] : texts[0];
        if (sli_says_door(texts[i])) {
            const sli_door_state state = sli_says_state(texts[1]);
            return (sli_says){SLI_THING_DOOR, state ? state : sli_says_state(texts[0]), own, 0};
        }
        if (sli_says_start(texts[i])) return (sli_says){.kind = SLI_THING_START, .name = own};
    }
    return (sli_says){0};
}

void sli_says_add(sli_says *says, const char *property, bool value) {
    if (sli_says_door_alone(property)) {
        if (value && says->kind == SLI_THING_NONE)
            *says = (sli_says){SLI_THING_DOOR, says->state, property, says->rank};
        else if (!value && says->kind == SLI_THING_DOOR)
            says->kind = SLI_THING_NONE;
        return;
    }
    const sli_door_state state = sli_says_state_alone(property);
    if (state == SLI_DOOR_OPEN) {
        says->state = value ? SLI_DOOR_OPEN : SLI_DOOR_SHUT;
        says->rank = 2;
    } else if (state == SLI_DOOR_SHUT && value && says->rank < 2) {
        says->state = SLI_DOOR_SHUT;
        says->rank = 1;
    } else if (state == SLI_DOOR_SHUT && !says->rank) {
        says->state = SLI_DOOR_OPEN;
    }
}

double sli_heading_of(double clockwise) {
    double heading = fmod(-clockwise, 360);
    if (heading < 0) heading += 360;
    return sl_coordinate_usable(heading) && heading < 360 ? heading + 0.0 : 0;
}

static bool is_named(sli_word word, const char *name) {
    return name && strlen(name) == word.length && strncasecmp(name, word.at, word.length) == 0;
}

static bool takes_none(const sli_things *things) {
    const char *names = things->options->start_names;
    return names && (!*names || strcmp(names, "none") == 0);
}

static sl_status remember(sli_things *things, const char *name) {
    if (!name || !*name || things->seen_count == SLI_NAMES_SHOWN) return SL_OK;
    for (size_t i = 0; i < things->seen_count; i++)
        if (strcmp(things->seen[i], name) == 0) return SL_OK;
    char *copy = sl_copy_text(things->context, name, strlen(name));
    if (!copy) return SL_NO_MEMORY;
    things->seen[things->seen_count++] = copy;
    return SL_OK;
}

sl_status sli_things_ask(sli_things *things, const char *name, const char *class_name,
                         sli_says *says) {
    const char *names = things->options->start_names;
    if (!names) return SL_OK;
    if (says->kind == SLI_THING_START) *says = (sli_says){0};
    if (takes_none(things)) return SL_OK;
    SL_TRY(remember(things, name));
    SL_TRY(remember(things, class_name));
    for (sli_word word; sli_layers_next(&names, &word);) {
        const char *own = is_named(word, name)         ? name
                          : is_named(word, class_name) ? class_name
                                                       : NULL;
        if (own) *says = (sli_says){.kind = SLI_THING_START, .name = own};
    }
    return SL_OK;
}

// --- gathering

void sli_things_destroy(sli_things *things) {
    for (size_t i = 0; i < things->items.count; i++)
        sl_free(things->context, things->items.items[i].name);
    for (size_t i = 0; i < things->seen_count; i++) sl_free(things->context, things->seen[i]);
    sl_free(things->context, things->items.items);
    sl_free(things->context, things->runs.items);
    *things = (sli_things){0};
}

sl_status sli_things_add(sli_things *things, const char *name, sli_thing thing) {
    SL_TRY(SL_ARRAY_ROOM(things->context, &things->items, 1));
    thing.name = sl_copy_text(things->context, name, strlen(name));
    if (!thing.name) return SL_NO_MEMORY;
    things->items.items[things->items.count++] = thing;
    return SL_OK;
}

static bool same_door(const sli_door_run *run, const sli_says *says) {
    return run->state == says->state && strcmp(run->name, says->name) == 0;
}

sl_status sli_things_add_square(sli_things *things, const sli_says *says, size_t column,
                                size_t row) {
    const size_t count = things->runs.count;
    sli_door_run *last = count ? &things->runs.items[count - 1] : NULL;
    if (last && last->top == row && last->right == column && same_door(last, says)) {
        last->right++;
        return SL_OK;
    }
    SL_TRY(SL_ARRAY_ROOM(things->context, &things->runs, 1));
    things->runs.items[things->runs.count++] = (sli_door_run){.name = says->name,
                                                              .state = says->state,
                                                              .left = column,
                                                              .right = column + 1,
                                                              .top = row,
                                                              .bottom = row + 1,
                                                              .root = count};
    return SL_OK;
}

/// Joins runs that lie on one another. Runs are in the order of rows, then columns, so what is
/// above is found by a second walk through the same order.
static void join_rows(sli_things *things) {
    sli_door_run *runs = things->runs.items;
    size_t above = 0;
    for (size_t i = 0; i < things->runs.count; i++) {
        sli_door_run *run = &runs[i];
        while (above < i && (runs[above].top + 1 < run->top ||
                             (runs[above].top + 1 == run->top && runs[above].left < run->left)))
            above++;
        const sli_door_run *other = &runs[above];
        const sli_says says = {.state = run->state, .name = run->name};
        if (other->top + 1 != run->top || other->left != run->left || other->right != run->right ||
            !same_door(other, &says))
            continue;
        run->root = other->root;
        runs[run->root].bottom = run->bottom;
    }
}

sl_status sli_things_end_block(sli_things *things, sl_point corner, sl_point step) {
    join_rows(things);
    sl_status status = SL_OK;
    for (size_t i = 0; status == SL_OK && i < things->runs.count; i++) {
        const sli_door_run *run = &things->runs.items[i];
        if (run->root != i) continue;
        const sl_point half = {(double)(run->right - run->left) * step.x / 2,
                               (double)(run->bottom - run->top) * step.y / 2};
        const sli_thing door = {.kind = SLI_THING_DOOR,
                                .middle = {corner.x + (double)run->left * step.x + half.x,
                                           corner.y + (double)run->top * step.y + half.y},
                                .of_tiles = true,
                                .u = {half.x, 0},
                                .v = {0, half.y},
                                .open = run->state != SLI_DOOR_SHUT};
        status = sli_things_add(things, run->name, door);
    }
    things->runs.count = 0;
    return status;
}

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
    const bool is_thin = at->thing->is_line || (fmin(at->half.x, at->half.y) < 0.25 &&
                                                fmax(at->half.x, at->half.y) >= 0.25);
    const door_way longer = way_of(at, taller, cut), other = way_of(at, !taller, cut);
    if (find_way(things, &longer, out)) return true;
    return !is_thin && find_way(things, &other, out);
}

static void place_door(const sli_things *things, const spot *at, sli_thing *door) {
    if (find_segment(things, at, false, &door->at))
        door->placed = true;
    else
        door->placed = door->cut = find_segment(things, at, true, &door->at);
    change(at, 'X', door->cut ? '+' : '#');
    if (door->cut) change(at, '#', '+');
    if (!door->placed) change(at, '+', '.');
    if (door->placed && !door->of_tiles) change(at, '+', 'o');
}

static bool is_all(const spot *at, char kind) {
    for (size_t row = at->rows.from; row < at->rows.to; row++)
        for (size_t column = at->columns.from; column < at->columns.to; column++)
            if (*square_at(at->grid, row, column) != kind) return false;
    return at->rows.from < at->rows.to && at->columns.from < at->columns.to;
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

/// Whether the middle is on a solid square; for a line also on the border of one.
static bool is_solid_at(const spot *at) {
    const double x = at->middle.x, y = at->middle.y;
    const size_t column = (size_t)x, row = (size_t)y;
    const size_t left = column - (at->thing->is_line && (double)column == x);
    const size_t above = row - (at->thing->is_line && (double)row == y);
    bool solid = false;
    for (size_t r = above; r != row + 1; r++)
        for (size_t c = left; c != column + 1; c++) {
            const char kind = sli_grid_square(at->grid, r, c);
            solid |= kind == '#' || kind == 'X';
        }
    return solid;
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
        if (thing->kind == SLI_THING_START)
            place_start(things, &at, thing);
        else if (!thing->placed)
            thing->solid |= is_solid_at(&at);
    }
    return SL_OK;
}

// --- into the map

/// Notes of one kind, beyond which only their number is told.
#define MOST_NOTES 5

/// A door that no squares tell the place of: as it is drawn.
static bool place_as_drawn(const sli_things *things, sli_thing *door) {
    const double along = hypot(door->u.x, door->u.y), across = hypot(door->v.x, door->v.y);
    if (door->placed) return true;
    if ((things->grids && !door->inside) || door->solid || along == across) return false;
    const sl_point half = along > across ? door->u : door->v;
    door->at = (sl_segment){{door->middle.x - half.x, things->top - (door->middle.y - half.y)},
                            {door->middle.x + half.x, things->top - (door->middle.y + half.y)}};
    door->placed = true;
    return true;
}

static bool is_usable(sl_point point) {
    return sl_coordinate_usable(point.x) && sl_coordinate_usable(point.y);
}

static void tell_left_out(const sli_things *things, const sli_thing *thing, size_t *count,
                          const char *why) {
    if (++*count > MOST_NOTES) return;
    char where[32] = "", x[SL_NUMBER_TEXT], y[SL_NUMBER_TEXT];
    if (thing->line) snprintf(where, sizeof where, ":%lu", (unsigned long)thing->line);
    sl_number_write(thing->middle.x, x);
    sl_number_write(things->top - thing->middle.y, y);
    sl_note(things->context, "%s%s: %s '%s' at %s %s is left out: %s", things->file, where,
            thing->kind == SLI_THING_DOOR ? "door" : "start",
            sli_show((sli_word){thing->name, strlen(thing->name)}).text, x, y, why);
}

static void tell_more(const sli_things *things, size_t count, const char *what) {
    if (count > MOST_NOTES)
        sl_note(things->context, "%s: %zu more %s%s left out", things->file, count - MOST_NOTES,
                what, count - MOST_NOTES == 1 ? " is" : "s are");
}

/// A text of names, each once: 'Player', 'spawn'.
typedef struct name_text {
    char text[256];
    size_t count;
} name_text;

static void add_name(name_text *names, const char *name) {
    char quoted[128];
    snprintf(quoted, sizeof quoted, "'%s'", sli_show((sli_word){name, strlen(name)}).text);
    if (strstr(names->text, quoted)) return;
    const size_t used = strlen(names->text);
    if (++names->count <= SLI_NAMES_SHOWN && used + strlen(quoted) + 8 < sizeof names->text)
        snprintf(names->text + used, sizeof names->text - used, "%s%s", used ? ", " : "", quoted);
    else if (!strstr(names->text, "..."))
        snprintf(names->text + used, sizeof names->text - used, " ...");
}

/// SL_BAD_ARGUMENT where a name that is asked for is that of no object.
static sl_status check_names(const sli_things *things) {
    const char *names = things->options->start_names;
    if (!names || takes_none(things)) return SL_OK;
    for (sli_word word; sli_layers_next(&names, &word);) {
        bool found = false;
        for (size_t i = 0; i < things->items.count && !found; i++)
            found = things->items.items[i].kind == SLI_THING_START &&
                    is_named(word, things->items.items[i].name);
        if (found) continue;
        name_text seen = {0};
        for (size_t i = 0; i < things->seen_count; i++) add_name(&seen, things->seen[i]);
        return sl_fail(things->context, SL_BAD_ARGUMENT,
                       "--start-names: %s has no object '%s'; its objects: %s", things->file,
                       sli_show(word).text, *seen.text ? seen.text : "none has a name");
    }
    return SL_OK;
}

static sl_status add_starts(const sli_things *things, sl_map *map) {
    const sl_box bounds = sl_map_bounds(map);
    size_t count = 0, moved = 0, left_out = 0;
    name_text names = {0};
    for (size_t i = 0; i < things->items.count; i++) {
        const sli_thing *start = &things->items.items[i];
        if (start->kind != SLI_THING_START) continue;
        const sl_point at = {start->middle.x, things->top - start->middle.y};
        const bool in_bounds = at.x >= bounds.min.x && at.x <= bounds.max.x &&
                               at.y >= bounds.min.y && at.y <= bounds.max.y;
        if (!is_usable(at) || !(things->grids ? start->inside : in_bounds)) {
            tell_left_out(things, start, &left_out, "it is outside the map");
            continue;
        }
        if (start->solid) {
            tell_left_out(things, start, &left_out, "it stands on solid ground");
            continue;
        }
        SL_TRY(sl_map_add_start(things->context, map, at, start->heading, start->line));
        add_name(&names, start->name);
        moved += start->moved;
        count++;
    }
    tell_more(things, left_out, "start");
    char also[96] = "";
    if (moved)
        snprintf(also, sizeof also, "; %zu of them moved from the edge of a solid square", moved);
    if (count)
        sl_note(things->context, "%s: taken: %zu start%s, from %s%s", things->file, count,
                count == 1 ? "" : "s", names.text, also);
    return SL_OK;
}

static int compare_names(const void *left, const void *right) {
    const sli_thing *const *a = left, *const *b = right;
    const int order = strcmp((*a)->name, (*b)->name);
    return order ? order : (*a > *b) - (*a < *b);
}

/// Makes a name one word of the map text, without what a list of names has between them, and
/// without the ':' that numbers of doors have before them.
static sl_status make_word(sl_context *context, char **name) {
    for (char *at = *name; *at; at++)
        if ((unsigned char)*at <= ' ' || strchr("#,:\x7f", *at)) *at = '_';
    if (sli_name_usable(*name, strlen(*name))) return SL_OK;
    char *other = sl_copy_text(context, "door", 4);
    if (!other) return SL_NO_MEMORY;
    sl_free(context, *name);
    *name = other;
    return SL_OK;
}

/// Doors of one name: the second gets ":2", the third ":3".
static sl_status number_name(sl_context *context, sli_thing *door, size_t number) {
    const size_t length = strlen(door->name);
    char *name = sl_alloc(context, length + 24);
    if (!name) return SL_NO_MEMORY;
    snprintf(name, length + 24, "%s:%zu", door->name, number);
    sl_free(context, door->name);
    door->name = name;
    return SL_OK;
}

static sl_status name_doors(const sli_things *things, sli_thing **doors, size_t count) {
    sl_status status = SL_OK;
    for (size_t i = 0; i < count && status == SL_OK; i++)
        status = make_word(things->context, &doors[i]->name);
    if (status == SL_OK && count) qsort(doors, count, sizeof *doors, compare_names);
    // The first of a name keeps it, so that the others can be held against it.
    for (size_t i = 0, first = 0, number = 1; i < count && status == SL_OK; i++) {
        if (i == first || strcmp(doors[i]->name, doors[first]->name) != 0) {
            first = i;
            number = 1;
        } else if (!doors[i]->goes_on) {
            status = number_name(things->context, doors[i], ++number);
        } else if (number > 1) {
            status = number_name(things->context, doors[i], number);
        }
    }
    return status;
}

static sl_status add_door(const sli_things *things, const sli_thing *door, sl_map *map) {
    if (things->options->doors)
        return sl_map_add_door(things->context, map, door->name, door->at, door->open, door->line);
    if (door->open) return SL_OK;
    return sl_map_add_wall(things->context, map, door->at.a, door->at.b, door->line);
}

static void tell_doors(const sli_things *things, size_t open, size_t shut) {
    if (!open && !shut) return;
    char states[64] = "";
    if (open && shut) snprintf(states, sizeof states, " (%zu open, %zu shut)", open, shut);
    sl_note(things->context, "%s: %s%zu %sdoor%s%s%s", things->file,
            things->options->doors ? "taken: " : "", open + shut,
            !shut  ? "open "
            : open ? ""
                   : "shut ",
            open + shut == 1 ? "" : "s", states,
            things->options->doors
                ? ""
                : ": without --doors, open ones are taken as gaps, shut ones as walls");
}

static sl_status add_doors(const sli_things *things, sl_map *map) {
    sli_thing **doors = sl_alloc_array(things->context, things->items.count, sizeof *doors);
    if (!doors) return SL_NO_MEMORY;
    size_t count = 0, left_out = 0, open = 0, shut = 0;
    for (size_t i = 0; i < things->items.count; i++) {
        sli_thing *door = &things->items.items[i];
        if (door->kind != SLI_THING_DOOR) continue;
        if (door->again) continue;
        door->goes_on = door->goes_on && things->items.items[i - 1].placed;
        if (place_as_drawn(things, door) && is_usable(door->at.a) && is_usable(door->at.b) &&
            (door->at.a.x != door->at.b.x || door->at.a.y != door->at.b.y)) {
            doors[count++] = door;
            continue;
        }
        door->placed = false;
        tell_left_out(things, door, &left_out,
                      things->grids && !door->inside ? "it is outside the map"
                                                     : "no passage is found there");
    }
    tell_more(things, left_out, "door");
    sl_status status = name_doors(things, doors, count);
    sl_free(things->context, doors);
    for (size_t i = 0; i < things->items.count && status == SL_OK; i++) {
        const sli_thing *door = &things->items.items[i];
        if (door->kind != SLI_THING_DOOR || !door->placed) continue;
        *(door->open ? &open : &shut) += !door->goes_on;
        status = add_door(things, door, map);
    }
    if (status == SL_OK) tell_doors(things, open, shut);
    return status;
}

sl_status sli_things_finish(sli_things *things, sl_map *map) {
    SL_TRY(check_names(things));
    if (!things->items.count) return SL_OK;
    SL_TRY(add_starts(things, map));
    return add_doors(things, map);
}
