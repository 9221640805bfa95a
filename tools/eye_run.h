/// One view put to every culling method.
#ifndef EYE_RUN_H
#define EYE_RUN_H

#include "sightline/bake.h"
#include "sightline/eye_to_cell.h"
#include "sightline/region.h"

/// What one method says.
typedef struct sl_eye_result {
    uint64_t *cells; ///< sl_eye_words() words
    uint32_t count;  ///< of cells
    double share;    ///< of the area of the cells on the eye's side (see sl_eye_run)
    sl_eye_account account;
    double seconds; ///< a query; 0 where it was not timed
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
} sl_eye_run;

/// A distance for sl_view_cone: as large as anything in the map.
double sl_eye_reach(const sl_space *space);

/// The eye must be within the bounds. `timed`: queries are repeated until their time is known.
sl_status sl_eye_run_make(sl_context *context, const sl_baked *baked, const sl_view *view,
                          bool timed, sl_eye_run *out);
void sl_eye_run_destroy(sl_context *context, sl_eye_run *run);

#endif
