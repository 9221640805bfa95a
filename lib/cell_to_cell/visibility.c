/// The result of a method, and what a method asks of its solver.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"

#include "sightline/stab.h"
#include "sightline/support.h"

#include <string.h>

void sl_visibility_destroy(sl_context *context, sl_visibility *visibility) {
    sl_pvs_destroy(context, &visibility->pvs);
    sl_pvs_destroy(context, &visibility->doubtful);
    sl_pvs_destroy(context, &visibility->mirrored);
    sli_door_sets_destroy(context, &visibility->doors);
    sli_door_sets_destroy(context, &visibility->mirrored_doors);
    sl_free(context, visibility->trees.offsets);
    sl_free(context, visibility->trees.nodes);
    *visibility = (sl_visibility){0};
}

sl_status sli_plan_check_solver(sl_context *context, const sl_plan *plan, const sl_solver *solver) {
    if (plan->range > 0 && strcmp(solver->name, sl_funnel()->name) != 0)
        return sl_fail(context, SL_UNSUPPORTED,
                       "the solver '%s' does not tell how long sightlines are, which a view range "
                       "asks for: take 'funnel'",
                       solver->name);
    if (plan->effects && solver->guarantee != SL_EXACT)
        return sl_fail(context, SL_UNSUPPORTED,
                       "the solver '%s' is rounded, and the map's effects ask for an exact one: "
                       "take 'funnel'",
                       solver->name);
    return SL_OK;
}
