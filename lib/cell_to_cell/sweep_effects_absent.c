/// The sweep where a build leaves effects out: it refuses to begin with any.
#include "cell_to_cell/sweep.h"
#include "effects/effects.h"

sl_status sl_see_sweep_one_way(sl_context *context, const sl_space *space,
                               const sl_see_options *options, sl_visibility *out) {
    (void)space, (void)options, (void)out;
    return sl_effects_refuse(context);
}

sl_status sl_see_sweep_finished(sl_context *context, const sl_space *space,
                                const sl_see_options *options, sl_visibility *out) {
    (void)space, (void)options, (void)out;
    return sl_effects_refuse(context);
}
