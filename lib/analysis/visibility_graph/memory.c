/// How much memory measures of a visibility graph take, told before they are computed.
///
/// One pass over the graph counts what the measures will keep:
///
///     words:   64 points near each other, of which a point sees some (graph_paths.c)
///     tiles:   64 points, of which one of 64 others sees some (tiles.c)
///     ways on: points within two steps of points beside walls (metric.c)
///
/// Stages follow each other and free what they took. So the answer is the largest stage, with the
/// graph and the table of measures. Each thread takes its share besides.
///
/// Invariant: counts are exact or upper bounds, but for the queues of searches. Those are guessed
/// from maps that were measured, so the answer is no bound where a queue grows longer. Cost:
/// O(edges), and for points beside walls a few rows for each step.
#include "analysis/visibility_graph/graph_paths.h"
#include "base/bits.h"

#include <string.h>

/// What a thread takes to run, and small blocks.
enum { A_THREAD = 2048 };

/// What the pass counts.
typedef struct counts {
    uint64_t points, bundles;
    uint64_t squares, sides; ///< of the grid: columns times rows, and their sum
    uint64_t words, tiles;
    uint64_t turning, steps; ///< points beside walls, and ordered pairs of them
    uint64_t turning_words;  ///< of points beside walls
    uint64_t ways, longest;  ///< ways on in all lists, and in one
    uint64_t threads;
} counts;

typedef struct counting {
    const sl_vga_graph *graph;
    const sl_bits *turning;       ///< by point
    uint32_t *slots, *points;     ///< of tiles
    uint32_t *path_slots;         ///< of searches for paths
    uint32_t *of_row, *of_bundle; ///< by bundle: the last slot, or bundle, that saw it; one more
    sl_bits *near;                ///< by point: within two steps
    counts all;
} counting;

/// What an array has room for once it grew to so many items (sl_reserve).
static uint64_t grown(uint64_t items) {
    uint64_t room = 8;
    while (room < items) room *= 2;
    return room;
}

static uint64_t most(uint64_t a, uint64_t b) {
    return a > b ? a : b;
}

// --- the pass

/// Points that a point beside walls reaches by two steps or fewer, itself included.
static uint64_t count_near(counting *c, uint32_t point) {
    const size_t words = c->graph->words;
    const sl_bits *row = sli_vga_row(c->graph, point);
    memcpy(c->near, row, words * sizeof *row);
    sl_bits_add(c->near, point);
    for (size_t w = 0; w < words; w++)
        for (sl_bits rest = row[w] & c->turning[w]; rest; rest &= rest - 1) {
            const uint32_t u = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest);
            const sl_bits *next = sli_vga_row(c->graph, u);
            for (size_t k = 0; k < words; k++) c->near[k] |= next[k];
        }
    return sli_bits_count(c->near, words);
}

/// Steps from a point to points beside walls.
static uint64_t count_steps(const counting *c, uint32_t point) {
    const sl_bits *row = sli_vga_row(c->graph, point);
    uint64_t count = 0;
    for (size_t w = 0; w < c->graph->words; w++)
        count += (uint64_t)__builtin_popcountll(row[w] & c->turning[w]);
    return count;
}

/// Counts the tiles that a point has a part in, and its words. Points at which paths turn, and
/// others, have words of their own.
static void count_row(counting *c, uint32_t slot) {
    const uint32_t point = c->points[slot], bundle = slot / 64;
    const sl_bits *row = sli_vga_row(c->graph, point);
    const uint64_t before = c->all.words;
    for (size_t w = 0; w < c->graph->words; w++)
        for (sl_bits rest = row[w]; rest; rest &= rest - 1) {
            const size_t q = w * 64 + (size_t)__builtin_ctzll(rest);
            const uint32_t tile = c->slots[q] / 64, word = c->path_slots[q] / 64;
            uint32_t *of_row = c->of_row + (sl_bits_has(c->turning, q) ? 0 : c->all.bundles);
            c->all.tiles += c->of_bundle[tile] != bundle + 1;
            c->of_bundle[tile] = bundle + 1;
            c->all.words += of_row[word] != slot + 1;
            of_row[word] = slot + 1;
        }
    if (sl_bits_has(c->turning, point)) c->all.turning_words += c->all.words - before;
}

static sl_status count_bundle(sl_context *context, counting *c, uint32_t bundle, bool metric) {
    counts *all = &c->all;
    const uint64_t room = SLI_VGA_KEPT_WAYS / all->bundles;
    uint64_t ways = 0;
    SL_TRY(sl_check_cancelled(context));
    for (uint32_t slot = bundle * 64; slot < all->points && slot < bundle * 64 + 64; slot++) {
        count_row(c, slot);
        if (!sl_bits_has(c->turning, c->points[slot])) continue;
        all->turning++;
        all->steps += count_steps(c, c->points[slot]);
        if (metric && ways < room) ways += SLI_VGA_WAYS_A_PAIR * count_near(c, c->points[slot]);
    }
    ways = ways < room ? ways : room;
    all->ways += ways;
    all->longest = most(all->longest, ways);
    return SL_OK;
}

// --- the stages

/// Tiles, and the sets of a thread.
static uint64_t visual_bytes(const counts *n, unsigned parts) {
    const uint64_t a_tile = sizeof(sli_vga_tile) + sizeof(sli_vga_tile_rows);
    const uint64_t order = 8 * n->points + 16 * n->bundles;
    const uint64_t searcher = 65 * 8 * SLI_VGA_DEPTHS; // numbers of points by depth
    const uint64_t local = parts & SL_VGA_LOCAL ? 24 * n->bundles : 0;
    const uint64_t global = parts & SL_VGA_GLOBAL ? (64 * 8 + 6 * 8) * n->bundles + searcher : 0;
    const uint64_t making = most(16 * n->points, grown(n->tiles) * a_tile);
    return order + most(making, n->tiles * a_tile + n->threads * most(local, global));
}

/// The graph for searches; `making`: while its words are listed.
static uint64_t sights_bytes(const counts *n, bool making) {
    const uint64_t slots = 64 * n->bundles, words = making ? grown(n->words) : n->words;
    const uint64_t scratch = making ? 4 * n->points + 8 * n->bundles : 0;
    return 12 * n->points + (3 * 4 + 2 * 8) * slots + (8 + 16) * n->bundles + scratch +
           words * sizeof(sli_vga_word);
}

/// Lists of ways on, and for each thread its arrays by slot, its buckets and its queue.
static uint64_t metric_bytes(const counts *n) {
    const uint64_t slots = 64 * n->bundles, buckets = 4 * grown(4 * (n->sides + 2));
    const uint64_t queue = grown(SLI_VGA_QUEUE * n->turning + 64);
    const uint64_t lists = 4 * (slots + n->steps + n->bundles) + 32 * n->bundles;
    const uint64_t walker = (6 * 4 + 12) * slots + buckets + (24 + 24 / 4 + 4) * queue;
    const uint64_t listing = 4 * slots + 12 * n->longest;
    return lists + 12 * n->ways + n->threads * most(walker, listing);
}

/// Directions, and for each thread its arrays, what points beside walls keep, and its queue.
static uint64_t angular_bytes(const counts *n) {
    const uint64_t slots = 64 * n->bundles;
    const uint64_t queue = grown(SLI_VGA_TURN_QUEUE * n->points);
    const uint64_t walker = 5 * 4 * slots + 12 * n->turning + 16 * n->turning_words +
                            (4 + 3 * 8) * n->bundles + (4 + 1) * grown(n->points) + 8192;
    return (4 * 8 + 4 * 4) * n->squares + 4 * n->points +
           n->threads * (walker + (20 + 20 / 4) * queue);
}

static uint64_t all_bytes(const counts *n, unsigned parts) {
    uint64_t stages = 0;
    if (parts & (SL_VGA_LOCAL | SL_VGA_GLOBAL)) stages = visual_bytes(n, parts);
    if (parts & SL_VGA_THROUGH) stages = most(stages, 8 * n->squares * (n->threads + 1));
    if (parts & (SL_VGA_METRIC | SL_VGA_ANGULAR)) stages = most(stages, sights_bytes(n, true));
    if (parts & SL_VGA_METRIC) stages = most(stages, sights_bytes(n, false) + metric_bytes(n));
    if (parts & SL_VGA_ANGULAR) stages = most(stages, sights_bytes(n, false) + angular_bytes(n));
    return stages + 4 * n->points + 8 * n->bundles + (n->threads + 1) * A_THREAD;
}

// --- the answer

static void counting_end(sl_context *context, counting *c) {
    void *parts[] = {c->slots, c->points, c->path_slots, c->of_row, c->of_bundle, c->near};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status count_all(sl_context *context, const sl_vga_grid *grid, bool metric, counting *c) {
    c->slots = sl_alloc_array(context, grid->count, sizeof *c->slots);
    c->points = sl_alloc_array(context, grid->count, sizeof *c->points);
    c->path_slots = sl_alloc_array(context, grid->count, sizeof *c->path_slots);
    c->of_row = sl_alloc_array(context, 2 * c->graph->words, sizeof *c->of_row);
    c->of_bundle = sl_alloc_array(context, c->graph->words, sizeof *c->of_bundle);
    c->near = sl_alloc_array(context, c->graph->words, sizeof *c->near);
    if (!c->slots || !c->points || !c->path_slots || !c->of_row || !c->of_bundle || !c->near)
        return SL_NO_MEMORY;
    SL_TRY(sli_vga_order_paths(context, grid, c->turning, c->path_slots, c->slots, c->points,
                               &(uint32_t){0}));
    SL_TRY(sli_vga_order(context, grid, c->slots, c->points));
    for (uint32_t bundle = 0; bundle < c->all.bundles; bundle++)
        SL_TRY(count_bundle(context, c, bundle, metric));
    return SL_OK;
}

sl_status sl_vga_measure_bytes(sl_context *context, const sl_outline *outline,
                               const sl_vga_grid *grid, const sl_vga_graph *graph,
                               const sl_vga_options *options, uint64_t *bytes) {
    const uint64_t threads = options->threads ? options->threads : sl_core_count();
    const uint64_t bundles = sl_bits_words(grid->count);
    sl_bits *turning = NULL;
    SL_TRY(sli_vga_find_turning(context, outline, grid, &turning));
    counting c = {.graph = graph,
                  .turning = turning,
                  .all = {.points = grid->count,
                          .bundles = bundles,
                          .squares = (uint64_t)grid->columns * grid->rows,
                          .sides = (uint64_t)grid->columns + grid->rows,
                          .threads = threads}};
    const sl_status status = count_all(context, grid, options->parts & SL_VGA_METRIC, &c);
    *bytes = sl_vga_graph_bytes(grid->count) + grid->count * sizeof(sl_vga_measures) +
             all_bytes(&c.all, options->parts);
    counting_end(context, &c);
    sl_free(context, turning);
    return status;
}
