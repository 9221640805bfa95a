/// The network of axial lines, and its measures (Hillier and Hanson 1984).
///
/// A step leads from a line to one that touches it. A search from each line, level by level, counts
/// the lines by depth: integration and its kin follow. Choice is betweenness (Brandes 2001): on the
/// way back through the levels, each line hands on what depends on it to the lines before it,
/// shared as their shortest paths are.
///
///      root     Numbers of shortest paths: 1, 1, 1, 2. The last line depends on the root by
///      /  \     both: each of the two gets a half.
///     o    o
///      \  /     Choice adds up in whole numbers of 2^-24, so that the order of threads does not
///       o       change a bit of it.
///
/// Lines are sorted by their left ends, and each is tested against those whose extents in x
/// overlap. Cost of measures: O(n * pairs that touch) for n lines.
#include "base/base.h"
#include "geometry/length.h"
#include "sightline/axial.h"

#include "analysis/axial/touch.h"
#include "analysis/visibility_graph/integration.h"
#include "sightline/support.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

// --- the network

void sl_line_graph_destroy(sl_context *context, sl_line_graph *graph) {
    sl_free(context, graph->first);
    sl_free(context, graph->others);
    *graph = (sl_line_graph){0};
}

typedef struct extent {
    double left, right;
    uint32_t line;
} extent;

static int compare_extents(const void *left, const void *right) {
    const extent *a = left, *b = right;
    if (a->left != b->left) return a->left < b->left ? -1 : 1;
    return (a->line > b->line) - (a->line < b->line);
}

typedef struct pair {
    uint32_t a, b;
} pair;

typedef struct pairs {
    SL_ARRAY(pair) list;
} pairs;

static sl_status find_pairs(sl_context *context, const sl_segment *lines, uint32_t count,
                            pairs *out) {
    extent *order = sl_alloc_array(context, (size_t)count + 1, sizeof *order);
    if (!order) return SL_NO_MEMORY;
    sl_status status = SL_OK;
    for (uint32_t i = 0; i < count; i++)
        order[i] = (extent){fmin(lines[i].a.x, lines[i].b.x), fmax(lines[i].a.x, lines[i].b.x), i};
    qsort(order, count, sizeof *order, compare_extents);
    for (uint32_t i = 0; i < count && status == SL_OK; i++) {
        const uint32_t a = order[i].line;
        if (i % 64 == 0) status = sl_check_cancelled(context);
        // Each pair is kept in a list, and then at both of its lines.
        if ((double)out->list.count * 4 * sizeof(pair) > (double)sl_machine_memory() / 2)
            status = sl_fail(context, SL_UNSUPPORTED,
                             "%u lines touch in more pairs than this machine has memory for; take "
                             "fewer lines",
                             count);
        for (uint32_t k = i + 1; k < count && order[k].left <= order[i].right; k++) {
            const uint32_t b = order[k].line;
            if (status != SL_OK || !sli_touch(&lines[a], &lines[b])) continue;
            status = SL_ARRAY_ROOM(context, &out->list, 1);
            if (status == SL_OK) out->list.items[out->list.count++] = (pair){a, b};
        }
    }
    sl_free(context, order);
    return status;
}

sl_status sl_line_graph_make(sl_context *context, const sl_segment *lines, uint32_t count,
                             sl_line_graph *out) {
    pairs found = {0};
    sl_line_graph graph = {.count = count};
    sl_status status = find_pairs(context, lines, count, &found);
    if (status == SL_OK) {
        graph.first = sl_alloc_array(context, (size_t)count + 2, sizeof *graph.first);
        graph.others = sl_alloc_array(context, 2 * found.list.count + 1, sizeof *graph.others);
        if (!graph.first || !graph.others) status = SL_NO_MEMORY;
    }
    if (status == SL_OK) {
        for (size_t i = 0; i < found.list.count; i++) {
            graph.first[found.list.items[i].a + 2]++;
            graph.first[found.list.items[i].b + 2]++;
        }
        for (uint32_t i = 0; i < count; i++) graph.first[i + 2] += graph.first[i + 1];
        for (size_t i = 0; i < found.list.count; i++) {
            const pair p = found.list.items[i];
            graph.others[graph.first[p.a + 1]++] = p.b;
            graph.others[graph.first[p.b + 1]++] = p.a;
        }
        for (uint32_t i = 0; i < count; i++)
            qsort(graph.others + graph.first[i], graph.first[i + 1] - graph.first[i],
                  sizeof *graph.others, sli_compare_whole);
    }
    sl_free(context, found.list.items);
    if (status == SL_OK)
        *out = graph;
    else
        sl_line_graph_destroy(context, &graph);
    return status;
}

// --- measures

/// Choice in whole numbers.
#define SHARE 0x1p24

typedef struct job {
    const sl_segment *lines;
    const sl_line_graph *graph;
    const sl_axial_options *options;
    sl_axial_measures *measures;
    _Atomic uint64_t *choice; ///< by line
} job;

typedef struct scratch {
    uint32_t *depth, *queue, *marks;
    double *paths, *depends; ///< by line: shortest paths from the root, and what depends on it
    uint64_t *choice;
    uint32_t mark;
} scratch;

static void end_measure_worker(sl_context *context, void *all, void *state) {
    const job *j = all;
    scratch *s = state;
    for (uint32_t i = 0; i < j->graph->count && s->choice; i++)
        if (s->choice[i]) atomic_fetch_add(&j->choice[i], s->choice[i]);
    sl_free(context, s->depth);
    sl_free(context, s->queue);
    sl_free(context, s->marks);
    sl_free(context, s->paths);
    sl_free(context, s->depends);
    sl_free(context, s->choice);
    sl_free(context, s);
}

static sl_status begin_measure_worker(sl_context *context, void *all, void **state) {
    const size_t count = (size_t)((const job *)all)->graph->count + 1;
    scratch *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->depth = sl_alloc_array(context, count, sizeof *s->depth);
    s->queue = sl_alloc_array(context, count, sizeof *s->queue);
    s->marks = sl_alloc_array(context, count, sizeof *s->marks);
    s->paths = sl_alloc_array(context, count, sizeof *s->paths);
    s->depends = sl_alloc_array(context, count, sizeof *s->depends);
    s->choice = sl_alloc_array(context, count, sizeof *s->choice);
    if (!s->depth || !s->queue || !s->marks || !s->paths || !s->depends || !s->choice) {
        end_measure_worker(context, all, s);
        return SL_NO_MEMORY;
    }
    *state = s;
    return SL_OK;
}

/// Returns how many lines are reached: queue[0 .. count), in ascending depth.
static uint32_t search(const job *j, scratch *s, uint32_t root) {
    const sl_line_graph *g = j->graph;
    const uint32_t radius = j->options->radius;
    uint32_t tail = 0;
    for (uint32_t i = 0; i < g->count; i++) {
        s->depth[i] = UINT32_MAX;
        s->paths[i] = s->depends[i] = 0;
    }
    s->depth[root] = 0;
    s->paths[root] = 1;
    s->queue[tail++] = root;
    for (uint32_t head = 0; head < tail; head++) {
        const uint32_t at = s->queue[head];
        if (radius && s->depth[at] == radius) break;
        for (size_t i = g->first[at]; i < g->first[at + 1]; i++) {
            const uint32_t next = g->others[i];
            if (s->depth[next] == UINT32_MAX) {
                s->depth[next] = s->depth[at] + 1;
                s->queue[tail++] = next;
            }
            if (s->depth[next] == s->depth[at] + 1) s->paths[next] += s->paths[at];
        }
    }
    return tail;
}

static void add_choice(const job *j, scratch *s, uint32_t reached) {
    const sl_line_graph *g = j->graph;
    for (uint32_t k = reached; k-- > 1;) {
        const uint32_t at = s->queue[k];
        const double each = (1 + s->depends[at]) / s->paths[at];
        for (size_t i = g->first[at]; i < g->first[at + 1]; i++) {
            const uint32_t before = g->others[i];
            if (s->depth[before] + 1 == s->depth[at]) s->depends[before] += s->paths[before] * each;
        }
        s->choice[at] += (uint64_t)llround(s->depends[at] * SHARE);
    }
}

static void measure_depths(const scratch *s, uint32_t reached, sl_axial_measures *out) {
    const double nodes = reached;
    double total = 0, entropy = 0;
    for (uint32_t k = 1, from = 1; k <= reached; k++) {
        if (k < reached) total += s->depth[s->queue[k]];
        if (k < reached && s->depth[s->queue[k]] == s->depth[s->queue[from]]) continue;
        const double share = (k - from) / (nodes - 1);
        if (k > from) entropy -= share * log2(share);
        from = k;
    }
    out->node_count = nodes;
    out->total_depth = total;
    if (reached < 2) return;
    const double mean = total / (nodes - 1);
    out->mean_depth = mean;
    out->entropy = entropy;
    const sli_integration integration = sli_integration_of(nodes, total);
    out->integration_hh = integration.hh;
    out->integration_pvalue = integration.pvalue;
    out->integration_tekl = integration.tekl;
}

static void measure_local(const job *j, scratch *s, uint32_t line, sl_axial_measures *out) {
    const sl_line_graph *g = j->graph;
    const sl_segment *l = &j->lines[line];
    uint32_t together = 0;
    s->mark++;
    out->connectivity = (double)(g->first[line + 1] - g->first[line]);
    out->line_length = sli_length(l->b.x - l->a.x, l->b.y - l->a.y);
    if (out->connectivity == 0) return;
    out->control = 0;
    for (size_t i = g->first[line]; i < g->first[line + 1]; i++) {
        const uint32_t other = g->others[i];
        out->control += 1.0 / (double)(g->first[other + 1] - g->first[other]);
        for (size_t k = g->first[other]; k < g->first[other + 1]; k++) {
            together += s->marks[g->others[k]] != s->mark;
            s->marks[g->others[k]] = s->mark;
        }
    }
    out->controllability = out->connectivity / together;
}

static sl_status measure_line(sl_context *context, void *all, void *state, size_t line) {
    const job *j = all;
    scratch *s = state;
    sl_axial_measures *out = &j->measures[line];
    double *values = (double *)out;
    for (size_t k = 0; k < sizeof *out / sizeof *values; k++) values[k] = NAN;
    SL_TRY(sl_check_cancelled(context));
    measure_local(j, s, (uint32_t)line, out);
    const uint32_t reached = search(j, s, (uint32_t)line);
    measure_depths(s, reached, out);
    add_choice(j, s, reached);
    return SL_OK;
}

sl_status sl_axial_measure(sl_context *context, const sl_segment *lines, const sl_line_graph *graph,
                           const sl_axial_options *options, sl_axial_measures *measures) {
    void *block = sl_alloc_array(context, (size_t)graph->count + 1, sizeof(_Atomic uint64_t));
    if (!block) return SL_NO_MEMORY;
    job j = {lines, graph, options, measures, block};
    const sl_work work = {.job = &j,
                          .begin = begin_measure_worker,
                          .unit = measure_line,
                          .end = end_measure_worker,
                          .stage = "axial measures",
                          .units = "lines"};
    const sl_status status = sl_work_run(context, &work, graph->count, options->threads);
    for (uint32_t i = 0; i < graph->count && status == SL_OK; i++) {
        const double nodes = measures[i].node_count;
        // Each pair was seen from both of its ends.
        measures[i].choice = (double)atomic_load(&j.choice[i]) / (2 * SHARE);
        if (nodes > 2)
            measures[i].choice_norm = measures[i].choice / ((nodes - 1) * (nodes - 2) / 2);
    }
    sl_free(context, block);
    return status;
}
