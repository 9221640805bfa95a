/// The sweep for maps with doors, mirrors or a view range: it decides most pairs, a search the
/// rest.
///
/// With all doors open the sweep sees every pair that can be seen at all. With all doors shut it
/// sees the pairs that need no door. Cells whose nearest points are beyond the range do not see
/// each other. Cells whose farthest points are within it need no test of the range. The depth-first
/// search is left the pairs that are possible and not certain. It goes only where such a pair is
/// left.
///
/// What is seen by mirror is left to the search too. From a cell it goes only where the sweep has
/// seen a cell with a mirror on its side. Behind the mirror a line is straight again. So each cell
/// that it enters has seen, by the sweep, all cells that it still comes to: the search goes only
/// where such a cell is not known yet.
#include "cell_to_cell/sweep/sweep.h"
#include "effects/filtered.h"

#include "cell_to_cell/methods.h"
#include "cell_to_cell/search/dfs.h"
#include "sightline/stab.h"

#include <string.h>

/// With walls in all doors; cells are the same.
static sl_status see_shut(sl_context *context, const sl_space *space, const sl_see_options *options,
                          size_t doors, sl_visibility *out) {
    bool *shut = sl_alloc_array(context, doors, sizeof *shut);
    if (!shut) return SL_NO_MEMORY;
    memset(shut, 1, doors * sizeof *shut);
    sl_space walled = {0};
    const sli_filtered_space filtered = {.shut = shut};
    sl_status status = sli_filtered_space_make(context, space, &filtered, NULL, &walled);
    sl_free(context, shut);
    if (status == SL_OK) status = sli_see_sweep(context, &walled, options, out);
    sl_space_destroy(context, &walled);
    return status;
}

static sl_status narrow(sl_context *context, const sl_space *space, double range,
                        sli_cells_apart most, sl_pvs *pvs) {
    sl_pvs within;
    SL_TRY(sli_pvs_within(context, space, pvs, range, most, &within));
    sl_pvs_destroy(context, pvs);
    *pvs = within;
    return SL_OK;
}

/// Whether pairs need sets of doors. With a limit of 0 they count as seen through open doors.
static bool keeps_doors(const sl_plan *plan) {
    return plan->effects & SL_EFFECT_DOOR && plan->door_limit;
}

/// The pairs that are seen whatever doors are shut: into `shut`, from those with all doors open.
static sl_status find_certain(sl_context *context, const sl_space *space,
                              const sl_see_options *options, const sl_plan *plan,
                              const sl_visibility *open, sl_visibility *shut) {
    const double range = plan->range;
    if (!keeps_doors(plan))
        return sli_pvs_within(context, space, &open->pvs, range, SLI_ALL_WITHIN, &shut->pvs);
    SL_TRY(see_shut(context, space, options, plan->map->door_count, shut));
    return range > 0 ? narrow(context, space, range, SLI_ALL_WITHIN, &shut->pvs) : SL_OK;
}

static sl_status see_all(sl_context *context, const sl_space *space, const sl_see_options *options,
                         sl_visibility *open, sl_visibility *shut, sl_visibility *out) {
    const sl_plan *plan = options->plan;
    sl_plan ways = *plan;
    ways.effects &= SL_EFFECT_ONEWAY;
    ways.range = 0;
    sl_see_options swept = *options, searched = *options;
    swept.plan = &ways;
    searched.solver = sl_funnel();
    SL_TRY(sli_see_sweep(context, space, &swept, open));
    // The sweep has decided all that is seen directly.
    const bool decided = !keeps_doors(plan) && !(plan->range > 0);
    if (!decided) SL_TRY(find_certain(context, space, &swept, plan, open, shut));
    if (plan->range > 0) SL_TRY(narrow(context, space, plan->range, SLI_SOME_WITHIN, &open->pvs));
    const sli_dfs_known known = {.possible = &open->pvs,
                                 .certain = decided ? &open->pvs : &shut->pvs};
    SL_TRY(sli_dfs_see_rest(context, space, &searched, &known, out));
    out->account.effects.glass_tests +=
        open->account.effects.glass_tests + shut->account.effects.glass_tests;
    out->account.sweep.pieces = open->account.sweep.pieces + shut->account.sweep.pieces;
    return SL_OK;
}

sl_status sli_see_sweep_finished(sl_context *context, const sl_space *space,
                                 const sl_see_options *options, sl_visibility *out) {
    sl_visibility open = {0}, shut = {0};
    const sl_status status = see_all(context, space, options, &open, &shut, out);
    sl_visibility_destroy(context, &open);
    sl_visibility_destroy(context, &shut);
    return status;
}
