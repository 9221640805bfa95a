/// What stands for the work on effects where a build leaves it out: it is refused. Whoever asks
/// sl_effects_check first never comes here.
#include "effects/effects.h"

sl_status sl_effects_refuse(sl_context *context) {
    return sl_fail(context, SL_UNSUPPORTED,
                   "this build is without effects: -DSIGHTLINE_EFFECTS=ON builds with them");
}

sl_status sl_filtered_space_make(sl_context *context, const sl_space *space,
                                 const sl_filtered_space *filtered, uint32_t *portals,
                                 sl_space *out) {
    (void)space, (void)filtered, (void)portals, (void)out;
    return sl_effects_refuse(context);
}
