/// Shortest ways through a building: along its storeys, and along the links between them.
#ifndef SIGHTLINE_BUILDING_ROUTE_H
#define SIGHTLINE_BUILDING_ROUTE_H

#include "sightline/path.h"
#include "sightline/storeys.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A place of a building.
typedef struct sl_building_place {
    size_t storey; ///< of sl_building.storeys
    sl_point at;
} sl_building_place;

/// A way. Zeroed, there is none.
typedef struct sl_building_route {
    bool found;
    double length;             ///< in the unit of the plans; 0 if there is no way
    sl_building_place *points; ///< from, where the way turns, both ends of links, to
    size_t count;
    size_t *links; ///< of sl_building.links, in the order of the way
    size_t link_count;
} sl_building_route;

/// Finds the shortest way. `finders` has one for each storey, in order; all plans are in one unit.
/// Lengths on a storey are those of sl_route_find(). No way is no failure. SL_BAD_ARGUMENT for a
/// storey that is not there, and as sl_route_find() says, for both places and for ends of links
/// that a shortest way may reach.
///
/// By Dijkstra over both places and the ends of links. Each way on a storey is asked for when its
/// begin is settled: at most (2 links + 2)^2 / storeys ways where links are spread evenly.
SL_API sl_status sl_building_route_find(sl_context *context, const sl_building *building,
                                        sl_route_finder *const *finders, sl_building_place from,
                                        sl_building_place to, sl_building_route *out);
SL_API void sl_building_route_destroy(sl_context *context,
                                      sl_building_route *route); ///< and zeroes it

#ifdef __cplusplus
}
#endif

#endif
