/// Local measures of a visibility graph, by the formulas of depthmapX (vgavisuallocal.cpp of its
/// salalib), after Turner et al. 2001; and the call for all measures.
///
/// Local measures look at the neighbours of a point and theirs. They work on tiles of the graph
/// (tiles.h), so sets are by slot here.
///
/// Cost: O(connectivity * bundles in sight) for a point. Points are independent, so threads take
/// bundles of them.
#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/tiles.h"
#include "geometry/length.h"

#include <math.h>
#include <string.h>

/// What the threads share, and what each needs: sets of points, and the points of a level.
typedef struct visual_job {
    const sli_vga_job *all;
    sli_vga_tiles tiles;
} visual_job;

typedef struct scratch {
    sl_bits *seen, *level, *next;
} scratch;

/// Without a call, as processors that count bits themselves are not taken for granted.
static inline uint64_t count_bits(uint64_t bits) {
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    return ((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56;
}

static uint64_t count_set(const sl_bits *set, size_t words) {
    uint64_t count = 0;
    for (size_t i = 0; i < words; i++) count += count_bits(set[i]);
    return count;
}

// --- local

/// Ordered pairs of neighbours of a point that see each other. Sight is mutual, so of two tiles
/// with the same pairs one is counted, twice.
static uint64_t count_triangles(const sli_vga_tiles *t, const sl_bits *neighbours) {
    uint64_t count = 0;
    for (size_t b = 0; b < t->bundles; b++) {
        if (!neighbours[b]) continue;
        for (size_t i = t->first[b]; i < t->first[b + 1]; i++) {
            const sli_vga_tile *tile = &t->tiles.items[i];
            const sl_bits others = neighbours[tile->bundle] & tile->any;
            if (tile->bundle < b || !others) continue;
            uint64_t of_tile = 0;
            for (sl_bits rest = neighbours[b]; rest; rest &= rest - 1)
                of_tile += count_bits(t->rows.items[i].rows[__builtin_ctzll(rest)] & others);
            count += tile->bundle == b ? of_tile : 2 * of_tile;
        }
    }
    return count;
}

static void measure_local(const visual_job *v, scratch *s, uint32_t point, sl_vga_measures *out) {
    const sli_vga_job *j = v->all;
    const sli_vga_tiles *t = &v->tiles;
    const double degree = j->degree[point];
    const sl_point at = j->grid->points[point];
    const size_t slot = t->slots[point], bytes = t->bundles * sizeof *s->level;
    memset(s->level, 0, bytes);
    memset(s->seen, 0, bytes);
    memset(s->next, 0, bytes);
    for (size_t i = t->first[slot / 64]; i < t->first[slot / 64 + 1]; i++)
        s->level[t->tiles.items[i].bundle] = t->rows.items[i].rows[slot % 64];
    out->point_first_moment = out->point_second_moment = out->visual_control = 0;
    for (size_t b = 0; b < t->bundles; b++) {
        for (sl_bits rest = s->level[b]; rest; rest &= rest - 1) {
            const uint32_t q = t->points[b * 64 + (size_t)__builtin_ctzll(rest)];
            const double distance =
                sli_length(j->grid->points[q].x - at.x, j->grid->points[q].y - at.y);
            out->point_first_moment += distance;
            out->point_second_moment += distance * distance;
            // Behind one-way glass a neighbour may see nothing.
            out->visual_control += j->degree[q] ? 1.0 / j->degree[q] : NAN;
        }
    }
    if (degree > 1)
        out->visual_clustering_coefficient =
            (double)count_triangles(t, s->level) / (degree * (degree - 1));
    sli_vga_tiles_step(t, s->level, s->seen, s->next);
    const uint64_t together = count_set(s->next, t->bundles);
    if (together) out->visual_controllability = degree / (double)together;
    if (!(degree > 0)) out->visual_control = NAN;
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
    const size_t words = ((const visual_job *)all)->tiles.bundles;
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
    const visual_job *v = all;
    const sli_vga_job *j = v->all;
    const uint32_t first = (uint32_t)unit * POINTS_A_UNIT, count = j->graph->count;
    for (uint32_t p = first; p < count && p < first + POINTS_A_UNIT; p++) {
        SL_TRY(sl_check_cancelled(context));
        measure_local(v, state, p, &j->measures[p]);
    }
    return SL_OK;
}

static sl_status measure_visual(sl_context *context, const sli_vga_job *job) {
    visual_job v = {.all = job};
    SL_TRY(sli_vga_tiles_make(context, job->grid, job->graph, &v.tiles));
    const sl_work work = {.job = &v,
                          .begin = scratch_begin,
                          .unit = measure_unit,
                          .end = scratch_end,
                          .stage = "measures",
                          .units = "bundles of points"};
    const size_t units = (job->graph->count + POINTS_A_UNIT - 1) / POINTS_A_UNIT;
    sl_status status = SL_OK;
    if (job->options->parts & SL_VGA_LOCAL)
        status = sl_work_run(context, &work, units, job->options->threads);
    if (status == SL_OK && job->options->parts & SL_VGA_GLOBAL)
        status = sli_vga_measure_global(context, job, &v.tiles);
    sli_vga_tiles_destroy(context, &v.tiles);
    return status;
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
        degree[p] = (uint32_t)count_set(sli_vga_row(graph, p), graph->words);
        double *all = (double *)&measures[p];
        for (size_t k = 0; k < sizeof *measures / sizeof *all; k++) all[k] = NAN;
        if (options->parts & (SL_VGA_LOCAL | SL_VGA_GLOBAL)) measures[p].connectivity = degree[p];
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
    uint32_t *queue = sl_alloc_array(context, graph->count, sizeof *queue);
    sl_bits *unseen = sl_alloc_array(context, graph->words, sizeof *unseen);
    sl_status status = queue && unseen ? SL_OK : SL_NO_MEMORY;
    size_t head = 0, tail = 0;
    for (uint32_t p = 0; p < graph->count && status == SL_OK; p++) {
        depths_out[p] = UINT32_MAX;
        sl_bits_add(unseen, p);
    }
    for (size_t i = 0; i < from_count && status == SL_OK; i++) {
        if (!sl_bits_has(unseen, from[i])) continue;
        sl_bits_flip(unseen, from[i]);
        depths_out[from[i]] = 0;
        queue[tail++] = from[i];
    }
    while (status == SL_OK && head < tail) {
        const uint32_t p = queue[head++];
        const sl_bits *row = sli_vga_row(graph, p);
        if (head % 4096 == 0) status = sl_check_cancelled(context);
        for (size_t w = 0; w < graph->words; w++) {
            for (sl_bits rest = row[w] & unseen[w]; rest; rest &= rest - 1) {
                const uint32_t q = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(rest);
                depths_out[q] = depths_out[p] + 1;
                queue[tail++] = q;
            }
            unseen[w] &= ~row[w];
        }
    }
    sl_free(context, queue);
    sl_free(context, unseen);
    return status;
}
