/// What a from-region solver is asked: which of a refine set's objects are seen through a face in a
/// quadrant of directions. All methods ask it the same, but for the refine set.
#ifndef SL_REGION_SOLVER_H
#define SL_REGION_SOLVER_H

#include "from_region/regions.h"

typedef struct sl_from_region_query {
    const sl_face *face;
    int quadrant;
    const sl_bits *refine;
} sl_from_region_query;

/// What a solver counts.
typedef struct sl_from_region_account {
    uint64_t images, rays, refined;
} sl_from_region_account;

typedef struct sl_from_region_looker {
    sl_status (*create)(sl_context *context, const sl_regions *scene,
                        const sl_from_region_options *options, void **state);
    void (*destroy)(sl_context *context, void *state);
    /// Adds what is seen to `seen`.
    sl_status (*look)(sl_context *context, void *state, const sl_from_region_query *query,
                      sl_bits *seen, sl_from_region_account *account);
} sl_from_region_looker;

const sl_from_region_looker *sl_from_region_sampling(void);
const sl_from_region_looker *sl_from_region_stabs(void);

#endif
