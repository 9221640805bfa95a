/// One effect a file; the table lists them in the order of their bits.
#ifndef SL_EFFECTS_EFFECTS_H
#define SL_EFFECTS_EFFECTS_H

#include "base/base.h"
#include "sightline/effects.h"

extern const sl_effect sl_effect_door;
extern const sl_effect sl_effect_mirror;
extern const sl_effect sl_effect_oneway;
extern const sl_effect sl_effect_range;

/// SL_UNSUPPORTED: what functions of effects say in a build without them.
sl_status sl_effects_refuse(sl_context *context);

#endif
