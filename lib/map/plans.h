/// Sheets: drawings that hold several plans apart from each other, such as the storeys of a house.
#ifndef SL_MAP_PLANS_H
#define SL_MAP_PLANS_H

#include "sightline/map.h"

/// A plan of a sheet. Boxes are in the sheet's own directions: x along its walls, nearest to
/// the map's x.
typedef struct sli_plan {
    sl_box box;    ///< in the sheet's directions
    sl_box bounds; ///< in the map's
    size_t walls;  ///< walls, doors and glass
} sli_plan;

enum { SLI_PLANS_MOST = 12 };

/// Zeroed, the map is no sheet.
typedef struct sli_sheet {
    sl_point along; ///< the sheet's x, of length 1
    sli_plan plans[SLI_PLANS_MOST];
    size_t count; ///< 0, or at least 2; in reading order: rows from the top, left to right
} sli_sheet;

/// Finds the plans of a map that is not clean. No walls may have changed until sli_sheet_take().
sl_status sli_sheet_find(sl_context *context, const sl_map *map, sli_sheet *out);

/// Keeps one plan: what has its middle in its box. Returns how many walls, doors and glass are left
/// out.
size_t sli_sheet_take(sl_context *context, const sli_sheet *sheet, size_t number, sl_map *map);

#endif
