/// What viewpoints see of each zone, and tables of it.
#ifndef COVER_ZONES_H
#define COVER_ZONES_H

#include "inputs/zones.h"
#include "studies/cover_report.h"

/// Areas of a zone: inside, and of that by how many viewpoints it is seen.
typedef struct zone_cover {
    double inside, seen, by_two;
    uint32_t viewpoints; ///< that see some of it
} zone_cover;

/// By zone. The caller frees them (sl_free). A zone that is not inside has areas of 0.
sl_status cover_zones_make(sl_context *context, const cover_report *report, const zone_list *zones,
                           zone_cover **out);

/// A line a zone.
void cover_zones_print(const cover_report *report, const zone_list *zones,
                       const zone_cover *covers);
/// "zones"
void cover_zones_add_json(json_fields *fields, const zone_list *zones, const zone_cover *covers);

/// Writes a table (.csv): a row a zone, or where `zones` is NULL a row a viewpoint with what it
/// sees.
sl_status cover_table_write(sl_context *context, const cover_report *report, const zone_list *zones,
                            const zone_cover *covers, const char *path);

#endif
