/// What effects do to the space before sight goes through it.
#ifndef SL_EFFECTS_EFFECTS_H
#define SL_EFFECTS_EFFECTS_H

#include "sightline/effects.h"
#include "sightline/support.h"

/// The space to look through under a plan, or NULL for none: `space` itself, or where one-way glass
/// is called for `made`, without the directed portals that it keeps sight from. `made` is zeroed,
/// and to be destroyed when done.
sl_status sli_oneway_filtered(sl_context *context, const sl_space *space, const sl_plan *plan,
                              sl_space *made, const sl_space **through);

#endif
