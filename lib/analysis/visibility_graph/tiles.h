/// A visibility graph in tiles, for searches from all points.
#ifndef SL_VGA_TILES_H
#define SL_VGA_TILES_H

#include "base/bits.h"
#include "sightline/vga.h"

/// What 64 points, near each other, see of 64 others.
typedef struct sli_vga_tile {
    uint64_t any;    ///< those that one of the points sees
    uint32_t bundle; ///< of the points that are seen
    uint32_t spans;  ///< into the bundle's `spans`, where those of the tile begin
} sli_vga_tile;

/// The tiles of 64 points, by ascending bundle, and the spans of all tiles. Those of a tile: its
/// pairs; then the places at which a span begins; then what each span sees, which is not what the
/// one before sees. The places before the first span see nothing.
typedef struct sli_vga_bundle {
    uint32_t count; ///< of tiles
    sli_vga_tile *tiles;
    uint64_t *spans;
} sli_vga_bundle;

/// The points in bundles of 64. A point has a slot: 64 * bundle + place.
typedef struct sli_vga_tiles {
    size_t bundles;
    uint32_t count;
    uint32_t *slots;  ///< by point
    uint32_t *points; ///< by slot
    sli_vga_bundle *of;
} sli_vga_tiles;

/// Points of a bundle that see the same of another.
typedef struct sli_vga_span {
    uint64_t starts;      ///< of the spans that follow
    const uint64_t *next; ///< what they see
    uint64_t places, seen;
} sli_vga_span;

/// The spans of a tile, before its first.
static inline sli_vga_span sli_vga_spans(const sli_vga_bundle *bundle, const sli_vga_tile *tile) {
    const uint64_t *spans = bundle->spans + tile->spans;
    return (sli_vga_span){spans[1], spans + 2, 0, 0};
}

/// Takes the next span; false at the end.
static inline bool sli_vga_next_span(sli_vga_span *span) {
    const uint64_t starts = span->starts;
    if (!starts) return false;
    span->starts = starts & (starts - 1);
    span->places = ((span->starts & -span->starts) - 1) & ~((starts & -starts) - 1);
    span->seen = *span->next++;
    return true;
}

/// The ordered pairs of a tile.
static inline uint64_t sli_vga_tile_pairs(const sli_vga_bundle *bundle, const sli_vga_tile *tile) {
    return bundle->spans[tile->spans];
}

/// What one place of a tile sees.
static inline uint64_t sli_vga_tile_row(const sli_vga_bundle *bundle, const sli_vga_tile *tile,
                                        unsigned place) {
    const uint64_t *spans = bundle->spans + tile->spans;
    const uint64_t starts = spans[1] & (((uint64_t)2 << place) - 1);
    return starts ? spans[1 + sli_word_count(starts)] : 0;
}

/// Numbers the points along a Z-curve: by point its slot, by slot its point.
sl_status sli_vga_order(sl_context *context, const sl_vga_grid *grid, uint32_t *slots,
                        uint32_t *points);

/// `threads`: 0 for one per core.
sl_status sli_vga_tiles_make(sl_context *context, const sl_vga_grid *grid,
                             const sl_vga_graph *graph, unsigned threads, sli_vga_tiles *out);
/// The bytes of tiles and their spans: of all bundles, and of the largest one.
typedef struct sli_vga_tile_bytes {
    uint64_t all, largest;
} sli_vga_tile_bytes;

/// Finds them without keeping tiles.
sl_status sli_vga_tiles_size(sl_context *context, const sl_vga_grid *grid,
                             const sl_vga_graph *graph, unsigned threads, sli_vga_tile_bytes *out);
void sli_vga_tiles_destroy(sl_context *context, sli_vga_tiles *tiles);

/// Adds to `next` all that points of `level` see and `seen` has not. Sets are by slot. The bundles
/// of `level` are among `bundles`; those of what is added go to `next_bundles`.
void sli_vga_tiles_step(const sli_vga_tiles *tiles, const sl_bits *bundles, const sl_bits *level,
                        const sl_bits *seen, sl_bits *next, sl_bits *next_bundles);

static inline void sli_swap_sets(sl_bits **a, sl_bits **b) {
    sl_bits *swap = *a;
    *a = *b;
    *b = swap;
}

#endif
