/// Walls from lines, curves and tiles, and how exactly a file writes their places.
///
/// A curve becomes chords that end on the curve. Their number follows from the tolerance: a chord
/// over an angle s of a circle is r (1 - cos(s / 2)) from it, and n even steps of a curve B are at
/// most max |B''| / (8 n^2) from it. Tiles of one grid are gathered first, so that a wall between a
/// solid and an open square is drawn once and runs as far as it can.
#include "io/parts/shapes.h"

#include "base/base.h"
#include "geometry/length.h"
#include "io/parts/limits.h"
#include "io/parts/things.h"
#include "sightline/support.h"

#include <inttypes.h>
#include <math.h>

// --- digits

/// The unit of the last decimal place of a number as written: 0.01 for "2.50"; at most 1.
static double decimal_unit(const char *text, size_t length) {
    const char *end = text + sli_number_length(text, length), *at = text;
    int places = 0;
    for (bool behind = false; at < end && (*at | 0x20) != 'e'; at++) {
        places -= behind;
        behind |= *at == '.';
    }
    double exponent = 0, unit = 0;
    if (at < end) (void)sl_number_read(at + 1, (size_t)(end - at - 1), &exponent);
    exponent += places;
    if (exponent >= 0) return 1;
    char power[32];
    snprintf(power, sizeof power, "1e%d", (int)fmax(exponent, -300));
    (void)sl_number_read(power, strlen(power), &unit);
    return unit;
}

double sli_shortest_unit(double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value, text);
    return decimal_unit(text, strlen(text));
}

void sli_keep_finest(double *finest, double unit) {
    if (unit > 0 && (*finest == 0 || unit < *finest)) *finest = unit;
}

/// An end and a wall that are each off by a unit are 2 units apart. Cleaning takes an end to a wall
/// within half of the tolerance: that makes 4. One more is for what transforms add.
#define UNITS 5

static double precision_of(const sl_map *map, double finest) {
    const sl_box b = sl_map_bounds(map);
    const double size = fmax(b.max.x - b.min.x, b.max.y - b.min.y);
    const double largest =
        fmax(fmax(fabs(b.min.x), fabs(b.min.y)), fmax(fabs(b.max.x), fabs(b.max.y)));
    // With so coarse a unit, the drawing lies on a grid: its places are equal or far apart.
    if (finest == 0 || finest > 1e-3 * size) return 0;
    // Digits beyond the rounding of doubles say nothing.
    return UNITS * fmax(finest, 0x1p-51 * largest);
}

uint64_t sli_digits_of(const char *text, size_t length) {
    sl_random hash = {0xcbf29ce484222325u}; // FNV-1a, and one round of mixing
    for (size_t i = 0; i < length; i++)
        hash.state = (hash.state ^ (unsigned char)text[i]) * 0x100000001b3u;
    return sl_random_next(&hash);
}

uint64_t sli_digits_of_number(double value) {
    char text[SL_NUMBER_TEXT];
    sl_number_write(value + 0.0, text);
    return sli_digits_of(text, strlen(text));
}

double sli_marked_precision(const sl_map *map, double finest, const char *mark, uint64_t sum) {
    char expected[20];
    double precision;
    snprintf(expected, sizeof expected, "%016llx ", (unsigned long long)sum);
    const bool marked = mark && strncmp(mark, expected, 17) == 0 &&
                        sl_number_read(mark + 17, strlen(mark + 17), &precision) &&
                        precision >= 0 && precision <= SL_COORDINATE_MAX;
    if (!marked) precision = precision_of(map, finest);
    return sli_coordinate(precision); // map text has no smaller numbers
}

// --- the pen

/// So many chords of one curve and no more.
#define MOST_CHORDS 4096

static const double pi = 3.14159265358979323846;

sli_affine sli_affine_after(sli_affine outer, sli_affine inner) {
    return (sli_affine){.xx = outer.xx * inner.xx + outer.xy * inner.yx,
                        .xy = outer.xx * inner.xy + outer.xy * inner.yy,
                        .x0 = outer.xx * inner.x0 + outer.xy * inner.y0 + outer.x0,
                        .yx = outer.yx * inner.xx + outer.yy * inner.yx,
                        .yy = outer.yx * inner.xy + outer.yy * inner.yy,
                        .y0 = outer.yx * inner.x0 + outer.yy * inner.y0 + outer.y0};
}

sl_point sli_affine_apply(sli_affine affine, sl_point point) {
    return (sl_point){affine.xx * point.x + affine.xy * point.y + affine.x0,
                      affine.yx * point.x + affine.yy * point.y + affine.y0};
}

sli_affine sli_affine_turn(double degrees) {
    double sine = sin(degrees * (pi / 180)), cosine = cos(degrees * (pi / 180));
    const double quarters = remainder(degrees / 90, 4);
    if (quarters == rint(quarters)) {
        sine = quarters == 1 ? 1 : quarters == -1 ? -1 : 0;
        cosine = quarters == 0 ? 1 : sine != 0 ? 0 : -1;
    }
    return (sli_affine){.xx = cosine, .xy = -sine, .yx = sine, .yy = cosine};
}

/// A place in the map; what is too small to be used is 0.
static bool place(const sli_pen *pen, sl_point point, sl_point *out) {
    *out = sli_coordinates(sli_affine_apply(pen->affine, point));
    return sl_coordinate_usable(out->x) && sl_coordinate_usable(out->y);
}

sl_status sli_pen_line(sli_pen *pen, sl_point to) {
    sl_point a, b;
    pen->too_far = !place(pen, pen->at, &a) || !place(pen, to, &b);
    if (pen->too_far)
        return sl_fail_at(pen->context, pen->name, pen->line,
                          "a coordinate is out of range: expected a magnitude up to %g",
                          SL_COORDINATE_MAX);
    pen->at = to;
    if (a.x == b.x && a.y == b.y) {
        pen->points++;
        return SL_OK;
    }
    SL_TRY(sli_limit_check(pen->context, pen->name, pen->line, SLI_LIMIT_WALLS, pen->walls + 1,
                           "the drawing gives"));
    if (pen->walls++ % 1024 == 0) SL_TRY(sl_check_cancelled(pen->context));
    return sl_map_add_wall(pen->context, pen->map, a, b, pen->item ? pen->item : pen->line);
}

void sli_pen_digits(sli_pen *pen, const char *text, size_t length, double unit) {
    const sli_affine *affine = &pen->affine;
    const double scale =
        fmax(sli_length(affine->xx, affine->yx), sli_length(affine->xy, affine->yy));
    sli_keep_finest(&pen->finest, decimal_unit(text, length) * unit * scale);
    pen->sum += sli_digits_of(text, length);
}

/// How far the map makes a vector at most.
static double length_in_map(const sli_affine *affine, sl_point vector) {
    return sli_length(affine->xx * vector.x + affine->xy * vector.y,
                      affine->yx * vector.x + affine->yy * vector.y);
}

/// A chord over an angle s is r (1 - cos(s / 2)) from its circle. An ellipse is a circle of its
/// greatest radius pressed together, and so are the distances; the two given radii are no less
/// than that one when added up as the legs of a right angle.
static int arc_chords(const sli_pen *pen, sl_point u, sl_point v, double sweep) {
    const double radius =
        sli_length(length_in_map(&pen->affine, u), length_in_map(&pen->affine, v));
    double share = pen->tolerance > 0 ? pen->tolerance / radius : 0.005;
    if (!(share < 1)) share = 1;
    const double count = ceil(fabs(sweep) / (2 * acos(1 - share)));
    return count >= 1 && count <= MOST_CHORDS ? (int)count : count > MOST_CHORDS ? MOST_CHORDS : 1;
}

sl_status sli_pen_arc(sli_pen *pen, sl_point centre, sl_point u, sl_point v, double sweep,
                      sl_point to) {
    const int count = arc_chords(pen, u, v, sweep);
    // A closed curve keeps an area.
    const int least = fabs(sweep) > 1.75 * pi ? 4 : 1;
    const int chords = count > least ? count : least;
    for (int i = 1; i < chords; i++) {
        const double angle = sweep * i / chords;
        const double cosine = cos(angle), sine = sin(angle);
        SL_TRY(sli_pen_line(pen, (sl_point){centre.x + cosine * u.x + sine * v.x,
                                            centre.y + cosine * u.y + sine * v.y}));
    }
    return sli_pen_line(pen, to);
}

/// n chords of even steps are no farther from the curve than max |B''| / (8 n²); for a cubic curve
/// that second derivative is at most 6 times the larger second difference of its control points.
static int cubic_chords(const sli_pen *pen, const sl_point p[4]) {
    double bend = 0, size = 0;
    for (int i = 0; i < 2; i++) {
        const sl_point second = {p[i].x - 2 * p[i + 1].x + p[i + 2].x,
                                 p[i].y - 2 * p[i + 1].y + p[i + 2].y};
        bend = fmax(bend, 6 * length_in_map(&pen->affine, second));
    }
    for (int i = 1; i < 4; i++) {
        const sl_point away = {p[i].x - p[0].x, p[i].y - p[0].y};
        size = fmax(size, length_in_map(&pen->affine, away));
    }
    const double tolerance = pen->tolerance > 0 ? pen->tolerance : size / 200;
    const double count = ceil(sqrt(bend / (8 * tolerance)));
    return count >= 1 && count <= MOST_CHORDS ? (int)count : count > MOST_CHORDS ? MOST_CHORDS : 1;
}

sl_status sli_pen_cubic(sli_pen *pen, sl_point first, sl_point second, sl_point to) {
    const sl_point p[4] = {pen->at, first, second, to};
    const int chords = cubic_chords(pen, p);
    for (int i = 1; i < chords; i++) {
        const double t = (double)i / chords, s = 1 - t;
        const double w[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        SL_TRY(sli_pen_line(
            pen, (sl_point){w[0] * p[0].x + w[1] * p[1].x + w[2] * p[2].x + w[3] * p[3].x,
                            w[0] * p[0].y + w[1] * p[1].y + w[2] * p[2].y + w[3] * p[3].y}));
    }
    return sli_pen_line(pen, to);
}

// --- tiles

#define MOST_SIDE  1048576
#define MOST_GRIDS 4096
/// Tiles are counted from the first block of a grid; farther out they are on another grid.
#define FARTHEST 1e9

void sli_tiles_destroy(sl_context *context, sli_tiles *tiles) {
    for (size_t i = 0; i < tiles->blocks.count; i++)
        sl_free(context, tiles->blocks.items[i].squares);
    sl_free(context, tiles->blocks.items);
    *tiles = (sli_tiles){0};
}

/// Whether tiles of this size have corners of their own, up to `count` of them from `from` on, and
/// a grid of such tiles has usable coordinates.
static bool can_be_told_apart(double from, double step, size_t count) {
    const double to = from + step * (double)count;
    const double farthest = fmax(fabs(from), fabs(to));
    return step >= 1e-9 && farthest <= 1e15 && farthest / step <= 1e12;
}

sl_status sli_tiles_check(sl_context *context, const sli_tiles *tiles, const char *name,
                          unsigned line, const char *what, uint64_t columns, uint64_t rows) {
    const uint64_t all = sli_limit_sum(tiles->squares, sli_limit_product(columns, rows));
    char text[160];
    snprintf(text, sizeof text, "%s, %" PRIu64 " x %" PRIu64 "%s", what, columns, rows,
             tiles->squares ? ", with those before" : "");
    return sli_limit_check(context, name, line, SLI_LIMIT_SQUARES, all, text);
}

sl_status sli_tiles_add(sl_context *context, sli_tiles *tiles, const char *name, sl_point corner,
                        sl_point step, size_t columns, size_t rows, char **squares) {
    SL_TRY(sli_tiles_check(context, tiles, name, 0, "its layers", columns, rows));
    if (!can_be_told_apart(corner.x, step.x, columns) || !can_be_told_apart(corner.y, step.y, rows))
        return sl_fail_at(context, name, 0,
                          "%zu x %zu tiles of %g x %g pixels at %g %g: out of range", columns, rows,
                          step.x, step.y, corner.x, corner.y);
    SL_TRY(SL_ARRAY_ROOM(context, &tiles->blocks, 1));
    char *open = sl_alloc_array(context, rows, columns);
    if (!open) return SL_NO_MEMORY;
    memset(open, '.', rows * columns);
    tiles->blocks.items[tiles->blocks.count++] = (sli_tile_block){
        .corner = corner, .step = step, .columns = columns, .rows = rows, .squares = open};
    tiles->squares += (uint64_t)columns * rows;
    *squares = open;
    return SL_OK;
}

/// Rounding of offsets moves a block by less than this share of a tile.
#define ON_GRID 1e-6

/// Where a block lies on the grid of the first one, in tiles; false where it is on another.
static bool place_on(const sli_tile_block *first, const sli_tile_block *block, double *column,
                     double *row) {
    if (block->step.x != first->step.x || block->step.y != first->step.y) return false;
    const double x = (block->corner.x - first->corner.x) / first->step.x;
    const double y = (block->corner.y - first->corner.y) / first->step.y;
    *column = rint(x);
    *row = rint(y);
    return fabs(*column - x) < ON_GRID && fabs(*row - y) < ON_GRID && fabs(*column) < FARTHEST &&
           fabs(*row) < FARTHEST;
}

/// The blocks of one grid: which they are, and the tiles that they span.
typedef struct span {
    const sli_tile_block *first;
    double left, top, right, bottom;
} span;

static span find_span(const sli_tiles *tiles, const sli_tile_block *first) {
    span all = {.first = first};
    for (size_t i = 0; i < tiles->blocks.count; i++) {
        const sli_tile_block *block = &tiles->blocks.items[i];
        double column, row;
        if (block->done || !place_on(first, block, &column, &row)) continue;
        all.left = fmin(all.left, column);
        all.top = fmin(all.top, row);
        all.right = fmax(all.right, column + (double)block->columns);
        all.bottom = fmax(all.bottom, row + (double)block->rows);
    }
    return all;
}

/// Puts one kind of square of a block in its place.
static void put(const sli_tile_block *block, size_t column, size_t row, char kind, sli_grid *grid) {
    const size_t width = grid->rows[0].length;
    for (size_t y = 0; y < block->rows; y++) {
        const char *from = block->squares + y * block->columns;
        char *to = grid->squares + (row + y) * width + column;
        for (size_t x = 0; x < block->columns; x++)
            if (from[x] == kind || (kind == '.' && from[x] != ' ')) to[x] = kind;
    }
}

/// Whether all blocks lie on the grid of the first one.
static bool is_only_grid(const sli_tiles *tiles, const sli_tile_block *first) {
    bool only = true;
    for (size_t i = 0; i < tiles->blocks.count && only; i++) {
        double column, row;
        only = place_on(first, &tiles->blocks.items[i], &column, &row);
    }
    return only;
}

static void put_all(sli_tiles *tiles, const span *all, char kind, sli_grid *grid) {
    // The first block is what the others are held against: it is done last.
    const size_t first = (size_t)(all->first - tiles->blocks.items);
    for (size_t i = tiles->blocks.count; i-- > first;) {
        sli_tile_block *block = &tiles->blocks.items[i];
        double column, row;
        if (block->done || !place_on(all->first, block, &column, &row)) continue;
        put(block, (size_t)(column - all->left), (size_t)(row - all->top), kind, grid);
        block->done = kind == '#';
    }
}

/// Which of two squares is water beside an open one: 1 the first, 2 the second, 0 none.
static int shore_of(char one, char other) {
    if ((one == '~') == (other == '~') || one == '#' || other == '#') return 0;
    return one == '~' ? 1 : 2;
}

/// The shores of one line of the grid, each as long as it can be. `upright` lines lie before a
/// column, the others above a row.
static sl_status add_shores_of_line(sl_context *context, const sli_grid *grid, bool upright,
                                    size_t line, sl_map *map) {
    const size_t length = upright ? grid->count : grid->rows[0].length;
    size_t from = 0;
    int last = 0;
    for (size_t i = 0; i <= length; i++) {
        const int now =
            i == length ? 0
            : upright
                ? shore_of(sli_grid_square(grid, i, line - 1), sli_grid_square(grid, i, line))
                : shore_of(sli_grid_square(grid, line - 1, i), sli_grid_square(grid, line, i));
        if (now == last) continue;
        const sl_point a =
            upright ? sli_grid_corner(grid, from - 1, line) : sli_grid_corner(grid, line - 1, from);
        const sl_point b =
            upright ? sli_grid_corner(grid, i - 1, line) : sli_grid_corner(grid, line - 1, i);
        if (last) SL_TRY(sl_map_add_wall(context, map, a, b, 0));
        from = i;
        last = now;
    }
    return SL_OK;
}

/// Water is seen over, and stops steps where it ends at open ground.
static sl_status add_shores(sl_context *context, const sli_grid *grid, sl_map *map) {
    const size_t first = map->wall_count;
    for (size_t row = 0; row <= grid->count; row++)
        SL_TRY(add_shores_of_line(context, grid, false, row, map));
    for (size_t column = 0; column <= grid->rows[0].length; column++) {
        SL_TRY(sl_check_cancelled(context));
        SL_TRY(add_shores_of_line(context, grid, true, column, map));
    }
    return sl_map_walls_stop(context, map, first, SL_STOPS_STEPS);
}

static sl_status add_grid(sl_context *context, sli_tiles *tiles, const char *name, const span *all,
                          const sli_tiles_options *options, bool closed, sl_map *map) {
    const double width = all->right - all->left, height = all->bottom - all->top;
    if (!can_be_told_apart(options->top, all->first->step.y, 0))
        return sl_fail_at(context, name, 0, "its tiles are out of range: its lower edge is at %g",
                          options->top);
    if (width > MOST_SIDE || height > MOST_SIDE)
        return sl_fail_at(context, name, 0,
                          "its tiles are spread over %.0f x %.0f squares: more than 2^20 on a side",
                          width, height);
    char what[96];
    snprintf(what, sizeof what, "its tiles are spread over %.0f x %.0f", width, height);
    SL_TRY(sli_limit_check(context, name, 0, SLI_LIMIT_SQUARES, (uint64_t)width * (uint64_t)height,
                           what));
    const sl_point step = all->first->step, corner = all->first->corner;
    sli_grid grid;
    SL_TRY(sli_grid_create(context, (size_t)width, (size_t)height, &grid));
    if (options->solid_between) {
        memset(grid.squares, '#', (size_t)width * (size_t)height);
        put_all(tiles, all, '.', &grid);
    }
    if (tiles->water) put_all(tiles, all, '~', &grid);
    put_all(tiles, all, '#', &grid);
    grid.step = step;
    grid.origin =
        (sl_point){corner.x + all->left * step.x, options->top - (corner.y + all->bottom * step.y)};
    grid.open_outside = !closed;
    grid.sure = !options->other_ground && is_only_grid(tiles, all->first);
    sl_status status = SL_OK;
    if (options->things) status = sli_things_place(options->things, &grid);
    if (status == SL_OK)
        status = options->add_walls ? options->add_walls(options->user, &grid, map)
                                    : sli_grid_add_walls(context, &grid, map);
    if (status == SL_OK && tiles->water) status = add_shores(context, &grid, map);
    sli_grid_destroy(context, &grid);
    return status;
}

sl_status sli_tiles_add_walls(sl_context *context, sli_tiles *tiles, const char *name,
                              const sli_tiles_options *options, sl_map *map) {
    size_t count = 0;
    for (size_t i = 0; i < tiles->blocks.count; i++) {
        if (tiles->blocks.items[i].done) continue;
        SL_TRY(sl_check_cancelled(context));
        if (count == MOST_GRIDS)
            return sl_fail_at(context, name, 0, "its layers lie on more than %d grids", MOST_GRIDS);
        const span all = find_span(tiles, &tiles->blocks.items[i]);
        const bool closed = count == 0 || options->all_closed;
        SL_TRY(add_grid(context, tiles, name, &all, options, closed, map));
        count++;
    }
    return SL_OK;
}
