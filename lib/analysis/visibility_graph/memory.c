/// How much memory measures of a visibility graph take, told before they are computed.
///
/// A pass over the graph counts what the measures will keep:
///
///     tiles:   64 points, of which one of 64 others sees some (tiles.c)
///     words:   64 points near each other, of which a point sees some (graph_paths.c)
///     ways on: points within two steps of points beside walls (metric.c)
///
/// Stages follow each other and free what they took. So the answer is the largest stage, with the
/// graph and the table of measures. Each thread takes its share besides.
///
/// Invariant: counts are exact or upper bounds, but for the queues of searches. Those are guessed
/// from maps that were measured, so the answer is no bound where a queue grows longer. Cost:
/// O(edges), and for metric paths a few rows for each step between points beside walls.
#include "analysis/visibility_graph/graph_paths.h"
#include "base/bits.h"

#include <string.h>

/// What a thread takes to run, and small blocks.
enum { A_THREAD = 2048 };

/// What the pass counts.
typedef struct counts {
    uint64_t points, bundles;
    uint64_t squares, sides; ///< of the grid: columns times rows, and their sum
    uint64_t words;
    sli_vga_tile_bytes tiles;
    uint64_t turning, steps; ///< points beside walls, and ordered pairs of them
    uint64_t turning_words;  ///< of points beside walls
    uint64_t ways, longest;  ///< ways on in all lists, and in one
    uint64_t threads;
} counts;

typedef struct counting {
    const sl_vga_graph *graph;
    const sl_bits *turning;            ///< by point
    uint32_t *slots, *points, *starts; ///< of searches for paths
    uint32_t *of_row;                  ///< by bundle: the last slot that saw it; one more
    sl_bits *near;                     ///< by point: within two steps
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
    const size_t words = sl_bits_words(c->graph->count);
    memset(c->near, 0, words * sizeof *c->near);
    sl_bits_add(c->near, point);
    sli_vga_add_row(c->graph, point, c->near);
    for (sl_vga_run run = sl_vga_row(c->graph, point); sl_vga_next(&run);)
        for (uint32_t q = run.first; q < run.stop; q++)
            if (sl_bits_has(c->turning, q)) sli_vga_add_row(c->graph, q, c->near);
    return sli_bits_count(c->near, words);
}

/// Counts the words of a point. Points at which paths turn, and others, have words of their own.
static void count_row(counting *c, uint32_t point) {
    const uint64_t before = c->all.words, steps = c->all.steps;
    for (sl_vga_run run = sl_vga_row(c->graph, point); sl_vga_next(&run);)
        for (uint32_t q = run.first; q < run.stop; q++) {
            const bool turns = sl_bits_has(c->turning, q);
            uint32_t *of_row = c->of_row + (turns ? 0 : c->all.bundles) + c->slots[q] / 64;
            c->all.words += *of_row != point + 1;
            c->all.steps += turns;
            *of_row = point + 1;
        }
    if (sl_bits_has(c->turning, point))
        c->all.turning_words += c->all.words - before;
    else
        c->all.steps = steps;
}

static sl_status count_bundle(sl_context *context, counting *c, uint32_t bundle, bool metric) {
    counts *all = &c->all;
    const uint64_t room = SLI_VGA_KEPT_WAYS / all->bundles;
    uint64_t ways = 0;
    SL_TRY(sl_check_cancelled(context));
    for (uint32_t p = bundle * 64; p < all->points && p < bundle * 64 + 64; p++) {
        count_row(c, p);
        if (!sl_bits_has(c->turning, p)) continue;
        all->turning++;
        if (metric && ways < room) ways += SLI_VGA_WAYS_A_PAIR * count_near(c, p);
    }
    ways = ways < room ? ways : room;
    all->ways += ways;
    all->longest = most(all->longest, ways);
    return SL_OK;
}

// --- the stages

/// Tiles, and the sets of a thread. While tiles are cut, it has rows of a bundle, and its tiles.
static uint64_t visual_bytes(const counts *n, unsigned parts) {
    const uint64_t order = 8 * n->points + sizeof(sli_vga_bundle) * n->bundles;
    const uint64_t searcher = 66 * 8 * SLI_VGA_DEPTHS; // numbers of points by depth
    const uint64_t second = parts & SL_VGA_LOCAL ? 4 * n->points : 0;
    const uint64_t global =
        (64 * 8 + 7 * 8 + 1) * n->bundles + searcher; // more than a local one takes
    const uint64_t cutter = (64 * 8 + 1) * n->bundles + 2 * n->tiles.largest + 1024;
    return order + second + most(16 * n->points, n->tiles.all + n->threads * most(cutter, global));
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
    void *parts[] = {c->slots, c->points, c->starts, c->of_row, c->near};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status count_all(sl_context *context, const sl_vga_grid *grid, bool metric, counting *c) {
    c->slots = sl_alloc_array(context, grid->count, sizeof *c->slots);
    c->points = sl_alloc_array(context, grid->count, sizeof *c->points);
    c->starts = sl_alloc_array(context, grid->count, sizeof *c->starts);
    c->of_row = sl_alloc_array(context, 2 * c->all.bundles, sizeof *c->of_row);
    c->near = sl_alloc_array(context, c->all.bundles, sizeof *c->near);
    if (!c->slots || !c->points || !c->starts || !c->of_row || !c->near) return SL_NO_MEMORY;
    SL_TRY(sli_vga_order_paths(context, grid, c->turning, c->slots, c->points, c->starts,
                               &(uint32_t){0}));
    for (uint32_t bundle = 0; bundle < c->all.bundles; bundle++)
        SL_TRY(count_bundle(context, c, bundle, metric));
    return SL_OK;
}

/// What measures of paths need.
static sl_status count_paths(sl_context *context, const sl_outline *outline,
                             const sl_vga_grid *grid, const sl_vga_graph *graph, bool metric,
                             counts *all) {
    sl_bits *turning = NULL;
    SL_TRY(sli_vga_find_turning(context, outline, grid, &turning));
    counting c = {.graph = graph, .turning = turning, .all = *all};
    const sl_status status = count_all(context, grid, metric, &c);
    *all = c.all;
    counting_end(context, &c);
    sl_free(context, turning);
    return status;
}

sl_status sl_vga_measure_bytes(sl_context *context, const sl_outline *outline,
                               const sl_vga_grid *grid, const sl_vga_graph *graph,
                               const sl_vga_options *options, uint64_t *bytes) {
    counts all = {.points = grid->count,
                  .bundles = sl_bits_words(grid->count),
                  .squares = (uint64_t)grid->columns * grid->rows,
                  .sides = (uint64_t)grid->columns + grid->rows,
                  .threads = options->threads ? options->threads : sl_core_count()};
    if (options->parts & (SL_VGA_LOCAL | SL_VGA_GLOBAL))
        SL_TRY(sli_vga_tiles_size(context, grid, graph, options->threads, &all.tiles));
    if (options->parts & (SL_VGA_METRIC | SL_VGA_ANGULAR))
        SL_TRY(count_paths(context, outline, grid, graph, options->parts & SL_VGA_METRIC, &all));
    *bytes = sli_vga_graph_size(graph) + grid->count * sizeof(sl_vga_measures) +
             all_bytes(&all, options->parts);
    return SL_OK;
}
