/// The table of cell-to-cell methods, and what they share.
#include "cell_to_cell/methods.h"

#include "base/base.h"

sl_see_options sl_see_options_default(void) {
    return (sl_see_options){.sight = SL_CLOSED,
                            .tree_bytes = UINT64_C(256) << 20,
                            .seed = 1,
                            .samples = 100,
                            .row_bytes = UINT64_MAX,
                            .sectors = 8};
}

void sl_visibility_destroy(sl_context *context, sl_visibility *visibility) {
    sl_pvs_destroy(context, &visibility->pvs);
    sl_pvs_destroy(context, &visibility->doubtful);
    sl_free(context, visibility->trees.offsets);
    sl_free(context, visibility->trees.nodes);
    *visibility = (sl_visibility){0};
}

const sl_see_method *sl_see_methods(size_t *count) {
    static const sl_see_method methods[] = {
        {.name = "dfs",
         .what = "depth-first search over portal sequences, each tested for a sightline",
         .stabs = true,
         .guarantee = SL_EXACT,
         .see = sl_see_dfs,
         .units = "cells",
         .look = sl_look_dfs,
         .settle = sl_settle_dfs,
         .carry = sl_carry_search},
        {.name = "sweep",
         .what = "a line turned about every corner of walls, by exact predicates: the fastest",
         .keeps_rows = true,
         .guarantee = SL_EXACT,
         .see = sl_see_sweep,
         .units = "corners",
         .look = sl_look_sweep,
         .settle = sl_settle_sweep,
         .carry = sl_carry_sweep},
        {.name = "prune",
         .what = "dfs only on where a bound leaves something to be found",
         .stabs = true,
         .guarantee = SL_EXACT,
         .see = sl_see_prune,
         .units = "cells",
         .look = sl_look_prune,
         .settle = sl_settle_prune,
         .carry = sl_carry_search},
        {.name = "multipass",
         .what = "sector by sector of directions, each cell among what those behind it see",
         .stabs = true,
         .guarantee = SL_EXACT,
         .keeps_rows = true,
         .see = sl_see_multipass},
        {.name = "flood",
         .what = "all that portals in pairs leave possible",
         .keeps_rows = true,
         .guarantee = SL_CONSERVATIVE,
         .see = sl_see_flood},
        {.name = "sampling",
         .what = "random lines from each cell",
         .keeps_rows = true,
         .guarantee = SL_AGGRESSIVE,
         .see = sl_see_sampling},
    };
    *count = sizeof methods / sizeof *methods;
    return methods;
}
