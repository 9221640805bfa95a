/// Mean depths of all points from searches of a few: roots, drawn at random from each part of the
/// graph (Eppstein and Wang 2004, Fast approximation of centrality). Sight is mutual, so the depth
/// of a point from a root is that of the root from the point.
///
///      p sees its neighbours: depth 1, exactly known.     mean = (1 * seen + (2 + rest) * unseen)
///      The others are 2 steps away and `rest` more.               / (seen + unseen)
///
/// Only the mean `rest` of the points that p does not see is estimated: by the roots among them,
/// which are a fair sample of these. A rest is 0 or more and has an upper bound: no point is
/// farther from p than from a root, and from there to p.
///
/// So Hoeffding's bound holds for the mean of k such rests, in its first form (1963, theorem 1; for
/// samples without repetition, section 6), by the divergence kl of two coins:
///
///      P(the mean is off so far that k * kl(sample, mean) > log(2 / (1 - confidence))) is at most
///      1 - confidence; all as shares of the upper bound.
///
/// An upper bound that is too large makes kl smaller, hence the interval wider, never wrong.
///
/// Invariant: the values of roots are exact, and those of all points in parts with no more points
/// than roots. Sums are of whole numbers, so threads change nothing.
///
/// Cost: a search for each root, and for each point the ends of its interval. Memory: 20 bytes a
/// point and thread.
#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/integration.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/// What the roots say of a point. Zeroed but for `far`, nothing.
typedef struct tally {
    uint64_t rest;   ///< sum of the steps beyond the second
    uint32_t unseen; ///< roots that it does not see
    uint32_t far;    ///< no point is farther
} tally;

typedef struct shared_tally {
    _Atomic uint64_t rest;
    _Atomic uint32_t unseen, far;
} shared_tally;

typedef struct estimate_job {
    const sl_vga_graph *graph;
    sli_vga_tiles tiles;
    uint32_t *part;       ///< by point
    uint32_t *part_first; ///< by part: into `order`; and one more
    uint32_t *order;      ///< points by part, the roots of each first
    uint32_t *roots;      ///< all of them
    uint32_t root_count;
    shared_tally *tallies; ///< by slot
    uint64_t *totals;      ///< by point, of roots: the sum of the steps to all
} estimate_job;

static uint32_t part_size(const estimate_job *j, uint32_t point) {
    return j->part_first[j->part[point] + 1] - j->part_first[j->part[point]];
}

// --- a search

typedef struct searcher {
    sl_bits *seen, *level, *next; ///< by slot
    sl_bits *bundles, *next_bundles, *touched;
    uint32_t *depth; ///< by slot that was found
    tally *tallies;  ///< by slot
} searcher;

/// Takes the points of the next level. Returns how many there are, and empties the level before.
static uint32_t take_level(const sli_vga_tiles *t, searcher *s, uint32_t depth) {
    uint32_t found = 0;
    size_t b = 0;
    for (; (b = sli_bits_next(s->bundles, t->bundles, b, true)) < t->bundles; b++) s->level[b] = 0;
    for (b = 0; (b = sli_bits_next(s->next_bundles, t->bundles, b, true)) < t->bundles; b++) {
        s->seen[b] |= s->next[b];
        sl_bits_add(s->touched, b);
        found += sli_word_count(s->next[b]);
        for (uint64_t rest = s->next[b]; rest; rest &= rest - 1)
            s->depth[b * 64 + (size_t)__builtin_ctzll(rest)] = depth;
    }
    memset(s->bundles, 0, sl_bits_words(t->bundles) * sizeof *s->bundles);
    sli_swap_sets(&s->level, &s->next);
    sli_swap_sets(&s->bundles, &s->next_bundles);
    return found;
}

/// Empties all sets, and tells each point that was found how far the root is.
static void take_depths(const sli_vga_tiles *t, searcher *s, uint32_t deepest) {
    size_t b = 0;
    for (; (b = sli_bits_next(s->touched, t->bundles, b, true)) < t->bundles; b++) {
        for (uint64_t rest = s->seen[b]; rest; rest &= rest - 1) {
            const size_t slot = b * 64 + (size_t)__builtin_ctzll(rest);
            const uint32_t depth = s->depth[slot];
            tally *of = &s->tallies[slot];
            of->unseen += depth > 1;
            of->rest += depth > 1 ? depth - 2 : 0;
            if (depth + deepest < of->far) of->far = depth + deepest;
        }
        s->seen[b] = s->level[b] = s->next[b] = 0;
    }
    const size_t bytes = sl_bits_words(t->bundles) * sizeof *s->bundles;
    memset(s->touched, 0, bytes);
    memset(s->bundles, 0, bytes);
}

static sl_status search_unit(sl_context *context, void *all, void *state, size_t unit) {
    const estimate_job *j = all;
    const sli_vga_tiles *t = &j->tiles;
    searcher *s = state;
    const uint32_t root = j->roots[unit], size = part_size(j, root);
    uint32_t depth = 0, found = 0;
    uint64_t total = 0;
    SL_TRY(sl_check_cancelled(context));
    sl_bits_add(s->next, t->slots[root]);
    sl_bits_add(s->next_bundles, t->slots[root] / 64);
    for (;;) {
        const uint32_t more = take_level(t, s, depth);
        found += more;
        total += (uint64_t)more * depth;
        if (found == size) break;
        sli_vga_tiles_step(t, s->bundles, s->level, s->seen, s->next, s->next_bundles);
        depth++;
    }
    take_depths(t, s, depth);
    j->totals[root] = total;
    return SL_OK;
}

static void end_searcher(sl_context *context, void *all, void *state) {
    const estimate_job *j = all;
    searcher *s = state;
    for (uint32_t slot = 0; s->tallies && slot < j->graph->count; slot++) {
        const tally *mine = &s->tallies[slot];
        shared_tally *of = &j->tallies[slot];
        if (mine->far == UINT32_MAX) continue;
        atomic_fetch_add(&of->rest, mine->rest);
        atomic_fetch_add(&of->unseen, mine->unseen);
        uint32_t far = atomic_load(&of->far);
        while (mine->far < far && !atomic_compare_exchange_weak(&of->far, &far, mine->far)) {
        }
    }
    void *parts[] = {s->seen,    s->level, s->next,    s->bundles, s->next_bundles,
                     s->touched, s->depth, s->tallies, s};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sl_free(context, parts[i]);
}

static sl_status begin_searcher(sl_context *context, void *all, void **state) {
    const estimate_job *j = all;
    const size_t words = j->tiles.bundles, slots = words * 64;
    searcher *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    sl_bits **sets[] = {&s->seen, &s->level, &s->next, &s->bundles, &s->next_bundles, &s->touched};
    bool room = (s->depth = sl_alloc_array(context, slots, sizeof *s->depth)) != NULL;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        room &= (*sets[i] = sl_alloc_array(context, words, sizeof **sets[i])) != NULL;
    s->tallies = room ? sl_alloc_array(context, slots, sizeof *s->tallies) : NULL;
    if (!s->tallies) {
        end_searcher(context, all, s);
        return SL_NO_MEMORY;
    }
    for (size_t slot = 0; slot < slots; slot++) s->tallies[slot].far = UINT32_MAX;
    *state = s;
    return SL_OK;
}

// --- roots

/// Sorts the points by part, and draws the first of each part.
static void draw_roots(estimate_job *j, uint32_t part_count, const sl_vga_estimate *options) {
    sl_random random = {options->seed};
    for (uint32_t p = 0; p < j->graph->count; p++) j->part_first[j->part[p] + 1]++;
    for (uint32_t k = 0; k < part_count; k++) j->part_first[k + 1] += j->part_first[k];
    for (uint32_t p = j->graph->count; p-- > 0;) j->order[--j->part_first[j->part[p] + 1]] = p;
    // Each has moved to the start of its part: entry k + 1 to that of part k.
    for (uint32_t k = 0; k < part_count; k++) j->part_first[k] = j->part_first[k + 1];
    j->part_first[part_count] = j->graph->count;
    for (uint32_t k = 0; k < part_count; k++) {
        uint32_t *points = j->order + j->part_first[k];
        const uint32_t size = j->part_first[k + 1] - j->part_first[k];
        for (uint32_t i = 0; i < size && i < options->roots; i++) {
            const uint32_t other = i + (uint32_t)sl_random_below(&random, size - i);
            const uint32_t root = points[other];
            points[other] = points[i];
            points[i] = root;
            j->roots[j->root_count++] = root;
        }
    }
}

// --- intervals

/// The divergence of two coins.
static double divergence(double a, double b) {
    return (a > 0 ? a * log(a / b) : 0) + (a < 1 ? (1 - a) * log((1 - a) / (1 - b)) : 0);
}

/// The share farthest from `mean`, towards `end`, whose divergence is up to `most`; rounded
/// outwards.
static double farthest_share(double mean, double end, double most) {
    double in = mean, out = end;
    for (int i = 0; i < 40; i++) {
        const double middle = (in + out) / 2;
        *(divergence(mean, middle) > most ? &out : &in) = middle;
    }
    return out;
}

/// The values of a point that is no root.
static void estimate_point(const estimate_job *j, uint32_t point, double seen, double confidence,
                           sl_vga_measures *out, sl_vga_interval *interval) {
    const shared_tally *of = &j->tallies[j->tiles.slots[point]];
    const double nodes = part_size(j, point), unseen = nodes - 1 - seen;
    const double far = atomic_load(&of->far), roots = atomic_load(&of->unseen);
    const double range = far > 2 ? far - 2 : 0;
    const double rest = roots > 0 ? (double)atomic_load(&of->rest) / roots : 0;
    double least = 0, most = range;
    if (roots > 0 && range > 0) {
        const double bound = log(2 / (1 - confidence)) / roots;
        least = range * farthest_share(rest / range, 0, bound);
        most = range * farthest_share(rest / range, 1, bound);
    }
    out->visual_mean_depth = (seen + unseen * (2 + rest)) / (nodes - 1);
    interval->least = (seen + unseen * (2 + least)) / (nodes - 1);
    interval->most = (seen + unseen * (2 + most)) / (nodes - 1);
}

static void estimate_all(const estimate_job *j, const uint32_t *degree, double confidence,
                         sl_vga_measures *measures, sl_vga_interval *intervals) {
    for (uint32_t p = 0; p < j->graph->count; p++) {
        const double nodes = part_size(j, p);
        sl_vga_measures *out = &measures[p];
        intervals[p] = (sl_vga_interval){NAN, NAN};
        out->visual_node_count = nodes;
        if (nodes < 2) continue;
        if (j->totals[p]) {
            out->visual_mean_depth = (double)j->totals[p] / (nodes - 1);
            intervals[p] = (sl_vga_interval){out->visual_mean_depth, out->visual_mean_depth};
        } else {
            estimate_point(j, p, degree[p], confidence, out, &intervals[p]);
        }
        const sli_integration i = sli_integration_of(nodes, out->visual_mean_depth * (nodes - 1));
        out->visual_integration_hh = i.hh;
        out->visual_integration_pvalue = i.pvalue;
        out->visual_integration_tekl = i.tekl;
    }
}

// --- the call

sl_vga_estimate sl_vga_estimate_default(void) {
    return (sl_vga_estimate){.roots = 256, .confidence = 0.99, .seed = 1};
}

bool sl_vga_is_estimated(const sl_measure *m) {
    if (m->of != SL_OF_GRAPH) return false;
    return m->group == SL_GROUP_GLOBAL ? m->unit != SL_UNIT_BITS
                                       : strcmp(m->name, "connectivity") == 0;
}

static sl_status estimate(sl_context *context, const sl_vga_grid *grid,
                          const sl_vga_estimate *options, estimate_job *j) {
    const uint32_t count = grid->count;
    uint32_t part_count;
    const sl_work work = {.job = j,
                          .begin = begin_searcher,
                          .unit = search_unit,
                          .end = end_searcher,
                          .stage = "depths",
                          .units = "roots"};
    SL_TRY(sli_vga_tiles_make(context, grid, j->graph, options->threads, &j->tiles));
    j->part = sl_alloc_array(context, count, sizeof *j->part);
    j->part_first = sl_alloc_array(context, (size_t)count + 2, sizeof *j->part_first);
    j->order = sl_alloc_array(context, count, sizeof *j->order);
    j->roots = sl_alloc_array(context, count, sizeof *j->roots);
    j->totals = sl_alloc_array(context, count, sizeof *j->totals);
    j->tallies = sl_alloc_array(context, count, sizeof *j->tallies);
    if (!j->part || !j->part_first || !j->order || !j->roots || !j->totals || !j->tallies)
        return SL_NO_MEMORY;
    for (uint32_t slot = 0; slot < count; slot++) atomic_init(&j->tallies[slot].far, UINT32_MAX);
    SL_TRY(sl_vga_parts(context, j->graph, NULL, 0, j->part, &part_count));
    draw_roots(j, part_count, options);
    return sl_work_run(context, &work, j->root_count, options->threads);
}

sl_status sl_vga_estimate_depths(sl_context *context, const sl_vga_grid *grid,
                                 const sl_vga_graph *graph, const sl_vga_estimate *options,
                                 sl_vga_measures *measures, sl_vga_interval *intervals) {
    if (graph->directed)
        return sl_fail(context, SL_UNSUPPORTED,
                       "estimates of depths need sight that is mutual: the map has one-way glass");
    if (!options->roots || !(options->confidence > 0 && options->confidence < 1))
        return sl_fail(context, SL_BAD_ARGUMENT,
                       "an estimate needs a root, and a confidence between 0 and 1");
    estimate_job job = {.graph = graph};
    uint32_t *degree = sl_alloc_array(context, graph->count, sizeof *degree);
    sl_status status = degree ? SL_OK : SL_NO_MEMORY;
    if (status == SL_OK) {
        sli_vga_begin_measures(graph, true, degree, measures);
        status = estimate(context, grid, options, &job);
    }
    if (status == SL_OK) estimate_all(&job, degree, options->confidence, measures, intervals);
    sli_vga_tiles_destroy(context, &job.tiles);
    void *arrays[] = {job.part,   job.part_first, job.order, job.roots,
                      job.totals, job.tallies,    degree};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sl_free(context, arrays[i]);
    return status;
}
