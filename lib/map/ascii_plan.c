/// Grids of solid and open squares, and the ASCII plan, which is such a grid.
///
/// A wall stands on each border between a solid square and an open one. Unit pieces in one line
/// that have the solid square on the same side become one wall:
///
///     # # # #                         level walls come from one pass over each pair of rows;
///     # . . #      .-----.            upright ones stay open in a table by column until a row
///     # . . #  ->  |     |            ends them
///     # # # #      '-----'
///
/// To write a plan, the squares outside the walls are solid, and each wall separates solid from
/// open. A flood from outside, wall by wall, tells the two apart: a square that is an odd number of
/// walls away is open. A map for which this does not work out is refused.
#include "map/grid.h"

#include "geometry/orient.h"
#include "map/scan.h"
#include "map/source.h"
#include "sightline/support.h"

#include <math.h>

sl_status sli_grid_create(sl_context *context, size_t width, size_t height, sli_grid *grid) {
    sli_word *rows = sl_alloc_array(context, height, sizeof *rows);
    char *squares = sl_alloc_array(context, height, width);
    if (!rows || !squares) {
        sl_free(context, rows);
        sl_free(context, squares);
        return SL_NO_MEMORY;
    }
    memset(squares, '.', width * height);
    for (size_t row = 0; row < height; row++) rows[row] = (sli_word){squares + row * width, width};
    *grid = (sli_grid){.rows = rows, .count = height, .step = {1, 1}, .squares = squares};
    return SL_OK;
}

void sli_grid_destroy(sl_context *context, sli_grid *grid) {
    sl_free(context, grid->rows);
    sl_free(context, grid->squares);
    *grid = (sli_grid){0};
}

static size_t row_length(const sli_grid *grid, size_t row) {
    return row < grid->count ? grid->rows[row].length : 0;
}

/// The number of columns of a row or the one above it, whichever is more.
static size_t columns_about(const sli_grid *grid, size_t row) {
    const size_t above = row_length(grid, row - 1), here = row_length(grid, row);
    return above > here ? above : here;
}

static uint32_t line_of(const sli_grid *grid, size_t row) {
    if (!grid->first_line) return 0;
    return grid->first_line + (uint32_t)(row < grid->count ? row : row - 1);
}

/// What is beside the border of two squares: solid ground on one side, open ground on the other, or
/// 0 for no wall. `left` is at the left hand of who goes along the border.
static uint32_t ground_between(const sli_grid *grid, bool left, bool right) {
    if (left == right) return 0;
    const uint32_t open = grid->sure ? SL_OPEN_RIGHT : 0;
    const uint32_t ground = SL_SOLID_LEFT | SL_SOLID_BEGINS | open;
    return left ? ground : sl_ground_turned(ground);
}

static sl_status add_marked(sl_context *context, const sli_grid *grid, sl_point a, sl_point b,
                            size_t row, uint32_t ground, sl_map *map) {
    SL_TRY(sl_map_add_wall(context, map, a, b, line_of(grid, row)));
    map->walls[map->wall_count - 1].ground = ground;
    return SL_OK;
}

/// The walls between a row and the one above it; `row` may be the one after the last.
static sl_status add_level(sl_context *context, const sli_grid *grid, size_t row, sl_map *map) {
    const size_t length = columns_about(grid, row);
    uint32_t ground = 0;
    for (size_t column = 0, first = 0; column <= length; column++) {
        const uint32_t here = ground_between(grid, sli_grid_solid(grid, row - 1, column),
                                             sli_grid_solid(grid, row, column));
        if (here == ground) continue;
        if (ground)
            SL_TRY(add_marked(context, grid, sli_grid_corner(grid, row - 1, first),
                              sli_grid_corner(grid, row - 1, column), row, ground, map));
        first = column;
        ground = here;
    }
    return SL_OK;
}

/// A wall between two columns that is not ended yet: the row where it begins, and its ground.
typedef struct upright_run {
    size_t first;
    uint32_t ground; ///< 0 for none
} upright_run;

/// Begins and ends the walls between the columns of a row; the row after the last ends them all.
/// `runs` has one for the left edge of each column.
static sl_status add_uprights(sl_context *context, const sli_grid *grid, size_t row,
                              upright_run *runs, sl_map *map) {
    const size_t length = columns_about(grid, row);
    for (size_t column = 0; column <= length; column++) {
        upright_run *run = &runs[column];
        const uint32_t here = ground_between(grid, sli_grid_solid(grid, row, column - 1),
                                             sli_grid_solid(grid, row, column));
        if (here == run->ground) continue;
        if (run->ground)
            SL_TRY(add_marked(context, grid, sli_grid_corner(grid, row - 1, column),
                              sli_grid_corner(grid, run->first - 1, column), run->first,
                              run->ground, map));
        *run = (upright_run){row, here};
    }
    return SL_OK;
}

sl_status sli_grid_add_walls(sl_context *context, const sli_grid *grid, sl_map *map) {
    size_t width = 0;
    for (size_t row = 0; row < grid->count; row++)
        if (grid->rows[row].length > width) width = grid->rows[row].length;
    upright_run *runs = sl_alloc_array(context, width + 1, sizeof *runs);
    if (!runs) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (size_t row = 0; status == SL_OK && row <= grid->count; row++) {
        if (row % 256 == 0) status = sl_check_cancelled(context);
        if (status == SL_OK) status = add_level(context, grid, row, map);
        if (status == SL_OK) status = add_uprights(context, grid, row, runs, map);
    }
    sl_free(context, runs);
    return status;
}

// --- plans

/// The limit of unit squares on each side of a written plan.
#define MOST_SQUARES 4096

/// The door of a square: through its middle, from one solid square to the opposite one. False
/// unless there is exactly one such pair.
static bool door_segment(const sli_grid *plan, size_t row, size_t column, sl_segment *out) {
    const bool beside =
        sli_grid_solid(plan, row, column - 1) && sli_grid_solid(plan, row, column + 1);
    const bool along =
        sli_grid_solid(plan, row - 1, column) && sli_grid_solid(plan, row + 1, column);
    const sl_point at = sli_grid_corner(plan, row, column);
    if (beside)
        *out = (sl_segment){{at.x, at.y + 0.5}, {at.x + 1, at.y + 0.5}};
    else
        *out = (sl_segment){{at.x + 0.5, at.y}, {at.x + 0.5, at.y + 1}};
    return beside != along;
}

/// The place of a start in a square.
static sl_point middle(const sli_grid *plan, size_t row, size_t column) {
    const sl_point at = sli_grid_corner(plan, row, column);
    return (sl_point){at.x + 0.5, at.y + 0.5};
}

/// The reading of a plan.
typedef struct plan_reader {
    sl_context *context;
    const char *name;
    sli_grid plan;
    sl_map *map;
} plan_reader;

static sl_status check_row(const plan_reader *reader, size_t row) {
    const sli_word line = reader->plan.rows[row];
    for (size_t i = 0; i < line.length; i++) {
        const unsigned char c = (unsigned char)line.at[i];
        if (strchr("# .+@", c)) continue;
        char shown[16];
        snprintf(shown, sizeof shown, c > 0x20 && c < 0x7f ? "'%c'" : "byte 0x%02x", c);
        return sl_fail_at(reader->context, reader->name, (unsigned)row + 1,
                          "column %zu: expected '#', ' ', '.', '+' or '@', found %s", i + 1,
                          c == '\t' ? "a tab" : shown);
    }
    return SL_OK;
}

/// The doors and starts of a row.
static sl_status add_things(const plan_reader *reader, size_t row) {
    const sli_grid *plan = &reader->plan;
    const uint32_t line = (uint32_t)row + 1;
    for (size_t column = 0; column < plan->rows[row].length; column++) {
        const char what = sli_grid_square(plan, row, column);
        if (what == '@')
            SL_TRY(
                sl_map_add_start(reader->context, reader->map, middle(plan, row, column), 0, line));
        if (what != '+') continue;
        sl_segment at;
        if (!door_segment(plan, row, column, &at))
            return sl_fail_at(reader->context, reader->name, line,
                              "column %zu: a door needs solid squares on two opposite sides, and "
                              "open floor on one of the others",
                              column + 1);
        char label[32];
        snprintf(label, sizeof label, "door%zu", reader->map->door_count + 1);
        SL_TRY(sl_map_add_door(reader->context, reader->map, label, at, true, line));
    }
    return SL_OK;
}

static sl_status read_rows(const plan_reader *reader) {
    bool any_open = false;
    for (size_t row = 0; row < reader->plan.count; row++) {
        SL_TRY(check_row(reader, row));
        const sli_word line = reader->plan.rows[row];
        for (size_t i = 0; i < line.length && !any_open; i++) any_open = line.at[i] != '#';
    }
    if (!any_open)
        return sl_fail_at(reader->context, reader->name, 0, "the plan has no open square");
    SL_TRY(sli_grid_add_walls(reader->context, &reader->plan, reader->map));
    for (size_t row = 0; row < reader->plan.count; row++) {
        if (row % 256 == 0) SL_TRY(sl_check_cancelled(reader->context));
        SL_TRY(add_things(reader, row));
    }
    return SL_OK;
}

/// The plan of these rows: unit squares, one line for each row.
static sli_grid plan_of(sli_word *rows, size_t count) {
    return (sli_grid){.rows = rows, .count = count, .step = {1, 1}, .first_line = 1, .sure = true};
}

sl_status sli_map_read_plan(sl_context *context, const char *name, const char *text, size_t size,
                            sl_map *map) {
    SL_TRY(sli_refuse_nul(context, name, text, size));
    sl_map read = {0};
    SL_ARRAY(sli_word) rows = {0};
    plan_reader reader = {.context = context, .name = name, .map = &read};
    sli_lines lines = sli_lines_of(text, size);
    sl_status status = SL_OK;
    for (sli_word line; status == SL_OK && sli_lines_next(&lines, &line);) {
        status = SL_ARRAY_ROOM(context, &rows, 1);
        if (status == SL_OK) rows.items[rows.count++] = line;
    }
    reader.plan = plan_of(rows.items, rows.count);
    if (status == SL_OK) status = read_rows(&reader);
    read.source.transform = sli_y_down((double)rows.count, 1); // columns and rows
    sl_free(context, rows.items);
    if (status == SL_OK)
        *map = read;
    else
        sl_map_destroy(context, &read);
    return status;
}

/// The making of a plan from a map. Squares are counted from the lower left. `left` and `bottom`
/// are the numbers of solid squares outside the walls there; the other sides have one or none.
typedef struct plan_maker {
    sl_context *context;
    const sl_map *map;
    sl_box walls;
    size_t left, bottom;
    size_t width, height;
    unsigned char *squares; ///< of the plan and one more square all around, see the marks below
    char *text;
    sli_word *rows;
} plan_maker;

enum { WALL_LEFT = 1, WALL_BELOW = 2, KNOWN = 4, OPEN = 8 };

static sl_status refuse(const plan_maker *maker, uint32_t line, const char *format, ...)
    SL_PRINTF(3, 4);

static sl_status refuse(const plan_maker *maker, uint32_t line, const char *format, ...) {
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return sli_map_fail(maker->context, maker->map, SL_UNSUPPORTED, line, "%s", what);
}

static sl_status refuse_segment(const plan_maker *maker, uint32_t line, const char *what,
                                sl_point a, sl_point b, const char *why) {
    char text[4][SL_NUMBER_TEXT];
    sl_number_write(a.x, text[0]);
    sl_number_write(a.y, text[1]);
    sl_number_write(b.x, text[2]);
    sl_number_write(b.y, text[3]);
    return refuse(maker, line, "%s %s %s %s %s: %s", what, text[0], text[1], text[2], text[3], why);
}

static sl_status refuse_wall(const plan_maker *maker, const sl_wall *wall, const char *why) {
    return refuse_segment(maker, wall->line, "wall", wall->a, wall->b, why);
}

/// Refuses, by name, all that has no character in a plan.
static sl_status refuse_others(const plan_maker *maker) {
    const sl_map *map = maker->map;
    if (map->mirror_count)
        return refuse(maker, map->mirrors[0].line, "a plan has no place for a mirror");
    if (map->oneway_count)
        return refuse(maker, map->oneways[0].line, "a plan has no place for one-way glass");
    if (map->seam_count) return refuse(maker, map->seams[0].line, "a plan has no place for a seam");
    if (map->cell_count)
        return refuse(maker, map->cells[0].line, "a plan has no place for cells of the map's own");
    if (map->range > 0) return refuse(maker, map->range_line, "a plan has no place for a range");
    if (map->path_count)
        return refuse(maker, map->paths[0].line, "a plan has no place for path %s",
                      map->paths[0].name);
    if (map->object_count)
        return refuse(maker, map->objects[0].line, "a plan has no place for object %s",
                      map->objects[0].name);
    if (map->source.notes) return refuse(maker, 0, "a plan has no place for the map's notes");
    bool walled = false;
    for (size_t i = 0; i < map->wall_count && !walled; i++)
        walled = !sli_same_point(map->walls[i].a, map->walls[i].b);
    if (!walled) return refuse(maker, 0, "a plan needs walls, the map has none");
    return SL_OK;
}

static bool whole(sl_point point) {
    return floor(point.x) == point.x && floor(point.y) == point.y;
}

/// Places one axis: the squares that the walls span, and the solid ones around. Walls keep their
/// coordinates where these are not negative and there are enough squares. Else the first wall
/// stands at 1, or at 0 where the walls need all squares.
static bool place(double low, double high, size_t *before, size_t *size) {
    if (high - low > MOST_SQUARES) return false;
    const size_t span = (size_t)(high - low);
    if (low >= 0 && low + (double)span + (low > 0) <= MOST_SQUARES)
        *before = (size_t)low;
    else
        *before = span + 2 <= MOST_SQUARES;
    *size = *before + span + (*before > 0);
    return true;
}

static sl_status lay_out(plan_maker *maker) {
    const sl_map *map = maker->map;
    const sl_wall *first = &map->walls[0];
    sl_box box = {.min = first->a, .max = first->a};
    for (size_t i = 0; i < map->wall_count; i++) {
        const sl_wall *wall = &map->walls[i];
        if (wall->a.x != wall->b.x && wall->a.y != wall->b.y)
            return refuse_wall(maker, wall, "a plan has horizontal and vertical walls only");
        if (!whole(wall->a) || !whole(wall->b))
            return refuse_wall(maker, wall, "a plan has walls at whole coordinates only");
        box.min.x = fmin(box.min.x, fmin(wall->a.x, wall->b.x));
        box.min.y = fmin(box.min.y, fmin(wall->a.y, wall->b.y));
        box.max.x = fmax(box.max.x, fmax(wall->a.x, wall->b.x));
        box.max.y = fmax(box.max.y, fmax(wall->a.y, wall->b.y));
        if (!place(box.min.x, box.max.x, &maker->left, &maker->width) ||
            !place(box.min.y, box.max.y, &maker->bottom, &maker->height))
            return refuse_wall(maker, wall, "more than 4096 x 4096 squares up to this wall");
    }
    maker->walls = box;
    if ((double)maker->left != box.min.x || (double)maker->bottom != box.min.y)
        sl_note(maker->context, "the plan stands %g %g off the map's place",
                (double)maker->left - box.min.x, (double)maker->bottom - box.min.y);
    return SL_OK;
}

static size_t column_of(const plan_maker *maker, double x) {
    return (size_t)(x - maker->walls.min.x) + maker->left;
}

static size_t level_of(const plan_maker *maker, double y) {
    return (size_t)(y - maker->walls.min.y) + maker->bottom;
}

/// The marks of a square of the plan, or of one around it (column or level SIZE_MAX for -1).
static unsigned char *marks(const plan_maker *maker, size_t column, size_t level) {
    return &maker->squares[(level + 1) * (maker->width + 2) + column + 1];
}

/// A wall as unit edges: `count` squares from (column, level) on, each with the wall to its left
/// (upright) or below it.
typedef struct edges {
    size_t column, level, count;
    bool upright;
} edges;

static edges run_of(const plan_maker *maker, const sl_wall *wall) {
    const bool upright = wall->a.x == wall->b.x;
    const size_t columns[] = {column_of(maker, wall->a.x), column_of(maker, wall->b.x)};
    const size_t levels[] = {level_of(maker, wall->a.y), level_of(maker, wall->b.y)};
    const bool swapped = upright ? levels[1] < levels[0] : columns[1] < columns[0];
    const size_t *along = upright ? levels : columns;
    return (edges){.column = columns[swapped],
                   .level = levels[swapped],
                   .count = along[!swapped] - along[swapped],
                   .upright = upright};
}

static void mark_walls(const plan_maker *maker) {
    for (size_t i = 0; i < maker->map->wall_count; i++) {
        const edges run = run_of(maker, &maker->map->walls[i]);
        for (size_t k = 0; k < run.count; k++) {
            if (run.upright)
                *marks(maker, run.column, run.level + k) |= WALL_LEFT;
            else
                *marks(maker, run.column + k, run.level) |= WALL_BELOW;
        }
    }
}

typedef SL_ARRAY(uint32_t) squares;

static sl_status push_square(sl_context *context, squares *list, size_t square) {
    SL_TRY(SL_ARRAY_ROOM(context, list, 1));
    list->items[list->count++] = (uint32_t)square;
    return SL_OK;
}

/// Floods from the squares in `now` up to the walls; squares behind a wall go to `next`.
static sl_status flood(const plan_maker *maker, squares *now, squares *next) {
    const size_t stride = maker->width + 2, rows = maker->height + 2;
    unsigned char *all = maker->squares;
    while (now->count) {
        const size_t at = now->items[--now->count];
        const size_t column = at % stride, level = at / stride;
        const size_t to[] = {at - 1, at + 1, at - stride, at + stride};
        const bool there[] = {column > 0, column + 1 < stride, level > 0, level + 1 < rows};
        for (int side = 0; side < 4; side++) {
            if (!there[side] || all[to[side]] & KNOWN) continue;
            // A wall is marked in the right or upper one of the two squares.
            const size_t marked = to[side] > at ? to[side] : at;
            if (all[marked] & (side < 2 ? WALL_LEFT : WALL_BELOW)) {
                SL_TRY(push_square(maker->context, next, to[side]));
                continue;
            }
            all[to[side]] |= KNOWN | (all[at] & OPEN);
            SL_TRY(push_square(maker->context, now, to[side]));
        }
    }
    return SL_OK;
}

/// Finds the open squares: those an odd number of walls away from outside, on the way that crosses
/// the fewest walls.
static sl_status find_open(const plan_maker *maker) {
    squares now = {0}, next = {0};
    maker->squares[0] |= KNOWN;
    sl_status status = push_square(maker->context, &now, 0);
    for (unsigned char side = OPEN; status == SL_OK && now.count; side ^= OPEN) {
        status = flood(maker, &now, &next);
        for (size_t i = 0; status == SL_OK && i < next.count; i++) {
            unsigned char *mark = &maker->squares[next.items[i]];
            if (*mark & KNOWN) continue;
            *mark |= KNOWN | side;
            status = push_square(maker->context, &now, next.items[i]);
        }
        next.count = 0;
    }
    sl_free(maker->context, now.items);
    sl_free(maker->context, next.items);
    return status;
}

/// Whether the squares beside a wall are what the wall says of its ground; `here` is the one to the
/// right of an upright wall, or above a level one.
static bool is_as_said(const sl_wall *wall, bool upright, unsigned char here, unsigned char there) {
    const bool rising = sli_compare_points(wall->a, wall->b) < 0;
    const uint32_t ground = rising ? wall->ground : sl_ground_turned(wall->ground);
    const unsigned char left = upright ? there : here, right = upright ? here : there;
    return !((ground & SL_SOLID_LEFT && left & OPEN) || (ground & SL_SOLID_RIGHT && right & OPEN) ||
             (ground & SL_OPEN_LEFT && !(left & OPEN)) ||
             (ground & SL_OPEN_RIGHT && !(right & OPEN)));
}

/// Every unit of every wall must have a solid square on one side and an open one on the other, and
/// those on which it says that the ground is solid or open.
static sl_status check_walls(const plan_maker *maker) {
    for (size_t i = 0; i < maker->map->wall_count; i++) {
        const edges run = run_of(maker, &maker->map->walls[i]);
        for (size_t k = 0; k < run.count; k++) {
            const size_t column = run.column + (run.upright ? 0 : k);
            const size_t level = run.level + (run.upright ? k : 0);
            const unsigned char here = *marks(maker, column, level);
            const unsigned char there = *marks(maker, column - run.upright, level - !run.upright);
            if ((here ^ there) & OPEN) {
                if (is_as_said(&maker->map->walls[i], run.upright, here, there)) continue;
                return refuse_wall(maker, &maker->map->walls[i],
                                   "a plan cannot say which side of it is solid ground");
            }
            return refuse_wall(maker, &maker->map->walls[i],
                               here & OPEN ? "open floor on both sides"
                                           : "no floor at either side");
        }
    }
    return SL_OK;
}

/// The plan's text, without doors and starts.
static sl_status make_text(plan_maker *maker) {
    const size_t stride = maker->width + 1;
    maker->text = sl_alloc_array(maker->context, maker->height, stride);
    maker->rows = sl_alloc_array(maker->context, maker->height, sizeof *maker->rows);
    if (!maker->text || !maker->rows) return SL_NO_MEMORY;
    for (size_t level = 0; level < maker->height; level++) {
        char *row = maker->text + (maker->height - 1 - level) * stride;
        for (size_t column = 0; column < maker->width; column++)
            row[column] = *marks(maker, column, level) & OPEN ? '.' : '#';
        row[maker->width] = '\n';
        maker->rows[maker->height - 1 - level] = (sli_word){row, maker->width};
    }
    return SL_OK;
}

/// The open square that holds a point (on an edge, the one right of it or above); NULL for none.
static char *open_square(const plan_maker *maker, sl_point point, size_t *row, size_t *column) {
    const double x = point.x - maker->walls.min.x, y = point.y - maker->walls.min.y;
    if (!(x >= 0 && y >= 0 && point.x < maker->walls.max.x && point.y < maker->walls.max.y))
        return NULL;
    *column = (size_t)x + maker->left;
    *row = maker->height - 1 - ((size_t)y + maker->bottom);
    char *at = &maker->text[*row * (maker->width + 1) + *column];
    return *at == '#' ? NULL : at;
}

/// A segment in the coordinates of the plan.
static sl_segment moved(const plan_maker *maker, sl_segment segment) {
    const double x = (double)maker->left - maker->walls.min.x;
    const double y = (double)maker->bottom - maker->walls.min.y;
    return (sl_segment){{segment.a.x + x, segment.a.y + y}, {segment.b.x + x, segment.b.y + y}};
}

/// Puts a door into a square, if reading the plan then finds the same door.
static sl_status put_door(const plan_maker *maker, const sl_door *door) {
    const sli_grid plan = plan_of(maker->rows, maker->height);
    const sl_segment at = moved(maker, door->segment);
    size_t row, column;
    sl_segment found;
    if (!door->open)
        return refuse_segment(maker, door->line, "door", door->segment.a, door->segment.b,
                              "a plan has open doors only");
    char *here = open_square(maker,
                             (sl_point){fmin(door->segment.a.x, door->segment.b.x),
                                        fmin(door->segment.a.y, door->segment.b.y)},
                             &row, &column);
    if (!here || *here != '.' || !door_segment(&plan, row, column, &found) ||
        !((sli_same_point(at.a, found.a) && sli_same_point(at.b, found.b)) ||
          (sli_same_point(at.a, found.b) && sli_same_point(at.b, found.a))))
        return refuse_segment(maker, door->line, "door", door->segment.a, door->segment.b,
                              "a plan's doors stand in the middle of a square, from one solid "
                              "square to the one opposite");
    *here = '+';
    return SL_OK;
}

static sl_status put_things(const plan_maker *maker) {
    const sl_map *map = maker->map;
    const sli_grid plan = plan_of(maker->rows, maker->height);
    for (size_t i = 0; i < map->door_count; i++) SL_TRY(put_door(maker, &map->doors[i]));
    if (map->door_count) sl_note(maker->context, "a plan's doors are named in reading order");
    size_t shifted = 0;
    for (size_t i = 0; i < map->start_count; i++) {
        const sl_start *start = &map->starts[i];
        size_t row, column;
        char *here = open_square(maker, start->at, &row, &column);
        if (!here) return refuse(maker, start->line, "the start stands in a solid square");
        if (*here != '.')
            return refuse(maker, start->line, "the start's square holds a door or a start already");
        *here = '@';
        const sl_point at = moved(maker, (sl_segment){start->at, start->at}).a;
        shifted += start->heading != 0 || !sli_same_point(at, middle(&plan, row, column));
    }
    if (shifted)
        sl_note(maker->context, "%zu starts moved to the middle of their square, heading 0",
                shifted);
    return SL_OK;
}

static sl_status make_plan(plan_maker *maker) {
    SL_TRY(refuse_others(maker));
    SL_TRY(lay_out(maker));
    maker->squares = sl_alloc_array(maker->context, maker->height + 2, maker->width + 2);
    if (!maker->squares) return SL_NO_MEMORY;
    mark_walls(maker);
    SL_TRY(find_open(maker));
    SL_TRY(check_walls(maker));
    SL_TRY(make_text(maker));
    return put_things(maker);
}

sl_status sli_map_print_plan(sl_context *context, const sl_map *map, FILE *stream) {
    plan_maker maker = {.context = context, .map = map};
    const sl_status status = make_plan(&maker);
    if (status == SL_OK) fwrite(maker.text, maker.width + 1, maker.height, stream);
    sl_free(context, maker.squares);
    sl_free(context, maker.text);
    sl_free(context, maker.rows);
    return status;
}
