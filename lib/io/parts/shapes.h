/// What drawings and games are made of, as walls: lines and curves by a pen, and solid tiles.
#ifndef SL_SHAPES_H
#define SL_SHAPES_H

#include "map/grid.h"
#include "sightline/map.h"
#include "sightline/support.h"

// --- the pen. Curves become chords that end on the curve. No point of the curve is farther than
// --- the tolerance from its chord, in the map's unit; by default no farther than 1/200 of the
// curve's
// --- own size (32 chords a circle)

/// x' = xx x + xy y + x0, y' = yx x + yy y + y0.
typedef struct sli_affine {
    double xx, xy, x0, yx, yy, y0;
} sli_affine;

#define SLI_AFFINE_NONE ((sli_affine){.xx = 1, .yy = 1})

/// The map that does `inner` first, then `outer`.
sli_affine sli_affine_after(sli_affine outer, sli_affine inner);
sl_point sli_affine_apply(sli_affine affine, sl_point point);
/// About the origin; multiples of a quarter turn are exact.
sli_affine sli_affine_turn(double degrees);

// --- digits: how exactly a file writes its places

/// The unit of the last decimal place of a number in its shortest text: 0.1 for 2.5; at most 1.
double sli_shortest_unit(double value);
/// Keeps the finer of two units in `finest`, where 0 stands for none yet.
void sli_keep_finest(double *finest, double unit);
/// A number for the digits of a place. The sum over all places of a file, in any order, changes
/// when one of them does.
uint64_t sli_digits_of(const char *text, size_t length);
/// The same of a number in its shortest text.
uint64_t sli_digits_of_number(double value);

/// Room for a mark: the sum of a file's digits and the map's precision, as the file's writer knew
/// them.
enum { SLI_MARK_TEXT = 64 };

/// What sl_map.precision is: what a mark says, if the file still has the numbers that were written.
/// Else, and with `mark` NULL, it follows from the finest unit, in the map's unit, that the map's
/// places have.
double sli_marked_precision(const sl_map *map, double finest, const char *mark, uint64_t sum);

typedef struct sli_pen {
    sl_context *context;
    const char *name; ///< of the file, for messages
    sl_map *map;
    sli_affine affine; ///< from the drawing's coordinates to the map's
    double tolerance;  ///< in the map's unit; 0: the usual
    uint32_t line;     ///< of the file, where walls are said to be from
    uint32_t item; ///< 0, or what walls have in place of the line (sl_map.source.lines_are_items)
    sl_point at;   ///< the pen, in the drawing's coordinates
    size_t walls;  ///< drawn
    size_t points; ///< lines of no length, left out
    bool too_far;  ///< the last failure: a coordinate that is not usable
    double finest; ///< the finest unit of the coordinates, in the map's unit
    uint64_t sum;  ///< of their digits
} sli_pen;

/// Takes note of how a coordinate is written, which the file has in `unit` drawing units.
void sli_pen_digits(sli_pen *pen, const char *text, size_t length, double unit);

/// Each draws from where the pen is, and moves it. SL_BAD_INPUT where the map's coordinate would
/// not be usable, or where there are more walls than the limit.
sl_status sli_pen_line(sli_pen *pen, sl_point to);
/// The arc centre + u cos t + v sin t for t from 0 to `sweep` (radians, up to a full turn either
/// way), to `to`, which is where it ends but for rounding.
sl_status sli_pen_arc(sli_pen *pen, sl_point centre, sl_point u, sl_point v, double sweep,
                      sl_point to);
/// A cubic Bézier curve with two control points.
sl_status sli_pen_cubic(sli_pen *pen, sl_point first, sl_point second, sl_point to);
/// A B-spline of a degree from 1 to 3 without weights, from its own beginning. There are `count`
/// points, more than the degree, and count + degree + 1 knots that never fall.
sl_status sli_pen_spline(sli_pen *pen, int degree, const double *knots, const sl_point *points,
                         size_t count);

// --- tiles, gathered block by block (layers, chunks, levels), then made into walls. Places are in
// --- pixels, y down, as the files have them; the walls have y up

typedef struct sli_tile_block {
    sl_point corner;      ///< the upper left one
    sl_point step;        ///< the size of a tile, over 0
    size_t columns, rows; ///< at least 1
    char *squares;        ///< row after row, '#' solid, '~' water, '.' open, ' ' not of the block
    bool done;            ///< its walls are made
} sli_tile_block;

/// Zero it to start.
typedef struct sli_tiles {
    SL_ARRAY(sli_tile_block) blocks;
    uint64_t squares; ///< of all blocks
    bool water;       ///< there is some: it stops steps, and neither sight nor sound
} sli_tiles;

/// SL_BAD_INPUT where a block of so many more squares goes beyond the limit: asked before its data
/// is unpacked. `what` says what the block is.
sl_status sli_tiles_check(sl_context *context, const sli_tiles *tiles, const char *name,
                          unsigned line, const char *what, uint64_t columns, uint64_t rows);

void sli_tiles_destroy(sl_context *context, sli_tiles *tiles);

/// Adds a block of open squares and gives them to be filled in; they belong to `tiles`.
/// SL_BAD_INPUT, naming the file, where the block lies so far out or has so many squares that their
/// corners would round to the same place.
sl_status sli_tiles_add(sl_context *context, sli_tiles *tiles, const char *name, sl_point corner,
                        sl_point step, size_t columns, size_t rows, char **squares);

typedef struct sli_tiles_options {
    double top;         ///< the files' y that is 0 in the map
    bool solid_between; ///< what no block covers is solid; else it is open
    bool all_closed;    ///< beyond each grid all is solid; else only beyond the first one
    bool other_ground;  ///< the map has solid ground that is not of squares: it may lie on them
    struct sli_things *things; ///< starts and doors, to be placed among the squares; NULL: none
    /// Makes the walls of a grid, for tiles that are no boxes; NULL for boxes.
    sl_status (*add_walls)(void *user, const sli_grid *grid, sl_map *map);
    void *user;
} sli_tiles_options;

/// Blocks whose tiles lie on one grid become one: a square is solid where any of them says so. Then
/// each grid gives its walls, few and long. SL_BAD_INPUT where a grid has
/// more squares than the limit, or 2^20 on a side, or there are more than 4096.
sl_status sli_tiles_add_walls(sl_context *context, sli_tiles *tiles, const char *name,
                              const sli_tiles_options *options, sl_map *map);

#endif
