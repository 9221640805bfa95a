/// A visibility graph in tiles, for searches from all points.
#ifndef SL_VGA_TILES_H
#define SL_VGA_TILES_H

#include "sightline/support.h"
#include "sightline/vga.h"

/// What 64 points, near each other, see of 64 others.
typedef struct sli_vga_tile {
    uint32_t bundle; ///< of the points that are seen
    uint64_t any;    ///< those that one of the points sees
} sli_vga_tile;

/// By point: those that it sees. Kept apart from the tiles, as most tiles are passed over.
typedef struct sli_vga_tile_rows {
    uint64_t rows[64];
} sli_vga_tile_rows;

/// The points in bundles of 64. A point has a slot: 64 * bundle + place.
typedef struct sli_vga_tiles {
    size_t bundles;
    uint32_t count;
    uint32_t *slots;  ///< by point
    uint32_t *points; ///< by slot
    size_t *first;    ///< by bundle, and one more: into `tiles`
    SL_ARRAY(sli_vga_tile) tiles;
    SL_ARRAY(sli_vga_tile_rows) rows; ///< by tile
} sli_vga_tiles;

/// Numbers the points along a Z-curve: by point its slot, by slot its point.
sl_status sli_vga_order(sl_context *context, const sl_vga_grid *grid, uint32_t *slots,
                        uint32_t *points);

sl_status sli_vga_tiles_make(sl_context *context, const sl_vga_grid *grid,
                             const sl_vga_graph *graph, sli_vga_tiles *out);
void sli_vga_tiles_destroy(sl_context *context, sli_vga_tiles *tiles);

/// Adds to `next` all that points of `level` see and `seen` has not. Sets are by slot.
void sli_vga_tiles_step(const sli_vga_tiles *tiles, const sl_bits *level, const sl_bits *seen,
                        sl_bits *next);

#endif
