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
    sl_vga_measures *measures;
} sli_vga_job;

/// The points beside walls. The result is the caller's.
sl_status sli_vga_find_turning(sl_context *context, const sl_outline *outline,
                               const sl_vga_grid *grid, sl_bits **out);

/// Global measures of all points.
sl_status sli_vga_measure_global(sl_context *context, const sli_vga_job *job,
                                 const sli_vga_tiles *tiles);

/// Metric and angular measures of all points, as the options ask.
sl_status sli_vga_measure_paths(sl_context *context, const sli_vga_job *job);

/// Through vision of all points.
sl_status sli_vga_measure_through(sl_context *context, const sli_vga_job *job);

#endif
