/// A visibility graph in tiles: its matrix of bits, cut into squares of 64 by 64 points. Only tiles
/// with a bit in them are kept.
///
/// The points are sorted along a Z-curve (Morton 1966) and bundled by 64, so those of a bundle lie
/// near each other and see much the same:
///
///      0  1 | 4  5      A step of a search takes the bundles that a level has points in. Each tile
///      2  3 | 6  7      of a bundle says by one word what its points see together. Often all of
///     ------+------     that has been reached: then the tile is passed over. Where the level has
///      8  9 | ...       the whole bundle, that word is the answer. Else the points' own rows are
///                       joined, until nothing is missing.
///
/// Cost of a step: the tiles of the level's bundles, and a few rows of some of them. Memory: 528
/// bytes a tile.
#include "analysis/visibility_graph/tiles.h"
#include "base/base.h"

#include <stdlib.h>
#include <string.h>

void sli_vga_tiles_destroy(sl_context *context, sli_vga_tiles *t) {
    sl_free(context, t->slots);
    sl_free(context, t->points);
    sl_free(context, t->first);
    sl_free(context, t->tiles.items);
    sl_free(context, t->rows.items);
    *t = (sli_vga_tiles){0};
}

// --- the order of points

typedef struct placed {
    uint64_t key;
    uint32_t point;
} placed;

/// The bits of a number, with a 0 between each two.
static uint64_t spread(uint32_t number) {
    uint64_t bits = number;
    bits = (bits | bits << 16) & 0x0000ffff0000ffff;
    bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
    bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
}

static int compare_keys(const void *left, const void *right) {
    const uint64_t a = ((const placed *)left)->key, b = ((const placed *)right)->key;
    return (a > b) - (a < b);
}

sl_status sli_vga_order(sl_context *context, const sl_vga_grid *grid, uint32_t *slots,
                        uint32_t *points) {
    placed *all = sl_alloc_array(context, grid->count, sizeof *all);
    if (!all) return SL_NO_MEMORY;
    for (uint32_t p = 0; p < grid->count; p++) {
        const uint32_t column = grid->squares[p] / grid->rows, row = grid->squares[p] % grid->rows;
        all[p] = (placed){spread(column) << 1 | spread(row), p};
    }
    qsort(all, grid->count, sizeof *all, compare_keys);
    for (uint32_t slot = 0; slot < grid->count; slot++) {
        points[slot] = all[slot].point;
        slots[all[slot].point] = slot;
    }
    sl_free(context, all);
    return SL_OK;
}

// --- the tiles

/// Adds the tiles of a bundle. `place` has by bundle the tile's number in the list, and 0 for none
/// yet: numbers before `first` are of others.
static sl_status cut(sl_context *context, const sl_vga_graph *graph, size_t bundle, size_t *place,
                     sli_vga_tiles *t) {
    const size_t first = t->tiles.count;
    for (size_t i = 0; i < 64 && bundle * 64 + i < t->count; i++) {
        const sl_bits *row = graph->rows + t->points[bundle * 64 + i] * graph->words;
        for (size_t w = 0; w < graph->words; w++) {
            for (sl_bits rest = row[w]; rest; rest &= rest - 1) {
                const uint32_t slot = t->slots[w * 64 + (size_t)__builtin_ctzll(rest)];
                const uint64_t bit = (uint64_t)1 << slot % 64;
                size_t at = place[slot / 64];
                if (at < first || at >= t->tiles.count || t->tiles.items[at].bundle != slot / 64) {
                    SL_TRY(SL_ARRAY_ROOM(context, &t->tiles, 1));
                    SL_TRY(SL_ARRAY_ROOM(context, &t->rows, 1));
                    at = place[slot / 64] = t->tiles.count++;
                    t->tiles.items[at] = (sli_vga_tile){.bundle = slot / 64};
                    t->rows.items[t->rows.count++] = (sli_vga_tile_rows){{0}};
                }
                t->rows.items[at].rows[i] |= bit;
                t->tiles.items[at].any |= bit;
            }
        }
    }
    return SL_OK;
}

sl_status sli_vga_tiles_make(sl_context *context, const sl_vga_grid *grid,
                             const sl_vga_graph *graph, sli_vga_tiles *out) {
    sli_vga_tiles t = {.bundles = sl_bits_words(grid->count), .count = grid->count};
    size_t *place = sl_alloc_array(context, t.bundles, sizeof *place);
    t.slots = sl_alloc_array(context, grid->count, sizeof *t.slots);
    t.points = sl_alloc_array(context, grid->count, sizeof *t.points);
    t.first = sl_alloc_array(context, t.bundles + 1, sizeof *t.first);
    sl_status status = place && t.slots && t.points && t.first ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) status = sli_vga_order(context, grid, t.slots, t.points);
    for (size_t b = 0; b < t.bundles && status == SL_OK; b++) {
        t.first[b] = t.tiles.count;
        status = sl_check_cancelled(context);
        if (status == SL_OK) status = cut(context, graph, b, place, &t);
    }
    sl_free(context, place);
    if (status != SL_OK) {
        sli_vga_tiles_destroy(context, &t);
        return status;
    }
    t.first[t.bundles] = t.tiles.count;
    sli_shrink(context, &t.tiles.items, &t.tiles.capacity, t.tiles.count, sizeof *t.tiles.items);
    sli_shrink(context, &t.rows.items, &t.rows.capacity, t.rows.count, sizeof *t.rows.items);
    *out = t;
    return SL_OK;
}

// --- steps

void sli_vga_tiles_step(const sli_vga_tiles *t, const sl_bits *level, const sl_bits *seen,
                        sl_bits *next) {
    for (size_t b = 0; b < t->bundles; b++) {
        if (!level[b]) continue;
        for (size_t i = t->first[b]; i < t->first[b + 1]; i++) {
            const sli_vga_tile *tile = &t->tiles.items[i];
            uint64_t missing = tile->any & ~(seen[tile->bundle] | next[tile->bundle]);
            if (!missing) continue;
            if (level[b] == UINT64_MAX) {
                next[tile->bundle] |= missing;
                continue;
            }
            uint64_t found = 0;
            for (sl_bits rest = level[b]; rest && missing; rest &= rest - 1) {
                const uint64_t more = t->rows.items[i].rows[__builtin_ctzll(rest)] & missing;
                found |= more;
                missing &= ~more;
            }
            next[tile->bundle] |= found;
        }
    }
}
