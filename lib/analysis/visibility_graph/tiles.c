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
/// Neighbours often see the same of a tile: then their rows are kept once, as a span. A tile that
/// is full has one span; of 100,000 points in a hall with pillars, a tile has 20.
///
/// Cost of a step: the tiles of the level's bundles, and a few spans of some of them. Memory: 32
/// bytes a tile, and 8 a span.
#include "analysis/visibility_graph/tiles.h"

#include <stdlib.h>
#include <string.h>

void sli_vga_tiles_destroy(sl_context *context, sli_vga_tiles *t) {
    sl_free(context, t->slots);
    sl_free(context, t->points);
    for (size_t b = 0; t->of && b < t->bundles; b++) {
        sl_free(context, t->of[b].tiles);
        sl_free(context, t->of[b].spans);
    }
    sl_free(context, t->of);
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

typedef struct cutting {
    const sl_vga_graph *graph;
    sli_vga_tiles *tiles;
    uint64_t *bytes; ///< by bundle, where they are counted and not kept
} cutting;

/// What a thread needs: the rows of a bundle, and its tiles while their number is not known.
typedef struct cutter {
    uint64_t (*rows)[64]; ///< by bundle that is seen, and place
    sl_bits *touched;     ///< bundles that are seen
    SL_ARRAY(sli_vga_tile) tiles;
    SL_ARRAY(uint64_t) spans;
} cutter;

static void end_cutter(sl_context *context, void *all, void *state) {
    (void)all;
    cutter *c = state;
    sl_free(context, c->rows);
    sl_free(context, c->touched);
    sl_free(context, c->tiles.items);
    sl_free(context, c->spans.items);
    sl_free(context, c);
}

static sl_status begin_cutter(sl_context *context, void *all, void **state) {
    const size_t bundles = ((const cutting *)all)->tiles->bundles;
    cutter *c = sl_alloc_array(context, 1, sizeof *c);
    if (!c) return SL_NO_MEMORY;
    c->rows = sl_alloc_array(context, bundles, sizeof *c->rows);
    c->touched = sl_alloc_array(context, sl_bits_words(bundles), sizeof *c->touched);
    if (c->rows && c->touched) {
        *state = c;
        return SL_OK;
    }
    end_cutter(context, all, c);
    return SL_NO_MEMORY;
}

/// Adds a tile, and its spans.
static sl_status add_tile(sl_context *context, cutter *c, uint32_t bundle) {
    const uint64_t *rows = c->rows[bundle];
    uint64_t before = 0, starts = 0, pairs = 0, any = 0;
    SL_TRY(SL_ARRAY_ROOM(context, &c->tiles, 1));
    SL_TRY(SL_ARRAY_ROOM(context, &c->spans, 66));
    const size_t first = c->spans.count;
    uint64_t *spans = c->spans.items + first, *next = spans + 2;
    for (int i = 0; i < 64; i++) {
        pairs += sli_word_count(rows[i]);
        any |= rows[i];
        if (rows[i] == before) continue;
        starts |= (uint64_t)1 << i;
        *next++ = before = rows[i];
    }
    spans[0] = pairs;
    spans[1] = starts;
    c->spans.count = (size_t)(next - c->spans.items);
    c->tiles.items[c->tiles.count++] = (sli_vga_tile){any, bundle, (uint32_t)first};
    return SL_OK;
}

/// A copy of what an array holds, without its spare room.
static sl_status keep(sl_context *context, const void *items, size_t count, size_t size, void *to) {
    void *copy = sl_alloc_array(context, count, size);
    if (!copy) return SL_NO_MEMORY;
    if (count) memcpy(copy, items, count * size);
    memcpy(to, &copy, sizeof copy);
    return SL_OK;
}

/// Adds what place `i` of a bundle sees. Points of a column lie by several in a bundle: these make
/// a word before it is stored.
static void take_row(const sli_vga_tiles *t, cutter *c, sl_vga_run run, size_t i) {
    uint32_t bundle = UINT32_MAX;
    uint64_t word = 0;
    while (sl_vga_next(&run))
        for (uint32_t q = run.first; q < run.stop; q++) {
            const uint32_t slot = t->slots[q];
            if (slot / 64 != bundle) {
                if (word) c->rows[bundle][i] |= word;
                word = 0;
                bundle = slot / 64;
                sl_bits_add(c->touched, bundle);
            }
            word |= (uint64_t)1 << slot % 64;
        }
    if (word) c->rows[bundle][i] |= word;
}

static sl_status cut(sl_context *context, void *all, void *state, size_t bundle) {
    const cutting *j = all;
    sli_vga_tiles *t = j->tiles;
    cutter *c = state;
    c->tiles.count = c->spans.count = 0;
    for (size_t i = 0; i < 64 && bundle * 64 + i < t->count; i++)
        take_row(t, c, sl_vga_row(j->graph, t->points[bundle * 64 + i]), i);
    for (size_t w = 0; w < sl_bits_words(t->bundles); w++) {
        for (sl_bits rest = c->touched[w]; rest; rest &= rest - 1) {
            const uint32_t seen = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest);
            SL_TRY(add_tile(context, c, seen));
            memset(c->rows[seen], 0, sizeof *c->rows);
        }
        c->touched[w] = 0;
    }
    if (c->spans.count > UINT32_MAX) return SL_NO_MEMORY;
    if (j->bytes) {
        j->bytes[bundle] =
            c->tiles.count * sizeof *c->tiles.items + c->spans.count * sizeof *c->spans.items;
        return SL_OK;
    }
    sli_vga_bundle *b = &t->of[bundle];
    b->count = (uint32_t)c->tiles.count;
    SL_TRY(keep(context, c->tiles.items, c->tiles.count, sizeof *b->tiles, &b->tiles));
    return keep(context, c->spans.items, c->spans.count, sizeof *b->spans, &b->spans);
}

/// Orders the points and cuts all bundles. `bytes`: as of cutting.
static sl_status cut_all(sl_context *context, const sl_vga_grid *grid, const sl_vga_graph *graph,
                         unsigned threads, uint64_t *bytes, sli_vga_tiles *t) {
    cutting job = {graph, t, bytes};
    const sl_work work = {.job = &job, .begin = begin_cutter, .unit = cut, .end = end_cutter};
    t->bundles = sl_bits_words(grid->count);
    t->count = grid->count;
    t->slots = sl_alloc_array(context, grid->count, sizeof *t->slots);
    t->points = sl_alloc_array(context, grid->count, sizeof *t->points);
    t->of = sl_alloc_array(context, t->bundles, sizeof *t->of);
    if (!t->slots || !t->points || !t->of) return SL_NO_MEMORY;
    SL_TRY(sli_vga_order(context, grid, t->slots, t->points));
    return sl_work_run(context, &work, t->bundles, threads);
}

sl_status sli_vga_tiles_make(sl_context *context, const sl_vga_grid *grid,
                             const sl_vga_graph *graph, unsigned threads, sli_vga_tiles *out) {
    sli_vga_tiles t = {0};
    const sl_status status = cut_all(context, grid, graph, threads, NULL, &t);
    if (status == SL_OK)
        *out = t;
    else
        sli_vga_tiles_destroy(context, &t);
    return status;
}

sl_status sli_vga_tiles_size(sl_context *context, const sl_vga_grid *grid,
                             const sl_vga_graph *graph, unsigned threads, sli_vga_tile_bytes *out) {
    sli_vga_tiles t = {0};
    const size_t bundles = sl_bits_words(grid->count);
    uint64_t *bytes = sl_alloc_array(context, bundles, sizeof *bytes);
    const sl_status status =
        bytes ? cut_all(context, grid, graph, threads, bytes, &t) : SL_NO_MEMORY;
    *out = (sli_vga_tile_bytes){0};
    for (size_t b = 0; status == SL_OK && b < bundles; b++) {
        out->all += bytes[b];
        if (bytes[b] > out->largest) out->largest = bytes[b];
    }
    sl_free(context, bytes);
    sli_vga_tiles_destroy(context, &t);
    return status;
}

// --- steps

/// Those of `points` that some place of `level` sees.
static uint64_t see_some(const sli_vga_bundle *of, const sli_vga_tile *tile, uint64_t level,
                         uint64_t points) {
    uint64_t missing = points;
    if (level == UINT64_MAX) return points;
    sli_vga_span span = sli_vga_spans(of, tile);
    while (missing && sli_vga_next_span(&span))
        if (span.places & level) missing &= ~span.seen;
    return points & ~missing;
}

void sli_vga_tiles_step(const sli_vga_tiles *t, const sl_bits *bundles, const sl_bits *level,
                        const sl_bits *seen, sl_bits *next, sl_bits *next_bundles) {
    for (size_t b = 0; (b = sli_bits_next(bundles, t->bundles, b, true)) < t->bundles; b++) {
        if (!level[b]) continue;
        for (uint32_t i = 0; i < t->of[b].count; i++) {
            const sli_vga_tile *tile = &t->of[b].tiles[i];
            const uint64_t missing = tile->any & ~(seen[tile->bundle] | next[tile->bundle]);
            const uint64_t found = missing ? see_some(&t->of[b], tile, level[b], missing) : 0;
            if (!found) continue;
            next[tile->bundle] |= found;
            sl_bits_add(next_bundles, tile->bundle);
        }
    }
}
