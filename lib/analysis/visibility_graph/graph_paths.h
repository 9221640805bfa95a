/// What searches for shortest and straightest paths share.
#ifndef SL_VGA_PATHS_H
#define SL_VGA_PATHS_H

#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/path_heap.h"
#include "analysis/visibility_graph/tiles.h"

#include <math.h>

#define SLI_RIGHT_ANGLE 1.5707963267948966

/// What a point sees of a bundle of 64 points.
typedef struct sli_vga_word {
    uint32_t bundle;
    uint64_t seen;
} sli_vga_word;

/// The smallest box around the points of a bundle.
typedef struct sli_vga_box {
    float left, right, bottom, top;
} sli_vga_box;

/// Memory for lists of ways on (metric.c): 384 MiB.
#define SLI_VGA_KEPT_WAYS ((size_t)1 << 25)

/// Ways on that are listed, for each pair of points two steps apart or fewer. Seldom reached: most
/// pairs have one way, or none.
#define SLI_VGA_WAYS_A_PAIR 2

/// About how many entries the queue of a search holds: of a metric one for each point beside walls,
/// of an angular one for each point. Told to those who ask for memory before the work.
#define SLI_VGA_QUEUE      2
#define SLI_VGA_TURN_QUEUE 15

/// The graph for searches. Points are numbered by slot: first those at which paths may turn. In
/// both groups, points near each other have near numbers.
typedef struct sli_vga_sights {
    const sli_vga_job *job;
    uint32_t count;
    uint32_t turning_count; ///< slots at which paths may turn
    size_t bundles;
    uint32_t *slots, *points; ///< by point, its slot; by slot, its point
    uint32_t *starts;         ///< all slots, in the order of searches: each start is near the last
    float *x, *y;             ///< by slot: the square
    uint32_t *parts;          ///< by slot: points of other parts are never reached
    sl_bits *turning;         ///< slots at which paths may turn
    sli_vga_box *boxes;       ///< by bundle
    size_t *first;            ///< by slot, and one more: into `words`
    size_t *others;           ///< by slot: its first word of points at which no path turns
    SL_ARRAY(sli_vga_word) words;
    size_t kept_ways; ///< SLI_VGA_KEPT_WAYS
} sli_vga_sights;

/// Numbers the points by slot. `starts`: all slots along the Z-curve. Returns how many turn paths.
sl_status sli_vga_order_paths(sl_context *context, const sl_vga_grid *grid, const sl_bits *turning,
                              uint32_t *slots, uint32_t *points, uint32_t *starts,
                              uint32_t *turning_count);

/// Whether a slot sees another.
static inline bool sli_vga_slot_sees(const sli_vga_sights *s, uint32_t at, uint32_t to) {
    const bool turns = sl_bits_has(s->turning, to);
    size_t low = turns ? s->first[at] : s->others[at];
    size_t high = turns ? s->others[at] : s->first[at + 1];
    while (low < high) { // bundles ascend
        const size_t middle = low + (high - low) / 2;
        if (s->words.items[middle].bundle < to / 64)
            low = middle + 1;
        else
            high = middle;
    }
    return low < (turns ? s->others[at] : s->first[at + 1]) &&
           s->words.items[low].bundle == to / 64 && s->words.items[low].seen >> to % 64 & 1;
}

sl_status sli_vga_sights_make(sl_context *context, const sli_vga_job *job, sli_vga_sights *out);
void sli_vga_sights_destroy(sl_context *context, sli_vga_sights *sights);

static inline double sli_vga_distance(const sli_vga_sights *s, uint32_t a, uint32_t b) {
    const double dx = (double)s->x[a] - (double)s->x[b], dy = (double)s->y[a] - (double)s->y[b];
    return sqrt(dx * dx + dy * dy);
}

/// The cosine of the turn of the path before, at, to.
static inline double sli_vga_cosine(const sli_vga_sights *s, uint32_t before, uint32_t at,
                                    uint32_t to) {
    const double ax = (double)s->x[to] - (double)s->x[at], ay = (double)s->y[to] - (double)s->y[at];
    const double bx = (double)s->x[at] - (double)s->x[before],
                 by = (double)s->y[at] - (double)s->y[before];
    return (ax * bx + ay * by) / sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
}

/// The turn itself, in right angles.
static inline float sli_vga_turn(double cosine) {
    return (float)(acos(fmin(fmax(cosine, -1), 1)) / SLI_RIGHT_ANGLE);
}

/// A search from each point. Threads take bundles; each has a walker of its own.
typedef struct sli_vga_searches {
    const sli_vga_sights *sights;
    const void *shared; ///< what the walkers read
    sl_status (*begin)(sl_context *context, const struct sli_vga_searches *searches, void **walker);
    sl_status (*measure)(sl_context *context, void *walker, uint32_t slot);
    void (*end)(sl_context *context, void *walker);
    const char *stage;
} sli_vga_searches;

sl_status sli_vga_search_all(sl_context *context, const sli_vga_searches *searches);

/// Measures lengths of shortest paths, and turns along them.
sl_status sli_vga_measure_metric(sl_context *context, const sli_vga_sights *sights);

/// Measures turns of straightest paths.
sl_status sli_vga_measure_angular(sl_context *context, const sli_vga_sights *sights);

#endif
