/// Shortest ways among walls: how far is it around the corner?
///
///     sl_route_finder *finder;
///     sl_route route = {0};
///     sl_route_finder_create(context, query, &finder);
///     sl_route_find(context, finder, from, to, &route);
///     if (route.found) use(route.length);
///     sl_route_destroy(context, &route);
///     sl_route_finder_destroy(context, finder);
///
/// A way is walked by a point, from cell to cell through portals. It may slide along walls and turn
/// at their ends, but it does not pass between walls that meet in a point. Shut doors and boxes
/// that block are walls; one-way glass is passed from where it is seen through. Mirrors are walls,
/// and the range does not count. A space is for sight or for steps (sl_map.channel): ways go by
/// what the query's space is for.
///
/// A point on a wall stands on one side of it, as an eye does (view.h). So without one-way glass
/// the distance is the same both ways, and no longer than by way of a third point.
///
/// How far sound goes: open all doors in the query, and give those that are shut a loss
/// (sl_route_finder_set_losses). They are passed then, each as if it was so much farther.
#ifndef SIGHTLINE_PATH_H
#define SIGHTLINE_PATH_H

#include "sightline/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Finds ways in the space of one query. Serves one thread at a time.
typedef struct sl_route_finder sl_route_finder;

/// A way. Zero it to start. It keeps its memory from one sl_route_find() to the next.
typedef struct sl_route {
    bool found;        ///< false: no way leads there
    double length;     ///< in map units; 0 if there is no way
    sl_point *points;  ///< from, the corners where the way turns (ends of walls), to
    size_t count;      ///< of points, 2 or more; 0 if there is no way
    uint32_t *portals; ///< the portals that it passes, in order: numbers of the query's space
    size_t portal_count;
    sl_point nearest; ///< if there is no way: a place that can be reached, next to the one that is
                      ///< nearest to `to`; rounded
    uint64_t nodes;   ///< search nodes that were expanded: the measure of the work
    size_t room, portal_room;
} sl_route;

SL_API void sl_route_destroy(sl_context *context, sl_route *route); ///< and zeroes it

/// A finder over the space that the query's settings make (sl_query_space). The query must outlive
/// it. SL_UNSUPPORTED for a loose space. Time and memory: O(portals).
///
/// For many ways among axial walls, cut the map by `mesh` (sl_subdivisions): its cells end at ends
/// of walls only, so ways through them are found in less time than through those of a kd-tree.
SL_API sl_status sl_route_finder_create(sl_context *context, sl_query *query,
                                        sl_route_finder **out);
/// Frees a finder. NULL is allowed.
SL_API void sl_route_finder_destroy(sl_context *context, sl_route_finder *finder);

/// Follows changes of the query's settings: to be called after doors or boxes change, before the
/// next question. Time O(portals). After a failure it must be called again.
SL_API sl_status sl_route_finder_update(sl_context *context, sl_route_finder *finder);

/// Passing door i of the map costs losses[i] in map units, as if the way was longer by that.
/// `count` losses, each finite and 0 or more; other doors have none. NULL: no losses. They are part
/// of lengths and distances from now on. The query says which doors are open: one that is shut
/// there is not passed. A door with a loss above 0 parts its two sides: a point on it stands on one
/// of them. Updates the finder. SL_BAD_ARGUMENT for other losses; nothing has changed then.
SL_API sl_status sl_route_finder_set_losses(sl_context *context, sl_route_finder *finder,
                                            const double *losses, size_t count);

/// How far from walls a walker with a radius must stand at both ends of its way, as a multiple of
/// the radius: 1 / cos(pi / 64), rounded up.
#define SL_ROUTE_ROOM 1.0013

/// Ways for a walker that is a disc of this radius, in map units: 0 or more; 0, as at first, is a
/// point. The way of its middle stays farther than the radius from all walls. It is no longer than
/// the shortest way of a disc whose radius is SL_ROUTE_ROOM times as large: arcs around ends of
/// walls are replaced by tangents. So a gap that is exactly as wide as the walker is not passed.
/// The bounds stop the middle of the walker only. Both ends of a way must have room for the larger
/// disc; 2^-39 of the largest coordinate is added to all this for rounding.
///
/// The way then turns at corners of the tangents, and it has no portals: those of the query's space
/// are not searched. Updates the finder. A question cleans and cuts a map that has the outline of
/// grown walls: only of those near cells that a way as short leads through, until that has been
/// done for as many walls as there are, or there is no way; then once of all. SL_UNSUPPORTED with
/// one-way glass, losses, and sl_route_distances(). SL_BAD_ARGUMENT for another radius.
SL_API sl_status sl_route_finder_set_radius(sl_context *context, sl_route_finder *finder,
                                            double radius);

/// The shortest way from one point to another (Cui, Harabor and Grastien 2017, Compromise-free
/// Pathfinding on a Navigation Mesh: Polyanya, on the convex cells).
///
/// Signs are exact: the way crosses no wall, and it turns only where a wall is. Lengths are sums of
/// square roots, compared as doubles: the way is longer than the shortest one by at most a relative
/// 2^-40 for each of its corners. `length` is rounded to a few units in the last place. Of ways of
/// the same length one is chosen by the places of its corners. It is read from its end: the corner
/// before a corner is the first around that, counter-clockwise from the direction of x. So the same
/// input gives the same way, as a rule in other cells, too. For a corner only those before it count
/// from which most can be turned to.
///
/// SL_BAD_ARGUMENT for a point outside the bounds or in solid ground, or without room for the
/// walker. No way is no failure. No memory is allocated once `route` and the finder have grown.
SL_API sl_status sl_route_find(sl_context *context, sl_route_finder *finder, sl_point from,
                               sl_point to, sl_route *route);

/// How far a cell is: the length of the shortest way to its nearest point.
typedef struct sl_route_near {
    double distance; ///< in map units; INFINITY: no way leads there, or the cell is too far
    sl_point at;     ///< the nearest point, rounded; of several, any
} sl_route_near;

/// How far each cell of the query's space is from a point: cells[c], of all sl_space.cell_count.
/// Cells that are farther than `limit` (0 or more; INFINITY: none) are INFINITY. With losses, the
/// others are the cells that a sound with that range reaches.
///
/// Signs are exact, as in sl_route_find(). Distances are rounded: off by at most a relative 2^-40
/// for each corner, and 2^-40 of the bounds' greater side. The limit is conservative: it leaves out
/// no cell within it, for ways with up to 1000 corners. Cells that are farther by up to a relative
/// 2^-30 and 2^-38 of that side may be in. Time and memory grow with the cells that corners see,
/// not with pairs of cells: nodes that bring nothing to a cell are left out.
///
/// SL_BAD_ARGUMENT for a point outside the bounds or in solid ground, or another limit.
SL_API sl_status sl_route_distances(sl_context *context, sl_route_finder *finder, sl_point from,
                                    double limit, sl_route_near *cells);

/// A shortest path map: how far all places are from one. Serves one thread at a time.
typedef struct sl_route_map sl_route_map;

/// How far a place is.
typedef struct sl_route_place {
    double distance; ///< in map units; INFINITY: no way leads there, or it is too far
    sl_point root;   ///< where the shortest way turns last before it; `from` if it is straight
} sl_route_place;

/// Makes the map of the shortest ways from a point. Each cell keeps the last corners of ways into
/// it, each with the directions that it serves; those that bring nothing to the cell are left out.
/// So its parts by last corner, which have bent borders, are found where they are asked for.
///
/// `limit` is as for sl_route_distances(): places that are farther may be INFINITY; those within it
/// are not. The finder must outlive the map, and must not be updated until then. SL_BAD_ARGUMENT
/// for a point outside the bounds or in solid ground, or another limit; SL_UNSUPPORTED with a
/// radius. Time as for sl_route_distances(); memory: the corners that cells keep.
SL_API sl_status sl_route_map_create(sl_context *context, sl_route_finder *finder, sl_point from,
                                     double limit, sl_route_map **out);
SL_API void sl_route_map_destroy(sl_context *context, sl_route_map *map); ///< NULL is allowed

/// How far a place is, as sl_route_find() says it, and where the way to it turns last. Of ways that
/// are as long, any. Signs are exact; the distance is off by at most a relative 2^-40 for each
/// corner. INFINITY for a place outside the bounds or in solid ground. Time: the corners that its
/// cells keep.
SL_API void sl_route_map_at(sl_route_map *map, sl_point to, sl_route_place *out);

#ifdef __cplusplus
}
#endif

#endif
