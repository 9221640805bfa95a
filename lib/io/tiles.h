/// Tiles gathered block by block (layers, chunks, levels), then made into walls.
///
/// Places are in pixels, y down, as the files have them; the walls have y up.
#ifndef SL_IMPORT_TILES_H
#define SL_IMPORT_TILES_H

#include "map/grid.h"

typedef struct sl_tile_block {
    sl_point corner;      ///< the upper left one
    sl_point step;        ///< the size of a tile, over 0
    size_t columns, rows; ///< at least 1
    char *squares;        ///< row after row, '#' solid, '.' open
    bool done;            ///< its walls are made
} sl_tile_block;

/// Zero it to start.
typedef struct sl_tiles {
    SL_ARRAY(sl_tile_block) blocks;
} sl_tiles;

void sl_tiles_destroy(sl_context *context, sl_tiles *tiles);

/// Adds a block of open squares and gives them to be filled in; they belong to `tiles`.
/// SL_BAD_INPUT, naming the file, where the block lies so far out or has so many squares that their
/// corners cannot be told apart.
sl_status sl_tiles_add(sl_context *context, sl_tiles *tiles, const char *name, sl_point corner,
                       sl_point step, size_t columns, size_t rows, char **squares);

typedef struct sl_tiles_options {
    double top;         ///< the files' y that is 0 in the map
    bool solid_between; ///< what no block covers is solid; else it is open
    bool all_closed;    ///< beyond each grid all is solid; else only beyond the first one
} sl_tiles_options;

/// Blocks whose tiles lie on one grid become one: a square is solid where any of them says so. Then
/// each grid gives its walls, few and long. `*grids` counts the grids. SL_BAD_INPUT where a grid is
/// larger than 2^26 squares, or 2^20 on a side, or there are more than 4096.
sl_status sl_tiles_add_walls(sl_context *context, sl_tiles *tiles, const char *name,
                             const sl_tiles_options *options, sl_map *map, size_t *grids);

#endif
