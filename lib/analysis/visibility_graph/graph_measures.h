/// What the measures of a visibility graph share.
#ifndef SL_VGA_MEASURES_H
#define SL_VGA_MEASURES_H

#include "analysis/visibility_graph/graph_rows.h"
#include "analysis/visibility_graph/tiles.h"
#include "sightline/support.h"
#include "sightline/vga.h"

/// Depths that a search counts points of, one by one.
enum { SLI_VGA_DEPTHS = 4096 };

typedef struct sli_vga_job {
    const sl_vga_grid *grid;
    const sl_vga_graph *graph;
    const sl_vga_options *options;
    const uint32_t *degree; ///< by point: its connectivity
    const sl_bits *turning; ///< points at which paths may turn
    uint32_t *second;       ///< by point: the points two steps away; NULL: not asked for
    sl_vga_measures *measures;
} sli_vga_job;

/// Adds the connectivity of each point to a zeroed array. All measures become NAN but, if it is
/// asked for, this one.
void sli_vga_begin_measures(const sl_vga_graph *graph, bool connected, uint32_t *degree,
                            sl_vga_measures *measures);

/// The points beside walls. The result is the caller's.
sl_status sli_vga_find_turning(sl_context *context, const sl_outline *outline,
                               const sl_vga_grid *grid, sl_bits **out);

/// Whether a point is to be measured.
static inline bool sli_vga_is_asked(const sl_vga_options *options, uint32_t point) {
    return !options->count || (point >= options->first && point - options->first < options->count);
}

/// The places of a bundle that have points to measure.
static inline uint64_t sli_vga_places(const sli_vga_job *job, const sli_vga_tiles *tiles,
                                      size_t bundle) {
    uint64_t places = 0;
    for (size_t i = 0; i < 64 && bundle * 64 + i < tiles->count; i++)
        if (sli_vga_is_asked(job->options, tiles->points[bundle * 64 + i]))
            places |= (uint64_t)1 << i;
    return places;
}

/// Some of these places of a bundle: points that all see each other. In a directed graph it is one.
uint64_t sli_vga_choose_group(const sli_vga_job *job, const sli_vga_tiles *tiles, size_t bundle,
                              uint64_t places);

/// Global measures of all points, if they are asked for, and points two steps away likewise.
sl_status sli_vga_measure_global(sl_context *context, const sli_vga_job *job,
                                 const sli_vga_tiles *tiles);

/// Local measures of all points.
sl_status sli_vga_measure_local(sl_context *context, const sli_vga_job *job,
                                const sli_vga_tiles *tiles);

/// Metric and angular measures of all points, as the options ask.
sl_status sli_vga_measure_paths(sl_context *context, const sli_vga_job *job);

/// Through vision of all points.
sl_status sli_vga_measure_through(sl_context *context, const sli_vga_job *job);

#endif
