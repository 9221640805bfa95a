/// What viewpoints see of each zone or room, and tables of it.
#ifndef COVER_ZONES_H
#define COVER_ZONES_H

#include "inputs/zones.h"
#include "sightline/rooms.h"
#include "studies/cover_report.h"

/// Of a zone, or a room.
typedef struct zone_cover {
    const char *name;               ///< the zone's own
    double by[SL_COVERAGE_CLASSES]; ///< the area inside that at least so many viewpoints see
    uint32_t viewpoints;            ///< that see some of it
} zone_cover;

/// Zeroed, none.
typedef struct zone_covers {
    const char *what; ///< "zone" or "room"; NULL: none were made
    zone_cover *items;
    size_t count;
} zone_covers;

/// By zone; the names are those of the list. A zone that is not inside has areas of 0.
sl_status cover_zones_make(sl_context *context, const cover_report *report, const zone_list *zones,
                           zone_covers *out);
/// By room.
sl_status cover_rooms_make(sl_context *context, const cover_report *report, const sl_rooms *rooms,
                           zone_covers *out);
void cover_zones_destroy(sl_context *context, zone_covers *covers); ///< and zeroes them

/// The share, in percent, that exactly so many see; of the last class, that many or more.
double cover_zone_percent(const zone_cover *cover, uint32_t class);

/// A line a zone.
void cover_zones_print(const cover_report *report, const zone_covers *covers);
/// "zones" or "rooms"
void cover_zones_add_json(json_fields *fields, const zone_covers *covers);

/// Writes a table (.csv): a row a zone, or where there are no `covers` a row a viewpoint with what
/// it sees.
sl_status cover_table_write(sl_context *context, const cover_report *report,
                            const zone_covers *covers, const char *path);

#endif
