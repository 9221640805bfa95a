/// What the exports of a baked file share: the effects on a portal.
#ifndef SL_EXPORT_H
#define SL_EXPORT_H

#include "sightline/bake.h"

/// The first door that a portal lies on; NULL for none.
const sl_door *sli_portal_door(const sl_baked *baked, uint32_t portal);

/// Which ways sight goes through the glass on a portal.
typedef enum sli_glass_way {
    SLI_GLASS_NONE, ///< no glass: both ways
    SLI_GLASS_FROM, ///< from the portal's first cell to its second only
    SLI_GLASS_TO,   ///< from the second to the first only
    SLI_GLASS_SHUT, ///< neither: two panes face each other
} sli_glass_way;

sli_glass_way sli_portal_glass(const sl_space *space, uint32_t portal);

/// "from", "to" or "none"; NULL where no glass is.
const char *sli_glass_name(sli_glass_way way);

#endif
