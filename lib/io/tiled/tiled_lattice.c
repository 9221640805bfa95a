/// How the tiles of Tiled's maps lie: squares, diamonds or hexagons.
///
/// Diamonds are squares in another coordinate system, the *plan*. There all that is known of
/// squares holds: long walls, doors, starts. At the end the plan is projected onto the screen:
///
///     plan    a b c        screen    a          x = (p - q) w / 2 s,   y = (p + q) h / 2 s
///             d e f                d   b
///                                g   e   c      for tiles of w x h pixels, squares of side s
///
/// Isometric maps have their tiles and objects in the plan. Staggered maps have them on the screen.
/// A staggered block of tiles is a block of the plan whose corners belong to no tile.
///
/// Hexagons have walls of their own. Their corners lie on lines with whole numbers, so that
/// neighbours have equal corners. A side is a wall where just one of its two tiles is solid. A tile
/// looks at three of its sides; the neighbours look at the other three. Time O(tiles).
#include "io/tiled/tiled.h"

#include <math.h>

// --- the head of a map

/// Larger tiles and sides of hexagons are refused.
#define MOST_PIXELS (1 << 20)

static sl_status read_word(const sli_json *map, const char *key, const char *const *words,
                           size_t count, size_t *index) {
    const sli_json member = sli_json_member(map, key);
    const char *text;
    if (!member.value) return SL_OK;
    SL_TRY(sli_json_text(&member, &text));
    for (*index = 0; *index < count; ++*index)
        if (strcmp(text, words[*index]) == 0) return SL_OK;
    return sli_json_fail(&member, "'%s' is unknown", sli_show((sli_word){text, strlen(text)}).text);
}

/// Tiled takes odd sizes of staggered tiles as one less.
static double even(double pixels) {
    return 2 * floor(pixels / 2);
}

static sl_status read_stagger(const sli_json *map, sli_tiled_lattice *lattice) {
    static const char *const axes[] = {"y", "x"}, *const indices[] = {"odd", "even"};
    size_t axis = 0, index = 0;
    int64_t side = 0;
    const sli_json length = sli_json_member(map, "hexsidelength");
    SL_TRY(read_word(map, "staggeraxis", axes, 2, &axis));
    SL_TRY(read_word(map, "staggerindex", indices, 2, &index));
    if (lattice->orientation == SLI_TILED_HEXAGONAL)
        SL_TRY(sli_json_whole_if(&length, 0, MOST_PIXELS, &side));
    lattice->tile = (sl_point){even(lattice->tile.x), even(lattice->tile.y)};
    lattice->stagger_x = axis == 1;
    lattice->stagger_even = index == 1;
    // Hexagons without straight sides are diamonds.
    if (!side) lattice->orientation = SLI_TILED_STAGGERED;
    lattice->side = (double)side;
    const double along = lattice->stagger_x ? lattice->tile.x : lattice->tile.y;
    if (lattice->side > along)
        return sli_json_fail(&length, "%.0f is more than the size of a tile, %.0f", lattice->side,
                             along);
    lattice->slope = floor((along - lattice->side) / 2);
    return SL_OK;
}

/// The height of the map on the screen, whose lower edge is 0 in the map.
static double height_of(const sli_tiled_lattice *lattice, double columns, double rows) {
    const double h = lattice->tile.y;
    switch (lattice->orientation) {
    case SLI_TILED_ISOMETRIC:
        return (columns + rows) * h / 2;
    case SLI_TILED_STAGGERED:
    case SLI_TILED_HEXAGONAL:
        if (lattice->stagger_x) return rows * h + (columns > 1 ? h / 2 : 0);
        return rows * (lattice->slope + lattice->side) + lattice->slope;
    case SLI_TILED_ORTHOGONAL:
        break;
    }
    return rows * h;
}

sl_status sli_tiled_read_lattice(const sli_json *map, sli_tiled_lattice *lattice) {
    static const char *const orientations[] = {"orthogonal", "isometric", "staggered", "hexagonal"};
    const sli_json width = sli_json_member(map, "tilewidth");
    const sli_json height = sli_json_member(map, "tileheight");
    const sli_json column_count = sli_json_member(map, "width");
    const sli_json row_count = sli_json_member(map, "height");
    size_t orientation = 0;
    int64_t columns = 0, rows;
    *lattice = (sli_tiled_lattice){0};
    SL_TRY(sli_json_object(map));
    SL_TRY(read_word(map, "orientation", orientations, 4, &orientation));
    lattice->orientation = (sli_tiled_orientation)orientation;
    if (!width.value || !height.value)
        return sli_json_fail(map,
                             "it does not say how large its tiles are (%s); a map saved by "
                             "Tiled does",
                             width.value ? "tileheight" : "tilewidth");
    SL_TRY(sli_json_number(&width, &lattice->tile.x));
    SL_TRY(sli_json_number(&height, &lattice->tile.y));
    SL_TRY(sli_json_whole(&row_count, 0, INT32_MAX, &rows));
    lattice->step = lattice->tile;
    if (lattice->orientation != SLI_TILED_ORTHOGONAL) {
        int64_t whole;
        SL_TRY(sli_json_whole(&width, 2, MOST_PIXELS, &whole));
        SL_TRY(sli_json_whole(&height, 2, MOST_PIXELS, &whole));
        SL_TRY(sli_json_whole(&column_count, 0, INT32_MAX, &columns));
    }
    const double w = lattice->tile.x, h = lattice->tile.y;
    if (lattice->orientation == SLI_TILED_ISOMETRIC) {
        lattice->step = (sl_point){h, h};
        lattice->left = (double)rows * w / 2;
    } else if (lattice->orientation != SLI_TILED_ORTHOGONAL) {
        SL_TRY(read_stagger(map, lattice));
        if (lattice->orientation == SLI_TILED_STAGGERED) {
            const double step = lattice->tile.x * lattice->tile.y / 2;
            lattice->step = (sl_point){step, step};
            lattice->left = lattice->stagger_even ? 0 : -lattice->tile.x / 2;
        } else {
            lattice->step = (sl_point){1, 1};
        }
    }
    lattice->height = height_of(lattice, (double)columns, (double)rows);
    return SL_OK;
}

// --- places

bool sli_tiled_has_plan(const sli_tiled_lattice *lattice) {
    return lattice->orientation == SLI_TILED_ISOMETRIC ||
           lattice->orientation == SLI_TILED_STAGGERED;
}

sli_affine sli_tiled_to_plan(const sli_tiled_lattice *lattice) {
    if (!sli_tiled_has_plan(lattice)) return SLI_AFFINE_NONE;
    const double x = lattice->step.x / lattice->tile.x, y = lattice->step.y / lattice->tile.y;
    return (sli_affine){
        .xx = x, .xy = y, .x0 = -x * lattice->left, .yx = -x, .yy = y, .y0 = x * lattice->left};
}

sli_affine sli_tiled_to_screen(const sli_tiled_lattice *lattice) {
    if (!sli_tiled_has_plan(lattice)) return SLI_AFFINE_NONE;
    const double x = lattice->tile.x / (2 * lattice->step.x);
    const double y = lattice->tile.y / (2 * lattice->step.y);
    return (sli_affine){.xx = x, .xy = -x, .x0 = lattice->left, .yx = y, .yy = y};
}

/// Whether the column, or the row, is the one of two that is moved by half a tile.
static bool is_moved(const sli_tiled_lattice *lattice, int64_t number) {
    return (number & 1) == (lattice->stagger_even ? 0 : 1);
}

sl_point sli_tiled_tile_at(const sli_tiled_lattice *lattice, int64_t column, int64_t row) {
    const double w = lattice->tile.x, h = lattice->tile.y;
    const double x = (double)column, y = (double)row;
    const double along = lattice->slope + lattice->side;
    switch (lattice->orientation) {
    case SLI_TILED_ISOMETRIC:
        return (sl_point){(x - y) * w / 2 + lattice->left - w / 2, (x + y) * h / 2};
    case SLI_TILED_STAGGERED:
    case SLI_TILED_HEXAGONAL:
        if (lattice->stagger_x)
            return (sl_point){x * along, y * h + (is_moved(lattice, column) ? h / 2 : 0)};
        return (sl_point){x * w + (is_moved(lattice, row) ? w / 2 : 0), y * along};
    case SLI_TILED_ORTHOGONAL:
        break;
    }
    return (sl_point){x * w, y * h};
}

/// Half of an even number, or of an odd one less 1.
static int64_t half(int64_t number) {
    return (number - (number & 1)) / 2;
}

void sli_tiled_square_of(const sli_tiled_lattice *lattice, int64_t *column, int64_t *row) {
    if (lattice->orientation != SLI_TILED_STAGGERED) return;
    // The upper left corner of the tile's box, in halves of tiles.
    const int64_t left = lattice->stagger_x ? *column : 2 * *column + is_moved(lattice, *row);
    const int64_t top = lattice->stagger_x ? 2 * *row + is_moved(lattice, *column) : *row;
    const int64_t across = left + 1 + !lattice->stagger_even;
    *column = half(top + across);
    *row = half(top - across);
}

void sli_tiled_plan_range(const sli_tiled_lattice *lattice, const sli_tiled_range *tiles,
                          sli_tiled_range *squares) {
    *squares = *tiles;
    if (lattice->orientation != SLI_TILED_STAGGERED) return;
    const int64_t wide = lattice->stagger_x ? 1 : 2, high = lattice->stagger_x ? 2 : 1;
    const int64_t left = wide * tiles->left, right = wide * tiles->right;
    const int64_t top = high * tiles->top, bottom = high * tiles->bottom;
    const int64_t shift = 1 + !lattice->stagger_even;
    *squares = (sli_tiled_range){.left = half(top + left + shift),
                                 .right = half(bottom + right + shift) + 1,
                                 .top = half(top - right - shift),
                                 .bottom = half(bottom - left - shift) + 1};
}

// --- from the plan to the screen

/// Corners of tiles become whole numbers of half pixels, exactly.
static sl_point project(const sli_tiled_lattice *lattice, sl_point at) {
    const double x = (at.x + at.y) * lattice->tile.x / (2 * lattice->step.x) + lattice->left;
    const double y = (at.x - at.y) * lattice->tile.y / (2 * lattice->step.y);
    const sl_point on = {x, lattice->height - y};
    return sli_coordinates(on);
}

static bool project_usable(const sli_tiled_lattice *lattice, sl_point *at) {
    *at = project(lattice, *at);
    return sl_coordinate_usable(at->x) && sl_coordinate_usable(at->y);
}

sl_status sli_tiled_project(const sli_json *json, const sli_tiled_lattice *lattice, sl_map *map) {
    if (!sli_tiled_has_plan(lattice)) return SL_OK;
    bool usable = true;
    size_t count = 0;
    for (size_t i = 0; i < map->wall_count; i++) {
        sl_wall wall = map->walls[i];
        usable &= project_usable(lattice, &wall.a) && project_usable(lattice, &wall.b);
        // Two places that rounding made one are no wall.
        if (wall.a.x != wall.b.x || wall.a.y != wall.b.y) map->walls[count++] = wall;
    }
    map->wall_count = count;
    for (size_t i = 0; i < map->door_count; i++) {
        sl_segment *at = &map->doors[i].segment;
        usable &= project_usable(lattice, &at->a) && project_usable(lattice, &at->b);
    }
    for (size_t i = 0; i < map->seam_count; i++) {
        sl_segment *at = &map->seams[i].segment;
        usable &= project_usable(lattice, &at->a) && project_usable(lattice, &at->b);
    }
    for (size_t i = 0; i < map->start_count; i++)
        usable &= project_usable(lattice, &map->starts[i].at);
    return usable ? SL_OK
                  : sli_json_fail(json,
                                  "a coordinate is out of range: expected a magnitude up "
                                  "to %g",
                                  SL_COORDINATE_MAX);
}

// --- hexagons. The columns are those whose tiles lie in line where rows are staggered, and the
// --- other way round: below, x is the axis with the straight sides, y the other one

typedef struct hexagons {
    sl_context *context;
    const sli_tiled_lattice *lattice;
    const sli_grid *grid;
    int64_t column, row; ///< of the first square
    sl_point offset;
    sl_map *map;
} hexagons;

/// Whether a tile is solid; `along` counts along the axis that has the straight sides.
static bool is_solid(const hexagons *all, int64_t along, int64_t across) {
    const bool x = all->lattice->stagger_x;
    // What is before the first row or column is a number too large for any.
    const size_t column = (size_t)((x ? along : across) - all->column);
    const size_t row = (size_t)((x ? across : along) - all->row);
    return sli_grid_solid(all->grid, row, column);
}

/// The corner where the lines with these numbers meet.
static sl_point hexagon_corner(const hexagons *all, int64_t line, int64_t half_tile) {
    const sli_tiled_lattice *lattice = all->lattice;
    const double along =
        (double)half(line) * (lattice->slope + lattice->side) + (line & 1 ? lattice->slope : 0);
    const double tile = lattice->stagger_x ? lattice->tile.y : lattice->tile.x;
    const double across = (double)half_tile * (tile / 2);
    const double x = lattice->stagger_x ? along : across, y = lattice->stagger_x ? across : along;
    return (sl_point){all->offset.x + x, lattice->height - (all->offset.y + y)};
}

/// A side of a tile that is solid or not, whose neighbour is the other.
static sl_status add_side(const hexagons *all, bool solid, sl_point a, sl_point b) {
    const uint32_t open = all->grid->sure ? SL_OPEN_RIGHT : 0;
    const uint32_t ground = SL_SOLID_LEFT | SL_SOLID_BEGINS | open;
    if (a.x == b.x && a.y == b.y) return SL_OK;
    // Exchanged axes turn left into right.
    SL_TRY(sl_map_add_wall(all->context, all->map, a, b, 0));
    all->map->walls[all->map->wall_count - 1].ground =
        solid == all->lattice->stagger_x ? ground : sl_ground_turned(ground);
    return SL_OK;
}

/// The three sides of a tile from its lower left corner on, against the clock:
///
///          2l+1 ____ 2l+2
///              /    \                  l: the number of the tile along the axis
///         2l  /      \  2l+3           corners by the numbers of their lines
///             \      /
///              \____/
static sl_status add_sides(const hexagons *all, int64_t along, int64_t across) {
    const bool moved = is_moved(all->lattice, along), solid = is_solid(all, along, across);
    const int64_t line = 2 * along, top = 2 * across + moved;
    const sl_point low = hexagon_corner(all, line + 2, top + 2);
    const sl_point middle = hexagon_corner(all, line + 3, top + 1);
    if (is_solid(all, along, across + 1) != solid)
        SL_TRY(add_side(all, solid, hexagon_corner(all, line + 1, top + 2), low));
    if (is_solid(all, along + 1, across + moved) != solid)
        SL_TRY(add_side(all, solid, low, middle));
    if (is_solid(all, along + 1, across + moved - 1) != solid)
        SL_TRY(add_side(all, solid, middle, hexagon_corner(all, line + 2, top)));
    return SL_OK;
}

sl_status sli_tiled_add_hexagons(sl_context *context, const sli_tiled_lattice *lattice,
                                 sl_point offset, const sli_grid *grid, sl_map *map) {
    hexagons all = {.context = context,
                    .lattice = lattice,
                    .grid = grid,
                    .column = (int64_t)grid->origin.x,
                    .row = -(int64_t)grid->origin.y - (int64_t)grid->count,
                    .offset = offset,
                    .map = map};
    const bool x = lattice->stagger_x;
    const int64_t columns = (int64_t)grid->rows[0].length, rows = (int64_t)grid->count;
    const int64_t first = x ? all.column : all.row, second = x ? all.row : all.column;
    const int64_t end = first + (x ? columns : rows), other_end = second + (x ? rows : columns);
    for (int64_t along = first - 1; along < end; along++) {
        SL_TRY(sl_check_cancelled(context));
        for (int64_t across = second - 1; across <= other_end; across++)
            SL_TRY(add_sides(&all, along, across));
    }
    return SL_OK;
}

bool sli_tiled_in_hexagon(const sli_tiled_lattice *lattice, int64_t column, int64_t row,
                          sl_point at) {
    const sl_point corner = sli_tiled_tile_at(lattice, column, row);
    const double x = lattice->stagger_x ? at.x - corner.x : at.y - corner.y;
    const double y = lattice->stagger_x ? at.y - corner.y : at.x - corner.x;
    const double tile = lattice->stagger_x ? lattice->tile.y : lattice->tile.x;
    const double away = fabs(y - tile / 2), end = 2 * lattice->slope + lattice->side;
    // The slope is 0 where hexagons are boxes.
    const double in = 2 * lattice->slope * away;
    return away <= tile / 2 && x * tile >= in && (end - x) * tile >= in;
}
