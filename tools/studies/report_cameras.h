/// The part of a report about cameras: their picture, classes of coverage, rooms, blind spots.
#ifndef REPORT_CAMERAS_H
#define REPORT_CAMERAS_H

#include "studies/cover_zones.h"
#include "studies/report_blocks.h"

typedef struct report_cameras_scene {
    const char *table; ///< of the viewpoints
    const char *input; ///< the map's file
    const sl_baked *baked;
    sl_query *query;
    const sl_rooms *rooms;
} report_cameras_scene;

/// What the blocks refer to. Zeroed, nothing.
typedef struct report_cameras {
    sl_cameras cameras;
    sl_coverage coverage;
    zone_covers rooms;
    cover_drawn drawn;
} report_cameras;

/// Reads the table and adds the blocks.
sl_status report_cameras_add(sl_context *context, const report_cameras_scene *scene,
                             report_blocks *blocks, report_cameras *out);
void report_cameras_destroy(sl_context *context, report_cameras *cameras);

#endif
