/// The work of `sightline viewcells`: from a map to a cut of the hierarchy of view cells.
#ifndef VIEW_RUN_H
#define VIEW_RUN_H

#include "sightline/bake.h"
#include "sightline/view_cells.h"

/// How the number of view cells is chosen.
typedef enum view_budget { BUDGET_TOLERANCE, BUDGET_CELLS, BUDGET_BYTES } view_budget;

typedef struct view_run_options {
    const sl_view_method *method;
    sl_view_sampling sampling;
    sl_view_subdivision subdivision;
    sl_render_cost render;
    bool exact;          ///< merged and told by exact sets, whatever the method
    uint64_t evaluation; ///< samples for it; 0 for none
    bool paths;          ///< viewpoints are along the map's paths
    double step;         ///< along them
    const char *density; ///< a picture of where viewpoints are, NULL for none
    view_budget budget;
    uint64_t cells, bytes;
    double tolerance;
} view_run_options;

typedef struct view_seconds {
    double read, subdivide, sample, divide, merge, evaluate, see;
} view_seconds;

/// All that was made, and what it took.
typedef struct view_run {
    sl_baked baked; ///< map and space alone
    sl_query *query;
    const sl_outline *outline;
    sl_view_places places;
    sl_view_scene scene;
    sl_view_segments segments;
    sl_view_tree tree;
    sl_view_found found;         ///< what an exact method did; its sets are in the hierarchy
    sl_view_hierarchy hierarchy; ///< as the segments tell it that it was made by
    sl_view_hierarchy evaluated; ///< as others do; no cells where there were none
    uint32_t cell_count;         ///< of the cut
    uint32_t *view_cells;        ///< by elementary cell
    uint32_t *numbers;           ///< by view cell: its number in the hierarchy
    bool has_exact;              ///< exact sets are there
    sl_baked exact;              ///< the map with the borders of view cells as seams, seen
    double exact_cost;           ///< expected, in cells; 0 where objects are walls
    uint64_t cell_bytes;         ///< what rows of the cells of `exact` take
    uint64_t plain_bytes;        ///< what rows of view cells take, before compression
    view_seconds seconds;
} view_run;

/// Starts from run->baked, which has a map and a space. Destroy `run` also on failure.
sl_status view_run_make(sl_context *context, const view_run_options *options, view_run *run);
/// Bakes the map with the view cells of the cut: exact sets by a method of sl_see_methods(); NULL
/// for the fastest exact one. `by_views`: keeps only the sets of view cells.
sl_status view_run_see(sl_context *context, const view_run_options *options,
                       const sl_see_method *method, bool by_views, view_run *run);
void view_run_destroy(sl_context *context, view_run *run);

/// The hierarchy that costs are reported by: that of the second set of samples, if there is one.
static inline const sl_view_hierarchy *view_run_told(const view_run *run) {
    return run->evaluated.cell_count ? &run->evaluated : &run->hierarchy;
}

/// The expected cost with that many view cells: the sum of mass times cost.
sl_status view_run_cost(sl_context *context, const sl_view_hierarchy *hierarchy, uint32_t cells,
                        double *cost, uint64_t *bytes);

#endif
