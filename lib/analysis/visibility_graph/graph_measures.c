/// The call for all measures of a visibility graph, and steps from chosen points.
#include "analysis/visibility_graph/graph_measures.h"
#include "analysis/visibility_graph/tiles.h"
#include "geometry/length.h"

#include <math.h>
#include <string.h>

/// The search for depths comes first: it counts points two steps away, for local measures too.
static sl_status measure_visual(sl_context *context, sli_vga_job *job) {
    const bool local = job->options->parts & SL_VGA_LOCAL;
    sli_vga_tiles tiles;
    SL_TRY(sli_vga_tiles_make(context, job->grid, job->graph, job->options->threads, &tiles));
    if (local) job->second = sl_alloc_array(context, job->graph->count, sizeof *job->second);
    sl_status status = local && !job->second ? SL_NO_MEMORY : SL_OK;
    if (status == SL_OK) status = sli_vga_measure_global(context, job, &tiles);
    if (status == SL_OK && local) status = sli_vga_measure_local(context, job, &tiles);
    sl_free(context, job->second);
    sli_vga_tiles_destroy(context, &tiles);
    return status;
}

sl_vga_options sl_vga_options_default(void) {
    return (sl_vga_options){.parts = SL_VGA_LOCAL | SL_VGA_GLOBAL};
}

void sli_vga_begin_measures(const sl_vga_graph *graph, bool connected, uint32_t *degree,
                            sl_vga_measures *measures) {
    for (uint32_t p = 0; p < graph->count; p++) {
        for (sl_vga_run run = sl_vga_row(graph, p); sl_vga_next(&run);)
            degree[p] += run.stop - run.first;
        double *all = (double *)&measures[p];
        for (size_t k = 0; k < sizeof *measures / sizeof *all; k++) all[k] = NAN;
        if (connected) measures[p].connectivity = degree[p];
    }
}

sl_status sl_vga_measure(sl_context *context, const sl_outline *outline, const sl_vga_grid *grid,
                         const sl_vga_graph *graph, const sl_vga_options *options,
                         sl_vga_measures *measures) {
    uint32_t *degree = sl_alloc_array(context, graph->count, sizeof *degree);
    if (!degree) return SL_NO_MEMORY;
    sli_vga_begin_measures(graph, options->parts & (SL_VGA_LOCAL | SL_VGA_GLOBAL), degree,
                           measures);
    sl_bits *turning = NULL;
    sl_status status = sli_vga_find_turning(context, outline, grid, &turning);
    sli_vga_job job = {grid, graph, options, degree, turning, NULL, measures};
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
