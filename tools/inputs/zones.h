/// Named parts of a plan: rooms, zones. They come from the map's own objects, from a table of
/// corners, or from the closed outlines of a drawing or map.
#ifndef ZONES_H
#define ZONES_H

#include "inputs/within.h"
#include "sightline/overlay.h"

/// Zeroed, it is empty. A zone is a polygon, counter-clockwise.
typedef struct zone_list {
    SL_ARRAY(sl_point) points; ///< of all zones
    SL_ARRAY(size_t) ends;     ///< by zone: the number of points up to its last one
    SL_ARRAY(char *) names;    ///< by zone
} zone_list;

/// Reads zones. `text` is a file, or names of the map's objects with commas between. A table (.csv)
/// has a line for each corner: name,x,y; a zone has its corners one after the other. Of a drawing
/// or map each closed outline is a zone. `option`: for messages; `input`: how the plan is read.
sl_status zones_read(sl_context *context, const char *option, const char *text,
                     const input_options *input, const sl_map *map, zone_list *out);
/// All zones as one shape, until the list changes.
sl_shape zones_shape(const zone_list *zones);
/// A zone as a shape; `*end` keeps what it refers to.
sl_shape zones_shape_of(const zone_list *zones, size_t zone, size_t *end);
/// Whether a zone, as a shape, has a point.
bool zones_shape_holds(const sl_shape *zone, sl_point at);
/// Whether any zone has a point.
bool zones_hold(const zone_list *zones, sl_point at);
void zones_destroy(sl_context *context, zone_list *zones); ///< and zeroes it

#endif
