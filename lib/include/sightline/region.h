/// The visible region (isovist) of an eye: an exact polygon, with arcs where the range ends.
#ifndef SIGHTLINE_REGION_H
#define SIGHTLINE_REGION_H

#include "sightline/measures.h"
#include "sightline/outline.h"
#include "sightline/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The `wall` of an edge that lies on none.
#define SL_NO_WALL UINT32_MAX

/// What an edge of a region lies on.
typedef enum sl_edge_kind {
    SL_EDGE_WALL,      ///< on a wall, or on several pieces that portals cut one wall into
    SL_EDGE_BORDER,    ///< on the map's border, where no wall is
    SL_EDGE_OCCLUDING, ///< radial: what lies beyond it is hidden by the corner at its near end
    SL_EDGE_CONE,      ///< on a border of the view cone
    SL_EDGE_MIRROR,    ///< of what is seen by mirror (mirrored.h): the mirror, nearest to the eye
    SL_EDGE_ARC,       ///< of less than half a circle about the eye, counter-clockwise: the range
} sl_edge_kind;

/// An edge of a region.
typedef struct sl_region_edge {
    uint32_t wall; ///< index of the space's walls; SL_NO_WALL for all kinds but walls
    uint8_t kind;  ///< of sl_edge_kind
    bool exact;    ///< its start is a corner of the space (or the eye), not a computed point
} sl_region_edge;

/// A region: a counter-clockwise polygon, star-shaped about the eye. Edge i leads from points[i] to
/// the next point, around. Zero it to start. It keeps its memory from one sl_region_make to the
/// next, so repeated calls allocate only while regions grow.
///
/// It is decided exactly which walls are met, and in what order. A point that is no corner is
/// computed in doubles, to a few units in the last place of its distance from the eye along each
/// axis. What is seen only in a single direction (a needle) is not part of the region. A wall that
/// is seen edge-on hides nothing; the radial edge along it counts as occluding.
typedef struct sl_region {
    sl_view view;
    double range;  ///< 0 for no limit
    uint32_t cell; ///< that sl_space_locate gives for the eye; SL_NO_CELL, and the region is empty,
                   ///< outside the bounds and in solid ground
    size_t count;  ///< of points, offsets and edges; 0 for an empty region
    sl_point *points;
    sl_point *offsets; ///< the points less the eye: more precise far from the origin
    sl_region_edge *edges;
    uint64_t portals_passed; ///< of the outline, to find it: the measure of the work
    struct sli_region_memory *memory;
} sl_region;

SL_API void sl_region_destroy(sl_context *context, sl_region *region); ///< and zeroes it

/// Makes the region of a view by expanding it through portals, from the cells at the eye (Teller
/// 1992, Visibility Computations in Densely Occluded Polyhedral Environments, eye-to-region; Bungiu
/// et al. 2014, Efficient Computation of Visibility Polygons, on triangles). `range` limits how far
/// is seen; 0 for no limit.
///
/// What an eye sees that is on a wall, on its end or on a portal, view.h says. Where a wall parts
/// what is around the eye, the eye is a point of its region; so is the eye of a cone. An eye that
/// sees nothing, and a cone of 0 degrees, have an empty region.
///
/// SL_BAD_ARGUMENT for a range that is negative or not finite, and for a cone's border that is the
/// eye itself or not finite. On failure the region is empty.
SL_API sl_status sl_region_make(sl_context *context, const sl_outline *outline, const sl_view *view,
                                double range, sl_region *region);

/// Measures under the names that depthmapX gives them (isovist.cpp of its salalib), in the map's
/// unit: measures.h says what each is. All are 0 for an empty region. Arcs count as arcs, not as
/// chords.
typedef struct sl_region_measures {
    SL_ISOVIST_MEASURES(SL_MEASURE_MEMBER)
    SL_RADIAL_MEASURES(SL_MEASURE_MEMBER)
} sl_region_measures;

/// All measures of a region. Time: its edges.
SL_API sl_region_measures sl_region_measure(const sl_region *region);

/// The area alone: faster.
SL_API double sl_region_area(const sl_region *region);

/// The visible corners of walls: ends of walls that are points of the region, in its order. Writes
/// up to `room` of them and returns how many there are; at most region->count.
SL_API size_t sl_region_corners(const sl_region *region, const sl_space *space, sl_point *corners,
                                size_t room);

/// The region as a plain polygon, its arcs as chords that lie within `tolerance` of them. Writes up
/// to `room` points and returns how many there are.
SL_API size_t sl_region_flatten(const sl_region *region, double tolerance, sl_point *points,
                                size_t room);

#ifdef __cplusplus
}
#endif

#endif
