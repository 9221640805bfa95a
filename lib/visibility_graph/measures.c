/// Measures of a visibility graph, by the formulas of depthmapX (vgavisuallocal.cpp,
/// vgavisualglobal.cpp of its salalib), after Turner et al. 2001 and Hillier and Hanson 1984.
///
/// Local measures look at the neighbours of a point and theirs: bit rows are intersected and
/// joined. Global measures search from each point, level by level: the points of a level are those
/// that a row of the level before has, and no earlier level. A search ends when all points have
/// been reached, so rows of the last level are rarely looked at.
///
/// Cost: a local measure O(connectivity * points / 64) for a point, a search O(points^2 / 64) at
/// most. Points are independent, so threads take bundles of them.
#include "visibility_graph/measures.h"

#include <math.h>
#include <string.h>

/// What a thread needs: sets of points, and the points of a level.
typedef struct scratch {
    sl_bits *seen, *level, *next;
} scratch;

static uint64_t count_bits(const sl_bits *set, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(set[i]);
    return count;
}

static uint64_t count_common(const sl_bits *a, const sl_bits *b, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += (uint64_t)__builtin_popcountll(a[i] & b[i]);
    return count;
}

// --- local

static void measure_local(const sli_vga_job *j, scratch *s, uint32_t point, sl_vga_measures *out) {
    const sl_vga_graph *graph = j->graph;
    const sl_bits *row = sli_vga_row(graph, point);
    const double degree = j->degree[point];
    const sl_point at = j->grid->points[point];
    uint64_t triangles = 0;
    memset(s->seen, 0, graph->words * sizeof *s->seen);
    out->point_first_moment = out->point_second_moment = out->visual_control = 0;
    for (size_t w = 0; w < graph->words; w++) {
        for (sl_bits rest = row[w]; rest; rest &= rest - 1) {
            const uint32_t q = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest);
            const sl_bits *other = sli_vga_row(graph, q);
            const double distance = hypot(j->grid->points[q].x - at.x, j->grid->points[q].y - at.y);
            out->point_first_moment += distance;
            out->point_second_moment += distance * distance;
            out->visual_control += 1.0 / j->degree[q];
            triangles += count_common(row, other, graph->words);
            for (size_t k = 0; k < graph->words; k++) s->seen[k] |= other[k];
        }
    }
    out->connectivity = degree;
    if (degree > 1)
        out->visual_clustering_coefficient = (double)triangles / (degree * (degree - 1));
    if (degree > 0)
        out->visual_controllability = degree / (double)count_bits(s->seen, graph->words);
    else
        out->visual_control = NAN;
}

// --- global

enum { DEPTHS = 4096 };

/// Numbers of points by depth; the last entry holds all that are deeper.
typedef struct depths {
    uint64_t points[DEPTHS];
    uint32_t deepest;
} depths;

/// Joins the rows of a level. Returns how many points of the result are new; `seen` gets them.
static uint64_t next_level(const sl_vga_graph *graph, scratch *s) {
    const size_t words = graph->words;
    memset(s->next, 0, words * sizeof *s->next);
    for (size_t w = 0; w < words; w++) {
        for (sl_bits rest = s->level[w]; rest; rest &= rest - 1) {
            const sl_bits *row =
                sli_vga_row(graph, (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest));
            for (size_t k = 0; k < words; k++) s->next[k] |= row[k];
        }
    }
    uint64_t found = 0;
    for (size_t k = 0; k < words; k++) {
        s->next[k] &= ~s->seen[k];
        s->seen[k] |= s->next[k];
        found += (uint64_t)__builtin_popcountll(s->next[k]);
    }
    sl_bits *swap = s->level;
    s->level = s->next;
    s->next = swap;
    return found;
}

static void search(const sl_vga_graph *graph, uint32_t point, uint32_t radius, scratch *s,
                   depths *out) {
    memset(s->seen, 0, graph->words * sizeof *s->seen);
    memset(s->level, 0, graph->words * sizeof *s->level);
    sl_bits_add(s->seen, point);
    sl_bits_add(s->level, point);
    out->points[0] = 1;
    out->deepest = 0;
    uint64_t left = graph->count - 1;
    for (uint32_t depth = 1; left && (radius == 0 || depth <= radius); depth++) {
        const uint64_t found = next_level(graph, s);
        if (!found) break;
        const uint32_t entry = depth < DEPTHS ? depth : DEPTHS - 1;
        if (entry > out->deepest) out->points[entry] = 0;
        out->points[entry] += found;
        out->deepest = entry;
        left -= found;
    }
}

/// Hillier and Hanson's relative asymmetry of the root of a diamond.
static double diamond_value(double n) {
    return 2 * (n * (log2((n + 2) / 3) - 1) + 1) / ((n - 1) * (n - 2));
}

static double pyramid_value(double n) {
    return 2 * (n - log2(n) - 1) / ((n - 1) * (n - 2));
}

static void measure_depths(const depths *d, sl_vga_measures *out) {
    double nodes = 0, total = 0;
    for (uint32_t k = 0; k <= d->deepest; k++) {
        nodes += (double)d->points[k];
        total += (double)k * (double)d->points[k];
    }
    out->visual_node_count = nodes;
    if (nodes < 2) return;
    const double mean = total / (nodes - 1);
    out->visual_mean_depth = mean;
    if (nodes > 2 && mean > 1) {
        const double ra = 2 * (mean - 1) / (nodes - 2);
        out->visual_integration_hh = diamond_value(nodes) / ra;
        out->visual_integration_pvalue = pyramid_value(nodes) / ra;
        out->visual_integration_tekl = log(0.5 * (nodes - 2)) / log(total - nodes + 1);
    }
    double entropy = 0, relative = 0, factorial = 1;
    for (uint32_t k = 1; k <= d->deepest; k++) {
        if (!d->points[k]) continue;
        const double share = (double)d->points[k] / (nodes - 1);
        entropy -= share * log2(share);
        factorial *= (double)(k + 1);
        const double expected = pow(mean, k) / factorial * exp(-mean);
        relative += share * log2(share / expected);
    }
    out->visual_entropy = entropy;
    out->visual_relativised_entropy = relative;
}

// --- all points

static void scratch_end(sl_context *context, void *all, void *state) {
    (void)all;
    scratch *s = state;
    sl_free(context, s->seen);
    sl_free(context, s->level);
    sl_free(context, s->next);
    sl_free(context, s);
}

static sl_status scratch_begin(sl_context *context, void *all, void **state) {
    const size_t words = ((const sli_vga_job *)all)->graph->words;
    scratch *s = sl_alloc_array(context, 1, sizeof *s);
    if (!s) return SL_NO_MEMORY;
    s->seen = sl_alloc_array(context, words, sizeof *s->seen);
    s->level = sl_alloc_array(context, words, sizeof *s->level);
    s->next = sl_alloc_array(context, words, sizeof *s->next);
    if (!s->seen || !s->level || !s->next) {
        scratch_end(context, all, s);
        return SL_NO_MEMORY;
    }
    *state = s;
    return SL_OK;
}

enum { POINTS_A_UNIT = 16 };

static sl_status measure_unit(sl_context *context, void *all, void *state, size_t unit) {
    const sli_vga_job *j = all;
    const uint32_t first = (uint32_t)unit * POINTS_A_UNIT, count = j->graph->count;
    for (uint32_t p = first; p < count && p < first + POINTS_A_UNIT; p++) {
        depths d;
        SL_TRY(sl_check_cancelled(context));
        if (j->options->parts & SL_VGA_LOCAL) measure_local(j, state, p, &j->measures[p]);
        if (!(j->options->parts & SL_VGA_GLOBAL)) continue;
        search(j->graph, p, j->options->radius, state, &d);
        measure_depths(&d, &j->measures[p]);
    }
    return SL_OK;
}

static sl_status measure_visual(sl_context *context, sli_vga_job *job) {
    const sl_work work = {.job = job,
                          .begin = scratch_begin,
                          .unit = measure_unit,
                          .end = scratch_end,
                          .stage = "measures",
                          .units = "bundles of points"};
    return sl_work_run(context, &work, (job->graph->count + POINTS_A_UNIT - 1) / POINTS_A_UNIT,
                       job->options->threads);
}

sl_vga_options sl_vga_options_default(void) {
    return (sl_vga_options){.parts = SL_VGA_LOCAL | SL_VGA_GLOBAL};
}

sl_status sl_vga_measure(sl_context *context, const sl_outline *outline, const sl_vga_grid *grid,
                         const sl_vga_graph *graph, const sl_vga_options *options,
                         sl_vga_measures *measures) {
    uint32_t *degree = sl_alloc_array(context, graph->count, sizeof *degree);
    if (!degree) return SL_NO_MEMORY;
    for (uint32_t p = 0; p < graph->count; p++) {
        degree[p] = (uint32_t)count_bits(sli_vga_row(graph, p), graph->words);
        double *all = (double *)&measures[p];
        for (size_t k = 0; k < sizeof *measures / sizeof *all; k++) all[k] = NAN;
    }
    sl_bits *turning = NULL;
    sl_status status = sli_vga_find_turning(context, outline, grid, &turning);
    sli_vga_job job = {grid, graph, options, degree, turning, measures};
    if (status == SL_OK && options->parts & (SL_VGA_LOCAL | SL_VGA_GLOBAL))
        status = measure_visual(context, &job);
    if (status == SL_OK && options->parts & SL_VGA_THROUGH)
        status = sli_vga_measure_through(context, &job);
    if (status == SL_OK && options->parts & (SL_VGA_METRIC | SL_VGA_ANGULAR))
        status = sli_vga_measure_paths(context, &job);
    sl_free(context, turning);
    sl_free(context, degree);
    return status;
}

sl_status sl_vga_step_depth(sl_context *context, const sl_vga_graph *graph, const uint32_t *from,
                            size_t from_count, uint32_t *depths_out) {
    sli_vga_job j = {.graph = graph};
    void *state;
    SL_TRY(scratch_begin(context, &j, &state));
    scratch *s = state;
    for (uint32_t p = 0; p < graph->count; p++) depths_out[p] = UINT32_MAX;
    for (size_t i = 0; i < from_count; i++) {
        sl_bits_add(s->seen, from[i]);
        sl_bits_add(s->level, from[i]);
        depths_out[from[i]] = 0;
    }
    for (uint32_t depth = 1; next_level(graph, s); depth++)
        for (uint32_t p = 0; p < graph->count; p++)
            if (sl_bits_has(s->level, p)) depths_out[p] = depth;
    scratch_end(context, NULL, s);
    return SL_OK;
}
