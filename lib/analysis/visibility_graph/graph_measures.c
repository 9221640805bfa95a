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

// --- local

/// Ordered pairs of neighbours of a point that see each other. Sight is mutual, so of two tiles
/// with the same pairs one is counted, twice.
static uint64_t count_triangles(const sli_vga_tiles *t, const sl_bits *neighbours) {
    uint64_t count = 0;
    for (size_t b = 0; b < t->bundles; b++) {
        if (!neighbours[b]) continue;
        for (uint32_t i = 0; i < t->of[b].count; i++) {
            const sli_vga_tile *tile = &t->of[b].tiles[i];
            const sl_bits others = neighbours[tile->bundle] & tile->any;
            if (tile->bundle < b || !others) continue;
            uint64_t of_tile = 0;
            if (neighbours[b] == UINT64_MAX && others == tile->any)
                of_tile = sli_vga_tile_pairs(&t->of[b], tile);
            else
                for (sli_vga_span span = sli_vga_spans(&t->of[b], tile); sli_vga_next_span(&span);)
                    of_tile += (uint64_t)sli_word_count(span.places & neighbours[b]) *
                               sli_word_count(span.seen & others);
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
    const sli_vga_bundle *of = &t->of[slot / 64];
    for (uint32_t i = 0; i < of->count; i++)
        s->level[of->tiles[i].bundle] = sli_vga_tile_row(of, &of->tiles[i], slot % 64);
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
    const uint64_t together = sli_bits_count(s->next, t->bundles);
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
    SL_TRY(sli_vga_tiles_make(context, job->grid, job->graph, job->options->threads, &v.tiles));
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
        for (sl_vga_run run = sl_vga_row(graph, p); sl_vga_next(&run);)
            degree[p] += run.stop - run.first;
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
    sl_bits *unseen = sl_alloc_array(context, sl_bits_words(graph->count), sizeof *unseen);
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
        if (head % 4096 == 0) status = sl_check_cancelled(context);
        for (sl_vga_run run = sl_vga_row(graph, p); sl_vga_next(&run);)
            for (size_t w = run.first / 64; w * 64 < run.stop; w++) {
                sl_bits found = unseen[w] & sli_bits_run(w, run.first, run.stop);
                unseen[w] &= ~found;
                for (; found; found &= found - 1) {
                    const uint32_t q = (uint32_t)(w * 64) + (uint32_t)__builtin_ctzll(found);
                    depths_out[q] = depths_out[p] + 1;
                    queue[tail++] = q;
                }
            }
    }
    sl_free(context, queue);
    sl_free(context, unseen);
    return status;
}
