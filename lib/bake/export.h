/// The exports that stand in the table (export.c), and what they share: the effects on a portal.
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

// --- what stands in the table of exports

/// "json": one object with all that a baked file holds, but for stab trees and notes.
/// SL_UNSUPPORTED for a map with mirrors in version 1.
sl_status sli_export_json(sl_context *context, const sl_baked *baked,
                          const sl_export_options *options, const char *path);
/// "geojson": a FeatureCollection of cells, portals, walls, doors, mirrors, one-way glass and
/// starts, in the map's own coordinates. Its writer is in sightline/json.h.
sl_status sli_export_geojson(sl_context *context, const sl_baked *baked,
                             const sl_export_options *options, const char *path);
/// "csv": a line "from,to" for each ordered pair seen.
sl_status sli_export_csv(sl_context *context, const sl_baked *baked,
                         const sl_export_options *options, const char *path);
/// "c": a C header with tables: cells, portals, doors by name, starts, and a bit for each pair that
/// is seen. SL_BAD_ARGUMENT for a prefix that is no C identifier.
sl_status sli_export_c(sl_context *context, const sl_baked *baked, const sl_export_options *options,
                       const char *path);

#endif
