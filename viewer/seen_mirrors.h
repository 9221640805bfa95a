/// What the eye sees in mirrors. That grows with each reflection, so that a frame takes what it has
/// time for.
#ifndef VIEWER_SEEN_MIRRORS_H
#define VIEWER_SEEN_MIRRORS_H

#include "seen.h"

/// Sets, of each method, what is seen by mirror, and the parts of the region. Where that takes too
/// long, cells are those that were baked, and parts those of fewer reflections.
sl_status seen_look_into_mirrors(sl_context *context, seen_state *seen,
                                 const document_state *document, const present_state *present);

void seen_forget_mirrors(sl_context *context, seen_state *seen);

#endif
