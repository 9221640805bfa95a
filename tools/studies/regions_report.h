/// The results of `sightline regions`: from-region methods on maps, for several sets of view cells.
#ifndef REGIONS_REPORT_H
#define REGIONS_REPORT_H

#include "sightline/from_region.h"
#include "sightline/support.h"

enum { REGIONS_METHODS_MOST = 4 };

/// What a method cost.
typedef struct regions_cost {
    const char *method;
    double seconds;      ///< of processor time, all threads'
    double refined;      ///< objects given to the solver, an image's mean share of all
    uint64_t candidates; ///< over view cells and quadrants
    uint64_t relations;  ///< 0 where the method does not tell
} regions_cost;

/// A map with one set of view cells.
typedef struct regions_row {
    char map[64], view_cells[32];
    sl_from_region_counts counts;
    uint64_t images, rays, pairs;
    regions_cost costs[REGIONS_METHODS_MOST];
    size_t cost_count;
} regions_row;

typedef SL_ARRAY(regions_row) regions_rows;

/// A view cell's mean share of the objects seen.
static inline double regions_mean_pvs(const regions_row *row) {
    const double all = (double)row->counts.view_cells * row->counts.objects;
    return all > 0 ? (double)row->pairs / all : 0;
}

void regions_print(const regions_rows *rows);
sl_status regions_write_csv(sl_context *context, const regions_rows *rows, const char *path);
/// The hierarchy's mean refine set over multipass's against the mean visible set (Laine 2005,
/// figure 11).
sl_status regions_draw_refine(sl_context *context, const regions_rows *rows, bool dark,
                              const char *path);
/// Multipass's candidates over what it found, and the bound.
sl_status regions_draw_work(sl_context *context, const regions_rows *rows, bool dark,
                            const char *path);

#endif
