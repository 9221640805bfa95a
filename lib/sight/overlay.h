/// Overlays with a limit.
#ifndef SL_SIGHT_OVERLAY_H
#define SL_SIGHT_OVERLAY_H

#include "sightline/overlay.h"

/// As sl_overlay_make, but SL_UNSUPPORTED where outlines cross more often than `most`. `what` is
/// laid: for the message.
sl_status sli_overlay_make_up_to(sl_context *context, const char *what, const sl_shape *within,
                                 const sl_shape *shapes, size_t count, size_t most,
                                 sl_overlay *out);

#endif
