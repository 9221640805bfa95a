/// One view put to every culling method.
#ifndef EYE_RUN_H
#define EYE_RUN_H

#include "sightline/bake.h"
#include "sightline/eye_to_cell.h"
#include "sightline/mirrored.h"

/// What one method says.
typedef struct sl_eye_result {
    uint64_t *cells; ///< sl_eye_words() words
    uint32_t count;  ///< of cells
    double share;    ///< of the area of the cells on the eye's side (see sl_eye_run)
    sl_eye_account account;
    double seconds;     ///< a query; 0 where it was not timed
    uint64_t *mirrored; ///< the cells seen by mirror; NULL where the method or the map knows none
    uint32_t mirrored_count;
    double mirrored_share;
    uint64_t rounded; ///< images that were rounded
} sl_eye_result;

/// Shares are of the cells that count (sl_baked_counts) where the eye's cell does, else of the
/// others.
typedef struct sl_eye_run {
    sl_view view;
    uint32_t cell;          ///< the eye's
    sl_eye_result *results; ///< one a method of sl_eye_methods()
    size_t result_count;
    sl_region region;      ///< the exact visible region
    double region_share;   ///< of the same area
    double region_seconds; ///< as above
    bool has_mirrors;      ///< the map; else the rest is empty
    uint32_t mirror_depth;
    double range;                ///< of the exact method and the region; 0 for no limit
    sl_mirrored_region mirrored; ///< the region with what is seen by mirror
} sl_eye_run;

/// A distance for sl_view_cone: as large as anything in the map.
double sl_eye_reach(const sl_space *space);

/// How many cells a set has, and their share as above; *count is added to.
void sl_eye_measure(const sl_baked *baked, uint32_t eye_cell, const uint64_t *cells,
                    uint32_t *count, double *share);

/// The eye must be within the bounds. `timed`: queries are repeated until their time is known.
/// `depth`: reflections, at most. `range`: how far is seen, reflected or not; 0 for no limit.
sl_status sl_eye_run_make(sl_context *context, const sl_baked *baked, const sl_view *view,
                          uint32_t depth, double range, bool timed, sl_eye_run *out);
void sl_eye_run_destroy(sl_context *context, sl_eye_run *run);

#endif
