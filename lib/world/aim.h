/// Which wanted cells a search over portal sequences can still come to.
#ifndef SL_WORLD_AIM_H
#define SL_WORLD_AIM_H

#include "world/world_rows.h"

/// Lists the wanted cells as targets of the next search.
sl_status sli_aim(sl_context *context, sli_world_rows *rows);

/// Whether lines that cross a portal and then a last one may meet a target that the search has not
/// seen yet. True if it has no targets.
bool sli_aim_may_hit(sli_world_rows *rows, const sl_directed_portal *first,
                     const sl_directed_portal *last);

#endif
