/// The table of cell-to-cell methods, their default options, and what maps they can serve.
#include "cell_to_cell/methods.h"
#include "cell_to_cell/pvs_rows.h"

#include "sightline/stab.h"
#include "sightline/support.h"

#include <string.h>

sl_see_options sl_see_options_default(void) {
    return (sl_see_options){.sight = SL_CLOSED,
                            .tree_bytes = UINT64_C(256) << 20,
                            .seed = 1,
                            .samples = 100,
                            .row_bytes = UINT64_MAX,
                            .sectors = 8};
}

sl_status sl_see_check(sl_context *context, const sl_see_method *method, const sl_solver *solver,
                       const sl_map *map) {
    SL_TRY(sl_effects_check(context, map, method->name, method->knows, method->lacks));
    const sl_plan plan = sl_plan_make(map);
    return method->stabs ? sli_plan_check_solver(context, &plan, solver) : SL_OK;
}

const sl_see_method *sl_see_methods(size_t *count) {
    static const sl_see_method methods[] = {
        {.name = "dfs",
         .what = "depth-first search over portal sequences, each tested for a sightline",
         .stabs = true,
         .guarantee = SL_EXACT,
         .knows = SL_EFFECT_DOOR | SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
         .see = sli_see_dfs,
         .units = "cells",
         .run = sli_run_dfs,
         .finish = sli_finish_dfs,
         .reuse = sli_reuse_search},
        {.name = "sweep",
         .what = "a line turned about every corner of walls, by exact predicates: the fastest",
         .keeps_rows = true,
         .guarantee = SL_EXACT,
         .knows = SL_EFFECT_DOOR | SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
         .see = sli_see_sweep,
         .units = "corners",
         .run = sli_run_sweep,
         .finish = sli_finish_sweep,
         .reuse = sli_reuse_sweep},
        {.name = "prune",
         .what = "dfs only on where a bound leaves something to be found",
         .stabs = true,
         .guarantee = SL_EXACT,
         .knows = SL_EFFECT_DOOR | SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
         .see = sli_see_prune,
         .units = "cells",
         .run = sli_run_prune,
         .finish = sli_finish_prune,
         .reuse = sli_reuse_search},
        {.name = "multipass",
         .what = "sector by sector of directions, each cell among what those behind it see",
         .stabs = true,
         .guarantee = SL_EXACT,
         .keeps_rows = true,
         .lacks = "in each sector of directions it takes pairs both ways, straight on and however "
                  "far apart",
         .see = sli_see_multipass},
        {.name = "flood",
         .what = "all that portals in pairs leave possible",
         .keeps_rows = true,
         .guarantee = SL_CONSERVATIVE,
         .knows = SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
         .see = sli_see_flood},
        {.name = "sampling",
         .what = "random lines from each cell",
         .keeps_rows = true,
         .guarantee = SL_AGGRESSIVE,
         .knows = SL_EFFECT_MIRROR | SL_EFFECT_ONEWAY | SL_EFFECT_RANGE,
         .see = sli_see_sampling},
    };
    *count = sizeof methods / sizeof *methods;
    return methods;
}

const sl_see_method *sl_see_method_named(const char *name) {
    size_t count;
    const sl_see_method *methods = sl_see_methods(&count);
    for (size_t i = 0; i < count; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    return NULL;
}

const sl_see_method *sl_see_method_for(const sl_map *map, const sl_see_options *options) {
    (void)map; // the sweep knows all effects
    return sl_see_method_named(options->trees || options->solver ? "dfs" : "sweep");
}
